//! The rule for runs that hardly progress, and its messages: one for runs of wedges, trucks, cars,
//! half-trucks and wheelsets, studies, driven wedges and FMUs.
//!
//! **To come forward by [`ADVANCE`], a run may take [`SURE_ATTEMPTS`] attempted steps (accepted and
//! rejected), and [`ATTEMPTS_A_SECOND`] more for each second of that way. Where [`INTERVALS`] output
//! intervals or one communication step are shorter, they are the way.** A run that takes more is stopped;
//! what was computed is kept. What rattles takes some five thousand steps a second, jammed wedges that
//! flutter a hundred thousand within some milliseconds, and then go on.
//!
//! A step that would have to be shorter than the resolution of time stops a run, too; that rule is the
//! integrator's ([`integrate::StepError`]).

use integrate::{Integrator, Problem, StepError};
use mechanics::body::COORDINATES;
use mechanics::system::{EnergyTermKind, System};
use quantity::{Number, SixDigits};
use serde::{Deserialize, Serialize};

/// The way, s,
pub const ADVANCE: f64 = 0.1;
/// or so many output intervals, or one communication step.
pub const INTERVALS: f64 = 10.0;
/// Attempted steps that are admissible for any way, however short: some tenths of a second of computing.
pub const SURE_ATTEMPTS: u64 = 100_000;
/// And for each second of it: with the sure ones 150,000 in 0.1 s, of which a wedge takes about one second
/// (5.5 to 7.5 µs each). So two seconds of a wedge end, or stop, in some 20 s.
pub const ATTEMPTS_A_SECOND: f64 = 5e5;

/// Returns the number of attempted steps that a run may take for a way of `advance` (s).
#[must_use]
pub fn most_attempts(advance: f64) -> u64 {
    SURE_ATTEMPTS.saturating_add((ATTEMPTS_A_SECOND * advance) as u64)
}

/// The progress of a run since the last check.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pace {
    /// Attempted steps until then.
    pub attempts: u64,
    /// The time then, s.
    pub time: f64,
}

impl Pace {
    /// Begins to count where an integrator is.
    #[must_use]
    pub fn of<P: Problem>(integrator: &Integrator<P>) -> Self {
        Self {
            attempts: attempts(integrator),
            time: integrator.time(),
        }
    }

    /// Looks at the run after a step; `short` (s) is the way where it is shorter than [`ADVANCE`]: ten output
    /// intervals, or the communication step.
    ///
    /// # Errors
    /// The run hardly progresses.
    pub fn check<P: Problem>(&mut self, integrator: &Integrator<P>, short: f64) -> Result<(), Stalled> {
        let (attempts, required) = (attempts(integrator), ADVANCE.min(short));
        let advance = integrator.time() - self.time;
        if advance >= required {
            *self = Self::of(integrator);
        } else if attempts.saturating_sub(self.attempts) > most_attempts(required) {
            return Err(Stalled {
                time: integrator.time(),
                attempts: attempts - self.attempts,
                advance,
                required,
                state: integrator.worst_state(),
            });
        }
        Ok(())
    }
}

fn attempts<P: Problem>(integrator: &Integrator<P>) -> u64 {
    let statistics = integrator.statistics();
    statistics.steps + statistics.rejected()
}

/// A run hardly progresses.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "the run hardly progresses at {} s: {attempts} attempted steps brought it forward by {advance:.1e} s, \
     and {} are admissible for {} s",
    SixDigits(*time),
    most_attempts(*required),
    Number(*required)
)]
pub struct Stalled {
    /// The time reached, s.
    pub time: f64,
    /// Attempted steps since the last check.
    pub attempts: u64,
    /// The time that they reached, s.
    pub advance: f64,
    /// The time that they must reach, s.
    pub required: f64,
    /// The state with the largest error.
    pub state: Option<usize>,
}

/// Advice where a run of a wedge cannot go on.
pub const WHAT_TO_TRY: &str = "try a softer contact.stiffness, a larger friction.reference_speed, or another \
     simulation.relative_tolerance, and look for values out of all proportion";

/// Advice where a run of a half-truck cannot go on.
pub const WHAT_TO_TRY_WITH_FILES: &str = "look at this body or connection with `wedgelab nucars show`: a \
                                          stiffness or a damping out of all proportion, or a mass that is \
                                          too small, makes steps so short";

/// Returns the integrator's message about a step that it cannot make, after the state in words; `name` names
/// a state.
#[must_use]
pub fn describe(error: &StepError, name: impl Fn(usize) -> String) -> String {
    match error.index {
        Some(state) => format!("{} (state {state}) cannot be computed: {error}", name(state)),
        None => error.to_string(),
    }
}

impl Stalled {
    /// Returns the message with the state in words; `name` names a state.
    #[must_use]
    pub fn describe(&self, name: impl Fn(usize) -> String) -> String {
        match self.state {
            Some(state) => format!("{self}; the largest error is that of {}", name(state)),
            None => self.to_string(),
        }
    }
}

/// Returns the name of a state of a system, in words; `numbers` are those that the user's files give to
/// bodies and connections, empty without such files.
#[must_use]
pub fn state_name(system: &System, numbers: [&[u32]; 2], index: usize) -> String {
    let layout = system.layout();
    let [bodies, connections] = numbers;
    let named = |what: &str, number: Option<&u32>, name: &str| match number {
        Some(number) => format!("{what} {number} ({name})"),
        None => format!("the {}", name.replace('_', " ")),
    };
    if index < 2 * layout.speeds {
        let count = system.bodies().len();
        let found = motion(count, layout.speeds, index, |body, k| system.position_of(body, k));
        return match found {
            Some((what, body)) => {
                let body = named("body", bodies.get(body), &system.bodies()[body].name);
                format!("{what} of {body}")
            }
            None => format!("state {index}"),
        };
    }
    let internal = index - 2 * layout.speeds;
    for face in system.faces() {
        let own = face.first_internal..face.first_internal + face.internal_count;
        if own.contains(&internal) {
            let point = (internal - face.first_internal) / face.element.law.states_per_point().max(1);
            return format!("the bristles at point {} of the {}", point + 1, face.element.name);
        }
    }
    for (place, connection) in system.connections().iter().enumerate() {
        let first = system.deflection_of(place);
        if first.is_some_and(|first| (first..first + 2).contains(&index)) {
            let connection = named("connection", connections.get(place), &connection.name);
            return format!("the force accumulators of {connection}");
        }
    }
    match system
        .energy_terms()
        .get(internal.saturating_sub(layout.internals))
    {
        Some(energy_term) if energy_term.kind == EnergyTermKind::MotionWork => {
            "the work of the motions".to_owned()
        }
        Some(energy_term) if energy_term.element.is_empty() => format!("`{}`", energy_term.kind.name()),
        Some(energy_term) => format!("the loss at the {}", energy_term.element),
        None => format!("state {index}"),
    }
}

/// Returns which position or speed a state is, in words, and the number of its body.
fn motion(
    bodies: usize,
    speeds: usize,
    index: usize,
    position_of: impl Fn(usize, usize) -> Option<usize>,
) -> Option<(String, usize)> {
    let (place, what) = if index < speeds {
        (index, "position")
    } else {
        (index - speeds, "speed")
    };
    let found = (0..bodies).find_map(|body| {
        let coordinate = (0..6).find(|k| position_of(body, *k) == Some(place))?;
        Some((coordinate, body))
    });
    found.map(|(coordinate, body)| (format!("the {what} in {}", COORDINATES[coordinate]), body))
}

#[cfg(test)]
mod tests {
    use integrate::{Reason, StepError};

    use super::describe;

    #[test]
    fn issue_048_the_state_that_cannot_be_computed_comes_first() {
        let error = StepError {
            time: 0.1,
            step: 2e-15,
            reason: Reason::Error,
            index: Some(117),
            scaled_error: 1.129,
        };
        let words = describe(&error, |_| "the speed in z of the wedge".to_owned());
        let start =
            "the speed in z of the wedge (state 117) cannot be computed: at time 0.1 even a step of 2e-15";
        assert!(words.starts_with(start), "{words}");
    }
}
