//! Figures of a survey of wedge rise: what is limited over the rise, and what rigs say of the truck.

use drawing::{Colour, Figure, Line, Panel, PlotCurve, distinct};
use quantity::{Kind, System as Units};
use study::rise::rigs::Rig;
use study::rise::{Survey, mph};

use super::{Exhibit, axis, capital};
use crate::rise_files::own_answers;
use crate::rise_work::RiseFindings;
use crate::warp_files::KIP_INCH;

const RISE: &str = "wedge rise (in)";
/// Speeds that a panel shows: the worst one first.
const SPEEDS: usize = 3;

/// Returns the figure of the limits: a panel each, over the rise, at the worst speed and beside it.
#[must_use]
pub fn limits(survey: &Survey, findings: &RiseFindings) -> Exhibit {
    let panels = own_answers(survey, findings).into_iter().map(|answer| {
        let limit = survey.limit(answer.question);
        let mut speeds: Vec<u32> = vec![answer.speed];
        // Others by how many rises they have.
        let mut others: Vec<(usize, u32)> = answer
            .speeds
            .iter()
            .map(|own| own.0)
            .filter(|own| *own != answer.speed)
            .map(|own| {
                (
                    survey.curve(&findings.known, &[], answer.question, own).len(),
                    own,
                )
            })
            .filter(|own| own.0 > 2)
            .collect();
        others.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.cmp(&b.1)));
        speeds.extend(others.iter().map(|own| own.1).take(SPEEDS - 1));
        let curves = speeds.iter().enumerate().map(|(number, speed)| {
            let points = survey.curve(&findings.known, &[], answer.question, *speed);
            let points = points.iter().map(|own| (own[0], own[1]));
            PlotCurve::new(
                format!("{} mph", mph(*speed)),
                distinct(number),
                points.collect::<Vec<_>>(),
            )
        });
        let mut curves: Vec<PlotCurve> = curves.collect();
        let bound = survey.curve(&findings.known, &[], answer.question, answer.speed);
        let bound: Vec<(f64, f64)> = bound.iter().map(|own| (own[0], own[2])).collect();
        curves.push(PlotCurve::new("limit", (Colour::Vermillion, Line::Dotted), bound));
        curves.retain(|own| !own.points.is_empty());
        let unit = match limit.unit.as_str() {
            "" => String::new(),
            unit => format!(" ({unit})"),
        };
        let label = format!("{}{unit}", limit.measure.name.replace('_', " "));
        let regime = survey.regimes[answer.question.regime].name.replace('_', " ");
        Panel::new(
            format!("{}: {}", capital(&regime), limit.quantity),
            RISE,
            label,
            curves,
        )
    });
    let panels: Vec<Panel> = panels.filter(|own| !own.curves.is_empty()).collect();
    let columns = panels.len().clamp(1, 2);
    Exhibit::new(
        "limits_over_rise".to_owned(),
        Figure::new(
            format!("{}: what wedge rise costs", survey.name),
            "What is limited over wedge rise at the speed at which the limit is reached first (blue), and at \
             others with most runs; limits dotted. Runs in which a wheel left its rail are not drawn.",
            panels,
        )
        .in_columns(columns),
    )
}

/// Returns the figure of the rigs: warp stiffness, energy of a cycle, speed at which hunting dies.
#[must_use]
pub fn rigs(survey: &Survey, findings: &RiseFindings) -> Exhibit {
    let units = Units::Us;
    let of = |rig: Rig, factor: f64| -> Vec<(f64, f64)> {
        let own = findings.rigs.iter().filter(|own| own.rig == rig);
        own.filter_map(|own| Some((f64::from(own.rise) / 16.0, own.value? * factor)))
            .collect()
    };
    let parts = [
        (
            Rig::Warp,
            "warp stiffness of both nests at 10 mrad",
            "stiffness (kip in/mrad)".to_owned(),
            1e-3 / KIP_INCH,
        ),
        (
            Rig::Damping,
            "energy of a cycle, bolster 0.5 in up and down",
            axis("energy", Kind::Energy, units),
            Kind::Energy.from_si(units),
        ),
        (
            Rig::Hunting,
            "speed at which hunting dies, falling",
            axis("speed", Kind::TravelSpeed, units),
            Kind::TravelSpeed.from_si(units),
        ),
    ];
    let panels = parts.into_iter().map(|(rig, title, label, factor)| {
        Panel::new(
            title,
            RISE,
            label,
            [PlotCurve::new(rig.name(), distinct(0), of(rig, factor))],
        )
    });
    let panels: Vec<Panel> = panels
        .filter(|own| own.curves.iter().any(|own| !own.points.is_empty()))
        .collect();
    let columns = panels.len().clamp(1, 3);
    Exhibit::new(
        "truck_over_rise".to_owned(),
        Figure::new(
            format!("{}: the truck over wedge rise", survey.name),
            "Rigs with the nests of the car's front truck, and the car at falling speed on perfect track.",
            panels,
        )
        .in_columns(columns),
    )
}
