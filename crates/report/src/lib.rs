//! Files and figures of results.
//!
//! - [`csv`]: the table `result.csv`.
//! - [`mat`]: the file `result.mat`, under the thesis's names; [`mat5`] is its format.
//! - [`summary`]: the file `summary.json`.
//! - [`files`]: writing whole results, or nothing.
//! - [`sections`], [`page`]: the report as one page.
//! - [`drawing`]: figures, their curves and axes, drawn as SVG and PNG; [`thin`] makes their curves small.
//! - [`figures`]: the report's figures.
//! - [`view`]: the data of the page's interactive part.
//! - [`run_files`]: the files of a run.

pub mod csv;
pub mod drawing;
pub mod figures;
pub mod files;
pub mod mat;
pub mod mat5;
pub mod page;
pub mod run_files;
pub mod sections;
pub mod summary;
pub mod thin;
pub mod view;
