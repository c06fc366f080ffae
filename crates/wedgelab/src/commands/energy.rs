//! `wedgelab energy`: where the energy of a cycle goes, and that of a car's run.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use quantity::{Kind, SixDigits, System as Units};
use report::drawn::Drawn;
use report::figures::power_flow;
use report::run_files::{CASE_FILE_NAME, RunFiles};
use report::summary::write_json;
use report::terminal::TerminalTable;
use study::each_case;
use study::losses::flow::{PowerFlow, words};
use study::losses::stroke::PARTS;
use study::losses::{EnergySummary, LossSplit};
use study::summary::{RunSummary, SummaryValue};

use super::run::read_any;
use crate::execute::{compute, unsound_unwritten};
use crate::failure::{Failure, Message, say};
use crate::folders;
use crate::interrupt;
use crate::json;
use crate::progress::Progress;

/// The files that are written on request.
const NAMES: [&str; 3] = ["energy.json", "power_flow.svg", "power_flow.png"];
/// Losses below this share of all that is lost have no rows of their own.
const SMALL: f64 = 1e-3;

/// Energy of a cycle, or of a car's run: work, storage and losses
///
/// Runs a case of a wedge or a truck with a sine or triangle motion, and prints the energy of a cycle (mean
/// of the whole cycles): work, losses by face and element, by corner or point, by contact state, by part of
/// the stroke, and the equivalent viscous damping. For a car it prints the energy of the whole run: losses of
/// each kind of face and element and of each of these, also per distance, as the mean resistance to the
/// motion. With --out the numbers are written as energy.json, the flow of energy as power_flow.svg and
/// power_flow.png.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab energy vdrun_toe_in_0.2_psi_0.012
  wedgelab energy truck_vertical_variable --out bounce
  wedgelab energy car_constant_curve_loaded --out curve
  wedgelab energy my_run --set friction.column=0.3")]
pub struct Arguments {
    /// Case file, folder of a run (whose case is run again), or the name of a built-in case
    case: PathBuf,
    /// Set one value over those of the case
    #[arg(long, value_name = "PATH.KEY=VALUE")]
    set: Vec<String>,
    /// Folder to write numbers and figure into
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    #[arg(long, help = json::HELP)]
    json: bool,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let of_run = arguments.case.join(CASE_FILE_NAME);
    let path = if of_run.is_file() {
        &of_run
    } else {
        &arguments.case
    };
    let case = read_any(path, &arguments.set)?;
    let folder = match &arguments.out {
        Some(path) => Some(folders::check(path, &NAMES, arguments.force)?),
        None => None,
    };
    let Some(energy) = each_case!(&case, case => energy_of(&**case, arguments.quiet))? else {
        let message = format!("{} is neither a wedge, nor a truck, nor a car", case.name());
        let advice =
            "energies are given for wedges and trucks whose motion or load is periodic, and for cars";
        return Err(Message::new(message, advice).into());
    };
    let Some(figure) = power_flow::figure(&energy) else {
        let why = if energy.missing.is_empty() {
            "nothing is put in and nothing is lost"
        } else {
            &energy.missing
        };
        let message = format!("{} has no energies of a cycle: {why}", case.name());
        let advice = "give a motion or load the shape \"sine\" or \"triangle\", and simulation.duration \
                      room for two of its periods";
        return Err(Message::new(message, advice).into());
    };
    if arguments.json {
        json::print(&energy)?;
    } else {
        write(&energy, case.units(), &mut io::stdout().lock())?;
    }
    if let Some(folder) = folder {
        let figure = Drawn::of(&figure)?;
        folder.write(|files| {
            files.add(NAMES[0], |out| write_json(&energy, out))?;
            figure.add(files, NAMES[1], NAMES[2])
        })?;
        if !arguments.json {
            let (path, names) = (folder.path().display(), NAMES.join(", "));
            writeln!(io::stdout(), "\nWritten into {path}: {names}.")?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// Runs a case, and returns the energies of its summary; `None` of a model without them.
fn energy_of<C: RunFiles>(case: &C, quiet: bool) -> Result<Option<EnergySummary>, Failure> {
    let Some(energy) = C::ENERGY else {
        return Ok(None);
    };
    let progress = Progress::new(1, quiet);
    interrupt::stops(
        "stopping: energies of a cycle are given for whole runs (once more: ends at once)",
        "nothing was written",
    );
    let done = compute(case, &progress);
    progress.finish();
    let summary = &done?.result.summary;
    if let Some(stopped) = summary
        .stopped()
        .filter(|stopped| interrupt::is_reason(Some(stopped)))
    {
        let time = SixDigits(stopped.time);
        let message = format!("the run {} was interrupted at {time} s", summary.name());
        let advice = "nothing is written, for energies of a cycle are given for whole runs; a \
                      simulation.duration of two periods is enough";
        return Err(Failure::Interrupted(Message::new(message, advice).into()));
    }
    if let Some(failure) = unsound_unwritten::<C>(summary) {
        return Err(failure);
    }
    for warning in summary.warnings() {
        say(&format!("warning: {}: {warning}", case.name()));
    }
    Ok(Some(energy(summary).clone()))
}

/// Returns the lines of `run` about the energy of a cycle; `None` if there is none.
pub fn in_short(energy: &EnergySummary) -> Option<String> {
    const MOST: usize = 4;
    if energy.distance.is_some() {
        return None;
    }
    let flow = PowerFlow::of(energy)?;
    let loss = energy.loss.as_ref()?;
    let of_all = |value: f64| format!("{:.1} %", 100.0 * value / loss.value);
    let losses = energy.by_size().into_iter().take(MOST);
    let losses: Vec<String> = losses
        .filter(|(_, _, value)| *value > SMALL * loss.value)
        .map(|(name, _, value)| format!("{} {}", words(name), of_all(value)))
        .collect();
    let states = [1, 2].map(|state| flow.outflows.iter().map(|own| own.by_state[state]).sum::<f64>());
    let stroke: Vec<String> = PARTS
        .iter()
        .filter_map(|part| {
            Some(format!(
                "{} {}",
                part.replace('_', " "),
                of_all(energy.by_stroke.get(*part)?.value)
            ))
        })
        .collect();
    let mut text = format!(
        "Energy of a cycle (mean of {}): {:.1} {} lost: {}.\nFriction of sticking contacts {}, of slipping \
         ones {}.\nBy part of the stroke: {}.",
        energy.cycles,
        loss.value,
        loss.unit,
        losses.join(", "),
        of_all(states[0]),
        of_all(states[1]),
        stroke.join(", ")
    );
    if let Some(line) = equivalent(energy) {
        text = format!("{text}\n{line}");
    }
    Some(text)
}

/// Returns the line about equivalent damping.
fn equivalent(energy: &EnergySummary) -> Option<String> {
    let own = energy.equivalent.as_ref()?;
    let ratio = own.damping_ratio.map_or(String::new(), |ratio| {
        format!(", a damping ratio of {ratio:.3} with the equivalent stiffness")
    });
    Some(format!(
        "Equivalent damping of all that is lost: {:.1} {} at {:.3} {} and {:.3} Hz{ratio}.",
        own.damping.value, own.damping.unit, own.amplitude.value, own.amplitude.unit, own.frequency
    ))
}

/// Writes all tables.
fn write(energy: &EnergySummary, units: Units, out: &mut impl Write) -> io::Result<()> {
    let Some(loss) = &energy.loss else {
        return Ok(());
    };
    writeln!(out, "Energy of a {}: {}.\n", energy.whole(), energy.span())?;
    balance(energy, loss).write(out)?;
    writeln!(out)?;
    let run = energy.distance.is_some();
    if run {
        of_run(energy, loss, units).write(out)?;
    } else {
        of_cycle(energy, loss).write(out)?;
    }
    let rows: Vec<(&str, &LossSplit, f64)> = energy
        .by_size()
        .into_iter()
        .filter(|(_, own, total)| !own.by_point.is_empty() && *total >= SMALL * loss.value)
        .collect();
    if !rows.is_empty() {
        let point = if run { "element" } else { "point" };
        let head = [
            (point, ""),
            ("lost in", ""),
            ("energy", &loss.unit),
            ("share", "%"),
        ];
        let mut table = TerminalTable::new(2, &head);
        for (name, own, total) in rows {
            let lost_in = words(if run { name } else { &own.kind });
            for (point, value) in &own.by_point {
                table.row([
                    point.replace('_', " "),
                    lost_in.clone(),
                    format!("{:.2}", value.value),
                    percent(value.value, total),
                ]);
            }
        }
        writeln!(out)?;
        table.write(out)?;
    }
    if let Some(line) = equivalent(energy) {
        writeln!(out, "\n{line}")?;
    }
    if run {
        return writeln!(
            out,
            "\nShares of elements are of the loss in all elements of their kind. The resistance is the \
             energy by the distance: the mean\nforce that makes up for it. What wheels lose is creep and the \
             damping of their contacts."
        );
    }
    writeln!(
        out,
        "\nShares of states, parts of the stroke and points are of the loss in their row. The powers of the \
         points, integrated step by\nstep, differ from the ledger by at most {:.1e} of all that is lost.",
        energy.largest_correction
    )
}

fn percent(value: f64, of: f64) -> String {
    format!("{:.1}", 100.0 * value / of)
}

/// Adds a row for each loss, from the largest on, those below [`SMALL`] together.
fn losses(
    table: &mut TerminalTable,
    energy: &EnergySummary,
    loss: &SummaryValue,
    more: impl Fn(&LossSplit, f64) -> Vec<String>,
) {
    let (mut count, mut sum) = (0, 0.0);
    for (name, own, total) in energy.by_size() {
        if total.abs() < SMALL * loss.value {
            (count, sum) = (count + 1, sum + total);
            continue;
        }
        let first = [words(name), format!("{total:.2}"), percent(total, loss.value)];
        table.row(first.into_iter().chain(more(own, total)));
    }
    if count > 0 {
        let name = format!("{count} others below {} %", 100.0 * SMALL);
        table.row([name, format!("{sum:.2}"), percent(sum, loss.value)]);
    }
}

/// Returns the losses of a cycle, by contact state and part of the stroke.
fn of_cycle(energy: &EnergySummary, loss: &SummaryValue) -> TerminalTable {
    let mut table = TerminalTable::new(
        1,
        &[
            ("lost in", ""),
            ("energy", &loss.unit),
            ("share", "%"),
            ("sticking", "%"),
            ("slipping", "%"),
            ("rising, upper half", "%"),
            ("falling, upper", "%"),
            ("falling, lower", "%"),
            ("rising, lower", "%"),
        ],
    );
    losses(&mut table, energy, loss, |own, total| {
        let share = |own: Option<&SummaryValue>| own.map_or("-".to_owned(), |own| percent(own.value, total));
        let states = ["stick", "slip"].map(|state| share(own.by_state.get(state)));
        let parts = PARTS.map(|part| share(own.by_stroke.get(part)));
        states.into_iter().chain(parts).collect()
    });
    let parts = PARTS.map(|part| {
        let own = energy.by_stroke.get(part);
        own.map_or("-".to_owned(), |own| percent(own.value, loss.value))
    });
    let first = ["all".to_owned(), format!("{:.2}", loss.value), "100.0".to_owned()];
    let empty = [String::new(), String::new()];
    table.row(first.into_iter().chain(empty).chain(parts));
    table
}

/// Returns the losses of a run, with the resistance that each makes.
fn of_run(energy: &EnergySummary, loss: &SummaryValue, units: Units) -> TerminalTable {
    let resistance = |total: f64| {
        let force = energy.by_distance(total, units);
        force.map_or("-".to_owned(), |force| format!("{:.2}", force.value))
    };
    let force = Kind::Force.label(units);
    let head = [
        ("lost in", ""),
        ("energy", loss.unit.as_str()),
        ("share", "%"),
        ("resistance", force),
    ];
    let mut table = TerminalTable::new(1, &head);
    losses(&mut table, energy, loss, |_, total| vec![resistance(total)]);
    let all = ["all".to_owned(), format!("{:.2}", loss.value), "100.0".to_owned()];
    table.row(all.into_iter().chain([resistance(loss.value)]));
    table
}

/// Returns the table of what goes in and out.
fn balance(energy: &EnergySummary, loss: &SummaryValue) -> TerminalTable {
    let mut table = TerminalTable::new(1, &[("balance", ""), ("energy", &loss.unit)]);
    for (name, work) in &energy.supplied {
        table.row([words(name), format!("{:.3}", work.value)]);
    }
    let stored: f64 = energy.stored_change.values().map(|own| own.value).sum();
    table.row(["stored".to_owned(), format!("{:.3}", -stored)]);
    table.row(["lost".to_owned(), format!("{:.3}", -loss.value)]);
    if let Some(residual) = &energy.residual {
        table.row(["residual".to_owned(), format!("{:.1e}", residual.value)]);
    }
    table
}
