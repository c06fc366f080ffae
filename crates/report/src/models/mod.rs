//! The models: what reports and programs ask about the runs of each.
//!
//! A file for each model: files of its own, its numbers and figures beside those of other runs, its 3D view
//! and page, its lines on the terminal, its loop in the explorer. All else about a run is the same for all.

use std::ops::ControlFlow;
use std::time::Duration;

use quantity::{Kind, System as Units};
use serde::Serialize;
use study::models::{AnyCase, AnySummary, ModelSummary, StudyCase};
use study::run::{Run, RunError};
use study::statics::StaticTable;

use crate::figures::side_by_side::Wanted;
use crate::run_files::RunFiles;
use crate::run_folder::KeyNumber;
use crate::table::ResultTable;
use crate::terminal::TerminalTable;
use crate::view::run::{Detail, Recording};

mod car;
mod half_truck;
mod limits;
mod truck;
mod vehicle;
pub(crate) mod wedge;
mod wheelset;

pub use wedge::{TABLE_NOTE as WEDGE_NOTE, table as table_of_wedges};

/// A summary, as reports show it.
pub trait ReportSummary: ModelSummary {
    /// Returns the numbers that people compare first.
    fn key_numbers(&self, case: Option<&AnyCase>) -> Vec<KeyNumber>;

    /// Returns the figures of its run over those of other ones.
    fn overlays(&self, table: &ResultTable) -> Vec<Wanted>;

    /// Returns whether these figures are over the distance.
    fn over_distance(&self) -> bool {
        false
    }

    /// Returns it without lists that are long.
    fn in_short(&self) -> AnySummary {
        self.clone().into()
    }

    /// Returns the static table of the start, if it has one.
    fn statics(&self) -> Option<&StaticTable> {
        None
    }
}

/// A case whose runs are shown.
pub trait ReportCase: StudyCase<Summary: ReportSummary> + RunFiles + Send + Sync + 'static {
    /// What a run takes along for its view, beside its table.
    type Along: Default;
    /// A run with its case and what it took along.
    type Shown: Send + Sync;

    /// How much the explorer keeps of a run.
    const EXPLORED: Detail = Detail::Thinned;

    /// Returns a run at its start that takes along what its view needs.
    ///
    /// # Errors
    /// As [`Run::new`].
    fn start(&self) -> Result<Run<Self>, RunError> {
        Run::new(self)
    }

    /// As [`Run::finish_while`], with what the run took along.
    fn finish(run: Run<Self>, go_on: &mut GoOn<'_>) -> (Self::Output, Self::Along);

    /// Returns a run to be shown; one that was read back has nothing taken along.
    fn shown(self, result: Self::Output, along: Self::Along) -> Self::Shown;

    /// Returns the case and the result of a run.
    fn parts(shown: &Self::Shown) -> (&Self, &Self::Output);

    /// Returns the 3D view and the plots of a run.
    fn recording(shown: &Self::Shown, detail: Detail) -> Recording;

    /// Returns the page of a run.
    ///
    /// # Errors
    /// Errors of the JSON writer.
    fn page(shown: &Self::Shown) -> Result<String, serde_json::Error>;

    /// Returns the table of a run on the terminal, and the note on its columns.
    fn in_words(summary: &Self::Summary, wall: Duration) -> (TerminalTable, String);

    /// Returns the loop of a run in the explorer: the vertical motion of the first body that moves, or the
    /// first column, over time.
    fn shown_loop(&self, result: &Self::Output) -> Loop {
        let columns = result.columns.iter().skip(1);
        let up = columns.clone().find(|own| own.name.ends_with("_z"));
        let shown = up.or_else(|| columns.clone().next());
        let (column, name) = shown.map_or(("time", "time"), |own| (own.name.as_str(), own.text.as_str()));
        let losses = result.column("losses").and_then(<[f64]>::last);
        Loop {
            title: "Motion over time",
            x: LoopAxis::new("time", "time"),
            y: LoopAxis::new(column, name),
            energy_of: "Energy lost in all elements",
            energy_per: "run",
            energy: losses.copied(),
            missing: String::new(),
        }
    }
}

/// Asked at each output time (s) whether a run is to go on.
pub type GoOn<'a> = dyn FnMut(f64) -> ControlFlow<String> + 'a;

/// An axis of the loop: a column of the run, and in words.
#[derive(Debug, Serialize)]
pub struct LoopAxis {
    column: String,
    name: String,
}

impl LoopAxis {
    fn new(column: &str, name: &str) -> Self {
        Self {
            column: column.to_owned(),
            name: name.to_owned(),
        }
    }
}

/// The loop that is shown over earlier ones.
#[derive(Debug, Serialize)]
pub struct Loop {
    title: &'static str,
    x: LoopAxis,
    y: LoopAxis,
    /// A description of the energy below.
    energy_of: &'static str,
    /// Of what it is the energy: of a cycle, or of the whole run.
    energy_per: &'static str,
    /// Energy, J; none where there are no cycles.
    energy: Option<f64>,
    /// The reason if there is none, else empty.
    missing: String,
}

/// The period that energies of periodic motions are of.
const CYCLE: &str = "cycle";

fn joules(value: f64, units: Units) -> f64 {
    value / Kind::Energy.from_si(units)
}

/// Returns the greatest value of a column less its least.
fn range(column: Option<&[f64]>) -> f64 {
    let values = column.unwrap_or_default().iter();
    let (least, most) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| {
        (least.min(*value), most.max(*value))
    });
    most - least
}

/// Returns a note with another one below it, if there is one.
#[must_use]
pub fn with_note(about: &str, more: Option<String>) -> String {
    more.map_or(about.to_owned(), |more| format!("{about}\n\n{more}"))
}
