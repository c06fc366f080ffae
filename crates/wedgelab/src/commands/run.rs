//! `wedgelab run`: one case.

use std::collections::BTreeMap;
use std::io;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use clap::Args;
use quantity::{Kind, Number, Quantity, nearest};
use report::figures::car::CarRun;
use report::figures::truck::TruckRun;
use report::page;
use report::run_files::{CASE_FILE_NAME, RunFiles, TABLES};
use serde::Serialize;
use serde_json::json;
use staging::Folder;
use study::car::CarCase;
use study::car::statistics::NO_STATISTICS;
use study::car::summary::CarSummary;
use study::car::worst::place_in_words;
use study::case::Case;
use study::models::{AnyCase, built_in, built_in_names};
use study::outcome::Outcome;
use study::output_files::{OutputFiles, TableFormat};
use study::summary::RunSummary;
use study::truck::run::TruckResult;
use study::truck::{TruckCase, WEDGE_NAMES};
use study::vehicle::VehicleCase;
use study::vehicle::summary::VehicleSummary;

use super::energy;
use crate::execute::{
    Done, TABLE_NOTE, compute, compute_with_contacts, compute_with_motions, started_with, table, unsound,
    write_as, write_outcome, write_page,
};
use crate::failure::{Failure, Message, say};
use crate::folders;
use crate::interrupt;
use crate::json;
use crate::progress::Progress;
use crate::saved::{self, Parts, Saved};
use crate::select::built_in_elsewhere;
use crate::start;
use crate::table::TerminalTable;

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
    if arguments.save.is_some() || arguments.from.is_some() {
        return execute_in_parts(&case, arguments);
    }
    match case {
        AnyCase::Wedge(case) => run_wedge(Arc::unwrap_or_clone(case), arguments),
        AnyCase::Truck(case) => run_truck(&case, arguments),
        AnyCase::Car(case) => run_car(&case, arguments),
        AnyCase::Vehicle(case) => run_vehicle(&case, arguments),
        AnyCase::HalfTruck(case) => Err(not_here(&case.name)),
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

/// Runs a wedge, and writes its page besides.
fn run_wedge(case: Case, arguments: &Arguments) -> Result<ExitCode, Failure> {
    let place = begin(&case, &[page::FILE_NAME], arguments)?;
    let (folder, progress) = (&place.folder, &place.progress);
    let done = compute(&case, progress).and_then(|done| {
        write_as(&done, &case, folder, &place.output, progress)?;
        Ok(done)
    });
    progress.finish();
    let done = done?;
    let (wall, run) = (done.wall, (case, done.result));
    write_page(folder, || page::wedge_run::render(&run))?;
    let summary = &run.1.summary;
    print_run(arguments, &place, summary, || {
        let energy = energy::in_short(&summary.energy);
        (table([(summary, wall)]), note(TABLE_NOTE, energy))
    })?;
    match unsound::<Case>(summary, folder.path()) {
        Some(failure) => Err(failure),
        None => Ok(ExitCode::SUCCESS),
    }
}

/// Runs a case of any model in parts.
fn execute_in_parts(case: &AnyCase, arguments: &Arguments) -> Result<ExitCode, Failure> {
    match case {
        AnyCase::Wedge(case) => run_in_parts(&**case, arguments, |done| {
            (table([(&done.result.summary, done.wall)]), TABLE_NOTE.to_owned())
        }),
        AnyCase::Truck(case) => run_in_parts(&**case, arguments, |done| {
            (truck_table(&done.result), TRUCK_NOTE.to_owned())
        }),
        AnyCase::Car(case) => run_in_parts(&**case, arguments, |done| limits_of_car(&done.result.summary)),
        AnyCase::Vehicle(case) => run_in_parts(&**case, arguments, |done| {
            let units = done.result.summary.units;
            (
                vehicle_table(&done.result.summary, units),
                VEHICLE_NOTE.to_owned(),
            )
        }),
        AnyCase::HalfTruck(case) => Err(not_here(&case.name)),
    }
}

fn run_in_parts<C: RunFiles>(
    case: &C,
    arguments: &Arguments,
    shown: impl FnOnce(&Done<C::Output>) -> (TerminalTable, String),
) -> Result<ExitCode, Failure> {
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
    print_run(arguments, &place, summary, || shown(&done))?;
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

/// Half-trucks have a command of their own.
fn not_here(name: &str) -> Failure {
    Message::new(format!("{name} is a half-truck"), "`wedgelab nucars run` runs it").into()
}

/// Returns a note with another one below it, if there is one.
fn note(about: &str, more: Option<String>) -> String {
    more.map_or(about.to_owned(), |more| format!("{about}\n\n{more}"))
}

/// Runs a truck, and writes its page besides.
fn run_truck(case: &TruckCase, arguments: &Arguments) -> Result<ExitCode, Failure> {
    let place = begin(case, &[page::FILE_NAME], arguments)?;
    let (folder, progress) = (&place.folder, &place.progress);
    let done = compute_with_contacts(case, progress).and_then(|(done, contacts)| {
        write_as(&done, case, folder, &place.output, progress)?;
        Ok((done, contacts))
    });
    progress.finish();
    let (done, contacts) = done?;
    let run = TruckRun {
        case: case.clone(),
        result: done.result,
        contacts,
    };
    write_page(folder, || page::truck_run::render(&run))?;
    let summary = &run.result.summary;
    if !arguments.json {
        start::print(&summary.statics, summary.units)?;
    }
    print_run(arguments, &place, &run.result.summary, || {
        let energy = energy::in_short(&run.result.summary.energy);
        (truck_table(&run.result), note(TRUCK_NOTE, energy))
    })?;
    match unsound::<TruckCase>(&run.result.summary, folder.path()) {
        Some(failure) => Err(failure),
        None => Ok(ExitCode::SUCCESS),
    }
}

/// Runs a car, and writes its page besides.
fn run_car(case: &CarCase, arguments: &Arguments) -> Result<ExitCode, Failure> {
    let place = begin(case, &[page::FILE_NAME], arguments)?;
    let (folder, progress) = (&place.folder, &place.progress);
    let done = compute_with_motions(case, progress).and_then(|(done, motions)| {
        write_as(&done, case, folder, &place.output, progress)?;
        Ok((done, motions))
    });
    progress.finish();
    let (done, motions) = done?;
    let run = CarRun {
        case: case.clone(),
        result: done.result,
        motions,
    };
    write_page(folder, || page::car_run::render(&run))?;
    let summary = &run.result.summary;
    if !arguments.json {
        start::print(&summary.statics, summary.units)?;
    }
    print_run(arguments, &place, summary, || limits_of_car(summary))?;
    match unsound::<CarCase>(summary, folder.path()) {
        Some(failure) => Err(failure),
        None => Ok(ExitCode::SUCCESS),
    }
}

/// Runs a vehicle, and writes its page besides.
fn run_vehicle(case: &VehicleCase, arguments: &Arguments) -> Result<ExitCode, Failure> {
    let place = begin(case, &[page::FILE_NAME], arguments)?;
    let (folder, progress) = (&place.folder, &place.progress);
    let done = compute(case, progress).and_then(|done| {
        write_as(&done, case, folder, &place.output, progress)?;
        Ok(done)
    });
    progress.finish();
    let result = done?.result;
    write_page(folder, || page::vehicle_run::render(case, &result))?;
    let summary = &result.summary;
    print_run(arguments, &place, summary, || {
        (vehicle_table(summary, summary.units), VEHICLE_NOTE.to_owned())
    })?;
    match unsound::<VehicleCase>(summary, folder.path()) {
        Some(failure) => Err(failure),
        None => Ok(ExitCode::SUCCESS),
    }
}

const VEHICLE_NOTE: &str = "\
Forces at the start and extremes over all output times. Natural vibrations, extremes of all columns and the
energy ledger stand in summary.json.";

/// Returns the table of the forces of a vehicle's elements.
fn vehicle_table(summary: &VehicleSummary, units: quantity::System) -> TerminalTable {
    let unit = Kind::Force.label(units);
    let head = [
        ("force", ""),
        ("at the start", unit),
        ("least", unit),
        ("largest", unit),
    ];
    let mut table = TerminalTable::new(1, &head);
    for (name, own) in &summary.forces_at_start {
        let column = format!("{name}_{}", Kind::Force.suffix(units));
        let found = summary.extremes.get(&column);
        let cell = |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{value:.1}"));
        table.row([
            name.replace('_', " "),
            cell(Some(own.value)),
            cell(found.map(|found| found.minimum)),
            cell(found.map(|found| found.maximum)),
        ]);
    }
    table
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

/// Returns the text about a car's run: its limits, and what its start locks in.
fn limits_of_car(summary: &CarSummary) -> (TerminalTable, String) {
    let (table, about) = limits_beside(summary);
    (table, note(&about, summary.start_in_words()))
}

fn limits_beside(summary: &CarSummary) -> (TerminalTable, String) {
    if summary.limits.is_empty() {
        let why = summary
            .warnings()
            .iter()
            .find(|own| own.starts_with(NO_STATISTICS));
        let why = why.and_then(|own| own.strip_prefix(NO_STATISTICS));
        (
            TerminalTable::new(1, &[]),
            format!("No statistics{}.", why.unwrap_or_default()),
        )
    } else if summary.limits.iter().any(|own| own.unfiltered) {
        (car_table(summary), format!("{CAR_NOTE}\n{UNFILTERED_NOTE}"))
    } else {
        (car_table(summary), CAR_NOTE.to_owned())
    }
}

/// The note on values that no filter has passed.
const UNFILTERED_NOTE: &str = "\
Values without margin are raw: the rows are too far apart for the filter that their limit is for. Shorten \
simulation.output_interval.";

/// The note that explains the columns of a car's table.
const CAR_NOTE: &str = "\
Worst value of each kind, of filtered forces and accelerations, beside limits that are remembered of AAR \
M-1001, chapter XI: check
them against your edition. A limit counts for its regimes only (summary.json names them). Margin: what is \
left, in parts of it; of a least share, of the way from 100 %.";

/// Returns the table of a car's limits.
fn car_table(summary: &CarSummary) -> TerminalTable {
    let mut table = TerminalTable::new(
        2,
        &[
            ("quantity", ""),
            ("worst at", ""),
            ("value", ""),
            ("limit", ""),
            ("margin", "%"),
        ],
    );
    for own in &summary.limits {
        let shown = |value: f64| match own.unit.as_str() {
            "" => format!("{value:.3}"),
            unit => format!("{value:.3} {unit}"),
        };
        table.row([
            own.quantity.clone(),
            place_in_words(&own.statistic),
            shown(own.value),
            shown(own.limit),
            match own.unfiltered {
                true => "-".to_owned(),
                false => format!("{:.0}", 100.0 * own.margin),
            },
        ]);
    }
    table
}

/// The note that explains the columns of a truck's table.
const TRUCK_NOTE: &str = "\
Column normal force: of each wedge, its least and largest at any output time. Energy per cycle: lost in \
friction at column and
slope, over whole cycles of the first periodic motion after the first one.";

/// Returns the table of a truck's wedges.
fn truck_table(result: &TruckResult) -> TerminalTable {
    let summary = &result.summary;
    let [force, energy] = [Kind::Force, Kind::Energy].map(|kind| kind.label(summary.units));
    let mut table = TerminalTable::new(
        1,
        &[
            ("wedge", ""),
            ("column normal force, least", force),
            ("largest", force),
            ("energy per cycle", energy),
        ],
    );
    for name in WEDGE_NAMES {
        let column = format!("{name}_column_normal_{}", Kind::Force.suffix(summary.units));
        let extremes = summary.extremes.get(&column);
        let cell = |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{value:.1}"));
        table.row([
            name.replace('_', " "),
            cell(extremes.map(|found| found.minimum)),
            cell(extremes.map(|found| found.maximum)),
            cell(summary.cycles.loss_of_wedges(&[name])),
        ]);
    }
    table
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
