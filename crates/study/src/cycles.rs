//! Friction in each cycle of the bolster: the share of the contact that sticks, and the power that wears the
//! faces.

use wedge::outputs::FACES;

use crate::metrics::Cycle;
use crate::result::RunResult;

/// The number that stands for stick in the columns of contact states.
const STICK: f64 = 1.0;
/// The columns of the energy lost in friction, face by face.
const LOSSES: [&str; FACES.len()] = ["side_frame_friction_loss", "bolster_friction_loss"];

/// One cycle of the bolster, from one start of its motion (phase 0) to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CycleShare {
    /// Start, s.
    pub start: f64,
    /// End, s.
    pub end: f64,
    /// Share of stick in all contact, face by face: of the output times at which points touch, counted
    /// point by point, the part at which they stick; `None` where no point of the face touches.
    pub stick: [Option<f64>; FACES.len()],
    /// Mean power lost in friction, face by face, W: what wears the face.
    pub wear_power: [f64; FACES.len()],
}

/// Returns the whole cycles of a run, from its start; empty if the bolster does not cycle or the table lacks
/// a column.
#[must_use]
pub fn shares(result: &RunResult, cycle: &Cycle) -> Vec<CycleShare> {
    collect(result, cycle).unwrap_or_default()
}

fn collect(result: &RunResult, cycle: &Cycle) -> Option<Vec<CycleShare>> {
    let times = result.column("time")?;
    let states = FACES.map(|face| states(result, face));
    if states.iter().any(Vec::is_empty) {
        return None;
    }
    let losses = [result.column(LOSSES[0])?, result.column(LOSSES[1])?];
    let period = cycle.period();
    let last = *times.last()?;
    let count = (last / period * (1.0 + 1e-12)).floor() as usize;
    let mut shares = Vec::new();
    for number in 0..count {
        let (start, end) = (number as f64 * period, (number + 1) as f64 * period);
        let rows = times.partition_point(|time| *time < start)..times.partition_point(|time| *time < end);
        let share = |face: usize| {
            let (mut touch, mut stick) = (0_u64, 0_u64);
            for state in &states[face] {
                for value in &state[rows.clone()] {
                    touch += u64::from(*value != 0.0);
                    stick += u64::from(*value == STICK);
                }
            }
            (touch > 0).then(|| stick as f64 / touch as f64)
        };
        let power = |face: usize| {
            (interpolate(times, losses[face], end) - interpolate(times, losses[face], start)) / period
        };
        shares.push(CycleShare {
            start,
            end: end.min(last),
            stick: [share(0), share(1)],
            wear_power: [power(0), power(1)],
        });
    }
    Some(shares)
}

/// Returns the contact states of the points of a face: of the grid, if there is one, else of the corners.
fn states<'r>(result: &'r RunResult, face: &str) -> Vec<&'r [f64]> {
    let of = |points: &str| {
        let beginning = format!("{face}_{points}");
        let columns = result.columns.iter().zip(&result.values);
        let own = columns
            .filter(|(column, _)| column.name.starts_with(&beginning) && column.name.ends_with("_state"));
        own.map(|(_, values)| values.as_slice()).collect::<Vec<_>>()
    };
    match of("point_") {
        points if points.is_empty() => of(""),
        points => points,
    }
}

/// Returns the value at `time`, straight between rows, and that of the nearest end outside.
fn interpolate(times: &[f64], values: &[f64], time: f64) -> f64 {
    let after = times.partition_point(|row| *row < time);
    if after == 0 {
        return values[0];
    }
    if after >= times.len() {
        return values[values.len() - 1];
    }
    let (t0, t1) = (times[after - 1], times[after]);
    let (v0, v1) = (values[after - 1], values[after]);
    v0 + (v1 - v0) * (time - t0) / (t1 - t0)
}
