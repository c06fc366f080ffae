//! The data of a method: its coefficients and orders.

use serde::{Deserialize, Serialize};

/// Largest number of stages of a method.
pub const MAXIMUM_STAGES: usize = 8;

/// Families of methods, by the equations of their stages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Family {
    /// Rosenbrock method: one linear system per stage, with the Jacobian matrix at the start of the step,
    ///
    /// ```text
    /// (I/(hγ) - J) U_i = f(t + α_i h, x + Σ_j a_ij U_j) + (1/h) Σ_j c_ij U_j + h d_i ∂f/∂t .
    /// ```
    ///
    /// This is the transformed form of Hairer & Wanner, *Solving Ordinary Differential Equations II*, 2nd ed.
    /// (1996), section IV.7, which needs no product with J. The argument of the last stage is the embedded
    /// solution; adding the last `U` to it gives the new state, so the last `U` is the error estimate.
    #[default]
    LinearlyImplicit,
    /// Explicit Runge-Kutta method: γ is zero, `U_i = h f(t + α_i h, x + Σ_j a_ij U_j)`. The last row of `a`
    /// holds the weights of the error estimate.
    Explicit,
    /// ESDIRK method: `U_i = h f(t + α_i h, x + Σ_j a_ij U_j + γ U_i)`, solved by Newton's method; the first
    /// stage is explicit. The last row of `a` holds the weights of the error estimate.
    DiagonallyImplicit,
}

/// The coefficients of a method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tableau {
    /// Name of the method.
    pub name: &'static str,
    /// Source of the coefficients.
    pub citation: &'static str,
    /// The family of methods that computes the stages.
    pub family: Family,
    /// Order of the solution.
    pub order: u32,
    /// Order of the embedded solution, from which the error is estimated.
    pub embedded_order: u32,
    /// Order of the dense output.
    pub dense_order: u32,
    /// γ.
    pub gamma: f64,
    /// a: row `i` has `i` entries.
    pub a: &'static [&'static [f64]],
    /// c: row `i` has `i` entries.
    pub c: &'static [&'static [f64]],
    /// α.
    pub alpha: &'static [f64],
    /// d.
    pub d: &'static [f64],
    /// Dense output: with `k_r = Σ_j dense[r][j] U_j` and `θ = (t - t0)/h` it is
    /// `(1-θ) x0 + θ (x1 + (1-θ) (k_0 + θ (k_1 + θ k_2)))`.
    pub dense: &'static [&'static [f64]],
}

impl Tableau {
    /// Returns the number of stages, the error estimate included.
    #[must_use]
    pub fn stages(&self) -> usize {
        self.alpha.len()
    }
}
