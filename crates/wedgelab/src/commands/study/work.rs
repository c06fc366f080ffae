//! Computing what a study lacks, several runs at a time.

use report::study_folder::{StudyFolder, StudyFolderError};
use report::study_work;
use study::design::Study;

use crate::interrupt;
use crate::progress::Steady;

/// What was done.
#[derive(Debug)]
pub struct Done {
    /// Runs that were there before.
    pub before: u64,
    /// Runs computed now.
    pub now: u64,
    /// Whether the user stopped it.
    pub interrupted: bool,
    /// Bytes of records that were cut off or damaged.
    pub lost: usize,
}

/// Computes all runs that have no record.
pub fn all(study: &Study, folder: &StudyFolder, jobs: usize, quiet: bool) -> Result<Done, StudyFolderError> {
    let begun = study_work::begun(folder)?;
    let progress = Steady::new("runs", study.count(), begun.runs, quiet);
    let computed = study_work::compute(study, folder, jobs, interrupt::flag(), &|| progress.done());
    let now = progress.finish();
    computed?;
    Ok(Done {
        before: begun.runs,
        now,
        interrupted: begun.runs + now < study.count(),
        lost: begun.lost,
    })
}
