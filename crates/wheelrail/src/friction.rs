//! Friction of a wheel on a rail: by zone, over distance, falling with slip.
//!
//! **Zones.** The coefficient is that of the tread up to a contact angle of 20° and that of the gauge face
//! from 30° on; between them it is linear in the angle. Lubricators oil the gauge face, modifiers are put on
//! the top of the rail. (Angles of an example of the program CONTACT.)
//!
//! **Distance.** Places along the track with both coefficients, linear between them, constant before and
//! behind: lubricators, wet spots.
//!
//! **Slip** (Polach 2005, Wear 258): `μ(w) = μ0 ((1 - A) exp(-B w) + A)` with the slip velocity w (m/s) of
//! the patch's middle, spin left aside, the ratio A of friction at high slip to that at none, and the decay B
//! (s/m). His values for a dry rail are A = 0.40, B = 0.60 s/m, with reduction factors kA = 1.0, kS = 0.40
//! ([`Reduction`](crate::creep::polach::Reduction)).
//!
//! Limits: one coefficient a patch; friction where a wheel begins to slip is that of its slip then, without
//! temperature. w is smoothed over 1e-7 m/s, so that derivatives exist where nothing slips.

use std::sync::Arc;

use numerics::scalar::Real;

/// Contact angles between which zones blend, rad: 20° and 30°.
const ZONES: [f64; 2] = [0.349_065_850_398_865_9, 0.523_598_775_598_298_8];
/// Slip velocity over which the falling begins smoothly, m/s.
const SMOOTH: f64 = 1e-7;

/// Coefficients of both zones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zones {
    /// Of the tread: below a contact angle of 20°.
    pub tread: f64,
    /// Of the gauge face: above 30°.
    pub gauge_face: f64,
}

/// The fall of friction with the slip velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Falling {
    /// A: friction at high slip over that at none.
    pub ratio: f64,
    /// B, s/m.
    pub decay: f64,
}

/// Polach's fall of friction on a dry rail.
pub const DRY: Falling = Falling {
    ratio: 0.40,
    decay: 0.60,
};

/// Friction of a wheel on a rail.
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    /// The coefficients, where they are not those over distance.
    pub zones: Zones,
    /// Coefficients at places along the track, m, rising.
    pub over: Option<Arc<[(f64, Zones)]>>,
    /// The fall with the slip.
    pub falling: Option<Falling>,
}

impl Friction {
    /// Returns one coefficient for everything.
    #[must_use]
    pub const fn constant(coefficient: f64) -> Self {
        Self::by_zone(coefficient, coefficient)
    }

    /// Returns a coefficient for the tread and one for the gauge face.
    #[must_use]
    pub const fn by_zone(tread: f64, gauge_face: f64) -> Self {
        Self {
            zones: Zones { tread, gauge_face },
            over: None,
            falling: None,
        }
    }

    /// Returns a coefficient that is not admissible, not between 0 and 2, if there is one.
    #[must_use]
    pub fn inadmissible(&self) -> Option<f64> {
        self.all().find(|own| !(0.0..=2.0).contains(own))
    }

    /// Returns all coefficients: of both zones, everywhere.
    pub fn all(&self) -> impl Iterator<Item = f64> {
        let over = self.over.iter().flat_map(|over| over.iter());
        let zones = std::iter::once(self.zones).chain(over.map(|(_, zones)| *zones));
        zones.flat_map(|own| [own.tread, own.gauge_face])
    }

    /// Returns the same with all coefficients times a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let zones = |own: &Zones| Zones {
            tread: factor * own.tread,
            gauge_face: factor * own.gauge_face,
        };
        let over = |own: &Arc<[(f64, Zones)]>| own.iter().map(|(at, own)| (*at, zones(own))).collect();
        Self {
            zones: zones(&self.zones),
            over: self.over.as_ref().map(over),
            falling: self.falling,
        }
    }

    /// Returns whether there is no friction anywhere.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.all().all(|own| own == 0.0)
    }

    /// Returns the coefficient at a patch with the slope of its plane (tangent of the contact angle) at a
    /// place along the track (m), where its material slips by a velocity along and across (m/s).
    #[inline(always)]
    pub fn at<S: Real>(&self, slope: S, along: S, slip: [S; 2]) -> S {
        let zones = &self.zones;
        if self.over.is_none() && self.falling.is_none() && zones.tread == zones.gauge_face {
            return S::from(zones.tread);
        }
        self.varying(slope, along, slip)
    }

    #[inline(never)]
    fn varying<S: Real>(&self, slope: S, along: S, [x, y]: [S; 2]) -> S {
        let [tread, gauge_face] = self.zones_at(along);
        let value = slope.value();
        let angle = libm::atan(value.abs());
        let share = (angle - ZONES[0]) / (ZONES[1] - ZONES[0]);
        let coefficient = if share <= 0.0 {
            tread
        } else if share >= 1.0 {
            gauge_face
        } else {
            let rate = value.signum() / ((1.0 + value * value) * (ZONES[1] - ZONES[0]));
            tread + (gauge_face - tread) * slope.chain(share, rate)
        };
        let Some(Falling { ratio, decay }) = self.falling else {
            return coefficient;
        };
        let velocity = (x * x + y * y + SMOOTH * SMOOTH).sqrt() - SMOOTH;
        coefficient * ((velocity * -decay).exp() * (1.0 - ratio) + ratio)
    }

    /// Returns the coefficient where nothing slips, which is the greatest one, at a slope of the plane of
    /// contact and a place along the track (m).
    #[must_use]
    pub fn at_rest(&self, slope: f64, along: f64) -> f64 {
        self.at(slope, along, [0.0; 2])
    }

    /// Returns the greatest coefficient at a slope of the plane of contact, of all places along the track.
    #[must_use]
    pub fn greatest(&self, slope: f64) -> f64 {
        match &self.over {
            // Between places it is linear.
            Some(over) => over
                .iter()
                .map(|(place, _)| self.at_rest(slope, *place))
                .fold(0.0, f64::max),
            None => self.at_rest(slope, 0.0),
        }
    }

    /// Returns the coefficients of tread and gauge face at a place along the track, m.
    fn zones_at<S: Real>(&self, along: S) -> [S; 2] {
        let constant = |zones: &Zones| [S::from(zones.tread), S::from(zones.gauge_face)];
        let Some(over) = &self.over else {
            return constant(&self.zones);
        };
        let next = over.partition_point(|(place, _)| *place <= along.value());
        match (next.checked_sub(1).map(|before| &over[before]), over.get(next)) {
            (Some((from, before)), Some((to, after))) => {
                let share = (along - *from) * (1.0 / (to - from));
                [
                    share * (after.tread - before.tread) + before.tread,
                    share * (after.gauge_face - before.gauge_face) + before.gauge_face,
                ]
            }
            (Some((_, zones)), None) | (None, Some((_, zones))) => constant(zones),
            (None, None) => constant(&self.zones),
        }
    }
}
