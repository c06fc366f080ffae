//! Figures of a certificate: what is limited, and what the wedges do, over the speed.

use ::study::certificate::{Assessed, Certificate};
use ::study::records::Status;
use quantity::{Kind, System as Units};

use super::{Exhibit, axis, capital};
use crate::certificate_files::CertificateFindings;
use drawing::{Colour, Figure, Line, Panel, PlotCurve, distinct};

/// Returns the figure of a regime over the speed: a panel for each of its limits, then the wedges.
#[must_use]
pub fn over_speed(certificate: &Certificate, findings: &CertificateFindings, regime: usize) -> Exhibit {
    let own = &certificate.regimes[regime];
    let units = Units::Us;
    let over = |value: &dyn Fn(&Assessed) -> Option<f64>| -> Vec<PlotCurve> {
        let conditions = certificate.conditions.iter().enumerate();
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
    for (number, limit) in certificate.limits.limits.iter().enumerate() {
        if !limit.is_for(&own.name) {
            continue;
        }
        let value = |run: &Assessed| run.checks.iter().find(|check| check.limit == number)?.value;
        let mut curves = over(&value);
        let speeds: Vec<f64> = curves
            .iter()
            .flat_map(|curve| curve.points.iter().map(|at| at.0))
            .collect();
        let ends = speeds
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| {
                (low.min(*at), high.max(*at))
            });
        if ends.0.is_finite() {
            curves.push(PlotCurve::new(
                "limit",
                (Colour::Vermillion, Line::Dotted),
                [(ends.0, limit.value), (ends.1, limit.value)],
            ));
        }
        let unit = match limit.unit.as_str() {
            "" => String::new(),
            unit => format!(" ({unit})"),
        };
        let y_label = format!("{}{unit}", limit.measure.name.replace('_', " "));
        panels.push(panel(limit.quantity.clone(), y_label, curves));
    }
    let measures = certificate.study.measures();
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
    let columns = panels.len().clamp(1, 2);
    Exhibit::new(
        format!("over_speed_{}", own.name),
        Figure::new(
            format!("{}: over the speed", capital(&own.title)),
            format!(
                "{}. What is limited, with its limit (dotted); then the energy that the friction of all \
                 wedges took in a run, and the share of the time after settling in which no point of a \
                 wedge's faces slips, mean of all wedges. Runs that did not reach the end of their track, or \
                 failed, are not drawn. Limits: {}, {}.",
                capital(&own.title),
                certificate.limits.title,
                certificate.limits.source
            ),
            panels,
        )
        .in_columns(columns),
    )
}
