//! What friction does in each cycle of the bolster: how much of the contact sticks, and the power that wears
//! the faces.

use wedge::outputs::{CORNERS, FACES};

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
    /// Share of stick in all contact, face by face: of the output times at which corners touch, counted
    /// corner by corner, the part at which they stick; `None` where no corner of the face touches.
    pub stick: [Option<f64>; FACES.len()],
    /// Mean power lost in friction, face by face, W: what wears the face.
    pub wear_power: [f64; FACES.len()],
}

/// The whole cycles of a run, from its start; empty if the bolster does not cycle or the table lacks a
/// column.
#[must_use]
pub fn shares(result: &RunResult, cycle: &Cycle) -> Vec<CycleShare> {
    collect(result, cycle).unwrap_or_default()
}

fn collect(result: &RunResult, cycle: &Cycle) -> Option<Vec<CycleShare>> {
    let times = result.column("time")?;
    let mut states = Vec::new();
    for face in FACES {
        for corner in CORNERS {
            states.push(result.column(&format!("{face}_{corner}_state"))?);
        }
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
            for state in &states[face * CORNERS.len()..][..CORNERS.len()] {
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

/// The value at `time`, straight between rows, and that of the nearest end outside.
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
