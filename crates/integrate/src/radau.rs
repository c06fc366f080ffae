//! The coefficients of collocation at seven points.

use crate::tableau::{Family, Tableau};

/// Number of points.
pub(crate) const POINTS: usize = 7;

/// Where the points stand in the step: the zeros of `d⁶/dx⁶ (x⁶ (x - 1)⁷)`, whose last one is the end.
pub(crate) const NODES: [f64; POINTS] = [
    0.029_316_427_159_784_893,
    0.148_078_599_668_484_3,
    0.336_984_690_281_154_3,
    0.558_671_518_771_550_1,
    0.769_233_862_030_054_5,
    0.926_945_671_319_741_1,
    1.0,
];

/// The real eigenvalue of the inverse of A.
pub(crate) const REAL: f64 = 8.936_832_788_405_216;
/// The others, real and imaginary part of one of each conjugate pair.
pub(crate) const PAIRS: [[f64; 2]; 3] = [
    [8.511_834_825_102_946, 3.281_013_624_325_059],
    [7.141_055_219_187_64, 6.623_045_922_639_276],
    [4.378_693_561_506_806, 10.169_693_283_795_011],
];

/// From values at the points to their parts along the eigenvectors: the real one, then real and imaginary part of each pair.
pub(crate) const TO_PARTS: [[f64; POINTS]; POINTS] = [
    [
        227.515_305_962_680_69,
        166.648_022_467_609_74,
        43.265_145_884_526_21,
        3.623_090_061_341_016,
        3.572_674_832_938_798,
        -2.743_556_365_603_367_5,
        1.451_453_540_254_750_4,
    ],
    [
        -149.593_124_014_126_06,
        -121.520_372_684_372_39,
        -24.388_552_039_018_936,
        -1.019_335_952_870_967_1,
        0.836_780_119_930_542_5,
        -0.543_687_016_028_553_1,
        0.450_969_124_648_049_67,
    ],
    [
        -46.538_251_448_717_65,
        11.940_815_528_140_572,
        19.639_440_365_406_923,
        7.194_457_842_745_54,
        -1.755_219_199_699_680_7,
        2.431_642_442_783_090_3,
        -1.123_241_364_795_619_9,
    ],
    [
        37.339_166_117_511_35,
        43.704_294_489_950_406,
        2.012_079_368_689_999,
        -1.857_403_157_579_182,
        -1.715_046_992_991_158_7,
        1.348_302_404_882_656_2,
        -0.469_346_371_803_773_1,
    ],
    [
        29.178_264_425_953_287,
        -5.034_386_978_900_09,
        -15.183_194_421_283_336,
        -0.510_010_432_592_433,
        -0.056_208_750_189_212_48,
        0.945_320_415_500_188_9,
        -0.485_824_319_691_574_14,
    ],
    [
        -1.503_695_084_725_646,
        -5.507_933_039_382_886,
        0.743_899_728_065_828_2,
        1.065_194_079_779_641_3,
        -0.908_070_543_408_782_8,
        0.567_162_793_947_580_5,
        -0.207_349_522_971_651_77,
    ],
    [
        -4.220_981_594_160_542,
        -0.325_262_637_028_757_5,
        3.470_335_365_184_938_2,
        -1.602_523_762_798_949_3,
        0.535_640_471_773_239_3,
        -0.177_425_374_560_811_1,
        0.045_992_745_663_932_77,
    ],
];

/// The parts of 1 and of the time in the step, with which a straight line of slopes begins.
pub(crate) const PARTS_OF_A_LINE: [[f64; 2]; POINTS] = {
    let mut parts = [[0.0; 2]; POINTS];
    let mut row = 0;
    while row < POINTS {
        let mut point = 0;
        while point < POINTS {
            parts[row][0] += TO_PARTS[row][point];
            parts[row][1] += TO_PARTS[row][point] * NODES[point];
            point += 1;
        }
        row += 1;
    }
    parts
};

/// Back from the parts to the points.
pub(crate) const FROM_PARTS: [[f64; POINTS]; POINTS] = [
    [
        0.002_443_584_304_870_611_3,
        -0.002_477_292_375_905_748_2,
        -0.005_521_234_961_087_705,
        -0.008_110_322_904_662_048,
        0.008_854_465_506_536_57,
        0.043_135_102_702_641_544,
        0.017_567_135_850_288_29,
    ],
    [
        -0.001_815_339_648_319_317,
        -0.000_133_332_706_787_926_77,
        0.006_370_949_650_332_42,
        0.016_831_136_553_119_18,
        -0.008_063_899_140_449_1,
        -0.076_263_296_268_823_1,
        -0.043_051_121_188_013_75,
    ],
    [
        0.004_605_339_331_161_875,
        -0.004_704_361_965_886_677,
        0.000_833_815_545_059_512_5,
        -0.017_120_862_123_206_865,
        -0.013_846_425_330_047_818,
        0.114_793_017_878_763_43,
        0.117_701_058_416_853_58,
    ],
    [
        0.017_870_023_342_853_068,
        0.006_230_142_304_692_350_5,
        0.050_233_209_826_877_644,
        -0.074_742_484_604_768_91,
        0.016_478_014_597_015_44,
        -0.076_429_387_193_936_7,
        -0.331_473_622_545_887_7,
    ],
    [
        0.128_181_008_077_283_91,
        0.203_435_464_963_430_3,
        0.190_090_040_712_092_46,
        0.010_733_522_758_363_541,
        0.386_422_232_202_524_03,
        -0.498_348_424_930_527_4,
        0.547_126_611_597_324_7,
    ],
    [
        0.520_065_149_748_824_7,
        1.043_503_890_549_530_6,
        0.256_143_889_271_087_8,
        1.053_148_452_916_898_6,
        0.551_068_789_979_251_7,
        1.063_169_298_167_257,
        0.972_645_673_235_145_8,
    ],
    [1.0, 2.0, 0.0, 2.0, 0.0, 2.0, 0.0],
];

/// Weights of the changes at the points in the estimate of the error.
pub(crate) const ERROR: [f64; POINTS] = [
    -6.084_307_291_132_809,
    0.783_277_943_092_000_6,
    -0.263_590_149_638_228_4,
    0.126_699_144_195_154_18,
    -0.072_384_852_898_517_4,
    0.043_363_616_009_258_24,
    -0.015_985_209_328_576_44,
];

/// Radau IIA of seven points, for stretches without kinks where something vibrates.
///
/// The states at the points are `x + Z_i`, `Z = h A f(x + Z)`: the polynomial of degree 7 through them and the start fulfils the equations at the points. All
/// coefficients follow from the points, and were computed with 60 digits. The eighth stage is the error.
pub(crate) static RADAU: Tableau = Tableau {
    name: "Radau IIA 13",
    citation: "E. Hairer, G. Wanner: Stiff differential equations solved by Radau methods, J. Comput. Appl. Math. 111 (1999) 93; Solving Ordinary \
               Differential Equations II, 2nd ed., Springer 1996, sections IV.5 and IV.8",
    family: Family::Collocation,
    order: 13,
    embedded_order: 7,
    dense_order: 7,
    gamma: 0.0,
    a: &[],
    c: &[],
    alpha: &[
        NODES[0], NODES[1], NODES[2], NODES[3], NODES[4], NODES[5], NODES[6], 1.0,
    ],
    d: &[],
    dense: &[
        &[
            54.374_436_894_128_614,
            -7.000_024_004_259_187,
            2.355_661_091_987_557,
            -1.132_289_066_106_134_4,
            0.646_891_326_767_358_7,
            -0.387_533_385_375_352_37,
            -0.857_142_857_142_857_1,
            0.0,
        ],
        &[
            -755.230_010_673_778_5,
            288.728_798_063_257_05,
            -106.081_322_583_958_55,
            52.323_122_371_025_896,
            -30.209_828_341_213_562,
            18.183_526_878_953_284,
            -7.714_285_714_285_714,
            0.0,
        ],
        &[
            3_600.870_828_284_067_6,
            -1_830.178_221_090_509_2,
            957.261_316_031_690_9,
            -517.779_768_834_475_6,
            310.048_697_511_822_2,
            -189.651_423_331_167_42,
            69.428_571_428_571_43,
            0.0,
        ],
        &[
            -7_670.897_106_142_544_5,
            4_440.552_420_492_544,
            -2_812.919_541_108_372_4,
            1_790.688_379_398_931_1,
            -1_149.477_498_041_855_6,
            725.481_916_829_869_2,
            -273.428_571_428_571_44,
            0.0,
        ],
        &[
            7_494.800_595_483_758,
            -4_662.312_139_807_13,
            3_313.200_932_776_888_3,
            -2_399.569_253_478_312,
            1_707.797_328_144_238_7,
            -1_135.631_748_833_728_6,
            433.714_285_714_285_7,
            0.0,
        ],
        &[
            -2_735.414_199_050_748,
            1_778.726_238_769_153_5,
            -1_362.198_077_510_200_2,
            1_085.503_251_260_887,
            -853.899_984_542_750_3,
            616.425_628_216_514_6,
            -245.142_857_142_857_14,
            0.0,
        ],
    ],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// A polynomial by its coefficients, the constant first.
    fn value(p: &[f64], x: f64) -> f64 {
        p.iter().rev().fold(0.0, |sum, c| sum * x + c)
    }

    /// The polynomial that is 1 at node `j` and 0 at the others.
    fn lagrange(nodes: &[f64], j: usize) -> Vec<f64> {
        let mut p = vec![1.0];
        for (_, node) in nodes.iter().enumerate().filter(|(k, _)| *k != j) {
            let scale = 1.0 / (nodes[j] - node);
            let mut next = vec![0.0; p.len() + 1];
            for (i, c) in p.iter().enumerate() {
                next[i] -= c * node * scale;
                next[i + 1] += c * scale;
            }
            p = next;
        }
        p
    }

    /// A, from the nodes alone.
    fn a() -> [[f64; POINTS]; POINTS] {
        let mut a = [[0.0; POINTS]; POINTS];
        for j in 0..POINTS {
            let p = lagrange(&NODES, j);
            let integral: Vec<f64> = std::iter::once(0.0)
                .chain(p.iter().enumerate().map(|(k, c)| c / (k + 1) as f64))
                .collect();
            for i in 0..POINTS {
                a[i][j] = value(&integral, NODES[i]);
            }
        }
        a
    }

    /// analytic: the quadrature of the last row is exact up to degree 12, what order 13 needs, and not beyond.
    #[test]
    fn the_nodes_are_those_of_order_13() {
        let b = a()[POINTS - 1];
        let integral = |degree: i32| -> f64 { b.iter().zip(&NODES).map(|(b, c)| b * c.powi(degree)).sum() };
        for degree in 0..=12 {
            let exact = 1.0 / f64::from(degree + 1);
            assert!((integral(degree) - exact).abs() < 1e-12, "{degree}");
        }
        assert!((integral(13) - 1.0 / 14.0).abs() > 1e-10);
    }

    /// analytic: parts and back is what it was, and A times its inverse by the eigenvalues is one.
    #[test]
    fn the_parts_are_those_of_the_inverse_of_a() {
        let a = a();
        for j in 0..POINTS {
            // the inverse of A, column j: parts, times eigenvalues, and back
            let parts: Vec<f64> = TO_PARTS.iter().map(|row| row[j]).collect();
            let mut scaled = vec![REAL * parts[0]];
            for ([re, im], part) in PAIRS.iter().zip(parts[1..].chunks(2)) {
                scaled.push(re * part[0] - im * part[1]);
                scaled.push(re * part[1] + im * part[0]);
            }
            let back = |parts: &[f64], i: usize| -> f64 {
                FROM_PARTS[i].iter().zip(parts).map(|(f, p)| f * p).sum()
            };
            for i in 0..POINTS {
                let one = f64::from(u8::from(i == j));
                assert!((back(&parts, i) - one).abs() < 1e-12, "{i} {j}");
                let product: f64 = (0..POINTS).map(|k| a[i][k] * back(&scaled, k)).sum();
                assert!((product - one).abs() < 1e-11, "{i} {j}");
            }
        }
    }

    /// analytic: the embedded solution, with the start as one more node of weight 1/REAL, has order 7.
    #[test]
    fn the_error_is_that_of_an_embedded_solution() {
        let a = a();
        // what the changes weigh, in slopes: ERROR·A
        let slopes: Vec<f64> = (0..POINTS)
            .map(|j| (0..POINTS).map(|i| ERROR[i] * a[i][j]).sum())
            .collect();
        for degree in 0..POINTS as i32 {
            let start = if degree == 0 { 1.0 / REAL } else { 0.0 };
            let sum: f64 = slopes.iter().zip(&NODES).map(|(w, c)| w * c.powi(degree)).sum();
            assert!((start + sum).abs() < 1e-12, "{degree}: {}", start + sum);
        }
    }

    /// analytic: the dense output goes through the states at the nodes.
    #[test]
    fn the_dense_output_interpolates() {
        let nodes: Vec<f64> = std::iter::once(0.0).chain(NODES).collect();
        for j in 0..POINTS {
            let p = lagrange(&nodes, j + 1);
            for theta in [0.1, 0.37, 0.81, 1.3] {
                let mut sum = if j == POINTS - 1 { theta } else { 0.0 };
                let mut power = theta * (1.0 - theta);
                for row in RADAU.dense {
                    sum += power * row[j];
                    power *= theta;
                }
                assert!(
                    (sum - value(&p, theta)).abs() < 1e-11 * (1.0 + sum.abs()),
                    "{j} {theta}"
                );
            }
        }
    }
}
