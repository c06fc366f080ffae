//! Energies per cycle and outcomes, from the summaries beside the results.

use std::collections::BTreeMap;
use std::path::Path;

use input::file::{Expected, Reason, read};
use input::{FileType, limits, shortened};
use quantity::{Kind, SixDigits, System as Units};
use serde::Deserialize;
use study::summary::SummaryValue;

use super::{ComparedResult, Energy};
use crate::{csv, summary};

/// The expected file of a summary.
const SUMMARY_FILE: Expected = Expected {
    what: "summary",
    types: &[FileType::Json],
    most: limits::RECORD_FILE,
};

/// The part of a summary that is read.
#[derive(Deserialize)]
struct SummaryPart {
    #[serde(default)]
    averages: AveragesPart,
    stopped: Option<EndPart>,
    #[serde(alias = "derailment")]
    derailed: Option<EndPart>,
    failed: Option<String>,
}

/// The end of a run before its time.
#[derive(Deserialize)]
struct EndPart {
    time: f64,
}

#[derive(Default, Deserialize)]
struct AveragesPart {
    energy_per_cycle: BTreeMap<String, SummaryValue>,
}

/// Energies per cycle of the results whose summaries have them, as the first one's has.
pub(super) fn energies(entries: &[ComparedResult], units: Units, notes: &mut Vec<String>) -> Vec<Energy> {
    let mut read = entries
        .iter()
        .map(|entry| match summary_beside(&entry.table.file) {
            Ok(found) => found.map(|part| {
                notes.extend(unsound(&entry.label, &part));
                part.averages.energy_per_cycle
            }),
            Err(error) => {
                let label = &entry.label;
                notes.push(format!(
                    "The summary.json of {label} is left out, it cannot be read: {error}."
                ));
                None
            }
        });
    let first = read.next().flatten().unwrap_or_default();
    let others: Vec<_> = read.collect();
    let mut energies = Vec::new();
    for (place, own) in &first {
        for (k, other) in others.iter().enumerate() {
            let theirs = other.as_ref().and_then(|all| all.get(place));
            if let (Some(first), Some(value)) =
                (energy(own, units), theirs.and_then(|one| energy(one, units)))
            {
                energies.push(Energy {
                    place: place.clone(),
                    unit: Kind::Energy.label(units),
                    result: k + 1,
                    value,
                    first,
                });
            }
        }
    }
    energies
}

/// Returns the note on a run that is not complete.
fn unsound(label: &str, part: &SummaryPart) -> Option<String> {
    let ends = [("derailed", &part.derailed), ("stopped", &part.stopped)];
    let ended = ends
        .into_iter()
        .find_map(|(verb, end)| Some((verb, end.as_ref()?.time)));
    match (ended, &part.failed) {
        (Some((verb, time)), _) => Some(format!(
            "{label} {verb} at {} s and is incomplete: its numbers are of the part until then.",
            SixDigits(time)
        )),
        (None, Some(_)) => Some(format!("{label} has failed: do not use its numbers.")),
        (None, None) => None,
    }
}

/// Returns the summary beside a `result.csv`, if there is one.
fn summary_beside(file: &Path) -> Result<Option<SummaryPart>, String> {
    if file.file_name().is_none_or(|name| name != csv::FILE_NAME) {
        return Ok(None);
    }
    match read(&file.with_file_name(summary::FILE_NAME), &SUMMARY_FILE) {
        Ok(bytes) => serde_json::from_slice(&bytes)
            .map(Some)
            .map_err(|error| shortened(&error.to_string())),
        Err(error) if matches!(error.reason, Reason::NotFound) => Ok(None),
        Err(error) => Err(error.to_string()),
    }
}

/// Returns an energy in these units.
fn energy(measure: &SummaryValue, units: Units) -> Option<f64> {
    let own = [Units::Us, Units::Si]
        .into_iter()
        .find(|own| Kind::Energy.label(*own) == measure.unit)?;
    let value = match own == units {
        true => measure.value,
        false => measure.value / Kind::Energy.from_si(own) * Kind::Energy.from_si(units),
    };
    // An energy edited by hand, beyond what numbers can hold.
    value.is_finite().then_some(value)
}
