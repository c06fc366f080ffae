//! diffsol in the race: BDF, TR-BDF2 and ESDIRK34, dense LU (nalgebra), the analytic Jacobian.
//!
//! Options beyond its defaults: relative tolerance zero and an absolute one of tolerance times scale for each
//! state, as every solver here; no limit of failures of Newton's method and of the error test, without which
//! runs end at impacts.

use std::cell::{Cell, RefCell};

use diffsol::{
    DiffsolError, NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquationsImplicit, OdeSolverMethod,
    OdeSolverStopReason, Vector,
};

use crate::clock::Stopwatch;
use crate::equations::Equations;
use crate::outcome::Outcome;
use crate::problem::RaceProblem;

/// diffsol's methods in the race.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Backward differentiation formulas of variable order.
    Bdf,
    /// The trapezoidal rule and the second of those formulas in turn.
    TrBdf2,
    /// A singly diagonally implicit Runge-Kutta method of order 3 (4).
    Esdirk34,
}

/// The Jacobian matrix, kept between the products that diffsol asks for.
struct StoredStates {
    time: f64,
    state: Vec<f64>,
    matrix: Vec<f64>,
}

/// Integrates up to `rows` rows; the states of the rows reached. `fresh`: a new Jacobian and
/// factorization each step.
///
/// # Errors
/// The problem does not exist, or diffsol refuses it.
pub fn run(
    name: &str,
    method: Method,
    fresh: bool,
    tolerance: f64,
    limit: f64,
    rows: usize,
) -> Result<(Outcome, Vec<f64>), String> {
    let problem = RaceProblem::named(name).map_err(|error| error.to_string())?;
    let equations = Equations::new(problem.system.clone(), &problem.start);
    let n = equations.dimension();
    let start = equations.start().to_vec();
    let absolute: Vec<f64> = equations.scales().iter().map(|scale| tolerance * scale).collect();
    let rows = rows.min(problem.rows());
    let mut states = Vec::with_capacity(rows * n);
    states.extend_from_slice(&start);
    let equations = RefCell::new(equations);
    let kept = RefCell::new(StoredStates {
        time: f64::NAN,
        state: vec![f64::NAN; n],
        matrix: vec![0.0; n * n],
    });
    let (derivatives, jacobians) = (Cell::new(0), Cell::new(0));
    let mut outcome = Outcome::default();
    let stopwatch = Stopwatch::start();
    let mut built = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(0.0)
        .atol(absolute)
        .rhs_implicit(
            |x: &[f64], _: &[f64], t: f64, dx: &mut [f64]| {
                derivatives.set(derivatives.get() + 1);
                equations.borrow_mut().rates(t, x, dx);
            },
            |x: &[f64], _: &[f64], t: f64, v: &[f64], y: &mut [f64]| {
                let kept = &mut *kept.borrow_mut();
                if kept.time != t || kept.state != x {
                    kept.time = t;
                    kept.state.copy_from_slice(x);
                    jacobians.set(jacobians.get() + 1);
                    if equations.borrow_mut().jacobian(t, x, &mut kept.matrix).is_err() {
                        kept.matrix.fill(f64::NAN);
                    }
                }
                y.fill(0.0);
                for (column, v) in kept.matrix.chunks_exact(n).zip(v) {
                    if *v != 0.0 {
                        for (y, entry) in y.iter_mut().zip(column) {
                            *y += entry * v;
                        }
                    }
                }
            },
        )
        .init(|_: &[f64], _: f64, x: &mut [f64]| x.copy_from_slice(&start), n)
        .build()
        .map_err(|error| error.to_string())?;
    built.ode_options.max_nonlinear_solver_failures = usize::MAX;
    built.ode_options.max_error_test_failures = usize::MAX;
    if fresh {
        built.ode_options.update_jacobian_after_steps = 1;
        built.ode_options.update_rhs_jacobian_after_steps = 1;
    }
    let each = Each {
        problem: &problem,
        rows,
        limit,
        stopwatch,
    };
    type Lu = NalgebraLU<f64>;
    match method {
        Method::Bdf => each.drive(built.bdf::<Lu>(), &mut outcome, &mut states),
        Method::TrBdf2 => each.drive(built.tr_bdf2::<Lu>(), &mut outcome, &mut states),
        Method::Esdirk34 => each.drive(built.esdirk34::<Lu>(), &mut outcome, &mut states),
    }
    outcome.cpu = stopwatch.cpu();
    outcome.wall = stopwatch.wall();
    outcome.derivatives = derivatives.get();
    outcome.jacobians = jacobians.get();
    Ok((outcome, states))
}

/// The settings of a run for a solver.
struct Each<'r> {
    problem: &'r RaceProblem,
    rows: usize,
    limit: f64,
    stopwatch: Stopwatch,
}

impl Each<'_> {
    /// Steps to the end, and takes the rows on the way.
    fn drive<'a, E, S>(&self, solver: Result<S, DiffsolError>, outcome: &mut Outcome, states: &mut Vec<f64>)
    where
        E: OdeEquationsImplicit<T = f64, V = NalgebraVec<f64>> + 'a,
        S: OdeSolverMethod<'a, E>,
    {
        outcome.rows = 1;
        let mut solver = match solver {
            Ok(solver) => solver,
            Err(error) => {
                outcome.failure = error.to_string();
                return;
            }
        };
        let end = self.problem.time(self.rows - 1);
        if let Err(error) = solver.set_stop_time(end) {
            outcome.failure = error.to_string();
            return;
        }
        let mut count = 0_u32;
        loop {
            let reason = match solver.step() {
                Ok(reason) => reason,
                Err(error) => {
                    outcome.failure = format!("{error} at t = {:.4} s", solver.state().t);
                    break;
                }
            };
            let done = matches!(reason, OdeSolverStopReason::TstopReached);
            let time = solver.state().t;
            while outcome.rows < self.rows && (done || self.problem.time(outcome.rows) <= time) {
                match solver.interpolate(self.problem.time(outcome.rows).min(time)) {
                    Ok(state) => states.extend(state.clone_as_vec()),
                    Err(error) => {
                        outcome.failure = error.to_string();
                        return;
                    }
                }
                outcome.rows += 1;
            }
            if done {
                break;
            }
            count += 1;
            if count.is_multiple_of(1024) && self.stopwatch.cpu() > self.limit {
                outcome.failure = format!("out of time at t = {time:.3} s");
                break;
            }
        }
        let statistics = solver.get_statistics();
        outcome.steps = statistics.number_of_steps as u64;
        outcome.rejected =
            (statistics.number_of_error_test_failures + statistics.number_of_nonlinear_solver_fails) as u64;
        outcome.factorizations = statistics.number_of_linear_solver_setups as u64;
    }
}
