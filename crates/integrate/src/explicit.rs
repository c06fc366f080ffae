//! The explicit method for where nothing is stiff: the seventh argument is the new state, and the eighth row of `a` makes the error
//! estimate of the seven `U`.

use crate::tableau::{Family, Tableau};

/// Weights of the new state.
const B: [f64; 7] = [
    35.0 / 384.0,
    0.0,
    500.0 / 1113.0,
    125.0 / 192.0,
    -2187.0 / 6784.0,
    11.0 / 84.0,
    0.0,
];

/// Weights of the fourth power in the dense output.
const D: [f64; 7] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

/// Dormand & Prince's method.
pub static DORMAND_PRINCE: Tableau = Tableau {
    name: "Dormand-Prince 5(4)",
    citation: "J. R. Dormand, P. J. Prince: A family of embedded Runge-Kutta formulae, J. Comp. Appl. Math. 6 (1980) 19; dense \
               output: E. Hairer, S. P. Nørsett, G. Wanner: Solving Ordinary Differential Equations I, 2nd ed., Springer 1993, \
               section II.6, and code DOPRI5",
    family: Family::Explicit,
    order: 5,
    embedded_order: 4,
    dense_order: 4,
    gamma: 0.0,
    a: &[
        &[],
        &[1.0 / 5.0],
        &[3.0 / 40.0, 9.0 / 40.0],
        &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
        &[
            19_372.0 / 6561.0,
            -25_360.0 / 2187.0,
            64_448.0 / 6561.0,
            -212.0 / 729.0,
        ],
        &[
            9017.0 / 3168.0,
            -355.0 / 33.0,
            46_732.0 / 5247.0,
            49.0 / 176.0,
            -5103.0 / 18_656.0,
        ],
        &[B[0], B[1], B[2], B[3], B[4], B[5]],
        &[
            71.0 / 57_600.0,
            0.0,
            -71.0 / 16_695.0,
            71.0 / 1920.0,
            -17_253.0 / 339_200.0,
            22.0 / 525.0,
            -1.0 / 40.0,
        ],
    ],
    c: &[],
    alpha: &[0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0, 1.0],
    d: &[],
    dense: &[
        &[1.0 - B[0], -B[1], -B[2], -B[3], -B[4], -B[5], 0.0, 0.0],
        &[
            2.0 * B[0] - 1.0 + D[0],
            0.0,
            2.0 * B[2] + D[2],
            2.0 * B[3] + D[3],
            2.0 * B[4] + D[4],
            2.0 * B[5] + D[5],
            D[6] - 1.0,
            0.0,
        ],
        &[-D[0], -D[1], -D[2], -D[3], -D[4], -D[5], -D[6], 0.0],
    ],
};
