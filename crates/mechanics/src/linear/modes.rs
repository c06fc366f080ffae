//! Slow motions of a linear second-order system: growth, frequency and shape.
//!
//! `M q¨ = K q + D q˙` has motions `q = Re(φ exp(λ t))` with `(λ² M - λ D - K) φ = 0`. Those near a real
//! shift σ are found by Arnoldi's method on `(σ - J)⁻¹`, J being the matrix of `(q, q˙)`, one solution of
//! `σ² M - σ D - K` a step, with full orthogonalization (Saad, Numerical Methods for Large Eigenvalue
//! Problems, 2011, chapters 6 and 8, remembered). A Ritz pair counts if its residual is below a bound,
//! relative to the eigenvalue of the inverse; others are left out. The start vector is fixed: same input,
//! same bits.

use nalgebra::linalg::{LU, Schur};
use nalgebra::{Complex, DMatrix, DVector, Dyn};
use thiserror::Error;

/// Residual of a Ritz pair, relative to the eigenvalue of the inverse, up to which it counts.
const RESIDUAL: f64 = 1e-7;
/// Part of a vector below which nothing new is left of it.
const NOTHING_NEW: f64 = 1e-13;

/// The matrices of `M q¨ = K q + D q˙`: K and D are derivatives of the forces, so that a spring has a
/// negative stiffness there.
#[derive(Clone, Debug, PartialEq)]
pub struct SecondOrder {
    /// M, kg and so on.
    pub mass: DMatrix<f64>,
    /// K, N/m and so on.
    pub stiffness: DMatrix<f64>,
    /// D, N·s/m and so on.
    pub damping: DMatrix<f64>,
}

/// A motion.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearMode {
    /// λ: growth and angular frequency, 1/s; the frequency is not negative.
    pub value: Complex<f64>,
    /// φ, the largest entry of `√M φ` being 1.
    pub shape: Vec<Complex<f64>>,
}

impl LinearMode {
    /// Returns its frequency, Hz.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        self.value.im / (2.0 * std::f64::consts::PI)
    }

    /// Returns its growth, 1/s: negative where it dies away.
    #[must_use]
    pub fn growth(&self) -> f64 {
        self.value.re
    }
}

/// `(σ - J)⁻¹` in scaled coordinates.
struct Inverse<'m> {
    own: &'m SecondOrder,
    shift: f64,
    factors: LU<f64, Dyn, Dyn>,
    /// Square roots of the masses.
    scales: DVector<f64>,
}

impl Inverse<'_> {
    /// Applies it to `(σ √m q, √m u)`.
    fn apply(&self, vector: &DVector<f64>) -> Option<DVector<f64>> {
        let n = self.scales.len();
        let q = vector.rows(0, n).component_div(&self.scales) / self.shift;
        let u = vector.rows(n, n).component_div(&self.scales);
        let own = self.own;
        let right = &own.mass * (u + &q * self.shift) - &own.damping * &q;
        let moved = self.factors.solve(&right)?;
        let rate = &moved * self.shift - &q;
        let mut out = DVector::zeros(2 * n);
        out.rows_mut(0, n)
            .copy_from(&(moved.component_mul(&self.scales) * self.shift));
        out.rows_mut(n, n).copy_from(&rate.component_mul(&self.scales));
        Some(out)
    }
}

impl SecondOrder {
    /// Returns the motions near the shift σ (1/s, positive), found within at most this many steps, by falling
    /// growth; of a pair of conjugate ones that with the positive frequency.
    ///
    /// # Errors
    /// The matrices hold values that are not finite, or the shift is an eigenvalue.
    pub fn modes(&self, shift: f64, steps: usize) -> Result<Vec<LinearMode>, NoVibration> {
        let n = self.mass.nrows();
        let matrix = &self.mass * (shift * shift) - &self.damping * shift - &self.stiffness;
        if !matrix.iter().all(|value| value.is_finite()) {
            return Err(NoVibration);
        }
        let inverse = Inverse {
            own: self,
            shift,
            factors: matrix.lu(),
            scales: DVector::from_fn(n, |i, _| self.mass[(i, i)].sqrt()),
        };
        let most = steps.min(2 * n);
        let start = DVector::from_fn(2 * n, |i, _| libm::cos(1.0 + 1.618 * i as f64));
        let mut basis = vec![start.normalize()];
        let mut hessenberg = DMatrix::zeros(most + 1, most);
        let mut count = most;
        for step in 0..most {
            let mut next = inverse.apply(&basis[step]).ok_or(NoVibration)?;
            let whole = next.norm();
            if !whole.is_finite() {
                return Err(NoVibration);
            }
            // Twice is enough.
            for _ in 0..2 {
                for (row, own) in basis.iter().enumerate() {
                    let part = own.dot(&next);
                    hessenberg[(row, step)] += part;
                    next.axpy(-part, own, 1.0);
                }
            }
            let left = next.norm();
            hessenberg[(step + 1, step)] = left;
            if left <= NOTHING_NEW * whole {
                count = step + 1;
                break;
            }
            basis.push(next / left);
        }
        let last = if basis.len() > count {
            hessenberg[(count, count - 1)]
        } else {
            0.0
        };
        let square = hessenberg.view((0, 0), (count, count)).into_owned();
        let eigenvalues = inverse_eigenvalues(square.clone()).ok_or(NoVibration)?;
        let mut found = Vec::new();
        for mu in &eigenvalues {
            // λ = σ - 1/μ
            let value = Complex::new(shift, 0.0) - mu.inv();
            if value.im < 0.0 || !value.re.is_finite() {
                continue;
            }
            let Some(own) = ritz(&square, *mu) else { continue };
            if (last * own[count - 1].norm()) > RESIDUAL * mu.norm() {
                continue;
            }
            let mut shape = DVector::<Complex<f64>>::zeros(n);
            for (vector, by) in basis.iter().zip(own.iter()) {
                for (to, from) in shape.iter_mut().zip(vector.rows(0, n).iter()) {
                    *to += by * *from;
                }
            }
            found.push(LinearMode {
                value,
                shape: self.normalized(shape, &inverse.scales),
            });
        }
        found.sort_by(|a, b| {
            b.value
                .re
                .total_cmp(&a.value.re)
                .then(b.value.im.total_cmp(&a.value.im))
        });
        Ok(found)
    }

    /// Returns the shape of `√M φ` divided by its largest entry and brought back to coordinates.
    fn normalized(&self, scaled: DVector<Complex<f64>>, scales: &DVector<f64>) -> Vec<Complex<f64>> {
        let largest = scaled
            .iter()
            .copied()
            .fold(Complex::new(0.0, 0.0), |most: Complex<f64>, own| {
                if own.norm_sqr() > most.norm_sqr() {
                    own
                } else {
                    most
                }
            });
        let own = scaled.iter().zip(scales.iter());
        own.map(|(value, scale)| value / largest / *scale).collect()
    }
}

/// Returns the eigenvector of a small matrix of this eigenvalue, of norm 1, by inverse iteration.
fn ritz(matrix: &DMatrix<f64>, mu: Complex<f64>) -> Option<DVector<Complex<f64>>> {
    let n = matrix.nrows();
    // Beside the eigenvalue, so that the matrix can be solved.
    let beside = mu + Complex::new(mu.norm() * 1e-10, 0.0);
    let shifted = DMatrix::from_fn(n, n, |i, j| {
        let own = Complex::new(matrix[(i, j)], 0.0);
        if i == j { own - beside } else { own }
    });
    let factors = shifted.lu();
    let mut vector = DVector::from_fn(n, |i, _| Complex::new(libm::cos(1.0 + i as f64), 0.0));
    for _ in 0..3 {
        vector = factors.solve(&vector)?;
        let size = vector.norm();
        if !(size > 0.0 && size.is_finite()) {
            return None;
        }
        vector.unscale_mut(size);
    }
    Some(vector)
}

/// Eigenvalues could not be found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "the eigenvalues of the linearized system were not found: its stiffness holds values that are not \
     finite or too far apart"
)]
pub struct NoVibration;

/// Returns the eigenvalues μ of the inverse of a shifted matrix, or of what stands for it.
///
/// Those of fast motions are so small that rounding keeps sub-diagonal entries beside them above the smallest
/// bound for being zero, which is relative to its neighbors. A bound t moves the μ of slow motions by about t
/// of themselves: the largest by 2e-8.
pub(crate) fn inverse_eigenvalues(matrix: DMatrix<f64>) -> Option<DVector<Complex<f64>>> {
    let n = matrix.nrows();
    let mut bounds = [1.0, 100.0, 1e4, 1e6, 1e8]
        .into_iter()
        .map(|times| times * f64::EPSILON);
    let schur = bounds.find_map(|bound| Schur::try_new(matrix.clone(), bound, 20 * n + 1000))?;
    Some(schur.complex_eigenvalues())
}
