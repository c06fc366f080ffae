//! The factors of a study: parameters by their paths, and the values that they take.

use std::borrow::Cow;

use quantity::{Number, Quantity};
use serde::Serialize;

/// A value as a case file takes it.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// A number with its unit; pure numbers have none. A toe is positive out.
    Number {
        /// The number.
        value: f64,
        /// Its unit as typed.
        unit: String,
    },
    /// Anything else, as TOML: names in quotes, motions, lists.
    Toml(String),
}

impl Value {
    /// Returns the value as TOML in a case file under `path`.
    #[must_use]
    pub fn to_toml(&self, path: &str) -> String {
        match self {
            Self::Number { value, unit } if unit.is_empty() => Number(*value).to_string(),
            Self::Number { value, unit } if is_toe(path) => {
                let direction = match value {
                    value if *value > 0.0 => " out",
                    value if *value < 0.0 => " in",
                    _ => "",
                };
                format!("\"{} {unit}{direction}\"", Number(value.abs()))
            }
            Self::Number { value, unit } => format!("\"{} {unit}\"", Number(*value)),
            Self::Toml(text) => text.clone(),
        }
    }

    /// Returns it as a table shows it, without quotes.
    #[must_use]
    pub fn shown(&self) -> Cow<'_, str> {
        match self {
            Self::Number { value, unit } if unit.is_empty() => {
                Cow::Owned(Number(rounded(*value)).to_string())
            }
            Self::Number { value, unit } => Cow::Owned(format!("{} {unit}", Number(rounded(*value)))),
            Self::Toml(text) => Cow::Borrowed(text.trim_matches('"')),
        }
    }

    /// Returns a text of a case file under `path`: a quantity or a toe, if it is one.
    #[must_use]
    pub fn of_text(path: &str, text: &str) -> Self {
        let quoted = || Self::Toml(toml::Value::from(text).to_string());
        let (magnitude, sign) = match is_toe(path).then(|| text.trim_end().rsplit_once(char::is_whitespace)) {
            Some(Some((angle, "out"))) => (angle, 1.0),
            Some(Some((angle, "in"))) => (angle, -1.0),
            _ => (text, 1.0),
        };
        match Quantity::parse(magnitude.trim()) {
            // A toe is said in words; what has a sign is refused with them.
            Ok(toe) if is_toe(path) && (toe.value() < 0.0 || toe.value().is_nan()) => quoted(),
            // Zero has one sign only.
            Ok(quantity) => Self::Number {
                value: sign * quantity.value() + 0.0,
                unit: quantity.unit_text().to_owned(),
            },
            Err(_) => quoted(),
        }
    }

    /// Makes it of a number typed without quotes: a pure number, or as [`Value::of_text`].
    #[must_use]
    pub fn of_number(path: &str, text: &str) -> Self {
        match text.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => Self::Number {
                value,
                unit: String::new(),
            },
            _ => Self::of_text(path, text),
        }
    }

    /// Returns the same number in another unit; `None` if it measures something else.
    #[must_use]
    pub fn in_unit(&self, unit: &str) -> Option<f64> {
        let Self::Number { value, unit: own } = self else {
            return None;
        };
        if own == unit {
            return Some(*value);
        }
        let (from, to) = (Quantity::new(1.0, own).ok()?, Quantity::new(1.0, unit).ok()?);
        (from.dimension() == to.dimension()).then(|| value * from.to_si() / to.to_si())
    }
}

/// Returns a number without the errors of a division or conversion: to twelve digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

/// Returns whether a path is that of a toe, of all columns or of one wedge's, whose direction is said in
/// words.
fn is_toe(path: &str) -> bool {
    path.rsplit('.').next() == Some("toe")
}

/// The values that a parameter takes.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Levels {
    /// These.
    Values(Vec<Value>),
    /// All between two numbers of one unit.
    Range {
        /// The first.
        from: f64,
        /// The last.
        to: f64,
        /// Their unit as typed; empty for pure numbers.
        unit: String,
        /// True if steps are ratios, false if differences; both ends are positive if true.
        logarithmic: bool,
        /// Their number in a full factorial study.
        count: u64,
    },
}

/// Values of several parameters under one name.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Group {
    /// Its name.
    pub name: String,
    /// Its settings, as `--set` takes them.
    pub set: Vec<String>,
}

/// A parameter that is varied, and those that take the same value with it; or groups of values.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Factor {
    /// The paths, as `--set` takes them; the first one names it. Of groups: their common name.
    pub paths: Vec<String>,
    /// Its values; of groups, their names.
    pub levels: Levels,
    /// The meanings of its values, if they are names of groups.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub groups: Vec<Group>,
}

impl Factor {
    /// Returns a factor of these paths and values.
    #[must_use]
    pub fn new(paths: Vec<String>, levels: Levels) -> Self {
        Self {
            paths,
            levels,
            groups: Vec::new(),
        }
    }

    /// Returns its name: the first path.
    #[must_use]
    pub fn name(&self) -> &str {
        self.paths.first().map_or("", String::as_str)
    }

    /// Returns the settings of one of its values, as `--set` takes them.
    #[must_use]
    pub fn overrides(&self, value: &Value) -> Vec<String> {
        if !self.groups.is_empty() {
            let name = value.shown();
            let group = self.groups.iter().find(|group| group.name == name);
            return group.map(|group| group.set.clone()).unwrap_or_default();
        }
        let paths = self.paths.iter();
        paths
            .map(|path| format!("{path}={}", value.to_toml(path)))
            .collect()
    }

    /// Returns the number of its values in a full factorial study.
    #[must_use]
    pub fn count(&self) -> u64 {
        match &self.levels {
            Levels::Values(values) => values.len() as u64,
            Levels::Range { count, .. } => *count,
        }
    }

    /// Returns the unit of its numbers; `None` if it has values that are none, or of several dimensions.
    #[must_use]
    pub fn unit(&self) -> Option<&str> {
        match &self.levels {
            Levels::Range { unit, .. } => Some(unit),
            Levels::Values(values) => match values.first()? {
                Value::Number { unit, .. } => values
                    .iter()
                    .all(|value| value.in_unit(unit).is_some())
                    .then_some(unit),
                Value::Toml(_) => None,
            },
        }
    }

    /// Returns the value of this number in a full factorial study.
    #[must_use]
    pub fn level(&self, number: u64) -> Value {
        match &self.levels {
            Levels::Values(values) => pick(values, number),
            Levels::Range { count, .. } if *count > 1 => {
                // The last one is the end to the last bit.
                self.at(number as f64 / (*count - 1) as f64)
            }
            Levels::Range { .. } => self.at(0.0),
        }
    }

    /// Returns the value at a coordinate from 0 to 1: of a list, each has an equal part of it.
    #[must_use]
    pub fn at(&self, coordinate: f64) -> Value {
        match &self.levels {
            Levels::Values(values) => {
                let number = (coordinate * values.len() as f64).floor() as u64;
                pick(values, number.min(values.len().saturating_sub(1) as u64))
            }
            Levels::Range {
                from,
                to,
                unit,
                logarithmic,
                ..
            } => {
                let value = match coordinate {
                    0.0 => *from,
                    1.0 => *to,
                    share if *logarithmic => from * libm::pow(to / from, share),
                    share => from + (to - from) * share,
                };
                Value::Number {
                    value,
                    unit: unit.clone(),
                }
            }
        }
    }
}

fn pick(values: &[Value], number: u64) -> Value {
    let found = usize::try_from(number).ok().and_then(|number| values.get(number));
    found.cloned().unwrap_or(Value::Toml(String::new()))
}
