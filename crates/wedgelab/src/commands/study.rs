//! `wedgelab study`: many variants of a case.

mod series;
pub(super) mod work;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use report::page::study as page;
use report::run_files::CASE_FILE_NAME;
use report::study_folder::{STUDY_FILE, StudyFolderError, TABLE_CSV_FILE, TABLE_FILE};
use report::study_work;
use report::table::in_folder;
use serde_json::json;
use study::design::{MANY, Study};

use crate::execute::jobs;
use crate::failure::{Failure, Message, say};
use crate::interrupt;
use crate::json;
use crate::select::built_in_elsewhere;

/// Run many variants of a wedge, a half-truck, a truck or a car
///
/// Reads a study file (TOML): a case, and parameters to vary as full factorial, Latin hypercube, Sobol'
/// sequence or list. Computes the measures of every variant (energies per cycle, equivalent damping and
/// stiffness, branch forces, peak moments, lift-off time, stick share, jam margin, wear power) and writes
/// table.parquet, with units in its metadata, the same as table.csv, and index.html (main effects, contour
/// maps, jam map). The same command continues a study that was stopped or killed; the table does not depend
/// on interruptions, nor on the number of jobs.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab study friction.toml
  wedgelab study friction.toml --out today --jobs 1
  wedgelab study friction.toml --cost               how long it takes, before it begins
  wedgelab study friction.toml --series 0 17        time series of two of its runs, any time

A study file:
  case = \"vdrun_toe_out_0.2_psi_0.012\"
  sampling = \"full_factorial\"
  [vary]
  friction.column = { from = 0.2, to = 0.6, count = 5 }
  wedge.angle = [\"30 deg\", \"32 deg\", \"35 deg\"]")]
pub struct Arguments {
    /// Study file
    study: PathBuf,
    /// Folder to write into, or to continue in [default: the study's name]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Number of runs at a time [default: number of processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Write the files of these runs (result.csv, ...) into series/NUMBER, and nothing else
    #[arg(long, value_name = "NUMBER", num_args = 1..)]
    series: Vec<u64>,
    /// Compute a few of the runs, say what all of them cost (time, space on the disk), and end
    #[arg(long)]
    cost: bool,
    /// Begin even if there are more than a million runs
    #[arg(long)]
    yes: bool,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
    #[arg(long, help = json::HELP)]
    json: bool,
}

/// Returns the failure if a built-in case, or the folder of a run or a study, is named in place of a study
/// file.
fn no_study(path: &Path) -> Option<Message> {
    let shown = path.display();
    if path.join(STUDY_FILE).is_file() {
        let advice = "give the study file that it was made of: it goes on where it was";
        return Some(Message::new(format!("{shown} is the folder of a study"), advice));
    }
    if in_folder(path).is_some() {
        let advice = format!(
            "`wedgelab plot` and `wedgelab compare` take it; a study of its case begins with case = \"{}\"",
            path.join(CASE_FILE_NAME).display()
        );
        return Some(Message::new(format!("{shown} is the result of a run"), advice));
    }
    built_in_elsewhere(path).filter(|_| !path.exists())
}

impl From<StudyFolderError> for Failure {
    fn from(error: StudyFolderError) -> Self {
        match error {
            StudyFolderError::NotAStudy { .. }
            | StudyFolderError::Busy { .. }
            | StudyFolderError::Changed { .. } => Self::Input(error.into()),
            _ => Self::Failed(error.into()),
        }
    }
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    if let Some(message) = no_study(&arguments.study) {
        return Err(message.into());
    }
    let study = Study::read(&arguments.study)?;
    if let Some(number) = arguments.series.iter().find(|number| **number >= study.count()) {
        let message = format!("there is no run {number}: the study has {} runs", study.count());
        return Err(Message::new(
            message,
            format!("runs are numbered from 0 to {}", study.count() - 1),
        )
        .into());
    }
    let path = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(&study.name));
    if !arguments.series.is_empty() {
        return series::write(&study, &path, &arguments.series, arguments.quiet);
    }
    if study.count() > MANY && !arguments.yes {
        let message = format!("the study has {} runs", study.count());
        let advice = "give --yes if you mean it, or vary fewer values; a sample of them (sampling \
                      = \"sobol\", runs = 1000) often says as much";
        return Err(Message::new(message, advice).into());
    }
    let folder = work::open(&study, &path)?;
    let clock = Instant::now();
    let jobs = jobs(arguments.jobs);
    if arguments.cost {
        let left = study.count() - study_work::kept(&folder)?.runs;
        let cost = work::cost(&study, &folder, (jobs, left), &|| ())?;
        writeln!(io::stdout().lock(), "{}", cost.words())?;
        return Ok(ExitCode::SUCCESS);
    }
    let done = work::all(&study, &folder, jobs, arguments.quiet)?;
    let kept = format!(
        "{} of {} runs are kept in {}",
        done.before + done.now,
        study.count(),
        path.display()
    );
    interrupt::ends(&format!("{kept}. The same command makes the table of them."));
    if done.interrupted || interrupt::wanted() {
        let message = format!("{}: {kept}", interrupt::REASON);
        return Err(Failure::Interrupted(
            Message::new(message, "the same command goes on from there").into(),
        ));
    }
    let wall = clock.elapsed().as_secs_f64();
    let digest = study_work::finish(&study, &folder)?;
    let [complete, refused, stopped, failed, derailed] = digest.ended;
    if let Some(warning) = digest.warning() {
        say(&format!("warning: {warning}"));
    }
    if arguments.json {
        let reasons = digest.reasons.iter();
        let reasons = reasons.map(|(run, reason)| json!({ "run": run, "reason": reason }));
        json::print(&json!({
            "folder": path,
            "files": [TABLE_FILE, TABLE_CSV_FILE, page::FILE_NAME],
            "runs": study.count(),
            "complete": complete,
            "refused": refused,
            "stopped": stopped,
            "failed": failed,
            "derailed": derailed,
            "before": done.before,
            "reasons": reasons.collect::<Vec<_>>(),
        }))?;
        return Ok(ExitCode::SUCCESS);
    }
    let mut out = io::stdout().lock();
    write!(out, "{} runs: {complete} complete", study.count())?;
    if refused + stopped > 0 {
        write!(out, ", {refused} refused, {stopped} stopped on their way")?;
    }
    if failed > 0 {
        write!(out, ", {failed} failed")?;
    }
    if derailed > 0 {
        write!(out, ", {derailed} derailed")?;
    }
    if done.before > 0 {
        write!(out, "; {} were there before", done.before)?;
    }
    if done.now > 0 {
        write!(out, "; {:.0} runs/s", done.now as f64 / wall)?;
    }
    writeln!(out, ".")?;
    for (number, reason) in digest.reasons.iter().take(3) {
        writeln!(out, "  run {number}: {reason}")?;
    }
    writeln!(
        out,
        "\nWritten into {}: {TABLE_FILE}, {TABLE_CSV_FILE}, {} (open it in a browser).",
        path.display(),
        page::FILE_NAME
    )?;
    Ok(ExitCode::SUCCESS)
}
