//! What the summaries beside the results say: models, energies per cycle, outcomes.

use std::collections::BTreeMap;
use std::path::Path;

use input::file::{Expected, Reason, read};
use input::{FileType, limits, shortened};
use quantity::{Kind, SixDigits, System as Units};
use serde::Deserialize;
use study::summary::SummaryValue;

use super::{ComparedResult, Energy};
use crate::summary;

/// The expected file of a summary.
const SUMMARY_FILE: Expected = Expected {
    what: "summary",
    types: &[FileType::Json],
    most: limits::RECORD_FILE,
};

/// The part of a summary that is read; only those of wedges have averages.
#[derive(Default, Deserialize)]
pub(super) struct SummaryPart {
    #[serde(default)]
    schema: String,
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
    #[serde(default)]
    energy_per_cycle: BTreeMap<String, SummaryValue>,
}

/// Schemas of the summaries of runs, and what they are about.
const MODELS: [(&str, &str); 6] = [
    (study::summary::SCHEMA, "a wedge"),
    (study::half_truck::SCHEMA, "a half-truck"),
    (study::truck::summary::SCHEMA, "a truck"),
    (study::car::summary::SCHEMA, "a car"),
    (study::vehicle::summary::SCHEMA, "a vehicle"),
    (study::wheelset::summary::SCHEMA, "a wheelset"),
];

impl SummaryPart {
    /// Returns what the run is about, as far as it is known.
    pub(super) fn model(&self) -> Option<&'static str> {
        let family = |schema: &str| schema.split('/').next().map(str::to_owned);
        let found = MODELS
            .iter()
            .find(|(schema, _)| family(schema) == family(&self.schema));
        found.map(|(_, model)| *model)
    }
}

/// Returns the summaries beside the results; an empty one where there is none or it cannot be read. Runs that
/// are not complete are noted.
pub(super) fn summaries(entries: &[ComparedResult], notes: &mut Vec<String>) -> Vec<SummaryPart> {
    let read = entries.iter().map(|entry| {
        let found = summary_beside(&entry.table.file).unwrap_or_else(|error| {
            let label = &entry.label;
            notes.push(format!(
                "The summary.json of {label} is left out, it cannot be read: {error}."
            ));
            None
        });
        let found = found.unwrap_or_default();
        notes.extend(unsound(&entry.label, &found));
        found
    });
    read.collect()
}

/// Returns energies per cycle of the results whose summaries have them, as the first one's has.
pub(super) fn energies(summaries: &[SummaryPart], units: Units) -> Vec<Energy> {
    let Some((first, others)) = summaries.split_first() else {
        return Vec::new();
    };
    let mut energies = Vec::new();
    for (place, own) in &first.averages.energy_per_cycle {
        for (k, other) in others.iter().enumerate() {
            let theirs = other.averages.energy_per_cycle.get(place);
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

/// Returns the summary beside the table of a run, if there is one.
fn summary_beside(file: &Path) -> Result<Option<SummaryPart>, String> {
    if !crate::table::is_of_run(file) {
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
