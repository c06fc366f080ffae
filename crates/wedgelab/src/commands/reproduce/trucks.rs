//! The half-truck's runs that the report compares with.

use std::path::Path;
use std::time::Instant;

use nucars::truck::Choices;
use rayon::prelude::*;
use report::agreement::TruckOutcome;
use report::files::Folder;
use report::page::Viewer;
use report::truck_files;
use report::view::run::{Detail, Recording};
use study::energy;
use study::plausibility;
use study::truck::TruckCase;
use study::truck::catalog::{self, Entry};
use study::truck::run::run_while;

use crate::failure::{Failure, Message, say};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;

/// The length of the runs, s: that of the thesis's.
const DURATION: f64 = 10.0;
/// A run to be made, and where it is written.
pub struct Planned {
    entry: Entry,
    case: TruckCase,
    folder: Folder,
}

impl Planned {
    /// Its name.
    pub fn name(&self) -> &str {
        &self.case.name
    }
}

/// All runs of the half-truck, in folders found fit.
pub fn plan(out: &Path, force: bool) -> Result<Vec<Planned>, Failure> {
    let cases = catalog::entries()
        .into_iter()
        .map(|entry| {
            let case = entry.case(&Choices::default(), DURATION).map_err(|error| {
                let message = format!("the files of {} make no model: {error}", entry.name());
                Failure::Failed(Message::new(message, "").into())
            })?;
            Ok((entry, case))
        })
        .collect::<Result<Vec<_>, Failure>>()?;
    let wanted = cases
        .iter()
        .map(|(_, case)| (out.join("runs").join(&case.name), truck_files::NAMES.as_slice()));
    let folders = folders::check_all(wanted, force)?;
    let planned = cases.into_iter().zip(folders);
    Ok(planned
        .map(|((entry, case), folder)| Planned { entry, case, folder })
        .collect())
}

/// A run with what the page shows of it, if it is interactive.
pub type ReproducedTruck = (TruckOutcome, Option<Recording>);

/// Runs them and writes their files, as many at a time as the pool has threads; `None` for those that were
/// interrupted.
pub fn trucks(planned: Vec<Planned>, progress: &Progress) -> Result<Vec<Option<ReproducedTruck>>, Failure> {
    planned
        .into_par_iter()
        .with_max_len(1)
        .map(|planned| one(planned, progress))
        .collect()
}

fn one(planned: Planned, progress: &Progress) -> Result<Option<ReproducedTruck>, Failure> {
    if interrupt::wanted() {
        return Ok(None);
    }
    let Planned { entry, case, folder } = planned;
    let start = Instant::now();
    let mut reached = progress.of_run(case.duration);
    let done = run_while(&case, |time| {
        reached(time);
        interrupt::go_on()
    });
    let result = done.map_err(|error| {
        let message = format!("the run {} cannot begin: {error}", case.name);
        Failure::Failed(Message::new(message, "").into())
    })?;
    if interrupt::is_reason(result.summary.stopped.as_ref()) {
        return Ok(None);
    }
    truck_files::write(&folder, &case, &result, catalog::OUTPUT_INTERVAL)?;
    let how = match &result.summary.stopped {
        Some(stopped) => format!("stopped at {} s", stopped.time),
        None => format!("{:.2} s", start.elapsed().as_secs_f64()),
    };
    progress.done(&case.name, &how);
    let warnings = &result.summary.warnings;
    for warning in energy::among(warnings).chain(plausibility::among(warnings)) {
        say(&format!("warning: {}: {warning}", case.name));
    }
    let recording = Viewer::embedded().map(|_| Recording::of_truck(&case, &result, Detail::Thinned));
    Ok(Some(((entry, result), recording)))
}
