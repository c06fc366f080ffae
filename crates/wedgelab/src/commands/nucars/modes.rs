//! `wedgelab nucars modes`: natural vibrations of a system.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use mechanics::body::COORDINATES;
use mechanics::system::{Held, StaticFriction, System, Vibration};
use nucars::Severity;
use nucars::check;
use nucars::file_sets::{find, kind, load};
use nucars::read::{FileKind, read_system};
use nucars::truck::{Choices, Truck};

use super::load::print_findings;
use crate::failure::{Failure, INPUT, Message};
use report::terminal::TerminalTable;

/// Print natural frequencies and shapes of a system
///
/// Undamped small vibrations about the drawn layout, or about static equilibrium without friction, input
/// bodies at rest. Where the slope of a characteristic jumps, the slope at larger strokes counts. Shapes are
/// given as shares of kinetic energy in each body's coordinates, with the sign of the motion; shares below 3
/// % are left out. A negative number instead of a frequency is that of a motion that grows.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab nucars modes half_truck.sys
  wedgelab nucars modes half_truck.sys --equilibrium --stick surfaces")]
pub struct Arguments {
    /// A system file (.SYS)
    file: PathBuf,
    /// About static equilibrium without friction instead of the drawn layout
    #[arg(long)]
    equilibrium: bool,
    /// Elements that stick: all closed friction elements, surfaces (wedges slide), or none
    #[arg(long, value_name = "WHAT", default_value = "all")]
    stick: Stick,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Stick {
    /// Surfaces and wedges
    All,
    /// Surfaces; wedges slide
    Surfaces,
    /// Nothing
    None,
}

/// The least share of kinetic energy that is shown.
const LEAST: f64 = 0.03;

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let source = load(&find(&arguments.file)?)?;
    let found = kind(&source)?;
    if found != FileKind::System {
        return Err(Message::new(
            format!("{} is not a system file, but a {found}", source.name()),
            "name the .SYS file",
        )
        .into());
    }
    let mut read = read_system(&source);
    read.add(check::system(&read));
    if read.findings.has_errors() {
        print_findings(&read.findings, |finding| finding.severity() == Severity::Error);
        return Ok(ExitCode::from(INPUT));
    }
    let wrong = |error: &dyn std::fmt::Display| {
        Message::new(
            format!("{} makes no system: {error}", source.name()),
            "`wedgelab nucars check` tells what is doubtful about it",
        )
    };
    let truck = Truck::new(&read.tree, None, &Choices::default()).map_err(|error| wrong(&error))?;
    let mut system = System::new(truck.model.clone()).map_err(|error| wrong(&error))?;
    let mut x = system.initial_state();
    if arguments.equilibrium {
        x = system
            .equilibrium(0.0, &x, StaticFriction::Without)
            .map_err(|error| Message::new(error.to_string(), "leave out --equilibrium"))?;
    }
    let held = match arguments.stick {
        Stick::All => Held::All,
        Stick::Surfaces => Held::Surfaces,
        Stick::None => Held::Nothing,
    };
    let vibrations = system
        .vibrations(0.0, &x, held)
        .map_err(|error| Message::new(error.to_string(), "look for stiffnesses out of proportion"))?;
    let bodies: Vec<(usize, String)> = truck
        .model
        .bodies
        .iter()
        .enumerate()
        .filter(|(_, body)| !body.is_prescribed())
        .map(|(place, body)| (place, format!("{} {}", truck.bodies[place], body.name)))
        .collect();
    let mut head = vec![("frequency", "Hz")];
    head.extend(bodies.iter().map(|(_, name)| (name.as_str(), "% of energy")));
    let mut table = TerminalTable::new(0, &head);
    for mode in &vibrations.modes {
        let mut row = vec![frequency(mode)];
        let all = bodies.iter().map(|(body, _)| energies(&system, mode, *body));
        row.extend(shares(&all.collect::<Vec<_>>()));
        table.row(row);
    }
    let mut out = io::stdout().lock();
    let about = if arguments.equilibrium {
        "static equilibrium"
    } else {
        "the drawn layout"
    };
    let sticks = match arguments.stick {
        Stick::All => "closed friction elements stick",
        Stick::Surfaces => "closed surfaces stick, wedges slide",
        Stick::None => "nothing sticks",
    };
    writeln!(out, "{}\nabout {about}; {sticks}\n", *read.tree.title.text)?;
    table.write(&mut out)?;
    if vibrations.asymmetry > 1e-9 {
        writeln!(
            out,
            "\nThe stiffness is not symmetric (by {:.1e} of its largest entry): friction follows normal \
             forces.",
            vibrations.asymmetry
        )?;
    }
    Ok(ExitCode::SUCCESS)
}

fn frequency(mode: &Vibration) -> String {
    let [real, imaginary] = mode.eigenvalue;
    if real < 0.0 && imaginary == 0.0 {
        format!("{:.4}", -(-real).sqrt() / (2.0 * std::f64::consts::PI))
    } else {
        format!("{:.4}", mode.frequency)
    }
}

/// Twice the kinetic energy in each free coordinate of a body at unit frequency, with the sign of its motion.
fn energies(system: &System, mode: &Vibration, body: usize) -> Vec<(usize, f64)> {
    let own = &system.bodies()[body];
    (0..6)
        .filter(|k| own.free[*k])
        .filter_map(|k| {
            let entry = mode.shape[system.position_of(body, k)?];
            let inertia = if k < 3 { own.mass } else { own.inertia[k - 3] };
            Some((k, inertia * entry * entry.abs()))
        })
        .collect()
}

/// Returns the shares of all bodies in words; the largest one is positive.
fn shares(energies: &[Vec<(usize, f64)>]) -> Vec<String> {
    let all = || energies.iter().flatten().map(|(_, energy)| *energy);
    let whole: f64 = all().map(f64::abs).sum();
    let largest = all().fold(0.0, |most: f64, own| {
        if own.abs() > 1.000_001 * most.abs() {
            own
        } else {
            most
        }
    });
    let whole = whole.copysign(largest);
    energies
        .iter()
        .map(|own| {
            let mut own: Vec<(usize, f64)> = own.iter().map(|(k, energy)| (*k, energy / whole)).collect();
            own.retain(|(_, share)| share.abs() >= LEAST);
            own.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
            let texts = own
                .iter()
                .map(|(k, share)| format!("{} {:+.0}", COORDINATES[*k], 100.0 * share));
            let text = texts.collect::<Vec<_>>().join("  ");
            if text.is_empty() { "-".to_owned() } else { text }
        })
        .collect()
}
