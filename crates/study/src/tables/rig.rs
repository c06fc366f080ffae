//! The rigs of a table: one nest's vertical motion, and warp.
//!
//! Both are those of the truck model (`truck_crowned_warp_nest_...`) with the parts of the case in them:
//! geometry, wedges, coils, gibs, lands, empirical warp springs. Side frames are held, the bolster is moved.
//! The bolster's height h is where the coils of a nest alone carry the load P, without friction:
//!
//! ```text
//! ½ Σ F_load(h) + ½ Σ F_control(h + r) = P    (control coils with variable damping alone, r the rise)
//! ```
//!
//! - **Nest**: the stroke s (positive where the bolster sinks from h) goes as `-A cos ωt` for one and a half
//!   cycles; the force is the mean of both nests' loads on the side frames. Unloading is the second half
//!   cycle, loading the third.
//! - **Warp**: the bolster rises to h from 0.2 in below, as in the warp tests of `wedgelab warp`, then both
//!   side frames yaw as `A sin ωt` for one and a quarter cycles; the moment is half of that on the bolster:
//!   one nest's.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use mechanics::elements::{ShearSpring, TableSpring};
use mechanics::motion::{Motion, Piece, RampProfile};
use quantity::Kind;
use serde::{Deserialize, Serialize};
use truck::{ControlCoil, Parameters, WedgeKind};
use wedge::parameters::{Damping, Start, Wear};

use super::TablesError;
use super::grid::Point;
use crate::case::CaseError;
use crate::outcome::Outcome;
use crate::run::Run;
use crate::summary::RunSummary;
use crate::truck::TruckCase;
use crate::truck::builtin::case_with;
use crate::truck::run::TruckResult;

/// Rows of a cycle: every quarter begins with one.
const ROWS: usize = 200;
/// Height from which the bolster rises before warp, m: 0.2 in.
const APPROACH: f64 = 0.2 * 0.0254;
/// When it has risen, s: not before this does warp begin.
const RISEN: f64 = 1.25;
/// Half of the heights among which the bolster's is looked for, m.
const MOST_HEIGHT: f64 = 0.25;

/// A test of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Test {
    /// Vertical force of a nest over its stroke.
    Nest,
    /// Warp moment of a nest over the warp angle.
    Warp,
}

impl Test {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Nest, Self::Warp];

    /// Returns its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Nest => "nest",
            Self::Warp => "warp",
        }
    }

    /// Returns the kinds of its motion and of what resists.
    #[must_use]
    pub fn kinds(self) -> [Kind; 2] {
        match self {
            Self::Nest => [Kind::Length, Kind::Force],
            Self::Warp => [Kind::Angle, Kind::Moment],
        }
    }

    /// Returns the time that its motion begins, in quarters of a period, and the first row of the falling
    /// branch; the rising one follows half a cycle later.
    fn beginning(self, period: f64) -> [usize; 2] {
        let quarter = ROWS / 4;
        match self {
            Self::Nest => [0, 2 * quarter],
            Self::Warp => {
                let start = (4.0 * RISEN / period).ceil().max(1.0) as usize;
                [start, (start + 1) * quarter]
            }
        }
    }

    /// Returns the time that a run takes, s.
    #[must_use]
    pub fn duration(self, rate: f64) -> f64 {
        let period = TAU / rate;
        let [_, first] = self.beginning(period);
        (first + ROWS) as f64 * period / ROWS as f64
    }
}

/// A run that a table needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// The test.
    pub test: Test,
    /// Load, rise, friction and rate.
    pub at: Point,
    /// Amplitude of the motion, m or rad.
    pub amplitude: f64,
}

/// The branches of a loop at the positions of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Branches {
    /// Where the motion grows: a nest's loading. N or N·m.
    pub rising: Vec<f64>,
    /// Where it falls: a nest's unloading.
    pub falling: Vec<f64>,
}

/// Returns `2 HALVES + 1` positions evenly between minus and plus an amplitude.
#[must_use]
pub fn positions(amplitude: f64) -> Vec<f64> {
    const HALVES: i32 = 10;
    let all = -HALVES..=HALVES;
    all.map(|k| amplitude * f64::from(k) / f64::from(HALVES))
        .collect()
}

/// Returns the load that the coils of a nest carry together without friction at a height of the bolster (m)
/// above the nominal layout and a rise of its wedges (m): mean of both nests, N.
#[must_use]
pub fn carried(parameters: &Parameters, height: f64, rise: f64) -> f64 {
    let coils = parameters.load_coils.iter().flatten();
    let load: f64 = coils
        .map(|coil| coil.spring.law(String::new()).load(height))
        .sum();
    let control = |coil: &ControlCoil| match coil {
        ControlCoil::Shear(spring) => ShearSpring::load(&spring.law(String::new()), height + rise),
        ControlCoil::Table(spring) => TableSpring::load(spring, height + rise),
        ControlCoil::Thesis(coil, _) => {
            let compression = coil.free_length - coil.nominal_length - height - rise;
            coil.law.force(compression)
        }
        ControlCoil::Nothing => 0.0,
    };
    let control: f64 = match parameters.damping {
        Damping::Constant => 0.0,
        Damping::Variable => parameters
            .wedges
            .iter()
            .map(|wedge| control(&wedge.control_coil))
            .sum(),
    };
    0.5 * (load + control)
}

/// Returns the height at which the coils of a nest carry a load; none if they do nowhere.
#[must_use]
pub fn height(parameters: &Parameters, load: f64, rise: f64) -> Option<f64> {
    let [mut low, mut high] = [-MOST_HEIGHT, MOST_HEIGHT];
    let excess = |height: f64| carried(parameters, height, rise) - load;
    if excess(low) < 0.0 || excess(high) > 0.0 {
        return None;
    }
    // To the last bit.
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(0.5 * (low + high))
}

/// Checks whether tables can be made of a case.
///
/// # Errors
/// Its wedges have no mass.
pub fn check(case: &TruckCase) -> Result<(), TablesError> {
    let mut wedges = case.parameters.wedges.iter();
    match wedges.any(|wedge| wedge.kind == WedgeKind::Massless) {
        true => Err(TablesError::Massless(case.name.clone())),
        false => Ok(()),
    }
}

/// Returns the case of a run.
///
/// # Errors
/// The coils carry the load at no height.
pub fn case(own: &TruckCase, wanted: &Wanted) -> Result<TruckCase, TablesError> {
    let [load, rise, friction, rate] = wanted.at;
    let mut parameters = own.parameters.clone();
    for wedge in &mut parameters.wedges {
        let Wear { column, slope } = wedge.wear;
        let share = match column + slope {
            sum if sum > 0.0 => column / sum,
            _ => 0.5,
        };
        wedge.wear = Wear::of_rise(rise, share, wedge.rise_angles());
        wedge.column_friction.coefficient = friction;
        wedge.slope_friction.coefficient = friction;
        for face in [&mut wedge.column_face, &mut wedge.slope_face] {
            if let Some(pad) = &mut face.pad {
                pad.friction = friction;
            }
        }
    }
    let height = height(&parameters, load, rise).ok_or_else(|| TablesError::Load {
        load,
        most: carried(&parameters, -MOST_HEIGHT, rise),
    })?;
    let damping = match parameters.damping {
        Damping::Constant => "constant",
        Damping::Variable => "variable",
    };
    let mut case = case_with(&format!("truck_crowned_warp_nest_{damping}"), &[])?;
    case.name = format!("{}_{}", own.name, wanted.test.name());
    let there = &mut case.parameters;
    there.damping = parameters.damping;
    there.gravity = parameters.gravity;
    there.geometry = parameters.geometry;
    there.wedges = parameters.wedges;
    there.load_coils = parameters.load_coils;
    there.gib = parameters.gib;
    there.lands = parameters.lands;
    there.warp_spring = parameters.warp_spring;
    there.start = Start::Equilibrium;
    let period = TAU / rate;
    let sine = |phase: f64| Motion::Sine {
        amplitude: wanted.amplitude,
        angular_frequency: rate,
        phase,
    };
    let [start, _] = wanted.test.beginning(period);
    let (vertical, yaw) = match wanted.test {
        Test::Nest => (
            vec![Motion::Constant(height), sine(0.5 * PI)],
            Motion::Constant(0.0),
        ),
        Test::Warp => {
            let approach = Motion::Ramp {
                amplitude: APPROACH,
                start: 0.2,
                duration: 1.0,
                profile: RampProfile::HalfCosine,
            };
            let yaw = Piece {
                start: start as f64 * 0.25 * period,
                motion: sine(0.0),
            };
            (
                vec![Motion::Constant(height - APPROACH), approach],
                Motion::Sequence(vec![yaw]),
            )
        }
    };
    there.bolster.motion.coordinates[2] = Motion::Sum(vertical);
    for frame in &mut there.side_frames {
        frame.motion.coordinates[5] = yaw.clone();
    }
    let simulation = &mut case.simulation;
    simulation.method = own.simulation.method;
    simulation.relative_tolerance = own.simulation.relative_tolerance;
    simulation.output_units = own.simulation.output_units;
    simulation.duration = wanted.test.duration(rate);
    simulation.output_interval = period / ROWS as f64;
    Ok(case)
}

/// Runs a test; `go_on` may stop it. Returns the branches of the loop and the warnings of the run.
///
/// # Errors
/// The run cannot begin or does not come to its end.
pub fn run(
    own: &TruckCase,
    wanted: &Wanted,
    go_on: &dyn Fn() -> ControlFlow<String>,
) -> Result<(Branches, Vec<String>), TablesError> {
    let case = case(own, wanted)?;
    let failed = |reason: String| TablesError::Run {
        name: case.name.clone(),
        at: wanted.at,
        reason,
    };
    let run = Run::new(&case).map_err(|error| failed(error.to_string()))?;
    let result = run.finish_while(|_| go_on());
    match result.summary.outcome() {
        Outcome::Complete => {}
        other => return Err(failed(other.told().unwrap_or_default())),
    }
    let branches = branches(&case, wanted, &result);
    let branches = branches.ok_or_else(|| failed("it has too few rows".to_owned()))?;
    Ok((branches, result.summary.warnings))
}

/// Returns the branches of the loop of a result.
fn branches(case: &TruckCase, wanted: &Wanted, result: &TruckResult) -> Option<Branches> {
    let (motion, force): (Vec<f64>, Vec<f64>) = match wanted.test {
        Test::Nest => {
            let height = case.parameters.bolster.motion.coordinates[2].evaluate(0.0, 0.0)[0];
            let height = height - wanted.amplitude;
            let sides = ["left", "right"].map(|side| format!("{side}_nest_vertical_force"));
            let [left, right] = [result.column(&sides[0])?, result.column(&sides[1])?];
            let heights = result.column("bolster_z")?.iter();
            (
                heights.map(|own| height - own).collect(),
                left.iter()
                    .zip(right)
                    .map(|(left, right)| 0.5 * (left + right))
                    .collect(),
            )
        }
        Test::Warp => {
            let moments = result.column("warp_moment")?.iter();
            (
                result.column("warp_angle")?.to_vec(),
                moments.map(|moment| 0.5 * moment).collect(),
            )
        }
    };
    let [_, first] = wanted.test.beginning(TAU / wanted.at[3]);
    let turn = first + ROWS / 2;
    let half = |from: usize, to: usize| Some((motion.get(from..=to)?, force.get(from..=to)?));
    let (falling, rising) = (half(first, turn)?, half(turn, turn + ROWS / 2)?);
    let positions = positions(wanted.amplitude);
    Some(Branches {
        rising: positions.iter().map(|own| at(rising, *own)).collect(),
        falling: positions.iter().map(|own| at(falling, *own)).collect(),
    })
}

/// Returns what a half cycle's force is at a position, by straight lines between rows, whichever way the
/// motion goes; beyond its ends that of the end.
fn at((motion, force): (&[f64], &[f64]), position: f64) -> f64 {
    let last = motion.len() - 1;
    let sign = if motion[last] > motion[0] { 1.0 } else { -1.0 };
    let above = motion.partition_point(|own| sign * own < sign * position);
    match above {
        0 => force[0],
        beyond if beyond > last => force[last],
        above => {
            let share = (position - motion[above - 1]) / (motion[above] - motion[above - 1]);
            force[above - 1] + share * (force[above] - force[above - 1])
        }
    }
}

impl From<CaseError> for TablesError {
    fn from(error: CaseError) -> Self {
        Self::Case(error)
    }
}
