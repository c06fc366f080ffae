//! The summary of a run: what `summary.json` holds.
//!
//! Schema `wedgelab.summary/2`. Every dimensional number is a [`SummaryValue`] with its unit, in the case's
//! output units; times are seconds. A reader should ignore keys that it does not know; the number after the
//! slash grows when a key changes its meaning or goes. A renamed key is read by its older name, too.

use std::collections::BTreeMap;

use integrate::Statistics;
use mechanics::energy_balance::EnergyBalance;
use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};

use crate::car::limits::LimitCheck;
use crate::car::statistics::Statistic;
use crate::finite::{find, is_finite};
use crate::jam::JamMargins;
use crate::losses::EnergySummary;
use crate::metrics::Extremes;
use crate::outcome::{Outcome, RunEnd};
pub use crate::summary_value::SummaryValue;

/// The schema's name and version.
pub const SCHEMA: &str = "wedgelab.summary/2";

/// The part that the summaries of all models have.
pub trait RunSummary {
    /// Returns the schema that it names.
    fn schema(&self) -> &str;
    /// Returns the program that wrote it, with its version.
    fn program(&self) -> &str;
    /// Returns the case's name.
    fn name(&self) -> &str;
    /// Returns the case's title; may be empty.
    fn title(&self) -> &str {
        ""
    }
    /// Returns the units of its numbers.
    fn units(&self) -> Units;
    /// Returns the number of rows of the table.
    fn rows(&self) -> usize;
    /// Returns the reason and time of the run's stop, if it did not come to its end.
    fn stopped(&self) -> Option<&Stopped>;
    /// Returns the reason why the numbers are not to be used, if so.
    fn failed(&self) -> Option<&str>;
    /// Returns the warnings about the numbers.
    fn warnings(&self) -> &[String];
    /// Returns the assumptions of the numbers.
    fn assumptions(&self) -> &[String];
    /// Returns the energy ledger at the end.
    fn ledger(&self) -> Ledger<'_>;
    /// Returns the number of steps of the integrator, and its relative tolerance.
    fn solver(&self) -> (u64, f64);
    /// Returns the relative residual of the energy ledger.
    fn largest_relative_residual(&self) -> f64 {
        self.ledger().largest_relative_residual
    }
    /// Returns where a wheel left its rail, if one did.
    fn derailed(&self) -> Option<RunEnd> {
        None
    }
    /// Returns the distance along the track at the end, of models that run on one.
    fn reached(&self) -> Option<SummaryValue> {
        None
    }
    /// Returns what rules ask of a run on a track; `None` of others.
    fn by_rules(&self) -> Option<ByRules<'_>> {
        None
    }
    /// Returns the worst values beside limits of rules; none of models without such limits.
    fn limits(&self) -> &[LimitCheck] {
        self.by_rules().map_or(&[], |own| own.limits)
    }
    /// Returns the name of the first number that is not finite, of models whose runs do not stop there.
    fn not_finite(&self) -> Option<String> {
        None
    }
    /// Returns how the run ended. A run that did not come to its end is `Derailed` or `Stopped` even if its
    /// energy ledger does not close, which [`RunSummary::failed`] and its warnings say.
    fn outcome(&self) -> Outcome {
        if let Some(end) = self.derailed() {
            return Outcome::Derailed(end);
        }
        match (self.stopped(), self.failed()) {
            (Some(stopped), _) => Outcome::Stopped(RunEnd {
                time: stopped.time,
                reason: stopped.reason.clone(),
                distance: self.reached(),
            }),
            (None, Some(reason)) => Outcome::Failed(reason.to_owned()),
            (None, None) => Outcome::Complete,
        }
    }
}

/// What rules ask of a run on a track.
#[derive(Clone, Copy, Debug)]
pub struct ByRules<'s> {
    /// The rule of the limits, its edition and source.
    pub limits_of: &'s str,
    /// Its limits beside the worst value of each.
    pub limits: &'s [LimitCheck],
    /// Statistics by name.
    pub statistics: &'s BTreeMap<String, Statistic>,
}

/// Returns the [`ByRules`] of a summary with fields of these names.
macro_rules! by_rules {
    ($own:expr) => {
        $crate::summary::ByRules {
            limits_of: &$own.limits_of,
            limits: &$own.limits,
            statistics: &$own.statistics,
        }
    };
}
pub(crate) use by_rules;

/// The energy ledger at the end of a run of any model.
#[derive(Clone, Copy, Debug)]
pub struct Ledger<'s> {
    /// Its entries by name.
    pub entries: &'s BTreeMap<String, SummaryValue>,
    /// Largest absolute residual at any output time.
    pub largest_residual: &'s SummaryValue,
    /// The first output time with this residual, s.
    pub largest_residual_time: f64,
    /// The measure of how well the ledger closes.
    pub largest_relative_residual: f64,
}

/// Returns the [`Ledger`] of a summary or of its part `ledger`: `$own` has the residuals, `$entries` what the
/// ledger is made of.
macro_rules! ledger {
    ($own:expr, $entries:expr) => {
        $crate::summary::Ledger {
            entries: &$entries,
            largest_residual: &$own.largest_residual,
            largest_residual_time: $own.largest_residual_time,
            largest_relative_residual: $own.largest_relative_residual,
        }
    };
}

/// Implements [`RunSummary`] by the fields of these names, and from what differs: title, ledger and solver;
/// models that run on a track add `derailed` and `reached`, others further methods.
macro_rules! run_summary {
    (
        $summary:ty, |$own:ident| $(title: $title:expr,)? ledger: $ledger:expr, solver: $solver:expr
        $(, derailed: $derailed:expr, reached: $reached:expr)? $(, { $($more:tt)* })?
    ) => {
        impl $crate::summary::RunSummary for $summary {
            fn schema(&self) -> &str {
                &self.schema
            }

            fn program(&self) -> &str {
                &self.program
            }

            fn name(&self) -> &str {
                &self.name
            }

            $(
                fn title(&self) -> &str {
                    let $own = self;
                    $title
                }
            )?

            fn units(&self) -> quantity::System {
                self.units
            }

            fn rows(&self) -> usize {
                self.rows
            }

            fn stopped(&self) -> Option<&$crate::summary::Stopped> {
                self.stopped.as_ref()
            }

            fn failed(&self) -> Option<&str> {
                self.failed.as_deref()
            }

            fn warnings(&self) -> &[String] {
                &self.warnings
            }

            fn assumptions(&self) -> &[String] {
                &self.assumptions
            }

            fn ledger(&self) -> $crate::summary::Ledger<'_> {
                let $own = self;
                $ledger
            }

            fn solver(&self) -> (u64, f64) {
                let $own = self;
                $solver
            }
            $(
                fn derailed(&self) -> Option<$crate::outcome::RunEnd> {
                    let $own = self;
                    $derailed
                }

                fn reached(&self) -> Option<$crate::summary::SummaryValue> {
                    let $own = self;
                    $reached
                }
            )?

            $($($more)*)?
        }
    };
}

pub(crate) use {ledger, run_summary};

run_summary!(
    Summary,
    |own| title: &own.title,
    ledger: ledger!(own.ledger, own.ledger.entries),
    solver: (own.solver.statistics.steps, own.solver.relative_tolerance),
    {
        fn not_finite(&self) -> Option<String> {
            Self::not_finite(self)
        }
    }
);

/// The summary of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// [`SCHEMA`].
    pub schema: String,
    /// Version of the program that wrote it.
    pub program: String,
    /// The case's name.
    pub name: String,
    /// The case's title.
    pub title: String,
    /// Units of the numbers: `us` or `si`.
    pub units: Units,
    /// True if the run came to its end and its energy ledger closes to 1e-2.
    pub complete: bool,
    /// Reason and time of the stop, if it is incomplete.
    pub stopped: Option<Stopped>,
    /// The reason for not using its numbers, which are kept: its energy ledger does not close to 1e-2.
    #[serde(default)]
    pub failed: Option<String>,
    /// Warnings about the numbers; empty for a sound run.
    #[serde(default)]
    pub warnings: Vec<String>,
    /// Number of rows of the result.
    pub rows: usize,
    /// Averages over cycles and branches.
    pub averages: Averages,
    /// Least and greatest values of the columns with fixed names, by their names with units.
    pub extremes: BTreeMap<String, crate::metrics::Extremes>,
    /// Changes of contact states.
    pub events: Events,
    /// The active friction laws, by face, and how far they crept.
    pub friction: BTreeMap<String, FrictionSummary>,
    /// Margins of the wedge to lock-up.
    #[serde(default)]
    pub jam: Option<JamMargins>,
    /// The energy ledger at the end.
    pub ledger: LedgerSummary,
    /// Sources and sinks of the energy of a cycle.
    #[serde(default)]
    pub energy: EnergySummary,
    /// Counters of the integrator.
    pub solver: Solver,
    /// The assumptions of the numbers.
    pub assumptions: Vec<String>,
}

impl Summary {
    /// Returns the name of the first number among averages, extremes and ledger that is not finite.
    #[must_use]
    pub fn not_finite(&self) -> Option<String> {
        let averages = &self.averages;
        let energies =
            find(&averages.energy_per_cycle).map(|place| format!("the energy per cycle at the {place}"));
        let means = find(&averages.up).or_else(|| find(&averages.down));
        let means = means.map(|column| format!("the mean of `{column}`"));
        let single = [
            ("the equivalent damping", &averages.equivalent_damping),
            ("the equivalent stiffness", &averages.equivalent_stiffness),
            (
                "the equivalent damping on the bolster",
                &averages.equivalent_damping_on_bolster,
            ),
        ];
        let single = single
            .into_iter()
            .find(|(_, measure)| measure.as_ref().is_some_and(|measure| !is_finite(measure.value)))
            .map(|(name, _)| name.to_owned());
        let extreme = |found: &Extremes| !(is_finite(found.minimum) && is_finite(found.maximum));
        let extremes = self.extremes.iter().find(|(_, found)| extreme(found));
        let extremes = extremes.map(|(column, _)| format!("an extreme of `{column}`"));
        let ledger = find(&self.ledger.entries).map(|entry| format!("the ledger's `{entry}`"));
        let residual = self.ledger.largest_relative_residual;
        let ledger =
            ledger.or_else(|| (!is_finite(residual)).then(|| "the ledger's relative residual".to_owned()));
        energies.or(means).or(single).or(extremes).or(ledger)
    }
}

/// Time and reason of the stop of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stopped {
    /// Time, s.
    pub time: f64,
    /// The reason.
    pub reason: String,
    /// Contact states at that time, by face and corner.
    pub contacts: BTreeMap<String, String>,
}

/// Averages over cycles and branches of the bolster's vertical motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Averages {
    /// The reason if there are none, else empty.
    pub missing: String,
    /// Number of whole cycles after the first half period.
    pub cycles: u32,
    /// Friction energy per cycle at the side frame and at the bolster.
    pub energy_per_cycle: BTreeMap<String, SummaryValue>,
    /// Equivalent viscous damping of the side-frame friction, W/(π ω A²).
    pub equivalent_damping: Option<SummaryValue>,
    /// Stiffness of the first harmonic of the vertical force of wedge and coil on the bolster.
    #[serde(default)]
    pub equivalent_stiffness: Option<SummaryValue>,
    /// Damping of the same first harmonic: of all that resists the bolster.
    #[serde(default)]
    pub equivalent_damping_on_bolster: Option<SummaryValue>,
    /// The window of the means below ([`window_of`](crate::metrics::window_of)): `mid stroke`, `lower
    /// stroke`.
    #[serde(default)]
    pub window: String,
    /// Means over the window where the bolster goes up, by column.
    pub up: BTreeMap<String, SummaryValue>,
    /// Means over the window where it goes down, by column.
    pub down: BTreeMap<String, SummaryValue>,
}

impl Averages {
    /// Returns the mean of the vertical wedge force while the bolster goes up.
    #[must_use]
    pub fn force_up(&self) -> Option<&SummaryValue> {
        self.up.get("vertical_wedge_force")
    }

    /// Returns the mean of the vertical wedge force while the bolster goes down.
    #[must_use]
    pub fn force_down(&self) -> Option<&SummaryValue> {
        self.down.get("vertical_wedge_force")
    }

    /// Returns the friction energy per cycle at the side frame.
    #[must_use]
    pub fn side_frame_energy(&self) -> Option<&SummaryValue> {
        self.energy_per_cycle.get("side_frame")
    }
}

/// Changes of contact states.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Events {
    /// Their number in all.
    pub total: u64,
    /// Counts by face and kind: `column` → `opens`, `closes`, `sticks`, `slips`.
    pub counts: BTreeMap<String, BTreeMap<String, u64>>,
    /// Changes that could not be resolved within one step.
    pub unresolved: u64,
    /// Breaks of the prescribed motions at which the integrator restarted.
    pub motion_breaks: u64,
    /// The thresholds, in words.
    pub thresholds: Vec<String>,
    /// The first ones, up to the cap.
    pub listed: Vec<ContactEvent>,
    /// Largest number listed.
    pub cap: usize,
}

/// A change of a contact point's mode.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactEvent {
    /// Time, s.
    pub time: f64,
    /// The face: `column` or `slope`.
    pub face: String,
    /// The corner, such as `lower_left`.
    pub corner: String,
    /// The mode before: `open`, `stick` or `slip`.
    pub from: String,
    /// The mode after.
    pub to: String,
}

/// The friction of a face.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrictionSummary {
    /// `tanh` or `bristle`.
    pub law: String,
    /// Coefficient of friction.
    pub coefficient: f64,
    /// Speed at which a corner creeps while it holds half its friction limit.
    pub creep_speed_at_half_load: SummaryValue,
    /// Greatest distance that a corner crept while its state was `stick`, over the whole run.
    pub crept_while_stuck: SummaryValue,
}

/// The energy ledger at the end of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LedgerSummary {
    /// Entries by name: work, stored energy, losses, residual.
    pub entries: BTreeMap<String, SummaryValue>,
    /// Energy stored at the start.
    pub stored_at_start: SummaryValue,
    /// Largest absolute change of the stored energy at any output time.
    pub largest_stored_change: SummaryValue,
    /// Largest absolute residual at any output time.
    pub largest_residual: SummaryValue,
    /// The first output time with this residual, s.
    pub largest_residual_time: f64,
    /// The residual that one step may leave, as the tolerance admits: below it nothing is wrong.
    #[serde(default)]
    pub admissible_residual: Option<SummaryValue>,
    /// The measure of how well the ledger closes:
    /// [`mechanics::energy_balance::EnergyBalance::relative_residual`].
    pub largest_relative_residual: f64,
}

impl LedgerSummary {
    /// Returns the ledger with these entries, beside what a run's balance found; `start` is the energy stored
    /// at the start, J.
    pub(crate) fn new(
        entries: BTreeMap<String, SummaryValue>,
        start: f64,
        balance: &EnergyBalance,
        units: Units,
    ) -> Self {
        let measure = |value: f64| SummaryValue::new(value, Kind::Energy, units);
        Self {
            entries,
            stored_at_start: measure(start),
            largest_stored_change: measure(balance.largest_stored_change),
            largest_residual: measure(balance.largest_residual),
            largest_residual_time: balance.largest_residual_time,
            admissible_residual: Some(measure(balance.admissible)),
            largest_relative_residual: balance.relative_residual(),
        }
    }
}

/// Counters of the integrator.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Solver {
    /// The method.
    pub method: String,
    /// Relative tolerance.
    pub relative_tolerance: f64,
    /// The error scales that it is relative to.
    pub scales: BTreeMap<String, String>,
    /// Counters.
    pub statistics: Statistics,
}
