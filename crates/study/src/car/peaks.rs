//! Peaks that a damping method of integration changes: those of wheels that land, and raw vertical
//! accelerations.

use std::collections::BTreeMap;

use integrate::{Family, Method};
use quantity::{Kind, System as Units};

use super::statistics::{Parts, SIDES, Statistic, in_words};
use crate::run::RowTable;
use crate::summary::SummaryValue;

/// Time after a landing in which its peak falls, s.
const IMPACT: f64 = 0.2;

/// A landing: the wheel, the times between which it is off its rail (s), the greatest force soon after (N).
struct Landing {
    wheel: String,
    left: f64,
    landed: f64,
    peak: f64,
}

/// Returns whether a method damps what is faster than its steps.
pub(super) fn damps(method: Method) -> bool {
    method.tableau().family == Family::DiagonallyImplicit
}

/// Returns the warning about wheels that leave their rails and land with more than their static load in a run
/// by a method that damps.
pub(crate) fn warning(table: &RowTable, parts: &Parts, (method, units): (Method, Units)) -> Option<String> {
    if !damps(method) {
        return None;
    }
    let mut all = Vec::new();
    for (axle, part) in parts.axles.iter().enumerate() {
        for (side, load) in part.loads.into_iter().enumerate() {
            let forces = table.column(&parts.force_of(axle, side, "vertical"));
            let wheel = format!("{} wheel of {}", SIDES[side], in_words(&part.name));
            let own = landings(&wheel, table.column("time"), forces);
            all.extend(own.into_iter().filter(|own| own.peak > load));
        }
    }
    let first = all.iter().min_by(|a, b| a.left.total_cmp(&b.left))?;
    let hardest = all.iter().max_by(|a, b| a.peak.total_cmp(&b.peak))?;
    let peak = SummaryValue::new(hardest.peak, Kind::Force, units);
    Some(format!(
        "wheels leave their rails and land {} times, first the {} at {:.3} s; the hardest landing is that of \
         the {} at {:.3} s, with {:.0} {} at the most: {method} damps impacts, and single peaks after a \
         landing may be a third off; set simulation.method = \"rodas5p\" for \
         them, and use values that last (hold times) otherwise",
        all.len(),
        first.wheel,
        first.left,
        hardest.wheel,
        hardest.landed,
        peak.value,
        peak.unit,
    ))
}

/// Adds to the raw statistics of vertical accelerations what a method that damps does to them.
pub(crate) fn remark(statistics: &mut BTreeMap<String, Statistic>, method: Method) {
    if !damps(method) {
        return;
    }
    let vertical = statistics
        .iter_mut()
        .filter(|(name, _)| name.contains("_vertical_acceleration_"));
    for (_, own) in vertical.filter(|(_, own)| own.raw.is_some()) {
        let words = format!("raw: up to 5 % low, since {method} damps fast vibrations");
        own.remark = match own.remark.as_str() {
            "" => words,
            other => format!("{other}; {words}"),
        };
    }
}

/// Returns the landings of a wheel, from the vertical forces on its rail (N) at times (s).
fn landings(wheel: &str, times: &[f64], forces: &[f64]) -> Vec<Landing> {
    let mut all = Vec::new();
    let mut left = None;
    for (row, (time, force)) in times.iter().zip(forces).enumerate() {
        if *force <= 0.0 {
            left.get_or_insert(*time);
        } else if let Some(left) = left.take() {
            let soon = times[row..].iter().zip(&forces[row..]);
            let soon = soon.take_while(|(own, _)| **own <= time + IMPACT);
            all.push(Landing {
                wheel: wheel.to_owned(),
                left,
                landed: *time,
                peak: soon.fold(0.0, |most, (_, own)| own.max(most)),
            });
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use mechanics::output::Column;

    use super::*;
    use crate::car::statistics::AxlePart;

    const POUND_FORCE: f64 = 4.448_221_615_260_5;

    fn parts() -> Parts {
        let axles = (1..=4).map(|axle| AxlePart {
            name: format!("axle_{axle}"),
            loads: [29e3 * POUND_FORCE; 2],
            place: 0.0,
        });
        Parts {
            axles: axles.collect(),
            ..Parts::default()
        }
    }

    /// Returns the rows of a car whose left wheel of axle 2 has these forces (lbf) every 5 ms, and whose
    /// other wheels carry 30 kip.
    fn table(forces: &[f64]) -> RowTable {
        let wheels = (1..=4).flat_map(|axle| SIDES.map(|side| format!("axle_{axle}_{side}_vertical")));
        let columns: Vec<Column> = [("time".to_owned(), Kind::Time)]
            .into_iter()
            .chain(wheels.map(|name| (name, Kind::Force)))
            .map(|(name, kind)| Column::new(name, kind, "", ""))
            .collect();
        let mut table = RowTable::new(&columns, |_| true);
        for (row, force) in forces.iter().enumerate() {
            let time = 0.005 * row as f64;
            let value = |column: &Column| match column.name.as_str() {
                "time" => time,
                "axle_2_left_vertical" => force * POUND_FORCE,
                _ => 30e3 * POUND_FORCE,
            };
            table.begin_row().extend(columns.iter().map(value));
            assert!(table.append(time).is_ok());
        }
        table
    }

    #[test]
    fn issue_047_landings_are_told_with_wheel_time_and_peak_where_the_method_damps() {
        let mut forces = vec![30e3; 100];
        forces[20..25].fill(0.0);
        forces[27] = 99e3;
        forces[60..63].fill(0.0);
        let table = table(&forces);
        for method in [Method::TrBdf2, Method::Esdirk3] {
            let told = warning(&table, &parts(), (method, Units::Us)).unwrap_or_default();
            for words in [
                "land 2 times",
                "first the left wheel of axle 2 at 0.100 s",
                "the left wheel of axle 2 at 0.125 s, with 99000 lbf",
                "simulation.method = \"rodas5p\"",
                &method.to_string(),
            ] {
                assert!(told.contains(words), "{words}: {told}");
            }
        }
        assert_eq!(warning(&table, &parts(), (Method::Rodas5P, Units::Us)), None);
    }

    #[test]
    fn issue_047_wheels_that_stay_down_or_do_not_land_are_no_landings() {
        let mut forces = vec![30e3; 100];
        forces[20..25].fill(10.0);
        assert_eq!(
            warning(&table(&forces), &parts(), (Method::TrBdf2, Units::Us)),
            None
        );
        // It is let down gently.
        forces.fill(28e3);
        forces[20..25].fill(0.0);
        assert_eq!(
            warning(&table(&forces), &parts(), (Method::TrBdf2, Units::Us)),
            None
        );
        // Off its rail to the end: derailed, or still in the air.
        forces[90..].fill(0.0);
        assert_eq!(
            warning(&table(&forces), &parts(), (Method::TrBdf2, Units::Us)),
            None
        );
    }
}
