//! `cargo xtask test`: all checks, and a table of the results.

mod deny;
mod features;
mod fmu;
pub mod layers;
mod links;
mod octave;
mod page;
mod programs;
mod prose;
mod python;
mod race;
mod readme;
mod runner;
mod viewer;

use std::env::consts::EXE_SUFFIX;
use std::process::{Command, ExitCode};
use std::time::Instant;

use crate::builds::{self, SHARED};
use crate::shell::{self, Workspace};
pub use python::path_with;
use runner::{passed, run_checks, table};

/// The remark of a passed check in the table, or the reason why it failed.
type Outcome = Result<Option<String>, String>;

/// One check.
#[derive(Clone, Copy)]
struct Check {
    name: &'static str,
    about: &'static str,
    /// Runs only when asked for by name, or with `--all`.
    on_request: bool,
    /// Runs at the same time as others of this kind, after the checks that compile.
    beside: bool,
    run: fn(&Workspace) -> Outcome,
}

impl Check {
    const fn new(name: &'static str, about: &'static str, run: fn(&Workspace) -> Outcome) -> Self {
        Self {
            name,
            about,
            on_request: false,
            beside: false,
            run,
        }
    }

    const fn on_request(self) -> Self {
        Self {
            on_request: true,
            ..self
        }
    }

    const fn beside(self) -> Self {
        Self { beside: true, ..self }
    }
}

/// The checks in the order in which they run: the quick ones first, those that run beside others last.
const CHECKS: &[Check] = &[
    Check::new("fmt", "the code is formatted", format),
    Check::new(
        "layers",
        "every crate depends on lower layers only, ARCHITECTURE.md lists the crates as they are",
        layers::check,
    ),
    Check::new(
        "features",
        "programs and tests share one build of every dependency",
        features::check,
    ),
    Check::new("prose", "no file points outside the repository", prose::check),
    Check::new(
        "links",
        "links between pages lead somewhere, source files that they name exist",
        links::check,
    ),
    Check::new(
        "viewer",
        "the pages' interactive part: types, lints, unit tests, its bundle (needs Node.js)",
        viewer::check,
    ),
    Check::new("clippy", "no lint warns", clippy),
    Check::new("test", "the tests of libraries and programs pass", programs::run),
    Check::new(
        "fuzz",
        "twenty seconds of broken inputs break no reader",
        |workspace| broken_inputs(workspace, 20),
    ),
    Check::new(
        "doctest",
        "the examples in the documentation and the example programs run",
        doc_tests,
    ),
    Check::new("doc", "the documentation builds without a warning", docs),
    Check::new(
        "deny",
        "licences, duplicates and sources of dependencies",
        deny::check,
    ),
    Check::new(
        "python",
        "the Python package installs, its tests, types, stubs and notebooks pass (needs Python 3.10)",
        python::check,
    )
    .beside(),
    Check::new(
        "browser",
        "the report's pages and the explorer in a browser (needs Node.js; installs Chromium)",
        viewer::browser,
    )
    .beside(),
    Check::new(
        "octave",
        "Octave and SciPy read the results, the plotting scripts draw them",
        octave::check,
    )
    .beside(),
    Check::new(
        "fmu",
        "FMUs are valid and give what runs give, in FMPy (needs Python 3)",
        fmu::check,
    )
    .beside(),
    // Its own installation, of some minutes on a new machine.
    Check::new(
        "book",
        "the documentation builds as a book (installs mdBook)",
        book,
    )
    .beside(),
    Check::new(
        "page",
        "the report's page passes an HTML validator (needs Node.js)",
        page::check,
    )
    .beside(),
    Check::new(
        "readme",
        "the commands of the README and of the tutorial run in their order",
        readme::check,
    )
    .beside(),
    Check::new(
        "fuzz-long",
        "ten minutes of broken inputs break no reader",
        |workspace| broken_inputs(workspace, 600),
    )
    .on_request(),
    Check::new(
        "race",
        "tests of the race and of the benchmarks; CVODE agrees with our integrator (installs SUNDIALS)",
        race::check,
    )
    .on_request(),
    Check::new(
        "advisories",
        "known vulnerabilities of dependencies (needs GitHub)",
        deny::advisories,
    )
    .on_request(),
];

fn format(workspace: &Workspace) -> Outcome {
    component(workspace, "fmt", "rustfmt")?;
    shell::run(&mut workspace.cargo(["fmt", "--all", "--check"]))?;
    Ok(None)
}

fn clippy(workspace: &Workspace) -> Outcome {
    component(workspace, "clippy", "clippy")?;
    shell::run(&mut workspace.cargo(["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]))?;
    Ok(None)
}

fn broken_inputs(workspace: &Workspace, seconds: u32) -> Outcome {
    crate::fuzz::check(workspace, seconds)?;
    Ok(None)
}

/// Example programs, which check what they print.
const EXAMPLES: [&str; 3] = ["custom_element", "stick_slip", "warp"];

fn doc_tests(workspace: &Workspace) -> Outcome {
    let mut tests = workspace.cargo(["test", "--release", "--no-fail-fast", "--doc"]);
    shell::run(tests.args(SHARED))?;
    let selected: Vec<&str> = EXAMPLES
        .iter()
        .flat_map(|example| ["--example", example])
        .collect();
    let examples = builds::programs(workspace, &selected)?.join("examples");
    for example in EXAMPLES {
        let mut program = Command::new(examples.join(format!("{example}{EXE_SUFFIX}")));
        shell::run(program.current_dir(&workspace.root))?;
    }
    Ok(None)
}

/// Libraries and programs apart: two targets of one name, such as the command `wedgelab` and a library
/// of that name, would write the same pages at once, of which cargo warns. So the programs' pages win.
fn docs(workspace: &Workspace) -> Outcome {
    for targets in ["--lib", "--bins"] {
        let mut command = workspace.cargo(["doc", "--workspace", "--no-deps", targets]);
        shell::run(command.env("RUSTDOCFLAGS", "-D warnings"))?;
    }
    Ok(None)
}

fn book(workspace: &Workspace) -> Outcome {
    crate::book::build(workspace)?;
    Ok(None)
}

/// Fetches a component of the Rust toolchain that a minimal installation leaves out.
fn component(workspace: &Workspace, command: &str, component: &str) -> Result<(), String> {
    if shell::output(&mut workspace.cargo([command, "--version"])).is_some() {
        return Ok(());
    }
    let mut rustup = Command::new("rustup");
    rustup
        .args(["component", "add", component])
        .current_dir(&workspace.root);
    shell::run(&mut rustup).map_err(|error| format!("`cargo {command}` is missing, and {error}"))
}

/// The request of the command line.
#[derive(Debug, PartialEq, Eq)]
enum Request {
    Help,
    Run {
        only: Vec<String>,
        all: bool,
        fail_fast: bool,
    },
}

fn parse(arguments: &[String]) -> Result<Request, String> {
    let mut only = Vec::new();
    let (mut all, mut fail_fast) = (false, false);
    let mut arguments = arguments.iter();
    while let Some(argument) = arguments.next() {
        let names = match argument.as_str() {
            "--help" | "-h" => return Ok(Request::Help),
            "--fail-fast" => {
                fail_fast = true;
                continue;
            }
            "--all" => {
                all = true;
                continue;
            }
            "--only" => arguments
                .next()
                .ok_or("`--only` wants names, as in `--only fmt,clippy`.")?
                .as_str(),
            other => other.strip_prefix("--only=").ok_or_else(|| {
                format!("`{other}` is unknown; there are `--only`, `--all` and `--fail-fast`.")
            })?,
        };
        for name in names.split(',').map(str::trim) {
            if !CHECKS.iter().any(|check| check.name == name) {
                let known: Vec<_> = CHECKS.iter().map(|check| check.name).collect();
                return Err(format!(
                    "There is no check `{name}`; there are {}.",
                    known.join(", ")
                ));
            }
            only.push(name.to_owned());
        }
    }
    if all && !only.is_empty() {
        return Err("`--all` and `--only` exclude each other.".to_owned());
    }
    Ok(Request::Run { only, all, fail_fast })
}

/// Returns the checks asked for, in their own order, each once; without names all of them, or all but those
/// on request.
fn select(only: &[String], all: bool) -> Vec<&'static Check> {
    let wanted = |check: &&Check| match only {
        [] => all || !check.on_request,
        names => names.iter().any(|name| name == check.name),
    };
    CHECKS.iter().filter(wanted).collect()
}

fn help() -> String {
    let mut text = String::from(
        "Usage: cargo xtask test [--only NAME,... | --all] [--fail-fast]\n\n\
         Runs the checks, the others too if one fails, and ends in a table. First come those that\n\
         compile, one after the other; then those that mostly wait, as many at a time as there are cores:\n\
         each prints its output whole when it ends.\n\n\
         Options:\n  --only NAME,...  only these checks\n  \
         --all            also those that run only on request\n  \
         --fail-fast      stop after the first failure\n\n\
         Checks:\n",
    );
    for check in CHECKS {
        let when = if check.on_request { "; only on request" } else { "" };
        text.push_str(&format!("  {:<12}{}{when}\n", check.name, check.about));
    }
    text.push_str("\nExit code: 0, 1 (a check failed), 2 (the call is wrong).");
    text
}

/// Runs the command.
pub fn run(workspace: &Workspace, arguments: &[String]) -> ExitCode {
    let (checks, fail_fast) = match parse(arguments) {
        Ok(Request::Run { only, all, fail_fast }) => (select(&only, all), fail_fast),
        Ok(Request::Help) => {
            println!("{}", help());
            return ExitCode::SUCCESS;
        }
        Err(message) => {
            eprintln!("{message}\n\n{}", help());
            return ExitCode::from(2);
        }
    };
    let start = Instant::now();
    let results = run_checks(&checks, fail_fast, workspace);
    println!("\n{}", table(&results, start.elapsed()));
    if passed(&results) {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse_line(line: &str) -> Result<Request, String> {
        parse(&line.split_whitespace().map(str::to_owned).collect::<Vec<_>>())
    }

    fn run_of(only: &[&str], fail_fast: bool) -> Request {
        Request::Run {
            only: only.iter().map(|name| (*name).to_owned()).collect(),
            all: false,
            fail_fast,
        }
    }

    #[test]
    fn arguments_are_understood() {
        assert_eq!(parse_line(""), Ok(run_of(&[], false)));
        assert_eq!(parse_line("--fail-fast"), Ok(run_of(&[], true)));
        assert_eq!(
            parse_line("--only fmt,clippy"),
            Ok(run_of(&["fmt", "clippy"], false))
        );
        assert_eq!(
            parse_line("--only=deny --fail-fast --only doc"),
            Ok(run_of(&["deny", "doc"], true))
        );
        assert_eq!(parse_line("--only fmt --help"), Ok(Request::Help));
    }

    #[test]
    fn wrong_arguments_are_named() {
        for (line, named) in [
            ("--only", "--only fmt,clippy"),
            ("--only=", "``"),
            ("--only fmt,,doc", "``"),
            ("--only fmt,style", "`style`"),
            ("--faster", "`--faster`"),
            ("--all --only fmt", "`--all`"),
            ("fmt", "`fmt`"),
        ] {
            let message = parse_line(line).expect_err(line);
            assert!(message.contains(named), "{line}: {message}");
        }
    }

    #[test]
    fn checks_keep_their_order_and_run_once() {
        let names = |only: &[&str]| -> Vec<&str> {
            let only: Vec<String> = only.iter().map(|name| (*name).to_owned()).collect();
            select(&only, false).iter().map(|check| check.name).collect()
        };
        assert_eq!(names(&["clippy", "fmt", "clippy"]), ["fmt", "clippy"]);
        assert_eq!(names(&["advisories"]), ["advisories"]);
        let on_request = ["fuzz-long", "race", "advisories"];
        assert_eq!(names(&[]).len(), CHECKS.len() - on_request.len());
        assert!(on_request.iter().all(|name| !names(&[]).contains(name)));
        assert_eq!(select(&[], true).len(), CHECKS.len());
    }
}
