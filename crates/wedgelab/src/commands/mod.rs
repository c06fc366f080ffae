//! The commands, one file each: arguments and execution.

pub mod case;
pub mod certify;
pub mod compare;
pub mod completions;
pub mod curves;
pub mod energy;
pub mod explore;
pub mod fit;
pub mod fmu;
pub mod lock_up;
pub mod man;
pub mod nucars;
pub mod plot;
pub mod quasi_static;
pub mod regime;
pub mod report;
pub mod reproduce;
pub mod run;
pub mod stability;
mod stability_locus;
pub mod study;
pub mod track;
pub mod warp;
pub mod wear;
pub mod wheelrail;
mod wheelrail_contact;
mod wheelrail_run;
