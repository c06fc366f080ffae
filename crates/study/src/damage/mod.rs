//! Damage of wheels and rails over a run: wear, rolling contact fatigue, and where it is on the profiles.
//!
//! Every row after the start has settled stands for the time since the row before it. Patches give the power
//! of creep, normal force, pressure, friction and place; the laws are those of [`wheelrail::damage`].
//!
//! A wheel's damage is the mean round its tread, a rail's the mean along the track: the depth, along the
//! normal, is the volume by the width of the place on the profile and by the circumference, or by the
//! distance.
//!
//! Limits: patches are Hertz's ellipses for their pressure; profiles do not wear within a run.

mod keys;
mod summary;

use rolling::wheel::PatchState;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use wheelrail::damage::{DamageFunction, Dose, Surface, WearMap};

use crate::wear::mounted::WedgeLaw;

pub(crate) use keys::{read, read_of_wedges};
pub(crate) use summary::of_service;
pub use summary::{DamageSummary, PlaceDamage, RailDamage, Weighed, WheelDamage};

/// The distance of the numbers of wheels and wedges: 100,000 miles, m.
pub const SERVICE: f64 = 1e5 * 1_609.344;
/// Width of the places of a profile, m.
pub const PLACE: f64 = 1e-3;
const SIDES: [&str; 2] = ["left", "right"];

/// The laws of damage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DamageLaws {
    /// Wear of wheels and rails.
    pub wear: WearMap,
    /// Rolling contact fatigue.
    pub fatigue: DamageFunction,
    /// Wear of wedges.
    pub wedges: WedgeLaw,
}

/// Damage of a wheel.
#[derive(Clone, Debug, PartialEq)]
pub struct OfWheel {
    /// Its name, such as `axle_1_left`.
    pub name: String,
    /// Its nominal radius, m.
    pub radius: f64,
    /// Over its profile.
    pub surface: Surface,
}

/// What wheels and rails take in a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Damage {
    laws: DamageLaws,
    /// Wheels, left and right of each wheelset.
    pub wheels: Vec<[OfWheel; 2]>,
    /// Rails, left and right, by all wheels.
    pub rails: [Surface; 2],
    /// Distance, m.
    pub distance: f64,
}

/// Sums of damage, as saved with a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SavedDamage {
    distance: f64,
    sums: Vec<[f64; 4]>,
}

impl Damage {
    /// Returns none, of wheels by names, radii and ranges of profiles (m), on rails of ranges (m).
    #[must_use]
    pub fn new(laws: DamageLaws, wheels: Vec<[(String, f64, [f64; 2]); 2]>, rails: [[f64; 2]; 2]) -> Self {
        let of_wheel = |(name, radius, range): (String, f64, [f64; 2])| OfWheel {
            name,
            radius,
            surface: Surface::new(range, PLACE),
        };
        Self {
            laws,
            wheels: wheels.into_iter().map(|pair| pair.map(of_wheel)).collect(),
            rails: rails.map(|range| Surface::new(range, PLACE)),
            distance: 0.0,
        }
    }

    /// Takes a way (m) along the track along.
    pub fn go(&mut self, way: f64) {
        self.distance += way.abs();
    }

    /// Takes a patch along, of a wheel on a side (left 0, right 1), that stands for a time (s) and a way (m).
    pub fn take(&mut self, (wheelset, side): (usize, usize), seen: &PatchState, (time, way): (f64, f64)) {
        let (patch, forces) = (&seen.patch, &seen.forces);
        let normal = forces.normal * patch.share;
        let [along, across] = forces.axes;
        if !(normal > 0.0 && along > 0.0 && across > 0.0) {
            return;
        }
        let pressure = seen.greatest_pressure;
        let power = seen.power();
        let volume = time * self.laws.wear.rate(power, normal, pressure, seen.friction);
        // Across the track the patch is as wide as it is seen from above.
        let half = across * patch.cosine;
        let dose = Dose {
            volume,
            square: volume * patch.cosine,
            energy: time * power,
            fatigue: way.abs() * self.laws.fatigue.at(seen.wear_number),
        };
        // Fatigue is that of a place which patches pass: in the middle of a patch the whole of it.
        let passing = |own: &Surface| Dose {
            fatigue: dose.fatigue * 4.0 * half / (3.0 * own.width()),
            ..dose
        };
        let on_wheel = &mut self.wheels[wheelset][side].surface;
        on_wheel.add(patch.profile, half, &passing(on_wheel));
        let on_rail = &mut self.rails[side];
        on_rail.add(patch.place[1], half, &passing(on_rail));
    }

    /// Returns its sums.
    #[must_use]
    pub fn saved(&self) -> SavedDamage {
        let places = self.surfaces().flat_map(|own| &own.places);
        SavedDamage {
            distance: self.distance,
            sums: places
                .map(|own| [own.volume, own.square, own.energy, own.fatigue])
                .collect(),
        }
    }

    fn surfaces(&self) -> impl Iterator<Item = &Surface> {
        let wheels = self.wheels.iter().flatten().map(|own| &own.surface);
        wheels.chain(&self.rails)
    }

    /// Goes on from saved sums; returns false if they are those of other profiles.
    pub fn restore(&mut self, saved: &SavedDamage) -> bool {
        let count: usize = self.surfaces().map(|own| own.places.len()).sum();
        if saved.sums.len() != count {
            return false;
        }
        let wheels = self.wheels.iter_mut().flatten().map(|own| &mut own.surface);
        let places = wheels.chain(&mut self.rails).flat_map(|own| &mut own.places);
        for (place, [volume, square, energy, fatigue]) in places.zip(&saved.sums) {
            *place = Dose {
                volume: *volume,
                square: *square,
                energy: *energy,
                fatigue: *fatigue,
            };
        }
        self.distance = saved.distance;
        true
    }

    /// Adds that of another run with wheels and rails of the same profiles, times a factor.
    pub fn merge(&mut self, other: &Self, factor: f64) {
        self.distance += factor * other.distance;
        let own = self.wheels.iter_mut().flatten();
        for (own, other) in own.zip(other.wheels.iter().flatten()) {
            own.surface.merge(&other.surface, factor);
        }
        for (own, other) in self.rails.iter_mut().zip(&other.rails) {
            own.merge(other, factor);
        }
    }

    /// Returns the mean of what creep takes by the distance, N.
    #[must_use]
    pub fn resistance(&self) -> f64 {
        let energy: f64 = self.rails.iter().map(|own| own.sum().energy).sum();
        match self.distance > 0.0 {
            true => energy / self.distance,
            false => 0.0,
        }
    }
}

impl OfWheel {
    /// Returns the depth (m) along the normal that a place of the profile wears by a volume (m³) times the
    /// cosine of its contact angle.
    #[must_use]
    pub fn depth(&self, square: f64) -> f64 {
        square / (self.surface.width() * TAU * self.radius)
    }
}
