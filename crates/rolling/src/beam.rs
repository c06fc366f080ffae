//! Rails as beams on springs, which the two wheels of a truck on a side share.
//!
//! **Winkler's beam.** A load P on an endless beam of bending stiffness EI on a foundation of k per length
//! deflects it at the distance d by (Hetényi 1946; remembered)
//!
//! ```text
//! F(d) P = P / K exp(-β d) (cos β d + sin β d),   K = 8 EI β³,   β = (k / 4 EI)^(1/4)
//! ```
//!
//! A moment M about the rail's base, against a roll stiffness of the foundation k_r per length, rolls it by
//! `T(d) M = M exp(-α d) / (2 √(GJ k_r))` with `α = √(k_r / GJ)`. The stiffness under one wheel, K, is that
//! of [`RailSupport`]: alone under a wheel a beam is as stiff as the piece of rail without it, but for roll.
//!
//! **Roll** is a coordinate of its own ([`RailRoll`]): under its wheel the rail turns about its base against
//! `1 / T(0)`, with the moment of all of the wheel's forces, and the wheel rolls on a head that is turned and
//! moved aside. The inertia is that of the shape exp(-α |x|), `j / α` with j per length.
//!
//! **Two wheels.** With the flexibility a of the own and b of the other wheel, both pieces of rail are tied
//! to the ground by `1 / (a + b)` and to each other by `b / (a² - b²)`: the inverse of the flexibility
//! matrix. Both are springs of the family of [`RailSupport`], and may be negative between the pieces where a
//! beam rises beside a load.
//!
//! **Columns.** The roll under a wheel is its own one and `exp(-α d)` times that under the other wheel of the
//! truck; the head has moved by the displacement of the base and by h times the roll.
//!
//! **Limits.** Quasi-static: no waves run along the rail, masses and dampers are those of pieces under the
//! wheels. Wheels of other trucks are not felt; the distance is the wheelbase. A wheel rolls on a head that
//! its own forces roll, not on what the roll under the other wheel adds (1.6 % of that at 70 in). Level
//! springs are the same in all directions, as those of [`RailSupport`]. Where what pieces lie on is moved,
//! the spring between them feels that too.

use super::track::RailSupport;

/// Mass moment of inertia of a rail 136RE about its base, kg·m²/m: 7,850 kg/m³ times the moments of inertia
/// of its section, 14.7 + 94.9 in⁴, and its 13.35 in² at 3.35 in (remembered).
const ROLL_INERTIA: f64 = 0.85;
/// Damping of the roll, a share of the critical one (guess).
const ROLL_DAMPING: f64 = 0.1;

/// A rail as a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct RailBeam {
    /// Bending stiffnesses EI, lateral and vertical, N·m².
    pub bending: [f64; 2],
    /// Torsional stiffness GJ, N·m².
    pub torsion: f64,
    /// Roll stiffness of the foundation about the base, N·m/rad a meter.
    pub roll_stiffness: f64,
    /// Height of the top above the base, m.
    pub height: f64,
    /// Place of the middle of the base to the field side of the origin of the rail's profile, m.
    pub base: f64,
}

/// The roll of a rail under a wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RailRoll {
    /// Height of the origin of the rail's profile above the axis of the roll, m.
    pub height: f64,
    /// Place of the axis to the field side of that origin, m.
    pub base: f64,
    /// Stiffness, N·m/rad.
    pub stiffness: f64,
    /// Moment of inertia, kg·m².
    pub inertia: f64,
    /// Damping, N·m·s/rad.
    pub damping: f64,
}

/// Springs of the two pieces of rail under a side of a truck.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedSprings {
    /// Of each to the ground.
    pub ground: RailSupport,
    /// Between them, without mass and damping.
    pub between: RailSupport,
}

impl RailBeam {
    /// A rail 136RE: moments of inertia 14.7 and 94.9 in⁴ (remembered), a torsion constant of 5.5 in⁴
    /// (guess), 207 and 81 GPa, 7 5/16 in high, inclined by 1:40; roll stiffness of the foundation 1e6
    /// N·m/rad a meter (guess).
    #[must_use]
    pub fn rail_136re() -> Self {
        const INCH: f64 = 0.0254;
        let fourth = INCH * INCH * INCH * INCH;
        let height = 7.3125 * INCH;
        Self {
            bending: [207e9 * 14.7 * fourth, 207e9 * 94.9 * fourth],
            torsion: 81e9 * 5.5 * fourth,
            roll_stiffness: 1e6,
            height,
            base: height / 40.0,
        }
    }

    /// Returns the deflection by a unit load at a distance (m) from it, m/N; `stiffness` is that under the
    /// load, N/m.
    #[must_use]
    pub fn deflection(stiffness: f64, bending: f64, distance: f64) -> f64 {
        let rate = libm::cbrt(stiffness / (8.0 * bending)) * distance;
        let (sine, cosine) = libm::sincos(rate);
        libm::exp(-rate) * (cosine + sine) / stiffness
    }

    /// Returns the roll by a unit moment at a distance (m) from it, rad/(N·m).
    #[must_use]
    pub fn roll(&self, distance: f64) -> f64 {
        let rate = (self.roll_stiffness / self.torsion).sqrt();
        libm::exp(-rate * distance) / (2.0 * (self.torsion * self.roll_stiffness).sqrt())
    }

    /// Returns the roll of a rail under a wheel.
    #[must_use]
    pub fn rolling(&self) -> RailRoll {
        let stiffness = 1.0 / self.roll(0.0);
        let inertia = ROLL_INERTIA * (self.torsion / self.roll_stiffness).sqrt();
        RailRoll {
            height: self.height,
            base: self.base,
            stiffness,
            inertia,
            damping: 2.0 * ROLL_DAMPING * (stiffness * inertia).sqrt(),
        }
    }

    /// Returns the flexibility of the base at a distance (m), lateral and vertical, m/N.
    fn flexibility(&self, support: &RailSupport, distance: f64) -> [f64; 2] {
        [0, 1].map(|i| Self::deflection(support.stiffness[i], self.bending[i], distance))
    }

    /// Returns the springs of two pieces under wheels at a distance (m).
    #[must_use]
    pub fn shared(&self, support: &RailSupport, distance: f64) -> SharedSprings {
        let [own, other] = [0.0, distance].map(|at| self.flexibility(support, at));
        let ground = [0, 1].map(|i| 1.0 / (own[i] + other[i]));
        let between = [0, 1].map(|i| other[i] / (own[i] * own[i] - other[i] * other[i]));
        SharedSprings {
            ground: RailSupport {
                stiffness: ground,
                ..support.clone()
            },
            between: RailSupport {
                mass: 0.0,
                stiffness: between,
                damping: [0.0; 2],
                preload: 0.0,
                ..support.clone()
            },
        }
    }

    /// Returns the rolls (rad, outwards) under both wheels of a truck on a side, at a distance (m), from what
    /// each wheel rolls it under itself.
    #[must_use]
    pub fn rolls(&self, own: [f64; 2], distance: f64) -> [f64; 2] {
        let share = self.roll(distance) / self.roll(0.0);
        [own[0] + share * own[1], own[1] + share * own[0]]
    }
}
