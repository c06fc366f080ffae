//! Profiles of wheels and rails.
