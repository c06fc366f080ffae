//! The measures of half-trucks: those of the summary, by the numbers of wedges and bodies in the files.

use mechanics::body::COORDINATES;
use quantity::{Kind, System as Units};

use super::measuring::judged;
use super::{Definitions, Judged, Measure, Measures, Unmeasured};
use crate::half_truck::run::cycle;
use crate::half_truck::{HalfTruckCase, HalfTruckResult, WedgeSummary};
use crate::metrics::Cycle;
use crate::models::StudyCase;
use crate::run::findings;
use crate::summary;

/// The metric of a wedge: its name after `wedge_NUMBER_`, kind, text, and where it stands in the summary.
type OfWedge = (&'static str, Kind, &'static str, fn(&WedgeSummary) -> Option<f64>);

const OF_WEDGES: [OfWedge; 5] = [
    (
        "energy_per_cycle",
        Kind::Energy,
        "lost in the column's friction each cycle of the vertical input",
        |wedge| value(wedge.energy_per_cycle.as_ref()),
    ),
    (
        "mean_column_friction_up",
        Kind::Force,
        "column friction on the side frame, positive up; mean while the input rises, at mid stroke with \
         constant damping, in the lower stroke with variable damping",
        |wedge| value(wedge.up.as_ref()),
    ),
    (
        "mean_column_friction_down",
        Kind::Force,
        "the same while the input falls",
        |wedge| value(wedge.down.as_ref()),
    ),
    (
        "largest_column_normal_force",
        Kind::Force,
        "largest normal force of the column at any output time",
        |wedge| value(wedge.largest_normal_force.as_ref()),
    ),
    (
        "jammed_share",
        Kind::Dimensionless,
        "share of the output times at which no steady sliding exists",
        |wedge| Some(wedge.jammed),
    ),
];

fn value(measure: Option<&summary::SummaryValue>) -> Option<f64> {
    measure.map(|measure| measure.value)
}

/// Returns names and coordinates of the free bodies' displacements, as the summary has them.
fn displacements(case: &HalfTruckCase) -> Vec<(String, usize)> {
    let bodies = case.truck.bodies.iter().zip(&case.truck.model.bodies);
    bodies
        .flat_map(|(number, body)| {
            let free = COORDINATES.iter().enumerate().filter(|(k, _)| body.free[*k]);
            free.map(move |(k, name)| (format!("body_{number}_{name}"), k))
        })
        .collect()
}

impl StudyCase for HalfTruckCase {
    fn cycle(&self) -> Option<Cycle> {
        cycle(self)
    }

    fn definitions(&self) -> Definitions {
        let mut all = vec![Measure::new(
            "energy_per_cycle",
            Kind::Energy,
            "lost in the friction of all columns each cycle of the vertical input",
            false,
        )];
        for place in self.wedges() {
            let number = self.truck.connections[place];
            all.extend(OF_WEDGES.iter().map(|(name, kind, text, _)| {
                Measure::new(format!("wedge_{number}_{name}"), *kind, *text, false)
            }));
        }
        for (name, coordinate) in displacements(self) {
            let kind = if coordinate < 3 { Kind::Length } else { Kind::Angle };
            let text = "largest displacement or angle from the drawn layout, without sign";
            all.push(Measure::new(format!("largest_{name}"), kind, text, true));
        }
        all.push(Measure::new(
            "ledger_residual",
            Kind::Dimensionless,
            "relative residual of the energy ledger: the largest residual over the largest of work, losses \
             and change of stored energy",
            true,
        ));
        all.push(Measure::new(
            "steps",
            Kind::Count,
            "accepted steps of the integrator",
            true,
        ));
        Definitions(all)
    }

    fn judge(&self) -> Result<Judged, Unmeasured> {
        // The summary's numbers are in the units of the results.
        let case = Self {
            units: Units::Si,
            ..self.clone()
        };
        judged(&case, findings::nonsense, measures)
    }
}

fn measures(case: &HalfTruckCase, result: &HalfTruckResult) -> Measures {
    let summary = &result.summary;
    let or_none = |value: Option<f64>| value.unwrap_or(f64::NAN);
    let energies = summary
        .wedges
        .values()
        .map(|own| value(own.energy_per_cycle.as_ref()));
    // Without wedges there is nothing to add up.
    let total: Option<f64> = energies
        .sum::<Option<f64>>()
        .filter(|_| !summary.wedges.is_empty());
    let mut values = vec![or_none(total)];
    for place in case.wedges() {
        let wedge = summary.wedges.get(&case.truck.connections[place].to_string());
        values.extend(OF_WEDGES.iter().map(|(_, _, _, of)| or_none(wedge.and_then(of))));
    }
    for (name, _) in displacements(case) {
        values.push(or_none(value(summary.largest_displacements.get(&name))));
    }
    values.push(summary.largest_relative_residual);
    values.push(summary.statistics.steps as f64);
    Measures(values)
}
