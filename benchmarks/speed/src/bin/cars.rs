//! `cars [NAME-PART|all] [STEPS] [METHOD]`: the built-in cars and regimes, empty and loaded: what a run
//! costs, and how far its statistics are from those at 1e-7.
//!
//! CPU times of one thread, with rows and statistics, without files. The run at 1e-7 (by METHOD, else by
//! ESDIRK3) ends where the run at the default tolerance has made STEPS steps; with 0 there is none.
//!
//! `cars threads N`: a study of four runs on so many threads.

use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use benchmarks::cars::{self, COLUMNS, Errors, Listed, Measured};
use benchmarks::exit;
use cpu_time::ProcessTime;
use integrate::Method;
use study::design::Study;
use study::records::{self, Status};

/// Steps of a run until which its statistics are compared.
const STEPS: u64 = 2500;

/// The study of four runs.
const STUDY: &str = "
case = \"car_tangent_loaded\"
sampling = \"full_factorial\"
accuracy = \"case\"
[set]
simulation.duration = \"10 s\"
[vary]
\"speed.value\" = [\"40 mph\", \"45 mph\", \"50 mph\", \"55 mph\"]
";

fn main() -> ExitCode {
    exit(measure_all())
}

fn measure_all() -> Result<(), String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let part = arguments.first().map_or("all", String::as_str);
    let number = |place: usize, least: u64| match arguments.get(place) {
        None => Ok(least),
        Some(text) => text.parse().map_err(|_| format!("`{text}` is no whole number")),
    };
    if part == "threads" {
        return threads(number(1, 1)?);
    }
    let steps = number(1, STEPS)?;
    let method = match arguments.get(2) {
        None => Method::Esdirk3,
        Some(name) => name.parse::<Method>().map_err(|error| error.to_string())?,
    };
    println!(
        "{:33} {:>5} {:>6} {:9} {:>6} {:>7} {:>7} {:>8} {:>8} {:>7} {:>9} {:>6} | {:>5} {:>7} {}",
        "run",
        "mph",
        "s",
        "method",
        "start",
        "CPU s/s",
        "steps/s",
        "matrix/s",
        "rhs/s",
        "event/s",
        "residual",
        "MB",
        "until",
        "CPU s/s",
        COLUMNS.map(|(name, _, _)| format!("{name:>8}")).concat() + "   median     95 %"
    );
    for listed in cars::all()? {
        let chosen = match part {
            "all" => true,
            "loaded" => !listed.is_empty(),
            "empty" => listed.is_empty(),
            part => listed.name.contains(part),
        };
        if chosen {
            measure(&listed, steps, method)?;
        }
    }
    Ok(())
}

/// Measures a run and prints its line.
fn measure(listed: &Listed, steps: u64, method: Method) -> Result<(), String> {
    let case = &listed.case;
    let whole = cars::measure(case, steps)?;
    if steps == 0 {
        println!("{}", cost(listed, &whole));
        return Ok(());
    }
    let until = cars::compared(case, whole.reached);
    let reference = cars::measure(&cars::tight(&cars::until(case, until), method), 0)?;
    let part = if until < whole.time {
        Some(cars::measure(&cars::until(case, until), 0)?)
    } else {
        None
    };
    let found = &part.as_ref().unwrap_or(&whole).summary.statistics;
    let errors = cars::errors(found, &reference.summary.statistics);
    println!("{} | {}", cost(listed, &whole), deviation(&reference, &errors));
    Ok(())
}

/// Returns what a run cost.
fn cost(listed: &Listed, own: &Measured) -> String {
    let solver = &own.summary.solver;
    let rate = |count: u64| count as f64 / own.time;
    let memory = own.memory.map_or("-".to_owned(), |memory| format!("{memory:.0}"));
    let ended = if own.summary.complete {
        ""
    } else {
        " (not complete)"
    };
    format!(
        "{:33} {:5.1} {:6.1} {:9} {:6.2} {:7.3} {:7.0} {:8.0} {:8.0} {:7.0} {:9.1e} {memory:>6}{ended}",
        listed.name,
        listed.speed,
        own.time,
        own.summary.method,
        own.start,
        own.cpu / own.time,
        rate(solver.steps),
        rate(solver.jacobians),
        rate(solver.derivatives),
        rate(solver.events),
        own.summary.ledger.largest_relative_residual,
    )
}

/// Returns the errors of statistics beside the reference.
fn deviation(reference: &Measured, errors: &Errors) -> String {
    let cell = |error: &Option<f64>| error.map_or(format!("{:>8}", "-"), |error| format!("{error:8.2}"));
    let cells: String = errors.columns.iter().map(cell).collect();
    let all: Vec<String> = errors.all.iter().map(cell).collect();
    let ended = if reference.summary.complete {
        ""
    } else {
        " (reference not complete)"
    };
    let costs = reference.cpu / reference.time;
    format!(
        "{:5.1} {costs:7.2} {cells} {}{ended}",
        reference.time,
        all.join(" ")
    )
}

/// Runs the study on so many threads.
fn threads(count: u64) -> Result<(), String> {
    let study = Study::parse("four_cars.toml", STUDY, Path::new("")).map_err(|error| error.to_string())?;
    let (next, failed) = (AtomicU64::new(0), AtomicU64::new(0));
    let (wall, cpu) = (Instant::now(), ProcessTime::now());
    let worker = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= study.count() {
                return;
            }
            if records::run(&study, number).status != Status::Complete {
                failed.fetch_add(1, Ordering::Relaxed);
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..count.max(1) {
            scope.spawn(worker);
        }
    });
    let (wall, cpu) = (wall.elapsed().as_secs_f64(), cpu.elapsed().as_secs_f64());
    let memory = cars::most_memory().map_or(String::new(), |memory| format!(", most memory {memory:.0} MB"));
    println!(
        "{} runs on {count} threads: {wall:.1} s, {cpu:.1} s of CPU{memory}",
        study.count()
    );
    match failed.into_inner() {
        0 => Ok(()),
        failed => Err(format!("{failed} of {} runs failed", study.count())),
    }
}
