//! The runs of a probability: those that a folder keeps, and those that come next, which threads of this
//! process compute, or a program that has workers elsewhere.
//!
//! What comes next follows from the plan and the results before: the estimate is made anew of what is kept
//! until a run is missing. So it is the same however often it was interrupted, and whoever computed.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use study::probability::{Plan, ProbabilityRun, ProbabilitySummary, estimate, indices};
use study::records::{self, Record};
use study::remote_run::RemoteRun;

use crate::assessment_work::in_parallel;
use crate::probability_files::NAMES;
use crate::study_folder::{StudyFolder, StudyFolderError};

/// The file that says what the runs of a folder are.
pub const PLAN_FILE: &str = "plan.json";

/// The runs of a plan, and the folder that keeps them.
#[derive(Debug)]
pub struct ProbabilityRuns {
    plan: Arc<Plan>,
    folder: StudyFolder,
    kept: BTreeMap<u64, Record>,
}

/// A run that is to be computed: its number, which is its turn, and its point.
pub type ProbabilityTask = (u64, Vec<f64>);

/// What comes next.
#[derive(Clone, Debug)]
pub enum ProbabilityNext {
    /// Runs that do not wait for each other.
    Missing(Vec<ProbabilityTask>),
    /// The result, and all runs in their order.
    Found(Box<ProbabilitySummary>, Vec<ProbabilityRun>),
}

impl ProbabilityRuns {
    /// Begins a plan in a folder, or goes on with the same plan.
    ///
    /// # Errors
    /// The folder holds something else or another plan, another program works there, or it cannot be written
    /// to.
    pub fn open(path: &Path, plan: Arc<Plan>) -> Result<Self, StudyFolderError> {
        let of = (plan.fingerprint(), plan.most_runs());
        let folder = StudyFolder::open_as(path, (PLAN_FILE, &NAMES), &plan.description(), of)?;
        let mut kept = BTreeMap::new();
        for part in 0..folder.parts() {
            let found = folder.part(part)?;
            kept.extend(found.records.into_iter().map(|record| (record.number, record)));
        }
        Ok(Self { plan, folder, kept })
    }

    /// Returns the plan.
    #[must_use]
    pub fn plan(&self) -> &Arc<Plan> {
        &self.plan
    }

    /// Returns the number of runs that the folder keeps.
    #[must_use]
    pub fn kept(&self) -> u64 {
        self.kept.len() as u64
    }

    /// Returns what comes next.
    #[must_use]
    pub fn comes_next(&self) -> ProbabilityNext {
        let plan = &*self.plan;
        let mut runs: Vec<ProbabilityRun> = Vec::new();
        let mut evaluate = |points: &[Vec<f64>]| {
            let numbered = || (runs.len() as u64..).zip(points);
            let missing = numbered().filter(|(number, _)| !self.kept.contains_key(number));
            let missing: Vec<_> = missing.map(|(number, point)| (number, point.clone())).collect();
            if !missing.is_empty() {
                return Err(missing);
            }
            let records = numbered().filter_map(|(number, point)| {
                let record = self.kept.get(&number)?.clone();
                let point = point.clone();
                Some(ProbabilityRun { point, record })
            });
            let records: Vec<ProbabilityRun> = records.collect();
            let answers = records.iter().map(|run| plan.answer(&run.record)).collect();
            runs.extend(records);
            Ok(answers)
        };
        let (dimensions, seed) = (plan.uncertain.len(), plan.seed());
        let of = (dimensions, plan.limit.goal, plan.confidence);
        let found = estimate(&plan.estimator, of, &mut evaluate);
        let found = found.and_then(|found| {
            let sobol = match plan.indices {
                0 => None,
                samples => indices::sobol(samples, (dimensions, seed, plan.confidence), &mut evaluate)?,
            };
            Ok((found, sobol))
        });
        match found {
            Err(missing) => ProbabilityNext::Missing(missing),
            Ok((found, sobol)) => {
                let summary = ProbabilitySummary::new(plan, found, sobol, &runs);
                ProbabilityNext::Found(Box::new(summary), runs)
            }
        }
    }

    /// Computes runs, so many at a time, until `stop` becomes true; tells each that is kept.
    ///
    /// # Errors
    /// The folder cannot be written to: runs that ended are kept.
    pub fn compute(
        &mut self,
        tasks: Vec<ProbabilityTask>,
        jobs: usize,
        stop: &AtomicBool,
        done: &(dyn Fn() + Sync),
    ) -> Result<(), StudyFolderError> {
        let failure: Mutex<Option<StudyFolderError>> = Mutex::new(None);
        let failed = || failure.lock().unwrap_or_else(PoisonError::into_inner);
        let records = in_parallel(tasks.into(), jobs, |(number, point): ProbabilityTask| {
            if stop.load(Ordering::Relaxed) || failed().is_some() {
                return None;
            }
            let record = self.plan.run(number, &point);
            match self.folder.keep(&record) {
                Ok(()) => {
                    done();
                    Some(record)
                }
                Err(error) => {
                    failed().get_or_insert(error);
                    None
                }
            }
        });
        let records = records.into_iter().flatten();
        self.kept.extend(records.map(|record| (record.number, record)));
        match failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some(error) => Err(error),
            None => Ok(()),
        }
    }

    /// Returns a run for a worker elsewhere.
    #[must_use]
    pub fn elsewhere(&self, (number, point): &ProbabilityTask) -> RemoteRun {
        self.plan.elsewhere(*number, point)
    }

    /// Keeps records that workers elsewhere computed.
    ///
    /// # Errors
    /// The bytes hold something else than records of this plan, or they cannot be written.
    pub fn keep(&mut self, bytes: &[u8]) -> Result<(), StudyFolderError> {
        self.folder.keep_all(bytes)?;
        let found = records::read(self.plan.fingerprint(), bytes).records.into_iter();
        self.kept.extend(found.map(|record| (record.number, record)));
        Ok(())
    }
}
