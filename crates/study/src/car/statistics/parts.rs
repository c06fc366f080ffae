//! Statistics over sections of the run, as the normal method of EN 14363:2005 takes them (remembered).
//!
//! The run after settling is divided into sections of one length; what is left at the end does not count. The
//! value x of a section is the percentile of 99.85 % or that of 0.15 %, the larger one in size: of sliding
//! means over the mean distance, for L/V and lateral forces of axles, else of the rows. Over the n sections
//! it is `mean(x) + k s(x)` with their standard deviation s (n - 1 in the denominator) and a factor k for
//! safety ([`super::Rules::section_factor_safety`]) or for the track and the ride
//! ([`super::Rules::section_factor`]); of one section x itself. The time is that of the section with the
//! largest x.
//!
//! Limits: the standard also wants at least 25 sections of a kind of track, test speeds and cant deficiencies
//! that are not looked at here, and statistics of two dimensions in curves.

use quantity::{Kind, SixDigits};

use super::{In, Pair, Rows, Taker};
use crate::signal::{WindowValue, percentile, sliding_means};

/// Shares of the percentiles.
const SHARES: [f64; 2] = [0.0015, 0.9985];

impl Taker<'_, '_> {
    /// Sliding means over sections, and the factor for safety.
    pub(super) fn of_means(&mut self, name: &str, own: &Pair, kind: Kind) {
        let distance = self.rules.mean_distance;
        let factor = self.rules.section_factor_safety;
        self.over_sections(name, own, kind, factor, |places, values| {
            largest_percentile(&sliding_means(places, values, distance))
        });
    }

    /// Rows over sections, and the factor for track and ride.
    pub(super) fn of_rows(&mut self, name: &str, own: &Pair, kind: Kind) {
        let factor = self.rules.section_factor;
        self.over_sections(name, own, kind, factor, |_, values| largest_percentile(values));
    }

    fn over_sections(
        &mut self,
        name: &str,
        own: &Pair,
        kind: Kind,
        factor: f64,
        of: impl Fn(&[f64], &[f64]) -> Option<f64>,
    ) {
        let (rows, length) = (self.rows, self.rules.section_length);
        let of_length = SixDigits(length);
        let name = format!("{name}_sections");
        let sections = match rows.go_forward() {
            true => sections(rows, length),
            false => Vec::new(),
        };
        let found = own.each().map(|values| {
            let values = values?;
            let each = sections.iter().map(|&(from, to)| {
                let value = of(&rows.distance[from..to], values.get(from..to)?)?;
                Some((value, rows.time[from]))
            });
            let each: Vec<(f64, f64)> = each.collect::<Option<_>>()?;
            let worst = each.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
            let count = each.len() as f64;
            let mean = each.iter().map(|own| own.0).sum::<f64>() / count;
            let squares = each
                .iter()
                .map(|own| (own.0 - mean) * (own.0 - mean))
                .sum::<f64>();
            Some(WindowValue {
                value: mean + factor * libm::sqrt(squares / (count - 1.0).max(1.0)),
                start: worst.1,
                length,
            })
        });
        self.keep(&name, found, In::Unit(kind, 1.0));
        let remark = match (sections.len(), rows.go_forward()) {
            (_, false) => "the car stands or goes back".to_owned(),
            (0, true) => format!(
                "the {:.0} m after settling are no section of {of_length} m",
                rows.length()
            ),
            (1, true) => format!("of one section of {of_length} m"),
            (count, true) => format!("of {count} sections of {of_length} m"),
        };
        self.remark(&name, remark);
    }
}

/// Returns the larger size of both percentiles.
fn largest_percentile(values: &[f64]) -> Option<f64> {
    let [low, high] = SHARES.map(|share| percentile(values, share));
    Some(low?.abs().max(high?.abs()))
}

/// Returns the first row of each whole section, and the one after its last.
fn sections(rows: Rows<'_>, length: f64) -> Vec<(usize, usize)> {
    let begin = rows.distance[0];
    let row = |number: usize| {
        let at = begin + number as f64 * length;
        rows.distance.partition_point(|own| *own < at * (1.0 - 1e-12))
    };
    let count = (rows.length() / length * (1.0 + 1e-12)).floor() as usize;
    let all = (0..count).map(|number| (row(number), row(number + 1)));
    all.filter(|(from, to)| to > from).collect()
}
