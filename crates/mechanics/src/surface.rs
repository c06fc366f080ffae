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
//! A worn surface recedes further by depths over both tangents ([`DepthSurface`]). With h(y, z) the depth of
//! profile and wear together, r = (x + h, y - η, z - ζ) from the nearest place, and T its two tangents:
//!
//! ```text
//! the nearest place (η, ζ) solves  (η - y, ζ - z) + (x + h) ∇h = 0,  n = (1, ∇h) / w,  g = n·r
//! K = Tᵀ ∇∇h T / w,   K' = K (1 + g K)⁻¹
//! ```
//!
//! T turns with n by the shortest way from the axes of the marker: with δn = T k, k = K' Tᵀdr, the tangents
//! turn about n by `(k₁ n_z - k₂ n_y) / (1 + n_x)`.
//!
//! For κ = 0 the arc is the plane, to the last bit of g and n. Moving by dr changes g by n·dr and turns the
//! normal by κ' t·dr, t = (-n_s, n_x). So forces along n have a potential, and energy closes.
//!
//! Limits: points may not lie beyond the center of an arc, nor beyond that of a hollow table or map. Outside
//! its first and last depth a table goes on straight; its curvature jumps there unless it is zero.

use numerics::lanes::{LANES, Lanes};
use numerics::scalar::{Number, Real};
use serde::{Deserialize, Serialize};

use crate::depth_surface::{Depth, DepthSurface};
use crate::spline::Spline;
use crate::vector::Vector;

/// The plane through the marker's origin; its outward normal is the marker's x axis, its tangents are y and
/// z.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Plane;

/// The profile of a surface, as depth h below its tangent plane over the distance s from its middle, m.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SurfaceProfile {
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
pub enum ProfileDirection {
    /// The marker's y axis.
    Y,
    /// The marker's z axis.
    #[default]
    Z,
}

/// The shape of a surface.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SurfaceShape {
    /// Its profile.
    pub profile: SurfaceProfile,
    /// Along which tangent the profile runs.
    pub direction: ProfileDirection,
    /// The further recession of it, as by wear.
    pub worn: Option<DepthSurface>,
}

/// The local geometry of a surface at a point (or at four in lanes): see the head of the module.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bend<P> {
    /// Signed distance, m: positive outside.
    pub gap: P,
    /// Normal and two tangents, in the axes of the marker.
    pub axes: [[P; 3]; 3],
    /// Curvatures at that distance, 1/m: of the first tangent, of both, of the second.
    pub curvature: [P; 3],
    /// By how much the tangents turn about the normal where it tilts along the first one and along the
    /// second.
    pub twist: [P; 2],
}

/// The same of a profile, in its plane.
struct ProfileBend<P> {
    gap: P,
    /// Components along x and along the profile.
    normal: [P; 2],
    curvature: P,
}

/// Numbers without derivatives: one, or four in lanes.
pub(crate) trait Plain: Number<Plain = Self> {
    /// Applies a function of real numbers lane by lane.
    fn each<const N: usize, const M: usize>(of: [Self; N], f: impl Fn([f64; N]) -> [f64; M]) -> [Self; M];
}

impl Plain for f64 {
    #[inline(always)]
    fn each<const N: usize, const M: usize>(of: [Self; N], f: impl Fn([f64; N]) -> [f64; M]) -> [Self; M] {
        f(of)
    }
}

impl Plain for Lanes {
    #[inline(always)]
    fn each<const N: usize, const M: usize>(of: [Self; N], f: impl Fn([f64; N]) -> [f64; M]) -> [Self; M] {
        let of = of.map(Self::to_array);
        let found: [[f64; M]; LANES] = std::array::from_fn(|lane| f(of.map(|own| own[lane])));
        std::array::from_fn(|part| Self::new(std::array::from_fn(|lane| found[lane][part])))
    }
}

/// Newton's method for the nearest place of a table ends after so many steps at the latest.
const STEPS: usize = 20;
/// It ends where a step is shorter than this, m.
const NEAR: f64 = 1e-15;

impl SurfaceProfile {
    /// Returns whether it is straight.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        matches!(self, Self::Flat)
    }

    /// Returns the radius of a crown, m; none of another profile.
    #[must_use]
    pub fn radius(&self) -> Option<f64> {
        match self {
            Self::Arc { curvature } if *curvature > 0.0 => Some(1.0 / curvature),
            Self::Arc { .. } | Self::Flat | Self::Table(_) => None,
        }
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
    fn bend<P: Plain>(&self, x: P, s: P) -> ProfileBend<P> {
        match self {
            Self::Flat => ProfileBend {
                gap: x,
                normal: [P::from(1.0), P::zero()],
                curvature: P::zero(),
            },
            Self::Arc { curvature } => {
                let (a, b) = (x * *curvature + 1.0, s * *curvature);
                let q = (a * a + b * b).sqrt();
                ProfileBend {
                    gap: (x * 2.0 + (x * x + s * s) * *curvature) / (q + 1.0),
                    normal: [a / q, b / q],
                    curvature: P::from(*curvature) / q,
                }
            }
            Self::Table(_) => {
                let [gap, along_x, along_s, curvature] = P::each([x, s], |[x, s]| self.nearest(x, s));
                ProfileBend {
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

impl SurfaceShape {
    /// Returns whether it is a plane.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        self.profile.is_flat() && self.worn.is_none()
    }

    /// Returns the local geometry of the surface at a point.
    #[inline(always)]
    pub(crate) fn bend<P: Plain>(&self, position: Vector<P>) -> Bend<P> {
        let ([x, y, z], zero, one) = (position.0, P::zero(), P::from(1.0));
        let Some(worn) = &self.worn else {
            let s = match self.direction {
                ProfileDirection::Y => y,
                ProfileDirection::Z => z,
            };
            let ProfileBend {
                gap,
                normal: [c, k],
                curvature,
            } = self.profile.bend(x, s);
            let (axes, curvature) = match self.direction {
                ProfileDirection::Y => (
                    [[c, k, zero], [-k, c, zero], [zero, zero, one]],
                    [curvature, zero, zero],
                ),
                ProfileDirection::Z => (
                    [[c, zero, k], [zero, one, zero], [-k, zero, c]],
                    [zero, zero, curvature],
                ),
            };
            return Bend {
                gap,
                axes,
                curvature,
                twist: [zero, zero],
            };
        };
        let [gap, c, a, b, first, both, second] = P::each(position.0, |place| self.nearest(worn, place));
        let own = one / (c + 1.0);
        Bend {
            gap,
            axes: [
                [c, a, b],
                [-a, one - a * a * own, -a * b * own],
                [-b, -a * b * own, one - b * b * own],
            ],
            curvature: [first, both, second],
            twist: [b * own, -a * own],
        }
    }

    /// Returns distance, normal and the three curvatures of a worn surface at a point.
    fn nearest(&self, worn: &DepthSurface, [x, y, z]: [f64; 3]) -> [f64; 7] {
        let depth = |place: [f64; 2]| {
            let mut depth = worn.evaluate(place[0], place[1]);
            let (along, twice) = match self.direction {
                ProfileDirection::Y => (0, 0),
                ProfileDirection::Z => (1, 2),
            };
            let [value, slope, second] = self.profile.depth(place[along]);
            depth.value += value;
            depth.slope[along] += slope;
            depth.second[twice] += second;
            depth
        };
        let mut place = [y, z];
        for _ in 0..STEPS {
            let Depth { value, slope, second } = depth(place);
            let [a, b] = slope;
            let far = x + value;
            let residual = [place[0] - y + far * a, place[1] - z + far * b];
            let flat = [1.0 + a * a, a * b, 1.0 + b * b];
            let mut matrix: [f64; 3] = std::array::from_fn(|k| flat[k] + far * second[k]);
            // Beyond the center of a hollow the nearest place is not unique.
            let bounds = matrix[0] > 0.5 * flat[0] && matrix[2] > 0.5 * flat[2];
            if !bounds || matrix[0] * matrix[2] - matrix[1] * matrix[1] < 0.25 {
                matrix = flat;
            }
            let [p, q, r] = matrix;
            let determinant = p * r - q * q;
            let step = [
                (r * residual[0] - q * residual[1]) / determinant,
                (p * residual[1] - q * residual[0]) / determinant,
            ];
            place = [place[0] - step[0], place[1] - step[1]];
            if step.iter().all(|step| step.abs() <= NEAR) {
                break;
            }
        }
        let Depth { value, slope, second } = depth(place);
        let w = (1.0 + slope[0] * slope[0] + slope[1] * slope[1]).sqrt();
        let (c, a, b) = (1.0 / w, slope[0] / w, slope[1] / w);
        let gap = c * (x + value) + a * (y - place[0]) + b * (z - place[1]);
        // The parts of the tangents along y and z.
        let own = 1.0 / (1.0 + c);
        let (t, e) = (
            [1.0 - a * a * own, -a * b * own],
            [-a * b * own, 1.0 - b * b * own],
        );
        let bent = |u: [f64; 2], v: [f64; 2]| {
            let [yy, yz, zz] = second;
            (u[0] * (yy * v[0] + yz * v[1]) + u[1] * (yz * v[0] + zz * v[1])) / w
        };
        let (first, both, other) = (bent(t, t), bent(t, e), bent(e, e));
        let determinant = (1.0 + gap * first) * (1.0 + gap * other) - gap * gap * both * both;
        let rest = gap * (first * other - both * both);
        [
            gap,
            c,
            a,
            b,
            (first + rest) / determinant,
            both / determinant,
            (other + rest) / determinant,
        ]
    }

    /// Returns distance and axes next to a point, with the derivatives of the point.
    #[inline(always)]
    fn local<S: Real>(&self, position: Vector<S>) -> (S, [[S; 3]; 3]) {
        let bend = self.bend::<f64>(Vector(position.0.map(|part| part.value())));
        let moved = Vector(position.0.map(|part| part - part.value()));
        let axes = bend.axes.map(|axis| axis.map(S::from));
        let [n, t, e] = axes.map(Vector);
        let [along, first, second] = resolve(&axes, moved);
        let (k, l, turn) = bend.tilt(first, second);
        let axes = [
            n + t.scale::<S, S>(k) + e.scale::<S, S>(l),
            t - n.scale::<S, S>(k) + e.scale::<S, S>(turn),
            e - n.scale::<S, S>(l) - t.scale::<S, S>(turn),
        ];
        (along + bend.gap, axes.map(|axis| axis.0))
    }

    /// Returns the signed distance of a point from the surface, m: positive outside, negative inside.
    #[inline(always)]
    pub fn gap<S: Real>(&self, point: Vector<S>) -> S {
        if self.is_flat() {
            return point.0[0];
        }
        self.local(point).0
    }

    /// Returns the components of a vector along the outward normal and the two tangents of the surface next
    /// to `point`.
    #[inline(always)]
    pub fn resolve<S: Real>(&self, point: Vector<S>, vector: Vector<S>) -> [S; 3] {
        if self.is_flat() {
            return vector.0;
        }
        resolve(&self.local(point).1, vector)
    }

    /// Returns the vector with the given components along the normal and the two tangents.
    #[inline(always)]
    pub fn compose<S: Real>(&self, point: Vector<S>, components: [S; 3]) -> Vector<S> {
        if self.is_flat() {
            return Vector(components);
        }
        compose(&self.local(point).1, components)
    }
}

impl<P: Plain> Bend<P> {
    /// Returns the angles by which the normal tilts along the first and along the second tangent, and the
    /// tangents turn about it, where the point moves by these components along the tangents.
    #[inline(always)]
    pub fn tilt<S: Number>(&self, first: S, second: S) -> (S, S, S)
    where
        P: Into<S>,
    {
        let [a, b, c] = self.curvature.map(Into::into);
        let (k, l) = (first * a + second * b, first * b + second * c);
        let [p, q] = self.twist.map(Into::into);
        (k, l, k * p + l * q)
    }
}

/// Components along the normal and two tangents of a vector in marker axes.
#[inline(always)]
pub(crate) fn resolve<S: Number>(axes: &[[S; 3]; 3], vector: Vector<S>) -> [S; 3] {
    let [x, y, z] = vector.0;
    axes.map(|[a, b, c]| x * a + y * b + z * c)
}

/// Returns the vector in marker axes with these components.
#[inline(always)]
pub(crate) fn compose<S: Number>(axes: &[[S; 3]; 3], [n, a, b]: [S; 3]) -> Vector<S> {
    let [own, t, e] = axes;
    Vector([0, 1, 2].map(|k| n * own[k] + a * t[k] + b * e[k]))
}
