//! Spirals (transition curves) by their names: how curvature and superelevation change along them.
//!
//! With the share u of the length L, the curvature is `κ0 + (κ1 - κ0) f(u)`, and so is the superelevation:
//!
//! | name | f(u) | offset at the end of a spiral from a tangent, small angles |
//! |---|---|---|
//! | clothoid (Euler) | u | L²/(6 R) |
//! | bloss | 3u² - 2u³ | 3 L²/(20 R) |
//! | sine (Klein) | u - sin(2πu)/(2π) | (1/6 - 1/(4π²)) L²/R |
//! | cosine | (1 - cos πu)/2 | (1/4 - 1/π²) L²/R |
//! | helmert (Schramm) | 2u² in the first half, 1 - 2(1-u)² in the second | 7 L²/(48 R) |
//! | cubic parabola | see below | (1 + 13 L²/(40 R²)) L²/(6 R) |
//!
//! A clothoid's rate jumps at both ends; that of the others is zero there, and sine and helmert change it
//! softly too (helmert's second derivative jumps in the middle).
//!
//! A **cubic parabola** is the curve `y = c x³` over the tangent, from the tangent's end on. It is no
//! clothoid: its curvature `6 c x / (1 + 9 c² x⁴)^1.5` grows more slowly than the distance, and falls again
//! where it leads away by more than 24.1 deg (tan² = 1/5). c and the abscissa of the end are those for which
//! the arc is L long and its curvature at the end is that of the curve, as surveyors who correct the simple
//! `x³/(6 R L)` do; uncorrected, the curvature would jump there. To a length of a tenth of the radius the
//! curvature differs from the clothoid's by less than 0.6 % of the curve's, to a third by less than 6 %;
//! longer than 0.69 radii there is none. Its superelevation rises as the clothoid's. It begins or
//! ends at a tangent.
//!
//! Sources: names and laws as in IFC 4.3 (alignment segments) and LandXML, remembered; offsets derived.

use std::f64::consts::PI;

/// The form of a spiral.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SpiralForm {
    /// Curvature linear in the distance.
    #[default]
    Clothoid,
    /// Curvature a cubic of the distance, with rates of zero at both ends.
    Bloss,
    /// The curve y = c x³ over its tangent.
    CubicParabola,
    /// Klein's sine on a line.
    Sine,
    /// Half a cosine.
    Cosine,
    /// Two parabolas.
    Helmert,
}

/// A part of the law f of a spiral.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Part {
    /// Begin and end along the spiral, m.
    pub reach: [f64; 2],
    /// Coefficients of curvature (1/m) and superelevation (m) by powers of the distance (m) from the begin.
    pub curvature: [f64; 4],
    pub superelevation: [f64; 4],
    /// A wave beside them.
    pub wave: Option<Wave>,
}

/// A wave `cos(rate t + phase)` of curvature and superelevation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wave {
    /// By the distance, rad/m.
    pub rate: f64,
    /// At the begin of its part, rad.
    pub phase: f64,
    /// Amplitude of the curvature, 1/m.
    pub curvature: f64,
    /// Amplitude of the superelevation, m.
    pub superelevation: f64,
}

/// Why there is no cubic parabola.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum NoParabola {
    /// There is a curve on both sides.
    TwoCurves,
    /// It would be longer than this, m.
    Longest(f64),
}

/// Parts of a cubic parabola.
const PARABOLA_PARTS: usize = 64;
/// Largest square of the slope of a cubic parabola: there its curvature is largest.
const STEEPEST: f64 = 0.2;

/// Returns the parts of a spiral of a length (m) from a curvature (1/m) and a superelevation (m) to others.
pub(super) fn parts(
    form: SpiralForm,
    length: f64,
    curvature: [f64; 2],
    superelevation: [f64; 2],
) -> Result<Vec<Part>, NoParabola> {
    let whole = |cubic: &dyn Fn([f64; 2]) -> [f64; 4], wave| {
        vec![Part {
            reach: [0.0, length],
            curvature: cubic(curvature),
            superelevation: cubic(superelevation),
            wave,
        }]
    };
    let wave = |rate: f64, phase: f64, share: f64| {
        Some(Wave {
            rate: rate / length,
            phase,
            curvature: share * (curvature[1] - curvature[0]),
            superelevation: share * (superelevation[1] - superelevation[0]),
        })
    };
    let rate = |[from, to]: [f64; 2]| (to - from) / length;
    let linear = |ends: [f64; 2]| [ends[0], rate(ends), 0.0, 0.0];
    Ok(match form {
        SpiralForm::Clothoid => whole(&linear, None),
        SpiralForm::Bloss => whole(
            &|ends| {
                let rate = rate(ends);
                [ends[0], 0.0, 3.0 * rate / length, -2.0 * rate / (length * length)]
            },
            None,
        ),
        // sin(2πu) = -cos(2πu + π/2).
        SpiralForm::Sine => whole(&linear, wave(2.0 * PI, 0.5 * PI, 0.5 / PI)),
        SpiralForm::Cosine => whole(
            &|[from, to]| [0.5 * (from + to), 0.0, 0.0, 0.0],
            wave(PI, 0.0, -0.5),
        ),
        SpiralForm::Helmert => {
            let half = 0.5 * length;
            let bend = |ends: [f64; 2]| 2.0 * rate(ends) / length;
            let rising = |ends: [f64; 2]| [ends[0], 0.0, bend(ends), 0.0];
            let falling = |ends: [f64; 2]| [0.5 * (ends[0] + ends[1]), 2.0 * rate(ends), -bend(ends), 0.0];
            [
                (rising(curvature), rising(superelevation), [0.0, half]),
                (falling(curvature), falling(superelevation), [half, length]),
            ]
            .map(|(curvature, superelevation, reach)| Part {
                reach,
                curvature,
                superelevation,
                wave: None,
            })
            .to_vec()
        }
        SpiralForm::CubicParabola => {
            let nodes = match curvature {
                [0.0, end] => parabola(length, end)?,
                [end, 0.0] => {
                    let mut nodes = parabola(length, end)?;
                    nodes.reverse();
                    nodes.iter_mut().for_each(|[at, _, rate]| {
                        *at = length - *at;
                        *rate = -*rate;
                    });
                    nodes
                }
                _ => return Err(NoParabola::TwoCurves),
            };
            let part = |pair: &[[f64; 3]]| {
                let ([from, k0, r0], [to, k1, r1]) = (pair[0], pair[1]);
                let step = to - from;
                let chord = (k1 - k0) / step;
                let begin = superelevation[0] + rate(superelevation) * from;
                Part {
                    reach: [from, to],
                    // Hermite's cubic.
                    curvature: [
                        k0,
                        r0,
                        (3.0 * chord - 2.0 * r0 - r1) / step,
                        (r0 + r1 - 2.0 * chord) / (step * step),
                    ],
                    superelevation: [begin, rate(superelevation), 0.0, 0.0],
                    wave: None,
                }
            };
            nodes.windows(2).map(part).collect()
        }
    })
}

/// Returns places along a cubic parabola (m) from its tangent, with curvature (1/m) and its rate (1/m²).
fn parabola(length: f64, end: f64) -> Result<Vec<[f64; 3]>, NoParabola> {
    // With p = tan² of the angle at the end, X the abscissa there: L = X I(p), κ L = 2 √p I(p) / (1 + p)^1.5.
    let turn = |p: f64| 2.0 * p.sqrt() * arc(p, 1.0) / libm::pow(1.0 + p, 1.5);
    let wanted = end.abs() * length;
    if wanted > turn(STEEPEST) {
        return Err(NoParabola::Longest(turn(STEEPEST) / end.abs()));
    }
    let (mut low, mut high) = (0.0, STEEPEST);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        match turn(middle) < wanted {
            true => low = middle,
            false => high = middle,
        }
    }
    let p = 0.5 * (low + high);
    let abscissa = length / arc(p, 1.0);
    let c = end.signum() * p.sqrt() / (3.0 * abscissa * abscissa);
    Ok((0..=PARABOLA_PARTS)
        .map(|k| {
            let at = length * k as f64 / PARABOLA_PARTS as f64;
            // The share v of the abscissa with X ∫ √(1 + p v⁴) dv = s, by Newton's method.
            let mut v = at / length;
            for _ in 0..20 {
                let step = (at / abscissa - arc(p, v)) / (1.0 + p * v * v * v * v).sqrt();
                v += step;
            }
            let x = v * abscissa;
            let q = 9.0 * c * c * x * x * x * x;
            let curvature = 6.0 * c * x / libm::pow(1.0 + q, 1.5);
            // dκ/dx = 6 c (1 - 5 q) / (1 + q)^2.5, dx/ds = (1 + q)^-0.5.
            [at, curvature, 6.0 * c * (1.0 - 5.0 * q) / libm::pow(1.0 + q, 3.0)]
        })
        .collect())
}

/// Returns `∫ √(1 + p w⁴) dw` from 0 to v, by the series of the root: p is at most 1/5.
fn arc(p: f64, v: f64) -> f64 {
    let step = p * v * v * v * v;
    let (mut sum, mut term, mut order) = (1.0, 1.0, 0.0);
    while order < 40.0 {
        order += 1.0;
        term *= (1.5 - order) / order * step;
        sum += term / (4.0 * order + 1.0);
    }
    v * sum
}
