//! The files of a run: its table in the formats asked for, the completed case, the summary.
//!
//! [`RunFiles::output_files`] says which tables a case is written into; a caller may ask for others. Tables
//! that an earlier run left in the folder and that are not written now are removed with the rest, so that all
//! tables of a folder are of one run.

use std::io::{self, Write};

use mechanics::output::Column;
use serde::Serialize;
use study::car::{self, CarCase};
use study::case::Case;
use study::half_truck::{HalfTruckCase, HalfTruckResult};
use study::output_files::{OutputFiles, TableFormat};
use study::result::RunResult;
use study::run::{RunCase, RunError};
use study::summary::RunSummary;
use study::truck::TruckCase;
use study::truck::columns::TruckTable;
use study::vehicle::VehicleCase;
use study::wheelset::WheelsetCase;
use wedge::face::Grid;
use wedge::outputs::Outputs;

use crate::figures::pressure_figure;
use crate::output_table::RunTable;
use crate::{csv, half_truck_files, mat, result_parquet, summary};
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
pub trait RunFiles: RunCase<Output = RunResult<Self::Summary>> {
    /// The summary of its runs.
    type Summary: RunSummary + Serialize;

    /// Returns the files of its table, unless others are asked for.
    fn output_files(&self) -> OutputFiles {
        OutputFiles::default()
    }

    /// Returns the columns of its runs.
    ///
    /// # Errors
    /// The case makes no system.
    fn columns(&self) -> Result<Vec<Column>, RunError>;

    /// Returns the completed case file, with the tables that it took from other files inside, so that it runs
    /// anywhere; `None` of a model without case files.
    fn case_file(&self) -> Option<&str> {
        None
    }

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
pub fn table_names(output: &OutputFiles) -> impl Iterator<Item = &'static str> {
    let written = TABLES.into_iter().filter(|(format, _)| output.has(*format));
    written.map(|(_, name)| name)
}

impl RunFiles for Case {
    type Summary = study::summary::Summary;

    fn columns(&self) -> Result<Vec<Column>, RunError> {
        Ok(Outputs::new(&self.parameters).columns().to_vec())
    }

    fn case_file(&self) -> Option<&str> {
        Some(self.to_toml_embedded())
    }

    fn figure_name(&self) -> Option<&'static str> {
        let faces = [&self.parameters.column_face, &self.parameters.slope_face];
        let pressure = faces.iter().any(|face| face.grid != Grid::default());
        pressure.then_some(PRESSURE_FILE_NAME)
    }

    fn figure(&self, result: &RunResult) -> Option<String> {
        Some(pressure_figure(self, result)?.to_svg())
    }

    /// The thesis's variables, whatever the columns of other tables.
    fn write_mat(&self, result: &RunResult, _table: &RunTable<'_>, out: &mut dyn Write) -> io::Result<()> {
        mat::write(self, result, out)
    }
}

impl RunFiles for HalfTruckCase {
    type Summary = study::half_truck::HalfTruckSummary;

    fn columns(&self) -> Result<Vec<Column>, RunError> {
        let beginning = self.begin()?;
        let columns = study::half_truck::columns::Columns::new(self, &beginning.system);
        Ok(columns.columns().to_vec())
    }

    fn write_mat(
        &self,
        result: &HalfTruckResult,
        _table: &RunTable<'_>,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        half_truck_files::write_mat(self, result, self.script_interval, out)
    }
}

impl RunFiles for TruckCase {
    type Summary = study::truck::summary::TruckSummary;

    fn columns(&self) -> Result<Vec<Column>, RunError> {
        Ok(TruckTable::new(self)?.columns().to_vec())
    }

    fn case_file(&self) -> Option<&str> {
        Some(self.to_toml_embedded())
    }
}

impl RunFiles for CarCase {
    type Summary = study::car::summary::CarSummary;

    fn output_files(&self) -> OutputFiles {
        self.output_files.clone()
    }

    fn columns(&self) -> Result<Vec<Column>, RunError> {
        car::run::columns(self)
    }

    fn case_file(&self) -> Option<&str> {
        Some(self.to_toml_embedded())
    }
}

impl RunFiles for VehicleCase {
    type Summary = study::vehicle::summary::VehicleSummary;

    fn output_files(&self) -> OutputFiles {
        self.output_files.clone()
    }

    fn columns(&self) -> Result<Vec<Column>, RunError> {
        VehicleCase::columns(self)
    }

    fn case_file(&self) -> Option<&str> {
        Some(self.to_toml_embedded())
    }
}

impl RunFiles for WheelsetCase {
    type Summary = study::wheelset::summary::WheelsetSummary;

    fn output_files(&self) -> OutputFiles {
        OutputFiles {
            tables: vec![TableFormat::Csv],
            ..OutputFiles::default()
        }
    }

    fn columns(&self) -> Result<Vec<Column>, RunError> {
        Ok(study::wheelset::columns::columns())
    }
}
