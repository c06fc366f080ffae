//! Eigenvalues of the motion about a state: growth and frequency of all free vibrations, damped and steadily
//! driven ones too.
//!
//! With J the Jacobian matrix of the rates, `δx˙ = J δx`; nothing is left out: velocities, internal states,
//! forces that follow no potential. About **steady rolling** on straight track J does not depend on distance
//! and spin angle, which only drift; they give eigenvalues of zero, and the others are those of the motion
//! relative to the wheelset's steady course.
//!
//! About **steady turning** (a curve of constant radius) J turns with the motion: with the rotation R(θ) of
//! level coordinates by the heading θ it is `J(θ) = R(θ) J(0) R(-θ)`. In axes that turn along, `ξ = R(-θ)
//! δx`, the motion is `ξ˙ = (J(0) - θ˙ G) ξ` with the generator G of R, `(x, y) → (-y, x)` for each pair of
//! level displacements and of their rates: a matrix that does not depend on time.
//!
//! The eigenvalues μ of `(σ I - J)⁻¹`, which the integrator's factors give, are `1/(σ - λ)`: those near σ,
//! the slow ones, are found best. Internal states that nothing couples to a body, such as the bristles of
//! points that do not touch, are left out: they relax by themselves.

use integrate::Problem;
use nalgebra::DMatrix;
use nalgebra::linalg::balancing::balance_parlett_reinsch;

use super::System;
use crate::linear::{NoVibration, inverse_eigenvalues};

impl System {
    /// Returns the eigenvalues λ (real and imaginary part, 1/s) of the motion about a state, by falling real
    /// part; `shift` (1/s) is a positive number of the size of those that matter.
    ///
    /// # Errors
    /// They are not found: the Jacobian matrix is not finite, or `shift` is one of them.
    pub fn eigenvalues(&mut self, time: f64, x: &[f64], shift: f64) -> Result<Vec<[f64; 2]>, NoVibration> {
        self.eigenvalues_turning(time, x, shift, 0.0, &[])
    }

    /// Returns the same in axes that turn about the vertical at a steady `rate` (rad/s), positive from x to
    /// y; `level` has the numbers (among the positions) of the displacements along x and y of each free body.
    /// All else must be the same at all headings.
    ///
    /// # Errors
    /// As [`System::eigenvalues`].
    pub fn eigenvalues_turning(
        &mut self,
        time: f64,
        x: &[f64],
        shift: f64,
        rate: f64,
        level: &[[usize; 2]],
    ) -> Result<Vec<[f64; 2]>, NoVibration> {
        let all = self.layout.len() - self.layout.quadratures;
        let mut dx = vec![0.0; x.len()];
        let mut unused = vec![0.0; x.len()];
        self.derivative(time, x, &mut dx);
        self.linearize(time, x, &dx, &mut unused);
        self.factor(shift).map_err(|_| NoVibration)?;
        // Bristles of points that do not touch relax by themselves: fast, and known.
        let first = 2 * self.layout.speeds;
        let counts = |k: &usize| *k < first || self.jacobian.is_coupled((*k - first) / 2);
        let states: Vec<usize> = (0..all).filter(counts).collect();
        let n = states.len();
        let mut inverse = DMatrix::zeros(n, n);
        let mut column = vec![0.0; x.len()];
        for (j, state) in states.iter().enumerate() {
            column.fill(0.0);
            column[*state] = 1.0;
            self.solve(&mut column);
            for (i, row) in states.iter().enumerate() {
                inverse[(i, j)] = column[*row];
            }
        }
        if !inverse.iter().all(|value: &f64| value.is_finite()) {
            return Err(NoVibration);
        }
        // (σ I - J + θ˙ G)⁻¹ = (I + θ˙ M G)⁻¹ M with M = (σ I - J)⁻¹; G takes column x from y and column y
        // from x.
        if rate != 0.0 {
            let mut turned = DMatrix::identity(n, n);
            let rates = self.layout.speeds;
            for [along, aside] in level.iter().flat_map(|[x, y]| [[*x, *y], [rates + x, rates + y]]) {
                for i in 0..n {
                    turned[(i, along)] += rate * inverse[(i, aside)];
                    turned[(i, aside)] -= rate * inverse[(i, along)];
                }
            }
            inverse = turned.lu().solve(&inverse).ok_or(NoVibration)?;
        }
        // Lengths, angles and their rates, deflections: of very different sizes.
        balance_parlett_reinsch(&mut inverse);
        let values = inverse_eigenvalues(inverse).ok_or(NoVibration)?;
        let mut found: Vec<[f64; 2]> = values
            .iter()
            .map(|mu| {
                let square = mu.norm_sqr();
                [shift - mu.re / square, mu.im / square]
            })
            .collect();
        found.sort_by(|a, b| b[0].total_cmp(&a[0]).then(b[1].total_cmp(&a[1])));
        Ok(found)
    }
}
