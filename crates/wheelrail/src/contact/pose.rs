//! The pose of a wheel relative to its rail, and the points of it that can touch a rail.
//!
//! **Axes of a contact.** x along the rail, y to the field side, z up, at the origin of the rail's profile.
//! On the left side these are forward, left, up; on the right side y is mirrored, so that one search serves
//! both. Vectors are mirrored by [`Side::mirrored`], moments and angular velocities by
//! [`Side::mirrored_axial`].
//!
//! **Silhouette.** A wheel is a body of revolution about the axle's direction e; a rail is a prism along x.
//! Points of the wheel touch only where its normal is square to x: at the profile coordinate u with radius
//! r(u), at the angle θ from the lowest point with `sin θ = τ r'(u)`, `τ = e_x / √(1 - e_x²)` (minus the
//! tangent of yaw). The search compares this silhouette with the rail's section. A wheel that is not round
//! has the radii of the angle that is down, and touches ahead of that silhouette where they grow.

use numerics::scalar::Real;

use super::turned::TurnedWheel;
use super::varying::Stretch;

/// A side of the track.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The left side, looking forward.
    Left,
    /// The right side.
    Right,
}

impl Side {
    /// Returns a vector in axes x forward, y to the field side, z up from one with y to the left, or back.
    #[inline(always)]
    pub fn mirrored<S: Real>(self, [x, y, z]: [S; 3]) -> [S; 3] {
        match self {
            Self::Left => [x, y, z],
            Self::Right => [x, -y, z],
        }
    }

    /// Returns a moment or an angular velocity in these axes, or back.
    #[inline(always)]
    pub fn mirrored_axial<S: Real>(self, [x, y, z]: [S; 3]) -> [S; 3] {
        match self {
            Self::Left => [x, y, z],
            Self::Right => [-x, y, -z],
        }
    }
}

/// Place and direction of a wheel in the axes of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelPose<S> {
    /// y and z of the wheel's center, where the axle meets the plane of the tape circle, m.
    pub center: [S; 2],
    /// Direction of the axle towards the field side, a unit vector.
    pub axle: [S; 3],
    /// Place of the wheel along the track, m: read where the rail's section changes along it.
    pub along: S,
    /// Angle of the wheel that is down, rad, growing as it rolls forward: read where it is not round.
    pub angle: S,
}

impl<S: Real> WheelPose<S> {
    /// Returns the pose of the wheel at a side, from the place of its center relative to the origin of the
    /// rail's profile (m, y to the left, z up) and from yaw (about z, to the left) and roll (about x, right
    /// side down) of the axle, rad.
    #[inline(always)]
    pub fn of(side: Side, [y, z]: [S; 2], yaw: S, roll: S) -> Self {
        let ((sin_yaw, cos_yaw), (sin_roll, cos_roll)) = (yaw.sin_cos(), roll.sin_cos());
        // Left of the axle: Rz(yaw) Rx(roll) (0, 1, 0).
        let left = [-(sin_yaw * cos_roll), cos_yaw * cos_roll, sin_roll];
        let axle = match side {
            Side::Left => left,
            Side::Right => left.map(|component| -component),
        };
        let [_, y, z] = side.mirrored([S::zero(), y, z]);
        Self {
            center: [y, z],
            axle: side.mirrored(axle),
            along: S::zero(),
            angle: S::zero(),
        }
    }

    /// Returns the values without derivatives.
    #[inline(always)]
    pub fn plain(&self) -> WheelPose<f64> {
        WheelPose {
            center: self.center.map(Real::value),
            axle: self.axle.map(Real::value),
            along: self.along.value(),
            angle: self.angle.value(),
        }
    }
}

/// The frame of a pose, the same for all points of the silhouette.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame<'r, S> {
    rail: &'r Stretch<'r>,
    pub wheel: &'r TurnedWheel<'r>,
    along_track: S,
    angle: S,
    center: [S; 2],
    axle: [S; 3],
    /// τ.
    tangent: S,
    /// Unit vectors square to the axle: along the rail as far as possible, and downwards.
    along: [S; 3],
    down: [S; 2],
}

/// Largest |sin θ| of a point that can be seen.
const LARGEST_SINE: f64 = 0.9;

/// A point of the silhouette over the rail.
#[derive(Clone, Copy, Debug)]
pub(super) struct ProfileNode<S> {
    /// Height of the rail above the wheel there, m.
    pub overlap: S,
    /// Its derivative by y.
    pub overlap_slope: S,
    /// Place on the wheel: x from its center, y, z in the axes of the contact, m.
    pub place: [S; 3],
    /// Slope of the rail.
    pub slope: S,
    /// Profile coordinate of the wheel, m.
    pub profile: S,
    /// Radius of the wheel, m.
    pub radius: S,
}

impl<'r, S: Real> Frame<'r, S> {
    /// Returns the frame of a pose of a wheel over a rail, both as they are at the pose.
    #[inline(always)]
    pub fn new(pose: &WheelPose<S>, wheel: &'r TurnedWheel<'r>, rail: &'r Stretch<'r>) -> Self {
        let [x, y, z] = pose.axle;
        let square = (x * x - 1.0) * -1.0;
        let level = square.sqrt();
        let across = (y * y + z * z).sqrt();
        Self {
            rail,
            wheel,
            along_track: pose.along,
            angle: pose.angle,
            center: pose.center,
            axle: pose.axle,
            tangent: x / level,
            along: [level, -(x * y) / level, -(x * z) / level],
            down: [z / across, -y / across],
        }
    }

    /// Returns the same without derivatives, in another scalar.
    #[inline(always)]
    pub fn lifted<T: Real>(&self) -> Frame<'r, T> {
        let lift = |value: S| T::from(value.value());
        Frame {
            rail: self.rail,
            wheel: self.wheel,
            along_track: lift(self.along_track),
            angle: lift(self.angle),
            center: self.center.map(lift),
            axle: self.axle.map(lift),
            tangent: lift(self.tangent),
            along: self.along.map(lift),
            down: self.down.map(lift),
        }
    }

    /// Returns the point of the silhouette at a parameter of the wheel's profile. Its sine θ is limited.
    #[inline(always)]
    pub fn node(&self, parameter: S) -> ProfileNode<S> {
        let (point, ahead) = self.wheel.at(parameter, self.angle);
        let mut sine = self.tangent * point.slope;
        if sine.value().abs() > LARGEST_SINE {
            sine = S::from(LARGEST_SINE.copysign(sine.value()));
        }
        let cosine = ((sine * sine - 1.0) * -1.0).sqrt();
        // The direction from the axle to the point, and the normal there.
        let out = [
            sine * self.along[1] + cosine * self.down[0],
            sine * self.along[2] + cosine * self.down[1],
        ];
        let normal = [
            out[0] - point.slope * self.axle[1],
            out[1] - point.slope * self.axle[2],
        ];
        let y = self.center[0] + point.y * self.axle[1] + point.radius * out[0];
        let z = self.center[1] + point.y * self.axle[2] + point.radius * out[1];
        let [height, slope] = self.rail.at(y, self.along_track);
        let x = point.y * self.axle[0] + point.radius * sine * self.along[0];
        ProfileNode {
            overlap: height - z,
            overlap_slope: slope + normal[0] / normal[1],
            place: [ahead.map_or(x, |ahead| x + ahead), y, z],
            slope,
            profile: point.y,
            radius: point.radius,
        }
    }
}

impl<S: Real> Frame<'_, S> {
    /// Returns the component of the axle's direction along the rail.
    #[inline(always)]
    pub fn axle_along(&self) -> S {
        self.axle[0]
    }

    /// Returns the rise of the rail along the track at y (m); none where its section does not change.
    #[inline(always)]
    pub fn climb(&self, y: S) -> Option<S> {
        self.rail.climb(y, self.along_track)
    }
}

impl Frame<'_, f64> {
    /// Returns beginning and end of the rail's section, m.
    #[inline(always)]
    pub fn rail_range(&self) -> [f64; 2] {
        self.rail.range()
    }

    /// Returns the height (m) of the rail at y (m), for a first look.
    #[inline(always)]
    pub fn coarse(&self, y: f64) -> f64 {
        self.rail.coarse(y)
    }

    /// Returns bounds of the profile coordinate for points whose y lies in a range (m); `radius` is the
    /// nominal one.
    #[inline(always)]
    pub fn reach(&self, [low, high]: [f64; 2], radius: f64) -> [f64; 2] {
        let slope = self.axle[1];
        if slope < 0.1 {
            return [f64::NEG_INFINITY, f64::INFINITY];
        }
        // The radius differs from the nominal one by less than 0.05 m, slopes are below 8.
        let sine = (8.0 * self.tangent.abs()).min(1.0);
        let lowest = (1.0 - sine * sine).sqrt();
        let margin = 0.05 * self.down[0].abs()
            + (radius + 0.05) * (sine * self.along[1].abs() + (1.0 - lowest) * self.down[0].abs());
        let base = self.center[0] + radius * self.down[0];
        [(low - base - margin) / slope, (high - base + margin) / slope]
    }

    /// Returns y and z of a station of the scan; none if it cannot be seen.
    #[inline(always)]
    pub fn station(&self, [y, radius, slope]: [f64; 3]) -> Option<[f64; 2]> {
        let sine = self.tangent * slope;
        if sine.abs() > LARGEST_SINE {
            return None;
        }
        let cosine = (1.0 - sine * sine).sqrt();
        Some([
            self.center[0] + y * self.axle[1] + radius * (sine * self.along[1] + cosine * self.down[0]),
            self.center[1] + y * self.axle[2] + radius * (sine * self.along[2] + cosine * self.down[1]),
        ])
    }
}
