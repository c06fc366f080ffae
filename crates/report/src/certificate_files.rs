//! The files of a certificate: a table with a row each run and limit, as Parquet and CSV, and all of it as
//! JSON.

use std::borrow::Cow;
use std::io::{self, Write};

use quantity::{Kind, System as Units};
use serde_json::json;
use study::car::certificate::{Assessed, Certificate, LimitVerdict, verdicts};

use crate::csv;
use crate::files::{FileError, Folder};
use crate::page::certificate as page;
use crate::parquet::{Cell, Content, ParquetColumn, Storage, TableWriter};
use crate::study_folder::{STUDY_KEY, StudyFolder, StudyFolderError};
use crate::summary;

/// The name and version of the JSON.
pub const SCHEMA: &str = "wedgelab.certificate/1";
/// The files' names; the study's table of measures stands beside them.
pub const NAMES: [&str; 4] = [
    "certificate.parquet",
    "certificate.csv",
    "certificate.json",
    page::FILE_NAME,
];

/// The findings of all runs.
#[derive(Clone, Debug)]
pub struct CertificateFindings {
    /// The runs in their order.
    pub runs: Vec<Assessed>,
    /// The verdict on each limit.
    pub verdicts: Vec<LimitVerdict>,
}

impl CertificateFindings {
    /// Makes the study's table of a folder in which all runs are kept, and assesses them.
    ///
    /// # Errors
    /// A run is missing, or something cannot be read or written.
    pub fn gather(certificate: &Certificate, folder: &StudyFolder) -> Result<Self, StudyFolderError> {
        let mut runs = Vec::new();
        folder.merge(&certificate.study, |values, record| {
            runs.push(certificate.assess(values, record));
        })?;
        let verdicts = verdicts(&runs);
        Ok(Self { runs, verdicts })
    }

    /// Returns the numbers of limits that are kept, exceeded, unknown.
    #[must_use]
    pub fn counts(&self) -> [usize; 3] {
        ["kept", "exceeded", "unknown"]
            .map(|word| self.verdicts.iter().filter(|own| own.word() == word).count())
    }
}

/// Writes the tables and the JSON.
///
/// # Errors
/// A file cannot be written.
pub fn write(
    certificate: &Certificate,
    findings: &CertificateFindings,
    page: &str,
    folder: &Folder,
) -> Result<(), FileError> {
    folder.write(|files| {
        files.add(NAMES[0], |out| parquet(certificate, findings, out))?;
        files.add(NAMES[1], |out| table_as_csv(certificate, findings, out))?;
        files.add(NAMES[2], |out| {
            summary::write_json(&document(certificate, findings), out)
        })?;
        files.add(NAMES[3], |out| out.write_all(page.as_bytes()))
    })
}

/// Returns the columns of the table.
fn columns() -> Vec<ParquetColumn> {
    let speed = Kind::TravelSpeed;
    let unit = speed.label(Units::Us);
    let column = |name: &str, unit: &str, text: &str, content| ParquetColumn {
        name: name.to_owned(),
        unit: unit.to_owned(),
        text: text.to_owned(),
        content,
    };
    let text = Content::Text;
    vec![
        column("run", "", "number of the run, from 0", Content::Integer),
        column("regime", "", "the regime", text),
        column("condition", "", "the condition", text),
        column("speed_mph", unit, "speed", Content::Number),
        column(
            "status",
            "",
            "complete, refused, stopped, failed or derailed",
            text,
        ),
        column(
            "limit",
            "",
            "the limit; missing where none is set for the regime",
            text,
        ),
        column("value", "", "what was measured, in `unit`", Content::Number),
        column("bound", "", "at_most or at_least", text),
        column("limit_value", "", "the limit, in `unit`", Content::Number),
        column("unit", "", "their unit", text),
        column(
            "margin",
            "",
            "what is left, in parts of the limit; negative where it is not kept; of a run that derailed, of \
             the part until then",
            Content::Number,
        ),
        column(
            "verdict",
            "",
            "kept or exceeded (all limits, where a wheel left its rail); missing where nothing was measured",
            text,
        ),
        column("note", "", "what else is to be said of the run", text),
    ]
}

/// Returns the rows of the table: each run beside each limit of its regime, or alone if there is none.
fn rows<'c>(
    certificate: &'c Certificate,
    findings: &'c CertificateFindings,
) -> impl Iterator<Item = Vec<Cell<'c>>> {
    let text = |own: &'c str| match own {
        "" => Cell::Missing,
        own => Cell::Text(Cow::Borrowed(own)),
    };
    findings.runs.iter().flat_map(move |run| {
        let head = vec![
            Cell::Integer(run.run as i64),
            text(&certificate.regimes[run.regime].name),
            text(&certificate.conditions[run.condition].name),
            Cell::Number(csv::rounded(run.speed_si * Kind::TravelSpeed.from_si(Units::Us))),
            text(run.status),
        ];
        let checks: Vec<Vec<Cell<'c>>> = match run.checks.as_slice() {
            [] => vec![vec![Cell::Missing; 7]],
            checks => checks
                .iter()
                .map(|check| {
                    let limit = &certificate.limits.limits[check.limit];
                    let number = |own: Option<f64>| own.map_or(Cell::Missing, Cell::Number);
                    let verdict = match run.keeps(check) {
                        Some(true) => text("kept"),
                        Some(false) => text("exceeded"),
                        None => Cell::Missing,
                    };
                    vec![
                        text(&limit.name),
                        number(check.value),
                        text(limit.bound.name()),
                        Cell::Number(limit.value),
                        text(&limit.unit),
                        number(check.margin),
                        verdict,
                    ]
                })
                .collect(),
        };
        checks.into_iter().map(move |own| {
            let mut row = head.clone();
            row.extend(own);
            row.push(text(&run.note));
            row
        })
    })
}

fn parquet(
    certificate: &Certificate,
    findings: &CertificateFindings,
    out: &mut (dyn Write + Send),
) -> io::Result<()> {
    let description = serde_json::to_string(&certificate.study.description()).map_err(io::Error::other)?;
    let metadata = [(STUDY_KEY, description)];
    let mut table = TableWriter::new(out, columns(), Storage::Values, &metadata).map_err(io::Error::other)?;
    for row in rows(certificate, findings) {
        table.row(row).map_err(io::Error::other)?;
    }
    table.finish().map_err(io::Error::other)
}

fn table_as_csv(
    certificate: &Certificate,
    findings: &CertificateFindings,
    out: &mut dyn Write,
) -> io::Result<()> {
    let columns = columns();
    csv::write_header(columns.iter().map(|column| column.name.as_str()), out)?;
    for row in rows(certificate, findings) {
        csv::write_cells(&row, out)?;
    }
    Ok(())
}

/// Returns all that a certificate says.
fn document(certificate: &Certificate, findings: &CertificateFindings) -> serde_json::Value {
    let limits = &certificate.limits;
    let verdicts = findings.verdicts.iter().map(|own| {
        let limit = &limits.limits[own.limit];
        json!({
            "regime": certificate.regimes[own.regime].name,
            "condition": certificate.conditions[own.condition].name,
            "limit": limit.name,
            "quantity": limit.quantity,
            "bound": limit.bound.name(),
            "limit_value": limit.value,
            "unit": limit.unit,
            "verdict": own.word(),
            "worst": own.worst,
            "derailed": own.derailed,
            "missing": own.missing,
            "other_start": own.other_start,
        })
    });
    let regimes = certificate.regimes.iter();
    let regimes = regimes.map(|own| json!({ "name": own.name, "title": own.title, "source": own.source }));
    let conditions = certificate.conditions.iter();
    let conditions = conditions.map(|own| json!({ "name": own.name, "title": own.title, "set": own.set }));
    let runs = findings.runs.iter().map(|run| {
        json!({
            "run": run.run,
            "regime": certificate.regimes[run.regime].name,
            "condition": certificate.conditions[run.condition].name,
            "speed": run.speed,
            "status": run.status,
            "note": run.note,
        })
    });
    json!({
        "schema": SCHEMA,
        "program": format!("wedgelab {}", env!("CARGO_PKG_VERSION")),
        "car": certificate.car,
        "limits": { "name": limits.name, "title": limits.title, "source": limits.source },
        "regimes": regimes.collect::<Vec<_>>(),
        "conditions": conditions.collect::<Vec<_>>(),
        "verdicts": verdicts.collect::<Vec<_>>(),
        "runs": runs.collect::<Vec<_>>(),
    })
}
