//! The lists of a request: texts with units to increasing values.

use quantity::{Kind, Quantity};

use super::TablesError;
use super::grid::Direction;
use crate::case::bounds;

/// What is read of a list.
impl Direction {
    /// Returns a list as users write it.
    fn example(self) -> &'static str {
        match self {
            Self::Load => "--load \"20 kip\" \"60 kip\"",
            Self::Rise => "--rise \"0 in\" \"0.75 in\"",
            Self::Friction => "--friction 0.25 0.5",
            Self::Rate => "--rate \"0.1 Hz\" \"1 Hz\"",
        }
    }

    /// Reads one value, SI.
    fn read(self, text: &str) -> Result<f64, String> {
        let text = text.trim();
        let value = match self {
            Self::Friction => text
                .parse::<f64>()
                .map_err(|_| "a number without unit is expected".to_owned())?,
            _ => Quantity::parse_as(text, self.kind())
                .map_err(|error| error.to_string())?
                .to_si(),
        };
        let (fits, expected) = match self {
            Self::Load => (value > 0.0, "a force above zero"),
            Self::Rise => (value >= 0.0, "a length of zero or more"),
            Self::Friction => ((0.0..=bounds::FRICTION).contains(&value), "a number from 0 to 10"),
            Self::Rate => (
                (LEAST_RATE..=MOST_RATE).contains(&value),
                "a frequency from 0.001 to 50 Hz",
            ),
        };
        match fits && f64::is_finite(value) {
            true => Ok(value),
            false => Err(format!("{expected} is expected")),
        }
    }
}

/// Least rate, rad/s: a run lasts some cycles.
const LEAST_RATE: f64 = 0.000_999 * std::f64::consts::TAU;
/// Greatest rate, rad/s.
const MOST_RATE: f64 = 50.001 * std::f64::consts::TAU;

/// Reads a list of a direction.
///
/// # Errors
/// A value that is none of this direction, or values that do not increase: the option, the number of the
/// value, and what to write.
pub fn list(direction: Direction, texts: &[String]) -> Result<Vec<f64>, TablesError> {
    let mut values: Vec<f64> = Vec::new();
    for (place, text) in texts.iter().enumerate() {
        let wrong = |reason: String| TablesError::Value {
            option: direction.name(),
            place: place + 1,
            text: text.clone(),
            reason,
            help: format!("write for example {}", direction.example()),
        };
        let value = direction.read(text).map_err(wrong)?;
        if let (Some(last), Some(before)) = (values.last(), texts.get(place.wrapping_sub(1)))
            && value <= *last
        {
            return Err(wrong(format!(
                "it does not exceed `{before}` before it, and a table's values increase"
            )));
        }
        values.push(value);
    }
    Ok(values)
}

/// Reads an amplitude.
///
/// # Errors
/// It is none.
pub fn amplitude(option: &'static str, kind: Kind, text: &str, most: f64) -> Result<f64, TablesError> {
    let example = match kind {
        Kind::Angle => "--angle \"20 mrad\"",
        _ => "--stroke \"0.5 in\"",
    };
    let wrong = |reason: String| TablesError::Value {
        option,
        place: 1,
        text: text.to_owned(),
        reason,
        help: format!("write for example {example}"),
    };
    let value = Quantity::parse_as(text.trim(), kind).map_err(|error| wrong(error.to_string()))?;
    let value = value.to_si();
    if value > 0.0 && value <= most {
        return Ok(value);
    }
    Err(wrong(match kind {
        Kind::Angle => format!("an angle above zero, up to {most} rad, is expected"),
        _ => format!("a length above zero, up to {most} m, is expected"),
    }))
}
