//! `wedge_count [MOST]`: how the cost of a step grows with the number of wedges in one system, uncoupled and in a chain.
//!
//! CPU times. A step is one of Rodas5P of a fixed length (10 µs), contact modes recorded as ever; the least of three runs. Pieces:
//! right-hand side, Jacobian matrix, factorization, solution, in the state that the last step ended in.

use std::hint::black_box;
use std::process::ExitCode;

use benchmarks::cpu_seconds;
use benchmarks::wedges::{Arrangement, wedges};
use integrate::{Integrator, Options, Problem};

const COUNTS: [usize; 8] = [1, 2, 5, 10, 20, 50, 100, 200];
/// Length of a step, s.
const STEP: f64 = 1e-5;
/// Wedges times steps of a run.
const WORK: usize = 40_000;

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
            "per wedge",
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
    let steps = WORK / count;
    let (mut least, mut events, mut end) = (f64::INFINITY, 0.0, Vec::new());
    for _ in 0..3 {
        let options = Options {
            fixed_step: Some(STEP),
            ..Options::default()
        };
        let start = system.initial_state();
        let mut integrator =
            Integrator::new(system.clone(), options, 0.0, &start).map_err(|error| error.to_string())?;
        let begun = cpu_seconds();
        for _ in 0..steps {
            integrator
                .step_to(f64::INFINITY)
                .map_err(|error| error.to_string())?;
        }
        least = least.min(cpu_seconds() - begun);
        events = integrator.statistics().events as f64 / (steps * count) as f64;
        end = integrator.x().to_vec();
    }
    let step = 1e6 * least / steps as f64;
    let [rates, jacobian, factor, solve] = pieces(system, &end).map(|cost| cost / count as f64);
    Ok(format!(
        "{step:>10.1} {:>10.2} {events:>8.4} {rates:>10.3} {jacobian:>10.3} {factor:>10.3} {solve:>10.3}",
        step / count as f64
    ))
}

/// Right-hand side, Jacobian matrix, factorization, solution, µs.
fn pieces(mut system: mechanics::system::System, x: &[f64]) -> [f64; 4] {
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
