//! The half-truck of the comparison program's files on one core: 20 s of motion, 18 coordinates, 48 to 50
//! connections.
//!
//! `half_truck [TOLERANCE] [NAME-PART]`, for example `half_truck 1e-5 69_constant`. Times are those of
//! integration, events and output rows each 0.01 s, without writing files; the target is 1 s a run at 1e-5.
//! Then the CPU time that the right-hand side, the Jacobian, a factorization and a solution take in a sliding
//! state; the target is a Jacobian of at most 10 right-hand sides.

use std::process::ExitCode;
use std::time::Instant;

use benchmarks::{costs, exit, sliding_truck};
use integrate::Problem;
use nucars::truck::Choices;
use study::half_truck::catalog::{DURATION, entries};
use study::half_truck::run::run;

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
    println!("Wall times on a machine that does other things too: trust ratios within one run.");
    println!(
        "{:42} {:>8} {:>8} {:>8} {:>8} {:>10}",
        "run, 20 s", "ms", "steps", "rejected", "events", "residual"
    );
    for entry in entries().into_iter().filter(|entry| entry.name().contains(part)) {
        let mut case = entry
            .case(&Choices::default(), DURATION)
            .map_err(|error| error.to_string())?;
        case.relative_tolerance = tolerance;
        let clock = Instant::now();
        let summary = run(&case, |_| ()).map_err(|error| error.to_string())?.summary;
        let wall = clock.elapsed().as_secs_f64();
        let statistics = &summary.statistics;
        println!(
            "{:42} {:8.1} {:8} {:8} {:8} {:10.1e}",
            summary.name,
            wall * 1e3,
            statistics.steps,
            statistics.rejected(),
            statistics.events,
            summary.largest_relative_residual
        );
    }
    for name in ["nucars_68_constant_toe_out", "nucars_69_constant_toe_out"] {
        let (mut system, x) = sliding_truck(name)?;
        system.next_time_discontinuity(0.0);
        let [derivative, jacobian, factor, solve] = costs(&mut system, 2.0, &x, 1e4, 2000);
        println!(
            "{name}: right-hand side {derivative:.2} us, Jacobian {jacobian:.2} us (ratio {:.1}), factor \
             {factor:.2} us, solve {solve:.2} us",
            jacobian / derivative
        );
    }
    Ok(())
}
