//! Values laid over a half-truck's files and settings: `PATH=VALUE`, as `--set` and studies take them.
//!
//! | path | value |
//! |---|---|
//! | `simulation.duration`, `simulation.output_interval` | a time |
//! | `simulation.relative_tolerance` | a number between 0 and 1 |
//! | `simulation.start` | `drawn` or `equilibrium` |
//! | `simulation.output_units` | `us` or `si` |
//! | `option.NAME` | a choice where the files leave one open: [`options`] |
//! | anything else | a value in the files: [`nucars::set`] |

use std::borrow::Cow;

use input::shortened;
use nucars::tree::{InputFile, SystemFile};
use quantity::{Kind, Quantity, System as Units, nearest};
use thiserror::Error;

use super::HalfTruckStart;
use super::files::Settings;
use super::options::{self, OptionError};

/// A value that cannot be set.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum SetError {
    /// There is no `=`.
    #[error("`{0}` is not of the form PATH=VALUE; write for example wedges.column_friction=0.3")]
    Form(String),
    /// One of the files' values.
    #[error(transparent)]
    File(#[from] nucars::set::SetError),
    /// One of the options.
    #[error(transparent)]
    Option(#[from] OptionError),
    /// There is no such setting.
    #[error("`simulation` has no `{name}`; {hint}")]
    Unknown {
        /// As typed.
        name: String,
        /// The nearest name, or all.
        hint: String,
    },
    /// The value is none of its kind.
    #[error("`{value}` is no value of `simulation.{name}`; expected: {expected}")]
    Value {
        /// The setting.
        name: &'static str,
        /// As typed.
        value: String,
        /// The admissible values.
        expected: &'static str,
    },
}

impl SetError {
    /// Returns whether the path is right and the value wrong.
    pub(crate) fn is_about_value(&self) -> bool {
        matches!(
            self,
            Self::Value { .. }
                | Self::File(nucars::set::SetError::Value { .. })
                | Self::Option(OptionError::Value { .. })
        )
    }
}

/// The settings below `simulation`, and what is expected of each.
const SIMULATION: [(&str, &str); 5] = [
    ("duration", "a positive time, such as \"10 s\""),
    ("output_interval", "a positive time, such as \"0.01 s\""),
    (
        "relative_tolerance",
        "a number between 0 and 1, both excluded, such as 1e-5",
    ),
    ("start", "\"drawn\" or \"equilibrium\""),
    ("output_units", "\"us\" or \"si\""),
];

/// Lays one value over settings and trees.
///
/// # Errors
/// [`SetError`]; nothing has changed then.
pub fn apply(
    typed: &str,
    settings: &mut Settings,
    system: &mut Cow<'_, SystemFile>,
    input: Option<&mut Cow<'_, InputFile>>,
) -> Result<(), SetError> {
    let (path, value) = typed
        .split_once('=')
        .map(|(path, value)| (path.trim(), value.trim()))
        .filter(|(path, value)| !path.is_empty() && !value.is_empty())
        .ok_or_else(|| SetError::Form(shortened(typed)))?;
    if let Some(name) = path.strip_prefix("simulation.") {
        return simulation(settings, name, value.trim_matches(['"', '\'']));
    }
    if let Some(name) = path.strip_prefix("option.") {
        return Ok(options::set(&mut settings.choices, &format!("{name}={value}"))?);
    }
    nucars::set::set(system.to_mut(), input.map(Cow::to_mut), path, value)?;
    Ok(())
}

fn simulation(settings: &mut Settings, name: &str, value: &str) -> Result<(), SetError> {
    let names = || SIMULATION.iter().map(|(name, _)| *name);
    let Some((name, expected)) = SIMULATION.into_iter().find(|(own, _)| *own == name) else {
        let hint = match nearest(name, names()) {
            Some(near) => format!("did you mean {near}?"),
            None => format!("it has {}", names().collect::<Vec<_>>().join(", ")),
        };
        return Err(SetError::Unknown {
            name: shortened(name),
            hint,
        });
    };
    let wrong = || SetError::Value {
        name,
        value: shortened(value),
        expected,
    };
    let time = || {
        let time = Quantity::parse_as(value, Kind::Time)
            .map_err(|_| wrong())?
            .to_si();
        Some(time)
            .filter(|time| *time > 0.0 && time.is_finite())
            .ok_or_else(wrong)
    };
    match name {
        "duration" => settings.duration = Some(time()?),
        "output_interval" => settings.interval = time()?,
        "relative_tolerance" => {
            let tolerance = value.parse().ok().filter(|own| *own > 0.0 && *own < 1.0);
            settings.relative_tolerance = tolerance.ok_or_else(wrong)?;
        }
        "start" => {
            settings.start = match value {
                "drawn" => HalfTruckStart::Drawn,
                "equilibrium" => HalfTruckStart::Equilibrium,
                _ => return Err(wrong()),
            };
        }
        _ => {
            settings.units = match value {
                "us" => Units::Us,
                "si" => Units::Si,
                _ => return Err(wrong()),
            };
        }
    }
    Ok(())
}
