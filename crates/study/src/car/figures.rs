//! Figures of a car that limits of rules depend on, and the limits of climbing of its wheels.

use car::{Parameters, Wheels};
use wheelrail::climb::{nadal, weinstock};
use wheelrail::contact::CreepLaw;
use wheelrail::friction::Friction;

use super::derailment::static_loads;

/// What each wheel's flange climbs at: the angle of its own flange, and the friction of its own rail.
#[derive(Clone, Debug)]
pub struct ClimbLimits {
    /// The largest angle of each flange's face by axle, left and right, rad; none of wheels without flanges.
    angles: Vec<[Option<f64>; 2]>,
    /// Of the wheels on the left and the right rail.
    friction: [Friction; 2],
}

/// What the flanges of an axle climb at, at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxleLimits {
    /// Nadal's limits of L/V of the left and the right wheel, with the friction where nothing slips; infinite
    /// without a flange.
    pub nadal: [f64; 2],
    /// Friction of the left and the right tread, where nothing slips.
    pub tread: [f64; 2],
}

impl ClimbLimits {
    /// Returns those of a car; none with linear wheels.
    #[must_use]
    pub fn of(parameters: &Parameters) -> Option<Self> {
        let Wheels::OnRails(own) = &parameters.wheels else {
            return None;
        };
        let angle = |wheel: &wheelrail::profile::Profile| wheel.wheel_figures().map(|own| own.angle);
        let mut angles: Vec<[Option<f64>; 2]> = Vec::new();
        for (axle, wheels) in own.wheels.iter().enumerate() {
            let same = |other: &[std::sync::Arc<_>; 2]| {
                (0..2).all(|side| std::sync::Arc::ptr_eq(&other[side], &wheels[side]))
            };
            angles.push(match own.wheels[..axle].iter().position(same) {
                Some(before) => angles[before],
                None => wheels.each_ref().map(|wheel| angle(wheel)),
            });
        }
        let friction = own.laws.each_ref().map(|law| match law.creep {
            CreepLaw::Frictionless => Friction::constant(0.0),
            _ => law.friction.clone(),
        });
        Some(Self { angles, friction })
    }

    /// Returns the limits of an axle (from the front, from 0) at a distance along the track (m).
    #[must_use]
    pub fn at(&self, axle: usize, along: f64) -> AxleLimits {
        let angles = self.angles.get(axle).copied().unwrap_or_default();
        AxleLimits {
            nadal: [0, 1].map(|side| {
                angles[side].map_or(f64::INFINITY, |angle| {
                    nadal(angle, self.friction[side].at_rest(libm::tan(angle), along))
                })
            }),
            tread: [0, 1].map(|side| self.friction[side].at_rest(0.0, along)),
        }
    }

    /// Returns whether friction changes along the track.
    #[must_use]
    pub fn vary(&self) -> bool {
        self.friction.iter().any(|own| own.over.is_some())
    }
}

impl AxleLimits {
    /// Returns the share of Weinstock's limit that wheels with these L/V have, left and right: the flange
    /// that bears is that of the wheel with the greater share of its own limit. Zero without flanges.
    #[must_use]
    pub fn weinstock_share(&self, [left, right]: [f64; 2]) -> f64 {
        let flange = usize::from(right / self.nadal[1] > left / self.nadal[0]);
        (left.abs() + right.abs()) / weinstock(self.nadal[flange], self.tread[1 - flange])
    }
}

/// Figures of a car that limits depend on, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarFigures {
    /// Least static load of an axle on level track, N.
    pub least_static_axle_load: f64,
    /// Greatest static load of an axle, N.
    pub greatest_static_axle_load: f64,
    /// Least static load of a wheel, N.
    pub least_static_wheel_load: f64,
    /// Greatest static load of a wheel, N.
    pub greatest_static_wheel_load: f64,
    /// Least of the largest angles of the flanges' faces, of all wheels, rad; `NaN` with linear wheels and
    /// without flanges.
    pub least_flange_angle: f64,
    /// Greatest friction of a wheel on its rail at the angle of its flange, of all places along the track and
    /// where nothing slips; `NaN` with linear wheels and without flanges.
    pub flange_friction: f64,
}

impl CarFigures {
    /// Names and units of measures with these figures, in the order of [`CarFigures::values`].
    pub const NAMES: [&'static str; 6] = [
        "least_static_axle_load",
        "greatest_static_axle_load",
        "least_static_wheel_load",
        "greatest_static_wheel_load",
        "least_flange_angle",
        "flange_friction",
    ];

    /// Returns those of a car.
    #[must_use]
    pub fn of(parameters: &Parameters) -> Self {
        let loads = static_loads(parameters);
        let axles = loads.map(|[left, right]| left + right);
        let least = |values: &[f64]| values.iter().copied().fold(f64::INFINITY, f64::min);
        let greatest = |values: &[f64]| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let climb = ClimbLimits::of(parameters);
        let flanges: Vec<[f64; 2]> = climb.map_or(Vec::new(), |own| {
            let sides = own.angles.iter().flat_map(|angles| angles.iter().enumerate());
            let known = sides.filter_map(|(side, angle)| angle.map(|angle| (side, angle)));
            known
                .map(|(side, angle)| [angle, own.friction[side].greatest(libm::tan(angle))])
                .collect()
        });
        // `min` and `max` leave `NaN` out.
        let of_flanges =
            |k: usize, better: fn(f64, f64) -> f64| flanges.iter().map(|own| own[k]).fold(f64::NAN, better);
        Self {
            least_static_axle_load: least(&axles),
            greatest_static_axle_load: greatest(&axles),
            least_static_wheel_load: least(loads.as_flattened()),
            greatest_static_wheel_load: greatest(loads.as_flattened()),
            least_flange_angle: of_flanges(0, f64::min),
            flange_friction: of_flanges(1, f64::max),
        }
    }

    /// Returns the figure with the name of a measure; `None` if there is none, or it is not known.
    #[must_use]
    pub fn named(&self, name: &str) -> Option<f64> {
        let place = Self::NAMES.iter().position(|own| *own == name)?;
        Some(self.values()[place]).filter(|own| own.is_finite())
    }

    /// Returns the figures in the order of [`CarFigures::NAMES`].
    #[must_use]
    pub fn values(&self) -> [f64; 6] {
        [
            self.least_static_axle_load,
            self.greatest_static_axle_load,
            self.least_static_wheel_load,
            self.greatest_static_wheel_load,
            self.least_flange_angle,
            self.flange_friction,
        ]
    }
}
