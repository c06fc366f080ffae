//! Running one case, writing its files, and its row in the table.

use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

use quantity::SixDigits;
use report::page;
use report::run_files::RunFiles;
use staging::Folder;
use study::car::CarCase;
use study::car::motions::MotionTable;
use study::car::run::CarResult;
use study::contacts::{ContactTable, TakesCorners};
use study::outcome::Outcome;
use study::output_files::OutputFiles;
use study::result::RunResult;
use study::run::{Run, RunCase, RunError};
use study::summary::{RunSummary, Summary, SummaryValue};

use crate::failure::{Failure, Message, say};
use crate::interrupt;
use crate::progress::Progress;
use crate::table::TerminalTable;

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

/// As [`compute`], with the corners of wedges that are bodies.
pub fn compute_with_contacts<C>(
    case: &C,
    progress: &Progress,
) -> Result<(Done<C::Output>, Option<ContactTable>), Failure>
where
    C: RunCase,
    C::Recorder: TakesCorners,
{
    let finish = |run: Run<C>, go_on: &mut GoOn<'_>| run.finish_with_contacts(go_on);
    compute_by(case, Run::with_contacts, finish, progress)
}

/// As [`compute`], of a car, with the motions of its bodies.
pub fn compute_with_motions(
    case: &CarCase,
    progress: &Progress,
) -> Result<(Done<CarResult>, Option<MotionTable>), Failure> {
    let finish = |run: Run<CarCase>, go_on: &mut GoOn<'_>| run.finish_with_motions(go_on);
    compute_by(case, Run::with_motions, finish, progress)
}

/// Asked at each output time (s) whether a run is to go on.
type GoOn<'a> = dyn FnMut(f64) -> ControlFlow<String> + 'a;

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

/// Returns the table of runs; all of them in the same units.
pub fn table<'d>(runs: impl IntoIterator<Item = (&'d Summary, Duration)> + Clone) -> TerminalTable {
    let unit = |of: fn(&Summary) -> Option<&SummaryValue>| {
        let found = runs.clone().into_iter().find_map(|(summary, _)| of(summary));
        found.map_or(String::new(), |measure| measure.unit.clone())
    };
    let mut table = TerminalTable::new(
        2,
        &[
            ("run", ""),
            ("window", "of mean force"),
            ("mean force, up", &unit(up)),
            ("mean force, down", &unit(down)),
            ("energy per cycle", &unit(energy)),
            ("ledger residual", "relative"),
            ("wall time", "s"),
        ],
    );
    for (summary, wall) in runs {
        let cell = |measure: Option<&SummaryValue>| {
            measure.map_or("-".to_owned(), |measure| format!("{:.1}", measure.value))
        };
        table.row([
            summary.name.clone(),
            summary.averages.window.clone(),
            cell(up(summary)),
            cell(down(summary)),
            cell(energy(summary)),
            format!("{:.1e}", summary.ledger.largest_relative_residual),
            format!("{:.2}", wall.as_secs_f64()),
        ]);
    }
    table
}

/// The note on the columns of the table.
pub const TABLE_NOTE: &str = "\
Mean force: vertical wedge force (column friction on the side frame, positive up), averaged while the \
bolster goes up or down, over
the output times after the first half period in the window: mid stroke (constant damping), the bolster \
faster than 0.9 of its peak
speed; lower stroke (variable damping), faster than 0.25 of it, and lower than 0.3 of its amplitude below \
its middle. Energy per
cycle: lost in friction at the side frame. Ledger residual: the largest at any output time, over the largest \
of work, losses and
change of stored energy.";

fn up(summary: &Summary) -> Option<&SummaryValue> {
    summary.averages.up.get("vertical_wedge_force")
}

fn down(summary: &Summary) -> Option<&SummaryValue> {
    summary.averages.down.get("vertical_wedge_force")
}

fn energy(summary: &Summary) -> Option<&SummaryValue> {
    summary.averages.energy_per_cycle.get("side_frame")
}
