//! The time series of some runs of a study, whenever they are wanted: a variant is a function of the study and its number.

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use report::files::Folder;
use report::run_files;
use report::study_folder::SERIES;
use study::design::Study;

use crate::execute::execute as execute_case;
use crate::failure::Failure;
use crate::progress::Progress;

/// Runs these variants and writes their files.
pub fn write(study: &Study, out: &Path, numbers: &[u64], quiet: bool) -> Result<ExitCode, Failure> {
    let progress = Progress::new(numbers.len(), quiet);
    let mut written = Vec::new();
    for number in numbers {
        let mut case = study.case(*number)?;
        case.name = format!("{}_{number}", study.name);
        case.document.name.clone_from(&case.name);
        let path = out.join(SERIES).join(number.to_string());
        // The same run gives the same files.
        let folder = Folder::check(&path, &run_files::NAMES, true)?;
        execute_case(&case, &folder, &progress)?;
        written.push(path.display().to_string());
    }
    progress.finish();
    writeln!(
        io::stdout().lock(),
        "Written into {}: {}.",
        written.join(", "),
        run_files::NAMES.join(", ")
    )?;
    Ok(ExitCode::SUCCESS)
}
