//! `truck [TOLERANCE] [NAME-PART] [METHOD]`: the rigs of the three-piece truck on one core, for example
//! `truck 1e-5 vertical esdirk3`.
//!
//! CPU times of integration with contact states recorded, without rows or files. Changes: of contact states,
//! a second. Newton: steps rejected because a stage could not be solved. Residual: the relative residual of
//! the energy ledger, each 0.05 s. Then what right-hand side, Jacobian matrix, factorization and solution
//! cost at the end of the last run.

use std::process::ExitCode;

use benchmarks::{costs, exit, ledger};
use cpu_time::ProcessTime;
use integrate::{Integrator, Method, Options};
use mechanics::energy_balance::EnergyBalance;
use mechanics::system::System;
use study::truck::{TruckCase, builtin};
use truck::Truck;

/// lbf, in N.
const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// The ledger is looked at each so many seconds.
const INTERVAL: f64 = 0.05;
/// Attempts after which a run is given up.
const MOST_STEPS: u64 = 2_000_000;

fn main() -> ExitCode {
    exit(measure_all())
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
        "{:34} {:8} {:>8} {:>8} {:>7} {:>9} {:>9} {:>9} {:>10} {:>7} {:>8} {:>9} {:>10}",
        "rig",
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
    // Without a part of a name, the loaded rigs.
    let loaded = builtin::groups().iter().take(1).flat_map(|group| &group.cases);
    let loaded: Vec<&str> = loaded.map(|case| case.name.as_str()).collect();
    let chosen = builtin::names().filter(|name| {
        if part.is_empty() {
            loaded.contains(name)
        } else {
            name.contains(part)
        }
    });
    for name in chosen {
        let case = builtin::case_with(name, &[]).map_err(|error| error.to_string())?;
        for method in &methods {
            last = Some(measure(&case, *method, tolerance)?);
        }
    }
    let Some((mut system, time, x)) = last else {
        let names: Vec<&str> = builtin::names().collect();
        return Err(format!(
            "no truck is called `{part}`; there are {}",
            names.join(", ")
        ));
    };
    let [rates, jacobian, factor, solve] = costs(&mut system, time, &x, 1e4, 1000);
    println!(
        "{} states: right-hand side {rates:.2} µs, Jacobian matrix {jacobian:.1} µs ({:.1} right-hand \
         sides), factorization {factor:.1} µs, solution {solve:.2} µs",
        x.len(),
        jacobian / rates
    );
    Ok(())
}

/// Runs one truck and prints its line; returns where it ended.
fn measure(case: &TruckCase, method: Method, tolerance: f64) -> Result<(System, f64, Vec<f64>), String> {
    let truck = Truck::new(&case.parameters).map_err(|error| error.to_string())?;
    let system = truck.system.clone();
    let options = Options {
        relative_tolerance: tolerance,
        maximum_steps: MOST_STEPS,
        ..Options::of(method)
    };
    let x = truck.initial_state.clone();
    let duration = case.simulation.duration;
    let mut observer = system.clone();
    let start = observer.observe(0.0, &x).energies.total();
    let mut integrator = Integrator::new(system, options, 0.0, &x).map_err(|error| error.to_string())?;
    let start_of_run = ProcessTime::now();
    let (mut stopped, mut balance) = (None, EnergyBalance::new(start));
    let (mut row, mut buffer, mut observing) = (1.0, x.clone(), 0.0);
    while integrator.time() < duration {
        if let Err(error) = integrator.step_to(duration) {
            stopped = Some(error.to_string());
            break;
        }
        while row * INTERVAL <= integrator.time() {
            let start_of_row = ProcessTime::now();
            integrator.interpolate(row * INTERVAL, &mut buffer);
            observer.segment_like(integrator.problem());
            let observation = observer.observe(row * INTERVAL, &buffer);
            balance.note(row * INTERVAL, &ledger(&observation, start));
            row += 1.0;
            observing += start_of_row.elapsed().as_secs_f64();
        }
    }
    let cpu = start_of_run.elapsed().as_secs_f64() - observing;
    let (time, x) = (integrator.time(), integrator.x().to_vec());
    observer.segment_like(integrator.problem());
    let observation = observer.observe(time, &x);
    let residual = balance.relative_residual();
    let column = truck.loads(&observation).wedges[0].column_normal;
    let s = integrator.statistics();
    println!(
        "{:34} {:8} {:8} {:8} {:7} {:9} {:9} {:9} {:10.0} {:7.2} {:8.1} {:9.1e} {:10.0}",
        case.name,
        method.tableau().name,
        s.steps,
        s.rejected(),
        s.rejected_newton,
        s.derivatives,
        s.jacobians,
        s.factorizations,
        s.events as f64 / time,
        cpu,
        1e6 * cpu / s.steps as f64,
        residual,
        column / POUND_FORCE
    );
    if let Some(error) = stopped {
        println!("  stopped at {time} s: {error}");
    }
    Ok((observer, time, x))
}
