//! Creep forces.
