//! The greatest pressure of an ellipse over its semi-axis along the rolling direction.
//!
//! `C = p0 / a = E* A f(g)` with the ratio g = b/a of the semi-axes across and along it, from Hertz's
//! equations for the curvature along a: `f = (1 - g²) / (g (K - E))` for g < 1, with complete elliptic
//! integrals of the parameter 1 - g², and `f = (g² - 1) / (g² E - K)` for g > 1, of 1 - 1/g². A
//! circle has f = 4/π. ln f is a table over ln g with slopes, 1/16 apart (relative error below 1e-6),
//! from g = 1/148 to 148; beyond, its end slopes go on.

use std::sync::LazyLock;

use crate::hertz::elliptic_integrals;

const STEP: f64 = 1.0 / 16.0;
const LARGEST: f64 = 5.0;
/// Half the step of differences for the slopes of the table.
const DIFFERENCE: f64 = 4e-3;
/// ln g within which f, whose terms lose digits there, is a straight line over g.
const CIRCLE: f64 = 1e-3;
/// ln g from and up to which the local condition takes over: g = 0.35 and 1.
const NARROW: f64 = -1.049_822_124_498_7;
const WIDE: f64 = 0.0;

static NODES: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| {
    let exact = |x: f64| {
        let g = libm::exp(x);
        if x.abs() < CIRCLE {
            let ends = [1.0 - 2.0 * CIRCLE, 1.0 + 2.0 * CIRCLE];
            let [low, high] = ends.map(factor);
            return libm::log(low + (high - low) * (g - ends[0]) / (4.0 * CIRCLE));
        }
        libm::log(factor(g))
    };
    let count = (LARGEST / STEP) as i32;
    let nodes = (-count..=count).map(|i| {
        let x = f64::from(i) * STEP;
        [
            exact(x),
            (exact(x + DIFFERENCE) - exact(x - DIFFERENCE)) / (2.0 * DIFFERENCE),
        ]
    });
    nodes.collect()
});

/// f(g).
fn factor(g: f64) -> f64 {
    if g < 1.0 {
        let [k, e] = elliptic_integrals(g);
        (1.0 - g * g) / (g * (k - e))
    } else {
        let [k, e] = elliptic_integrals(1.0 / g);
        (g * g - 1.0) / (g * g * e - k)
    }
}

/// Returns ln f and its slope at ln g.
pub(super) fn log_factor(x: f64) -> [f64; 2] {
    let nodes = NODES.as_slice();
    let relative = (x + LARGEST) / STEP;
    let index = (relative.max(0.0) as usize).min(nodes.len() - 2);
    let t = relative - index as f64;
    let ([a, da], [b, db]) = (nodes[index], nodes[index + 1]);
    if t < 0.0 {
        return [a + da * t * STEP, da];
    }
    if t > 1.0 {
        return [b + db * (t - 1.0) * STEP, db];
    }
    let (da, db) = (da * STEP, db * STEP);
    let (c, d) = (3.0 * (b - a) - 2.0 * da - db, da + db - 2.0 * (b - a));
    [
        a + t * (da + t * (c + t * d)),
        (da + t * (2.0 * c + t * 3.0 * d)) / STEP,
    ]
}

/// Returns the share of the local condition and its slope at ln g.
pub(super) fn share(x: f64) -> [f64; 2] {
    let t = (x - NARROW) / (WIDE - NARROW);
    if t <= 0.0 {
        return [0.0, 0.0];
    }
    if t >= 1.0 {
        return [1.0, 0.0];
    }
    [t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) / (WIDE - NARROW)]
}
