//! Elastic contact of two curved bodies.
