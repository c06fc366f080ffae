//! What a study keeps of a car's run: the worst of its statistics ([`crate::car::statistics`]), filtered, or
//! raw where nothing is filtered.

use std::borrow::Cow;

use quantity::{Kind, System as Units};

use super::measuring::run_whole;
use super::{Definitions, Judged, Measure, Measures, Unmeasured};
use crate::car::CarCase;
use crate::car::run::CarResult;
use crate::plausibility;

/// A measure of a statistic: its name, kind, meaning, the ending of the statistics, and whether the least is
/// worst.
type Worst = (&'static str, Kind, &'static str, &'static str, bool);

const WORST: [Worst; 11] = [
    (
        "l_over_v_time",
        Kind::Dimensionless,
        "largest wheel L/V that lasts for the hold time",
        "_l_over_v_time",
        false,
    ),
    (
        "l_over_v_distance",
        Kind::Dimensionless,
        "largest wheel L/V that lasts over the hold distance",
        "_l_over_v_distance",
        false,
    ),
    (
        "axle_sum_l_over_v_time",
        Kind::Dimensionless,
        "largest axle sum of L/V that lasts for the hold time",
        "_sum_l_over_v_time",
        false,
    ),
    (
        "side_l_over_v",
        Kind::Dimensionless,
        "largest L/V of a truck's side over the side distance",
        "_side_l_over_v",
        false,
    ),
    (
        "l_over_v_in_curves",
        Kind::Dimensionless,
        "largest percentile of wheel L/V in curves",
        "_l_over_v_in_curves",
        false,
    ),
    (
        "least_load_time",
        Kind::Dimensionless,
        "least wheel load that lasts for the hold time, % of the static one",
        "_least_load_time",
        true,
    ),
    (
        "body_roll_peak_to_peak",
        Kind::Angle,
        "greatest less least roll of the body",
        "body_roll_peak_to_peak",
        false,
    ),
    (
        "lateral_acceleration_deviation",
        Kind::RideAcceleration,
        "largest standard deviation of the lateral acceleration at a truck center",
        "_lateral_acceleration_deviation",
        false,
    ),
    (
        "lateral_acceleration_peak_to_peak",
        Kind::RideAcceleration,
        "greatest less least lateral acceleration at a truck center",
        "_lateral_acceleration_peak_to_peak",
        false,
    ),
    (
        "vertical_acceleration_peak_to_peak",
        Kind::RideAcceleration,
        "greatest less least vertical acceleration at a truck center",
        "_vertical_acceleration_peak_to_peak",
        false,
    ),
    (
        "lateral_acceleration_rms",
        Kind::RideAcceleration,
        "largest rms of the lateral acceleration at a truck center",
        "_lateral_acceleration_rms",
        false,
    ),
];

const OTHERS: [(&str, Kind, &str); 6] = [
    (
        "largest_warp_angle",
        Kind::Angle,
        "largest warp angle of a truck, without sign",
    ),
    ("wedge_loss", Kind::Energy, "lost in the friction of all wedges"),
    ("end_speed", Kind::TravelSpeed, "speed at the end"),
    ("derailed", Kind::Count, "1 if a wheel left its rail, else 0"),
    (
        "ledger_residual",
        Kind::Dimensionless,
        "relative residual of the energy ledger: the largest residual over the largest of work, losses and \
         change of stored energy",
    ),
    ("steps", Kind::Count, "accepted steps of the integrator"),
];

/// Returns the measures of cars' runs.
#[must_use]
pub fn definitions() -> Definitions {
    let define = |name, kind, text, always| Measure {
        name: Cow::Borrowed(name),
        text: Cow::Borrowed(text),
        kind,
        always,
    };
    let worst = WORST
        .iter()
        .map(|(name, kind, text, ..)| define(name, *kind, text, false));
    let others = OTHERS
        .iter()
        .map(|(name, kind, text)| define(name, *kind, text, true));
    Definitions(worst.chain(others).collect())
}

/// Runs a car, measures it in the order of [`definitions`], and judges whether the measures mean something.
///
/// # Errors
/// The run cannot begin or does not come to its end.
pub fn judge(case: &CarCase) -> Result<Judged, Unmeasured> {
    // The summary's numbers are in the units of the results.
    let mut case = case.clone();
    case.simulation.output_units = Units::Si;
    let (result, nonsense) = run_whole(&case, plausibility::nonsense_in_car)?;
    Ok(Judged {
        measures: measures(&result),
        nonsense,
    })
}

fn measures(result: &CarResult) -> Measures {
    let summary = &result.summary;
    let mut values = Vec::new();
    for (_, _, _, ending, least) in WORST {
        let sum = ending.contains("_sum_");
        let own = summary
            .statistics
            .iter()
            .filter(|(name, _)| name.ends_with(ending) && (sum || !name.contains("_sum_")));
        let found = own.filter_map(|(_, own)| own.filtered.as_ref().or(own.raw.as_ref()));
        let found = found.map(|own| own.value);
        let worst = if least {
            found.reduce(f64::min)
        } else {
            found.reduce(f64::max)
        };
        values.push(worst.unwrap_or(f64::NAN));
    }
    let largest = |name: &str| {
        let values = result.column(name).unwrap_or_default();
        values.iter().fold(0.0, |most: f64, value| most.max(value.abs()))
    };
    let [_, end] = &summary.speed;
    values.extend([
        largest("truck_1_warp_angle").max(largest("truck_2_warp_angle")),
        summary.wedge_losses.values().map(|own| own.value).sum(),
        end.value,
        f64::from(u8::from(summary.derailed.is_some())),
        summary.ledger.largest_relative_residual,
        summary.solver.steps as f64,
    ]);
    Measures(values)
}
