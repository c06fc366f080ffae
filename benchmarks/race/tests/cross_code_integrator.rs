//! The integrator agrees with an independent code (diffsol) on standard test problems of stiff equations and
//! on one with a contact.
#![allow(missing_docs, clippy::unwrap_used)]

#[path = "../../../crates/integrate/tests/common/mod.rs"]
mod common;

use common::problems::{MU, robertson, van_der_pol};
use common::tolerance;
use diffsol::{
    NalgebraLU, NalgebraMat, OdeBuilder, OdeEquationsImplicit, OdeSolverMethod, OdeSolverProblem,
    OdeSolverStopReason, Vector,
};
use integrate::{FunctionProblem, Integrator, Method, Options};

type Matrix = NalgebraMat<f64>;

/// Returns the states of the independent code at `times`.
fn reference<E>(problem: &OdeSolverProblem<E>, times: &[f64]) -> Vec<Vec<f64>>
where
    E: OdeEquationsImplicit<M = Matrix, V = diffsol::NalgebraVec<f64>, T = f64, C = diffsol::NalgebraContext>,
{
    let mut solver = problem.tr_bdf2::<NalgebraLU<f64>>().unwrap();
    times
        .iter()
        .map(|&time| {
            solver.set_stop_time(time).unwrap();
            while !matches!(solver.step().unwrap(), OdeSolverStopReason::TstopReached) {}
            solver.state().y.clone_as_vec()
        })
        .collect()
}

/// Returns our states at `times`.
fn states_at(problem: FunctionProblem<'_>, options: Options, x: &[f64], times: &[f64]) -> Vec<Vec<f64>> {
    let mut integrator = Integrator::new(problem, options, 0.0, x).unwrap();
    let values = times
        .iter()
        .map(|&time| {
            while integrator.time() < time {
                integrator.step_to(time).unwrap();
            }
            integrator.x().to_vec()
        })
        .collect();
    println!("{:?}", integrator.statistics());
    values
}

#[test]
fn robertson_agrees_with_an_independent_code() {
    let times = [0.4, 40.0, 4e3, 4e5];
    let problem = OdeBuilder::<Matrix>::new()
        .rtol(1e-9)
        .atol([1e-11, 1e-15, 1e-11])
        .rhs_implicit(
            |x: &[f64], _: &[f64], _: f64, y: &mut [f64]| {
                y[0] = -0.04 * x[0] + 1e4 * x[1] * x[2];
                y[2] = 3e7 * x[1] * x[1];
                y[1] = -y[0] - y[2];
            },
            |x: &[f64], _: &[f64], _: f64, v: &[f64], y: &mut [f64]| {
                y[0] = -0.04 * v[0] + 1e4 * (v[1] * x[2] + x[1] * v[2]);
                y[2] = 6e7 * x[1] * v[1];
                y[1] = -y[0] - y[2];
            },
        )
        .init(
            |_: &[f64], _: f64, y: &mut [f64]| y.copy_from_slice(&[1.0, 0.0, 0.0]),
            3,
        )
        .build()
        .unwrap();
    let independent = reference(&problem, &times);
    for method in Method::ALL {
        let options = Options {
            method,
            relative_tolerance: tolerance(method, 1e-9),
            ..Options::default()
        };
        let found = states_at(robertson(), options, &[1.0, 0.0, 0.0], &times);
        for ((time, found), independent) in times.iter().zip(&found).zip(&independent) {
            for ((a, b), scale) in found.iter().zip(independent).zip([1.0, 1e-4, 1.0]) {
                assert!(
                    (a - b).abs() < 1e-7 * scale,
                    "{method} at {time}: {found:?}, {independent:?}"
                );
            }
        }
    }
}

#[test]
fn van_der_pol_agrees_with_an_independent_code() {
    let times = [500.0, 1000.0, 2000.0];
    let problem = OdeBuilder::<Matrix>::new()
        .rtol(1e-10)
        .atol([1e-11, 1e-11])
        .rhs_implicit(
            |x: &[f64], _: &[f64], _: f64, y: &mut [f64]| {
                y[0] = x[1];
                y[1] = MU * (1.0 - x[0] * x[0]) * x[1] - x[0];
            },
            |x: &[f64], _: &[f64], _: f64, v: &[f64], y: &mut [f64]| {
                y[0] = v[1];
                y[1] = (-2.0 * MU * x[0] * x[1] - 1.0) * v[0] + MU * (1.0 - x[0] * x[0]) * v[1];
            },
        )
        .init(
            |_: &[f64], _: f64, y: &mut [f64]| y.copy_from_slice(&[2.0, 0.0]),
            2,
        )
        .build()
        .unwrap();
    let independent = reference(&problem, &times);
    for method in Method::ALL {
        let options = Options {
            method,
            relative_tolerance: 1e-10,
            ..Options::default()
        };
        let found = states_at(van_der_pol(), options, &[2.0, 0.0], &times);
        for ((time, found), independent) in times.iter().zip(&found).zip(&independent) {
            assert!(
                (found[0] - independent[0]).abs() < 2e-6,
                "{method} at {time}: {found:?}, {independent:?}"
            );
        }
    }
}

const GRAVITY: f64 = 386.0886;
/// Angular frequency of the mass on the spring (140 Hz).
const OMEGA: f64 = 879.645_943_005_142_4;

#[test]
fn a_bouncing_mass_with_loss_agrees_with_an_independent_code() {
    // A damper only where the spring presses: the force is continuous, its derivative jumps.
    const DAMPING: f64 = 0.05;
    fn speed_up(x: &[f64]) -> f64 {
        -GRAVITY + OMEGA * OMEGA * (-x[0]).max(0.0) * (1.0 - DAMPING * x[1])
    }
    fn slopes(x: &[f64]) -> [f64; 2] {
        if x[0] < 0.0 {
            [
                -OMEGA * OMEGA * (1.0 - DAMPING * x[1]),
                OMEGA * OMEGA * x[0] * DAMPING,
            ]
        } else {
            [0.0, 0.0]
        }
    }
    let times = [0.04, 0.06, 0.1, 0.2, 0.3];
    let mut problem = OdeBuilder::<Matrix>::new()
        .rtol(1e-9)
        .atol([1e-11, 1e-8])
        .rhs_implicit(
            |x: &[f64], _: &[f64], _: f64, y: &mut [f64]| {
                y[0] = x[1];
                y[1] = speed_up(x);
            },
            |x: &[f64], _: &[f64], _: f64, v: &[f64], y: &mut [f64]| {
                let slopes = slopes(x);
                y[0] = v[1];
                y[1] = slopes[0] * v[0] + slopes[1] * v[1];
            },
        )
        .init(
            |_: &[f64], _: f64, y: &mut [f64]| y.copy_from_slice(&[0.5, 0.0]),
            2,
        )
        .build()
        .unwrap();
    // It has trouble at discontinuities.
    problem.ode_options.max_nonlinear_solver_failures = 100_000;
    problem.ode_options.max_error_test_failures = 1000;
    let independent = reference(&problem, &times);
    for method in Method::ALL {
        let mine = FunctionProblem::new(
            vec![1.0, OMEGA * 0.01],
            |_, x, dx| {
                dx[0] = x[1];
                dx[1] = speed_up(x);
            },
            |_, x, j| {
                let slopes = slopes(x);
                j.copy_from_slice(&[0.0, 1.0, slopes[0], slopes[1]]);
            },
        );
        let options = Options {
            method,
            relative_tolerance: tolerance(method, 1e-8),
            ..Options::default()
        };
        let found = states_at(mine, options, &[0.5, 0.0], &times);
        for ((time, found), independent) in times.iter().zip(&found).zip(&independent) {
            assert!(
                (found[0] - independent[0]).abs() < 2e-6,
                "{method} at {time}: {found:?}, {independent:?}"
            );
        }
    }
}
