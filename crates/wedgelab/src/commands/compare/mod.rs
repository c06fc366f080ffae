//! `wedgelab compare`: results beside each other.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use report::comparison::{ComparedResult, Comparison, FILE_NAME};
use report::table::is_of_run;
use report::terminal::TerminalTable;
use serde_json::{Value, json};

use crate::adjust::{Names, TimeSpan};
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::json;
use crate::select::read_table;

mod sections;

/// Compare results: overlay figures and a table of differences
///
/// Compares results with the first of them: those of runs (the folder or a table in it) and other CSV files
/// with columns of the same names, such as time_s, wedge_x_in. Different units are converted and different
/// times interpolated, with a message. Of runs of different models (a wedge, a truck) only columns chosen by
/// --columns are compared. Prints the differences, and writes them as differences.csv with a figure for each
/// column and the hysteresis loops.
///
/// With --sections the first result is a measurement and the others are models: all are cut into the same
/// sections, over the distance where all have it, else over time. Prints mean and standard deviation of the
/// differences over the sections, of mean, max (larger of the 0.15 % and 99.85 % percentiles in size) and rms
/// about the mean in each; writes sections.csv, section_statistics.csv and a figure for each column.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab compare reproduction/runs/vdrun_toe_0_psi_0.012 softer
  wedgelab compare my_run other_program.csv --columns wedge_z vertical_wedge_force --out check
  wedgelab compare my_run other_program.csv --map vertical_wedge_force=Fz --from 2 --to 8
  wedgelab compare measured.csv my_run --sections \"100 m\" --columns axle_1_left_vertical
  wedgelab compare measured.csv my_run --sections 12 --accept limits.toml

Without --columns the main columns that all results have are compared.")]
pub struct Arguments {
    /// Results: folders of runs, or CSV files; the others are compared with the first
    #[arg(required = true, num_args = 2.., value_name = "RESULT")]
    results: Vec<PathBuf>,
    /// Folder to write into
    #[arg(long, value_name = "DIR", default_value = "comparison")]
    out: PathBuf,
    /// Compare only these columns, named with or without unit
    #[arg(long, value_name = "NAME", num_args = 1..)]
    columns: Vec<String>,
    #[command(flatten)]
    span: TimeSpan,
    #[command(flatten)]
    names: Names,
    /// Compare section by section: a number of sections, their length or time, or a CSV file of them
    #[arg(long, value_name = "N|LENGTH|FILE")]
    sections: Option<String>,
    /// Limits of the standard deviations by column and quantity (TOML); means must be within two thirds
    #[arg(long, value_name = "FILE", requires = "sections")]
    accept: Option<PathBuf>,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    #[arg(long, help = json::HELP)]
    json: bool,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let mut entries = read(&arguments.results)?;
    arguments
        .names
        .apply(entries.iter_mut().map(|entry| &mut entry.table))?;
    for entry in &mut entries {
        arguments.span.apply(&mut entry.table)?;
    }
    if let Some(request) = &arguments.sections {
        return sections::execute(arguments, request, &entries);
    }
    let comparison = Comparison::of(&entries, &arguments.columns)?;
    let figures = comparison.figures(&entries)?;
    let mut names: Vec<&str> = vec![FILE_NAME];
    names.extend(figures.iter().map(|(name, _)| name.as_str()));
    let folder = folders::check(&arguments.out, &names, arguments.force)?;
    folder.write(|files| {
        files.add(FILE_NAME, |out| comparison.write(&entries, out))?;
        for (name, figure) in &figures {
            files.add(name, |out| out.write_all(figure.to_svg().as_bytes()))?;
        }
        Ok(())
    })?;

    if arguments.json {
        json::print(&document(&comparison, &entries, folder.path(), &names))?;
        return Ok(ExitCode::SUCCESS);
    }
    let mut out = io::stdout().lock();
    let first = &entries[0].label;
    writeln!(
        out,
        "Differences from {first}, in its units, at its {} times from {} s to {} s.\n",
        comparison.rows, comparison.span.0, comparison.span.1
    )?;
    differences(&comparison, &entries).write(&mut out)?;
    if !comparison.energies.is_empty() {
        writeln!(out)?;
        energies(&comparison, &entries).write(&mut out)?;
    }
    writeln!(
        out,
        "\nLargest: the difference that is largest in size, result less {first}, and its time. RMS: root \
         mean square of the\n\
         difference. Percentages are of the range (greatest less least value) of {first}."
    )?;
    for note in &comparison.notes {
        writeln!(out, "{note}")?;
    }
    writeln!(
        out,
        "\nWritten into {}: {}.",
        folder.path().display(),
        names.join(", ")
    )?;
    Ok(ExitCode::SUCCESS)
}

/// Returns the comparison as JSON; what is compared is named by its label.
fn document(comparison: &Comparison, entries: &[ComparedResult], folder: &Path, names: &[&str]) -> Value {
    let differences = comparison.differences.iter().map(|one| {
        json!({
            "column": one.column,
            "unit": one.unit,
            "result": entries[one.result].label,
            "largest": one.largest,
            "time_s": one.time,
            "root_mean_square": one.root_mean_square,
            "range_of_first": one.range,
            "mean": one.mean,
            "mean_of_first": one.mean_of_first,
        })
    });
    let energies = comparison.energies.iter().map(|one| {
        json!({
            "place": one.place,
            "unit": one.unit,
            "result": entries[one.result].label,
            "energy_per_cycle": one.value,
            "energy_per_cycle_of_first": one.first,
        })
    });
    json!({
        "folder": folder,
        "files": names,
        "first": entries[0].label,
        "rows": comparison.rows,
        "from_s": comparison.span.0,
        "to_s": comparison.span.1,
        "differences": differences.collect::<Vec<_>>(),
        "energies": energies.collect::<Vec<_>>(),
        "notes": comparison.notes,
    })
}

/// Reads the results and gives them names that differ.
fn read(paths: &[PathBuf]) -> Result<Vec<ComparedResult>, Failure> {
    let mut entries: Vec<ComparedResult> = Vec::new();
    for path in paths {
        let table = read_table(path)?;
        if entries.iter().any(|entry| entry.table.file == table.file) {
            let message = format!("`{}` is named twice", path.display());
            return Err(Message::new(message, "name two different results").into());
        }
        entries.push(ComparedResult {
            label: label(&table.file),
            table,
        });
    }
    let shared = |label: &String| entries.iter().filter(|entry| entry.label == *label).count() > 1;
    let labels: Vec<String> = entries
        .iter()
        .zip(paths)
        .map(|(entry, path)| {
            if shared(&entry.label) {
                path.display().to_string()
            } else {
                entry.label.clone()
            }
        })
        .collect();
    for (entry, label) in entries.iter_mut().zip(labels) {
        entry.label = label;
    }
    Ok(entries)
}

/// Returns the name of a result: its folder's, or that of a file without ending.
pub fn label(file: &Path) -> String {
    let own = file.file_stem();
    let folder = file.parent().and_then(Path::file_name);
    let name = match is_of_run(file) {
        true => folder.or(own),
        false => own,
    };
    name.map_or_else(
        || file.display().to_string(),
        |name| name.to_string_lossy().into_owned(),
    )
}

fn differences(comparison: &Comparison, entries: &[ComparedResult]) -> TerminalTable {
    let first = &entries[0].label;
    let mut table = TerminalTable::new(
        3,
        &[
            ("column", ""),
            ("unit", ""),
            ("result", ""),
            ("largest", ""),
            ("at", "s"),
            ("of range", "%"),
            ("RMS", ""),
            ("of range", "%"),
            ("mean", ""),
            ("mean of", first),
        ],
    );
    let percent = |value: f64, range: f64| {
        let part = 100.0 * value.abs() / range;
        match part.is_finite() {
            // The first hardly moves: the percentage says nothing else.
            true if part > 1e4 => "> 10000".to_owned(),
            true => format!("{part:.2}"),
            false => "-".to_owned(),
        }
    };
    for one in &comparison.differences {
        table.row([
            one.column.clone(),
            one.unit.to_owned(),
            entries[one.result].label.clone(),
            number(one.largest),
            format!("{:.3}", one.time),
            percent(one.largest, one.range),
            number(one.root_mean_square),
            percent(one.root_mean_square, one.range),
            number(one.mean),
            number(one.mean_of_first),
        ]);
    }
    table
}

fn energies(comparison: &Comparison, entries: &[ComparedResult]) -> TerminalTable {
    let first = &entries[0].label;
    let mut table = TerminalTable::new(
        3,
        &[
            ("friction energy per cycle", ""),
            ("unit", ""),
            ("result", ""),
            ("energy", ""),
            ("that of", first),
            ("difference", "%"),
        ],
    );
    for one in &comparison.energies {
        let part = 100.0 * (one.value - one.first) / one.first;
        table.row([
            one.place.replace('_', " "),
            one.unit.to_owned(),
            entries[one.result].label.clone(),
            number(one.value),
            number(one.first),
            if part.is_finite() {
                format!("{part:+.2}")
            } else {
                "-".to_owned()
            },
        ]);
    }
    table
}

/// Four digits, whatever the size.
fn number(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e6).contains(&size) {
        let decimals = (3 - size.log10().floor() as i32).clamp(0, 6) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.3e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_digits() {
        for (value, text) in [
            (0.0, "0"),
            (12345.678, "12346"),
            (-1.23456, "-1.235"),
            (0.0123456, "0.01235"),
            (1.5e-7, "1.500e-7"),
            (3.2e9, "3.200e9"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn results_are_named_by_their_folders() {
        assert_eq!(label(Path::new("runs/soft/result.csv")), "soft");
        assert_eq!(label(Path::new("result.csv")), "result");
        assert_eq!(label(Path::new("rig/day_2.csv")), "day_2");
    }
}
