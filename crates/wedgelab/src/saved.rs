//! Runs in parts: a state that a run is saved in, in one file with its case, and goes on from.
//!
//! The file is JSON: the schema, the case as it is printed, and the state, every number with all of its bits.
//! A state belongs to its case: a run of another one does not go on from it. It has the rows that the summary
//! is made of, so that the summary of the last part is that of the whole run.

use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

use input::FileType;
use input::file::{Expected, read_text};
use input::limits::SAVED_STATE;
use quantity::Number;
use report::files::Folder;
use serde::{Deserialize, Serialize};
use study::run::{RUN_STATE_VERSION, Recorder, Run, RunCase, RunError, RunState};

use crate::execute::{Done, started};
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;

/// The schema's name and version.
const SCHEMA: &str = "wedgelab.run_state/1";
/// The reason in the summary of a run that is stopped and saved.
const REASON: &str = "told to, and saved";

/// Requests to a run that is made in parts.
#[derive(Debug)]
pub struct Parts<'a> {
    /// The case as it is printed, with all that it needs.
    pub case: &'a str,
    /// The file to go on from.
    pub from: Option<&'a Path>,
    /// The file to save the state in where the run stops.
    pub save: Option<&'a Path>,
    /// The time of the stop, s.
    pub until: Option<f64>,
    /// True if a saved state may be overwritten.
    pub force: bool,
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

/// The state of a run of a case.
type State<C> = RunState<<<C as RunCase>::Recorder as Recorder>::Counts>;

/// A saved state in its file: the time, s, and the file.
#[derive(Debug)]
pub struct Saved {
    /// The time, s.
    pub time: f64,
    /// The file.
    pub path: PathBuf,
}

/// Returns whether this is why a run stopped.
pub fn is_reason(reason: &str) -> bool {
    reason == REASON
}

/// Runs a case of any model in parts. A run that ends is not saved.
pub fn compute<C: RunCase>(
    case: &C,
    parts: &Parts<'_>,
    progress: &Progress,
) -> Result<(Done<C::Output>, Option<Saved>), Failure> {
    let [duration, _] = case.duration_and_interval();
    if let Some(until) = parts.until
        && until >= duration
    {
        let message = format!(
            "--until is {} s, and the run ends at {} s",
            Number(until),
            Number(duration)
        );
        return Err(Message::new(message, "give an earlier time, or leave --until out").into());
    }
    let folder = parts
        .save
        .map(|path| file_in_folder(path, parts.force))
        .transpose()?;
    let start = Instant::now();
    let run = match parts.from {
        Some(path) => Run::resume(case, read::<C>(path, parts.case)?),
        None => Run::new(case),
    };
    let mut run = started(case, run)?;
    let mut reached = progress.of_run(duration);
    let (mut reason, mut whole) = (None, true);
    while reason.is_none() && !run.is_finished() {
        match run.advance() {
            Ok(()) if run.is_finished() => {}
            Ok(()) if parts.until.is_some_and(|until| run.time() >= until) => {
                reason = Some(REASON.to_owned())
            }
            Ok(()) => reason = interrupt::go_on().break_value(),
            Err(error) => (reason, whole) = (Some(error.to_string()), false),
        }
        reached(run.time());
    }
    let saved = match &folder {
        Some((folder, name)) if reason.is_some() && whole => {
            let written = Written {
                schema: SCHEMA,
                case: parts.case,
                state: &run.state(),
            };
            let text = serde_json::to_vec(&written).map_err(io::Error::from)?;
            if text.len() as u64 > SAVED_STATE {
                return Err(too_large(text.len()).into());
            }
            folder.write(|files| files.add(name, |out| out.write_all(&text)))?;
            run.look_ahead()
                .map_err(|error| Message::new(error.to_string(), C::WHERE_TO_LOOK))?;
            Some(Saved {
                time: run.time(),
                path: folder.path().join(name),
            })
        }
        _ => None,
    };
    let stopped = reason.map(|reason| run.stopped(reason));
    let result = run.result(stopped);
    let wall = start.elapsed();
    Ok((Done { result, wall }, saved))
}

/// Returns the failure of a state that could not be read again.
fn too_large(bytes: usize) -> Message {
    let message = format!(
        "the state takes {} MB, and no more than {} MB are read again",
        bytes >> 20,
        SAVED_STATE >> 20
    );
    Message::new(
        message,
        "lengthen simulation.output_interval, or save earlier: the state holds the rows so far",
    )
}

/// Returns the folder of a file that is to be written, and the file's name.
fn file_in_folder(path: &Path, force: bool) -> Result<(Folder, &str), Failure> {
    let Some(name) = path.file_name().and_then(|name| name.to_str()) else {
        let message = format!("`{}` names no file", path.display());
        return Err(Message::new(message, "write for example --save state.json").into());
    };
    let parent = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    Ok((folders::check(parent, &[name], force)?, name))
}

/// Reads the state of a case.
fn read<C: RunCase>(path: &Path, case: &str) -> Result<State<C>, Failure> {
    let expected = Expected {
        what: "saved state",
        types: &[FileType::Json],
        most: SAVED_STATE,
    };
    let text = read_text(path, &expected)
        .map_err(|error| Message::new(error.to_string(), error.help().unwrap_or_default()))?;
    let path = path.display();
    let refused = |error: serde_json::Error| {
        let message = format!("`{path}` is no saved state of such a run: {error}");
        Message::new(message, "name a file that `wedgelab run --save` wrote")
    };
    let head: Head = serde_json::from_str(&text).map_err(refused)?;
    if head.schema != SCHEMA {
        let message = format!("`{path}` is {}; {SCHEMA} is expected", head.schema);
        return Err(Message::new(message, "name a file that `wedgelab run --save` wrote").into());
    }
    if head.case != case {
        let message = format!("`{path}` is the state of another case");
        let line = first_difference(&head.case, case);
        let advice = format!("continue the case that was saved, with the same --set; {line}");
        return Err(Message::new(message, advice).into());
    }
    if head.state.version != RUN_STATE_VERSION {
        let found = head.state.version;
        let message = format!("`{path}`: {}", RunError::Version { found });
        return Err(Message::new(
            message,
            "name a file that `wedgelab run --save` of this version wrote",
        )
        .into());
    }
    let body: Body<State<C>> = serde_json::from_str(&text).map_err(refused)?;
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
