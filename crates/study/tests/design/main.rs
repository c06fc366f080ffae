//! Studies: documents, sampling, records.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod analytic;
mod common;
mod groups;
mod half_truck;
mod input;
mod limits;
mod records;
