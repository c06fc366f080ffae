//! Elastic contact of two curved bodies of one material (Hertz 1882).
//!
//! The gap of the undeformed bodies is `A x² + B y²`, with A = ½ (1/R_wheel,x + 1/R_rail,x) along the rolling
//! direction and B likewise across it; convex curvatures are positive. With `E* = E / (2 (1 - ν²))` the load
//! N presses an ellipse whose ratio of semi-axes g solves
//!
//! ```text
//! (K - E) / (E/g² - K) = min(A, B) / max(A, B)
//! ```
//!
//! with the complete elliptic integrals K and E of the parameter `1 - g²`; then
//! `N = (4 E*/3) d^1.5 / (r_d^1.5 √(A + B))` at an approach d. K and E come from the arithmetic-geometric
//! mean. Units: N, m, Pa.
//!
//! Limits: half-spaces (a patch small against the radii), no friction in the normal problem; conformal
//! contact in the flange throat is outside of it.

use std::f64::consts::{FRAC_PI_2, PI};

use numerics::scalar::Real;
use thiserror::Error;

/// An isotropic elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Young's modulus, Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio, 0 to 0.5.
    pub poisson: f64,
}

impl Material {
    /// Returns the shear modulus, Pa.
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        self.youngs_modulus / (2.0 * (1.0 + self.poisson))
    }

    /// Returns the composite modulus E* of two bodies of this material, Pa.
    #[must_use]
    pub fn composite_modulus(&self) -> f64 {
        self.youngs_modulus / (2.0 * (1.0 - self.poisson * self.poisson))
    }
}

/// No ellipse is pressed.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum HertzError {
    /// The bodies fit or overlap in one direction.
    #[error(
        "the sum of curvatures of wheel and rail {direction} is {sum} 1/m; it must be positive: the \
         surfaces conform, and Hertz's theory does not hold there"
    )]
    Conformal {
        /// Along or across the rolling direction.
        direction: &'static str,
        /// The sum of curvatures, 1/m.
        sum: f64,
    },
    /// A constant of the material is not admissible.
    #[error("{what} is {value}; it must be {must}")]
    Material {
        /// The constant's name.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The condition on it.
        must: &'static str,
    },
}

/// A contact of given curvatures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hertz {
    /// The material of both bodies.
    pub material: Material,
    /// `N = stiffness · d^1.5`, N/m^1.5.
    pub stiffness: f64,
    /// Semi-axes over the cube root of the load, along and across the rolling direction, m/N^(1/3).
    pub axes: [f64; 2],
}

impl Hertz {
    /// Returns the contact of bodies whose curvatures (1/m) sum up to `rolling` along the rolling direction
    /// and to `lateral` across it.
    ///
    /// # Errors
    /// A sum is not positive, or a constant of the material is not admissible.
    pub fn new(material: Material, rolling: f64, lateral: f64) -> Result<Self, HertzError> {
        let admissible = |what, value: f64, holds: bool, must| match holds && value.is_finite() {
            true => Ok(()),
            false => Err(HertzError::Material { what, value, must }),
        };
        let Material {
            youngs_modulus,
            poisson,
        } = material;
        admissible(
            "Young's modulus",
            youngs_modulus,
            youngs_modulus > 0.0,
            "positive",
        )?;
        let within = (0.0..=0.5).contains(&poisson);
        admissible("Poisson's ratio", poisson, within, "from 0 to 0.5")?;
        for (direction, sum) in [
            ("along the rolling direction", rolling),
            ("across the rolling direction", lateral),
        ] {
            if !(sum > 0.0 && sum.is_finite()) {
                return Err(HertzError::Conformal { direction, sum });
            }
        }
        let (a, b) = (0.5 * rolling, 0.5 * lateral);
        let ratio = a.min(b) / a.max(b);
        let shape = EllipseShape::of(ratio);
        let modulus = material.composite_modulus();
        let size = libm::cbrt(3.0 / (4.0 * modulus * (a + b)));
        let (major, minor) = (shape.major * size, shape.minor * size);
        let axes = if b > a { [major, minor] } else { [minor, major] };
        let stiffness = 4.0 * modulus / (3.0 * shape.approach * shape.approach.sqrt() * (a + b).sqrt());
        Ok(Self {
            material,
            stiffness,
            axes,
        })
    }

    /// Returns the load (N) at an approach (m); zero if the bodies do not touch.
    #[inline(always)]
    pub fn load<S: Real>(&self, approach: S) -> S {
        if approach.value() <= 0.0 {
            return S::zero();
        }
        approach * approach.sqrt() * self.stiffness
    }

    /// Returns the approach (m) under a load (N).
    #[must_use]
    pub fn approach(&self, load: f64) -> f64 {
        let root = libm::cbrt(load / self.stiffness);
        root * root
    }

    /// Returns the semi-axes (m) along and across the rolling direction under a load (N, positive).
    #[inline(always)]
    pub fn semi_axes<S: Real>(&self, load: S) -> [S; 2] {
        let root = libm::cbrt(load.value());
        let root = load.chain(root, root / (3.0 * load.value()));
        self.axes.map(|axis| root * axis)
    }

    /// Returns the greatest pressure (Pa) under a load (N).
    #[must_use]
    pub fn greatest_pressure(&self, load: f64) -> f64 {
        let [a, b] = self.semi_axes(load);
        1.5 * load / (PI * a * b)
    }
}

/// The dimensionless ellipse: semi-axes and approach over their scales.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipseShape {
    /// Major semi-axis m.
    pub major: f64,
    /// Minor semi-axis n.
    pub minor: f64,
    /// Approach r_d.
    pub approach: f64,
}

impl EllipseShape {
    /// Returns the ellipse of a ratio of curvatures `min(A, B) / max(A, B)`, above 0 and at most 1.
    #[must_use]
    pub fn of(ratio: f64) -> Self {
        let g = axis_ratio(ratio);
        let [k, e] = elliptic_integrals(g);
        let major = libm::cbrt(2.0 * e / (PI * g * g));
        Self {
            major,
            minor: g * major,
            approach: 2.0 * k / (PI * major),
        }
    }
}

/// Returns the complete elliptic integrals K and E of the parameter `1 - g²`, g above 0 and at most 1.
#[must_use]
pub fn elliptic_integrals(g: f64) -> [f64; 2] {
    let (mut a, mut b) = (1.0, g);
    let (mut sum, mut weight) = (0.5 * (1.0 - g * g), 0.5);
    while (a - b) > 1e-16 * a {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        weight *= 2.0;
        sum += weight * c * c;
        if c < 1e-9 * a {
            break;
        }
    }
    let k = FRAC_PI_2 / (0.5 * (a + b));
    [k, k * (1.0 - sum)]
}

/// Returns the ratio of the semi-axes, by bisection of its logarithm. Near a circle the equation loses
/// digits; there `g = ratio^(2/3)` to second order.
fn axis_ratio(ratio: f64) -> f64 {
    if ratio > 1.0 - 1e-6 {
        return libm::cbrt(ratio * ratio);
    }
    let excess = |g: f64| {
        let [k, e] = elliptic_integrals(g);
        (k - e) / (e / (g * g) - k) - ratio
    };
    // g lies between the ratio and its square root.
    let (mut low, mut high) = (0.5 * libm::log(ratio) * 2.0, 0.5 * libm::log(ratio));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if excess(libm::exp(middle)) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    libm::exp(0.5 * (low + high))
}
