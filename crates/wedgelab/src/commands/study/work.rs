//! Computing the missing runs of a study, several at a time.

use std::path::Path;
use std::time::Instant;

use report::study_folder::{StudyFolder, StudyFolderError};
use report::study_work;
use study::design::Study;

use crate::cost::{Cost, EACH, WORTH};
use crate::failure::say;
use crate::folders;
use crate::interrupt;
use crate::progress::Steady;

/// Counts of runs.
#[derive(Debug)]
pub struct Done {
    /// Runs that were there before.
    pub before: u64,
    /// Runs computed now.
    pub now: u64,
    /// True if the user stopped it.
    pub interrupted: bool,
}

/// Holds the folder of a study: a signal from now on stops the runs, and those that ended are kept.
pub fn open(study: &Study, path: &Path) -> Result<StudyFolder, StudyFolderError> {
    let folder = StudyFolder::open(path, study)?;
    folders::tell_removed(folder.removed());
    interrupt::stops(
        "stopping: the runs under way are finished and kept (once more: ends at once)",
        &format!(
            "the runs that ended are kept in {}. The same command goes on from there.",
            path.display()
        ),
    );
    Ok(folder)
}

/// Computes some of the missing runs and judges by them what all cost.
pub fn cost(
    study: &Study,
    folder: &StudyFolder,
    (jobs, left): (usize, u64),
    done: &(dyn Fn() + Sync),
) -> Result<Cost, StudyFolderError> {
    let sample = study_work::sample(study, folder, (EACH * jobs) as u64)?;
    let (count, clock) = (sample.len() as u64, Instant::now());
    study_work::compute_some(study, folder, sample, jobs, interrupt::flag(), done)?;
    Ok(Cost {
        left,
        sample: count,
        took: clock.elapsed(),
        jobs,
        // A record, and a row of each table.
        bytes: 3 * (RECORD + 8 * study.measures().iter().count() as u64),
    })
}

/// Bytes of a record besides its measures.
const RECORD: u64 = 33;

/// Computes all runs that have no record.
pub fn all(study: &Study, folder: &StudyFolder, jobs: usize, quiet: bool) -> Result<Done, StudyFolderError> {
    let kept = study_work::kept(folder)?;
    let progress = Steady::new("runs", study.count(), kept.runs, quiet);
    let left = study.count() - kept.runs;
    if !quiet && left > WORTH * (EACH * jobs) as u64 {
        let cost = cost(study, folder, (jobs, left), &|| progress.done())?;
        if cost.is_long() && !interrupt::wanted() {
            say(&cost.words());
        }
    }
    let computed = study_work::compute(study, folder, jobs, interrupt::flag(), &|| progress.done());
    let now = progress.finish();
    computed?;
    if kept.lost > 0 {
        say(&format!(
            "note: {} bytes in parts/ were cut off or damaged; their runs were computed again",
            kept.lost
        ));
    }
    Ok(Done {
        before: kept.runs,
        now,
        interrupted: kept.runs + now < study.count(),
    })
}
