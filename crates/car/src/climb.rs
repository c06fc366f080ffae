//! What the flanges of a vehicle's wheels climb at ([`wheelrail::climb`]).

use wheelrail::climb::{nadal, weinstock};
use wheelrail::contact::CreepLaw;
use wheelrail::friction::Friction;

use crate::parameters::{Parameters, ProfiledWheels, Wheels};

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
        match &parameters.wheels {
            Wheels::OnRails(own) => Some(Self::of_wheels(own)),
            Wheels::Linear { .. } => None,
        }
    }

    /// Returns those of four axles with wheels with profiles.
    #[must_use]
    pub fn of_wheels(own: &ProfiledWheels) -> Self {
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
        Self { angles, friction }
    }

    /// Returns the same of so many axles that are as the first one.
    #[must_use]
    pub fn of_axles(self, count: usize) -> Self {
        let first = self.angles.first().copied().unwrap_or_default();
        Self {
            angles: vec![first; count],
            ..self
        }
    }

    /// Returns of all wheels with a flange the largest angle of its face, rad, and the greatest friction
    /// there along the track, where nothing slips.
    #[must_use]
    pub fn flanges(&self) -> Vec<[f64; 2]> {
        let sides = self.angles.iter().flat_map(|angles| angles.iter().enumerate());
        let known = sides.filter_map(|(side, angle)| angle.map(|angle| (side, angle)));
        known
            .map(|(side, angle)| [angle, self.friction[side].greatest(libm::tan(angle))])
            .collect()
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
