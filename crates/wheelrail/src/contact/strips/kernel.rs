//! Displacement of a half-space under a strip of semi-elliptic pressure, by a table.
//!
//! A line along x with the pressure `√(1 - (x/a)²)` for |x| < a and a width dy moves the surface at a
//! distance `t a` square to its middle by `G(t) dy / (π E*)` and bends it along x there by `-H(t) dy /
//! (π E* a²)`:
//!
//! ```text
//! G(t) = ∫ √(1 - s²) / √(s² + t²) ds from -1 to 1 = 2 √(1 + t²) (K(m) - E(m)),   m = 1 / (1 + t²)
//! H(t) = G'' + G'/t = G(t) / (1 + t²)
//! ```
//!
//! with complete elliptic integrals K and E of the parameter m; H follows from Laplace's equation, which the
//! potential of the line obeys beside it. Strips need the integrals I and J of G and H from 0 to t. Between
//! 2^-10 and 2^10 they are tables of cubics, sixteen to an octave, through exact values and slopes (relative
//! error below 1e-7); cells follow from the bits of t, so no logarithm is needed. Below, both are
//! `2 t ln(4/t)`; above, I grows by `(π/2) ln t`, and J is π.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::LazyLock;

use super::super::section::hermite;
use crate::hertz::elliptic_integrals;

/// Exponents of two between which the table lies.
const LOWEST: i32 = -10;
const HIGHEST: i32 = 10;
/// Bits of the mantissa that number the cells of an octave.
const BITS: u32 = 4;
const CELLS: usize = ((HIGHEST - LOWEST) as usize) << BITS;
/// Points and weights of Gauss's rule on 0 to 1.
const GAUSS: [[f64; 2]; 5] = [
    [0.046_910_077_030_668, 0.118_463_442_528_095],
    [0.230_765_344_947_158, 0.239_314_335_249_683],
    [0.5, 0.284_444_444_444_444],
    [0.769_234_655_052_842, 0.239_314_335_249_683],
    [0.953_089_922_969_332, 0.118_463_442_528_095],
];

/// Which influence of a strip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Influence {
    /// Displacement: I and G.
    Displacement,
    /// Bending: J and H.
    Bending,
}

/// Tables of both influences: the beginning of each cell, and its cubic from the constant on.
#[derive(Debug)]
pub(super) struct StripKernel {
    cells: [Vec<[f64; 5]>; 2],
    /// I at the end of the table.
    last: f64,
}

static KERNEL: LazyLock<StripKernel> = LazyLock::new(StripKernel::new);

/// Returns the tables.
pub(super) fn kernel() -> &'static StripKernel {
    &KERNEL
}

/// G(t) and H(t), t positive.
fn exact(t: f64) -> [f64; 2] {
    let root = (1.0 + t * t).sqrt();
    let [k, e] = elliptic_integrals(t / root);
    [2.0 * root * (k - e), 2.0 * (k - e) / root]
}

/// The number of a value's cell, counted from zero.
#[inline(always)]
fn cell_of(t: f64) -> i64 {
    let first = ((1023 + LOWEST) as i64) << BITS;
    (t.to_bits() >> (52 - BITS)) as i64 - first
}

/// The beginning of a cell.
fn beginning(cell: usize) -> f64 {
    let first = ((1023 + LOWEST) as u64) << BITS;
    f64::from_bits((first + cell as u64) << (52 - BITS))
}

impl StripKernel {
    fn new() -> Self {
        let lowest = beginning(0);
        let mut last = 0.0;
        let cells = [0, 1].map(|which| {
            let mut value = 2.0 * lowest * libm::log(4.0 / lowest);
            let cells = (0..CELLS).map(|cell| {
                let [from, to] = [beginning(cell), beginning(cell + 1)];
                let length = to - from;
                let points = GAUSS.map(|[at, weight]| exact(from + length * at)[which] * weight);
                let next = value + length * points.iter().sum::<f64>();
                let slopes = [exact(from)[which], exact(to)[which]];
                let [a, b, c, d] = hermite(length, [value, next], slopes);
                value = next;
                [from, a, b, c, d]
            });
            let cells = cells.collect();
            if which == 0 {
                last = value;
            }
            cells
        });
        Self { cells, last }
    }

    /// Returns the integral, which is odd, and the function, which is even, at t.
    #[inline(always)]
    pub fn at(&self, influence: Influence, t: f64) -> [f64; 2] {
        let size = t.abs();
        let cells = &self.cells[usize::from(influence == Influence::Bending)];
        let [value, slope] = match cells.get(cell_of(size) as usize) {
            Some([from, a, b, c, d]) => {
                let s = size - from;
                [a + s * (b + s * (c + s * d)), b + s * (2.0 * c + s * 3.0 * d)]
            }
            None => self.beyond(influence, size),
        };
        [value.copysign(t), slope]
    }

    #[cold]
    fn beyond(&self, influence: Influence, t: f64) -> [f64; 2] {
        if t >= 1.0 {
            return match influence {
                Influence::Displacement => {
                    let log = libm::log(t / beginning(CELLS));
                    [self.last + FRAC_PI_2 * log, FRAC_PI_2 / t]
                }
                Influence::Bending => [PI, 0.0],
            };
        }
        if t == 0.0 {
            return [0.0; 2];
        }
        let log = libm::log(4.0 / t);
        [2.0 * t * log, 2.0 * (log - 1.0)]
    }
}
