//! Statistics of a run that rules for the assessment of freight cars ask for, from its columns.
//!
//! All lengths of time and distance, frequencies and limits are those that are remembered of AAR M-1001,
//! chapter XI (1993, and a later edition): **check them against your edition**. They are parameters
//! ([`Rules`]).
//!
//! | statistic | how |
//! |---|---|
//! | wheel L/V | lateral force on the rail, positive where it spreads the gauge, over the vertical force; the largest that lasts for the hold time, and over the hold distance |
//! | axle sum L/V | sum of the sizes of both wheels' L/V; the largest that lasts for the hold time |
//! | truck side L/V | lateral over vertical forces of both wheels of a side; the largest that lasts over the side distance |
//! | in curves | the percentile of wheel L/V and axle sums over the rows with the car's middle in full curves |
//! | least wheel load | share of the static one; the least, and the one that is not exceeded for the hold time |
//! | body roll | greatest less least |
//! | accelerations at the truck centers | greatest less least, largest size, largest standard deviation over a distance, largest rms over a time |
//!
//! Raw: from the rows. Filtered: wheel forces and accelerations through a low-pass filter
//! ([`crate::signal::LowPass`]), ratios of filtered forces. Before the settling time nothing counts. A ratio
//! is zero where a wheel carries less than a hundredth of its static load: the value there is the least
//! wheel load.

use std::collections::BTreeMap;

use quantity::{Kind, SixDigits, System as Units};
use serde::{Deserialize, Serialize};

use crate::signal::{LowPass, WindowValue, largest_deviation, largest_rms, percentile, sustained};
use crate::summary::SummaryValue;

const FOOT: f64 = 0.3048;
/// Share of the static load below which a wheel has no ratio.
pub const LEAST_SHARE: f64 = 0.01;
/// The names of the sides in columns.
pub const SIDES: [&str; 2] = ["left", "right"];

/// The rules of statistics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// Cutoff of the filter of wheel forces, Hz.
    pub wheel_filter: f64,
    /// Duration of an exceedance, s.
    pub hold_time: f64,
    /// The same over a distance, m.
    pub hold_distance: f64,
    /// Distance of a truck side's L/V, m.
    pub side_distance: f64,
    /// Share of the rows in curves below the value reported.
    pub percentile: f64,
    /// Cutoff of the filter of accelerations, Hz.
    pub acceleration_filter: f64,
    /// Distance of the standard deviation of accelerations, m.
    pub deviation_distance: f64,
    /// Time of the rms of accelerations, s.
    pub rms_time: f64,
    /// True if results have filtered columns.
    pub filtered_columns: bool,
}

impl Rules {
    /// Returns a text in which hold times and distances are named with their values: `L/V lasting 50 ms`.
    #[must_use]
    pub fn in_words(&self, text: &str) -> String {
        let feet = |length: f64| format!("{} ft", SixDigits(length / FOOT));
        [
            (
                "that lasts for the hold time",
                format!("lasting {} ms", SixDigits(1e3 * self.hold_time)),
            ),
            (
                "that lasts over the hold distance",
                format!("lasting {}", feet(self.hold_distance)),
            ),
            (
                "over the side distance",
                format!("over {}", feet(self.side_distance)),
            ),
        ]
        .into_iter()
        .fold(text.to_owned(), |text, (before, value)| {
            text.replace(before, &value)
        })
    }
}

impl Default for Rules {
    fn default() -> Self {
        Self {
            wheel_filter: 15.0,
            hold_time: 0.05,
            hold_distance: 3.0 * FOOT,
            side_distance: 6.0 * FOOT,
            percentile: 0.95,
            acceleration_filter: 10.0,
            deviation_distance: 2000.0 * FOOT,
            rms_time: 2.0,
            filtered_columns: true,
        }
    }
}

/// The beginning of the warning of a run without statistics.
pub const NO_STATISTICS: &str = "there are no statistics";

/// A column of a run by name (without unit), SI.
pub type StatisticColumn<'c> = &'c dyn Fn(&str) -> &'c [f64];

/// The histories that statistics are taken of.
pub struct Histories<'c> {
    /// The columns. Rows beyond those of the run so far count for filters alone.
    pub column: StatisticColumn<'c>,
    /// Number of rows of the run so far.
    pub rows: usize,
    /// Time between two rows, s.
    pub interval: f64,
    /// The start of the statistics, s.
    pub begin: f64,
    /// Static loads of the wheels, by axle, left and right, N.
    pub static_loads: [[f64; 2]; 4],
    /// True if a distance along the track (m) is in a full curve.
    pub in_curve: &'c dyn Fn(f64) -> bool,
}

/// One number of a run, raw and filtered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Statistic {
    /// From the rows.
    pub raw: Option<SummaryValue>,
    /// From filtered forces or accelerations.
    pub filtered: Option<SummaryValue>,
    /// The start of the filtered value, or else of the raw one, s.
    pub time: Option<f64>,
    /// The reason if there is none, or a remark; else empty.
    pub remark: String,
}

/// A filtered column.
pub struct Filtered {
    /// The name of the raw column, without unit.
    pub of: String,
    /// The values, SI.
    pub values: Vec<f64>,
}

/// The statistics.
pub struct Statistics {
    /// By name.
    pub values: BTreeMap<String, Statistic>,
    /// Filtered columns.
    pub filtered: Vec<Filtered>,
    /// The action that failed.
    pub remarks: Vec<String>,
}

/// The rows from the settling time on: their times and distances.
#[derive(Clone, Copy)]
struct Rows<'c> {
    time: &'c [f64],
    distance: &'c [f64],
}

/// Takes statistics.
struct Taker<'c, 'h> {
    histories: &'c Histories<'h>,
    rules: &'c Rules,
    units: Units,
    rows: Rows<'c>,
    /// The first of the rows, and the one after the last, among all.
    range: (usize, usize),
    taken: Statistics,
}

/// Raw and filtered values of one quantity, from the settling time on.
struct Pair {
    raw: Vec<f64>,
    filtered: Option<Vec<f64>>,
}

impl Pair {
    fn each(&self) -> [Option<&[f64]>; 2] {
        [Some(self.raw.as_slice()), self.filtered.as_deref()]
    }

    /// Combines values of several pairs row by row.
    fn of<const N: usize>(pairs: [&Self; N], combine: impl Fn([f64; N]) -> f64) -> Self {
        let rows = |each: [&[f64]; N]| -> Vec<f64> {
            let count = each.iter().map(|own| own.len()).min().unwrap_or(0);
            (0..count).map(|row| combine(each.map(|own| own[row]))).collect()
        };
        let raw = rows(pairs.map(|own| own.raw.as_slice()));
        let filtered = pairs.iter().all(|own| own.filtered.is_some());
        Self {
            raw,
            filtered: filtered.then(|| rows(pairs.map(|own| own.filtered.as_deref().unwrap_or_default()))),
        }
    }
}

impl Statistics {
    /// Returns the statistics of a run.
    #[must_use]
    pub fn of(histories: &Histories<'_>, rules: &Rules, units: Units) -> Self {
        let column = histories.column;
        let all = column("time");
        let mut own = Self {
            values: BTreeMap::new(),
            filtered: Vec::new(),
            remarks: Vec::new(),
        };
        // A last row may stand nearer to the one before it.
        let even = match all {
            [.., before, last] if last - before < histories.interval * (1.0 - 1e-6) => all.len() - 1,
            _ => all.len(),
        };
        let rows = histories.rows.min(even);
        for (cutoff, names) in [
            (rules.wheel_filter, wheel_forces().collect::<Vec<_>>()),
            (rules.acceleration_filter, accelerations().collect()),
        ] {
            match LowPass::new(histories.interval, cutoff) {
                Ok(filter) => own.filtered.extend(names.into_iter().map(|name| {
                    let mut values = filter.apply(&column(&name)[..even]);
                    values.truncate(rows);
                    Filtered { of: name, values }
                })),
                Err(error) => own.remarks.push(format!(
                    "{error}: nothing is filtered by it; shorten simulation.output_interval"
                )),
            }
        }
        let from = all[..rows]
            .iter()
            .position(|time| *time >= histories.begin * (1.0 - 1e-12));
        let begin = SixDigits(histories.begin);
        let from = match from {
            Some(from) if from + 1 < rows => from,
            Some(_) => {
                own.remarks.push(format!(
                    "{NO_STATISTICS}: from the settling time of {begin} s on the run has one row, and two \
                     are needed; shorten simulation.output_interval, or let the run last longer"
                ));
                return own;
            }
            None => {
                own.remarks.push(format!(
                    "{NO_STATISTICS}: the run does not reach beyond the settling time of {begin} s"
                ));
                return own;
            }
        };
        let mut taker = Taker {
            histories,
            rules,
            units,
            rows: Rows {
                time: &all[from..rows],
                distance: &column("distance")[from..rows],
            },
            range: (from, rows),
            taken: own,
        };
        taker.wheels();
        taker.body();
        taker.taken
    }
}

/// Returns the names of the forces of wheels on rails.
fn wheel_forces() -> impl Iterator<Item = String> {
    let wheels = (1..=4).flat_map(|axle| SIDES.map(|side| format!("axle_{axle}_{side}")));
    wheels.flat_map(|wheel| ["vertical", "lateral"].map(|what| format!("{wheel}_{what}")))
}

/// Returns the names of the accelerations at the truck centers.
fn accelerations() -> impl Iterator<Item = String> {
    let ends = (1..=2).flat_map(|end| ["lateral", "vertical"].map(|direction| (end, direction)));
    ends.map(|(end, direction)| format!("body_at_truck_{end}_{direction}_acceleration"))
}

/// Returns whether statistics need all rows of a column.
pub(super) fn need(name: &str) -> bool {
    let others = ["distance", "body_roll"].contains(&name);
    others || wheel_forces().chain(accelerations()).any(|own| own == name)
}

impl Taker<'_, '_> {
    /// Returns a column, raw and filtered.
    fn pair(&self, name: &str) -> Pair {
        let (from, to) = self.range;
        let values = (self.histories.column)(name);
        let filtered = self.taken.filtered.iter().find(|own| own.of == name);
        Pair {
            raw: values[from..to].to_vec(),
            filtered: filtered.map(|own| own.values[from..].to_vec()),
        }
    }

    fn wheels(&mut self) {
        let (histories, rows, rules) = (self.histories, self.rows, self.rules);
        let curve: Vec<bool> = rows
            .distance
            .iter()
            .map(|own| (histories.in_curve)(*own))
            .collect();
        let mut axles: Vec<[[Pair; 2]; 2]> = Vec::new();
        for (axle, loads) in (1..).zip(histories.static_loads) {
            let mut wheels = Vec::new();
            for (side, load) in SIDES.into_iter().zip(loads) {
                let stem = format!("axle_{axle}_{side}");
                let [vertical, lateral] =
                    ["vertical", "lateral"].map(|what| self.pair(&format!("{stem}_{what}")));
                let ratio = Pair::of([&lateral, &vertical], |[l, v]| ratio(l, v, load));
                self.held(&format!("{stem}_l_over_v"), &ratio);
                self.in_curves(&format!("{stem}_l_over_v"), &ratio, &curve);
                self.least_load(&stem, &vertical, load);
                wheels.push([lateral, vertical]);
            }
            let (Some(right), Some(left)) = (wheels.pop(), wheels.pop()) else {
                return;
            };
            let sum = Pair::of([&left[0], &left[1], &right[0], &right[1]], |[ll, lv, rl, rv]| {
                ratio(ll, lv, loads[0]).abs() + ratio(rl, rv, loads[1]).abs()
            });
            let name = format!("axle_{axle}_sum_l_over_v");
            self.set(&format!("{name}_time"), &sum, Kind::Dimensionless, |values| {
                sustained(rows.time, values, rules.hold_time)
            });
            self.in_curves(&name, &sum, &curve);
            axles.push([left, right]);
        }
        for (truck, pair) in (1..).zip(axles.chunks(2)) {
            let [first, second] = pair else { continue };
            for (side, name) in SIDES.into_iter().enumerate() {
                let least: f64 = histories.static_loads[2 * truck - 2..2 * truck]
                    .iter()
                    .map(|own| own[side])
                    .sum();
                let own = Pair::of(
                    [
                        &first[side][0],
                        &first[side][1],
                        &second[side][0],
                        &second[side][1],
                    ],
                    |[l1, v1, l2, v2]| ratio(l1 + l2, v1 + v2, least),
                );
                self.set(
                    &format!("truck_{truck}_{name}_side_l_over_v"),
                    &own,
                    Kind::Dimensionless,
                    |values| over_distance(rows, values, rules.side_distance),
                );
            }
        }
    }

    /// Wheel L/V that lasts, over time and distance.
    fn held(&mut self, name: &str, ratio: &Pair) {
        let (rows, rules) = (self.rows, self.rules);
        self.set(&format!("{name}_time"), ratio, Kind::Dimensionless, |values| {
            sustained(rows.time, values, rules.hold_time)
        });
        self.set(
            &format!("{name}_distance"),
            ratio,
            Kind::Dimensionless,
            |values| over_distance(rows, values, rules.hold_distance),
        );
    }

    /// The percentile in full curves.
    fn in_curves(&mut self, name: &str, own: &Pair, curve: &[bool]) {
        let found = own.each().map(|values| {
            let inside: Vec<f64> = values?
                .iter()
                .zip(curve)
                .filter(|(_, inside)| **inside)
                .map(|(v, _)| *v)
                .collect();
            percentile(&inside, self.rules.percentile)
        });
        if found[0].is_none() {
            return;
        }
        let [raw, filtered] =
            found.map(|own| own.map(|own| SummaryValue::new(own, Kind::Dimensionless, self.units)));
        let statistic = Statistic {
            raw,
            filtered,
            time: None,
            remark: String::new(),
        };
        self.taken.values.insert(format!("{name}_in_curves"), statistic);
    }

    /// The least load of a wheel, and the one that is not exceeded for the hold time, in % of the static one.
    fn least_load(&mut self, stem: &str, vertical: &Pair, load: f64) {
        let (rows, rules) = (self.rows, self.rules);
        if load <= 0.0 {
            return;
        }
        let percent = |found: WindowValue| SummaryValue {
            value: -100.0 * found.value / load,
            unit: "%".to_owned(),
        };
        let negative = |values: &[f64]| -> Vec<f64> { values.iter().map(|own| -own).collect() };
        for (name, hold) in [("least_load", 0.0), ("least_load_time", rules.hold_time)] {
            let found = vertical
                .each()
                .map(|values| sustained(rows.time, &negative(values?), hold));
            let statistic = Statistic {
                time: found[1].or(found[0]).map(|own| own.start),
                raw: found[0].map(percent),
                filtered: found[1].map(percent),
                remark: String::new(),
            };
            self.taken.values.insert(format!("{stem}_{name}"), statistic);
        }
    }

    fn body(&mut self) {
        let (rows, rules, (from, to)) = (self.rows, self.rules, self.range);
        let roll = Pair {
            raw: (self.histories.column)("body_roll")[from..to].to_vec(),
            filtered: None,
        };
        self.set("body_roll_peak_to_peak", &roll, Kind::Angle, whole(rows));
        for name in accelerations() {
            {
                let own = self.pair(&name);
                let kind = Kind::RideAcceleration;
                self.set(&format!("{name}_peak_to_peak"), &own, kind, whole(rows));
                self.set(&format!("{name}_largest"), &own, kind, |values| {
                    let sizes: Vec<f64> = values.iter().map(|own| own.abs()).collect();
                    sustained(rows.time, &sizes, 0.0)
                });
                let deviation = |values: &[f64]| {
                    let found = largest_deviation(rows.distance, values, rules.deviation_distance)?;
                    Some(timed(rows, found))
                };
                let statistic = format!("{name}_deviation");
                self.set(&statistic, &own, kind, deviation);
                let run = rows.distance[rows.distance.len() - 1] - rows.distance[0];
                if run < rules.deviation_distance
                    && let Some(own) = self.taken.values.get_mut(&statistic)
                {
                    own.remark = format!(
                        "over the {:.0} ft of the run, not over {:.0} ft",
                        run / FOOT,
                        rules.deviation_distance / FOOT
                    );
                }
                self.set(&format!("{name}_rms"), &own, kind, |values| {
                    largest_rms(rows.time, values, rules.rms_time)
                });
            }
        }
    }

    /// Takes a number of raw and of filtered values.
    fn set(&mut self, name: &str, own: &Pair, kind: Kind, take: impl Fn(&[f64]) -> Option<WindowValue>) {
        let found = own.each().map(|values| take(values?));
        let value = |found: WindowValue| SummaryValue::new(found.value, kind, self.units);
        let remark = match found[0] {
            Some(_) => String::new(),
            None => format!(
                "the {:.3} s after settling are too short",
                self.rows.time[self.rows.time.len() - 1] - self.rows.time[0]
            ),
        };
        let statistic = Statistic {
            time: found[1].or(found[0]).map(|own| own.start),
            raw: found[0].map(value),
            filtered: found[1].map(value),
            remark,
        };
        self.taken.values.insert(name.to_owned(), statistic);
    }
}

/// Lateral over vertical force; zero where the wheel carries next to nothing.
#[must_use]
pub fn ratio(lateral: f64, vertical: f64, static_load: f64) -> f64 {
    if vertical > LEAST_SHARE * static_load {
        lateral / vertical
    } else {
        0.0
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

/// Returns the largest value that lasts over a distance, with its time. Where the car stands or goes back
/// there is none.
fn over_distance(rows: Rows<'_>, values: &[f64], distance: f64) -> Option<WindowValue> {
    if rows.distance.windows(2).any(|pair| pair[1] <= pair[0]) {
        return None;
    }
    Some(timed(rows, sustained(rows.distance, values, distance)?))
}

/// Returns a value at a distance with its time.
fn timed(rows: Rows<'_>, found: WindowValue) -> WindowValue {
    let row = rows.distance.partition_point(|own| *own < found.start);
    WindowValue {
        start: rows.time[row.min(rows.time.len() - 1)],
        ..found
    }
}
