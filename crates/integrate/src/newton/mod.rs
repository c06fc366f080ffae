//! Parts of the modified Newton iteration of the ESDIRK methods that do not depend on the integrator: the
//! Jacobian cache with the contact state it is valid for, and the line search.
//!
//! A stage is the zero of `F(z) = (base - z)/(hγ) + f(t, z)`; a correction is `d = (I/(hγ) - J)⁻¹ F(z)`. The
//! iteration itself is in [`crate::integrator`]'s file `esdirk.rs`.

mod contact_state;
mod jacobian_cache;
mod line_search;

pub(crate) use jacobian_cache::{CacheValidity, JacobianCache, LinearizationPoint};
pub(crate) use line_search::LineSearch;

use crate::problem::ProblemStructure;
use crate::tuning::newton as tuning;

/// The stage being solved.
#[derive(Debug, Default)]
pub(crate) struct Newton {
    /// Index of the stage, and its time.
    pub stage: usize,
    pub time: f64,
    /// Number of matrices used for it so far.
    pub matrices: u32,
    /// Norm of the last correction; at most 1: it is admissible as the last one.
    pub size: f64,
    pub line_search: LineSearch,
    pub cache: JacobianCache,
    /// True if the cached matrix was valid at the predicted stage.
    pub cache_valid: bool,
    pub base: Vec<f64>,
    /// The point where the last correction starts, that correction, and the next one.
    pub from: Vec<f64>,
    pub correction: Vec<f64>,
    pub next: Vec<f64>,
    /// Reciprocals of the admissible last correction.
    pub correction_weights: Vec<f64>,
    /// Reciprocals of the admissible error.
    pub error_weights: Vec<f64>,
}

impl Newton {
    /// Returns the memory for a problem; vectors have `stride` entries.
    pub fn new(structure: &ProblemStructure, tolerance: f64, stride: usize) -> Self {
        let zero = || vec![0.0; stride];
        let (mut correction_weights, mut error_weights) = (zero(), zero());
        let scales = &structure.scales;
        for (weight, scale) in correction_weights
            .iter_mut()
            .zip(scales)
            .take(structure.dynamic_states)
        {
            *weight = 1.0 / (tuning::LAST_CORRECTION * tolerance * scale);
        }
        for (weight, bound) in correction_weights.iter_mut().zip(&structure.zone_error_bounds) {
            *weight = weight.max(1.0 / (tuning::LAST_CORRECTION_IN_ZONE * bound));
        }
        for (weight, scale) in error_weights.iter_mut().zip(scales).take(structure.displacements) {
            *weight = 1.0 / (tolerance * scale);
        }
        Self {
            cache: JacobianCache::new(structure, stride),
            base: zero(),
            from: zero(),
            correction: zero(),
            next: zero(),
            correction_weights,
            error_weights,
            ..Self::default()
        }
    }

    /// Returns the component of the next correction along the last one, relative to the last one. `size` is
    /// the norm of the next correction; where it is not finite, it points straight back.
    pub fn component_along(&self, size: f64) -> f64 {
        if !size.is_finite() {
            return -1.0;
        }
        let (mut product, mut square) = (0.0, 0.0);
        let corrections = self.correction.iter().zip(&self.next);
        for ((last, next), weight) in corrections.zip(&self.correction_weights) {
            let last = last * weight;
            product += last * (next * weight);
            square += last * last;
        }
        product / square
    }
}
