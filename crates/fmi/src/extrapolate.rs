//! Extrapolation of inputs to the end of a communication step, from their values at its beginning.

use crate::element::QuantityEntry;

/// The interpretation of inputs of a communication step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Understanding {
    /// Rates of neighbours are found from their positions.
    pub derive_rates: bool,
    /// Inputs are those of the step's end, not of its beginning.
    pub at_end: bool,
}

/// The known values of the inputs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Known<'k> {
    /// Their values.
    pub values: &'k [f64],
    /// Their derivatives by time, where the importer has given them for this step.
    pub slopes: &'k [Option<f64>],
    /// Their values one communication step earlier, and its length (s); none in the first step.
    pub before: Option<(&'k [f64], f64)>,
}

/// Returns the inputs at the end of a step of this length (s).
///
/// Positions go on with their rate, and with half the square of the step times the rate's derivative where
/// that is known; rates go on with their derivative; other inputs are held, or go on with their derivative.
pub(crate) fn end_of_step(
    entries: &[QuantityEntry],
    known: Known<'_>,
    step: f64,
    how: Understanding,
) -> Vec<f64> {
    let Known {
        values,
        slopes,
        before,
    } = known;
    let slope = |index: usize| slopes.get(index).copied().flatten();
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
        let change = before.map(|(before, length)| (values[position] - before[position], length));
        match (how.derive_rates, how.at_end) {
            // Positions and rates as given.
            (false, true) => {}
            // The mean rate of the step that is being made.
            (true, true) => end[rate] = change.map_or(0.0, |(change, _)| change / step),
            (false, false) => {
                let bend = slope(rate).unwrap_or(0.0);
                end[position] = values[position] + step * (values[rate] + 0.5 * step * bend);
            }
            (true, false) => {
                let mean =
                    slope(position).unwrap_or_else(|| change.map_or(0.0, |(change, length)| change / length));
                end[position] = values[position] + step * mean;
                end[rate] = mean;
            }
        }
    }
    end
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

    fn at_end(
        values: [f64; 3],
        slopes: [Option<f64>; 3],
        before: Option<[f64; 3]>,
        how: [bool; 2],
    ) -> Vec<f64> {
        let how = Understanding {
            derive_rates: how[0],
            at_end: how[1],
        };
        let known = Known {
            values: &values,
            slopes: &slopes,
            before: before.as_ref().map(|before| (&before[..], 0.25)),
        };
        end_of_step(&entries(), known, 0.5, how)
    }

    #[test]
    fn analytic_positions_go_on_with_their_rates() {
        assert_eq!(
            at_end([1.0, 2.0, 7.0], [None; 3], None, [false; 2]),
            [2.0, 2.0, 7.0]
        );
        // z = 1 + 2 t + 3 t², whose rate's derivative is 6
        assert_eq!(
            at_end(
                [1.0, 2.0, 7.0],
                [Some(2.0), Some(6.0), Some(-1.0)],
                None,
                [false; 2]
            ),
            [2.75, 5.0, 6.5]
        );
    }

    #[test]
    fn analytic_rates_come_from_the_last_step_where_they_are_not_given() {
        let before = Some([0.5, 99.0, 7.0]);
        assert_eq!(
            at_end([1.0, 99.0, 7.0], [None; 3], before, [true, false]),
            [2.0, 2.0, 7.0]
        );
        assert_eq!(
            at_end([1.0, 99.0, 7.0], [None; 3], None, [true, false]),
            [1.0, 0.0, 7.0]
        );
        assert_eq!(
            at_end([1.0, 99.0, 7.0], [Some(3.0), None, None], before, [true, false]),
            [2.5, 3.0, 7.0]
        );
    }

    #[test]
    fn limits_values_at_the_end_are_taken_as_they_are() {
        assert_eq!(
            at_end([1.0, 2.0, 7.0], [None; 3], None, [false, true]),
            [1.0, 2.0, 7.0]
        );
        let before = Some([0.5, 99.0, 7.0]);
        assert_eq!(
            at_end([1.0, 99.0, 7.0], [None; 3], before, [true, true]),
            [1.0, 1.0, 7.0]
        );
    }
}
