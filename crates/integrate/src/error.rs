//! Errors.

use crate::limits::{MAXIMUM_COUNT, STATE_VERSION};

/// An integration cannot begin.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SetupError {
    /// An option is not admissible.
    #[error("`{name}` is {value}; it must {must}")]
    Option {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The condition on it.
        must: &'static str,
    },
    /// A length does not fit.
    #[error("the problem has {expected} {what}, but {found} were given")]
    Dimension {
        /// The counted things.
        what: &'static str,
        /// The number that the problem has.
        expected: usize,
        /// The given number.
        found: usize,
    },
    /// An error scale is not positive.
    #[error(
        "the error scale of state {index} is {value}; it must be positive (infinite: not error controlled)"
    )]
    Scale {
        /// The state.
        index: usize,
        /// Its scale.
        value: f64,
    },
    /// No state is error controlled, so that the step size is not determined.
    #[error("no state has a finite error scale: give one, or use a fixed step")]
    NothingControlled,
    /// The time is not finite.
    #[error("the start time is {0}")]
    Time(f64),
    /// The initial value of a state is not finite.
    #[error("state {index} starts with {value}")]
    NotFiniteState {
        /// The state.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// The right-hand side is not finite at the start.
    #[error("the derivative of state {index} is {value} at the start (time {time})")]
    NotFiniteDerivative {
        /// The start.
        time: f64,
        /// The state.
        index: usize,
        /// Its derivative.
        value: f64,
    },
    /// The problem's next time discontinuity is not later than the start of the interval.
    #[error("the problem's next time discontinuity after {start} is at {end}; it must be later")]
    TimeDiscontinuity {
        /// Start of the interval.
        start: f64,
        /// Its end.
        end: f64,
    },
    /// A saved state comes from another version of this library.
    #[error(
        "the saved state has version {found}; this program reads version {expected}",
        expected = STATE_VERSION
    )]
    Version {
        /// Version of the saved state.
        found: u32,
    },
    /// A member of a saved state has a value that it cannot have.
    #[error(
        "the saved state is damaged: `{name}` is {value}; continue from the state as it was saved, or begin \
         anew"
    )]
    Damaged {
        /// The member.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A counter of a saved state is larger than any run can count.
    #[error(
        "the saved state is damaged: the counter `{name}` is {found}, and no run counts beyond {maximum}; \
         continue from the state as it was saved, or begin anew",
        maximum = MAXIMUM_COUNT
    )]
    Counter {
        /// The counter.
        name: &'static str,
        /// Its value.
        found: u64,
    },
}

/// Reasons why a step was not accepted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// The local error was too large.
    Error,
    /// A value was not finite.
    NotFinite,
    /// The matrix was singular.
    Singular {
        /// Index of the diagonal block.
        block: usize,
    },
    /// Newton's method did not converge.
    NewtonFailure,
    /// The maximum number of steps is reached.
    MaximumSteps {
        /// The maximum number.
        maximum: u64,
    },
    /// The step is so short that adding it does not change the time.
    StepUnderflow,
    /// The limit is not later than the time.
    Limit {
        /// The limit.
        limit: f64,
    },
    /// The problem's next time discontinuity is not later than the time.
    TimeDiscontinuity {
        /// The discontinuity.
        end: f64,
    },
}

/// No step could be accepted. The integrator still holds the last accepted step.
#[derive(Clone, Debug, PartialEq)]
pub struct StepError {
    /// Time at the start of the step.
    pub time: f64,
    /// Length of the last attempt.
    pub step: f64,
    /// The reason for its rejection.
    pub reason: Reason,
    /// Index of the state with the largest error, or of the first one that is not finite.
    pub index: Option<usize>,
    /// Error of that state in units of the tolerance, in the last attempt rejected because of its error; NaN
    /// if not finite.
    pub scaled_error: f64,
}

impl std::fmt::Display for StepError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            time,
            step,
            reason,
            index,
            scaled_error,
        } = self;
        let state = |f: &mut std::fmt::Formatter<'_>, before: &str| match index {
            Some(index) => write!(f, "{before} state {index}"),
            None => Ok(()),
        };
        match reason {
            Reason::Error => {
                write!(
                    f,
                    "at time {time:?} even a step of {step:?} has {scaled_error:.3e} times the admissible \
                     error"
                )?;
                state(f, " in")?;
                f.write_str(
                    ": loosen the tolerance or enlarge this state's error scale, or look for a jump in the \
                     problem",
                )
            }
            Reason::NotFinite => {
                write!(
                    f,
                    "at time {time:?} even a step of {step:?} leads to values that are not finite"
                )?;
                state(f, ", first in")?;
                f.write_str(
                    ": the problem may have no solution beyond, or a law is evaluated outside its domain",
                )
            }
            Reason::Singular { block } => write!(
                f,
                "at time {time:?} the matrix of a step of {step:?} is singular in block {block}: \
                 look for an infinite or missing partial derivative"
            ),
            Reason::NewtonFailure => write!(
                f,
                "at time {time:?} the equations of a step of {step:?} could not be solved: look for a jump \
                 in the problem, or choose another method"
            ),
            Reason::MaximumSteps { maximum } => {
                write!(
                    f,
                    "at time {time:?} the {maximum} admissible steps are used up (the last one was {step:?} \
                     long)"
                )?;
                state(f, ", the largest error being in")?;
                f.write_str(": allow more steps, loosen the tolerance, or regularize the problem")
            }
            Reason::StepUnderflow => write!(
                f,
                "at time {time:?} a step of {step:?} is lost against the time, which cannot tell its end \
                 from its start: look for what makes steps so short, or begin anew at an earlier time"
            ),
            Reason::Limit { limit } => write!(f, "a step from time {time:?} cannot end at {limit:?}"),
            Reason::TimeDiscontinuity { end } => {
                write!(
                    f,
                    "the problem's next time discontinuity after {time:?} is at {end:?}; it must be later"
                )
            }
        }
    }
}

impl std::error::Error for StepError {}
