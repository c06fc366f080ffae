//! What a run says about itself: its ledger, its limits, its warnings, and extreme cars.
#![allow(missing_docs, clippy::unwrap_used, clippy::panic)]

mod extreme_cars;
mod limits;
mod short_runs;
mod warnings;
