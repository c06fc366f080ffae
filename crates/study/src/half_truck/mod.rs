//! Runs of the half-truck of the comparison program's files.
//!
//! [`catalog`] lists the thesis's runs, [`files`] makes a run of any files, with single values [`mod@set`]
//! over them. [`HalfTruckCase`] is a model made from files with what a run needs besides, [`run`](run::run)
//! runs it, [`requests`] holds what a data file asks for, and [`HalfTruckResult`] what came out.

pub mod catalog;
pub mod columns;
pub mod files;
pub mod options;
pub mod requests;
pub mod run;
pub mod set;
pub mod wedge_bodies;
mod wedge_seen;
pub mod yaw;

use std::collections::BTreeMap;

use integrate::Statistics;
use nucars::truck::Truck;
use quantity::System as Units;
use serde::{Deserialize, Serialize};

use crate::result::RunResult;
use crate::summary::{Stopped, SummaryValue, ledger, run_summary};
use requests::Request;
use wedge_bodies::MountedWedge;
pub use yaw::YawSummary;

/// The start of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HalfTruckStart {
    /// At rest in the drawn layout.
    #[default]
    Drawn,
    /// At rest in static equilibrium without friction, the input bodies where they are at time zero.
    Equilibrium,
}

/// A run to be made.
#[derive(Clone, Debug)]
pub struct HalfTruckCase {
    /// Its name: results go into a folder of that name.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// The model.
    pub truck: Truck,
    /// The wedges that are bodies with mass.
    pub wedge_bodies: Vec<MountedWedge>,
    /// The values taken from the files and those added, in words; the assumptions have them too.
    pub wedge_notes: Vec<String>,
    /// The basis in words.
    pub assumptions: Vec<String>,
    /// The quantities written besides time, wedges and energies.
    pub requests: Vec<Request>,
    /// Its beginning.
    pub start: HalfTruckStart,
    /// Its duration, s.
    pub duration: f64,
    /// Time between two rows, s.
    pub interval: f64,
    /// Time between two rows of the array for the thesis's scripts, s: that of the printed runs, or of the
    /// run file; zero if it names none.
    pub script_interval: f64,
    /// Relative tolerance of the integrator.
    pub relative_tolerance: f64,
    /// Units of the results.
    pub units: Units,
}

impl HalfTruckCase {
    /// Returns the same case under another name.
    #[must_use]
    pub fn named(&self, name: &str) -> Self {
        Self {
            name: name.to_owned(),
            ..self.clone()
        }
    }
}

/// The result of a run.
pub type HalfTruckResult = RunResult<HalfTruckSummary>;

/// The schema's name and version.
pub const SCHEMA: &str = "wedgelab.truck/2";

/// The summary of a half-truck's run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HalfTruckSummary {
    /// [`SCHEMA`].
    pub schema: String,
    /// Version of the program that wrote it.
    pub program: String,
    /// The case's name.
    pub name: String,
    /// The case's title.
    pub title: String,
    /// Units of the numbers.
    pub units: Units,
    /// True if the run came to its end and its energy ledger closes to 1e-2.
    pub complete: bool,
    /// Reason and time of the stop, if it is incomplete.
    pub stopped: Option<Stopped>,
    /// The reason for not using its numbers, which are kept: its energy ledger does not close to 1e-2.
    #[serde(default)]
    pub failed: Option<String>,
    /// Warnings about the numbers; empty for a sound run.
    #[serde(default)]
    pub warnings: Vec<String>,
    /// Number of rows.
    pub rows: usize,
    /// Commanded and reached yaw, if one is commanded.
    #[serde(default)]
    pub yaw: Option<YawSummary>,
    /// Each wedge, by its number in the file.
    pub wedges: BTreeMap<String, WedgeSummary>,
    /// Largest displacements (without sign) of the free bodies, by `body_NUMBER_COORDINATE`.
    pub largest_displacements: BTreeMap<String, SummaryValue>,
    /// Entries of the energy ledger at the end.
    pub ledger: BTreeMap<String, SummaryValue>,
    /// Largest absolute change of the stored energy at any output time.
    pub largest_stored_change: SummaryValue,
    /// Largest absolute residual at any output time.
    pub largest_residual: SummaryValue,
    /// The first output time with this residual, s.
    pub largest_residual_time: f64,
    /// The residual that one step may leave, as the tolerance admits: below it nothing is wrong.
    #[serde(default)]
    pub admissible_residual: Option<SummaryValue>,
    /// The measure of how well the ledger closes: [`mechanics::energy_balance::relative_residual`] of the
    /// largest residual.
    pub largest_relative_residual: f64,
    /// Steps and calls of the integrator.
    pub statistics: Statistics,
    /// Its relative tolerance.
    pub relative_tolerance: f64,
    /// The assumptions of the numbers.
    pub assumptions: Vec<String>,
}

run_summary!(
    HalfTruckSummary,
    |own| title: &own.title,
    ledger: ledger!(own, own.ledger),
    solver: (own.statistics.steps, own.relative_tolerance)
);

/// A wedge's averages.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WedgeSummary {
    /// Friction energy at the column per cycle of the vertical input, over whole cycles after the first half
    /// period.
    pub energy_per_cycle: Option<SummaryValue>,
    /// Equivalent viscous damping of that energy, W/(π ω A²) with ω and A of the vertical input.
    #[serde(default)]
    pub equivalent_damping: Option<SummaryValue>,
    /// The window of the means below ([`window_of`](crate::metrics::window_of)): `mid stroke`, `lower
    /// stroke`; empty if the input does not cycle.
    #[serde(default)]
    pub window: String,
    /// Mean of the column's friction on the side frame (positive up) over the window where the input goes up.
    pub up: Option<SummaryValue>,
    /// The same where it goes down.
    pub down: Option<SummaryValue>,
    /// Largest normal force of the column.
    pub largest_normal_force: Option<SummaryValue>,
    /// Share of the output times at which it is jammed.
    pub jammed: f64,
}
