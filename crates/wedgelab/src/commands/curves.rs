//! `wedgelab curves`: stiffness and friction of a truck up and down, and in roll.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use quantity::{Kind, System as Units};
use report::csv::converted;
use report::curves_files::{self, LabeledLoop, NAMES};
use report::drawn::Drawn;
use report::terminal::TerminalTable;
use study::truck::loop_curve::{LoopCurve, LoopKind};

use super::warp::{STOPPING, Varied, interrupted, run};
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;

/// Stiffness, friction and energy of a truck whose bolster moves up and down or rolls
///
/// Runs a truck_vertical_... or truck_roll_... rig, or a case of your own in which the bolster's vertical
/// motion or roll is periodic, and writes curves.csv (the loop of the last whole cycle), curves.svg and
/// curves.png. Several values of
/// --friction, --toe, --wear make one test for each combination.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab curves truck_vertical_variable --friction 0.2 0.4
  wedgelab curves truck_roll_constant --set truck.condition=mu_0.25")]
pub struct Arguments {
    /// Case file, or the name of a built-in case
    #[arg(default_value = "truck_vertical_variable")]
    case: PathBuf,
    #[command(flatten)]
    varied: Varied,
    /// Folder to write into [default: NAME_curves]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let cases = arguments.varied.cases(&arguments.case)?;
    let Some((_, first)) = cases.first() else {
        return Ok(ExitCode::SUCCESS);
    };
    let name = first.name.clone();
    let path = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{name}_curves")));
    let folder = folders::check(path, &NAMES, arguments.force)?;
    let progress = Progress::new(cases.len(), arguments.quiet);
    interrupt::stops(STOPPING, "nothing was written");
    let mut loops: Vec<LabeledLoop> = Vec::new();
    for (label, case) in &cases {
        let Some(result) = run(label, case, &progress)? else {
            break;
        };
        let Some(curve) = LoopCurve::of(case, &result) else {
            progress.finish();
            let message = format!(
                "in {} the bolster makes no whole cycle up and down, or in roll",
                case.name
            );
            let advice = "take truck_vertical_variable or truck_roll_variable, or a longer duration; \
                          `wedgelab warp` is for warp";
            return Err(Message::new(message, advice).into());
        };
        loops.push((label.clone(), curve));
    }
    progress.finish();
    let early = interrupted(loops.len(), cases.len());
    if loops.is_empty() {
        return early.map_or(Ok(ExitCode::SUCCESS), Err);
    }
    let figure = Drawn::of(&curves_files::figure(&loops))?;
    folder.write(|files| {
        files.add(curves_files::LOOPS, |out| curves_files::write(&loops, out))?;
        figure.add(files, curves_files::FIGURE, curves_files::PICTURE)
    })?;
    let mut out = io::stdout().lock();
    table(&name, &loops).write(&mut out)?;
    writeln!(
        out,
        "\nOf both nests, over the last whole cycle. Stiffness: from the lower to the upper end. \
         Friction: half the width of the loop in\n\
         its middle. Energy: its area. Loss ratio: energy over 2 pi, stiffness and the square of the \
         amplitude.\n\nWritten into {}: {}.",
        folder.path().display(),
        NAMES.join(", ")
    )?;
    early.map_or(Ok(ExitCode::SUCCESS), Err)
}

/// Returns the table of loops.
fn table(name: &str, loops: &[LabeledLoop]) -> TerminalTable {
    let vertical = loops
        .first()
        .is_none_or(|(_, own)| own.kind == LoopKind::Vertical);
    let units = if vertical {
        ["in", "lbf/in", "lbf", "lbf·in"]
    } else {
        ["mrad", "kip·in/mrad", "kip·in", "lbf·in"]
    };
    let mut table = TerminalTable::new(
        1,
        &[
            ("test", ""),
            ("amplitude", units[0]),
            ("stiffness", units[1]),
            ("friction", units[2]),
            ("energy", units[3]),
            ("loss ratio", ""),
        ],
    );
    let us = |value: f64, kind: Kind| converted(value, kind, Units::Us);
    for (label, own) in loops {
        let numbers = match own.kind {
            LoopKind::Vertical => [
                format!("{:.3}", us(own.amplitude, Kind::Length)),
                format!("{:.0}", us(own.stiffness, Kind::Stiffness)),
                format!("{:.0}", us(own.friction, Kind::Force)),
            ],
            LoopKind::Roll => [
                format!("{:.2}", 1e3 * own.amplitude),
                format!("{:.1}", 1e-6 * us(own.stiffness, Kind::Moment)),
                format!("{:.1}", 1e-3 * us(own.friction, Kind::Moment)),
            ],
        };
        let label = if label.is_empty() {
            name.to_owned()
        } else {
            label.clone()
        };
        let rest = [
            format!("{:.0}", us(own.energy, Kind::Energy)),
            format!("{:.3}", own.loss_ratio),
        ];
        table.row(std::iter::once(label).chain(numbers).chain(rest));
    }
    table
}
