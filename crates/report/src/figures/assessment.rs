//! Figures of an assessment: what is limited, and what the wedges do, over the speed.

use ::study::assessment::{Assessed, Assessment};
use ::study::records::Status;
use quantity::{Kind, System as Units};

use super::{Exhibit, axis, capital};
use crate::assessment_files::AssessmentFindings;
use drawing::{Colour, Figure, Line, Panel, PlotCurve, distinct};

/// Returns the figure of a regime over the speed: a panel for each of its limits, then the wedges.
#[must_use]
pub fn over_speed(assessment: &Assessment, findings: &AssessmentFindings, regime: usize) -> Exhibit {
    let own = &assessment.regimes[regime];
    let units = Units::Us;
    let over = |value: &dyn Fn(&Assessed) -> Option<f64>| -> Vec<PlotCurve> {
        let conditions = assessment.conditions.iter().enumerate();
        let curves = conditions.map(|(condition, named)| {
            let runs = findings.runs.iter();
            let own = runs.filter(|run| run.regime == regime && run.condition == condition);
            let own = own.filter(|run| run.status == Status::Complete.name());
            let mut points: Vec<(f64, f64)> = own
                .filter_map(|run| Some((run.speed_si * Kind::TravelSpeed.from_si(units), value(run)?)))
                .collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            PlotCurve::new(named.name.replace('_', " "), distinct(condition), points)
        });
        curves.filter(|curve| !curve.points.is_empty()).collect()
    };
    let panel = |title: String, y_label: String, curves: Vec<PlotCurve>| {
        Panel::new(title, axis("speed", Kind::TravelSpeed, units), y_label, curves)
    };
    let mut panels = Vec::new();
    for (number, limit) in assessment.limits.limits.iter().enumerate() {
        if !limit.is_for(&own.name) {
            continue;
        }
        let value = |run: &Assessed| run.checks.iter().find(|check| check.limit == number)?.value;
        let mut curves = over(&value);
        // Of a formula each run has its own.
        let allowed = |run: &Assessed| run.checks.iter().find(|check| check.limit == number)?.allowed;
        let of_first = over(&allowed).into_iter().take(1);
        curves.extend(
            of_first.map(|own| PlotCurve::new("limit", (Colour::Vermillion, Line::Dotted), own.points)),
        );
        let unit = match limit.unit.as_str() {
            "" => String::new(),
            unit => format!(" ({unit})"),
        };
        let y_label = format!("{}{unit}", limit.measure.name.replace('_', " "));
        panels.push(panel(assessment.quantity(limit), y_label, curves));
    }
    let measures = assessment.study.measures();
    let loss = |run: &Assessed| {
        let place = measures.place("wedge_loss")?;
        Some(run.measures.get(place)? * Kind::Energy.from_si(units))
    };
    panels.push(panel(
        "energy lost in the wedges".to_owned(),
        axis("energy", Kind::Energy, units),
        over(&loss),
    ));
    let locked = |run: &Assessed| {
        let places = (0..measures.len()).filter(|place| measures[*place].name.ends_with("_locked_share"));
        let shares: Vec<f64> = places
            .filter_map(|place| run.measures.get(place).copied())
            .filter(|share| !share.is_nan())
            .collect();
        (!shares.is_empty()).then(|| 100.0 * shares.iter().sum::<f64>() / shares.len() as f64)
    };
    panels.push(panel(
        "wedges that no point of slips".to_owned(),
        "share of the time (%)".to_owned(),
        over(&locked),
    ));
    panels.retain(|panel| !panel.curves.is_empty());
    let of_wedges = match measures.place("wedge_loss") {
        Some(_) => {
            "; then the energy that the friction of all wedges took in a run, and the share of the time \
             after settling in which no point of a wedge's faces slips, mean of all wedges"
        }
        None => "",
    };
    let columns = panels.len().clamp(1, 2);
    Exhibit::new(
        format!("over_speed_{}", own.name),
        Figure::new(
            format!("{}: over the speed", capital(&own.title)),
            format!(
                "{}. What is limited, with its limit (dotted){of_wedges}. Runs that did not reach the end of \
                 their track, or failed, are not drawn. Limits: {}, {}.",
                capital(&own.title),
                assessment.limits.title,
                assessment.limits.source
            ),
            panels,
        )
        .in_columns(columns),
    )
}
