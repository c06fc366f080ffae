//! The parameter that decides.
//!
//! Points are divided in two by one parameter: a range at a quarter, the half or three quarters of it,
//! choices one against the others. With shares p₁, p₂ of the points on the two sides, shares s₁, s₂ of them
//! where a statement holds, and s of all points, the cut *explains*
//!
//! ```text
//! φ² = p₁ p₂ (s₁ - s₂)² / (s (1 - s))
//! ```
//!
//! of the variance of holding (the square of the correlation of two yes-or-no quantities): 1 if the cut tells
//! exactly where the statement holds, 0 if it says nothing. The cut that explains most decides, if it
//! explains more than chance would: n φ² is about chi-squared of one degree of freedom for n points without
//! any connection, and the best of some fifteen cuts passes 12 in fewer than one of a hundred such
//! statements.
//!
//! Defect: one cut of one parameter. A statement that hangs on two parameters together, or on the middle of a
//! range, is said to hang on less than it does.

use serde::Serialize;

use super::space::Space;

/// Least n φ² of a cut that decides.
const CHANCE: f64 = 12.0;

/// A side of a cut.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Side {
    /// The name of the points: `below 2.5e5 lbf/in`, `through the seat`.
    pub name: String,
    /// Points of it that decide the statement.
    pub decided: usize,
    /// Share of them where it holds.
    pub share: f64,
}

/// The cut that tells best where a statement holds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Split {
    /// The parameter's name.
    pub parameter: &'static str,
    /// Both sides, the one where the statement holds more often first.
    pub sides: [Side; 2],
    /// φ², the share of the variance that it explains.
    pub explains: f64,
}

/// Returns the cut that decides; `None` if the statement holds at all or at no points, or no cut explains
/// more than chance. `holds` has for each point that decides the statement its number and whether it holds
/// there.
#[must_use]
pub fn deciding(space: &Space, holds: &[(u64, bool)]) -> Option<Split> {
    let all = holds.len() as f64;
    let share = holds.iter().filter(|(_, holds)| *holds).count() as f64 / all;
    let points: Vec<(Vec<f64>, bool)> = holds
        .iter()
        .map(|(point, holds)| (space.coordinates(*point), *holds))
        .collect();
    let mut best: Option<Split> = None;
    for (dimension, parameter) in space.parameters.iter().enumerate() {
        for cut in parameter.cuts() {
            let names = parameter.sides(cut);
            let mut counts = [[0_usize; 2]; 2];
            for (coordinates, holds) in &points {
                let side = usize::from(!parameter.is_first(cut, coordinates[dimension]));
                counts[side][0] += 1;
                counts[side][1] += usize::from(*holds);
            }
            if counts.iter().any(|[decided, _]| *decided == 0) {
                continue;
            }
            let shares = counts.map(|[decided, hold]| hold as f64 / decided as f64);
            let parts = counts.map(|[decided, _]| decided as f64 / all);
            let difference = shares[0] - shares[1];
            let explains = parts[0] * parts[1] * difference * difference / (share * (1.0 - share));
            // A share of 0 or 1 explains nothing, and is no number here.
            let is_better = best.as_ref().is_none_or(|best| explains > best.explains);
            if explains * all >= CHANCE && is_better {
                let [first, second] = names;
                let side = |name: String, index: usize| Side {
                    name,
                    decided: counts[index][0],
                    share: shares[index],
                };
                let mut sides = [side(first, 0), side(second, 1)];
                if difference < 0.0 {
                    sides.reverse();
                }
                best = Some(Split {
                    parameter: parameter.name,
                    sides,
                    explains,
                });
            }
        }
    }
    best
}
