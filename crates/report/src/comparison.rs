//! Results beside each other: differences from the first one, and overlay figures.
//!
//! Everything is in the units of the first result and at its times, as far as all results have them: the
//! numbers of the others are converted, and interpolated linearly between their own times (counts, such as
//! contact states, keep the value of the row before). Means and root mean squares are over these times, each
//! counting the same. Figures show every result at its own times.

use std::io::{self, Write};

use quantity::{Kind, System as Units};

use crate::output_table::OutputTable;
use crate::overlay::{self, Axes};
use crate::plot;
use crate::table::{ResultTable, TableColumn};
use choose::choose;
use drawing::Figure;
use energies::{SummaryPart, energies, summaries};
pub use error::ComparisonError;

mod choose;
mod energies;
mod error;
pub mod section_files;
pub mod sections;

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

/// A result with its name in figures and tables.
#[derive(Clone, Debug)]
pub struct ComparedResult {
    /// Its name.
    pub label: String,
    /// Its table.
    pub table: ResultTable,
}

/// The difference of a column of one result from the first result's, in the first one's units.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The column, without unit.
    pub column: String,
    /// Its unit as shown; empty for pure numbers.
    pub unit: &'static str,
    /// The result, by its place among the entries.
    pub result: usize,
    /// The largest difference in size, this result less the first.
    pub largest: f64,
    /// Its time, s.
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

impl Difference {
    /// Returns whether none of its numbers has overflowed.
    fn is_finite(&self) -> bool {
        let numbers = [
            self.largest,
            self.time,
            self.root_mean_square,
            self.range,
            self.mean,
            self.mean_of_first,
        ];
        numbers.iter().all(|number| number.is_finite())
    }
}

/// Friction energy per cycle, from the summaries, in the first result's units.
#[derive(Clone, Debug, PartialEq)]
pub struct Energy {
    /// The body: `side_frame` or `bolster`.
    pub place: String,
    /// Its unit as shown.
    pub unit: &'static str,
    /// The result, by its place among the entries.
    pub result: usize,
    /// Of this result.
    pub value: f64,
    /// Of the first one.
    pub first: f64,
}

/// The outcome of comparing results with the first one.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Units of all numbers: the first result's.
    pub units: Units,
    /// The span of time that all have, s.
    pub span: (f64, f64),
    /// The first result's rows within it.
    pub rows: usize,
    /// Conversions, interpolations and omissions, in words.
    pub notes: Vec<String>,
    /// The columns compared, without units.
    pub columns: Vec<String>,
    /// The differences, by column and result.
    pub differences: Vec<Difference>,
    /// The energies per cycle, where the summaries have them.
    pub energies: Vec<Energy>,
}

impl Comparison {
    /// Compares results with the first of them; `columns` chooses, empty: the main ones that all have, else
    /// all that all have, if they are runs of one model.
    ///
    /// # Errors
    /// See [`ComparisonError`].
    pub fn of(entries: &[ComparedResult], columns: &[String]) -> Result<Self, ComparisonError> {
        let Some((first, others)) = entries.split_first() else {
            return Err(ComparisonError::NoCommonTime {
                spans: "there are no results".to_owned(),
            });
        };
        let mut notes = Vec::new();
        let summaries = summaries(entries, &mut notes);
        let models: Vec<_> = summaries.iter().map(SummaryPart::model).collect();
        let columns = choose(entries, &models, columns, &mut notes)?;
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
                let found = difference(own, units, k + 1, &times, &own_values, &values);
                if !found.is_finite() {
                    return Err(ComparisonError::NotFinite {
                        column: name.clone(),
                        result: other.label.clone(),
                    });
                }
                differences.push(found);
            }
        }
        Ok(Self {
            units,
            span,
            rows: times.len(),
            energies: energies(&summaries, units),
            notes,
            columns,
            differences,
        })
    }

    /// Returns the figures with their file names: one a column, over time, and the hysteresis loops.
    ///
    /// # Errors
    /// A column is missing: the entries are not those that were compared.
    pub fn figures(&self, entries: &[ComparedResult]) -> Result<Vec<(String, Figure)>, ComparisonError> {
        let mut figures: Vec<(String, Figure)> = Vec::new();
        for name in &self.columns {
            let title = format!("Comparison: {}", overlay::words(name));
            let file = free_name(format!("{}.svg", plot::file_name(name)), &figures);
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

    fn overlay(
        &self,
        entries: &[ComparedResult],
        title: String,
        x: &str,
        y: &str,
    ) -> Result<Figure, ComparisonError> {
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

    /// Writes the table of differences. Differences are *result* less *compared_with*; relative ones are
    /// fractions of `range`, which is the first result's. Energies per cycle stand in the same columns as far
    /// as these apply.
    ///
    /// # Errors
    /// The writer's.
    pub fn write(&self, entries: &[ComparedResult], out: &mut dyn Write) -> io::Result<()> {
        let differences = self.differences.iter().map(|own| {
            let Difference {
                largest, time, range, ..
            } = *own;
            let square = own.root_mean_square;
            let relative = [largest.abs() / range, square, square / range, range];
            let numbers = [&[largest, time][..], &relative, &[own.mean, own.mean_of_first]].concat();
            (own.column.clone(), own.unit, own.result, numbers)
        });
        let energies = self.energies.iter().map(|own| {
            let mut numbers = vec![own.value - own.first];
            numbers.extend([f64::NAN; 5]);
            numbers.extend([own.value, own.first]);
            (
                format!("energy_per_cycle_{}", own.place),
                own.unit,
                own.result,
                numbers,
            )
        });
        let label = |index: usize| entries.get(index).map_or("", |entry| entry.label.as_str());
        let mut table = OutputTable::new(differences.chain(energies), self.units);
        table.text("column", |(column, ..)| column);
        table.text("unit", |(_, unit, ..)| unit);
        table.text("result", move |(_, _, result, _)| label(*result));
        table.text("compared_with", move |_| label(0));
        let names = [
            "largest_difference",
            "time_s",
            "largest_relative",
            "rms_difference",
            "rms_relative",
            "range",
            "mean",
            "mean_of_compared_with",
        ];
        for (place, name) in names.into_iter().enumerate() {
            table.number(name, Kind::Count, move |(.., numbers)| numbers[place]);
        }
        table.write_csv(out)
    }
}

/// Returns a file name that none of the figures has, nor the figure of the loops.
fn free_name(mut file: String, figures: &[(String, Figure)]) -> String {
    let taken = |file: &str| {
        let mut names = figures
            .iter()
            .map(|(other, _)| other.as_str())
            .chain([LOOP_FILE_NAME]);
        names.any(|other| other.to_lowercase() == file.to_lowercase())
    };
    while taken(&file) {
        file.insert(0, '_');
    }
    file
}

/// First and last time of a table.
fn ends(table: &ResultTable) -> (f64, f64) {
    let times = table.times();
    (
        times.first().copied().unwrap_or(f64::NAN),
        times.last().copied().unwrap_or(f64::NAN),
    )
}

fn common_span(entries: &[ComparedResult]) -> Result<(f64, f64), ComparisonError> {
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

/// Returns remarks about spans, units and times that are not the same.
fn differing(
    first: &ComparedResult,
    others: &[ComparedResult],
    times: &[f64],
    span: (f64, f64),
) -> Vec<String> {
    let mut notes = Vec::new();
    let all = std::iter::once(first).chain(others);
    if all.into_iter().any(|entry| ends(&entry.table) != span) {
        notes.push(format!(
            "Compared from {} s to {} s, which all of them have.",
            span.0, span.1
        ));
    }
    for other in others {
        notes.extend(conversion(first, other));
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

/// Returns the remark about the units of a result that are not the first one's.
fn conversion(first: &ComparedResult, other: &ComparedResult) -> Option<String> {
    (other.table.units != first.table.units).then(|| {
        format!(
            "{} is in {} units; its numbers are converted to those of {}, {}.",
            other.label,
            words_of(other.table.units),
            first.label,
            words_of(first.table.units)
        )
    })
}

fn words_of(units: Units) -> &'static str {
    match units {
        Units::Us => "US customary",
        Units::Si => "SI",
    }
}

/// Returns a column's values in these units at these times, all of them within the table's span.
fn sampled(table: &ResultTable, column: &TableColumn, units: Units, times: &[f64]) -> Vec<f64> {
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
    column: &TableColumn,
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
