//! Plain data of the integrator: the attempt at a step, and the memory of the dense-output correction.

use crate::discontinuity::Prediction;
use crate::error::Reason;

/// The reason why an attempt failed, and the index of the state to blame.
pub(super) struct AttemptFailure {
    pub reason: Reason,
    pub index: Option<usize>,
}

/// The norm of the error of an attempt in units of the tolerance, or why it failed.
pub(super) type AttemptOutcome = Result<f64, AttemptFailure>;

/// The current attempt at a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attempt {
    /// Latest end of the step.
    pub end: f64,
    /// Planned length of the step.
    pub proposed: f64,
    /// Length and end of the attempt.
    pub step: f64,
    pub target: f64,
    /// The predicted discontinuity or zone at which the attempt ends.
    pub prediction: Option<Prediction>,
    /// True if the attempt is shorter than planned, because of a limit or a prediction.
    pub truncated: bool,
    /// Error of the last attempt that was rejected because of its error, in units of the tolerance.
    pub scaled_error: f64,
    /// True if the attempt only locates the origin of a value that is not finite.
    pub diagnostic: bool,
    /// Index of the state to blame for the failure before a diagnostic attempt.
    pub blamed: Option<usize>,
}

impl Attempt {
    pub const NONE: Self = Self {
        end: f64::NAN,
        proposed: f64::NAN,
        step: f64::NAN,
        target: f64::NAN,
        prediction: None,
        truncated: false,
        scaled_error: 0.0,
        diagnostic: false,
        blamed: None,
    };
}

/// The state of the correction of the last step's dense output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum CorrectionState {
    /// They are not.
    #[default]
    Disabled,
    /// The first correction will tell, with the matrix of the step.
    Undecided,
    /// They are.
    Enabled,
}

/// Memory of the dense-output correction.
#[derive(Debug, Default)]
pub(super) struct DenseCorrection {
    pub state: CorrectionState,
    /// States of the dense output, and the corrected ones.
    pub start: Vec<f64>,
    pub x: Vec<f64>,
    /// Derivative of the dense output.
    pub derivative: Vec<f64>,
    /// Right-hand side; then the correction.
    pub rate: Vec<f64>,
}

impl DenseCorrection {
    /// Returns the memory for vectors of `stride` entries.
    pub fn new(stride: usize) -> Self {
        Self {
            state: CorrectionState::Disabled,
            start: vec![0.0; stride],
            x: vec![0.0; stride],
            derivative: vec![0.0; stride],
            rate: vec![0.0; stride],
        }
    }
}
