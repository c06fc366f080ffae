//! The massless wedge in quasi-static sliding, with its jam condition.
//!
//! The wedge between a column (toe angle φ, positive toe out) and a slope (angle θ from the vertical) is
//! pushed up by the coil force F_s. With a = +1 while the bolster moves down and -1 while it moves up, and
//! b = +1 when the friction of the slope on the wedge acts up the slope, force balance along the slope and
//! across it gives (Steets 2007, eq. 5-1, derived anew; ψ_c = atan μ_c, ψ_s = atan μ_s):
//!
//! ```text
//! N_c = F_s cos ψ_c cos(θ - b ψ_s) / sin(θ + φ - b ψ_s - a ψ_c)
//! N_s = F_s cos ψ_s cos(φ - a ψ_c) / sin(θ + φ - b ψ_s - a ψ_c)
//! ```
//!
//! As printed, eq. 5-1 is this normal force for unloading, with sin φ misprinted for sin θ. A steady solution
//! exists only while the angle in the denominator, the jam margin, is positive (and the numerators are).
//! Units: N, rad.
//!
//! The least of these margins (a = b = +1: the faces close on the wedge, both frictions hold it) is the
//! *lock-up margin* `α - ψ_c - ψ_s`, with α the angle at which the two faces close. A wedge between two faces
//! and nothing else is a body of two forces: they are opposite, on one line. The line lies in both friction
//! cones, of half-angles ψ_c and ψ_s about normals that are α apart, exactly if α ≤ ψ_c + ψ_s: then the wedge
//! can be held without any coil. With the pocket yawed by ψ,
//! `sin²(α/2) = sin²((θ+φ)/2) + cos φ cos θ sin²(ψ/2)`; without yaw α = θ + φ.
//!
//! Limits: no mass, no moments, the faces flat on each other. Rigid kinematics choose b: toe out b = -a, toe
//! in b = +a; with no toe the slope does not slip, and the industry's elements take the toe-out branch.

use numerics::scalar::Real;

/// A massless wedge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuasiStaticWedge {
    /// Wedge angle θ from the vertical, rad.
    pub angle: f64,
    /// Toe angle φ, rad; positive is toe out.
    pub toe: f64,
    /// Coefficient of friction of the column.
    pub column_friction: f64,
    /// Coefficient of friction of the slope.
    pub slope_friction: f64,
}

/// The direction in which the bolster moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlidingDirection {
    /// Down: loading.
    Down,
    /// Up: unloading.
    Up,
}

/// The direction in which the friction of the slope acts on the wedge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlopeFriction {
    /// Up the slope (b = +1).
    UpSlope,
    /// Down the slope (b = -1).
    DownSlope,
}

/// Steady sliding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sliding {
    /// Normal force at the column, N.
    pub column_normal: f64,
    /// Friction at the column, `μ_c N_c`, N.
    pub column_friction: f64,
    /// Normal force at the slope, N.
    pub slope_normal: f64,
}

impl SlidingDirection {
    /// Returns a: +1 down, -1 up.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Down => 1.0,
            Self::Up => -1.0,
        }
    }
}

impl SlopeFriction {
    /// Returns b: +1 up the slope, -1 down the slope.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::UpSlope => 1.0,
            Self::DownSlope => -1.0,
        }
    }
}

impl QuasiStaticWedge {
    /// Returns the branch that rigid kinematics choose: toe out (and no toe) b = -a, toe in b = +a.
    #[must_use]
    pub fn branch(&self, direction: SlidingDirection) -> SlopeFriction {
        let toe_in = self.toe < 0.0;
        match (direction, toe_in) {
            (SlidingDirection::Down, true) | (SlidingDirection::Up, false) => SlopeFriction::UpSlope,
            (SlidingDirection::Down, false) | (SlidingDirection::Up, true) => SlopeFriction::DownSlope,
        }
    }

    /// Returns the jam margin `θ + φ - b ψ_s - a ψ_c`, rad: the wedge jams where it is not positive.
    #[must_use]
    pub fn jam_margin(&self, direction: SlidingDirection, slope: SlopeFriction) -> f64 {
        self.angle + self.toe
            - slope.sign() * libm::atan(self.slope_friction)
            - direction.sign() * libm::atan(self.column_friction)
    }

    /// Returns the angle α at which column and slope close on the wedge (rad), with the pocket yawed against
    /// the column by `yaw` (rad). Zero or less: they do not close upwards, and nothing holds the wedge down.
    #[must_use]
    pub fn closing_angle(&self, yaw: f64) -> f64 {
        if yaw == 0.0 {
            return self.angle + self.toe;
        }
        let half = libm::sin(0.5 * (self.angle + self.toe));
        let turned = libm::sin(0.5 * yaw);
        let square = half * half + libm::cos(self.toe) * libm::cos(self.angle) * turned * turned;
        2.0 * libm::asin(square.sqrt().min(1.0)).copysign(half)
    }

    /// Returns the lock-up margin `α - ψ_c - ψ_s`, rad: where it is not positive, the friction cones of the
    /// two faces hold a line in common, and a wedge on which the faces close locks.
    #[must_use]
    pub fn lock_up_margin(&self, yaw: f64) -> f64 {
        self.closing_angle(yaw) - libm::atan(self.column_friction) - libm::atan(self.slope_friction)
    }

    /// Returns the steady sliding under a coil force (N), or `None` if the wedge jams.
    #[must_use]
    pub fn slide(
        &self,
        direction: SlidingDirection,
        slope: SlopeFriction,
        coil_force: f64,
    ) -> Option<Sliding> {
        let margin = self.jam_margin(direction, slope);
        let (psi_c, psi_s) = (libm::atan(self.column_friction), libm::atan(self.slope_friction));
        let sine = libm::sin(margin);
        let column = libm::cos(self.angle - slope.sign() * psi_s) * libm::cos(psi_c);
        let across = libm::cos(self.toe - direction.sign() * psi_c) * libm::cos(psi_s);
        if sine <= 0.0 || margin <= 0.0 || column < 0.0 || across < 0.0 {
            return None;
        }
        let column_normal = coil_force * column / sine;
        Some(Sliding {
            column_normal,
            column_friction: self.column_friction * column_normal,
            slope_normal: coil_force * across / sine,
        })
    }

    /// Returns the normal forces (N) at column and slope under a load (N: coil force less weight) while a
    /// part of the friction is mobilized: `mobilized` goes from -1 (steady sliding up) over 0 (no friction)
    /// to +1 (steady sliding down), at both faces alike, the slope's friction acting as on the
    /// [`QuasiStaticWedge::branch`]. `None` where the wedge jams.
    ///
    /// It is the same balance as [`QuasiStaticWedge::slide`], with `μ = mobilized · coefficient` for `tan ψ`:
    ///
    /// ```text
    /// N_c = F (cos θ + b μ_s sin θ) / (sin(θ+φ) (1 - a μ_c b μ_s) - cos(θ+φ) (a μ_c + b μ_s))
    /// N_s = F (cos φ + a μ_c sin φ) / (the same)
    /// ```
    #[must_use]
    pub fn normal_forces<S: Real>(&self, mobilized: S, load: S) -> Option<[S; 2]> {
        let [column, slope] = self.mobilize(mobilized);
        let (sin, cos) = libm::sincos(self.angle + self.toe);
        let denominator = -(column * slope * sin) + sin - (column + slope) * cos;
        let (sin_angle, cos_angle) = libm::sincos(self.angle);
        let (sin_toe, cos_toe) = libm::sincos(self.toe);
        let [on_column, on_slope] = [slope * sin_angle + cos_angle, column * sin_toe + cos_toe];
        if [denominator, on_column, on_slope]
            .iter()
            .any(|part| part.value().is_nan() || part.value() <= 0.0)
        {
            return None;
        }
        Some([load * on_column / denominator, load * on_slope / denominator])
    }

    /// Returns the friction force over normal force at column (positive: up on the wedge) and slope
    /// (positive: up the slope on the wedge), see [`QuasiStaticWedge::normal_forces`].
    pub fn mobilize<S: Real>(&self, mobilized: S) -> [S; 2] {
        let way = match self.branch(SlidingDirection::Down) {
            SlopeFriction::UpSlope => 1.0,
            SlopeFriction::DownSlope => -1.0,
        };
        [
            mobilized * self.column_friction,
            mobilized * (way * self.slope_friction),
        ]
    }

    /// Returns the friction coefficient (equal at both faces) at which loading with the slope's friction up
    /// the slope jams: `tan((θ + φ)/2)`.
    #[must_use]
    pub fn critical_friction(&self) -> f64 {
        libm::tan(0.5 * (self.angle + self.toe))
    }
}
