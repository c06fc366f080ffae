//! Agreement with published reference solutions, and with those of an independent code. Crate `race` compares
//! with a solver of others that runs beside ours.

use crate::common;
use common::problems::{PUBLISHED, STICK_SLIP, stick_slip, stick_slip_with_discontinuities};
use common::{run, scaled_error, tolerance};
use integrate::{Method, Options};

/// Errors of the whole run, in units of the scales: at most ten tolerances of 1e-8.
#[test]
fn published_reference_solutions_are_met_by_all_methods() {
    for problem in &PUBLISHED {
        for method in Method::ALL {
            let options = Options {
                method,
                relative_tolerance: tolerance(method, 1e-8),
                ..Options::default()
            };
            let (x, statistics) = run((problem.problem)(), options, problem.start, problem.end);
            let error = scaled_error(&x, problem.reference, problem.scales);
            println!(
                "{}, {method}: error {error:.1e}, {} steps",
                problem.name, statistics.steps
            );
            assert!(
                error < 1e-7,
                "{} ({}), {method}: {error}",
                problem.name,
                problem.citation
            );
        }
    }
}

#[test]
fn a_stick_slip_oscillator_agrees_with_an_independent_code() {
    for method in Method::ALL {
        for make in [stick_slip, stick_slip_with_discontinuities] {
            let options = Options {
                method,
                relative_tolerance: tolerance(method, 1e-8),
                maximum_step: 0.01,
                ..Options::default()
            };
            let (x, statistics) = run(make(), options, STICK_SLIP.start, STICK_SLIP.end);
            let error = scaled_error(&x, STICK_SLIP.reference, STICK_SLIP.scales);
            println!("{method}: error {error:.1e}, {} steps", statistics.steps);
            // ESDIRK methods do not control the error of the speed.
            let admissible = match method {
                Method::TrBdf2 => 2e-6,
                Method::Esdirk3 => 1e-4,
                _ => 1e-7,
            };
            assert!(error < admissible, "{method}: {error}");
        }
    }
}
