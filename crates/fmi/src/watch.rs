//! Doubts about inputs: rates that contradict their positions, and motions that no machine makes.

use quantity::{Kind, SixDigits};
use serde::{Deserialize, Serialize};

use crate::element::QuantityEntry;
use crate::extrapolate::Point;
use crate::unit::Unit;

/// Largest error of a rate between two points, as a share of the largest speed before: coarse steps, and
/// rates that come a step late, stay below.
const LARGEST_SHARE: f64 = 0.25;

/// The part of the largest speed that is still remembered a point later: where a motion turns, a rate that is
/// late differs from it by all of its present value.
const MEMORY: f64 = 0.99;

/// Points in a row that contradict: one is a jump.
const FEWEST: u8 = 3;

/// Smallest contradiction that is told, m; for angles ten times the number, rad, as at a lever of 0.1 m.
const SMALLEST: f64 = 1e-5;

/// Largest speed of a position, m/s or rad/s. Trains are slower, and so are the parts of their trucks.
const LARGEST_SPEED: f64 = 100.0;

/// Smaller jumps are no motion of this speed, m or rad.
const SMALLEST_JUMP: f64 = 1e-3;

/// The doubt about a position and its rate so far: both since when they contradict each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Doubt {
    /// Points in a row at which they do.
    points: u8,
    /// The time of the point before, s.
    pub since: f64,
    /// The change of the position since then, m or rad.
    pub change: f64,
    /// The integral of the rate since then, m or rad.
    pub integral: f64,
    /// The largest speed, which fades, m/s or rad/s.
    speed: f64,
}

impl Doubt {
    /// Returns its numbers.
    pub fn values(&self) -> [&f64; 4] {
        [&self.since, &self.change, &self.integral, &self.speed]
    }

    /// Takes a point (time, position, rate) after another one into account. Returns whether position and
    /// rate contradict each other: a motion whose rate stays between both does not.
    fn note(&mut self, [t0, z0, r0]: [f64; 3], [t1, z1, r1]: [f64; 3], smallest: f64) -> bool {
        let step = t1 - t0;
        let (change, integral) = (z1 - z0, 0.5 * step * (r0 + r1));
        self.speed = (MEMORY * self.speed)
            .max((change / step).abs())
            .max(r0.abs())
            .max(r1.abs());
        let error = change - integral;
        let explained = 0.5 * step * (r1 - r0).abs() + LARGEST_SHARE * step * self.speed;
        if error.abs() <= explained {
            self.points = 0;
            return false;
        }
        if self.points == 0 || error * (self.change - self.integral) < 0.0 {
            let speed = self.speed;
            *self = Self {
                since: t0,
                speed,
                ..Self::default()
            };
        }
        self.points = self.points.saturating_add(1);
        self.change += change;
        self.integral += integral;
        self.points >= FEWEST && (self.change - self.integral).abs() > smallest
    }
}

/// Returns the positions among inputs, with the numbers of their rates.
pub(crate) fn positions(entries: &[QuantityEntry]) -> impl Iterator<Item = (usize, usize)> {
    let rates = entries.iter().enumerate();
    rates.filter_map(|(position, entry)| Some((position, entry.rate?)))
}

fn is_length(entry: &QuantityEntry) -> bool {
    entry.unit == Some(Unit::Of(Kind::Length))
}

/// Returns a length or an angle with its unit, or with that of its rate.
fn with_unit(value: f64, entry: &QuantityEntry, per_second: &str) -> String {
    let unit = if is_length(entry) { "m" } else { "rad" };
    format!("{} {unit}{per_second}", SixDigits(value))
}

/// Takes the inputs at a point after another one into account; `doubts` are those of the positions, and
/// `is_used` says whether the rate of a position is read. Returns the first pair that contradicts, in words
/// without advice, with its numbers.
pub(crate) fn contradiction(
    entries: &[QuantityEntry],
    doubts: &mut [Doubt],
    [before, now]: [&Point; 2],
    is_used: impl Fn(usize, usize) -> bool,
) -> Option<(usize, usize, String)> {
    let mut found: Option<(usize, usize, String)> = None;
    for ((position, rate), doubt) in positions(entries).zip(doubts) {
        let entry = &entries[position];
        let at = |point: &Point| [point.time, point.inputs[position], point.inputs[rate]];
        let smallest = if is_length(entry) {
            SMALLEST
        } else {
            10.0 * SMALLEST
        };
        if !is_used(position, rate) {
            *doubt = Doubt::default();
        } else if doubt.note(at(before), at(now), smallest) && found.is_none() {
            let measure = |value: f64| with_unit(value, entry, "");
            let text = format!(
                "the inputs `{}` and `{}` contradict each other: from {} s to {} s the position changes by \
                 {}, the integral of the rate is {}",
                entry.name,
                entries[rate].name,
                SixDigits(doubt.since),
                SixDigits(now.time),
                measure(doubt.change),
                measure(doubt.integral)
            );
            found = Some((position, rate, text));
        }
    }
    found
}

/// Returns the first position that moves, within a time (s) from one point to the next, as no machine does,
/// in words.
pub(crate) fn too_fast(
    entries: &[QuantityEntry],
    [before, now]: [&Point; 2],
    duration: f64,
) -> Option<String> {
    positions(entries).find_map(|(position, rate)| {
        let entry = &entries[position];
        let jump = (now.inputs[position] - before.inputs[position]).abs();
        let limit = with_unit(LARGEST_SPEED, entry, "/s");
        let end = "look for a jump of the input, and for its unit (SI)";
        if jump > SMALLEST_JUMP && jump > LARGEST_SPEED * duration {
            let (way, speed) = (
                with_unit(jump, entry, ""),
                with_unit(jump / duration, entry, "/s"),
            );
            return Some(format!(
                "implausible: the input `{}` moves by {way} in {} s up to {} s, {speed}; the limit is \
                 {limit} (no train is so fast); {end}",
                entry.name,
                SixDigits(duration),
                SixDigits(now.time)
            ));
        }
        let speed = now.inputs[rate].abs();
        (speed > LARGEST_SPEED).then(|| {
            format!(
                "implausible: the input `{}` is {} at {} s; the limit is {limit} (no train is so fast); \
                 {end}",
                entries[rate].name,
                with_unit(now.inputs[rate], entry, "/s"),
                SixDigits(now.time)
            )
        })
    })
}
