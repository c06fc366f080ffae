//! `wedgelab run`: one case.

use std::collections::BTreeMap;
use std::io;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use clap::Args;
use quantity::{Kind, Number, Quantity, nearest};
use report::models::{ReportCase, ReportSummary, with_note};
use report::page;
use report::run_files::{CASE_FILE_NAME, RunFiles, TABLES};
use report::terminal::TerminalTable;
use serde::Serialize;
use serde_json::json;
use staging::Folder;
use study::case::Case;
use study::each_case;
use study::models::{AnyCase, built_in, built_in_names};
use study::outcome::Outcome;
use study::output_files::{OutputFiles, TableFormat};
use study::summary::RunSummary;

use super::energy;
use crate::execute::{Done, compute_shown, started_with, unsound, write_as, write_outcome, write_page};
use crate::failure::{Failure, Message, say};
use crate::folders;
use crate::interrupt;
use crate::json;
use crate::progress::Progress;
use crate::saved::{self, Parts, Saved};
use crate::select::built_in_elsewhere;
use crate::start;

/// Run one case: a wedge, a truck, a car or a vehicle of your own
///
/// Runs a case file, of a wedge, of a truck, of a car on track or of a vehicle of bodies and elements, and
/// writes its time histories, case.toml (the case, completed) and summary.json (averages, extremes, events,
/// energy ledger, solver statistics, assumptions) into a folder named as the case; and index.html: a wedge
/// moving in 3D with its loops and key numbers; a truck, its loops and wedges; a car on its track, limits,
/// statistics and figures over the distance.
///
/// Time histories are result.csv and result.mat (of a wedge under the thesis's names). Those of a car, which
/// has most columns, are result.parquet, and a result.csv with its time, distance, speed and roll; --tables
/// and --columns choose others, as output.tables and output.columns in the case of a car do.
///
/// A run with --save or --continue writes the same files except index.html. Its rows have the same bits as
/// those of the whole run, filtered columns included, and the summary of the last part is that of the whole
/// run.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab run my.toml
  wedgelab run my.toml --set friction.column=0.3 --out softer
  wedgelab run truck_warp_nest_constant_rising --set truck.condition=mu_0.25
  wedgelab run truck_vertical_variable --set wedge.leading_left.friction.column=0.2
  wedgelab run car_twist_and_roll_loaded --set 'speed.value=\"18 mph\"' --set truck.friction.column=0.1
  wedgelab run my.toml --json --quiet | jq .summary.ledger
  wedgelab run car_hunting_empty --tables csv,mat
  wedgelab run car_hunting_empty --columns 'axle_1_*' '*_acceleration'
  wedgelab run car_hunting_empty --save state.json --until '20 s' --out first
  wedgelab run car_hunting_empty --continue state.json --out second
  wedgelab run vdrun_toe_0_psi_0 --set 'wedge.angle=\"35 deg\"' --set 'simulation.duration=\"20 s\"'")]
pub struct Arguments {
    /// Case file, or, if there is no such file, the name of a built-in case
    case: PathBuf,
    /// Set one value over those of the case; VALUE is TOML (quotes around text may be left out)
    #[arg(long, value_name = "PATH.KEY=VALUE")]
    set: Vec<String>,
    /// Folder to write into [default: the case's name]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Files of the time histories: parquet, csv, mat [default: those of the case]
    #[arg(long, value_name = "FORMAT", value_delimiter = ',', num_args = 1.., value_parser = format)]
    tables: Vec<TableFormat>,
    /// Columns that they have, as names or patterns with * and ?; the time always [default: all]
    #[arg(long, value_name = "PATTERN", num_args = 1..)]
    columns: Vec<String>,
    /// Of these, the columns of a result.csv that is beside a result.parquet [default: those of the case]
    #[arg(long, value_name = "PATTERN", num_args = 1..)]
    csv_columns: Vec<String>,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
    #[arg(long, help = json::HELP)]
    json: bool,
    /// File for the state of the run when it stops: by --until, or by Ctrl-C
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,
    /// Time at which the run stops and is saved
    #[arg(long, value_name = "TIME", requires = "save", value_parser = time)]
    until: Option<Quantity>,
    /// File with the state to continue from, of the same case; rows before it are not repeated
    #[arg(long = "continue", value_name = "FILE")]
    from: Option<PathBuf>,
}

fn time(text: &str) -> Result<Quantity, String> {
    let quantity = Quantity::parse_as(text, Kind::Time).map_err(|error| error.to_string())?;
    match quantity.to_si() > 0.0 {
        true => Ok(quantity),
        false => Err("a time above zero is expected, for example \"5 s\"".to_owned()),
    }
}

fn format(name: &str) -> Result<TableFormat, String> {
    let found = TableFormat::NAMES.iter().find(|(own, _)| *own == name);
    found.map(|(_, format)| *format).ok_or_else(|| {
        let names = TableFormat::NAMES.iter().map(|(own, _)| *own);
        let near =
            nearest(name, names.clone()).map_or(String::new(), |near| format!("; did you mean {near}?"));
        let names = names.collect::<Vec<_>>().join(", ");
        format!("the formats are {names}{near}")
    })
}

/// Returns the files of time histories that are asked for.
fn output_of<C: RunFiles>(case: &C, arguments: &Arguments) -> Result<OutputFiles, Failure> {
    let mut output = case.output_files();
    for (given, own) in [
        (&arguments.columns, &mut output.columns),
        (&arguments.csv_columns, &mut output.csv_columns),
    ] {
        if !given.is_empty() {
            own.clone_from(given);
        }
    }
    if !arguments.tables.is_empty() {
        output.tables.clone_from(&arguments.tables);
    }
    if output.is_to_be_checked() {
        let columns = started_with(case, case.columns())?;
        output
            .check(&columns, case.units())
            .map_err(|error| Message::new(error.to_string(), error.advice))?;
    }
    Ok(output)
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let case = read_any(&arguments.case, &arguments.set)?;
    if let Some(entry) = case.entry().filter(|entry| entry.command != "run") {
        let message = format!("{} is a {}", case.name(), entry.name);
        return Err(Message::new(message, format!("`wedgelab {}` runs it", entry.command)).into());
    }
    match arguments.save.is_some() || arguments.from.is_some() {
        true => each_case!(&case, case => run_in_parts(&**case, arguments)),
        false => each_case!(&case, case => run_whole(&**case, arguments)),
    }
}

/// The place of a run's files.
struct Place {
    folder: Folder,
    output: OutputFiles,
    names: Vec<&'static str>,
    progress: Progress,
}

/// Returns the place for the files of a run, with these besides; a signal stops it from now on.
fn begin<C: RunFiles>(case: &C, besides: &[&'static str], arguments: &Arguments) -> Result<Place, Failure> {
    let path = arguments.out.clone();
    let path = path.unwrap_or_else(|| PathBuf::from(case.name()));
    let output = output_of(case, arguments)?;
    let names = [&case.names(&output)[..], besides].concat();
    // Tables of an earlier run are in the way, too.
    let tables = TABLES.map(|(_, name)| name);
    let others = tables.into_iter().filter(|name| !names.contains(name));
    let all: Vec<&str> = names.iter().copied().chain(others).collect();
    let folder = folders::check(path, &all, arguments.force)?;
    interrupt::stops_run();
    Ok(Place {
        folder,
        output,
        names,
        progress: Progress::new(1, arguments.quiet),
    })
}

/// Runs a case, and writes its page besides.
fn run_whole<C: ReportCase>(case: &C, arguments: &Arguments) -> Result<ExitCode, Failure> {
    let place = begin(case, &[page::FILE_NAME], arguments)?;
    let (folder, progress) = (&place.folder, &place.progress);
    let computed = compute_shown(case, progress).and_then(|(done, along)| {
        write_as(&done, case, folder, &place.output, progress)?;
        Ok((done, along))
    });
    progress.finish();
    let (Done { result, wall }, along) = computed?;
    let shown = case.clone().shown(result, along);
    write_page(folder, || C::page(&shown))?;
    let summary = &C::parts(&shown).1.summary;
    if let Some(statics) = summary.statics().filter(|_| !arguments.json) {
        start::print(statics, summary.units())?;
    }
    print_run(arguments, &place, summary, || {
        let (table, about) = C::in_words(summary, wall);
        let energy = C::ENERGY.and_then(|of| energy::in_short(of(summary)));
        (table, with_note(&about, energy))
    })?;
    match unsound::<C>(summary, folder.path()) {
        Some(failure) => Err(failure),
        None => Ok(ExitCode::SUCCESS),
    }
}

/// Runs a case in parts.
fn run_in_parts<C: ReportCase>(case: &C, arguments: &Arguments) -> Result<ExitCode, Failure> {
    let place = begin(case, &[], arguments)?;
    let (folder, progress) = (&place.folder, &place.progress);
    let parts = Parts {
        case: case.case_file().unwrap_or_default(),
        from: arguments.from.as_deref(),
        save: arguments.save.as_deref(),
        until: arguments.until.as_ref().map(Quantity::to_si),
        force: arguments.force,
    };
    let computed = saved::compute(case, &parts, progress).and_then(|(done, saved)| {
        write_as(&done, case, folder, &place.output, progress)?;
        Ok((done, saved))
    });
    progress.finish();
    let (done, saved) = computed?;
    let summary = &done.result.summary;
    print_run(arguments, &place, summary, || C::in_words(summary, done.wall))?;
    if let Some(Saved { time, path }) = &saved {
        let (time, path) = (Number(*time), path.display());
        say(&format!(
            "saved at {time} s in {path}; --continue {path} goes on from there"
        ));
    } else if arguments.save.is_some() {
        match summary.outcome() {
            Outcome::Complete | Outcome::Failed(_) => say("the run came to its end; no state is saved"),
            Outcome::Derailed(_) | Outcome::Stopped(_) => say("the run cannot go on; no state is saved"),
        }
    }
    let saved = summary.stopped().is_some_and(|own| saved::is_reason(&own.reason));
    match unsound::<C>(summary, folder.path()) {
        Some(failure) if !saved => Err(failure),
        _ => Ok(ExitCode::SUCCESS),
    }
}

/// Tells what came out and where it lies: in words, a table and what its columns are, or as JSON.
fn print_run(
    arguments: &Arguments,
    place: &Place,
    summary: &(impl Serialize + RunSummary),
    words: impl FnOnce() -> (TerminalTable, String),
) -> Result<(), Failure> {
    let (path, names) = (place.folder.path(), &place.names);
    if arguments.json {
        let sizes: BTreeMap<&str, u64> = names
            .iter()
            .map(|name| (*name, folders::bytes(&path.join(name))))
            .collect();
        let document = json!({ "folder": path, "files": names, "bytes": sizes, "summary": summary });
        return json::print(&document);
    }
    let mut out = io::stdout().lock();
    let (table, note) = words();
    write_outcome(summary, &mut out)?;
    table.write(&mut out)?;
    let page = if names.contains(&page::FILE_NAME) {
        "; open index.html in a browser"
    } else {
        ""
    };
    let files = folders::listed(path, names);
    writeln!(out, "\n{note}\n\nWritten into {}: {files}{page}.", path.display())?;
    Ok(())
}

/// Returns whether a built-in case is meant. A folder may well have its name: that of its results.
pub fn is_built_in(path: &Path) -> bool {
    (!path.exists() || path.is_dir()) && path.to_str().and_then(built_in).is_some()
}

/// Returns the case that a user names, of whatever model, with `--set` overrides.
pub fn read_any(path: &Path, set: &[String]) -> Result<AnyCase, Failure> {
    let name = path.to_str().unwrap_or("");
    if is_built_in(path)
        && let Some(case) = AnyCase::built_in(name, set)?
    {
        return Ok(case);
    }
    let own = path.join(CASE_FILE_NAME);
    if let Some(message) = built_in_elsewhere(path).filter(|_| !path.is_file() && !own.exists()) {
        return Err(message.into());
    }
    if path.is_dir() {
        let advice = match own.exists() {
            true => format!("name the case file in it: {}", own.display()),
            false => "name a case file".to_owned(),
        };
        return Err(Message::new(format!("`{name}` is a folder, not a case file"), advice).into());
    }
    if !path.exists() && !name.ends_with(".toml") && path.components().count() == 1 {
        let advice = match nearest(name, built_in_names()) {
            Some(near) => format!("did you mean the built-in case {near}? `wedgelab case` lists all"),
            None => "name a TOML file, or one of the cases that `wedgelab case` lists".to_owned(),
        };
        let message = format!("there is neither a case file nor a built-in case `{name}`");
        return Err(Message::new(message, advice).into());
    }
    Ok(AnyCase::read(path, set)?)
}

/// Returns the same where only a wedge's case will do.
pub fn read(path: &Path, set: &[String]) -> Result<Case, Failure> {
    wedge_of(read_any(path, set)?)
}

/// Returns the wedge's case, where no other will do.
pub fn wedge_of(case: AnyCase) -> Result<Case, Failure> {
    match case {
        AnyCase::Wedge(case) => Ok(Arc::unwrap_or_clone(case)),
        other => Err(Message::new(
            format!(
                "{} is a {}, and this command takes a single wedge",
                other.name(),
                other.model()
            ),
            "`wedgelab run`, `study`, `fit`, `plot` and `compare` take trucks, cars and vehicles",
        )
        .into()),
    }
}
