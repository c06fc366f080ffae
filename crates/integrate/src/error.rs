//! What can go wrong.

use crate::state::{MOST_COUNTED, STATE_VERSION};

/// An integration cannot begin.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SetupError {
    /// A setting is not admissible.
    #[error("`{name}` is {value}; it must {must}")]
    Option {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        must: &'static str,
    },
    /// Lengths do not fit.
    #[error("the problem has {expected} {what}, but {found} were given")]
    Dimension {
        /// What is counted.
        what: &'static str,
        /// The number of the problem.
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
    /// The start of a state is not finite.
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
    /// The problem names an end of a segment that does not lie behind its start.
    #[error("the problem's segment that starts at {start} ends at {end}; it must end later")]
    Segment {
        /// Start of the segment.
        start: f64,
        /// Its end.
        end: f64,
    },
    /// A saved state comes from another version of this library.
    #[error("the saved state has version {found}; this program reads version {expected}", expected = STATE_VERSION)]
    Version {
        /// Version of the saved state.
        found: u32,
    },
    /// A saved state has a member that cannot be.
    #[error(
        "the saved state is damaged: `{name}` is {value}; continue from the state as it was saved, or begin anew"
    )]
    Damaged {
        /// The member.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A counter of a saved state is beyond what any run can reach.
    #[error(
        "the saved state is damaged: the counter `{name}` is {found}, and no run counts beyond {most}; \
         continue from the state as it was saved, or begin anew",
        most = MOST_COUNTED
    )]
    Counter {
        /// The counter.
        name: &'static str,
        /// Its value.
        found: u64,
    },
}

/// Why a step was not accepted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// The local error was too large.
    Error,
    /// A value was not finite.
    NotFinite,
    /// The matrix was singular.
    Singular {
        /// Its diagonal block.
        block: usize,
    },
    /// Newton's method did not find a stage.
    Unsolved,
    /// The largest number of steps was exceeded.
    MaximumSteps {
        /// This number.
        maximum: u64,
    },
    /// The step to be tried is so short that the time stays what it is.
    Lost,
    /// The limit does not lie ahead.
    Limit {
        /// The limit.
        limit: f64,
    },
    /// The problem named an end of a segment that does not lie behind its start.
    Segment {
        /// This end.
        end: f64,
    },
}

/// A step could not be made. The integrator still holds the last accepted step.
#[derive(Clone, Debug, PartialEq)]
pub struct StepError {
    /// Time at the start of the step.
    pub time: f64,
    /// Length of the last attempt.
    pub step: f64,
    /// Why it was not accepted.
    pub reason: Reason,
    /// The state with the largest error, or the first one that is not finite.
    pub index: Option<usize>,
    /// Its error in units of the tolerance, in the last attempt rejected because of its error; NaN if not finite.
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
                    "at time {time:?} even a step of {step:?} has {scaled_error:.3e} times the admissible error"
                )?;
                state(f, " in")?;
                f.write_str(
                    ": loosen the tolerance or enlarge this state's error scale, or look for a jump in the problem",
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
            Reason::Unsolved => write!(
                f,
                "at time {time:?} the equations of a step of {step:?} could not be solved: look for a jump in the problem, \
                 or choose another method"
            ),
            Reason::MaximumSteps { maximum } => {
                write!(
                    f,
                    "at time {time:?} the {maximum} admissible steps are used up (the last one was {step:?} long)"
                )?;
                state(f, ", the largest error being in")?;
                f.write_str(": allow more steps, loosen the tolerance, or regularize the problem")
            }
            Reason::Lost => write!(
                f,
                "at time {time:?} a step of {step:?} is lost against the time, which cannot tell its end from its start: \
                 look for what makes steps so short, or begin anew at an earlier time"
            ),
            Reason::Limit { limit } => write!(f, "a step from time {time:?} cannot end at {limit:?}"),
            Reason::Segment { end } => {
                write!(
                    f,
                    "the problem's segment that starts at {time:?} ends at {end:?}; it must end later"
                )
            }
        }
    }
}

impl std::error::Error for StepError {}
