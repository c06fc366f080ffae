//! The text of an assessment's study: a row each regime, condition and speed.

use std::fmt::Write;
use std::sync::Arc;

use super::Request;
use super::conditions::Condition;
use crate::car::CarCase;
use crate::car::regime::{Regime, START, says_start};
use crate::case::problem::TomlSource;
use crate::case::{CaseError, overrides, tree};
use crate::models::{AnyCase, CaseSource};

/// Returns which conditions start shaken: those in which neither the case, nor --set, nor a regime, nor the
/// condition says how the car starts. A car on linear wheels and a vehicle are never shaken.
pub(super) fn is_shaken(
    request: &Request,
    (source, base): (&CaseSource, &AnyCase),
    regimes: &[Regime],
    conditions: &[Condition],
) -> Result<Vec<bool>, CaseError> {
    let CaseSource::File { name, text, .. } = source else {
        return Ok(vec![false; conditions.len()]);
    };
    let tree = tree::parse(&TomlSource::new(name.as_str(), text.as_str())).map_err(CaseError::new)?;
    let on_rails = |own: &Arc<CarCase>| matches!(own.parameters.wheels, ::car::Wheels::OnRails(_));
    let said = tree.place_of(START).is_some()
        || says_start(&request.set)
        || regimes.iter().any(|own| says_start(&own.set))
        || !base.car().is_some_and(on_rails);
    Ok(conditions
        .iter()
        .map(|own| !said && !says_start(&own.set))
        .collect())
}

/// Writes the study; `output` are windows of the rule, `shaken` says of each condition whether cars start
/// shaken in it.
pub(super) fn text(
    regimes: &[Regime],
    conditions: &[Condition],
    request: &Request,
    car: &AnyCase,
    (output, shaken): (&[String], Vec<bool>),
) -> Result<String, CaseError> {
    let is_empty = car.car().map(|own| own.parameters.lading.is_empty());
    let mut text = format!("case = \"{}\"\nsampling = \"list\"\n[set]\n", car.name());
    let lines = |text: &mut String, set: &[String]| {
        for own in set {
            // Writing into a text cannot fail.
            let _ = writeln!(text, "{own}");
        }
    };
    lines(&mut text, output);
    let set = request.set.iter().map(|own| overrides::to_toml(own));
    lines(
        &mut text,
        &set.collect::<Result<Vec<_>, _>>().map_err(CaseError::new)?,
    );
    let mut rows = String::new();
    for regime in regimes {
        let _ = writeln!(text, "[groups.regime.\"{}\"]", regime.name);
        let lading = match regime.lading.as_deref() {
            Some("loaded") if is_empty == Some(true) => Some("loaded"),
            Some("empty") if is_empty == Some(false) => Some("empty"),
            _ => None,
        };
        if let Some(lading) = lading {
            let _ = writeln!(text, "lading = {{ kind = \"{lading}\" }}");
        }
        lines(&mut text, &regime.everywhere());
        let speeds = match request.speeds.as_slice() {
            [] => regime.speeds.as_slice(),
            speeds => speeds,
        };
        for condition in conditions {
            for speed in speeds {
                let _ = writeln!(
                    rows,
                    "[[variants]]\nregime = \"{}\"\ncondition = \"{}\"",
                    regime.name, condition.name
                );
                lines(&mut rows, &regime.at(speed)?);
            }
        }
    }
    for (condition, shaken) in conditions.iter().zip(shaken) {
        let _ = writeln!(text, "[groups.condition.\"{}\"]", condition.name);
        lines(&mut text, &condition.set);
        if shaken {
            let _ = writeln!(text, "{START} = \"shaken\"");
        }
    }
    Ok(text + &rows)
}
