//! Nonlinear stability of a car: over which speeds it hunts once it has been disturbed, and from which on it
//! begins to hunt by itself.
//!
//! Two runs on straight track that is perfect but for small dips:
//!
//! - **falling**: at the highest speed all wheelsets start to the left of the middle; after a hold the speed
//!   falls by a slow ramp. Where the motion dies, the limit cycle ends.
//! - **rising**: from the lowest speed on by the same ramp, over lateral dips of the rails of 0.02 in every
//!   200 ft that only a motion that grows turns into hunting. Where it begins, the equilibrium ends.
//!
//! Between the two speeds a car may run quietly or hunt, after what disturbed it. The amplitude is half of
//! greatest less least lateral displacement of a wheelset within a window of time; it counts as hunting from
//! a threshold on. A ramp that is too fast lets the motion die late and begin late: halve it to see by how
//! much.

use std::ops::ControlFlow;

use car::{Drive, Parameters, Start, Wheels};
use quantity::SixDigits;
use thiserror::Error;
use wheelrail::track::shape::Shape;
use wheelrail::track::{Direction, Irregularity, Placed, Rails};

use super::CarCase;
use super::run::CarResult;
use super::track::tangent;
use crate::outcome::Outcome;
use crate::run::{Run, RunError};
use crate::summary::RunSummary;

/// Time of a window in which an amplitude is taken, s: at least a period of hunting and of the body's sway.
pub(super) const WINDOW: f64 = 1.5;
/// Time at the first speed before the ramp, s: a limit cycle has settled, the start has died away.
const HOLD: f64 = 10.0;
/// Time between two rows, s.
const INTERVAL: f64 = 0.01;
/// Shift of wheelsets to the left at the start, if the case does not say, m: 0.4 in, near the flange; a
/// smaller one may miss the limit cycle.
pub(super) const SHIFT: f64 = 0.4 * 0.0254;
/// Gain of the drive of a car that coasts in its case, N·s/m.
pub(super) const GAIN: f64 = 1e5;
/// Depth and length of the rails' lateral dips, and from one to the next, m: 0.02 in, 30 ft, 200 ft.
const DIP: [f64; 3] = [0.02 * 0.0254, 30.0 * 0.3048, 200.0 * 0.3048];

/// The settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HuntingSettings {
    /// Lowest and highest speed, m/s.
    pub speeds: [f64; 2],
    /// Duration of each ramp, s.
    pub ramp: f64,
    /// Amplitude of a wheelset from which on a motion is hunting, m.
    pub threshold: f64,
}

/// Amplitudes in a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Time in its middle, s.
    pub time: f64,
    /// Mean speed, m/s.
    pub speed: f64,
    /// Lateral amplitude of each wheelset, front to rear, m.
    pub axles: [f64; 4],
    /// The larger amplitude of the lateral accelerations of the body at the truck centers, m/s².
    pub acceleration: f64,
}

impl Point {
    /// Returns the largest amplitude of the wheelsets, m.
    #[must_use]
    pub fn amplitude(&self) -> f64 {
        self.axles.into_iter().fold(0.0, f64::max)
    }
}

/// The speed at which hunting ends or begins among the speeds of a ramp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Boundary {
    /// At this speed, m/s.
    At(f64),
    /// It hunts at all of them.
    Everywhere,
    /// It hunts at none of them.
    Nowhere,
    /// A wheel leaves its rail at this speed, m/s.
    Derails(f64),
}

/// A ramp of the speed.
#[derive(Clone, Debug)]
pub struct Ramp {
    /// Amplitudes, in order of time.
    pub points: Vec<Point>,
    /// The speed at which hunting ends (falling) or begins (rising).
    pub boundary: Boundary,
    /// The outcome of its run.
    pub outcome: Outcome,
    /// Warnings about its numbers: what the run lacks to be complete, warnings of the run.
    pub warnings: Vec<String>,
}

/// The findings.
#[derive(Clone, Debug)]
pub struct Hunting {
    /// The settings asked for.
    pub settings: HuntingSettings,
    /// From the highest speed down.
    pub falling: Ramp,
    /// From the lowest speed up; none where the user stopped it before.
    pub rising: Option<Ramp>,
    /// True if all was computed.
    pub complete: bool,
}

/// Reasons why there is none.
#[derive(Debug, Error)]
pub enum HuntingError {
    /// Linear wheels have no limit cycle.
    #[error(
        "wheels.geometry is \"linear\": linear wheels have neither flanges nor saturation, and so no limit \
         cycle"
    )]
    LinearWheels,
    /// The settings make no ramp.
    #[error(
        "speeds from {low} to {high} m/s in {ramp} s with a threshold of {threshold} m make no ramp: all \
         must be positive, and speeds must rise"
    )]
    Settings {
        /// The lowest, m/s.
        low: f64,
        /// The highest, m/s.
        high: f64,
        /// Time of the ramp, s.
        ramp: f64,
        /// The threshold, m.
        threshold: f64,
    },
    /// A run cannot begin.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A run ended before its time.
    #[error("the run with {which} speed stopped at {} s: {reason}", SixDigits(*time))]
    Stopped {
        /// `falling` or `rising`.
        which: &'static str,
        /// The time, s.
        time: f64,
        /// The reason.
        reason: String,
    },
}

impl HuntingSettings {
    /// Checks that a case can be run so.
    ///
    /// # Errors
    /// The wheels are linear, or the settings make no ramp.
    pub fn check(&self, case: &CarCase) -> Result<(), HuntingError> {
        if matches!(case.parameters.wheels, Wheels::Linear { .. }) {
            return Err(HuntingError::LinearWheels);
        }
        let [low, high] = self.speeds;
        let positive = [low, high - low, self.ramp, self.threshold];
        match positive.iter().all(|own| *own > 0.0 && own.is_finite()) {
            true => Ok(()),
            false => Err(self.refused()),
        }
    }

    fn refused(&self) -> HuntingError {
        let [low, high] = self.speeds;
        HuntingError::Settings {
            low,
            high,
            ramp: self.ramp,
            threshold: self.threshold,
        }
    }
}

/// Returns over which speeds a car hunts. `go_on` receives the share that is done; where it breaks, with a
/// reason, what was computed comes back as incomplete.
///
/// # Errors
/// [`HuntingError`].
pub fn hunting(
    case: &CarCase,
    settings: HuntingSettings,
    mut go_on: impl FnMut(f64) -> ControlFlow<String>,
) -> Result<Hunting, HuntingError> {
    settings.check(case)?;
    let all = HOLD + settings.ramp;
    let (falling, whole) = one(case, &settings, true, |time| go_on(0.5 * time / all))?;
    let mut found = Hunting {
        settings,
        falling,
        rising: None,
        complete: false,
    };
    if whole {
        let (rising, whole) = one(case, &settings, false, |time| go_on(0.5 + 0.5 * time / all))?;
        (found.rising, found.complete) = (Some(rising), whole);
    }
    Ok(found)
}

/// Returns the falling ramp alone: the speed at which a limit cycle dies. `go_on` receives the time; where it
/// breaks, what was computed comes back.
///
/// # Errors
/// [`HuntingError`].
pub fn falling(
    case: &CarCase,
    settings: HuntingSettings,
    go_on: impl FnMut(f64) -> ControlFlow<String>,
) -> Result<Ramp, HuntingError> {
    settings.check(case)?;
    one(case, &settings, true, go_on).map(|own| own.0)
}

/// Runs one ramp. Returns it, and whether the run came to its end.
fn one(
    case: &CarCase,
    settings: &HuntingSettings,
    falls: bool,
    go_on: impl FnMut(f64) -> ControlFlow<String>,
) -> Result<(Ramp, bool), HuntingError> {
    let mut own = case.clone();
    own.simulation.duration = HOLD + settings.ramp;
    own.simulation.output_interval = INTERVAL;
    own.rules.filtered_columns = false;
    let parameters = parameters(&case.parameters, settings, falls);
    own.parameters = parameters.ok_or_else(|| settings.refused())?;
    let mut interrupted = false;
    let mut go_on = go_on;
    let result = Run::new(&own)?.finish_while(|time| {
        let next = go_on(time);
        interrupted |= next.is_break();
        next
    });
    let outcome = result.summary.outcome();
    if let Outcome::Stopped(end) = &outcome
        && !interrupted
    {
        return Err(HuntingError::Stopped {
            which: if falls { "falling" } else { "rising" },
            time: end.time,
            reason: end.reason.clone(),
        });
    }
    let points = points(&result);
    let boundary = match outcome {
        Outcome::Derailed(_) => {
            let last = result.column("speed").and_then(|values| values.last());
            Boundary::Derails(last.copied().unwrap_or_default())
        }
        _ => boundary(&points, settings.threshold, falls),
    };
    let ramp = Ramp {
        points,
        boundary,
        warnings: outcome
            .told()
            .into_iter()
            .chain(result.summary.warnings)
            .collect(),
        outcome,
    };
    Ok((ramp, !interrupted))
}

/// Returns the same car on a track for a ramp.
fn parameters(own: &Parameters, settings: &HuntingSettings, falls: bool) -> Option<Parameters> {
    let mut own = own.clone();
    let [low, high] = settings.speeds;
    let [from, to] = if falls { [high, low] } else { [low, high] };
    let reach = own.reach();
    let way = HOLD * from + 0.5 * settings.ramp * (low + high);
    // It may lag a little.
    let length = 2.0 * reach + 1.05 * way + 20.0;
    own.track = tangent(length)?;
    let shifts = own.start.wheelset_shifts;
    let shifted = shifts.iter().any(|shift| *shift != 0.0);
    own.start = Start {
        kind: own.start.kind,
        ..Start::at(reach + 1.0, from)
    };
    if falls {
        own.start.wheelset_shifts = if shifted { shifts } else { [SHIFT; 4] };
    } else {
        let [depth, dip, spacing] = DIP;
        let count = (length / spacing).ceil() as usize;
        let dips = (0..count).map(|number| Placed {
            rails: Rails::Both,
            direction: Direction::Lateral,
            irregularity: Irregularity::Shape(Shape::Dip {
                depth,
                length: dip,
                start: 2.0 * reach + number as f64 * spacing,
            }),
        });
        own.track.irregularities = dips.collect();
    }
    let gain = own.drive.gain().unwrap_or(GAIN);
    own.drive = Drive::History {
        gain,
        speeds: vec![[HOLD, from], [HOLD + settings.ramp, to]],
    };
    Some(own)
}

/// Returns the amplitudes in the windows that are whole and end after the hold.
fn points(result: &CarResult) -> Vec<Point> {
    let column = |name: &str| result.column(name).unwrap_or_default();
    let (times, speeds) = (column("time"), column("speed"));
    let axles = [1, 2, 3, 4].map(|axle| column(&format!("axle_{axle}_lateral")));
    let ends = [1, 2].map(|truck| column(&format!("body_at_truck_{truck}_lateral_acceleration")));
    let count = (WINDOW / INTERVAL).round() as usize;
    let first = ((HOLD - WINDOW) / INTERVAL).round() as usize;
    let windows = (first..)
        .step_by(count)
        .take_while(|from| from + count < times.len());
    let swing = |values: &[f64]| {
        let (least, most) = values
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), own| {
                (least.min(*own), most.max(*own))
            });
        0.5 * (most - least)
    };
    windows
        .map(|from| {
            let rows = from..=from + count;
            Point {
                time: times[from + count / 2],
                speed: speeds[rows.clone()].iter().sum::<f64>() / (count + 1) as f64,
                axles: axles.map(|values| swing(&values[rows.clone()])),
                acceleration: ends
                    .map(|values| swing(&values[rows.clone()]))
                    .into_iter()
                    .fold(0.0, f64::max),
            }
        })
        .collect()
}

/// Returns the speed at which hunting ends (falling: the last window above the threshold) or begins (rising:
/// the first one).
fn boundary(points: &[Point], threshold: f64, falls: bool) -> Boundary {
    let hunts = |point: &Point| point.amplitude() >= threshold;
    let (edge, other) = if falls {
        (points.iter().rposition(hunts), points.len().saturating_sub(1))
    } else {
        (points.iter().position(hunts), 0)
    };
    match edge {
        None => Boundary::Nowhere,
        Some(edge) if edge == other => Boundary::Everywhere,
        Some(edge) => {
            // Halfway to the neighbor below the threshold.
            let next = if falls { edge + 1 } else { edge - 1 };
            Boundary::At(0.5 * (points[edge].speed + points[next].speed))
        }
    }
}
