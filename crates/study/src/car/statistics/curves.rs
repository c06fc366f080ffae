//! Statistics of the rows with the car's middle in full curves.
//!
//! | statistic | how |
//! |---|---|
//! | L/V in curves | the percentile of all rows in full curves |
//! | forces in curves | quasi-static forces: the median of each full curve; the largest in size |
//! | quasi-static load | the mean vertical force in each full curve, share of the static one; the least |
//!
//! A full curve is one stretch of rows on it: in the next one, to the other side, a wheel has other forces.

use quantity::Kind;

use super::{In, Pair, Taker};
use crate::signal::{WindowValue, percentile};

impl Taker<'_, '_> {
    /// The percentile in full curves.
    pub(super) fn in_curves(&mut self, name: &str, own: &Pair) {
        let found = own.each().map(|values| {
            let rows = values?.iter().zip(&self.curve);
            let inside: Vec<f64> = rows.filter(|(_, inside)| **inside).map(|(v, _)| *v).collect();
            percentile(&inside, self.rules.percentile)
        });
        if found[0].is_none() {
            return;
        }
        let name = format!("{name}_in_curves");
        let value = |value: f64| WindowValue {
            value,
            start: 0.0,
            length: 0.0,
        };
        let unit = In::Unit(Kind::Dimensionless, 1.0);
        self.keep(&name, found.map(|own| own.map(value)), unit);
        // It is of all rows.
        if let Some(own) = self.taken.values.get_mut(&name) {
            own.time = None;
        }
    }

    /// Quasi-static forces of a wheel; its static load, N.
    pub(super) fn forces_in_curves(&mut self, stem: &str, lateral: &Pair, vertical: &Pair, load: f64) {
        let curves = self.full_curves();
        if curves.is_empty() {
            return;
        }
        let rows = self.rows;
        // The largest of what each curve has.
        let largest = |values: &[f64], of: fn(&[f64]) -> Option<f64>| {
            let own = curves.iter().filter_map(|&(from, to)| {
                Some(WindowValue {
                    value: of(values.get(from..to)?)?,
                    start: rows.time[from],
                    length: rows.time[to - 1] - rows.time[from],
                })
            });
            own.reduce(|most, own| if own.value > most.value { own } else { most })
        };
        let size: fn(&[f64]) -> Option<f64> = |values| percentile(values, 0.5).map(f64::abs);
        for (name, own) in [("lateral", lateral), ("vertical", vertical)] {
            let name = format!("{stem}_{name}_force_in_curves");
            self.keep(
                &name,
                own.each().map(|values| largest(values?, size)),
                In::Unit(Kind::Force, 1.0),
            );
        }
        if load > 0.0 {
            let relief: fn(&[f64]) -> Option<f64> =
                |values| Some(-values.iter().sum::<f64>() / values.len() as f64);
            let found = vertical.each().map(|values| largest(values?, relief));
            self.keep(&format!("{stem}_quasi_static_load"), found, In::PercentOf(-load));
        }
    }

    /// The first row of each full curve, and the one after its last.
    fn full_curves(&self) -> Vec<(usize, usize)> {
        let mut all = Vec::new();
        let mut row = 0;
        for own in self.curve.chunk_by(|a, b| a == b) {
            if own[0] {
                all.push((row, row + own.len()));
            }
            row += own.len();
        }
        all
    }
}
