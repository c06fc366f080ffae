//! The columns of measured tables: their names, signs and units, and how a user names those of a recording.

use input::shortened;
use quantity::{Kind, Quantity, nearest};

/// A quantity of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TrackColumn {
    Distance,
    Milepost,
    MilepostOffset,
    LeftProfile,
    RightProfile,
    Profile,
    LeftAlignment,
    RightAlignment,
    Alignment,
    CrossLevel,
    Superelevation,
    GaugeDeviation,
    Gauge,
    Curvature,
    DegreeOfCurve,
    Grade,
}

const FORWARD: [&str; 2] = ["forward", "nothing"];
const VERTICAL: [&str; 2] = ["up", "down"];
const LATERAL: [&str; 2] = ["left", "right"];
const HIGH: [&str; 2] = ["right_high", "left_high"];
const WIDE: [&str; 2] = ["wide", "tight"];

/// Names and signs (positive, negative) of the quantities.
const COLUMNS: [(&str, TrackColumn, [&str; 2]); 16] = [
    ("distance", TrackColumn::Distance, FORWARD),
    ("milepost", TrackColumn::Milepost, FORWARD),
    ("milepost_offset", TrackColumn::MilepostOffset, FORWARD),
    ("left_profile", TrackColumn::LeftProfile, VERTICAL),
    ("right_profile", TrackColumn::RightProfile, VERTICAL),
    ("profile", TrackColumn::Profile, VERTICAL),
    ("left_alignment", TrackColumn::LeftAlignment, LATERAL),
    ("right_alignment", TrackColumn::RightAlignment, LATERAL),
    ("alignment", TrackColumn::Alignment, LATERAL),
    ("cross_level", TrackColumn::CrossLevel, HIGH),
    ("superelevation", TrackColumn::Superelevation, HIGH),
    ("gauge_deviation", TrackColumn::GaugeDeviation, WIDE),
    ("gauge", TrackColumn::Gauge, WIDE),
    ("curvature", TrackColumn::Curvature, LATERAL),
    ("degree_of_curve", TrackColumn::DegreeOfCurve, LATERAL),
    ("grade", TrackColumn::Grade, VERTICAL),
];

/// Units at the end of names.
const ENDINGS: [(&str, &str); 7] = [
    ("_per_ft", "1/ft"),
    ("_per_m", "1/m"),
    ("_in", "in"),
    ("_ft", "ft"),
    ("_mm", "mm"),
    ("_cm", "cm"),
    ("_m", "m"),
];

/// The kind of the values of a rail's column.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ColumnKind {
    /// Not stated: the form in which the table is used decides.
    #[default]
    Unstated,
    /// The rail's own offset.
    SpaceCurve,
    /// Mid-chord offsets of a chord, m.
    MidChord(f64),
}

impl ColumnKind {
    /// Returns whether both are offsets of one chord, to the next foot, as titles name chords.
    pub(super) fn is_of_chord(self, chord: f64) -> bool {
        matches!(self, Self::MidChord(own) if feet(own) == feet(chord))
    }
}

/// Returns a chord (m) in whole feet.
pub(super) fn feet(chord: f64) -> f64 {
    (chord / 0.3048).round()
}

/// A column of a recording as its user names it, for tables whose titles are others than those here.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedColumn {
    quantity: TrackColumn,
    title: String,
    unit: Option<String>,
    sign: f64,
    kind: ColumnKind,
}

impl NamedColumn {
    /// Returns the column of a quantity (`left_profile`, `milepost`, ...) that has this title in the file,
    /// apart from case, quotes and a unit in brackets. `unit` is needed where the title has none; a milepost
    /// without one counts miles. `sign` is the word for the positive direction of the values, the first of
    /// its two if left out.
    ///
    /// # Errors
    /// What is wrong, and what to write.
    pub fn new(
        quantity: &str,
        title: &str,
        unit: Option<&str>,
        sign: Option<&str>,
        kind: ColumnKind,
    ) -> Result<Self, [String; 2]> {
        let names = || COLUMNS.iter().map(|(name, ..)| *name);
        let Some((_, column, signs)) = COLUMNS.iter().find(|(name, ..)| *name == quantity) else {
            let near = nearest(quantity, names());
            let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? "));
            let all: Vec<&str> = names().collect();
            return Err([
                format!("there is no quantity `{}`", shortened(quantity)),
                format!("{near}write one of {}", all.join(", ")),
            ]);
        };
        let sign = match sign {
            None => 1.0,
            Some(own) if own == signs[0] => 1.0,
            Some(own) if own == signs[1] && *signs != FORWARD => -1.0,
            Some(own) => {
                return Err([
                    format!("{} is no positive direction of {quantity}", shortened(own)),
                    format!(
                        "write the direction in which values are positive: {}",
                        signs.join(" or ")
                    ),
                ]);
            }
        };
        let rail = matches!(signs, &VERTICAL | &LATERAL)
            && !matches!(
                column,
                TrackColumn::Curvature | TrackColumn::DegreeOfCurve | TrackColumn::Grade
            );
        if kind != ColumnKind::Unstated && !rail {
            return Err([
                format!("{quantity} has no kind"),
                "space curves and mid-chord offsets are profiles and alignments".to_owned(),
            ]);
        }
        if let Some(unit) = unit {
            unit_factor(*column, Some(unit), title).map_err(|found| {
                [
                    found,
                    "write a unit such as \"in\", \"mm\", \"ft\", \"mi\", \"1/ft\", \"deg\"".to_owned(),
                ]
            })?;
        }
        Ok(Self {
            quantity: *column,
            title: title.trim().to_owned(),
            unit: unit.map(str::to_owned),
            sign,
            kind,
        })
    }

    /// Returns the column in a row of titles, or what is wrong.
    pub(super) fn among(&self, titles: &[&str]) -> Result<Head, String> {
        let plain = |cell: &str| cell.trim().trim_matches('"').trim().to_ascii_lowercase();
        let wanted = plain(&self.title);
        let matches = |cell: &str| plain(cell) == wanted || split_unit(&plain(cell)).0 == wanted;
        let Some(index) = titles.iter().position(|cell| matches(cell)) else {
            let all: Vec<String> = titles.iter().map(|cell| plain(cell)).collect();
            let near = nearest(&wanted, all.iter().map(String::as_str));
            let near = near.map_or(String::new(), |near| format!("; near it is {}", shortened(near)));
            return Err(format!(
                "there is no column {} for {}{near}; the titles are {}",
                shortened(&self.title),
                name_of(self.quantity),
                shortened(&all.join(", "))
            ));
        };
        let cell = titles[index].trim().trim_matches('"').trim();
        let written = split_unit(cell).1;
        let unit = match (&self.unit, &written, self.quantity) {
            (Some(own), Some(written), _) if own != written => {
                let [one, other] = [own, written].map(|unit| unit_factor(self.quantity, Some(unit), cell));
                if one? != other? {
                    return Err(format!(
                        "the column {} is in {}, not in {}",
                        shortened(cell),
                        shortened(written),
                        shortened(own)
                    ));
                }
                Some(own.as_str())
            }
            (Some(own), ..) | (None, Some(own), _) => Some(own.as_str()),
            (None, None, TrackColumn::Milepost) => Some("mi"),
            (None, None, _) => None,
        };
        Ok(Head {
            index,
            column: self.quantity,
            kind: self.kind,
            factor: self.sign * unit_factor(self.quantity, unit, cell)?,
        })
    }
}

/// A column as its header says it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Head {
    pub index: usize,
    pub column: TrackColumn,
    pub kind: ColumnKind,
    pub factor: f64,
}

/// Returns the words for the positive and the negative sign of a quantity.
pub(super) fn signs_of(column: TrackColumn) -> [&'static str; 2] {
    COLUMNS
        .iter()
        .find(|(_, own, _)| *own == column)
        .map_or(VERTICAL, |(_, _, signs)| *signs)
}

/// Returns the name of a quantity.
pub(super) fn name_of(column: TrackColumn) -> &'static str {
    COLUMNS
        .iter()
        .find(|(_, own, _)| *own == column)
        .map_or("", |(name, _, _)| name)
}

/// Returns whether a quantity says where a row lies.
pub(super) fn is_place(column: TrackColumn) -> bool {
    matches!(
        column,
        TrackColumn::Distance | TrackColumn::Milepost | TrackColumn::MilepostOffset
    )
}

/// Returns a title without the unit in brackets behind it, and that unit.
fn split_unit(cell: &str) -> (&str, Option<String>) {
    match cell.find(['[', '(']) {
        Some(at) => (
            cell[..at].trim(),
            Some(cell[at + 1..].trim_end_matches([']', ')']).trim().to_owned()),
        ),
        None => (cell, None),
    }
}

/// Returns the factor of a unit to SI units, or what is wrong with it.
fn unit_factor(column: TrackColumn, unit: Option<&str>, title: &str) -> Result<f64, String> {
    let shown = shortened(title);
    let in_kind = |unit: &str, kind: Kind| {
        Quantity::parse_as(&format!("1 {unit}"), kind)
            .map(|one| one.to_si())
            .map_err(|error| format!("the unit of the column {shown}: {error}"))
    };
    match (column, unit) {
        (TrackColumn::Grade, None) => Ok(1.0),
        (TrackColumn::Grade, Some("%")) => Ok(0.01),
        (TrackColumn::DegreeOfCurve, None) => Ok(1f64.to_radians()),
        (_, None) => Err(format!("the column {shown} has no unit")),
        (TrackColumn::Curvature, Some(unit)) => match unit.strip_prefix("1/") {
            Some(length) => Ok(1.0 / in_kind(length, Kind::Length)?),
            None => Err(format!(
                "the unit of the column {shown} is none of curvature, such as 1/ft"
            )),
        },
        (TrackColumn::DegreeOfCurve, Some(unit)) => in_kind(unit, Kind::Angle),
        (TrackColumn::Grade, Some(unit)) => in_kind(unit, Kind::Dimensionless),
        (_, Some(unit)) => in_kind(unit, Kind::Length),
    }
}

/// Returns a column of the header; none if it is another one, an error (what is found) if its unit is wrong.
pub(super) fn head(index: usize, cell: &str) -> Result<Option<Head>, String> {
    let cell = cell.trim().trim_matches('"').trim();
    let lower = cell.to_ascii_lowercase();
    let (title, unit) = match lower.contains(['[', '(']) {
        true => (split_unit(&lower).0, split_unit(cell).1),
        false => match ENDINGS.iter().find(|(ending, _)| lower.ends_with(ending)) {
            Some((ending, unit)) => (&lower[..lower.len() - ending.len()], Some((*unit).to_owned())),
            None => (lower.as_str(), None),
        },
    };
    // Offsets: left_profile_offset_62_ft, left_profile_mco_62.
    let columns = || COLUMNS.iter().map(|(name, column, _)| (*name, *column));
    let found = columns().find(|(name, _)| *name == title);
    let at = ["_offset", "_mco", "_chord"]
        .iter()
        .find_map(|word| title.find(word));
    let (base, kind) = match (found, at) {
        (None, Some(at)) => {
            let digits: String = title[at..].chars().filter(char::is_ascii_digit).collect();
            let chord = digits.parse().unwrap_or(0.0) * 0.3048;
            (&title[..at], ColumnKind::MidChord(chord))
        }
        _ => (title, ColumnKind::Unstated),
    };
    let Some((_, column)) = columns().find(|(name, _)| *name == base) else {
        return Ok(None);
    };
    let unit = match (column, &unit) {
        (TrackColumn::Milepost, None) => Some("mi"),
        _ => unit.as_deref(),
    };
    Ok(Some(Head {
        index,
        column,
        kind,
        factor: unit_factor(column, unit, cell)?,
    }))
}
