//! The three-piece truck's rigs: runs that are written and shown, variants for comparison, and the page.

use std::path::Path;

use rayon::prelude::*;
use report::figures::Exhibit;
use report::figures::truck::{TruckRun, of_rigs};
use report::run_files;
use report::view::View;
use report::view::run::{Detail, Recording};
use reproduction::page::truck::{self, TruckContents};
use reproduction::three_piece::{self, Rigs, TruckFindings, Variant};
use staging::{FileError, Files, Folder};
use study::truck::summary::TruckSummary;
use study::truck::{TruckCase, builtin};

use super::draw;
use crate::execute::{compute, compute_shown, write_quietly};
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;

/// The variant that figures show beside the rigs.
const SMOOTH: &str = "warp, mu 0.25";
/// The rigs whose contact states are drawn.
const DRAWN: [&str; 2] = ["truck_vertical_variable", "truck_warp_nest_constant_rising"];

/// A rig to be run, and where it is written; or a variant, of which nothing is written.
pub enum Planned {
    Rig(Box<TruckCase>, Folder),
    Variant(Box<Variant>),
}

/// A run that was made, with what the page shows of it.
pub struct Made {
    key: String,
    run: TruckRun,
    written: bool,
    recording: Option<Recording>,
}

/// Returns all runs, in folders found fit.
pub fn plan(out: &Path, force: bool) -> Result<Vec<Planned>, Failure> {
    let cases = three_piece::shown()
        .into_iter()
        .map(|name| builtin::case_with(name, &[]))
        .collect::<Result<Vec<_>, _>>()?;
    let wanted = cases
        .iter()
        .map(|case| (out.join("runs").join(&case.name), run_files::NAMES.as_slice()));
    let folders = folders::check_all(wanted, force)?;
    let rigs = cases.into_iter().zip(folders);
    let mut planned: Vec<Planned> = rigs
        .map(|(case, folder)| Planned::Rig(Box::new(case), folder))
        .collect();
    let variants = three_piece::variants()?.into_iter();
    planned.extend(variants.map(|variant| Planned::Variant(Box::new(variant))));
    Ok(planned)
}

/// Returns the names of the runs that are written.
pub fn names(planned: &[Planned]) -> Vec<String> {
    let rigs = planned.iter().filter_map(|planned| match planned {
        Planned::Rig(case, _) => Some(case.name.clone()),
        Planned::Variant(_) => None,
    });
    rigs.collect()
}

/// Returns whether each of the runs that are written was.
pub fn written(made: &[Option<Made>], rigs: usize) -> impl Iterator<Item = bool> {
    made.iter().take(rigs).map(Option::is_some)
}

/// Runs them and writes the files of rigs, as many at a time as the pool has threads; `None` for those that
/// were interrupted.
pub fn run(planned: Vec<Planned>, progress: &Progress) -> Result<Vec<Option<Made>>, Failure> {
    planned
        .into_par_iter()
        .with_max_len(1)
        .map(|planned| one(planned, progress))
        .collect()
}

fn one(planned: Planned, progress: &Progress) -> Result<Option<Made>, Failure> {
    if interrupt::wanted() {
        return Ok(None);
    }
    let (key, case, folder) = match planned {
        Planned::Rig(case, folder) => (case.name.clone(), *case, Some(folder)),
        Planned::Variant(variant) => (variant.key, variant.case, None),
    };
    let (done, contacts) = match &folder {
        Some(_) => compute_shown(&case, progress)?,
        None => (compute(&case, progress)?, None),
    };
    if interrupt::is_reason(done.result.summary.stopped.as_ref()) {
        return Ok(None);
    }
    match &folder {
        // What makes a run doubtful stands on the page.
        Some(folder) => write_quietly(&done, &case, folder, progress)?,
        None => progress.done(&key, &format!("{:.2} s", done.wall.as_secs_f64())),
    }
    let recording = folder
        .as_ref()
        .map(|_| Recording::of_three_piece_truck(&case, &done.result, contacts.as_ref(), Detail::Thinned));
    // Tables of corners are large, and only two are drawn.
    let contacts = contacts.filter(|_| DRAWN.contains(&key.as_str()));
    Ok(Some(Made {
        key,
        run: TruckRun {
            case,
            result: done.result,
            contacts,
        },
        written: folder.is_some(),
        recording,
    }))
}

/// The report: the page, its numbers, and what may be wrong with a run.
pub struct TruckReport {
    pub page: String,
    pub findings: TruckFindings,
    pub figures: usize,
    pub summaries: Vec<TruckSummary>,
}

/// Draws the figures and makes the page.
pub fn report_on(made: Vec<Made>, figures: &Folder) -> Result<TruckReport, Failure> {
    let (mut runs, mut recordings, mut rigs, mut smooth) = (Vec::new(), Vec::new(), Rigs::default(), None);
    for made in made {
        rigs.add(&made.key, made.run.case.clone(), made.run.result.clone());
        recordings.extend(made.recording);
        if made.written {
            runs.push(made.run);
        } else if made.key == SMOOTH {
            smooth = Some(made.run);
        }
    }
    let findings = TruckFindings::of(&rigs);
    drop(rigs);
    let exhibits = of_rigs(&runs, smooth.as_ref());
    let svgs = draw(&exhibits.iter().collect::<Vec<&Exhibit>>(), figures)?;
    let units = runs
        .first()
        .map(|run| run.result.summary.units)
        .unwrap_or_default();
    let view = View::new(units, recordings, &exhibits)
        .to_json()
        .map_err(|error| {
            let message = format!("cannot write the data of the truck's page: {error}");
            Failure::Failed(Message::new(message, "").into())
        })?;
    let drawn: Vec<(Exhibit, String)> = exhibits.into_iter().zip(svgs).collect();
    let results: Vec<_> = runs.into_iter().map(|run| run.result).collect();
    let page = truck::render(&TruckContents {
        rigs: &results,
        findings: &findings,
        figures: &drawn,
        view: &view,
    });
    Ok(TruckReport {
        page,
        findings,
        figures: drawn.len(),
        summaries: results.into_iter().map(|result| result.summary).collect(),
    })
}

/// Writes page and numbers, both or none.
pub fn add(files: &mut Files<'_>, report: &TruckReport) -> Result<(), FileError> {
    files.add(truck::FILE_NAME, |out| out.write_all(report.page.as_bytes()))?;
    files.add(three_piece::FILE_NAME, |out| report.findings.write(out))
}
