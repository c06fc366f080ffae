//! The root locus of a car over any one parameter of its case: the vibrations about steady running at a
//! speed, with friction stuck and absent, for evenly spaced values of the parameter.
//!
//! Each value is a case of its own, read again with the key set, so that everything that follows from the key
//! follows here too. As in [`stability`](crate::car::stability) the car runs on straight track without
//! irregularities.

use std::ops::ControlFlow;

use car::{FrictionState, LinearizeError, vibrations};
use quantity::nearest;
use thiserror::Error;

use crate::car::CarCase;
use crate::car::stability::{BranchKind, NamedMode, named, steady, straight};
use crate::case::CaseError;
use crate::case::field::Input;
use crate::design::{Factor, Levels, Value};

/// The way in which a range is written.
const FORM: &str = "write for example \"truck.center_plate.friction=0.1..0.4\" or \
                    \"truck.load_springs.shear_stiffness=2000 lbf/in..5000 lbf/in\"";
/// Growth (1/s) and frequency (Hz) that differ by no more than this are the same.
const SAME: f64 = 1e-3;

/// A key of a case and the values that it takes, evenly spaced between two ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Vary {
    factor: Factor,
    values: Vec<Value>,
}

/// Reasons why a text says no range of a key.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum VaryError {
    /// There is no key, or nothing after it.
    #[error("`{0}` is no KEY=FROM..TO")]
    NoKey(String),
    /// There is no range after the key.
    #[error("`{key}={range}` is no range: there is no `..` between two ends")]
    NoRange {
        /// The key.
        key: String,
        /// The text after it.
        range: String,
    },
    /// An end is no number.
    #[error("`{end}`, an end of the range of {key}, is neither a number nor one with a unit")]
    NoNumber {
        /// The key.
        key: String,
        /// The text of the end.
        end: String,
    },
    /// The ends have different units.
    #[error("the range of {key} goes from `{from}` to `{to}`: the units differ")]
    Units {
        /// The key.
        key: String,
        /// The first end.
        from: String,
        /// The last end.
        to: String,
    },
    /// Both ends are the same.
    #[error("the range of {key} is one value only, {value}")]
    OneValue {
        /// The key.
        key: String,
        /// The value.
        value: String,
    },
    /// There are fewer than two values.
    #[error("{0} values make no range")]
    Steps(u32),
    /// The key takes something else.
    #[error("{key} is no number: it is {now}")]
    NotNumber {
        /// The key.
        key: String,
        /// Its value in the case.
        now: String,
        /// The key of a number that is nearest to it; may be missing.
        near: Option<String>,
    },
}

impl VaryError {
    /// Returns the advice.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Units { .. } => "give both ends in the same unit, or both without".to_owned(),
            Self::OneValue { .. } => "give two different ends".to_owned(),
            Self::Steps(_) => "take at least 2".to_owned(),
            Self::NotNumber { near: Some(near), .. } => {
                format!("take the key of a number, such as {near}")
            }
            Self::NotNumber { .. } => "take the key of a number".to_owned(),
            Self::NoKey(_) | Self::NoRange { .. } | Self::NoNumber { .. } => FORM.to_owned(),
        }
    }
}

impl Vary {
    /// Reads `KEY=FROM..TO`; `steps` is the number of values, both ends among them.
    ///
    /// # Errors
    /// [`VaryError`].
    pub fn parse(text: &str, steps: u32) -> Result<Self, VaryError> {
        if steps < 2 {
            return Err(VaryError::Steps(steps));
        }
        let parts = text
            .split_once('=')
            .map(|(key, range)| (key.trim(), range.trim()));
        let Some((key, range)) = parts.filter(|(key, range)| !key.is_empty() && !range.is_empty()) else {
            return Err(VaryError::NoKey(text.to_owned()));
        };
        let key = key.to_owned();
        let Some((from, to)) = range.split_once("..") else {
            let range = range.to_owned();
            return Err(VaryError::NoRange { key, range });
        };
        let end = |text: &str| match Value::of_number(&key, text.trim().trim_matches('"')) {
            Value::Number { value, unit } => Ok((value, unit)),
            Value::Toml(_) => Err(VaryError::NoNumber {
                key: key.clone(),
                end: text.trim().to_owned(),
            }),
        };
        let ((first, unit), (last, other)) = (end(from)?, end(to)?);
        if unit != other {
            let [from, to] = [from, to].map(|own| own.trim().to_owned());
            return Err(VaryError::Units { key, from, to });
        }
        if first == last {
            let value = Value::Number { value: first, unit };
            let value = value.shown().into_owned();
            return Err(VaryError::OneValue { key, value });
        }
        let levels = Levels::Range {
            from: first,
            to: last,
            unit,
            logarithmic: false,
            count: u64::from(steps),
        };
        let factor = Factor::new(vec![key], levels);
        let values = (0..u64::from(steps))
            .map(|number| plain(factor.level(number)))
            .collect();
        Ok(Self { factor, values })
    }

    /// Returns the key.
    #[must_use]
    pub fn key(&self) -> &str {
        self.factor.name()
    }

    /// Returns the unit of the values as typed; empty for pure numbers.
    #[must_use]
    pub fn unit(&self) -> &str {
        self.factor.unit().unwrap_or("")
    }

    /// Returns the values in that unit, both ends among them.
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        let unit = self.unit();
        self.values.iter().filter_map(|own| own.in_unit(unit)).collect()
    }

    /// Checks that the key is one of a number, if the case has it. Keys that it has not are left to the
    /// reader of cases, which knows those that may be left out.
    ///
    /// # Errors
    /// [`VaryError::NotNumber`].
    pub fn check(&self, case: &CarCase) -> Result<(), VaryError> {
        let fields = || case.fields().iter().flat_map(|section| &section.fields);
        let own = fields().find(|field| field.path == self.key());
        // Without a value it is not known what it takes.
        let Some(own) = own.filter(|own| !own.text.is_empty()) else {
            return Ok(());
        };
        if matches!(own.input, Input::Number(_)) {
            return Ok(());
        }
        let numbers = fields().filter(|field| matches!(field.input, Input::Number(_)));
        Err(VaryError::NotNumber {
            key: self.key().to_owned(),
            now: own.text.clone(),
            near: nearest(self.key(), numbers.map(|field| field.path.as_str())).map(str::to_owned),
        })
    }
}

/// Returns a value without the errors of a division: to twelve digits.
fn plain(value: Value) -> Value {
    match value {
        Value::Number { value, unit } => Value::Number {
            value: format!("{value:.11e}").parse().unwrap_or(value),
            unit,
        },
        other => other,
    }
}

/// Reasons why there is no root locus.
#[derive(Debug, Error)]
pub enum LocusError {
    /// A value makes no case.
    #[error("{key} = {value} makes no car: {error}")]
    Case {
        /// The key.
        key: String,
        /// The value.
        value: String,
        /// What is wrong with it.
        error: Box<CaseError>,
    },
    /// The car of a value cannot be linearized.
    #[error("with {key} = {value} the car cannot be linearized: {error}")]
    Linearize {
        /// The key.
        key: String,
        /// The value.
        value: String,
        /// The reason.
        error: Box<LinearizeError>,
    },
}

/// The vibrations over the values with friction in one state.
#[derive(Clone, Debug, PartialEq)]
pub struct LocusBranch {
    /// What friction does.
    pub kind: BranchKind,
    /// Vibrations at each value, by falling growth.
    pub modes: Vec<Vec<NamedMode>>,
}

/// The root locus over a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Locus {
    /// The key of the parameter.
    pub key: String,
    /// The unit of its values as typed; empty for pure numbers.
    pub unit: String,
    /// Its values, in that unit; fewer where the user stopped it.
    pub values: Vec<f64>,
    /// Speed of the car, m/s.
    pub speed: f64,
    /// Friction stuck, then absent.
    pub branches: [LocusBranch; 2],
    /// True if all values were computed.
    pub complete: bool,
}

/// Returns the vibrations at a speed (m/s) for each value. `read` reads the case with an override
/// (`key=value`) laid over it; all cases are read before anything is computed. `go_on` receives the share
/// that is done.
///
/// # Errors
/// [`LocusError`], which names the value.
pub fn locus(
    vary: &Vary,
    speed: f64,
    read: impl Fn(&[String]) -> Result<CarCase, CaseError>,
    mut go_on: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Locus, LocusError> {
    let key = || vary.key().to_owned();
    let mut cases = Vec::new();
    for value in &vary.values {
        let case = read(&vary.factor.overrides(value)).map_err(|error| LocusError::Case {
            key: key(),
            value: value.shown().into_owned(),
            error: Box::new(error),
        })?;
        cases.push(case);
    }
    let mut found = Locus {
        key: key(),
        unit: vary.unit().to_owned(),
        values: Vec::new(),
        speed,
        branches: [BranchKind::Stuck, BranchKind::Absent].map(|kind| LocusBranch {
            kind,
            modes: Vec::new(),
        }),
        complete: false,
    };
    for ((number, case), value) in cases.iter().enumerate().zip(vary.values()) {
        let modes = both(case, speed).map_err(|error| LocusError::Linearize {
            key: key(),
            value: vary.values[number].shown().into_owned(),
            error: Box::new(error),
        })?;
        found.values.push(value);
        for (branch, modes) in found.branches.iter_mut().zip(modes) {
            branch.modes.push(modes);
        }
        let stopped = go_on((number + 1) as f64 / cases.len() as f64).is_break();
        if stopped && number + 1 < cases.len() {
            return Ok(found);
        }
    }
    found.complete = true;
    Ok(found)
}

/// Returns the vibrations of a car with friction stuck and absent.
fn both(case: &CarCase, speed: f64) -> Result<[Vec<NamedMode>; 2], LinearizeError> {
    let mut car = steady(case, &straight(&case.parameters))?;
    let model = car.model(speed)?;
    let of = |friction: FrictionState| -> Result<Vec<NamedMode>, LinearizeError> {
        Ok(named(&car, &model, &vibrations(&model, friction.of(&model))?))
    };
    Ok([of(FrictionState::Stuck)?, of(FrictionState::Absent)?])
}

impl LocusBranch {
    /// Returns the vibration that grows most at a value, counted from 0; none if there is none.
    #[must_use]
    pub fn most(&self, number: usize) -> Option<&NamedMode> {
        self.modes.get(number)?.first()
    }
}

impl Locus {
    /// Returns whether the vibrations are the same at all values, to 0.001 1/s and 0.001 Hz: what only limits
    /// friction, such as a coefficient, stands neither in stuck nor in absent friction.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        let alike = |a: &[NamedMode], b: &[NamedMode]| {
            let near = |(a, b): (&NamedMode, &NamedMode)| {
                (a.growth - b.growth).abs() <= SAME && (a.frequency - b.frequency).abs() <= SAME
            };
            a.len() == b.len() && a.iter().zip(b).all(near)
        };
        let mut branches = self.branches.iter();
        self.values.len() > 1
            && branches.all(|own| own.modes.windows(2).all(|pair| alike(&pair[0], &pair[1])))
    }
}
