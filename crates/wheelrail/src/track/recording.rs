//! The text of a measured table: its titles, signs and rows.

use std::path::Path;

use input::file::Expected;
use input::{CellError, FileType, Separated, limits, shortened};

use super::columns::{ColumnKind, Head, NamedColumn, TrackColumn, head, is_place, name_of, signs_of};
use super::gaps;
use super::measured_error::MeasuredError;
use super::stations::{self, MILE, PlaceKind, Running, StationEquation};

/// Nominal gauge of a column `gauge`, m: 56.5 in.
const NOMINAL_GAUGE: f64 = 56.5 * 0.0254;
/// Largest number of a table, in SI units: 10,000 km.
const LARGEST: f64 = 1e7;

/// What the caller knows of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// There is no sign row, and signs are the first ones of each quantity.
    pub signs_known: bool,
    /// Length up to which gaps are filled, m.
    pub longest_gap: f64,
    /// The columns by their own titles. If there is one, no other column is read, and there is no sign row.
    pub columns: Vec<NamedColumn>,
    /// The direction in which the track is run.
    pub running: Running,
    /// Readings that are one place.
    pub equations: Vec<StationEquation>,
}

impl Default for Reading {
    /// Nothing is known: titles and signs are in the table, readings rise.
    fn default() -> Self {
        Self {
            signs_known: false,
            longest_gap: gaps::LONGEST_GAP,
            columns: Vec::new(),
            running: Running::Rising,
            equations: Vec::new(),
        }
    }
}

/// The values of a column, row by row.
#[derive(Debug)]
pub(super) struct Values {
    pub what: TrackColumn,
    pub kind: ColumnKind,
    /// In SI units, with the signs of this crate; NaN where the recording has none.
    pub values: Vec<f64>,
}

/// The rows of a table.
#[derive(Debug)]
pub(super) struct Recording {
    /// The distance of each row, m: they rise.
    pub distances: Vec<f64>,
    pub columns: Vec<Values>,
    /// The line of each row, from 1.
    pub lines: Vec<usize>,
}

/// Returns the text of a file.
pub(super) fn text_of(path: &Path) -> Result<String, MeasuredError> {
    let expected = Expected {
        what: "table of track",
        types: &[FileType::MeasuredTrack],
        most: limits::TEXT_FILE,
    };
    Ok(input::file::read_text(path, &expected)?)
}

/// Returns the rows of a text; `name` is what messages call it.
pub(super) fn parse(name: &str, text: &str, reading: &Reading) -> Result<Recording, MeasuredError> {
    let wrong = |line: usize, found: String, remedy: &str| MeasuredError::Line {
        name: name.to_owned(),
        line,
        found,
        remedy: remedy.to_owned(),
    };
    let mut lines = text
        .lines()
        .enumerate()
        .map(|(index, line)| (index + 1, line))
        .filter(|(_, line)| {
            let line = line.trim();
            !line.is_empty() && !line.starts_with('#')
        });
    let Some((header_line, header)) = lines.next() else {
        return Err(wrong(1, "there is no header".into(), HEADER));
    };
    let mut written = Separated::of(header);
    let titles: Vec<&str> = written.cells(header).collect();
    let mut heads = heads_of(&titles, &reading.columns).map_err(|found| wrong(header_line, found, HEADER))?;
    if !reading.signs_known && reading.columns.is_empty() {
        let (number, row) = lines
            .next()
            .ok_or_else(|| wrong(header_line + 1, "there is no sign row".into(), SIGNS))?;
        let cells: Vec<&str> = written.cells(row).collect();
        for head in &mut heads {
            let cell = cells.get(head.index).copied().unwrap_or("");
            head.factor *= sign(head.column, cell).map_err(|found| wrong(number, found, SIGNS))?;
        }
    }
    let place = places_of(&heads).map_err(|found| wrong(header_line, found, HEADER))?;
    let mut columns: Vec<Vec<f64>> = heads.iter().map(|_| Vec::new()).collect();
    let mut rows = Vec::new();
    for (number, line) in lines {
        if let Some(found) = written.surplus(line, titles.len()) {
            return Err(wrong(number, found, "write a cell for each title"));
        }
        let cells: Vec<&str> = written.cells(line).collect();
        if rows.len() == limits::TABLE_ROWS {
            let found = format!("there are more than {} rows", limits::TABLE_ROWS);
            return Err(wrong(number, found, "divide the track"));
        }
        for (head, values) in heads.iter().zip(&mut columns) {
            let cell = cells.get(head.index).copied().unwrap_or("");
            let value = match number_of(&mut written, head, cell) {
                Ok(value) if value.abs() <= LARGEST => value,
                Ok(value) => {
                    let found = format!(
                        "{} is too large, under {}",
                        value / head.factor,
                        name_of(head.column)
                    );
                    return Err(wrong(number, found, "look at the unit of the column"));
                }
                Err(CellError::Gap) if !is_place(head.column) => f64::NAN,
                Err(error) => {
                    let found = format!("{error}, under {}", name_of(head.column));
                    return Err(wrong(number, found, error.remedy()));
                }
            };
            values.push(value);
        }
        rows.push(number);
    }
    let mut readings = std::mem::take(&mut columns[place.column]);
    if let Some(beyond) = place.beyond {
        for (own, beyond) in readings.iter_mut().zip(&columns[beyond]) {
            *own += beyond;
        }
    }
    let along = stations::along(&readings, place.kind, reading.running, &reading.equations);
    let (distances, turned_round) = along.map_err(|step| {
        let line = rows.get(step.row).copied().unwrap_or(header_line);
        wrong(line, step.found, &step.remedy)
    })?;
    let mut found = Vec::new();
    for (head, mut values) in heads.into_iter().zip(columns) {
        if is_place(head.column) {
            continue;
        }
        if head.column == TrackColumn::Gauge && !matches!(head.kind, ColumnKind::MidChord(_)) {
            // The sign of a gauge is that of its deviation.
            values
                .iter_mut()
                .for_each(|value| *value = value.abs() - NOMINAL_GAUGE);
        }
        let mut column = Values {
            what: head.column,
            kind: head.kind,
            values,
        };
        if reading.running == Running::Falling {
            column.exchange_sides();
        }
        if turned_round {
            column.values.reverse();
        }
        found.push(column);
    }
    if turned_round {
        rows.reverse();
    }
    Ok(Recording {
        distances,
        columns: found,
        lines: rows,
    })
}

impl Values {
    /// Turns the values to those of someone who looks the other way along the track.
    fn exchange_sides(&mut self) {
        let (what, sign) = match self.what {
            TrackColumn::LeftProfile => (TrackColumn::RightProfile, 1.0),
            TrackColumn::RightProfile => (TrackColumn::LeftProfile, 1.0),
            TrackColumn::LeftAlignment => (TrackColumn::RightAlignment, -1.0),
            TrackColumn::RightAlignment => (TrackColumn::LeftAlignment, -1.0),
            own @ (TrackColumn::Alignment
            | TrackColumn::CrossLevel
            | TrackColumn::Superelevation
            | TrackColumn::Curvature
            | TrackColumn::DegreeOfCurve
            | TrackColumn::Grade) => (own, -1.0),
            own => (own, 1.0),
        };
        self.what = what;
        if sign < 0.0 {
            self.values.iter_mut().for_each(|value| *value = -*value);
        }
    }
}

/// Returns the columns of the titles: the named ones, or those whose titles are known.
fn heads_of(titles: &[&str], named: &[NamedColumn]) -> Result<Vec<Head>, String> {
    if !named.is_empty() {
        return named.iter().map(|column| column.among(titles)).collect();
    }
    let mut heads = Vec::new();
    for (index, cell) in titles.iter().enumerate() {
        heads.extend(head(index, cell)?);
    }
    if heads.iter().any(|own| own.column == TrackColumn::Distance) {
        heads.retain(|own| own.column == TrackColumn::Distance || !is_place(own.column));
    }
    Ok(heads)
}

/// The columns that say where a row lies.
struct Places {
    column: usize,
    beyond: Option<usize>,
    kind: PlaceKind,
}

fn places_of(heads: &[Head]) -> Result<Places, String> {
    let find = |column| heads.iter().position(|head| head.column == column);
    let [distance, milepost, beyond] = [
        TrackColumn::Distance,
        TrackColumn::Milepost,
        TrackColumn::MilepostOffset,
    ]
    .map(find);
    match (distance, milepost) {
        (Some(_), Some(_)) => Err("there are both a distance and a milepost: name one of them".to_owned()),
        (Some(_), None) if beyond.is_some() => {
            Err("a milepost_offset lies beyond a milepost, and there is none".to_owned())
        }
        (Some(column), None) => Ok(Places {
            column,
            beyond: None,
            kind: PlaceKind::Distance,
        }),
        (None, Some(column)) => Ok(Places {
            column,
            beyond,
            kind: PlaceKind::Milepost,
        }),
        (None, None) => Err("the header has no column distance".to_owned()),
    }
}

/// Returns the sign (1 or -1) that a cell of the sign row gives to a quantity.
fn sign(column: TrackColumn, cell: &str) -> Result<f64, String> {
    let [plus, minus] = signs_of(column);
    match cell.trim_matches('"').to_ascii_lowercase().as_str() {
        "" if is_place(column) => Ok(1.0),
        own if own == plus => Ok(1.0),
        own if own == minus && !is_place(column) => Ok(-1.0),
        _ => Err(format!(
            "the sign row has {} under {}; {plus} or {minus} is expected",
            shortened(cell),
            name_of(column)
        )),
    }
}

/// Returns the number in a cell, in SI units; a milepost may say the feet beyond it.
fn number_of(written: &mut Separated, head: &Head, cell: &str) -> Result<f64, CellError> {
    let number = written.number(cell).map(|value| head.factor * value);
    match number {
        Err(CellError::NoNumber(_)) if head.column == TrackColumn::Milepost => {
            let unit = if head.factor == MILE { MILE } else { 1000.0 };
            stations::place_of(cell, unit).ok_or_else(|| CellError::NoNumber(shortened(cell)))
        }
        number => number,
    }
}

const HEADER: &str = "write a header such as: distance [ft], left_profile [in], right_profile [in]; or name \
                      the columns of the recording in the track file, such as [columns] with milepost = \
                      { name = \"Milepost\" } and left_profile = { name = \"Left Prof 62\", unit = \
                      \"in\" }; docs/wheelrail.md lists both";
const SIGNS: &str = "write under the header which way is positive: up or down for profiles, left or right \
                     for alignment and curvature, right_high or left_high for cross level, wide or tight \
                     for gauge; or say signs = \"usual\" if they are up, left, right_high, wide";
