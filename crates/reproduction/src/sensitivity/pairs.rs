//! Pairs of parameters that decide together.
//!
//! Points are divided in four by a cut of each of two parameters, with the cuts of [`super::split`]. With
//! shares p of the points in a quarter, s_q of them where a statement holds, and s of all points, the two
//! cuts together *explain*
//!
//! ```text
//! η² = Σ p (s_q - s)² / (s (1 - s))
//! ```
//!
//! of the variance of holding. A pair decides a statement where this exceeds what any single cut of any
//! parameter explains (φ²) by more than chance: n (η² - φ²) is about chi-squared of two degrees of freedom
//! for n points where the second cut says nothing, and the best of some 300 pairs of cuts passes 24 in fewer
//! than one of a hundred such statements. Of all pairs of cuts the one that explains most stands for the
//! statement.

use serde::Serialize;

use super::space::{Cut, Space};

/// Least n (η² - φ²) of a pair that decides.
const CHANCE: f64 = 24.0;

/// Two cuts that together tell where a statement holds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Pair {
    /// The parameters' names.
    pub parameters: [&'static str; 2],
    /// The sides of both cuts.
    pub sides: [[String; 2]; 2],
    /// The share of points where the statement holds, by side of the first and of the second cut.
    pub shares: [[f64; 2]; 2],
    /// η², the share of the variance that they explain.
    pub explains: f64,
    /// φ² of the best single cut.
    pub alone: f64,
}

/// A pair of parameters, with the statements that it decides.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PairShown {
    /// The parameters' names.
    pub parameters: [&'static str; 2],
    /// Ids of the statements that it decides; the one that it explains best comes first.
    pub statements: Vec<&'static str>,
    /// Its cuts for that one.
    pub best: Pair,
}

/// Numbers of points and of those that hold, by side of two cuts.
type Quarters = [[[usize; 2]; 2]; 2];

/// Returns the pair of cuts that decides; `None` if a single cut explains as much but for chance. `holds` has
/// for each point that decides the statement its number and whether it holds there; `alone` is φ² of the best
/// single cut.
#[must_use]
pub fn deciding(space: &Space, holds: &[(u64, bool)], alone: f64) -> Option<Pair> {
    let all = holds.len() as f64;
    let share = holds.iter().filter(|(_, holds)| *holds).count() as f64 / all;
    let variance = share * (1.0 - share);
    let cuts: Vec<(usize, Cut)> = (0..space.parameters.len())
        .flat_map(|place| {
            space.parameters[place]
                .cuts()
                .into_iter()
                .map(move |cut| (place, cut))
        })
        .collect();
    // On which side of each cut each point is.
    let sides: Vec<Vec<usize>> = holds
        .iter()
        .map(|(point, _)| {
            let at = space.coordinates(*point);
            let side = |(place, cut): &(usize, Cut)| {
                usize::from(!space.parameters[*place].is_first(*cut, at[*place]))
            };
            cuts.iter().map(side).collect()
        })
        .collect();
    let mut best: Option<(f64, usize, usize, Quarters)> = None;
    for (first, (place, _)) in cuts.iter().enumerate() {
        for (second, _) in cuts.iter().enumerate().filter(|(_, (other, _))| other > place) {
            let mut quarters: Quarters = [[[0; 2]; 2]; 2];
            for (sides, (_, holds)) in sides.iter().zip(holds) {
                let own = &mut quarters[sides[first]][sides[second]];
                own[0] += 1;
                own[1] += usize::from(*holds);
            }
            let own = quarters.iter().flatten().filter(|[decided, _]| *decided > 0);
            let explains = own
                .map(|[decided, hold]| {
                    let (decided, hold) = (*decided as f64, *hold as f64);
                    decided / all * (hold / decided - share).powi(2)
                })
                .sum::<f64>()
                / variance;
            // A share of 0 or 1 explains nothing, and is no number here.
            if (explains - alone) * all >= CHANCE && best.as_ref().is_none_or(|best| explains > best.0) {
                best = Some((explains, first, second, quarters));
            }
        }
    }
    let (explains, first, second, quarters) = best?;
    let chosen = [first, second].map(|number| cuts[number]);
    Some(Pair {
        parameters: chosen.map(|(place, _)| space.parameters[place].name),
        sides: chosen.map(|(place, cut)| space.parameters[place].sides(cut)),
        shares: quarters.map(|row| row.map(|[decided, hold]| hold as f64 / decided as f64)),
        explains,
        alone,
    })
}

/// Gathers the pairs of statements by their parameters, those that decide most first.
#[must_use]
pub fn gathered(found: Vec<(&'static str, Pair)>) -> Vec<PairShown> {
    let mut all: Vec<PairShown> = Vec::new();
    for (statement, pair) in found {
        match all.iter_mut().find(|own| own.parameters == pair.parameters) {
            None => all.push(PairShown {
                parameters: pair.parameters,
                statements: vec![statement],
                best: pair,
            }),
            Some(own) if pair.explains > own.best.explains => {
                own.statements.insert(0, statement);
                own.best = pair;
            }
            Some(own) => own.statements.push(statement),
        }
    }
    all.sort_by_key(|own| std::cmp::Reverse(own.statements.len()));
    all
}
