//! `wedgelab track`: the course of a track: curves, superelevation, grades and irregularities.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Subcommand};
use quantity::{Kind, Quantity};
use report::track_files::{self, NAMES, Survey, degree};
use study::track::TrackFile;

use crate::drawn::Drawn;
use crate::failure::{Failure, Message, say};
use crate::folders;
use crate::table::TerminalTable;

/// Tracks: curves, spirals, superelevation, grades and irregularities
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Show curvature and irregularities over the distance, with mid-chord offsets
    ///
    /// Reads a track file (docs/wheelrail.md) and writes track.csv (curvature, superelevation, grade, profile
    /// and alignment of both rails, cross level, gauge, mid-chord offsets of 31, 62 and 124 ft), track.svg
    /// and track.png.
    ///
    /// The `start` of joints is the distance of the first joint's lowest point: the rail falls towards it
    /// from half a spacing before. The `start` of a sine, dip or jog is that of its beginning.
    Show {
        /// Track file
        track: PathBuf,
        /// Distance between two rows
        #[arg(long, value_name = "LENGTH", default_value = "1 ft", value_parser = length)]
        interval: Quantity,
        /// Folder to write into [default: the track's name]
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// Overwrite existing results
        #[arg(long)]
        force: bool,
    },
}

fn length(text: &str) -> Result<Quantity, String> {
    let quantity = Quantity::parse_as(text, Kind::Length).map_err(|error| error.to_string())?;
    if quantity.to_si() >= 1e-3 {
        Ok(quantity)
    } else {
        Err("it must be 1 mm or more".to_owned())
    }
}

const INCH: f64 = 0.0254;
const FOOT: f64 = 0.3048;
/// More rows than these are not written.
const MOST_ROWS: f64 = 2e6;

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let Command::Show {
        track: path,
        interval,
        out,
        force,
    } = &arguments.command;
    let TrackFile {
        name,
        title,
        track,
        doubts,
        ..
    } = TrackFile::read(path)?;
    let interval = interval.to_si();
    let length = track.center_line.length();
    if length / interval > MOST_ROWS {
        let message = format!("{:.0} rows are more than {MOST_ROWS:e}", length / interval);
        return Err(Message::new(message, "choose a longer --interval").into());
    }
    let folder = folders::check(
        out.clone().unwrap_or_else(|| PathBuf::from(&name)),
        &NAMES,
        *force,
    )?;
    let survey = Survey::new(&track, interval);
    let figure = Drawn::of(&survey.figure(&name))?;
    folder.write(|files| {
        files.add(track_files::TABLE, |out| survey.write(out))?;
        figure.add(files, track_files::FIGURE, track_files::PICTURE)
    })?;
    for doubt in &doubts {
        say(&format!("warning: {name}: {doubt}"));
    }
    let sharpest = survey.sharpest();
    let mut out = io::stdout().lock();
    if !title.is_empty() {
        writeln!(out, "{title}")?;
    }
    let way = if sharpest > 0.0 { "left" } else { "right" };
    let curve = match sharpest {
        0.0 => "straight".to_owned(),
        _ => format!(
            "sharpest curve {:.2} deg to the {way}, radius {:.0} ft",
            degree(sharpest).abs(),
            1.0 / sharpest.abs() / FOOT
        ),
    };
    writeln!(
        out,
        "{:.0} ft, {curve}, {} irregularities\n",
        length / FOOT,
        track.irregularities.len()
    )?;
    let mut table = TerminalTable::new(
        1,
        &[
            ("largest mid-chord offset, in", ""),
            ("31 ft", "in"),
            ("at", "ft"),
            ("62 ft", "in"),
            ("at", "ft"),
            ("124 ft", "in"),
            ("at", "ft"),
        ],
    );
    for (measured, chords) in survey.largest() {
        let cells = chords.iter().flat_map(|largest| {
            [
                format!("{:.3}", largest.offset / INCH),
                format!("{:.0}", largest.at / FOOT),
            ]
        });
        table.row(std::iter::once(measured.name().replace('_', " ")).chain(cells));
    }
    table.write(&mut out)?;
    writeln!(
        out,
        "\nProfile: up; alignment: to the left; beside the curve of the track.\n\nWritten into {}: {}.",
        folder.path().display(),
        NAMES.join(", ")
    )?;
    Ok(ExitCode::SUCCESS)
}
