//! The reproduction of Steets (2007): what `wedgelab reproduce` says of its runs.
//!
//! - [`claims`]: the statements of the thesis about its runs, each with a predicate and a verdict.
//! - [`sensitivity`]: how far these verdicts depend on the parameters that the thesis leaves open.
//! - [`agreement`]: how far the stand-alone wedge and the comparison program's wedges agree.
//! - [`three_piece`]: the rigs of the truck with four wedges, against closed forms and independent numbers.
//! - [`figures`]: the figures of the thesis, of the comparison, and of the cases beyond the thesis.
//! - [`sections`], [`page`]: the report as one page.
//!
//! ```
//! use reproduction::claims::{ClaimVerdict, Evidence, evaluate};
//!
//! // Without any run no statement can be decided.
//! let rows = evaluate(&Evidence::default());
//! assert!(rows.iter().all(|row| row.verdict == ClaimVerdict::CannotBeDecided));
//! ```

pub mod agreement;
pub mod claims;
pub mod figures;
pub mod page;
pub mod sections;
pub mod sensitivity;
pub mod three_piece;
