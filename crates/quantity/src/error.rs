//! Errors in the text of a quantity.

use crate::{Dimension, Kind, System};
use std::ops::Range;
use thiserror::Error;

/// The mistakes in the text of a quantity. Its message says what was found and what was expected,
/// [`UnitError::help`] what to write instead, [`UnitError::span`] where.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum UnitError {
    /// There is nothing.
    #[error("a number with a unit is missing")]
    Empty {
        /// The expected kind, if that is known.
        expected: Option<Kind>,
    },
    /// A number stands alone.
    #[error("the unit is missing{}", expected_clause(*.expected))]
    MissingUnit {
        /// The number as typed.
        number: String,
        /// The expected kind, if that is known.
        expected: Option<Kind>,
        /// The place, in bytes of the text.
        span: Range<usize>,
    },
    /// The text does not begin with a number.
    #[error("\"{text}\" is not a number: {reason}")]
    BadNumber {
        /// The text in place of a number.
        text: String,
        /// The reason.
        reason: String,
        /// The expected kind, if that is known.
        expected: Option<Kind>,
        /// The place, in bytes of the text.
        span: Range<usize>,
    },
    /// Not a number, infinite, or too large to compute with.
    #[error("\"{text}\" is not a finite number")]
    NotFinite {
        /// The number as typed.
        text: String,
        /// The place, in bytes of the text.
        span: Range<usize>,
    },
    /// No unit has this name.
    #[error("there is no unit \"{unit}\"")]
    UnknownUnit {
        /// The name as typed.
        unit: String,
        /// The name that may have been meant.
        nearest: Option<String>,
        /// The place, in bytes of the text.
        span: Range<usize>,
    },
    /// The units do not combine to one.
    #[error("this unit cannot be read: {reason}")]
    BadExpression {
        /// The reason.
        reason: String,
        /// The place, in bytes of the text.
        span: Range<usize>,
    },
    /// A quantity of another kind than expected.
    #[error("this is {} ({unit}); {} is expected", Kind::describe(*.found), .expected.name())]
    WrongDimension {
        /// The number as typed.
        number: String,
        /// The unit as typed.
        unit: String,
        /// Its dimension.
        found: Dimension,
        /// The expected kind.
        expected: Kind,
        /// The place of the unit, in bytes of the text.
        span: Range<usize>,
    },
}

fn expected_clause(expected: Option<Kind>) -> String {
    expected.map_or_else(String::new, |kind| format!("; {} is expected", kind.name()))
}

impl UnitError {
    /// Returns the place of the mistake: a range of bytes of the text that was read.
    pub fn span(&self) -> Range<usize> {
        match self {
            UnitError::Empty { .. } => 0..0,
            UnitError::MissingUnit { span, .. }
            | UnitError::BadNumber { span, .. }
            | UnitError::NotFinite { span, .. }
            | UnitError::UnknownUnit { span, .. }
            | UnitError::BadExpression { span, .. }
            | UnitError::WrongDimension { span, .. } => span.clone(),
        }
    }

    /// Returns the advice: what to write instead.
    pub fn help(&self) -> String {
        match self {
            UnitError::Empty { expected } => example("1", *expected),
            UnitError::MissingUnit { number, expected, .. } => example(number, *expected),
            UnitError::BadNumber { expected, .. } => example("1.5", *expected),
            UnitError::NotFinite { .. } => "write a finite number".into(),
            UnitError::UnknownUnit {
                nearest: Some(nearest),
                ..
            } => {
                format!("did you mean {nearest}?")
            }
            UnitError::UnknownUnit { nearest: None, .. } => {
                "units are, for example, in, mm, lbf, kip, N, lb, kg, s, deg, rad, Hz, and \
                 compounds such as lbf/in, lbf s/in, N/mm"
                    .into()
            }
            UnitError::BadExpression { .. } => {
                "write products with a space, quotients with /, powers with ^: \"lbf s/in\", \
                 \"lb in^2\""
                    .into()
            }
            UnitError::WrongDimension {
                number,
                unit,
                found,
                expected,
                ..
            } => {
                let example = example(number, Some(*expected));
                let names_pound = unit.split(|c: char| !c.is_alphabetic()).any(|name| name == "lb");
                let rate = *found == Dimension::new(0, 0, -1, 0);
                if names_pound && *expected != Kind::Mass && *expected != Kind::Inertia {
                    format!("lb is a mass, lbf the force: {example}")
                } else if rate && expected.dimension().angle == 1 {
                    format!("say whether radians or cycles are meant: {example}, or Hz for cycles")
                } else {
                    example
                }
            }
        }
    }
}

fn example(number: &str, expected: Option<Kind>) -> String {
    let kind = expected.unwrap_or(Kind::Length);
    let (us, si) = (kind.unit(System::Us), kind.unit(System::Si));
    if us.is_empty() {
        format!("write for example {number}")
    } else if us == si {
        format!("write for example \"{number} {us}\"")
    } else {
        format!("write for example \"{number} {us}\", or another unit such as {si}")
    }
}
