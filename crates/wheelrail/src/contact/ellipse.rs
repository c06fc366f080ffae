//! Hertz's ellipse by a table, with derivatives.
//!
//! The dimensionless semi-axis along the rolling direction and the approach r_d depend on `x = ln(B/A)`
//! alone; the semi-axis across it is that of `-x`. Logarithms of both are cubics between exact values 1/12
//! apart (relative error below 1e-6 against [`Hertz`](crate::hertz::Hertz)). Beyond |x| = 9 the ratio B/A is
//! held: such contacts conform, and Hertz's theory does not hold for them.

use std::sync::LazyLock;

use numerics::scalar::Real;

use crate::hertz::{EllipseShape, Hertz, HertzError, Material};

/// Largest |ln(B/A)|.
const LARGEST: f64 = 9.0;
/// Spacing of the table.
const STEP: f64 = 1.0 / 12.0;
/// Step of differences for the slopes of the table.
const DIFFERENCE: f64 = 1e-4;

/// Logarithm of the semi-axis along the rolling direction and of r_d, each with its slope: the table.
static NODES: LazyLock<Vec<[[f64; 2]; 2]>> = LazyLock::new(|| {
    let exact = |x: f64| {
        let shape = EllipseShape::of(libm::exp(-x.abs()));
        let along = if x > 0.0 { shape.major } else { shape.minor };
        [libm::log(along), libm::log(shape.approach)]
    };
    let count = (LARGEST / STEP) as i32;
    let nodes = (-count..=count).map(|i| {
        let x = f64::from(i) * STEP;
        let (here, [up, down]) = (exact(x), [exact(x + DIFFERENCE), exact(x - DIFFERENCE)]);
        [0, 1].map(|k| [here[k], (up[k] - down[k]) / (2.0 * DIFFERENCE)])
    });
    nodes.collect()
});

/// Stiffness and axes of one contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse<S> {
    /// `N = stiffness · d^1.5`, N/m^1.5.
    pub stiffness: S,
    /// Semi-axes over the cube root of the load, along and across the rolling direction, m/N^(1/3).
    pub axes: [S; 2],
}

/// The table with a material.
#[derive(Clone, Debug)]
pub struct Ellipses {
    material: Material,
    nodes: &'static [[[f64; 2]; 2]],
}

impl Ellipses {
    /// Returns the table with a material.
    ///
    /// # Errors
    /// A constant of the material is not admissible.
    pub fn new(material: Material) -> Result<Self, HertzError> {
        // The constants are checked there.
        Hertz::new(material, 1.0, 1.0)?;
        Ok(Self {
            material,
            nodes: NODES.as_slice(),
        })
    }

    /// Returns the material.
    #[must_use]
    pub fn material(&self) -> Material {
        self.material
    }

    /// Returns the ellipse of sums of curvatures (1/m, positive) along and across the rolling direction.
    #[inline(always)]
    pub fn of<S: Real>(&self, rolling: S, lateral: S) -> Ellipse<S> {
        let ratio = lateral / rolling;
        let x = libm::log(ratio.value());
        let x = if x.abs() < LARGEST {
            ratio.chain(x, 1.0 / ratio.value())
        } else {
            S::from(LARGEST.copysign(x))
        };
        let [along, approach] = self.at(x).map(Real::exp);
        let [across, _] = self.at(-x).map(Real::exp);
        let sum = (rolling + lateral) * 0.5;
        let modulus = self.material.composite_modulus();
        let size = sum.recip() * (3.0 / (4.0 * modulus));
        let root = libm::cbrt(size.value());
        let size = size.chain(root, root / (3.0 * size.value()));
        Ellipse {
            stiffness: (approach * approach.sqrt() * sum.sqrt()).recip() * (4.0 * modulus / 3.0),
            axes: [along * size, across * size],
        }
    }

    /// Returns both logarithms at x.
    #[inline(always)]
    fn at<S: Real>(&self, x: S) -> [S; 2] {
        let relative = (x.value() + LARGEST) / STEP;
        let index = (relative.max(0.0) as usize).min(self.nodes.len() - 2);
        let t = relative - index as f64;
        let (from, to) = (&self.nodes[index], &self.nodes[index + 1]);
        [0, 1].map(|k| {
            let ([a, da], [b, db]) = (from[k], to[k]);
            let (da, db) = (da * STEP, db * STEP);
            let (c, d) = (3.0 * (b - a) - 2.0 * da - db, da + db - 2.0 * (b - a));
            let value = a + t * (da + t * (c + t * d));
            let slope = (da + t * (2.0 * c + t * 3.0 * d)) / STEP;
            x.chain(value, slope)
        })
    }
}
