//! `car [SECONDS]`: a loaded freight car on track on one core: tangent of FRA class 6 at 60 km/h and curves,
//! with wedges that are bodies and with massless ones.
//!
//! CPU times of integration with contact states recorded, without rows or files. Real time: seconds of the
//! car a second of CPU time. Newton: steps rejected because a stage could not be solved. Changes: of contact
//! states, a second of the car. Residual: the relative residual of the energy ledger, each 0.05 s. At the end
//! what one evaluation costs, and the most memory that the process held.

use std::process::ExitCode;

use benchmarks::{costs, exit};
use car::Car;
use cpu_time::ProcessTime;
use integrate::{Integrator, Method, Options};
use mechanics::energy_balance::EnergyBalance;
use mechanics::system::System;
use study::car::CarCase;
use study::case::Tables;

/// The ledger is looked at each so many seconds.
const INTERVAL: f64 = 0.05;

/// Tangent with all four irregularities of class 6, and its speed.
fn class_6() -> String {
    let spectra = [
        ("fra_lateral", "both", "lateral"),
        ("fra_cross_level", "against", "lateral"),
        ("fra_vertical", "both", "vertical"),
        ("fra_cross_level", "against", "vertical"),
    ];
    let irregularities = (1..).zip(spectra).map(|(seed, (spectrum, rails, direction))| {
        format!(
            "[[track.irregularities]]\nspectrum = \"{spectrum}\"\nclass = 6\nrails = \"{rails}\"\n\
             direction = \"{direction}\"\nseed = {seed}\n"
        )
    });
    let tangent = "speed.value = \"60 km/h\"\n[[track.segments]]\ntangent = \"600 m\"\n";
    std::iter::once(tangent.to_owned())
        .chain(irregularities)
        .collect()
}

/// Into a curve, smooth.
const CURVE: &str = "
speed.value = \"40 km/h\"
[[track.segments]]
tangent = \"60 m\"
[[track.segments]]
spiral = \"60 m\"
[[track.segments]]
curve = \"400 m\"
degree = \"DEGREE deg\"
direction = \"left\"
superelevation = \"4 in\"
";

/// Dynamic curving: low joints every 39 ft of a curve, staggered.
fn joints() -> String {
    let of = |(rails, start)| {
        format!(
            "[[track.irregularities]]\nshape = \"joints\"\nrails = \"{rails}\"\ndirection = \"vertical\"\n\
             depth = \"0.5 in\"\nspacing = \"39 ft\"\njoints = 10\nstart = \"{start} ft\"\n"
        )
    };
    [("left", 400.0), ("right", 419.5)].map(of).concat()
}

fn main() -> ExitCode {
    exit(measure_all())
}

fn measure_all() -> Result<(), String> {
    let seconds = std::env::args().nth(1);
    let seconds = seconds.as_deref().unwrap_or("20");
    let duration: f64 = seconds
        .parse()
        .map_err(|_| format!("`{seconds}` is no number of seconds"))?;
    let curve = |degree: &str| CURVE.replace("DEGREE", degree);
    let (fast, exact) = ((Method::TrBdf2, 1e-4), (Method::Esdirk3, 2e-6));
    let class_6 = class_6();
    let joints = format!("{}{}", curve("10"), joints());
    let runs = [
        ("tangent, class 6, wedge bodies", &class_6, "body", fast),
        ("tangent, class 6, massless wedges", &class_6, "massless", fast),
        ("tangent, class 6, wedge bodies", &class_6, "body", exact),
        ("tangent, class 6, massless wedges", &class_6, "massless", exact),
        ("curve of 7.5 deg, wedge bodies", &curve("7.5"), "body", fast),
        (
            "curve of 7.5 deg, massless wedges",
            &curve("7.5"),
            "massless",
            fast,
        ),
        ("dynamic curve of 10 deg, wedge bodies", &joints, "body", fast),
        (
            "dynamic curve of 10 deg, massless wedges",
            &joints,
            "massless",
            fast,
        ),
        ("curve of 12 deg, wedge bodies", &curve("12"), "body", fast),
    ];
    println!(
        "{:40} {:8} {:>9} {:>6} {:>8} {:>6} {:>7} {:>9} {:>9} {:>9} {:>6} {:>9} {:>9}",
        "run",
        "method",
        "tolerance",
        "steps",
        "rejected",
        "Newton",
        "rhs",
        "Jacobians",
        "factors",
        "changes/s",
        "CPU s",
        "real time",
        "residual"
    );
    for (name, track, wedges, (method, tolerance)) in runs {
        let text = format!("model = \"car\"\n{track}");
        let chosen = [format!("truck.wedge.kind={wedges}")];
        let case = CarCase::parse("car.toml", &text, Tables::nowhere(), &chosen)
            .map_err(|error| error.to_string())?;
        let car = Car::new(&case.parameters).map_err(|error| error.to_string())?;
        let (mut system, x) = measure(name, &car, duration, method, tolerance)?;
        if name.starts_with("tangent") && method == Method::TrBdf2 {
            let [rates, jacobian, factor, solve] = costs(&mut system, duration, &x, 1e3, 200);
            println!(
                "  {} states: right-hand side {rates:.1} µs, Jacobian matrix {jacobian:.0} µs, factorization \
                 {factor:.1} µs, solution {solve:.1} µs",
                x.len()
            );
        }
    }
    if let Some(memory) = most_memory() {
        println!("most memory of the process: {memory}");
    }
    Ok(())
}

/// Runs a car and prints its line; returns where it ended.
fn measure(
    name: &str,
    car: &Car,
    duration: f64,
    method: Method,
    tolerance: f64,
) -> Result<(System, Vec<f64>), String> {
    let x = car.initial_state.clone();
    let options = Options {
        relative_tolerance: tolerance,
        ..Options::of(method)
    };
    let mut observer = car.system.clone();
    let start = observer.observe(0.0, &x).energies.total();
    let integrator = Integrator::new(car.system.clone(), options, 0.0, &x);
    let mut integrator = integrator.map_err(|error| error.to_string())?;
    let (mut balance, mut buffer) = (EnergyBalance::new(start), x.clone());
    let (mut row, mut observing, start_of_run) = (1.0, 0.0, ProcessTime::now());
    while integrator.time() < duration {
        integrator.step_to(duration).map_err(|error| error.to_string())?;
        while row * INTERVAL <= integrator.time() {
            let start_of_row = ProcessTime::now();
            integrator.interpolate(row * INTERVAL, &mut buffer);
            observer.segment_like(integrator.problem());
            let seen = observer.observe(row * INTERVAL, &buffer);
            balance.note(row * INTERVAL, &observer.ledger_entries(&seen, start));
            row += 1.0;
            observing += start_of_row.elapsed().as_secs_f64();
        }
    }
    let cpu = start_of_run.elapsed().as_secs_f64() - observing;
    let s = integrator.statistics();
    println!(
        "{name:40} {:8} {tolerance:9.0e} {:6} {:8} {:6} {:7} {:9} {:9} {:9.0} {cpu:6.2} {:9.1} {:9.1e}",
        method.tableau().name,
        s.steps,
        s.rejected(),
        s.rejected_newton,
        s.derivatives,
        s.jacobians,
        s.factorizations,
        s.events as f64 / duration,
        duration / cpu,
        balance.relative_residual()
    );
    Ok((observer, integrator.x().to_vec()))
}

/// Returns the most memory that this process has held, where the system tells it.
fn most_memory() -> Option<String> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.trim().trim_end_matches(" kB").parse().ok()?;
    Some(format!("{:.0} MB", kilobytes / 1024.0))
}
