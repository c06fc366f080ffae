//! The numbers of a run that people compare first, each with its window: over what it is taken.

use std::collections::BTreeMap;

use quantity::{Kind, System as Units};
use study::car::summary::CarSummary;
use study::half_truck::HalfTruckSummary;
use study::metrics::Extremes;
use study::models::{AnyCase, AnySummary};
use study::summary::{Summary, SummaryValue};
use study::truck::WEDGE_NAMES;
use study::truck::summary::TruckSummary;
use study::vehicle::summary::VehicleSummary;
use study::wedge_rise::RiseSummary;
use study::wheelset::summary::WheelsetSummary;
use wedge::parameters::Damping;

use super::RunFolder;
use crate::figures::digits;

/// A number of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyNumber {
    /// The description.
    pub what: String,
    /// Over what it is taken.
    pub window: String,
    /// The number with its unit, as the summary has it.
    pub value: SummaryValue,
    /// Its kind, if its unit is one that can be converted.
    pub kind: Option<Kind>,
}

/// The window of every whole-run extreme.
const ALL_TIMES: &str = "all output times";

impl KeyNumber {
    fn new(what: impl Into<String>, window: impl Into<String>, value: &SummaryValue, kind: Kind) -> Self {
        Self {
            what: what.into(),
            window: window.into(),
            value: value.clone(),
            kind: Some(kind),
        }
    }

    /// Returns a number of a unit that stays as it is.
    fn plain(what: impl Into<String>, window: impl Into<String>, value: f64, unit: &str) -> Self {
        Self {
            what: what.into(),
            window: window.into(),
            value: SummaryValue {
                value,
                unit: unit.to_owned(),
            },
            kind: None,
        }
    }

    /// Returns the key numbers of a wedge's run; without its damping the window of means is told in general.
    #[must_use]
    pub fn of_wedge(summary: &Summary, damping: Option<Damping>) -> Vec<Self> {
        of_wedge(summary, damping)
    }

    /// Returns the key numbers of a truck's run.
    #[must_use]
    pub fn of_truck(summary: &TruckSummary) -> Vec<Self> {
        of_truck(summary)
    }

    /// Returns the number in these units, as far as it can be converted.
    #[must_use]
    pub fn in_units(&self, units: Units) -> SummaryValue {
        let own = |kind: Kind| {
            [Units::Us, Units::Si]
                .into_iter()
                .find(|own| kind.label(*own) == self.value.unit)
        };
        match self.kind.and_then(|kind| Some((kind, own(kind)?))) {
            Some((kind, own)) if own != units => SummaryValue {
                value: self.value.value / kind.from_si(own) * kind.from_si(units),
                unit: kind.label(units).to_owned(),
            },
            _ => self.value.clone(),
        }
    }
}

impl RunFolder {
    /// Returns the numbers that people compare first.
    #[must_use]
    pub fn key_numbers(&self) -> Vec<KeyNumber> {
        let case = self.case.as_ref().and_then(AnyCase::wedge);
        match &self.summary {
            AnySummary::Wedge(own) => of_wedge(own, case.map(|case| case.parameters.damping)),
            AnySummary::HalfTruck(own) => of_half_truck(own),
            AnySummary::Truck(own) => of_truck(own),
            AnySummary::Car(own) => of_car(own),
            AnySummary::Vehicle(own) => of_vehicle(own),
            AnySummary::Wheelset(own) => of_wheelset(own),
        }
    }
}

/// Returns the output times that means of a branch are over, in words; without a damping those of both.
#[must_use]
pub fn branch_window(damping: Option<Damping>) -> &'static str {
    match damping {
        Some(Damping::Constant) => {
            "output times after the first half period, bolster faster than 0.9 of its peak speed"
        }
        Some(Damping::Variable) => {
            "output times after the first half period, bolster faster than 0.25 of its peak speed and below \
             \u{2212}0.3 of its amplitude"
        }
        None => {
            "output times after the first half period that count for the branch, which depend on the damping"
        }
    }
}

fn cycles(count: u32) -> String {
    match count {
        1 => "one whole cycle".to_owned(),
        count => format!("{count} whole cycles"),
    }
}

/// Least and greatest value of a column with their times.
fn extremes(
    found: Option<&Extremes>,
    (least, largest): (&str, &str),
    kind: Kind,
    units: Units,
) -> Vec<KeyNumber> {
    let Some(found) = found else {
        return Vec::new();
    };
    let number = |what: &str, value: f64, time: f64| KeyNumber {
        what: what.to_owned(),
        window: format!("{ALL_TIMES}; at {} s", digits(time)),
        value: SummaryValue {
            value,
            unit: kind.label(units).to_owned(),
        },
        kind: Some(kind),
    };
    vec![
        number(least, found.minimum, found.minimum_time),
        number(largest, found.maximum, found.maximum_time),
    ]
}

fn of_wedge(own: &Summary, damping: Option<Damping>) -> Vec<KeyNumber> {
    let averages = &own.averages;
    let over = format!("{} after the first half period", cycles(averages.cycles));
    let mut numbers = Vec::new();
    for (branch, means) in [("up", &averages.up), ("down", &averages.down)] {
        if let Some(value) = means.get("vertical_wedge_force") {
            numbers.push(KeyNumber::new(
                format!("mean vertical wedge force, bolster going {branch}"),
                branch_window(damping),
                value,
                Kind::Force,
            ));
        }
    }
    for (place, what) in [
        ("side_frame", "friction energy at the side frame per cycle"),
        ("bolster", "friction energy at the bolster per cycle"),
    ] {
        if let Some(value) = averages.energy_per_cycle.get(place) {
            numbers.push(KeyNumber::new(what, &over, value, Kind::Energy));
        }
    }
    let singles = [
        (
            "equivalent damping of the side-frame friction",
            &averages.equivalent_damping,
            Kind::Damping,
        ),
        (
            "equivalent stiffness on the bolster",
            &averages.equivalent_stiffness,
            Kind::Stiffness,
        ),
        (
            "equivalent damping on the bolster",
            &averages.equivalent_damping_on_bolster,
            Kind::Damping,
        ),
    ];
    for (what, value, kind) in singles {
        numbers.extend(value.iter().map(|value| KeyNumber::new(what, &over, value, kind)));
    }
    let column = format!("vertical_wedge_force_{}", Kind::Force.suffix(own.units));
    numbers.extend(extremes(
        own.extremes.get(&column),
        ("least vertical wedge force", "largest vertical wedge force"),
        Kind::Force,
        own.units,
    ));
    numbers
}

fn of_half_truck(own: &HalfTruckSummary) -> Vec<KeyNumber> {
    let mut numbers = Vec::new();
    let over = "whole cycles after the first half period";
    for (number, wedge) in &own.wedges {
        let rows = [
            (
                "mean column friction, bolster going up",
                branch_window(None),
                &wedge.up,
                Kind::Force,
            ),
            (
                "mean column friction, bolster going down",
                branch_window(None),
                &wedge.down,
                Kind::Force,
            ),
            (
                "friction energy at the column per cycle",
                over,
                &wedge.energy_per_cycle,
                Kind::Energy,
            ),
            (
                "largest normal force of the column",
                ALL_TIMES,
                &wedge.largest_normal_force,
                Kind::Force,
            ),
        ];
        for (what, window, value, kind) in rows {
            let what = format!("wedge {number}: {what}");
            numbers.extend(
                value
                    .iter()
                    .map(|value| KeyNumber::new(&what, window, value, kind)),
            );
        }
    }
    numbers
}

fn of_truck(own: &TruckSummary) -> Vec<KeyNumber> {
    let mut numbers = Vec::new();
    let over = format!("{} after the first", cycles(own.cycles.count));
    let energy = |value: f64| SummaryValue {
        value,
        unit: Kind::Energy.label(own.units).to_owned(),
    };
    if let Some(work) = &own.cycles.work {
        numbers.push(KeyNumber::new(
            "work of all motions per cycle",
            &over,
            work,
            Kind::Energy,
        ));
    }
    if let Some(loss) = own.cycles.loss_of_wedges(&WEDGE_NAMES) {
        numbers.push(KeyNumber::new(
            "friction energy of the four wedges per cycle",
            &over,
            &energy(loss),
            Kind::Energy,
        ));
    }
    if let Some(equivalent) = &own.energy.equivalent {
        let over = cycles(own.energy.cycles);
        numbers.push(KeyNumber::new(
            "equivalent damping of all losses",
            &over,
            &equivalent.damping,
            Kind::Damping,
        ));
        if let Some(ratio) = equivalent.damping_ratio {
            numbers.push(KeyNumber::plain("damping ratio of all losses", &over, ratio, ""));
        }
    }
    for (angle, value) in &own.warp_stiffness {
        numbers.push(KeyNumber::plain(
            format!("warp stiffness to {angle}"),
            "secant from rest to this angle",
            value.value,
            &value.unit,
        ));
    }
    let suffix = Kind::Force.suffix(own.units);
    let of = |wedge: &'static str| {
        Some((
            wedge,
            own.extremes.get(&format!("{wedge}_column_normal_{suffix}"))?,
        ))
    };
    let columns: Vec<(&str, &Extremes)> = WEDGE_NAMES.into_iter().filter_map(of).collect();
    let number = |what: &str, (wedge, value, time): (&str, f64, f64)| KeyNumber {
        what: what.to_owned(),
        window: format!(
            "{ALL_TIMES}; {} wedge at {} s",
            wedge.replace('_', " "),
            digits(time)
        ),
        value: SummaryValue {
            value,
            unit: Kind::Force.label(own.units).to_owned(),
        },
        kind: Some(Kind::Force),
    };
    let least = columns
        .iter()
        .min_by(|(_, a), (_, b)| a.minimum.total_cmp(&b.minimum));
    let largest = columns
        .iter()
        .max_by(|(_, a), (_, b)| a.maximum.total_cmp(&b.maximum));
    if let (Some((least, a)), Some((largest, b))) = (least, largest) {
        numbers.extend([
            number(
                "least normal force of a column",
                (least, a.minimum, a.minimum_time),
            ),
            number(
                "largest normal force of a column",
                (largest, b.maximum, b.maximum_time),
            ),
        ]);
    }
    numbers.extend(of_rise(&own.wedge_rise));
    numbers
}

/// Returns the largest rise of a wedge at the start beside what limits it.
fn of_rise(rises: &BTreeMap<String, RiseSummary>) -> Option<KeyNumber> {
    let (name, own) = rises
        .iter()
        .max_by(|(_, a), (_, b)| a.at_start.value.total_cmp(&b.at_start.value))?;
    let coil = own.coil_without_load.as_ref().map_or(String::new(), |limit| {
        format!(
            "; its coil has no load from {} {} on",
            digits(limit.value),
            limit.unit
        )
    });
    let window = format!(
        "{} wedge; its pocket holds {} {}{coil}",
        name.replace('_', " "),
        digits(own.pocket.value),
        own.pocket.unit
    );
    let what = "largest wedge rise at the start";
    Some(KeyNumber::new(what, window, &own.at_start, Kind::Length))
}

fn of_car(own: &CarSummary) -> Vec<KeyNumber> {
    let mut numbers: Vec<KeyNumber> = own
        .limits
        .iter()
        .map(|limit| {
            let at = limit.statistic.replace('_', " ");
            let window = format!("worst after settling, at {at}");
            KeyNumber::plain(&limit.quantity, window, limit.value, &limit.unit)
        })
        .collect();
    for ((what, value), kind) in [
        ("speed at the start", &own.speed[0]),
        ("speed at the end", &own.speed[1]),
        ("distance at the end", &own.distance[1]),
    ]
    .into_iter()
    .zip([Kind::TravelSpeed, Kind::TravelSpeed, Kind::Distance])
    {
        numbers.push(KeyNumber::new(what, "one output time", value, kind));
    }
    if let Some(first) = own.wedge_losses.values().next() {
        let sum = SummaryValue {
            value: own.wedge_losses.values().map(|loss| loss.value).sum(),
            unit: first.unit.clone(),
        };
        numbers.push(KeyNumber::new(
            "friction energy of all wedges",
            "the whole run",
            &sum,
            Kind::Energy,
        ));
    }
    numbers.extend(of_rise(&own.wedge_rise));
    numbers
}

fn of_vehicle(own: &VehicleSummary) -> Vec<KeyNumber> {
    let mut numbers = Vec::new();
    for (number, vibration) in (1..).zip(&own.vibrations).take(8) {
        let window = "about the rest";
        let what = format!("natural frequency {number}");
        numbers.push(KeyNumber::plain(what, window, vibration.frequency_hz, "Hz"));
        let what = format!("damping ratio {number}");
        numbers.push(KeyNumber::plain(what, window, vibration.damping_ratio, ""));
    }
    for (name, force) in &own.forces_at_start {
        let what = name.replace('_', " ");
        numbers.push(KeyNumber::new(what, "at the start", force, Kind::Force));
    }
    numbers
}

fn of_wheelset(own: &WheelsetSummary) -> Vec<KeyNumber> {
    let mut numbers = Vec::new();
    if let Some(hunting) = &own.hunting {
        let window = "least damped vibration about steady rolling";
        numbers.extend([
            KeyNumber::plain("hunting frequency", window, hunting.frequency_hz, "Hz"),
            KeyNumber::plain("hunting damping ratio", window, hunting.damping_ratio, ""),
        ]);
    }
    for (name, kind) in [("lateral", Kind::Length), ("yaw", Kind::Angle)] {
        let suffix = kind.suffix(own.units);
        numbers.extend(extremes(
            own.extremes.get(&format!("{name}_{suffix}")),
            (&format!("least {name}"), &format!("largest {name}")),
            kind,
            own.units,
        ));
    }
    numbers
}
