//! Benchmarks: how fast, with caveats.
//!
//! Wall times depend on the machine and on what else it does: compare within one run, and trust ratios of 1.2
//! and more. Instruction counts (`valgrind --tool=callgrind`) repeat to the last digit for the same binary.

pub mod cars;
pub mod circle;
pub mod explicit;
pub mod wedges;

use std::hint::black_box;
use std::process::ExitCode;

use cpu_time::ProcessTime;
use integrate::Problem;
use mechanics::energy_balance::Entries;
use mechanics::system::Observation;
use mechanics::system::System;
use nucars::truck::Choices;
use study::half_truck::catalog;
use wedge::parameters::Damping;
use wedge::{BuildError, Wedge, thesis};

/// Returns the exit code of a benchmark, and prints its error, if it has one.
pub fn exit(done: Result<(), String>) -> ExitCode {
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

/// Returns a wedge in the middle of a branch, pressed into both faces and sliding, toe out and yawed, and its
/// state.
///
/// # Errors
/// The thesis's parameters make no wedge, which would be a defect.
pub fn sliding_wedge(damping: Damping) -> Result<(Wedge, Vec<f64>), BuildError> {
    let wedge = Wedge::new(thesis::parameters(damping, 0.003, 0.012))?;
    let mut x = wedge.initial_state.clone();
    x[1] = 2e-5;
    x[3] = 0.006;
    x[5] = -0.04;
    Ok((wedge, x))
}

/// Returns a half-truck of the catalog ([`catalog::entries`]) with its bolster going down and its wedges
/// sliding, and its state.
///
/// # Errors
/// There is no such run, or it makes no system.
pub fn sliding_truck(name: &str) -> Result<(System, Vec<f64>), String> {
    let entry = catalog::entry(name).ok_or_else(|| format!("there is no run {name}"))?;
    let case = entry
        .case(&Choices::default(), 1.0)
        .map_err(|error| error.to_string())?;
    let body = case
        .truck
        .body(1)
        .ok_or_else(|| format!("{name} has no body 1"))?;
    let system = System::new(case.truck.model.clone()).map_err(|error| error.to_string())?;
    let mut x = system.initial_state();
    let count = system.layout().speeds;
    let height = system
        .position_of(body, 2)
        .ok_or_else(|| format!("{name}: body 1 does not move up and down"))?;
    x[height] = -0.01;
    x[count + height] = -0.04;
    for place in case.truck.wedges() {
        if let Some(deflection) = system.deflection_of(place) {
            x[deflection] = -1e-4;
        }
    }
    Ok((system, x))
}

/// CPU times (µs) of right-hand side, Jacobian matrix, factorization and solution at a state: the least of
/// nine rounds of `calls` each. `shift` is what the matrix is factored with, 1/s.
pub fn costs<P: Problem>(problem: &mut P, time: f64, x: &[f64], shift: f64, calls: usize) -> [f64; 4] {
    let (mut dx, mut df_dt) = (vec![0.0; x.len()], vec![0.0; x.len()]);
    // Each call a little later, so that nothing is known from the one before.
    let mut at = time;
    let rates = least(calls, || {
        at += 1e-9;
        problem.derivative(at, black_box(x), &mut dx);
    });
    let jacobian = least(calls, || {
        at += 1e-9;
        df_dt.fill(0.0);
        problem.linearize(at, black_box(x), &dx, &mut df_dt);
    });
    let factor = least(calls, || {
        black_box(problem.factor(black_box(shift)).is_ok());
    });
    let solve = least(calls, || {
        df_dt.copy_from_slice(&dx);
        problem.solve(black_box(&mut df_dt));
    });
    [rates, jacobian, factor, solve]
}

/// Returns the least CPU time of nine rounds, µs a call.
fn least(calls: usize, mut call: impl FnMut()) -> f64 {
    let rounds = (0..9).map(|_| {
        let start = ProcessTime::now();
        for _ in 0..calls {
            call();
        }
        1e6 * start.elapsed().as_secs_f64() / calls as f64
    });
    rounds.fold(f64::INFINITY, f64::min)
}

/// Returns the energies of an instant for an energy balance; `start` is the stored energy at the start, J.
#[must_use]
pub fn ledger(observation: &Observation, start: f64) -> Entries {
    let (work, losses) = observation
        .quadratures
        .split_first()
        .map_or((0.0, 0.0), |(work, losses)| (*work, losses.iter().sum::<f64>()));
    let stored_change = observation.energies.total() - start;
    Entries {
        work,
        losses,
        stored_change,
        residual: work - stored_change - losses,
        admissible: 0.0,
        exchanged: 0.0,
    }
}

/// The code in the crates' README files runs with the tests of documentation.
#[cfg(doctest)]
mod readmes {
    #[doc = include_str!("../../../crates/integrate/README.md")]
    struct Integrate;
    #[doc = include_str!("../../../crates/wheelrail/README.md")]
    struct Wheelrail;
}
