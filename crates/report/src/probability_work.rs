//! Computing the runs of a probability: those that a folder keeps are not computed again.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use study::probability::{Answer, Plan, ProbabilityRun};
use study::records::Record;

use crate::probability_files::NAMES;
use crate::study_folder::{StudyFolder, StudyFolderError};

/// The file that says what the runs of a folder are.
pub const PLAN_FILE: &str = "plan.json";

/// Reasons why runs end before all are there.
#[derive(Debug)]
pub enum Unfinished {
    /// The folder cannot be read or written.
    Folder(StudyFolderError),
    /// It was asked to stop.
    Stopped,
}

impl From<StudyFolderError> for Unfinished {
    fn from(error: StudyFolderError) -> Self {
        Self::Folder(error)
    }
}

/// The runs of a plan, in the order in which they are asked for: each has the number of its turn, which the
/// plan and the results before it decide.
pub struct ProbabilityRuns<'p> {
    plan: &'p Plan,
    folder: StudyFolder,
    jobs: usize,
    kept: BTreeMap<u64, Record>,
    /// The runs so far.
    pub runs: Vec<ProbabilityRun>,
    /// Number of runs that were computed now.
    pub computed: u64,
}

impl<'p> ProbabilityRuns<'p> {
    /// Begins a plan in a folder, or goes on with the same plan.
    ///
    /// # Errors
    /// The folder holds something else or another plan, another program works there, or it cannot be written
    /// to.
    pub fn open(path: &Path, plan: &'p Plan, jobs: usize) -> Result<Self, StudyFolderError> {
        let of = (plan.fingerprint(), plan.most_runs());
        let folder = StudyFolder::open_as(path, (PLAN_FILE, &NAMES), &plan.description(), of)?;
        let mut kept = BTreeMap::new();
        for part in 0..folder.parts() {
            let found = folder.part(part)?;
            kept.extend(found.records.into_iter().map(|record| (record.number, record)));
        }
        Ok(Self {
            plan,
            folder,
            jobs,
            kept,
            runs: Vec::new(),
            computed: 0,
        })
    }

    /// Returns the number of runs that the folder keeps.
    #[must_use]
    pub fn kept(&self) -> u64 {
        self.kept.len() as u64
    }

    /// Returns the answers at points, of runs that are kept or computed now, so many at a time, until `stop`
    /// becomes true. Tells each one that is computed.
    ///
    /// # Errors
    /// The folder cannot be written to, or it was stopped: runs that ended are kept.
    pub fn answers(
        &mut self,
        points: &[Vec<f64>],
        stop: &AtomicBool,
        done: &(dyn Fn() + Sync),
    ) -> Result<Vec<Answer>, Unfinished> {
        let first = self.runs.len() as u64;
        let missing: Vec<(u64, &Vec<f64>)> = (first..)
            .zip(points)
            .filter(|(number, _)| !self.kept.contains_key(number))
            .collect();
        let next = AtomicUsize::new(0);
        let failure: Mutex<Option<StudyFolderError>> = Mutex::new(None);
        let computed: Mutex<Vec<Record>> = Mutex::new(Vec::new());
        let worker = || {
            while let Some((number, point)) = missing.get(next.fetch_add(1, Ordering::Relaxed)) {
                let failed = failure.lock().unwrap_or_else(PoisonError::into_inner).is_some();
                if failed || stop.load(Ordering::Relaxed) {
                    return;
                }
                let record = self.plan.run(*number, point);
                match self.folder.keep(&record) {
                    Ok(()) => {
                        computed
                            .lock()
                            .unwrap_or_else(PoisonError::into_inner)
                            .push(record);
                        done();
                    }
                    Err(error) => {
                        let mut first = failure.lock().unwrap_or_else(PoisonError::into_inner);
                        first.get_or_insert(error);
                    }
                }
            }
        };
        std::thread::scope(|scope| {
            for _ in 0..self.jobs.min(missing.len()) {
                scope.spawn(worker);
            }
        });
        let computed = computed.into_inner().unwrap_or_else(PoisonError::into_inner);
        self.computed += computed.len() as u64;
        self.kept
            .extend(computed.into_iter().map(|record| (record.number, record)));
        if let Some(error) = failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
            return Err(error.into());
        }
        let mut answers = Vec::with_capacity(points.len());
        for (number, point) in (first..).zip(points) {
            let record = self.kept.get(&number).ok_or(Unfinished::Stopped)?.clone();
            answers.push(self.plan.answer(&record));
            self.runs.push(ProbabilityRun {
                point: point.clone(),
                record,
            });
        }
        Ok(answers)
    }
}
