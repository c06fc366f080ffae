//! The runs of a survey of wedge rise: those that a folder keeps, and those that come next, which threads of
//! this process compute, or a program that has workers elsewhere.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::{fs, io};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use staging::{FileError, Folder};
use study::design::StudySource;
use study::records;
use study::rise::bracket::Rise;
use study::rise::plan::Batch;
use study::rise::rigs::{OfRig, Rig};
use study::rise::{Known, OfRun, Prepared, Survey, Wanted};

use crate::assessment_work::in_parallel;
use crate::study_folder::StudyFolderError;

/// The folder of kept runs, in that of the survey.
pub const RUNS: &str = "runs";

/// What is known when a survey ends.
#[derive(Clone, Debug, Default)]
pub struct RiseFindings {
    /// The runs.
    pub known: Known,
    /// The rigs.
    pub rigs: Vec<OfRig>,
    /// The number of runs and rigs that the folder had before.
    pub before: usize,
}

/// A run or a rig as it is kept: with all that it is made of, so that another car's is not taken for it.
#[derive(Deserialize, Serialize)]
struct Kept<T> {
    program: String,
    made_of: String,
    found: T,
}

/// A run or a rig that is to be computed.
#[derive(Clone, Debug)]
pub struct RiseTask {
    name: String,
    made_of: String,
    what: What,
}

#[derive(Clone, Debug)]
enum What {
    Rig(Rig, Rise),
    Run(Wanted, Box<Prepared>),
}

/// What came of a task.
enum Found {
    Rig(OfRig),
    Run(Wanted, OfRun),
}

/// Tasks that do not wait for each other.
#[derive(Clone, Debug)]
pub struct RiseTasks {
    /// What they look at.
    pub about: &'static str,
    /// The tasks.
    pub tasks: Vec<RiseTask>,
}

/// The runs of a survey, and the folder that keeps them.
#[derive(Debug)]
pub struct RiseRuns {
    survey: Arc<Survey>,
    folder: PathBuf,
    /// One file is written at a time.
    writes: Mutex<()>,
    rigs_are_next: bool,
    findings: RiseFindings,
}

impl RiseTask {
    /// Returns the study whose only run it is, for a worker elsewhere; none of a rig, which is computed here.
    #[must_use]
    pub fn elsewhere(&self) -> Option<&StudySource> {
        match &self.what {
            What::Rig(..) => None,
            What::Run(_, prepared) => Some(prepared.study().source()),
        }
    }
}

impl RiseRuns {
    /// Returns the runs of a survey in its folder.
    #[must_use]
    pub fn new(survey: Arc<Survey>, path: &Path) -> Self {
        Self {
            survey,
            folder: path.join(RUNS),
            writes: Mutex::new(()),
            rigs_are_next: true,
            findings: RiseFindings::default(),
        }
    }

    /// Returns what is known.
    #[must_use]
    pub fn findings(&self) -> &RiseFindings {
        &self.findings
    }

    /// Returns what is to be computed next; none if the survey has come to its end.
    pub fn next_tasks(&mut self) -> Option<RiseTasks> {
        if std::mem::take(&mut self.rigs_are_next) {
            let tasks = self.missing_rigs();
            if !tasks.is_empty() {
                let about = "warp, damping, hunting";
                return Some(RiseTasks { about, tasks });
            }
        }
        while let Some(Batch { about, runs }) = self.survey.next(&self.findings.known) {
            let missing = runs.into_iter().filter_map(|wanted| self.missing_run(wanted));
            let tasks: Vec<RiseTask> = missing.collect();
            if !tasks.is_empty() {
                return Some(RiseTasks { about, tasks });
            }
        }
        None
    }

    fn missing_rigs(&mut self) -> Vec<RiseTask> {
        let mut tasks = Vec::new();
        for (rig, rise) in self.survey.rigs() {
            let made_of = self.survey.rig_made_of((rig, rise));
            let name = format!("{}_rise_{rise}_16", rig.name());
            match self.kept(&name, &made_of) {
                Some(own) => self.know(Found::Rig(own), true),
                None => tasks.push(RiseTask {
                    name,
                    made_of,
                    what: What::Rig(rig, rise),
                }),
            }
        }
        tasks
    }

    /// Returns the task of a run; none if it is kept, or cannot begin.
    fn missing_run(&mut self, wanted: Wanted) -> Option<RiseTask> {
        let prepared = match self.survey.prepare(&wanted) {
            Ok(own) => own,
            Err(error) => {
                let refused = self.survey.refused(error);
                self.know(Found::Run(wanted, refused), false);
                return None;
            }
        };
        let made_of = prepared.case().to_toml().unwrap_or_default();
        let name = self.survey.name_of(&wanted);
        match self.kept(&name, &made_of) {
            Some(own) => {
                self.know(Found::Run(wanted, own), true);
                None
            }
            None => Some(RiseTask {
                name,
                made_of,
                what: What::Run(wanted, Box::new(prepared)),
            }),
        }
    }

    fn know(&mut self, found: Found, was_there: bool) {
        self.findings.before += usize::from(was_there);
        match found {
            Found::Rig(own) => {
                self.findings.rigs.push(own);
                self.findings.rigs.sort_by_key(|own| (own.rig, own.rise));
            }
            Found::Run(wanted, own) => {
                self.findings.known.insert(wanted, own);
            }
        }
    }

    /// Computes tasks, so many at a time, until `stop` becomes true; tells each that is kept. Returns whether
    /// all were computed.
    ///
    /// # Errors
    /// A file cannot be written; what was written before stays.
    pub fn compute(
        &mut self,
        tasks: Vec<RiseTask>,
        jobs: usize,
        stop: &AtomicBool,
        done: &(dyn Fn() + Sync),
    ) -> Result<bool, FileError> {
        let stops = || stop.load(Ordering::Relaxed);
        let compute = |task: RiseTask| -> Result<Option<Found>, FileError> {
            if stops() {
                return Ok(None);
            }
            let found = match &task.what {
                What::Run(wanted, prepared) => Found::Run(wanted.clone(), prepared.run()),
                What::Rig(rig, rise) => {
                    let go_on = || match stops() {
                        true => ControlFlow::Break("the survey was stopped".to_owned()),
                        false => ControlFlow::Continue(()),
                    };
                    Found::Rig(self.survey.rig((*rig, *rise), &go_on))
                }
            };
            // A rig that was stopped says nothing of the truck.
            if matches!(found, Found::Rig(_)) && stops() {
                return Ok(None);
            }
            self.write(&task, &found)?;
            done();
            Ok(Some(found))
        };
        let mut all = true;
        for own in in_parallel(tasks.into(), jobs, compute) {
            match own? {
                Some(found) => self.know(found, false),
                None => all = false,
            }
        }
        Ok(all)
    }

    /// Keeps the record of a task that a worker elsewhere computed.
    ///
    /// # Errors
    /// It is no such record, or the file cannot be written.
    pub fn keep(&mut self, task: &RiseTask, bytes: &[u8]) -> Result<(), StudyFolderError> {
        let What::Run(wanted, prepared) = &task.what else {
            return Err(StudyFolderError::ForeignBytes);
        };
        let found = records::read(prepared.study().fingerprint(), bytes);
        let [record] = found.records.as_slice() else {
            return Err(StudyFolderError::ForeignBytes);
        };
        let found = Found::Run(wanted.clone(), prepared.of(record));
        self.write(task, &found)?;
        self.know(found, false);
        Ok(())
    }

    /// Returns what a file keeps, if it is made of this.
    fn kept<T: DeserializeOwned>(&self, name: &str, made_of: &str) -> Option<T> {
        let text = fs::read(self.folder.join(format!("{name}.json"))).ok()?;
        let own: Kept<T> = serde_json::from_slice(&text).ok()?;
        (own.made_of == made_of && own.program == program()).then_some(own.found)
    }

    fn write(&self, task: &RiseTask, found: &Found) -> Result<(), FileError> {
        match found {
            Found::Rig(own) => self.write_as(task, own),
            Found::Run(_, own) => self.write_as(task, own),
        }
    }

    fn write_as<T: Serialize>(&self, task: &RiseTask, found: T) -> Result<(), FileError> {
        let file = format!("{}.json", task.name);
        let own = Kept {
            program: program(),
            made_of: task.made_of.clone(),
            found,
        };
        let _one_at_a_time = self.writes.lock().unwrap_or_else(PoisonError::into_inner);
        Folder::check(&self.folder, &[&file], true)?.write(|files| {
            files.add(&file, |out| {
                serde_json::to_writer_pretty(out, &own).map_err(io::Error::from)
            })
        })
    }
}

fn program() -> String {
    format!("wedgelab {}", env!("CARGO_PKG_VERSION"))
}
