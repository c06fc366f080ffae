//! Files and figures of results.
//!
//! - [`csv`]: the table `result.csv`.
//! - [`summary`]: the file `summary.json`.
//! - [`files`]: writing whole results, or nothing.
//! - [`sections`], [`page`]: the report as one page.
//! - [`run_files`]: the three files of a run.
//! - [`drawing`]: figures, their curves and axes, drawn as SVG and PNG; [`thin`] makes their curves small.
//! - [`figures`]: the report's figures.

pub mod csv;
pub mod drawing;
pub mod figures;
pub mod files;
pub mod page;
pub mod run_files;
pub mod sections;
pub mod summary;
pub mod thin;
