//! The built-in runs, made once for all tests of a file, two at a time.
#![allow(dead_code, clippy::unwrap_used, clippy::expect_used)]

use std::collections::BTreeMap;
use std::sync::{LazyLock, Mutex};

use study::case::{Case, builtin};
use study::result::RunResult;
use study::run::Run;

pub const INCH: f64 = 0.0254;
pub const LBF: f64 = 0.453_592_37 * 9.806_65;
pub const LBF_IN: f64 = LBF * INCH;

/// The twelve runs of table 4-1.
pub static TWELVE: LazyLock<BTreeMap<&'static str, RunResult>> = LazyLock::new(|| {
    let cases: Vec<Case> = builtin::thesis_names()
        .map(|name| builtin::case(name).unwrap())
        .collect();
    builtin::thesis_names().zip(run_all(&cases, 2)).collect()
});

/// Returns one of them.
pub fn twelve(name: &str) -> &'static RunResult {
    &TWELVE[name]
}

/// Runs cases in so many threads; results in the order of the cases.
pub fn run_all(cases: &[Case], threads: usize) -> Vec<RunResult> {
    let next = Mutex::new(0);
    let results = Mutex::new((0..cases.len()).map(|_| None).collect::<Vec<_>>());
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let i = {
                        let mut next = next.lock().unwrap();
                        *next += 1;
                        *next - 1
                    };
                    let Some(case) = cases.get(i) else { break };
                    let result = Run::new(case).unwrap().finish(|_| {});
                    results.lock().unwrap()[i] = Some(result);
                }
            });
        }
    });
    results
        .into_inner()
        .unwrap()
        .into_iter()
        .map(Option::unwrap)
        .collect()
}

/// Returns a column in inches, lbf, lbf·in.
pub fn column(result: &RunResult, name: &str, unit: f64) -> Vec<f64> {
    result
        .column(name)
        .unwrap_or_else(|| panic!("no column {name}"))
        .iter()
        .map(|v| v / unit)
        .collect()
}

/// Branch means of the vertical wedge force (up, down) in lbf, and the energy per cycle at the side frame in
/// lbf·in, as the summary has them.
pub fn averages(result: &RunResult) -> [f64; 3] {
    let averages = &result.summary.averages;
    let force = |means: &BTreeMap<String, study::summary::SummaryValue>| {
        let mean = &means["vertical_wedge_force"];
        assert_eq!(mean.unit, "lbf");
        mean.value
    };
    let energy = &averages.energy_per_cycle["side_frame"];
    [force(&averages.up), force(&averages.down), energy.value]
}
