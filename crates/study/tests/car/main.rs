//! Freight cars on track: cases, statistics, messages.
#![allow(clippy::unwrap_used)]

mod case;
mod input;
mod run;
mod stability;
mod statistics;
