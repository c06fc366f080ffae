//! The folder of a run, read back: its table, its summary, its case, and what its page keeps of its 3D view.
//!
//! Nothing here runs a case: results may come from another machine, or from a run of hours. What is read is
//! what `wedgelab run`, `nucars run`, `wheelrail run` and `reproduce` have written.

use std::path::{Path, PathBuf};

use input::file::{Expected, Reason, read};
use input::{FileType, limits};
use mechanics::output::Column;
use quantity::System as Units;
use serde::Deserialize;
use study::each_case;
use study::models::{self, AnyCase, AnySummary, ModelSummary};
use study::result::RunResult;

pub use error::{REPRODUCTION_FILE, RunFolderError};
pub use key_numbers::{KeyNumber, branch_window};

use crate::models::ReportCase;
use crate::run_files::CASE_FILE_NAME;
use crate::table::ResultTable;
use crate::view::kept::KeptView;
use crate::view::run::{Detail, Recording};
use crate::{csv, mat, page, result_parquet, summary};

mod error;
pub(crate) mod key_numbers;

/// The expected file of a summary.
const SUMMARY_FILE: Expected = Expected {
    what: "summary",
    types: &[FileType::Json],
    most: limits::RECORD_FILE,
};

/// The files of a run that its page links to, if they are there.
const FILES: [&str; 6] = [
    page::FILE_NAME,
    result_parquet::FILE_NAME,
    csv::FILE_NAME,
    summary::FILE_NAME,
    CASE_FILE_NAME,
    mat::FILE_NAME,
];

/// A run, read back.
#[derive(Clone, Debug)]
pub struct RunFolder {
    /// Its name beside others: that of its folder.
    pub label: String,
    /// The folder.
    pub folder: PathBuf,
    /// Its table.
    pub table: ResultTable,
    /// Its summary.
    pub summary: AnySummary,
    /// Its case; a half-truck and a wheelset have no file of it.
    pub case: Option<AnyCase>,
    /// Its files, as far as they are there.
    pub files: Vec<&'static str>,
    /// The mistake in the set.
    pub notes: Vec<String>,
}

/// The source of a run's 3D view and plots.
#[derive(Clone, Debug)]
pub enum Seen {
    /// From its table and case.
    Made(Box<Recording>),
    /// From its own page, which keeps more than its table.
    Kept(Box<KeptView>),
}

impl RunFolder {
    /// Reads the run in a folder, or the one whose table or `summary.json` is named.
    ///
    /// # Errors
    /// There is no run, or its files are damaged or of another version: see [`RunFolderError`].
    pub fn read(path: &Path) -> Result<Self, RunFolderError> {
        let folder = error::folder_of(path)?;
        let table = ResultTable::read(&folder)?;
        let file = folder.join(summary::FILE_NAME);
        let bytes = read(&file, &SUMMARY_FILE).map_err(|error| match error.reason {
            Reason::NotFound => RunFolderError::NoSummary {
                folder: folder.clone(),
            },
            _ => RunFolderError::Unreadable(error),
        })?;
        let summary = summary_of(&file, &bytes)?;
        let mut notes = Vec::new();
        let rows = table.times().len();
        if rows != summary.shared().rows() {
            notes.push(format!(
                "{} has {rows} rows, and summary.json is about {}: they are not of one run",
                table.file.file_name().unwrap_or_default().display(),
                summary.shared().rows()
            ));
        }
        let case = folder.join(CASE_FILE_NAME);
        let case = match case.is_file().then(|| AnyCase::read(&case, &[])) {
            Some(Ok(case)) => Some(case),
            Some(Err(error)) => {
                let reason = error.to_string();
                let first = reason.lines().next().unwrap_or_default();
                notes.push(format!("case.toml cannot be read by this version: {first}"));
                None
            }
            None => None,
        };
        let name = folder.canonicalize().ok();
        let name = name.as_deref().unwrap_or(&folder).file_name();
        Ok(Self {
            label: name.map_or_else(
                || summary.shared().name().to_owned(),
                |name| name.to_string_lossy().into_owned(),
            ),
            files: FILES
                .into_iter()
                .filter(|name| folder.join(name).is_file())
                .collect(),
            folder,
            table,
            summary,
            case,
            notes,
        })
    }

    /// Returns the name of its model, with the article.
    #[must_use]
    pub fn what(&self) -> &'static str {
        models::of_schema(self.summary.shared().schema()).map_or("", |model| model.what)
    }

    /// Returns the units of its numbers.
    #[must_use]
    pub fn units(&self) -> Units {
        self.summary.shared().units()
    }

    /// Returns its 3D view and plots: those that its own page keeps, or made from its table and its case;
    /// `None` where neither is there.
    #[must_use]
    pub fn seen(&self) -> Option<Seen> {
        if let Some(kept) = self.kept() {
            return Some(Seen::Kept(Box::new(kept)));
        }
        let made = each_case!(self.case.as_ref()?, case => self.made(&**case))?;
        Some(Seen::Made(Box::new(made.named(&self.label))))
    }

    /// Returns the data of its own page, if that is a page of this run.
    fn kept(&self) -> Option<KeptView> {
        let kept = KeptView::read(&self.folder.join(page::FILE_NAME), self.summary.shared().name())?;
        // It may be the page of another run, over which this one was written: a page keeps every n-th row.
        let (own, times) = (kept.times(), self.table.times());
        let [last, rows] = [own.len().checked_sub(1)?, times.len().checked_sub(1)?];
        let stride = rows.checked_div(last).unwrap_or(0);
        let same = |row: usize| {
            let (own, time) = (f64::from(own[row]), times[row * stride]);
            (own - time).abs() <= 1e-6 * time.abs().max(1e-3)
        };
        (stride > 0 && [1, last].into_iter().all(same)).then(|| kept.named(&self.label))
    }

    /// Returns its 3D view and plots from its table, without what that has not; `None` if it is no run of
    /// such a case.
    fn made<C: ReportCase>(&self, case: &C) -> Option<Recording> {
        let result = self.result(C::Summary::of(&self.summary)?.clone());
        let shown = case.clone().shown(result, C::Along::default());
        Some(C::recording(&shown, Detail::Thinned))
    }

    /// Returns the result as it came out of the run: what stands in the table, SI, without texts of columns.
    fn result<S>(&self, summary: S) -> RunResult<S> {
        let columns = self.table.columns();
        RunResult {
            columns: columns
                .iter()
                .map(|own| Column {
                    name: own.name.clone(),
                    kind: own.kind,
                    frame: "".into(),
                    reference: "".into(),
                    text: String::new(),
                })
                .collect(),
            values: columns.iter().map(|own| own.si()).collect(),
            summary,
        }
    }
}

/// The schema that every document of the program names.
#[derive(Deserialize)]
struct Named {
    schema: Option<String>,
}

/// Reads the content of a `summary.json`, by the schema that it names.
fn summary_of(file: &Path, bytes: &[u8]) -> Result<AnySummary, RunFolderError> {
    let damaged = |error| RunFolderError::damaged(file, &error);
    let named: Named = serde_json::from_slice(bytes).map_err(damaged)?;
    let schema = named.schema.unwrap_or_default();
    let model = models::of_schema(&schema).ok_or_else(|| RunFolderError::schema(file, &schema))?;
    (model.summary)(bytes).map_err(damaged)
}

/// Gives runs names that differ: folders of one name are called as they were named.
pub fn tell_apart(runs: &mut [RunFolder], named: &[PathBuf]) {
    let labels: Vec<String> = runs.iter().map(|run| run.label.clone()).collect();
    for (run, path) in runs.iter_mut().zip(named) {
        if labels.iter().filter(|other| **other == run.label).count() > 1 {
            run.label = path.display().to_string();
        }
    }
}
