//! Another assessment, beside which one is shown.

use std::path::{Path, PathBuf};

use input::file::{Expected, ReadError, read_text};
use input::{FileType, limits, shortened};
use miette::Diagnostic;
use serde::Deserialize;
use thiserror::Error;

use crate::assessment_files::{NAMES, SCHEMA};

/// The file's older name, and its schema then, which are read.
const BEFORE: &str = "certificate.json";
const SCHEMA_BEFORE: &str = "wedgelab.certificate/1";
/// The expected file.
const FILE: Expected = Expected {
    what: "file of an assessment",
    types: &[FileType::Assessment, FileType::Json],
    most: limits::RECORD_FILE,
};

/// A folder has no assessment to compare with.
#[derive(Debug, Error, Diagnostic)]
#[error("{} is no assessment to compare with: {reason}", .file.display())]
#[diagnostic(help("{advice}"))]
pub struct AgainstError {
    file: PathBuf,
    reason: String,
    advice: &'static str,
}

/// The verdict of another assessment on a limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Other {
    /// Regime, condition, limit.
    pub key: [String; 3],
    /// The worst value.
    pub value: f64,
    /// Its unit there.
    pub unit: String,
    /// The margin, in parts of the limit there.
    pub margin: f64,
}

/// Another assessment, beside which this one is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Against {
    /// Its car and folder, in words.
    pub name: String,
    /// Its criteria.
    pub others: Vec<Other>,
}

/// What every document of the program says of itself.
#[derive(Deserialize)]
struct Named {
    schema: Option<String>,
}

#[derive(Deserialize)]
struct Document {
    car: String,
    verdicts: Vec<VerdictThere>,
}

#[derive(Deserialize)]
struct VerdictThere {
    regime: String,
    condition: String,
    limit: String,
    unit: String,
    worst: Option<WorstThere>,
}

/// The worst run; numbers that were not finite are missing.
#[derive(Deserialize)]
struct WorstThere {
    value: Option<f64>,
    margin: Option<f64>,
}

impl Against {
    /// Reads the assessment in a folder.
    ///
    /// # Errors
    /// There is none, or it is damaged or of another version.
    pub fn read(folder: &Path) -> Result<Self, AgainstError> {
        let own = folder.join(NAMES[2]);
        let before = folder.join(BEFORE);
        let file = if !own.exists() && before.exists() {
            before
        } else {
            own
        };
        let text = read_text(&file, &FILE).map_err(|error: ReadError| {
            refused(
                &file,
                error.to_string(),
                "name the folder that `wedgelab assess` or `wedgelab regime` wrote",
            )
        })?;
        let named: Named = parsed(&file, &text)?;
        let schema = named.schema.unwrap_or_default();
        if ![SCHEMA, SCHEMA_BEFORE].contains(&schema.as_str()) {
            let reason = format!("its schema is \"{}\"; {SCHEMA} is expected", shortened(&schema));
            let advice = "name a folder that this version of `wedgelab assess` or `wedgelab regime` wrote";
            return Err(refused(&file, reason, advice));
        }
        let document: Document = parsed(&file, &text)?;
        let others = document.verdicts.into_iter().filter_map(|own| {
            let worst = own.worst?;
            Some(Other {
                key: [own.regime, own.condition, own.limit],
                value: worst.value?,
                unit: own.unit,
                margin: worst.margin?,
            })
        });
        Ok(Self {
            name: format!("{} ({})", document.car, folder.display()),
            others: others.collect(),
        })
    }
}

fn parsed<'t, T: Deserialize<'t>>(file: &Path, text: &'t str) -> Result<T, AgainstError> {
    serde_json::from_str(text).map_err(|error| {
        let advice = "the file is damaged: copy it again, or give the command that wrote it once more";
        refused(file, input::bounded(error.to_string()), advice)
    })
}

fn refused(file: &Path, reason: String, advice: &'static str) -> AgainstError {
    AgainstError {
        file: file.to_owned(),
        reason,
        advice,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Against, AgainstError> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(NAMES[2]), text).unwrap();
        Against::read(folder.path())
    }

    const VERDICT: &str = r#"{"regime": "a", "condition": "new", "limit": "roll", "unit": "rad",
        "worst": {"run": 1, "value": 0.1, "margin": 0.5}}"#;

    fn document(verdicts: &str) -> String {
        format!("{{\"schema\": \"{SCHEMA}\", \"car\": \"mine\", \"verdicts\": {verdicts}}}")
    }

    #[test]
    fn issue_048_values_of_other_assessments_keep_their_units() {
        let found = read(&document(&format!("[{VERDICT}]"))).unwrap();
        assert_eq!(found.others[0].unit, "rad");
        assert_eq!(found.others[0].key, ["a", "new", "roll"]);
        let missing = VERDICT.replace("0.1", "null");
        assert_eq!(read(&document(&format!("[{missing}]"))).unwrap().others, []);
    }

    #[test]
    fn limits_documents_of_the_older_name_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let text = document(&format!("[{VERDICT}]")).replace(SCHEMA, SCHEMA_BEFORE);
        std::fs::write(folder.path().join(BEFORE), &text).unwrap();
        let found = Against::read(folder.path()).unwrap();
        assert_eq!(found.others[0].key, ["a", "new", "roll"]);
    }

    #[test]
    fn issue_048_damaged_assessments_are_refused_with_their_place() {
        let cut = document(&format!("[{VERDICT}]"));
        for (text, expected) in [
            (&cut[..cut.len() - 3], "line 2"),
            (&document("7"), "expected a sequence"),
            (
                &document(&format!("[{}]", VERDICT.replace("0.1", "\"0.1\""))),
                "expected f64",
            ),
            (
                "{\"schema\": \"wedgelab.assessment/1\", \"car\": \"a\"}",
                "missing field `verdicts`",
            ),
            ("{\"schema\": \"\\u001b[31m\"}", "its schema is \"?[31m\""),
            ("PAR1", "a file of an assessment is expected"),
        ] {
            let error = read(text).unwrap_err();
            let message = error.to_string();
            assert!(message.contains(expected), "{message}");
            assert!(error.help().is_some());
        }
        let long = read(&format!("{{\"schema\": \"{}\"}}", "long ".repeat(10_000))).unwrap_err();
        assert!(long.to_string().len() < 1000);
    }
}
