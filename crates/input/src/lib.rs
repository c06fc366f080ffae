//! Reading of files and texts within stated limits.
//!
//! - [`limits`]: the limits of every reader, in one place.
//! - [`mod@file`]: files read up to a size, their type looked at first.
//! - [`FileType`]: what a file seems to be, and which command takes it.
//! - [`Text`]: a text that was read, with excerpts of bounded size for messages.
//! - [`Separated`]: tables of numbers as text, with decimal points or commas.
//! - [`structure`]: nesting, number of values and length of lines of TOML, found before it is parsed.
//! - [`shortened`]: a piece of a user's text, short enough for a message.
//!
//! ```
//! use input::{FileType, limits, structure};
//!
//! let seems = FileType::of(b"case = \"vdrun_toe_0_psi_0\"\n[vary]\n");
//! assert_eq!(seems, Some(FileType::Study));
//! let nested = format!("deep = {}", "[".repeat(limits::NESTING + 1));
//! assert!(structure::toml(&nested).is_err()); // before a parser sees it
//! ```

#![warn(missing_docs)]

pub mod file;
mod file_type;
pub mod limits;
mod separated;
mod shorten;
pub mod structure;
mod text;

pub use file_type::FileType;
pub use separated::{CellError, Separated};
pub use shorten::{bounded, shortened};
pub use text::Text;
