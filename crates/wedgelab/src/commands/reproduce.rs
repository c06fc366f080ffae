//! `wedgelab reproduce`: the thesis's twelve runs.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use clap::Args;
use rayon::prelude::*;
use report::files::{Folder, check_all};
use report::hysteresis::{self, Loop};
use report::run_files;
use study::case::{Case, builtin};
use study::summary::Summary;
use wedge::parameters::Damping;

use crate::execute::{TABLE_NOTE, execute as execute_case, incomplete, table};
use crate::failure::{FAILED, Failure, Message};
use crate::progress::Progress;
use crate::select::select;

/// Run the thesis's twelve runs
///
/// Computes the twelve runs of Steets (2007), table 4-1: variable and constant damping, toe out, none and in, with and
/// without yaw of the bolster. Writes for each run runs/NAME/result.csv, case.toml and summary.json, and for each
/// damping a hysteresis figure; prints a table of the runs.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab reproduce
  wedgelab reproduce --out today --jobs 1
  wedgelab reproduce --only 'vdrun*' cdrun_toe_0_psi_0 --force")]
pub struct Arguments {
    /// Folder to write into
    #[arg(long, value_name = "DIR", default_value = "reproduction")]
    out: PathBuf,
    /// Run only these: names, beginnings that only one name has, or patterns such as 'vdrun*'
    #[arg(long, value_name = "NAME", num_args = 1..)]
    only: Vec<String>,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    /// How many runs at a time [default: as many as there are processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// What is kept of a run whose files are written.
struct Kept {
    summary: Summary,
    wall: Duration,
    hysteresis: Option<Loop>,
}

/// Does it.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let cases = select(&arguments.only, builtin::thesis_names())?
        .into_iter()
        .map(builtin::case)
        .collect::<Result<Vec<Case>, _>>()?;
    let figures: Vec<(Damping, String)> = [Damping::Variable, Damping::Constant]
        .into_iter()
        .filter(|damping| cases.iter().any(|case| case.parameters.damping == *damping))
        .map(|damping| (damping, hysteresis::file_name(damping)))
        .collect();
    let (sheets, folders) = check(&arguments.out, &cases, &figures, arguments.force)?;

    let progress = Progress::new(cases.len(), arguments.quiet);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(arguments.jobs.map_or(0, usize::from))
        .build()
        .map_err(|error| Failure::Failed(Message::new(error.to_string(), "try --jobs 1").into()))?;
    let kept: Vec<Result<Kept, Failure>> = pool.install(|| {
        let work = cases.par_iter().zip(&folders).with_max_len(1);
        work.map(|(case, folder)| keep(case, folder, &progress)).collect()
    });
    progress.finish();
    let kept = kept.into_iter().collect::<Result<Vec<Kept>, Failure>>()?;

    let loops: Vec<Loop> = kept.iter().filter_map(|kept| kept.hysteresis.clone()).collect();
    sheets.write(|files| {
        for (damping, name) in &figures {
            if let Some(figure) = hysteresis::figure(*damping, &loops) {
                files.add(name, |out| out.write_all(figure.to_svg().as_bytes()))?;
            }
        }
        Ok(())
    })?;

    let mut out = io::stdout().lock();
    table(kept.iter().map(|kept| (&kept.summary, kept.wall))).write(&mut out)?;
    writeln!(
        out,
        "\n{TABLE_NOTE}\n\nWritten into {}: runs/NAME/{{{}}}, {}.",
        sheets.path().display(),
        run_files::NAMES.join(", "),
        figures
            .iter()
            .map(|(_, name)| name.as_str())
            .collect::<Vec<_>>()
            .join(", "),
    )?;
    out.flush()?;
    let mut code = ExitCode::SUCCESS;
    for (kept, folder) in kept.iter().zip(&folders) {
        if let Some(report) = incomplete(&kept.summary, folder) {
            code = ExitCode::from(FAILED);
            Failure::Failed(report).report();
        }
    }
    Ok(code)
}

fn keep(case: &Case, folder: &Folder, progress: &Progress) -> Result<Kept, Failure> {
    let done = execute_case(case, folder, progress)?;
    Ok(Kept {
        hysteresis: Loop::of(case, &done.result),
        summary: done.result.summary,
        wall: done.wall,
    })
}

/// The folder of the figures and those of the runs, found fit before anything is computed.
fn check(
    out: &Path,
    cases: &[Case],
    figures: &[(Damping, String)],
    force: bool,
) -> Result<(Folder, Vec<Folder>), Failure> {
    let names: Vec<&str> = figures.iter().map(|(_, name)| name.as_str()).collect();
    let runs = cases
        .iter()
        .map(|case| (out.join("runs").join(&case.name), run_files::NAMES.as_slice()));
    let mut folders = check_all(
        std::iter::once((out.to_owned(), names.as_slice())).chain(runs),
        force,
    )
    .map_err(|error| Failure::Input(error.into()))?;
    let sheets = folders.remove(0);
    Ok((sheets, folders))
}
