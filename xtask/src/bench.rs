//! `cargo xtask bench`: how fast, with caveats; wall times and instruction counts side by side.

use std::process::{Command, ExitCode};

use crate::shell::{self, Workspace};

const HELP: &str = "\
Usage: cargo xtask bench [arguments of `cargo bench`]

Without arguments: times the right-hand side, the Jacobian and the twelve thesis runs, and counts their instructions (where
valgrind is installed). With arguments, runs `cargo bench` with them, over all crates unless some are chosen, such as
`cargo xtask bench --package benchmarks`.";

const CAVEATS: &str = "\
Read this first: wall times depend on the machine and on what else it does. Compare within one run, and trust ratios of
1.2 and more. Instruction counts repeat for the same binary, but are no times.";

/// The run whose instructions are counted: the slowest yawed one.
const COUNTED_RUN: [&str; 3] = ["rodas4", "1e-6", "vdrun_toe_0.2_psi_0.012"];

/// Runs the command.
pub fn run(workspace: &Workspace, arguments: &[String]) -> ExitCode {
    if matches!(arguments, [only] if only == "--help" || only == "-h") {
        println!("{HELP}");
        return ExitCode::SUCCESS;
    }
    let done = if arguments.is_empty() {
        everything(workspace)
    } else {
        shell::run(&mut workspace.cargo(call(arguments)))
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
    println!("{CAVEATS}\n");
    shell::run(&mut workspace.cargo(["bench", "--package", "benchmarks", "--bench", "wedge"]))?;
    shell::run(&mut workspace.cargo(["build", "--release", "--package", "benchmarks", "--bins"]))?;
    let program = |name: &str| workspace.target.join("release").join(name);
    shell::run(&mut Command::new(program("thesis_runs")))?;
    println!("\nOne communication step of 1 ms of an FMU, yawed cases (target 50 µs):");
    shell::run(&mut Command::new(program("steps")))?;
    if shell::output(Command::new("valgrind").arg("--version")).is_none() {
        println!("\nNo instruction counts: valgrind is not installed (Debian: apt-get install valgrind).");
        return Ok(());
    }
    let count = |name: &str, arguments: &[&str]| {
        let mut command = Command::new("valgrind");
        command.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]);
        instructions(command.arg(program(name)).args(arguments))
    };
    println!("\nInstructions (callgrind):");
    for kind in ["right-hand-side", "jacobian"] {
        let calls = count("calls", &[kind, "2000"])? - count("calls", &[kind, "1000"])?;
        println!("  {kind:16} {:>14.0} per call", calls / 1000.0);
    }
    println!(
        "  {:16} {:>14.0} {}",
        "run",
        count("thesis_runs", &COUNTED_RUN)?,
        COUNTED_RUN.join(" ")
    );
    Ok(())
}

/// The instructions that a command under callgrind reports.
fn instructions(command: &mut Command) -> Result<f64, String> {
    let output = command
        .output()
        .map_err(|error| format!("cannot start valgrind: {error}"))?;
    let text = String::from_utf8_lossy(&output.stderr);
    let count = text
        .lines()
        .find_map(|line| line.split("Collected :").nth(1)?.trim().parse().ok());
    count.ok_or_else(|| format!("valgrind reported no count:\n{text}"))
}

/// The arguments for cargo: all crates, unless some are chosen.
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
