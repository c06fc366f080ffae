//! The time series of some runs of a study, whenever they are wanted: a variant is a function of the study
//! and its number.

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use report::run_files::RunFiles;
use report::study_folder::SERIES;
use staging::Folder;
use study::design::Study;
use study::each_case;
use study::models::ModelCase;

use crate::execute::{execute_whole, unsound};
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;

/// Runs these variants and writes their files.
pub fn write(study: &Study, out: &Path, numbers: &[u64], quiet: bool) -> Result<ExitCode, Failure> {
    let progress = Progress::new(numbers.len(), quiet);
    interrupt::stops(
        "stopping: the run under way is not written (once more: ends at once)",
        "the runs that were written before are whole; the same command computes all of them again",
    );
    let names = each_case!(&study.base, own => own.names(&own.output_files()));
    let (mut written, mut failures) = (Vec::new(), Vec::new());
    for number in numbers {
        let path = out.join(SERIES).join(number.to_string());
        let name = format!("{}_{number}", study.name);
        // The same run gives the same files.
        let folder = folders::check(&path, &names, true)?;
        let case = study.case(*number)?.named(&name);
        let whole = each_case!(&case, case => one(&**case, &folder, &progress))?;
        let Some(failure) = whole else {
            progress.finish();
            return Err(interrupted(numbers, written.len()));
        };
        failures.extend(failure);
        written.push(path.display().to_string());
    }
    progress.finish();
    writeln!(
        io::stdout().lock(),
        "Written into {}: {}.",
        written.join(", "),
        names.join(", ")
    )?;
    let mut code = ExitCode::SUCCESS;
    for failure in failures {
        code = failure.report();
    }
    Ok(code)
}

/// Runs one variant and writes its files; `None` if it was interrupted, else why it is unsound, if so.
fn one<C: RunFiles>(
    case: &C,
    folder: &Folder,
    progress: &Progress,
) -> Result<Option<Option<Failure>>, Failure> {
    let done = execute_whole(case, folder, progress)?;
    Ok(done.map(|done| unsound::<C>(&done.result.summary, folder.path())))
}

/// Returns the message about these runs, of which so many are written.
fn interrupted(numbers: &[u64], written: usize) -> Failure {
    let missing: Vec<String> = numbers[written..].iter().map(u64::to_string).collect();
    let message = format!(
        "{}: {written} of {} runs are written, and whole",
        interrupt::REASON,
        numbers.len()
    );
    let advice = format!(
        "the same command with --series {} computes those that are missing",
        missing.join(" ")
    );
    Failure::Interrupted(Message::new(message, advice).into())
}
