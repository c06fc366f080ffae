//! Linear stability of a car about steady running: the motions that grow, over speed, and the critical speed,
//! with friction that sticks and without friction.
//!
//! The car runs on straight track without irregularities, whatever its case's track is; the springs under its
//! rails are the case's. What is linearized, and how, says [`car::Parameters::modes`].

use std::ops::ControlFlow;

pub use car::{CriticalSpeed, FrictionState, LinearizeError, Mode};
use car::{Parameters, Start};

use super::CarCase;
use super::track::tangent;

/// Vibrations slower than this are drifts, Hz.
const SLOWEST: f64 = 0.05;
/// Vibrations faster than this are those of contacts, Hz.
const FASTEST: f64 = 30.0;
/// Growth below this is none, 1/s: that of undamped vibrations in rounding.
const NONE: f64 = 1e-5;

/// The motions about steady running with one state of friction.
#[derive(Clone, Debug)]
pub struct Branch {
    /// The state of friction.
    pub friction: FrictionState,
    /// Vibrations at each speed, by falling growth.
    pub modes: Vec<Vec<Mode>>,
    /// The lowest of the speeds from which on a vibration grows, refined; none if none grows.
    pub critical: Option<CriticalSpeed>,
}

/// Returns what of a case's track does not count for its stability; none of straight track without
/// irregularities.
#[must_use]
pub fn left_out(case: &CarCase) -> Option<&'static str> {
    let track = &case.parameters.track;
    // Shorter than any curve or spiral.
    const STEP: f64 = 1.0;
    let steps = (track.center_line.length() / STEP) as usize;
    let curved = (0..=steps).any(|step| track.center_line.at(step as f64 * STEP).curvature[0] != 0.0);
    match (curved, track.irregularities.is_empty()) {
        (true, false) => Some("the curves and irregularities of its track do not count"),
        (true, true) => Some("the curves of its track do not count"),
        (false, false) => Some("the irregularities of its track do not count"),
        (false, true) => None,
    }
}

/// The findings.
#[derive(Clone, Debug)]
pub struct Stability {
    /// The speeds, m/s.
    pub speeds: Vec<f64>,
    /// Friction that sticks, then none; fewer where the user stopped it.
    pub branches: Vec<Branch>,
    /// True if all was computed.
    pub complete: bool,
}

/// The two states of friction, with their names.
pub const FRICTION: [(FrictionState, &str); 2] =
    [(FrictionState::Stuck, "stuck"), (FrictionState::Absent, "absent")];

/// Returns the vibrations at these speeds (m/s, rising), and the critical speeds. `go_on` receives the share
/// that is done.
///
/// # Errors
/// The car cannot be linearized at a speed.
pub fn stability(
    case: &CarCase,
    speeds: &[f64],
    mut go_on: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Stability, LinearizeError> {
    let mut found = Stability {
        speeds: speeds.to_vec(),
        branches: Vec::new(),
        complete: false,
    };
    // A refinement takes some more.
    let all = (2 * (speeds.len() + 4)) as f64;
    let mut done = 0.0;
    let fastest = speeds.iter().fold(0.0_f64, |most, own| most.max(*own));
    let Some(straight) = straight(&case.parameters, fastest) else {
        return Ok(found);
    };
    for (friction, _) in FRICTION {
        let mut branch = Branch {
            friction,
            modes: Vec::new(),
            critical: None,
        };
        for speed in speeds {
            let modes = straight.modes(*speed, friction)?;
            branch.modes.push(vibrations(modes));
            done += 1.0;
            if go_on(done / all).is_break() {
                found.branches.push(branch);
                return Ok(found);
            }
        }
        branch.critical = critical(&straight, speeds, &branch)?;
        done += 4.0;
        found.branches.push(branch);
        if go_on(done / all).is_break() {
            return Ok(found);
        }
    }
    found.complete = true;
    Ok(found)
}

/// Returns the same car on straight track, long enough for a second at a speed (m/s).
fn straight(parameters: &Parameters, fastest: f64) -> Option<Parameters> {
    let mut own = parameters.clone();
    let reach = own.reach();
    own.track = tangent(2.0 * reach + 3.0 * fastest + 10.0)?;
    own.start = Start {
        heading: 0.0,
        kind: own.start.kind,
        ..Start::at(reach + 1.0, fastest)
    };
    Some(own)
}

fn vibrations(modes: Vec<Mode>) -> Vec<Mode> {
    let mut own: Vec<Mode> = modes
        .into_iter()
        .filter(|mode| (SLOWEST..=FASTEST).contains(&mode.frequency))
        .collect();
    own.sort_by(|a, b| b.growth.total_cmp(&a.growth));
    own
}

/// Returns the first speed from which on a vibration grows.
fn critical(
    car: &Parameters,
    speeds: &[f64],
    branch: &Branch,
) -> Result<Option<CriticalSpeed>, LinearizeError> {
    let grows = |modes: &Vec<Mode>| modes.first().is_some_and(|mode| mode.growth > NONE);
    let Some(first) = branch.modes.iter().position(grows) else {
        return Ok(None);
    };
    let Some(before) = first.checked_sub(1) else {
        let mode = branch.modes[first].first();
        return Ok(mode.map(|mode| CriticalSpeed {
            speed: speeds[first],
            frequency: mode.frequency,
        }));
    };
    let [low, high] = [speeds[before], speeds[first]];
    car.critical_speed([low, high], high - low, branch.friction)
}
