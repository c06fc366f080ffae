//! The columns of measured tables: their names, signs and units.

use input::shortened;
use quantity::{Kind, Quantity};

/// A quantity of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TrackColumn {
    Distance,
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

const VERTICAL: [&str; 2] = ["up", "down"];
const LATERAL: [&str; 2] = ["left", "right"];
const HIGH: [&str; 2] = ["right_high", "left_high"];
const WIDE: [&str; 2] = ["wide", "tight"];

/// Names and signs (positive, negative) of the quantities.
const COLUMNS: [(&str, TrackColumn, [&str; 2]); 14] = [
    ("distance", TrackColumn::Distance, ["forward", "nothing"]),
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

/// A column as its header says it.
pub(super) struct Head {
    pub index: usize,
    pub column: TrackColumn,
    pub chord: Option<String>,
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

/// Returns a column of the header; none if it is another one, an error (what is found) if its unit is wrong.
pub(super) fn head(index: usize, cell: &str) -> Result<Option<Head>, String> {
    let cell = cell.trim().trim_matches('"').trim();
    let lower = cell.to_ascii_lowercase();
    let (title, unit) = match lower.find(['[', '(']) {
        Some(at) => (
            lower[..at].trim(),
            Some(cell[at + 1..].trim_end_matches([']', ')']).trim().to_owned()),
        ),
        None => {
            let ending = ENDINGS.iter().find(|(ending, _)| lower.ends_with(ending));
            match ending {
                Some((ending, unit)) => (&lower[..lower.len() - ending.len()], Some((*unit).to_owned())),
                None => (lower.as_str(), None),
            }
        }
    };
    // Offsets: left_profile_offset_62_ft, left_profile_mco_62.
    let (base, chord) = match title
        .find("_offset")
        .or_else(|| title.find("_mco"))
        .or_else(|| title.find("_chord"))
    {
        Some(at) => {
            let digits: String = title[at..].chars().filter(char::is_ascii_digit).collect();
            (&title[..at], Some(format!("{digits}_ft")))
        }
        None => (title, None),
    };
    let Some((_, column, _)) = COLUMNS.iter().find(|(name, _, _)| *name == base) else {
        return Ok(None);
    };
    let column = *column;
    let shown = shortened(cell);
    let factor = match (column, unit) {
        (TrackColumn::Grade, None) => 1.0,
        (TrackColumn::Grade, Some(unit)) if unit == "%" => 0.01,
        (TrackColumn::DegreeOfCurve, None) => 1f64.to_radians(),
        (_, None) => return Err(format!("the column {shown} has no unit")),
        (TrackColumn::Curvature, Some(unit)) => {
            let Some(length) = unit.strip_prefix("1/") else {
                return Err(format!(
                    "the unit of the column {shown} is none of curvature, such as 1/ft"
                ));
            };
            let length = Quantity::parse_as(&format!("1 {length}"), Kind::Length);
            1.0 / length
                .map_err(|error| format!("the unit of the column {shown}: {error}"))?
                .to_si()
        }
        (_, Some(unit)) => {
            let kind = match column {
                TrackColumn::DegreeOfCurve => Kind::Angle,
                TrackColumn::Grade => Kind::Dimensionless,
                _ => Kind::Length,
            };
            let one = Quantity::parse_as(&format!("1 {unit}"), kind);
            one.map_err(|error| format!("the unit of the column {shown}: {error}"))?
                .to_si()
        }
    };
    Ok(Some(Head {
        index,
        column,
        chord,
        factor,
    }))
}
