//! The loop of a truck's vertical or roll motion: stiffness, friction, energy.

use std::f64::consts::PI;
use std::ops::Range;

use quantity::Kind;

use super::TruckCase;
use super::run::{TruckResult, period_of};

/// The motion and the resistance of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopKind {
    /// The bolster moves up and down; the load of both nests resists.
    Vertical,
    /// The bolster rolls; the moment on it about its center of gravity resists.
    Roll,
}

impl LoopKind {
    /// Returns the column of what moves.
    #[must_use]
    pub fn motion(self) -> &'static str {
        match self {
            Self::Vertical => "bolster_z",
            Self::Roll => "bolster_roll",
        }
    }

    /// Returns the kinds of what moves and of what resists.
    #[must_use]
    pub fn kinds(self) -> [Kind; 2] {
        match self {
            Self::Vertical => [Kind::Length, Kind::Force],
            Self::Roll => [Kind::Angle, Kind::Moment],
        }
    }

    /// Returns the resistance, SI: positive where it opposes a positive motion.
    fn resistance(self, result: &TruckResult) -> Vec<f64> {
        let column = |name: &str| result.column(name).unwrap_or_default();
        match self {
            // The load of a nest grows as the bolster sinks.
            Self::Vertical => {
                let sides = column("left_nest_vertical_force")
                    .iter()
                    .zip(column("right_nest_vertical_force"));
                sides.map(|(left, right)| -(left + right)).collect()
            }
            Self::Roll => column("bolster_roll_moment")
                .iter()
                .map(|moment| -moment)
                .collect(),
        }
    }
}

/// The loop of the last whole cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopCurve {
    /// The motion and the force of the loop.
    pub kind: LoopKind,
    /// Its rows in the result.
    pub rows: Range<usize>,
    /// The motion, m or rad, at these rows.
    pub motion: Vec<f64>,
    /// The resisting force or moment, N or N·m.
    pub resistance: Vec<f64>,
    /// Half the travel, m or rad.
    pub amplitude: f64,
    /// Resistance at the upper end less that at the lower one, over the travel, N/m or N·m/rad.
    pub stiffness: f64,
    /// Half the width of the loop in the middle of the travel, N or N·m: what friction holds.
    pub friction: f64,
    /// Its area, J.
    pub energy: f64,
    /// Damping ratio of a spring of this stiffness that loses as much: energy over 2π times stiffness and the
    /// square of the amplitude.
    pub loss_ratio: f64,
}

impl LoopCurve {
    /// Returns the loop of a run; `None` where the bolster neither moves up and down nor rolls periodically,
    /// or there is no whole cycle.
    #[must_use]
    pub fn of(case: &TruckCase, result: &TruckResult) -> Option<Self> {
        let motions = &case.parameters.bolster.motion.coordinates;
        let (kind, period) = match [2, 3].map(|k: usize| period_of(&motions[k])) {
            [Some(period), _] => (LoopKind::Vertical, period),
            [None, Some(period)] => (LoopKind::Roll, period),
            [None, None] => return None,
        };
        let times = result.column("time")?;
        let rows = last_cycle(times, period)?;
        let motion = result.column(kind.motion())?[rows.clone()].to_vec();
        let resistance = kind.resistance(result)[rows.clone()].to_vec();
        let end = |better: fn(f64, f64) -> bool| {
            let rows = 0..motion.len();
            rows.fold(0, |best, row| {
                if better(motion[row], motion[best]) {
                    row
                } else {
                    best
                }
            })
        };
        let [low, high] = [end(|a, b| a < b), end(|a, b| a > b)];
        let amplitude = 0.5 * (motion[high] - motion[low]);
        let stiffness = (resistance[high] - resistance[low]) / (2.0 * amplitude);
        let energy = work(&resistance, &motion);
        let middle = 0.5 * (motion[high] + motion[low]);
        let crossings: Vec<f64> = (0..motion.len() - 1)
            .filter(|i| {
                (motion[*i] - middle) * (motion[i + 1] - middle) <= 0.0 && motion[*i] != motion[i + 1]
            })
            .map(|i| {
                let share = (middle - motion[i]) / (motion[i + 1] - motion[i]);
                resistance[i] + share * (resistance[i + 1] - resistance[i])
            })
            .collect();
        let most = crossings.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = crossings.iter().copied().fold(f64::INFINITY, f64::min);
        Some(Self {
            kind,
            rows,
            amplitude,
            stiffness,
            friction: 0.5 * (most - least),
            energy,
            loss_ratio: energy / (2.0 * PI * stiffness * amplitude * amplitude),
            motion,
            resistance,
        })
    }
}

/// Returns the rows of the last whole cycle of a motion with this period and beginning (s); `None` if there
/// is none.
pub(super) fn last_cycle(times: &[f64], [period, start]: [f64; 2]) -> Option<Range<usize>> {
    // Output times are multiples of the interval but for rounding.
    const SLACK: f64 = 1e-9;
    let first = times.last()? - period;
    (first >= start - SLACK).then(|| times.partition_point(|time| *time < first - SLACK)..times.len())
}

/// Returns the work of a force along a way, J: straight lines between rows.
pub(super) fn work(force: &[f64], way: &[f64]) -> f64 {
    let rows = force.windows(2).zip(way.windows(2));
    rows.map(|(force, way)| 0.5 * (force[0] + force[1]) * (way[1] - way[0]))
        .sum()
}
