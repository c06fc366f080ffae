//! Figures of one run of a car, over the distance along the track.

use ::study::car::CarCase;
use ::study::car::motions::MotionTable;
use ::study::car::run::CarResult;
use ::study::car::statistics::SIDES;
use ::study::damage::PlaceDamage;
use ::study::truck::WEDGE_NAMES;
use quantity::{Kind, System as Units};

use super::{Exhibit, axis};
use crate::csv::converted;
use drawing::{Figure, Panel, PlotCurve, distinct};

/// A run of a car.
#[derive(Clone, Debug)]
pub struct CarRun {
    /// Its case.
    pub case: CarCase,
    /// The outcome.
    pub result: CarResult,
    /// The motions of its bodies, if the run took them along.
    pub motions: Option<MotionTable>,
}

impl CarRun {
    fn units(&self) -> Units {
        self.result.summary.units
    }

    /// Returns a column over the distance, in output units; empty if it is not there.
    fn over_distance(&self, name: &str) -> Vec<(f64, f64)> {
        let units = self.units();
        let kind = |name: &str| {
            let found = self.result.columns.iter().find(|column| column.name == name);
            found.map_or(Kind::Dimensionless, |column| column.kind)
        };
        let distances = self.result.column("distance").unwrap_or_default();
        let values = self.result.column(name).unwrap_or_default();
        let own = kind(name);
        let pairs = distances.iter().zip(values);
        pairs
            .map(|(s, value)| {
                (
                    converted(*s, Kind::Distance, units),
                    converted(*value, own, units),
                )
            })
            .collect()
    }

    /// Returns a panel of these columns: labels and names.
    fn panel(&self, title: &str, y: (&str, Kind), columns: &[(String, String)]) -> Panel {
        let units = self.units();
        let curves = columns.iter().enumerate().map(|(number, (label, name))| {
            PlotCurve::new(label.clone(), distinct(number), self.over_distance(name))
        });
        Panel::new(
            title,
            axis("distance", Kind::Distance, units),
            axis(y.0, y.1, units),
            curves.filter(|curve| !curve.points.is_empty()),
        )
    }

    /// Returns the filtered column if there is one, else the raw one.
    fn best(&self, name: &str) -> String {
        let filtered = format!("{name}_filtered");
        match self.result.column(&filtered) {
            Some(_) => filtered,
            None => name.to_owned(),
        }
    }
}

/// Labels and names of columns of both sides of both axles of a truck.
fn wheels(run: &CarRun, truck: usize, what: &str) -> Vec<(String, String)> {
    let axles = [2 * truck - 1, 2 * truck];
    axles
        .into_iter()
        .flat_map(|axle| {
            SIDES.map(|side| {
                let name = format!("axle_{axle}_{side}_{what}");
                (format!("axle {axle}, {side}"), run.best(&name))
            })
        })
        .collect()
}

/// Returns the figure of depths over the profiles; none of a run without damage.
fn damage(run: &CarRun) -> Option<Exhibit> {
    let damage = run.result.summary.damage.as_ref()?;
    let units = run.units();
    let over = |places: &[PlaceDamage]| -> Vec<(f64, f64)> {
        places.iter().map(|place| (place.y, place.depth)).collect()
    };
    let wheels = damage.wheels.iter().enumerate().map(|(number, (name, own))| {
        PlotCurve::new(name.replace('_', " "), distinct(number), over(&own.profile))
    });
    let rails = damage.rails.iter().enumerate().map(|(number, (side, own))| {
        PlotCurve::new(format!("{side} rail"), distinct(number), over(&own.profile))
    });
    let panel = |title: &str, place: &str, curves: Vec<PlotCurve>| {
        Panel::new(
            title,
            axis(place, Kind::Length, units),
            axis("depth", Kind::Length, units),
            curves,
        )
    };
    let panels = vec![
        panel(
            "(a) wheels, 100,000 miles",
            "to the field side of the tape circle",
            wheels.collect(),
        ),
        panel(
            "(b) rails, 1,000,000 tons",
            "to the field side of the origin",
            rails.collect(),
        ),
    ];
    let caption = "Depth that wheels wear over 100,000 miles, and rails over 1,000,000 gross tons, of this \
                   run again and again on profiles as they are: Archard's law by the map of [damage].";
    let name = run.case.name.as_str();
    Some(Exhibit::new(
        format!("{name}_damage"),
        Figure::new(format!("{name}: wear over the profiles"), caption, panels).in_columns(2),
    ))
}

/// Returns the figures of a run.
#[must_use]
pub fn exhibits(run: &CarRun) -> Vec<Exhibit> {
    let mut all = over_distance(run);
    all.extend(damage(run));
    all
}

fn over_distance(run: &CarRun) -> Vec<Exhibit> {
    let name = run.case.name.as_str();
    let exhibit = |what: &str, title: &str, caption: &str, panels: Vec<Panel>| {
        Exhibit::new(
            format!("{name}_{what}"),
            Figure::new(format!("{name}: {title}"), caption, panels).in_columns(2),
        )
    };
    let filter = run.case.rules.wheel_filter;
    let of_wheels = |what: &str, y: (&str, Kind)| {
        vec![
            run.panel("(a) front truck", y, &wheels(run, 1, what)),
            run.panel("(b) rear truck", y, &wheels(run, 2, what)),
        ]
    };
    let axles = |what: &str| -> Vec<(String, String)> {
        (1..=4)
            .map(|axle| (format!("axle {axle}"), format!("axle_{axle}_{what}")))
            .collect()
    };
    let ends = |what: &str| -> Vec<(String, String)> {
        [(1, "front"), (2, "rear")]
            .map(|(end, label)| (label.to_owned(), run.best(&format!("body_at_truck_{end}_{what}"))))
            .to_vec()
    };
    let one = |label: &str, name: &str| vec![(label.to_owned(), name.to_owned())];
    let trucks = |what: &str| -> Vec<(String, String)> {
        [(1, "front"), (2, "rear")]
            .map(|(truck, label)| (label.to_owned(), format!("truck_{truck}_{what}")))
            .to_vec()
    };
    let nests: Vec<(String, String)> = [(1, "front"), (2, "rear")]
        .into_iter()
        .flat_map(|(truck, label)| {
            SIDES.map(|side| {
                let name = format!("truck_{truck}_{side}_nest_vertical_force");
                (format!("{label}, {side}"), name)
            })
        })
        .collect();
    let columns = |truck: usize| -> Vec<(String, String)> {
        WEDGE_NAMES
            .map(|wedge| {
                (
                    wedge.replace('_', " "),
                    format!("truck_{truck}_{wedge}_column_normal"),
                )
            })
            .to_vec()
    };
    vec![
        exhibit(
            "wheel_loads",
            "vertical wheel forces",
            &format!(
                "Vertical force of each wheel on its rail over the distance, normal to the track's plane, \
                 below {filter} Hz."
            ),
            of_wheels("vertical", ("vertical force", Kind::Force)),
        ),
        exhibit(
            "lateral_forces",
            "lateral wheel forces",
            &format!(
                "Lateral force of each wheel on its rail, positive where it spreads the gauge, below \
                 {filter} Hz."
            ),
            of_wheels("lateral", ("lateral force", Kind::Force)),
        ),
        exhibit(
            "l_over_v",
            "L/V of the wheels",
            &format!("Lateral over vertical force of each wheel, of the forces below {filter} Hz."),
            of_wheels("l_over_v", ("L/V", Kind::Dimensionless)),
        ),
        exhibit(
            "axles",
            "axles on the track",
            "Places of the axles from the track's center line, positive to the left, and their yaw against \
             the track.",
            vec![
                run.panel("(a) lateral", ("lateral", Kind::Length), &axles("lateral")),
                run.panel("(b) yaw", ("yaw", Kind::Angle), &axles("yaw")),
            ],
        ),
        exhibit(
            "body",
            "car body",
            &format!(
                "Roll of the body against the track, and its accelerations at the truck centers below {} Hz.",
                run.case.rules.acceleration_filter
            ),
            vec![
                run.panel("(a) roll", ("roll", Kind::Angle), &one("body", "body_roll")),
                run.panel(
                    "(b) lateral",
                    ("acceleration", Kind::RideAcceleration),
                    &ends("lateral_acceleration"),
                ),
                run.panel(
                    "(c) vertical",
                    ("acceleration", Kind::RideAcceleration),
                    &ends("vertical_acceleration"),
                ),
                run.panel("(d) speed", ("speed", Kind::TravelSpeed), &one("car", "speed")),
            ],
        ),
        exhibit(
            "trucks",
            "trucks",
            "Warp angle of each truck, and what its nests carry.",
            vec![
                run.panel(
                    "(a) warp angle",
                    ("warp angle", Kind::Angle),
                    &trucks("warp_angle"),
                ),
                run.panel("(b) nests", ("load", Kind::Force), &nests),
            ],
        ),
        exhibit(
            "wedges",
            "wedges",
            "Normal force of the column of each wedge.",
            vec![
                run.panel("(a) front truck", ("normal force", Kind::Force), &columns(1)),
                run.panel("(b) rear truck", ("normal force", Kind::Force), &columns(2)),
            ],
        ),
        exhibit(
            "energy_ledger",
            "energy ledger",
            "Work since the start and where it went; every loss is integrated from its own force and \
             velocity.",
            vec![
                run.panel(
                    "(a) entries",
                    ("energy", Kind::Energy),
                    &[
                        ("work of drive", "drive_work"),
                        ("lost in creep", "creep_loss"),
                        ("lost in friction", "friction_loss"),
                        ("lost in contact damping", "contact_damping_loss"),
                        ("lost in coils, stops, rails", "element_loss"),
                        ("stored, less that at the start", "stored_energy_change"),
                    ]
                    .map(|(label, name)| (label.to_owned(), name.to_owned())),
                ),
                run.panel(
                    "(b) residual",
                    ("energy", Kind::Energy),
                    &one("residual", "ledger_residual"),
                ),
            ],
        ),
    ]
}
