//! Extrapolation of inputs to the end of a communication step, from their values at its beginning and before.

use serde::{Deserialize, Serialize};

use crate::element::QuantityEntry;

/// The interpretation of inputs of a communication step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Understanding {
    /// Rates of neighbours are found from their positions.
    pub derive_rates: bool,
    /// Inputs are those of the step's end, not of its beginning.
    pub at_end: bool,
}

/// The inputs at a communication point, or after a step of the importer's integrator.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Point {
    /// The time, s.
    pub time: f64,
    /// Their values.
    pub inputs: Vec<f64>,
}

/// The earlier points that are kept: with the present one, what two second differences need.
pub(crate) const KEPT_POINTS: usize = 3;

/// The known values of the inputs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Known<'k> {
    /// The time at which they hold, s.
    pub time: f64,
    /// Their values.
    pub values: &'k [f64],
    /// Their derivatives by time, where the importer has given them for this step.
    pub slopes: &'k [Option<f64>],
    /// True for each input that has been set since the initialization.
    pub set: &'k [bool],
    /// Their values before, the latest last.
    pub past: &'k [Point],
}

impl Understanding {
    /// Returns whether a rate is found from its position: because the importer wants it, or since it sets
    /// the position and never the rate.
    pub fn derives(self, set: &[bool], position: usize, rate: usize) -> bool {
        let is_set = |input: usize| set.get(input).copied().unwrap_or(false);
        self.derive_rates || is_set(position) && !is_set(rate)
    }
}

/// Returns the inputs at the end of a step of this length (s).
///
/// Positions go on with their rate, and with half the square of the step times the rate's derivative where
/// that is known; rates go on with their derivative; other inputs are held, or go on with their derivative.
/// Where a rate is found from its position, both go on as the position has moved ([`continued`]).
pub(crate) fn end_of_step(
    entries: &[QuantityEntry],
    known: Known<'_>,
    step: f64,
    how: Understanding,
) -> Vec<f64> {
    let values = known.values;
    let slope = |index: usize| known.slopes.get(index).copied().flatten();
    let mut end: Vec<f64> = values
        .iter()
        .enumerate()
        .map(|(index, value)| match slope(index) {
            Some(slope) if !how.at_end => value + slope * step,
            _ => *value,
        })
        .collect();
    for (position, entry) in entries.iter().enumerate() {
        let Some(rate) = entry.rate else { continue };
        if how.derives(known.set, position, rate) {
            let ahead = if how.at_end { 0.0 } else { step };
            let line = |rate: f64| [values[position] + ahead * rate, rate];
            let given = slope(position).filter(|_| !how.at_end).map(line);
            [end[position], end[rate]] = given
                .or_else(|| continued(known, position, ahead))
                .unwrap_or_else(|| line(if how.derive_rates { 0.0 } else { values[rate] }));
        } else if !how.at_end {
            let bend = slope(rate).unwrap_or(0.0);
            end[position] = values[position] + step * (values[rate] + 0.5 * step * bend);
        }
    }
    end
}

/// Returns value and rate of a position that goes on for some time (s) as it has moved: along the parabola
/// through the last three points, whose bend is the smaller one of the last two, and none where these differ
/// in sign. So a jump does not swing back, and a smooth motion has an error of third order.
fn continued(known: Known<'_>, position: usize, ahead: f64) -> Option<[f64; 2]> {
    let earlier = |back: usize| {
        let point = known.past.get(known.past.len().checked_sub(back)?)?;
        Some((point.time, *point.inputs.get(position)?))
    };
    let (now, before) = ((known.time, *known.values.get(position)?), earlier(1)?);
    let slope = |(t1, z1): (f64, f64), (t0, z0): (f64, f64)| (z1 - z0) / (t1 - t0);
    let rate = slope(now, before);
    let bend = match (earlier(2), earlier(3)) {
        (Some(second), Some(third)) => {
            let middle = slope(before, second);
            let last = (rate - middle) / (now.0 - second.0);
            let previous = (middle - slope(second, third)) / (before.0 - third.0);
            if last * previous > 0.0 {
                last.signum() * last.abs().min(previous.abs())
            } else {
                0.0
            }
        }
        _ => 0.0,
    };
    let length = now.0 - before.0;
    Some([
        now.1 + ahead * (rate + (ahead + length) * bend),
        rate + (2.0 * ahead + length) * bend,
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entries() -> Vec<QuantityEntry> {
        let mut entries = vec![
            QuantityEntry::real("z", None, Some(0.0), ""),
            QuantityEntry::real("z_rate", None, Some(0.0), ""),
            QuantityEntry::real("k", None, Some(0.0), ""),
        ];
        entries[0].rate = Some(1);
        entries
    }

    /// Returns the inputs 0.5 s after the time 0.
    fn at_end(
        values: [f64; 3],
        slopes: [Option<f64>; 3],
        past: &[(f64, f64)],
        how: [bool; 2],
        set: [bool; 2],
    ) -> Vec<f64> {
        let how = Understanding {
            derive_rates: how[0],
            at_end: how[1],
        };
        let past = past.iter().map(|(time, z)| Point {
            time: *time,
            inputs: vec![*z, 99.0, 7.0],
        });
        let known = Known {
            time: 0.0,
            values: &values,
            slopes: &slopes,
            set: &[set[0], set[1], false],
            past: &past.collect::<Vec<_>>(),
        };
        end_of_step(&entries(), known, 0.5, how)
    }

    const BOTH: [bool; 2] = [true; 2];

    #[test]
    fn analytic_positions_go_on_with_their_rates() {
        assert_eq!(
            at_end([1.0, 2.0, 7.0], [None; 3], &[], [false; 2], BOTH),
            [2.0, 2.0, 7.0]
        );
        // z = 1 + 2 t + 3 t², whose rate's derivative is 6
        let slopes = [Some(2.0), Some(6.0), Some(-1.0)];
        assert_eq!(
            at_end([1.0, 2.0, 7.0], slopes, &[], [false; 2], BOTH),
            [2.75, 5.0, 6.5]
        );
    }

    #[test]
    fn analytic_rates_come_from_the_last_step_where_they_are_not_given() {
        let past = [(-0.25, 0.5)];
        let derives = [true, false];
        assert_eq!(
            at_end([1.0, 99.0, 7.0], [None; 3], &past, derives, BOTH),
            [2.0, 2.0, 7.0]
        );
        assert_eq!(
            at_end([1.0, 99.0, 7.0], [None; 3], &[], derives, BOTH),
            [1.0, 0.0, 7.0]
        );
        assert_eq!(
            at_end([1.0, 99.0, 7.0], [Some(3.0), None, None], &past, derives, BOTH),
            [2.5, 3.0, 7.0]
        );
    }

    #[test]
    fn issue_047_a_rate_that_is_never_set_comes_from_the_position() {
        let past = [(-0.25, 0.5)];
        let go =
            |past: &[(f64, f64)], set: [bool; 2]| at_end([1.0, 4.0, 7.0], [None; 3], past, [false; 2], set);
        assert_eq!(go(&past, [true, false]), [2.0, 2.0, 7.0]);
        // The rate of the initialization holds where nothing is known yet, or nothing is connected.
        assert_eq!(go(&[], [true, false]), [3.0, 4.0, 7.0]);
        assert_eq!(go(&past, [false, false]), [3.0, 4.0, 7.0]);
        assert_eq!(go(&past, BOTH), [3.0, 4.0, 7.0]);
    }

    #[test]
    fn analytic_a_parabola_goes_on_as_it_is_and_a_jump_does_not_swing_back() {
        // z = 1 + 2 t + 3 t², in steps of different lengths
        let z = |t: f64| 1.0 + t * (2.0 + 3.0 * t);
        let past = [-1.0, -0.5, -0.375].map(|t| (t, z(t)));
        let found = at_end([1.0, 0.0, 7.0], [None; 3], &past, [false; 2], [true, false]);
        assert_eq!(found, [2.75, 5.0, 7.0]);
        let found = at_end([1.0, 0.0, 7.0], [None; 3], &past, [false, true], [true, false]);
        assert_eq!(found, [1.0, 2.0, 7.0]);
        // At rest, then moved by 1: it goes on along the line, and stays once it stays.
        let jump = |past: [f64; 3]| {
            let past = [(-1.5, past[0]), (-1.0, past[1]), (-0.5, past[2])];
            at_end([1.0, 0.0, 7.0], [None; 3], &past, [false; 2], [true, false])
        };
        assert_eq!(jump([0.0, 0.0, 0.0]), [2.0, 2.0, 7.0]);
        assert_eq!(jump([0.0, 0.0, 1.0]), [1.0, 0.0, 7.0]);
    }

    #[test]
    fn limits_values_at_the_end_are_taken_as_they_are() {
        assert_eq!(
            at_end([1.0, 2.0, 7.0], [None; 3], &[], [false, true], BOTH),
            [1.0, 2.0, 7.0]
        );
        assert_eq!(
            at_end([1.0, 99.0, 7.0], [None; 3], &[(-0.5, 0.5)], [true; 2], BOTH),
            [1.0, 1.0, 7.0]
        );
    }
}
