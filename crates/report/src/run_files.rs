//! The files of a run: its table in the formats asked for, the completed case, the summary.
//!
//! [`ModelCase::output_files`] says which tables a case is written into; a caller may ask for others. Tables
//! that an earlier run left in the folder and that are not written now are removed with the rest, so that all
//! tables of a folder are of one run.

use std::io::{self, Write};

use study::models::ModelCase;
use study::output_files::{OutputFiles, TableFormat};
use study::summary::RunSummary;

use crate::output_table::RunTable;
use crate::{csv, mat, result_parquet, summary};
use staging::{FileError, Files, Folder};

/// The name of the case's file.
pub const CASE_FILE_NAME: &str = "case.toml";
/// The files of a run of a wedge or truck, unless others are asked for.
pub const NAMES: [&str; 4] = [csv::FILE_NAME, mat::FILE_NAME, CASE_FILE_NAME, summary::FILE_NAME];
/// The files that the table of a run may be written into.
pub const TABLES: [(TableFormat, &str); 3] = [
    (TableFormat::Parquet, result_parquet::FILE_NAME),
    (TableFormat::Csv, csv::FILE_NAME),
    (TableFormat::Mat, mat::FILE_NAME),
];

/// The name of the figure of the pressure over faces with grids of points.
pub const PRESSURE_FILE_NAME: &str = "pressure.svg";

/// A case whose runs are written as files.
pub trait RunFiles: ModelCase {
    /// Returns the name of the figure that is written besides, if there is one.
    fn figure_name(&self) -> Option<&'static str> {
        None
    }

    /// Returns that figure as SVG.
    fn figure(&self, _result: &Self::Output) -> Option<String> {
        None
    }

    /// Returns the files that [`RunFiles::write_as`] writes of this case.
    fn names(&self, output: &OutputFiles) -> Vec<&'static str> {
        let case = self.case_file().map(|_| CASE_FILE_NAME);
        let others = case.into_iter().chain([summary::FILE_NAME]);
        table_names(output)
            .chain(others)
            .chain(self.figure_name())
            .collect()
    }

    /// Writes the file under the name `result.mat`, of the columns of `table`.
    ///
    /// # Errors
    /// The writer's.
    fn write_mat(&self, result: &Self::Output, table: &RunTable<'_>, out: &mut dyn Write) -> io::Result<()> {
        mat::write_named(table, &result.summary, out)
    }

    /// Adds the files besides the table.
    ///
    /// # Errors
    /// A file cannot be written.
    fn add_others(&self, files: &mut Files<'_>, result: &Self::Output) -> Result<(), FileError> {
        if let Some(text) = self.case_file() {
            files.add(CASE_FILE_NAME, |out| out.write_all(text.as_bytes()))?;
        }
        files.add(summary::FILE_NAME, |out| {
            summary::write_json(&result.summary, out)
        })?;
        if let (Some(name), Some(figure)) = (self.figure_name(), self.figure(result)) {
            files.add(name, |out| out.write_all(figure.as_bytes()))?;
        }
        Ok(())
    }

    /// Writes the files of a run, all of them or none.
    ///
    /// # Errors
    /// A file cannot be written.
    fn write(&self, folder: &Folder, result: &Self::Output) -> Result<(), FileError> {
        self.write_as(folder, result, &self.output_files())
    }

    /// Writes the files of a run, all of them or none, with the tables of `output`.
    ///
    /// # Errors
    /// A file cannot be written.
    fn write_as(
        &self,
        folder: &Folder,
        result: &Self::Output,
        output: &OutputFiles,
    ) -> Result<(), FileError> {
        folder.write(|files| {
            for (format, name) in TABLES {
                if output.has(format) {
                    files.add(name, |out| self.write_table(result, format, output, out))?;
                } else {
                    files.supersede(name);
                }
            }
            self.add_others(files, result)
        })
    }

    /// Writes the table of a run in a format.
    ///
    /// # Errors
    /// The writer's.
    fn write_table(
        &self,
        result: &Self::Output,
        format: TableFormat,
        output: &OutputFiles,
        out: &mut (dyn Write + Send),
    ) -> io::Result<()> {
        let units = result.summary.units();
        let all = result.columns.iter().zip(&result.values);
        let table = RunTable::of_run(all.filter(|(own, _)| output.writes(format, own, units)), units)?;
        match format {
            TableFormat::Parquet => result_parquet::write(&table, out),
            TableFormat::Csv => table.write_csv(out),
            TableFormat::Mat => self.write_mat(result, &table, out),
        }
    }
}

/// Returns the names of the files of the table.
fn table_names(output: &OutputFiles) -> impl Iterator<Item = &'static str> {
    let written = TABLES.into_iter().filter(|(format, _)| output.has(*format));
    written.map(|(_, name)| name)
}
