//! The race's tables, as text with Markdown tables.

use std::fmt::Write;

use crate::contest::{COMMON_OPTIONS, IN_OCTAVE, SOLVERS};
use crate::runner::REFERENCE;
use crate::standings::{Judgement, Standing};

/// What must be read first.
const CAVEATS: &str = "\
Read this first.

- Times are CPU times of the integration alone, the least of up to five repetitions, on a machine that may do other things: trust ratios
  of 1.5 and more within one run of the race.
- The drivers of the other solvers are ours (`crates/race/drivers`, `crates/race/src/diffsol.rs`). Who knows a solver better may set it
  better.
- All solvers but one (the last of these points) get the same compiled right-hand side and the same analytic Jacobian matrix; SciPy and
  Octave call them from their languages, which is where most of their time goes. Others integrate positions, speeds, bristles and one energy; ours integrates all
  energies of the ledger besides. No solver records when contacts change, but ours where its name says so, as in users' runs. It alone is told where contacts open and close and where slip
  reverses. Its Rosenbrock methods end their steps there, and hold speeds to the reference speed of friction (0.001 in/s, where a point sticks) and the wedge's positions to 1e-6 m where a wider tolerance
  is asked for: from 1e-3 to 1e-5 they do more than the others are asked to. Its TR-BDF2 and ESDIRK3 keep their Jacobian matrix in between
  and look there for reversals in Newton's method; their tolerance holds for displacements alone, and their steps end at the rows.
- The compiled solvers run at 3e-4, 3e-5, ... 3e-8 besides the decades of tolerance.
- The equations are those of this project: nothing here says how a solver does on others.
- Runs without bolster yaw ring and are chaotic in detail: only means are compared there, and one run alone is a matter of luck. Each
  is made from several starts, in each of which the wedge starts a hundredth of a millimetre lower than in the one before, every solver from the
  same ones; errors are root mean squares over the starts, each against a reference of its own, times and counts are means over them.
- Every error is compared only down to the floor, which is how far the reference's own solver at 1e-9 and 1e-10 is from itself at 1e-11; with several
  starts, that and twice the scatter of a root mean square over so many (with five, 1.6 times): nearer to it, luck decides who is better.
- Octave's ode15s gets one second of simulated time, and is compared with ours over the same second, whose first part is the
  release from the start. It runs twice: with the compiled right-hand side and Jacobian matrix, and on the yawed cases with the right-hand
  side in Octave's own language (`wedge_rates.m`, vectorized over the eight contacts, agreeing with the compiled one to 1e-10) and a Jacobian
  matrix by differences of its own.
";

/// What to read first, with what this program and everything in it that is Rust was compiled for.
#[must_use]
pub fn caveats() -> String {
    let processors = if cfg!(target_feature = "avx2") {
        "processors with AVX2"
    } else {
        "every processor of its kind"
    };
    format!(
        "{CAVEATS}- What is Rust - our integrator, diffsol, the right-hand side and the Jacobian matrix - is compiled for {processors}.\n"
    )
}

/// A time in words.
fn seconds(value: f64) -> String {
    if value < 1.0 {
        format!("{:.1} ms", value * 1e3)
    } else {
        format!("{value:.1} s")
    }
}

/// A count; some drivers do not count everything.
fn told(count: u64) -> String {
    if count == 0 {
        "-".to_owned()
    } else {
        count.to_string()
    }
}

fn power(value: f64) -> String {
    format!("{value:.0e}")
}

/// The options of every solver.
#[must_use]
pub fn options() -> String {
    let mut text = format!(
        "All: {COMMON_OPTIONS}; reference: {} at {}.\n\n",
        REFERENCE.0, REFERENCE.1
    );
    text.push_str("| solver | options beyond its defaults |\n|---|---|\n");
    for solver in SOLVERS {
        let _ = writeln!(text, "| {} | {} |", solver.name, solver.options);
    }
    text
}

/// How many times faster ours is, case by case and solver by solver: the least and the middle of all error levels.
#[must_use]
pub fn ratios(standings: &[Standing]) -> String {
    let mut text = String::new();
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
    let heads: Vec<&str> = columns.iter().map(|(head, _)| head.as_str()).collect();
    let _ = writeln!(
        text,
        "| case | floor | {} | Octave ode15s | the same, equations in Octave |",
        heads.join(" | ")
    );
    let _ = writeln!(text, "|---|---|{}---|---|", "---|".repeat(columns.len()));
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
        let _ = writeln!(text, "| {} |", cells.join(" | "));
    }
    text
}

/// The least ratio with its level, and the greatest.
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
pub fn at_level(standings: &[Standing], level: f64) -> String {
    let mut text = String::from(
        "| case | solver | tolerance | error | time | steps | right-hand sides | Jacobians | times ours |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    // Where the reference is zero there is no error to speak of.
    for one in standings.iter().filter(|one| one.floor > 0.0) {
        let ours = one.cheapest(&one.ours(), level);
        for name in one.solvers() {
            let mut case = one.case.clone();
            if one.span < 10.0 {
                let _ = write!(case, ", {} s", one.span);
            }
            let Some(run) = one.cheapest(&[name], level) else {
                let _ = writeln!(
                    text,
                    "| {case} | {name} | never as exact, or not in time | | | | | | |"
                );
                continue;
            };
            let outcome = &run.entry.outcome;
            let times = ours.map_or("-".to_owned(), |ours| {
                format!("{:.1}", outcome.cpu / ours.entry.outcome.cpu)
            });
            let _ = writeln!(
                text,
                "| {case} | {name} | {} | {} | {} | {} | {} | {} | {times} |",
                run.entry.tolerance,
                power(run.error.unwrap_or(f64::INFINITY)),
                seconds(outcome.cpu),
                outcome.steps,
                told(outcome.derivatives),
                told(outcome.jacobians),
            );
        }
    }
    text
}

/// Every failure, case by case.
#[must_use]
pub fn failures(standings: &[Standing]) -> String {
    let mut text = String::from("| case | solver | tolerances | why |\n|---|---|---|---|\n");
    for one in standings {
        for name in one.solvers() {
            let failed = |run: &&Judgement| run.entry.solver == name && !run.entry.outcome.failure.is_empty();
            // Runs that were spared after one that was out of time stand in a line of their own.
            for spared in [false, true] {
                let kind = |run: &&Judgement| run.entry.outcome.failure.starts_with("not tried") == spared;
                let runs: Vec<&Judgement> = one.runs.iter().filter(failed).filter(kind).collect();
                let Some(first) = runs.first() else { continue };
                let tolerances: Vec<&str> = runs.iter().map(|run| run.entry.tolerance.as_str()).collect();
                let _ = writeln!(
                    text,
                    "| {} | {name} | {} | {} |",
                    one.case,
                    tolerances.join(", "),
                    first.entry.outcome.failure
                );
            }
        }
    }
    text
}

/// All runs of a case: the cheapest of each solver at each level, and its failures.
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
                told(outcome.steps),
                told(outcome.rejected),
                told(outcome.derivatives),
                told(outcome.jacobians),
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

/// The whole text.
#[must_use]
pub fn everything(standings: &[Standing]) -> String {
    let mut text = format!("# The race\n\n{}\n## Options\n\n{}", caveats(), options());
    text.push_str(
        "\n## How many times longer the others take at equal error\n\nThe least ratio over all errors that both reach, with that error, \
         and the greatest; each solver at its best tolerance.\n\n",
    );
    text.push_str(&ratios(standings));
    let _ = write!(
        text,
        "\n## Each solver's cheapest run with an error of at most 1 %\n\n{}\n## Failures\n\n{}",
        at_level(standings, 1e-2),
        failures(standings)
    );
    for one in standings {
        let _ = write!(text, "\n## {}, {} s\n\n{}", one.case, one.span, standing(one));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome::Outcome;
    use crate::runner::Entry;

    fn run(solver: &str, error: f64, cpu: f64) -> Judgement {
        Judgement {
            entry: Entry {
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
        let text = ratios(&[standing]);
        let expected = "| a case | 1e-3 | 5.0 (at 3e-2) to 5.0 | - | never as exact | - | - |";
        assert!(text.lines().any(|line| line == expected), "{text}");
    }
}
