//! Agreement with an independent code (diffsol) and with closed forms.

#![allow(clippy::unwrap_used)] // it may stop where it stands

use diffsol::{
    NalgebraLU, NalgebraMat, OdeBuilder, OdeEquationsImplicit, OdeSolverMethod, OdeSolverProblem,
    OdeSolverStopReason, Vector,
};
use integrate::{FunctionProblem, Integrator, Method, Options};

type Matrix = NalgebraMat<f64>;

/// A tolerance at which a method is about as exact as the others: that of order 2 makes many more steps.
fn tolerance(method: Method, of_others: f64) -> f64 {
    match method {
        Method::TrBdf2 => 1e-3 * of_others,
        _ => of_others,
    }
}

/// Values of the independent code at `times`.
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

fn run(problem: FunctionProblem<'_>, options: Options, x: &[f64], times: &[f64]) -> Vec<Vec<f64>> {
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

fn robertson() -> FunctionProblem<'static> {
    FunctionProblem::new(
        vec![1.0, 1e-4, 1.0],
        |_, x, dx| {
            dx[0] = -0.04 * x[0] + 1e4 * x[1] * x[2];
            dx[2] = 3e7 * x[1] * x[1];
            dx[1] = -dx[0] - dx[2];
        },
        |_, x, j| {
            j[..3].copy_from_slice(&[-0.04, 1e4 * x[2], 1e4 * x[1]]);
            j[6..].copy_from_slice(&[0.0, 6e7 * x[1], 0.0]);
            for k in 0..3 {
                j[3 + k] = -j[k] - j[6 + k];
            }
        },
    )
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
        let found = run(robertson(), options, &[1.0, 0.0, 0.0], &times);
        for ((time, found), independent) in times.iter().zip(&found).zip(&independent) {
            for ((a, b), scale) in found.iter().zip(independent).zip([1.0, 1e-4, 1.0]) {
                assert!(
                    (a - b).abs() < 1e-7 * scale,
                    "{method} at {time}: {found:?}, {independent:?}"
                );
            }
        }
    }
    // Published: SUNDIALS' example cvRoberts_dns at t = 40 (rtol 1e-4)
    for (value, published) in independent[1].iter().zip([7.158e-1, 9.185e-6, 2.842e-1]) {
        assert!((value / published - 1.0).abs() < 2e-4);
    }
}

#[test]
fn van_der_pol_agrees_with_an_independent_code() {
    const MU: f64 = 1000.0;
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
        let van_der_pol = FunctionProblem::new(
            vec![1.0, 1.0],
            |_, x, dx| {
                dx[0] = x[1];
                dx[1] = MU * (1.0 - x[0] * x[0]) * x[1] - x[0];
            },
            |_, x, j| {
                let row = [-2.0 * MU * x[0] * x[1] - 1.0, MU * (1.0 - x[0] * x[0])];
                j.copy_from_slice(&[0.0, 1.0, row[0], row[1]]);
            },
        );
        let options = Options {
            method,
            relative_tolerance: 1e-10,
            ..Options::default()
        };
        let found = run(van_der_pol, options, &[2.0, 0.0], &times);
        for ((time, found), independent) in times.iter().zip(&found).zip(&independent) {
            assert!(
                (found[0] - independent[0]).abs() < 2e-6,
                "{method} at {time}: {found:?}, {independent:?}"
            );
        }
        // Published: F. Mazzia, C. Magherini: Test Set for Initial Value Problem Solvers 2.4 (2008), problem VDPOL,
        // whose time is t/μ
        assert!(
            (found[2][0] - 1.706_167_732_170_483).abs() < 2e-6,
            "{method}: {:?}",
            found[2]
        );
    }
}

const GRAVITY: f64 = 386.0886;
/// Angular frequency of the mass on the spring (140 Hz).
const OMEGA: f64 = 879.645_943_005_142_4;

/// A mass falls on a unilateral spring without loss.
fn bounce() -> FunctionProblem<'static> {
    FunctionProblem::new(
        vec![1.0, OMEGA * 0.01],
        |_, x, dx| {
            dx[0] = x[1];
            dx[1] = -GRAVITY - OMEGA * OMEGA * x[0].min(0.0);
        },
        |_, x, j| j.copy_from_slice(&[0.0, 1.0, if x[0] < 0.0 { -OMEGA * OMEGA } else { 0.0 }, 0.0]),
    )
    .events(
        1,
        |_, x, modes| modes[0] = u8::from(x[0] < 0.0),
        |_, x, modes, margins| margins[0] = if modes[0] == 0 { x[0] } else { -x[0] },
        |_, _, _, mode| 1 - mode,
    )
}

/// Start height, time of the first contact, durations of contact and of flight.
fn bounce_times() -> (f64, f64, f64, f64) {
    let height = 0.5;
    let fall = (2.0 * height / GRAVITY).sqrt();
    let speed = GRAVITY * fall;
    // below: x = -g/ω² + (g/ω²) cos ωt - (v/ω) sin ωt, up again where tan(ωt/2) = -vω/g
    let contact = 2.0 * (std::f64::consts::PI - libm::atan(speed * OMEGA / GRAVITY)) / OMEGA;
    (height, fall, contact, 2.0 * fall)
}

fn bounce_exact(time: f64) -> f64 {
    let (height, fall, contact, flight) = bounce_times();
    if time < fall {
        return height - 0.5 * GRAVITY * time * time;
    }
    let speed = GRAVITY * fall;
    let since = (time - fall) % (contact + flight);
    if since < contact {
        let sag = GRAVITY / (OMEGA * OMEGA);
        sag * (libm::cos(OMEGA * since) - 1.0) - speed / OMEGA * libm::sin(OMEGA * since)
    } else {
        let t = since - contact;
        speed * t - 0.5 * GRAVITY * t * t
    }
}

#[test]
fn a_bouncing_mass_agrees_with_its_closed_form() {
    let (height, fall, contact, flight) = bounce_times();
    for method in Method::ALL {
        let options = Options {
            method,
            relative_tolerance: 1e-8,
            ..Options::default()
        };
        let mut integrator = Integrator::new(bounce(), options, 0.0, &[height, 0.0]).unwrap();
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
            let error = integrator.x()[0] - bounce_exact(integrator.time());
            assert!(error.abs() < 3e-5, "{method} at {}: {error}", integrator.time());
        }
        assert_eq!(u64::from(changes), integrator.statistics().events);
        assert!(changes >= 18);
        println!("{method}: {:?}", integrator.statistics());
    }
}

#[test]
fn a_bouncing_mass_with_loss_agrees_with_an_independent_code() {
    // A damper only where the spring presses: the force is continuous, with a kink.
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
    // it has trouble at kinks
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
        let found = run(mine, options, &[0.5, 0.0], &times);
        for ((time, found), independent) in times.iter().zip(&found).zip(&independent) {
            assert!(
                (found[0] - independent[0]).abs() < 2e-6,
                "{method} at {time}: {found:?}, {independent:?}"
            );
        }
    }
}
