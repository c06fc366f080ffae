//! Runs in parts: a state that a run is saved in, in one file with its case, and goes on from.
//!
//! The state has the rows that the summary is made of, so that the summary of the last part is that of the
//! whole run.

use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

use input::limits::SAVED_STATE;
use quantity::Number;
use staging::Folder;
use study::run::{Run, RunCase, saved};

use crate::execute::{Done, started};
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;

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
        Some(path) => Run::resume(case, saved::read::<C>(path, parts.case)?),
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
    let kept = match &folder {
        Some((folder, name)) if reason.is_some() && whole => {
            let text = saved::to_bytes(parts.case, &run.state()).map_err(io::Error::from)?;
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
    Ok((Done { result, wall }, kept))
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
