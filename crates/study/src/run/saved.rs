//! Saved states of runs as files: JSON with the schema, the case as it is printed, and the state, every
//! number with all of its bits. A state belongs to its case: a run of another one does not go on from it.

use std::path::Path;

use input::FileType;
use input::file::{Expected, read_text};
use input::limits::SAVED_STATE;
use miette::Diagnostic;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{RUN_STATE_VERSION, Recorder, RunCase, RunError, RunState};

/// The schema's name and version.
const SCHEMA: &str = "wedgelab.run_state/1";
/// Advice where a file is none of a saved state.
const NAME_ONE: &str = "name a file that `wedgelab run --save` wrote";
const FILE: Expected = Expected {
    what: "saved state",
    types: &[FileType::Json],
    most: SAVED_STATE,
};

/// The state of a run of a case.
pub type StateOf<C> = RunState<<<C as RunCase>::Recorder as Recorder>::Counts>;

/// A file is no state that a run can go on from.
#[derive(Debug, Error, Diagnostic)]
#[error("{message}")]
#[diagnostic(help("{advice}"))]
pub struct SavedStateError {
    message: String,
    advice: String,
}

impl SavedStateError {
    fn new(message: impl Into<String>, advice: impl Into<String>) -> Self {
        Self {
            message: input::bounded(message.into()),
            advice: advice.into(),
        }
    }
}

#[derive(Serialize)]
struct Written<'s, S> {
    schema: &'s str,
    case: &'s str,
    state: &'s S,
}

#[derive(Deserialize)]
struct Head {
    schema: String,
    case: String,
    state: Version,
}

#[derive(Deserialize)]
struct Version {
    version: u32,
}

#[derive(Deserialize)]
struct Body<S> {
    state: S,
}

/// Returns a state and its case, as it is printed, as the file has them.
///
/// # Errors
/// Errors of the JSON writer.
pub fn to_bytes<N: Serialize>(case: &str, state: &RunState<N>) -> serde_json::Result<Vec<u8>> {
    serde_json::to_vec(&Written {
        schema: SCHEMA,
        case,
        state,
    })
}

/// Reads the state of a run of a case, which is printed as `case`.
///
/// # Errors
/// The file cannot be read, or has no state of this case.
pub fn read<C: RunCase>(path: &Path, case: &str) -> Result<StateOf<C>, SavedStateError> {
    let text = read_text(path, &FILE);
    let text = text.map_err(|error| {
        let advice = error.help().unwrap_or_else(|| NAME_ONE.to_owned());
        SavedStateError::new(error.to_string(), advice)
    })?;
    parse::<C>(&path.display().to_string(), &text, case)
}

/// As [`read`], from a text that `source` names in messages.
///
/// # Errors
/// As [`read`].
pub fn parse<C: RunCase>(source: &str, text: &str, case: &str) -> Result<StateOf<C>, SavedStateError> {
    let refused = |error: serde_json::Error| {
        let message = format!("`{source}` is no saved state of such a run: {error}");
        SavedStateError::new(message, NAME_ONE)
    };
    let head: Head = serde_json::from_str(text).map_err(refused)?;
    if head.schema != SCHEMA {
        let found = input::shortened(&head.schema);
        let message = format!("`{source}` is {found}; {SCHEMA} is expected");
        return Err(SavedStateError::new(message, NAME_ONE));
    }
    if head.case != case {
        let message = format!("`{source}` is the state of another case");
        let line = first_difference(&head.case, case);
        let advice = format!("continue the case that was saved, with the same --set; {line}");
        return Err(SavedStateError::new(message, advice));
    }
    if head.state.version != RUN_STATE_VERSION {
        let found = head.state.version;
        let message = format!("`{source}`: {}", RunError::Version { found });
        let advice = "name a file that `wedgelab run --save` of this version wrote";
        return Err(SavedStateError::new(message, advice));
    }
    let body: Body<StateOf<C>> = serde_json::from_str(text).map_err(refused)?;
    Ok(body.state)
}

/// Returns in words where two cases differ first.
fn first_difference(saved: &str, own: &str) -> String {
    let line = |text: &str, number: usize| text.lines().nth(number).unwrap_or("nothing").to_owned();
    let longest = saved.lines().count().max(own.lines().count());
    let number = (0..longest).find(|number| line(saved, *number) != line(own, *number));
    let [saved, own] = [saved, own].map(|text| input::shortened(&line(text, number.unwrap_or(0))));
    format!("the saved one has `{saved}`, this one `{own}`")
}
