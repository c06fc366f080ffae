//! Answers as JSON: one document on the standard output, for programs that read it.

use std::io;

use serde::Serialize;

use crate::failure::Failure;

/// Says of an option `--json` what it does; the same in all commands.
pub const HELP: &str = "Answer as one JSON document on the standard output instead of in words";

/// Prints a document. Numbers that are not finite are null.
pub fn print(document: &impl Serialize) -> Result<(), Failure> {
    Ok(report::summary::write_json(document, &mut io::stdout().lock())?)
}
