//! analytic: predicted discontinuities. Steps end after them instead of being rejected across them; the
//! results stay the same.

use crate::common;
use common::problems::{BouncingBall, shaken, shaken_with_bound, shaken_with_slip};
use common::run;
use integrate::{Family, FunctionProblem, Integrator, Method, Options, Statistics};

/// Meters.
const BALL: BouncingBall = BouncingBall {
    gravity: 9.81,
    omega: 500.0,
    height: 0.5,
};

fn options(method: Method, relative_tolerance: f64) -> Options {
    Options {
        method,
        relative_tolerance,
        ..Options::default()
    }
}

#[test]
fn a_predicted_contact_costs_fewer_attempts_and_the_motion_is_the_same() {
    // In the middle of the sixth flight: the height follows from the energy.
    let ((fall, _), (contact, flight)) = (BALL.fall(), BALL.contact_and_flight());
    let end = fall + 6.0 * (contact + flight) - fall;
    for method in Method::ALL {
        if method.tableau().family != Family::LinearlyImplicit {
            continue; // it goes across
        }
        let (x, plain) = run(BALL.problem(), options(method, 1e-8), &[0.5, 0.0], end);
        let predicted = BALL
            .problem()
            .discontinuities(1, 0, |_, x, functions| functions.values[0] = x[0]);
        let (y, predicted) = run(predicted, options(method, 1e-8), &[0.5, 0.0], end);
        for state in [&x, &y] {
            assert!(
                (state[0] - 0.5).abs() < 1e-4 && state[1].abs() < 3e-3,
                "{method}: {state:?}"
            );
        }
        assert!(
            predicted.discontinuities_predicted >= 12,
            "{method}: {predicted:?}"
        );
        let attempts = |statistics: &Statistics| statistics.steps + statistics.rejected();
        println!(
            "{method}: {} attempts instead of {}",
            attempts(&predicted),
            attempts(&plain)
        );
        assert!(
            10 * attempts(&predicted) < 9 * attempts(&plain),
            "{method}: {predicted:?} instead of {plain:?}"
        );
    }
}

#[test]
fn slip_reversals_are_predicted() {
    let (exact, _) = run(shaken(), options(Method::Rodas5P, 1e-10), &[0.0, 0.0], 8.0);
    let (x, plain) = run(shaken(), options(Method::Rodas5P, 1e-6), &[0.0, 0.0], 8.0);
    let (y, predicted) = run(
        shaken_with_slip(),
        options(Method::Rodas5P, 1e-6),
        &[0.0, 0.0],
        8.0,
    );
    for state in [&x, &y] {
        for (value, exact) in state.iter().zip(&exact) {
            assert!((value - exact).abs() < 1e-4, "{state:?} {exact:?}");
        }
    }
    // It reverses 12 times.
    assert!(predicted.discontinuities_predicted >= 12, "{predicted:?}");
    assert!(
        predicted.rejected() + predicted.steps < plain.rejected() + plain.steps,
        "{predicted:?} instead of {plain:?}"
    );
}

#[test]
fn bounds_apply_in_zones_and_widen_outside() {
    let attempts = |statistics: &Statistics| statistics.steps + statistics.rejected();
    let (exact, _) = run(shaken(), options(Method::Rodas5P, 1e-10), &[0.0, 0.0], 8.0);
    // As exact everywhere as a zone needs.
    let (_, tight) = run(
        shaken_with_slip(),
        options(Method::Rodas5P, 1e-5),
        &[0.0, 0.0],
        8.0,
    );
    for tolerance in [1e-3, 1e-4] {
        let (x, wide) = run(
            shaken_with_bound(),
            options(Method::Rodas5P, tolerance),
            &[0.0, 0.0],
            8.0,
        );
        println!(
            "{tolerance}: {} attempts, {} with a tight tolerance everywhere",
            attempts(&wide),
            attempts(&tight)
        );
        for (value, exact) in x.iter().zip(&exact) {
            assert!((value - exact).abs() < 0.01 * exact, "{tolerance}: {x:?}");
        }
        assert!(
            attempts(&wide) < attempts(&tight),
            "{tolerance}: {wide:?} {tight:?}"
        );
    }
}

#[test]
fn zone_bounds_widen_with_the_smallest_slip() {
    // A circle; two directions of constant size, which have nothing to do with it.
    let steps = |sizes: [f64; 2]| {
        let circle = FunctionProblem::new(
            vec![1.0; 2],
            |_, x, dx| dx.copy_from_slice(&[-x[1], x[0]]),
            |_, _, j| j.copy_from_slice(&[0.0, -1.0, 1.0, 0.0]),
        )
        .discontinuities(0, 2, move |_, _, functions| {
            functions.slips.copy_from_slice(&sizes.map(|size| [size, 0.0]))
        })
        .zone_error_bounds(vec![1e-8; 2]);
        run(circle, options(Method::Rodas5P, 1e-4), &[1.0, 0.0], 20.0)
            .1
            .steps
    };
    let none = steps([f64::NAN; 2]);
    assert_eq!(steps([1e6, 2e6]), none);
    let in_zone = steps([1e6, 0.0]);
    assert_eq!(steps([20.0, f64::NAN]), in_zone);
    // Errors of order 5 in the step: 1e4 times the error makes 6.3 times the steps. A slip of 2000: a hundred
    // times the bound.
    assert!(in_zone > 5 * none, "{in_zone} {none}");
    let between = steps([2000.0, 1e6]);
    assert!(
        2 * none < between && 2 * between < in_zone,
        "{in_zone} {between} {none}"
    );
}

#[test]
fn a_slip_that_only_turns_is_no_discontinuity() {
    // x turns in a circle of radius 1000: its components change their sign, but it never comes near zero.
    let circle = FunctionProblem::new(
        vec![1.0; 2],
        |_, x, dx| dx.copy_from_slice(&[-3.0 * x[1], 3.0 * x[0]]),
        |_, _, j| j.copy_from_slice(&[0.0, -3.0, 3.0, 0.0]),
    )
    .discontinuities(0, 1, |_, x, functions| functions.slips[0] = [x[0], x[1]]);
    let (_, statistics) = run(circle, options(Method::Rodas5P, 1e-4), &[1000.0, 0.0], 10.0);
    assert_eq!(statistics.discontinuities_predicted, 0);
}

#[test]
fn a_saved_state_continues_with_the_same_bits_also_before_a_discontinuity() {
    let options = options(Method::Rodas5P, 1e-3);
    let mut whole = Integrator::new(shaken_with_bound(), options.clone(), 0.0, &[0.0, 0.0]).unwrap();
    let mut resumed = 0;
    while whole.time() < 3.0 {
        let text = serde_json::to_string(&whole.state()).unwrap();
        whole.step_to(3.0).unwrap();
        let state = serde_json::from_str(&text).unwrap();
        let mut again = Integrator::resume(shaken_with_bound(), options.clone(), state).unwrap();
        again.step_to(3.0).unwrap();
        assert_eq!(again.state(), whole.state());
        resumed += 1;
    }
    assert!(resumed > 40 && whole.statistics().discontinuities_predicted > 2);
}

/// Returns the largest error of a single step, in tolerances: each is made again at a tolerance of 1e-12.
fn worst_step(problem: fn() -> FunctionProblem<'static>, tolerance: f64) -> (f64, u64) {
    let options = |tolerance| options(Method::Rodas5P, tolerance);
    let mut integrator = Integrator::new(problem(), options(tolerance), 0.0, &[0.0, 0.0]).unwrap();
    let mut worst = 0.0_f64;
    while integrator.time() < 4.0 {
        let (time, x) = (integrator.time(), integrator.x().to_vec());
        integrator.step_to(4.0).unwrap();
        let fine = Options {
            initial_step: Some(1e-3 * (integrator.time() - time)),
            ..options(1e-12)
        };
        let mut again = Integrator::new(shaken(), fine, time, &x).unwrap();
        while again.time() < integrator.time() {
            again.step_to(integrator.time()).unwrap();
        }
        worst = worst.max((integrator.x()[0] - again.x()[0]).abs() / tolerance);
    }
    (worst, integrator.statistics().steps)
}

/// Stick-to-slip transition: the Jacobian matrix of the start knows only the sticking friction, and the error
/// estimate is damped with it.
#[test]
fn issue_007_behaviour_a_step_from_stick_to_slip_is_as_exact_as_others() {
    let (plain, plain_steps) = worst_step(shaken, 1e-5);
    let (predicted, predicted_steps) = worst_step(shaken_with_bound, 1e-5);
    println!("{plain:.1} in {plain_steps} steps, {predicted:.1} in {predicted_steps}");
    assert!(plain > 100.0, "nothing to control here: {plain}");
    assert!(predicted < 3.0, "{predicted}");
    assert!(predicted_steps < plain_steps);
}

/// Slip that reverses within a fraction of a microsecond: its zone is narrower than the resolution of the
/// search.
#[test]
fn issue_007_behaviour_a_fast_slip_reversal_is_predicted() {
    const SPEED: f64 = 1e-7;
    let shaken = || {
        FunctionProblem::new(
            vec![1.0],
            |t, x, dx| dx[0] = 3.0 * libm::sin(5.0 * t) - libm::tanh(x[0] / SPEED),
            |_, x, j| {
                let friction = libm::tanh(x[0] / SPEED);
                j[0] = -(1.0 - friction * friction) / SPEED;
            },
        )
        .time_derivative(|t, _, df_dt| df_dt[0] = 15.0 * libm::cos(5.0 * t))
    };
    let predicted =
        shaken().discontinuities(0, 1, |_, x, functions| functions.slips[0] = [x[0] / SPEED, 0.0]);
    let (exact, _) = run(shaken(), options(Method::Rodas5P, 1e-11), &[0.0], 8.0);
    let (x, statistics) = run(predicted, options(Method::Rodas5P, 1e-4), &[0.0], 8.0);
    assert!((x[0] - exact[0]).abs() < 1e-3, "{x:?} {exact:?}");
    // It reverses 12 times.
    assert!(statistics.discontinuities_predicted >= 12, "{statistics:?}");
}

/// A ball that bounces, with explicit steps: after each impact they are as long as after the last one.
#[test]
fn issue_007_behaviour_impacts_cost_few_rejections() {
    let ball = BALL
        .problem()
        .discontinuities(1, 0, |_, x, functions| functions.values[0] = x[0])
        .spectral_radius_bound(|_, x| if x[0] < 0.0 { BALL.omega } else { 0.0 });
    let (_, statistics) = run(ball, options(Method::Rodas5P, 1e-7), &[0.5, 0.0], 20.0);
    // 31 impacts, nearly all by explicit steps; if steps after an impact were half as long as those before
    // it, there would be ten rejections each.
    assert!(statistics.discontinuities_predicted >= 62, "{statistics:?}");
    assert!(
        10 * statistics.explicit_steps > 9 * statistics.steps,
        "{statistics:?}"
    );
    assert!(statistics.rejected() < 6 * 31, "{statistics:?}");
}
