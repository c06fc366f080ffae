//! `wedgelab wheelrail contact`: the patches of a loaded wheelset, in the frame of the program CONTACT.

use std::io::{self, Write};
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use quantity::{Kind, Quantity};
use serde_json::{Value, json};
use wheelrail::contact::{ContactLaw, CreepLaw, Side};
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::creep::polach;
use wheelrail::hertz::Material;
use wheelrail::loaded::{Attitude, LoadedPatch, LoadedWheel, Seat};
use wheelrail::wheelset::RigidWheelset;

use super::wheelrail::{WheelRailPair, wrong};
use crate::failure::{Failure, Message};
use crate::json;
use crate::table::TerminalTable;

/// Frame and signs of the results: in the help, the table and the JSON.
const FRAME: &str = "CONTACT's: x forward, y to the right, z down, from the middle of the track at the \
                     height of the rails' tops; forward rolling is a negative pitch rate. Forces and the \
                     spin moment act on the rail, in the plane of contact; creepages are the rail's \
                     velocity less the wheel's over the speed";

/// Prints them with the long help of the command.
const EXAMPLES: &str = "\
Frame: x forward, y to the right, z down (that of the program CONTACT; everything else in wedgelab has y to \
the left and
z up). Forward rolling is a negative pitch rate. Forces act on the rail. Each wheel carries the load at a \
height of its
own. Where two areas of contact grow together they are given as one patch with a share and as two with the \
rest; forces
contain the share.

Examples:
  wedgelab wheelrail contact aar_1b 136re --lateral \"0.25 in\" --load \"33 kip\" --speed \"40 mph\"
  wedgelab wheelrail contact MBench_S1002_v3.prw MBench_UIC60_v3.prr --gauge \"1435 mm\" --lateral \"3 mm\" \\
    --yaw \"0.0072 rad\" --roll \"-0.0001803 rad\" --load \"10 kN\" --speed \"2 m/s\" --pitch-rate \
\"-4.3451503 rad/s\" \\
    --friction 0.3 --creep fastsim --json";

/// Arguments of the command.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    pair: WheelRailPair,
    /// Lateral place of the wheelset, to the right
    #[arg(
        long,
        value_name = "LENGTH",
        default_value = "0 mm",
        value_parser = of_length,
        allow_hyphen_values = true,
    )]
    lateral: Quantity,
    /// Yaw, to the right (about z, down)
    #[arg(
        long,
        value_name = "ANGLE",
        default_value = "0 rad",
        value_parser = of_angle,
        allow_hyphen_values = true,
    )]
    yaw: Quantity,
    /// Roll, right side down (about x, forward)
    #[arg(
        long,
        value_name = "ANGLE",
        default_value = "0 rad",
        value_parser = of_angle,
        allow_hyphen_values = true,
    )]
    roll: Quantity,
    /// Vertical load of each wheel
    #[arg(long, value_name = "FORCE", value_parser = of_force, allow_hyphen_values = true)]
    load: Quantity,
    /// Forward speed
    #[arg(
        long,
        value_name = "SPEED",
        default_value = "2 m/s",
        value_parser = of_speed,
        allow_hyphen_values = true,
    )]
    speed: Quantity,
    /// Pitch rate: negative where the wheelset rolls forward [default: the speed over the nominal radius]
    #[arg(long, value_name = "RATE", value_parser = of_rate, allow_hyphen_values = true)]
    pitch_rate: Option<Quantity>,
    /// Coefficient of friction
    #[arg(
        long,
        value_name = "NUMBER",
        default_value_t = 0.3,
        allow_hyphen_values = true
    )]
    friction: f64,
    /// Creep law
    #[arg(long, value_name = "LAW", value_enum, default_value_t = Creep::Polach)]
    creep: Creep,
    /// Cells and strips of FASTSIM
    #[arg(
        long,
        value_name = "NUMBER",
        default_value_t = 50,
        value_parser = clap::value_parser!(u16).range(1..=1000),
    )]
    cells: u16,
    /// Shear modulus of both bodies
    #[arg(long, value_name = "MODULUS", default_value = "82 GPa", value_parser = of_modulus)]
    shear_modulus: f64,
    /// Poisson's ratio of both bodies
    #[arg(long, value_name = "NUMBER", default_value_t = 0.28)]
    poisson: f64,
    #[arg(long, help = json::HELP)]
    json: bool,
}

/// A creep law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub(super) enum Creep {
    /// Kalker's linear theory, without saturation
    Linear,
    /// Shen, Hedrick and Elkins
    ShenHedrickElkins,
    /// Polach, clean dry rails
    Polach,
    /// Kalker's simplified theory
    Fastsim,
}

fn of(text: &str, kind: Kind) -> Result<Quantity, String> {
    Quantity::parse_as(text, kind).map_err(|error| format!("{error}; {}", error.help()))
}

pub(super) fn of_length(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Length)
}

pub(super) fn of_angle(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Angle)
}

fn of_force(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Force)
}

pub(super) fn of_speed(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Speed)
}

fn of_rate(text: &str) -> Result<Quantity, String> {
    of(text, Kind::AngularSpeed)
}

/// Returns a modulus, Pa.
fn of_modulus(text: &str) -> Result<f64, String> {
    let units = [("GPa", 1e9), ("MPa", 1e6), ("ksi", 6_894_757.293_168_361)];
    let value = units.iter().find_map(|(unit, factor)| {
        let number: f64 = text.trim().strip_suffix(unit)?.trim().parse().ok()?;
        Some(number * factor)
    });
    match value {
        Some(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("write for example 82 GPa (or MPa, ksi)".to_owned()),
    }
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let pair = &arguments.pair;
    if !(0.0..=0.5).contains(&arguments.poisson) {
        let message = format!(
            "Poisson's ratio is {}; it must be from 0 to 0.5",
            arguments.poisson
        );
        return Err(Message::new(message, "steel has 0.28").into());
    }
    // Other programs pass through the points of a file.
    let (wheel, rail) = (pair.wheel(0.0)?, pair.rail(0.0)?);
    let (layout, radius) = (pair.layout(), pair.radius());
    let material = Material {
        youngs_modulus: 2.0 * arguments.shear_modulus * (1.0 + arguments.poisson),
        poisson: arguments.poisson,
    };
    let wheelset = RigidWheelset::new([&wheel; 2], [radius; 2], [&rail; 2], layout, material)
        .map_err(|error| wrong(&error))?;
    let speed = arguments.speed.to_si();
    let attitude = Attitude {
        lateral: arguments.lateral.to_si(),
        yaw: arguments.yaw.to_si(),
        roll: arguments.roll.to_si(),
        speed,
        pitch_rate: arguments
            .pitch_rate
            .as_ref()
            .map_or(-speed / radius, Quantity::to_si),
    };
    let cells = usize::from(arguments.cells);
    let law = ContactLaw {
        friction: arguments.friction,
        damping: 0.0,
        creep: match arguments.creep {
            Creep::Linear => CreepLaw::Linear,
            Creep::ShenHedrickElkins => CreepLaw::ShenHedrickElkins,
            Creep::Polach => CreepLaw::Polach(polach::DRY),
            Creep::Fastsim => CreepLaw::Fastsim(StripGrid { cells, strips: cells }),
        },
        slowest: 0.0,
    };
    let load = arguments.load.to_si();
    let of_side = |side| {
        let loaded = wheelset.loaded(side, &attitude, load, &law);
        loaded.map_err(|error| Failure::from(Message::new(error.to_string(), error.remedy())))
    };
    let wheels = [of_side(Side::Left)?, of_side(Side::Right)?];
    let mut out = io::stdout().lock();
    if arguments.json {
        let creep = arguments.creep.to_possible_value();
        let given = json!({
            "wheel": wheel.name(),
            "rail": rail.name(),
            "gauge_mm": 1e3 * layout.gauge,
            "gauge_depth_mm": 1e3 * layout.gauge_depth,
            "tape_distance_mm": 1e3 * layout.tape_distance,
            "nominal_radius_mm": 1e3 * radius,
            "lateral_mm": 1e3 * attitude.lateral,
            "yaw_rad": attitude.yaw,
            "roll_rad": attitude.roll,
            "speed_m_per_s": attitude.speed,
            "pitch_rate_rad_per_s": attitude.pitch_rate,
            "load_n": load,
            "friction": law.friction,
            "creep": creep.map(|value| value.get_name().to_owned()),
            "cells": (arguments.creep == Creep::Fastsim).then_some(cells),
            "shear_modulus_gpa": 1e-9 * arguments.shear_modulus,
            "poisson": arguments.poisson,
        });
        let answer = json!({
            "frame": FRAME,
            "given": given,
            "left": wheels[0].patches.iter().map(patch).collect::<Vec<_>>(),
            "right": wheels[1].patches.iter().map(patch).collect::<Vec<_>>(),
            "left_wheel": whole(&wheels[0]),
            "right_wheel": whole(&wheels[1]),
        });
        json::print(&answer)?;
    } else {
        write(&wheels, &mut out)?;
        writeln!(
            out,
            "\nFrame: {}.",
            FRAME.replace("; f", ";\nf").replace("; c", ";\nc")
        )?;
    }
    Ok(ExitCode::SUCCESS)
}

fn patch(patch: &LoadedPatch) -> Value {
    json!({
        "share": patch.share,
        "y_mm": 1e3 * patch.y,
        "angle_rad": patch.angle,
        "normal_n": patch.normal,
        "fx_n": patch.fx,
        "fy_n": patch.fy,
        "spin_moment_nmm": 1e3 * patch.spin_moment,
        "creepage_x": patch.creepage[0],
        "creepage_y": patch.creepage[1],
        "spin_per_mm": 1e-3 * patch.spin,
        "a_mm": 1e3 * patch.axes[0],
        "b_mm": 1e3 * patch.axes[1],
        "greatest_pressure_mpa": 1e-6 * patch.greatest_pressure,
    })
}

/// Returns the wheel; its height is null if it has none.
fn whole(wheel: &LoadedWheel) -> Value {
    json!({
        "seat": wheel.seat.word(),
        "center_y_mm": 1e3 * wheel.center,
        "height_mm": 1e3 * wheel.height,
        "lateral_force_n": wheel.force[0],
        "vertical_force_n": wheel.force[1],
    })
}

fn write(wheels: &[LoadedWheel; 2], out: &mut impl Write) -> io::Result<()> {
    let mut table = TerminalTable::new(
        1,
        &[
            ("wheel", ""),
            ("y", "mm"),
            ("angle", "rad"),
            ("share", ""),
            ("normal", "N"),
            ("Fx", "N"),
            ("Fy", "N"),
            ("Mz", "N mm"),
            ("creepage x", "1e-3"),
            ("y", "1e-3"),
            ("spin", "1/mm"),
            ("a", "mm"),
            ("b", "mm"),
            ("pressure", "MPa"),
        ],
    );
    for (wheel, side) in wheels.iter().zip(["left", "right"]) {
        for patch in &wheel.patches {
            let [x, y] = patch.creepage;
            table.row([
                side.to_owned(),
                format!("{:.2}", 1e3 * patch.y),
                format!("{:.4}", patch.angle),
                format!("{:.2}", patch.share),
                format!("{:.1}", patch.normal),
                format!("{:.1}", patch.fx),
                format!("{:.1}", patch.fy),
                format!("{:.0}", 1e3 * patch.spin_moment),
                format!("{:.4}", 1e3 * x),
                format!("{:.4}", 1e3 * y),
                format!("{:.3e}", 1e-3 * patch.spin),
                format!("{:.3}", 1e3 * patch.axes[0]),
                format!("{:.3}", 1e3 * patch.axes[1]),
                format!("{:.0}", 1e-6 * patch.greatest_pressure),
            ]);
        }
    }
    table.write(out)?;
    writeln!(out)?;
    for (wheel, side) in wheels.iter().zip(["left", "right"]) {
        let (y, height) = (1e3 * wheel.center, 1e3 * wheel.height);
        match wheel.seat {
            Seat::OnRail => writeln!(
                out,
                "The {side} wheel's center is {height:.3} mm above the top of its rail."
            )?,
            Seat::FlangeTip => writeln!(
                out,
                "The {side} wheel has climbed: it stands on the tip of its flange, above the flange's \
                 face; its center, at y = {y:.2} mm,\nis {height:.3} mm above the top of its rail."
            )?,
            Seat::RimEdge => writeln!(
                out,
                "The {side} wheel stands on the outer edge of its rim, about to fall between the rails; its \
                 center is at y = {y:.2} mm."
            )?,
            Seat::OffRail => writeln!(
                out,
                "The {side} wheel is off its rail: its tape circle is at y = {y:.2} mm. It carries nothing."
            )?,
        }
    }
    Ok(())
}
