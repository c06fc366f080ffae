//! `wedgelab nucars run`: one run of a half-truck.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use nucars::Severity;
use nucars::file_sets::{self, RunFiles, find, kind, load};
use nucars::truck::{Choices, Wedges, Yaw};
use quantity::{Kind, Quantity, nearest};
use report::drawn::Drawn;
use report::half_truck_files;
use report::models::ReportCase;
use report::page;
use report::terminal::TerminalTable;
use study::half_truck::catalog::{self, CatalogEntry, YawCase};
use study::half_truck::files::{Settings, case_of_run};
use study::half_truck::{HalfTruckCase, HalfTruckStart, options};

use super::files::Instead;
use super::load::print_findings;
use crate::commands::run::is_built_in;
use crate::execute::{Done, compute_shown, unsound, write, write_outcome, write_page};
use crate::failure::{Failure, Message, say};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;
use crate::units::OutputUnits;

/// The files of the figure.
const FIGURE: [&str; 2] = ["loops.svg", "loops.png"];

/// Run a half-truck from its files
///
/// Reads a run file with the files it names, and writes result.csv (the columns of the data file, wedges,
/// bodies, energies), result.mat (the same, and the array that the thesis's scripts load), summary.json
/// (averages of each wedge, energy ledger, yaw, assumptions), loops.svg and loops.png (forces of the wedges'
/// columns over their strokes) and index.html (the half-truck moving in 3D, loops) into a folder named as the
/// run file. The run file's stepping constants set the end of the run. The runs of the thesis's table 4-1 are
/// built in; --list names them.
///
/// Choices that no public text settles are --options, with defaults that the summary lists: bend
/// (half_cosine, linear), speed (along the track), plain_toe_angle (column of types without an angle), branch
/// (friction_force, or a reference speed), rise_in_slip (true, false), negative_rise (extend, stop),
/// accumulator_damping (a factor), gap_tension (never, allowed).
///
/// --wedges bodies replaces each wedge of type 6.8 or 6.9 by a body with mass, corners with contact and a
/// coil. Values that the files do not have are defaults, which the run prints and the summary lists;
/// wedge_mass, wedge_height, wedge_width, wedge_contact_stiffness and wedge_contact_damping are options.
///
/// --set lays single values over the files, by the numbers that these give:
/// characteristic.301.column_friction, wedges.slope_friction (of all wedges), body.2.mass, connection.127.z,
/// function.7.factor, history.1.frequency; simulation.duration and simulation.relative_tolerance.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab nucars run half_truck.run
  wedgelab nucars run yaw.run --data results.dat --yaw drop
  wedgelab nucars run half_truck.run --option branch=\"0.1 in/s\" --option gap_tension=allowed --out other
  wedgelab nucars run nucars_69_constant_toe_out_yaw
  wedgelab nucars run nucars_69_constant_toe_out --wedges bodies --option wedge_contact_stiffness=\"1e6 \
lbf/in\" --out bodies
  wedgelab nucars run half_truck.run --set wedges.column_friction=0.3 --set 'body.2.mass=\"2000 lb\"' --out \
softer

Exit codes: 0 done; 1 the run could not finish or has failed, or files could not be written;
2 the input is wrong; 129, 130, 143 ended by SIGHUP, SIGINT (Ctrl-C), SIGTERM: what was computed is
written.")]
pub struct Arguments {
    /// Run file (.RUN), or, if there is no such file, the name of a built-in run
    #[arg(value_name = "FILE", required_unless_present = "list")]
    file: Option<PathBuf>,
    /// List the built-in runs
    #[arg(long, exclusive = true)]
    list: bool,
    #[command(flatten)]
    instead: Instead,
    /// Folder to write into [default: the run file's name without ending]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    /// Start in static equilibrium without friction instead of the drawn layout
    #[arg(long)]
    equilibrium: bool,
    /// Also write the columns that the data file switches off
    #[arg(long)]
    all_outputs: bool,
    /// Time between two rows
    #[arg(
        long,
        value_name = "TIME",
        default_value = "0.01 s",
        value_parser = time,
        allow_hyphen_values = true,
    )]
    interval: Quantity,
    /// Means by which the bolster reaches its yaw
    #[arg(long, value_name = "HOW")]
    yaw: Option<YawArgument>,
    /// Model of the wedges of types 6.8 and 6.9
    #[arg(long, value_name = "WHAT")]
    wedges: Option<WedgesArgument>,
    /// A choice where the files leave one open
    #[arg(long, value_name = "NAME=VALUE")]
    option: Vec<String>,
    /// Set one value over those of the files
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Units of the results
    #[arg(long, default_value = "us")]
    units: OutputUnits,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// The means by which the bolster reaches its yaw.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub enum YawArgument {
    /// As the files say, even where springs hold the bolster
    Printed,
    /// As they mean it: without the longitudinal springs at both sides, with a stiff yaw spring
    Drop,
    /// As they mean it: the outer input bodies move along
    Drive,
}

/// Models of wedges.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum WedgesArgument {
    /// The files' law, without mass
    Massless,
    /// Bodies with mass between pocket and column
    Bodies,
}

fn time(text: &str) -> Result<Quantity, String> {
    let quantity = Quantity::parse_as(text, Kind::Time).map_err(|error| error.to_string())?;
    if quantity.to_si() > 0.0 && quantity.to_si().is_finite() {
        Ok(quantity)
    } else {
        Err("it must be positive".to_owned())
    }
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let (false, Some(file)) = (arguments.list, &arguments.file) else {
        return list();
    };
    interrupt::listen();
    let settings = arguments.settings()?;
    let case = match built_in(file)? {
        Some(entry) => arguments.built_in(entry, settings)?,
        None if !file.exists() && is_built_in(file) => {
            let message = format!(
                "`{}` is a built-in case, not a half-truck of NUCARS's files",
                file.display()
            );
            let advice = format!("`wedgelab run {}` runs it", file.display());
            return Err(Message::new(message, advice).into());
        }
        None => arguments.of_files(file, &settings)?,
    };
    let path = arguments.out.clone().unwrap_or_else(|| PathBuf::from(&case.name));
    let names = [&half_truck_files::NAMES[..], &FIGURE, &[page::FILE_NAME]].concat();
    let folder = folders::check(path, &names, arguments.force)?;
    let progress = Progress::new(1, arguments.quiet);
    interrupt::stops_run();
    let done = compute_shown(&case, &progress)
        .and_then(|(done, along)| write(&done, &case, &folder, &progress).map(|()| (done, along)));
    progress.finish();
    let (Done { result, wall }, along) = done?;
    let figure = Drawn::of(&page::half_truck_run::loops(&case, &result).figure)?;
    let figures = folders::check(folder.path().to_owned(), &FIGURE, true)?;
    figures.write(|files| figure.add(files, FIGURE[0], FIGURE[1]))?;
    let shown = case.shown(result, along);
    write_page(&folder, || HalfTruckCase::page(&shown))?;
    let (case, result) = HalfTruckCase::parts(&shown);
    let summary = &result.summary;
    let (table, about) = HalfTruckCase::in_words(summary, wall);
    if summary.yaw.as_ref().is_some_and(|yaw| yaw.is_missed()) {
        say("  --yaw drop leaves out the springs that hold it, --yaw drive moves their input bodies along");
    }
    let mut out = io::stdout().lock();
    writeln!(out, "{}\n", summary.title)?;
    write_outcome(summary, &mut out)?;
    table.write(&mut out)?;
    if !case.wedge_notes.is_empty() {
        writeln!(out, "\nWedges as bodies:")?;
        for note in &case.wedge_notes {
            writeln!(out, "  {note}")?;
        }
    }
    writeln!(
        out,
        "\n{about}\n\
         Relative residual of the energy ledger: {:.1e}, the largest at any output time over the largest \
         of work, losses and\nchange of stored energy.\n\nWritten into {}: {} (open it in a browser).",
        summary.largest_relative_residual,
        folder.path().display(),
        names.join(", ")
    )?;
    match unsound::<HalfTruckCase>(summary, folder.path()) {
        Some(failure) => Err(failure),
        None => Ok(ExitCode::SUCCESS),
    }
}

impl Arguments {
    fn settings(&self) -> Result<Settings, Message> {
        let mut choices = choices(self.yaw, &self.option)?;
        match self.wedges {
            None => {}
            Some(WedgesArgument::Massless) => choices.wedges = Wedges::Massless,
            Some(WedgesArgument::Bodies) => choices.wedges = Wedges::Bodies,
        }
        Ok(Settings {
            choices,
            start: if self.equilibrium {
                HalfTruckStart::Equilibrium
            } else {
                HalfTruckStart::Drawn
            },
            all_outputs: self.all_outputs,
            interval: self.interval.to_si(),
            set: self.set.clone(),
            units: self.units.system(),
            ..Settings::default()
        })
    }

    fn built_in(&self, entry: CatalogEntry, settings: Settings) -> Result<HalfTruckCase, Message> {
        check_built_in(entry, &self.instead, self.yaw)?;
        entry.case_with(&settings).map_err(|error| {
            let advice = "choose another interval, option or value; `wedgelab nucars run --help` lists them";
            Message::new(error.to_string(), advice)
        })
    }

    /// Returns the case of a run file.
    fn of_files(&self, file: &Path, settings: &Settings) -> Result<HalfTruckCase, Failure> {
        let instead = self.instead.files();
        let RunToMake { path, files, again } = read_run(file, &instead)?;
        Ok(case_of_run(&path, &files, settings).map_err(|error| {
            Message::new(
                format!("{} cannot be run: {error}", path.display()),
                format!("`{again}` tells what is doubtful about the files"),
            )
        })?)
    }
}

/// Returns the choices where the files leave something open.
pub fn choices(yaw: Option<YawArgument>, typed: &[String]) -> Result<Choices, Message> {
    let mut choices = Choices {
        yaw: match yaw {
            None | Some(YawArgument::Printed) => Yaw::AsPrinted,
            Some(YawArgument::Drop) => Yaw::Dropped,
            Some(YawArgument::Drive) => Yaw::Driven,
        },
        ..Choices::default()
    };
    for typed in typed {
        options::set(&mut choices, typed)
            .map_err(|error| Message::new(error.to_string(), "`wedgelab nucars run --help` lists them"))?;
    }
    Ok(choices)
}

/// Checks whether a built-in run can be made without other files, and yaw so.
pub fn check_built_in(
    entry: CatalogEntry,
    instead: &Instead,
    yaw: Option<YawArgument>,
) -> Result<(), Message> {
    if let Some(option) = instead.files().given().first() {
        return Err(Message::new(
            format!(
                "the built-in run {} has its own files, and {option} is given",
                entry.name()
            ),
            "give a run file, or leave it out",
        ));
    }
    let fits = match yaw {
        None => true,
        Some(YawArgument::Printed) => entry.yaw != YawCase::Intended,
        Some(_) => entry.yaw == YawCase::Intended,
    };
    if fits {
        return Ok(());
    }
    Err(Message::new(
        format!("--yaw does not fit the built-in run {}", entry.name()),
        "built-in runs with yaw as intended end with _yaw, those as printed with _yaw_as_printed",
    ))
}

/// A run file with its files, which can be run.
pub struct RunToMake {
    /// The path of the run file.
    pub path: PathBuf,
    /// All files.
    pub files: RunFiles,
    /// The command that tells what is doubtful about them.
    pub again: String,
}

/// Reads a run file with its files; tells their errors, and refuses them if they have some.
pub fn read_run(file: &Path, instead: &file_sets::Instead) -> Result<RunToMake, Failure> {
    let path = find(file)?;
    let source = load(&path)?;
    let found = kind(&source)?;
    if found != nucars::read::FileKind::Run {
        return Err(Message::new(
            format!("{} is not a run file, but a {found}", path.display()),
            "name the .RUN file, which says what belongs together and how long the run is",
        )
        .into());
    }
    let files = RunFiles::read(&path, instead)?;
    for findings in files.findings() {
        print_findings(findings, |finding| finding.severity() == Severity::Error);
    }
    let again = std::iter::once(format!("wedgelab nucars check {}", path.display()))
        .chain(instead.given())
        .collect::<Vec<_>>()
        .join(" ");
    if files.has_errors() {
        return Err(Message::new(
            format!("{} cannot be run", path.display()),
            format!("mend the errors above; `{again}` tells warnings and notes too"),
        )
        .into());
    }
    let warnings = files.count(Severity::Warning);
    if warnings > 0 {
        let s = if warnings == 1 { "" } else { "s" };
        say(&format!(
            "{warnings} warning{s} about the files; `{again}` tells them"
        ));
    }
    Ok(RunToMake { path, files, again })
}

/// Returns the built-in run of this name, unless there is such a file.
pub fn built_in(file: &Path) -> Result<Option<CatalogEntry>, Message> {
    let name = file.to_str().unwrap_or("");
    let exists = file.is_file();
    if let Some(entry) = catalog::entry(name).filter(|_| !exists) {
        return Ok(Some(entry));
    }
    if !exists && name.starts_with("nucars_") && file.extension().is_none() {
        let names: Vec<String> = catalog::entries().iter().map(CatalogEntry::name).collect();
        let advice = match nearest(name, names.iter().map(String::as_str)) {
            Some(near) => format!("did you mean {near}? `wedgelab nucars run --list` lists all"),
            None => "`wedgelab nucars run --list` lists the built-in runs".to_owned(),
        };
        return Err(Message::new(
            format!("there is neither a file nor a built-in run `{name}`"),
            advice,
        ));
    }
    Ok(None)
}

fn list() -> Result<ExitCode, Failure> {
    let mut shown = TerminalTable::new(2, &[("name", ""), ("what", "")]);
    for entry in catalog::entries() {
        shown.row([entry.name(), entry.title()]);
    }
    let mut out = io::stdout().lock();
    shown.write(&mut out)?;
    Ok(ExitCode::SUCCESS)
}
