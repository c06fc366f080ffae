//! Who runs: the solvers, how each is started, and with which options.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::problem::is_yawed;
use crate::wedge_case::WedgeCase;

/// The paths of the programs of the race.
#[derive(Clone, Debug)]
pub struct Tools {
    /// This program.
    pub own: PathBuf,
    /// The dynamic library with the equations.
    pub library: PathBuf,
    /// The drivers' sources.
    pub drivers: PathBuf,
    /// The driver of CVODE, compiled.
    pub cvode: Option<PathBuf>,
    /// A Python with SciPy.
    pub python: Option<PathBuf>,
    /// A Python with Exudyn.
    pub exudyn: Option<PathBuf>,
    /// Octave, and the folder with the compiled `race_mex`.
    pub octave: Option<(PathBuf, PathBuf)>,
}

/// The program that runs a solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Program {
    /// Compiled in.
    Own,
    /// `drivers/cvode.c`.
    Cvode,
    /// `drivers/scipy_race.py`.
    Scipy,
    /// `drivers/ode15s_race.m`.
    Octave,
    /// `drivers/exudyn_planar.py`.
    Exudyn,
}

/// A solver of the race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solver {
    /// Its name in tables and figures.
    pub name: &'static str,
    /// Its program.
    pub program: Program,
    /// Its name in the program.
    pub method: &'static str,
    /// True for this project's integrator.
    pub ours: bool,
    /// Simulated time that it is given, s: less where ten seconds would take hours.
    pub span: f64,
    /// Options beyond its defaults.
    pub options: &'static str,
}

/// Our default method with contact modes recorded, which no other solver does.
pub const RECORDED: &str = "wedgelab Rodas5P, modes recorded";

/// Octave's ode15s with the right-hand side in Octave's own language.
pub const IN_OCTAVE: &str = "Octave ode15s with equations in Octave";

const SAME: &str = "absolute tolerance = tolerance × scale for each state, no relative one";

/// All solvers.
pub const SOLVERS: &[Solver] = &[
    Solver {
        name: "wedgelab Rodas5P",
        program: Program::Own,
        method: "rodas5p",
        ours: true,
        span: 10.0,
        options: "defaults (all quadratures of the energy ledger, discontinuities predicted; a wedge's \
                  positions and speeds held to 1e-5 of their scales where a wider tolerance is asked for), \
                  but contact modes not recorded",
    },
    Solver {
        name: "wedgelab TR-BDF2",
        program: Program::Own,
        method: "own_tr_bdf2",
        ours: true,
        span: 10.0,
        options: "the same, method TR-BDF2: the tolerance holds for displacements alone; steps of 0.01 s at \
                  most, the distance of the rows",
    },
    Solver {
        name: "wedgelab ESDIRK3",
        program: Program::Own,
        method: "own_esdirk3",
        ours: true,
        span: 10.0,
        options: "the same, method ESDIRK3",
    },
    Solver {
        name: RECORDED,
        program: Program::Own,
        method: "rodas5p_recorded",
        ours: true,
        span: 10.0,
        options: "defaults, as in users' runs: contact modes recorded, their changes located",
    },
    Solver {
        name: "CVODE BDF",
        program: Program::Cvode,
        method: "bdf",
        ours: false,
        span: 10.0,
        options: "dense analytic Jacobian; up to 1000 failed error tests and Newton failures in a step",
    },
    Solver {
        name: "diffsol BDF",
        program: Program::Own,
        method: "bdf",
        ours: false,
        span: 10.0,
        options: "max_nonlinear_solver_failures and max_error_test_failures unlimited",
    },
    Solver {
        name: "diffsol TR-BDF2",
        program: Program::Own,
        method: "tr_bdf2",
        ours: false,
        span: 10.0,
        options: "the same",
    },
    Solver {
        name: "diffsol ESDIRK34",
        program: Program::Own,
        method: "esdirk34",
        ours: false,
        span: 10.0,
        options: "the same",
    },
    Solver {
        name: "SciPy LSODA",
        program: Program::Scipy,
        method: "lsoda",
        ours: false,
        span: 10.0,
        options: "through odeint, analytic Jacobian, unlimited steps",
    },
    Solver {
        name: "SciPy BDF",
        program: Program::Scipy,
        method: "bdf",
        ours: false,
        span: 10.0,
        options: "analytic Jacobian, relative tolerance 1e-13",
    },
    Solver {
        name: "SciPy Radau",
        program: Program::Scipy,
        method: "radau",
        ours: false,
        span: 10.0,
        options: "analytic Jacobian, relative tolerance 1e-13",
    },
    Solver {
        name: "Octave ode15s",
        program: Program::Octave,
        method: "compiled",
        ours: false,
        span: 1.0,
        options: "first step 1e-9 s, analytic Jacobian, relative tolerance 1e-13",
    },
    Solver {
        name: IN_OCTAVE,
        program: Program::Octave,
        method: "octave",
        ours: false,
        span: 1.0,
        options: "right-hand side in Octave's language (drivers/wedge_rates.m), Jacobian by ode15s's own \
                  differences, first step 1e-9 s, relative tolerance 1e-13; the yawed cases only",
    },
    Solver {
        name: "Exudyn",
        program: Program::Exudyn,
        method: "generalized_alpha",
        ours: false,
        span: 10.0,
        options: "see drivers/exudyn_planar.py",
    },
];

/// The remarks that hold for all solvers.
pub const COMMON_OPTIONS: &str = SAME;

/// Returns the solver of this name in programs and tables.
#[must_use]
pub fn solver(name: &str) -> Option<&'static Solver> {
    SOLVERS.iter().find(|solver| solver.name == name)
}

impl Solver {
    /// Returns whether it can take part in a problem, and its tool is there.
    #[must_use]
    pub fn takes_part(&self, tools: &Tools, case: &str) -> bool {
        match self.program {
            Program::Own => true,
            Program::Cvode => tools.cvode.is_some(),
            Program::Scipy => tools.python.is_some(),
            // In Octave's own language a run takes minutes: where the aim is, and no further.
            Program::Octave => tools.octave.is_some() && (self.name != IN_OCTAVE || is_yawed(case)),
            Program::Exudyn => tools.exudyn.is_some() && case.starts_with("planar"),
        }
    }

    /// Returns the command of one run.
    #[must_use]
    pub fn command(
        &self,
        tools: &Tools,
        case: &str,
        tolerance: &str,
        limit: f64,
        file: &Path,
        rows: usize,
    ) -> Option<Command> {
        let mut command = match self.program {
            Program::Own => {
                let mut command = Command::new(&tools.own);
                command.args(["solve", self.method]);
                command
            }
            Program::Cvode => Command::new(tools.cvode.as_ref()?),
            Program::Scipy => {
                let mut command = Command::new(tools.python.as_ref()?);
                command
                    .arg(tools.drivers.join("scipy_race.py"))
                    .arg(&tools.library)
                    .arg(self.method);
                command
            }
            Program::Octave => {
                let (octave, folder) = tools.octave.as_ref()?;
                let mut command = Command::new(octave);
                command
                    .args(["--no-init-file", "--quiet"])
                    .arg(tools.drivers.join("ode15s_race.m"))
                    .arg(self.method);
                if self.name == IN_OCTAVE {
                    command.arg(WedgeCase::named(case).ok()?.json().ok()?);
                } else {
                    command.arg(folder);
                }
                command
            }
            Program::Exudyn => {
                let mut command = Command::new(tools.exudyn.as_ref()?);
                command
                    .arg(tools.drivers.join("exudyn_planar.py"))
                    .arg(&tools.library);
                command
            }
        };
        command
            .args([case, tolerance])
            .arg(limit.to_string())
            .arg(file)
            .arg(rows.to_string());
        // One thread each: libraries for linear algebra would start more.
        command
            .env("OMP_NUM_THREADS", "1")
            .env("OPENBLAS_NUM_THREADS", "1");
        Some(command)
    }
}
