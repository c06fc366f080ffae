//! `wedgelab track`: the course of a track: curves, superelevation, grades and irregularities.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Subcommand};
use quantity::{Kind, Quantity};
use report::drawn::Drawn;
use report::terminal::TerminalTable;
use report::track_class;
use report::track_files::{self, NAMES, Survey, degree};
use study::track::TrackFile;
use study::track::bands::BANDS;
use wheelrail::track::TrackClass;

use crate::failure::{Failure, Message, say};
use crate::folders;

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
    /// and track.png. Prints the largest offsets, the worst values of 49 CFR 213 beside the limits of the
    /// track's class (`class = 4` in the file) with the class that the geometry gets, and the standard
    /// deviations of waves by bands.
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
        class,
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
    by_class(&mut out, &TrackClass::of(&track, interval), class)?;
    by_bands(&mut out, &survey)?;
    writeln!(
        out,
        "\nProfile: up; alignment: to the left; beside the curve of the track.\n\nWritten into {}: {}.",
        folder.path().display(),
        NAMES.join(", ")
    )?;
    Ok(ExitCode::SUCCESS)
}

/// Writes the worst values beside the limits of a class, and the class that the geometry gets.
fn by_class(out: &mut impl Write, found: &TrackClass, stated: Option<usize>) -> io::Result<()> {
    let compared = stated.unwrap_or(found.class().max(1));
    let limit = format!("limit of class {compared}");
    let mut table = TerminalTable::new(
        1,
        &[
            ("worst value, in", ""),
            ("value", "in"),
            (&limit, "in"),
            ("at", "ft"),
            ("keeps class", ""),
            ("limits", ""),
        ],
    );
    for row in track_class::rows(found, compared) {
        table.row([
            row.name,
            row.value,
            row.limit,
            row.at,
            row.class,
            row.mark.to_owned(),
        ]);
    }
    writeln!(out)?;
    table.write(out)?;
    writeln!(out, "\n{}", track_class::verdict(found, stated))?;
    writeln!(
        out,
        "Speeds, curves and what else a class asks for are not examined; docs/wheelrail.md lists what is."
    )
}

/// Writes standard deviations by bands of wavelengths, of tracks with irregularities.
fn by_bands(out: &mut impl Write, survey: &Survey<'_>) -> io::Result<()> {
    let found = survey.bands();
    let some = found
        .iter()
        .flat_map(|(_, bands)| bands)
        .flatten()
        .any(|own| own.whole > 0.0);
    if !some {
        return Ok(());
    }
    let titles = BANDS.map(|band| {
        format!(
            "{}, {} to {} m",
            band.name, band.wavelengths[0], band.wavelengths[1]
        )
    });
    let mut columns = vec![("standard deviation, in", "")];
    for title in &titles {
        columns.extend([(title.as_str(), "in"), ("worst 200 m", "in"), ("at", "ft")]);
    }
    let mut table = TerminalTable::new(1, &columns);
    for (measured, bands) in found {
        let cells = bands.iter().flat_map(|own| match own {
            Some(own) => [
                format!("{:.4}", own.whole / INCH),
                format!("{:.4}", own.worst[0] / INCH),
                format!("{:.0}", own.worst[1] / FOOT),
            ],
            None => ["rows too far apart".to_owned(), String::new(), String::new()],
        });
        table.row(std::iter::once(measured.name().replace('_', " ")).chain(cells));
    }
    writeln!(out)?;
    table.write(out)
}
