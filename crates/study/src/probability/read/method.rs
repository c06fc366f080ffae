//! Reading the method with its numbers.

use crate::case::problem::{Problem, Problems};
use crate::case::section::{CaseSection, Names};
use crate::case::tree::NodeValue;
use crate::design::DIMENSIONS;
use crate::probability::Estimator;
use crate::probability::sample::Counting;
use crate::probability::subset::Subset;

#[derive(Clone, Copy, PartialEq)]
enum Method {
    Count(Counting),
    Subset,
}

const METHODS: Names<Method> = &[
    ("monte_carlo", Method::Count(Counting::MonteCarlo)),
    ("latin_hypercube", Method::Count(Counting::LatinHypercube)),
    ("sobol", Method::Count(Counting::Sobol)),
    ("subset", Method::Subset),
];
const OF_SUBSET: [&str; 5] = ["samples", "repeats", "level_probability", "levels", "most_runs"];
/// More runs than these are a slip of the pen: their points are in memory.
const MOST: u64 = 1_000_000;
const MOST_SEED: u64 = 1 << 52;
/// One in this many samples begins a chain.
const PARTS: [usize; 4] = [2, 4, 5, 10];
/// Fewer repeats tell too little of their scatter.
const LEAST_REPEATS: u64 = 4;

/// Reads the method and the number of base samples of indices.
pub(super) fn read(
    top: &CaseSection<'_>,
    dimensions: usize,
    problems: &mut Problems,
) -> Option<(Estimator, u64)> {
    let before = problems.count();
    let method = top.choice("method", METHODS, problems)?;
    let seed = whole(top, "seed", [0, MOST_SEED], Some(0), problems);
    let indices = match top.table.get("indices").map(|node| &node.value) {
        Some(NodeValue::Truth(false)) => Some(0),
        // A power of two fills the space evenly.
        Some(NodeValue::Truth(true)) => Some(128),
        _ => whole(top, "indices", [0, MOST], Some(0), problems),
    };
    let estimator = match method {
        Method::Count(counting) => {
            for key in OF_SUBSET {
                refuse(
                    top,
                    key,
                    "this method",
                    "it belongs to method = \"subset\"",
                    problems,
                );
            }
            if counting == Counting::Sobol && dimensions > DIMENSIONS {
                let message = format!(
                    "{dimensions} parameters are uncertain; the Sobol' sequence here has {DIMENSIONS}"
                );
                problems.push(Problem::new(message).help("take method = \"latin_hypercube\""));
            }
            let runs = whole(top, "runs", [1, MOST], None, problems);
            Estimator::Count {
                counting,
                runs: runs?,
                seed: seed?,
            }
        }
        Method::Subset => {
            let help = "subset simulation has `samples` in a level, `repeats`, and `most_runs` at most";
            refuse(top, "runs", "subset simulation", help, problems);
            let samples = whole(top, "samples", [20, MOST], Some(200), problems);
            let repeats = whole(top, "repeats", [LEAST_REPEATS, 10_000], Some(10), problems);
            let levels = whole(top, "levels", [1, 100], Some(8), problems);
            let most_runs = whole(top, "most_runs", [1, MOST], None, problems);
            let parts = parts(top, problems);
            let (samples, repeats, parts) = (samples?, repeats?, parts?);
            if samples % parts as u64 != 0 {
                let message = format!("`samples` is {samples}, no multiple of {parts}");
                let help = format!(
                    "one in {parts} begins a chain of {parts}: write {}",
                    samples.next_multiple_of(parts as u64)
                );
                let problem = Problem::new(message).help(help);
                problems.push(match top.table.get("samples") {
                    Some(node) => problem.at(&node.place).label("not in whole chains"),
                    None => problem,
                });
            }
            if let (Some(most), Some(node)) = (most_runs, top.table.get("most_runs"))
                && most < samples * repeats
            {
                let message =
                    format!("`most_runs` is {most}, less than the first level of all repeats takes");
                let help = format!(
                    "{repeats} repeats of {samples} samples are {} runs, and each further level takes \
                     {} % of them; write fewer `samples`, or more runs",
                    samples * repeats,
                    100 - 100 / parts
                );
                problems.push(Problem::new(message).at(&node.place).label("too few").help(help));
            }
            Estimator::Subset(Subset {
                samples: samples as usize,
                parts,
                repeats: repeats as usize,
                levels: levels? as usize,
                seed: seed?,
                most_runs: most_runs?,
            })
        }
    };
    (problems.count() == before).then_some((estimator, indices?))
}

/// Reads the probability of a level, as the number of parts of which one is kept.
fn parts(top: &CaseSection<'_>, problems: &mut Problems) -> Option<usize> {
    let Some(node) = top.table.get("level_probability") else {
        return Some(10);
    };
    let found = match node.value {
        NodeValue::Number(value) => PARTS
            .into_iter()
            .find(|parts| (value * *parts as f64 - 1.0).abs() < 1e-9),
        _ => None,
    };
    if found.is_none() {
        let message = format!("`level_probability` is {}", node.place.text());
        let problem = Problem::new(message)
            .at(&node.place)
            .label("0.1, 0.2, 0.25 or 0.5");
        problems.push(problem.help("write level_probability = 0.1: the usual share of a level that is kept"));
    }
    found
}

/// Reads a whole number; `default` where it is left out, if it may be.
fn whole(
    top: &CaseSection<'_>,
    key: &str,
    [least, most]: [u64; 2],
    default: Option<u64>,
    problems: &mut Problems,
) -> Option<u64> {
    let help = format!("write for example {key} = {}", default.unwrap_or(300).max(least));
    if let (Some(default), None) = (default, top.table.get(key)) {
        return Some(default);
    }
    let node = top.require(key, &help, problems)?;
    match node.value {
        NodeValue::Number(value) if value.fract() == 0.0 && value >= least as f64 && value <= most as f64 => {
            Some(value as u64)
        }
        _ => {
            let text = node.place.text();
            let message = format!("`{key}` is {text}; a whole number, at least {least}, is expected");
            let problem = Problem::new(message).at(&node.place);
            problems.push(
                problem
                    .label(format!("a whole number from {least} to {most}"))
                    .help(help),
            );
            None
        }
    }
}

fn refuse(top: &CaseSection<'_>, key: &str, what: &str, help: &str, problems: &mut Problems) {
    if let Some(entry) = top.table.entry(key) {
        let problem = Problem::new(format!("{what} has no `{key}`")).at(&entry.key_place);
        problems.push(problem.label("not here").help(help));
    }
}
