//! The ESDIRK methods: their coefficients, vibrations that they damp, friction that reverses, the Jacobian
//! cache and the stage predictor, and stages without solution.

use crate::common;
use common::problems::{stick_slip, stick_slip_with_discontinuities};
use common::run;
use integrate::{FunctionProblem, Integrator, Method, Options, Reason, SetupError, State};

const ESDIRK: [Method; 2] = [Method::TrBdf2, Method::Esdirk3];

fn options_of(method: Method, tolerance: f64) -> Options {
    Options {
        method,
        relative_tolerance: tolerance,
        ..Options::default()
    }
}

fn options(tolerance: f64) -> Options {
    options_of(Method::TrBdf2, tolerance)
}

/// TR-BDF2: both stages integrate linear functions exactly; the estimate is the error for quadratic ones.
#[test]
fn convergence_coefficients_of_tr_bdf2_fulfil_their_conditions() {
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

/// ESDIRK3: conditions of order 3, of stage order 2, and of the embedded solution; the dense output passes
/// through its stages.
#[test]
fn convergence_coefficients_of_esdirk3_fulfil_their_conditions() {
    let tableau = Method::Esdirk3.tableau();
    let (alpha, count) = (tableau.alpha, 5);
    let near = |found: f64, exact: f64, what: &str| {
        assert!((found - exact).abs() < 1e-14, "{what}: {found}, {exact}")
    };
    // Rows with their diagonals.
    let rows: Vec<Vec<f64>> = (0..count)
        .map(|i| {
            let diagonal = if i == 0 { 0.0 } else { tableau.gamma };
            let mut row = [tableau.a[i], &[diagonal]].concat();
            row.resize(count, 0.0);
            row
        })
        .collect();
    let sum = |weights: &[f64], values: &dyn Fn(usize) -> f64| -> f64 {
        weights
            .iter()
            .enumerate()
            .map(|(j, weight)| weight * values(j))
            .sum()
    };
    for (i, row) in rows.iter().enumerate().skip(1) {
        near(sum(row, &|_| 1.0), alpha[i], "a stage of order 1");
        near(
            sum(row, &|j| alpha[j]),
            alpha[i] * alpha[i] / 2.0,
            "a stage of order 2",
        );
    }
    let last = &rows[count - 1];
    let tall = |j: usize| sum(&rows[j], &|k| alpha[k]);
    near(sum(last, &|j| alpha[j] * alpha[j]), 1.0 / 3.0, "order 3");
    near(sum(last, &tall), 1.0 / 6.0, "order 3 of what is solved twice");
    let estimate = tableau.a[count];
    near(sum(estimate, &|_| 1.0), 0.0, "the estimate of a line");
    near(sum(estimate, &|j| alpha[j]), 0.0, "the estimate of a parabola");
    assert!(sum(estimate, &|j| alpha[j] * alpha[j]).abs() > 1e-3);
    for i in [1, 2] {
        let theta = alpha[i];
        for j in 0..count {
            let bend = tableau.dense[0][j] + theta * tableau.dense[1][j];
            near(
                theta * last[j] + theta * (1.0 - theta) * bend,
                rows[i][j],
                "dense output",
            );
        }
    }
}

/// Returns a mass on a stiff spring whose support moves as sin t: x'' = -ω² (x - sin t).
fn carried(omega: f64) -> FunctionProblem<'static> {
    FunctionProblem::new(
        vec![1.0, 1.0],
        move |t, x, dx| {
            dx[0] = x[1];
            dx[1] = -omega * omega * (x[0] - libm::sin(t));
        },
        move |_, _, j| j.copy_from_slice(&[0.0, 1.0, -omega * omega, 0.0]),
    )
    .time_derivative(move |t, _, f| f[1] = omega * omega * libm::cos(t))
}

/// A mass on a stiff spring follows its support; its speed, the derivative of a constrained coordinate, keeps
/// the order of the stages.
#[test]
fn convergence_the_speed_on_a_stiff_spring_keeps_its_order() {
    for method in ESDIRK {
        let errors = [64, 128].map(|steps| {
            let options = Options {
                fixed_step: Some(1.0 / f64::from(steps)),
                ..options_of(method, 1e-6)
            };
            let (x, _) = run(carried(1e6), options, &[0.0, 1.0], 1.0);
            [(x[0] - libm::sin(1.0)).abs(), (x[1] - libm::cos(1.0)).abs()]
        });
        let order = libm::log2(errors[0][1] / errors[1][1]);
        println!("{method}: errors {errors:?}, order of the speed {order:.2}");
        assert!(errors[1][0] < 1e-9, "{method}: {errors:?}");
        assert!((order - 2.0).abs() < 0.1, "{method}: {order}");
    }
}

/// A vibration of 160 Hz under the tolerance is gone after a second of long steps; the slow motion is there.
#[test]
fn limits_a_fast_vibration_is_damped_and_the_motion_is_kept() {
    for method in ESDIRK {
        let options = Options {
            maximum_step: 0.1,
            ..options_of(method, 1e-4)
        };
        let (x, statistics) = run(carried(1000.0).displacements(1), options, &[5e-5, 1.0], 1.0);
        let exact = libm::sin(1.0) / (1.0 - 1e-6);
        println!("{method}: {statistics:?}");
        assert!((x[0] - exact).abs() < 1e-6, "{method}: {x:?}");
        assert!((x[1] - libm::cos(1.0)).abs() < 1e-3, "{method}: {x:?}");
        // It would take 160 periods of some twenty steps each to follow it.
        assert!(statistics.steps < 200, "{method}: {statistics:?}");
    }
}

/// A mass of 1 kg slides at 1 m/s under friction of 10 N, a force of 5 N pulls it on: it stops after 0.1 m
/// and creeps.
#[test]
fn analytic_a_sliding_mass_stops_and_sticks() {
    const REFERENCE: f64 = 1e-5;
    for method in ESDIRK {
        let problem = FunctionProblem::new(
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
        let (x, statistics) = run(problem, options_of(method, 1e-6), &[0.0, 1.0], 1.0);
        let creeps = REFERENCE * libm::atanh(0.5);
        assert!((x[0] - (0.1 + 0.8 * creeps)).abs() < 1e-5, "{method}: {x:?}");
        assert!((x[1] / creeps - 1.0).abs() < 1e-6, "{method}: {x:?}, {creeps}");
        println!("{method}: {statistics:?}");
        let attempts = statistics.steps + statistics.rejected();
        assert!(
            attempts < 80 && statistics.rejected_newton == 0,
            "{method}: {statistics:?}"
        );
    }
}

/// If the problem tells its slips, Newton's method uses its matrix again in the same contact state:
/// the same motion for fewer matrices.
#[test]
fn convergence_a_reused_matrix_changes_nothing_but_the_cost() {
    let reference = Options {
        relative_tolerance: 1e-10,
        ..Options::default()
    };
    let (exact, _) = run(stick_slip(), reference, &[0.0, 0.0], 4.0);
    for method in ESDIRK {
        let options = Options {
            maximum_step: 0.01,
            ..options_of(method, 1e-7)
        };
        let [alone, reused] = [stick_slip, stick_slip_with_discontinuities]
            .map(|make| run(make(), options.clone(), &[0.0, 0.0], 4.0));
        println!("{method}: {:?}\n{:?}", alone.1, reused.1);
        for (x, _) in [&alone, &reused] {
            assert!((x[0] - exact[0]).abs() < 2e-5, "{method}: {x:?}, {exact:?}");
            assert!((x[1] - exact[1]).abs() < 1e-3, "{method}: {x:?}, {exact:?}");
        }
        assert!(4 * reused.1.jacobians < 3 * alone.1.jacobians, "{method}");
        // Where a matrix costs as much as four right-hand sides, as for half-trucks (trucks: eight).
        let [one, other] = [&reused.1, &alone.1].map(|s| s.derivatives + 4 * s.jacobians);
        assert!(one < other, "{method}: {one}, {other}");
    }
}

/// A resumed run has the Jacobian matrix of the saved one.
#[test]
fn reproducible_a_resumed_run_has_the_cached_matrix() {
    for method in ESDIRK {
        let options = options_of(method, 1e-6);
        let mut whole = Integrator::new(
            stick_slip_with_discontinuities(),
            options.clone(),
            0.0,
            &[0.0, 0.0],
        )
        .unwrap();
        let mut parts = Integrator::new(
            stick_slip_with_discontinuities(),
            options.clone(),
            0.0,
            &[0.0, 0.0],
        )
        .unwrap();
        let mut kept = 0;
        while whole.time() < 2.0 {
            whole.step_to(2.0).unwrap();
            let jacobians = parts.statistics().jacobians;
            let text = serde_json::to_string(&parts.state()).unwrap();
            let state: State = serde_json::from_str(&text).unwrap();
            if whole.statistics().steps.is_multiple_of(2) {
                parts =
                    Integrator::resume(stick_slip_with_discontinuities(), options.clone(), state).unwrap();
            } else {
                parts.restore(&state).unwrap();
            }
            parts.step_to(2.0).unwrap();
            kept += u32::from(parts.statistics().jacobians == jacobians);
            assert_eq!(whole.state(), parts.state(), "{method}");
        }
        assert!(kept > 50, "{method}: {kept}");
    }
}

/// Only the ends of their steps are in equilibrium with friction: output times limit steps.
#[test]
fn limits_output_times_end_the_steps_of_esdirk_methods() {
    for method in Method::ALL {
        let integrator = Integrator::new(carried(100.0), options_of(method, 1e-4), 0.0, &[0.0, 1.0]).unwrap();
        let limit = integrator.step_limit(0.5, 2.0);
        assert_eq!(limit, if ESDIRK.contains(&method) { 0.5 } else { 2.0 });
        assert_eq!(integrator.step_limit(3.0, 2.0), 2.0);
    }
}

/// Returns a right-hand side that points back to zero from both sides.
fn points_back(speed: f64) -> FunctionProblem<'static> {
    let slope = move |x: f64| if x > 0.0 { -speed } else { speed };
    FunctionProblem::new(
        vec![1.0],
        move |_, x, dx| dx[0] = slope(x[0]),
        |_, _, j| j[0] = 0.0,
    )
}

/// Where the right-hand side points back from both sides there is no classical solution (a sliding mode,
/// Filippov). The state rests there within the tolerance.
#[test]
fn limits_a_sliding_mode_rests_within_the_tolerance() {
    let (x, _) = run(points_back(1.0), options(1e-3), &[0.5], 1.0);
    assert!(x[0].abs() < 1e-3, "{x:?}");
}

/// If steps may not be short enough for that, the error says so.
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
    assert_eq!(error.reason, Reason::NewtonFailure);
    assert!((error.time - 5e-4).abs() < 1e-5, "{error}");
    assert!(
        error.to_string().contains("could not be solved: look for a jump"),
        "{error}"
    );
    assert!(integrator.statistics().rejected_newton > 2);
}

/// A saved state has the last stage derivative, the linearization point and the last step; impossible ones
/// are refused.
#[test]
fn input_a_damaged_stage_derivative_or_matrix_is_refused() {
    let mut integrator = Integrator::new(carried(100.0), options(1e-4), 0.0, &[0.0, 1.0]).unwrap();
    integrator.step_to(1.0).unwrap();
    let saved = serde_json::to_value(integrator.state()).unwrap();
    let resume = |key: &str, value: serde_json::Value| {
        let mut damaged = saved.clone();
        damaged[key] = value;
        let state: State = serde_json::from_value(damaged).unwrap();
        Integrator::resume(carried(100.0), options(1e-4), state).map(|_| ())
    };
    let slopes = SetupError::Dimension {
        what: "stage derivatives",
        expected: 2,
        found: 1,
    };
    assert_eq!(resume("last_stage_derivative", vec![1.0].into()), Err(slopes));
    let places = SetupError::Dimension {
        what: "states of the matrix",
        expected: 2,
        found: 1,
    };
    assert_eq!(
        resume(
            "linearization_point",
            serde_json::json!({ "time": 0.1, "x": [1.0], "shift": 0.0 })
        ),
        Err(places)
    );
    let early = SetupError::Damaged {
        name: "linearization_point",
        value: -1.0,
    };
    assert_eq!(
        resume(
            "linearization_point",
            serde_json::json!({ "time": -1.0, "x": [1.0, 1.0], "shift": 0.0 })
        ),
        Err(early)
    );
    assert_eq!(resume("linearization_point", serde_json::Value::Null), Ok(()));
    assert!(resume("last_stage_derivative", integrator.derivative().to_vec().into()).is_ok());
}
