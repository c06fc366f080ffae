//! Dense output and its correction.

use integrate::{FunctionProblem, Integrator, Options};

const GRAVITY: f64 = 9.81;
const FRICTION: f64 = 0.5;
/// The reference speed of friction, m/s.
const REFERENCE: f64 = 2.5e-5;

/// Returns the force that pulls, in units of the weight: it swings, and friction always holds it.
fn pull(time: f64) -> f64 {
    0.4 * libm::sin(7.0 * time) + 0.05 * libm::sin(31.0 * time)
}

/// Returns a mass on a surface with friction by tanh: place, speed.
fn sticking() -> FunctionProblem<'static> {
    FunctionProblem::new(
        vec![1e-3, 1e-3],
        |t, x, dx| {
            dx[0] = x[1];
            dx[1] = GRAVITY * (pull(t) - FRICTION * libm::tanh(x[1] / REFERENCE));
        },
        |_, x, jacobian| {
            let friction = libm::tanh(x[1] / REFERENCE);
            jacobian[1] = 1.0;
            jacobian[3] = -GRAVITY * FRICTION / REFERENCE * (1.0 - friction * friction);
        },
    )
    .time_derivative(|t, _, df_dt| {
        df_dt[1] = GRAVITY * (7.0 * 0.4 * libm::cos(7.0 * t) + 31.0 * 0.05 * libm::cos(31.0 * t));
    })
}

/// Returns the largest difference of friction and pull, in units of the weight, at four times within each
/// step, and the number of steps: interpolated (corrected), and by the plain dense output.
fn largest_error(tolerance: f64) -> ([f64; 2], u64) {
    let options = Options {
        relative_tolerance: tolerance,
        ..Options::default()
    };
    let mut run = Integrator::new(sticking(), options, 0.0, &[0.0; 2]).unwrap();
    let mut most = [0.0_f64; 2];
    while run.time() < 3.0 {
        run.step_to(3.0).unwrap();
        // The transient at the start takes 1e-5 s.
        if run.previous_time() < 1e-3 {
            continue;
        }
        for theta in [0.15, 0.4, 0.65, 0.9] {
            let time = run.previous_time() + theta * (run.time() - run.previous_time());
            let (mut corrected, mut plain) = ([0.0; 2], [0.0; 2]);
            run.interpolate(time, &mut corrected);
            run.interpolate_range(time, 0, &mut plain);
            for (most, x) in most.iter_mut().zip([corrected, plain]) {
                *most = most.max((FRICTION * libm::tanh(x[1] / REFERENCE) - pull(time)).abs());
            }
        }
    }
    (most, run.statistics().steps)
}

/// The acceleration of what creeps is nothing beside the pull, 1e-5 of the weight, so friction is what pulls.
/// In the middle of a step the plain dense output is off by up to 6 % of the weight (the friction of wedges
/// was off by up to a quarter in single rows).
#[test]
fn issue_007_behaviour_sticking_friction_is_interpolated_in_equilibrium() {
    for tolerance in [1e-3, 1e-4] {
        let ([corrected, plain], steps) = largest_error(tolerance);
        println!("{tolerance:e}: {corrected:.1e} corrected, {plain:.1e} plain, {steps} steps");
        assert!(
            corrected < 3e-3,
            "{tolerance:e}: off by {corrected} of the weight"
        );
        assert!(
            corrected < 0.2 * plain,
            "{tolerance:e}: {corrected}, without correction {plain}"
        );
    }
}

/// Interpolated values do not depend on earlier interpolations, and interpolation does not change the run.
#[test]
fn interpolation_does_not_depend_on_earlier_interpolations() {
    let begin = || {
        let options = Options {
            relative_tolerance: 1e-4,
            ..Options::default()
        };
        Integrator::new(sticking(), options, 0.0, &[0.0; 2]).unwrap()
    };
    let (mut often, mut once, mut never) = (begin(), begin(), begin());
    let mut differ = 0;
    while never.time() < 1.0 {
        for run in [&mut often, &mut once, &mut never] {
            run.step_to(1.0).unwrap();
        }
        let at = |theta: f64| never.previous_time() + theta * (never.time() - never.previous_time());
        let mut x = [0.0; 2];
        for theta in [0.9, 0.2, 0.7, 0.3] {
            often.interpolate(at(theta), &mut x);
        }
        let (mut first, mut plain) = ([0.0; 2], [0.0; 2]);
        once.interpolate(at(0.3), &mut first);
        once.interpolate_range(at(0.3), 0, &mut plain);
        assert_eq!(
            first.map(f64::to_bits),
            x.map(f64::to_bits),
            "t = {}",
            never.time()
        );
        differ += u32::from(first != plain);
        assert_eq!(often.state().x, never.state().x);
        assert_eq!(once.proposed_step(), never.proposed_step());
    }
    assert!(differ > 10, "{differ} steps were corrected");
}

/// After a change of the right-hand side there is only the plain dense output.
#[test]
fn nothing_is_corrected_after_a_change_of_the_right_hand_side() {
    let options = Options {
        relative_tolerance: 1e-4,
        ..Options::default()
    };
    let mut run = Integrator::new(sticking(), options, 0.0, &[0.0; 2]).unwrap();
    for _ in 0..20 {
        run.step_to(3.0).unwrap();
    }
    let middle = 0.5 * (run.previous_time() + run.time());
    let (mut corrected, mut plain, mut after) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    run.interpolate(middle, &mut corrected);
    run.interpolate_range(middle, 0, &mut plain);
    run.reevaluate();
    run.interpolate(middle, &mut after);
    assert_ne!(corrected, plain);
    assert_eq!(after, plain);
}
