//! `summary.json`: the run in numbers, for people and programs.
//!
//! Its schema is that of [`study::summary::Summary`], named in its key `schema` (`wedgelab.summary/2`): every
//! dimensional number is an object `{"value": ..., "unit": "..."}`, times are in seconds, keys that a reader
//! does not know are to be ignored.

use std::io::{self, Write};

use serde::Serialize;

/// The file's name.
pub const FILE_NAME: &str = "summary.json";

/// Writes anything as a summary is written: indented, a line feed at the end.
///
/// # Errors
/// The writer's.
pub fn write_json(summary: &impl Serialize, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, summary)?;
    out.write_all(b"\n")
}
