//! The twelve runs of the thesis's table 4-1 on one core: wall time, steps, what came out.
//!
//! `thesis_runs [METHOD] [TOLERANCE] [NAME-PART]`, for example `thesis_runs rodas5p 1e-5 psi_0.012`. Times
//! are those of integration, events and output rows, without writing files.

use std::process::ExitCode;
use std::time::Instant;

use study::case::builtin;
use study::run::Run;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut overrides = Vec::new();
    if let Some(method) = arguments.first() {
        overrides.push(format!("simulation.method={method:?}"));
    }
    if let Some(tolerance) = arguments.get(1) {
        overrides.push(format!("simulation.relative_tolerance={tolerance}"));
    }
    let part = arguments.get(2).map_or("", String::as_str);
    println!("Wall times on a machine that does other things too: trust ratios within one run.");
    println!(
        "{:26} {:>9} {:>9} {:>10} {:>10} {:>8} {:>8} {:>8} {:>8}",
        "run", "up lbf", "down lbf", "lbf·in", "residual", "steps", "explicit", "rejected", "ms"
    );
    let mut total = 0.0;
    for name in builtin::thesis_names().filter(|name| name.contains(part)) {
        let case = match builtin::case_with(name, &overrides) {
            Ok(case) => case,
            Err(error) => {
                eprintln!("{error}");
                return ExitCode::from(2);
            }
        };
        let clock = Instant::now();
        let run = match Run::new(&case) {
            Ok(run) => run,
            Err(error) => {
                eprintln!("{name}: {error}");
                return ExitCode::from(1);
            }
        };
        let summary = run.finish(|_| ()).summary;
        let wall = clock.elapsed().as_secs_f64();
        total += wall;
        let mean = |branch: &std::collections::BTreeMap<String, study::summary::SummaryValue>| {
            branch
                .get("vertical_wedge_force")
                .map_or(f64::NAN, |measure| measure.value)
        };
        let energy = summary
            .averages
            .energy_per_cycle
            .get("side_frame")
            .map_or(f64::NAN, |e| e.value);
        let statistics = &summary.solver.statistics;
        println!(
            "{name:26} {:9.1} {:9.1} {energy:10.1} {:10.1e} {:8} {:8} {:8} {:8.1}",
            mean(&summary.averages.up),
            mean(&summary.averages.down),
            summary.ledger.largest_relative_residual,
            statistics.steps,
            statistics.explicit_steps,
            statistics.rejected(),
            wall * 1e3
        );
    }
    println!("all {:.2} s", total);
    ExitCode::SUCCESS
}
