//! Shared by the tests of the half-truck.
#![allow(dead_code, clippy::unwrap_used)]

use nucars::truck::Choices;
use study::half_truck::catalog::{CatalogEntry, entries, entry};
use study::half_truck::files::Settings;
use study::half_truck::run::run;
use study::half_truck::{HalfTruckCase, HalfTruckResult};

pub const INCH: f64 = 0.0254;
pub const POUND: f64 = 4.448_221_615_260_5;
pub const POUND_INCH: f64 = POUND * INCH;

pub fn case(name: &str, duration: f64) -> HalfTruckCase {
    let entry: CatalogEntry = entry(name).unwrap();
    entry.case(&Choices::default(), duration).unwrap()
}

pub fn result(name: &str, duration: f64) -> HalfTruckResult {
    run(&case(name, duration), |_| ()).unwrap()
}

/// Returns a run with wedges' bodies and values set over it.
pub fn bodies(name: &str, duration: f64, set: &[&str]) -> HalfTruckCase {
    set_over(name, duration, &[&["option.wedges=bodies"], set].concat())
}

/// Returns a run with values set over it.
pub fn set_over(name: &str, duration: f64, set: &[&str]) -> HalfTruckCase {
    let settings = Settings {
        duration: Some(duration),
        set: set.iter().map(|typed| (*typed).to_owned()).collect(),
        ..Settings::default()
    };
    entry(name).unwrap().case_with(&settings).unwrap()
}

/// Runs several cases at a time.
pub fn run_cases(cases: &[HalfTruckCase]) -> Vec<HalfTruckResult> {
    let half = cases.len().div_ceil(2).max(1);
    std::thread::scope(|scope| {
        let parts: Vec<_> = cases
            .chunks(half)
            .map(|part| {
                scope.spawn(move || {
                    let run = |case: &HalfTruckCase| run(case, |_| ()).unwrap();
                    part.iter().map(run).collect::<Vec<_>>()
                })
            })
            .collect();
        parts.into_iter().flat_map(|part| part.join().unwrap()).collect()
    })
}

/// Runs all entries that are chosen, several at a time.
pub fn run_all(
    duration: f64,
    choose: impl Fn(&CatalogEntry) -> bool,
) -> Vec<(CatalogEntry, HalfTruckResult)> {
    let chosen: Vec<CatalogEntry> = entries().into_iter().filter(choose).collect();
    let half = chosen.len().div_ceil(2);
    std::thread::scope(|scope| {
        let parts: Vec<_> = chosen
            .chunks(half.max(1))
            .map(|part| {
                scope.spawn(move || {
                    let run = |entry: &CatalogEntry| (*entry, result(&entry.name(), duration));
                    part.iter().map(run).collect::<Vec<_>>()
                })
            })
            .collect();
        parts.into_iter().flat_map(|part| part.join().unwrap()).collect()
    })
}
