//! Runs of built-in trucks.
#![allow(dead_code, clippy::unwrap_used)]

use study::case::Tables;
use study::run::Run;
use study::truck::run::TruckResult;
use study::truck::{TruckCase, builtin};

pub const INCH: f64 = 0.0254;
pub const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// kip·in, in N·m.
pub const KIP_INCH: f64 = 1e3 * POUND_FORCE * INCH;

/// Returns a built-in truck with values set over it.
pub fn case(name: &str, set: &[&str]) -> TruckCase {
    let set: Vec<String> = set.iter().map(|text| (*text).to_owned()).collect();
    builtin::case_with(name, &set).unwrap()
}

/// Returns what is read from a complete case.
pub fn read_back(case: &TruckCase) -> TruckCase {
    TruckCase::parse("again.toml", case.to_toml(), Tables::nowhere(), &[]).unwrap()
}

/// Returns its run.
pub fn run(name: &str, set: &[&str]) -> TruckResult {
    let result = Run::new(&case(name, set)).unwrap().finish(|_| ());
    assert!(result.summary.complete, "{name}: {:?}", result.summary.stopped);
    result
}

/// Returns a column of a result.
pub fn column<'r>(result: &'r TruckResult, name: &str) -> &'r [f64] {
    result.column(name).unwrap()
}

/// Returns a value of a column at a time (s), a multiple of the output interval of 0.01 s.
pub fn at(result: &TruckResult, name: &str, time: f64) -> f64 {
    column(result, name)[(time / 0.01).round() as usize]
}
