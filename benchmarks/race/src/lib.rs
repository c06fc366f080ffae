//! The solver race: other people's solvers and ours on the same equations, side by side.
//!
//! - [`problem`]: the problems by name.
//! - [`equations`]: state, rates and Jacobian matrix, as every other solver gets them; [`c_interface`] for
//!   drivers in C, Python and Octave (`drivers/`); [`wedge_case`] for the one that has the equations in its
//!   own language.
//! - [`own`], [`diffsol`]: the drivers in Rust; [`outcome`]: what every driver reports.
//! - [`contest`]: who runs; [`runner`]: runs them; [`measure`], [`standings`]: errors, fronts, ratios;
//!   [`tables`], [`figures`]: what is shown of them; [`page`]: `docs/race.md`.

pub mod c_interface;
pub mod clock;
pub mod contest;
#[cfg(feature = "solvers")]
pub mod diffsol;
pub mod equations;
#[cfg(feature = "figures")]
pub mod figures;
pub mod measure;
pub mod outcome;
pub mod own;
pub mod page;
pub mod problem;
pub mod runner;
pub mod standings;
pub mod tables;
pub mod wedge_case;
