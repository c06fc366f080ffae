//! A run of the explorer: its data for the page, and its files.

use std::io;
use std::ops::ControlFlow;

use report::models::{GoOn, Loop, ReportCase, ReportSummary};
use report::run_files::TABLES;
use report::summary;
use report::view::View;
use study::each_case;
use study::models::{AnyCase, AnySummary};
use study::output_files::{OutputFiles, TableFormat};
use study::summary::RunSummary;

use super::api::Refused;

/// The result of a case.
pub struct Outcome {
    /// The case.
    pub case: AnyCase,
    run: Box<dyn Explored>,
}

/// A run that has ended.
trait Explored: Send + Sync {
    /// Returns the part of its summary that all models have.
    fn shared(&self) -> &dyn RunSummary;
    /// Returns the view that the page draws.
    fn view(&self) -> View;
    /// Returns its summary.
    fn summary(&self) -> AnySummary;
    /// Returns the loop of it.
    fn shown_loop(&self) -> Loop;
    /// Writes its table, or its summary.
    fn write(&self, format: Option<TableFormat>, out: &mut Vec<u8>) -> io::Result<()>;
}

/// A run as its model shows it.
struct OfModel<C: ReportCase>(C::Shown);

impl<C: ReportCase> Explored for OfModel<C> {
    fn shared(&self) -> &dyn RunSummary {
        &C::parts(&self.0).1.summary
    }

    fn view(&self) -> View {
        View::new(self.shared().units(), [C::recording(&self.0, C::EXPLORED)], [])
    }

    fn summary(&self) -> AnySummary {
        C::parts(&self.0).1.summary.in_short()
    }

    fn shown_loop(&self) -> Loop {
        let (case, result) = C::parts(&self.0);
        case.shown_loop(result)
    }

    fn write(&self, format: Option<TableFormat>, out: &mut Vec<u8>) -> io::Result<()> {
        let (case, result) = C::parts(&self.0);
        match format {
            // All columns, whatever the case keeps in folders.
            Some(format) => case.write_table(result, format, &OutputFiles::default(), out),
            None => summary::write_json(&result.summary, out),
        }
    }
}

/// Runs a case while it is wanted.
///
/// # Errors
/// It cannot begin, is no longer wanted, or its averages are no numbers.
pub fn compute(case: AnyCase, wanted: impl Fn() -> bool) -> Result<Outcome, Refused> {
    if case.half_truck().is_some() {
        return Err(Refused::mistake("", NO_HALF_TRUCK.to_owned(), ""));
    }
    let mut replaced = false;
    let mut goes_on = |_: f64| match wanted() {
        true => ControlFlow::Continue(()),
        false => {
            replaced = true;
            ControlFlow::Break("another run took its place".to_owned())
        }
    };
    let run = each_case!(&case, case => run_of(&**case, &mut goes_on))?;
    if replaced {
        return Err(Refused::Replaced);
    }
    finite(run.shared())?;
    Ok(Outcome { case, run })
}

fn run_of<C: ReportCase>(case: &C, goes_on: &mut GoOn<'_>) -> Result<Box<dyn Explored>, Refused> {
    let run = case
        .start()
        .map_err(|error| Refused::mistake("", format!("the run cannot begin: {error}"), OUT_OF_PROPORTION))?;
    let (result, along) = C::finish(run, goes_on);
    Ok(Box::new(OfModel::<C>(case.clone().shown(result, along))))
}

/// The reason for refusing half-trucks.
pub const NO_HALF_TRUCK: &str =
    "the explorer takes wedges, trucks, cars and vehicles, not the half-trucks of NUCARS's files";

const OUT_OF_PROPORTION: &str = "look for values that are out of proportion";

/// Refuses results whose averages are not finite: no number can be shown for them. Rows always are.
///
/// # Errors
/// One of them is none.
pub fn finite(summary: &dyn RunSummary) -> Result<(), Refused> {
    match summary.not_finite() {
        Some(what) => Err(Refused::mistake(
            "",
            format!("{what} is not a finite number"),
            OUT_OF_PROPORTION,
        )),
        None => Ok(()),
    }
}

impl Outcome {
    /// Returns whether it is that of a case: their completed case files are the same.
    pub fn is_of(&self, case: &AnyCase) -> bool {
        self.case.to_toml() == case.to_toml()
    }

    /// Returns the view that the page draws.
    pub fn view(&self) -> View {
        self.run.view()
    }

    /// Returns its summary, of a wedge without the list of events.
    pub fn summary(&self) -> AnySummary {
        self.run.summary()
    }

    /// Returns the loop of it.
    pub fn shown_loop(&self) -> Loop {
        self.run.shown_loop()
    }

    /// Writes one of its files, but not the case. Returns the type of what was written.
    pub fn write(&self, file: &str, out: &mut Vec<u8>) -> io::Result<&'static str> {
        let format = TABLES
            .into_iter()
            .find(|(_, name)| *name == file)
            .map(|(format, _)| format);
        self.run.write(format, out)?;
        Ok(match format {
            None => "application/json",
            Some(TableFormat::Csv) => "text/csv",
            Some(TableFormat::Mat) => "application/octet-stream",
            Some(TableFormat::Parquet) => "application/vnd.apache.parquet",
        })
    }
}
