//! `wedgelab explore`: a page on which every value of a case can be changed, and each change runs it again.
//!
//! - [`guard`], [`token`]: the requests that are answered.
//! - [`base`]: the case that changes are laid over.
//! - [`outcome`]: a run of a wedge, of a truck or of a car: its data for the page, its files.
//! - [`api`]: requests and answers, `wedgelab.explore/1`, described in `docs/explore.md`.
//! - [`limits`]: limits of a request, of a connection, and of all of them.
//! - [`routes`]: reading requests, work on other threads, answering.
//! - [`connections`]: taking connections, within time limits.
//! - [`browser`]: calling a browser with the page.
//! - [`server`]: start and stop.

mod api;
mod base;
mod browser;
mod connections;
mod guard;
mod limits;
mod outcome;
mod routes;
mod server;
mod token;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use crate::failure::Failure;
use base::Base;

/// The case that is shown first if none is named.
const FIRST: &str = "vdrun_toe_0_psi_0";

/// Change a case on a page and see its loop move
///
/// Serves a page on this machine only (127.0.0.1) with a control for every value of the case; each change
/// runs the case again and shows the new hysteresis loop over the earlier ones, with plots and the 3D view.
/// Prints the address to open in a browser, with a secret that only you are shown; Ctrl-C stops it.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab explore
  wedgelab explore my.toml --open
  wedgelab explore truck_warp_nest_constant_rising
  wedgelab explore car_pitch_and_bounce_loaded
  wedgelab explore cdrun_toe_0_psi_0.012 --port 8080")]
pub struct Arguments {
    /// Case file of a wedge, of a truck or of a car, or, if there is no such file, the name of a built-in
    /// case [default: vdrun_toe_0_psi_0]
    case: Option<PathBuf>,
    /// Port to listen at; 0: any that is free
    #[arg(long, value_name = "PORT", default_value_t = 0)]
    port: u16,
    /// Open the page in a browser: $BROWSER, or the one that the system has
    #[arg(long)]
    open: bool,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let path = arguments.case.clone().unwrap_or_else(|| PathBuf::from(FIRST));
    let base = Base::open(&path)?;
    server::serve(base, arguments.port, arguments.open)?;
    Ok(ExitCode::SUCCESS)
}
