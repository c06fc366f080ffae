//! Normal contact on strips: loads at which the displaced surfaces meet, without tension.
//!
//! A strip k of the width w_k carries the load q_k per width as a semi-elliptic pressure over its half length
//! a_k. With the places s along the surfaces, `d = s_j - s_k` and I, J of `kernel.rs`, the surface at the
//! middle of strip j is moved and bent along the rolling direction by
//!
//! ```text
//! u_j = Σ C_k a_k² / (π E*) ΔI_jk,      ΔI_jk = I((d + w_k/2) / a_k) - I((d - w_k/2) / a_k)
//! u_j'' = -Σ C_k / (π E*) ΔJ_jk,        C_k = 2 q_k / (π a_k²)
//! ```
//!
//! where C is the greatest pressure of a strip over its half length. In contact both are those of the bodies:
//! the overlap h_j, and the curvature `-2 A_j` of their gap. The second condition is met with the C of the
//! strip itself in place of its neighbors': `C_j = 2 π E* A_j / W_j`, `W_j = Σ ΔJ_jk`. In an ellipse all C
//! are the same, so that ellipses are found exactly but for the finite number of strips; wide patches tend to
//! plane strain, `C = E* A`.
//!
//! The sum W needs many strips where a patch is narrow. There C is that of the ellipse whose ratio of
//! semi-axes across and along, g = b/a, is that of the part (from the variance of the a_k² over the places
//! and from their mean): `C_j = E* A_j f(g)` (`ratio.rs`). Between g = 0.35 and 1 ln C passes from one to the
//! other; in an ellipse they are equal. Both are taken from the lengths of the round before: two rounds, the
//! first one from the ellipse of the depth and the half width of the overlap. So the loads of a round are
//! unique.
//!
//! The first condition,
//!
//! ```text
//! Σ C_k a_k² ΔI_jk / (π E*) = h_j   where a_j > 0,   ≥ h_j   where a_j = 0,
//! ```
//!
//! is solved for the squares of the half lengths by Newton's method. Strips that would be pulled leave the
//! contact, those that the surfaces would penetrate join it. As a strip's half length falls to zero its
//! compliance grows without bound (as its logarithm): it appears and vanishes smoothly. Derivatives follow
//! from the solved equations (theorem of implicit functions).

use std::f64::consts::PI;

use numerics::scalar::Real;

use super::super::search::AREAS;
use super::influence::{free, influences, moved};
use super::kernel::Influence;
use super::rates::Rates;

/// Strips of a part.
pub const STRIPS: usize = 16;
/// Most parts that are solved together.
pub(super) const PARTS: usize = 2 * AREAS;
/// Rounds: C from the last loads, then loads at that C.
const ROUNDS: usize = 2;
/// Most steps of Newton's method.
const STEPS: usize = 40;
/// Change over the largest unknown at which it ends: the next one would be of the order of its square.
const ENOUGH: f64 = 1e-6;
/// Penetration over the overlap from which a strip joins the contact, and its first unknown over the largest.
const PENETRATION: f64 = 1e-12;
const JOINS: f64 = 1e-3;
/// Least factor of a square in a step, and the square over the largest below which it is zero.
const SHRINKS: f64 = 0.01;
const VANISHES: f64 = 1e-9;

/// Share with which parts press each other, from 0 (not) to 1.
pub(super) type Couplings<S> = [[S; PARTS]; PARTS];

/// A part of a contact: strips of one width.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<S> {
    /// Normal overlap at the middle of each strip, m.
    pub overlap: [S; STRIPS],
    /// Its place along the surfaces, m.
    pub place: [S; STRIPS],
    /// Half of the sum of curvatures along the rolling direction, 1/m.
    pub curvature: [S; STRIPS],
    /// Width of a strip, m.
    pub width: S,
    /// First estimate of the squares of half lengths, m².
    pub start: [S; STRIPS],
}

impl Part<f64> {
    const NONE: Self = Self {
        overlap: [0.0; STRIPS],
        place: [0.0; STRIPS],
        curvature: [0.0; STRIPS],
        width: 0.0,
        start: [0.0; STRIPS],
    };
}

impl<S: Real> Part<S> {
    /// Returns the values without derivatives.
    fn plain(&self) -> Part<f64> {
        Part {
            overlap: self.overlap.map(Real::value),
            place: self.place.map(Real::value),
            curvature: self.curvature.map(Real::value),
            width: self.width.value(),
            start: self.start.map(Real::value),
        }
    }
}

/// Loads of a part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Loads<S> {
    /// Load per width, N/m.
    pub line: [S; STRIPS],
    /// Half length, m.
    pub half_length: [S; STRIPS],
}

/// The solution at given C without derivatives, for N strips.
struct Solution<const N: usize> {
    /// Squares of half lengths, m².
    squares: [f64; N],
    /// ΔI of each strip in contact on all strips.
    influence: [[f64; N]; N],
    /// Triangular factors of the matrix of Newton's method over the strips in contact.
    factors: [[f64; N]; N],
    /// Strips in contact.
    order: [usize; N],
    active: usize,
}

impl<const N: usize> Solution<N> {
    fn of(parts: &[Part<f64>], couplings: &Couplings<f64>, rates: &[f64; N], start: &[f64; N]) -> Self {
        let count = parts.len() * STRIPS;
        let mut own = Self {
            squares: *start,
            influence: [[0.0; N]; N],
            factors: [[0.0; N]; N],
            order: [0; N],
            active: 0,
        };
        let mut residual = [0.0; N];
        for step in 0..STEPS {
            own.set(parts, couplings, rates, &mut residual);
            let largest = own.squares[..count].iter().fold(0.0, |a: f64, b| a.max(*b));
            let mut changed = false;
            if step > 0 {
                for i in 0..count {
                    let overlap = parts[i / STRIPS].overlap[i % STRIPS];
                    if own.squares[i] == 0.0 && residual[i] < -PENETRATION * overlap.abs() {
                        own.squares[i] = JOINS * largest;
                        changed = true;
                    }
                }
                if changed {
                    own.set(parts, couplings, rates, &mut residual);
                }
            }
            own.factor();
            let mut change = [0.0; N];
            for (own, strip) in change.iter_mut().zip(&own.order[..own.active]) {
                *own = residual[*strip];
            }
            back(&own.factors, own.active, &mut change);
            let mut greatest = 0.0_f64;
            for (change, &i) in change.iter().zip(&own.order[..own.active]) {
                greatest = greatest.max(change.abs() / largest);
                let before = own.squares[i];
                let next = before - change;
                own.squares[i] = next.max(before * SHRINKS);
                if next < before * SHRINKS && own.squares[i] < VANISHES * largest {
                    own.squares[i] = 0.0;
                    changed = true;
                }
            }
            if !changed && greatest < ENOUGH {
                break;
            }
        }
        own
    }

    /// Sets up the equations at the unknowns.
    fn set(
        &mut self,
        parts: &[Part<f64>],
        couplings: &Couplings<f64>,
        rates: &[f64; N],
        residual: &mut [f64; N],
    ) {
        self.active = 0;
        for i in 0..parts.len() * STRIPS {
            residual[i] = -parts[i / STRIPS].overlap[i % STRIPS];
            if self.squares[i] > 0.0 {
                self.order[self.active] = i;
                self.active += 1;
            }
        }
        let mut rows = [usize::MAX; N];
        for (row, strip) in self.order[..self.active].iter().enumerate() {
            rows[*strip] = row;
        }
        for p in 0..parts.len() {
            let squares = &self.squares[p * STRIPS..(p + 1) * STRIPS];
            let (influence, factors) = (&mut self.influence, &mut self.factors);
            influences(
                Influence::Displacement,
                parts,
                p,
                squares,
                |q, j, m, difference, _| {
                    let (k, coupling) = (p * STRIPS + m, couplings[q][p]);
                    let (value, rate) = (difference.value * coupling, rates[k] / PI);
                    influence[rows[k]][j] = value;
                    residual[j] += rate * squares[m] * value;
                    if let Some(row) = factors.get_mut(rows[j]) {
                        row[rows[k]] = rate * (value - 0.5 * coupling * difference.scaled);
                    }
                },
            );
        }
    }

    /// Factors the matrix of Newton's method.
    fn factor(&mut self) {
        let count = self.active;
        for pivot in 0..count {
            let upper = self.factors[pivot];
            let inverse = 1.0 / upper[pivot];
            for row in &mut self.factors[pivot + 1..count] {
                let factor = row[pivot] * inverse;
                row[pivot] = factor;
                for (own, above) in row[pivot + 1..count].iter_mut().zip(&upper[pivot + 1..count]) {
                    *own -= factor * above;
                }
            }
        }
    }

    /// Returns the changes of the squares as the parts and, by `grown` relatively, C change.
    fn changes<S: Real>(
        &self,
        parts: &[Part<S>],
        plain: &[Part<f64>],
        couplings: &Couplings<S>,
        rates: &[f64; N],
        grown: &[S; N],
    ) -> [S; N] {
        let mut changes = [S::zero(); N];
        let order = &self.order[..self.active];
        let mut rows = [usize::MAX; N];
        for (row, &strip) in order.iter().enumerate() {
            rows[strip] = row;
            changes[row] = free(parts[strip / STRIPS].overlap[strip % STRIPS]);
        }
        let weight = |k: usize| rates[k] * self.squares[k] / PI;
        let displacement = Influence::Displacement;
        let weighted = (&self.squares[..], weight);
        moved(displacement, parts, plain, couplings, weighted, |j, change| {
            if let Some(own) = changes.get_mut(rows[j]) {
                *own -= change;
            }
        });
        for (row, &j) in order.iter().enumerate() {
            for (column, &k) in order.iter().enumerate() {
                changes[row] -= grown[k] * (weight(k) * self.influence[column][j]);
            }
        }
        back(&self.factors, self.active, &mut changes);
        let mut gained = [S::zero(); N];
        for (change, &strip) in changes.iter().zip(order) {
            gained[strip] = *change;
        }
        gained
    }
}

/// Replaces the first `count` entries of the right-hand side by the solution.
fn back<S: Real, const N: usize>(matrix: &[[f64; N]; N], count: usize, right: &mut [S; N]) {
    for row in 1..count {
        let mut sum = right[row];
        for (own, factor) in right[..row].iter().zip(&matrix[row][..row]) {
            sum -= *own * *factor;
        }
        right[row] = sum;
    }
    for row in (0..count).rev() {
        let mut sum = right[row];
        for (own, factor) in right[row + 1..count].iter().zip(&matrix[row][row + 1..count]) {
            sum -= *own * *factor;
        }
        right[row] = sum * (1.0 / matrix[row][row]);
    }
}

/// Solves parts and gives the loads of each to `take`; `modulus` is E*, Pa.
#[inline(always)]
pub(super) fn solve<S: Real>(
    parts: &[Part<S>],
    couplings: &Couplings<S>,
    modulus: f64,
    take: impl FnMut(usize, &Loads<S>),
) {
    match parts.len() {
        1 => solve_sized::<S, STRIPS>(parts, couplings, modulus, take),
        2 => solve_sized::<S, { 2 * STRIPS }>(parts, couplings, modulus, take),
        _ => solve_sized::<S, { PARTS * STRIPS }>(parts, couplings, modulus, take),
    }
}

#[inline(always)]
fn solve_sized<S: Real, const N: usize>(
    parts: &[Part<S>],
    couplings: &Couplings<S>,
    modulus: f64,
    mut take: impl FnMut(usize, &Loads<S>),
) {
    let mut plain = [Part::<f64>::NONE; PARTS];
    for (own, part) in plain.iter_mut().zip(parts) {
        *own = part.plain();
    }
    let plain = &plain[..parts.len()];
    let values = couplings.map(|row| row.map(Real::value));
    let derived = size_of::<S>() != size_of::<f64>();
    let (mut squares, mut gained) = ([0.0; N], [S::zero(); N]);
    for (p, part) in parts.iter().enumerate() {
        for m in 0..STRIPS {
            let start = part.start[m];
            squares[p * STRIPS + m] = start.value();
            gained[p * STRIPS + m] = free(start);
        }
    }
    let (mut rates, mut grown) = ([0.0; N], [S::zero(); N]);
    for _ in 0..ROUNDS {
        let own = Rates::of(plain, &values, &squares, derived);
        rates = own.rates;
        let solution = Solution::of(plain, &values, &rates, &squares);
        if derived {
            grown = own.changes(parts, plain, couplings, (&squares, &gained));
            gained = solution.changes(parts, plain, couplings, &rates, &grown);
        }
        squares = solution.squares;
    }
    for p in 0..parts.len() {
        let mut loads = Loads {
            line: [S::zero(); STRIPS],
            half_length: [S::zero(); STRIPS],
        };
        for m in 0..STRIPS {
            let k = p * STRIPS + m;
            if squares[k] <= 0.0 {
                continue;
            }
            let square = S::from(squares[k]) + gained[k];
            loads.line[m] = square * (grown[k] + 1.0) * (0.5 * PI * modulus * rates[k]);
            loads.half_length[m] = square.sqrt();
        }
        take(p, &loads);
    }
}
