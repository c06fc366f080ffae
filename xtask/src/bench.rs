//! `cargo xtask bench`: measurements of speed, with caveats; writes `docs/benchmarks.md`, and of cars
//! `docs/benchmarks-cars.md`.

mod cars;
mod page;

use std::fmt::Write;
use std::process::{Command, ExitCode};

use crate::builds;
use crate::machine::Machine;
use crate::shell::{self, Workspace};
use page::{INSTRUCTIONS, Printed, SECTIONS};

const HELP: &str = "\
Usage: cargo xtask bench [cars [--quick | --page] | arguments of `cargo bench`]

Without arguments: measures evaluations, the thesis's runs, studies, half-truck, truck and FMUs, counts \
instructions (where valgrind
is installed), and writes docs/benchmarks.md: some minutes. With arguments, runs `cargo bench` with them, \
over all crates unless some
are chosen, such as `cargo xtask bench --package benchmarks`.
`cars`: measures all built-in cars and regimes beside an explicit program, and writes \
docs/benchmarks-cars.md: some 20 minutes on two
cores. With --quick it shows a few runs and writes nothing, with --page it writes the page from the last \
measurement.";

/// The run whose instructions are counted: the slowest yawed one.
const COUNTED_RUN: [&str; 3] = ["rodas5p", "1e-6", "vdrun_toe_in_0.2_psi_0.012"];

/// A line that programs print for those who run them alone; the page says it for all.
const CAVEAT: &str = "Wall times on a machine";

/// Runs the command.
pub fn run(workspace: &Workspace, arguments: &[String]) -> ExitCode {
    if matches!(arguments, [only] if only == "--help" || only == "-h") {
        println!("{HELP}");
        return ExitCode::SUCCESS;
    }
    let done = match arguments {
        [] => everything(workspace),
        [first, rest @ ..] if first == "cars" => cars::run(workspace, rest),
        _ => shell::run(&mut workspace.cargo(call(arguments))),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn everything(workspace: &Workspace) -> Result<(), String> {
    let build = ["build", "--release", "--package", "benchmarks", "--bins"];
    shell::run(&mut workspace.cargo(build))?;
    shell::run(&mut workspace.cargo(["bench", "--package", "benchmarks", "--bench", "wedge", "--no-run"]))?;
    let load = std::fs::read_to_string("/proc/loadavg").ok();
    let load = load.as_deref().and_then(|text| text.split_whitespace().next());
    let mut printed = Vec::new();
    for section in SECTIONS {
        println!("\n{}:", section.heading);
        let Some(text) = measured(workspace, section.program)? else {
            println!("left out: valgrind is not installed (Debian: apt-get install valgrind)");
            continue;
        };
        println!("{text}");
        printed.push(Printed { section, text });
    }
    let file = workspace.root.join("docs").join("benchmarks.md");
    std::fs::write(&file, page::page(&Machine::here(), load, &printed))
        .map_err(|error| format!("cannot write {}: {error}", file.display()))?;
    println!("\n{}", file.display());
    Ok(())
}

/// Returns the output of a section's program; none if it is not installed.
fn measured(workspace: &Workspace, program: &[&str]) -> Result<Option<String>, String> {
    let binary = |name: &str| workspace.target.join("release").join(name);
    let (name, arguments) = match program {
        [] => {
            let bench = ["bench", "--package", "benchmarks", "--bench", "wedge", "--"];
            let text = stdout(workspace.cargo(bench).args(["--output-format", "bencher"]))?;
            return Ok(Some(page::evaluations(&text)));
        }
        INSTRUCTIONS => return counts(workspace),
        [name, arguments @ ..] => (name, arguments),
    };
    let text = stdout(Command::new(binary(name)).args(arguments))?;
    let lines = text.lines().filter(|line| !line.starts_with(CAVEAT));
    Ok(Some(lines.collect::<Vec<_>>().join("\n")))
}

/// Returns the output of a command.
fn stdout(command: &mut Command) -> Result<String, String> {
    let output = command.output();
    let output =
        output.map_err(|error| format!("{} cannot be started: {error}", command.get_program().display()))?;
    if !output.status.success() {
        let error = String::from_utf8_lossy(&output.stderr);
        return Err(format!(
            "{}: {}\n{error}",
            command.get_program().display(),
            output.status
        ));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Instructions of single calls and of a run; none without valgrind.
fn counts(workspace: &Workspace) -> Result<Option<String>, String> {
    if shell::output(Command::new("valgrind").arg("--version")).is_none() {
        return Ok(None);
    }
    // Valgrind does not know all instructions of the usual build.
    let folder = builds::portable(workspace, &["--package", "benchmarks", "--bins"])?;
    let count = |name: &str, arguments: &[&str]| {
        let mut command = Command::new("valgrind");
        command.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]);
        instructions(command.arg(folder.join(name)).args(arguments))
    };
    let mut text = String::new();
    for kind in ["right-hand-side", "jacobian"] {
        let calls = count("calls", &[kind, "2000"])? - count("calls", &[kind, "1000"])?;
        let _ = writeln!(text, "{kind:16} {:>14.0} per call", calls / 1000.0);
    }
    let run = count("thesis_runs", &COUNTED_RUN)?;
    let _ = writeln!(text, "{:16} {run:>14.0} {}", "run", COUNTED_RUN.join(" "));
    Ok(Some(text))
}

/// Returns the instructions that a command under callgrind reports.
fn instructions(command: &mut Command) -> Result<f64, String> {
    let output = command
        .output()
        .map_err(|error| format!("cannot start valgrind: {error}"))?;
    let text = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(format!("valgrind: {}\n{text}", output.status));
    }
    let count = text
        .lines()
        .find_map(|line| line.split("Collected :").nth(1)?.trim().parse().ok());
    count.ok_or_else(|| format!("valgrind reported no count:\n{text}"))
}

/// Returns the arguments for cargo: all crates, unless some are chosen.
fn call(arguments: &[String]) -> Vec<&str> {
    let chosen = arguments
        .iter()
        .take_while(|argument| *argument != "--")
        .any(|argument| {
            argument.starts_with("-p") || argument == "--package" || argument.starts_with("--package=")
        });
    let all = if chosen { None } else { Some("--workspace") };
    std::iter::once("bench")
        .chain(all)
        .chain(arguments.iter().map(String::as_str))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<String> {
        line.split_whitespace().map(str::to_owned).collect()
    }

    #[test]
    fn all_crates_unless_some_are_chosen() {
        assert_eq!(call(&[]), ["bench", "--workspace"]);
        assert_eq!(
            call(&words("-- rhs -p")),
            ["bench", "--workspace", "--", "rhs", "-p"]
        );
        assert_eq!(call(&words("--package wedge")), ["bench", "--package", "wedge"]);
        assert_eq!(call(&words("-p wedge")), ["bench", "-p", "wedge"]);
    }
}
