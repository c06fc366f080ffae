//! The class of a track from its geometry, by the limits of [`super::class_limits`].
//!
//! Quantities are those of the unloaded track's rails at rows along it. Alignment and profile are measured
//! beside the design's curve, as the rule measures them against uniform curvature. A place counts as a curve
//! where the center line is sharper than a tenth of a degree (a guess, for center lines that were measured).
//! On tangents the worse rail counts; the rule lets an inspector choose one for the whole tangent.
//!
//! Limits: between two rows nothing is seen, so that a peak of a wave λ may be larger by `(π d/λ)²/2` at
//! rows d apart. Gauge is 56.5 in and what the rails deviate from it.

use std::collections::VecDeque;

use super::chord;
use super::class_limits::{CLASS_LIMITS, CLASSES, ClassLimit, ClassQuantity, HIGHEST_COVERED};
use super::layout::{RailPlace, Track};

/// Nominal gauge, m.
const GAUGE: f64 = 56.5 * 0.0254;
/// Least curvature of a curve, 1/m: a tenth of a degree of curve.
const CURVE: f64 = 0.1 * std::f64::consts::PI / 180.0 / 30.48;
/// Distance from one staggered joint to the next, m: not nearer by the rule, not farther for rails of 39 ft
/// (a guess).
const JOINTS: [f64; 2] = [10.0 * 0.3048, 30.0 * 0.3048];
/// Differences between seven joints.
const PAIRS: usize = 6;

/// The worst value of a quantity along a track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClassValue {
    /// The row of the rule.
    pub limit: ClassLimit,
    /// The value, m: of gauges the gauge, of others its size.
    pub value: f64,
    /// Its distance along the track, m.
    pub at: f64,
    /// The highest class whose limit it keeps, from 1; 0 if it keeps none.
    pub class: usize,
}

/// The class of a track.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackClass {
    /// The worst value of each row of the rule that the track has a value of.
    pub values: Vec<ClassValue>,
}

impl TrackClass {
    /// Returns the class of a track from rows `interval` (m) apart.
    #[must_use]
    pub fn of(track: &Track, interval: f64) -> Self {
        let rows = Rows::of(track, interval);
        let worst = |limit: &ClassLimit| {
            let (value, at) = rows.worst(track, limit.quantity)?;
            let class = class_of(limit, value);
            Some(ClassValue {
                limit: *limit,
                value,
                at,
                class,
            })
        };
        Self {
            values: CLASS_LIMITS.iter().filter_map(worst).collect(),
        }
    }

    /// Returns the class by all rows of classes 1 to 5: 0 if the track keeps none of them.
    #[must_use]
    pub fn class(&self) -> usize {
        let classes = self.values.iter().map(|own| own.class);
        classes.min().unwrap_or(HIGHEST_COVERED).min(HIGHEST_COVERED)
    }

    /// Returns the value that keeps the track from the next class, or the one nearest to its limit in class
    /// 5.
    #[must_use]
    pub fn governing(&self) -> Option<&ClassValue> {
        let next = (self.class() + 1).min(HIGHEST_COVERED);
        let share = |own: &&ClassValue| own.limit.share(own.value, next);
        let judged = self.values.iter().filter(|own| share(own).is_some());
        judged.max_by(|a, b| share(a).unwrap_or(0.0).total_cmp(&share(b).unwrap_or(0.0)))
    }
}

impl ClassLimit {
    /// Returns the limit of a class (from 1), m.
    #[must_use]
    pub fn of_class(&self, class: usize) -> Option<f64> {
        class.checked_sub(1).and_then(|index| *self.limits.get(index)?)
    }

    /// Returns which part of a class's limit a value (m) takes; of gauges of the play to it from 56.5 in.
    #[must_use]
    pub fn share(&self, value: f64, class: usize) -> Option<f64> {
        let limit = self.of_class(class)?;
        Some(match self.quantity {
            ClassQuantity::WidestGauge | ClassQuantity::NarrowestGauge => (value - GAUGE) / (limit - GAUGE),
            _ => value / limit,
        })
    }
}

/// Returns the highest class whose limit a value keeps; rows without a limit in classes 1 to 5 keep them all,
/// and the others keep no class beyond the last one they limit.
fn class_of(limit: &ClassLimit, value: f64) -> usize {
    /// What rounding may add to a value at its limit.
    const ROUNDING: f64 = 1.0 + 1e-9;
    let of_high_classes = limit.limits[0..HIGHEST_COVERED].iter().all(Option::is_none);
    let mut class = if of_high_classes { HIGHEST_COVERED } else { 0 };
    while class < CLASSES {
        match limit.share(value, class + 1) {
            Some(share) if share <= ROUNDING => class += 1,
            None if class < HIGHEST_COVERED => class += 1,
            _ => break,
        }
    }
    class
}

/// A track at equal distances.
struct Rows {
    distances: Vec<f64>,
    rails: Vec<[RailPlace; 2]>,
    curvature: Vec<f64>,
    /// Right rail above the left one, m.
    cross_level: Vec<f64>,
}

impl Rows {
    fn of(track: &Track, interval: f64) -> Self {
        let length = track.center_line.length();
        let count = (length / interval).ceil() as usize;
        let distances: Vec<f64> = (0..=count).map(|k| (k as f64 * interval).min(length)).collect();
        let rails: Vec<[RailPlace; 2]> = distances.iter().map(|at| track.rails(*at)).collect();
        let stations = distances.iter().map(|at| track.center_line.at(*at));
        let (curvature, raised): (Vec<f64>, Vec<f64>) = stations
            .map(|own| (own.curvature[0], own.superelevation[0]))
            .unzip();
        let cross_level = raised
            .iter()
            .zip(&rails)
            .map(|(raised, [left, right])| raised + right.vertical[0] - left.vertical[0]);
        Self {
            cross_level: cross_level.collect(),
            distances,
            rails,
            curvature,
        }
    }

    /// Returns the largest of the values at rows, and its distance (m).
    fn largest(&self, value: impl Fn(usize) -> Option<f64>) -> Option<(f64, f64)> {
        let values = (0..self.distances.len()).filter_map(|row| Some((value(row)?, self.distances[row])));
        values.reduce(|most, own| if own.0 > most.0 { own } else { most })
    }

    fn gauge(&self, row: usize) -> f64 {
        let [left, right] = &self.rails[row];
        GAUGE + left.lateral[0] - right.lateral[0]
    }

    fn is_curve(&self, row: usize) -> bool {
        self.curvature[row].abs() > CURVE
    }

    /// Returns the worst value (m) of a quantity and its distance (m); none if there is nothing to measure.
    fn worst(&self, track: &Track, quantity: ClassQuantity) -> Option<(f64, f64)> {
        let alinement = |rail: usize, row: usize, chord: f64| {
            let lateral = |at: f64| track.rails(at)[rail].lateral[0];
            chord::offset(lateral, self.distances[row], chord).abs()
        };
        let either = |row: usize, chord: f64| alinement(0, row, chord).max(alinement(1, row, chord));
        // The right rail is the outer one in curves to the left.
        let outer = |row: usize, chord: f64| alinement(usize::from(self.curvature[row] > 0.0), row, chord);
        match quantity {
            ClassQuantity::WidestGauge => self.largest(|row| Some(self.gauge(row))),
            ClassQuantity::NarrowestGauge => {
                let (value, at) = self.largest(|row| Some(-self.gauge(row)))?;
                Some((-value, at))
            }
            ClassQuantity::TangentAlinement(chord) => {
                self.largest(|row| (!self.is_curve(row)).then(|| either(row, chord)))
            }
            ClassQuantity::CurveAlinement(chord) => {
                self.largest(|row| self.is_curve(row).then(|| outer(row, chord)))
            }
            ClassQuantity::Alinement(chord) => self.largest(|row| {
                Some(match self.is_curve(row) {
                    true => outer(row, chord),
                    false => either(row, chord),
                })
            }),
            ClassQuantity::Profile(chord) => self.largest(|row| {
                let offset = |rail: usize| {
                    let vertical = |at: f64| track.rails(at)[rail].vertical[0];
                    chord::offset(vertical, self.distances[row], chord).abs()
                };
                Some(offset(0).max(offset(1)))
            }),
            ClassQuantity::CrossLevel => self.largest(|row| {
                let own = self.cross_level[row];
                Some(match self.is_curve(row) {
                    // The outer rail is to be the higher one.
                    true => (-own * self.curvature[row].signum()).max(0.0),
                    false => own.abs(),
                })
            }),
            ClassQuantity::Warp(length) => self.warp(length),
            ClassQuantity::StaggeredJoints => self.staggered_joints(),
        }
    }

    /// Returns the largest difference of the cross level (m) between two rows at most a length (m) apart, and
    /// the distance of the later one (m).
    fn warp(&self, length: f64) -> Option<(f64, f64)> {
        // Rows of falling and of rising values, of which the first is the largest, the smallest in the
        // window.
        let (mut highs, mut lows) = (VecDeque::new(), VecDeque::new());
        let mut worst: Option<(f64, f64)> = None;
        for (row, at) in self.distances.iter().enumerate() {
            let own = self.cross_level[row];
            for (window, sign) in [(&mut highs, 1.0), (&mut lows, -1.0)] {
                while window
                    .back()
                    .is_some_and(|&(_, last): &(f64, f64)| sign * last <= sign * own)
                {
                    window.pop_back();
                }
                window.push_back((*at, own));
                while window
                    .front()
                    .is_some_and(|&(first, _)| at - first > length * (1.0 + 1e-9))
                {
                    window.pop_front();
                }
            }
            let [high, low] = [&highs, &lows].map(|window| window.front().map_or(own, |front| front.1));
            if worst.is_none_or(|(most, _)| high - low > most) {
                worst = Some((high - low, *at));
            }
        }
        worst
    }

    /// Returns the largest difference (m) that six successive extremes of the cross level all exceed, joint
    /// by joint, with the distance of the first (m); none if there are no such seven.
    fn staggered_joints(&self) -> Option<(f64, f64)> {
        let own = &self.cross_level;
        let extremes: Vec<(f64, f64)> = (1..own.len().saturating_sub(1))
            .filter(|&row| (own[row] - own[row - 1]) * (own[row + 1] - own[row]) < 0.0)
            .map(|row| (self.distances[row], own[row]))
            .collect();
        let differences = |seven: &[(f64, f64)]| -> Option<(f64, f64)> {
            let mut least = f64::INFINITY;
            for pair in seven.windows(2) {
                let apart = pair[1].0 - pair[0].0;
                if !(JOINTS[0]..=JOINTS[1]).contains(&apart) {
                    return None;
                }
                least = least.min((pair[1].1 - pair[0].1).abs());
            }
            Some((least, seven[0].0))
        };
        let found = extremes.windows(PAIRS + 1).filter_map(differences);
        found.reduce(|most, own| if own.0 > most.0 { own } else { most })
    }
}
