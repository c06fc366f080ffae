//! `wedgelab fit`: parameters of a case from a measured loop.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use rayon::prelude::*;
use report::drawn::Drawn;
use report::fit_files::{self, FitFigure};
use report::run_files;
use report::table::{ResultTable as Measurements, TableColumn};
use report::terminal::TerminalTable;
use study::case::CaseError;
use study::fit::{Fit, FitError, Free, FreeError, Measured, fit};
use study::metrics::Cycle;
use study::models::{AnyCase, CaseSource};

use super::run::{is_built_in, read_any};
use crate::adjust::{self, Names, seconds};
use crate::failure::{Failure, Message, say};
use crate::folders;
use crate::interrupt;
use crate::select::read_table;

/// Columns of a wedge or a truck that may hold the measured force, the first one found being taken.
const FORCES: [&str; 7] = [
    "warp_moment",
    "interaxle_shear_moment",
    "vertical_wedge_force",
    "vertical_force_on_side_frame",
    "net_force_on_bolster_z",
    "net_force_on_side_frame_z",
    "longitudinal_wedge_force",
];
/// The vertical displacement of a wedge's bolster, and that of the body that drives a half-truck's.
const DISPLACEMENTS: [&str; 2] = ["bolster_vertical", "input_vertical"];
/// A measured stroke that differs by more than this part from the case's is reported.
const STROKE: f64 = 0.02;
/// Below this, differences hang together so much that intervals are too narrow.
const INDEPENDENT: f64 = 1.0;

/// Find parameters of a case from a measured force-displacement loop
///
/// Takes a CSV file with the columns time_s, a force such as vertical_wedge_force_lbf, and perhaps
/// bolster_vertical_in, and finds the values of free parameters between bounds with which the case's run
/// comes nearest to it (least squares). Prints them with confidence intervals, and writes fit.json, the case
/// with the values found, and a figure of loop and residuals. The case may be a half-truck: then --column
/// names the force (wedge_127_column_friction), and parameters are those of `wedgelab nucars run --set`.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab fit loop.csv my.toml --free friction.column=0.2..0.6
  wedgelab fit loop.csv rig_constant --free friction.column=0.2..0.6 friction.slope=0.2..0.6 --confidence 0.99
  wedgelab fit loop.csv my.toml --follow --free 'control_coil.stiffness=1500 lbf/in..2500 lbf/in'
  wedgelab fit loop.csv half_truck.run --column wedge_127_column_friction --free \
wedges.column_friction=0.2..0.6

Preload is control_coil.free_length or control_coil.nominal_length.")]
pub struct Arguments {
    /// Measured values: a CSV file as `wedgelab compare` reads
    measured: PathBuf,
    /// Case file or run file of a half-truck, or, if there is no such file, the name of a built-in one
    case: PathBuf,
    /// Parameters to be found, between bounds
    #[arg(long, value_name = "PATH=LOW..HIGH", num_args = 1.., required = true)]
    free: Vec<String>,
    /// Column with the measured force
    /// [default: the first force on a wedge's side frame or bolster that the file has]
    #[arg(long, value_name = "NAME")]
    column: Option<String>,
    /// Move the bolster as measured (column bolster_vertical), not as the case says
    #[arg(long)]
    follow: bool,
    /// Leave out the values before this time, s [default: the first half period of the bolster's motion]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    from: Option<f64>,
    /// Leave out the values after this time, s
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    to: Option<f64>,
    #[command(flatten)]
    names: Names,
    /// Probability with which the intervals are to hold the true values
    #[arg(long, value_name = "P", default_value_t = 0.95)]
    confidence: f64,
    /// Set one value over those of the case
    #[arg(long, value_name = "PATH.KEY=VALUE")]
    set: Vec<String>,
    /// Folder to write into
    #[arg(long, value_name = "DIR", default_value = "fit")]
    out: PathBuf,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
}

impl From<FreeError> for Failure {
    fn from(error: FreeError) -> Self {
        Message::new(error.problem, error.advice).into()
    }
}

impl From<FitError> for Failure {
    fn from(error: FitError) -> Self {
        match error {
            FitError::Case(error) => error.into(),
            FitError::TooFew { .. } => {
                Message::new(error.to_string(), "free fewer parameters, or lower --from").into()
            }
            FitError::NotFinite => Message::new(
                error.to_string(),
                "look for wrong units or damage in the measured values",
            )
            .into(),
            FitError::Model(_) => Self::Failed(
                Message::new(
                    format!("the case cannot be fitted: {error}"),
                    "look at the run with `wedgelab run` at values between the bounds, and narrow the bounds",
                )
                .into(),
            ),
        }
    }
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    if !(arguments.confidence > 0.0 && arguments.confidence < 1.0) {
        let message = format!("--confidence is {}", arguments.confidence);
        return Err(Message::new(message, "it lies between 0 and 1: 0.95 is usual").into());
    }
    let free = arguments
        .free
        .iter()
        .map(|text| Free::parse(text))
        .collect::<Result<Vec<_>, _>>()?;
    if let Some(twice) = free
        .iter()
        .enumerate()
        .find(|(number, one)| free[..*number].iter().any(|other| other.path == one.path))
    {
        return Err(Message::new(
            format!("`{}` is free twice", twice.1.path),
            "take one of them out",
        )
        .into());
    }
    let mut table = read_table(&arguments.measured)?;
    arguments.names.apply([&mut table])?;
    adjust::keep(&mut table, None, arguments.to)?;
    let force = force(&table, arguments.column.as_deref())?;
    let displacement = DISPLACEMENTS.iter().find_map(|name| table.find(name));
    let displacement = displacement.map(TableColumn::si);
    let half_truck = CaseSource::half_truck(Path::new(""), &arguments.case)?;
    let times = table.times();
    let mut set = arguments.set.clone();
    if arguments.follow {
        if half_truck.is_some() {
            let advice = "history.NUMBER.factor and history.NUMBER.frequency, by --set, change the motion \
                          of its files";
            return Err(Message::new(
                "--follow moves the bolster of a wedge, and the case is a half-truck",
                advice,
            )
            .into());
        }
        let Some(displacement) = &displacement else {
            let message = format!(
                "--follow needs the column {}, which {} has not",
                DISPLACEMENTS[0],
                table.file.display()
            );
            return Err(Message::new(message, "add it, with its unit: bolster_vertical_in").into());
        };
        set.push(followed(times, displacement));
    }
    let last = times.last().copied().unwrap_or(0.0);
    set.push(format!("simulation.duration={last} s"));
    let base = match &half_truck {
        Some(source) => source.case(&set)?,
        None => read_any(&arguments.case, &set)?,
    };
    let cycle = base.cycle();
    if !arguments.follow
        && let Some(displacement) = &displacement
    {
        compare_stroke(cycle, displacement);
    }
    let from = arguments
        .from
        .unwrap_or_else(|| cycle.map_or(0.0, |cycle| 0.5 * cycle.period()));
    let kept: Vec<usize> = (0..times.len()).filter(|row| times[*row] >= from).collect();
    let pick = |values: &[f64]| -> Vec<f64> { kept.iter().map(|row| values[*row]).collect() };
    let measured = Measured {
        times: pick(times),
        values: pick(&force.si()),
        column: force.name.clone(),
    };
    let mut names = vec![fit_files::FILE_NAME, fit_files::FIGURE, fit_files::PICTURE];
    if half_truck.is_none() {
        names.push(run_files::CASE_FILE_NAME);
    }
    let folder = folders::check(&arguments.out, &names, arguments.force)?;
    let case = |more: &[String]| {
        let all = [&set, more].concat();
        match &half_truck {
            Some(source) => source.case(&all),
            None => case_with(arguments, &all),
        }
    };
    let found = fit(&case, &measured, &free, arguments.confidence, &|count, one| {
        (0..count).into_par_iter().map(one).collect()
    })?;

    let values: Vec<String> = found
        .parameters
        .iter()
        .map(|found| found.free.set(found.value))
        .collect();
    let fitted = match &half_truck {
        Some(_) => None,
        None => case_with(arguments, &[arguments.set.clone(), values].concat())?.to_toml(),
    };
    let displacement = displacement.map(|values| pick(&values));
    let shown = FitFigure {
        measured: &measured,
        kind: force.kind,
        displacement: displacement.as_deref(),
        units: table.units,
        confidence: arguments.confidence,
    };
    let figure = Drawn::of(&fit_files::figure(&found, &shown))?;
    folder.write(|files| {
        files.add(fit_files::FILE_NAME, |out| fit_files::write(&found, &shown, out))?;
        if let Some(fitted) = &fitted {
            files.add(run_files::CASE_FILE_NAME, |out| out.write_all(fitted.as_bytes()))?;
        }
        figure.add(files, fit_files::FIGURE, fit_files::PICTURE)
    })?;
    print_fit(&found, &shown, &arguments.out, &names)?;
    for warning in &found.warnings {
        say(&format!("warning: {}: {warning}", base.name()));
    }
    match &found.failed {
        Some(reason) => Err(failed_fit(reason, &arguments.out)),
        None => Ok(ExitCode::SUCCESS),
    }
}

/// Returns the failure of a fit that came to its end, but whose run failed; its files are written.
fn failed_fit(reason: &str, folder: &std::path::Path) -> Failure {
    let message = format!("the fit has failed: in the run with these values {reason}");
    let kept = format!(
        "its files are in {}, marked as failed; do not use their numbers",
        folder.display()
    );
    Failure::Failed(Message::new(message, kept).into())
}

/// Returns the case with values set; as [`read_any`], but with the errors of cases alone.
fn case_with(arguments: &Arguments, set: &[String]) -> Result<AnyCase, CaseError> {
    let name = arguments.case.to_str().unwrap_or("");
    if is_built_in(&arguments.case)
        && let Some(case) = AnyCase::built_in(name, set)?
    {
        return Ok(case);
    }
    AnyCase::read(&arguments.case, set)
}

/// Returns the column with the measured force.
fn force<'t>(table: &'t Measurements, name: Option<&str>) -> Result<&'t TableColumn, Failure> {
    if let Some(name) = name {
        return Ok(table.column(name)?);
    }
    FORCES.iter().find_map(|name| table.find(name)).ok_or_else(|| {
        let message = format!("{} has no force that is known", table.file.display());
        let advice = format!(
            "name a column with --column; known are {}, and of a half-truck those of its result.csv",
            FORCES.join(", ")
        );
        Message::new(message, advice).into()
    })
}

/// Returns the bolster's motion as measured.
fn followed(times: &[f64], displacement: &[f64]) -> String {
    let mut text = "bolster.vertical={ shape = \"table\", points = [".to_owned();
    for (time, value) in times.iter().zip(displacement) {
        // Writing to a String cannot fail.
        let _ = write!(text, "[\"{time} s\", \"{value} m\"], ");
    }
    text + "] }"
}

/// Tells if the case moves the bolster by another stroke than was measured.
fn compare_stroke(cycle: Option<Cycle>, displacement: &[f64]) {
    let Some(cycle) = cycle else {
        return;
    };
    let ends = displacement
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(*value), high.max(*value))
        });
    let stroke = 0.5 * (ends.1 - ends.0) / cycle.amplitude - 1.0;
    if stroke.abs() > STROKE {
        say(&format!(
            "warning: the measured stroke is {:+.1} % of the case's away from it; --follow moves the \
             bolster as measured",
            100.0 * stroke
        ));
    }
}

fn print_fit(
    found: &Fit,
    shown: &FitFigure<'_>,
    folder: &std::path::Path,
    names: &[&str],
) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    let interval = format!("interval, {} %", 100.0 * shown.confidence);
    let mut table = TerminalTable::new(
        1,
        &[
            ("parameter", ""),
            ("value", ""),
            (&interval, ""),
            ("unit", ""),
            ("", ""),
        ],
    );
    for parameter in &found.parameters {
        let (half, note) = match parameter.half_interval {
            Some(half) => (format!("± {half:.2e}"), String::new()),
            None if parameter.at_bound => ("-".to_owned(), "at its bound".to_owned()),
            None => ("-".to_owned(), "not determined".to_owned()),
        };
        // As many digits as the interval lets mean anything.
        let digits = parameter
            .half_interval
            .filter(|half| *half > 0.0)
            .map_or(4.0, |half| 1.0 - half.log10().floor());
        let digits = digits.clamp(0.0, 12.0) as usize;
        table.row([
            parameter.free.path.clone(),
            format!("{:.digits$}", parameter.value),
            half,
            parameter.free.unit.clone(),
            note,
        ]);
    }
    table.write(&mut out)?;
    if let Some(correlations) = &found.correlations {
        for (i, row) in correlations.iter().enumerate() {
            for (j, value) in row
                .iter()
                .enumerate()
                .take(i)
                .filter(|(_, value)| value.abs() > 0.9)
            {
                let [a, b] = [i, j].map(|k| found.parameters[k].free.path.as_str());
                writeln!(out, "{a} and {b} are hard to tell apart: correlation {value:.3}")?;
            }
        }
    } else {
        let text = match found.parameters.len() {
            1 => "The measured values do not determine this parameter.",
            _ => "The measured values do not determine these parameters together: free fewer.",
        };
        writeln!(out, "{text}")?;
    }
    let unit = shown.kind.label(shown.units);
    let size = found.standard_error * shown.kind.from_si(shown.units);
    writeln!(
        out,
        "\n{} values of {}, standard error {size:.3} {unit}, Durbin-Watson {:.2}, {} rounds.",
        shown.measured.values.len(),
        shown.measured.column,
        found.durbin_watson,
        found.rounds
    )?;
    if found.durbin_watson < INDEPENDENT {
        writeln!(
            out,
            "The differences hang together (Durbin-Watson far below 2): the model lacks something, and the \
             intervals are too narrow."
        )?;
    }
    if !found.settled {
        writeln!(
            out,
            "It did not come to rest: look at the residuals, and narrow the bounds."
        )?;
    }
    writeln!(out, "Written into {}: {}.", folder.display(), names.join(", "))?;
    Ok(())
}
