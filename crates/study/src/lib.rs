//! Cases, runs and metrics.
//!
//! A [`case::Case`] says what to run, a [`run::Run`] runs it, a [`result::RunResult`] holds what came out,
//! and [`summary::Summary`] says it in numbers.
//!
//! ```
//! use study::case::Case;
//! use study::run::Run;
//!
//! let text = "[wedge]\ndamping = \"constant\"\n[simulation]\nduration = \"0.2 s\"\n";
//! let case = Case::parse("my.toml", text, std::path::Path::new(""), &[])?;
//! let result = Run::new(&case)?.finish(|_time| ());
//! assert_eq!(result.rows(), 21);
//! assert!(result.summary.ledger.largest_relative_residual < 1e-5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod assessment;
pub mod assumptions;
pub mod car;
pub mod case;
pub mod closed_form;
pub mod contacts;
pub mod cycles;
pub mod damage;
pub mod design;
pub mod energy;
mod finite;
pub mod fit;
pub(crate) mod geometry;
pub mod half_truck;
pub mod jam;
pub mod lock_up;
pub mod locus;
pub mod losses;
pub mod measures;
pub mod metrics;
pub mod models;
pub mod outcome;
pub mod output_files;
pub mod packed;
pub mod patches;
pub mod plausibility;
pub mod probability;
pub mod progress;
mod reader;
pub mod records;
pub mod remote_run;
pub mod result;
pub mod rise;
pub mod route;
mod rows;
pub mod run;
mod run_error;
pub mod sections;
pub mod signal;
pub mod statics;
pub mod stepping;
pub mod summary;
mod summary_value;
pub mod tables;
pub mod track;
pub mod truck;
pub mod vehicle;
pub mod wear;
mod wedge_faces;
pub mod wedge_rise;
pub mod wheelset;
