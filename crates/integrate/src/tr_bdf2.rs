//! The diagonally implicit method that damps fast vibrations.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use crate::tableau::{Family, Tableau};

/// Where the first implicit stage stands, and the weights of both formulas.
const MIDDLE: f64 = 2.0 - SQRT_2;
const GAMMA: f64 = 1.0 - FRAC_1_SQRT_2;
const W: f64 = 0.25 * SQRT_2;

/// Dense output: the polynomial of degree 2 through both ends and the stage between them.
const BETWEEN: f64 = 1.0 / (MIDDLE * (1.0 - MIDDLE));

/// Twice the constant of the error, `-0.0404 h³ x'''`.
const ERROR: f64 = 2.0 * (-3.0 * MIDDLE * MIDDLE + 4.0 * MIDDLE - 2.0) / (12.0 * (2.0 - MIDDLE));

/// The trapezoidal rule to 0.59 of the step, and the second backward differentiation formula through that point to its end.
///
/// The first stage is the last one of the step before. All stages are of order 2, so that what a stiff spring holds keeps its order, its
/// speed as well: a method of order 2 with stages of order 1 (Alexander's, 1977) errs there by a third of the step times the acceleration.
pub static TR_BDF2: Tableau = Tableau {
    name: "TR-BDF2",
    citation: "R. E. Bank et al.: Transient simulation of silicon devices and circuits, IEEE Trans. Electron Devices 32 (1985) 1992; as \
               a method with an embedded one: M. E. Hosea, L. F. Shampine: Analysis and implementation of TR-BDF2, Appl. Numer. \
               Math. 20 (1996) 21",
    family: Family::DiagonallyImplicit,
    order: 2,
    embedded_order: 2,
    dense_order: 2,
    gamma: GAMMA,
    a: &[
        &[],
        &[GAMMA],
        &[W, W],
        // The second divided difference of the rates.
        &[ERROR / MIDDLE, -ERROR * BETWEEN, ERROR / (1.0 - MIDDLE)],
    ],
    c: &[],
    alpha: &[0.0, MIDDLE, 1.0, 1.0],
    d: &[],
    dense: &[&[
        (GAMMA - MIDDLE * W) * BETWEEN,
        (GAMMA - MIDDLE * W) * BETWEEN,
        -MIDDLE * GAMMA * BETWEEN,
        0.0,
    ]],
};
