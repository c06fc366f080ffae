//! The hysteresis figure: vertical wedge force over the bolster's vertical displacement.

use mechanics::motion::Motion;
use quantity::{Kind, System as Units};
use study::case::Case;
use study::metrics::Cycle;
use study::result::RunResult;
use wedge::parameters::Damping;

use crate::csv::converted;
use crate::drawing::{Colour, Curve, Figure, Line, Panel};

/// What the figure needs of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// The wedge's damping.
    pub damping: Damping,
    /// Units of the points.
    pub units: Units,
    /// Toe angle, rad, positive out.
    pub toe: f64,
    /// Bolster yaw, rad.
    pub yaw: f64,
    /// Displacement and force, without the start.
    pub points: Vec<(f64, f64)>,
}

impl Loop {
    /// Takes the loop out of a run. The first half period of the bolster's motion, in which the wedge settles, is left out.
    #[must_use]
    pub fn of(case: &Case, result: &RunResult) -> Option<Self> {
        let units = result.summary.units;
        let start = Cycle::of(&case.parameters).map_or(0.0, |cycle| 0.5 * cycle.period());
        let times = result.column("time")?;
        let x = result.column("bolster_vertical")?;
        let y = result.column("vertical_wedge_force")?;
        let points = times
            .iter()
            .zip(x.iter().zip(y))
            .filter(|(time, _)| **time >= start)
            .map(|(_, (x, y))| {
                (
                    converted(*x, Kind::Length, units),
                    converted(*y, Kind::Force, units),
                )
            })
            .collect();
        let yaw = match &case.parameters.bolster.coordinates[5] {
            Motion::Constant(yaw) => *yaw,
            _ => 0.0,
        };
        Some(Self {
            damping: case.parameters.damping,
            units,
            toe: case.parameters.toe,
            yaw,
            points,
        })
    }
}

/// A damping's name, as in file names.
#[must_use]
pub fn damping_name(damping: Damping) -> &'static str {
    match damping {
        Damping::Variable => "variable",
        Damping::Constant => "constant",
    }
}

/// The name of a damping's figure file.
#[must_use]
pub fn file_name(damping: Damping) -> String {
    format!("hysteresis_{}.svg", damping_name(damping))
}

/// The figure of all loops with this damping, one panel a yaw angle; `None` if there are no loops.
#[must_use]
pub fn figure(damping: Damping, loops: &[Loop]) -> Option<Figure> {
    let loops: Vec<&Loop> = loops.iter().filter(|one| one.damping == damping).collect();
    let units = loops.first()?.units;
    let mut yaws: Vec<f64> = loops.iter().map(|one| one.yaw).collect();
    yaws.sort_by(f64::total_cmp);
    yaws.dedup();
    let panels = yaws
        .iter()
        .zip('a'..)
        .map(|(yaw, letter)| Panel {
            title: if *yaw == 0.0 {
                format!("({letter}) bolster not yawed")
            } else {
                format!("({letter}) bolster yawed by {yaw} rad")
            },
            x_label: format!("bolster vertical displacement ({})", Kind::Length.label(units)),
            y_label: format!("vertical wedge force ({})", Kind::Force.label(units)),
            curves: loops
                .iter()
                .filter(|one| one.yaw == *yaw)
                .map(|one| curve(one))
                .collect(),
        })
        .collect();
    let name = damping_name(damping);
    Some(Figure {
        title: format!(
            "{}{} damping: vertical wedge force over bolster displacement",
            name[..1].to_uppercase(),
            &name[1..]
        ),
        caption: format!(
            "Hysteresis of the {name}ly damped friction wedge: the column's friction force as it acts on the side frame \
             (positive up) over the bolster's vertical displacement (positive up), for each toe angle, without and with \
             yaw of the bolster. The first half period, in which the wedge settles from rest, is not shown."
        ),
        panels,
    })
}

fn curve(one: &Loop) -> Curve {
    let degrees = (one.toe.to_degrees().abs() * 1e6).round() / 1e6;
    let (label, colour, line) = if one.toe > 0.0 {
        (format!("toe out {degrees}°"), Colour::Blue, Line::Solid)
    } else if one.toe < 0.0 {
        (format!("toe in {degrees}°"), Colour::Vermillion, Line::DashDot)
    } else {
        ("no toe".to_owned(), Colour::Black, Line::Dashed)
    };
    Curve {
        label,
        colour,
        line,
        points: one.points.clone(),
    }
}
