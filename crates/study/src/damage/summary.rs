//! Damage of wheels and rails in numbers for owners: by distance, by tonnage, over the profiles.

use std::collections::BTreeMap;

use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use wheelrail::damage::{Dose, Surface};

use super::{Damage, SERVICE, SIDES};
use crate::summary::SummaryValue;

/// Density of steel, kg/m³.
const STEEL: f64 = 7850.0;
/// The tonnage of rails' numbers: 1,000,000 gross tons of 2,000 lb, N.
const OF_RAILS: f64 = 1e6 * 2000.0 * 4.448_221_615_260_5;
/// Places with less than this share of the largest depth are left out.
const SEEN: f64 = 1e-4;

/// Damage of wheels and rails in a run after it has settled.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DamageSummary {
    /// The distance.
    pub distance: SummaryValue,
    /// What creep takes by the distance, all wheels.
    pub creep_resistance: SummaryValue,
    /// Wheels by their names, such as `axle_1_left`: over 100,000 miles.
    pub wheels: BTreeMap<String, WheelDamage>,
    /// Rails, `left` and `right`: over 1,000,000 gross tons.
    pub rails: BTreeMap<String, RailDamage>,
}

/// Damage of a wheel over 100,000 miles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WheelDamage {
    /// The mean wear number.
    pub wear_number: SummaryValue,
    /// Worn mass of steel.
    pub worn_mass: SummaryValue,
    /// The largest depth on the profile, and where it is.
    pub largest_depth: SummaryValue,
    /// Its place on the profile, from the tape circle to the field side.
    pub place: SummaryValue,
    /// Damage by rolling contact fatigue where it is largest, 1e-5 of the life.
    pub fatigue: f64,
    /// Over the profile.
    pub profile: Vec<PlaceDamage>,
}

/// Damage of a rail over 1,000,000 gross tons.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RailDamage {
    /// The mean wear number of a wheel.
    pub wear_number: SummaryValue,
    /// Worn area of the section, as a depth over 1 in (25.4 mm).
    pub worn_over_an_inch: SummaryValue,
    /// The largest depth on the profile, and where it is.
    pub largest_depth: SummaryValue,
    /// Its place on the profile, from its origin to the field side.
    pub place: SummaryValue,
    /// Damage by rolling contact fatigue where it is largest, 1e-5 of the life.
    pub fatigue: f64,
    /// Over the profile.
    pub profile: Vec<PlaceDamage>,
}

/// Damage at a place of a profile.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlaceDamage {
    /// The place, to the field side.
    pub y: f64,
    /// Depth.
    pub depth: f64,
    /// Damage by rolling contact fatigue, 1e-5 of the life.
    pub fatigue: f64,
}

/// Returns a way of service (m) in miles or kilometers.
pub(crate) fn of_service(si: f64, units: Units) -> SummaryValue {
    let (unit, name) = match units {
        Units::Us => (1_609.344, "mi"),
        Units::Si => (1e3, "km"),
    };
    SummaryValue {
        value: si / unit,
        unit: name.to_owned(),
    }
}

/// What damage is weighed by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighed {
    /// Weight of the vehicle, N.
    pub weight: f64,
    /// Units of the numbers.
    pub units: Units,
}

/// The largest depth (m) with its place (m), the largest fatigue, and all places.
struct OnProfile {
    largest: [f64; 2],
    fatigue: f64,
    all: Vec<PlaceDamage>,
}

/// Returns the damage over a profile, of places whose depth (m) is `by_volume` times the volume and whose
/// fatigue is `by_fatigue` times that of the place's patches.
fn over(surface: &Surface, [by_volume, by_fatigue]: [f64; 2], units: Units) -> OnProfile {
    let length = Kind::Length.from_si(units);
    let depth = |dose: &Dose| dose.square * by_volume;
    let each = || surface.middles().zip(&surface.places);
    let largest = each().fold([0.0, 0.0], |most: [f64; 2], (y, own)| {
        let found = depth(own);
        if found > most[0] { [found, y] } else { most }
    });
    let fatigue = each().map(|(_, own)| own.fatigue * by_fatigue);
    let fatigue = fatigue.fold(0.0, f64::max);
    let seen = each().filter(|(_, own)| depth(own) > SEEN * largest[0] || own.fatigue != 0.0);
    let all = seen.map(|(y, own)| PlaceDamage {
        y: y * length,
        depth: depth(own) * length,
        fatigue: own.fatigue * by_fatigue,
    });
    OnProfile {
        largest,
        fatigue,
        all: all.collect(),
    }
}

impl Damage {
    /// Returns the summary; none before a distance is made.
    #[must_use]
    pub fn summary(&self, weighed: Weighed) -> Option<DamageSummary> {
        let Weighed { weight, units } = weighed;
        if !(self.distance > 0.0 && weight > 0.0) {
            return None;
        }
        let value = |own: f64, kind: Kind| SummaryValue::new(own, kind, units);
        let times = SERVICE / self.distance;
        let wheels = self.wheels.iter().flatten().map(|own| {
            let sum = own.surface.sum();
            let round = TAU * own.radius;
            let on = over(&own.surface, [times * own.depth(1.0), times / round], units);
            let damage = WheelDamage {
                wear_number: value(sum.energy / self.distance, Kind::Force),
                worn_mass: value(times * sum.volume * STEEL, Kind::Mass),
                largest_depth: value(on.largest[0], Kind::Length),
                place: value(on.largest[1], Kind::Length),
                fatigue: on.fatigue,
                profile: on.all,
            };
            (own.name.clone(), damage)
        });
        let passages = OF_RAILS / weight;
        let axles = self.wheels.len().max(1) as f64;
        let rails = SIDES.into_iter().zip(&self.rails).map(|(side, own)| {
            let sum = own.sum();
            let by_volume = passages / (self.distance * own.width());
            let on = over(own, [by_volume, passages / self.distance], units);
            let damage = RailDamage {
                wear_number: value(sum.energy / (self.distance * axles), Kind::Force),
                worn_over_an_inch: value(passages * sum.volume / (self.distance * 0.0254), Kind::Length),
                largest_depth: value(on.largest[0], Kind::Length),
                place: value(on.largest[1], Kind::Length),
                fatigue: on.fatigue,
                profile: on.all,
            };
            (side.to_owned(), damage)
        });
        Some(DamageSummary {
            distance: value(self.distance, Kind::Distance),
            creep_resistance: value(self.resistance(), Kind::Force),
            wheels: wheels.collect(),
            rails: rails.collect(),
        })
    }
}
