//! Running one case, writing its files, and its row in the table.

use std::io::{self, Write};
use std::path::Path;
use std::time::{Duration, Instant};

use quantity::SixDigits;
use report::models::{GoOn, ReportCase};
use report::page;
use report::run_files::RunFiles;
use staging::Folder;
use study::outcome::Outcome;
use study::output_files::OutputFiles;
use study::result::RunResult;
use study::run::{Run, RunCase, RunError};
use study::summary::RunSummary;

use crate::failure::{Failure, Message, say};
use crate::interrupt;
use crate::progress::Progress;

/// A run that has ended, perhaps before its time.
#[derive(Debug)]
pub struct Done<R = RunResult> {
    /// The outcome.
    pub result: R,
    /// The wall time, without writing.
    pub wall: Duration,
}

/// Runs a case of any model until it ends or is interrupted.
pub fn compute<C: RunCase>(case: &C, progress: &Progress) -> Result<Done<C::Output>, Failure> {
    let finish = |run: Run<C>, go_on: &mut GoOn<'_>| (run.finish_while(go_on), ());
    compute_by(case, Run::new, finish, progress).map(|(done, ())| done)
}

/// As [`compute`], with what the view of the run needs beside its table.
pub fn compute_shown<C: ReportCase>(
    case: &C,
    progress: &Progress,
) -> Result<(Done<C::Output>, C::Along), Failure> {
    compute_by(case, C::start, C::finish, progress)
}

/// Runs a case, from what begins it and what finishes it with what it takes along.
fn compute_by<C: RunCase, T>(
    case: &C,
    begin: impl FnOnce(&C) -> Result<Run<C>, RunError>,
    finish: impl FnOnce(Run<C>, &mut GoOn<'_>) -> (C::Output, T),
    progress: &Progress,
) -> Result<(Done<C::Output>, T), Failure> {
    let start = Instant::now();
    let run = started(case, begin(case))?;
    let [duration, _] = case.duration_and_interval();
    let mut reached = progress.of_run(duration);
    let (result, taken) = finish(run, &mut |time| {
        reached(time);
        interrupt::go_on()
    });
    let wall = start.elapsed();
    Ok((Done { result, wall }, taken))
}

/// Returns a run that has begun; where nothing can be computed at all, the input is at fault.
pub fn started<C: RunCase>(case: &C, run: Result<Run<C>, RunError>) -> Result<Run<C>, Message> {
    started_with(case, run)
}

/// As [`started`], for anything that a case makes as it begins.
pub fn started_with<C: RunCase, T>(case: &C, made: Result<T, RunError>) -> Result<T, Message> {
    made.map_err(|error| {
        let message = format!("the run {} cannot begin: {error}", case.name());
        Message::new(message, C::WHERE_TO_LOOK)
    })
}

/// Writes the files of a run, and says what makes its numbers doubtful.
pub fn write<C: RunFiles>(
    done: &Done<C::Output>,
    case: &C,
    folder: &Folder,
    progress: &Progress,
) -> Result<(), Failure> {
    write_as(done, case, folder, &case.output_files(), progress)
}

/// As [`write()`], with the tables of `output`.
pub fn write_as<C: RunFiles>(
    done: &Done<C::Output>,
    case: &C,
    folder: &Folder,
    output: &OutputFiles,
    progress: &Progress,
) -> Result<(), Failure> {
    case.write_as(folder, &done.result, output)?;
    tell(done, case, progress);
    for warning in done.result.summary.warnings() {
        say(&format!("warning: {}: {warning}", case.name()));
    }
    Ok(())
}

/// Writes the files of a run.
pub fn write_quietly<C: RunFiles>(
    done: &Done<C::Output>,
    case: &C,
    folder: &Folder,
    progress: &Progress,
) -> Result<(), Failure> {
    case.write(folder, &done.result)?;
    tell(done, case, progress);
    Ok(())
}

/// Tells that a run has ended, and how.
fn tell<C: RunFiles>(done: &Done<C::Output>, case: &C, progress: &Progress) {
    let outcome = done.result.summary.outcome();
    let how = match outcome.end() {
        Some(end) => format!("{} at {} s", outcome.word(), SixDigits(end.time)),
        None => format!("{:.2} s", done.wall.as_secs_f64()),
    };
    progress.done(case.name(), &how);
}

/// Writes the page of a run beside its files.
pub fn write_page(
    folder: &Folder,
    render: impl FnOnce() -> Result<String, serde_json::Error>,
) -> Result<(), Failure> {
    let html = render().map_err(|error| {
        let message = format!("cannot write the page's data: {error}");
        Failure::Failed(Message::new(message, "").into())
    })?;
    let folder = Folder::check(folder.path(), &[page::FILE_NAME], true)?;
    Ok(folder.write(|files| files.add(page::FILE_NAME, |out| out.write_all(html.as_bytes())))?)
}

/// Runs a case and writes its files; `None` if it was interrupted, of which nothing is written then.
pub fn execute_whole<C: RunFiles>(
    case: &C,
    folder: &Folder,
    progress: &Progress,
) -> Result<Option<Done<C::Output>>, Failure> {
    if interrupt::wanted() {
        return Ok(None);
    }
    let done = compute(case, progress)?;
    if interrupt::is_reason(done.result.summary.stopped()) {
        return Ok(None);
    }
    write(&done, case, folder, progress)?;
    Ok(Some(done))
}

/// Returns the message of a run that is not complete; `None` if it is.
pub fn unsound<C: RunFiles>(summary: &C::Summary, folder: &Path) -> Option<Failure> {
    let folder = folder.display();
    let kept = match summary.outcome() {
        Outcome::Failed(_) => {
            format!("its files are in {folder}, marked as failed; do not use their numbers")
        }
        _ => format!("what was computed until then is in {folder}, marked as incomplete"),
    };
    unsound_with::<C>(summary, &kept)
}

/// Returns the message of a run that is not complete and of which nothing is written; `None` if it is.
pub fn unsound_unwritten<C: RunFiles>(summary: &C::Summary) -> Option<Failure> {
    unsound_with::<C>(summary, "nothing of it is written")
}

/// Returns the same; `kept` says where its files are.
fn unsound_with<C: RunFiles>(summary: &C::Summary, kept: &str) -> Option<Failure> {
    let outcome = summary.outcome();
    let message = format!("the run {} {}", summary.name(), outcome.told()?);
    let failure = |advice: String| Message::new(message, advice).into();
    Some(match outcome {
        Outcome::Derailed(_) => Failure::Derailed(failure(kept.to_owned())),
        Outcome::Stopped(_) if interrupt::is_reason(summary.stopped()) => Failure::Interrupted(failure(
            format!("{kept}; the same command with --force computes the whole run, from its start"),
        )),
        Outcome::Stopped(_) => Failure::Failed(failure(with_suspects(kept, C::WHAT_TO_TRY))),
        Outcome::Failed(_) | Outcome::Complete => Failure::Failed(failure(kept.to_owned())),
    })
}

/// Writes above the table of a run that is not complete why, and what the table holds.
pub fn write_outcome(summary: &impl RunSummary, out: &mut impl Write) -> io::Result<()> {
    let outcome = summary.outcome();
    match (outcome.told(), outcome.numbers()) {
        (Some(told), Some(numbers)) => writeln!(out, "The run {} {told}.\n{numbers}\n", summary.name()),
        _ => Ok(()),
    }
}

/// Returns the message about the files of a run, with advice if it could not go on.
fn with_suspects(kept: &str, suspects: &str) -> String {
    [kept, suspects].join(if suspects.is_empty() { "" } else { "; " })
}

/// Returns the number of runs at a time: as given, or as many as there are processors.
pub fn jobs(given: Option<u16>) -> usize {
    given.map_or_else(
        || std::thread::available_parallelism().map_or(1, usize::from),
        usize::from,
    )
}
