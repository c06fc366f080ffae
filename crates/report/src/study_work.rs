//! Computing what the folder of a study lacks, several runs at a time; and what is made of all runs.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use study::design::Study;
use study::records;

use crate::assessment_work::in_parallel;
use crate::page::study as page;
use crate::study_digest::Digest;
use crate::study_folder::{StudyFolder, StudyFolderError};

/// The runs that a folder holds before anything is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KeptRuns {
    /// Runs that are there.
    pub runs: u64,
    /// Bytes of records that were cut off or damaged, and are not there in another record.
    pub lost: usize,
}

/// Looks at all parts.
///
/// # Errors
/// One of them cannot be read, or holds something else.
pub fn kept(folder: &StudyFolder) -> Result<KeptRuns, StudyFolderError> {
    let mut kept = KeptRuns { runs: 0, lost: 0 };
    for part in 0..folder.parts() {
        let found = folder.part(part)?;
        let count = found.records.len() as u64;
        kept.runs += count;
        // What was computed again since then needs no word.
        if count < folder.numbers(part).end - folder.numbers(part).start {
            kept.lost += found.lost;
        }
    }
    Ok(kept)
}

/// The queue of work: the runs of one part, then of the next.
struct Queue {
    part: u64,
    numbers: std::vec::IntoIter<u64>,
}

/// Computes all runs that have no record, by so many workers, until `stop` becomes true: no new runs begin
/// then, and those under way are finished. Tells each one that is kept.
///
/// # Errors
/// A part cannot be read or written to. All that was kept stays.
pub fn compute(
    study: &Study,
    folder: &StudyFolder,
    jobs: usize,
    stop: &AtomicBool,
    done: &(dyn Fn() + Sync),
) -> Result<(), StudyFolderError> {
    let queue = Mutex::new(Queue {
        part: 0,
        numbers: Vec::new().into_iter(),
    });
    let failure: Mutex<Option<StudyFolderError>> = Mutex::new(None);
    let failed = AtomicBool::new(false);
    let fail = |error| {
        failed.store(true, Ordering::Relaxed);
        let mut first = failure.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert(error);
    };
    let stops = || stop.load(Ordering::Relaxed) || failed.load(Ordering::Relaxed);
    let next = || -> Option<u64> {
        let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
        if stops() {
            return None;
        }
        loop {
            if let Some(number) = queue.numbers.next() {
                return Some(number);
            }
            if queue.part >= folder.parts() {
                return None;
            }
            match folder.missing(queue.part) {
                Ok(numbers) => queue.numbers = numbers.into_iter(),
                Err(error) => {
                    fail(error);
                    return None;
                }
            }
            queue.part += 1;
        }
    };
    let worker = || {
        while let Some(number) = next() {
            match folder.keep(&records::run(study, number)) {
                Ok(()) => done(),
                Err(error) => fail(error),
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..jobs.max(1) {
            scope.spawn(worker);
        }
    });
    match failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some(error) => Err(error),
        None => Ok(()),
    }
}

/// Returns so many of the runs that have no record yet, spread over the study: by them it can be judged how
/// long the others take.
///
/// # Errors
/// A part cannot be read.
pub fn sample(study: &Study, folder: &StudyFolder, count: u64) -> Result<Vec<u64>, StudyFolderError> {
    let spread = (0..count).map(|own| study.count() * (2 * own + 1) / (2 * count));
    let mut sample = Vec::new();
    for number in spread {
        let missing = folder.missing(folder.part_of(number))?;
        if sample.last() != Some(&number) && missing.binary_search(&number).is_ok() {
            sample.push(number);
        }
    }
    Ok(sample)
}

/// Computes these runs, so many at a time, until `stop` becomes true, and keeps them. Tells each.
///
/// # Errors
/// A part cannot be written to.
pub fn compute_some(
    study: &Study,
    folder: &StudyFolder,
    numbers: Vec<u64>,
    jobs: usize,
    stop: &AtomicBool,
    done: &(dyn Fn() + Sync),
) -> Result<(), StudyFolderError> {
    let kept = in_parallel(numbers.into(), jobs, |number| {
        match stop.load(Ordering::Relaxed) {
            true => Ok(()),
            false => folder.keep(&records::run(study, number)).map(|()| done()),
        }
    });
    kept.into_iter().collect()
}

/// Makes the table and the page of all runs.
///
/// # Errors
/// A run is missing, or something cannot be read or written.
pub fn finish(study: &Study, folder: &StudyFolder) -> Result<Digest, StudyFolderError> {
    let mut digest = Digest::new(study);
    folder.merge(study, |values, record| digest.add(study, values, record))?;
    page::write(study, &digest, folder.path()).map_err(StudyFolderError::after_all_runs)?;
    Ok(digest)
}
