//! Requests and answers, `wedgelab.explore/1`, described in `docs/explore.md`. No network here.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::time::Instant;

use report::models::Loop;
use report::view::View;
use report::{run_files, summary};
use serde::{Deserialize, Serialize};
use study::case::builtin::CaseGroup;
use study::case::{CaseError, FieldSection};
use study::models::{self, AnyCase, AnySummary};

use super::base::Base;
use super::limits;
use super::outcome::{Outcome, compute};

/// The name and version of the answers.
pub const SCHEMA: &str = "wedgelab.explore/1";

/// A request: a case with changes.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wanted {
    /// A built-in case; left out: the one the program was started with.
    #[serde(default)]
    pub preset: Option<String>,
    /// Changes by path, as typed. Those of a table go before those of its keys: that is the order of their
    /// names.
    #[serde(default)]
    pub set: BTreeMap<String, String>,
}

/// The data that the page needs to begin.
#[derive(Debug, Serialize)]
pub struct Opening {
    schema: &'static str,
    /// The built-in case the program was started with; `null` for a file.
    preset: Option<String>,
    /// The name of the explored file or built-in case.
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

/// The answer to a run.
#[derive(Debug, Serialize)]
pub struct Answer {
    schema: &'static str,
    /// `wedgelab.view/1`.
    view: View,
    #[serde(serialize_with = "AnySummary::serialize_content")]
    summary: AnySummary,
    /// The loop that is shown over earlier ones.
    #[serde(rename = "loop")]
    shown_loop: Loop,
    /// The case's fields as they are now: a change may change what is completed from it.
    sections: Vec<FieldSection>,
    /// Wall time of the run, s.
    seconds: f64,
}

/// A mistake in what was asked for.
#[derive(Debug, PartialEq, Eq, Serialize)]
pub struct Mistake {
    /// The field it belongs to; empty if it belongs to none.
    pub path: String,
    /// The mistake.
    pub message: String,
    /// The remedy: text to write instead; may be empty.
    pub help: String,
}

/// The reason if there is no answer.
#[derive(Debug, PartialEq, Eq)]
pub enum Refused {
    /// Mistakes in the typed text.
    Mistakes(Vec<Mistake>),
    /// A later request took its place, or its client has gone.
    Replaced,
    /// There is no such file.
    Unknown(String),
    /// Files could not be made.
    Failed(String),
}

impl Refused {
    /// Makes the message of one mistake.
    pub fn mistake(path: &str, message: String, help: &str) -> Self {
        Self::Mistakes(vec![Mistake {
            path: path.to_owned(),
            message,
            help: help.to_owned(),
        }])
    }
}

impl Wanted {
    /// Refuses more than is looked at.
    fn check(&self) -> Result<(), Refused> {
        let names = self.set.keys().chain(&self.preset);
        if self.set.len() > limits::CHANGES {
            let message = format!("{} changes are too many", self.set.len());
            let help = format!(
                "at most {} are laid over a case; write them into a case file",
                limits::CHANGES
            );
            return Err(Refused::mistake("", message, &help));
        }
        if let Some(long) = names.into_iter().find(|name| name.len() > limits::NAME) {
            let message = format!("a name of {} bytes is too long", long.len());
            let help = format!("paths and presets have at most {} bytes", limits::NAME);
            return Err(Refused::mistake("", message, &help));
        }
        if let Some((path, text)) = self.set.iter().find(|(_, text)| text.len() > limits::TEXT) {
            let message = format!("a text of {} bytes is too long", text.len());
            let help = format!(
                "at most {} bytes are read; put a long table into a CSV file",
                limits::TEXT
            );
            return Err(Refused::mistake(path, message, &help));
        }
        Ok(())
    }
}

/// A file to be kept.
#[derive(Debug)]
pub struct Export {
    /// Its name.
    pub name: String,
    /// Its type.
    pub media: &'static str,
    /// Its contents.
    pub bytes: Vec<u8>,
}

/// The explorer's state: the case, the number of the latest run, the latest result.
pub struct Explorer {
    base: Base,
    latest: AtomicU64,
    kept: Mutex<Option<StoredRun>>,
}

/// Whoever waits for an answer. When it is dropped, what was begun for it ends at its next step.
#[derive(Debug, Default)]
pub struct Client(Arc<()>);

impl Client {
    /// Returns a watch that tells whether the client still waits.
    pub fn watch(&self) -> Watch {
        Watch(Arc::downgrade(&self.0))
    }
}

/// Tells whether a [`Client`] still waits.
#[derive(Clone, Debug)]
pub struct Watch(Weak<()>);

/// A run that has begun: it goes on while no later one begins and its client waits.
#[derive(Debug)]
pub struct Turn {
    number: u64,
    client: Watch,
}

struct StoredRun {
    wanted: Wanted,
    outcome: Arc<Outcome>,
}

impl Explorer {
    /// Makes it of this case.
    pub fn new(base: Base) -> Self {
        Self {
            base,
            latest: AtomicU64::new(0),
            kept: Mutex::new(None),
        }
    }

    /// Ends whatever runs; gives the turn of a run that begins now.
    pub fn begin(&self, client: Watch) -> Turn {
        Turn {
            number: self.latest.fetch_add(1, Ordering::SeqCst) + 1,
            client,
        }
    }

    /// Ends whatever runs.
    pub fn end(&self) {
        self.latest.fetch_add(1, Ordering::SeqCst);
    }

    fn goes_on(&self, turn: &Turn) -> bool {
        self.latest.load(Ordering::Relaxed) == turn.number && turn.client.0.strong_count() > 0
    }

    /// Returns the data that the page needs to begin.
    ///
    /// # Errors
    /// A table that the case names has changed since the start and is wrong now.
    pub fn opening(&self) -> Result<Opening, Refused> {
        let case = self.case(&Wanted::default())?;
        let presets = |group: &'static CaseGroup| Presets {
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
        };
        Ok(Opening {
            schema: SCHEMA,
            preset: self.base.preset().map(str::to_owned),
            name: case.name().to_owned(),
            presets: models::groups().map(presets).collect(),
            sections: case.fields(),
        })
    }

    /// Runs what is wanted, unless a later request comes or the client goes.
    ///
    /// # Errors
    /// Mistakes in the typed text, a later request, or a client that has gone.
    pub fn run(&self, wanted: &Wanted, turn: &Turn) -> Result<Answer, Refused> {
        let started = Instant::now();
        let outcome = self.outcome(wanted, turn)?;
        let seconds = started.elapsed().as_secs_f64();
        Ok(Answer {
            schema: SCHEMA,
            view: outcome.view(),
            summary: outcome.summary(),
            shown_loop: outcome.shown_loop(),
            sections: outcome.case.fields(),
            seconds,
        })
    }

    /// Returns a file of what is wanted: one of those of `wedgelab run`.
    ///
    /// # Errors
    /// As [`Explorer::run`], or there is no such file.
    pub fn export(&self, wanted: &Wanted, file: &str, client: Watch) -> Result<Export, Refused> {
        let failed = |error: std::io::Error| Refused::Failed(error.to_string());
        let mut bytes = Vec::new();
        let (name, media) = if file == run_files::CASE_FILE_NAME {
            let case = self.case(wanted)?;
            bytes = case.to_toml().unwrap_or_default().into_bytes();
            (case.name().to_owned(), "application/toml")
        } else {
            let tables = run_files::TABLES.map(|(_, name)| name);
            let names = [&tables[..], &[run_files::CASE_FILE_NAME, summary::FILE_NAME]].concat();
            if !names.contains(&file) {
                let names = names.join(", ");
                return Err(Refused::Unknown(format!(
                    "There is no file {file}; there are {names}."
                )));
            }
            let outcome = self.outcome(wanted, &self.begin(client))?;
            let media = outcome.write(file, &mut bytes).map_err(failed)?;
            (outcome.case.name().to_owned(), media)
        };
        Ok(Export {
            name: format!("{name}_{file}"),
            media,
            bytes,
        })
    }

    fn case(&self, wanted: &Wanted) -> Result<AnyCase, Refused> {
        wanted.check()?;
        let overrides: Vec<String> = wanted
            .set
            .iter()
            .map(|(path, text)| format!("{path}={text}"))
            .collect();
        let built_in = wanted.preset.clone().map(Base::BuiltIn);
        let base = built_in.as_ref().unwrap_or(&self.base);
        let case = base.with(&overrides).map_err(|error| {
            let known = base.with(&[]).map_or(Vec::new(), |case| case.fields());
            Refused::Mistakes(mistakes(&error, &wanted.set, &known))
        })?;
        limits::check(&case).map_err(|refused| {
            let typed = [refused.path, "simulation.duration"];
            let path = typed.iter().find(|path| wanted.set.contains_key(**path));
            Refused::mistake(path.unwrap_or(&refused.path), refused.message, &refused.help)
        })?;
        Ok(case)
    }

    /// Returns the outcome; that of the latest run if it is what was wanted then.
    fn outcome(&self, wanted: &Wanted, turn: &Turn) -> Result<Arc<Outcome>, Refused> {
        let case = self.case(wanted)?;
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        // Tables in files may have changed: the case must be the same, too.
        if let Some(kept) = kept
            .as_ref()
            .filter(|kept| kept.wanted == *wanted && kept.outcome.is_of(&case))
        {
            return Ok(Arc::clone(&kept.outcome));
        }
        drop(kept);
        let outcome = Arc::new(compute(case, || self.goes_on(turn))?);
        *self.kept.lock().unwrap_or_else(PoisonError::into_inner) = Some(StoredRun {
            wanted: wanted.clone(),
            outcome: Arc::clone(&outcome),
        });
        Ok(outcome)
    }
}

/// Returns the mistakes, each with the field it is shown at: the one that was typed into, or else the one the
/// message speaks of.
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::outcome::finite;
    use super::*;

    fn explorer() -> Explorer {
        Explorer::new(Base::BuiltIn("vdrun_toe_0_psi_0".to_owned()))
    }

    #[test]
    fn issue_029_a_run_ends_with_its_client() {
        let (explorer, wanted) = (explorer(), Wanted::default());
        let client = Client::default();
        let turn = explorer.begin(client.watch());
        assert!(explorer.run(&wanted, &turn).is_ok());
        let other = Wanted {
            set: [("friction.column".to_owned(), "0.3".to_owned())].into(),
            ..wanted
        };
        drop(client);
        assert_eq!(explorer.run(&other, &turn).err(), Some(Refused::Replaced));
        let client = Client::default();
        let turn = explorer.begin(client.watch());
        explorer.begin(client.watch());
        assert_eq!(explorer.run(&other, &turn).err(), Some(Refused::Replaced));
    }

    #[test]
    fn issue_029_results_that_are_not_finite_are_refused() {
        let explorer = explorer();
        let client = Client::default();
        let turn = explorer.begin(client.watch());
        let outcome = explorer.outcome(&Wanted::default(), &turn).unwrap();
        let AnySummary::Wedge(mut own) = outcome.summary() else {
            unreachable!("it is a wedge");
        };
        assert_eq!(finite(&*own), Ok(()));
        own.averages.energy_per_cycle.values_mut().next().unwrap().value = f64::NAN;
        let Err(Refused::Mistakes(mistakes)) = finite(&*own) else {
            unreachable!("it is not finite");
        };
        assert!(
            mistakes[0].message.contains("the energy per cycle at the"),
            "{mistakes:?}"
        );
    }
}
