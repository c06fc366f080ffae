//! Checks, set-up and benchmarks of the workspace: `cargo xtask <command>`.
//!
//! One module a command. Exit codes: 0, 1 (a check failed), 2 (the call itself is wrong).

mod architecture;
mod bench;
mod book;
mod builds;
mod debian;
mod fuzz;
mod machine;
mod race;
mod shell;
mod test;
mod venv;
mod viewer;
mod wheel;

use std::env;
use std::process::ExitCode;

use shell::Workspace;

/// A command: its name, what it does in one line, and how it runs.
struct Command {
    name: &'static str,
    about: &'static str,
    run: fn(&Workspace, &[String]) -> ExitCode,
}

const COMMANDS: &[Command] = &[
    Command {
        name: "test",
        about: "run all checks, fetching what they need",
        run: test::run,
    },
    Command {
        name: "bench",
        about: "run the benchmarks (`cargo bench --workspace`)",
        run: bench::run,
    },
    Command {
        name: "fuzz",
        about: "give broken inputs to every reader, for a minute or as long as asked",
        run: fuzz::run,
    },
    Command {
        name: "race",
        about: "run other people's solvers and ours on the same equations, fetching what they need",
        run: race::run,
    },
    Command {
        name: "architecture",
        about: "write the table of the crates in ARCHITECTURE.md",
        run: architecture::run,
    },
    Command {
        name: "book",
        about: "build the documentation as a book",
        run: book::run,
    },
    Command {
        name: "viewer",
        about: "bundle the interactive part of pages anew (needs Node.js)",
        run: viewer::run,
    },
    Command {
        name: "wheel",
        about: "build a wheel of the Python package (needs Python 3.10)",
        run: wheel::run,
    },
];

fn help() -> String {
    let mut text = String::from("Usage: cargo xtask <command> [options]\n\nCommands:\n");
    for command in COMMANDS {
        text.push_str(&format!("  {:<8}{}\n", command.name, command.about));
    }
    text.push_str("\n`cargo xtask <command> --help` explains one command.");
    text
}

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let Some((name, rest)) = arguments.split_first() else {
        println!("{}", help());
        return ExitCode::SUCCESS;
    };
    if matches!(name.as_str(), "--help" | "-h" | "help") {
        println!("{}", help());
        return ExitCode::SUCCESS;
    }
    match COMMANDS.iter().find(|command| command.name == name) {
        Some(command) => (command.run)(&Workspace::find(), rest),
        None => {
            eprintln!("There is no command `{name}`.\n\n{}", help());
            ExitCode::from(2)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn help_lists_every_command() {
        let text = help();
        for command in COMMANDS {
            assert!(
                text.contains(command.name) && text.contains(command.about),
                "{}",
                command.name
            );
        }
    }
}
