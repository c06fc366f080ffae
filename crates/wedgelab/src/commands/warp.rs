//! `wedgelab warp`: warp moment over warp angle, as a table that an engineer puts into an industry program.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use report::drawn::Drawn;
use report::terminal::TerminalTable;
use report::warp_files::{self, KIP_INCH, NAMES, Tested};
use study::truck::TruckCase;
use study::truck::run::TruckResult;
use study::truck::warp::{NUCARS_STIFFNESS, WarpCurve};

use super::run::read_any;
use crate::execute::{Done, compute, unsound_unwritten};
use crate::failure::{Failure, Message, say};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;

/// Warp moment of a truck over the warp angle, its parts and stiffness
///
/// Runs a warp test (truck_warp_nest_... or truck_warp_axles_..., or your own case in which the warp angle
/// moves), and writes warp.csv (moment, stiffness and the moment's parts at 0.5 to 20 mrad), warp_loops.csv,
/// warp.pwl (the same for one nest as piecewise linear functions of NUCARS), warp.svg and warp.png. Several
/// values of --friction, --toe, --wear make one test for each combination. NUCARS's empirical lines for new
/// and worn trucks are beside them.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab warp
  wedgelab warp my_truck.toml --worn
  wedgelab warp truck_crowned_warp_nest_variable --friction 0.2 0.3 0.4 --out friction
  wedgelab warp truck_crowned_warp_nest_constant --rise \"0 in\" \"0.5 in\" \"1 in\"
  wedgelab warp truck_warp_axles_constant_rising_empty --set truck.condition=mu_0.25")]
pub struct Arguments {
    /// Case file, or the name of a built-in case [default: truck_crowned_warp_nest_constant, new and worn]
    case: Option<PathBuf>,
    #[command(flatten)]
    varied: Varied,
    /// Beside the case the same truck worn: friction of 0.25 and a wedge rise of 0.75 in
    #[arg(long, conflicts_with_all = ["friction", "toe", "wear", "rise"])]
    worn: bool,
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
    /// Rises of all wedges in their pockets, such as "0.5 in", in place of depths of wear; in equilibrium too
    #[arg(long, value_name = "RISE", num_args = 1.., conflicts_with = "wear")]
    rise: Vec<String>,
    /// Set one value over those of the case
    #[arg(long, value_name = "PATH.KEY=VALUE")]
    set: Vec<String>,
}

/// A truck new and worn, where no case is named.
const DEFAULT: &str = "truck_crowned_warp_nest_constant";
/// Friction and rise of a worn truck: guesses, and so is that both come together.
const WORN: [&str; 4] = [
    "friction.column=0.25",
    "friction.slope=0.25",
    "wedge.rise=0.75 in",
    "start.kind=equilibrium",
];

impl Arguments {
    /// Returns the cases with their labels, each with the worn truck beside it if that is asked for.
    fn cases(&self) -> Result<Vec<(String, TruckCase)>, Failure> {
        let varied = &self.varied;
        let path = self.case.as_deref().unwrap_or(Path::new(DEFAULT));
        let one = [&varied.friction, &varied.toe, &varied.wear, &varied.rise]
            .iter()
            .all(|own| own.is_empty());
        if !self.worn && (self.case.is_some() || !one) {
            return varied.cases(path);
        }
        let worn = WORN.map(str::to_owned);
        let worn: Vec<String> = varied.set.iter().cloned().chain(worn).collect();
        Ok(vec![
            ("new".to_owned(), truck(path, &varied.set)?),
            (
                "worn: friction 0.25, rise 0.75 in".to_owned(),
                truck(path, &worn)?,
            ),
        ])
    }
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let cases = arguments.cases()?;
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
            let advice = "take truck_crowned_warp_nest_constant, or move the side frames' yaw or the \
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
         energy that the last whole cycle takes. Below some 10 mrad the faces decide, their crown first, \
         then their points and\n\
         contact.stiffness; above it friction, wear, and whether the nest locks. NUCARS's lines are chords \
         over 30 mrad.\n\nWritten into {}: {}.",
        folder.path().display(),
        NAMES.join(", ")
    )?;
    early.map_or(Ok(ExitCode::SUCCESS), Err)
}

impl Varied {
    /// Returns the case with all combinations of what is varied, with labels.
    pub fn cases(&self, case: &Path) -> Result<Vec<(String, TruckCase)>, Failure> {
        let none = |list: &[String], set: &dyn Fn(&str) -> Variant| match list {
            [] => vec![Variant::default()],
            several => several.iter().map(|own| set(own)).collect(),
        };
        const FACES: [&str; 2] = ["column", "slope"];
        let in_equilibrium = |mut set: Vec<String>| {
            set.push("start.kind=equilibrium".to_owned());
            set
        };
        let frictions = none(&self.friction, &|own| {
            let set = FACES.map(|face| format!("friction.{face}={own}"));
            (format!("friction {own}"), set.to_vec())
        });
        let toes = none(&self.toe, &|own| {
            (format!("toe {own}"), vec![format!("side_frame.toe={own}")])
        });
        let worn = match self.rise.as_slice() {
            [] => none(&self.wear, &|own| {
                let set = FACES.map(|face| format!("wedge.{face}_wear={own}"));
                (format!("wear {own}"), in_equilibrium(set.to_vec()))
            }),
            rises => none(rises, &|own| {
                let set = vec![format!("wedge.rise={own}")];
                (format!("rise {own}"), in_equilibrium(set))
            }),
        };
        let mut cases = Vec::new();
        for friction in &frictions {
            for toe in &toes {
                for worn in &worn {
                    let parts = [friction, toe, worn];
                    let labels = parts.iter().map(|own| &*own.0).filter(|own| !own.is_empty());
                    let labels: Vec<&str> = labels.collect();
                    let set = parts.iter().flat_map(|own| own.1.iter().cloned());
                    let set: Vec<String> = self.set.iter().cloned().chain(set).collect();
                    cases.push((labels.join(", "), truck(case, &set)?));
                }
            }
        }
        Ok(cases)
    }
}

/// The label of a test among others, and what it sets.
type Variant = (String, Vec<String>);

/// Returns the case of a truck with values laid over it.
pub(super) fn truck(case: &Path, set: &[String]) -> Result<TruckCase, Failure> {
    let any = read_any(case, set)?;
    if let Some(truck) = any.truck() {
        return Ok(TruckCase::clone(truck));
    }
    let what = any.wedge().map_or(any.model(), |_| "single wedge");
    let message = format!(
        "{} is the case of a {what}; a truck's is expected",
        case.display()
    );
    let advice = "take a built-in truck (`wedgelab case` lists them), or a case with model = \"truck\"";
    Err(Message::new(message, advice).into())
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
