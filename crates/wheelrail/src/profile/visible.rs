//! The part of a profile that a wheel or a rail can touch with: where it is not steeper than 82°.

use super::ProfileCurve;

/// Steepest direction that is part of a section, rad: 82°.
const STEEPEST: f64 = 1.431_169_986_635_35;
/// Step of the walk along a curve, m.
const SPACING: f64 = 1e-4;

/// Returns the range of parameters around `datum` in which the curve is not steeper than 82° of level.
pub(crate) fn visible_from(curve: &ProfileCurve, datum: f64) -> [f64; 2] {
    let [low, high] = curve.range();
    let level = |parameter: f64| curve.at(parameter).angle().abs() <= STEEPEST;
    let walk = |direction: f64| {
        let end = if direction > 0.0 { high } else { low };
        let mut at = datum;
        loop {
            let next = at + direction * SPACING;
            let beyond = (next - end) * direction >= 0.0;
            let next = if beyond { end } else { next };
            if !level(next) {
                // Bisect the place where it becomes too steep.
                let (mut inside, mut outside) = (at, next);
                for _ in 0..30 {
                    let middle = 0.5 * (inside + outside);
                    *(if level(middle) { &mut inside } else { &mut outside }) = middle;
                }
                return inside;
            }
            if beyond {
                return end;
            }
            at = next;
        }
    };
    [walk(-1.0), walk(1.0)]
}

/// Returns the parameter at which y is zero.
pub(crate) fn zero_of(curve: &ProfileCurve) -> Option<f64> {
    let sample = curve.sample(SPACING);
    sample.windows(2).find_map(|pair| {
        let ([y0, _], [y1, _]) = (pair[0].1.position, pair[1].1.position);
        (y0 <= 0.0 && y1 > 0.0).then(|| pair[0].0 + (pair[1].0 - pair[0].0) * y0 / (y0 - y1))
    })
}
