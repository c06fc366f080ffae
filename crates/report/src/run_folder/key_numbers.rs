//! The numbers of a run that people compare first, each with its window: over what it is taken.

use std::collections::BTreeMap;

use quantity::{Kind, System as Units};
use study::each_summary;
use study::metrics::Extremes;
use study::summary::SummaryValue;
use study::wedge_rise::RiseSummary;
use wedge::parameters::Damping;

use super::RunFolder;
use crate::figures::digits;
use crate::models::ReportSummary;

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
pub(crate) const ALL_TIMES: &str = "all output times";

impl KeyNumber {
    pub(crate) fn new(
        what: impl Into<String>,
        window: impl Into<String>,
        value: &SummaryValue,
        kind: Kind,
    ) -> Self {
        Self {
            what: what.into(),
            window: window.into(),
            value: value.clone(),
            kind: Some(kind),
        }
    }

    /// Returns a number of a unit that stays as it is.
    pub(crate) fn plain(what: impl Into<String>, window: impl Into<String>, value: f64, unit: &str) -> Self {
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
        each_summary!(&self.summary, own => own.key_numbers(self.case.as_ref()))
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

pub(crate) fn cycles(count: u32) -> String {
    match count {
        1 => "one whole cycle".to_owned(),
        count => format!("{count} whole cycles"),
    }
}

/// Least and greatest value of a column with their times.
pub(crate) fn extremes(
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

/// Returns the largest rise of a wedge at the start beside what limits it.
pub(crate) fn of_rise(rises: &BTreeMap<String, RiseSummary>) -> Option<KeyNumber> {
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
