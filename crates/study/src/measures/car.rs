//! The metrics of a car's run in a study: the worst of its statistics ([`crate::car::statistics`]), filtered,
//! or raw where nothing is filtered.

use quantity::{Kind, System as Units};
use truck::WEDGE_NAMES;

use super::measuring::judged;
use super::of_rules;
use super::{Definitions, Judged, Measure, Measures, Unmeasured};
use crate::car::CarCase;
use crate::car::figures::CarFigures;
use crate::car::run::CarResult;
use crate::models::StudyCase;
use crate::run::findings;
use crate::wedge_rise;

const OTHERS: [(&str, Kind, &str); 10] = [
    (
        "largest_warp_angle",
        Kind::Angle,
        "largest warp angle of a truck, without sign",
    ),
    (
        "largest_nest_load",
        Kind::Force,
        "largest vertical force of a nest on its bolster",
    ),
    (
        "largest_wear_number",
        Kind::Force,
        "largest energy that creep takes by the distance, of a wheel",
    ),
    (
        "largest_rise_at_start",
        Kind::Length,
        "largest rise of a wedge in its pocket at the start",
    ),
    ("wedge_loss", Kind::Energy, "lost in the friction of all wedges"),
    ("end_speed", Kind::TravelSpeed, "speed at the end"),
    (
        "end_distance",
        Kind::Distance,
        "distance along the track at the end",
    ),
    ("derailed", Kind::Count, "1 if a wheel left its rail, else 0"),
    (
        "ledger_residual",
        Kind::Dimensionless,
        "relative residual of the energy ledger: the largest residual over the largest of work, losses and \
         change of stored energy",
    ),
    ("steps", Kind::Count, "accepted steps of the integrator"),
];

impl StudyCase for CarCase {
    fn definitions(&self) -> Definitions {
        let others = OTHERS
            .iter()
            .map(|(name, kind, text)| Measure::new(*name, *kind, *text, true));
        let of_wedges = |ending: &str, kind: Kind, text: &'static str, always: bool| {
            let names = wedges().map(|wedge| format!("{wedge}_{ending}"));
            let all = names.map(|name| Measure::new(name, kind, text, always));
            all.collect::<Vec<_>>()
        };
        let text = "share of the time after settling in which no point of its faces slips";
        let locked = of_wedges("locked_share", Kind::Dimensionless, text, false);
        let text = "lost in its friction";
        let losses = of_wedges("friction_loss", Kind::Energy, text, true);
        let all = of_rules::worst().chain(others).chain(locked).chain(losses);
        Definitions(all.chain(of_rules::figures()).collect())
    }

    fn judge(&self) -> Result<Judged, Unmeasured> {
        // The summary's numbers are in the units of the results.
        let mut case = self.clone();
        case.simulation.output_units = Units::Si;
        judged(&case, findings::nonsense_in_car, measures)
    }
}

/// Returns the names of all wedges.
fn wedges() -> impl Iterator<Item = String> {
    (1..=2).flat_map(|truck| WEDGE_NAMES.map(|wedge| format!("truck_{truck}_{wedge}")))
}

fn measures(case: &CarCase, result: &CarResult) -> Measures {
    let summary = &result.summary;
    let mut values = of_rules::values(&summary.statistics);
    let largest = |name: &str| {
        let values = result.column(name).unwrap_or_default();
        values.iter().fold(0.0, |most: f64, value| most.max(value.abs()))
    };
    let largest_of = |ending: &str| {
        let names = result.columns.iter().map(|column| &*column.name);
        let own = names.filter(|name| name.ends_with(ending));
        own.map(largest).fold(0.0, f64::max)
    };
    values.extend([
        largest_of("_warp_angle"),
        largest_of("_nest_vertical_force"),
        largest_of("_wear_number"),
        wedge_rise::largest(&summary.wedge_rise),
        summary.wedge_losses.values().map(|own| own.value).sum(),
        summary.speed[1].value,
        summary.distance[1].value,
        f64::from(u8::from(summary.derailed.is_some())),
        summary.ledger.largest_relative_residual,
        summary.solver.steps as f64,
    ]);
    let locked = |wedge: String| summary.wedge_locked.get(&wedge).copied();
    values.extend(wedges().map(|wedge| locked(wedge).unwrap_or(f64::NAN)));
    let loss = |wedge: String| summary.wedge_losses.get(&wedge).map(|own| own.value);
    values.extend(wedges().map(|wedge| loss(wedge).unwrap_or(0.0)));
    values.extend(CarFigures::of(&case.parameters).values());
    Measures(values)
}
