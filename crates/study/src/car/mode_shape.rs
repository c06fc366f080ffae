//! Motions about steady running, for pictures of them: what a car's bodies do over a few periods.
//!
//! The states are those of steady running plus `Re(φ exp(iωt))`, observed as those of a run are. They are
//! no solution of the equations of motion but the shape of a linear one: there are places and angles, and no
//! forces.

use std::f64::consts::TAU;

use car::{BuildError, Car, Drive, Start, StartKind, SteadyCar};
use quantity::Kind;

use super::CarCase;
use super::columns::CarTable;
use super::motions::MotionTable;
use super::stability::{Branch, BranchKind, Critical, Stability, straight};
use crate::result::RunResult;

/// Rows of a period, and periods.
pub const ROWS: usize = 40;
/// Periods that are shown.
pub const PERIODS: usize = 2;

/// What a motion belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotionOf {
    /// The curve of critical speeds: a lateral amplitude (m) of the wheelset that moves most.
    Amplitude(f64),
    /// The critical speed of a branch, whose linear motion has any size; true if it grows at the lowest speed
    /// already.
    Branch(BranchKind, bool),
}

/// A motion about steady running.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownMotion {
    /// What it belongs to.
    pub of: MotionOf,
    /// The bodies that move, and how.
    pub name: String,
    /// The speed, m/s.
    pub speed: f64,
    /// Frequency, Hz.
    pub frequency: f64,
    /// Displacements in the order of the positions of the car's state, m and rad: real and imaginary parts.
    pub shape: Vec<[f64; 2]>,
}

/// What a car's bodies do in a motion.
#[derive(Clone, Debug)]
pub struct ModeRecording {
    /// The case, on straight track.
    pub case: CarCase,
    /// Places and angles of its table and of its bodies, row by row over [`PERIODS`] of [`ROWS`] each; SI.
    pub result: RunResult<()>,
    /// The value of each column in steady running.
    pub rest: Vec<f64>,
}

/// Returns the motions of a car that are worth a picture: the neutral ones of the largest and the smallest
/// amplitude, and those at the critical speeds of the branches, as large as the largest amplitude. The linear
/// benchmark is another car and has none.
#[must_use]
pub fn motions(found: &Stability) -> Vec<ShownMotion> {
    let mut all: Vec<ShownMotion> = Vec::new();
    let of_curve = |largest: bool| {
        let mut own = found.curve.iter().filter_map(|own| {
            let of = MotionOf::Amplitude(own.amplitude);
            Some(ShownMotion::new(of, own.critical.as_ref()?, own.amplitude))
        });
        if largest { own.next() } else { own.next_back() }
    };
    for own in [of_curve(true), of_curve(false)].into_iter().flatten() {
        if all.iter().all(|other| other.of != own.of) {
            all.push(own);
        }
    }
    let Some(largest) = found.curve.first().map(|own| own.amplitude) else {
        return all;
    };
    let branches = found.branches.iter().filter(|own| own.kind != BranchKind::Tied);
    all.extend(branches.filter_map(|own| of_branch(own, found.steady.car(), largest)));
    all
}

/// Returns the motion at the critical speed of a branch, in which a body moves by `largest` (m) and none
/// more.
fn of_branch(branch: &Branch, car: &Car, largest: f64) -> Option<ShownMotion> {
    let critical = branch.critical.as_ref()?;
    let numbers = &car.numbers;
    let frames = numbers.side_frames.iter().flatten();
    let bodies = numbers.body_parts().chain(numbers.bolsters);
    let bodies = bodies.chain(frames.copied()).chain(numbers.wheelsets);
    let places = bodies.flat_map(|body| (0..3).filter_map(move |k| car.system.position_of(body, k)));
    let most = places.fold(0.0_f64, |most, place| {
        let [re, im] = critical.shape[place];
        most.max(libm::hypot(re, im))
    });
    let scale = largest / most;
    let of = MotionOf::Branch(branch.kind, critical.at_lowest);
    scale.is_finite().then(|| ShownMotion::new(of, critical, scale))
}

impl ShownMotion {
    /// Returns a motion, its shape multiplied.
    fn new(of: MotionOf, critical: &Critical, scale: f64) -> Self {
        Self {
            of,
            name: critical.name.clone(),
            speed: critical.speed,
            frequency: critical.frequency,
            shape: critical
                .shape
                .iter()
                .map(|part| part.map(|own| scale * own))
                .collect(),
        }
    }
}

/// Returns what the bodies of a case's car do in a motion about its steady running. The car stands still
/// along the track, so that it stays in view.
///
/// # Errors
/// The parameters make no car.
pub fn record(case: &CarCase, steady: &SteadyCar, motion: &ShownMotion) -> Result<ModeRecording, BuildError> {
    let mut case = case.clone();
    case.parameters = straight(&case.parameters);
    case.parameters.drive = Drive::Coasting;
    // States come from elsewhere: where it starts does not matter.
    case.parameters.start = Start {
        kind: StartKind::Nominal,
        ..case.parameters.start
    };
    let table = CarTable::new(&case.parameters)?;
    let mut system = steady.car().system.clone();
    let still = steady.state(motion.speed);
    let (speeds, no_rates) = (system.layout().speeds, vec![0.0; still.len()]);
    let mut motions = MotionTable::new(&case.parameters);
    let mut rows: Vec<Vec<f64>> = vec![Vec::new(); table.columns().len()];
    let mut row = Vec::new();
    // The first row is that of steady running.
    let count = 1 + PERIODS * ROWS + 1;
    for number in 0..count {
        let phase = TAU * number.saturating_sub(1) as f64 / ROWS as f64;
        let (sine, cosine) = libm::sincos(phase);
        let mut state = still.clone();
        for (place, [re, im]) in motion.shape.iter().enumerate().filter(|_| number > 0) {
            state[place] += re * cosine - im * sine;
            state[speeds + place] -= TAU * motion.frequency * (re * sine + im * cosine);
        }
        let observation = system.observe(phase / (TAU * motion.frequency), &state);
        row.clear();
        table.read(&observation, &no_rates, 0.0, &mut row);
        motions.take(table.car(), &observation);
        for (column, value) in rows.iter_mut().zip(&row) {
            column.push(*value);
        }
    }
    let mut result = RunResult {
        columns: table.columns().to_vec(),
        values: rows,
        summary: (),
    };
    result.columns.extend(motions.columns);
    result.values.extend(motions.values);
    let is_place: Vec<String> = result
        .columns
        .iter()
        .filter(|own| {
            let kinds = [Kind::Time, Kind::Distance, Kind::Length, Kind::Angle];
            kinds.contains(&own.kind) && !own.name.contains("_patch_")
        })
        .map(|own| own.name.clone())
        .collect();
    result.keep_columns(|name| is_place.iter().any(|own| own == name));
    let rest = result.values.iter_mut().map(|own| own.remove(0)).collect();
    Ok(ModeRecording { case, result, rest })
}
