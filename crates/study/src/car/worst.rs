//! The worst of each kind of statistic: over all axles, sides or ends of a car.

use std::collections::BTreeMap;

use quantity::Kind;

use super::statistics::{Of, Statistic};
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
    /// What the statistics are taken of, and the endings of their names.
    of: (Of, &'static str),
    /// True if the least value is worst, false if the greatest.
    least: bool,
    /// True if nothing of it is filtered.
    raw: bool,
    /// The ending of the statistic whose greatest value says where this one counts, if not its own.
    at: Option<&'static str>,
    /// Unit of a number of [`Kind::Dimensionless`].
    pub unit: &'static str,
}

const fn greatest(name: &'static str, kind: Kind, text: &'static str, of: (Of, &'static str)) -> Worst {
    Worst {
        name,
        kind,
        text,
        of,
        least: false,
        raw: false,
        at: None,
        unit: "",
    }
}

impl Worst {
    const fn least(self, unit: &'static str) -> Self {
        Self {
            least: true,
            unit,
            ..self
        }
    }

    const fn raw(self) -> Self {
        Self { raw: true, ..self }
    }

    const fn where_worst_is(self, ending: &'static str) -> Self {
        Self {
            at: Some(ending),
            ..self
        }
    }
}

/// All kinds.
pub const WORST: [Worst; 38] = [
    greatest(
        "l_over_v_time",
        Kind::Dimensionless,
        "largest wheel L/V that lasts for the hold time",
        (Of::Wheel, "_l_over_v_time"),
    ),
    greatest(
        "l_over_v_distance",
        Kind::Dimensionless,
        "largest wheel L/V that lasts over the hold distance",
        (Of::Wheel, "_l_over_v_distance"),
    ),
    greatest(
        "axle_sum_l_over_v_time",
        Kind::Dimensionless,
        "largest axle sum of L/V that lasts for the hold time",
        (Of::Axle, "_sum_l_over_v_time"),
    ),
    greatest(
        "side_l_over_v",
        Kind::Dimensionless,
        "largest L/V of a truck's side over the side distance",
        (Of::Truck, "_side_l_over_v"),
    ),
    greatest(
        "l_over_v_in_curves",
        Kind::Dimensionless,
        "largest percentile of wheel L/V in curves",
        (Of::Wheel, "_l_over_v_in_curves"),
    ),
    greatest(
        "axle_sum_l_over_v_in_curves",
        Kind::Dimensionless,
        "largest percentile of axle sums of L/V in curves",
        (Of::Axle, "_sum_l_over_v_in_curves"),
    ),
    greatest(
        "least_load_time",
        Kind::Dimensionless,
        "least wheel load that lasts for the hold time, % of the static one",
        (Of::Wheel, "_least_load_time"),
    )
    .least("%"),
    greatest(
        "body_roll_peak_to_peak",
        Kind::Angle,
        "greatest less least roll of the body",
        (Of::Body, "_roll_peak_to_peak"),
    )
    .raw(),
    greatest(
        "lateral_acceleration_deviation",
        Kind::RideAcceleration,
        "largest standard deviation of the lateral acceleration at a truck center",
        (Of::Body, "_lateral_acceleration_deviation"),
    ),
    greatest(
        "lateral_acceleration_peak_to_peak",
        Kind::RideAcceleration,
        "greatest less least lateral acceleration at a truck center",
        (Of::Body, "_lateral_acceleration_peak_to_peak"),
    ),
    greatest(
        "vertical_acceleration_peak_to_peak",
        Kind::RideAcceleration,
        "greatest less least vertical acceleration at a truck center",
        (Of::Body, "_vertical_acceleration_peak_to_peak"),
    ),
    greatest(
        "lateral_acceleration_rms",
        Kind::RideAcceleration,
        "largest rms of the lateral acceleration at a truck center",
        (Of::Body, "_lateral_acceleration_rms"),
    ),
    greatest(
        "lateral_acceleration_largest",
        Kind::RideAcceleration,
        "largest lateral acceleration at a truck center",
        (Of::Body, "_lateral_acceleration_largest"),
    ),
    greatest(
        "vertical_acceleration_largest",
        Kind::RideAcceleration,
        "largest vertical acceleration at a truck center",
        (Of::Body, "_vertical_acceleration_largest"),
    ),
    greatest(
        "lateral_acceleration_range",
        Kind::RideAcceleration,
        "greatest less least lateral acceleration at a truck center within the range time, without \
         peaks shorter than the hold time",
        (Of::Body, "_lateral_acceleration_range"),
    ),
    greatest(
        "vertical_acceleration_range",
        Kind::RideAcceleration,
        "the same of the vertical acceleration",
        (Of::Body, "_vertical_acceleration_range"),
    ),
    greatest(
        "lateral_acceleration_rmst",
        Kind::RideAcceleration,
        "largest rms about a straight line over the RMSt time of the lateral acceleration at a truck \
         center",
        (Of::Body, "_lateral_acceleration_rmst"),
    ),
    greatest(
        "vertical_acceleration_rmst",
        Kind::RideAcceleration,
        "the same of the vertical acceleration",
        (Of::Body, "_vertical_acceleration_rmst"),
    ),
    greatest(
        "truck_lateral_acceleration_rms",
        Kind::RideAcceleration,
        "largest rms over the truck's rms time of the lateral acceleration of a bolster or side \
         frame, in the band of trucks",
        (Of::Truck, "_lateral_acceleration_rms"),
    ),
    greatest(
        "truck_lateral_acceleration_rmst",
        Kind::RideAcceleration,
        "the same about a straight line",
        (Of::Truck, "_lateral_acceleration_rmst"),
    ),
    greatest(
        "nadal_share_time",
        Kind::Dimensionless,
        "largest share of Nadal's limit of L/V that lasts for the hold time",
        (Of::Wheel, "_nadal_share_time"),
    ),
    greatest(
        "weinstock_share_time",
        Kind::Dimensionless,
        "largest share of Weinstock's limit of the axle sum that lasts for the hold time",
        (Of::Axle, "_weinstock_share_time"),
    ),
    greatest(
        "climb_distance",
        Kind::Distance,
        "longest distance over which a wheel's L/V exceeds Nadal's limit",
        (Of::Wheel, "_climb_distance"),
    ),
    greatest(
        "climb_angle_of_attack",
        Kind::Angle,
        "mean size of the axle's yaw along that distance; zero where nothing climbs",
        (Of::Wheel, "_climb_angle_of_attack"),
    )
    .where_worst_is("_climb_distance"),
    greatest(
        "wheel_lift",
        Kind::Length,
        "largest lift of a wheel off its rail",
        (Of::Wheel, "_lift_largest"),
    )
    .raw(),
    greatest(
        "net_axle_l_over_v",
        Kind::Dimensionless,
        "largest lateral force of an axle over its static load that lasts over the hold distance",
        (Of::Axle, "_net_l_over_v"),
    ),
    greatest(
        "least_load_distance",
        Kind::Dimensionless,
        "least wheel load that lasts over the hold distance, % of the static one",
        (Of::Wheel, "_least_load_distance"),
    )
    .least("%"),
    greatest(
        "least_side_load",
        Kind::Dimensionless,
        "least load of a truck's side that lasts over the side distance, % of the static one",
        (Of::Truck, "_least_side_load"),
    )
    .least("%"),
    greatest(
        "axle_lateral_force_mean",
        Kind::Force,
        "largest mean of an axle's lateral force over the mean distance",
        (Of::Axle, "_lateral_force_mean"),
    ),
    greatest(
        "axle_lateral_force_instability",
        Kind::Force,
        "largest rms of an axle's lateral force over a section's length, within 2 Hz of its dominant \
         frequency",
        (Of::Axle, "_lateral_force_instability"),
    ),
    greatest(
        "lateral_force_in_curves",
        Kind::Force,
        "largest quasi-static lateral force of a wheel: the median of a full curve",
        (Of::Wheel, "_lateral_force_in_curves"),
    ),
    greatest(
        "vertical_force_in_curves",
        Kind::Force,
        "largest quasi-static vertical force of a wheel: the median of a full curve",
        (Of::Wheel, "_vertical_force_in_curves"),
    ),
    greatest(
        "least_quasi_static_load",
        Kind::Dimensionless,
        "least mean load of a wheel in a full curve, % of the static one",
        (Of::Wheel, "_quasi_static_load"),
    )
    .least("%"),
    greatest(
        "l_over_v_sections",
        Kind::Dimensionless,
        "mean and deviations of wheel L/V over sections",
        (Of::Wheel, "_l_over_v_sections"),
    ),
    greatest(
        "axle_lateral_force_sections",
        Kind::Force,
        "mean and deviations of an axle's lateral force over sections",
        (Of::Axle, "_lateral_force_sections"),
    ),
    greatest(
        "vertical_force_sections",
        Kind::Force,
        "mean and deviations of a wheel's vertical force over sections",
        (Of::Wheel, "_vertical_force_sections"),
    ),
    greatest(
        "lateral_acceleration_sections",
        Kind::RideAcceleration,
        "mean and deviations of the lateral acceleration at a truck center over sections",
        (Of::Body, "_lateral_acceleration_sections"),
    ),
    greatest(
        "vertical_acceleration_sections",
        Kind::RideAcceleration,
        "mean and deviations of the vertical acceleration at a truck center over sections",
        (Of::Body, "_vertical_acceleration_sections"),
    ),
];

/// The worst statistic of a kind.
#[derive(Clone, Copy, Debug)]
pub struct WorstStatistic<'s> {
    /// Its name.
    pub statistic: &'s str,
    /// Where it is taken, in words.
    pub place: &'s str,
    /// Its value: filtered, or raw where nothing is filtered.
    pub value: &'s SummaryValue,
    /// The start of that value, s.
    pub time: Option<f64>,
    /// True if the value is filtered.
    pub filtered: bool,
}

impl Worst {
    /// Returns the kind with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        WORST.iter().find(|own| own.name == name)
    }

    /// Returns whether it is taken in full curves alone: on a track without them there is none.
    #[must_use]
    pub fn is_of_curves(&self) -> bool {
        self.name.ends_with("_in_curves") || self.name == "least_quasi_static_load"
    }

    /// Returns whether rules want it of filtered values.
    #[must_use]
    pub fn is_filtered(&self) -> bool {
        !self.raw
    }

    /// Finds it among the statistics of a run, if there is one of its kind.
    #[must_use]
    pub fn of<'s>(&self, statistics: &'s BTreeMap<String, Statistic>) -> Option<WorstStatistic<'s>> {
        let (of, ending) = self.of;
        let Some(other) = self.at else {
            return worst(statistics, (of, ending), self.least);
        };
        let place = worst(statistics, (of, other), false)?;
        let name = place.statistic.strip_suffix(other)?;
        let (statistic, own) = statistics.get_key_value(&format!("{name}{ending}"))?;
        found(statistic, own)
    }
}

fn worst<'s>(
    statistics: &'s BTreeMap<String, Statistic>,
    (of, ending): (Of, &str),
    least: bool,
) -> Option<WorstStatistic<'s>> {
    let own = statistics
        .iter()
        .filter(|(name, own)| name.ends_with(ending) && own.of == of);
    let worse = |a: f64, b: f64| if least { a < b } else { a > b };
    let all = own.filter_map(|(name, own)| found(name, own));
    all.reduce(|worst, own| match worse(own.value.value, worst.value.value) {
        true => own,
        false => worst,
    })
}

fn found<'s>(statistic: &'s str, own: &'s Statistic) -> Option<WorstStatistic<'s>> {
    Some(WorstStatistic {
        statistic,
        place: &own.place,
        value: own.filtered.as_ref().or(own.raw.as_ref())?,
        time: own.time,
        filtered: own.filtered.is_some(),
    })
}
