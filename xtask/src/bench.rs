//! `cargo xtask bench`: the benchmarks of all crates.

use std::process::ExitCode;

use crate::shell::{self, Workspace};

const HELP: &str = "\
Usage: cargo xtask bench [arguments of `cargo bench`]

Runs `cargo bench --workspace`; every argument is passed on, such as
`cargo xtask bench --package mechanics`.";

/// Runs the command.
pub fn run(workspace: &Workspace, arguments: &[String]) -> ExitCode {
    if matches!(arguments, [only] if only == "--help" || only == "-h") {
        println!("{HELP}");
        return ExitCode::SUCCESS;
    }
    match shell::run(&mut workspace.cargo(call(arguments))) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
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
