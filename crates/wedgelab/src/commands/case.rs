//! `wedgelab case`: the built-in cases.

use std::io::{self, Write};
use std::process::ExitCode;

use clap::Args;
use study::case::builtin;

use crate::failure::Failure;
use crate::select::select;
use crate::table::Table;

/// List the built-in cases, or print one as a case file
///
/// Without a name, lists the built-in cases with their titles. With one, prints that case as a complete, commented
/// case file: change what you like, and run it with `wedgelab run`.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab case
  wedgelab case vdrun_toe_0_psi_0 > a.toml && wedgelab run a.toml")]
pub struct Arguments {
    /// Name of a built-in case, or a beginning that only one has
    name: Option<String>,
}

/// Does it.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let mut out = io::stdout().lock();
    let Some(name) = &arguments.name else {
        let mut table = Table::new(2, &[("name", ""), ("title", "")]);
        for (name, title) in builtin::list() {
            table.row([name.to_owned(), title]);
        }
        table.write(&mut out)?;
        return Ok(ExitCode::SUCCESS);
    };
    for name in select(std::slice::from_ref(name))? {
        let case = builtin::case(name)?;
        out.write_all(case.document.to_toml().as_bytes())?;
    }
    Ok(ExitCode::SUCCESS)
}
