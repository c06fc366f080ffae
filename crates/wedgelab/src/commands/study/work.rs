//! Computing the missing runs of a study, several at a time.

use std::path::Path;

use report::study_folder::{StudyFolder, StudyFolderError};
use report::study_work;
use study::design::Study;

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

/// Computes all runs that have no record.
pub fn all(study: &Study, folder: &StudyFolder, jobs: usize, quiet: bool) -> Result<Done, StudyFolderError> {
    let kept = study_work::kept(folder)?;
    let progress = Steady::new("runs", study.count(), kept.runs, quiet);
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
