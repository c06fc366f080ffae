//! The number of yawed runs that a study computes in a second on one core, and the distance of its branch
//! means from those of a tight tolerance.
//!
//! `study_rate [TOLERANCE] [OUTPUT-INTERVAL] [METHOD] [REPEATS]`, for example
//! `study_rate 1.5e-5 "0.01 s" tr-bdf2 5` for engineering accuracy. Errors are against relative tolerance
//! 1e-9 with the case's own output interval. Then the rate of a small study, four variants of friction of
//! each case.

use std::process::ExitCode;
use std::time::Instant;

use study::case::{Case, builtin};
use study::measures::{Measures, measure, of_wedges};

/// Returns true for the metrics that are compared: means over branches, energies, equivalent stiffness and
/// damping.
fn compared(name: &str) -> bool {
    name.starts_with("mean_vertical_wedge")
        || name.starts_with("mean_long")
        || name.starts_with("energy")
        || name.starts_with("equivalent")
}

fn run(name: &str, set: &[String]) -> Result<(Measures, Case), String> {
    let case = builtin::case_with(name, set).map_err(|error| error.to_string())?;
    let measures = measure(&case).map_err(|error| format!("{name}: {error:?}"))?;
    Ok((measures, case))
}

fn main() -> ExitCode {
    match rate() {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("{reason}");
            ExitCode::FAILURE
        }
    }
}

fn rate() -> Result<(), String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let keys = ["relative_tolerance", "output_interval", "method"];
    let set: Vec<String> = keys
        .iter()
        .zip(&arguments)
        .map(|(key, value)| format!("simulation.{key}={value}"))
        .collect();
    let repeats: u32 = arguments.get(3).and_then(|text| text.parse().ok()).unwrap_or(3);
    let tight = ["simulation.relative_tolerance=1e-9".to_owned()];
    let mut total = 0.0;
    let mut runs = 0;
    for name in builtin::thesis_names().filter(|name| name.ends_with("psi_0.012")) {
        let (reference, _) = run(name, &tight)?;
        let (found, case) = run(name, &set)?;
        let clock = Instant::now();
        for _ in 0..repeats {
            measure(&case).map_err(|error| format!("{error:?}"))?;
        }
        let wall = clock.elapsed().as_secs_f64() / f64::from(repeats);
        total += wall;
        runs += 1;
        print!(
            "{name:26} {:6.2} ms {:6} steps ",
            wall * 1e3,
            of_wedges().get(&found, "steps").unwrap_or(0.0)
        );
        for (number, definition) in of_wedges().iter().enumerate() {
            if compared(&definition.name) {
                let error = found.0[number] / reference.0[number] - 1.0;
                print!(" {:+.2}%", 100.0 * error);
            }
        }
        println!();
    }
    println!("{:.0} runs/s on one core", f64::from(runs) / total);
    variants(&set, repeats)
}

/// Measures the rate of variants.
fn variants(set: &[String], repeats: u32) -> Result<(), String> {
    let mut cases = Vec::new();
    for name in builtin::thesis_names().filter(|name| name.ends_with("psi_0.012")) {
        for friction in ["0.35", "0.38", "0.42", "0.45"] {
            let own = ["column", "slope"].map(|face| format!("friction.{face}={friction}"));
            let set: Vec<String> = set.iter().chain(&own).cloned().collect();
            cases.push(builtin::case_with(name, &set).map_err(|error| error.to_string())?);
        }
    }
    // The shortest time: other programs may run beside this one.
    let mut shortest = f64::INFINITY;
    for _ in 0..repeats.max(1) {
        let clock = Instant::now();
        for case in &cases {
            measure(case).map_err(|error| format!("{error:?}"))?;
        }
        shortest = shortest.min(clock.elapsed().as_secs_f64());
    }
    println!(
        "{} variants: {:.0} runs/s",
        cases.len(),
        cases.len() as f64 / shortest
    );
    Ok(())
}
