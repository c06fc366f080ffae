//! Errors of all runs, work-precision fronts, and how many times faster one solver is than another at equal
//! error.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;

use crate::contest::solver;
use crate::measure::{Judge, Quantities};
use crate::outcome::{Outcome, read_states};
use crate::problem::{Judged, start_of, with_start};
use crate::runner::{REFERENCE, RaceEntry, states_file};

/// Errors at which solvers are compared.
pub const LEVELS: [f64; 9] = [3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6, 1e-7];

/// A run with its error.
#[derive(Clone, Debug, Serialize)]
pub struct Judgement {
    /// The run.
    #[serde(flatten)]
    pub entry: RaceEntry,
    /// Its error against the reference; none if it failed.
    pub error: Option<f64>,
}

impl Judgement {
    /// Returns whether it came to its end.
    #[must_use]
    pub fn finished(&self) -> bool {
        self.entry.outcome.failure.is_empty() && self.error.is_some()
    }
}

/// All runs of a case over the same span.
#[derive(Clone, Debug, Serialize)]
pub struct Standing {
    /// The problem.
    pub case: String,
    /// Simulated time, s.
    pub span: f64,
    /// On what it is judged.
    pub judged: String,
    /// The error of the reference: smaller errors say nothing.
    pub floor: f64,
    /// From how many starts each run was made: errors and the floor are root mean squares over them, times
    /// and counts their means; the floor then has twice the scatter of such a root mean square on top.
    pub starts: usize,
    /// The runs.
    pub runs: Vec<Judgement>,
}

/// Judges all entries.
///
/// # Errors
/// A file cannot be read, or a reference is missing.
pub fn judge(folder: &Path, entries: &[RaceEntry]) -> Result<Vec<Standing>, String> {
    let mut groups: BTreeMap<(usize, usize), BTreeMap<u32, Vec<&RaceEntry>>> = BTreeMap::new();
    let mut cases: Vec<&str> = Vec::new();
    for entry in entries {
        let (case, start) = start_of(&entry.case);
        if !cases.contains(&case) {
            cases.push(case);
        }
        let number = cases.iter().position(|known| *known == case).unwrap_or(0);
        // The longest span first.
        let group = groups.entry((number, usize::MAX - entry.rows)).or_default();
        group.entry(start).or_default().push(entry);
    }
    let mut standings = Vec::new();
    for ((number, _), starts) in groups {
        let each = starts
            .iter()
            .map(|(start, group)| standing(folder, &with_start(cases[number], *start), group));
        standings.extend(over_starts(each.collect::<Result<_, _>>()?));
    }
    Ok(standings)
}

/// Returns the means of the same case over several starts, the first its own. A run counts that came through
/// from each.
#[must_use]
pub fn over_starts(each: Vec<Standing>) -> Option<Standing> {
    let starts = each.len();
    let floor = root_mean_square(each.iter().map(|one| one.floor), starts);
    let mut others = each.into_iter();
    let mut whole = others.next()?;
    let others: Vec<Standing> = others.collect();
    whole.floor = floor;
    if starts > 1 {
        // A root mean square over n starts scatters by 1/√(2n) of itself. Nearer to the floor than twice
        // that, who is below a level and who is above it would be luck.
        whole.floor *= 1.0 + (2.0 / starts as f64).sqrt();
    }
    for run in whole.runs.iter_mut().filter(|run| run.finished()) {
        let same = |one: &&Judgement| {
            one.entry.solver == run.entry.solver && one.entry.tolerance == run.entry.tolerance
        };
        let rest: Vec<&Judgement> = others
            .iter()
            .filter_map(|one| one.runs.iter().find(same))
            .collect();
        let failed = rest.iter().find(|one| !one.finished());
        if failed.is_some() || rest.len() + 1 < starts {
            let started = failed.map_or_else(
                || format!("run from {} of {starts} starts only", rest.len() + 1),
                |one| format!("{} (started {})", one.entry.outcome.failure, one.entry.case),
            );
            run.entry.outcome.failure = started;
            run.error = None;
            continue;
        }
        let errors = rest.iter().filter_map(|one| one.error).chain(run.error);
        run.error = Some(root_mean_square(errors, starts));
        let outcomes: Vec<&Outcome> = rest.iter().map(|one| &one.entry.outcome).collect();
        run.entry.outcome = run.entry.outcome.mean_with(&outcomes);
    }
    whole.starts = starts;
    Some(whole)
}

fn root_mean_square(values: impl Iterator<Item = f64>, number: usize) -> f64 {
    (values.map(|value| value * value).sum::<f64>() / number as f64).sqrt()
}

fn standing(folder: &Path, case: &str, group: &[&RaceEntry]) -> Result<Standing, String> {
    let mut judge = Judge::new(case)?;
    let (all, rows) = (judge.problem().rows(), group[0].rows);
    let read =
        |judge: &mut Judge, solver: &str, tolerance: &str, of: usize| -> Result<Option<Quantities>, String> {
            let file = states_file(folder, case, solver, tolerance, of);
            let states =
                read_states(&file).map_err(|error| format!("cannot read {}: {error}", file.display()))?;
            Ok(judge.quantities(&states, rows))
        };
    let missing = || format!("{case}: there is no reference");
    let reference = read(&mut judge, REFERENCE.0, REFERENCE.1, all)?.ok_or_else(missing)?;
    let second = read(&mut judge, REFERENCE.0, REFERENCE.2, all)?.ok_or_else(missing)?;
    let mut floor = second.error(&reference);
    let means = matches!(reference, Quantities::Means(_));
    let mut runs = Vec::new();
    for entry in group {
        if [REFERENCE.1, REFERENCE.2].contains(&entry.tolerance.as_str()) {
            continue;
        }
        let error = if entry.outcome.failure.is_empty() {
            read(&mut judge, &entry.solver, &entry.tolerance, rows)?.map(|found| found.error(&reference))
        } else {
            None
        };
        // What is chaotic scatters: the reference is not known better than its solver's close tolerances
        // agree.
        let close = entry.solver == REFERENCE.0 && entry.tolerance == "1e-9";
        if let (true, Some(error)) = (close, error) {
            floor = floor.max(error);
        }
        runs.push(Judgement {
            entry: (*entry).clone(),
            error,
        });
    }
    let judged = match (judge.problem().judged, means) {
        (Judged::Position, _) => "position",
        (_, true) => "branch means and energy per cycle",
        _ => "time series of the forces",
    };
    Ok(Standing {
        case: case.to_owned(),
        span: judge.problem().time(rows - 1),
        judged: judged.to_owned(),
        floor,
        starts: 1,
        runs,
    })
}

impl Standing {
    /// Returns the solvers that have runs, in the order of the runs.
    #[must_use]
    pub fn solvers(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for run in &self.runs {
            if !names.contains(&run.entry.solver.as_str()) {
                names.push(&run.entry.solver);
            }
        }
        names
    }

    /// Returns the cheapest finished run of the named solvers whose error is not above `level` (or the floor,
    /// if that is higher).
    #[must_use]
    pub fn cheapest(&self, names: &[&str], level: f64) -> Option<&Judgement> {
        let level = level.max(self.floor);
        self.runs
            .iter()
            .filter(|run| run.finished() && names.contains(&run.entry.solver.as_str()))
            .filter(|run| run.error.is_some_and(|error| error <= level))
            .min_by(|a, b| a.entry.outcome.cpu.total_cmp(&b.entry.outcome.cpu))
    }

    /// Returns the levels that this standing can tell apart: those above the floor, and the floor itself.
    #[must_use]
    pub fn levels(&self) -> Vec<f64> {
        let mut levels: Vec<f64> = LEVELS.into_iter().filter(|level| *level > self.floor).collect();
        if levels.is_empty() {
            levels.push(self.floor);
        }
        levels
    }

    /// Returns the ratio of the times of `others` to those of `ours` at equal error: each at its best
    /// tolerance; level by level where both come.
    #[must_use]
    pub fn ratios(&self, others: &[&str], ours: &[&str]) -> Vec<(f64, f64)> {
        let levels = self.levels().into_iter();
        levels
            .filter_map(|level| {
                let (other, own) = (self.cheapest(others, level)?, self.cheapest(ours, level)?);
                Some((level, other.entry.outcome.cpu / own.entry.outcome.cpu))
            })
            .collect()
    }

    /// Our own solvers of this standing.
    #[must_use]
    pub fn ours(&self) -> Vec<&str> {
        let ours = |name: &&str| solver(name).is_some_and(|solver| solver.ours);
        self.solvers().into_iter().filter(ours).collect()
    }
}
