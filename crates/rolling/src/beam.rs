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
//! A lateral force acts at the rail's head, h above the base: the head moves by `F(d) + h² T(d)`.
//!
//! **Two wheels.** With the flexibility a of the own and b of the other wheel, both pieces of rail are tied
//! to the ground by `1 / (a + b)` and to each other by `b / (a² - b²)`: the inverse of the flexibility
//! matrix. Both are springs of the family of [`RailSupport`], and may be negative between the pieces where a
//! beam rises beside a load.
//!
//! **Columns.** Roll and gauge are observed: `θ_i = Σ_j T_ij M_j` with the moments of both wheels' forces
//! about the base, lateral and vertical ones. The head has moved by the piece's own displacement and by h
//! times the roll of what the springs do not feel.
//!
//! **Limits.** Quasi-static: no waves run along the rail, masses and dampers are those of pieces under the
//! wheels. Wheels of other trucks are not felt; the distance is the wheelbase. Springs feel the roll that
//! lateral forces make at the head, not that of vertical forces beside the rail's axis, and a wheel rolls on
//! a head that moves aside but does not turn: 3 mrad on a crown of 10 in would move a contact by 0.8 mm.
//! Level springs are the same in all directions, as those of [`RailSupport`]. Where what pieces lie on is
//! moved, the spring between them feels that too.

use super::track::RailSupport;
use crate::wheel::PatchState;

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

    /// Returns the flexibility of the head at a distance (m), lateral and vertical, m/N.
    fn flexibility(&self, support: &RailSupport, distance: f64) -> [f64; 2] {
        let [lateral, vertical] =
            [0, 1].map(|i| Self::deflection(support.stiffness[i], self.bending[i], distance));
        [
            lateral + self.height * self.height * self.roll(distance),
            vertical,
        ]
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

    /// Returns the springs of a piece whose neighbors carry nothing.
    #[must_use]
    pub fn alone(&self, support: &RailSupport) -> RailSupport {
        RailSupport {
            stiffness: self.flexibility(support, 0.0).map(f64::recip),
            ..support.clone()
        }
    }

    /// Returns the moment about the base of what a patch's forces do to the rail, N·m: positive where it
    /// rolls the rail outwards.
    #[must_use]
    pub fn moment(&self, seen: &PatchState) -> f64 {
        let (patch, forces) = (&seen.patch, &seen.forces);
        let ([_, y, z], normal, across) = (patch.place, patch.normal(), patch.across());
        let of = |i: usize| (normal[i] * forces.normal + across[i] * forces.creep.y) * patch.share;
        // Forces on the wheel, y to the field side: on the rail they are the opposite ones.
        let (outwards, down) = (-of(1), of(2));
        outwards * (z + self.height) + down * (y - self.base)
    }

    /// Returns the rolls (rad, outwards) of both rails of a truck's side under moments about their bases
    /// (N·m) at a distance (m).
    #[must_use]
    pub fn rolls(&self, moments: [f64; 2], distance: f64) -> [f64; 2] {
        let [own, other] = [0.0, distance].map(|at| self.roll(at));
        let [a, b] = moments;
        [own * a + other * b, other * a + own * b]
    }
}
