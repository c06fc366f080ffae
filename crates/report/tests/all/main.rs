//! Tests of `report`, one program: what is linked once is not linked thirty times.
#![allow(clippy::expect_used, clippy::unwrap_used, missing_docs)]

mod figures;
mod files;
mod input_tables;
mod issue_029_behaviour;
mod issue_029_leftovers;
mod onset_files;
mod study;
mod tables;
mod view;
mod view_car;
mod view_stability;
mod view_truck;
