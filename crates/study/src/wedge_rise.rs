//! Rises of wedges in their pockets at the start of a run, as a gauge shows them, beside what limits them: the
//! pocket, and the coil that loses its load as the wedge rises.
//!
//! A control coil pushes with `F = P - k e` where it is longer by e than in the nominal layout; e is the rise,
//! and with variable damping the height of the bolster on top. So its load is gone at the rise
//! `P / k - (e - rise)`, bolster and side frame being where they are.

use std::collections::BTreeMap;

use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};
use truck::{ControlCoil, WEDGE_NAMES, Wedge, WedgeLoads};

use crate::summary::SummaryValue;

/// Rise and limits of a wedge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RiseSummary {
    /// The rise at the start.
    pub at_start: SummaryValue,
    /// The rise at which the control coil loses its load there; none of a coil without a linear law.
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

fn rises<'w>(trucks: &[AtStart<'w>]) -> Vec<Rise<'w>> {
    let of = |(prefix, wedges, loads): &AtStart<'w>| {
        let own = WEDGE_NAMES.into_iter().zip(wedges.iter()).zip(loads.iter());
        let all = own.map(|((name, wedge), loads)| Rise {
            name: format!("{prefix}{name}"),
            at_start: loads.rise,
            coil_without_load: match &wedge.control_coil {
                ControlCoil::Shear(coil) if coil.preload > 0.0 => {
                    Some(coil.preload / coil.stiffness - (loads.coil_extension - loads.rise))
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
        let limit = own.coil_without_load.filter(|limit| own.at_start >= *limit)?;
        Some(format!("{} (from a rise of {} on)", own.name, shown(limit)))
    });
    // Elastic contacts take a few hundredths of it.
    let unmoved = listed(&|own| {
        let rise = own.wedge.wear.rise(own.wedge.rise_angles());
        let column = own.wedge.free[0] && own.wedge.free[2];
        (column && rise > 0.0 && own.at_start < 0.5 * rise)
            .then(|| format!("{} ({} of {})", own.name, shown(own.at_start), shown(rise)))
    });
    let words = [
        high.map(|list| {
            format!(
                "wedges stand higher at the start than their pockets hold: {list}; lower the rise or the depths \
                 of wear, or write the rise that the pocket holds as wedge.rise_limit"
            )
        }),
        loose.map(|list| {
            format!(
                "control coils carry nothing at the start, since the wedges have risen off them: {list}; \
                 columns get no force from them. Lower the rise, or give the coil's preload and stiffness"
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
