//! The evaluation of an assessment's runs when all are kept: tables, runs near limits from another start, the
//! worst run of each regime, the page.

use std::collections::VecDeque;
use std::io;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use study::assessment::dependence::{Varied, wanted};
use study::assessment::refined::Refined;
use study::assessment::{Assessed, Assessment, worst_run};
use study::models::AnyCase;

use crate::assessment_files::{self, AssessmentFindings, NAMES};
use crate::page as pages;
use crate::page::assessment::{self as page, Against, TrackRun, WorstRun};
use crate::study_folder::{StudyFolder, StudyFolderError};
use staging::Folder;

/// The folder of the worst runs, in that of the assessment.
pub const WORST: &str = "worst";

/// Assesses all runs, computes those near limits from another start and at other frictions, and the worst one
/// of each regime again with the motions of its bodies, and writes tables and page; `None` if `stop` became
/// true meanwhile. Tells each worst run that is done.
///
/// # Errors
/// A run is missing, or something cannot be read or written.
pub fn finish(
    assessment: &Assessment,
    folder: &StudyFolder,
    jobs: usize,
    against: Option<&Against>,
    stop: &AtomicBool,
    done: &(dyn Fn() + Sync),
) -> Result<Option<AssessmentFindings>, StudyFolderError> {
    let mut findings = AssessmentFindings::gather(assessment, folder)?;
    refine(assessment, &mut findings, jobs, stop);
    let again = wanted(&findings.verdicts, &assessment.request.frictions);
    let varied = in_parallel(again.into(), jobs, |(number, change)| {
        let goes_on = !stop.load(Ordering::Relaxed);
        let case = findings.case(assessment, number).filter(|_| goes_on)?;
        assessment.varied(number, &case, change)
    });
    let varied: Vec<Varied> = varied.into_iter().flatten().collect();
    assessment.note(&mut findings.verdicts, &varied);
    let worst = worst_runs(assessment, &findings, folder.path(), jobs, stop, done)?;
    if stop.load(Ordering::Relaxed) {
        return Ok(None);
    }
    let page = page::render(assessment, &findings, &worst, against);
    let page = page.map_err(|error| unwritable(folder.path(), error))?;
    let files = Folder::check(folder.path(), &NAMES, true)?;
    assessment_files::write(assessment, &findings, &page, &files)
        .map_err(StudyFolderError::after_all_runs)?;
    Ok(Some(findings))
}

/// Computes runs at more speeds about the worst one of each regime, as long as there is something to see.
fn refine(assessment: &Assessment, findings: &mut AssessmentFindings, jobs: usize, stop: &AtomicBool) {
    while assessment.request.refine && !stop.load(Ordering::Relaxed) {
        let wanted = assessment.next_speeds(&findings.runs).into();
        let found = in_parallel(wanted, jobs, |at| {
            let goes_on = !stop.load(Ordering::Relaxed);
            goes_on.then(|| assessment.run_at(at).ok()).flatten()
        });
        let mut found: Vec<Refined> = found.into_iter().flatten().collect();
        // One that cannot be made would be asked for again.
        if found.is_empty() || stop.load(Ordering::Relaxed) {
            return;
        }
        found.sort_by_key(|own| (own.assessed.regime, own.assessed.condition));
        findings.add(assessment, found);
    }
}

fn unwritable(folder: &Path, error: serde_json::Error) -> StudyFolderError {
    StudyFolderError::Table {
        file: folder.join(pages::FILE_NAME),
        reason: io::Error::other(error),
    }
}

fn worst_runs(
    assessment: &Assessment,
    findings: &AssessmentFindings,
    path: &Path,
    jobs: usize,
    stop: &AtomicBool,
    done: &(dyn Fn() + Sync),
) -> Result<Vec<WorstRun>, StudyFolderError> {
    let regimes = 0..assessment.regimes.len();
    let wanted: VecDeque<(usize, &Assessed)> = regimes
        .filter_map(|regime| Some((regime, worst_run(&findings.runs, regime)?)))
        .collect();
    let found = in_parallel(wanted, jobs, |(regime, run)| {
        let own = match findings.case(assessment, run.run) {
            Some(case) => one(assessment, (regime, case), path, stop),
            None => Ok(None),
        };
        done();
        own
    });
    let found: Result<Vec<Option<WorstRun>>, StudyFolderError> = found.into_iter().collect();
    let mut found: Vec<WorstRun> = found?.into_iter().flatten().collect();
    found.sort_by_key(|own| own.regime);
    Ok(found)
}

/// Computes something of all items, several at a time; results come in any order.
pub(crate) fn in_parallel<T: Send, R: Send>(
    items: VecDeque<T>,
    jobs: usize,
    compute: impl Fn(T) -> R + Sync,
) -> Vec<R> {
    let (queue, found) = (Mutex::new(items), Mutex::new(Vec::new()));
    let worker = || {
        let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).pop_front();
        while let Some(item) = next() {
            let own = compute(item);
            found.lock().unwrap_or_else(PoisonError::into_inner).push(own);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..jobs.max(1) {
            scope.spawn(worker);
        }
    });
    found.into_inner().unwrap_or_else(PoisonError::into_inner)
}

/// Makes one of the runs; `None` if it was stopped, or is no run any more.
fn one(
    assessment: &Assessment,
    (regime, case): (usize, AnyCase),
    path: &Path,
    stop: &AtomicBool,
) -> Result<Option<WorstRun>, StudyFolderError> {
    let name = assessment.regimes[regime].name.as_str();
    let stops = || stop.load(Ordering::Relaxed);
    let run = TrackRun::of(&case, name, &assessment.limits, || match stops() {
        true => ControlFlow::Break(String::new()),
        false => ControlFlow::Continue(()),
    });
    let Some(run) = run.filter(|_| !stops()) else {
        return Ok(None);
    };
    let folder = format!("{WORST}/{name}");
    run.write(&path.join(&folder))?;
    Ok(Some(WorstRun {
        regime,
        worst: page::worst_second(assessment, regime, &run),
        run,
        folder,
    }))
}
