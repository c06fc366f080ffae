//! Stability of a car by linearization about steady running: the motions that grow, over speed, with friction
//! stuck and absent, and the critical speed over the amplitude between these ends by equivalent
//! linearization.
//!
//! The car runs on straight track without irregularities, whatever its case's track is; the springs under its
//! rails are the case's. What is linearized, and how, say [`car::SteadyCar`] and [`car::OverAmplitude`]. With
//! `[stability] warp_moment` the car is taken as the linear benchmark of textbooks too
//! ([`car::Parameters::tied`]), and with `body = "held"` each truck alone ([`car::SteadyCar::hold_body`]).

use std::ops::ControlFlow;

use car::{
    CriticalSpeed, FrictionState, Neutral, NoWarp, OverAmplitude, Parameters, Start, StartKind, SteadyCar,
    Wheels, growing, name_of, vibrations,
};
use mechanics::linear::{LinearMode, LinearModel};
use quantity::{Kind, System as Units};
use thiserror::Error;

use super::CarCase;
use super::track::tangent;

pub use car::LinearizeError;

/// Amplitudes of the curve, each this part of the one before it, down from that at which the flanges bear.
const AMPLITUDES: usize = 12;
const FALL: f64 = 0.8;

/// Reasons why there is none.
#[derive(Debug, Error)]
pub enum StabilityError {
    /// It cannot be linearized.
    #[error(transparent)]
    Linearize(#[from] LinearizeError),
    /// The benchmark's warp stiffness cannot be had.
    #[error(transparent)]
    Warp(#[from] NoWarp),
}

/// What friction does in a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BranchKind {
    /// It sticks: bristles are springs.
    Stuck,
    /// There is none.
    Absent,
    /// As in the linear benchmark: adapters and plates tied, plates free in yaw, wedges a warp spring.
    Tied,
}

impl BranchKind {
    /// Returns its name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Stuck => "stuck",
            Self::Absent => "absent",
            Self::Tied => "tied",
        }
    }

    /// Returns it in a sentence.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Stuck => "friction stuck",
            Self::Absent => "friction absent",
            Self::Tied => "linear benchmark",
        }
    }
}

/// A vibration.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMode {
    /// Growth, 1/s: negative where it dies away.
    pub growth: f64,
    /// Frequency, Hz.
    pub frequency: f64,
    /// The bodies that move, and how.
    pub name: String,
}

/// The motions about steady running in a branch.
#[derive(Clone, Debug)]
pub struct Branch {
    /// What friction does.
    pub kind: BranchKind,
    /// Vibrations at each speed, by falling growth.
    pub modes: Vec<Vec<NamedMode>>,
    /// The lowest of the speeds from which on a vibration grows, refined; none if none grows.
    pub critical: Option<Critical>,
}

/// A motion that neither grows nor dies at a speed, beyond which it grows.
#[derive(Clone, Debug, PartialEq)]
pub struct Critical {
    /// The speed, m/s.
    pub speed: f64,
    /// Frequency, Hz.
    pub frequency: f64,
    /// The bodies that move, and how.
    pub name: String,
    /// True if it grows at the lowest speed that was asked for already: the critical speed is not above.
    pub at_lowest: bool,
    /// Its shape in the order of the positions of the car's state, real and imaginary parts, for pictures of
    /// it: that of an amplitude has 1 for the wheelset that moves most, that of a branch has any size.
    pub shape: Vec<[f64; 2]>,
}

/// The critical speed of an amplitude.
#[derive(Clone, Debug)]
pub struct AtAmplitude {
    /// Lateral amplitude of the wheelset that moves most, m.
    pub amplitude: f64,
    /// The critical speed; none if motions of this amplitude die at all speeds that were looked at.
    pub critical: Option<Critical>,
    /// True if no motion was found though there may be one: the iteration does not converge.
    pub unsolved: bool,
}

/// The findings.
#[derive(Clone, Debug)]
pub struct Stability {
    /// The speeds, m/s.
    pub speeds: Vec<f64>,
    /// Friction that sticks, then none, then the linear benchmark if it is asked for; fewer where the user
    /// stopped it.
    pub branches: Vec<Branch>,
    /// The critical speed over the amplitude, which falls.
    pub curve: Vec<AtAmplitude>,
    /// The largest amplitude of the curve, m: beyond it flanges bear, if wheels have them.
    pub clearance: f64,
    /// Whether wheels have flanges: linear ones have none.
    pub has_flanges: bool,
    /// The car in steady running, for pictures of its motions.
    pub steady: SteadyCar,
    /// Whether its body is held, so that each truck runs alone.
    pub body_held: bool,
    /// True if all was computed.
    pub complete: bool,
}

/// The speed up to which the curve is looked for, over the fastest that is asked for.
pub const BEYOND: f64 = 1.5;

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

/// Returns the vibrations at these speeds (m/s, rising), the critical speeds of all branches, and the curve
/// over the amplitude. `go_on` receives the share that is done.
///
/// # Errors
/// [`StabilityError`].
pub fn stability(
    case: &CarCase,
    speeds: &[f64],
    mut go_on: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Stability, StabilityError> {
    let straight = straight(&case.parameters);
    let tied = match case.stability.benchmark_warp {
        Some(warp) => {
            let mut own = straight.tied(warp)?;
            // Without friction nothing is locked in.
            own.start.kind = StartKind::Equilibrium;
            Some(steady(case, &own)?)
        }
        None => None,
    };
    let mut car = OverAmplitude::of(steady(case, &straight)?, &straight)?;
    let mut found = Stability {
        speeds: speeds.to_vec(),
        branches: Vec::new(),
        curve: Vec::new(),
        clearance: 0.0,
        has_flanges: matches!(case.parameters.wheels, Wheels::OnRails(_)),
        steady: car.steady().clone(),
        body_held: case.stability.body_held,
        complete: false,
    };
    let kinds = [
        (BranchKind::Stuck, FrictionState::Stuck, found.steady.clone()),
        (BranchKind::Absent, FrictionState::Absent, found.steady.clone()),
    ];
    let kinds = kinds
        .into_iter()
        .chain(tied.map(|own| (BranchKind::Tied, FrictionState::Stuck, own)));
    let mut done = 0.0;
    for (kind, friction, mut own) in kinds {
        let (branch, whole) = branch(&mut own, kind, friction, speeds, |share| {
            go_on(done + 0.1 * share)
        })?;
        done += 0.1;
        found.branches.push(branch);
        if !whole {
            return Ok(found);
        }
    }
    let clearance = car.clearance();
    let amplitudes: Vec<f64> = (0..AMPLITUDES)
        .map(|k| clearance * libm::pow(FALL, k as f64))
        .collect();
    let fastest = speeds.iter().fold(0.0_f64, |most, own| most.max(*own));
    let motions = car.neutral_motions(&amplitudes, fastest, |share| go_on(done + (1.0 - done) * share))?;
    for (amplitude, motion) in amplitudes.iter().zip(motions) {
        let unsolved = matches!(motion, Neutral::Unsolved);
        let critical = match motion {
            Neutral::At(own) => Some(Critical::of(&mut found.steady, &own, false)?),
            Neutral::Above | Neutral::Unsolved => None,
        };
        found.curve.push(AtAmplitude {
            amplitude: *amplitude,
            critical,
            unsolved,
        });
    }
    // Where a smaller amplitude grows, one that does not has more likely been lost than found above.
    let mut grows = false;
    for own in found.curve.iter_mut().rev() {
        grows |= own.critical.is_some();
        own.unsolved |= grows && own.critical.is_none();
    }
    found.clearance = clearance;
    found.complete = found.curve.len() == AMPLITUDES;
    Ok(found)
}

/// Returns a car of these parameters in steady running, its body held if the case says so.
pub(crate) fn steady(case: &CarCase, parameters: &Parameters) -> Result<SteadyCar, LinearizeError> {
    let mut own = SteadyCar::new(parameters)?;
    if case.stability.body_held {
        own.hold_body();
    }
    Ok(own)
}

/// Returns a branch, and whether it is whole.
fn branch(
    car: &mut SteadyCar,
    kind: BranchKind,
    friction: FrictionState,
    speeds: &[f64],
    mut go_on: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<(Branch, bool), LinearizeError> {
    let mut branch = Branch {
        kind,
        modes: Vec::new(),
        critical: None,
    };
    let mut first = None;
    for (number, speed) in speeds.iter().enumerate() {
        let model = car.model(*speed)?;
        let modes = vibrations(&model, friction.of(&model))?;
        if let (None, Some(mode)) = (&first, growing(&modes)) {
            first = Some((number, mode.clone()));
        }
        branch.modes.push(named(car, &model, &modes));
        if go_on((number + 1) as f64 / speeds.len() as f64).is_break() {
            return Ok((branch, false));
        }
    }
    let Some((number, mode)) = first else {
        return Ok((branch, true));
    };
    let before = number.checked_sub(1).map(|before| speeds[before]);
    let found = match before {
        None => Some(CriticalSpeed {
            speed: speeds[number],
            frequency: mode.frequency(),
            shape: mode.shape,
        }),
        Some(before) => car.critical_speed([before, speeds[number]], friction)?,
    };
    if let Some(own) = found {
        branch.critical = Some(Critical::of(car, &own, before.is_none())?);
    }
    Ok((branch, true))
}

/// Returns vibrations of a model with their names.
pub(crate) fn named(car: &SteadyCar, model: &LinearModel, modes: &[LinearMode]) -> Vec<NamedMode> {
    let own = modes.iter().map(|mode| NamedMode {
        growth: mode.growth(),
        frequency: mode.frequency(),
        name: name_of(car.car(), model, &mode.shape),
    });
    own.collect()
}

impl Critical {
    /// Returns a motion with its name.
    fn of(car: &mut SteadyCar, own: &CriticalSpeed, at_lowest: bool) -> Result<Self, LinearizeError> {
        let model = car.model(own.speed)?;
        Ok(Self {
            speed: own.speed,
            frequency: own.frequency,
            name: name_of(car.car(), &model, &own.shape),
            at_lowest,
            shape: own.shape.iter().map(|part| [part.re, part.im]).collect(),
        })
    }
}

/// Returns the same car on straight track, long enough to settle on.
pub(crate) fn straight(parameters: &Parameters) -> Parameters {
    /// Longer than a second at the speed of settling, m.
    const WAY: f64 = 100.0;
    let mut own = parameters.clone();
    let reach = own.reach();
    if let Some(track) = tangent(2.0 * reach + WAY) {
        own.track = track;
    }
    own.start = Start {
        heading: 0.0,
        // The nominal layout is no steady running.
        kind: match own.start.kind {
            StartKind::Nominal => StartKind::Equilibrium,
            kind => kind,
        },
        ..Start::at(reach + 1.0, 1.0)
    };
    own
}

impl Stability {
    /// Returns the slowest critical speed of the curve, with its amplitude (m).
    #[must_use]
    pub fn slowest(&self) -> Option<(f64, &Critical)> {
        let own = self
            .curve
            .iter()
            .filter_map(|own| Some((own.amplitude, own.critical.as_ref()?)));
        own.min_by(|a, b| a.1.speed.total_cmp(&b.1.speed))
    }

    /// Returns the smallest amplitude (m) that grows at no more than the fastest speed that was asked for,
    /// with its critical speed.
    #[must_use]
    pub fn smallest(&self) -> Option<(f64, &Critical)> {
        let fastest = self.speeds.iter().fold(0.0_f64, |most, own| most.max(*own));
        let own = self
            .curve
            .iter()
            .filter_map(|own| Some((own.amplitude, own.critical.as_ref()?)));
        own.filter(|(_, critical)| critical.speed <= fastest)
            .min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Returns what has been found in a sentence.
    #[must_use]
    pub fn verdict(&self, units: Units) -> String {
        let own = self.found(units);
        match self.body_held {
            true => format!("Each truck alone, the car's body being held. {own}"),
            false => own,
        }
    }

    fn found(&self, units: Units) -> String {
        let speed = |si: f64| {
            let unit = Kind::TravelSpeed.label(units);
            format!("{:.0} {unit}", si * Kind::TravelSpeed.from_si(units))
        };
        let length = |si: f64| {
            let own = si * Kind::Length.from_si(units);
            let places = if own < 1.0 { 2 } else { 1 };
            format!("{own:.places$} {}", Kind::Length.label(units))
        };
        let fastest = self.speeds.iter().fold(0.0_f64, |most, own| most.max(*own));
        let stuck = self.branches.iter().find(|own| own.kind == BranchKind::Stuck);
        if let Some(own) = stuck.and_then(|own| own.critical.as_ref()) {
            let from = if own.at_lowest { "already at" } else { "from" };
            return format!(
                "Even the smallest motions grow, {from} {} on: {} at {:.2} Hz.",
                speed(own.speed),
                own.name,
                own.frequency
            );
        }
        let (off, flanges) = match (self.has_flanges, self.body_held) {
            (true, false) => (
                "off the flanges nothing",
                " On the flanges it may hunt at lower speeds: --nonlinear tells.",
            ),
            (true, true) => ("off the flanges nothing", ""),
            (false, _) => ("nothing", ""),
        };
        let (Some((amplitude, slowest)), smallest) = (self.slowest(), self.smallest()) else {
            let up_to = length(self.clearance);
            return format!(
                "Nothing of up to {up_to} grows up to {}.{flanges}",
                speed(BEYOND * fastest)
            );
        };
        let what = format!("{} at {:.2} Hz", slowest.name, slowest.frequency);
        let [largest, least] = [length(amplitude), speed(slowest.speed)];
        match smallest {
            None => format!(
                "Up to {}, {off} of up to {} grows; above {least} a motion of {largest} does: \
                 {what}.{flanges}",
                speed(fastest),
                length(self.clearance)
            ),
            Some((smallest, above)) => {
                let also = match smallest == amplitude {
                    true => String::new(),
                    false => format!(", from {largest} on above {least}"),
                };
                format!(
                    "From {} on it hunts above {}{also}: {what}; {off} grows below {least}.{flanges}",
                    length(smallest),
                    speed(above.speed)
                )
            }
        }
    }
}
