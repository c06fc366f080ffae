//! `cargo xtask bench cars`: the built-in cars and regimes beside an explicit program; writes
//! `docs/benchmarks-cars.md`. Nobody edits the page.

use std::fmt::Write;
use std::fs::File;
use std::path::Path;
use std::process::Command;

use crate::machine::Machine;
use crate::shell::{self, Workspace};

/// What another explicit program needed on its machine, CPU seconds a second of car.
const OTHERS: f64 = 0.31;

/// The text before all numbers.
const ABOUT: &str = "\
# Benchmarks of cars

What runs of the built-in cars cost, on every built-in regime, loaded and empty, and how accurate their \
statistics are; beside them an explicit program as a yardstick. `cargo xtask bench cars` measures \
everything and writes this page; its text is in `xtask/src/bench/cars.rs`: edit it there. Wedges, trucks \
and single evaluations: [benchmarks.md](benchmarks.md).

## How to read it

- CPU seconds a second of the car, of one thread, with rows and statistics, without files. Loaded cars are \
measured beside empty ones, the explicit program by itself, unless the line below says otherwise; other \
programs beside them make CPU times longer, too.
- Method and tolerance are those of the case: `tr-bdf2` at 1e-4 unless the regime sets others.
- Names with `car_` are built-in cars. Others are the regime with the other lading, or `hunting` at a held \
speed; the speed is that of the built-in car of the regime.
- A run that is marked \"not complete\" derailed or stopped; its numbers are those of the part until then.
";

const COSTS: &str = "\
Speed at the start and length of the run; CPU time of the start (equilibrium; regimes also shake the car \
for 6 s, once a program for runs whose cars and rails are alike: 4 to 8 s); then for each second of \
the car CPU time, accepted steps, Jacobian matrices, right-hand sides, changes of contact states; the \
relative residual of the energy ledger; the most memory of the process.";

const ERRORS: &str = "\
Differences of statistics from those of a run by ESDIRK3 at a relative tolerance of 1e-7, in % of the \
largest of their kind, of wheel loads in % of the static one: filtered values where there are such. \
Columns: roll of the body (greatest less least); rms of vertical and lateral accelerations at the truck \
centers; their greatest less least values; least wheel load and largest L/V that last for 50 ms; median and \
95 % value over all statistics. What is very small is nothing: accelerations are related to 0.01 g at \
least, L/V to 0.05, roll to 1 mrad, forces to 500 lbf. Both runs are compared until the time in the first \
column, at which the run at the default tolerance has made 2,500 steps: runs at 1e-7 would take an hour \
otherwise. Friction that sticks and slips makes histories diverge: an error is that of one realization.";

const EXPLICIT: &str = "\
`benchmarks/speed/src/explicit`: 19 rigid bodies with all motions (car body, bolsters, side frames, eight \
wedges, wheelsets), the classical Runge-Kutta method at 8e-5 s, sliders at four points of each face of a \
wedge, coned wheels with Hertz's and Kalker's forces on rails that do not give way; weights, stiffnesses \
and friction of the built-in cars, 50 mph. It has no curves, no profiles, no rails that give way, no \
events, no error control and no ledger; its head lists what is simplified. Smooth: perfect track. Rough: \
four waves of 5 to 15 mm. The last three columns are a sign that it is a car of the same kind.";

const THREADS: &str = "\
A study of four runs, `car_tangent_loaded` at 40 to 55 mph for 10 s each.";

/// Names of what is measured, which are those of the files that it is kept in, with the programs.
const MEASURED: [(&str, &[&str]); 5] = [
    ("explicit", &["explicit_car"]),
    ("loaded", &["cars", "loaded"]),
    ("empty", &["cars", "empty"]),
    ("threads_1", &["cars", "threads", "1"]),
    ("threads_2", &["cars", "threads", "2"]),
];

/// Measures, and writes the page; `--page` only writes it, `--quick` only shows a few runs.
///
/// # Errors
/// A program does not compile or fails, or the page cannot be written.
pub fn run(workspace: &Workspace, arguments: &[String]) -> Result<(), String> {
    let folder = workspace.target.join("bench-cars");
    match arguments {
        [only] if only == "--page" => return write_page(workspace, &folder),
        [] => {}
        [only] if only == "--quick" => {}
        [other, ..] => {
            return Err(format!(
                "`bench cars` knows `--quick` and `--page`, not `{other}`"
            ));
        }
    }
    let build = ["build", "--release", "--package", "benchmarks", "--bins"];
    shell::run(&mut workspace.cargo(build))?;
    let command = |words: &[&str]| {
        let mut command = Command::new(workspace.target.join("release").join(words[0]));
        command.args(&words[1..]);
        command
    };
    if !arguments.is_empty() {
        shell::run(&mut command(&["explicit_car", "2"]))?;
        return shell::run(&mut command(&["cars", "tangent", "300"]));
    }
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    keep(
        &folder,
        "load",
        load.split_whitespace().next().unwrap_or("unknown"),
    )?;
    // Lines are kept as they come, for who looks at them meanwhile.
    let measure = |(name, words): (&str, &[&str])| {
        let file = folder.join(format!("{name}.txt"));
        println!("{} ...", file.display());
        let out = File::create(&file).map_err(|error| format!("{}: {error}", file.display()))?;
        let status = command(words).stdout(out).status();
        let status = status.map_err(|error| format!("{}: {error}", words.join(" ")))?;
        let failed = || format!("{}: {status}", words.join(" "));
        status.success().then_some(()).ok_or_else(failed)
    };
    let [explicit, loaded, empty, one, two] = MEASURED;
    measure(explicit)?;
    std::thread::scope(|scope| {
        let beside = scope.spawn(|| measure(loaded));
        let empty = measure(empty);
        let loaded = beside.join();
        loaded
            .unwrap_or_else(|_| Err("a measurement failed".to_owned()))
            .and(empty)
    })?;
    measure(one)?;
    measure(two)?;
    write_page(workspace, &folder)
}

/// Writes a text into a file of the measurement.
fn keep(folder: &Path, name: &str, text: &str) -> Result<(), String> {
    let file = folder.join(format!("{name}.txt"));
    std::fs::write(&file, text).map_err(|error| format!("{}: {error}", file.display()))
}

/// Writes the page from what was kept, with a remark on the measurement if there is one (`remark.txt`).
fn write_page(workspace: &Workspace, folder: &Path) -> Result<(), String> {
    let read = |name: &str| {
        let file = folder.join(format!("{name}.txt"));
        std::fs::read_to_string(&file).map_err(|error| {
            format!(
                "{}: {error}; `cargo xtask bench cars` measures it",
                file.display()
            )
        })
    };
    let rows = read("empty")?;
    let rows = rows.split_once('\n').map_or("", |(_, rows)| rows);
    let cars = read("loaded")? + rows;
    let threads = read("threads_1")? + &read("threads_2")?;
    // What else ran meanwhile, by who measured.
    let load = read("load")? + &read("remark").map_or(String::new(), |remark| format!("; {}", remark.trim()));
    let text = page(&Machine::here(), &load, &read("explicit")?, &cars, &threads);
    let file = workspace.root.join("docs").join("benchmarks-cars.md");
    std::fs::write(&file, text).map_err(|error| format!("cannot write {}: {error}", file.display()))?;
    println!("{}", file.display());
    Ok(())
}

/// Returns the page.
fn page(machine: &Machine, load: &str, explicit: &str, cars: &str, threads: &str) -> String {
    let Machine {
        processor,
        cores,
        date,
        rustc,
    } = machine;
    let mut text = format!(
        "{ABOUT}\nMeasured on {date}: {processor}, {cores} cores, rustc {rustc}; load average of the machine \
         at the beginning {load}.\n"
    );
    let _ = write!(
        text,
        "\n## In short\n\nThe yardstick is the explicit program on smooth track, or the other one if it \
         takes less.\n\n\
         | what | CPU s a second of car | of the yardstick |\n|---|---|---|\n{}",
        summary(explicit, cars)
    );
    let halves = |place: usize, skipped: usize| {
        let lines = cars.lines().map(|line| {
            let name = line.get(..skipped).unwrap_or_default();
            let part = line.split('|').nth(place).unwrap_or_default();
            format!("{name}{part}").trim_end().to_owned()
        });
        lines.collect::<Vec<_>>().join("\n")
    };
    for (heading, about, lines) in [
        ("What runs cost", COSTS, halves(0, 0)),
        ("Errors of statistics", ERRORS, halves(1, NAME)),
        ("The explicit program", EXPLICIT, explicit.to_owned()),
        ("Threads", THREADS, threads.to_owned()),
    ] {
        let lines = lines.trim_end();
        // Not measured.
        if lines.is_empty() {
            continue;
        }
        let _ = write!(text, "\n## {heading}\n\n{about}\n\n```text\n{lines}\n```\n");
    }
    text
}

/// Width of the column of names.
const NAME: usize = 33;

/// Returns the number in a column of the line that begins so.
fn number(text: &str, name: &str, place: usize) -> Option<f64> {
    let line = text.lines().find(|line| line.starts_with(name))?;
    line.get(name.len()..)?
        .split_whitespace()
        .nth(place)?
        .parse()
        .ok()
}

/// Returns the rows of the table of what matters most.
fn summary(explicit: &str, cars: &str) -> String {
    let own = number(explicit, "smooth, loaded ", 1);
    let yardstick = own.unwrap_or(f64::INFINITY).min(OTHERS);
    let mut rows = String::new();
    let mut row = |what: &str, value: Option<f64>| {
        if let Some(value) = value {
            let _ = writeln!(rows, "| {what} | {value:.2} | {:.1} |", value / yardstick);
        }
    };
    row("explicit program, loaded, smooth track", own);
    for (name, what) in [
        ("rough, loaded ", "the same on rough track"),
        (
            "smooth, loaded, 18 points ",
            "the same with 18 points a face, smooth track",
        ),
        (
            "rough, loaded, 18 points ",
            "the same with 18 points a face, rough track",
        ),
    ] {
        row(what, number(explicit, name, 1));
    }
    row(
        "another explicit program, smooth track, elsewhere (as reported)",
        Some(OTHERS),
    );
    // After the name: speed, length, method, start, CPU time.
    for (name, what) in [
        (
            "car_lean_loaded ",
            "perfect curve of 4 deg, loaded (`car_lean_loaded`)",
        ),
        (
            "car_constant_curve_loaded ",
            "curve of 7.5 deg, loaded (`car_constant_curve_loaded`)",
        ),
        (
            "car_tangent_loaded ",
            "tangent of class 4 at 50 mph, loaded (`car_tangent_loaded`)",
        ),
        ("car_tangent_empty ", "the same, empty (`car_tangent_empty`)"),
    ] {
        row(what, number(cars, name, 4));
    }
    let costs = cars
        .lines()
        .skip(1)
        .filter_map(|line| line.split_whitespace().nth(5)?.parse().ok());
    let mut all: Vec<f64> = costs.collect();
    all.sort_by(f64::total_cmp);
    row("least of all runs", all.first().copied());
    row("median of all runs", all.get(all.len() / 2).copied());
    row("most of all runs", all.last().copied());
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_has_both_halves_of_each_run_and_the_yardstick() {
        let machine = Machine {
            processor: "Some CPU".to_owned(),
            cores: 2,
            date: "2026-11-29".to_owned(),
            rustc: "1.95.0".to_owned(),
        };
        let explicit = "run   s CPU s/s\nsmooth, loaded   10.0   0.420  12500\n";
        let cars = format!(
            "{:33} mph s | until roll\n{:33} 50.0 20.0 tr-bdf2 0.20 1.240 900 | 5.0 0.31\n",
            "run", "car_tangent_loaded"
        );
        let page = page(&machine, "0.10", explicit, &cars, "4 runs on 1 threads: 40.0 s\n");
        for part in [
            "| explicit program, loaded, smooth track | 0.42 | 1.4 |",
            "elsewhere (as reported) | 0.31 | 1.0 |",
            "| median of all runs | 1.24 | 4.0 |",
            "loaded (`car_tangent_loaded`) | 1.24 | 4.0 |",
            "50.0 20.0 tr-bdf2 0.20 1.240 900\n```",
            "car_tangent_loaded                50.0",
            "car_tangent_loaded                5.0 0.31",
            "4 runs on 1 threads",
        ] {
            assert!(page.contains(part), "{part} is not in\n{page}");
        }
    }
}
