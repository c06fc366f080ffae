//! A point: the twelve runs there, and what they decide of each statement.

use std::panic::{AssertUnwindSafe, catch_unwind};

use study::case::{Case, builtin};
use study::result::RunResult;
use study::run::Run;
use study::summary::RunSummary;

use super::axes;
use crate::agreement::TruckOutcome;
use crate::claims::{ClaimVerdict, Evidence, verdicts};

/// The outcome at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct PointOutcome {
    /// The verdict on each statement, in the order of the thesis.
    pub verdicts: Vec<ClaimVerdict>,
    /// For each of the axes of the thesis's figures ([`super::AXES`]), true if the runs stay within them.
    pub axes: Vec<bool>,
    /// Runs that failed or did not come to their end, with why. What needs them is not decided there.
    pub unsound: Vec<String>,
}

/// Makes the twelve runs with these values over the cases', and decides. `trucks` are runs of the half-truck,
/// which has nothing of what is open.
#[must_use]
pub fn compute(set: &[String], trucks: &[TruckOutcome]) -> PointOutcome {
    let (mut runs, mut unsound) = (Vec::new(), Vec::new());
    for name in builtin::thesis_names() {
        // A mistake of ours in one run must not take the others with it.
        let run = catch_unwind(AssertUnwindSafe(|| run(name, set)))
            .unwrap_or_else(|_| Err("a mistake of Wedgelab itself".to_owned()));
        match run {
            Ok((case, result)) => {
                let why = result.summary.outcome().told();
                unsound.extend(why.map(|why| format!("{name} {why}")));
                runs.push((case, result));
            }
            Err(why) => unsound.push(format!("{name}: {why}")),
        }
    }
    let evidence = Evidence::new(runs.iter().map(|(case, result)| (case, result)))
        .with_trucks(trucks.iter().map(|(entry, result)| (entry, result)));
    PointOutcome {
        verdicts: verdicts(&evidence),
        axes: axes::within(&runs),
        unsound,
    }
}

fn run(name: &str, set: &[String]) -> Result<(Case, RunResult), String> {
    let case = builtin::case_with(name, set).map_err(|error| error.to_string())?;
    let run = Run::new(&case).map_err(|error| error.to_string())?;
    Ok((case, run.finish(|_| ())))
}
