//! `wedgelab warp`: warp moment over warp angle, as a table that an engineer puts into an industry program.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use report::warp_files::{self, KIP_INCH, NAMES, Tested};
use study::any_case::AnyCase;
use study::truck::TruckCase;
use study::truck::run::TruckResult;
use study::truck::warp::{NUCARS_STIFFNESS, WarpCurve};

use super::run::read_any;
use crate::drawn::Drawn;
use crate::execute::{Done, compute, unsound_unwritten};
use crate::failure::{Failure, Message, say};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;
use crate::table::TerminalTable;

/// Warp moment of a truck over the warp angle, its parts and stiffness
///
/// Runs a warp test (truck_warp_nest_... or truck_warp_axles_..., or your own case in which the warp angle
/// moves), and writes warp.csv (moment, stiffness and the moment's parts at 0.5 to 20 mrad), warp_loops.csv,
/// warp.pwl (the same for one nest as piecewise linear functions of NUCARS), warp.svg and warp.png. Several
/// values of --friction, --toe, --wear make one test for each combination. NUCARS's empirical lines for new
/// and worn trucks are included for comparison.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab warp truck_warp_nest_constant_rising
  wedgelab warp truck_warp_nest_variable_rising --friction 0.2 0.3 0.4 --out friction
  wedgelab warp truck_warp_axles_constant_rising_empty --set truck.condition=worn")]
pub struct Arguments {
    /// Case file, or the name of a built-in case
    #[arg(default_value = "truck_warp_nest_constant_rising")]
    case: PathBuf,
    #[command(flatten)]
    varied: Varied,
    /// Folder to write into [default: NAME_warp]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// Values that vary from test to test.
#[derive(Debug, Args)]
pub struct Varied {
    /// Coefficients of friction of all wedges at column and slope
    #[arg(long, value_name = "MU", num_args = 1..)]
    friction: Vec<String>,
    /// Toes of all columns, such as "0.2 deg out"
    #[arg(long, value_name = "ANGLE", num_args = 1..)]
    toe: Vec<String>,
    /// Depths of wear of all columns and slopes, such as "0.1 in"; the truck then starts in equilibrium
    #[arg(long, value_name = "DEPTH", num_args = 1..)]
    wear: Vec<String>,
    /// Set one value over those of the case
    #[arg(long, value_name = "PATH.KEY=VALUE")]
    set: Vec<String>,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let cases = arguments.varied.cases(&arguments.case)?;
    let Some((_, first)) = cases.first() else {
        return Ok(ExitCode::SUCCESS);
    };
    let path = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}_warp", first.name)));
    let folder = folders::check(path, &NAMES, arguments.force)?;
    let progress = Progress::new(cases.len(), arguments.quiet);
    interrupt::stops(STOPPING, "nothing was written");
    let mut tests = Vec::new();
    for (label, case) in &cases {
        let Some(result) = run(label, case, &progress)? else {
            break;
        };
        let Some(curve) = WarpCurve::of(case, &result) else {
            progress.finish();
            let message = format!("in {} the warp angle stays below 0.5 mrad", case.name);
            let advice = "take truck_warp_nest_constant_rising, or move the side frames' yaw or the \
                          wheelsets against each other";
            return Err(Message::new(message, advice).into());
        };
        tests.push(Tested {
            label: label.clone(),
            result,
            curve,
        });
    }
    progress.finish();
    let early = interrupted(tests.len(), cases.len());
    if tests.is_empty() {
        return early.map_or(Ok(ExitCode::SUCCESS), Err);
    }
    let figure = Drawn::of(&warp_files::figure(&tests))?;
    folder.write(|files| {
        files.add(warp_files::STIFFNESS, |out| {
            warp_files::write_stiffness(&tests, out)
        })?;
        files.add(warp_files::LOOPS, |out| warp_files::write_loops(&tests, out))?;
        files.add(warp_files::PWL, |out| warp_files::write_pwl(&tests, out))?;
        figure.add(files, warp_files::FIGURE, warp_files::PICTURE)
    })?;
    let mut out = io::stdout().lock();
    table(&tests).write(&mut out)?;
    writeln!(
        out,
        "\nWarp moment on the bolster over the warp angle where an angle is reached first, of the whole \
         truck, kip·in/mrad. Loop:\n\
         energy that the last whole cycle takes. Where a nest locks, contact.stiffness and the bristles \
         set the moment.\n\nWritten into {}: {}.",
        folder.path().display(),
        NAMES.join(", ")
    )?;
    early.map_or(Ok(ExitCode::SUCCESS), Err)
}

impl Varied {
    /// Returns the case with all combinations of what is varied, with labels.
    pub fn cases(&self, case: &Path) -> Result<Vec<(String, TruckCase)>, Failure> {
        let none = |list: &[String]| {
            if list.is_empty() {
                vec![None]
            } else {
                list.iter().cloned().map(Some).collect()
            }
        };
        let mut cases = Vec::new();
        for friction in none(&self.friction) {
            for toe in none(&self.toe) {
                for wear in none(&self.wear) {
                    let (mut set, mut labels) = (self.set.clone(), Vec::new());
                    if let Some(friction) = &friction {
                        set.extend(["column", "slope"].map(|face| format!("friction.{face}={friction}")));
                        labels.push(format!("friction {friction}"));
                    }
                    if let Some(toe) = &toe {
                        set.push(format!("side_frame.toe={toe}"));
                        labels.push(format!("toe {toe}"));
                    }
                    if let Some(wear) = &wear {
                        set.extend(["column", "slope"].map(|face| format!("wedge.{face}_wear={wear}")));
                        set.push("start.kind=equilibrium".to_owned());
                        labels.push(format!("wear {wear}"));
                    }
                    let case = match read_any(case, &set)? {
                        AnyCase::Truck(case) => *case,
                        other => {
                            let what = match &other {
                                AnyCase::Car(_) => "a car",
                                AnyCase::HalfTruck(_) => "a half-truck",
                                _ => "a single wedge",
                            };
                            let message =
                                format!("{} is the case of {what}; a truck's is expected", other.name());
                            let advice = "take a built-in truck (`wedgelab case` lists them), or a case \
                                          with model = \"truck\"";
                            return Err(Message::new(message, advice).into());
                        }
                    };
                    cases.push((labels.join(", "), case));
                }
            }
        }
        Ok(cases)
    }
}

/// The message of a command that runs several tests on a first signal.
pub const STOPPING: &str =
    "stopping: the tests that have ended are written (once more: ends at once and writes nothing)";

/// Returns the message of an interrupted command that has made so many of its tests; `None` if it was not.
pub fn interrupted(made: usize, all: usize) -> Option<Failure> {
    if made == all || !interrupt::wanted() {
        return None;
    }
    let message = format!("{}: {made} of {all} tests have ended", interrupt::REASON);
    let advice = match made {
        0 => "nothing is written; the same command begins anew",
        _ => "they are written; the same command with --force makes all of them, from the start",
    };
    Some(Failure::Interrupted(Message::new(message, advice).into()))
}

/// Runs one test: its progress and warnings go to standard error. `None` if it was interrupted.
pub fn run(label: &str, case: &TruckCase, progress: &Progress) -> Result<Option<TruckResult>, Failure> {
    if interrupt::wanted() {
        return Ok(None);
    }
    let Done { result, wall } = compute(case, progress)?;
    if interrupt::is_reason(result.summary.stopped.as_ref()) {
        return Ok(None);
    }
    progress.done(&case.name, &format!("{:.2} s", wall.as_secs_f64()));
    if let Some(failure) = unsound_unwritten::<TruckCase>(&result.summary) {
        progress.finish();
        return Err(failure);
    }
    for warning in &result.summary.warnings {
        say(&format!(
            "warning: {}: {warning}",
            if label.is_empty() { &case.name } else { label }
        ));
    }
    Ok(Some(result))
}

/// Returns the table of stiffnesses.
fn table(tests: &[Tested]) -> TerminalTable {
    let mut table = TerminalTable::new(
        1,
        &[
            ("test", ""),
            ("0.5", "mrad"),
            ("1", "mrad"),
            ("2", "mrad"),
            ("5", "mrad"),
            ("10", "mrad"),
            ("20", "mrad"),
            ("from 10 to 20 mrad", ""),
            ("loop", "kip·in"),
        ],
    );
    let per_mrad = |stiffness: f64| format!("{:.1}", 1e-3 * stiffness / KIP_INCH);
    for test in tests {
        let mut cells = vec![if test.label.is_empty() {
            test.result.summary.name.clone()
        } else {
            test.label.clone()
        }];
        for angle in study::truck::summary::WARP_ANGLES {
            let found = test.curve.stiffness.iter().find(|(own, _)| *own == 1e-3 * angle);
            cells.push(found.map_or("-".to_owned(), |(_, stiffness)| per_mrad(*stiffness)));
        }
        cells.push(warp_files::growth_in_words(test.curve.growth));
        cells.push(
            test.curve
                .loop_area
                .map_or("-".to_owned(), |area| format!("{:.2}", area / KIP_INCH)),
        );
        table.row(cells);
    }
    for (name, stiffness) in NUCARS_STIFFNESS {
        let mut cells = vec![name.to_owned()];
        cells.extend(std::iter::repeat_n(per_mrad(stiffness), 6));
        cells.extend(["", "0"].map(str::to_owned));
        table.row(cells);
    }
    table
}
