//! Results beside each other: differences from the first one, and overlay figures.
//!
//! Everything is in the units of the first result and at its times, as far as all results have them: the numbers of the
//! others are converted, and interpolated linearly between their own times (counts, such as contact states, keep the value of
//! the row before). Means and root mean squares are over these times, each counting the same. Figures show every
//! result at its own times.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use miette::Diagnostic;
use quantity::{Kind, System as Units, nearest};
use serde::Deserialize;
use study::summary::Measure;
use thiserror::Error;

use crate::drawing::Figure;
use crate::overlay::{self, Axes};
use crate::plot;
use crate::summary;
use crate::table::{Column, Table, TableError};

/// The columns that are compared if nothing else is asked for, as far as all results have them.
pub const MAIN: [&str; 15] = [
    "vertical_wedge_force",
    "vertical_force_on_side_frame",
    "longitudinal_wedge_force",
    "side_frame_dissipation",
    "bolster_dissipation",
    "side_frame_roll_moment",
    "side_frame_pitch_moment",
    "side_frame_yaw_moment",
    "coil_force",
    "coil_length",
    "wedge_x",
    "wedge_z",
    "wedge_pitch",
    "wedge_yaw",
    "bolster_vertical",
];

/// The name of the table of differences.
pub const FILE_NAME: &str = "differences.csv";
/// The name of the figure of the hysteresis loops.
pub const LOOP_FILE_NAME: &str = "hysteresis.svg";

const LOOP: [&str; 2] = ["bolster_vertical", "vertical_wedge_force"];

/// Why results cannot be compared.
#[derive(Debug, Error, Diagnostic)]
pub enum ComparisonError {
    /// A result has not the column.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Table(#[from] TableError),
    /// No column but the time is in all of them.
    #[error("`{}` and `{}` have no column in common but the time", .first.display(), .second.display())]
    #[diagnostic(help("{advice}"))]
    NothingInCommon {
        /// The first result.
        first: PathBuf,
        /// The one that shares nothing with it, or with those in between.
        second: PathBuf,
        /// Names that are near each other.
        advice: String,
    },
    /// Two columns of one name measure different things.
    #[error("`{column}` is {own} in `{}` and {other} in `{}`", .first.display(), .second.display())]
    #[diagnostic(help("rename one of the two, or leave the column out with --columns"))]
    Kinds {
        /// The column.
        column: String,
        /// The first result.
        first: PathBuf,
        /// What it is there.
        own: &'static str,
        /// The other.
        second: PathBuf,
        /// What it is there.
        other: &'static str,
    },
    /// The time was asked for as a column.
    #[error("columns are compared at the same times; the time itself cannot be compared")]
    #[diagnostic(help("name other columns, such as vertical_wedge_force"))]
    Time,
    /// There are not two times within the span that all have.
    #[error("the results have no span of time in common: {spans}")]
    #[diagnostic(help("results are compared at equal times: run the cases over the same times"))]
    NoCommonTime {
        /// From when to when each of them goes.
        spans: String,
    },
}

/// A result with its name in figures and tables.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Its name.
    pub label: String,
    /// Its table.
    pub table: Table,
}

/// How a column of one result differs from the first result's, in the first one's units.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The column, without unit.
    pub column: String,
    /// Its unit as shown; empty for pure numbers.
    pub unit: &'static str,
    /// Which result, by its place among the entries.
    pub result: usize,
    /// The largest difference in size, this result less the first.
    pub largest: f64,
    /// When it is the largest, s.
    pub time: f64,
    /// Root mean square of the difference.
    pub root_mean_square: f64,
    /// Greatest less least value of the first result.
    pub range: f64,
    /// Mean of this result.
    pub mean: f64,
    /// Mean of the first result.
    pub mean_of_first: f64,
}

/// Friction energy per cycle, from the summaries, in the first result's units.
#[derive(Clone, Debug, PartialEq)]
pub struct Energy {
    /// Where: `side_frame` or `bolster`.
    pub place: String,
    /// Its unit as shown.
    pub unit: &'static str,
    /// Which result, by its place among the entries.
    pub result: usize,
    /// Of this result.
    pub value: f64,
    /// Of the first one.
    pub first: f64,
}

/// What came out of comparing results with the first one.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Units of all numbers: the first result's.
    pub units: Units,
    /// The span of time that all have, s.
    pub span: (f64, f64),
    /// The first result's rows within it.
    pub rows: usize,
    /// What was converted, interpolated or left out, in words.
    pub notes: Vec<String>,
    /// The columns compared, without units.
    pub columns: Vec<String>,
    /// The differences, by column and result.
    pub differences: Vec<Difference>,
    /// The energies per cycle, where the summaries have them.
    pub energies: Vec<Energy>,
}

impl Comparison {
    /// Compares results with the first of them; `columns` chooses, empty: the main ones that all have, else all that all
    /// have.
    ///
    /// # Errors
    /// See [`ComparisonError`].
    pub fn of(entries: &[Entry], columns: &[String]) -> Result<Self, ComparisonError> {
        let Some((first, others)) = entries.split_first() else {
            return Err(ComparisonError::NoCommonTime {
                spans: "there are no results".to_owned(),
            });
        };
        let mut notes = Vec::new();
        let columns = choose(first, others, columns, &mut notes)?;
        let span = common_span(entries)?;
        let within = |time: &f64| *time >= span.0 && *time <= span.1;
        let times: Vec<f64> = first.table.times().iter().copied().filter(within).collect();
        notes.extend(differing(first, others, &times, span));
        let units = first.table.units;
        let mut differences = Vec::new();
        for name in &columns {
            let own = first.table.column(name)?;
            let own_values = sampled(&first.table, own, units, &times);
            for (k, other) in others.iter().enumerate() {
                let values = sampled(&other.table, other.table.column(name)?, units, &times);
                differences.push(difference(own, units, k + 1, &times, &own_values, &values));
            }
        }
        Ok(Self {
            units,
            span,
            rows: times.len(),
            energies: energies(entries, units, &mut notes),
            notes,
            columns,
            differences,
        })
    }

    /// The figures with their file names: one a column, over time, and the hysteresis loops.
    ///
    /// # Errors
    /// A column is missing: the entries are not those that were compared.
    pub fn figures(&self, entries: &[Entry]) -> Result<Vec<(String, Figure)>, ComparisonError> {
        let mut figures: Vec<(String, Figure)> = Vec::new();
        let free = |file: &str, figures: &[(String, Figure)]| {
            let taken = |other: &str| other.to_lowercase() == file.to_lowercase();
            !taken(LOOP_FILE_NAME) && !figures.iter().any(|(other, _)| taken(other))
        };
        for name in &self.columns {
            let title = format!("Comparison: {}", overlay::words(name));
            let mut file = format!("{}.svg", plot::file_name(name));
            while !free(&file, &figures) {
                file.insert(0, '_');
            }
            figures.push((file, self.overlay(entries, title, "time", name)?));
        }
        let [x, y] = LOOP;
        let all_have = entries.iter().all(|entry| entry.table.find(x).is_some());
        if all_have && self.columns.iter().any(|name| name == y) {
            let title = "Comparison: vertical wedge force over bolster displacement".to_owned();
            figures.push((LOOP_FILE_NAME.to_owned(), self.overlay(entries, title, x, y)?));
        }
        Ok(figures)
    }

    fn overlay(&self, entries: &[Entry], title: String, x: &str, y: &str) -> Result<Figure, ComparisonError> {
        let mut axes = Axes {
            x_label: String::new(),
            y_label: String::new(),
            curves: Vec::new(),
        };
        for entry in entries {
            let (abscissa, ordinate) = (entry.table.column(x)?, entry.table.column(y)?);
            if axes.curves.is_empty() {
                axes.x_label = overlay::axis(abscissa, self.units);
                axes.y_label = overlay::axis(ordinate, self.units);
            }
            let values = abscissa
                .in_units(self.units)
                .into_iter()
                .zip(ordinate.in_units(self.units));
            let timed = entry.table.times().iter().zip(values);
            let within = timed.filter(|(time, _)| **time >= self.span.0 && **time <= self.span.1);
            axes.curves
                .push((entry.label.clone(), within.map(|(_, point)| point).collect()));
        }
        let labels: Vec<&str> = entries.iter().map(|entry| entry.label.as_str()).collect();
        let caption = format!(
            "{} over {} of the results {}, each at its own output times, from {} s to {} s.",
            overlay::words(y),
            overlay::words(x),
            labels.join(", "),
            self.span.0,
            self.span.1
        );
        Ok(overlay::figure(title, caption, vec![axes]))
    }

    /// Writes the table of differences. Differences are *result* less *compared_with*; relative ones are fractions of
    /// `range`, which is the first result's. Energies per cycle stand in the same columns as far as these apply.
    ///
    /// # Errors
    /// The writer's.
    pub fn write(&self, entries: &[Entry], out: &mut dyn Write) -> io::Result<()> {
        let mut table = ::csv::Writer::from_writer(out);
        table.write_record([
            "column",
            "unit",
            "result",
            "compared_with",
            "largest_difference",
            "time_s",
            "largest_relative",
            "rms_difference",
            "rms_relative",
            "range",
            "mean",
            "mean_of_compared_with",
        ])?;
        let label = |index: usize| entries.get(index).map_or("", |entry| entry.label.as_str());
        let number = |value: f64| {
            if value.is_finite() {
                value.to_string()
            } else {
                String::new()
            }
        };
        for one in &self.differences {
            table.write_record([
                &one.column,
                one.unit,
                label(one.result),
                label(0),
                &number(one.largest),
                &number(one.time),
                &number(one.largest.abs() / one.range),
                &number(one.root_mean_square),
                &number(one.root_mean_square / one.range),
                &number(one.range),
                &number(one.mean),
                &number(one.mean_of_first),
            ])?;
        }
        for one in &self.energies {
            table.write_record([
                &format!("energy_per_cycle_{}", one.place),
                one.unit,
                label(one.result),
                label(0),
                &number(one.value - one.first),
                "",
                "",
                "",
                "",
                "",
                &number(one.value),
                &number(one.first),
            ])?;
        }
        table.flush()
    }
}

/// The columns to compare, without units.
fn choose(
    first: &Entry,
    others: &[Entry],
    wanted: &[String],
    notes: &mut Vec<String>,
) -> Result<Vec<String>, ComparisonError> {
    let clash = |own: &Column, other: &Entry| {
        let theirs = other.table.find(&own.name)?;
        (theirs.kind.dimension() != own.kind.dimension()).then(|| ComparisonError::Kinds {
            column: own.name.clone(),
            first: first.table.file.clone(),
            own: own.kind.name(),
            second: other.table.file.clone(),
            other: theirs.kind.name(),
        })
    };
    if !wanted.is_empty() {
        let mut chosen: Vec<String> = Vec::new();
        for name in wanted {
            let own = first.table.column(name)?;
            if own.name == "time" {
                return Err(ComparisonError::Time);
            }
            for other in others {
                other.table.column(&own.name)?;
                if let Some(error) = clash(own, other) {
                    return Err(error);
                }
            }
            if !chosen.contains(&own.name) {
                chosen.push(own.name.clone());
            }
        }
        return Ok(chosen);
    }
    let mut common: Vec<&Column> = first
        .table
        .columns()
        .iter()
        .filter(|own| own.name != "time")
        .collect();
    for other in others {
        let before = common.clone();
        common.retain(|own| other.table.find(&own.name).is_some());
        if common.is_empty() {
            return Err(nothing_in_common(first, other, &before));
        }
        common.retain(|own| match clash(own, other) {
            None => true,
            Some(error) => {
                notes.push(format!("{error}; it is left out."));
                false
            }
        });
    }
    let main: Vec<String> = MAIN
        .iter()
        .filter(|name| common.iter().any(|own| own.name == **name))
        .map(|name| (*name).to_owned())
        .collect();
    if main.is_empty() {
        return Ok(common.into_iter().map(|own| own.name.clone()).collect());
    }
    Ok(main)
}

/// The error, with names that may be meant to be the same.
fn nothing_in_common(first: &Entry, other: &Entry, own: &[&Column]) -> ComparisonError {
    const MOST: usize = 3;
    let theirs = || {
        let names = other.table.columns().iter().map(|column| column.name.as_str());
        names.filter(|name| *name != "time")
    };
    let near: Vec<String> = own
        .iter()
        .filter_map(|own| Some(format!("`{}` and `{}`", own.name, nearest(&own.name, theirs())?)))
        .take(MOST)
        .collect();
    let advice = if near.is_empty() {
        let list = theirs().take(MOST).collect::<Vec<&str>>().join(", ");
        format!("the columns of the second are {list} ...; name them as docs/summary.md does")
    } else {
        format!("near each other are {}: give them the same name", near.join(", "))
    };
    ComparisonError::NothingInCommon {
        first: first.table.file.clone(),
        second: other.table.file.clone(),
        advice,
    }
}

/// First and last time of a table.
fn ends(table: &Table) -> (f64, f64) {
    let times = table.times();
    (
        times.first().copied().unwrap_or(f64::NAN),
        times.last().copied().unwrap_or(f64::NAN),
    )
}

fn common_span(entries: &[Entry]) -> Result<(f64, f64), ComparisonError> {
    let span = entries
        .iter()
        .map(|entry| ends(&entry.table))
        .fold((f64::NEG_INFINITY, f64::INFINITY), |(start, end), own| {
            (start.max(own.0), end.min(own.1))
        });
    let times = entries.first().map_or(&[][..], |first| first.table.times());
    let within = times.iter().filter(|time| **time >= span.0 && **time <= span.1);
    if within.count() >= 2 {
        return Ok(span);
    }
    let spans: Vec<String> = entries
        .iter()
        .map(|entry| {
            let (start, end) = ends(&entry.table);
            format!("{} goes from {start} s to {end} s", entry.label)
        })
        .collect();
    Err(ComparisonError::NoCommonTime {
        spans: spans.join(", "),
    })
}

/// What is said about spans, units and times that are not the same.
fn differing(first: &Entry, others: &[Entry], times: &[f64], span: (f64, f64)) -> Vec<String> {
    let mut notes = Vec::new();
    let all = std::iter::once(first).chain(others);
    if all.into_iter().any(|entry| ends(&entry.table) != span) {
        notes.push(format!(
            "Compared from {} s to {} s, which all of them have.",
            span.0, span.1
        ));
    }
    for other in others {
        if other.table.units != first.table.units {
            notes.push(format!(
                "{} is in {} units; its numbers are converted to those of {}, {}.",
                other.label,
                words_of(other.table.units),
                first.label,
                words_of(first.table.units)
            ));
        }
        let within = other
            .table
            .times()
            .iter()
            .filter(|time| **time >= span.0 && **time <= span.1);
        let own: Vec<f64> = within.copied().collect();
        // Decimal times of two programs may differ in their last digits.
        let close = 1e-9 * (span.1 - span.0);
        let same = own.len() == times.len() && own.iter().zip(times).all(|(a, b)| (a - b).abs() <= close);
        if !same {
            notes.push(format!(
                "{} has {} rows in this span, {} has {}: it is interpolated linearly to the times of {}.",
                other.label,
                own.len(),
                first.label,
                times.len(),
                first.label
            ));
        }
    }
    notes
}

fn words_of(units: Units) -> &'static str {
    match units {
        Units::Us => "US customary",
        Units::Si => "SI",
    }
}

/// A column's values in these units at these times, all of them within the table's span.
fn sampled(table: &Table, column: &Column, units: Units, times: &[f64]) -> Vec<f64> {
    let own = table.times();
    let values = column.in_units(units);
    let at = |time: &f64| {
        let after = own.partition_point(|own| own <= time);
        let before = after.saturating_sub(1);
        if own[before] == *time || after == own.len() || column.kind == Kind::Count {
            return values[before];
        }
        let part = (time - own[before]) / (own[after] - own[before]);
        values[before] + part * (values[after] - values[before])
    };
    times.iter().map(at).collect()
}

fn difference(
    column: &Column,
    units: Units,
    result: usize,
    times: &[f64],
    first: &[f64],
    other: &[f64],
) -> Difference {
    let count = times.len() as f64;
    let mean = |values: &[f64]| values.iter().sum::<f64>() / count;
    let (least, greatest) = first
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(*value), high.max(*value))
        });
    let (mut largest, mut time, mut squares) = (0.0_f64, times.first().copied().unwrap_or(0.0), 0.0);
    for ((own, other), now) in first.iter().zip(other).zip(times) {
        let difference = other - own;
        squares += difference * difference;
        if difference.abs() > largest.abs() {
            (largest, time) = (difference, *now);
        }
    }
    Difference {
        column: column.name.clone(),
        unit: column.kind.label(units),
        result,
        largest,
        time,
        root_mean_square: (squares / count).sqrt(),
        range: greatest - least,
        mean: mean(other),
        mean_of_first: mean(first),
    }
}

/// What is wanted of a summary.
#[derive(Deserialize)]
struct SummaryPart {
    averages: AveragesPart,
}

#[derive(Deserialize)]
struct AveragesPart {
    energy_per_cycle: std::collections::BTreeMap<String, Measure>,
}

/// Energies per cycle of the results whose summaries have them, as the first one's has.
fn energies(entries: &[Entry], units: Units, notes: &mut Vec<String>) -> Vec<Energy> {
    let mut read = entries
        .iter()
        .map(|entry| match summary_beside(&entry.table.file) {
            Ok(found) => found.map(|part| part.averages.energy_per_cycle),
            Err(error) => {
                let label = &entry.label;
                notes.push(format!(
                    "The summary.json of {label} is left out, it cannot be read: {error}."
                ));
                None
            }
        });
    let first = read.next().flatten().unwrap_or_default();
    let others: Vec<_> = read.collect();
    let mut energies = Vec::new();
    for (place, own) in &first {
        for (k, other) in others.iter().enumerate() {
            let theirs = other.as_ref().and_then(|all| all.get(place));
            if let (Some(first), Some(value)) =
                (energy(own, units), theirs.and_then(|one| energy(one, units)))
            {
                energies.push(Energy {
                    place: place.clone(),
                    unit: Kind::Energy.label(units),
                    result: k + 1,
                    value,
                    first,
                });
            }
        }
    }
    energies
}

/// The summary beside a `result.csv`, if there is one.
fn summary_beside(file: &Path) -> Result<Option<SummaryPart>, String> {
    if file.file_name().is_none_or(|name| name != crate::csv::FILE_NAME) {
        return Ok(None);
    }
    match fs::read(file.with_file_name(summary::FILE_NAME)) {
        Ok(bytes) => serde_json::from_slice(&bytes)
            .map(Some)
            .map_err(|error| error.to_string()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error.to_string()),
    }
}

/// An energy in these units.
fn energy(measure: &Measure, units: Units) -> Option<f64> {
    let own = [Units::Us, Units::Si]
        .into_iter()
        .find(|own| Kind::Energy.label(*own) == measure.unit)?;
    if own == units {
        return Some(measure.value);
    }
    Some(measure.value / Kind::Energy.from_si(own) * Kind::Energy.from_si(units))
}
