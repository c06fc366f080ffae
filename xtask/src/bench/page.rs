//! The page of the benchmarks, `docs/benchmarks.md`: fixed text around the output of the programs. Nobody
//! edits the page.

use std::fmt::Write;

use crate::machine::Machine;

/// The output of one program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Printed {
    /// Its section.
    pub section: Section,
    /// Its lines.
    pub text: String,
}

/// A section of the page: what it shows, and the program whose lines it holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Section {
    /// Its heading.
    pub heading: &'static str,
    /// The explanation of the lines.
    pub about: &'static str,
    /// The program of the package `benchmarks`, with its arguments; none: the benchmark `wedge` of
    /// `cargo bench`.
    pub program: &'static [&'static str],
}

const COLUMNS_OF_RUNS: &str = "Ten seconds each. Mean forces while the bolster rises and falls (constant \
                               damping: mid stroke; variable: lower stroke), friction energy per cycle at \
                               the side frame, relative residual of the energy ledger, \
                               accepted steps, explicit ones among them, rejected attempts, wall time. It \
                               includes contact events and output times each 0.01 s, but no files.";

/// The sections, in the order of the page.
pub const SECTIONS: [Section; 13] = [
    Section {
        heading: "One evaluation",
        about: "A wedge in the middle of a branch, pressed into both faces and sliding, yawed; and the \
                half-truck, sliding: right-hand side, Jacobian matrix with the derivative by time, and one \
                factorization with a solution.",
        program: &[],
    },
    Section {
        heading: "The thesis's twelve runs, Rodas5P at 1e-6: the default",
        about: COLUMNS_OF_RUNS,
        program: &["thesis_runs"],
    },
    Section {
        heading: "The same by ESDIRK3 at 1e-6",
        about: "A method that damps the vibrations of contacts: read branch means and energies.",
        program: &["thesis_runs", "esdirk3", "1e-6"],
    },
    Section {
        heading: "The same by TR-BDF2 at 1.5e-5: the engineering accuracy of studies",
        about: "Also a method that damps.",
        program: &["thesis_runs", "tr-bdf2", "1.5e-5"],
    },
    Section {
        heading: "Studies",
        about: "The six yawed runs with a study's measures at engineering accuracy, one after the other on \
                one core: wall time, steps, and how far measures are from those at 1e-9 (friction energies \
                per cycle at side frame and bolster; equivalent damping, stiffness, and damping on the \
                bolster; mean vertical wedge forces up and down; mean longitudinal ones). Then 24 variants \
                of them.",
        program: &["study_rate", "1.5e-5", "0.01 s", "tr-bdf2", "5"],
    },
    Section {
        heading: "The half-truck",
        about: "Twenty seconds of its files, 18 coordinates, 48 to 50 connections, at 1e-5. Wedges that jam \
                and yaw take longer; `nucars_69_variable_toe_in_yaw` flutters between sticking and the \
                limit of the files.",
        program: &["half_truck", "1e-5"],
    },
    Section {
        heading: "A communication step of an FMU",
        about: "Steps of 1 ms of a driven wedge through the interface of FMI, without and with reading the \
                outputs, average over a run.",
        program: &["steps"],
    },
    Section {
        heading: "A three-piece truck",
        about: "Two side frames and four wedges with six coordinates each, 40 contact points with bristles, \
                a prescribed bolster or a half car on it: its rigs, 5 to 22 s, at 1e-5. Newton: steps \
                rejected because a stage could not be solved. Residual: the relative residual of the energy \
                ledger.",
        program: &["truck", "1e-5"],
    },
    Section {
        heading: "A freight car on track",
        about: "A loaded car, 20 s: two trucks whose wheels search their contacts in each evaluation, creep \
                by Polach, each wheel on a sprung rail. Real time: seconds of the car a second of CPU time. \
                Floors on class 6 and in the dynamic curve at 1e-4: 2 times real time with wedge bodies, 5 \
                with massless wedges; residual of the ledger below 1e-4, which takes ESDIRK3 at 2e-6 on \
                rough track. Others publish 1.03 to 1.18 times real time for a passenger car of 109 states \
                without wedges (OpenRailVehicleDynamics, by its authors on their machine), and about one \
                to ten times for commercial codes with massless wedges (unverified): other vehicles, \
                tracks, tolerances and machines, so no comparison of programs.",
        program: &["car"],
    },
    Section {
        heading: "A body on a circle of track",
        about: "A wheelset carried once round a curve, in coordinates of several kinds: how far it came, \
                steps, the largest error of the lateral force, the relative residual of the energy ledger.",
        program: &["circle"],
    },
    Section {
        heading: "The contact of a wheel",
        about: "A nominal AAR-1B wheel on a nominal 136RE rail, 0.1 mm of overlap, by its lateral place: \
                search or table, normal and creep forces; the best of 40 batches each. Floors: with Polach \
                5 µs, by tables 1 µs, FASTSIM 21 × 21 20 µs.",
        program: &["wheel_contact"],
    },
    Section {
        heading: "Many wedges in one system",
        about: "1 to 200 wedges with variable damping while the bolsters go down, by implicit steps of a \
                fixed length. Uncoupled: each between a column and a bolster of its own. Chained: column, \
                wedge, bolster, wedge, column ..., free bodies on stiff supports, a block-tridiagonal \
                matrix. Supports: these free bodies alone, so that the chain less them is what wedges \
                between free bodies cost. The cost of a step is proportional to the number of wedges.",
        program: &["wedge_count"],
    },
    Section {
        heading: "Instructions",
        about: "Counted by callgrind, of programs compiled for all processors. They repeat to the last \
                digit for the same binary, but they are no times.",
        program: INSTRUCTIONS,
    },
];

/// No program of its own: what callgrind counts.
pub const INSTRUCTIONS: &[&str] = &["callgrind"];

/// The text before all numbers.
const ABOUT: &str = "\
# Benchmarks

How long evaluations, runs, studies and steps take. `cargo xtask bench` measures everything and writes this \
page; its text is in `xtask/src/bench/page.rs`: edit it there.
All built-in cars and regimes beside an explicit program: [benchmarks-cars.md](benchmarks-cars.md).
How we compare with other solvers: [race.md](race.md). Why the integrator is built so, with what each change \
gained: [decisions](decisions).

## How to read it

- Wall times depend on the machine and on what else it does: compare within one page, and trust ratios of \
1.2 and more. Times of `truck`, `wedge_count` and evaluations of the half-truck are CPU times.
- All runs use one core.
- A tolerance bounds the error estimate of a step: with Rodas5P in all states and energies, with ESDIRK3 and \
TR-BDF2 in displacements alone. At 1e-6 branch means of yawed runs are within 0.2 % of those at 1e-9. Runs \
without yaw are chaotic in detail: their means scatter.
- The same with another method or tolerance: `cargo run --release -p benchmarks --bin thesis_runs -- METHOD \
TOLERANCE NAME-PART`.
";

/// Measurements of other commands.
const OTHERS: &str = "
## What other commands measure

| what | command |
|---|---|
| the report's page: size, time until it opens, frames a second of the 3D view; the explorer's answer to a \
change | `cargo xtask test --only browser` |
| runs, `run_many` and single steps from Python, against the command line | `python \
crates/wedgelab-py/benchmarks/overhead.py WEDGELAB` |
| other solvers on the same equations | `cargo xtask race` ([race.md](race.md)) |
";

/// Returns the page.
pub fn page(machine: &Machine, load: Option<&str>, printed: &[Printed]) -> String {
    let Machine {
        processor,
        cores,
        date,
        rustc,
    } = machine;
    let mut text = format!("{ABOUT}\nMeasured on {date}: {processor}, {cores} cores, rustc {rustc}");
    if let Some(load) = load {
        let _ = write!(
            text,
            "; load average of the machine at the beginning {load} (the benchmarks alone: up to 1)"
        );
    }
    text.push_str(".\n");
    let found = |section: &str| {
        let own = printed.iter().find(|one| one.section.heading == section);
        own.map_or("", |one| one.text.as_str())
    };
    let summary = summary(found);
    if !summary.is_empty() {
        let _ = write!(text, "\n## In short\n\n| what | found |\n|---|---|\n{summary}");
    }
    for one in printed {
        let lines: Vec<&str> = one.text.lines().map(str::trim_end).collect();
        let _ = write!(
            text,
            "\n## {}\n\n{}\n\n```text\n{}\n```\n",
            one.section.heading,
            one.section.about,
            lines.join("\n").trim_matches('\n')
        );
    }
    text.push_str(OTHERS);
    text
}

/// Returns the rows of the table of what matters most.
fn summary<'p>(found: impl Fn(&str) -> &'p str) -> String {
    let [one, runs, esdirk3, _, studies, half_truck, steps, ..] =
        SECTIONS.map(|section| found(section.heading));
    let mut rows = String::new();
    let mut row = |what: &str, value: Option<String>| {
        if let Some(value) = value {
            let _ = writeln!(rows, "| {what} | {value} |");
        }
    };
    let evaluation = |name: &str| {
        let line = one.lines().find(|line| line.starts_with(name))?;
        Some(line[name.len()..].trim().to_owned())
    };
    let pair = |first: &str, second: &str| Some(format!("{}, {}", evaluation(first)?, evaluation(second)?));
    row(
        "right-hand side, Jacobian matrix of a sliding wedge (variable damping)",
        pair("right-hand side, Variable", "jacobian, Variable"),
    );
    let yawed = |text: &str, kind: &str| {
        let lines = text
            .lines()
            .filter(|line| line.starts_with(kind) && line.contains("psi_0.012"));
        range(
            lines.filter_map(|line| line.split_whitespace().last()?.parse().ok()),
            "ms",
        )
    };
    let total = |text: &str| {
        let line = text.lines().find(|line| line.starts_with("all "))?;
        Some(line.trim_start_matches("all ").to_owned())
    };
    row("the twelve runs of ten seconds, default method", total(runs));
    row("one yawed run, variable damping", yawed(runs, "vdrun"));
    row("one yawed run, constant damping", yawed(runs, "cdrun"));
    row("the twelve runs by ESDIRK3", total(esdirk3));
    let rate = studies.lines().find(|line| line.contains("runs/s on one core"));
    row(
        "yawed runs of a study, engineering accuracy, one core",
        rate.map(|line| line.trim_end_matches(" on one core").to_owned()),
    );
    let trucks = half_truck
        .lines()
        .filter(|line| line.starts_with("nucars_") && !line.contains(':') && !line.contains("toe_in"));
    let trucks = trucks.filter_map(|line| line.split_whitespace().nth(1)?.parse().ok());
    row(
        "twenty seconds of the half-truck, toe out or none",
        range(trucks, "ms"),
    );
    let each = steps
        .lines()
        .filter(|line| line.contains("drun_"))
        .filter_map(|line| line.split_whitespace().nth(1)?.parse().ok());
    row("a step of 1 ms of an FMU, yawed cases", range(each, "µs"));
    rows
}

/// Returns the least and the greatest of some values.
fn range(values: impl Iterator<Item = f64>, unit: &str) -> Option<String> {
    let (least, most) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| {
        (least.min(value), most.max(value))
    });
    (least <= most).then(|| format!("{least:.0} to {most:.0} {unit}"))
}

/// Returns the times that `cargo bench` prints as `test NAME ... bench: 1,234 ns/iter (+/- 5)`, a line each.
pub fn evaluations(text: &str) -> String {
    let mut lines = String::new();
    for line in text.lines() {
        let parts = line.strip_prefix("test ").and_then(|rest| {
            let (name, time) = rest.split_once(" ... bench:")?;
            let (time, _) = time.split_once(" ns/iter")?;
            Some((name, time.trim()))
        });
        if let Some((name, time)) = parts {
            let _ = writeln!(lines, "{name:46} {time:>8} ns");
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_holds_what_was_printed() {
        let machine = Machine {
            processor: "Some CPU".to_owned(),
            cores: 2,
            date: "2026-11-25".to_owned(),
            rustc: "1.95.0".to_owned(),
        };
        let bench = "test right-hand side, Variable ... bench:         217 ns/iter (+/- 3)\n\
                     test jacobian, Variable ... bench:       1,017 ns/iter (+/- 9)\n";
        let runs = "run  ms\nvdrun_toe_0_psi_0.012  1 40.0\nvdrun_toe_in_0.2_psi_0.012 1 44.6\nall 0.73 s\n";
        let printed = [
            Printed {
                section: SECTIONS[0],
                text: evaluations(bench),
            },
            Printed {
                section: SECTIONS[1],
                text: runs.to_owned(),
            },
        ];
        let page = page(&machine, Some("0.50"), &printed);
        for part in [
            "Measured on 2026-11-25: Some CPU, 2 cores, rustc 1.95.0; load average of the machine at the \
             beginning 0.50",
            "| right-hand side, Jacobian matrix of a sliding wedge (variable damping) | 217 ns, 1,017 ns |",
            "| the twelve runs of ten seconds, default method | 0.73 s |",
            "| one yawed run, variable damping | 40 to 45 ms |",
            "```text\nrun  ms\nvdrun_toe_0_psi_0.012  1 40.0\n",
        ] {
            assert!(page.contains(part), "{part} is not in\n{page}");
        }
        assert!(!page.contains("constant damping |"), "{page}");
    }
}
