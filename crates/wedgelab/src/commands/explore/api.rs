//! Requests and answers, `wedgelab.explore/1`: what `docs/explore.md` describes. No network here.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use report::view::View;
use report::view::run::{Detail, Recording};
use report::{csv, mat, run_files, summary};
use serde::{Deserialize, Serialize};
use study::case::{Case, CaseError, FieldSection, builtin};
use study::result::RunResult;
use study::run::Run;
use study::summary::{Stopped, Summary};

use super::base::Base;

/// The name and version of the answers.
pub const SCHEMA: &str = "wedgelab.explore/1";

/// What is asked for: a case with changes.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wanted {
    /// A built-in case; left out: the one the program was started with.
    #[serde(default)]
    pub preset: Option<String>,
    /// Changes by path, as typed. Those of a table go before those of its keys: that is the order of their names.
    #[serde(default)]
    pub set: BTreeMap<String, String>,
}

/// What the page needs to begin.
#[derive(Debug, Serialize)]
pub struct Opening {
    schema: &'static str,
    /// The built-in case the program was started with; `null` for a file.
    preset: Option<String>,
    /// What is being explored: the file or the built-in case.
    name: String,
    presets: Vec<Presets>,
    sections: Vec<FieldSection>,
}

/// Built-in cases that belong together.
#[derive(Debug, Serialize)]
struct Presets {
    name: &'static str,
    title: &'static str,
    look_at: &'static str,
    cases: Vec<Preset>,
}

#[derive(Debug, Serialize)]
struct Preset {
    name: &'static str,
    title: &'static str,
}

/// What came out of a run.
#[derive(Debug, Serialize)]
pub struct Answer {
    schema: &'static str,
    /// `wedgelab.view/1`.
    view: View,
    /// `wedgelab.summary/1`, without the list of events.
    summary: Summary,
    /// The case's fields as they are now: a change may change what is completed from it.
    sections: Vec<FieldSection>,
    /// What the run took, s.
    seconds: f64,
}

/// A mistake in what was asked for.
#[derive(Debug, PartialEq, Eq, Serialize)]
pub struct Mistake {
    /// The field it belongs to; empty if it belongs to none.
    pub path: String,
    /// What is wrong.
    pub message: String,
    /// What to write instead; may be empty.
    pub help: String,
}

/// Why there is no answer.
#[derive(Debug, PartialEq, Eq)]
pub enum Refused {
    /// What was typed is wrong.
    Mistakes(Vec<Mistake>),
    /// A later request took its place.
    Replaced,
    /// There is no such file.
    Unknown(String),
    /// Files could not be made.
    Failed(String),
}

/// A file to be kept.
#[derive(Debug)]
pub struct Export {
    /// Its name.
    pub name: String,
    /// Its type.
    pub media: &'static str,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// The explorer's state: the case, the number of the latest run, the latest result.
pub struct Explorer {
    base: Base,
    latest: AtomicU64,
    kept: Mutex<Option<Kept>>,
}

struct Kept {
    wanted: Wanted,
    outcome: Arc<(Case, RunResult)>,
}

impl Explorer {
    /// Of this case.
    pub fn new(base: Base) -> Self {
        Self {
            base,
            latest: AtomicU64::new(0),
            kept: Mutex::new(None),
        }
    }

    /// Ends whatever runs; gives the number of a run that begins now.
    pub fn begin(&self) -> u64 {
        self.latest.fetch_add(1, Ordering::SeqCst) + 1
    }

    /// What the page needs to begin.
    ///
    /// # Errors
    /// A table that the case names has changed since the start and is wrong now.
    pub fn opening(&self) -> Result<Opening, Refused> {
        let case = self.case(&Wanted::default())?;
        let presets = builtin::groups().iter().map(|group| Presets {
            name: group.name,
            title: group.title,
            look_at: group.look_at,
            cases: group
                .cases
                .iter()
                .map(|case| Preset {
                    name: &case.name,
                    title: &case.title,
                })
                .collect(),
        });
        Ok(Opening {
            schema: SCHEMA,
            preset: self.base.preset().map(str::to_owned),
            name: case.name.clone(),
            presets: presets.collect(),
            sections: case.document.fields(),
        })
    }

    /// Runs what is wanted, unless a later request comes.
    ///
    /// # Errors
    /// What was typed is wrong, or a later request came.
    pub fn run(&self, wanted: &Wanted, number: u64) -> Result<Answer, Refused> {
        let begun = Instant::now();
        let outcome = self.outcome(wanted, number)?;
        let seconds = begun.elapsed().as_secs_f64();
        let (case, result) = &*outcome;
        let recording = Recording::of_wedge(&outcome, Detail::Full);
        let view = View::new(result.summary.units, [recording], []);
        let mut summary = result.summary.clone();
        summary.events.listed.clear();
        Ok(Answer {
            schema: SCHEMA,
            view,
            summary,
            sections: case.document.fields(),
            seconds,
        })
    }

    /// A file of what is wanted: one of those of `wedgelab run`.
    ///
    /// # Errors
    /// As [`Explorer::run`], or there is no such file.
    pub fn export(&self, wanted: &Wanted, file: &str, number: impl Fn() -> u64) -> Result<Export, Refused> {
        let failed = |error: std::io::Error| Refused::Failed(error.to_string());
        let mut bytes = Vec::new();
        let (name, media) = if file == run_files::CASE_FILE_NAME {
            let case = self.case(wanted)?;
            bytes = case.document.with_tables_embedded().to_toml().into_bytes();
            (case.name, "application/toml")
        } else {
            if !run_files::NAMES.contains(&file) {
                let names = run_files::NAMES.join(", ");
                return Err(Refused::Unknown(format!(
                    "There is no file {file}; there are {names}."
                )));
            }
            let outcome = self.outcome(wanted, number())?;
            let (case, result) = &*outcome;
            let media = match file {
                csv::FILE_NAME => csv::write(result, &mut bytes).map(|()| "text/csv"),
                mat::FILE_NAME => mat::write(case, result, &mut bytes).map(|()| "application/octet-stream"),
                _ => summary::write(&result.summary, &mut bytes).map(|()| "application/json"),
            };
            (case.name.clone(), media.map_err(failed)?)
        };
        Ok(Export {
            name: format!("{name}_{file}"),
            media,
            bytes,
        })
    }

    fn case(&self, wanted: &Wanted) -> Result<Case, Refused> {
        let overrides: Vec<String> = wanted
            .set
            .iter()
            .map(|(path, text)| format!("{path}={text}"))
            .collect();
        let built_in = wanted.preset.clone().map(Base::BuiltIn);
        let base = built_in.as_ref().unwrap_or(&self.base);
        base.with(&overrides).map_err(|error| {
            let known = base.with(&[]).map_or(Vec::new(), |case| case.document.fields());
            Refused::Mistakes(mistakes(&error, &wanted.set, &known))
        })
    }

    /// What comes out; that of the latest run if it is what was wanted then.
    fn outcome(&self, wanted: &Wanted, number: u64) -> Result<Arc<(Case, RunResult)>, Refused> {
        let case = self.case(wanted)?;
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        // Tables in files may have changed: the case must be the same, too.
        if let Some(kept) = kept
            .as_ref()
            .filter(|kept| kept.wanted == *wanted && kept.outcome.0 == case)
        {
            return Ok(Arc::clone(&kept.outcome));
        }
        drop(kept);
        let result = self.compute(&case, number)?;
        let outcome = Arc::new((case, result));
        *self.kept.lock().unwrap_or_else(PoisonError::into_inner) = Some(Kept {
            wanted: wanted.clone(),
            outcome: Arc::clone(&outcome),
        });
        Ok(outcome)
    }

    fn compute(&self, case: &Case, number: u64) -> Result<RunResult, Refused> {
        let mut run = Run::new(case).map_err(|error| {
            Refused::Mistakes(vec![Mistake {
                path: String::new(),
                message: format!("the run cannot begin: {error}"),
                help: "look for values that are out of proportion".to_owned(),
            }])
        })?;
        while !run.is_finished() {
            if self.latest.load(Ordering::Relaxed) != number {
                return Err(Refused::Replaced);
            }
            if let Err(error) = run.advance() {
                let stopped = Stopped {
                    time: run.time(),
                    reason: error.to_string(),
                    contacts: run.contact_states(),
                };
                return Ok(run.result(Some(stopped)));
            }
        }
        Ok(run.result(None))
    }
}

/// The mistakes, each with the field it is shown at: the one that was typed into, or else the one the message speaks of.
fn mistakes(error: &CaseError, set: &BTreeMap<String, String>, known: &[FieldSection]) -> Vec<Mistake> {
    let is_field = |path: &str| {
        set.contains_key(path)
            || known
                .iter()
                .flat_map(|section| &section.fields)
                .any(|field| field.path == path)
    };
    error
        .problems()
        .iter()
        .map(|problem| {
            let message = problem.message();
            let spoken_of = message
                .split('`')
                .nth(1)
                .map(|path| path.split('[').next().unwrap_or(path));
            let path = problem.set_path().or(spoken_of).filter(|path| is_field(path));
            Mistake {
                path: path.unwrap_or("").to_owned(),
                message: message.to_owned(),
                help: problem.advice().unwrap_or("").to_owned(),
            }
        })
        .collect()
}
