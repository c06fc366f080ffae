//! TR-BDF2: the trapezoidal rule and the second backward differentiation formula as one ESDIRK step of order
//! 2.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use super::tableau::{Family, Tableau};

/// Abscissa of the intermediate stage, 2 - √2 = 0.586.
const MIDDLE: f64 = 2.0 - SQRT_2;
/// Diagonal coefficient of both implicit stages.
const GAMMA: f64 = 1.0 - FRAC_1_SQRT_2;
/// Weight of the first two stages in the solution.
const W: f64 = 0.25 * SQRT_2;

/// Factor of the dense output, the polynomial of degree 2 through both ends and the intermediate stage.
const INTERPOLATION: f64 = 1.0 / (MIDDLE * (1.0 - MIDDLE));

/// Twice the error constant; the local error is `-0.0404 h³ x'''`.
const ERROR: f64 = 2.0 * (-3.0 * MIDDLE * MIDDLE + 4.0 * MIDDLE - 2.0) / (12.0 * (2.0 - MIDDLE));

/// TR-BDF2: the trapezoidal rule up to 0.59 of the step, then BDF2 through that point to the end of the step.
///
/// The first stage is the last one of the previous step (FSAL). All stages have order 2, so a coordinate that
/// is held by a stiff spring keeps order 2, and so does its speed. A method of order 2 whose stages have
/// order 1 (R. Alexander, SIAM J. Numer. Anal. 14 (1977) 1006) has an error of h/3 times the acceleration in
/// that speed.
pub static TR_BDF2: Tableau = Tableau {
    name: "TR-BDF2",
    citation: "R. E. Bank et al.: Transient simulation of silicon devices and circuits, IEEE Trans. Electron \
               Devices 32 (1985) 1992; as an embedded pair: M. E. Hosea, L. F. Shampine: Analysis and \
               implementation of TR-BDF2, Appl. Numer. Math. 20 (1996) 21",
    family: Family::DiagonallyImplicit,
    order: 2,
    embedded_order: 2,
    dense_order: 2,
    gamma: GAMMA,
    a: &[
        &[],
        &[GAMMA],
        &[W, W],
        // The second divided difference of the stage derivatives.
        &[ERROR / MIDDLE, -ERROR * INTERPOLATION, ERROR / (1.0 - MIDDLE)],
    ],
    c: &[],
    alpha: &[0.0, MIDDLE, 1.0, 1.0],
    d: &[],
    dense: &[&[
        (GAMMA - MIDDLE * W) * INTERPOLATION,
        (GAMMA - MIDDLE * W) * INTERPOLATION,
        -MIDDLE * GAMMA * INTERPOLATION,
        0.0,
    ]],
};
