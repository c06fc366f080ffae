//! `wedgelab plot`: any column over any other.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use report::plot;
use report::table::Table;

use super::compare::label;
use crate::adjust::Span;
use crate::drawn::png;
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;

/// Draw any column of a result over any other
///
/// Takes the result of a run (its folder or its result.csv) or another CSV file with columns such as time_s,
/// wedge_x_in, and writes an SVG or PNG file. Several columns with one unit share their axes; each unit has
/// its own.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab plot my_run --x time --y wedge_z
  wedgelab plot my_run --x bolster_vertical --y vertical_wedge_force --out loop.svg --from 2
  wedgelab plot my_run --x time --y column_upper_left_gap column_lower_left_gap")]
pub struct Arguments {
    /// Result: the folder of a run, or a CSV file
    result: PathBuf,
    /// Column along the horizontal axis, named with or without unit
    #[arg(long, value_name = "NAME")]
    x: String,
    /// Columns along the vertical axis
    #[arg(long, value_name = "NAME", num_args = 1.., required = true)]
    y: Vec<String>,
    #[command(flatten)]
    span: Span,
    /// File to write, ending in .svg or .png [default: Y_over_X.svg]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Overwrite an existing file
    #[arg(long)]
    force: bool,
}

/// Does it.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let mut table = Table::read(&arguments.result)?;
    arguments.span.apply(&mut table)?;
    let x = table.column(&arguments.x)?.name.clone();
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
    let Some((name, picture)) = drawn(&file) else {
        let message = format!(
            "`{}` is no name for a figure: figures are SVG or PNG",
            file.display()
        );
        let advice = format!("write --out {}", file.with_extension("svg").display());
        return Err(Message::new(message, advice).into());
    };
    let folder = match file.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let folder = folders::check(folder, &[name], arguments.force)?;
    let bytes = if picture {
        png(&figure)?
    } else {
        figure.to_svg().into_bytes()
    };
    folder.write(|files| files.add(name, |out| out.write_all(&bytes)))?;
    writeln!(io::stdout().lock(), "Written: {}.", file.display())?;
    Ok(ExitCode::SUCCESS)
}

/// The name of a file that can be drawn, and whether it is a picture (PNG) rather than a drawing (SVG).
fn drawn(file: &Path) -> Option<(&str, bool)> {
    let ending = file.extension()?.to_str()?.to_ascii_lowercase();
    let name = file.file_name()?.to_str()?;
    match ending.as_str() {
        "svg" => Some((name, false)),
        "png" => Some((name, true)),
        _ => None,
    }
}
