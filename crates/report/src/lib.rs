//! Files and figures of results.
//!
//! - [`csv`]: the table `result.csv`.
//! - [`mat`]: the file `result.mat`, under the thesis's names; [`mat5`] is its format.
//! - [`summary`]: the file `summary.json`.
//! - [`files`]: writing whole results, or nothing.
//! - [`run_files`]: the files of a run.
//! - [`table`]: tables of results, read back.
//! - [`comparison`]: results beside each other; [`plot`]: any column over any other.
//! - [`drawing`]: figures, their curves and axes, drawn as SVG; [`thin`] makes their curves small.
//! - [`hysteresis`]: the wedge force over the bolster's displacement.

pub mod comparison;
pub mod csv;
pub mod drawing;
pub mod files;
pub mod hysteresis;
pub mod mat;
pub mod mat5;
mod overlay;
pub mod plot;
pub mod run_files;
pub mod summary;
pub mod table;
pub mod thin;
