//! The metrics of a truck's run in a study: the numbers of its summary.
//!
//! Means and largest values are over the output times of the whole cycles after the first ([`Cycles`]), or of
//! the whole run where there are none.
//!
//! [`Cycles`]: crate::truck::summary::Cycles

use quantity::{Kind, System as Units};
use truck::WEDGE_NAMES;

use super::measuring::judged;
use super::{Definitions, Judged, Measure, Measures, Unmeasured};
use crate::metrics::Cycle;
use crate::models::StudyCase;
use crate::run::findings;
use crate::truck::TruckCase;
use crate::truck::run::{TruckResult, window};
use crate::truck::summary::{WARP_ANGLES, warp_stiffness};
use crate::wedge_rise;

/// Measures of all runs.
const OF_ALL: [(&str, Kind, &str, bool); 13] = [
    (
        "work_per_cycle",
        Kind::Energy,
        "work of all prescribed motions each cycle",
        false,
    ),
    (
        "friction_loss_per_cycle",
        Kind::Energy,
        "lost in the friction of all wedges each cycle",
        false,
    ),
    (
        "loss_per_cycle",
        Kind::Energy,
        "lost in all faces and elements each cycle",
        false,
    ),
    (
        "equivalent_damping",
        Kind::Damping,
        "of all that is lost in bounce: loss per cycle over pi omega A^2",
        false,
    ),
    (
        "damping_ratio",
        Kind::Dimensionless,
        "of bounce: loss per cycle over 4 pi times the largest energy in a spring of the equivalent \
         stiffness",
        false,
    ),
    (
        "largest_warp_angle",
        Kind::Angle,
        "largest warp angle, without sign",
        true,
    ),
    (
        "largest_warp_moment",
        Kind::Moment,
        "largest warp moment on the bolster, without sign",
        true,
    ),
    (
        "least_nest_vertical_force",
        Kind::Force,
        "least load of a nest at any output time",
        true,
    ),
    (
        "largest_nest_vertical_force",
        Kind::Force,
        "largest load of a nest at any output time",
        true,
    ),
    (
        "lowest_bolster_z",
        Kind::Length,
        "lowest place of the bolster from nominal",
        true,
    ),
    (
        "largest_rise_at_start",
        Kind::Length,
        "largest rise of a wedge in its pocket at the start",
        true,
    ),
    (
        "ledger_residual",
        Kind::Dimensionless,
        "relative residual of the energy ledger: the largest residual over the largest of work, losses and \
         change of stored energy",
        true,
    ),
    ("steps", Kind::Count, "accepted steps of the integrator", true),
];

/// Measures of each wedge: the ending of their names.
const OF_WEDGES: [(&str, Kind, &str); 3] = [
    (
        "largest_column_normal",
        Kind::Force,
        "largest normal force of its column",
    ),
    (
        "mean_column_normal",
        Kind::Force,
        "mean normal force of its column",
    ),
    (
        "friction_loss_per_cycle",
        Kind::Energy,
        "lost in its friction at column and slope each cycle",
    ),
];

impl StudyCase for TruckCase {
    fn cycle(&self) -> Option<Cycle> {
        Cycle::of_motion(&self.parameters.bolster.motion.coordinates[2])
    }

    fn definitions(&self) -> Definitions {
        let all = OF_ALL.iter();
        let mut measures: Vec<Measure> = all
            .map(|(name, kind, text, always)| Measure::new(*name, *kind, *text, *always))
            .collect();
        for angle in WARP_ANGLES {
            let name = format!("warp_moment_at_{}_mrad", angle.to_string().replace('.', "_"));
            let text = format!("growth of the warp moment until the warp angle reaches {angle} mrad first");
            measures.push(Measure::new(name, Kind::Moment, text, false));
        }
        for wedge in WEDGE_NAMES {
            for (name, kind, text) in OF_WEDGES {
                let always = !name.ends_with("per_cycle");
                measures.push(Measure::new(format!("{wedge}_{name}"), kind, text, always));
            }
        }
        Definitions(measures)
    }

    fn judge(&self) -> Result<Judged, Unmeasured> {
        // The summary's numbers are in the units of the results.
        let mut case = self.clone();
        case.simulation.output_units = Units::Si;
        judged(&case, findings::nonsense_in_truck, measures)
    }
}

fn measures(case: &TruckCase, result: &TruckResult) -> Measures {
    let column = |name: &str| result.column(name).unwrap_or_default();
    let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let nests = ["left", "right"].map(|side| column(&format!("{side}_nest_vertical_force")));
    let both = nests.into_iter().flatten();
    let (least, most) = both.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| {
        (least.min(*value), most.max(*value))
    });
    let (cycles, energy) = (&result.summary.cycles, &result.summary.energy);
    let equivalent = energy.equivalent.as_ref();
    let loss_of = |wedges: &[&str]| cycles.loss_of_wedges(wedges).unwrap_or(f64::NAN);
    let mut values = vec![
        cycles.work.as_ref().map_or(f64::NAN, |work| work.value),
        loss_of(&WEDGE_NAMES),
        energy.loss.as_ref().map_or(f64::NAN, |loss| loss.value),
        equivalent.map_or(f64::NAN, |own| own.damping.value),
        equivalent.and_then(|own| own.damping_ratio).unwrap_or(f64::NAN),
        largest(column("warp_angle")),
        largest(column("warp_moment")),
        least,
        most,
        column("bolster_z")
            .iter()
            .fold(f64::INFINITY, |least, value| least.min(*value)),
        wedge_rise::largest(&result.summary.wedge_rise),
        result.summary.ledger.largest_relative_residual,
        result.summary.statistics.steps as f64,
    ];
    for angle in WARP_ANGLES {
        let stiffness = warp_stiffness(column("warp_angle"), column("warp_moment"), 1e-3 * angle);
        values.push(stiffness.map_or(f64::NAN, |stiffness| stiffness * 1e-3 * angle));
    }
    let times = column("time");
    let rows = window(case).map_or(0..times.len(), |([start, end], _)| {
        times.partition_point(|time| *time < start)..times.partition_point(|time| *time <= end)
    });
    for wedge in WEDGE_NAMES {
        let normal = column(&format!("{wedge}_column_normal"));
        values.push(largest(normal));
        let rows = &normal[rows.clone()];
        values.push(rows.iter().sum::<f64>() / rows.len() as f64);
        values.push(loss_of(&[wedge]));
    }
    Measures(values)
}
