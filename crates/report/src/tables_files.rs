//! The files of `wedgelab tables`: both tables as CSV and as piecewise linear functions of NUCARS, all of it
//! with its error as JSON.

use std::f64::consts::TAU;
use std::io::{self, Write};

use nucars::source::Spanned;
use nucars::tree::PiecewiseLinear;
use nucars::write::write_function;
use quantity::{Kind, SixDigits, System as Units};
use serde_json::{Value, json};
use study::tables::check::{Check, CheckPlace};
use study::tables::grid::{Direction, Point};
use study::tables::rig::Test;
use study::tables::{NestTables, Table, words};

use crate::csv::{converted, rounded};
use crate::output_table::{Cell, Content, OutputTable};
use crate::tables_work::TablesFindings;
use crate::terminal::TerminalTable;

/// The tables, their error, and what they rest on.
pub const SUMMARY: &str = "tables.json";
/// The tables as CSV.
pub const CSV: [&str; 2] = ["nest.csv", "warp.csv"];
/// The tables as functions of NUCARS.
pub const PWL: [&str; 2] = ["nest.pwl", "warp.pwl"];
/// All of them.
pub const NAMES: [&str; 5] = [SUMMARY, CSV[0], PWL[0], CSV[1], PWL[1]];

/// What the numbers rest on besides the case, each with its mark.
const ASSUMPTIONS: [&str; 7] = [
    "one nest: the mean of both nests of the truck (half of its warp moment); side frames and bolster move \
     as prescribed (choice)",
    "load: what the coils of a nest carry at zero stroke, without friction (choice)",
    "warp: the bolster has risen by 0.2 in to its height before; another history leaves other normal forces \
     (choice)",
    "rate: the frequency of a sine of the table's amplitude (choice)",
    "0.75 in of rise, friction of 0.2, 0.35 and 0.5, 1 Hz, loads of 0.3 and 0.6 of the nominal one: \
     guesses, unless others are given",
    "a loop at another amplitude is cut out of the table: at its turning points it jumps from branch to \
     branch (choice; its error is among those stated)",
    "the sign of a nest's functions of NUCARS, extension positive, and that end slopes go on beyond the \
     points: derived from published input files, its manual is not public",
];

/// Number of a test's first function of NUCARS.
fn first_number(test: Test) -> u32 {
    match test {
        Test::Nest => 1001,
        Test::Warp => 20_001,
    }
}

/// Names of the columns of motion, rising and falling branch, their mean and half difference.
fn names(test: Test) -> [&'static str; 5] {
    match test {
        Test::Nest => [
            "stroke",
            "force_loading",
            "force_unloading",
            "force_mean",
            "force_half_width",
        ],
        Test::Warp => [
            "warp_angle",
            "moment_rising",
            "moment_falling",
            "moment_mean",
            "moment_half_width",
        ],
    }
}

/// Writes a table: a row for each node and position.
///
/// # Errors
/// The writer's.
pub fn write_csv(tables: &NestTables, number: usize, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let table = &tables.tables[number];
    let rows = tables
        .grid
        .nodes()
        .enumerate()
        .flat_map(|(node, at)| (0..table.positions.len()).map(move |position| (node, at, position)));
    let mut csv = OutputTable::new(rows, units);
    csv.rounded("load", Kind::Force, |(_, at, _): &(usize, Point, usize)| at[0]);
    csv.rounded("rise", Kind::Length, |(_, at, _)| at[1]);
    csv.rounded("friction", Kind::Dimensionless, |(_, at, _)| at[2]);
    csv.rounded("rate_Hz", Kind::Count, |(_, at, _)| at[3] / TAU);
    let [motion, resistance] = table.test.kinds();
    let [position, rising, falling, mean, half] = names(table.test);
    csv.rounded(position, motion, |(.., own)| table.positions[*own]);
    let of = |(node, _, own): &(usize, Point, usize)| {
        let branches = &table.branches[*node];
        [branches.rising[*own], branches.falling[*own]]
    };
    csv.number(rising, resistance, move |row| of(row)[0]);
    csv.number(falling, resistance, move |row| of(row)[1]);
    csv.number(mean, resistance, move |row| {
        let [rising, falling] = of(row);
        0.5 * (rising + falling)
    });
    csv.number(half, resistance, move |row| {
        let [rising, falling] = of(row);
        0.5 * (rising - falling)
    });
    csv.column(["function", "", ""], Content::Integer, move |(node, ..)| {
        Cell::Integer(i64::from(number_of(table.test, *node)))
    });
    csv.write_csv(out)
}

/// Returns the number of the mean at a node; the half width has the next one.
fn number_of(test: Test, node: usize) -> u32 {
    first_number(test) + 2 * node as u32
}

/// Returns the functions of NUCARS of a table: mean and half width at each node, in lb and in, or lb·in and
/// rad; a nest's with extension positive.
#[must_use]
pub fn functions(table: &Table) -> Vec<PiecewiseLinear> {
    let [motion, resistance] = table.test.kinds();
    let us = |value: f64, kind: Kind| rounded(converted(value, kind, Units::Us));
    // To a thousandth; zero has no sign.
    let plain = |value: f64| (converted(value, resistance, Units::Us) * 1e3).round() / 1e3 + 0.0;
    let function = |id: u32, points: Vec<(f64, f64)>| {
        let (abscissae, ordinates): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        let spanned =
            |values: Vec<f64>| -> Vec<Spanned<f64>> { values.into_iter().map(Into::into).collect() };
        PiecewiseLinear {
            id: id.into(),
            ordinates: spanned(ordinates),
            abscissae: spanned(abscissae),
            span: Default::default(),
        }
    };
    let nodes = table.branches.iter().enumerate();
    nodes
        .flat_map(|(node, own)| {
            let points = |half: bool| -> Vec<(f64, f64)> {
                let all = own.rising.iter().zip(&own.falling).zip(&table.positions);
                let mut points: Vec<(f64, f64)> = all
                    .map(|((rising, falling), position)| {
                        let value = 0.5 * if half { rising - falling } else { rising + falling };
                        let (position, value) = (us(*position, motion), plain(value));
                        match (table.test, half) {
                            // Stroke and force are positive in compression.
                            (Test::Nest, false) => (0.0 - position, 0.0 - value),
                            (Test::Nest, true) => (0.0 - position, value),
                            (Test::Warp, _) => (position, value),
                        }
                    })
                    .collect();
                if table.test == Test::Nest {
                    points.reverse();
                }
                points
            };
            let id = number_of(table.test, node);
            [function(id, points(false)), function(id + 1, points(true))]
        })
        .collect()
}

/// Writes the functions of NUCARS of a table.
///
/// # Errors
/// The writer's.
pub fn write_pwl(tables: &NestTables, number: usize, out: &mut dyn Write) -> io::Result<()> {
    let table = &tables.tables[number];
    let (about, units) = match table.test {
        Test::Nest => (
            "Vertical force of one nest with its wedges over its extension from where it carries its load",
            "lb over in; extension and tension positive, so forces are negative; the load is in them",
        ),
        Test::Warp => (
            "Warp moment of one nest on the bolster over the yaw of side frame against bolster",
            "in-lb over rad; positive where the moment resists a positive angle",
        ),
    };
    let [motion, _] = table.test.kinds();
    let amplitude = SixDigits(converted(table.amplitude, motion, Units::Us));
    let unit = motion.suffix(Units::Us);
    for line in [
        format!("{about}."),
        format!("Truck: {}; from wedgelab.", tables.case),
        format!("Units: {units}."),
        "Two functions a node: the mean of both branches (an odd number), and half of their difference,"
            .to_owned(),
        "which acts against the motion (the next, even number). Choose the node by load, rise, friction and"
            .to_owned(),
        "rate in the comment above it; between two nodes mix their ordinates in proportion.".to_owned(),
        format!(
            "Loops of {amplitude} {unit} to each side; beyond the last points the end slope goes on, and \
             means nothing."
        ),
        "At both ends the half width is that of a loop that turns there.".to_owned(),
        "Error against whole runs, in per cent of their largest value (largest, root mean square), and of"
            .to_owned(),
        "the energy of a cycle:".to_owned(),
    ] {
        writeln!(out, "! {line}")?;
    }
    for check in &table.checks {
        let [largest, rms, half] = check.per_cent();
        writeln!(
            out,
            "!   {}: {largest:.2} %, {rms:.2} %; energy {:+.1} %; friction is {half:.2} %",
            place_in_words(&check.place),
            check.energy_per_cent()
        )?;
    }
    for text in constants(tables) {
        writeln!(out, "! {text}")?;
    }
    writeln!(out, "\\PWL DATA")?;
    for (node, pair) in functions(table).chunks(2).enumerate() {
        writeln!(out, "! {}", words(tables.grid.node(node)))?;
        for function in pair {
            write!(out, "{}", write_function(function))?;
        }
    }
    Ok(())
}

/// Returns what is said of directions that are constants.
fn constants(tables: &NestTables) -> Vec<String> {
    let varied: Vec<Direction> = tables.grid.varied().collect();
    let constant = Direction::ALL.into_iter().enumerate();
    constant
        .filter(|(_, direction)| !varied.contains(direction))
        .map(|(k, direction)| {
            let value = tables.grid.values[k][0];
            format!(
                "The {} has one value and is a constant: {}.",
                direction.name(),
                value_in_words(direction, value)
            )
        })
        .collect()
}

fn value_in_words(direction: Direction, value: f64) -> String {
    match direction {
        Direction::Rate => format!("{} Hz", SixDigits(value / TAU)),
        Direction::Friction => SixDigits(value).to_string(),
        Direction::Load | Direction::Rise => {
            let kind = direction.kind();
            let value = SixDigits(converted(value, kind, Units::Us));
            format!("{value} {}", kind.suffix(Units::Us))
        }
    }
}

/// Returns where a check is, in words.
fn place_in_words(place: &CheckPlace) -> String {
    match place.between {
        Some(direction) => {
            let value = place.at[direction as usize];
            format!("{}, {}", place.words(), value_in_words(direction, value))
        }
        None => place.words(),
    }
}

/// Returns all of it as JSON.
#[must_use]
pub fn summary(findings: &TablesFindings) -> Value {
    let tables = &findings.tables;
    let check = |own: &Check| {
        let [largest, rms, half_width] = own.per_cent();
        json!({
            "where": place_in_words(&own.place),
            "between": own.place.between.map(Direction::name),
            "load_N": own.place.at[0],
            "rise_m": own.place.at[1],
            "friction": own.place.at[2],
            "rate_Hz": own.place.at[3] / TAU,
            "amplitude_share": own.place.amplitude_share,
            "largest_per_cent": largest,
            "rms_per_cent": rms,
            "half_width_per_cent": half_width,
            "energy_per_cent": own.energy_per_cent(),
            "largest": own.largest,
            "rms": own.rms,
            "reference": own.reference,
        })
    };
    let table = |own: &Table| {
        let [motion, resistance] = own.test.kinds();
        json!({
            "test": own.test.name(),
            "motion_unit": motion.label(Units::Si),
            "resistance_unit": resistance.label(Units::Si),
            "amplitude": own.amplitude,
            "positions": own.positions,
            "branches": own.branches,
            "error": own.checks.iter().map(check).collect::<Vec<_>>(),
        })
    };
    let [load, rise, friction, rate] = &tables.grid.values;
    json!({
        "schema": "wedgelab-tables-1",
        "program": format!("wedgelab {}", env!("CARGO_PKG_VERSION")),
        "case": tables.case,
        "title": tables.title,
        "grid": {
            "load_N": load,
            "rise_m": rise,
            "friction": friction,
            "rate_Hz": rate.iter().map(|own| own / TAU).collect::<Vec<_>>(),
            "order": "load slowest, then rise, friction, rate",
        },
        "constants": constants(tables),
        "tables": tables.tables.each_ref().map(table),
        "runs": findings.runs,
        "warnings": findings.warnings.iter().map(|(text, runs)| json!({
            "text": text,
            "runs": runs,
        })).collect::<Vec<_>>(),
        "assumptions": ASSUMPTIONS,
    })
}

/// Writes what is printed: the errors of both tables.
///
/// # Errors
/// The writer's.
pub fn print(findings: &TablesFindings, out: &mut impl Write) -> io::Result<()> {
    let tables = &findings.tables;
    let mut table = TerminalTable::new(
        2,
        &[
            ("table", ""),
            ("against a run", ""),
            ("largest", "%"),
            ("rms", "%"),
            ("friction", "%"),
            ("energy", "%"),
        ],
    );
    for own in &tables.tables {
        for check in &own.checks {
            let numbers = check.per_cent().map(|own| format!("{own:.2}"));
            let words = [own.test.name().to_owned(), place_in_words(&check.place)];
            let energy = format!("{:+.1}", check.energy_per_cent());
            table.row(words.into_iter().chain(numbers).chain([energy]));
        }
    }
    table.write(out)?;
    writeln!(
        out,
        "\nDifferences of the tables from runs that are not in them, in per cent of the largest force or \
         moment of\nthe run; beside them half the width of its loop; by how much the table's energy of a \
         cycle exceeds the run's.\n{} nodes, {} runs.",
        tables.grid.count(),
        findings.runs
    )?;
    for text in constants(tables) {
        writeln!(out, "{text}")?;
    }
    Ok(())
}
