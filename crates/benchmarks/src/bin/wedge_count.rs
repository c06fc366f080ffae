//! `wedge_count [MOST]`: how the cost of a step grows with the number of wedges in one system, uncoupled and in a chain.
//!
//! CPU times. A step is one of Rodas5P of a fixed length (10 µs) of the first 4 ms, the least of several runs: with and without
//! the recording of contact modes. Pieces: right-hand side, Jacobian matrix, factorization, solution, in the state that the last step
//! ended in.

use std::hint::black_box;
use std::process::ExitCode;

use benchmarks::cpu_seconds;
use benchmarks::wedges::{Arrangement, wedges};
use integrate::{Integrator, Options, Problem, Singular};
use mechanics::system::System;

const COUNTS: [usize; 8] = [1, 2, 5, 10, 20, 50, 100, 200];
/// Length of a step, s.
const STEP: f64 = 1e-5;
/// Steps of a run.
const STEPS: u32 = 400;
/// Runs: as many as give this many wedges in all, and three.
const WEDGES: usize = 200;

/// A system whose contact modes nobody records.
struct Unrecorded(System);

impl Problem for Unrecorded {
    fn dimension(&self) -> usize {
        self.0.dimension()
    }
    fn scales(&self) -> &[f64] {
        self.0.scales()
    }
    fn segment(&mut self, start: f64) -> f64 {
        self.0.segment(start)
    }
    fn derivative(&mut self, time: f64, x: &[f64], dx: &mut [f64]) {
        self.0.derivative(time, x, dx);
    }
    fn linearize(&mut self, time: f64, x: &[f64], dx: &[f64], df_dt: &mut [f64]) {
        self.0.linearize(time, x, dx, df_dt);
    }
    fn factor(&mut self, shift: f64) -> Result<(), Singular> {
        self.0.factor(shift)
    }
    fn solve(&mut self, b: &mut [f64]) {
        self.0.solve(b);
    }
}

fn main() -> ExitCode {
    let most = std::env::args().nth(1).map_or(Ok(200), |text| text.parse());
    let Ok(most) = most else {
        eprintln!("usage: wedge_count [MOST], such as 50");
        return ExitCode::from(2);
    };
    println!(
        "CPU times, µs, each divided by the number of wedges; events: changes of contact modes a step and wedge."
    );
    for arrangement in [Arrangement::Uncoupled, Arrangement::Chained] {
        println!(
            "\n{:12} {:>6} {:>10} {:>10} {:>8} {:>10} {:>10} {:>10} {:>10}",
            format!("{arrangement:?}"),
            "wedges",
            "step",
            "recorded",
            "events",
            "rhs",
            "Jacobian",
            "factor",
            "solve"
        );
        for count in COUNTS.into_iter().filter(|count| *count <= most) {
            match measure(count, arrangement) {
                Ok(line) => println!("{:12} {count:>6} {line}", ""),
                Err(error) => {
                    eprintln!("{count} wedges, {arrangement:?}: {error}");
                    return ExitCode::FAILURE;
                }
            }
        }
    }
    ExitCode::SUCCESS
}

/// The costs of one system.
fn measure(count: usize, arrangement: Arrangement) -> Result<String, String> {
    let system = wedges(count, arrangement)?;
    let (mut recorded, mut bare) = (f64::INFINITY, f64::INFINITY);
    let (mut events, mut end) = (0, Vec::new());
    for _ in 0..(WEDGES / count).max(3) {
        let mut cost;
        (cost, _, _) = steps(Unrecorded(system.clone()), &system)?;
        bare = bare.min(cost);
        (cost, events, end) = steps(system.clone(), &system)?;
        recorded = recorded.min(cost);
    }
    let [rates, jacobian, factor, solve] = pieces(system, &end);
    let each = [bare, recorded, rates, jacobian, factor, solve].map(|cost| cost / count as f64);
    let events = events as f64 / f64::from(STEPS) / count as f64;
    let [bare, recorded, rates, jacobian, factor, solve] = each;
    Ok(format!(
        "{bare:>10.2} {recorded:>10.2} {events:>8.4} {rates:>10.3} {jacobian:>10.3} {factor:>10.3} {solve:>10.3}"
    ))
}

/// The mean cost of a step, µs, the number of events, and the state at the end.
fn steps<P: Problem>(problem: P, system: &System) -> Result<(f64, u64, Vec<f64>), String> {
    let options = Options {
        fixed_step: Some(STEP),
        ..Options::default()
    };
    let mut integrator =
        Integrator::new(problem, options, 0.0, &system.initial_state()).map_err(|error| error.to_string())?;
    let begun = cpu_seconds();
    for _ in 0..STEPS {
        integrator
            .step_to(f64::INFINITY)
            .map_err(|error| error.to_string())?;
    }
    let cost = 1e6 * (cpu_seconds() - begun) / f64::from(STEPS);
    Ok((cost, integrator.statistics().events, integrator.x().to_vec()))
}

/// Right-hand side, Jacobian matrix, factorization, solution, µs.
fn pieces(mut system: System, x: &[f64]) -> [f64; 4] {
    let (mut dx, mut df_dt) = (vec![0.0; x.len()], vec![0.0; x.len()]);
    let calls = (20_000 / x.len()).max(20);
    system.segment(0.0);
    let mut at = 0.1;
    let rates = cost(calls, || {
        at += 1e-9;
        system.derivative(at, black_box(x), &mut dx);
    });
    let jacobian = cost(calls, || {
        at += 1e-9;
        df_dt.fill(0.0);
        system.linearize(at, black_box(x), &dx, &mut df_dt);
    });
    let factor = cost(calls, || {
        black_box(system.factor(black_box(1e5)).is_ok());
    });
    let solve = cost(calls, || {
        df_dt.copy_from_slice(&dx);
        system.solve(black_box(&mut df_dt));
    });
    [rates, jacobian, factor, solve]
}

/// The best of several rounds, µs a call.
fn cost(calls: usize, mut call: impl FnMut()) -> f64 {
    let rounds = (0..9).map(|_| {
        let begun = cpu_seconds();
        for _ in 0..calls {
            call();
        }
        1e6 * (cpu_seconds() - begun) / calls as f64
    });
    rounds.fold(f64::INFINITY, f64::min)
}
