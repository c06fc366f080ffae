//! The half-truck's runs that the report compares with.

use std::io::{self, Write};
use std::path::Path;
use std::time::Instant;

use nucars::truck::Choices;
use rayon::prelude::*;
use report::agreement::TruckOutcome;
use report::files::{Folder, check_all};
use report::{csv, summary};
use study::truck::catalog::{self, Entry};
use study::truck::{TruckCase, TruckResult, run};

use crate::failure::{Failure, Message};
use crate::progress::Progress;

/// The length of the runs, s: that of the thesis's.
const DURATION: f64 = 10.0;
/// The files of a run.
pub const NAMES: [&str; 2] = [csv::FILE_NAME, summary::FILE_NAME];

/// A run to be made, and where it is written.
pub struct Planned {
    entry: Entry,
    case: TruckCase,
    folder: Folder,
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
        .map(|(_, case)| (out.join("runs").join(&case.name), NAMES.as_slice()));
    let folders = check_all(wanted, force).map_err(|error| Failure::Input(error.into()))?;
    let planned = cases.into_iter().zip(folders);
    Ok(planned
        .map(|((entry, case), folder)| Planned { entry, case, folder })
        .collect())
}

/// Runs them and writes their files, as many at a time as the pool has threads.
pub fn trucks(planned: Vec<Planned>, progress: &Progress) -> Result<Vec<TruckOutcome>, Failure> {
    planned
        .into_par_iter()
        .with_max_len(1)
        .map(|planned| one(planned, progress))
        .collect()
}

fn one(planned: Planned, progress: &Progress) -> Result<TruckOutcome, Failure> {
    let Planned { entry, case, folder } = planned;
    let start = Instant::now();
    let result = run::run(&case, progress.of_run(case.duration)).map_err(|error| {
        let message = format!("the run {} cannot begin: {error}", case.name);
        Failure::Failed(Message::new(message, "").into())
    })?;
    folder.write(|files| {
        files.add(csv::FILE_NAME, |out| table(&result, out))?;
        files.add(summary::FILE_NAME, |out| {
            serde_json::to_writer_pretty(&mut *out, &result.summary)?;
            out.write_all(b"\n")
        })
    })?;
    let how = match &result.summary.stopped {
        Some(stopped) => format!("stopped at {} s", stopped.time),
        None => format!("{:.2} s", start.elapsed().as_secs_f64()),
    };
    progress.done(&case.name, &how);
    Ok((entry, result))
}

/// The table as `result.csv` of the other runs: names with units, shortest numbers.
fn table(result: &TruckResult, out: &mut dyn Write) -> io::Result<()> {
    let units = result.summary.units;
    let names: Vec<String> = result
        .columns
        .iter()
        .map(|column| column.full_name(units))
        .collect();
    writeln!(out, "{}", names.join(","))?;
    let mut line = String::new();
    for row in 0..result.summary.rows {
        line.clear();
        for (column, values) in result.columns.iter().zip(&result.values) {
            if !line.is_empty() {
                line.push(',');
            }
            line += &csv::converted(values[row], column.kind, units).to_string();
        }
        line.push('\n');
        out.write_all(line.as_bytes())?;
    }
    Ok(())
}
