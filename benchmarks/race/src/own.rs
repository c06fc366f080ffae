//! Our own integrator in the race: all quadratures of the energy ledger, error control of all; contact modes
//! recorded, as in users' runs, or not, as by the other solvers.

use integrate::{Family, Integrator, Method, Options};

use crate::clock::Stopwatch;
use crate::equations::Equations;
use crate::outcome::Outcome;
use crate::problem::RaceProblem;

/// Integrates up to `rows` rows, contact states `recorded` or not; the states of the rows reached.
///
/// # Errors
/// The problem does not exist, or the integrator refuses the start.
pub fn run(
    name: &str,
    method: Method,
    recorded: bool,
    tolerance: f64,
    limit: f64,
    rows: usize,
) -> Result<(Outcome, Vec<f64>), String> {
    let problem = RaceProblem::named(name).map_err(|error| error.to_string())?;
    let equations = Equations::new(problem.system.clone(), &problem.start);
    let rows = rows.min(problem.rows());
    let end = problem.time(rows - 1);
    let n = equations.dimension();
    let mut states = Vec::with_capacity(rows * n);
    let mut full = problem.start.clone();
    let mut reduced = vec![0.0; n];
    let mut outcome = Outcome::default();
    let stopwatch = Stopwatch::start();
    let options = Options {
        relative_tolerance: tolerance,
        record_events: recorded,
        maximum_step: match method.tableau().family {
            Family::DiagonallyImplicit => problem.interval,
            _ => f64::INFINITY,
        },
        ..Options::of(method)
    };
    let mut integrator = Integrator::new(problem.system.clone(), options, 0.0, &problem.start)
        .map_err(|error| error.to_string())?;
    states.extend_from_slice(equations.start());
    let mut row = 1;
    while row < rows {
        if let Err(error) = integrator.step_to(integrator.step_limit(problem.time(row), end)) {
            outcome.failure = error.to_string();
            break;
        }
        while row < rows && problem.time(row) <= integrator.time() {
            integrator.interpolate(problem.time(row), &mut full);
            equations.reduce(&full, &mut reduced);
            states.extend_from_slice(&reduced);
            row += 1;
        }
        if integrator.statistics().steps % 1024 == 0 && stopwatch.cpu() > limit {
            outcome.failure = format!("out of time at t = {:.3} s", integrator.time());
            break;
        }
    }
    outcome.cpu = stopwatch.cpu();
    outcome.wall = stopwatch.wall();
    let statistics = integrator.statistics();
    outcome.steps = statistics.steps;
    outcome.rejected = statistics.rejected();
    outcome.derivatives = statistics.derivatives;
    outcome.jacobians = statistics.jacobians;
    outcome.factorizations = statistics.factorizations;
    outcome.rows = row;
    Ok((outcome, states))
}
