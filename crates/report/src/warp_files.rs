//! The files of `wedgelab warp`: a table for industry programs, as CSV and as piecewise linear functions of
//! NUCARS, and figures.

use std::fmt::Write as _;
use std::io::{self, Write};

use quantity::{Kind, System as Units};
use study::truck::run::TruckResult;
use study::truck::warp::{Growth, NUCARS_STIFFNESS, PARTS, WarpCurve};

use crate::csv::converted;
use crate::figures::axis;
use crate::output_table::{Cell, Content, OutputTable};
use drawing::{Colour, Figure, Line, Panel, PlotCurve, distinct};

/// The table of stiffnesses.
pub const STIFFNESS: &str = "warp.csv";
/// The loops.
pub const LOOPS: &str = "warp_loops.csv";
/// The piecewise linear functions.
pub const PWL: &str = "warp.pwl";
/// The figure.
pub const FIGURE: &str = "warp.svg";
/// The same as a picture.
pub const PICTURE: &str = "warp.png";
/// All of them.
pub const NAMES: [&str; 5] = [STIFFNESS, LOOPS, PWL, FIGURE, PICTURE];

/// kip·in, in N·m.
pub const KIP_INCH: f64 = 112.984_829_027_616_7;

/// One warp test.
#[derive(Clone, Debug)]
pub struct Tested {
    /// Its label among the others, such as `friction 0.25`; empty if there is one only.
    pub label: String,
    /// Its run.
    pub result: TruckResult,
    /// Its curve.
    pub curve: WarpCurve,
}

/// Writes the table: a row for each test and angle, then NUCARS's empirical lines.
///
/// # Errors
/// The writer's.
pub fn write_stiffness(tests: &[Tested], out: &mut dyn Write) -> io::Result<()> {
    let measured = tests.iter().flat_map(|test| {
        let rows = test.curve.stiffness.iter().zip(&test.curve.parts);
        rows.map(move |((angle, stiffness), parts)| {
            (
                test.label.as_str(),
                [*angle, *stiffness],
                Some((parts, test.curve.growth.name())),
            )
        })
    });
    let empirical = NUCARS_STIFFNESS
        .into_iter()
        .flat_map(|(name, stiffness)| [0.010, 0.020].map(|angle| (name, [angle, stiffness], None)));
    let us = |value: f64| Cell::Text(format!("{:.1}", converted(value, Kind::Moment, Units::Us)).into());
    let mut table = OutputTable::new(measured.chain(empirical), Units::Us);
    table.text("test", |(name, ..)| name);
    table.number("warp_angle", Kind::Angle, |(_, [angle, _], _)| *angle);
    let number = Content::Number;
    let moment = ["warp_moment_lbf_in", "", ""];
    table.column(moment, number, move |(_, [angle, stiffness], _)| {
        us(angle * stiffness)
    });
    let stiffness = ["warp_stiffness_lbf_in_per_rad", "", ""];
    table.column(stiffness, number, move |(_, [_, stiffness], _)| us(*stiffness));
    for (place, (name, ..)) in PARTS.into_iter().enumerate() {
        table.column([&format!("{name}_lbf_in"), "", ""], number, move |(.., more)| {
            more.map_or(Cell::Missing, |(parts, _)| us(parts[place]))
        });
    }
    table.text("growth", |(.., more)| more.map_or("", |(_, growth)| growth));
    table.write_csv(out)
}

/// Writes angle, moment and its parts over the last whole cycle of each test.
///
/// # Errors
/// The writer's.
pub fn write_loops(tests: &[Tested], out: &mut dyn Write) -> io::Result<()> {
    let rows = tests
        .iter()
        .flat_map(|test| test.curve.rows.clone().map(move |row| (test, row)));
    let value =
        |test: &Tested, row: usize, name: &str| test.result.column(name).map_or(f64::NAN, |own| own[row]);
    let mut table = OutputTable::new(rows, Units::Us);
    table.text("test", |(test, _)| &test.label);
    for (name, kind) in [("time", Kind::Time), ("warp_angle", Kind::Angle)] {
        table.rounded(name, kind, move |(test, row)| value(test, *row, name));
    }
    table.number("warp_moment", Kind::Moment, move |(test, row)| {
        value(test, *row, "warp_moment")
    });
    for (name, ..) in PARTS {
        let column = format!("warp_moment_{name}");
        table.number(name, Kind::Moment, move |(test, row)| value(test, *row, &column));
    }
    table.write_csv(out)
}

/// Writes the piecewise linear functions of one nest (half of the truck's moment), as NUCARS reads them:
/// mirrored about the origin, lbf·in over rad.
///
/// # Errors
/// The writer's.
pub fn write_pwl(tests: &[Tested], out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "! Warp resistance of bolster to side frame, one nest (half of the truck's moment),"
    )?;
    writeln!(
        out,
        "! in-lb over rad, where an angle is reached first; from wedgelab. Beyond the last point its slope \
         goes on."
    )?;
    for (number, test) in tests.iter().enumerate() {
        if !test.label.is_empty() {
            writeln!(out, "! {}", test.label)?;
        }
        let (mut ordinates, mut abscissae) = ("0.0".to_owned(), "0.0".to_owned());
        for (angle, stiffness) in &test.curve.stiffness {
            let moment = 0.5 * converted(angle * stiffness, Kind::Moment, Units::Us);
            // Writing to a String cannot fail.
            let _ = write!(ordinates, " {moment:.4E}");
            let _ = write!(abscissae, " {angle}");
        }
        let count = test.curve.stiffness.len() + 1;
        writeln!(
            out,
            "  {}   {count}   {ordinates}\n          {abscissae}",
            14 + number
        )?;
    }
    Ok(())
}

/// Returns the figure: loops with NUCARS's empirical lines, and the parts of the first test's moment.
#[must_use]
pub fn figure(tests: &[Tested]) -> Figure {
    let kip = |value: f64| value / KIP_INCH;
    let mut loops: Vec<PlotCurve> = NUCARS_STIFFNESS
        .iter()
        .zip([Line::Dotted, Line::Dashed])
        .map(|((name, stiffness), line)| {
            PlotCurve::new(
                *name,
                (Colour::Grey, line),
                [-20.0, 20.0]
                    .map(|angle: f64| (angle, kip(1e-3 * angle * stiffness)))
                    .to_vec(),
            )
        })
        .collect();
    let column = |test: &Tested, name: &str| -> Vec<f64> {
        let values = test.result.column(name).unwrap_or_default();
        values[test.curve.rows.clone()].to_vec()
    };
    let over_angle = |test: &Tested, name: &str| -> Vec<(f64, f64)> {
        let angles = column(test, "warp_angle");
        let moments = column(test, name);
        angles
            .into_iter()
            .map(|angle| 1e3 * angle)
            .zip(moments.into_iter().map(kip))
            .collect()
    };
    for (number, test) in tests.iter().enumerate() {
        let label = if test.label.is_empty() {
            "truck".to_owned()
        } else {
            test.label.clone()
        };
        loops.push(PlotCurve::new(
            label,
            distinct(number),
            over_angle(test, "warp_moment"),
        ));
    }
    let mut panels = vec![Panel::new(
        "(a) warp moment",
        "warp angle (mrad)",
        "warp moment on the bolster (kip·in)",
        loops,
    )];
    if let Some(first) = tests.first() {
        let named = if first.label.is_empty() {
            String::new()
        } else {
            format!(": {}", first.label)
        };
        let parts = PARTS.iter().enumerate().filter_map(|(number, (name, words, _))| {
            let points = over_angle(first, &format!("warp_moment_{name}"));
            points
                .iter()
                .any(|(_, moment)| *moment != 0.0)
                .then(|| PlotCurve::new(*words, distinct(tests.len() + number), points))
        });
        panels.push(Panel::new(
            format!("(b) its parts{named}"),
            "warp angle (mrad)",
            "part of the warp moment (kip·in)",
            parts,
        ));
        panels.push(Panel::new(
            format!("(c) normal forces of the columns{named}"),
            "warp angle (mrad)",
            axis("column normal force", Kind::Force, Units::Us),
            study::truck::WEDGE_NAMES
                .into_iter()
                .enumerate()
                .map(|(number, wedge)| {
                    let forces = column(first, &format!("{wedge}_column_normal"));
                    let angles = column(first, "warp_angle").into_iter().map(|angle| 1e3 * angle);
                    let forces = forces
                        .into_iter()
                        .map(|force| converted(force, Kind::Force, Units::Us));
                    PlotCurve::new(
                        wedge.replace('_', " "),
                        distinct(tests.len() + 3 + number),
                        angles.zip(forces),
                    )
                }),
        ));
    }
    Figure::new(
        "Warp of a three-piece truck",
        "Warp moment on the bolster over the warp angle (mean yaw of the side frames less that of \
                  the bolster) over the last whole cycle. Grey: NUCARS's empirical stiffnesses, which stand \
                  for wedging action where wedges have no bodies. Where a nest locks, contact and bristle \
                  stiffness set the moment.",
        panels,
    )
}

/// Returns the plateau or what there is instead, in words.
#[must_use]
pub fn growth_in_words(growth: Growth) -> String {
    match growth {
        Growth::Plateau(moment) => format!("plateau at {:.0} kip·in", moment / KIP_INCH),
        other => other.name().to_owned(),
    }
}
