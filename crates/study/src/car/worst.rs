//! The worst of each kind of statistic: over all axles, sides or ends of a car.

use std::collections::BTreeMap;

use quantity::Kind;

use super::statistics::Statistic;
use crate::summary::SummaryValue;

/// The rule that selects from all statistics of one kind.
#[derive(Debug, PartialEq)]
pub struct Worst {
    /// The name of the measure that studies keep and limits name.
    pub name: &'static str,
    /// The kind of quantity.
    pub kind: Kind,
    /// The description, a few words.
    pub text: &'static str,
    /// The endings of the names of the statistics.
    ending: &'static str,
    /// True if the least value is worst, false if the greatest.
    least: bool,
    /// Unit of a number of [`Kind::Dimensionless`].
    pub unit: &'static str,
}

const fn greatest(name: &'static str, kind: Kind, text: &'static str, ending: &'static str) -> Worst {
    Worst {
        name,
        kind,
        text,
        ending,
        least: false,
        unit: "",
    }
}

/// All kinds.
pub const WORST: [Worst; 12] = [
    greatest(
        "l_over_v_time",
        Kind::Dimensionless,
        "largest wheel L/V that lasts for the hold time",
        "_l_over_v_time",
    ),
    greatest(
        "l_over_v_distance",
        Kind::Dimensionless,
        "largest wheel L/V that lasts over the hold distance",
        "_l_over_v_distance",
    ),
    greatest(
        "axle_sum_l_over_v_time",
        Kind::Dimensionless,
        "largest axle sum of L/V that lasts for the hold time",
        "_sum_l_over_v_time",
    ),
    greatest(
        "side_l_over_v",
        Kind::Dimensionless,
        "largest L/V of a truck's side over the side distance",
        "_side_l_over_v",
    ),
    greatest(
        "l_over_v_in_curves",
        Kind::Dimensionless,
        "largest percentile of wheel L/V in curves",
        "_l_over_v_in_curves",
    ),
    greatest(
        "axle_sum_l_over_v_in_curves",
        Kind::Dimensionless,
        "largest percentile of axle sums of L/V in curves",
        "_sum_l_over_v_in_curves",
    ),
    Worst {
        name: "least_load_time",
        kind: Kind::Dimensionless,
        text: "least wheel load that lasts for the hold time, % of the static one",
        ending: "_least_load_time",
        least: true,
        unit: "%",
    },
    greatest(
        "body_roll_peak_to_peak",
        Kind::Angle,
        "greatest less least roll of the body",
        "body_roll_peak_to_peak",
    ),
    greatest(
        "lateral_acceleration_deviation",
        Kind::RideAcceleration,
        "largest standard deviation of the lateral acceleration at a truck center",
        "_lateral_acceleration_deviation",
    ),
    greatest(
        "lateral_acceleration_peak_to_peak",
        Kind::RideAcceleration,
        "greatest less least lateral acceleration at a truck center",
        "_lateral_acceleration_peak_to_peak",
    ),
    greatest(
        "vertical_acceleration_peak_to_peak",
        Kind::RideAcceleration,
        "greatest less least vertical acceleration at a truck center",
        "_vertical_acceleration_peak_to_peak",
    ),
    greatest(
        "lateral_acceleration_rms",
        Kind::RideAcceleration,
        "largest rms of the lateral acceleration at a truck center",
        "_lateral_acceleration_rms",
    ),
];

/// The worst statistic of a kind.
#[derive(Clone, Copy, Debug)]
pub struct WorstStatistic<'s> {
    /// Its name.
    pub statistic: &'s str,
    /// Its value: filtered, or raw where nothing is filtered.
    pub value: &'s SummaryValue,
    /// The start of that value, s.
    pub time: Option<f64>,
    /// True if the value is filtered.
    pub filtered: bool,
}

/// Returns where a statistic is taken, in words, by its name: `axle_2_right_l_over_v_time` is taken at axle
/// 2, right wheel.
#[must_use]
pub fn place_in_words(statistic: &str) -> String {
    let parts: Vec<&str> = statistic.split('_').collect();
    match parts.as_slice() {
        ["axle", axle, side @ ("left" | "right"), ..] => format!("axle {axle}, {side} wheel"),
        ["axle", axle, ..] => format!("axle {axle}"),
        ["truck", truck, side @ ("left" | "right"), ..] => format!("truck {truck}, {side} side"),
        ["truck", truck, ..] => format!("truck {truck}"),
        ["body", "at", "truck", truck, ..] => format!("body over truck {truck}"),
        ["body", ..] => "body".to_owned(),
        _ => statistic.replace('_', " "),
    }
}

impl Worst {
    /// Returns the kind with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        WORST.iter().find(|own| own.name == name)
    }

    /// Returns whether rules want it of filtered values: all but angles.
    #[must_use]
    pub fn is_filtered(&self) -> bool {
        self.kind != Kind::Angle
    }

    /// Finds it among the statistics of a run, if there is one of its kind.
    #[must_use]
    pub fn of<'s>(&self, statistics: &'s BTreeMap<String, Statistic>) -> Option<WorstStatistic<'s>> {
        let sum = self.ending.contains("_sum_");
        let own = statistics
            .iter()
            .filter(|(name, _)| name.ends_with(self.ending) && (sum || !name.contains("_sum_")));
        let found = own.filter_map(|(statistic, own)| {
            let value = own.filtered.as_ref().or(own.raw.as_ref())?;
            Some(WorstStatistic {
                statistic,
                value,
                time: own.time,
                filtered: own.filtered.is_some(),
            })
        });
        let worse = |a: f64, b: f64| if self.least { a < b } else { a > b };
        found.reduce(|worst, own| match worse(own.value.value, worst.value.value) {
            true => own,
            false => worst,
        })
    }
}
