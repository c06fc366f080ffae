//! Statistics of a run that rules for the assessment of vehicles ask for, from its columns.
//!
//! Lengths of time and distance, frequencies and factors are parameters ([`Rules`]); the usual ones are
//! remembered of AAR M-1001, chapter XI (1993, and a later edition), of 49 CFR 213.333 (windows of 1, 2 and 4
//! s, the band of trucks) and of EN 14363:2005 (sections): **check them against your edition**.
//!
//! | statistic | how | |
//! |---|---|---|
//! | L/V, axle sums, truck sides, loads, Nadal, climb, lift, forces of axles | largest or least that lasts over a time or a distance | [`wheels`] |
//! | in full curves | percentiles, medians, means | [`curves`] |
//! | roll and accelerations of the body, accelerations of trucks | range, size, deviation, rms, rms about a line | [`body`] |
//! | over sections of the run | mean and deviations of percentiles | [`parts`] |
//!
//! Raw: from the rows. Filtered: wheel forces and accelerations through a low-pass filter
//! ([`crate::signal::LowPass`]), ratios of filtered forces; accelerations of trucks through a band-pass
//! ([`crate::signal::BandPass`]). Before the settling time nothing counts. A ratio is zero where a wheel
//! carries less than a hundredth of its static load: the value there is the least wheel load.
//!
//! A filtered value depends on rows after it. Those of the low-pass filters are the same whether the run ends
//! or goes on, since runs look ahead for them. The band-pass of trucks would need to see a minute ahead: it
//! takes the rows that there are, so that the trucks' statistics of a run that is interrupted are those at
//! its end so far, and those of the whole run come out when it is whole.

use std::collections::BTreeMap;

use ::car::ClimbLimits;
use quantity::{Kind, SixDigits, System as Units};
use serde::{Deserialize, Serialize};

pub use ::car::ratio;
pub(crate) use of_parts::in_words;
pub use of_parts::{AxlePart, Of, Parts, PlacePart, TruckPart};
pub use rules::Rules;

use crate::signal::{LowPass, WindowValue};
use crate::summary::SummaryValue;

pub mod body;
pub mod curves;
pub mod filtered;
mod of_parts;
pub mod parts;
mod rules;
pub mod wheels;

const FOOT: f64 = 0.3048;
/// The names of the sides in columns.
pub const SIDES: [&str; 2] = ["left", "right"];

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
    /// What they are taken of.
    pub parts: &'c Parts,
    /// What flanges climb at; none with linear wheels.
    pub climb: Option<&'c ClimbLimits>,
    /// True if a distance along the track (m) is in a full curve.
    pub in_curve: &'c dyn Fn(f64) -> bool,
}

/// One number of a run, raw and filtered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Statistic {
    /// What it is taken of.
    #[serde(default)]
    pub of: Of,
    /// Where it is taken, in words: "axle 2, right wheel"; empty in older summaries.
    #[serde(default)]
    pub place: String,
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
    /// Filtered columns, without those of the accelerations of trucks.
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

impl Rows<'_> {
    /// Returns whether the car goes forward all the time.
    fn go_forward(&self) -> bool {
        self.distance.windows(2).all(|pair| pair[1] > pair[0])
    }

    /// Returns the length of the run, m.
    fn length(&self) -> f64 {
        self.distance[self.distance.len() - 1] - self.distance[0]
    }

    /// Returns the time of the first row at a distance or beyond.
    fn time_at(&self, distance: f64) -> f64 {
        let row = self.distance.partition_point(|own| *own < distance);
        self.time[row.min(self.time.len() - 1)]
    }
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
    /// Rows in full curves.
    curve: Vec<bool>,
    /// What the statistics to be kept are of, and where, in words.
    at: (Of, String),
}

/// Raw and filtered values of one quantity, from the settling time on.
#[derive(Default)]
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
        Self::by_row(pairs, |_, values| combine(values))
    }

    /// The same, with the number of the row.
    fn by_row<const N: usize>(pairs: [&Self; N], combine: impl Fn(usize, [f64; N]) -> f64) -> Self {
        let rows = |each: [&[f64]; N]| -> Vec<f64> {
            let count = each.iter().map(|own| own.len()).min().unwrap_or(0);
            (0..count)
                .map(|row| combine(row, each.map(|own| own[row])))
                .collect()
        };
        let raw = rows(pairs.map(|own| own.raw.as_slice()));
        let filtered = pairs.iter().all(|own| own.filtered.is_some());
        Self {
            raw,
            filtered: filtered.then(|| rows(pairs.map(|own| own.filtered.as_deref().unwrap_or_default()))),
        }
    }

    /// Adds several pairs.
    fn sum<'p>(pairs: impl Iterator<Item = &'p Self> + Clone) -> Self {
        let zero = |own: &Self| Self::of([own], |_| 0.0);
        let Some(first) = pairs.clone().next() else {
            return Self::default();
        };
        pairs.fold(zero(first), |sum, own| Self::of([&sum, own], |[a, b]| a + b))
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
        let parts = histories.parts;
        for (cutoff, names) in [
            (rules.wheel_filter, parts.wheel_forces()),
            (rules.acceleration_filter, parts.accelerations()),
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
        let distance = &column(&parts.distance)[from..rows];
        let mut taker = Taker {
            histories,
            rules,
            units,
            rows: Rows {
                time: &all[from..rows],
                distance,
            },
            range: (from, rows),
            taken: own,
            curve: distance.iter().map(|own| (histories.in_curve)(*own)).collect(),
            at: (Of::Body, String::new()),
        };
        taker.wheels();
        taker.body();
        taker.trucks(even);
        taker.taken
    }
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

    /// Returns a column, if the run has it.
    fn column(&self, name: &str) -> Option<&[f64]> {
        let (from, to) = self.range;
        (self.histories.column)(name).get(from..to)
    }

    /// Takes a number of raw and of filtered values.
    fn set(&mut self, name: &str, own: &Pair, kind: Kind, take: impl Fn(&[f64]) -> Option<WindowValue>) {
        self.keep(name, own.each().map(|values| take(values?)), In::Unit(kind, 1.0));
    }

    /// As [`Taker::set`], of rows over the distance: where the car stands or goes back there is none.
    fn over_distance(
        &mut self,
        name: &str,
        own: &Pair,
        unit: In,
        take: impl Fn(&[f64], &[f64]) -> Option<WindowValue>,
    ) {
        let rows = self.rows;
        let forward = rows.go_forward();
        let taken = |values: &[f64]| Some(timed(rows, take(rows.distance, values)?)).filter(|_| forward);
        self.keep(name, own.each().map(|values| taken(values?)), unit);
        if !forward {
            self.remark(name, "the car stands or goes back".to_owned());
        }
    }

    /// Keeps a number, raw and filtered.
    fn keep(&mut self, name: &str, found: [Option<WindowValue>; 2], unit: In) {
        let value = |found: WindowValue| unit.of(found.value, self.units);
        let remark = match found {
            [None, None] => format!(
                "the {:.3} s after settling are too short",
                self.rows.time[self.rows.time.len() - 1] - self.rows.time[0]
            ),
            _ => String::new(),
        };
        let (of, place) = self.at.clone();
        let statistic = Statistic {
            of,
            place,
            time: found[1].or(found[0]).map(|own| own.start),
            raw: found[0].map(value),
            filtered: found[1].map(value),
            remark,
        };
        self.taken.values.insert(name.to_owned(), statistic);
    }

    /// Sets the remark of a number.
    fn remark(&mut self, name: &str, text: String) {
        if let Some(own) = self.taken.values.get_mut(name) {
            own.remark = text;
        }
    }
}

/// The unit of a number of the summary, and a factor.
#[derive(Clone, Copy)]
enum In {
    /// That of its kind.
    Unit(Kind, f64),
    /// Percent, of this value.
    PercentOf(f64),
}

impl In {
    fn of(self, value: f64, units: Units) -> SummaryValue {
        match self {
            Self::Unit(kind, factor) => SummaryValue::new(factor * value, kind, units),
            Self::PercentOf(whole) => SummaryValue {
                value: 100.0 * value / whole,
                unit: "%".to_owned(),
            },
        }
    }
}

/// Returns a value at a distance with its time.
fn timed(rows: Rows<'_>, found: WindowValue) -> WindowValue {
    WindowValue {
        start: rows.time_at(found.start),
        ..found
    }
}
