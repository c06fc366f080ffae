//! Measured track: tables over the distance, foot by foot or at any rising distances.
//!
//! **CSV.** Lines that begin with `#` are comments. The first other line is the header: a column a quantity,
//! with its unit in brackets (`left_profile [in]`) or at the end of its name (`left_profile_in`). The second
//! line is the **sign row**: under each column a word says which way is positive. It may be left out where
//! the caller says that the signs are those of the first word of each row here:
//!
//! | column | what | signs |
//! |---|---|---|
//! | `distance` | along the track, in plan | `forward` or empty |
//! | `left_profile`, `right_profile`, `profile` | a rail, or the mean of both, vertically | `up`, `down` |
//! | `left_alignment`, `right_alignment`, `alignment` | a rail, or the mean of both, laterally | `left`, `right` |
//! | `cross_level`, `superelevation` | right rail above the left one | `right_high`, `left_high` |
//! | `gauge_deviation`, `gauge` | gauge less nominal, gauge (less 56.5 in here) | `wide`, `tight` |
//! | `curvature`, `degree_of_curve` | of the center line | `left`, `right` |
//! | `grade` | rise by the distance | `up`, `down` |
//!
//! Other columns are left aside. Numbers have decimal points, or decimal commas between semicolons and tabs.
//! Cells without a number, and rows that a regular recording lacks, are gaps: see [`Gap`]. Irregularities are
//! **space curves**: the rail's own offset from its nominal place. Mid-chord offsets are none, and are taken
//! only where the caller states chord and wavelengths; see [`chord::invert`].

use std::path::Path;

use input::file::Expected;
use input::{CellError, FileType, Separated, limits, shortened};
use quantity::SixDigits;
use thiserror::Error;

use super::center_line::{CenterLine, TrackError};
use super::chord::{self, ChordError};
use super::columns::{Head, TrackColumn, head, name_of, signs_of};
use super::gaps::{self, Gap};
use super::layout::{Direction, Irregularity, Placed, Rails};
use super::samples::Samples;

/// Nominal gauge of a column `gauge`, m: 56.5 in.
const NOMINAL_GAUGE: f64 = 56.5 * 0.0254;
/// Largest number of a table, in SI units: 10,000 km.
const LARGEST: f64 = 1e7;
/// Relative tolerance of spacings that must be equal.
const UNEQUAL: f64 = 1e-3;

/// Reasons why a measured table is no track.
#[derive(Debug, Error)]
pub enum MeasuredError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] input::file::ReadError),
    /// A line is wrong.
    #[error("{name}:{line}: {found}")]
    Line {
        /// The file.
        name: String,
        /// The line, from 1.
        line: usize,
        /// The kind found there.
        found: String,
        /// The advice.
        remedy: String,
    },
    /// Only mid-chord offsets where space curves are expected.
    #[error(
        "{name}: the column {column} holds mid-chord offsets; an irregularity of 39 ft appears in offsets \
         of 62 ft 0.72 times as large, one of 31 ft not at all: offsets are no profile"
    )]
    MidChord {
        /// The file.
        name: String,
        /// The column.
        column: String,
    },
    /// Something that is needed is not in the table.
    #[error("{name}: there is no column {needed}")]
    Missing {
        /// The file.
        name: String,
        /// The missing column.
        needed: &'static str,
    },
    /// A gap that is too long to be filled.
    #[error(
        "{name}: {gap}: a gap of {} m; up to {} m are filled",
        SixDigits(gap.length()), SixDigits(*longest)
    )]
    Gap {
        /// The file.
        name: String,
        /// The gap.
        gap: Gap,
        /// Length up to which gaps are filled, m.
        longest: f64,
    },
    /// A column that has no number at an end of the table.
    #[error("{name}: {column} has no number in {rows} rows at {at} m, at an end of the table")]
    End {
        /// The file.
        name: String,
        /// The column.
        column: &'static str,
        /// The number of rows.
        rows: usize,
        /// The distance of the table's end, m.
        at: SixDigits,
    },
    /// Values cannot be a spline.
    #[error("{what}")]
    Samples {
        /// The mistake.
        what: String,
    },
    /// Offsets cannot be inverted.
    #[error(transparent)]
    Chord(#[from] ChordError),
    /// The center line cannot be.
    #[error(transparent)]
    Track(#[from] TrackError),
}

impl MeasuredError {
    /// Returns the line of the table, from 1, if the mistake lies in one.
    #[must_use]
    pub const fn line(&self) -> Option<usize> {
        match self {
            Self::Line { line, .. } => Some(*line),
            _ => None,
        }
    }

    /// Returns the remedy.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Line { remedy, .. } => remedy.clone(),
            Self::MidChord { .. } => "give space curves; or write form = \"mid_chord\" with chord = \"62 \
                                      ft\" and the wavelengths over which to invert it, such as shortest \
                                      = \"35 ft\", longest = \"370 ft\""
                .to_owned(),
            Self::Gap { .. } => "measure the gap, or state the length up to which the spline is to fill \
                                 gaps, such as gaps = \"20 ft\": waves shorter than twice that length are \
                                 lost in it"
                .to_owned(),
            Self::End { .. } => "leave these rows out: a table may end before the track (beyond = \
                                 \"level\") and begin later (start)"
                .to_owned(),
            Self::Missing { .. } => "docs/wheelrail.md lists the columns".to_owned(),
            Self::Chord(_) => "state other wavelengths, or give space curves".to_owned(),
            Self::File(_) | Self::Samples { .. } | Self::Track(_) => "look at the table".to_owned(),
        }
    }
}

/// The form of the columns of rails.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// The rails' own offsets.
    SpaceCurve,
    /// Mid-chord offsets of a chord (m), which are inverted over wavelengths (m).
    MidChord {
        /// The chord, m.
        chord: f64,
        /// The shortest and the longest wavelength, m.
        wavelengths: [f64; 2],
    },
}

/// What the caller knows of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// There is no sign row, and signs are the first ones of the table above.
    pub signs_known: bool,
    /// Length up to which gaps are filled, m.
    pub longest_gap: f64,
}

impl Default for Reading {
    fn default() -> Self {
        Self {
            signs_known: false,
            longest_gap: gaps::LONGEST_GAP,
        }
    }
}

/// A column of a table.
#[derive(Clone, Debug, PartialEq)]
struct Column {
    what: TrackColumn,
    /// The chord's name, such as `62_ft`, if the values are mid-chord offsets.
    chord: Option<String>,
    values: Vec<f64>,
    gaps: Vec<Gap>,
}

/// A measured table, in SI units and with the signs of this crate.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredTable {
    name: String,
    distances: Vec<f64>,
    columns: Vec<Column>,
    /// Where whole rows are not there.
    jumps: Vec<Gap>,
    longest_gap: f64,
}

impl MeasuredTable {
    /// Reads a file.
    ///
    /// # Errors
    /// The file cannot be read, or a line of it is wrong.
    pub fn read(path: &Path, reading: Reading) -> Result<Self, MeasuredError> {
        let expected = Expected {
            what: "table of track",
            types: &[FileType::MeasuredTrack],
            most: limits::TEXT_FILE,
        };
        let text = input::file::read_text(path, &expected)?;
        Self::parse(&path.display().to_string(), &text, reading)
    }

    /// As [`MeasuredTable::read`], from a text; `name` is what messages call it.
    ///
    /// # Errors
    /// A line is wrong.
    pub fn parse(name: &str, text: &str, reading: Reading) -> Result<Self, MeasuredError> {
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
        let Some((number, header)) = lines.next() else {
            return Err(wrong(1, "there is no header".into(), HEADER));
        };
        let mut written = Separated::of(header);
        let titles = written.cells(header).count();
        let mut heads: Vec<Head> = Vec::new();
        for (index, cell) in written.cells(header).enumerate() {
            if let Some(head) = head(index, cell).map_err(|found| wrong(number, found, HEADER))? {
                heads.push(head);
            }
        }
        if !reading.signs_known {
            let (number, row) = lines
                .next()
                .ok_or_else(|| wrong(number + 1, "there is no sign row".into(), SIGNS))?;
            let cells: Vec<&str> = written.cells(row).collect();
            for head in &mut heads {
                let cell = cells.get(head.index).copied().unwrap_or("");
                let [plus, minus] = signs_of(head.column);
                let sign = match cell.trim_matches('"').to_ascii_lowercase().as_str() {
                    "" if head.column == TrackColumn::Distance => 1.0,
                    own if own == plus => 1.0,
                    own if own == minus && head.column != TrackColumn::Distance => -1.0,
                    _ => {
                        let found = format!(
                            "the sign row has {} under {}; {plus} or {minus} is expected",
                            shortened(cell),
                            name_of(head.column)
                        );
                        return Err(wrong(number, found, SIGNS));
                    }
                };
                head.factor *= sign;
            }
        }
        let mut columns: Vec<Vec<f64>> = heads.iter().map(|_| Vec::new()).collect();
        let distance = heads.iter().position(|head| head.column == TrackColumn::Distance);
        let distance =
            distance.ok_or_else(|| wrong(number, "the header has no column distance".into(), HEADER))?;
        for (number, line) in lines {
            if let Some(found) = written.surplus(line, titles) {
                return Err(wrong(number, found, "write a cell for each title"));
            }
            let cells: Vec<&str> = written.cells(line).collect();
            if columns[distance].len() == limits::TABLE_ROWS {
                let found = format!("there are more than {} rows", limits::TABLE_ROWS);
                return Err(wrong(number, found, "divide the track"));
            }
            for (head, values) in heads.iter().zip(&mut columns) {
                let cell = cells.get(head.index).copied().unwrap_or("");
                let value = match written.number(cell) {
                    Ok(value) if (head.factor * value).abs() <= LARGEST => head.factor * value,
                    Ok(value) => {
                        let found = format!("{value} is too large, under {}", name_of(head.column));
                        return Err(wrong(number, found, "look at the unit of the column"));
                    }
                    Err(CellError::Gap) if head.column != TrackColumn::Distance => f64::NAN,
                    Err(error) => {
                        let found = format!("{error}, under {}", name_of(head.column));
                        return Err(wrong(number, found, error.remedy()));
                    }
                };
                values.push(value);
            }
            let own = &columns[distance];
            if let [.., before, last] = own[..]
                && last <= before
            {
                let found = format!("the distance {last} m follows {before} m");
                return Err(wrong(number, found, "distances must rise from row to row"));
            }
        }
        let distances = std::mem::take(&mut columns[distance]);
        let mut filled = Vec::new();
        for (head, mut values) in heads.into_iter().zip(columns) {
            if head.column == TrackColumn::Distance {
                continue;
            }
            if head.column == TrackColumn::Gauge && head.chord.is_none() {
                // The sign of a gauge is that of its deviation.
                values
                    .iter_mut()
                    .for_each(|value| *value = value.abs() - NOMINAL_GAUGE);
            }
            filled.push(Column {
                what: head.column,
                gaps: gaps::fill(name_of(head.column), &distances, &mut values),
                chord: head.chord,
                values,
            });
        }
        Ok(Self {
            name: name.to_owned(),
            jumps: gaps::missing_rows(&distances),
            distances,
            columns: filled,
            longest_gap: reading.longest_gap,
        })
    }

    /// Returns in words how many gaps the spline fills, if it fills any.
    #[must_use]
    pub fn filled(&self) -> Option<String> {
        let own = self.columns.iter().flat_map(|column| &column.gaps);
        let filled: Vec<&Gap> = own
            .chain(&self.jumps)
            .filter(|gap| gap.length() <= self.longest_gap)
            .collect();
        let longest =
            filled
                .iter()
                .copied()
                .reduce(|longest, gap| match gap.length() > longest.length() {
                    true => gap,
                    false => longest,
                })?;
        let gaps = match filled.len() {
            1 => "1 gap".to_owned(),
            count => format!("{count} gaps"),
        };
        let waves = SixDigits(2.0 * longest.length());
        Some(format!(
            "{}: the spline fills {gaps}, the longest of them {longest}; waves shorter than {waves} m are \
            not known \
             there",
            self.name
        ))
    }

    /// Returns the first and the last distance, m; zero if there is no row.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        match self.distances[..] {
            [first, .., last] => [first, last],
            _ => [0.0; 2],
        }
    }

    /// Returns the values of a column, if there is one: those of a chord (such as `62_ft`), or the quantity
    /// itself.
    fn column(&self, wanted: TrackColumn, chord: Option<&str>) -> Result<Option<&[f64]>, MeasuredError> {
        let mut columns = self.columns.iter();
        let Some(found) = columns.find(|own| own.what == wanted && own.chord.as_deref() == chord) else {
            return Ok(None);
        };
        if let Some(gap) = found
            .gaps
            .iter()
            .chain(&self.jumps)
            .find(|gap| gap.length() > self.longest_gap)
        {
            return Err(MeasuredError::Gap {
                name: self.name.clone(),
                gap: gap.clone(),
                longest: self.longest_gap,
            });
        }
        let [first, last] = self.range();
        let missing = |values: &mut dyn Iterator<Item = &f64>| values.take_while(|own| own.is_nan()).count();
        let ends = [
            (missing(&mut found.values.iter()), first),
            (missing(&mut found.values.iter().rev()), last),
        ];
        match ends.into_iter().find(|(rows, _)| *rows > 0) {
            Some((rows, at)) => Err(MeasuredError::End {
                name: self.name.clone(),
                column: name_of(wanted),
                rows,
                at: SixDigits(at),
            }),
            None => Ok(Some(&found.values)),
        }
    }

    /// Returns the irregularities in the table, `start` (m) farther on and tapered within `taper` (m) at both
    /// ends. Where both rails are given, cross level and gauge are left aside: they are contained in them. A
    /// cross level is taken less the table's superelevation, if it has one.
    ///
    /// # Errors
    /// There are no irregularities, they are mid-chord offsets, or these cannot be inverted.
    pub fn irregularities(&self, form: Form, start: f64, taper: f64) -> Result<Vec<Placed>, MeasuredError> {
        let distances: Vec<f64> = self.distances.iter().map(|own| own + start).collect();
        let values = |column: TrackColumn| -> Result<Option<Vec<f64>>, MeasuredError> {
            let of_pair = [
                TrackColumn::CrossLevel,
                TrackColumn::GaugeDeviation,
                TrackColumn::Gauge,
            ];
            if let Form::MidChord { chord, .. } = form
                && !of_pair.contains(&column)
                && let Some(offsets) = self.column(column, Some(&format!("{:.0}_ft", chord / 0.3048)))?
            {
                return Ok(Some(offsets.to_vec()));
            }
            let Some(own) = self.column(column, None)? else {
                return Ok(None);
            };
            let design = match column {
                TrackColumn::CrossLevel => self.column(TrackColumn::Superelevation, None)?,
                _ => None,
            };
            Ok(Some(match design {
                Some(design) => own.iter().zip(design).map(|(own, design)| own - design).collect(),
                None => own.to_vec(),
            }))
        };
        let mut placed = Vec::new();
        let mut add = |column: TrackColumn, rails, direction, sign: f64| -> Result<bool, MeasuredError> {
            let Some(own) = values(column)? else {
                return Ok(false);
            };
            let own = match (form, rails) {
                (Form::MidChord { chord, wavelengths }, Rails::Left | Rails::Right | Rails::Both) => {
                    chord::invert(&own, self.spacing()?, chord, wavelengths, taper)?
                }
                _ => own,
            };
            let own = own.into_iter().map(|value| sign * value).collect();
            placed.push(Placed {
                rails,
                direction,
                irregularity: Irregularity::Samples(Samples::new(distances.clone(), own, taper)?),
            });
            Ok(true)
        };
        for (direction, left, right, mean, [difference, other], sign) in [
            (
                Direction::Vertical,
                TrackColumn::LeftProfile,
                TrackColumn::RightProfile,
                TrackColumn::Profile,
                [TrackColumn::CrossLevel; 2],
                -1.0,
            ),
            (
                Direction::Lateral,
                TrackColumn::LeftAlignment,
                TrackColumn::RightAlignment,
                TrackColumn::Alignment,
                [TrackColumn::GaugeDeviation, TrackColumn::Gauge],
                1.0,
            ),
        ] {
            let rails = [
                add(left, Rails::Left, direction, 1.0)?,
                add(right, Rails::Right, direction, 1.0)?,
            ];
            if rails == [false; 2] {
                add(mean, Rails::Both, direction, 1.0)?;
                if !add(difference, Rails::Against, direction, sign)? && other != difference {
                    add(other, Rails::Against, direction, sign)?;
                }
            }
        }
        let mut offsets = self.columns.iter();
        let offset = offsets.find_map(|own| Some((own.what, own.chord.as_ref()?)));
        match (placed.is_empty(), offset) {
            (false, _) => Ok(placed),
            (true, Some((column, chord))) => Err(MeasuredError::MidChord {
                name: self.name.clone(),
                column: format!("{}_offset_{chord}", name_of(column)),
            }),
            (true, None) => Err(MeasuredError::Missing {
                name: self.name.clone(),
                needed: "of irregularities, such as left_profile",
            }),
        }
    }

    /// Returns the distance from row to row, which must be equal, m.
    fn spacing(&self) -> Result<f64, MeasuredError> {
        let [first, last] = self.range();
        let spacing = (last - first) / (self.distances.len().max(2) - 1) as f64;
        let pairs = self.distances.windows(2);
        match pairs
            .map(|pair| pair[1] - pair[0])
            .find(|own| (own / spacing - 1.0).abs() > UNEQUAL)
        {
            None => Ok(spacing),
            Some(own) => Err(MeasuredError::Samples {
                what: format!(
                    "{}: rows {own} m and {spacing} m apart; offsets are inverted from rows at equal \
                     distances",
                    self.name
                ),
            }),
        }
    }

    /// Returns the center line of the table: curvature (0 if there is none), superelevation and grade, linear
    /// between its rows. The centers of the rails are `rail_distance` (m) apart.
    ///
    /// # Errors
    /// The table has no curvature and no superelevation, does not begin at zero, or its track cannot be.
    pub fn center_line(&self, rail_distance: f64) -> Result<CenterLine, MeasuredError> {
        let zeros = vec![0.0; self.distances.len()];
        let degrees: Option<Vec<f64>> = self.column(TrackColumn::DegreeOfCurve, None)?.map(|degrees| {
            let curvature = |degree: &f64| 2.0 * libm::sin(0.5 * degree) / 30.48;
            degrees.iter().map(curvature).collect()
        });
        let curvature = self.column(TrackColumn::Curvature, None)?.or(degrees.as_deref());
        let superelevation = self.column(TrackColumn::Superelevation, None)?;
        if curvature.is_none() && superelevation.is_none() {
            return Err(MeasuredError::Missing {
                name: self.name.clone(),
                needed: "curvature, degree_of_curve or superelevation",
            });
        }
        let grades: Vec<[f64; 2]> = match self.column(TrackColumn::Grade, None)? {
            Some(grades) => self
                .distances
                .iter()
                .zip(grades)
                .map(|(own, grade)| [*own, *grade])
                .collect(),
            None => Vec::new(),
        };
        Ok(CenterLine::of_table(
            &self.distances,
            curvature.unwrap_or(&zeros),
            superelevation.unwrap_or(&zeros),
            rail_distance,
            &grades,
        )?)
    }
}

const HEADER: &str = "write a header such as: distance [ft], left_profile [in], right_profile [in]; \
                      docs/wheelrail.md lists the columns";
const SIGNS: &str = "write under the header which way is positive: up or down for profiles, left or right \
                     for alignment and curvature, right_high or left_high for cross level, wide or tight \
                     for gauge; or say signs = \"usual\" if they are up, left, right_high, wide";
