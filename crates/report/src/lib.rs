//! Files and figures of results.
//!
//! - [`output_table`]: tables that are written, in each format; [`csv`]: the table `result.csv`;
//!   [`result_parquet`]: `result.parquet`.
//! - [`mat`]: the file `result.mat`, under the thesis's names; [`mat5`] is its format.
//! - [`summary`]: the file `summary.json`.
//! - [`page`]: pages of runs and studies.
//! - [`figures`]: the report's figures.
//! - [`view`]: the data of the page's interactive part.
//! - [`models`]: what each model shows of its runs; [`run_files`]: the files of a run.
//! - [`half_truck_files`]: the files of a half-truck's run.
//! - [`warp_files`], [`curves_files`], [`wear_files`]: the files of `wedgelab warp`, `curves` and `wear`;
//!   [`stability_files`], [`locus_files`], [`hunting_files`], [`onset_files`]: those of `wedgelab stability`;
//!   [`wheelrail_files`]: those of `wedgelab wheelrail plot`; [`track_files`]: those of
//!   `wedgelab track show`; [`tables_files`]: those of `wedgelab tables`, whose runs [`tables_work`] makes.
//! - [`terminal`]: tables on the terminal.
//! - [`table`]: tables of results, read back; [`run_folder`]: whole runs.
//! - [`study_folder`], [`study_work`]: studies of many runs, kept and computed; [`parquet`] is their table,
//!   [`study_digest`] what their page shows.
//! - [`assessment_work`], [`assessment_files`]: an assessment of a car, made and written.
//! - [`fit_files`]: the files of an identification.
//! - [`comparison`]: results beside each other; [`plot`]: any column over any other.
//!
//! ```
//! use quantity::{Kind, System};
//! use report::output_table::OutputTable;
//!
//! let mut table = OutputTable::new([[0.5, 2.0], [1.0, 3.0]], System::Si);
//! table.number("travel", Kind::Length, |row: &[f64; 2]| row[0]);
//! let mut out = Vec::new();
//! table.write_csv(&mut out)?;
//! assert!(out.starts_with(b"travel"));
//! # Ok::<(), std::io::Error>(())
//! ```

pub mod assessment_files;
pub mod assessment_work;
pub mod comparison;
pub mod csv;
pub mod curves_files;
pub mod drawn;
pub mod figures;
pub mod fit_files;
pub mod half_truck_files;
pub mod hunting_files;
pub mod lock_up_files;
pub mod locus_files;
pub mod mat;
pub mod mat5;
pub mod models;
pub mod onset_files;
pub mod output_table;
mod overlay;
pub mod page;
pub mod parquet;
pub mod plot;
pub mod probability_files;
pub mod probability_work;
pub mod result_parquet;
pub mod rise_files;
pub mod rise_work;
pub mod route_files;
pub mod run_files;
pub mod run_folder;
pub mod stability_files;
pub mod study_digest;
pub mod study_folder;
pub mod study_work;
pub mod summary;
pub mod table;
pub mod tables_files;
pub mod tables_work;
pub mod terminal;
pub mod track_class;
pub mod track_files;
pub mod vehicle_stability_files;
pub mod view;
pub mod warp_files;
pub mod wear_files;
pub mod wheelrail_files;
pub mod wheelset_stability_files;
