//! The files of an assessment: a table with a row each run and limit, as Parquet and CSV, and all of it as
//! JSON.

use quantity::{Kind, System as Units};
use serde_json::json;
use study::assessment::refined::Refined;
use study::assessment::{Assessed, Assessment, KeptLimit, LimitVerdict, verdicts};
use study::car::limits::Mark;
use study::models::AnyCase;

use crate::csv;
use crate::output_table::{Cell, Content, OutputTable};
use crate::page::assessment as page;
use crate::parquet::Storage;
use crate::study_folder::{STUDY_KEY, StudyFolder, StudyFolderError};
use crate::summary;
use staging::{FileError, Folder};

/// The name and version of the JSON.
pub const SCHEMA: &str = "wedgelab.assessment/1";
/// The files' names; the study's table of measures stands beside them.
pub const NAMES: [&str; 4] = [
    "assessment.parquet",
    "assessment.csv",
    "assessment.json",
    page::FILE_NAME,
];

/// The findings of all runs.
#[derive(Clone, Debug)]
pub struct AssessmentFindings {
    /// The runs in their order.
    pub runs: Vec<Assessed>,
    /// The verdict on each limit.
    pub verdicts: Vec<LimitVerdict>,
    /// The cars of runs at speeds that were not asked for; their numbers follow those of the study.
    pub refined: Vec<AnyCase>,
}

impl AssessmentFindings {
    /// Makes the study's table of a folder in which all runs are kept, and assesses them.
    ///
    /// # Errors
    /// A run is missing, or something cannot be read or written.
    pub fn gather(assessment: &Assessment, folder: &StudyFolder) -> Result<Self, StudyFolderError> {
        let mut runs = Vec::new();
        folder.merge(&assessment.study, |values, record| {
            runs.push(assessment.assess(values, record));
        })?;
        let verdicts = verdicts(&runs);
        Ok(Self {
            runs,
            verdicts,
            refined: Vec::new(),
        })
    }

    /// Adds runs at speeds that were not asked for, and judges anew.
    pub fn add(&mut self, assessment: &Assessment, more: Vec<Refined>) {
        for mut own in more {
            own.assessed.run = assessment.study.count() + self.refined.len() as u64;
            self.runs.push(own.assessed);
            self.refined.push(own.case);
        }
        self.runs.sort_by(|a, b| {
            let place = |run: &Assessed| (run.regime, run.condition);
            place(a).cmp(&place(b)).then(a.speed_si.total_cmp(&b.speed_si))
        });
        self.verdicts = verdicts(&self.runs);
    }

    /// Returns the car of a run by its number.
    #[must_use]
    pub fn case(&self, assessment: &Assessment, run: u64) -> Option<AnyCase> {
        match run.checked_sub(assessment.study.count()) {
            None => assessment.study.case(run).ok(),
            Some(more) => self.refined.get(usize::try_from(more).ok()?).cloned(),
        }
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
    assessment: &Assessment,
    findings: &AssessmentFindings,
    page: &str,
    folder: &Folder,
) -> Result<(), FileError> {
    folder.write(|files| {
        let table = table(assessment, findings);
        files.add(NAMES[0], |out| {
            let description = serde_json::to_string(&assessment.study.description())?;
            table.write_parquet(Storage::Values, (STUDY_KEY, description), out)
        })?;
        files.add(NAMES[1], |out| table.write_csv(out))?;
        files.add(NAMES[2], |out| {
            summary::write_json(&document(assessment, findings), out)
        })?;
        files.add(NAMES[3], |out| out.write_all(page.as_bytes()))
    })
}

/// Returns the table: each run beside each limit of its regime, or alone if there is none.
fn table<'c>(
    assessment: &'c Assessment,
    findings: &'c AssessmentFindings,
) -> OutputTable<'c, (&'c Assessed, Option<&'c KeptLimit>)> {
    let rows = findings.runs.iter().flat_map(|run| {
        let alone = run.checks.is_empty().then_some((run, None));
        let checks = run.checks.iter().map(move |check| (run, Some(check)));
        alone.into_iter().chain(checks)
    });
    let mut table = OutputTable::new(rows, Units::Us);
    let (integer, number, text) = (Content::Integer, Content::Number, Content::Text);
    let limit = |check: &Option<&KeptLimit>| Some(&assessment.limits.limits[(*check)?.limit]);
    let numeric = |value: Option<f64>| value.map_or(Cell::Missing, Cell::Number);
    let about = ["run", "", "number of the run, from 0"];
    table.column(about, integer, |(run, _)| Cell::Integer(run.run as i64));
    table.column(["regime", "", "the regime"], text, |(run, _)| {
        assessment.regimes[run.regime].name.as_str().into()
    });
    table.column(["condition", "", "the condition"], text, |(run, _)| {
        assessment.conditions[run.condition].name.as_str().into()
    });
    table.quantity(["speed", "speed"], Kind::TravelSpeed, |(run, _), factor| {
        Cell::Number(csv::rounded(run.speed_si * factor))
    });
    let about = ["status", "", "complete, refused, stopped, failed or derailed"];
    table.column(about, text, |(run, _)| run.status.into());
    let about = ["limit", "", "the limit; missing where none is set for the regime"];
    table.column(about, text, move |(_, check)| {
        limit(check).map_or("", |own| &own.name).into()
    });
    let about = ["value", "", "what was measured, in `unit`"];
    table.column(about, number, move |(_, check)| {
        numeric(check.and_then(|own| own.value))
    });
    let about = ["bound", "", "at_most or at_least"];
    table.column(about, text, move |(_, check)| {
        limit(check).map_or("", |own| own.bound.name()).into()
    });
    let about = ["limit_value", "", "the limit for this run, in `unit`"];
    table.column(about, number, move |(_, check)| {
        numeric(check.and_then(|own| own.allowed))
    });
    let about = ["unit", "", "their unit"];
    table.column(about, text, move |(_, check)| {
        limit(check).map_or("", |own| &own.unit).into()
    });
    let about = "what is left, in parts of the limit; negative where it is not kept; of a run that derailed, \
                 of the part until then";
    table.column(["margin", "", about], number, move |(_, check)| {
        numeric(check.and_then(|own| own.margin))
    });
    let about = "kept or exceeded (all limits, where a wheel left its rail); missing where nothing was \
                 measured";
    table.column(["verdict", "", about], text, |(run, check)| {
        match check.and_then(|own| run.keeps(own)) {
            Some(true) => "kept".into(),
            Some(false) => "exceeded".into(),
            None => Cell::Missing,
        }
    });
    let about = [
        "refined",
        "",
        "1 if the speed was not asked for: it lies beside the worst one; else 0",
    ];
    table.column(about, integer, |(run, _)| Cell::Integer(i64::from(run.refined)));
    let about = ["note", "", "what else is to be said of the run"];
    table.column(about, text, |(run, _)| run.note.as_str().into());
    table
}

/// Returns what it is: a certificate, or an assessment that is none.
#[must_use]
pub fn kind(assessment: &Assessment, findings: &AssessmentFindings) -> &'static str {
    match assessment.falls_short(&findings.verdicts).is_empty() {
        true => "certificate",
        false => "assessment",
    }
}

/// Returns all that an assessment says.
fn document(assessment: &Assessment, findings: &AssessmentFindings) -> serde_json::Value {
    let limits = &assessment.limits;
    let verdicts = findings.verdicts.iter().map(|own| {
        let limit = &limits.limits[own.limit];
        json!({
            "regime": assessment.regimes[own.regime].name,
            "condition": assessment.conditions[own.condition].name,
            "limit": limit.name,
            "quantity": assessment.quantity(limit),
            "measure": limit.measure.name,
            "paragraph": limit.paragraph,
            "mark": limit.mark.map(Mark::name),
            "bound": limit.bound.name(),
            "limit_in_words": limit.value_in_words(),
            "limit_value": own.worst.as_ref().map(|own| own.limit_value),
            "unit": limit.unit,
            "verdict": own.word(),
            "worst": own.worst,
            "derailed": own.derailed,
            "missing": own.missing,
            "at_given_speeds": own.asked,
            "other_start": own.depends.other_start,
            "friction": own.depends.friction,
            "turned_by": own.turned_by(),
        })
    });
    let regimes = assessment.regimes.iter();
    let regimes = regimes.map(|own| json!({ "name": own.name, "title": own.title, "source": own.source }));
    let conditions = assessment.conditions.iter();
    let conditions = conditions.map(|own| json!({ "name": own.name, "title": own.title, "set": own.set }));
    let runs = findings.runs.iter().map(|run| {
        json!({
            "run": run.run,
            "regime": assessment.regimes[run.regime].name,
            "condition": assessment.conditions[run.condition].name,
            "speed": run.speed,
            "status": run.status,
            "note": run.note,
            "refined": run.refined,
        })
    });
    json!({
        "schema": SCHEMA,
        "program": format!("wedgelab {}", env!("CARGO_PKG_VERSION")),
        "car": assessment.car,
        "kind": kind(assessment, findings),
        "no_certificate_because": assessment.falls_short(&findings.verdicts),
        "limits": {
            "name": limits.name,
            "title": limits.title,
            "edition": limits.edition,
            "source": limits.source,
            "not_covered": limits.not_covered,
        },
        "regimes": regimes.collect::<Vec<_>>(),
        "conditions": conditions.collect::<Vec<_>>(),
        "verdicts": verdicts.collect::<Vec<_>>(),
        "runs": runs.collect::<Vec<_>>(),
    })
}
