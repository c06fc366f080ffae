//! The files of a run: the table, the same under the thesis's names, the completed case, the summary.

use serde::Serialize;
use study::car::CarCase;
use study::car::run::CarResult;
use study::case::Case;
use study::half_truck::{HalfTruckCase, HalfTruckResult};
use study::result::RunResult;
use study::run::RunCase;
use study::summary::RunSummary;
use study::truck::TruckCase;
use study::truck::run::TruckResult;
use study::wheelset::WheelsetCase;
use study::wheelset::run::WheelsetResult;
use wedge::face::Grid;

use crate::figures::pressure_figure;
use crate::files::{FileError, Folder};
use crate::{csv, half_truck_files, mat, summary};

/// The name of the case's file.
pub const CASE_FILE_NAME: &str = "case.toml";
/// The files of a run.
pub const NAMES: [&str; 4] = [csv::FILE_NAME, mat::FILE_NAME, CASE_FILE_NAME, summary::FILE_NAME];

/// The name of the figure of the pressure over faces with grids of points.
pub const PRESSURE_FILE_NAME: &str = "pressure.svg";

/// A case whose runs are written as files.
pub trait RunFiles: RunCase<Output = RunResult<Self::Summary>> {
    /// The summary of its runs.
    type Summary: RunSummary + Serialize;
    /// The files of a run.
    const FILES: &'static [&'static str];

    /// Returns the files that [`RunFiles::write`] writes of this case.
    fn names(&self) -> Vec<&'static str> {
        Self::FILES.to_vec()
    }

    /// Writes the files of a run, all of them or none.
    ///
    /// # Errors
    /// A file cannot be written.
    fn write(&self, folder: &Folder, result: &Self::Output) -> Result<(), FileError>;
}

impl RunFiles for Case {
    type Summary = study::summary::Summary;
    const FILES: &'static [&'static str] = &NAMES;

    fn names(&self) -> Vec<&'static str> {
        let faces = [&self.parameters.column_face, &self.parameters.slope_face];
        let pressure = faces.iter().any(|face| face.grid != Grid::default());
        let more = pressure.then_some(PRESSURE_FILE_NAME);
        NAMES.into_iter().chain(more).collect()
    }

    fn write(&self, folder: &Folder, result: &RunResult) -> Result<(), FileError> {
        write(folder, self, result)
    }
}

impl RunFiles for HalfTruckCase {
    type Summary = study::half_truck::HalfTruckSummary;
    const FILES: &'static [&'static str] = &half_truck_files::NAMES;

    fn write(&self, folder: &Folder, result: &HalfTruckResult) -> Result<(), FileError> {
        half_truck_files::write(folder, self, result, self.script_interval)
    }
}

impl RunFiles for TruckCase {
    type Summary = study::truck::summary::TruckSummary;
    const FILES: &'static [&'static str] = &NAMES;

    fn write(&self, folder: &Folder, result: &TruckResult) -> Result<(), FileError> {
        let units = self.simulation.output_units;
        folder.write(|files| {
            files.add(csv::FILE_NAME, |out| {
                csv::write_columns(&result.columns, &result.values, units, out)
            })?;
            files.add(mat::FILE_NAME, |out| mat::write_truck(result, out))?;
            files.add(CASE_FILE_NAME, |out| {
                out.write_all(self.to_toml_embedded().as_bytes())
            })?;
            files.add(summary::FILE_NAME, |out| {
                summary::write_json(&result.summary, out)
            })
        })
    }
}

impl RunFiles for CarCase {
    type Summary = study::car::summary::CarSummary;
    const FILES: &'static [&'static str] = &NAMES;

    fn write(&self, folder: &Folder, result: &CarResult) -> Result<(), FileError> {
        let units = self.simulation.output_units;
        folder.write(|files| {
            files.add(csv::FILE_NAME, |out| {
                csv::write_columns(&result.columns, &result.values, units, out)
            })?;
            files.add(mat::FILE_NAME, |out| mat::write_car(result, out))?;
            files.add(CASE_FILE_NAME, |out| {
                out.write_all(self.to_toml_embedded().as_bytes())
            })?;
            files.add(summary::FILE_NAME, |out| {
                summary::write_json(&result.summary, out)
            })
        })
    }
}

impl RunFiles for WheelsetCase {
    type Summary = study::wheelset::summary::WheelsetSummary;
    const FILES: &'static [&'static str] = &[csv::FILE_NAME, summary::FILE_NAME];

    fn write(&self, folder: &Folder, result: &WheelsetResult) -> Result<(), FileError> {
        let units = self.wheelset.units;
        folder.write(|files| {
            files.add(csv::FILE_NAME, |out| {
                csv::write_columns(&result.columns, &result.values, units, out)
            })?;
            files.add(summary::FILE_NAME, |out| {
                summary::write_json(&result.summary, out)
            })
        })
    }
}

/// Writes the files of a run, all of them or none.
///
/// The case is written completed, with the tables that it took from other files inside, so that it runs
/// anywhere.
///
/// # Errors
/// A file cannot be written.
pub fn write(folder: &Folder, case: &Case, result: &RunResult) -> Result<(), FileError> {
    folder.write(|files| {
        files.add(csv::FILE_NAME, |out| csv::write(result, out))?;
        files.add(mat::FILE_NAME, |out| mat::write(case, result, out))?;
        files.add(CASE_FILE_NAME, |out| {
            let document = case.document.clone().with_tables_embedded();
            out.write_all(document.to_toml().as_bytes())
        })?;
        files.add(summary::FILE_NAME, |out| summary::write(&result.summary, out))?;
        if let Some(figure) = pressure_figure(case, result) {
            files.add(PRESSURE_FILE_NAME, |out| {
                out.write_all(figure.to_svg().as_bytes())
            })?;
        }
        Ok(())
    })
}
