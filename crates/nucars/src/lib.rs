//! Input files of NUCARS, the vehicle dynamics program of the North American railways: reading, checking,
//! showing.
//!
//! - [`source`]: texts and places in them,
//! - [`tree`]: what the files say, typed, as typed, in the files' units,
//! - [`read`]: text to tree, with all mistakes and their places,
//! - [`mod@write`]: tree to text,
//! - [`check`]: what a tree lacks or contradicts, alone and together with the files it belongs to,
//! - [`mod@set`]: single values laid over trees,
//! - [`show`]: a system as tables,
//! - [`files`]: finding the files that a run names; [`file_sets`]: files that belong together,
//! - [`truck`]: a system and its inputs as a model that can be run,
//! - [`builtin`]: the half-truck of Steets (2007), appendices A and B.
//!
//! The program's manual is not public. The grammar and the meaning of the values follow the files printed in
//! R. Steets, "Three-dimensional multibody modeling of railway friction wedges", Virginia Tech 2007,
//! appendices A and B, with what their comments and numbers tell.
//!
//! ```
//! use nucars::read::read_system;
//! use nucars::tree::Law;
//! use nucars::{builtin, check};
//!
//! let source = builtin::source("bolst_wedge_sf_69_const.sys").expect("a file of the thesis");
//! let read = read_system(&source);
//! let doubts = check::system(&read);
//! // The tree, or all errors with their places.
//! let system = read.with(doubts).strict()?;
//!
//! let wedge = system.connection(127).expect("a wedge");
//! let characteristic = *wedge.element.characteristics()[0];
//! let law = &system.characteristic(characteristic).expect("its law").law;
//! let Law::StickSlipWedge3d { coil, .. } = law else {
//!     unreachable!("type 6.9");
//! };
//! assert_eq!(system.function(**coil).expect("the coil").value(0.0), -3702.2);
//! # Ok::<(), nucars::FileErrors>(())
//! ```

#![warn(missing_docs)]

pub mod builtin;
pub mod check;
pub mod file_sets;
pub mod files;
mod finding;
mod lexer;
mod number;
pub mod read;
pub mod set;
pub mod show;
pub mod source;
pub mod tree;
pub mod truck;
pub mod write;

pub use finding::{FileErrors, Finding, Findings, Severity};
