//! Figures of what goes into the runs: the bolster's motion, the friction law, the coil.

use drawing::{Colour, Figure, Line, Panel, PlotCurve, distinct};
use mechanics::coil::CoilLaw;
use mechanics::friction::{FrictionLaw, bristle, tanh};
use quantity::{Kind, System as Units};
use report::csv::converted;
use report::figures::{CaseOutcome, Exhibit, axis, capital, curve, digits, toe_style, yaw};
use wedge::parameters::Damping;

/// Returns the figures that these runs allow.
#[must_use]
pub fn exhibits(outcomes: &[CaseOutcome]) -> Vec<Exhibit> {
    let mut exhibits = Vec::new();
    exhibits.extend(bolster_motion(outcomes));
    exhibits.extend(friction_law(outcomes));
    for damping in [Damping::Variable, Damping::Constant] {
        exhibits.extend(coil(outcomes, damping));
    }
    exhibits
}

/// Figure 4-1, and the yaw of figure 4-2.
fn bolster_motion(outcomes: &[CaseOutcome]) -> Option<Exhibit> {
    let (_, result) = outcomes.first()?;
    let units = result.summary.units;
    let mut yawing: Vec<PlotCurve> = Vec::new();
    for (case, result) in outcomes {
        let label = format!("yaw {} rad", yaw(case));
        if yawing.iter().all(|curve| curve.label != label) {
            let (colour, line) = distinct(yawing.len() + 1);
            yawing.push(curve(result, "time", "bolster_yaw", (&label, colour, line)));
        }
    }
    Some(Exhibit {
        name: "bolster_motion".to_owned(),
        thesis: "figures 4-1 and 4-2".to_owned(),
        figure: Figure::new(
            "The bolster's prescribed motion",
            "(a) Vertical displacement of the bolster, the same in all runs: it rises first. (b) \
                      Its yaw, which is held from the start.",
            [
                Panel::new(
                    "(a) vertical displacement",
                    "time (s)",
                    axis("displacement", Kind::Length, units),
                    [curve(
                        result,
                        "time",
                        "bolster_vertical",
                        ("all runs", Colour::Blue, Line::Solid),
                    )],
                ),
                Panel::new("(b) yaw", "time (s)", axis("yaw", Kind::Angle, units), yawing),
            ],
        ),
    })
}

/// Figure 3-9: the friction force over the slip speed, from the law's own code; beside it the law that
/// sticks.
fn friction_law(outcomes: &[CaseOutcome]) -> Option<Exhibit> {
    let (case, result) = outcomes.first()?;
    let units = result.summary.units;
    let FrictionLaw::Tanh { reference_speed } = case.parameters.column_friction.law else {
        return None;
    };
    let smooth = |speed: f64| tanh::friction(1.0, reference_speed, [speed, 0.0]).force[0];
    let speeds = (-500..=500).map(|i| 0.01 * f64::from(i) * reference_speed);
    let law = speeds.map(|speed| (converted(speed, Kind::Speed, units), smooth(speed)));
    Some(Exhibit {
        name: "friction_law".to_owned(),
        thesis: "figure 3-9".to_owned(),
        figure: Figure::new(
            "The friction laws",
            format!(
                "(a) The thesis's law (eq. 3-8): friction over the friction limit as a function of the slip \
                 speed, v0 = {} {}. It is zero at rest, so that a loaded corner creeps. (b) The bristle \
                 law, the alternative: friction over the friction limit as a function of the displacement, \
                 back and forth. It is elastic until it slips, and holds a load.",
                digits(converted(reference_speed, Kind::Speed, units)),
                Kind::Speed.label(units)
            ),
            [
                Panel::new(
                    "(a) tanh",
                    axis("slip speed", Kind::Speed, units),
                    "friction over its limit",
                    [PlotCurve::new("tanh", (Colour::Blue, Line::Solid), law)],
                ),
                Panel::new(
                    "(b) bristle",
                    axis("displacement", Kind::Length, units),
                    "friction over its limit",
                    [PlotCurve::new(
                        "bristle",
                        (Colour::Vermillion, Line::DashDot),
                        bristle_loop(units),
                    )],
                ),
            ],
        ),
    })
}

/// Returns the bristle law under a slow triangular motion, with the default stiffness and damping of a face
/// and a limit of 1000 lbf.
fn bristle_loop(units: Units) -> Vec<(f64, f64)> {
    const INCH: f64 = 0.0254;
    const POUND_FORCE: f64 = 4.448_221_615_260_5;
    let (stiffness, damping) = (1e6 * POUND_FORCE / INCH, 1e3 * POUND_FORCE / INCH);
    let limit = 1000.0 * POUND_FORCE;
    let (speed, step) = (1e-3 * INCH, 1e-2);
    let (mut place, mut deflection) = (0.0, 0.0);
    let mut points = Vec::new();
    for leg in [1.0, -1.0, -1.0, 1.0, 1.0] {
        for _ in 0..300 {
            // One Euler step; the law is slow here: 1 s in stick against a time constant of 1 ms in slip.
            for _ in 0..50 {
                let velocity = [leg * speed, 0.0];
                let friction = bristle::friction(limit, stiffness, damping, velocity, [deflection, 0.0]);
                deflection += friction.rate[0] * step / 50.0;
            }
            place += leg * speed * step;
            let velocity = [leg * speed, 0.0];
            let friction = bristle::friction(limit, stiffness, damping, velocity, [deflection, 0.0]);
            points.push((converted(place, Kind::Length, units), friction.force[0] / limit));
        }
    }
    points
}

/// Coil force over length (figures 2-3 and 2-4 show it for the comparison program) and over time.
fn coil(outcomes: &[CaseOutcome], damping: Damping) -> Option<Exhibit> {
    let runs: Vec<&CaseOutcome> = outcomes
        .iter()
        .filter(|(case, _)| case.parameters.damping == damping && yaw(case) == 0.0)
        .collect();
    let (case, result) = runs.first()?;
    let units = result.summary.units;
    let coil = &case.parameters.coil;
    let mut over_length = Vec::new();
    if let CoilLaw::Linear { stiffness } = coil.law {
        let lengths = result.column("coil_length")?;
        let low = lengths.iter().copied().fold(f64::INFINITY, f64::min);
        let high = lengths.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let air = 0.1 * (high - low) + 0.02 * high;
        let points = [low - air, high + air].map(|length| {
            (
                converted(length, Kind::Length, units),
                converted(stiffness * (coil.free_length - length), Kind::Force, units),
            )
        });
        over_length.push(PlotCurve::new(
            "law",
            (Colour::Grey, Line::Solid),
            points.to_vec(),
        ));
    }
    let mut over_time = Vec::new();
    for (case, result) in &runs {
        let (label, colour, line) = toe_style(case.parameters.toe);
        over_length.push(curve(result, "coil_length", "coil_force", (&label, colour, line)));
        over_time.push(curve(result, "time", "coil_force", (&label, colour, line)));
    }
    let name = damping.name();
    let (thesis, seat) = match damping {
        Damping::Variable => (
            "figure 2-3",
            "It stands on the side frame, so that its force follows the bolster's travel",
        ),
        Damping::Constant => (
            "figure 2-4",
            "It stands in the bolster's pocket, so that its force hardly changes",
        ),
    };
    Some(Exhibit {
        name: format!("{name}_coil_force"),
        thesis: thesis.to_owned(),
        figure: Figure::new(
            format!("{} damping: the control coil's force", capital(name)),
            format!(
                "Force of the control coil on the wedge (a) over its length, with the law, and (b) over \
                 time, bolster not yawed. {seat}. The force is the spring's, without the coil's damping. \
                 The thesis draws it over the displacement.",
            ),
            [
                Panel::new(
                    "(a) over the coil's length",
                    axis("coil length", Kind::Length, units),
                    axis("coil force", Kind::Force, units),
                    over_length,
                ),
                Panel::new(
                    "(b) over time",
                    "time (s)",
                    axis("coil force", Kind::Force, units),
                    over_time,
                ),
            ],
        ),
    })
}
