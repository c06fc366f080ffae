//! Statistics of the body and of the parts of trucks.
//!
//! | statistic | how |
//! |---|---|
//! | body roll | greatest less least |
//! | accelerations at the truck centers | greatest less least; of levels that are held for the hold time within the range time ([`crate::signal::largest_range`]); largest size; largest standard deviation over a distance; largest rms over a time; largest rms about a line over a time |
//! | lateral accelerations of bolster and side frames | largest rms over a time, about zero and about a line; filtered: in the band of trucks |

use quantity::Kind;

use super::{FOOT, In, Of, Pair, Rows, Taker, timed};
use crate::signal::{
    BandPass, WindowValue, largest_deviation, largest_range, largest_rms, largest_rmst, sustained,
};

impl Taker<'_, '_> {
    pub(super) fn body(&mut self) {
        let (rows, rules) = (self.rows, self.rules);
        let parts = self.histories.parts;
        for own in &parts.bodies {
            let name = format!("{}_roll", own.name);
            if let Some(raw) = self.column(&name).map(<[f64]>::to_vec) {
                self.at = (Of::Body, own.words.clone());
                let roll = Pair { raw, filtered: None };
                self.set(&format!("{name}_peak_to_peak"), &roll, Kind::Angle, whole(rows));
            }
        }
        let kind = Kind::RideAcceleration;
        // Two of each place.
        for (number, name) in parts.accelerations().into_iter().enumerate() {
            self.at = (Of::Body, parts.on_bodies[number / 2].words.clone());
            let own = self.pair(&name);
            self.set(&format!("{name}_peak_to_peak"), &own, kind, whole(rows));
            self.set(&format!("{name}_largest"), &own, kind, |values| {
                let sizes: Vec<f64> = values.iter().map(|own| own.abs()).collect();
                sustained(rows.time, &sizes, 0.0)
            });
            let statistic = format!("{name}_deviation");
            self.set(&statistic, &own, kind, |values| {
                let found = largest_deviation(rows.distance, values, rules.deviation_distance)?;
                Some(timed(rows, found))
            });
            if rows.length() < rules.deviation_distance {
                let text = format!(
                    "over the {:.0} ft of the run, not over {:.0} ft",
                    rows.length() / FOOT,
                    rules.deviation_distance / FOOT
                );
                self.remark(&statistic, text);
            }
            self.set(&format!("{name}_rms"), &own, kind, |values| {
                largest_rms(rows.time, values, rules.rms_time)
            });
            self.within(
                &format!("{name}_range"),
                &own,
                rules.range_time,
                |values, time| largest_range(rows.time, values, time, rules.hold_time),
            );
            self.within(&format!("{name}_rmst"), &own, rules.rmst_time, |values, time| {
                largest_rmst(rows.time, values, time)
            });
            self.of_rows(&name, &own, kind);
        }
    }

    /// Accelerations of the parts of trucks; rows up to `even` are evenly apart.
    pub(super) fn trucks(&mut self, even: usize) {
        let (rows, rules, (from, to)) = (self.rows, self.rules, self.range);
        let all = self.histories.parts.on_trucks.iter();
        let names = all.map(|own| (format!("{}_lateral_acceleration", own.name), &own.words));
        let names: Vec<(String, &String)> = names.filter(|(name, _)| self.column(name).is_some()).collect();
        let filter = BandPass::new(self.histories.interval, rules.truck_band);
        if let (Err(error), false) = (&filter, names.is_empty()) {
            self.taken.remarks.push(format!(
                "{error}: accelerations of trucks are not filtered; shorten simulation.output_interval"
            ));
        }
        for (name, words) in names {
            self.at = (Of::Truck, words.clone());
            let all = (self.histories.column)(&name);
            let filtered = filter
                .as_ref()
                .ok()
                .map(|own| own.apply(&all[..even])[from..to].to_vec());
            let raw = all[from..to].to_vec();
            let own = Pair { raw, filtered };
            let time = rules.truck_rms_time;
            self.within(&format!("{name}_rms"), &own, time, |values, time| {
                largest_rms(rows.time, values, time)
            });
            self.within(&format!("{name}_rmst"), &own, time, |values, time| {
                largest_rmst(rows.time, values, time)
            });
        }
    }

    /// An acceleration within windows of a time (s), or of the run where that is shorter.
    fn within(
        &mut self,
        name: &str,
        own: &Pair,
        time: f64,
        take: impl Fn(&[f64], f64) -> Option<WindowValue>,
    ) {
        let found = own.each().map(|values| take(values?, time));
        let shorter = found[0].filter(|own| own.length < time * (1.0 - 1e-9));
        self.keep(name, found, In::Unit(Kind::RideAcceleration, 1.0));
        if let Some(own) = shorter {
            let text = format!("within the {:.3} s of the run, not within {time} s", own.length);
            self.remark(name, text);
        }
    }
}

/// Greatest less least value of all rows, with the time from the first of both to the second.
fn whole(rows: Rows<'_>) -> impl Fn(&[f64]) -> Option<WindowValue> {
    move |values| {
        let extreme = |worse: fn(&f64, &f64) -> bool| {
            let pairs = values.iter().zip(rows.time);
            pairs.reduce(|most, own| if worse(own.0, most.0) { own } else { most })
        };
        let (greatest, least) = (extreme(|a, b| a > b)?, extreme(|a, b| a < b)?);
        Some(WindowValue {
            value: greatest.0 - least.0,
            start: greatest.1.min(*least.1),
            length: (greatest.1 - least.1).abs(),
        })
    }
}
