//! Events, time discontinuities, tolerances, limits and saved states against closed forms.

use crate::common;
use std::f64::consts::PI;

use common::problems::{BouncingBall, prothero_robinson, prothero_robinson_solution};
use common::run;
use integrate::{Event, FunctionProblem, Integrator, Method, Options, State};

/// x'' = -x with discrete states for the sign of the position and of the speed.
fn oscillator(hysteresis: f64) -> FunctionProblem<'static> {
    FunctionProblem::new(
        vec![1.0; 2],
        |_, x, dx| {
            dx[0] = x[1];
            dx[1] = -x[0];
        },
        |_, _, j| j.copy_from_slice(&[0.0, 1.0, -1.0, 0.0]),
    )
    .events(
        2,
        |_, x, states| {
            states[0] = u8::from(x[0] < 0.0);
            states[1] = u8::from(x[1] < 0.0);
        },
        move |_, x, states, functions| {
            for i in 0..2 {
                functions[i] = if states[i] == 0 { x[i] } else { -x[i] } + hysteresis;
            }
        },
        |_, _, _, state| 1 - state,
    )
}

/// Integrates to `end` with the given limits in between; all events.
fn record(mut integrator: Integrator<FunctionProblem<'_>>, end: f64, limit: f64) -> Vec<Event> {
    let mut events = Vec::new();
    let mut next = limit;
    while integrator.time() < end {
        let before = integrator.discrete_states().to_vec();
        integrator.step_to(end.min(next)).unwrap();
        assert_eq!(before, integrator.discrete_states_before_step());
        let mut time = integrator.previous_time();
        let mut states = before;
        for event in integrator.events() {
            assert!(
                event.time >= time && event.time <= integrator.time(),
                "in order of time"
            );
            assert_eq!(states[event.index], event.from);
            states[event.index] = event.to;
            time = event.time;
        }
        assert_eq!(states, integrator.discrete_states());
        events.extend_from_slice(integrator.events());
        if integrator.time() >= next {
            next += limit;
        }
    }
    assert_eq!(integrator.statistics().events, events.len() as u64);
    assert_eq!(integrator.statistics().events_unresolved, 0);
    events
}

#[test]
fn events_are_where_the_closed_form_has_them() {
    let start = 0.3_f64;
    for method in Method::ALL {
        for hysteresis in [0.0, 1e-3, 0.2] {
            for (maximum_step, limit) in [
                (f64::INFINITY, f64::INFINITY),
                (0.05, f64::INFINITY),
                (f64::INFINITY, 0.37),
                (0.2, 0.11),
            ] {
                let options = Options {
                    method,
                    relative_tolerance: 1e-10,
                    maximum_step,
                    ..Options::default()
                };
                let x = [libm::cos(start), -libm::sin(start)];
                let integrator = Integrator::new(oscillator(hysteresis), options, 0.0, &x).unwrap();
                let events = record(integrator, 20.0, limit);
                // x = cos(t + start): position events at phases π/2 + asin(hysteresis) + kπ, speed events a
                // quarter later
                let late = libm::asin(hysteresis);
                let mut exact: Vec<(f64, usize)> = (0..9)
                    .flat_map(|k| {
                        [(0.5 * PI, 0), (PI, 1)]
                            .map(|(phase, i)| (phase + late + f64::from(k) * PI - start, i))
                    })
                    .filter(|(time, _)| *time > 0.0 && *time < 20.0)
                    .collect();
                exact.sort_by(|a, b| a.0.total_cmp(&b.0));
                assert_eq!(
                    events.len(),
                    exact.len(),
                    "{method} {hysteresis} {maximum_step} {limit}: {events:?}"
                );
                for (event, (time, index)) in events.iter().zip(exact) {
                    assert_eq!(event.index, index);
                    // Errors are held in proportion to the step: over many steps the lower order has more of
                    // them.
                    let admissible = if method == Method::TrBdf2 { 2e-6 } else { 2e-8 };
                    assert!(
                        (event.time - time).abs() < admissible,
                        "{method} {hysteresis} {maximum_step} {limit}: {event:?}, exactly at {time}"
                    );
                }
            }
        }
    }
}

#[test]
fn several_events_in_one_step_are_all_found() {
    // A discrete state with nine values in a row, passed in one long step of x = t.
    let problem = FunctionProblem::new(vec![1.0], |_, _, dx| dx[0] = 1.0, |_, _, j| j[0] = 0.0).events(
        2,
        |_, _, states| states.fill(0),
        |_, x, states, functions| {
            functions[0] = f64::from(states[0]) * 0.1 + 0.1 - x[0];
            // The second follows the first at once.
            functions[1] = if states[0] >= 2 && states[1] == 0 {
                -1.0
            } else {
                1.0
            };
        },
        |_, _, _, state| state + 1,
    );
    let options = Options {
        fixed_step: Some(1.0),
        ..Options::default()
    };
    let mut integrator = Integrator::new(problem, options, 0.0, &[0.0]).unwrap();
    integrator.step_to(f64::INFINITY).unwrap();
    let found: Vec<_> = integrator
        .events()
        .iter()
        .map(|event| (event.index, event.to))
        .collect();
    let mut expected: Vec<_> = (1..=9).map(|state| (0, state)).collect();
    expected.insert(2, (1, 1));
    assert_eq!(found[..10], expected);
    for event in integrator.events().iter().filter(|event| event.index == 0) {
        assert!(
            (event.time - 0.1 * f64::from(event.to)).abs() < 1e-11,
            "{event:?}"
        );
    }
    assert_eq!(integrator.events()[2].time, integrator.events()[1].time);
}

#[test]
fn an_event_that_is_declined_and_chatter_do_not_stop_the_integration() {
    let problem = FunctionProblem::new(vec![1.0], |_, _, dx| dx[0] = 1.0, |_, _, j| j[0] = 0.0).events(
        2,
        |_, _, states| states.fill(0),
        |_, x, _, functions| functions.copy_from_slice(&[0.5 - x[0], 2.5 - x[0]]),
        |_, _, index, state| if index == 0 { state } else { 1 - state },
    );
    let options = Options {
        fixed_step: Some(1.0),
        maximum_events: 10,
        ..Options::default()
    };
    let mut integrator = Integrator::new(problem, options, 0.0, &[0.0]).unwrap();
    for _ in 0..2 {
        integrator.step_to(f64::INFINITY).unwrap();
        assert!(integrator.events().is_empty());
    }
    integrator.step_to(f64::INFINITY).unwrap();
    assert_eq!(integrator.events().len(), 10);
    assert_eq!(integrator.statistics().events_unresolved, 1);
}

/// x' = s(t) - x with the triangular wave s of period 2 between 0 and 1, from x(0) = 0; exact in each
/// smooth interval.
fn triangle(time: f64) -> f64 {
    let (mut x, mut start, mut rising) = (0.0, 0.0, true);
    loop {
        let end = time.min(start + 1.0);
        let duration = end - start;
        // particular solution for s = a + b τ: a - b + b τ
        let (a, b) = if rising { (0.0, 1.0) } else { (1.0, -1.0) };
        x = (x - (a - b)) * libm::exp(-duration) + a - b + b * duration;
        if end >= time {
            return x;
        }
        (start, rising) = (start + 1.0, !rising);
    }
}

fn driven_by_triangle(with_breaks: bool) -> FunctionProblem<'static> {
    let problem = FunctionProblem::new(
        vec![1.0],
        |t, x, dx| {
            let phase = t - 2.0 * (0.5 * t).floor();
            dx[0] = phase.min(2.0 - phase) - x[0];
        },
        |_, _, j| j[0] = -1.0,
    )
    .time_derivative(|t, _, f| {
        f[0] = if t - 2.0 * (0.5 * t).floor() < 1.0 {
            1.0
        } else {
            -1.0
        }
    });
    if with_breaks {
        problem.time_discontinuities((1..20).map(f64::from).collect())
    } else {
        problem
    }
}

#[test]
fn steps_end_at_time_discontinuities_and_keep_their_order() {
    for method in Method::ALL {
        let run = |with_breaks| {
            let options = Options {
                method,
                relative_tolerance: 1e-10,
                ..Options::default()
            };
            let mut integrator =
                Integrator::new(driven_by_triangle(with_breaks), options, 0.0, &[0.0]).unwrap();
            let (mut worst, mut ends) = (0.0_f64, 0);
            while integrator.time() < 9.5 {
                integrator.step_to(9.5).unwrap();
                worst = worst.max((integrator.x()[0] - triangle(integrator.time())).abs());
                ends += u32::from(integrator.time() == integrator.time().floor());
            }
            (worst, ends, integrator.statistics().clone())
        };
        let (worst, ends, statistics) = run(true);
        let admissible = if method == Method::TrBdf2 { 1e-7 } else { 2e-9 };
        assert!(worst < admissible, "{method}: {worst}");
        assert_eq!(ends, 9, "steps end exactly at the discontinuities");
        assert_eq!(statistics.restarts, 9);
        // a step planned for the end of a transient may be too long for the next one
        assert!(statistics.rejected() <= 9, "{method}: {statistics:?}");
        let (_, _, plain) = run(false);
        assert!(
            plain.rejected_error > 9 + statistics.rejected_error,
            "{method}: {plain:?}"
        );
    }
}

/// The right-hand side jumps at time discontinuities.
#[test]
fn steps_end_exactly_at_time_discontinuities_and_limits() {
    let problem = FunctionProblem::new(
        vec![1.0],
        |t, _, dx| dx[0] = if t <= 0.1 { 1.0 } else { -1.0 },
        |_, _, j| j[0] = 0.0,
    )
    .time_discontinuities(vec![0.1, 0.7]);
    let mut integrator = Integrator::new(problem, Options::default(), 0.0, &[0.0]).unwrap();
    let mut times = Vec::new();
    while integrator.time() < 1.0 {
        let limit = if integrator.time() < 0.35 { 0.35 } else { 1.0 };
        integrator.step_to(limit).unwrap();
        times.push(integrator.time());
    }
    for time in [0.1, 0.35, 0.7, 1.0] {
        assert!(times.contains(&time), "{time} in {times:?}");
    }
    assert_eq!(integrator.statistics().restarts, 2);
}

#[test]
fn errors_are_proportional_to_the_tolerance() {
    for method in Method::ALL {
        let mut last = f64::INFINITY;
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
            let options = Options {
                method,
                relative_tolerance: tolerance,
                ..Options::default()
            };
            let mut integrator = Integrator::new(oscillator(0.0), options, 0.0, &[1.0, 0.0]).unwrap();
            while integrator.time() < 10.0 {
                integrator.step_to(10.0).unwrap();
            }
            let error = (integrator.x()[0] - libm::cos(10.0)).abs();
            println!(
                "{method} {tolerance:e}: {error:.2e}, {:?}",
                integrator.statistics()
            );
            // The error of a step is held to the tolerance, and there are tolerance^(-1/3) steps of order 2.
            let admissible = match method {
                Method::TrBdf2 => 3.0 * libm::pow(tolerance, 2.0 / 3.0),
                _ => 30.0 * tolerance,
            };
            assert!(error < admissible, "{method} {tolerance}: {error}");
            assert!(error < 0.2 * last, "{method} {tolerance}: {error} after {last}");
            last = error;
        }
    }
}

#[test]
fn a_state_that_is_not_controlled_does_not_matter() {
    let problem = FunctionProblem::new(
        vec![1.0, f64::INFINITY],
        |t, x, dx| {
            dx[0] = -x[0];
            dx[1] = libm::sin(1e4 * t);
        },
        |_, _, j| j[0] = -1.0,
    )
    .time_derivative(|t, _, f| f[1] = 1e4 * libm::cos(1e4 * t));
    let mut integrator = Integrator::new(problem, Options::default(), 0.0, &[1.0, 0.0]).unwrap();
    while integrator.time() < 1.0 {
        integrator.step_to(1.0).unwrap();
    }
    assert!(
        integrator.statistics().steps < 60,
        "{:?}",
        integrator.statistics()
    );
    assert!((integrator.x()[0] - libm::exp(-1.0)).abs() < 1e-6);
}

/// Discontinuities in state and time, events and a varying step together.
fn everything() -> FunctionProblem<'static> {
    FunctionProblem::new(
        vec![1.0, 30.0],
        |t, x, dx| {
            let phase = t - t.floor();
            dx[0] = x[1];
            dx[1] = -9.0 * phase.min(1.0 - phase) - 400.0 * x[0].min(0.0) - 20.0 * libm::tanh(x[1] / 0.01);
        },
        |_, x, j| {
            let th = libm::tanh(x[1] / 0.01);
            j.copy_from_slice(&[
                0.0,
                1.0,
                if x[0] < 0.0 { -400.0 } else { 0.0 },
                -2000.0 * (1.0 - th * th),
            ]);
        },
    )
    .time_derivative(|t, _, f| f[1] = if t - t.floor() < 0.5 { -9.0 } else { 9.0 })
    .time_discontinuities((1..2000).map(|k| f64::from(k) * 0.5).collect())
    .events(
        1,
        |_, x, states| states[0] = u8::from(x[0] < 0.0),
        |_, x, states, functions| functions[0] = if states[0] == 0 { x[0] } else { -x[0] } + 1e-6,
        |_, _, _, state| 1 - state,
    )
}

#[test]
fn a_saved_integration_continues_with_the_same_bits() {
    for method in Method::ALL {
        let options = Options {
            method,
            maximum_step: 0.02,
            ..Options::default()
        };
        let walk = |integrator: &mut Integrator<FunctionProblem<'static>>, steps: usize| {
            for _ in 0..steps {
                integrator.step_to(f64::INFINITY).unwrap();
            }
        };
        let mut straight = Integrator::new(everything(), options.clone(), 0.0, &[1.0, 40.0]).unwrap();
        walk(&mut straight, 1000);
        // The cut must not matter, wherever it falls: also at a time discontinuity.
        let mut interrupted = Integrator::new(everything(), options.clone(), 0.0, &[1.0, 40.0]).unwrap();
        walk(&mut interrupted, 400);
        while interrupted.time() != 2.0 * (0.5 * interrupted.time()).floor()
            && interrupted.statistics().steps < 990
        {
            walk(&mut interrupted, 1);
            let text = serde_json::to_string(&interrupted.state()).unwrap();
            let state: State = serde_json::from_str(&text).unwrap();
            assert_eq!(state, interrupted.state());
            interrupted = Integrator::resume(everything(), options.clone(), state).unwrap();
        }
        let left = 1000 - interrupted.statistics().steps as usize;
        walk(&mut interrupted, left);
        let (a, b) = (straight.state(), interrupted.state());
        assert_eq!(a.time.to_bits(), b.time.to_bits());
        for (a, b) in a.x.iter().zip(&b.x) {
            assert_eq!(a.to_bits(), b.to_bits());
        }
        let mut statistics = b.statistics.clone();
        // each resumption evaluates the derivative once
        assert!(statistics.derivatives >= a.statistics.derivatives);
        statistics.derivatives = a.statistics.derivatives;
        assert_eq!(a.statistics, statistics);
        assert_eq!(
            (a.discrete_states, a.proposed_step),
            (b.discrete_states, b.proposed_step)
        );
    }
}

#[test]
fn a_bouncing_ball_follows_its_closed_form() {
    // Inches; 140 Hz on the spring.
    let ball = BouncingBall {
        gravity: 386.0886,
        omega: 879.645_943_005_142_4,
        height: 0.5,
    };
    let ((fall, _), (contact, flight)) = (ball.fall(), ball.contact_and_flight());
    for method in Method::ALL {
        let options = Options {
            method,
            relative_tolerance: 1e-8,
            ..Options::default()
        };
        let mut integrator = Integrator::new(ball.problem(), options, 0.0, &[ball.height, 0.0]).unwrap();
        let (mut changes, mut expected) = (0, fall);
        while integrator.time() < 1.0 {
            integrator.step_to(1.0).unwrap();
            for event in integrator.events() {
                assert!(
                    (event.time - expected).abs() < 1e-6,
                    "{method}: {event:?}, expected at {expected}"
                );
                assert_eq!(event.to, 1 - changes % 2);
                expected += if changes % 2 == 0 { contact } else { flight };
                changes += 1;
            }
            let error = integrator.x()[0] - ball.solution(integrator.time());
            assert!(error.abs() < 3e-5, "{method} at {}: {error}", integrator.time());
        }
        assert_eq!(u64::from(changes), integrator.statistics().events);
        assert!(changes >= 18);
    }
}

/// The transient decays within 1/λ; after it the solution is φ.
#[test]
fn the_prothero_robinson_problem_follows_its_closed_form() {
    for method in Method::ALL {
        for lambda in [-1.0, -1e3, -1e6] {
            let options = Options {
                method,
                relative_tolerance: 1e-7,
                ..Options::default()
            };
            let start = prothero_robinson_solution(0.0) + 1.0;
            let (x, statistics) = run(prothero_robinson(lambda), options, &[start], 2.0);
            let exact = prothero_robinson_solution(2.0) + libm::exp(2.0 * lambda);
            let error = (x[0] - exact).abs();
            println!(
                "{method}, λ = {lambda}: error {error:.1e}, {} steps",
                statistics.steps
            );
            assert!(error < 2e-5, "{method}, λ = {lambda}: {error}");
            assert!(statistics.steps < 3000, "{method}, λ = {lambda}: {statistics:?}");
        }
    }
}
