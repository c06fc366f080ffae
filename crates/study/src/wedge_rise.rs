//! Rises of wedges in their pockets at the start of a run, as a gauge shows them, beside what limits them:
//! the pocket, and the coil that loses its load as the wedge rises.
//!
//! A control coil pushes with `F = P - k e` where it is longer by e than in the nominal layout; e is the
//! rise, and with variable damping the height of the bolster on top. What presses the wedge is that less its
//! weight W, and gone at the rise `(P - W) / k - (e - rise)`, bolster and side frame being where they are:
//! higher the wedge does not come, whatever is worn.

use std::collections::BTreeMap;

use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};
use truck::{ControlCoil, WEDGE_NAMES, Wedge, WedgeLoads};
use wedge::parameters::STANDARD_GRAVITY;

use crate::summary_value::SummaryValue;

/// Rise and limits of a wedge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RiseSummary {
    /// The rise at the start.
    pub at_start: SummaryValue,
    /// The rise at which the control coil carries the wedge alone there, and presses no more; none of a coil
    /// without a linear law.
    pub coil_without_load: Option<SummaryValue>,
    /// The rise that the pocket holds.
    pub pocket: SummaryValue,
}

/// The same in SI.
struct Rise<'w> {
    name: String,
    at_start: f64,
    coil_without_load: Option<f64>,
    wedge: &'w Wedge,
}

/// A truck's wedges with their loads at the start, and what precedes their names.
pub(crate) type AtStart<'w> = (&'static str, &'w [Wedge; 4], &'w [WedgeLoads; 4]);

impl Rise<'_> {
    /// Returns the rise that wear makes.
    fn by_wear(&self) -> f64 {
        self.wedge.wear.rise(self.wedge.rise_angles())
    }
}

fn rises<'w>(trucks: &[AtStart<'w>]) -> Vec<Rise<'w>> {
    let of = |(prefix, wedges, loads): &AtStart<'w>| {
        let own = WEDGE_NAMES.into_iter().zip(wedges.iter()).zip(loads.iter());
        let all = own.map(|((name, wedge), loads)| Rise {
            name: format!("{prefix}{name}"),
            at_start: loads.rise,
            coil_without_load: match &wedge.control_coil {
                ControlCoil::Shear(coil) if coil.preload > 0.0 => {
                    let weight = wedge.mass * STANDARD_GRAVITY;
                    Some((coil.preload - weight) / coil.stiffness - (loads.coil_extension - loads.rise))
                }
                ControlCoil::Shear(_)
                | ControlCoil::Table(_)
                | ControlCoil::Thesis(..)
                | ControlCoil::Nothing => None,
            },
            wedge,
        });
        all.collect::<Vec<_>>()
    };
    trucks.iter().flat_map(of).collect()
}

/// Returns the rises of all wedges by their names.
pub(crate) fn summary(trucks: &[AtStart<'_>], units: Units) -> BTreeMap<String, RiseSummary> {
    let value = |value: f64| SummaryValue::new(value, Kind::Length, units);
    let all = rises(trucks).into_iter();
    all.map(|own| {
        let summary = RiseSummary {
            at_start: value(own.at_start),
            coil_without_load: own.coil_without_load.map(value),
            pocket: value(own.wedge.rise_limit),
        };
        (own.name, summary)
    })
    .collect()
}

/// Returns the largest rise at the start in a summary, in its units; zero of none.
pub(crate) fn largest(rises: &BTreeMap<String, RiseSummary>) -> f64 {
    let all = rises.values().map(|own| own.at_start.value);
    all.reduce(f64::max).unwrap_or_default()
}

/// Returns the warnings about wedges that stand out of their pockets, about coils without load, and about
/// wedges that wear should lift but that start in the nominal layout.
pub(crate) fn warnings(trucks: &[AtStart<'_>], units: Units) -> Vec<String> {
    let all = rises(trucks);
    let shown = |value: f64| {
        let value = SummaryValue::new(value, Kind::Length, units);
        format!("{:.3} {}", value.value, value.unit)
    };
    let listed = |of: &dyn Fn(&Rise<'_>) -> Option<String>| -> Option<String> {
        let found: Vec<String> = all.iter().filter_map(of).collect();
        let rest = match found.len().saturating_sub(4) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        (!found.is_empty()).then(|| found[..found.len().min(4)].join(", ") + &rest)
    };
    let high = listed(&|own| {
        (own.at_start > own.wedge.rise_limit).then(|| {
            format!(
                "{} ({} of {})",
                own.name,
                shown(own.at_start),
                shown(own.wedge.rise_limit)
            )
        })
    });
    let loose = listed(&|own| {
        let reached = own.by_wear().max(own.at_start);
        let limit = own.coil_without_load.filter(|limit| reached >= *limit)?;
        Some(format!("{} (from a rise of {} on)", own.name, shown(limit)))
    });
    // Elastic contacts take a few hundredths of it.
    let unmoved = listed(&|own| {
        let rise = own.by_wear();
        let moves = own.wedge.free[0] && own.wedge.free[2];
        (moves && rise > 0.0 && own.at_start < 0.5 * rise)
            .then(|| format!("{} ({} of {})", own.name, shown(own.at_start), shown(rise)))
    });
    let words = [
        high.map(|list| {
            format!(
                "wedges stand higher at the start than their pockets hold: {list}; lower the rise or the \
                 depths of wear, or write the rise that the pocket holds as wedge.rise_limit"
            )
        }),
        loose.map(|list| {
            format!(
                "control coils carry no more than their wedges at the start, since these are worn: {list}; \
                 they press no column. Lower the rise, or give the coil's preload and stiffness"
            )
        }),
        unmoved.map(|list| {
            format!(
                "worn wedges start where unworn ones stand, between faces that do not touch: {list}; begin \
                 with start.kind = \"equilibrium\""
            )
        }),
    ];
    words.into_iter().flatten().collect()
}
