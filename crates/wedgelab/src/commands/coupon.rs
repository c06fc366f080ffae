//! `wedgelab coupon`: what a sliding coupon of a wedge's face loses over the wear coefficient, and the
//! coefficient that a measured loss means.

use std::io::{self, Write};
use std::process::ExitCode;

use clap::Args;
use quantity::{Kind, Quantity};
use report::terminal::TerminalTable;
use serde_json::json;
use study::wear::archard::Archard;
use study::wear::coupon::Coupon;

use crate::failure::Failure;
use crate::json;

/// Wear of a friction coupon over the wear coefficient, and the coefficient of a measured wear
///
/// A coupon of a wedge's face slides to and fro under a clamp and wears by Archard's law; no motion is
/// integrated. Without options it is the test of AAR M-980 as remembered: 0.5 in to each side, 100,000
/// cycles, 750 lbf: check them against your edition. Write the coefficient that comes out as
/// damage.wedge_coefficient of a car or a truck, or as coefficient of the wedges of a route, whose command
/// tells the miles to a rise.
///
/// The hardness is a guess. A coupon runs warm and keeps its debris: a wedge in service may wear otherwise.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab coupon
  wedgelab coupon --area \"4 in^2\" --worn-depth \"0.02 in\"
  wedgelab coupon --clamp \"1500 lbf\" --cycles 50000 --worn-mass \"3 g\"")]
pub struct Arguments {
    /// Amplitude of the motion, to each side
    #[arg(long, value_name = "LENGTH", default_value = "0.5 in", value_parser = length)]
    amplitude: f64,
    /// Number of cycles
    #[arg(long, value_name = "N", default_value = "100000", value_parser = positive)]
    cycles: f64,
    /// Load that clamps it
    #[arg(long, value_name = "FORCE", default_value = "750 lbf", value_parser = force)]
    clamp: f64,
    /// Hardness of the softer partner
    #[arg(long, value_name = "PRESSURE", default_value = "2450 MPa", value_parser = pressure)]
    hardness: f64,
    /// Area of its face: depths need it
    #[arg(long, value_name = "AREA", value_parser = area)]
    area: Option<f64>,
    /// Worn depth that was measured; needs --area
    #[arg(
        long,
        value_name = "LENGTH",
        value_parser = length,
        requires = "area",
        conflicts_with = "worn_mass",
    )]
    worn_depth: Option<f64>,
    /// Worn mass of steel that was measured
    #[arg(long, value_name = "MASS", value_parser = mass)]
    worn_mass: Option<f64>,
    #[arg(long, help = json::HELP)]
    json: bool,
}

/// Coefficients of the table.
const COEFFICIENTS: [f64; 7] = [1e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3];
/// Density of steel, kg/m³.
const STEEL: f64 = 7850.0;
/// Coefficients between which unlubricated steel wears: a guess.
const USUAL: [f64; 2] = [1e-6, 1e-2];

fn read(text: &str, kind: Kind) -> Result<f64, String> {
    let own = Quantity::parse_as(text.trim(), kind).map_err(|error| error.to_string())?;
    match own.to_si() > 0.0 && own.to_si().is_finite() {
        true => Ok(own.to_si()),
        false => Err("a value above 0 is expected".to_owned()),
    }
}

fn length(text: &str) -> Result<f64, String> {
    read(text, Kind::Length)
}

fn force(text: &str) -> Result<f64, String> {
    read(text, Kind::Force)
}

fn pressure(text: &str) -> Result<f64, String> {
    read(text, Kind::Pressure)
}

fn mass(text: &str) -> Result<f64, String> {
    read(text, Kind::Mass)
}

/// Reads an area as a square of lengths: `4 in^2`.
fn area(text: &str) -> Result<f64, String> {
    let how = "write an area such as \"4 in^2\" or \"2500 mm^2\"";
    let unit = text
        .trim()
        .strip_suffix("^2")
        .or(text.trim().strip_suffix('²'))
        .ok_or(how)?;
    let number: String = unit
        .chars()
        .take_while(|own| !own.is_ascii_alphabetic())
        .collect();
    let number: f64 = number.trim().parse().map_err(|_| how)?;
    let name: String = unit
        .chars()
        .skip_while(|own| !own.is_ascii_alphabetic())
        .collect();
    let side = read(&format!("1 {name}"), Kind::Length)?;
    match number > 0.0 && number.is_finite() {
        true => Ok(number * side * side),
        false => Err("an area above 0 is expected".to_owned()),
    }
}

fn positive(text: &str) -> Result<f64, String> {
    let own = text
        .parse::<f64>()
        .ok()
        .filter(|own| *own > 0.0 && own.is_finite());
    own.ok_or_else(|| "a number above 0 is expected".to_owned())
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let coupon = Coupon {
        amplitude: arguments.amplitude,
        cycles: arguments.cycles,
        clamp: arguments.clamp,
    };
    let worn = match (arguments.worn_depth, arguments.area, arguments.worn_mass) {
        (Some(depth), Some(area), _) => Some(depth * area),
        (_, _, Some(mass)) => Some(mass / STEEL),
        _ => None,
    };
    let found = worn.map(|volume| coupon.coefficient(volume, arguments.hardness));
    let rows: Vec<[f64; 2]> = COEFFICIENTS
        .iter()
        .copied()
        .chain(found)
        .map(|coefficient| {
            let law = Archard {
                coefficient,
                hardness: arguments.hardness,
            };
            [coefficient, coupon.volume(&law)]
        })
        .collect();
    if arguments.json {
        let row = |own: &[f64; 2]| {
            json!({
                "coefficient": own[0],
                "volume_m3": own[1],
                "mass_kg": own[1] * STEEL,
                "depth_m": arguments.area.map(|area| own[1] / area),
            })
        };
        json::print(&json!({
            "amplitude_m": coupon.amplitude,
            "cycles": coupon.cycles,
            "clamp_n": coupon.clamp,
            "hardness_pa": arguments.hardness,
            "area_m2": arguments.area,
            "coefficient_of_worn": found,
            "rows": rows.iter().map(row).collect::<Vec<_>>(),
        }))?;
        return Ok(ExitCode::SUCCESS);
    }
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "a coupon slides {:.4} in to each side, {} times, under {:.1} lbf: {:.0} m under load; hardness \
         {:.0} MPa\n",
        coupon.amplitude / 0.0254,
        coupon.cycles,
        coupon.clamp * Kind::Force.from_si(quantity::System::Us),
        coupon.load_times_path() / coupon.clamp,
        arguments.hardness * 1e-6
    )?;
    let mut table = TerminalTable::new(
        0,
        &[
            ("K", ""),
            ("volume", "mm³"),
            ("steel", "g"),
            ("depth", "in"),
            ("depth", "mm"),
        ],
    );
    for [coefficient, volume] in &rows {
        let depth = |unit: f64| match arguments.area {
            Some(area) => format!("{:.4}", volume / area / unit),
            None => "–".to_owned(),
        };
        table.row([
            format!("{coefficient:.2e}"),
            format!("{:.3}", volume * 1e9),
            format!("{:.4}", volume * STEEL * 1e3),
            depth(0.0254),
            depth(1e-3),
        ]);
    }
    table.write(&mut out)?;
    if let Some(own) = found {
        writeln!(out, "The measured wear means K = {own:.3e}: the last row.")?;
        if !(USUAL[0]..=USUAL[1]).contains(&own) {
            writeln!(
                out,
                "warning: dry steel is worn by 1e-6 to 1e-2 (a guess): look at the units of what was measured"
            )?;
        }
    }
    Ok(ExitCode::SUCCESS)
}
