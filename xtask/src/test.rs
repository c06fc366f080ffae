//! `cargo xtask test`: all checks, one after the other, and a table of the results.

mod deny;
mod features;
mod fmu;
mod layers;
mod links;
mod octave;
mod page;
mod prose;
mod python;
mod race;
mod readme;
mod viewer;

use std::env::consts::EXE_SUFFIX;
use std::process::{Command, ExitCode};
use std::time::{Duration, Instant};

use crate::builds::{self, SHARED};
use crate::shell::{self, Workspace};
pub use python::path_with;

/// The remark of a passed check in the table, or the reason why it failed.
type Outcome = Result<Option<String>, String>;

/// One check.
struct Check {
    name: &'static str,
    about: &'static str,
    /// Runs only when asked for by name.
    on_request: bool,
    run: fn(&Workspace) -> Outcome,
}

impl Check {
    const fn new(name: &'static str, about: &'static str, run: fn(&Workspace) -> Outcome) -> Self {
        Self {
            name,
            about,
            on_request: false,
            run,
        }
    }

    const fn on_request(name: &'static str, about: &'static str, run: fn(&Workspace) -> Outcome) -> Self {
        Self {
            name,
            about,
            on_request: true,
            run,
        }
    }
}

/// The checks in the order in which they run: the quick ones first.
const CHECKS: &[Check] = &[
    Check::new("fmt", "the code is formatted", format),
    Check::new(
        "layers",
        "every crate depends on lower layers only",
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
    Check::new(
        "test",
        "the tests of libraries, programs and examples pass",
        tests,
    ),
    Check::new(
        "browser",
        "the report's pages and the explorer in a browser (needs Node.js; installs Chromium)",
        viewer::browser,
    ),
    Check::new(
        "fuzz",
        "a minute of broken inputs breaks no reader",
        broken_inputs,
    ),
    Check::new(
        "octave",
        "Octave and SciPy read the results, the plotting scripts draw them",
        octave::check,
    ),
    Check::new(
        "python",
        "the Python package installs, its tests, types, stubs and notebooks pass (needs Python 3.10)",
        python::check,
    ),
    Check::new(
        "fmu",
        "FMUs are valid and give what runs give, in FMPy (needs Python 3)",
        fmu::check,
    ),
    Check::new(
        "race",
        "tests of the race and of the benchmarks; CVODE agrees with our integrator (installs SUNDIALS)",
        race::check,
    ),
    Check::new(
        "doctest",
        "the examples in the documentation and the example programs run",
        doc_tests,
    ),
    Check::new("doc", "the documentation builds without a warning", docs),
    // Its own installation, of some minutes on a new machine.
    Check::new(
        "book",
        "the documentation builds as a book (installs mdBook)",
        book,
    ),
    Check::new(
        "page",
        "the report's page passes an HTML validator (needs Node.js)",
        page::check,
    ),
    Check::new(
        "readme",
        "the commands of the README and of the tutorial run in their order",
        readme::check,
    ),
    Check::new(
        "deny",
        "licences, duplicates and sources of dependencies",
        deny::check,
    ),
    Check::on_request(
        "advisories",
        "known vulnerabilities of dependencies (needs GitHub)",
        deny::advisories,
    ),
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

fn tests(workspace: &Workspace) -> Outcome {
    // In the release profile: what is tested is what users run (docs/decisions/0008), and it is several times
    // faster. The tests of what is built apart run in the check `race`; benchmarks are left to `cargo xtask
    // bench`, and clippy has compiled them.
    let targets = ["--lib", "--bins", "--tests", "--examples"];
    shell::run(
        workspace
            .cargo(["test", "--release", "--no-fail-fast"])
            .args(SHARED)
            .args(targets),
    )?;
    Ok(None)
}

fn broken_inputs(workspace: &Workspace) -> Outcome {
    crate::fuzz::check(workspace)?;
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
    Run { only: Vec<String>, fail_fast: bool },
}

fn parse(arguments: &[String]) -> Result<Request, String> {
    let mut only = Vec::new();
    let mut fail_fast = false;
    let mut arguments = arguments.iter();
    while let Some(argument) = arguments.next() {
        let names = match argument.as_str() {
            "--help" | "-h" => return Ok(Request::Help),
            "--fail-fast" => {
                fail_fast = true;
                continue;
            }
            "--only" => arguments
                .next()
                .ok_or("`--only` wants names, as in `--only fmt,clippy`.")?
                .as_str(),
            other => other
                .strip_prefix("--only=")
                .ok_or_else(|| format!("`{other}` is unknown; there are `--only` and `--fail-fast`."))?,
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
    Ok(Request::Run { only, fail_fast })
}

/// Returns the checks asked for, in their own order, each once; without names all but those on request.
fn select(only: &[String]) -> Vec<&'static Check> {
    let wanted = |check: &&Check| match only {
        [] => !check.on_request,
        names => names.iter().any(|name| name == check.name),
    };
    CHECKS.iter().filter(wanted).collect()
}

fn help() -> String {
    let mut text = String::from(
        "Usage: cargo xtask test [--only NAME,...] [--fail-fast]\n\n\
         Runs the checks, all of them even if one fails, and ends in a table.\n\n\
         Options:\n  --only NAME,...  only these checks\n  --fail-fast      stop after the first failure\n\n\
         Checks:\n",
    );
    for check in CHECKS {
        let when = if check.on_request { "; only when named" } else { "" };
        text.push_str(&format!("  {:<12}{}{when}\n", check.name, check.about));
    }
    text.push_str("\nExit code: 0, 1 (a check failed), 2 (the call is wrong).");
    text
}

/// Runs the command.
pub fn run(workspace: &Workspace, arguments: &[String]) -> ExitCode {
    let (only, fail_fast) = match parse(arguments) {
        Ok(Request::Run { only, fail_fast }) => (only, fail_fast),
        Ok(Request::Help) => {
            println!("{}", help());
            return ExitCode::SUCCESS;
        }
        Err(message) => {
            eprintln!("{message}\n\n{}", help());
            return ExitCode::from(2);
        }
    };
    let results = run_checks(&select(&only), fail_fast, workspace);
    println!("\n{}", table(&results));
    if passed(&results) {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

/// A check and, if it ran, how long it took and what came out.
struct Line {
    name: &'static str,
    result: Option<(Duration, Outcome)>,
}

fn run_checks(checks: &[&Check], fail_fast: bool, workspace: &Workspace) -> Vec<Line> {
    let mut results = Vec::new();
    let mut stopped = false;
    for check in checks {
        if stopped {
            results.push(Line {
                name: check.name,
                result: None,
            });
            continue;
        }
        println!("\n=== {}: {}", check.name, check.about);
        let start = Instant::now();
        let outcome = (check.run)(workspace);
        let took = start.elapsed();
        match &outcome {
            Ok(Some(note)) => println!("=== {}: ok, {} ({note})", check.name, duration(took)),
            Ok(None) => println!("=== {}: ok, {}", check.name, duration(took)),
            Err(message) => println!("{message}\n=== {}: FAILED, {}", check.name, duration(took)),
        }
        stopped = fail_fast && outcome.is_err();
        results.push(Line {
            name: check.name,
            result: Some((took, outcome)),
        });
    }
    results
}

/// Returns whether nothing failed and nothing was left out.
fn passed(results: &[Line]) -> bool {
    results.iter().all(|line| matches!(line.result, Some((_, Ok(_)))))
}

fn duration(took: Duration) -> String {
    let seconds = took.as_secs_f64();
    if seconds < 60.0 {
        return format!("{seconds:.1} s");
    }
    let seconds = seconds.round() as u64;
    format!("{} min {:02} s", seconds / 60, seconds % 60)
}

fn table(results: &[Line]) -> String {
    let row = |name: &str, result: &str, time: &str, note: &str| {
        format!("{name:<12}{result:<9}{time:>13}  {note}")
            .trim_end()
            .to_owned()
    };
    let mut rows = vec![row("check", "result", "time", "")];
    let mut total = Duration::ZERO;
    for line in results {
        rows.push(match &line.result {
            None => row(line.name, "not run", "", ""),
            Some((took, outcome)) => {
                total += *took;
                match outcome {
                    Ok(note) => row(line.name, "ok", &duration(*took), note.as_deref().unwrap_or("")),
                    Err(_) => row(line.name, "FAILED", &duration(*took), ""),
                }
            }
        });
    }
    let result = if passed(results) { "ok" } else { "FAILED" };
    rows.push(row("total", result, &duration(total), ""));
    rows.join("\n")
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
            select(&only).iter().map(|check| check.name).collect()
        };
        assert_eq!(names(&["clippy", "fmt", "clippy"]), ["fmt", "clippy"]);
        assert_eq!(names(&["advisories"]), ["advisories"]);
        assert_eq!(names(&[]).len(), CHECKS.len() - 1);
        assert!(!names(&[]).contains(&"advisories"));
    }

    #[test]
    fn a_failure_does_not_hide_the_others() {
        let checks = [
            Check::new("a", "", |_| Ok(Some("a note".to_owned()))),
            Check::new("b", "", |_| Err("broken".to_owned())),
            Check::new("c", "", |_| Ok(None)),
        ];
        let checks: Vec<&Check> = checks.iter().collect();
        let workspace = Workspace::find();

        let all = run_checks(&checks, false, &workspace);
        assert!(all.iter().all(|line| line.result.is_some()) && !passed(&all));
        let text = table(&all);
        assert!(text.contains("a note") && text.contains("FAILED"), "{text}");

        let fast = run_checks(&checks, true, &workspace);
        assert!(fast[2].result.is_none() && !passed(&fast));
        assert!(table(&fast).contains("c           not run"));

        assert!(passed(&run_checks(&checks[..1], true, &workspace)));
    }

    #[test]
    fn durations_read_well() {
        assert_eq!(duration(Duration::from_millis(440)), "0.4 s");
        assert_eq!(duration(Duration::from_secs(123)), "2 min 03 s");
    }
}
