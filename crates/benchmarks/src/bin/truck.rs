//! `truck [TOLERANCE] [NAME-PART] [METHOD]`: the three-piece truck on one core, 10 s of a prescribed bolster, for example
//! `truck 1e-5 vertical esdirk3`.
//!
//! CPU times of integration with contact states recorded, without rows or files. Changes: of contact states, a second. Newton: steps
//! rejected because a stage could not be solved. Residual: of the energy ledger, over the larger of work done and losses. Then what right-hand
//! side, Jacobian matrix, factorization and solution cost at the end of the last run.

use std::hint::black_box;
use std::process::ExitCode;

use benchmarks::cpu_seconds;
use benchmarks::truck::{RIGS, Rig};
use integrate::{Integrator, Method, Options, Problem};
use mechanics::system::System;

/// Simulated time, s.
const DURATION: f64 = 10.0;
/// Attempts after which a run is given up.
const MOST_STEPS: u64 = 2_000_000;

fn main() -> ExitCode {
    match measure_all() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn measure_all() -> Result<(), String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let tolerance = arguments.first().map_or("1e-5", String::as_str);
    let tolerance: f64 = tolerance
        .parse()
        .map_err(|_| format!("`{tolerance}` is no tolerance"))?;
    let part = arguments.get(1).map_or("", String::as_str);
    let methods = match arguments.get(2) {
        None => vec![Method::Rodas5P, Method::TrBdf2, Method::Esdirk3],
        Some(name) => vec![name.parse::<Method>().map_err(|error| error.to_string())?],
    };
    println!(
        "{:26} {:8} {:>8} {:>8} {:>7} {:>9} {:>9} {:>9} {:>10} {:>7} {:>8} {:>9} {:>10}",
        "truck, 10 s",
        "method",
        "steps",
        "rejected",
        "Newton",
        "rhs",
        "Jacobians",
        "factors",
        "changes/s",
        "CPU s",
        "µs/step",
        "residual",
        "column lbf"
    );
    let mut last = None;
    for rig in RIGS.iter().filter(|rig| rig.name.contains(part)) {
        for method in &methods {
            last = Some(measure(rig, *method, tolerance)?);
        }
    }
    let Some((system, time, x)) = last else {
        let names: Vec<&str> = RIGS.iter().map(|rig| rig.name).collect();
        return Err(format!(
            "no truck is called `{part}`; there are {}",
            names.join(", ")
        ));
    };
    costs(system, time, &x);
    Ok(())
}

/// Runs one truck and prints its line; returns where it ended.
fn measure(rig: &Rig, method: Method, tolerance: f64) -> Result<(System, f64, Vec<f64>), String> {
    let system = rig.system()?;
    let options = Options {
        relative_tolerance: tolerance,
        maximum_steps: MOST_STEPS,
        ..Options::of(method)
    };
    let x = system.initial_state();
    let mut observer = system.clone();
    let start = observer.observe(0.0, &x).energies.total();
    let mut integrator = Integrator::new(system, options, 0.0, &x).map_err(|error| error.to_string())?;
    let begun = cpu_seconds();
    let mut stopped = None;
    while integrator.time() < DURATION {
        if let Err(error) = integrator.step_to(DURATION) {
            stopped = Some(error.to_string());
            break;
        }
    }
    let cpu = cpu_seconds() - begun;
    let (time, x) = (integrator.time(), integrator.x().to_vec());
    observer.segment_like(integrator.problem());
    let seen = observer.observe(time, &x);
    let (work, losses) = seen
        .quadratures
        .split_first()
        .map_or((0.0, 0.0), |(work, losses)| (*work, losses.iter().sum::<f64>()));
    let residual = (seen.energies.total() - start - work + losses) / losses.max(work.abs());
    let column: f64 = seen
        .faces
        .iter()
        .zip(observer.faces())
        .find(|(_, face)| face.element.name == "column")
        .map_or(0.0, |(face, _)| {
            face.points.iter().map(|point| point.normal).sum()
        });
    let s = integrator.statistics();
    println!(
        "{:26} {:8} {:8} {:8} {:7} {:9} {:9} {:9} {:10.0} {:7.2} {:8.1} {:9.1e} {:10.0}",
        rig.name,
        method.tableau().name,
        s.steps,
        s.rejected(),
        s.rejected_unsolved,
        s.derivatives,
        s.jacobians,
        s.factorizations,
        s.events as f64 / time,
        cpu,
        1e6 * cpu / s.steps as f64,
        residual,
        column / 4.448_221_615_260_5
    );
    if let Some(error) = stopped {
        println!("  stopped at {time} s: {error}");
    }
    Ok((observer, time, x))
}

/// Prints what the parts of a step cost.
fn costs(mut system: System, time: f64, x: &[f64]) {
    let (mut dx, mut df_dt) = (vec![0.0; x.len()], vec![0.0; x.len()]);
    let mut at = time;
    let rates = cost(|| {
        at += 1e-9;
        system.derivative(at, black_box(x), &mut dx);
    });
    let jacobian = cost(|| {
        at += 1e-9;
        df_dt.fill(0.0);
        system.linearize(at, black_box(x), &dx, &mut df_dt);
    });
    let factor = cost(|| {
        black_box(system.factor(black_box(1e4)).is_ok());
    });
    let solve = cost(|| {
        df_dt.copy_from_slice(&dx);
        system.solve(black_box(&mut df_dt));
    });
    println!(
        "{} states: right-hand side {rates:.2} µs, Jacobian matrix {jacobian:.1} µs ({:.1} right-hand sides), factorization \
         {factor:.1} µs, solution {solve:.2} µs",
        x.len(),
        jacobian / rates
    );
}

/// The least of several rounds, µs a call.
fn cost(mut call: impl FnMut()) -> f64 {
    const CALLS: u32 = 1000;
    let rounds = (0..9).map(|_| {
        let begun = cpu_seconds();
        for _ in 0..CALLS {
            call();
        }
        1e6 * (cpu_seconds() - begun) / f64::from(CALLS)
    });
    rounds.fold(f64::INFINITY, f64::min)
}
