//! `cargo xtask race`: our integrator and other people's solvers on the same equations, side by side in one
//! run.

pub mod tools;

use std::process::{Command, ExitCode};

use crate::machine::Machine;
use crate::shell::{self, Workspace};

const HELP: &str = "\
Usage: cargo xtask race [--quick | --page] [--again] [options of the race]

Builds the race and its drivers, installs what they need (Debian: SUNDIALS, Octave; into target/tools: \
SciPy, Exudyn), runs all
solvers on the thesis's twelve cases, the planar wedge and the stick test, and writes all runs into \
target/race. A race over all
cases, solvers and tolerances writes docs/race.md, its figures, and its results into docs/measured/race.json.
Octave runs with the compiled equations and, on the yawed cases, with equations in its own language.
Runs that are there already are kept; --again begins anew.
What is Rust is compiled for processors with AVX2; with RUSTFLAGS=\"-C target-cpu=x86-64\" for all.

  --page              run nothing, write docs/race.md from docs/measured/race.json
  --quick             four cases at three tolerances, without Octave: two to three minutes
  --cases PART,...    problems whose names contain one of the parts
  --solvers PART,...  solvers likewise
  --tolerances T,...  some of 1e-3, 1e-4, ... 1e-9
  --limit SECONDS     CPU time of a run (60)
  --starts NUMBER     starts of each case of which only means are compared (5): errors are their root mean \
square
  --short SECONDS     simulated time of Octave's runs (1); 10: minutes a run
  --kept-only yes     run nothing, judge what was kept";

/// The runs of `--quick`.
const QUICK: [&str; 8] = [
    "--cases",
    "vdrun_toe_out_0.2_psi_0.012,cdrun_toe_0_psi_0.012,planar_constant,stick",
    "--tolerances",
    "1e-3,1e-5,1e-7",
    "--solvers",
    "wedgelab,CVODE,diffsol,SciPy,Exudyn",
    "--limit",
    "5",
];

/// Runs the command.
pub fn run(workspace: &Workspace, arguments: &[String]) -> ExitCode {
    if matches!(arguments, [only] if only == "--help" || only == "-h") {
        println!("{HELP}");
        return ExitCode::SUCCESS;
    }
    match start(workspace, arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn start(workspace: &Workspace, arguments: &[String]) -> Result<(), String> {
    let has = |name: &str| arguments.iter().any(|argument| argument == name);
    let docs = workspace.root.join("docs");
    if has("--page") {
        shell::run(&mut workspace.cargo(["build", "--release", "--package", "race"]))?;
        let mut race = Command::new(workspace.target.join("release").join("race"));
        let [results, page] = [docs.join("measured").join("race.json"), docs.join("race.md")];
        return shell::run(race.arg("page").args([results, page]));
    }
    let quick = has("--quick");
    let rest = arguments
        .iter()
        .filter(|argument| !matches!(argument.as_str(), "--quick" | "--again"));
    let folder = workspace.target.join(if quick { "race-quick" } else { "race" });
    if has("--again") && folder.exists() {
        std::fs::remove_dir_all(&folder)
            .map_err(|error| format!("cannot remove {}: {error}", folder.display()))?;
    }
    let tools = tools::prepare(workspace, !quick)?;
    let mut race = Command::new(&tools.race);
    race.arg("all").args(tools.arguments()).arg("--out").arg(folder);
    if quick {
        race.args(QUICK);
    } else {
        let machine = Machine::here();
        race.arg("--docs").arg(docs);
        race.args([
            "--machine",
            &machine.processor,
            "--cores",
            &machine.cores.to_string(),
        ]);
        race.args(["--date", &machine.date, "--rustc", &machine.rustc]);
    }
    shell::run(race.args(rest))
}
