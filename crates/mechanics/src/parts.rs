//! The quantities of a system that its elements have in common, while they are assembled.

use crate::energy::EnergyTerm;

/// Energy terms and couplings that are collected during assembly.
pub(crate) struct Parts {
    pub energy_terms: Vec<EnergyTerm>,
    pub internal_pairs: Vec<Vec<usize>>,
    pub quadrature_bodies: Vec<(usize, usize)>,
    pub quadrature_pairs: Vec<(usize, usize)>,
}
