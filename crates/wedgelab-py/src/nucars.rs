//! Files of NUCARS: reading and checking.

use std::path::PathBuf;

use ::nucars::file_sets::{Instead, LoadError, ReadFiles, find, kind, load};
use ::nucars::read::{FileKind, read_data, read_input, read_run, read_system};
use ::nucars::source::SourceText;
use ::nucars::{Findings, builtin, check, show, write};
use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::errors::{findings, guarded, simple};

/// `wedgelab.NucarsError` about a file that cannot be read at all.
pub fn load_error(py: Python<'_>, error: &LoadError) -> PyErr {
    simple(py, "NucarsError", &error.message, &error.advice)
}

/// A table: title, names and units of columns, rows of texts.
type ShownTable = (
    &'static str,
    String,
    Vec<(&'static str, &'static str)>,
    Vec<Vec<String>>,
);

/// A file that was read and checked alone.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativeFile")]
pub struct NativeFile {
    name: String,
    kind: FileKind,
    title: String,
    text: String,
    written: String,
    tables: Vec<ShownTable>,
    findings: Findings,
}

#[pymethods]
impl NativeFile {
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// `system`, `input`, `data` or `run`.
    #[getter]
    fn kind(&self) -> &'static str {
        word(self.kind)
    }

    #[getter]
    fn title(&self) -> &str {
        &self.title
    }

    /// Returns the text as it was read.
    #[getter]
    fn text(&self) -> &str {
        &self.text
    }

    /// Written anew from what was understood.
    #[getter]
    fn written(&self) -> &str {
        &self.written
    }

    /// Tables of a system.
    #[getter]
    fn tables(&self) -> Vec<ShownTable> {
        self.tables.clone()
    }

    #[getter]
    fn has_errors(&self) -> bool {
        self.findings.has_errors()
    }

    #[getter]
    fn findings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        findings(py, self.findings.list())
    }
}

fn word(kind: FileKind) -> &'static str {
    match kind {
        FileKind::System => "system",
        FileKind::Input => "input",
        FileKind::Data => "data",
        FileKind::Run => "run",
    }
}

fn of_source(source: &std::sync::Arc<SourceText>) -> Result<NativeFile, LoadError> {
    let kind = kind(source)?;
    let mut tables = Vec::new();
    let (title, written, found) = match kind {
        FileKind::System => {
            let mut read = read_system(source);
            read.add(check::system(&read));
            let shown = show::system(&read.tree).into_iter();
            tables = shown
                .map(|table| (table.key, table.title, table.columns, table.rows))
                .collect();
            (
                read.tree.title.text.value.clone(),
                write::write_system(&read.tree),
                read.findings,
            )
        }
        FileKind::Data => {
            let mut read = read_data(source);
            read.add(check::data(&read));
            (String::new(), write::write_data(&read.tree), read.findings)
        }
        FileKind::Input => {
            let mut read = read_input(source);
            read.add(check::input(&read));
            (
                read.tree.title.text.value.clone(),
                write::write_input(&read.tree),
                read.findings,
            )
        }
        FileKind::Run => {
            let mut read = read_run(source);
            read.add(check::run(&read));
            (
                read.tree.title.text.value.clone(),
                write::write_run(&read.tree),
                read.findings,
            )
        }
    };
    Ok(NativeFile {
        name: source.name().to_owned(),
        kind,
        title,
        text: source.text().to_owned(),
        written,
        tables,
        findings: found,
    })
}

/// Reads a file: a path, or the name of a file that is built in.
#[pyfunction]
pub fn read_file(py: Python<'_>, path: PathBuf) -> PyResult<NativeFile> {
    guarded(py, || {
        let name = path.to_str().unwrap_or("");
        let built_in = builtin::source(name).filter(|_| !path.is_file());
        let source = match built_in {
            Some(source) => Ok(source),
            None => find(&path).and_then(|path| load(&path)),
        };
        source
            .and_then(|source| of_source(&source))
            .map_err(|error| load_error(py, &error))
    })
}

/// Checks files alone and with those they belong to: for each its path, kind, and findings.
#[pyfunction]
#[pyo3(signature = (paths, system, data, input))]
pub fn check_files<'py>(
    py: Python<'py>,
    paths: Vec<PathBuf>,
    system: Option<PathBuf>,
    data: Option<PathBuf>,
    input: Option<PathBuf>,
) -> PyResult<Vec<(String, &'static str, Bound<'py, PyList>)>> {
    guarded(py, || {
        let instead = Instead { system, data, input };
        let files = checked(&paths, &instead).map_err(|error| load_error(py, &error))?;
        let all = files.all().into_iter();
        all.map(|(kind, path, list)| Ok((path.display().to_string(), word(kind), findings(py, list.list())?)))
            .collect()
    })
}

fn checked(paths: &[PathBuf], instead: &Instead) -> Result<ReadFiles, LoadError> {
    let mut files = ReadFiles::default();
    for path in paths {
        files.add(&find(path)?, None)?;
    }
    for kind in [FileKind::System, FileKind::Data, FileKind::Input] {
        if let (_, Some(path)) = instead.of(kind) {
            files.add(&find(path)?, Some(kind))?;
        }
    }
    let sets = files.sets(instead)?;
    files.check(&sets);
    Ok(files)
}
