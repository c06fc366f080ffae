//! Physical quantities at the doors of the program: what a user types, and the names and
//! factors of what a user reads.
//!
//! Inside, every number is SI. Outside, a number always carries its unit:
//!
//! ```
//! use quantity::{Kind, Quantity};
//!
//! let stiffness = Quantity::parse_as("3000 lbf/in", Kind::Stiffness)?;
//! assert!((stiffness.to_si() - 525_380.505_739_429).abs() < 1e-9);
//! assert_eq!(stiffness.to_string(), "3000 lbf/in");
//!
//! let error = Quantity::parse_as("10.25 in", Kind::Force).unwrap_err();
//! assert_eq!(error.to_string(), "this is a length (in); a force is expected");
//! # Ok::<(), quantity::UnitError>(())
//! ```
//!
//! - [`Quantity`]: a value and its unit, as typed.
//! - [`Kind`]: what a number stands for: its dimension, its name, its units in a [`System`].
//! - [`UnitError`]: what is wrong with a text, where, and what to write instead.

#![warn(missing_docs)]

mod dimension;
mod error;
mod expression;
mod hint;
mod kind;
mod nearest;
mod parse;
mod pattern;
mod units;

pub use dimension::Dimension;
pub use error::UnitError;
pub use expression::Unit;
pub use hint::length_hint;
pub use kind::{Kind, System};
pub use nearest::nearest;
pub use parse::{Number, Quantity, SixDigits};
pub use pattern::{fits_pattern, is_pattern};
pub use units::{INCH, POUND, POUND_FORCE, STANDARD_GRAVITY};
