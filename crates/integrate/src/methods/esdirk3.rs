//! `ESDIRK3(2)5L[2]SA` of Kennedy & Carpenter: order 3(2), four implicit stages of stage order 2.

use std::f64::consts::SQRT_2;

use super::tableau::{Family, Tableau};

/// Diagonal coefficient of all implicit stages.
const GAMMA: f64 = 9.0 / 40.0;

/// Abscissae of the second and the third implicit stage.
const THIRD: f64 = 9.0 * (2.0 + SQRT_2) / 40.0;
const FOURTH: f64 = 3.0 / 5.0;
/// Coefficients left of the diagonal; the first two of each stage are equal.
const A3: f64 = 9.0 * (1.0 + SQRT_2) / 80.0;
const A4: [f64; 2] = [
    (22.0 + 15.0 * SQRT_2) / (80.0 * (1.0 + SQRT_2)),
    -7.0 / (40.0 * (1.0 + SQRT_2)),
];
/// Weights of the solution, the first for the first two stages.
const B: [f64; 3] = [
    (2398.0 + 1205.0 * SQRT_2) / (2835.0 * (4.0 + 3.0 * SQRT_2)),
    -2374.0 * (1.0 + 2.0 * SQRT_2) / (2835.0 * (5.0 + 3.0 * SQRT_2)),
    5827.0 / 7560.0,
];
/// Weights of the embedded solution, likewise.
const EMBEDDED: [f64; 4] = [
    4_555_948_517_383.0 / 24_713_416_420_891.0,
    -7_107_561_914_881.0 / 25_547_637_784_726.0,
    30_698_249.0 / 44_052_120.0,
    49_563.0 / 233_080.0,
];

/// Dense output: the polynomial of degree 3 through both ends and the stages at `9/20` and [`THIRD`].
const DENSE: [[f64; 6]; 2] = {
    let end = [B[0], B[0], B[1], B[2], GAMMA];
    let stages = [
        (2.0 * GAMMA, [GAMMA, GAMMA, 0.0, 0.0, 0.0]),
        (THIRD, [A3, A3, GAMMA, 0.0, 0.0]),
    ];
    let mut rows = [[0.0; 6]; 2];
    let mut j = 0;
    while j < end.len() {
        // Distance of each stage from the chord between the ends, over `θ (1 - θ)`.
        let [(second, a), (third, b)] = stages;
        let first = (a[j] - second * end[j]) * (1.0 / (second * (1.0 - second)));
        let last = (b[j] - third * end[j]) * (1.0 / (third * (1.0 - third)));
        let rise = (last - first) / (third - second);
        (rows[0][j], rows[1][j]) = (first - second * rise, rise);
        j += 1;
    }
    rows
};

/// ESDIRK3. The first stage is the last one of the previous step (FSAL); the last stage is the new state.
pub static ESDIRK3: Tableau = Tableau {
    name: "ESDIRK3",
    citation: "C. A. Kennedy, M. H. Carpenter: Diagonally implicit Runge-Kutta methods for stiff ODEs, Appl. \
               Numer. Math. 146 (2019) 221: ESDIRK3(2)5L[2]SA",
    family: Family::DiagonallyImplicit,
    order: 3,
    embedded_order: 2,
    dense_order: 2,
    gamma: GAMMA,
    a: &[
        &[],
        &[GAMMA],
        &[A3, A3],
        &[A4[0], A4[0], A4[1]],
        &[B[0], B[0], B[1], B[2]],
        &[
            B[0] - EMBEDDED[0],
            B[0] - EMBEDDED[0],
            B[1] - EMBEDDED[1],
            B[2] - EMBEDDED[2],
            GAMMA - EMBEDDED[3],
        ],
    ],
    c: &[],
    alpha: &[0.0, 2.0 * GAMMA, THIRD, FOURTH, 1.0, 1.0],
    d: &[],
    dense: &[&DENSE[0], &DENSE[1]],
};
