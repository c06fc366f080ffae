//! The files of a half-truck's run: the table, the same for MATLAB, the summary.
//!
//! `result.mat` holds every column of the table under its full name, and the array that the thesis's scripts
//! (Steets 2007, appendix D) load from the comparison program's results, under their name (`var_vrt_69_out`,
//! `const_yaw_68_out`, ...) and in their units (pound-force, inch, second). Its columns follow the order of
//! the data files, forces, strokes, velocities, of the first wedge (127 in the printed files, the leading
//! left one):
//!
//! | column | type 6.9 | type 6.8 |
//! |---|---|---|
//! | 1 | time | time |
//! | 2 | vertical force | vertical force |
//! | 3 | longitudinal force | lateral force |
//! | 4 | lateral force | vertical stroke |
//! | 5 | vertical stroke | lateral stroke |
//! | 6 | longitudinal stroke | vertical velocity |
//! | 7 | lateral stroke | lateral velocity |
//! | 8, 9, 10 | vertical, longitudinal, lateral velocity | |
//!
//! The scripts use columns 1, 2, 3, 5 and 8 of type 6.9 and 1, 2, 4 and 6 of type 6.8; the others follow from
//! the data files. Signs: the vertical force is the whole one of the wedge on the side frame, positive up.
//! The scripts plot it beside `-Fz` of the wedge with variable damping (where the coil presses the side frame
//! down: negative) and beside `Fz` with constant damping (friction on the side frame). The longitudinal force
//! is the column's push, positive, as `Fx`.
//!
//! The scripts take rows 35 to 75 for 350 to 750 of arrays sampled each 0.01 s: the comparison program's
//! arrays have a row each 0.1 s, the last of the run file's stepping constants. So has this one: row k is the
//! time (k - 1) times the interval, between rows of the table interpolated linearly.

use std::io::{self, Write};

use mechanics::connection::{Accumulator, Law};
use quantity::System as Units;
use study::half_truck::{HalfTruckCase, HalfTruckResult, yaw};
use wedge::parameters::Damping;

use crate::csv::converted;
use crate::output_table::RunTable;
use crate::{csv, mat, mat5, summary};

/// The files of a half-truck's run.
pub const NAMES: [&str; 3] = [csv::FILE_NAME, mat::FILE_NAME, summary::FILE_NAME];

/// The array of the thesis's scripts: its name and columns.
#[derive(Clone, Debug, PartialEq)]
pub struct ScriptArray {
    /// Its name, such as `var_vrt_69_out`.
    pub name: String,
    /// Its columns, by their names in the table.
    pub columns: Vec<String>,
}

impl ScriptArray {
    /// Returns the array of a run; `None` without wedges of type 6.8 or 6.9.
    #[must_use]
    pub fn of(case: &HalfTruckCase) -> Option<Self> {
        let place = *case.wedges().first()?;
        let law = &case.truck.model.connections[place].law;
        let constant = match (case.wedge_body(place), law) {
            (Some(wedge), _) => wedge.damping == Damping::Constant,
            (None, Law::Wedge(wedge)) if matches!(wedge.accumulator, Accumulator::Bristle { .. }) => {
                wedge.coil_in_bolster
            }
            _ => return None,
        };
        let number = case.truck.connections[place];
        let spatial = law.coordinates().contains(&0);
        let name = format!(
            "{}_{}_{}_out",
            if constant { "const" } else { "var" },
            if yaw::is_commanded(&case.truck) {
                "yaw"
            } else {
                "vrt"
            },
            if spatial { "69" } else { "68" }
        );
        let all = [
            "vertical_force",
            "longitudinal_force",
            "lateral_force",
            "stroke",
            "longitudinal_stroke",
            "lateral_stroke",
            "stroke_rate",
            "longitudinal_stroke_rate",
            "lateral_stroke_rate",
        ];
        let columns = all
            .into_iter()
            .filter(|what| spatial || !what.starts_with("longitudinal"))
            .map(|what| format!("wedge_{number}_{what}"));
        let columns = std::iter::once("time".to_owned()).chain(columns).collect();
        Some(Self { name, columns })
    }

    /// Returns its values, with a row each `interval` seconds.
    fn values(&self, result: &HalfTruckResult, interval: f64) -> io::Result<Vec<Vec<f64>>> {
        let missing = |name: &str| io::Error::other(format!("the result has no column `{name}`"));
        let times = result.column("time").ok_or_else(|| missing("time"))?;
        let last = times.last().copied().unwrap_or_default();
        let rows = (last / interval * (1.0 + 1e-12)).floor() as usize + 1;
        let mut all = Vec::with_capacity(self.columns.len());
        for name in &self.columns {
            let found = result.columns.iter().zip(&result.values);
            let (column, values) = found
                .into_iter()
                .find(|(column, _)| column.name == *name)
                .ok_or_else(|| missing(name))?;
            let convert = |si| converted(si, column.kind, Units::Us);
            let at = |row| convert(sample(times, values, row as f64 * interval));
            all.push((0..rows).map(at).collect());
        }
        Ok(all)
    }
}

/// Returns the value at a time, linear between rows; at a row's time (but for rounding) that row's.
fn sample(times: &[f64], values: &[f64], time: f64) -> f64 {
    let after = times.partition_point(|own| *own < time);
    let near = |index: usize| {
        let own = times.get(index)?;
        ((own - time).abs() <= 1e-9 * time.abs()).then(|| values[index])
    };
    if let Some(value) = near(after).or_else(|| near(after.checked_sub(1)?)) {
        return value;
    }
    match (after.checked_sub(1), times.get(after)) {
        (Some(before), Some(next)) => {
            let share = (time - times[before]) / (next - times[before]);
            values[before] + share * (values[after] - values[before])
        }
        (Some(before), None) => values[before],
        (None, _) => values.first().copied().unwrap_or_default(),
    }
}

/// Writes `result.mat`.
///
/// # Errors
/// The writer's.
pub fn write_mat(
    case: &HalfTruckCase,
    result: &HalfTruckResult,
    script_interval: f64,
    out: &mut dyn Write,
) -> io::Result<()> {
    let own = &result.summary;
    mat5::header(&format!("{}, case {}", own.program, own.name), out)?;
    let mut about = format!("{}: {}\nwritten by {}\n", own.name, own.title, own.program);
    about += &mat::soundness(own);
    if let Some(array) = ScriptArray::of(case).filter(|_| script_interval > 0.0) {
        let values = array.values(result, script_interval)?;
        let columns: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        mat5::matrix(&array.name, &columns, out)?;
        about.push_str(&format!(
            "{}: as the thesis's scripts load it, a row each {script_interval} s; lbf, in, s; columns: {}\n",
            array.name,
            array.columns.join(", ")
        ));
    }
    let columns = result.columns.iter().zip(&result.values);
    RunTable::of_run(columns, own.units)?.write_mat(&mut about, out)?;
    mat5::text("about", about.trim_end(), out)
}

#[cfg(test)]
mod tests {
    use super::sample;

    #[test]
    fn samples_take_rows_and_interpolate_between() {
        let (times, values) = ([0.0, 0.1, 0.2, 0.30000000000000004], [0.0, 1.0, 4.0, 9.0]);
        for (time, value) in [
            (0.0, 0.0),
            (0.3, 9.0),
            (0.15, 2.5),
            (0.2, 4.0),
            (1.0, 9.0),
            (-1.0, 0.0),
        ] {
            assert!((sample(&times, &values, time) - value).abs() < 1e-12, "{time}");
        }
    }
}
