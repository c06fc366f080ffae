//! Quantities as typed.

use crate::units::system_of;
use crate::{Dimension, Kind, System, Unit, UnitError};
use input::{limits, shortened};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::str::FromStr;

/// A number with a unit, as it was typed: `"3000 lbf/in"`.
///
/// It keeps its text, so that what is printed is what was written; two quantities are equal if
/// their texts are. Texts that read back are all it ever holds.
#[derive(Clone, Debug)]
pub struct Quantity {
    text: Box<str>,
    value: f64,
    unit: Unit,
    unit_start: usize,
}

impl Quantity {
    /// Reads a number and a unit of any dimension.
    ///
    /// The number may have a sign, a decimal point and an exponent; the space before the unit
    /// may be left out.
    ///
    /// # Errors
    /// Every [`UnitError`] but [`UnitError::WrongDimension`].
    pub fn parse(text: &str) -> Result<Self, UnitError> {
        Self::read(text, None)
    }

    /// Reads a number and a unit that measures `kind`.
    ///
    /// # Errors
    /// Every [`UnitError`].
    pub fn parse_as(text: &str, kind: Kind) -> Result<Self, UnitError> {
        let quantity = Self::read(text, Some(kind))?;
        quantity.check(kind)?;
        Ok(quantity)
    }

    /// Returns a quantity from a number and the text of its unit.
    ///
    /// # Errors
    /// As [`Quantity::parse`]; places count from the start of the text this prints.
    pub fn new(value: f64, unit: &str) -> Result<Self, UnitError> {
        Self::parse(&format!("{} {}", Number(value), unit.trim()))
    }

    /// Checks whether it measures `kind`.
    ///
    /// # Errors
    /// [`UnitError::WrongDimension`] if it does not.
    pub fn check(&self, kind: Kind) -> Result<(), UnitError> {
        if kind.accepts(self.dimension()) {
            return Ok(());
        }
        Err(UnitError::WrongDimension {
            number: shortened(self.text[..self.unit_start].trim()),
            unit: shortened(self.unit_text()),
            found: self.dimension(),
            expected: kind,
            span: self.unit_start..self.unit_start + self.unit_text().len(),
        })
    }

    /// Returns the number as typed, in its own unit.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// Returns the unit.
    pub fn unit(&self) -> Unit {
        self.unit
    }

    /// Returns the unit's text as typed.
    pub fn unit_text(&self) -> &str {
        self.text[self.unit_start..].trim()
    }

    /// Returns the text as typed.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the dimension.
    pub fn dimension(&self) -> Dimension {
        self.unit.dimension()
    }

    /// Returns the system of units in which it was typed: that of the first part of its unit that belongs to
    /// one alone. None if no part does, as in `3 deg/s`.
    pub fn system(&self) -> Option<System> {
        let mut names = self.unit_text().split(|c: char| !(c.is_alphabetic() || c == '°'));
        names.find_map(system_of)
    }

    /// Returns the value in SI: one multiplication by the unit's factor.
    pub fn to_si(&self) -> f64 {
        self.value * self.unit.factor()
    }

    fn read(text: &str, expected: Option<Kind>) -> Result<Self, UnitError> {
        let start = text.len() - text.trim_start().len();
        let trimmed = text.trim();
        if trimmed.is_empty() {
            return Err(UnitError::Empty { expected });
        }
        let too_long = || UnitError::BadNumber {
            text: shortened(trimmed),
            reason: format!("it has more than {} characters", limits::QUANTITY),
            expected,
            span: 0..text.len(),
        };
        if text.len() > limits::QUANTITY {
            return Err(too_long());
        }
        let end = start + number_length(trimmed);
        let number = &text[start..end];
        let rest = &text[end..];
        if let Some(error) = bad_number(text, start, end, expected) {
            return Err(error);
        }
        let not_finite = || UnitError::NotFinite {
            text: shortened(number),
            span: start..end,
        };
        let value: f64 = number.parse().map_err(|_| not_finite())?;
        // Written with a blank between number and unit it must be read again.
        let written = number.len() + 1 + rest.trim().len();
        if written > limits::QUANTITY {
            return Err(too_long());
        }
        if rest.trim().is_empty() {
            let number = shortened(number);
            return Err(UnitError::MissingUnit {
                number,
                expected,
                span: start..end,
            });
        }
        let unit_start = end + (rest.len() - rest.trim_start().len());
        let unit = Unit::parse_at(text[unit_start..].trim_end(), unit_start)?;
        if !value.is_finite() || !(value * unit.factor()).is_finite() {
            return Err(not_finite());
        }
        Ok(Quantity {
            text: text.into(),
            value,
            unit,
            unit_start,
        })
    }
}

/// Returns the length in bytes of the number a text begins with: `[+-] digits [. digits] [e [+-] digits]`.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |mut at: usize| {
        while bytes.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        at
    };
    let sign = |at: usize| at + usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let start = sign(0);
    let mut end = digits(start);
    let mut any = end > start;
    if bytes.get(end) == Some(&b'.') {
        let fraction = digits(end + 1);
        any |= fraction > end + 1;
        end = fraction;
    }
    if !any {
        return 0;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let exponent = sign(end + 1);
        let after = digits(exponent);
        if after > exponent {
            end = after;
        }
    }
    end
}

/// Returns the error of the number in `text[start..end]`, judged also by what follows it.
fn bad_number(text: &str, start: usize, end: usize, expected: Option<Kind>) -> Option<UnitError> {
    let rest = &text[end..];
    let word = rest.split(char::is_whitespace).next().unwrap_or("");
    let span = start..end + word.len();
    let bad = |reason: &str| {
        let text = shortened(&text[span.clone()]);
        Some(UnitError::BadNumber {
            text,
            reason: reason.into(),
            expected,
            span: span.clone(),
        })
    };
    let digit_after = |mark: char| {
        rest.strip_prefix(mark)
            .is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
    };
    if end == start {
        let name = word.trim_start_matches(['+', '-']).to_lowercase();
        if ["nan", "inf", "infinity"].contains(&name.as_str()) {
            return Some(UnitError::NotFinite {
                text: shortened(word),
                span,
            });
        }
        return bad("a quantity begins with a number");
    }
    if digit_after(',') {
        return bad("write a decimal point, and no separators of thousands");
    }
    if digit_after('_') {
        return bad("write the digits without underscores");
    }
    if digit_after('.') || rest.starts_with('.') {
        return bad("it has two decimal points");
    }
    None
}

/// A number in the shortest form that reads back to the same bits: with an exponent where it would have many
/// zeros.
#[derive(Clone, Copy, Debug)]
pub struct Number(pub f64);

impl fmt::Display for Number {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || (1e-5..1e16).contains(&size) {
            write!(out, "{}", self.0)
        } else {
            write!(out, "{:e}", self.0)
        }
    }
}

/// A number in a message, such as a time: at most six significant digits.
#[derive(Clone, Copy, Debug)]
pub struct SixDigits(pub f64);

impl fmt::Display for SixDigits {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        // What was written is read back to the same digits; what is no number stays what it is.
        let rounded = format!("{:.5e}", self.0).parse().unwrap_or(self.0);
        Number(rounded).fmt(out)
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.pad(&self.text)
    }
}

impl PartialEq for Quantity {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl FromStr for Quantity {
    type Err = UnitError;

    fn from_str(text: &str) -> Result<Self, UnitError> {
        Self::parse(text)
    }
}

impl Serialize for Quantity {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.text)
    }
}

impl<'de> Deserialize<'de> for Quantity {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        Self::parse(&text).map_err(serde::de::Error::custom)
    }
}
