//! Surfaces that contact points touch, in the axes of the surface's marker: x is its outward normal, y and z
//! are its tangents.
//!
//! A surface is a plane or a cylinder in the wide sense: a profile along one of the two tangents, drawn out
//! along the other. The profile is straight, an arc, or a table. Every point has the signed distance g from
//! the surface, its normal n there, and the curvature κ' of the surface through the point at that distance:
//!
//! ```text
//! arc of curvature κ, x along the normal, s along the profile:  q² = (1 + κx)² + (κs)²
//!     g = (2x + κ(x² + s²)) / (1 + q),   n = (1 + κx, κs) / q,   κ' = κ / q
//! table of depths h(s):  the nearest place σ solves  σ - s + (x + h) h' = 0,  w² = 1 + h'²
//!     n = (1, h') / w,   g = n·(x + h, s - σ),   κ' = κ / (1 + κ g),   κ = h'' / w³
//! ```
//!
//! For κ = 0 the arc is the plane, to the last bit of g and n. Moving by dr changes g by n·dr and turns the
//! normal by κ' t·dr, t = (-n_s, n_x). So forces along n have a potential, and energy closes.
//!
//! Limits: points may not lie beyond the center of an arc, nor beyond that of a hollow table. Outside its
//! first and last depth a table goes on straight; its curvature jumps there unless it is zero.

use numerics::lanes::Lanes;
use numerics::scalar::{Number, Real};
use serde::{Deserialize, Serialize};

use crate::spline::Spline;
use crate::vector::Vector;

/// The plane through the marker's origin; its outward normal is the marker's x axis, its tangents are y and
/// z.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Plane;

/// The profile of a surface, as depth h below its tangent plane over the distance s from its middle, m.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Profile {
    /// Straight.
    #[default]
    Flat,
    /// An arc.
    Arc {
        /// Curvature, 1/m: positive where the surface is crowned, negative where it is hollow.
        curvature: f64,
    },
    /// Depths by table, twice continuously differentiable between its ends, straight beyond them.
    Table(Spline),
}

/// The tangent along which a profile runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// The marker's y axis.
    Y,
    /// The marker's z axis.
    #[default]
    Z,
}

/// The shape of a surface.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Shape {
    /// Its profile.
    pub profile: Profile,
    /// Along which tangent the profile runs.
    pub direction: Direction,
}

/// What a surface is like next to a point (or to four in lanes): see the head of the module.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bend<P> {
    /// Signed distance, m: positive outside.
    pub gap: P,
    /// Components of the normal along x and along the profile.
    pub normal: [P; 2],
    /// Curvature at that distance, 1/m.
    pub curvature: P,
}

/// Numbers without derivatives: one, or four in lanes.
pub(crate) trait Plain: Number<Plain = Self> {
    /// Applies a function of two real numbers lane by lane.
    fn each(a: Self, b: Self, f: impl Fn(f64, f64) -> [f64; 4]) -> [Self; 4];
}

impl Plain for f64 {
    #[inline(always)]
    fn each(a: Self, b: Self, f: impl Fn(f64, f64) -> [f64; 4]) -> [Self; 4] {
        f(a, b)
    }
}

impl Plain for Lanes {
    #[inline(always)]
    fn each(a: Self, b: Self, f: impl Fn(f64, f64) -> [f64; 4]) -> [Self; 4] {
        let (a, b) = (a.to_array(), b.to_array());
        let found: [[f64; 4]; 4] = std::array::from_fn(|lane| f(a[lane], b[lane]));
        std::array::from_fn(|part| Self::new(std::array::from_fn(|lane| found[lane][part])))
    }
}

/// Newton's method for the nearest place of a table ends after so many steps at the latest.
const STEPS: usize = 20;
/// It ends where a step is shorter than this, m.
const NEAR: f64 = 1e-15;

impl Profile {
    /// Returns whether it is straight.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        matches!(self, Self::Flat)
    }

    /// Returns the depth (m) at a distance from the middle (m), and its first and second derivative. An arc
    /// ends at its radius, where the depth is not finite.
    #[must_use]
    pub fn depth(&self, s: f64) -> [f64; 3] {
        match self {
            Self::Flat => [0.0; 3],
            Self::Arc { curvature } => {
                let root = (1.0 - curvature * s * curvature * s).sqrt();
                if root.is_nan() {
                    return [f64::NAN; 3];
                }
                [
                    curvature * s * s / (1.0 + root),
                    curvature * s / root,
                    curvature / (root * root * root),
                ]
            }
            Self::Table(spline) => {
                let (first, last) = spline.range();
                let inside = s.clamp(first, last);
                let [value, slope, second] = spline.evaluate(inside);
                if inside == s {
                    [value, slope, second]
                } else {
                    [value + slope * (s - inside), slope, 0.0]
                }
            }
        }
    }

    /// Returns the profile with the other sense of its distance.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        match self {
            Self::Table(spline) => Self::Table(spline.mirrored()),
            other => other.clone(),
        }
    }

    #[inline(always)]
    pub(crate) fn bend<P: Plain>(&self, x: P, s: P) -> Bend<P> {
        match self {
            Self::Flat => Bend {
                gap: x,
                normal: [P::from(1.0), P::zero()],
                curvature: P::zero(),
            },
            Self::Arc { curvature } => {
                let (a, b) = (x * *curvature + 1.0, s * *curvature);
                let q = (a * a + b * b).sqrt();
                Bend {
                    gap: (x * 2.0 + (x * x + s * s) * *curvature) / (q + 1.0),
                    normal: [a / q, b / q],
                    curvature: P::from(*curvature) / q,
                }
            }
            Self::Table(_) => {
                let [gap, along_x, along_s, curvature] = P::each(x, s, |x, s| self.nearest(x, s));
                Bend {
                    gap,
                    normal: [along_x, along_s],
                    curvature,
                }
            }
        }
    }

    /// Returns distance, normal and curvature of a table.
    fn nearest(&self, x: f64, s: f64) -> [f64; 4] {
        let mut place = s;
        for _ in 0..STEPS {
            let [h, slope, second] = self.depth(place);
            let flat = 1.0 + slope * slope;
            let residual = place - s + (x + h) * slope;
            // Beyond the center of a hollow the nearest place is not unique.
            let step = residual / (flat + (x + h) * second).max(0.5 * flat);
            place -= step;
            if step.abs() <= NEAR {
                break;
            }
        }
        let [h, slope, second] = self.depth(place);
        let w = (1.0 + slope * slope).sqrt();
        let normal = [1.0 / w, slope / w];
        let gap = normal[0] * (x + h) + normal[1] * (s - place);
        let curvature = second / (w * w * w);
        [gap, normal[0], normal[1], curvature / (1.0 + curvature * gap)]
    }
}

impl Shape {
    /// Returns the coordinate along the profile.
    #[inline(always)]
    pub(crate) fn along<S: Number>(&self, position: Vector<S>) -> S {
        match self.direction {
            Direction::Y => position.0[1],
            Direction::Z => position.0[2],
        }
    }

    /// Returns distance and normal next to a point, with the derivatives of the point.
    #[inline(always)]
    fn local<S: Real>(&self, position: Vector<S>) -> (S, [S; 2]) {
        let (x, s) = (position.0[0], self.along(position));
        let bend = self.profile.bend::<f64>(x.value(), s.value());
        let [c, k] = bend.normal;
        let (dx, ds) = (x - x.value(), s - s.value());
        let turn = (ds * c - dx * k) * bend.curvature;
        (dx * c + ds * k + bend.gap, [turn * -k + c, turn * c + k])
    }

    /// Returns the signed distance of a point from the surface, m: positive outside, negative inside.
    #[inline(always)]
    pub fn gap<S: Real>(&self, point: Vector<S>) -> S {
        if self.profile.is_flat() {
            return point.0[0];
        }
        self.local(point).0
    }

    /// Returns the components of a vector along the outward normal and the two tangents of the surface next
    /// to `point`.
    #[inline(always)]
    pub fn resolve<S: Real>(&self, point: Vector<S>, vector: Vector<S>) -> [S; 3] {
        if self.profile.is_flat() {
            return vector.0;
        }
        resolve(self.direction, self.local(point).1, vector)
    }

    /// Returns the vector with the given components along the normal and the two tangents.
    #[inline(always)]
    pub fn compose<S: Real>(&self, point: Vector<S>, components: [S; 3]) -> Vector<S> {
        if self.profile.is_flat() {
            return Vector(components);
        }
        compose(self.direction, self.local(point).1, components)
    }
}

/// Components along the normal, with its components along x and along the profile, and two tangents of a
/// vector in marker axes.
#[inline(always)]
pub(crate) fn resolve<S: Number>(direction: Direction, [c, k]: [S; 2], vector: Vector<S>) -> [S; 3] {
    let [x, y, z] = vector.0;
    match direction {
        Direction::Y => [x * c + y * k, y * c - x * k, z],
        Direction::Z => [x * c + z * k, y, z * c - x * k],
    }
}

/// The vector in marker axes with these components.
#[inline(always)]
pub(crate) fn compose<S: Number>(direction: Direction, [c, k]: [S; 2], [n, a, b]: [S; 3]) -> Vector<S> {
    match direction {
        Direction::Y => Vector([n * c - a * k, n * k + a * c, b]),
        Direction::Z => Vector([n * c - b * k, a, n * k + b * c]),
    }
}
