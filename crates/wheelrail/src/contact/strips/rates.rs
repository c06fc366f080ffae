//! Pressures of strips over their half lengths: from bending, or from the ellipse of the part where it is
//! narrow (see `solve.rs`).

use std::f64::consts::PI;

use numerics::scalar::Real;

use super::influence::{free, influences, moved};
use super::kernel::Influence;
use super::ratio::{self, log_factor};
use super::solve::{Couplings, PARTS, Part, STRIPS};

/// Least variance of the squares of a part over the square of a strip's width.
const LEAST_SPREAD: f64 = 1.0 / 12.0;

/// Pressures over half lengths, from squares of half lengths.
pub(super) struct Rates<const N: usize> {
    /// C / E* of each strip, 1/m.
    pub rates: [f64; N],
    /// W of each strip, and its derivatives by the square of strip k.
    bending: [f64; N],
    bending_by: [[f64; N]; N],
    /// Share of W in ln C of each part; slopes of ln C by ln g, and of ln g by the square, of each strip.
    shares: [f64; PARTS],
    by_ratio: [f64; N],
    ratio_by: [f64; N],
}

impl<const N: usize> Rates<N> {
    /// Returns them; `derived` says whether slopes are needed.
    pub fn of(parts: &[Part<f64>], couplings: &Couplings<f64>, squares: &[f64; N], derived: bool) -> Self {
        let mut own = Self {
            rates: [0.0; N],
            bending: [0.0; N],
            bending_by: [[0.0; N]; N],
            shares: [0.0; PARTS],
            by_ratio: [0.0; N],
            ratio_by: [0.0; N],
        };
        // A strip out of contact bends as one whose half length falls to zero.
        for (bending, square) in own.bending.iter_mut().zip(squares) {
            *bending = if *square > 0.0 { 0.0 } else { 2.0 * PI };
        }
        for p in 0..parts.len() {
            let squares = &squares[p * STRIPS..(p + 1) * STRIPS];
            influences(Influence::Bending, parts, p, squares, |q, j, m, difference, _| {
                own.bending[j] += couplings[q][p] * difference.value;
                if derived {
                    let by = -couplings[q][p] * 0.5 / squares[m] * difference.scaled;
                    own.bending_by[j][p * STRIPS + m] = by;
                }
            });
        }
        for (p, part) in parts.iter().enumerate() {
            own.part(p, part, &squares[p * STRIPS..(p + 1) * STRIPS]);
        }
        own
    }

    /// Finds C of a part from W and g.
    fn part(&mut self, p: usize, part: &Part<f64>, squares: &[f64]) {
        let both = || squares.iter().zip(&part.place);
        let sum: f64 = squares.iter().sum();
        let fourths: f64 = squares.iter().map(|square| square * square).sum();
        let least = sum.max(f64::MIN_POSITIVE);
        let mean = both().map(|(square, s)| square * s).sum::<f64>() / least;
        let away = |s: &f64| (s - mean) * (s - mean);
        let variance = both().map(|(square, s)| square * away(s)).sum::<f64>() / least;
        // A single strip has no variance; it is as wide as it is.
        let spread = variance.max(part.width * part.width * LEAST_SPREAD);
        // A part whose load falls to none is as wide as can be over its half lengths.
        let log = match sum > 0.0 {
            true => 0.5 * libm::log(4.0 * spread * sum / fourths),
            false => f64::INFINITY,
        };
        let [factor, slope] = if sum > 0.0 { log_factor(log) } else { [0.0; 2] };
        let [share, share_slope] = ratio::share(log);
        self.shares[p] = share;
        for (m, square) in squares.iter().enumerate() {
            let k = p * STRIPS + m;
            if *square > 0.0 {
                let by_spread = match spread > variance {
                    true => 0.0,
                    false => (away(&part.place[m]) - variance) / (sum * variance),
                };
                self.ratio_by[k] = 0.5 * by_spread - square / fourths + 0.5 / sum;
            }
            let local = libm::log(2.0 * PI / self.bending[k]);
            self.by_ratio[k] = share_slope * (local - factor) + (1.0 - share) * slope;
            self.rates[k] = part.curvature[m] * libm::exp(share * local + (1.0 - share) * factor);
        }
    }

    /// Returns the relative changes of C as the parts and the squares change: derivatives alone.
    pub fn changes<S: Real>(
        &self,
        parts: &[Part<S>],
        plain: &[Part<f64>],
        couplings: &Couplings<S>,
        squares: (&[f64; N], &[S; N]),
    ) -> [S; N] {
        let (values, changed) = squares;
        let (mut grown, mut ratios) = ([S::zero(); N], [S::zero(); PARTS]);
        for (p, part) in parts.iter().enumerate() {
            let own = p * STRIPS..(p + 1) * STRIPS;
            ratios[p] = free(part.width) * (1.0 / part.width.value());
            for k in own.clone() {
                ratios[p] += changed[k] * self.ratio_by[k];
            }
        }
        let count = parts.len() * STRIPS;
        let local = self.shares.iter().any(|share| *share > 0.0);
        if local {
            let bending = Influence::Bending;
            moved(
                bending,
                parts,
                plain,
                couplings,
                (values, |_| 1.0),
                |j, change| grown[j] += change,
            );
            for j in 0..count {
                for k in 0..count {
                    if values[k] > 0.0 {
                        grown[j] += changed[k] * self.bending_by[j][k];
                    }
                }
            }
        }
        for j in 0..count {
            let (p, m) = (j / STRIPS, j % STRIPS);
            let curvature = parts[p].curvature[m];
            grown[j] = free(curvature) * (1.0 / curvature.value()) + ratios[p] * self.by_ratio[j]
                - grown[j] * (self.shares[p] / self.bending[j]);
        }
        grown
    }
}
