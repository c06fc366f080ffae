//! Running one case, writing its files, and its row in the table.

use std::path::Path;
use std::time::{Duration, Instant};

use quantity::Number;
use report::files::Folder;
use report::{half_truck_files, run_files};
use study::case::Case;
use study::half_truck::{HalfTruckCase, HalfTruckResult, HalfTruckSummary};
use study::progress::{WHAT_TO_TRY, WHAT_TO_TRY_WITH_FILES};
use study::result::RunResult;
use study::run::{Run, RunCase};
use study::summary::{Stopped, Summary, SummaryValue};

use crate::failure::{Failure, Message, say};
use crate::interrupt;
use crate::progress::Progress;
use crate::table::Table;

/// A run that has ended, perhaps before its time.
#[derive(Debug)]
pub struct Done<R = RunResult> {
    /// What came out.
    pub result: R,
    /// How long it took, without writing.
    pub wall: Duration,
}

/// Runs a case of any model until it ends or is interrupted.
pub fn compute<C: RunCase>(case: &C, progress: &Progress) -> Result<Done<C::Output>, Failure> {
    let start = Instant::now();
    // Where nothing can be computed at all, the input is at fault.
    let run = Run::new(case).map_err(|error| {
        let message = format!("the run {} cannot begin: {error}", case.name());
        Message::new(message, C::WHERE_TO_LOOK)
    })?;
    let [duration, _] = case.duration_and_interval();
    let mut reached = progress.of_run(duration);
    let result = run.finish_while(|time| {
        reached(time);
        interrupt::go_on()
    });
    Ok(Done {
        result,
        wall: start.elapsed(),
    })
}

/// Writes the files of a run.
pub fn write(done: &Done, case: &Case, folder: &Folder, progress: &Progress) -> Result<(), Failure> {
    run_files::write(folder, case, &done.result)?;
    let summary = &done.result.summary;
    let how = match &summary.stopped {
        Some(stopped) => format!("stopped at {} s", Number(stopped.time)),
        None => format!("{:.2} s", done.wall.as_secs_f64()),
    };
    progress.done(&case.name, &how);
    for warning in &summary.warnings {
        say(&format!("warning: {}: {warning}", case.name));
    }
    Ok(())
}

/// Runs a case and writes its files; `None` if it was interrupted, of which nothing is written then.
pub fn execute_whole(case: &Case, folder: &Folder, progress: &Progress) -> Result<Option<Done>, Failure> {
    if interrupt::wanted() {
        return Ok(None);
    }
    let done = compute(case, progress)?;
    if interrupt::is_reason(done.result.summary.stopped.as_ref()) {
        return Ok(None);
    }
    write(&done, case, folder, progress)?;
    Ok(Some(done))
}

/// Writes the files of a half-truck's run; `script_interval` (s) is that of the array for the thesis's
/// scripts.
pub fn write_half_truck(
    done: &Done<HalfTruckResult>,
    case: &HalfTruckCase,
    folder: &Folder,
    script_interval: f64,
    progress: &Progress,
) -> Result<(), Failure> {
    half_truck_files::write(folder, case, &done.result, script_interval)?;
    let summary = &done.result.summary;
    let how = match &summary.stopped {
        Some(stopped) => format!("stopped at {} s", Number(stopped.time)),
        None => format!("{:.2} s", done.wall.as_secs_f64()),
    };
    progress.done(&case.name, &how);
    Ok(())
}

/// Why a run is incomplete or has failed, for its user; `None` if it is sound.
pub fn unsound(summary: &Summary, folder: &Path) -> Option<Failure> {
    if let Some(stopped) = &summary.stopped {
        return Some(stopped_run(&summary.name, stopped, folder, WHAT_TO_TRY));
    }
    let reason = summary.failed.as_ref()?;
    Some(failed_run(&summary.name, reason, folder))
}

/// The same of a half-truck's run.
pub fn unsound_half_truck(summary: &HalfTruckSummary, folder: &Path) -> Option<Failure> {
    if let Some(stopped) = &summary.stopped {
        return Some(stopped_run(
            &summary.name,
            stopped,
            folder,
            WHAT_TO_TRY_WITH_FILES,
        ));
    }
    let reason = summary.failed.as_ref()?;
    Some(failed_run(&summary.name, reason, folder))
}

/// A run that came to its end but failed, and whose files are written.
fn failed_run(name: &str, reason: &str, folder: &Path) -> Failure {
    let message = format!("the run {name} has failed: {reason}");
    let kept = format!(
        "its files are in {}, marked as failed; do not use their numbers",
        folder.display()
    );
    Failure::Failed(Message::new(message, kept).into())
}

/// A run that stopped and whose files are written; `suspects` says what to try if it could not go on.
fn stopped_run(name: &str, stopped: &Stopped, folder: &Path, suspects: &str) -> Failure {
    let message = format!(
        "the run {name} stopped at {} s and is incomplete: {}",
        Number(stopped.time),
        stopped.reason
    );
    let kept = format!(
        "what was computed until then is in {}, marked as incomplete",
        folder.display()
    );
    if interrupt::is_reason(Some(stopped)) {
        let advice = format!("{kept}; the same command with --force computes the whole run, from its start");
        return Failure::Interrupted(Message::new(message, advice).into());
    }
    let advice = [kept.as_str(), suspects].join(if suspects.is_empty() { "" } else { "; " });
    Failure::Failed(Message::new(message, advice).into())
}

/// The table of runs; all of them in the same units.
pub fn table<'d>(runs: impl IntoIterator<Item = (&'d Summary, Duration)> + Clone) -> Table {
    let unit = |of: fn(&Summary) -> Option<&SummaryValue>| {
        let found = runs.clone().into_iter().find_map(|(summary, _)| of(summary));
        found.map_or(String::new(), |measure| measure.unit.clone())
    };
    let mut table = Table::new(
        1,
        &[
            ("run", ""),
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
            cell(up(summary)),
            cell(down(summary)),
            cell(energy(summary)),
            format!("{:.1e}", summary.ledger.largest_relative_residual),
            format!("{:.2}", wall.as_secs_f64()),
        ]);
    }
    table
}

/// What the columns of the table are.
pub const TABLE_NOTE: &str = "\
Mean force: vertical wedge force (column friction on the side frame, positive up), averaged over the branch in which the
bolster goes up or down. Energy per cycle: lost in friction at the side frame. Ledger residual: the largest at any output time,
over the largest of work, losses and change of stored energy.";

fn up(summary: &Summary) -> Option<&SummaryValue> {
    summary.averages.up.get("vertical_wedge_force")
}

fn down(summary: &Summary) -> Option<&SummaryValue> {
    summary.averages.down.get("vertical_wedge_force")
}

fn energy(summary: &Summary) -> Option<&SummaryValue> {
    summary.averages.energy_per_cycle.get("side_frame")
}
