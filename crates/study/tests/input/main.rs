//! Cases, tables and tracks as they are read: values, messages about mistakes, the keys of a case.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/problems.rs"]
mod problems;

mod case;
mod case_keys;
mod column_names;
mod faces;
mod fields;
mod issue_029_behaviour;
mod issue_029_tables;
mod messages;
mod motions;
mod overrides;
mod recordings;
mod track;
mod values;
