//! Coefficients of methods.
//!
//! All methods to choose from are stiffly accurate and L-stable. The linearly implicit ones (Rosenbrock methods) stand in
//! the transformed form of Hairer & Wanner, *Solving Ordinary Differential Equations II*, 2nd ed. (1996), section IV.7,
//! which needs no product with the Jacobian matrix. One step of length `h` from `(t, x)` solves, stage by stage,
//!
//! ```text
//! (I/(hγ) - J) U_i = f(t + α_i h, x + Σ_j a_ij U_j) + (1/h) Σ_j c_ij U_j + h d_i ∂f/∂t
//! ```
//!
//! The argument of the last stage is the embedded solution; adding the last `U` to it gives the new states, so that
//! the last `U` is the error estimate. The others use the same rows: see [`Family`].

use serde::{Deserialize, Serialize};

use crate::esdirk3::ESDIRK3;
use crate::rodas::{RODAS4, RODAS4P, RODAS4P2, RODAS5P, RODAS42};
use crate::tr_bdf2::TR_BDF2;

/// Largest number of stages of a method.
pub const MAXIMUM_STAGES: usize = 8;

/// How a method finds its stages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Family {
    /// By one linear system a stage (Rosenbrock).
    #[default]
    LinearlyImplicit,
    /// By evaluation: γ is zero, `U_i = h f(t + α_i h, x + Σ_j a_ij U_j)`, and the last row of `a` makes the error estimate.
    Explicit,
    /// By Newton's method: `U_i = h f(t + α_i h, x + Σ_j a_ij U_j + γ U_i)`; the last `U` is the error estimate.
    DiagonallyImplicit,
}

/// A method as rows of data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tableau {
    /// Name of the method.
    pub name: &'static str,
    /// Where the coefficients come from.
    pub citation: &'static str,
    /// How it finds its stages.
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
    /// Dense output: with `k_r = Σ_j dense[r][j] U_j` and `ϑ = (t - t0)/h` it is
    /// `(1-ϑ) x0 + ϑ (x1 + (1-ϑ) (k_0 + ϑ (k_1 + ϑ k_2)))`.
    pub dense: &'static [&'static [f64]],
}

impl Tableau {
    /// Number of stages.
    #[must_use]
    pub fn stages(&self) -> usize {
        self.alpha.len()
    }
}

/// Choice of the method.
///
/// ```
/// use integrate::Method;
/// assert_eq!(Method::Rodas5P.tableau().order, 5);
/// assert_eq!("rodas4p".parse(), Ok(Method::Rodas4P));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Order 4(3), 6 stages: the cheapest step.
    Rodas4,
    /// Order 4(3), 6 stages, another choice of the free parameters.
    Rodas42,
    /// Order 4(3), 6 stages; no order reduction for stiff time dependence (Prothero-Robinson, parabolic problems).
    Rodas4P,
    /// Order 4(3), 6 stages; as [`Method::Rodas4P`], with smaller errors from an inexact Jacobian.
    Rodas4P2,
    /// Order 5(4), 8 stages; little order reduction; dense output of order 4.
    #[default]
    Rodas5P,
    /// Order 2, two implicit stages solved by Newton's method: damps fast vibrations instead of following them. The tolerance holds
    /// for [`crate::Problem::displacements`] alone. For averages, not for time series of what vibrates.
    TrBdf2,
    /// Order 3(2), four implicit stages solved by Newton's method: as [`Method::TrBdf2`], with a fraction of the error at tight tolerances.
    Esdirk3,
}

impl Method {
    /// All methods.
    pub const ALL: [Self; 7] = [
        Self::Rodas4,
        Self::Rodas42,
        Self::Rodas4P,
        Self::Rodas4P2,
        Self::Rodas5P,
        Self::TrBdf2,
        Self::Esdirk3,
    ];

    /// The coefficients.
    #[must_use]
    pub fn tableau(self) -> &'static Tableau {
        match self {
            Self::Rodas4 => &RODAS4,
            Self::Rodas42 => &RODAS42,
            Self::Rodas4P => &RODAS4P,
            Self::Rodas4P2 => &RODAS4P2,
            Self::Rodas5P => &RODAS5P,
            Self::TrBdf2 => &TR_BDF2,
            Self::Esdirk3 => &ESDIRK3,
        }
    }
}

impl std::fmt::Display for Method {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.tableau().name)
    }
}

/// There is no method of this name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no method `{0}`; choose Rodas4, Rodas42, Rodas4P, Rodas4P2, Rodas5P, TR-BDF2 or ESDIRK3")]
pub struct UnknownMethod(pub String);

impl std::str::FromStr for Method {
    type Err = UnknownMethod;
    fn from_str(name: &str) -> Result<Self, UnknownMethod> {
        Self::ALL
            .into_iter()
            .find(|method| method.tableau().name.eq_ignore_ascii_case(name))
            .ok_or_else(|| UnknownMethod(name.to_owned()))
    }
}
