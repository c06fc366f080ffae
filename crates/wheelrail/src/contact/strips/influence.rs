//! Influences of strips on each other, and how they change as parts move.

use numerics::scalar::Real;

use super::kernel::{Influence, kernel};
use super::solve::{Couplings, Part, STRIPS};

/// Influence of a strip, I or J with its function G or H: differences over its edges.
#[derive(Clone, Copy, Default)]
pub(super) struct Difference {
    /// ΔI or ΔJ.
    pub value: f64,
    /// Δ(t G) or Δ(t H).
    pub scaled: f64,
    /// ΔG or ΔH, and the sum of G or H over the edges.
    pub slope: f64,
    pub sum: f64,
}

/// Gives the influence of each strip m in contact of part p on each strip j (of part q) to `take`, with its
/// half length.
#[inline(always)]
pub(super) fn influences(
    influence: Influence,
    parts: &[Part<f64>],
    p: usize,
    squares: &[f64],
    mut take: impl FnMut(usize, usize, usize, Difference, f64),
) {
    let (kernel, part) = (kernel(), &parts[p]);
    let width = part.width;
    for m in 0..STRIPS {
        if squares[m] == 0.0 {
            continue;
        }
        let half = squares[m].sqrt();
        let inverse = 1.0 / half;
        // Strips of this part on one side of strip m, by their distance.
        let mut beside = [Difference::default(); STRIPS];
        let (step, mut before) = (width * inverse, [0.0; 3]);
        for (i, own) in beside.iter_mut().enumerate().take(m.max(STRIPS - 1 - m) + 1) {
            let t = (i as f64 + 0.5) * step;
            let [value, slope] = kernel.at(influence, t);
            let scaled = t * slope;
            *own = match i {
                0 => Difference {
                    value: 2.0 * value,
                    scaled: 2.0 * scaled,
                    slope: 0.0,
                    sum: 2.0 * slope,
                },
                _ => Difference {
                    value: value - before[0],
                    scaled: scaled - before[2],
                    slope: slope - before[1],
                    sum: slope + before[1],
                },
            };
            before = [value, slope, scaled];
        }
        for n in 0..STRIPS {
            let mut own = beside[n.abs_diff(m)];
            if n < m {
                own.slope = -own.slope;
            }
            take(p, p * STRIPS + n, m, own, half);
        }
        for (q, other) in parts.iter().enumerate().filter(|(q, _)| *q != p) {
            for (n, place) in other.place.iter().enumerate() {
                let away = place - part.place[m];
                let [t1, t0] = [0.5, -0.5].map(|side| (away + side * width) * inverse);
                let ([v1, s1], [v0, s0]) = (kernel.at(influence, t1), kernel.at(influence, t0));
                let own = Difference {
                    value: v1 - v0,
                    scaled: t1 * s1 - t0 * s0,
                    slope: s1 - s0,
                    sum: s1 + s0,
                };
                take(q, q * STRIPS + n, m, own, half);
            }
        }
    }
}

/// The derivatives of a number, without its value.
#[inline(always)]
pub(super) fn free<S: Real>(value: S) -> S {
    value - value.value()
}

/// Gives how the sums over influences of strips k with their weights on strip j change as the parts move, at
/// the half lengths as they are.
#[inline(always)]
pub(super) fn moved<S: Real>(
    influence: Influence,
    parts: &[Part<S>],
    plain: &[Part<f64>],
    couplings: &Couplings<S>,
    (squares, weight): (&[f64], impl Fn(usize) -> f64),
    mut take: impl FnMut(usize, S),
) {
    for p in 0..parts.len() {
        let width = free(parts[p].width);
        let own = &squares[p * STRIPS..(p + 1) * STRIPS];
        let mut by_width = [0.0; STRIPS];
        influences(influence, plain, p, own, |q, j, m, difference, half| {
            let (k, n, inverse) = (p * STRIPS + m, j % STRIPS, 1.0 / half);
            let (slope, sum) = (difference.slope, 0.5 * difference.sum);
            if q == p {
                let apart = n as f64 - m as f64;
                by_width[n] += weight(k) * (apart * slope + sum) * inverse;
                return;
            }
            let away = free(parts[q].place[n]) - free(parts[p].place[m]);
            let coupling = couplings[q][p];
            let change = (away * slope + width * sum) * (coupling.value() * inverse)
                + free(coupling) * difference.value;
            take(j, change * weight(k));
        });
        for (n, slope) in by_width.into_iter().enumerate() {
            take(p * STRIPS + n, width * slope);
        }
    }
}
