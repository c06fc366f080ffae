//! `wedgelab lock-up`: where a wedge locks up, over two of its parameters.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use report::drawn::Drawn;
use report::lock_up_files::{self, NAMES};
use study::lock_up::{LockUpMap, MapError, MapRange, RigOutcome, map};

use super::run::read;
use crate::execute::jobs;
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Steady;

/// Lock-up of a wedge over two of its parameters: margins and outcomes of runs
///
/// At each point of a map over two of angle, friction, toe, crown and yaw, computes the lock-up margin of the
/// massless wedge (the angle at which the faces close on the wedge, less the friction angles of both), and
/// runs a rig: the bolster presses the wedge against the column. If the margin is not positive the wedge
/// locks and its normal forces grow against the stiffness of the contacts; else it slides away. Writes
/// lock_up.csv, lock_up.svg and lock_up.png.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab lock-up
  wedgelab lock-up my_wedge.toml --over \"toe=5 deg in..5 deg out\" friction=0.1..0.6
  wedgelab lock-up --over \"yaw=0 mrad..40 mrad\" \"angle=25 deg..50 deg\" --set friction.column=0.3
  wedgelab lock-up --over \"crown=20 in..500 in\" friction=0.1..0.6 --points 25

Axes: angle (of the wedge), friction (of both faces), toe (with its direction), crown (radius, up the
wedge's vertical face), yaw (of the pocket). Motions of the case are left out.")]
pub struct Arguments {
    /// Case file of a single wedge, or the name of a built-in case
    #[arg(default_value = "lock_up_friction_0.4")]
    case: PathBuf,
    /// The two axes, each with its ends
    #[arg(long, value_name = "AXIS=FROM..TO", num_args = 1..,
          default_values = ["angle=20 deg..50 deg", "friction=0.1..0.6"], value_parser = MapRange::parse)]
    over: Vec<MapRange>,
    /// Number of points along each axis, 2 to 200
    #[arg(long, value_name = "N", default_value = "15", value_parser = points)]
    points: usize,
    /// Set one value over those of the case
    #[arg(long, value_name = "PATH.KEY=VALUE")]
    set: Vec<String>,
    /// Number of runs at a time [default: number of processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Folder to write into [default: NAME_lock_up]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

fn points(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(points) if (2..=200).contains(&points) => Ok(points),
        Ok(0 | 1) => Err("one point along an axis is no map; give 2 to 200".to_owned()),
        _ => Err("give a whole number from 2 to 200".to_owned()),
    }
}

/// Returns the failure of a map.
fn refused(error: MapError) -> Failure {
    let message = error.to_string();
    match error {
        MapError::Case(error) => error.into(),
        MapError::SameAxis(_) => Message::new(
            message,
            "give two different ones of angle, friction, toe, crown, yaw",
        )
        .into(),
        MapError::OnePoint(_) => Message::new(message, "give at least 2 points").into(),
        MapError::Interrupted(_) => {
            Failure::Interrupted(Message::new(message, "no rig had ended, and nothing is written").into())
        }
    }
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let [first, second] = *arguments.over.as_slice() else {
        let message = format!("a map has two axes, and --over has {}", arguments.over.len());
        let advice = "write for example --over \"angle=20 deg..50 deg\" friction=0.1..0.6";
        return Err(Message::new(message, advice).into());
    };
    let case = read(&arguments.case, &arguments.set)?;
    let path = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}_lock_up", case.name)));
    let folder = folders::check(path, &NAMES, arguments.force)?;
    let jobs = jobs(arguments.jobs);
    let all = arguments.points * arguments.points;
    let progress = Steady::new("rigs", all as u64, 0, arguments.quiet);
    interrupt::stops(
        "stopping: the rigs that have ended are written (once more: ends at once and writes nothing)",
        "nothing was written",
    );
    let found = map(&case, [first, second], arguments.points, jobs, |_| {
        interrupt::go_on()
    });
    progress.finish();
    let found = found.map_err(refused)?;
    let units = case.simulation.output_units;
    let figure = Drawn::of(&lock_up_files::figure(&case, &found, units))?;
    folder.write(|files| {
        files.add(lock_up_files::TABLE, |out| {
            lock_up_files::write_table(&found, units, out)
        })?;
        figure.add(files, lock_up_files::FIGURE, lock_up_files::PICTURE)
    })?;
    let mut out = io::stdout().lock();
    print_map(&found, &mut out)?;
    writeln!(
        out,
        "\nWritten into {}: {}.",
        folder.path().display(),
        NAMES.join(", ")
    )?;
    let Some(reason) = &found.interrupted else {
        return Ok(ExitCode::SUCCESS);
    };
    let left = found.cells.iter().filter(|cell| match &cell.found {
        RigOutcome::Unknown(why) => why == reason,
        _ => false,
    });
    let message = format!("{reason}: {} of {all} rigs were not run", left.count());
    let advice = "their points have the closed form alone, and are marked as unknown; the same command with \
                  --force makes the whole map, and fewer --points are sooner done";
    Err(Failure::Interrupted(Message::new(message, advice).into()))
}

/// Prints the findings.
fn print_map(found: &LockUpMap, out: &mut dyn Write) -> io::Result<()> {
    let [locks, slides, wrong] = found.counts();
    let margins = found.cells.iter().map(|cell| cell.margin.to_degrees());
    let (least, most) = margins.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), margin| {
        (least.min(margin), most.max(margin))
    });
    let others = found.cells.len() - locks - slides;
    writeln!(
        out,
        "{} points: {locks} rigs lock up, {slides} slide, {others} tell nothing. The lock-up margin goes \
         from {least:.2} to {most:.2} deg.",
        found.cells.len()
    )?;
    if wrong == 0 {
        writeln!(out, "Every rig agrees with the sign of its margin.")
    } else {
        writeln!(
            out,
            "{wrong} rigs contradict the sign of their margin; the largest such margin is {:.2} deg.",
            found.disagreement().to_degrees()
        )
    }
}
