//! The number of statements that hold over the contact stiffness, and the rule that chooses it.
//!
//! The thesis gives no contact stiffness. *Required* are the statements of [`REQUIRED`], and that runs stay
//! within the axes of the thesis's figures ([`AXES`]). *The rule*: of five equal parts of the range (each a
//! factor of 2.5), the default is the middle of the part in which most of what is required holds, over all
//! else that is open; of parts that do not differ in that, the part in which most statements hold. *Differ*
//! means by more than two standard errors of the difference of the means. The middle part, whose middle is
//! the comparison program's stiffness, is left for another part only if that is better in this sense: it is
//! the one stiffness with a source.

use std::collections::BTreeMap;
use std::ops::Range;

use serde::Serialize;

use super::axes::AXES;
use super::point::PointOutcome;
use super::space::{PointPlace, STIFFNESS, Space};
use crate::claims::{ClaimVerdict, REQUIRED, claims};

/// Parts of the range.
const PARTS: usize = 5;
/// The part whose middle is the comparison program's.
const MIDDLE: usize = PARTS / 2;

/// A mean with its standard error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Mean {
    /// The mean.
    pub mean: f64,
    /// Its standard error.
    pub error: f64,
}

impl Mean {
    /// Makes it of some values; `None` below two of them.
    fn of(values: &[f64]) -> Option<Self> {
        let count = values.len() as f64;
        if count < 2.0 {
            return None;
        }
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
        let error = (squares / (count - 1.0) / count).sqrt();
        Some(Self { mean, error })
    }

    /// Returns whether it is greater than another by more than two standard errors of the difference.
    fn exceeds(self, other: Self) -> bool {
        self.mean - other.mean > 2.0 * self.error.hypot(other.error)
    }
}

/// A stiffness, all else as decided.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Alone {
    /// Contact stiffness a corner, lbf/in.
    pub stiffness: f64,
    /// Statements that hold.
    pub holds: usize,
    /// The requirements that hold.
    pub required: usize,
}

/// A part of the range, over all else that is open.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StiffnessPart {
    /// From and to this stiffness a corner, lbf/in.
    pub stiffness: [f64; 2],
    /// Points in it.
    pub points: usize,
    /// Statements that hold.
    pub holds: Mean,
    /// The requirements that hold.
    pub required: Mean,
}

/// The statements that hold over the contact stiffness.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OfStiffness {
    /// Numbers of requirements: statements and axes.
    pub of_required: usize,
    /// Stiffness by stiffness, all else as decided.
    pub alone: Vec<Alone>,
    /// Parts of the range; empty with too few points.
    pub parts: Vec<StiffnessPart>,
    /// The part that the rule chooses.
    pub chosen: Option<usize>,
}

/// Returns the part that the rule chooses.
fn choose(parts: &[StiffnessPart]) -> Option<usize> {
    let middle = parts.get(MIDDLE)?;
    let is_better = |one: &StiffnessPart, other: &StiffnessPart| {
        let worse = other.required.exceeds(one.required);
        one.required.exceeds(other.required) || (!worse && one.holds.exceeds(other.holds))
    };
    let better = parts
        .iter()
        .enumerate()
        .filter(|(_, part)| is_better(part, middle));
    let best = better.reduce(|best, next| {
        let exceeds = next.1.required.exceeds(best.1.required);
        let equal = !best.1.required.exceeds(next.1.required);
        if exceeds || (equal && next.1.holds.mean > best.1.holds.mean) {
            next
        } else {
            best
        }
    });
    Some(best.map_or(MIDDLE, |(number, _)| number))
}

/// Returns the outcome of these points.
pub(super) fn of_stiffness(
    space: &Space,
    points: Range<u64>,
    found: &BTreeMap<PointPlace, PointOutcome>,
) -> OfStiffness {
    let required: Vec<bool> = claims().map(|claim| REQUIRED.contains(&claim.id)).collect();
    let counts = |found: &PointOutcome| {
        let axes = found.axes.iter().filter(|within| **within).count();
        let holds = found.verdicts.iter().zip(&required);
        let holds = holds.filter(|(verdict, _)| **verdict == ClaimVerdict::Holds);
        holds.fold((0, axes), |(all, needed), (_, required)| {
            (all + 1, needed + usize::from(*required))
        })
    };
    let alone = space.places(0).into_iter().filter_map(|place| {
        let PointPlace::Stiffness(_) = place else {
            return None;
        };
        let (holds, required) = counts(found.get(&place)?);
        let stiffness = space.stiffness(place)?;
        Some(Alone {
            stiffness,
            holds,
            required,
        })
    });
    let part = |number: usize| {
        let ends = [number, number + 1].map(|end| end as f64 / PARTS as f64);
        let own = points.clone().filter(|point| {
            let coordinate = space.coordinates(*point)[STIFFNESS];
            (ends[0]..ends[1]).contains(&coordinate)
        });
        let counted = own.filter_map(|point| found.get(&PointPlace::Space(point)).map(counts));
        let (all, needed): (Vec<f64>, Vec<f64>) = counted
            .map(|(holds, required)| (holds as f64, required as f64))
            .unzip();
        let factor = &space.parameters[STIFFNESS].factor;
        Some(StiffnessPart {
            stiffness: ends.map(|end| factor.at(end).in_unit("lbf/in").unwrap_or(f64::NAN)),
            points: all.len(),
            holds: Mean::of(&all)?,
            required: Mean::of(&needed)?,
        })
    };
    let parts: Vec<StiffnessPart> = (0..PARTS).map(part).collect::<Option<_>>().unwrap_or_default();
    OfStiffness {
        of_required: REQUIRED.len() + AXES.len(),
        alone: alone.collect(),
        chosen: choose(&parts),
        parts,
    }
}
