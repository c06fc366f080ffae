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
//! Other columns are left aside. Irregularities are **space curves**: the rail's own offset from its nominal
//! place. Mid-chord offsets are none, and are taken only where the caller states chord and wavelengths; see
//! [`chord::invert`].

use std::path::Path;

use input::file::Expected;
use input::{limits, shortened};
use thiserror::Error;

use super::center_line::{CenterLine, TrackError};
use super::chord::{self, ChordError};
use super::columns::{Head, TrackColumn, head, name_of, signs_of};
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
    /// Returns the remedy.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Line { remedy, .. } => remedy.clone(),
            Self::MidChord { .. } => "give space curves; or write form = \"mid_chord\" with chord = \"62 \
                                      ft\" and the wavelengths over which to invert it, such as shortest \
                                      = \"35 ft\", longest = \"370 ft\""
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

/// A measured table, in SI units and with the signs of this crate.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredTable {
    name: String,
    distances: Vec<f64>,
    columns: Vec<(TrackColumn, Vec<f64>)>,
    /// Columns of mid-chord offsets: what they are of, the chord's name (such as `62_ft`), values.
    offsets: Vec<(TrackColumn, String, Vec<f64>)>,
}

impl MeasuredTable {
    /// Reads a file. `signs_known`: there is no sign row, and signs are the first ones of the table above.
    ///
    /// # Errors
    /// The file cannot be read, or a line of it is wrong.
    pub fn read(path: &Path, signs_known: bool) -> Result<Self, MeasuredError> {
        let expected = Expected {
            what: "table of track",
            types: &[],
            most: limits::TEXT_FILE,
        };
        let text = input::file::read_text(path, &expected)?;
        Self::parse(&path.display().to_string(), &text, signs_known)
    }

    /// As [`MeasuredTable::read`], from a text; `name` is what messages call it.
    ///
    /// # Errors
    /// A line is wrong.
    pub fn parse(name: &str, text: &str, signs_known: bool) -> Result<Self, MeasuredError> {
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
        let separator = [';', '\t', ',']
            .into_iter()
            .find(|own| header.contains(*own))
            .unwrap_or(',');
        let mut heads: Vec<Head> = Vec::new();
        for (index, cell) in header.split(separator).enumerate() {
            if let Some(head) = head(index, cell).map_err(|found| wrong(number, found, HEADER))? {
                heads.push(head);
            }
        }
        if !signs_known {
            let (number, row) = lines
                .next()
                .ok_or_else(|| wrong(number + 1, "there is no sign row".into(), SIGNS))?;
            let cells: Vec<&str> = row.split(separator).map(str::trim).collect();
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
            let cells: Vec<&str> = line.split(separator).collect();
            if columns[distance].len() == limits::TABLE_ROWS {
                let found = format!("there are more than {} rows", limits::TABLE_ROWS);
                return Err(wrong(number, found, "divide the track"));
            }
            for (head, values) in heads.iter().zip(&mut columns) {
                let cell = cells.get(head.index).map_or("", |cell| cell.trim());
                match cell.parse::<f64>() {
                    Ok(value) if (head.factor * value).abs() <= LARGEST => values.push(head.factor * value),
                    _ => {
                        let found = format!(
                            "{} is no number of a track, under {}",
                            shortened(cell),
                            name_of(head.column)
                        );
                        return Err(wrong(
                            number,
                            found,
                            "fill gaps in the measurement; write numbers such as -0.25",
                        ));
                    }
                }
            }
            let own = &columns[distance];
            if let [.., before, last] = own[..]
                && last <= before
            {
                let found = format!("the distance {last} m follows {before} m");
                return Err(wrong(number, found, "distances must rise from row to row"));
            }
        }
        let mut table = Self {
            name: name.to_owned(),
            distances: std::mem::take(&mut columns[distance]),
            columns: Vec::new(),
            offsets: Vec::new(),
        };
        for (head, mut values) in heads.into_iter().zip(columns) {
            match (head.column, head.chord) {
                (TrackColumn::Distance, _) => {}
                (column, Some(chord)) => table.offsets.push((column, chord, values)),
                (column, None) => {
                    if column == TrackColumn::Gauge {
                        // The sign of a gauge is that of its deviation.
                        values
                            .iter_mut()
                            .for_each(|value| *value = value.abs() - NOMINAL_GAUGE);
                    }
                    table.columns.push((column, values));
                }
            }
        }
        Ok(table)
    }

    /// Returns the first and the last distance, m; zero if there is no row.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        match self.distances[..] {
            [first, .., last] => [first, last],
            _ => [0.0; 2],
        }
    }

    fn column(&self, wanted: TrackColumn) -> Option<&[f64]> {
        let found = self.columns.iter().find(|(column, _)| *column == wanted);
        found.map(|(_, values)| values.as_slice())
    }

    /// Returns the irregularities in the table, `start` (m) farther on and tapered within `taper` (m) at both
    /// ends. Where both rails are given, cross level and gauge are left aside: they are contained in them. A
    /// cross level is taken less the table's superelevation, if it has one.
    ///
    /// # Errors
    /// There are no irregularities, they are mid-chord offsets, or these cannot be inverted.
    pub fn irregularities(&self, form: Form, start: f64, taper: f64) -> Result<Vec<Placed>, MeasuredError> {
        let distances: Vec<f64> = self.distances.iter().map(|own| own + start).collect();
        let values = |column: TrackColumn| -> Option<Vec<f64>> {
            if let Form::MidChord { chord, .. } = form
                && !matches!(
                    column,
                    TrackColumn::CrossLevel | TrackColumn::GaugeDeviation | TrackColumn::Gauge
                )
            {
                let name = format!("{:.0}_ft", chord / 0.3048);
                let offset = self
                    .offsets
                    .iter()
                    .find(|(own, chord, _)| *own == column && *chord == name);
                if let Some((_, _, values)) = offset {
                    return Some(values.clone());
                }
            }
            let own = self.column(column)?.to_vec();
            let design = self
                .column(TrackColumn::Superelevation)
                .filter(|_| column == TrackColumn::CrossLevel);
            Some(match design {
                Some(design) => own.iter().zip(design).map(|(own, design)| own - design).collect(),
                None => own,
            })
        };
        let mut placed = Vec::new();
        let mut add = |column: TrackColumn, rails, direction, sign: f64| -> Result<bool, MeasuredError> {
            let Some(own) = values(column) else {
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
        match (placed.is_empty(), self.offsets.first()) {
            (false, _) => Ok(placed),
            (true, Some((column, chord, _))) => Err(MeasuredError::MidChord {
                name: self.name.clone(),
                column: format!("{}_offset_{chord}", name_of(*column)),
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
        let degrees: Option<Vec<f64>> = self.column(TrackColumn::DegreeOfCurve).map(|degrees| {
            let curvature = |degree: &f64| 2.0 * libm::sin(0.5 * degree) / 30.48;
            degrees.iter().map(curvature).collect()
        });
        let curvature = self.column(TrackColumn::Curvature).or(degrees.as_deref());
        let superelevation = self.column(TrackColumn::Superelevation);
        if curvature.is_none() && superelevation.is_none() {
            return Err(MeasuredError::Missing {
                name: self.name.clone(),
                needed: "curvature, degree_of_curve or superelevation",
            });
        }
        let grades: Vec<[f64; 2]> = match self.column(TrackColumn::Grade) {
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
