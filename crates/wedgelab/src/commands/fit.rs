//! `wedgelab fit`: placeholder while building.

use std::process::ExitCode;

use clap::Args;

use crate::failure::Failure;

/// Find parameters of a case from a measured loop
#[derive(Debug, Args)]
pub struct Arguments {}

/// Does it.
pub fn execute(_: &Arguments) -> Result<ExitCode, Failure> {
    Ok(ExitCode::SUCCESS)
}
