//! The method that damps fast vibrations: its coefficients, what it keeps and what it damps, friction that reverses, and what it
//! cannot solve.

#![allow(clippy::unwrap_used)] // it may stop where it stands

mod common;

use common::run;
use integrate::{Integrator, Method, Options, Ordinary, Reason, SetupError, State};

fn options(tolerance: f64) -> Options {
    Options {
        method: Method::TrBdf2,
        relative_tolerance: tolerance,
        ..Options::default()
    }
}

/// Both stages integrate a linear slope exactly, and the estimate is the error of a quadratic one.
#[test]
fn convergence_coefficients_fulfil_their_conditions() {
    let tableau = Method::TrBdf2.tableau();
    let (alpha, gamma) = (tableau.alpha, tableau.gamma);
    let sum = |weights: &[f64], power: i32| -> f64 {
        weights
            .iter()
            .zip(alpha)
            .map(|(weight, alpha)| weight * alpha.powi(power))
            .sum()
    };
    for (row, alpha) in tableau.a.iter().zip(alpha).skip(1).take(2) {
        for power in 0..2 {
            let found = sum(row, power) + gamma * alpha.powi(power);
            let exact = alpha.powi(power + 1) / f64::from(power + 1);
            assert!((found - exact).abs() < 1e-15, "{found}, {exact}");
        }
    }
    let estimate = tableau.a[3];
    assert!(sum(estimate, 0).abs() < 1e-15 && sum(estimate, 1).abs() < 1e-15);
    let missing = 1.0 / 3.0 - sum(tableau.a[2], 2) - gamma;
    assert!((sum(estimate, 2) - missing).abs() < 1e-15, "{missing}");
    // The dense output goes through the stage between the ends.
    let theta = alpha[1];
    let bend = |stage: usize| theta * (1.0 - theta) * tableau.dense[0][stage];
    // x(ϑ) = x0 + ϑ (x1 - x0) + bend, and the stage is x0 + γ (U_0 + U_1).
    for (stage, (end, middle)) in [(tableau.a[2][0], gamma), (tableau.a[2][1], gamma), (gamma, 0.0)]
        .into_iter()
        .enumerate()
    {
        assert!(
            (theta * end + bend(stage) - middle).abs() < 1e-15,
            "stage {stage}"
        );
    }
}

/// A mass on a stiff spring whose support moves as sin t: x'' = -ω² (x - sin t).
fn carried(omega: f64) -> Ordinary<'static> {
    Ordinary::new(
        vec![1.0, 1.0],
        move |t, x, dx| {
            dx[0] = x[1];
            dx[1] = -omega * omega * (x[0] - libm::sin(t));
        },
        move |_, _, j| j.copy_from_slice(&[0.0, 1.0, -omega * omega, 0.0]),
    )
    .time_derivative(move |t, _, f| f[1] = omega * omega * libm::cos(t))
}

/// What a stiff spring holds follows its support with order 2, its speed as well, though that is the derivative of what is held.
#[test]
fn convergence_the_speed_of_what_is_held_keeps_its_order() {
    let errors = [64, 128].map(|steps| {
        let options = Options {
            fixed_step: Some(1.0 / f64::from(steps)),
            ..options(1e-6)
        };
        let (x, _) = run(carried(1e6), options, &[0.0, 1.0], 1.0);
        [(x[0] - libm::sin(1.0)).abs(), (x[1] - libm::cos(1.0)).abs()]
    });
    let order = libm::log2(errors[0][1] / errors[1][1]);
    println!("errors {errors:?}, order of the speed {order:.2}");
    assert!(errors[1][0] < 1e-9, "{errors:?}");
    assert!((order - 2.0).abs() < 0.1, "{order}");
}

/// A vibration of 160 Hz under the tolerance is gone after a second of long steps; the slow motion is there.
#[test]
fn limits_a_fast_vibration_is_damped_and_the_motion_is_kept() {
    let (x, statistics) = run(carried(1000.0).displacements(1), options(1e-4), &[5e-5, 1.0], 1.0);
    let exact = libm::sin(1.0) / (1.0 - 1e-6);
    println!("{statistics:?}");
    assert!((x[0] - exact).abs() < 1e-6, "{x:?}");
    assert!((x[1] - libm::cos(1.0)).abs() < 1e-3, "{x:?}");
    // It would take 160 periods of some twenty steps each to follow it.
    assert!(statistics.steps < 200, "{statistics:?}");
}

/// A mass of 1 kg slides at 1 m/s under friction of 10 N, a force of 5 N pulls it on: it stops after 0.1 m and creeps.
#[test]
fn analytic_a_sliding_mass_stops_and_sticks() {
    const REFERENCE: f64 = 1e-5;
    let problem = Ordinary::new(
        vec![1.0, 1.0],
        |_, x, dx| {
            dx[0] = x[1];
            dx[1] = 5.0 - 10.0 * libm::tanh(x[1] / REFERENCE);
        },
        |_, x, j| {
            let cosh = libm::cosh(x[1] / REFERENCE);
            j.copy_from_slice(&[0.0, 1.0, 0.0, -10.0 / (REFERENCE * cosh * cosh)]);
        },
    );
    let (x, statistics) = run(problem, options(1e-6), &[0.0, 1.0], 1.0);
    let creeps = REFERENCE * libm::atanh(0.5);
    assert!((x[0] - (0.1 + 0.8 * creeps)).abs() < 1e-5, "{x:?}");
    assert!((x[1] / creeps - 1.0).abs() < 1e-6, "{x:?}, {creeps}");
    println!("{statistics:?}");
    let attempts = statistics.steps + statistics.rejected();
    assert!(
        attempts < 80 && statistics.rejected_unsolved == 0,
        "{statistics:?}"
    );
}

/// A slope that points back to zero from both sides.
fn points_back(speed: f64) -> Ordinary<'static> {
    let slope = move |x: f64| if x > 0.0 { -speed } else { speed };
    Ordinary::new(
        vec![1.0],
        move |_, x, dx| dx[0] = slope(x[0]),
        |_, _, j| j[0] = 0.0,
    )
}

/// A slope that jumps has no solution where it points back from both sides. Within the tolerance the state rests there.
#[test]
fn limits_what_points_back_from_both_sides_rests() {
    let (x, _) = run(points_back(1.0), options(1e-3), &[0.5], 1.0);
    assert!(x[0].abs() < 1e-3, "{x:?}");
}

/// Where steps may not be as short as that takes, the message says so.
#[test]
fn input_stages_without_solution_are_reported() {
    let options = Options {
        minimum_step: 1e-6,
        ..options(1e-3)
    };
    let mut integrator = Integrator::new(points_back(1e3), options, 0.0, &[0.5]).unwrap();
    let error = loop {
        match integrator.step_to(1.0) {
            Ok(()) => assert!(integrator.time() < 1e-3, "there is no solution beyond 0.5 ms"),
            Err(error) => break error,
        }
    };
    assert_eq!(error.reason, Reason::Unsolved);
    assert!((error.time - 5e-4).abs() < 1e-5, "{error}");
    assert!(
        error.to_string().contains("could not be solved: look for a jump"),
        "{error}"
    );
    assert!(integrator.statistics().rejected_unsolved > 2);
}

/// A saved run has the slope with which its last step ended. One that cannot be is refused.
#[test]
fn input_a_damaged_slope_is_refused() {
    let mut integrator = Integrator::new(carried(100.0), options(1e-4), 0.0, &[0.0, 1.0]).unwrap();
    integrator.step_to(1.0).unwrap();
    let saved = serde_json::to_value(integrator.state()).unwrap();
    let resume = |slope: Vec<f64>| {
        let mut damaged = saved.clone();
        damaged["slope"] = slope.into();
        let state: State = serde_json::from_value(damaged).unwrap();
        Integrator::resume(carried(100.0), options(1e-4), state).map(|_| ())
    };
    let slopes = SetupError::Dimension {
        what: "slopes",
        expected: 2,
        found: 1,
    };
    assert_eq!(resume(vec![1.0]), Err(slopes));
    assert!(resume(integrator.derivative().to_vec()).is_ok());
}
