//! The integration methods, one file each.
//!
//! All methods that can be chosen are stiffly accurate and L-stable: a Rosenbrock method and two ESDIRK
//! methods. The explicit method of [`explicit`] is not chosen; it takes over from a Rosenbrock method while
//! steps are short against 1/(spectral radius), see [`crate::Options::explicit_steps`].

pub(crate) mod esdirk3;
pub(crate) mod explicit;
pub(crate) mod rodas5p;
pub(crate) mod tableau;
pub(crate) mod tr_bdf2;

use serde::{Deserialize, Serialize};

use esdirk3::ESDIRK3;
use rodas5p::RODAS5P;
use tableau::Tableau;
use tr_bdf2::TR_BDF2;

/// Choice of the method.
///
/// ```
/// use integrate::Method;
/// assert_eq!(Method::Rodas5P.tableau().order, 5);
/// assert_eq!("tr-bdf2".parse(), Ok(Method::TrBdf2));
/// assert!("rodas4".parse::<Method>().is_err());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Rosenbrock, order 5(4), 8 stages; little order reduction; dense output of order 4.
    #[default]
    Rodas5P,
    /// ESDIRK, order 2, two implicit stages: damps fast vibrations instead of following them. The tolerance
    /// holds for [`crate::ProblemStructure::displacements`] alone. For averages, not for time series of what
    /// vibrates.
    TrBdf2,
    /// ESDIRK, order 3(2), four implicit stages: as [`Method::TrBdf2`], with a fraction of its error at tight
    /// tolerances.
    Esdirk3,
}

impl Method {
    /// All methods.
    pub const ALL: [Self; 3] = [Self::Rodas5P, Self::TrBdf2, Self::Esdirk3];

    /// Returns the coefficients.
    #[must_use]
    pub fn tableau(self) -> &'static Tableau {
        match self {
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
#[error("there is no method `{0}`; choose Rodas5P, TR-BDF2 or ESDIRK3")]
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
