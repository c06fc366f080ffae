//! The race's tables, as text with Markdown tables.

use std::fmt::{self, Write};

use serde::{Deserialize, Serialize};

use crate::contest::IN_OCTAVE;
use crate::problem::is_yawed;
use crate::standings::{Judgement, Standing};

/// A table of texts. Stored as its lines: the head, then the rows.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "Vec<String>", into = "Vec<String>")]
pub struct MarkdownTable {
    /// The names of the columns.
    pub head: Vec<String>,
    /// The rows, as long as the head.
    pub rows: Vec<Vec<String>>,
}

/// The separator of the cells of a line.
const BETWEEN: &str = " | ";

impl From<Vec<String>> for MarkdownTable {
    fn from(lines: Vec<String>) -> Self {
        let cells = |line: &String| line.split(BETWEEN).map(str::to_owned).collect::<Vec<_>>();
        let head = lines.first().map(cells).unwrap_or_default();
        let rows = lines.iter().skip(1).map(|line| {
            let mut row = cells(line);
            row.resize(head.len(), String::new());
            row
        });
        Self {
            rows: rows.collect(),
            head,
        }
    }
}

impl From<MarkdownTable> for Vec<String> {
    fn from(table: MarkdownTable) -> Self {
        let lines = std::iter::once(table.head).chain(table.rows);
        let lines = lines.filter(|line| !line.is_empty());
        // Empty cells at the end are left out.
        lines
            .map(|line| line.join(BETWEEN).trim_end_matches([' ', '|']).to_owned())
            .collect()
    }
}

impl MarkdownTable {
    fn new<S: ToString>(head: &[S]) -> Self {
        Self {
            head: head.iter().map(ToString::to_string).collect(),
            rows: Vec::new(),
        }
    }
}

impl fmt::Display for MarkdownTable {
    /// Writes it as Markdown.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "| {} |", self.head.join(" | "))?;
        writeln!(f, "|{}", "---|".repeat(self.head.len()))?;
        self.rows
            .iter()
            .try_for_each(|row| writeln!(f, "| {} |", row.join(" | ")))
    }
}

/// Returns the processor features that this program and all Rust in it were compiled for.
#[must_use]
pub fn processors() -> &'static str {
    if cfg!(target_feature = "avx2") {
        "processors with AVX2"
    } else {
        "every processor of its kind"
    }
}

/// Returns a time in words.
fn seconds(value: f64) -> String {
    if value < 1.0 {
        format!("{:.1} ms", value * 1e3)
    } else {
        format!("{value:.1} s")
    }
}

/// Returns a count; some drivers do not count everything.
fn count_text(count: u64) -> String {
    if count == 0 {
        "-".to_owned()
    } else {
        count.to_string()
    }
}

fn power(value: f64) -> String {
    format!("{value:.0e}")
}

/// Returns the table of ratios of times to ours, case by case and solver by solver: the least and the middle
/// of all error levels.
#[must_use]
pub fn ratios(standings: &[Standing]) -> MarkdownTable {
    let full = standings.iter().map(|one| one.span).fold(0.0, f64::max);
    let rows: Vec<&Standing> = standings.iter().filter(|one| one.span == full).collect();
    let mut columns: Vec<(String, Vec<&str>)> = vec![("CVODE".to_owned(), vec!["CVODE BDF"])];
    columns.push((
        "diffsol's best".to_owned(),
        vec!["diffsol BDF", "diffsol TR-BDF2", "diffsol ESDIRK34"],
    ));
    columns.push((
        "SciPy's best".to_owned(),
        vec!["SciPy LSODA", "SciPy BDF", "SciPy Radau"],
    ));
    let heads = columns.iter().map(|(head, _)| head.as_str());
    let heads = ["case", "floor"].into_iter().chain(heads);
    let heads: Vec<&str> = heads
        .chain(["Octave ode15s", "the same, equations in Octave"])
        .collect();
    let mut table = MarkdownTable::new(&heads);
    for one in rows {
        let mut cells = vec![one.case.clone(), power(one.floor)];
        let (ours, took_part) = (one.ours(), one.solvers());
        for (_, names) in &columns {
            let both = !ours.is_empty() && names.iter().any(|name| took_part.contains(name));
            cells.push(if both {
                cell(&one.ratios(names, &ours))
            } else {
                "-".to_owned()
            });
        }
        for name in ["Octave ode15s", IN_OCTAVE] {
            // The longest span first: mostly the only one.
            let mut spans = standings.iter().filter(|other| other.case == one.case);
            cells.push(match spans.find(|other| other.solvers().contains(&name)) {
                None => "-".to_owned(),
                // The reference is zero: runs are exact or not, and their cost says nothing.
                Some(span) if span.floor == 0.0 => "no force in this second".to_owned(),
                Some(span) => cell(&span.ratios(&[name], &span.ours())),
            });
        }
        table.rows.push(cells);
    }
    table
}

/// Returns the least ratio with its level, and the greatest.
fn cell(ratios: &[(f64, f64)]) -> String {
    let least = ratios.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let most = ratios.iter().map(|(_, ratio)| *ratio).fold(0.0, f64::max);
    match least {
        Some((level, least)) => format!("{least:.1} (at {}) to {most:.1}", power(*level)),
        None => "never as exact".to_owned(),
    }
}

/// Case by case the cheapest run of each solver whose error is not above `level`, or the floor.
#[must_use]
pub fn at_level(standings: &[Standing], level: f64) -> MarkdownTable {
    let mut table = MarkdownTable::new(&[
        "case",
        "solver",
        "tolerance",
        "error",
        "time",
        "steps",
        "right-hand sides",
        "Jacobians",
        "times ours",
    ]);
    // Where the reference is zero there is no error to speak of.
    for one in standings.iter().filter(|one| one.floor > 0.0) {
        let ours = one.cheapest(&one.ours(), level);
        for name in one.solvers() {
            let mut case = one.case.clone();
            if one.span < 10.0 {
                let _ = write!(case, ", {} s", one.span);
            }
            let Some(run) = one.cheapest(&[name], level) else {
                let mut row = vec![case, name.to_owned(), "never as exact, or not in time".to_owned()];
                row.resize(table.head.len(), String::new());
                table.rows.push(row);
                continue;
            };
            let outcome = &run.entry.outcome;
            let times = ours.map_or("-".to_owned(), |ours| {
                format!("{:.1}", outcome.cpu / ours.entry.outcome.cpu)
            });
            table.rows.push(vec![
                case,
                name.to_owned(),
                run.entry.tolerance.clone(),
                power(run.error.unwrap_or(f64::INFINITY)),
                seconds(outcome.cpu),
                outcome.steps.to_string(),
                count_text(outcome.derivatives),
                count_text(outcome.jacobians),
                times,
            ]);
        }
    }
    table
}

/// Time and error of some solvers at one tolerance, in the yawed cases, which converge.
#[must_use]
pub fn at_tolerance(standings: &[Standing], tolerance: &str, solvers: &[&str]) -> MarkdownTable {
    let heads: Vec<&str> = ["case"].into_iter().chain(solvers.iter().copied()).collect();
    let mut table = MarkdownTable::new(&heads);
    let full = standings.iter().map(|one| one.span).fold(0.0, f64::max);
    for one in standings
        .iter()
        .filter(|one| one.span == full && is_yawed(&one.case))
    {
        let cell = |solver: &&str| {
            let same = |run: &&Judgement| run.entry.solver == *solver && run.entry.tolerance == tolerance;
            match one.runs.iter().find(same) {
                None => "-".to_owned(),
                Some(run) => match run.error {
                    Some(error) if run.finished() => {
                        format!("{}, {error:.1e}", seconds(run.entry.outcome.cpu))
                    }
                    _ => "out of time".to_owned(),
                },
            }
        };
        let cells = solvers.iter().map(cell);
        table
            .rows
            .push([one.case.clone()].into_iter().chain(cells).collect());
    }
    table
}

/// Every failure, case by case.
#[must_use]
pub fn failures(standings: &[Standing]) -> MarkdownTable {
    let mut table = MarkdownTable::new(&["case", "solver", "tolerances", "why"]);
    for one in standings {
        for name in one.solvers() {
            let failed = |run: &&Judgement| run.entry.solver == name && !run.entry.outcome.failure.is_empty();
            // Runs that were spared after one that was out of time stand in a line of their own.
            for spared in [false, true] {
                let kind = |run: &&Judgement| run.entry.outcome.failure.starts_with("not tried") == spared;
                let runs: Vec<&Judgement> = one.runs.iter().filter(failed).filter(kind).collect();
                let Some(first) = runs.first() else { continue };
                let tolerances: Vec<&str> = runs.iter().map(|run| run.entry.tolerance.as_str()).collect();
                table.rows.push(vec![
                    one.case.clone(),
                    name.to_owned(),
                    tolerances.join(", "),
                    first.entry.outcome.failure.clone(),
                ]);
            }
        }
    }
    table
}

/// Returns all runs of a case: the cheapest of each solver at each level, and its failures.
#[must_use]
pub fn standing(one: &Standing) -> String {
    let mut text = format!(
        "Judged by {}; floor {}; {} s of simulated time{}.\n\n",
        one.judged,
        power(one.floor),
        one.span,
        match one.starts {
            1 => String::new(),
            starts => format!("; {starts} starts"),
        }
    );
    text.push_str(
        "| solver | tolerance | error | time | steps | rejected | right-hand sides | Jacobians |\n",
    );
    text.push_str("|---|---|---|---|---|---|---|---|\n");
    let mut failures = Vec::new();
    for name in one.solvers() {
        let runs: Vec<&Judgement> = one.runs.iter().filter(|run| run.entry.solver == name).collect();
        for run in runs {
            let (entry, outcome) = (&run.entry, &run.entry.outcome);
            if !run.finished() {
                failures.push(format!("{name} at {}: {}", entry.tolerance, outcome.failure));
                continue;
            }
            // Off the front: another run of the same solver is at least as exact and as quick.
            let error = run.error.unwrap_or(f64::INFINITY).max(one.floor);
            let front = one
                .cheapest(&[name], error)
                .is_none_or(|best| best.entry.tolerance == entry.tolerance);
            let _ = writeln!(
                text,
                "| {name} | {}{} | {} | {} | {} | {} | {} | {} |",
                entry.tolerance,
                if front { " *" } else { "" },
                power(run.error.unwrap_or(f64::INFINITY)),
                seconds(outcome.cpu),
                count_text(outcome.steps),
                count_text(outcome.rejected),
                count_text(outcome.derivatives),
                count_text(outcome.jacobians),
            );
        }
    }
    text.push_str("\n`*`: on the solver's own front.\n");
    if !failures.is_empty() {
        text.push_str("\nFailures:\n\n");
        for failure in failures {
            let _ = writeln!(text, "- {failure}");
        }
    }
    text
}

/// Returns all runs of all cases.
#[must_use]
pub fn everything(standings: &[Standing]) -> String {
    let mut text = String::from("# All runs of the race\n");
    for one in standings {
        let _ = write!(text, "\n## {}, {} s\n\n{}", one.case, one.span, standing(one));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome::Outcome;
    use crate::runner::RaceEntry;

    fn run(solver: &str, error: f64, cpu: f64) -> Judgement {
        Judgement {
            entry: RaceEntry {
                case: "a case".to_owned(),
                solver: solver.to_owned(),
                tolerance: "1e-6".to_owned(),
                rows: 11,
                outcome: Outcome {
                    cpu,
                    ..Outcome::default()
                },
            },
            error: Some(error),
        }
    }

    #[test]
    fn who_did_not_run_is_not_called_inexact() {
        let standing = Standing {
            case: "a case".to_owned(),
            span: 10.0,
            judged: "position".to_owned(),
            floor: 1e-3,
            starts: 1,
            runs: vec![
                run("wedgelab Rodas5P", 2e-3, 0.1),
                run("CVODE BDF", 2e-3, 0.5),
                run("SciPy LSODA", 0.5, 0.5),
            ],
        };
        let text = ratios(&[standing]).to_string();
        let expected = "| a case | 1e-3 | 5.0 (at 3e-2) to 5.0 | - | never as exact | - | - |";
        assert!(text.lines().any(|line| line == expected), "{text}");
    }
}
