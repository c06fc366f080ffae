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
//! Places may be mileposts ([`super::stations`]), in miles or with feet beyond them (`milepost`,
//! `milepost_offset`). A recording whose titles are others is read by [`super::NamedColumn`]s.
//!
//! Other columns are left aside. Numbers have decimal points, or decimal commas between semicolons and tabs.
//! Cells without a number, and rows that a regular recording lacks, are gaps: see [`Gap`]. Irregularities are
//! **space curves**: the rail's own offset from its nominal place. Mid-chord offsets are none, and are taken
//! only where the caller states chord and wavelengths; see [`chord::invert`].

use std::path::Path;

use quantity::SixDigits;

use super::center_line::CenterLine;
use super::chord;
use super::columns::{ColumnKind, TrackColumn, feet, name_of};
use super::gaps::{self, Gap};
use super::layout::{Direction, Irregularity, Placed, Rails};
use super::measured_error::MeasuredError;
use super::recording::{self, Reading};
use super::samples::{Samples, natural_spline, piece};

/// Relative tolerance of spacings that are taken as equal.
const UNEQUAL: f64 = 1e-3;
/// Rows at equal distances by rows of a table, at most.
const MOST_FILLED: f64 = 4.0;

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

/// A column of a table.
#[derive(Clone, Debug, PartialEq)]
struct Column {
    what: TrackColumn,
    kind: ColumnKind,
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

/// Values at equal distances, m.
struct EqualRows {
    spacing: f64,
    distances: Vec<f64>,
    values: Vec<f64>,
}

/// Returns whether values are those of the quantity itself.
fn is_no_offset(kind: ColumnKind) -> bool {
    !matches!(kind, ColumnKind::MidChord(_))
}

impl MeasuredTable {
    /// Reads a file.
    ///
    /// # Errors
    /// The file cannot be read, or a line of it is wrong.
    pub fn read(path: &Path, reading: &Reading) -> Result<Self, MeasuredError> {
        Self::parse(&path.display().to_string(), &recording::text_of(path)?, reading)
    }

    /// As [`MeasuredTable::read`], from a text; `name` is what messages call it.
    ///
    /// # Errors
    /// A line is wrong.
    pub fn parse(name: &str, text: &str, reading: &Reading) -> Result<Self, MeasuredError> {
        let found = recording::parse(name, text, reading)?;
        let (distances, lines) = (found.distances, found.lines);
        let columns = found.columns.into_iter().map(|mut column| Column {
            what: column.what,
            gaps: gaps::fill(name_of(column.what), &distances, &lines, &mut column.values),
            kind: column.kind,
            values: column.values,
        });
        Ok(Self {
            name: name.to_owned(),
            columns: columns.collect(),
            jumps: gaps::missing_rows(&distances, &lines),
            distances,
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

    /// Returns the values of a quantity whose kind fits, if there is a column of it.
    fn column(
        &self,
        wanted: TrackColumn,
        fits: impl Fn(ColumnKind) -> bool,
    ) -> Result<Option<&[f64]>, MeasuredError> {
        let mut columns = self.columns.iter();
        let Some(found) = columns.find(|own| own.what == wanted && fits(own.kind)) else {
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
        let values = |column: TrackColumn| -> Result<Option<Vec<f64>>, MeasuredError> {
            let Some(own) = self.of_form(column, form)? else {
                return Ok(None);
            };
            let design = match column {
                TrackColumn::CrossLevel => self.column(TrackColumn::Superelevation, is_no_offset)?,
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
            let (distances, own) = match (form, rails) {
                (Form::MidChord { chord, wavelengths }, Rails::Left | Rails::Right | Rails::Both) => {
                    let rows = self.at_equal_distances(own)?;
                    let curve = chord::invert(&rows.values, rows.spacing, chord, wavelengths, taper)?;
                    (rows.distances, curve)
                }
                _ => (self.distances.clone(), own),
            };
            let distances = distances.iter().map(|own| own + start).collect();
            let own = own.into_iter().map(|value| sign * value).collect();
            placed.push(Placed {
                rails,
                direction,
                irregularity: Irregularity::Samples(Samples::new(distances, own, taper)?),
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
        match placed.is_empty() {
            false => Ok(placed),
            true => Err(MeasuredError::Missing {
                name: self.name.clone(),
                needed: "of irregularities, such as left_profile",
            }),
        }
    }

    /// Returns the values of a quantity that are of a form. A quantity that has another form alone is
    /// refused: left out, its rail would be perfect.
    fn of_form(&self, wanted: TrackColumn, form: Form) -> Result<Option<&[f64]>, MeasuredError> {
        let pair = [
            TrackColumn::CrossLevel,
            TrackColumn::GaugeDeviation,
            TrackColumn::Gauge,
        ];
        let found = match form {
            Form::MidChord { chord, .. } if !pair.contains(&wanted) => {
                match self.column(wanted, |kind| kind.is_of_chord(chord))? {
                    None => self.column(wanted, |kind| kind == ColumnKind::Unstated)?,
                    found => found,
                }
            }
            _ => self.column(wanted, is_no_offset)?,
        };
        let other = self.columns.iter().find(|own| own.what == wanted);
        match (found, other, form) {
            (Some(found), ..) => Ok(Some(found)),
            (None, None, _) => Ok(None),
            (None, Some(other), form) => Err(match (other.kind, form) {
                (ColumnKind::MidChord(chord), Form::SpaceCurve) => MeasuredError::MidChord {
                    name: self.name.clone(),
                    column: format!("{}_offset_{:.0}_ft", name_of(wanted), feet(chord)),
                },
                (kind, _) => MeasuredError::OtherKind {
                    name: self.name.clone(),
                    column: name_of(wanted),
                    held: match kind {
                        ColumnKind::MidChord(chord) => format!("offsets of {:.0} ft", feet(chord)),
                        ColumnKind::SpaceCurve | ColumnKind::Unstated => "a space curve".to_owned(),
                    },
                },
            }),
        }
    }

    /// Returns values at equal distances: as they are, or, where the rows of a regular recording are a little
    /// unequal (mileposts are rounded) or a few are not there, those of the spline through them.
    fn at_equal_distances(&self, values: Vec<f64>) -> Result<EqualRows, MeasuredError> {
        let [first, last] = self.range();
        let spacing = (last - first) / (self.distances.len().max(2) - 1) as f64;
        let steps = || self.distances.windows(2).map(|pair| pair[1] - pair[0]);
        let Some(unequal) = steps().find(|own| (own / spacing - 1.0).abs() > UNEQUAL) else {
            return Ok(EqualRows {
                spacing,
                distances: self.distances.clone(),
                values,
            });
        };
        let few = |usual: &f64| (last - first) / usual < MOST_FILLED * self.distances.len() as f64;
        let Some(usual) = gaps::usual_step(&self.distances).filter(few) else {
            return Err(MeasuredError::Samples {
                what: format!(
                    "{}: rows {unequal} m and {spacing} m apart; offsets are inverted from rows at equal \
                     distances",
                    self.name
                ),
            });
        };
        let count = ((last - first) / usual).round().max(1.0);
        let spacing = (last - first) / count;
        let seconds = natural_spline(&self.distances, &values);
        let distances: Vec<f64> = (0..=count as usize).map(|k| first + k as f64 * spacing).collect();
        let at = |distance: &f64| {
            let after = self.distances.partition_point(|own| own <= distance);
            let k = after.clamp(1, values.len() - 1) - 1;
            let pair = |own: &[f64]| [own[k], own[k + 1]];
            piece(pair(&self.distances), pair(&values), pair(&seconds), *distance)[0]
        };
        Ok(EqualRows {
            spacing,
            values: distances.iter().map(at).collect(),
            distances,
        })
    }

    /// Returns the center line of the table: curvature (0 if there is none), superelevation and grade, linear
    /// between its rows. The centers of the rails are `rail_distance` (m) apart.
    ///
    /// # Errors
    /// The table has no curvature and no superelevation, does not begin at zero, or its track cannot be.
    pub fn center_line(&self, rail_distance: f64) -> Result<CenterLine, MeasuredError> {
        let zeros = vec![0.0; self.distances.len()];
        let degrees: Option<Vec<f64>> =
            self.column(TrackColumn::DegreeOfCurve, is_no_offset)?
                .map(|degrees| {
                    let curvature = |degree: &f64| 2.0 * libm::sin(0.5 * degree) / 30.48;
                    degrees.iter().map(curvature).collect()
                });
        let curvature = self
            .column(TrackColumn::Curvature, is_no_offset)?
            .or(degrees.as_deref());
        let superelevation = self.column(TrackColumn::Superelevation, is_no_offset)?;
        if curvature.is_none() && superelevation.is_none() {
            return Err(MeasuredError::Missing {
                name: self.name.clone(),
                needed: "curvature, degree_of_curve or superelevation",
            });
        }
        let grades: Vec<[f64; 2]> = match self.column(TrackColumn::Grade, is_no_offset)? {
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
