//! The half-truck's runs that the report compares with.

use std::path::Path;

use crate::execute::{compute, write_quietly};
use nucars::truck::Choices;
use rayon::prelude::*;
use report::half_truck_files;
use report::view::run::{Detail, Recording};
use reproduction::agreement::{self, TruckOutcome};
use staging::Folder;
use study::energy;
use study::half_truck::HalfTruckCase;
use study::half_truck::catalog::{self, CatalogEntry};
use study::plausibility;

use crate::failure::{Failure, Message, say};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;

/// The length of the runs, s: that of the thesis's.
pub const DURATION: f64 = 10.0;

/// A run to be made, and where it is written.
pub struct Planned {
    entry: CatalogEntry,
    case: HalfTruckCase,
    folder: Folder,
}

impl Planned {
    /// Returns its name.
    pub fn name(&self) -> &str {
        &self.case.name
    }
}

/// Returns all runs of the half-truck, in folders found fit.
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
    let wanted = cases.iter().map(|(_, case)| {
        (
            out.join("runs").join(&case.name),
            half_truck_files::NAMES.as_slice(),
        )
    });
    let folders = folders::check_all(wanted, force)?;
    let planned = cases.into_iter().zip(folders);
    Ok(planned
        .map(|((entry, case), folder)| Planned { entry, case, folder })
        .collect())
}

/// A run with what the page shows of it.
pub type ReproducedTruck = (TruckOutcome, Recording);

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
    let done = compute(&case, progress)?;
    if interrupt::is_reason(done.result.summary.stopped.as_ref()) {
        return Ok(None);
    }
    write_quietly(&done, &case, &folder, progress)?;
    let mut result = done.result;
    let warnings = &result.summary.warnings;
    for warning in energy::among(warnings).chain(plausibility::among(warnings)) {
        say(&format!("warning: {}: {warning}", case.name));
    }
    let recording = Recording::of_truck(&case, &result, None, Detail::Thinned);
    result.keep_columns(agreement::needs);
    Ok(Some(((entry, result), recording)))
}
