//! The explicit Runge-Kutta pair of Tsitouras: order 5(4), seven stages, first same as last (FSAL).
//!
//! The argument of the seventh stage is the new state; the eighth row of `a` holds the weights of the error
//! estimate. Decision 0039 compares this pair with that of Dormand & Prince.

use super::tableau::{Family, Tableau};

/// Weights of the new state.
const B: [f64; 6] = [
    0.096_460_766_818_065_23,
    0.01,
    0.479_889_650_414_499_6,
    1.379_008_574_103_742,
    -3.290_069_515_436_081,
    2.324_710_524_099_774,
];

/// Weights of θ² in the dense output.
const SECOND: [f64; 7] = [
    -2.763_706_197_274_826,
    0.131_7,
    3.930_296_236_894_751_6,
    -12.411_077_166_933_676,
    37.509_313_416_511_04,
    -27.896_526_289_197_286,
    1.5,
];

/// Weights of θ⁴ in the dense output.
const FOURTH: [f64; 7] = [
    -1.053_088_497_729_021_6,
    0.101_7,
    2.490_627_285_651_253,
    -16.548_102_889_244_902,
    47.379_521_962_819_28,
    -34.870_657_861_496_61,
    2.5,
];

/// Tsitouras 5(4).
pub static TSITOURAS: Tableau = Tableau {
    name: "Tsitouras 5(4)",
    citation: "Ch. Tsitouras: Runge-Kutta pairs of order 5(4) satisfying only the first column simplifying \
               assumption, Computers & Mathematics with Applications 62 (2011) 770",
    family: Family::Explicit,
    order: 5,
    embedded_order: 4,
    dense_order: 4,
    gamma: 0.0,
    a: &[
        &[],
        &[0.161],
        &[-0.008_480_655_492_356_989, 0.335_480_655_492_357],
        &[
            2.897_153_057_105_493_5,
            -6.359_448_489_975_075,
            4.362_295_432_869_581_5,
        ],
        &[
            5.325_864_828_439_257,
            -11.748_883_564_062_828,
            7.495_539_342_889_836_5,
            -0.092_495_066_361_755_25,
        ],
        &[
            5.861_455_442_946_42,
            -12.920_969_317_847_11,
            8.159_367_898_576_159,
            -0.071_584_973_281_401,
            -0.028_269_050_394_068_383,
        ],
        &B,
        &[
            -0.001_780_011_052_225_771_4,
            -0.000_816_434_459_656_746_9,
            0.007_880_878_010_261_995,
            -0.144_711_007_173_262_9,
            0.582_357_165_452_555_2,
            -0.458_082_105_929_186_97,
            1.0 / 66.0,
        ],
    ],
    c: &[],
    alpha: &[0.0, 0.161, 0.327, 0.9, 0.980_025_540_904_509_7, 1.0, 1.0, 1.0],
    d: &[],
    // Of θ (1 - θ), θ² (1 - θ), θ³ (1 - θ).
    dense: &[
        &[1.0 - B[0], -B[1], -B[2], -B[3], -B[4], -B[5], 0.0, 0.0],
        &[
            1.0 - B[0] + SECOND[0],
            SECOND[1] - B[1],
            SECOND[2] - B[2],
            SECOND[3] - B[3],
            SECOND[4] - B[4],
            SECOND[5] - B[5],
            SECOND[6],
            0.0,
        ],
        &[
            -FOURTH[0], -FOURTH[1], -FOURTH[2], -FOURTH[3], -FOURTH[4], -FOURTH[5], -FOURTH[6], 0.0,
        ],
    ],
};
