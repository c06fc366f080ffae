//! The filtered columns of a run, beside the raw ones.

use mechanics::output::Column;

use super::{Parts, Rules, SIDES, Statistics, ratio};
use crate::signal::LowPass;

/// Returns the columns of a run with those that are filtered after them.
#[must_use]
pub fn with_filtered(raw: &[Column], parts: &Parts, rules: &Rules) -> Vec<Column> {
    let names = names(parts);
    let all = raw
        .iter()
        .filter(|own| rules.filtered_columns && names.contains(&own.name));
    let filtered = all.map(|column| Column {
        name: format!("{}_filtered", column.name),
        ..column.clone()
    });
    let filtered: Vec<Column> = filtered.collect();
    [raw, &filtered].concat()
}

/// The names of the columns that are filtered.
fn names(parts: &Parts) -> Vec<String> {
    let axles = parts.axles.iter();
    let ratios = axles.flat_map(|own| SIDES.map(|side| format!("{}_{side}_l_over_v", own.name)));
    [parts.wheel_forces(), ratios.collect(), parts.accelerations()].concat()
}

/// Returns the filtered columns with their values at so many rows.
#[must_use]
pub fn filtered(
    statistics: &Statistics,
    (parts, rules): (&Parts, &Rules),
    columns: &[Column],
    rows: usize,
) -> Vec<(Column, Vec<f64>)> {
    let mut all = Vec::new();
    if !rules.filtered_columns {
        return all;
    }
    let mut append = |of: &str, own: Vec<f64>, cutoff: f64| {
        let Some(raw) = columns.iter().find(|column| column.name == of).cloned() else {
            return;
        };
        let column = Column {
            name: format!("{of}_filtered"),
            text: format!("{}; below {cutoff} Hz", raw.text),
            ..raw
        };
        all.push((column, own));
    };
    let whole = |name: &str| -> Option<Vec<f64>> {
        let own = statistics.filtered.iter().find(|own| own.of == name)?;
        let mut values = own.values.clone();
        // A last row that is nearer than the others has the value before it.
        let last = values.last().copied().unwrap_or_default();
        values.resize(rows, last);
        Some(values)
    };
    for (axle, own) in parts.axles.iter().enumerate() {
        for (side, name) in SIDES.into_iter().enumerate() {
            let names = ["vertical", "lateral"].map(|what| parts.force_of(axle, side, what));
            let [Some(vertical), Some(lateral)] = names.each_ref().map(|name| whole(name)) else {
                continue;
            };
            let pairs = lateral.iter().zip(&vertical);
            let ratios = pairs.map(|(l, v)| ratio(*l, *v, own.loads[side])).collect();
            let [vertical_name, lateral_name] = &names;
            append(vertical_name, vertical, rules.wheel_filter);
            append(lateral_name, lateral, rules.wheel_filter);
            append(
                &format!("{}_{name}_l_over_v", own.name),
                ratios,
                rules.wheel_filter,
            );
        }
    }
    for name in parts.accelerations() {
        if let Some(own) = whole(&name) {
            append(&name, own, rules.acceleration_filter);
        }
    }
    all
}

/// Returns the time (s) that the filters of wheel forces and of the body's accelerations look ahead; the band
/// of trucks takes what rows there are ([`super`]).
#[must_use]
pub fn look_ahead(rules: &Rules, interval: f64) -> f64 {
    let filters = [rules.wheel_filter, rules.acceleration_filter].map(|own| LowPass::new(interval, own));
    let rows = filters.iter().flatten().map(LowPass::rows_ahead).max();
    rows.map_or(0.0, |rows| (rows + 1) as f64 * interval)
}
