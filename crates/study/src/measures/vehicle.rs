//! The metrics of a vehicle's run in a study: of each of its columns the least, the greatest, the mean and
//! the root mean square over all output times; its slowest natural vibration; what its run lost.

use ::vehicle::OnTrack;
use mechanics::output::Column;
use quantity::{Kind, System as Units};

use super::measuring::judged;
use super::of_rules;
use super::{Definitions, Judged, Measure, Measures, Unmeasured};
use crate::car::figures::CarFigures;
use crate::models::{ModelCase, StudyCase};
use crate::run::findings;
use crate::summary::SummaryValue;
use crate::vehicle::VehicleCase;
use crate::vehicle::run::VehicleResult;
use crate::vehicle::summary::VehicleSummary;

/// Measures of a column: the ending of their names.
const OF_COLUMNS: [(&str, &str); 4] = [
    ("min", "least value"),
    ("max", "greatest value"),
    ("mean", "mean"),
    ("rms", "root mean square"),
];

/// Measures of all runs.
const OF_ALL: [(&str, Kind, &str, bool); 5] = [
    (
        "slowest_frequency",
        Kind::Frequency,
        "of the natural vibrations about the rest",
        false,
    ),
    (
        "slowest_damping_ratio",
        Kind::Dimensionless,
        "of the slowest natural vibration",
        false,
    ),
    ("loss", Kind::Energy, "lost in the whole run", true),
    (
        "ledger_residual",
        Kind::Dimensionless,
        "relative residual of the energy ledger: the largest residual over the largest of work, losses and \
         change of stored energy",
        true,
    ),
    ("steps", Kind::Count, "accepted steps of the integrator", true),
];

/// Measures of runs on a track, beside those of rules.
const ON_TRACK: [(&str, Kind, &str); 3] = [
    (
        "end_distance",
        Kind::Distance,
        "distance along the track of the first wheelset at the end",
    ),
    ("end_speed", Kind::TravelSpeed, "speed at the end"),
    ("derailed", Kind::Count, "1 if a wheel left its rail, else 0"),
];

/// The ending of the names of filtered columns.
const FILTERED: &str = "_filtered";

impl StudyCase for VehicleCase {
    /// None where it makes no vehicle.
    fn definitions(&self) -> Definitions {
        let all = OF_ALL.iter();
        let mut measures: Vec<Measure> = all
            .map(|(name, kind, text, always)| Measure::new(*name, *kind, *text, *always))
            .collect();
        let filtered = |column: &&Column| !column.name.ends_with(FILTERED);
        for column in self.columns().unwrap_or_default().iter().skip(1).filter(filtered) {
            for (ending, text) in OF_COLUMNS {
                let name = format!("{}_{ending}", column.name);
                let text = format!("{text}, {}", column.text);
                measures.push(Measure::new(name, column.kind, text, true));
            }
        }
        if self.description.on_track.is_some() {
            measures.extend(of_rules::worst());
            let others = ON_TRACK.iter();
            measures.extend(others.map(|(name, kind, text)| Measure::new(*name, *kind, *text, true)));
            // Static loads are of a rest that there may be none of.
            measures.extend(of_rules::figures().map(|own| Measure { always: false, ..own }));
        }
        Definitions(measures)
    }

    fn judge(&self) -> Result<Judged, Unmeasured> {
        // The summary's numbers are in the units of the results.
        let mut case = self.clone();
        case.simulation.output_units = Units::Si;
        let nonsense = match case.description.on_track {
            Some(_) => findings::nonsense_in_car,
            None => findings::nonsense_in_truck,
        };
        judged(&case, nonsense, measures)
    }
}

fn measures(case: &VehicleCase, result: &VehicleResult) -> Measures {
    let summary = &result.summary;
    let slowest = summary.vibrations.first();
    let losses = result.column("losses").and_then(<[f64]>::last).copied();
    let mut values = vec![
        // Frequencies are angular inside.
        slowest.map_or(f64::NAN, |own| own.frequency_hz * 2.0 * std::f64::consts::PI),
        slowest.map_or(f64::NAN, |own| own.damping_ratio),
        losses.unwrap_or(f64::NAN),
        summary.ledger.largest_relative_residual,
        summary.solver.steps as f64,
    ];
    let columns = result.columns.iter().zip(&result.values).skip(1);
    for (_, column) in columns.filter(|(own, _)| !own.name.ends_with(FILTERED)) {
        let rows = column.len() as f64;
        values.push(column.iter().copied().fold(f64::INFINITY, f64::min));
        values.push(column.iter().copied().fold(f64::NEG_INFINITY, f64::max));
        values.push(column.iter().sum::<f64>() / rows);
        values.push((column.iter().map(|own| own * own).sum::<f64>() / rows).sqrt());
    }
    if let Some(on) = &case.description.on_track {
        values.extend(of_rules::values(&summary.statistics));
        let end = |own: Option<&SummaryValue>| own.map_or(f64::NAN, |own| own.value);
        values.extend([
            end(summary.reached.as_ref()),
            end(summary.speed.as_ref().map(|[_, last]| last)),
            f64::from(u8::from(summary.derailed.is_some())),
        ]);
        values.extend(figures(on, summary).values());
    }
    Measures(values)
}

fn figures(on: &OnTrack, summary: &VehicleSummary) -> CarFigures {
    let climb = on.climb_limits();
    let loads = on.all_wheelsets().into_iter().filter_map(|(name, _)| {
        let side = |side: &str| Some(summary.static_loads.get(&format!("{name}_{side}"))?.value);
        Some([side("left")?, side("right")?])
    });
    CarFigures::with(&loads.collect::<Vec<_>>(), Some(&climb))
}
