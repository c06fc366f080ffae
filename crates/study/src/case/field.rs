//! A case as a list of fields: what each value is, what may be typed there, how far a slider reaches.
//!
//! Written from the same lines as the commented case file ([`Case::to_toml`](super::Case::to_toml)), so that
//! texts stand in one place.

use quantity::{Kind, Quantity, System};
use serde::Serialize;

use super::section::{Names, name_of};
use super::units::in_system;

/// Fields under one heading.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FieldSection {
    /// The table's name in case files; empty for the top.
    pub name: String,
    /// A description of it; may be empty.
    pub about: String,
    /// Its fields, in the order of the case file.
    pub fields: Vec<Field>,
}

/// A value of a case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Field {
    /// Its path, as `--set` takes it: `wedge.angle`.
    pub path: String,
    /// The meaning; may be empty.
    pub help: String,
    /// The value there, as `--set` takes it; empty if it is left out.
    pub text: String,
    /// The admissible values.
    pub input: Input,
}

/// The input that a field admits.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Input {
    /// A number, with a unit or without.
    Number(TypedNumber),
    /// Three numbers in a list.
    Triple {
        /// The numbers.
        numbers: Box<[TypedNumber; 3]>,
    },
    /// One of several names.
    Choice {
        /// The names.
        choices: Vec<&'static str>,
    },
    /// Some of several names, in a list.
    Several {
        /// The names.
        choices: Vec<&'static str>,
        /// Those that are chosen.
        chosen: Vec<&'static str>,
    },
    /// Any text.
    Text,
    /// Anything else, as TOML: a motion, a table.
    Toml {
        /// The text in US customary units, if it is typed in others.
        #[serde(skip_serializing_if = "Option::is_none")]
        us: Option<String>,
        /// The text in SI units, if it is typed in others.
        #[serde(skip_serializing_if = "Option::is_none")]
        si: Option<String>,
    },
}

/// A number as typed, and a range about it for a slider.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TypedNumber {
    /// The number before the unit.
    pub value: f64,
    /// The unit as typed; empty for pure numbers.
    pub unit: String,
    /// Its value in SI units.
    pub si: f64,
    /// The kind of quantity that it measures.
    pub kind: Kind,
    /// Lower end of the suggested range, in the unit as typed.
    pub low: f64,
    /// Upper end of it.
    pub high: f64,
    /// True if steps should be ratios of the value, not differences: both ends are positive then.
    pub logarithmic: bool,
    /// Words after the unit that stand for a negative and a positive sign, such as `in` and `out`.
    pub signs: Option<[&'static str; 2]>,
    /// The same in US customary units, if the unit as typed is no such unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub in_us: Option<InUnits>,
    /// The same in SI units, if the unit as typed is no such unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub in_si: Option<InUnits>,
}

/// A number with its range in another unit; read, it gives the same SI value.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InUnits {
    /// The number with its unit.
    pub text: String,
    /// The number before the unit.
    pub value: f64,
    /// The unit.
    pub unit: String,
    /// Lower end of the suggested range, in this unit.
    pub low: f64,
    /// Upper end of it.
    pub high: f64,
}

/// The rule that suggests a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Reach {
    /// From half of a positive value to its double.
    Positive,
    /// From a tenth of a positive value to ten times it.
    Wide,
    /// From zero to twice the value, or to the SI value given where it is zero.
    FromZero(f64),
    /// Both ways, to twice its size, or to the SI value given where it is zero.
    Signed(f64),
    /// Between two SI values.
    Between(f64, f64),
}

/// A value of a case, as text and as what it is.
#[derive(Clone)]
pub(crate) struct Written {
    pub toml: String,
    pub input: Input,
}

impl TypedNumber {
    pub(crate) fn of(quantity: &Quantity, kind: Kind, reach: Reach) -> Self {
        let (value, si) = (quantity.value(), quantity.to_si());
        // All units that can be typed are multiples of the SI unit.
        let unit = Quantity::new(1.0, quantity.unit_text()).map_or(1.0, |one| one.to_si());
        let mut own = Self::new(value, quantity.unit_text(), si, unit, kind, reach);
        own.in_us = own.other(quantity, unit, System::Us);
        own.in_si = own.other(quantity, unit, System::Si);
        own
    }

    /// Returns the same in a unit of a system, if that is another one; `size` is that of the unit as typed.
    fn other(&self, quantity: &Quantity, size: f64, system: System) -> Option<InUnits> {
        let other = in_system(quantity, self.kind, system);
        let one = Quantity::new(1.0, other.unit_text()).ok()?.to_si();
        (other != *quantity).then(|| InUnits {
            text: other.text().to_owned(),
            value: other.value(),
            unit: other.unit_text().to_owned(),
            low: self.low * size / one,
            high: self.high * size / one,
        })
    }

    fn new(value: f64, unit: &str, si: f64, size: f64, kind: Kind, reach: Reach) -> Self {
        let (low, high) = match reach {
            Reach::Positive => (0.5 * value, 2.0 * value),
            Reach::Wide => (0.1 * value, 10.0 * value),
            Reach::FromZero(_) if value != 0.0 => (0.0, 2.0 * value),
            Reach::FromZero(most) => (0.0, most / size),
            Reach::Signed(_) if value != 0.0 => (-2.0 * value.abs(), 2.0 * value.abs()),
            Reach::Signed(most) => (-most / size, most / size),
            Reach::Between(low, high) => (low / size, high / size),
        };
        Self {
            value,
            unit: unit.to_owned(),
            si,
            kind,
            low,
            high,
            logarithmic: reach == Reach::Wide,
            signs: None,
            in_us: None,
            in_si: None,
        }
    }
}

impl Written {
    pub fn quantity(quantity: &Quantity, kind: Kind, reach: Reach) -> Self {
        Self {
            toml: quoted(quantity.text()),
            input: Input::Number(TypedNumber::of(quantity, kind, reach)),
        }
    }

    pub fn triple(quantities: &[Quantity; 3], kind: Kind, reach: Reach) -> Self {
        let [a, b, c] = quantities.each_ref().map(|one| quoted(one.text()));
        Self {
            toml: format!("[{a}, {b}, {c}]"),
            input: Input::Triple {
                numbers: Box::new(quantities.each_ref().map(|one| TypedNumber::of(one, kind, reach))),
            },
        }
    }

    /// Returns a pure number: the shortest decimal that reads back to the same bits.
    pub fn number(number: f64, reach: Reach) -> Self {
        Self {
            toml: format!("{number:?}"),
            input: Input::Number(TypedNumber::new(
                number,
                "",
                number,
                1.0,
                Kind::Dimensionless,
                reach,
            )),
        }
    }

    pub fn choice<T: PartialEq>(names: Names<T>, chosen: &T) -> Self {
        // Older names of a choice are read, not offered.
        let is_own = |(name, choice): &&(&'static str, T)| name_of(names, choice) == *name;
        Self {
            toml: quoted(name_of(names, chosen)),
            input: Input::Choice {
                choices: names.iter().filter(is_own).map(|(name, _)| *name).collect(),
            },
        }
    }

    pub fn several<T: PartialEq>(names: Names<T>, chosen: &[T]) -> Self {
        let chosen: Vec<&str> = chosen.iter().map(|one| name_of(names, one)).collect();
        let list: Vec<String> = chosen.iter().map(|name| quoted(name)).collect();
        Self {
            toml: format!("[{}]", list.join(", ")),
            input: Input::Several {
                choices: names.iter().map(|(name, _)| *name).collect(),
                chosen,
            },
        }
    }

    pub fn truth(truth: bool) -> Self {
        Self {
            toml: truth.to_string(),
            input: Input::Choice {
                choices: vec!["true", "false"],
            },
        }
    }

    pub fn text(text: &str) -> Self {
        Self {
            toml: quoted(text),
            input: Input::Text,
        }
    }

    pub fn toml(toml: String) -> Self {
        Self {
            toml,
            input: Input::Toml { us: None, si: None },
        }
    }

    /// TOML with quantities in it, which `of` writes in the units of a system, or as typed.
    pub fn toml_in_units(of: impl Fn(Option<System>) -> String) -> Self {
        let toml = of(None);
        let other = |system| Some(of(Some(system))).filter(|text| *text != toml);
        let (us, si) = (other(System::Us), other(System::Si));
        Self {
            toml,
            input: Input::Toml { us, si },
        }
    }

    /// Returns the text that a user types for it: quantities and names without quotes.
    pub fn typed(&self) -> String {
        match &self.input {
            Input::Number(_) | Input::Choice { .. } | Input::Text => {
                unquoted(&self.toml).unwrap_or_else(|| self.toml.clone())
            }
            _ => self.toml.clone(),
        }
    }
}

/// Returns a text as TOML.
pub(crate) fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

fn unquoted(toml: &str) -> Option<String> {
    let table: toml::Table = format!("value = {toml}").parse().ok()?;
    Some(table.get("value")?.as_str()?.to_owned())
}
