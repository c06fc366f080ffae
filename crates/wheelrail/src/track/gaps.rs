//! Gaps of a recording, filled by the natural cubic spline through what was measured.
//!
//! Optics of measuring cars drop out at low speed or in dirt: cells without a number, or rows that are not
//! there. A spline across a gap of length g knows nothing of waves shorter than 2 g. Gaps are filled up to a
//! length that the user may state; [`LONGEST_GAP`] otherwise, half of the shortest wavelength that EN 13848-1
//! asks for (3 m, remembered) to the next foot.

use std::fmt;

use quantity::SixDigits;

use super::samples::{natural_spline, piece};

/// Length up to which gaps are filled where nothing else is stated, m: 5 ft.
pub const LONGEST_GAP: f64 = 5.0 * 0.3048;
/// Rows that are farther apart than this many times the usual distance have others missing between them.
const JUMP: f64 = 1.5;
/// Relative tolerance of the usual distance, and the part of all rows that keep it in a regular recording.
const REGULAR: [f64; 2] = [0.1, 0.9];

/// Rows without a number, between two that have one.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// The table's column; `distance` where whole rows are not there.
    pub column: &'static str,
    /// The number of rows without a number.
    pub rows: usize,
    /// The distances of the rows beside it, m.
    pub between: [f64; 2],
    /// The lines of these rows in the file, from 1, in its order.
    pub lines: [usize; 2],
}

impl Gap {
    /// Returns its length, m: from the last number before it to the first one after it.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.between[1] - self.between[0]
    }
}

impl fmt::Display for Gap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [from, to] = self.between.map(SixDigits);
        let rows = if self.rows == 1 { "row" } else { "rows" };
        let missing = match self.column {
            "distance" => "not there".to_owned(),
            column => format!("without {column}"),
        };
        write!(f, "{} {rows} {missing} between {from} m and {to} m", self.rows)?;
        write!(f, " (lines {} and {})", self.lines[0], self.lines[1])
    }
}

fn in_order([one, other]: [usize; 2]) -> [usize; 2] {
    [one.min(other), one.max(other)]
}

/// Returns the usual distance from row to row (m) of a regular recording.
pub(super) fn usual_step(distances: &[f64]) -> Option<f64> {
    let steps: Vec<f64> = distances.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mut sorted = steps.clone();
    sorted.sort_by(f64::total_cmp);
    let usual = *sorted.get(sorted.len() / 2)?;
    let [tolerance, part] = REGULAR;
    let regular = steps
        .iter()
        .filter(|step| (*step / usual - 1.0).abs() < tolerance);
    (regular.count() as f64 >= part * steps.len() as f64).then_some(usual)
}

/// Returns where rows of a regular recording are not there.
pub(super) fn missing_rows(distances: &[f64], lines: &[usize]) -> Vec<Gap> {
    let Some(usual) = usual_step(distances) else {
        return Vec::new();
    };
    let pairs = distances.windows(2).zip(lines.windows(2));
    let jumps = pairs.filter(|(pair, _)| pair[1] - pair[0] > JUMP * usual);
    jumps
        .map(|(pair, lines)| Gap {
            column: "distance",
            rows: ((pair[1] - pair[0]) / usual).round() as usize - 1,
            between: [pair[0], pair[1]],
            lines: in_order([lines[0], lines[1]]),
        })
        .collect()
}

/// Fills the rows of a column that are NaN and returns where they were. Rows before the first number and
/// after the last one stay NaN.
pub(super) fn fill(column: &'static str, distances: &[f64], lines: &[usize], values: &mut [f64]) -> Vec<Gap> {
    if values.iter().all(|value| value.is_finite()) {
        return Vec::new();
    }
    let known: Vec<usize> = (0..values.len()).filter(|&row| values[row].is_finite()).collect();
    if known.is_empty() {
        return Vec::new();
    }
    let x: Vec<f64> = known.iter().map(|&row| distances[row]).collect();
    let y: Vec<f64> = known.iter().map(|&row| values[row]).collect();
    let seconds = natural_spline(&x, &y);
    let mut gaps = Vec::new();
    for (k, pair) in known.windows(2).enumerate() {
        for row in pair[0] + 1..pair[1] {
            let of = |own: &[f64]| [own[k], own[k + 1]];
            values[row] = piece(of(&x), of(&y), of(&seconds), distances[row])[0];
        }
        if pair[1] - pair[0] > 1 {
            gaps.push(Gap {
                column,
                rows: pair[1] - pair[0] - 1,
                between: [x[k], x[k + 1]],
                lines: in_order([lines[pair[0]], lines[pair[1]]]),
            });
        }
    }
    gaps
}
