//! `wedgelab quasi-static`: the massless wedge in steady sliding.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use mechanics::quasi_static::{QuasiStaticWedge, SlidingDirection, SlopeFriction};
use quantity::{Kind, Quantity, System as Units};
use report::summary::write_json;
use report::terminal::TerminalTable;
use serde_json::{Value, json};
use study::case::bounds;

use crate::failure::Failure;
use crate::folders;
use crate::json;
use crate::units::OutputUnits;

/// Forces of the massless wedge in steady sliding, and its jam margin
///
/// Solves the balance of forces of a wedge without mass (Steets 2007, eq. 5-1, derived anew) for both
/// directions of the bolster and both directions of the slope's friction. Where the jam margin is not
/// positive there is no steady sliding: the wedge jams. The defaults are the thesis's with variable damping,
/// its coil compressed by 1 in. With --out it writes quasi_static.json, which is what --json prints.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab quasi-static
  wedgelab quasi-static --toe \"0.2 deg out\" --coil-force \"3702.2 lbf\" --angle \"37.5 deg\"
  wedgelab quasi-static --mu-column 0.6 --mu-slope 0.6 --units si
  wedgelab quasi-static --toe \"0.2 deg in\" --out toe_in")]
pub struct Arguments {
    /// Wedge angle from the vertical
    #[arg(long, default_value = "32 deg", value_parser = angle, allow_hyphen_values = true)]
    angle: Quantity,
    /// Toe angle of the column with its direction, such as "0.2 deg out"
    #[arg(long, default_value = "0 deg", value_parser = toe, allow_hyphen_values = true)]
    toe: Toe,
    /// Coefficient of friction at the column
    #[arg(
        long,
        value_name = "MU",
        default_value = "0.4",
        value_parser = friction,
        allow_hyphen_values = true,
    )]
    mu_column: f64,
    /// Coefficient of friction at the slope
    #[arg(
        long,
        value_name = "MU",
        default_value = "0.4",
        value_parser = friction,
        allow_hyphen_values = true,
    )]
    mu_slope: f64,
    /// Force of the control coil, upwards on the wedge
    #[arg(
        long,
        value_name = "FORCE",
        default_value = "3000 lbf",
        value_parser = force,
        allow_hyphen_values = true,
    )]
    coil_force: Quantity,
    /// Units of the output
    #[arg(long, default_value = "us")]
    units: OutputUnits,
    /// Folder to write quasi_static.json into
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Overwrite existing results
    #[arg(long, requires = "out")]
    force: bool,
    #[arg(long, help = json::HELP)]
    json: bool,
}

/// The file that `--out` writes.
const FILE_NAME: &str = "quasi_static.json";

/// A toe angle as typed and in rad, positive out.
#[derive(Clone, Debug)]
struct Toe {
    text: String,
    value: f64,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let units = arguments.units.system();
    let wedge = QuasiStaticWedge {
        angle: arguments.angle.to_si(),
        toe: arguments.toe.value,
        column_friction: arguments.mu_column,
        slope_friction: arguments.mu_slope,
    };
    let document = document(&wedge, arguments.coil_force.to_si(), units);
    let folder = arguments.out.as_ref();
    let folder = folder.map(|path| folders::check(path, &[FILE_NAME], arguments.force));
    let folder = folder.transpose()?;
    if let Some(folder) = &folder {
        folder.write(|files| files.add(FILE_NAME, |out| write_json(&document, out)))?;
    }
    if arguments.json {
        json::print(&document)?;
        return Ok(ExitCode::SUCCESS);
    }
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "Massless wedge in steady sliding: angle {}, toe {}, friction {} at the column and {} at the \
         slope,\ncoil force {}.\n",
        arguments.angle, arguments.toe.text, arguments.mu_column, arguments.mu_slope, arguments.coil_force
    )?;
    forces(&wedge, arguments.coil_force.to_si(), units).write(&mut out)?;
    let critical = wedge.critical_friction();
    writeln!(
        out,
        "\n* What the motion chooses. With the bolster going down, friction of the slope acts on the \
         wedge down the slope if\n  the toe is out, up the slope if it is in; with the bolster going up, \
         the reverse. {}\n\n\
         Critical friction, equal at both faces, above which the wedge jams with the bolster going down \
         and the slope's\nfriction up the slope: {critical:.4}.",
        if wedge.toe == 0.0 {
            "Without toe the slope does\n  not slip; toe out is the usual choice."
        } else {
            "The others are for comparison."
        }
    )?;
    if let Some(folder) = &folder {
        writeln!(out, "\nWritten into {}: {FILE_NAME}.", folder.path().display())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Returns both directions of the bolster, each with the slope's friction that the motion chooses, and the
/// other.
fn branches(wedge: &QuasiStaticWedge) -> impl Iterator<Item = (SlidingDirection, SlopeFriction, bool)> {
    [SlidingDirection::Down, SlidingDirection::Up]
        .into_iter()
        .flat_map(|direction| {
            let chosen = wedge.branch(direction);
            let other = match chosen {
                SlopeFriction::UpSlope => SlopeFriction::DownSlope,
                SlopeFriction::DownSlope => SlopeFriction::UpSlope,
            };
            [(direction, chosen, true), (direction, other, false)]
        })
}

fn direction_in_words(direction: SlidingDirection) -> &'static str {
    match direction {
        SlidingDirection::Down => "down",
        SlidingDirection::Up => "up",
    }
}

fn friction_in_words(slope: SlopeFriction) -> &'static str {
    match slope {
        SlopeFriction::UpSlope => "up the slope",
        SlopeFriction::DownSlope => "down the slope",
    }
}

/// Forces and jam margins as JSON; forces are null where the wedge jams.
fn document(wedge: &QuasiStaticWedge, coil_force: f64, units: Units) -> Value {
    let branches = branches(wedge).map(|(direction, slope, chosen)| {
        let sliding = wedge.slide(direction, slope, coil_force);
        let force = |value: f64| value * Kind::Force.from_si(units);
        json!({
            "bolster_goes": direction_in_words(direction),
            "slope_friction_on_wedge": friction_in_words(slope),
            "chosen_by_motion": chosen,
            "column_normal": sliding.map(|sliding| force(sliding.column_normal)),
            "column_friction": sliding.map(|sliding| force(sliding.column_friction)),
            "slope_normal": sliding.map(|sliding| force(sliding.slope_normal)),
            "jam_margin_deg": wedge.jam_margin(direction, slope).to_degrees(),
        })
    });
    json!({
        "unit_of_forces": Kind::Force.label(units),
        "critical_friction": wedge.critical_friction(),
        "branches": branches.collect::<Vec<_>>(),
    })
}

fn forces(wedge: &QuasiStaticWedge, coil_force: f64, units: Units) -> TerminalTable {
    let unit = Kind::Force.label(units);
    let mut table = TerminalTable::new(
        2,
        &[
            ("bolster", "goes"),
            ("slope's friction", "on the wedge"),
            ("column normal", unit),
            ("column friction", unit),
            ("slope normal", unit),
            ("jam margin", "deg"),
        ],
    );
    for (direction, slope, chosen) in branches(wedge) {
        let force = |value: f64| format!("{:.1}", value * Kind::Force.from_si(units));
        let [column, friction, normal] = match wedge.slide(direction, slope, coil_force) {
            Some(sliding) => [
                force(sliding.column_normal),
                force(sliding.column_friction),
                force(sliding.slope_normal),
            ],
            None => ["jams", "-", "-"].map(str::to_owned),
        };
        let mark = if chosen { " *" } else { "" };
        table.row([
            direction_in_words(direction).to_owned(),
            format!("{}{mark}", friction_in_words(slope)),
            column,
            friction,
            normal,
            format!("{:.2}", wedge.jam_margin(direction, slope).to_degrees()),
        ]);
    }
    table
}

fn quantity(text: &str, kind: Kind) -> Result<Quantity, String> {
    Quantity::parse_as(text.trim(), kind).map_err(|error| format!("{error}; {}", error.help()))
}

fn angle(text: &str) -> Result<Quantity, String> {
    let angle = quantity(text, Kind::Angle)?;
    if angle.to_si() > 0.0 && angle.to_si() < std::f64::consts::FRAC_PI_2 {
        Ok(angle)
    } else {
        Err(
            "a wedge angle lies between 0 deg and 90 deg, both excluded; write for example \"32 deg\""
                .to_owned(),
        )
    }
}

fn toe(text: &str) -> Result<Toe, String> {
    const HELP: &str = "write its size and direction: \"0.2 deg out\" (the gap between column and bolster \
                        opens downwards), \"0.2 deg in\", or \"0 deg\"";
    let text = text.trim();
    let (size, sign) = match text.rsplit_once(char::is_whitespace) {
        Some((size, "out")) => (size, Some(1.0)),
        Some((size, "in")) => (size, Some(-1.0)),
        _ => (text, None),
    };
    let size = Quantity::parse_as(size.trim(), Kind::Angle)
        .map_err(|error| format!("{error}; {HELP}"))?
        .to_si();
    let most = std::f64::consts::FRAC_PI_8;
    match sign {
        None if size != 0.0 => Err(format!("the direction is missing; {HELP}")),
        _ if size < 0.0 => Err(format!("the size of a toe angle is not negative; {HELP}")),
        _ if size >= most => Err(format!("a toe angle is below 22.5 deg; {HELP}")),
        _ => Ok(Toe {
            text: text.to_owned(),
            value: sign.unwrap_or(1.0) * size,
        }),
    }
}

fn friction(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if (0.0..=bounds::FRICTION).contains(&value) => Ok(value),
        _ => Err(format!(
            "a coefficient of friction is a number from 0 to {}, without unit; write for example 0.4",
            bounds::FRICTION
        )),
    }
}

fn force(text: &str) -> Result<Quantity, String> {
    let force = quantity(text, Kind::Force)?;
    if force.to_si() > bounds::largest(Kind::Force) {
        Err(format!("the coil's force must be {}", bounds::words(Kind::Force)))
    } else if force.to_si() > 0.0 {
        Ok(force)
    } else {
        Err("the coil pushes, its force is positive; write for example \"3000 lbf\"".to_owned())
    }
}
