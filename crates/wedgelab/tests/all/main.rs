//! Tests of `wedgelab`, one program: what is linked once is not linked thirty times.
#![allow(clippy::unwrap_used, missing_docs)]

mod assess;
mod car_commands;
mod cli;
#[path = "../common/mod.rs"]
mod common;
mod compare;
mod compare_sections;
mod energy;
mod fmu;
mod issue_036_book;
mod issue_036_doors;
mod issue_047_outcomes;
mod issue_048_results;
mod json;
mod lock_up;
mod nucars;
mod nucars_wedges;
mod probability;
mod report;
mod rise;
mod route;
mod run_report;
mod stability_vary;
mod tables;
mod truck_commands;
mod wear;
mod wheelrail_contact;
mod wheelrail_run;
mod wheelrail_stability;
