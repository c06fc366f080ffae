//! `wedge_count [MOST]`: how the cost of a step grows with the number of wedges in one system, uncoupled and
//! in a chain, and of the free bodies that the chain has beside its wedges: the chain less these is what a
//! wedge between two free bodies costs. `wedge_count uncoupled|chained|supports COUNT STEPS [recorded]`:
//! these steps of one system alone, contact states recorded or not, to count instructions.
//!
//! CPU times. A step is one of Rodas5P of a fixed length (10 µs) of the first 4 ms, the least of several
//! runs: with and without the recording of contact states. Pieces: right-hand side, Jacobian matrix,
//! factorization, solution, in the state that the last step ended in.

use std::process::ExitCode;

use benchmarks::wedges::{Arrangement, wedges};
use benchmarks::{costs, exit};
use cpu_time::ProcessTime;
use integrate::{Integrator, Options, Problem};
use mechanics::system::System;

const COUNTS: [usize; 8] = [1, 2, 5, 10, 20, 50, 100, 200];
/// Length of a step, s.
const STEP: f64 = 1e-5;
/// Steps of a run.
const STEPS: u32 = 400;
/// Runs: as many as give this many wedges in all, and three.
const WEDGES: usize = 200;

const USAGE: &str =
    "usage: wedge_count [MOST], or wedge_count uncoupled|chained|supports COUNT STEPS [recorded]";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    exit(match words.as_slice() {
        [] => table(usize::MAX),
        [most] => most.parse().map_err(|_| USAGE.to_owned()).and_then(table),
        [arrangement, count, number] => one(arrangement, count, number, false),
        [arrangement, count, number, "recorded"] => one(arrangement, count, number, true),
        _ => Err(USAGE.to_owned()),
    })
}

/// Steps of one system alone.
fn one(arrangement: &str, count: &str, number: &str, recorded: bool) -> Result<(), String> {
    let arrangement = match arrangement {
        "uncoupled" => Arrangement::Uncoupled,
        "chained" => Arrangement::Chained,
        "supports" => Arrangement::Supports,
        _ => return Err(USAGE.to_owned()),
    };
    let (Ok(count), Ok(number)) = (count.parse(), number.parse()) else {
        return Err(USAGE.to_owned());
    };
    let system = wedges(count, arrangement)?;
    // Without the clock, which stops Valgrind.
    advance(&mut begin(&system, recorded)?, number)
}

/// Prints the costs of all systems up to this number of wedges.
fn table(most: usize) -> Result<(), String> {
    println!(
        "CPU times, µs, each divided by the number of wedges; events: changes of contact modes a step and \
         wedge."
    );
    println!("Step: contact modes not recorded; recorded: with them.");
    for arrangement in [
        Arrangement::Uncoupled,
        Arrangement::Chained,
        Arrangement::Supports,
    ] {
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
            println!("{:12} {count:>6} {}", "", measure(count, arrangement)?);
        }
    }
    Ok(())
}

/// Returns the costs of one system.
fn measure(count: usize, arrangement: Arrangement) -> Result<String, String> {
    let mut system = wedges(count, arrangement)?;
    let (mut recorded, mut bare) = (f64::INFINITY, f64::INFINITY);
    let (mut events, mut end) = (0, Vec::new());
    for _ in 0..(WEDGES / count).max(3) {
        let mut cost;
        (cost, _, _) = steps(&system, false)?;
        bare = bare.min(cost);
        (cost, events, end) = steps(&system, true)?;
        recorded = recorded.min(cost);
    }
    system.next_time_discontinuity(0.0);
    let calls = (20_000 / end.len()).max(20);
    let [rates, jacobian, factor, solve] = costs(&mut system, 0.1, &end, 1e5, calls);
    let each = [bare, recorded, rates, jacobian, factor, solve].map(|cost| cost / count as f64);
    let events = events as f64 / f64::from(STEPS) / count as f64;
    let [bare, recorded, rates, jacobian, factor, solve] = each;
    Ok(format!(
        "{bare:>10.2} {recorded:>10.2} {events:>8.4} {rates:>10.3} {jacobian:>10.3} {factor:>10.3} \
         {solve:>10.3}"
    ))
}

/// Returns the mean cost of a step, µs, the number of events, and the state at the end.
fn steps(system: &System, recorded: bool) -> Result<(f64, u64, Vec<f64>), String> {
    let mut integrator = begin(system, recorded)?;
    let start = ProcessTime::now();
    advance(&mut integrator, STEPS)?;
    let cost = 1e6 * start.elapsed().as_secs_f64() / f64::from(STEPS);
    Ok((cost, integrator.statistics().events, integrator.x().to_vec()))
}

fn begin(system: &System, recorded: bool) -> Result<Integrator<System>, String> {
    let options = Options {
        fixed_step: Some(STEP),
        explicit_steps: false,
        record_events: recorded,
        ..Options::default()
    };
    Integrator::new(system.clone(), options, 0.0, &system.initial_state()).map_err(|error| error.to_string())
}

fn advance(integrator: &mut Integrator<System>, number: u32) -> Result<(), String> {
    for _ in 0..number {
        integrator
            .step_to(f64::INFINITY)
            .map_err(|error| error.to_string())?;
    }
    Ok(())
}
