//! Parts of the modified Newton iteration of the ESDIRK methods that do not depend on the integrator: the
//! stage predictor, the Jacobian cache with the contact state it is valid for, and the line search.
//!
//! A stage is the zero of `F(z) = (base - z)/(hγ) + f(t, z)`; a correction is `d = (I/(hγ) - J)⁻¹ F(z)`. The
//! iteration itself is in [`crate::integrator`]'s file `esdirk.rs`.

mod contact_state;
mod jacobian_cache;
mod line_search;
mod slip_reversal;
mod stage_predictor;

pub(crate) use jacobian_cache::{CacheValidity, JacobianCache, LinearizationPoint};
pub(crate) use line_search::LineSearch;
pub(crate) use slip_reversal::SlipReversal;
pub(crate) use stage_predictor::{Extrapolation, StepHistory};

use crate::discontinuity::DiscontinuityFunctions;
use crate::problem::Problem;
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
    /// Whether the cached matrix was valid at the predicted stage.
    pub cache_valid: bool,
    /// Whether the predicted stage is that of the cubic; then `next` holds that of the straight line.
    pub predicted_by_cubic: bool,
    /// The last step, valid if it ended smoothly.
    pub history_valid: bool,
    pub history: StepHistory,
    /// Discontinuity functions at the start and at the end of a correction.
    pub ends: [DiscontinuityFunctions; 2],
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
    pub fn new<P: Problem>(problem: &P, tolerance: f64, stride: usize) -> Self {
        let zero = || vec![0.0; stride];
        let (mut correction_weights, mut error_weights) = (zero(), zero());
        let scales = problem.scales();
        for (weight, scale) in correction_weights
            .iter_mut()
            .zip(scales)
            .take(problem.dynamic_states())
        {
            *weight = 1.0 / (tuning::LAST_CORRECTION * tolerance * scale);
        }
        for (weight, bound) in correction_weights.iter_mut().zip(problem.zone_error_bounds()) {
            *weight = weight.max(1.0 / (tuning::LAST_CORRECTION_IN_ZONE * bound));
        }
        for (weight, scale) in error_weights.iter_mut().zip(scales).take(problem.displacements()) {
            *weight = 1.0 / (tolerance * scale);
        }
        let functions = || DiscontinuityFunctions::zeros(problem.discontinuity_counts());
        Self {
            cache: JacobianCache::new(problem, stride),
            ends: [functions(), functions()],
            history: StepHistory {
                step: 0.0,
                x: zero(),
                first: zero(),
            },
            base: zero(),
            from: zero(),
            correction: zero(),
            next: zero(),
            correction_weights,
            error_weights,
            ..Self::default()
        }
    }

    /// Returns whether the last stage needed no matrix but the cached one.
    pub fn was_smooth(&self) -> bool {
        self.cache_valid && self.matrices == 1
    }

    /// Stores an accepted step of length `step`, from states `x` with the first stage `first`, if it ended
    /// smoothly.
    pub fn store_step(&mut self, step: f64, x: &[f64], first: &[f64]) {
        self.history_valid = self.was_smooth();
        if self.history_valid {
            self.history.step = step;
            self.history.x.copy_from_slice(x);
            self.history.first.copy_from_slice(first);
        }
    }

    /// Returns the last step for a saved state, with vectors of `dimension` entries.
    pub fn saved_history(&self, dimension: usize) -> Option<StepHistory> {
        self.history_valid.then(|| StepHistory {
            step: self.history.step,
            x: self.history.x[..dimension].to_vec(),
            first: self.history.first[..dimension].to_vec(),
        })
    }

    /// Restores the last step of a saved state.
    pub fn restore_history(&mut self, saved: Option<&StepHistory>) {
        self.history_valid = saved.is_some();
        if let Some(saved) = saved {
            let n = saved.x.len();
            self.history.step = saved.step;
            self.history.x[..n].copy_from_slice(&saved.x);
            self.history.first[..n].copy_from_slice(&saved.first);
        }
    }

    /// Forgets the matrix and the last step: the right-hand side has changed.
    pub fn forget(&mut self) {
        self.cache.clear();
        self.history_valid = false;
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
