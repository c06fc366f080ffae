//! `result.mat`: a run under the names of the thesis, for its plotting scripts.
//!
//! A MAT-file of version 5 (see [`mat5`]) with the variables that the scripts in appendices D and E of Steets
//! (2007) load, in the thesis's units (inch, pound-force, second, radian) whatever the case's, one row an
//! output time:
//!
//! | variable | columns | meaning |
//! |---|---|---|
//! | `t` | 1 | time |
//! | `y` | 9 | q1..q4: wedge longitudinal, vertical, pitch, yaw; the bolster's vertical displacement; u1..u4: their rates |
//! | `Fx` | 1 | longitudinal wedge force, positive (eq. 5-2) |
//! | `Fz` | 1 | variable damping: eq. 5-3, column friction *on the wedge* plus the coil's force, so that the scripts plot `-Fz`; constant damping: column friction *on the side frame*, plotted as it is |
//! | `EsideframeT` (variable), `Esideframe` (constant) | 1 | power of the column's friction (eq. 5-4), not positive with tanh |
//! | `FsideframeNormal`, `FbolsterNormal` | 4 | normal force of each corner |
//! | `FsideframeTangent` | 4 | size of the friction force of each corner of the column |
//! | `Momentsideframex`, `y`, `z` | 1 | moment of the column's contact forces on the wedge about its centre of gravity |
//! | `Fspring2` | 1 | spring force of the control coil, positive when it pushes |
//! | `vector` | 1 | length of the control coil |
//! | `about` | text | this table |
//!
//! q1, q3, q4 and the bolster's displacement are zero in the nominal position. q2 is absolute, as in the
//! scripts: with variable damping it is the height of the wedge over the coil's seat (nominal length 10.25
//! in; the scripts subtract 10.25). With constant damping the text counts it from the bolster (eq. 3-4),
//! while the scripts plot its full travel of about 2 in and subtract 9.95: an origin that the text never
//! names. It is [`CONSTANT_NOMINAL_HEIGHT`] in the nominal position here.
//!
//! The scripts only load the corners' forces and never plot them, and say nothing of their shape: four
//! columns, in the order of the result's table (lower right, lower left, upper right, upper left), are a
//! choice.

use std::io::{self, Write};

use quantity::{Kind, System as Units};
use study::case::Case;
use study::result::RunResult;
use study::summary::RunSummary;
use wedge::outputs::CORNERS;
use wedge::parameters::Damping;

use crate::csv::converted;
use crate::mat5;
use crate::output_table::RunTable;

/// The file's name.
pub const FILE_NAME: &str = "result.mat";

/// The height that the thesis's script of the yawed, constantly damped run subtracts from q2 (appendix
/// D.2.2), in.
pub const CONSTANT_NOMINAL_HEIGHT: f64 = 9.95;

/// A column in the thesis's units.
type MatColumn = Vec<f64>;

/// A variable: its name, what it is, its unit, its columns.
struct Variable {
    name: &'static str,
    text: String,
    unit: &'static str,
    columns: Vec<MatColumn>,
}

/// Writes the file.
///
/// # Errors
/// The writer's; a column of the result is missing or the run is too long for the format (4 GiB a variable).
pub fn write(case: &Case, result: &RunResult, out: &mut dyn Write) -> io::Result<()> {
    let variables = variables(case, result)?;
    mat5::header(
        &format!("{}, case {}", result.summary.program, result.summary.name),
        out,
    )?;
    for variable in &variables {
        let columns: Vec<&[f64]> = variable.columns.iter().map(Vec::as_slice).collect();
        mat5::matrix(variable.name, &columns, out)?;
    }
    mat5::text("about", &about(result, &variables), out)
}

/// Returns the sentence on a run that is incomplete or has failed.
pub fn soundness(summary: &impl RunSummary) -> String {
    let outcome = summary.outcome();
    let end = outcome.end();
    let incomplete = end.map(|end| format!("incomplete: the run {} at {} s\n", outcome.word(), end.time));
    let failed = summary.failed().map(|reason| format!("failed: {reason}\n"));
    incomplete.into_iter().chain(failed).collect()
}

/// Writes the file of a run of a truck or car: the columns of a table under their full names, and a text on
/// them.
///
/// # Errors
/// The writer's.
pub fn write_named<S: RunSummary>(table: &RunTable<'_>, summary: &S, out: &mut dyn Write) -> io::Result<()> {
    let [name, title, program] = [summary.name(), summary.title(), summary.program()];
    mat5::header(&format!("{program}, case {name}"), out)?;
    let mut about = format!("{name}: {title}\nwritten by {program}\n");
    about += &soundness(summary);
    table.write_mat(&mut about, out)?;
    mat5::text("about", about.trim_end(), out)
}

fn variables(case: &Case, result: &RunResult) -> io::Result<Vec<Variable>> {
    let table = Thesis { result };
    let damping = case.parameters.damping;
    let (nominal, nominal_text) = match damping {
        Damping::Variable => (
            converted(case.parameters.coil.nominal_length, Kind::Length, Units::Us),
            "height over the coil's seat",
        ),
        Damping::Constant => (
            CONSTANT_NOMINAL_HEIGHT,
            "height from the origin of the thesis's script",
        ),
    };
    let mut y = table.all(&[
        "wedge_x",
        "wedge_z",
        "wedge_pitch",
        "wedge_yaw",
        "bolster_vertical",
        "wedge_x_rate",
        "wedge_z_rate",
        "wedge_pitch_rate",
        "wedge_yaw_rate",
    ])?;
    for height in &mut y[1] {
        *height += nominal;
    }
    let y_text = format!(
        "wedge x, z, pitch, yaw (in, rad; z as {nominal_text}, {nominal} in nominal position), \
         bolster z (in), rates of the first four"
    );
    let (fz, fz_text, power) = match damping {
        Damping::Variable => (
            table.negative("vertical_force_on_side_frame")?,
            "column friction on the wedge plus coil force (eq. 5-3), positive up; plotted as -Fz",
            "EsideframeT",
        ),
        Damping::Constant => (
            table.one("vertical_wedge_force")?,
            "column friction on the side frame, positive up",
            "Esideframe",
        ),
    };
    let plain = |name, text: &str, unit, columns| Variable {
        name,
        text: text.to_owned(),
        unit,
        columns,
    };
    let mut all = vec![
        plain("t", "time", "s", table.all(&["time"])?),
        plain("y", &y_text, "in, rad, in/s, rad/s", y),
        plain(
            "Fx",
            "longitudinal wedge force (eq. 5-2)",
            "lbf",
            table.all(&["longitudinal_wedge_force"])?,
        ),
        plain("Fz", fz_text, "lbf", vec![fz]),
        plain(
            power,
            "power of the friction at the side frame (eq. 5-4)",
            "lbf in/s",
            table.all(&["side_frame_friction_power"])?,
        ),
        plain(
            "FsideframeNormal",
            "normal force of the column's corners",
            "lbf",
            table.corners("column", "normal_force")?,
        ),
        plain(
            "FsideframeTangent",
            "size of the friction force of the column's corners",
            "lbf",
            table.friction_sizes("column")?,
        ),
        plain(
            "FbolsterNormal",
            "normal force of the slope's corners",
            "lbf",
            table.corners("slope", "normal_force")?,
        ),
        plain(
            "Fspring2",
            "spring force of the control coil, positive when it pushes",
            "lbf",
            table.all(&["coil_force"])?,
        ),
        plain(
            "vector",
            "length of the control coil",
            "in",
            table.all(&["coil_length"])?,
        ),
    ];
    for (name, axis) in [
        ("Momentsideframex", "roll"),
        ("Momentsideframey", "pitch"),
        ("Momentsideframez", "yaw"),
    ] {
        let column = format!("side_frame_{axis}_moment");
        let text = format!("{axis} moment of the side frame on the wedge about its center of gravity");
        all.push(plain(name, &text, "lbf in", table.all(&[&column])?));
    }
    Ok(all)
}

/// The result in the thesis's units.
struct Thesis<'r> {
    result: &'r RunResult,
}

impl Thesis<'_> {
    fn one(&self, name: &str) -> io::Result<MatColumn> {
        let missing = || io::Error::other(format!("the result has no column `{name}`"));
        let columns = self.result.columns.iter().zip(&self.result.values);
        let (column, values) = columns
            .into_iter()
            .find(|(column, _)| column.name == name)
            .ok_or_else(missing)?;
        let convert = |value: &f64| converted(*value, column.kind, Units::Us);
        Ok(values.iter().map(convert).collect())
    }

    fn negative(&self, name: &str) -> io::Result<MatColumn> {
        Ok(self.one(name)?.into_iter().map(|value| -value).collect())
    }

    fn all(&self, names: &[&str]) -> io::Result<Vec<MatColumn>> {
        names.iter().map(|name| self.one(name)).collect()
    }

    fn corners(&self, face: &str, what: &str) -> io::Result<Vec<MatColumn>> {
        let names = CORNERS.iter().map(|corner| format!("{face}_{corner}_{what}"));
        names.map(|name| self.one(&name)).collect()
    }

    fn friction_sizes(&self, face: &str) -> io::Result<Vec<MatColumn>> {
        let parts = ["x", "y", "z"].map(|axis| self.corners(face, &format!("friction_force_{axis}")));
        let [x, y, z] = parts;
        let (x, y, z) = (x?, y?, z?);
        let corner = |k: usize| {
            let parts = x[k].iter().zip(&y[k]).zip(&z[k]);
            parts.map(|((x, y), z)| (x * x + y * y + z * z).sqrt()).collect()
        };
        Ok((0..CORNERS.len()).map(corner).collect())
    }
}

fn about(result: &RunResult, variables: &[Variable]) -> String {
    let summary = &result.summary;
    let mut text = format!(
        "{}: {}\nwritten by {}; names as in Steets (2007), appendices D and E\n",
        summary.name, summary.title, summary.program
    );
    text += &soundness(summary);
    for variable in variables {
        text.push_str(&format!(
            "{} ({}): {}\n",
            variable.name, variable.unit, variable.text
        ));
    }
    text.push_str("Columns of FsideframeNormal, FsideframeTangent, FbolsterNormal: ");
    text.push_str(&CORNERS.join(", ").replace('_', " "));
    text
}
