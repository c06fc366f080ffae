//! Computing what the folder of a study lacks, several runs at a time; and what is made of all runs.

use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use study::design::Study;
use study::records::{self, Record};

use crate::page::study as page;
use crate::study_digest::Digest;
use crate::study_folder::{StudyFolder, StudyFolderError};

/// What a folder holds before anything is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Begun {
    /// Runs that are there.
    pub runs: u64,
    /// Bytes of records that were cut off or damaged, and are not there in another record.
    pub lost: usize,
}

/// Looks at all parts.
///
/// # Errors
/// One of them cannot be read, or holds something else.
pub fn begun(folder: &StudyFolder) -> Result<Begun, StudyFolderError> {
    let mut begun = Begun { runs: 0, lost: 0 };
    for part in 0..folder.parts() {
        let found = folder.part(part)?;
        let count = found.records.len() as u64;
        begun.runs += count;
        // What was computed again since then needs no word.
        if count < folder.numbers(part).end - folder.numbers(part).start {
            begun.lost += found.lost;
        }
    }
    Ok(begun)
}

/// What is still to be done: the runs of one part, then of the next.
struct Queue {
    part: u64,
    numbers: std::vec::IntoIter<u64>,
    /// How many runs all workers together have under way.
    under_way: u64,
}

impl Queue {
    /// Whether a worker of so many that has some runs under way may have one more, if no more than `beyond` runs are in parts not looked
    /// at yet. Several side by side are faster than one after the other, but not as fast as on cores of their own: of the last
    /// ones no worker takes more than its share.
    fn shares(&self, own: u64, jobs: u64, beyond: u64) -> bool {
        let left = self.numbers.len() as u64 + self.under_way + beyond;
        own == 0 || own < left.div_ceil(jobs)
    }
}

/// Computes all runs that have no record, by so many workers, each of which has several under way, until `stop` becomes true: no new
/// runs begin then, and those under way are finished. Tells each one that is kept.
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
        under_way: 0,
    });
    let failure: Mutex<Option<StudyFolderError>> = Mutex::new(None);
    let failed = AtomicBool::new(false);
    let fail = |error| {
        failed.store(true, Ordering::Relaxed);
        let mut first = failure.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert(error);
    };
    let stops = || stop.load(Ordering::Relaxed) || failed.load(Ordering::Relaxed);
    let workers = jobs.max(1) as u64;
    // The next run for a worker that has `own` runs under way.
    let next = |own: u64| -> Option<u64> {
        let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
        let beyond = study.count().saturating_sub(folder.numbers(queue.part).start);
        if stops() || !queue.shares(own, workers, beyond) {
            return None;
        }
        loop {
            if let Some(number) = queue.numbers.next() {
                queue.under_way += 1;
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
    let keep = |record: &Record| {
        let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
        queue.under_way = queue.under_way.saturating_sub(1);
        drop(queue);
        match folder.keep(record) {
            Ok(()) => done(),
            Err(error) => fail(error),
        }
    };
    let worker = || {
        // Anew as long as there is something, for a worker that has had its share.
        loop {
            let (pulled, kept) = (Cell::new(0), Cell::new(0));
            let mut pull = || {
                let number = next(pulled.get() - kept.get())?;
                pulled.set(pulled.get() + 1);
                Some(number)
            };
            records::run_many(study, &mut pull, &mut |record| {
                kept.set(kept.get() + 1);
                keep(&record);
                !stops()
            });
            if pulled.get() == 0 {
                return;
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..jobs {
            scope.spawn(worker);
        }
    });
    match failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some(error) => Err(error),
        None => Ok(()),
    }
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

#[cfg(test)]
mod tests {
    use super::Queue;

    #[test]
    fn limits_the_last_runs_are_shared_by_all_workers() {
        let queue = |numbers: u64, under_way| Queue {
            part: 1,
            numbers: (0..numbers).collect::<Vec<_>>().into_iter(),
            under_way,
        };
        // Four runs, four workers: one each. Two workers have two each.
        assert!(queue(4, 0).shares(0, 4, 0) && !queue(3, 1).shares(1, 4, 0));
        assert!(queue(3, 1).shares(1, 2, 0) && !queue(2, 2).shares(2, 2, 0));
        // Those of parts not looked at count.
        assert!(queue(3, 1).shares(1, 4, 16));
        // Whoever has none takes one.
        assert!(queue(1, 100).shares(0, 1000, 0));
    }
}
