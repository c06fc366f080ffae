//! The runs of a survey of wedge rise: those that a folder keeps, the others computed and kept there.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::{fs, io};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use staging::{FileError, Folder};
use study::rise::plan::Batch;
use study::rise::rigs::{OfRig, Rig};
use study::rise::{Known, OfRun, Survey, Wanted};

use crate::assessment_work::in_parallel;

/// The folder of kept runs, in that of the survey.
pub const RUNS: &str = "runs";

/// What is known when a survey ends.
#[derive(Clone, Debug)]
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

/// What survey and caller say to each other.
pub struct Watch<'w> {
    /// Becomes true when the survey is to stop.
    pub stop: &'w AtomicBool,
    /// Hears of each batch of runs before it begins, with the number of runs that are known.
    pub begins: &'w (dyn Fn(&str, usize, usize) + Sync),
    /// Hears of each run that is done.
    pub done: &'w (dyn Fn() + Sync),
}

/// A folder of kept runs.
struct Keeper<'w> {
    folder: PathBuf,
    /// One file is written at a time.
    writes: Mutex<()>,
    watch: &'w Watch<'w>,
}

/// Makes all runs of a survey; none if it was stopped.
///
/// # Errors
/// A file cannot be written.
pub fn run(
    survey: &Survey,
    path: &Path,
    jobs: usize,
    watch: &Watch<'_>,
) -> Result<Option<RiseFindings>, FileError> {
    let keeper = Keeper {
        folder: path.join(RUNS),
        writes: Mutex::new(()),
        watch,
    };
    let mut findings = RiseFindings {
        known: Known::new(),
        rigs: Vec::new(),
        before: 0,
    };
    let rigs = survey.rigs();
    (watch.begins)("warp, damping, hunting", rigs.len(), 0);
    for own in in_parallel(rigs.into(), jobs, |own| keeper.rig(survey, own)) {
        let Some((was_there, own)) = own? else {
            return Ok(None);
        };
        findings.before += usize::from(was_there);
        findings.rigs.push(own);
    }
    findings.rigs.sort_by_key(|own| (own.rig, own.rise));
    while let Some(Batch { about, runs }) = survey.next(&findings.known) {
        (watch.begins)(about, runs.len(), findings.known.len());
        let found = in_parallel(runs.into(), jobs, |wanted| {
            let own = keeper.run(survey, &wanted);
            own.map(|own| own.map(|own| (wanted, own)))
        });
        for own in found {
            let Some((wanted, (was_there, run))) = own? else {
                return Ok(None);
            };
            findings.before += usize::from(was_there);
            findings.known.insert(wanted, run);
        }
    }
    Ok(Some(findings))
}

/// A result, and whether it was there before; none if the survey was stopped.
type Found<T> = Result<Option<(bool, T)>, FileError>;

impl Keeper<'_> {
    fn stops(&self) -> bool {
        self.watch.stop.load(Ordering::Relaxed)
    }

    fn run(&self, survey: &Survey, wanted: &Wanted) -> Found<OfRun> {
        if self.stops() {
            return Ok(None);
        }
        let prepared = match survey.prepare(wanted) {
            Ok(own) => own,
            Err(error) => {
                (self.watch.done)();
                return Ok(Some((false, survey.refused(error))));
            }
        };
        let made_of = prepared.case().to_toml().unwrap_or_default();
        self.kept(&survey.name_of(wanted), made_of, || Some(prepared.run()))
    }

    fn rig(&self, survey: &Survey, (rig, rise): (Rig, u32)) -> Found<OfRig> {
        if self.stops() {
            return Ok(None);
        }
        let made_of = survey.rig_made_of((rig, rise));
        self.kept(&format!("{}_rise_{rise}_16", rig.name()), made_of, || {
            let go_on = || match self.stops() {
                true => ControlFlow::Break("the survey was stopped".to_owned()),
                false => ControlFlow::Continue(()),
            };
            let own = survey.rig((rig, rise), &go_on);
            (!self.stops()).then_some(own)
        })
    }

    /// Returns what a file keeps if it is made of this, else computes and keeps it.
    fn kept<T: DeserializeOwned + Serialize>(
        &self,
        name: &str,
        made_of: String,
        compute: impl FnOnce() -> Option<T>,
    ) -> Found<T> {
        let file = format!("{name}.json");
        let there = fs::read(self.folder.join(&file)).ok();
        let there: Option<Kept<T>> = there.and_then(|text| serde_json::from_slice(&text).ok());
        if let Some(own) = there.filter(|own| own.made_of == made_of && own.program == program()) {
            (self.watch.done)();
            return Ok(Some((true, own.found)));
        }
        let Some(found) = compute() else { return Ok(None) };
        let own = Kept {
            program: program(),
            made_of,
            found,
        };
        let one_at_a_time = self.writes.lock().unwrap_or_else(PoisonError::into_inner);
        Folder::check(&self.folder, &[&file], true)?.write(|files| {
            files.add(&file, |out| {
                serde_json::to_writer_pretty(out, &own).map_err(io::Error::from)
            })
        })?;
        drop(one_at_a_time);
        (self.watch.done)();
        Ok(Some((false, own.found)))
    }
}

fn program() -> String {
    format!("wedgelab {}", env!("CARGO_PKG_VERSION"))
}
