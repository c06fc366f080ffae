//! Files and figures of results.
//!
//! - [`beyond`]: figures of the cases beyond the thesis, one a group.
//! - [`csv`]: the table `result.csv`.
//! - [`summary`]: the file `summary.json`.
//! - [`files`]: writing whole results, or nothing.
//! - [`run_files`]: the three files of a run.
//! - [`drawing`]: figures, their curves and axes, drawn as SVG; [`thin`] makes their curves small.
//! - [`hysteresis`]: the wedge force over the bolster's displacement.

pub mod beyond;
pub mod csv;
pub mod drawing;
pub mod files;
pub mod hysteresis;
pub mod run_files;
pub mod summary;
pub mod thin;
