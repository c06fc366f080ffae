//! Jacobian cache: the matrix of Newton's method is used again in later stages and steps, as long as they are
//! in the contact state in which it was evaluated.
//!
//! A matrix of another contact state does harm that corrections do not show: one from within a regularization
//! zone is some hundred times as stiff as the same contact when it slides, so that corrections look as much
//! too small. (Several cached matrices, one per contact state, gained nothing: decision 0043.)

use serde::{Deserialize, Serialize};

use super::contact_state::ActiveSet;
use crate::discontinuity::DiscontinuityFunctions;
use crate::problem::{Problem, ProblemStructure};

/// The linearization point of a Jacobian matrix.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct LinearizationPoint {
    pub time: f64,
    /// States; padded in the cache.
    pub x: Vec<f64>,
    /// Shift with which the matrix is factored; zero: it is not factored.
    pub shift: f64,
}

impl LinearizationPoint {
    /// Returns a value that it cannot have in a run whose smooth interval began at `start`.
    pub fn damage(&self, start: f64) -> Option<f64> {
        let mut values = self.x.iter().chain([&self.time, &self.shift]).copied();
        values
            .find(|value| !value.is_finite())
            .or((self.time < start).then_some(self.time))
            .or((self.shift < 0.0).then_some(self.shift))
    }
}

/// The state of the matrix; the problem itself stores it.
#[derive(Debug, Default)]
pub(crate) struct JacobianCache {
    /// True if there is a matrix.
    filled: bool,
    /// True if the problem reports all its discontinuities.
    complete: bool,
    point: LinearizationPoint,
    /// Contact state at that point, and at the point of the last [`JacobianCache::set_contact_state`].
    contact_state: ActiveSet,
    current: ActiveSet,
    /// Scratch memory.
    functions: DiscontinuityFunctions,
}

/// Validity of the cached matrix at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CacheValidity {
    /// It was evaluated in the same contact state.
    Valid,
    /// It was evaluated in another contact state, or there is none.
    Invalid,
    /// There is a matrix, but its contact state is unknown: the problem does not report all its
    /// discontinuities.
    Unknown,
}

impl JacobianCache {
    /// Returns an empty cache for a problem.
    pub fn new(structure: &ProblemStructure, stride: usize) -> Self {
        let functions = DiscontinuityFunctions::zeros(structure.discontinuity_values, structure.slips);
        let current = ActiveSet::new(&functions);
        Self {
            filled: false,
            complete: structure.discontinuities_complete,
            point: LinearizationPoint {
                x: vec![0.0; stride],
                ..LinearizationPoint::default()
            },
            contact_state: current.clone(),
            functions,
            current,
        }
    }

    /// Forgets the matrix.
    pub fn clear(&mut self) {
        self.filled = false;
    }

    /// Computes the contact state at a point, if the problem reports all its discontinuities.
    pub fn set_contact_state<P: Problem>(&mut self, problem: &mut P, time: f64, x: &[f64]) {
        if self.complete {
            problem.discontinuities(time, x, &mut self.functions);
            self.current.set(&self.functions);
        }
    }

    /// Computes the contact state at a point; returns whether the matrix is valid there.
    pub fn validity<P: Problem>(&mut self, problem: &mut P, time: f64, x: &[f64]) -> CacheValidity {
        self.set_contact_state(problem, time, x);
        if !self.filled {
            CacheValidity::Invalid
        } else if !self.complete {
            CacheValidity::Unknown
        } else if self.contact_state.is_near(&self.current) {
            CacheValidity::Valid
        } else {
            CacheValidity::Invalid
        }
    }

    /// Stores that the matrix was evaluated at a point (states padded), that of the last contact state.
    pub fn store(&mut self, time: f64, x: &[f64]) {
        (self.filled, self.point.time, self.point.shift) = (true, time, 0.0);
        self.point.x.copy_from_slice(x);
        std::mem::swap(&mut self.contact_state, &mut self.current);
    }

    /// Returns the shift with which the matrix is factored; zero: it is not factored.
    pub fn shift(&self) -> f64 {
        self.point.shift
    }

    /// Stores the shift with which the matrix was factored.
    pub fn set_shift(&mut self, shift: f64) {
        self.point.shift = shift;
    }

    /// Returns the linearization point of the matrix for a saved state, with `dimension` states.
    pub fn saved_point(&self, dimension: usize) -> Option<LinearizationPoint> {
        self.filled.then(|| LinearizationPoint {
            x: self.point.x[..dimension].to_vec(),
            ..self.point
        })
    }
}
