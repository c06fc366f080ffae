//! Wear of wedges in numbers for owners.

use std::collections::BTreeMap;

use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};
use wedge::parameters::Wear;

use super::{FacePace, OfFace, SQUARE, WedgeLaw, WedgesWork};
use crate::damage::of_service;
use crate::summary::SummaryValue;

/// Wear of the wedges by a run, again and again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WedgesWorn {
    /// The distance, or the number of cycles, that the depths are worn in.
    pub over: SummaryValue,
    /// Wedges by their names.
    pub wedges: BTreeMap<String, WedgeWorn>,
}

/// Wear of a wedge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WedgeWorn {
    /// At the column.
    pub column: FaceWorn,
    /// At the slope.
    pub slope: FaceWorn,
    /// What the mean depths of both partners make the wedge rise.
    pub rise: SummaryValue,
}

/// Wear of a wedge's face.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FaceWorn {
    /// Mean depth that the wedge's face loses.
    pub mean_depth: SummaryValue,
    /// The largest depth of a point by its mean: 1 is even wear.
    pub unevenness: f64,
    /// Mean normal force where it slides.
    pub force: SummaryValue,
    /// Shares of the face's points in the energy, in the order of its grid.
    pub shares: Vec<f64>,
    /// How far the face is moved over its counterface: up, across, share of the energy.
    pub moved: Vec<[f64; 3]>,
}

/// The distance or the number of cycles of a summary.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Over {
    /// A distance, m.
    Distance(f64),
    /// A number of cycles of a period, s.
    Cycles(f64, f64),
}

impl WedgesWork {
    /// Returns the summary; none before something has moved.
    pub(crate) fn summary(&self, law: &WedgeLaw, (over, units): (&Over, Units)) -> Option<WedgesWorn> {
        let [time, way] = self.passed;
        let (times, shown) = match over {
            Over::Distance(own) => (own / way, of_service(*own, units)),
            Over::Cycles(count, period) => {
                let unit = "cycles".to_owned();
                (count * period / time, SummaryValue { value: *count, unit })
            }
        };
        if !times.is_finite() || self.wedges.is_empty() {
            return None;
        }
        let wedges = self.wedges.iter().map(|wedge| {
            let depths = wedge.faces.each_ref().map(|face| {
                let energy = times * face.work.energy();
                face.plan.depth(law, energy)
            });
            let both = depths.map(|own| (1.0 + law.counterface) * own);
            let rise = Wear {
                column: both[0],
                slope: both[1],
            }
            .rise(wedge.angles);
            let [column, slope] = [0, 1].map(|face| worn(&wedge.faces[face], depths[face], units));
            let rise = SummaryValue::new(rise, Kind::Length, units);
            (wedge.name.clone(), WedgeWorn { column, slope, rise })
        });
        Some(WedgesWorn {
            over: shown,
            wedges: wedges.collect(),
        })
    }
}

fn worn(face: &OfFace, mean: f64, units: Units) -> FaceWorn {
    let work = &face.work;
    let sum: f64 = work.points.iter().sum();
    let part = if sum > 0.0 { 1.0 / sum } else { 0.0 };
    let shares: Vec<f64> = work.points.iter().map(|own| own * part).collect();
    let square = SQUARE * Kind::Length.from_si(units);
    let moved = work
        .moved
        .iter()
        .map(|([up, across], own)| [f64::from(*up) * square, f64::from(*across) * square, own * part]);
    let most = shares
        .iter()
        .zip(&face.plan.weights)
        .map(|(own, weight)| own / weight);
    FaceWorn {
        mean_depth: SummaryValue::new(mean, Kind::Length, units),
        unevenness: most.fold(0.0, f64::max),
        force: SummaryValue::new(work.force * part, Kind::Force, units),
        shares,
        moved: moved.collect(),
    }
}

impl FaceWorn {
    /// Hands what it says of a share of its distance or cycles to a function.
    pub(crate) fn pace<T>(&self, share: f64, units: Units, take: impl FnOnce(&FacePace<'_>) -> T) -> T {
        let length = Kind::Length.from_si(units);
        let moved: Vec<[f64; 3]> = self
            .moved
            .iter()
            .map(|[up, across, own]| [up / length, across / length, *own])
            .collect();
        take(&FacePace {
            mean: share * self.mean_depth.value / length,
            force: self.force.value / Kind::Force.from_si(units),
            shares: &self.shares,
            moved: &moved,
        })
    }
}
