//! `wedgelab plot`: any column over any other, or the power spectral density of one.

use std::f64::consts::PI;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use quantity::{Kind, Quantity, SixDigits};
use report::drawn::png;
use report::plot;
use report::table::ResultTable;
use study::signal::{Spectrum, SpectrumError};

use super::compare::label;
use crate::adjust::TimeSpan;
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::select::read_table;

/// Draw any column of a result over any other
///
/// Takes the result of a run (its folder or its result.csv) or another CSV file with columns such as time_s,
/// wedge_x_in, and writes an SVG or PNG file. Several columns with one unit share their axes; each unit has
/// its own.
///
/// With --psd it draws the one-sided power spectral density of a column by Welch's method (segments that
/// overlap by half, less their means, under Hann's window), in decibels over one unit of the column, squared,
/// per Hz: its integral over the frequency is the variance. A file ending in .csv gets the densities
/// themselves. Rows must be equidistant in time; frequencies above half their rate are aliased.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab plot my_run --x time --y wedge_z
  wedgelab plot my_run --x bolster_vertical --y vertical_wedge_force --out loop.svg --from 2
  wedgelab plot my_run --x time --y column_upper_left_gap column_lower_left_gap
  wedgelab plot my_run --psd vertical_wedge_force --from 2
  wedgelab plot my_run --psd vertical_wedge_force --resolution \"0.5 Hz\" --out psd.csv")]
pub struct Arguments {
    /// Result: the folder of a run, or a CSV file
    result: PathBuf,
    /// Column along the horizontal axis, named with or without unit
    #[arg(long, value_name = "NAME", required_unless_present = "psd")]
    x: Option<String>,
    /// Columns along the vertical axis
    #[arg(long, value_name = "NAME", num_args = 1.., required_unless_present = "psd")]
    y: Vec<String>,
    /// Draw the power spectral density of this column
    #[arg(long, value_name = "NAME", conflicts_with_all = ["x", "y"])]
    psd: Option<String>,
    /// Largest distance of two frequencies [default: that of at least eight segments]
    #[arg(long, value_name = "FREQUENCY", value_parser = frequency, allow_hyphen_values = true)]
    resolution: Option<f64>,
    #[command(flatten)]
    span: TimeSpan,
    /// File to write, ending in .svg or .png, with --psd also in .csv [default: Y_over_X.svg, NAME_psd.svg]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Overwrite an existing file
    #[arg(long)]
    force: bool,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let mut table = read_table(&arguments.result)?;
    arguments.span.apply(&mut table)?;
    let x = match (&arguments.psd, &arguments.x) {
        (Some(name), _) => return density(arguments, &table, name),
        (None, _) if arguments.resolution.is_some() => {
            let advice = "name the column with --psd, or leave --resolution out";
            return Err(Message::new("--resolution is for --psd", advice).into());
        }
        (None, Some(x)) => table.column(x)?.name.clone(),
        (None, None) => return Err(Message::new("--x is missing", "name the column with --x NAME").into()),
    };
    let mut y: Vec<String> = Vec::new();
    for name in &arguments.y {
        let name = &table.column(name)?.name;
        if !y.contains(name) {
            y.push(name.clone());
        }
    }
    let figure = plot::figure(&table, &label(&table.file), &x, &y)?;
    let file = match &arguments.out {
        Some(file) => file.clone(),
        None => {
            let [x, y] = [&x, &y[0]].map(|name| plot::file_name(name));
            PathBuf::from(format!("{y}_over_{x}.svg"))
        }
    };
    let Some((name, kind)) = drawn(&file).filter(|(_, kind)| *kind != Drawn::Table) else {
        return Err(no_figure(&file, "SVG or PNG"));
    };
    let bytes = match kind {
        Drawn::Picture => png(&figure)?,
        _ => figure.to_svg().into_bytes(),
    };
    write(&file, name, arguments.force, &bytes)?;
    writeln!(io::stdout().lock(), "Written: {}.", file.display())?;
    Ok(ExitCode::SUCCESS)
}

/// Draws or writes the power spectral density of a column.
fn density(arguments: &Arguments, table: &ResultTable, name: &str) -> Result<ExitCode, Failure> {
    let column = table.column(name)?;
    let file = match &arguments.out {
        Some(file) => file.clone(),
        None => PathBuf::from(format!("{}_psd.svg", plot::file_name(&column.name))),
    };
    let Some((name, kind)) = drawn(&file) else {
        return Err(no_figure(&file, "SVG or PNG, densities are CSV"));
    };
    let spectrum = Spectrum::welch(table.times(), &column.written, arguments.resolution)
        .map_err(|error| refused(table, &error))?;
    let bytes = match kind {
        Drawn::Table => {
            let mut bytes = Vec::new();
            plot::write_density(table, column, &spectrum, &mut bytes)?;
            bytes
        }
        kind => {
            let figure = plot::density_figure(table, &label(&table.file), column, &spectrum);
            match kind {
                Drawn::Picture => png(&figure)?,
                _ => figure.to_svg().into_bytes(),
            }
        }
    };
    write(&file, name, arguments.force, &bytes)?;
    let unit = column.kind.label(table.units);
    let rms = spectrum.variance().sqrt();
    writeln!(
        io::stdout().lock(),
        "Power spectral density of {}, {}, from {} segments of {} rows, lines {} Hz apart up to {} Hz. Root \
         mean square about the mean: {} {unit}; most of it at {} Hz.\nWritten: {}.",
        column.name,
        plot::density_unit(unit),
        spectrum.segments,
        spectrum.rows,
        SixDigits(spectrum.resolution()),
        SixDigits(0.5 * spectrum.rows as f64 * spectrum.resolution()),
        SixDigits(rms),
        SixDigits(spectrum.peak()),
        file.display()
    )?;
    Ok(ExitCode::SUCCESS)
}

fn frequency(text: &str) -> Result<f64, String> {
    Quantity::parse_as(text.trim(), Kind::Frequency)
        // Inside, frequencies are angular.
        .map(|quantity| quantity.to_si() / (2.0 * PI))
        .map_err(|error| format!("{error}; write for example \"0.5 Hz\""))
}

/// Returns the reason why there is no spectrum, and the advice.
fn refused(table: &ResultTable, error: &SpectrumError) -> Message {
    let advice = match error {
        SpectrumError::TooShort { .. } => {
            "ask for a coarser --resolution, or for a longer span of time; a run's rows are as near as its \
             simulation.output_interval says"
        }
        SpectrumError::Uneven { .. } => {
            "give a table whose times are evenly apart, such as a run's result.csv"
        }
        SpectrumError::Resolution { .. } => "write for example --resolution \"0.5 Hz\"",
    };
    Message::new(format!("`{}`: {error}", table.file.display()), advice)
}

/// Returns the failure of a name that is not that of a file that can be written.
fn no_figure(file: &Path, what: &str) -> Failure {
    let message = format!("`{}` is no name for a figure: figures are {what}", file.display());
    let advice = format!("write --out {}", file.with_extension("svg").display());
    Message::new(message, advice).into()
}

fn write(file: &Path, name: &str, force: bool, bytes: &[u8]) -> Result<(), Failure> {
    let folder = match file.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let folder = folders::check(folder, &[name], force)?;
    Ok(folder.write(|files| files.add(name, |out| out.write_all(bytes)))?)
}

/// Contents of a file.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Drawn {
    /// SVG.
    Drawing,
    /// PNG.
    Picture,
    /// CSV.
    Table,
}

/// Returns the name of a file that can be written, and what it holds.
fn drawn(file: &Path) -> Option<(&str, Drawn)> {
    let ending = file.extension()?.to_str()?.to_ascii_lowercase();
    let name = file.file_name()?.to_str()?;
    match ending.as_str() {
        "svg" => Some((name, Drawn::Drawing)),
        "png" => Some((name, Drawn::Picture)),
        "csv" => Some((name, Drawn::Table)),
        _ => None,
    }
}
