//! What a half-truck's run looks like: bolster, side frames, wedges with their coils, springs.
//!
//! The comparison program's files have places, wedge angles and toes, but no sizes of bodies: the wedges are as
//! large as the stand-alone one, all else is for the eye. Its wedges are massless and have no angles of
//! their own: they are drawn in the bolster's pocket, where they rise as the law says. The law has one state
//! a wedge, that of the friction at the column; the slope's friction follows it, and is shown with the same
//! state while it is pressed.

use mechanics::connection::{ColumnFace as Face, Law, Wedge};
use mechanics::output::Column;
use nucars::truck::Truck;
use quantity::Kind;
use study::half_truck::HalfTruckResult;
use wedge::parameters::Damping;

use super::carriage::{Carriage, DrawnSpring, DrawnWedge, Part, less};
use super::run::Plot;
use super::scene::{Scene, SceneBody, SceneContact};

/// A wedge with what is drawn of it.
struct Seen<'t> {
    number: u32,
    law: &'t Wedge,
    bolster: usize,
    side_frame: usize,
    point: [f64; 3],
    /// +1: the column lies ahead of it (+x), -1: behind.
    ahead: f64,
}

impl Seen<'_> {
    fn id(&self) -> String {
        format!("wedge_{}", self.number)
    }

    /// The column's inclination against the vertical: a turn about y.
    fn toe(&self) -> f64 {
        match &self.law.column {
            Face::Plain { .. } => 0.0,
            Face::Profile { depth, .. } => {
                self.ahead * libm::atan(depth.slopes().get(depth.piece(0.0)).copied().unwrap_or(0.0))
            }
        }
    }
}

/// All wedges, by their places.
fn wedges(truck: &Truck) -> Vec<Seen<'_>> {
    let all: Vec<usize> = truck.wedges().collect();
    let connection = |place: &usize| &truck.model.connections[*place];
    let middle = all.iter().map(|place| connection(place).point[0]).sum::<f64>() / all.len().max(1) as f64;
    let seen = |place: &usize| {
        let own = connection(place);
        let Law::Wedge(law) = &own.law else { return None };
        let ahead = match &law.column {
            Face::Profile { direction, .. } => *direction,
            Face::Plain { .. } => f64::copysign(1.0, own.point[0] - middle),
        };
        Some(Seen {
            number: truck.connections[*place],
            law,
            bolster: own.a,
            side_frame: own.b,
            point: own.point,
            ahead,
        })
    };
    all.iter().filter_map(seen).collect()
}

/// Columns that the scene needs and the table does not have: parts of forces in the fixed axes, states of
/// slopes, the wedges' shift.
#[must_use]
pub fn drawn(truck: &Truck, result: &HalfTruckResult) -> (Vec<Column>, Vec<Vec<f64>>) {
    let (mut columns, mut values) = (Vec::new(), Vec::new());
    for wedge in wedges(truck) {
        let id = wedge.id();
        let of = |what: &str| result.column(&format!("{id}_{what}")).unwrap_or_default();
        let scaled =
            |what: &str, factor: f64| of(what).iter().map(|value| factor * value).collect::<Vec<f64>>();
        let (sine, cosine) = libm::sincos(wedge.law.angle);
        let state = of("state").iter().zip(of("slope_normal_force"));
        let drawn = [
            (
                "shift",
                Kind::Length,
                "longitudinal shift of the wedge in its pocket, from its rise",
                scaled("rise", wedge.ahead * sine / cosine),
            ),
            (
                "column_friction_x",
                Kind::Force,
                "longitudinal friction of the column on the wedge, toe left aside",
                vec![0.0; of("state").len()],
            ),
            (
                "column_friction_y",
                Kind::Force,
                "lateral friction of the column on the wedge",
                scaled("lateral_force", -1.0),
            ),
            (
                "column_friction_z",
                Kind::Force,
                "vertical friction of the column on the wedge",
                scaled("column_friction", -1.0),
            ),
            (
                "slope_friction_x",
                Kind::Force,
                "longitudinal friction of the slope on the wedge",
                scaled("slope_friction", wedge.ahead * sine),
            ),
            (
                "slope_friction_z",
                Kind::Force,
                "vertical friction of the slope on the wedge",
                scaled("slope_friction", cosine),
            ),
            (
                "slope_state",
                Kind::Count,
                "state shown at the slope: that of the wedge's friction while the slope presses, else open",
                state
                    .map(|(state, normal)| if *normal > 0.0 { *state } else { 0.0 })
                    .collect(),
            ),
        ];
        for (name, kind, text, own) in drawn {
            columns.push(Column {
                name: format!("{id}_{name}"),
                kind,
                frame: "x forward, y left, z up".into(),
                reference: "".into(),
                text: text.to_owned(),
            });
            values.push(own);
        }
    }
    (columns, values)
}

fn body_id(truck: &Truck, body: usize) -> String {
    format!("body_{}", truck.bodies[body])
}

/// The scene; none without wedges.
#[must_use]
pub fn scene(truck: &Truck) -> Option<Scene> {
    let wedges = wedges(truck);
    let size = wedge::thesis::parameters(Damping::Variable, 0.0, 0.0).wedge;
    let model = &truck.model;
    let bolsters = distinct(wedges.iter().map(|wedge| wedge.bolster));
    let side_frames = distinct(wedges.iter().map(|wedge| wedge.side_frame));
    let part = |place: &usize| {
        let body = &model.bodies[*place];
        let id = body_id(truck, *place);
        let names = mechanics::body::COORDINATES;
        let column = |k: usize| body.free[k].then(|| format!("{id}_{}", names[k]));
        Part {
            name: body.name.clone(),
            center: body.frame.origin,
            coordinates: std::array::from_fn(column),
            // The bolster goes up and down to scale.
            steady: [None, None, column(2).filter(|_| bolsters.contains(place))],
            id,
        }
    };
    let place_in = |list: &[usize], body: usize| list.iter().position(|own| *own == body);
    let springs = model
        .connections
        .iter()
        .enumerate()
        .filter_map(|(place, connection)| {
            let Law::Springs(springs) = &connection.law else {
                return None;
            };
            let carries = wedges
                .iter()
                .any(|wedge| (wedge.bolster, wedge.side_frame) == (connection.a, connection.b));
            if !carries || !springs.iter().any(|(coordinate, _)| *coordinate == 2) {
                return None;
            }
            let [x, y, _] = connection.point;
            Some(DrawnSpring {
                name: format!("spring {}", truck.connections[place]),
                at: [x, y],
                bolster: place_in(&bolsters, connection.a)?,
                side_frame: place_in(&side_frames, connection.b)?,
            })
        });
    // Axles: where friction surfaces stand on the ground.
    let axles = model.connections.iter().filter_map(|connection| {
        let on = matches!(connection.law, Law::Surface(_)).then_some(connection.a)?;
        Some((place_in(&side_frames, on)?, connection.point))
    });
    let drawn = wedges.iter().filter_map(|wedge| {
        let id = wedge.id();
        let column = |what: &str| Some(format!("{id}_{what}"));
        Some(DrawnWedge {
            key: wedge.number.to_string(),
            name: format!("wedge {}", wedge.number),
            body: SceneBody {
                on: Some(body_id(truck, wedge.bolster)),
                along: None,
                spin: None,
                position: less(wedge.point, model.bodies[wedge.bolster].frame.origin),
                coordinates: [column("shift"), None, column("rise"), None, None, None],
                steady: [None, None, None],
                id: id.clone(),
            },
            offset: [0.0; 3],
            point: wedge.point,
            ahead: wedge.ahead,
            angle: wedge.law.angle,
            toe: wedge.toe(),
            wear: 0.0,
            size: [size.height, 0.7 * size.width],
            bolster: place_in(&bolsters, wedge.bolster)?,
            side_frame: place_in(&side_frames, wedge.side_frame)?,
            coil_in_bolster: wedge.law.coil_in_bolster,
            coil_force: column("coil_force"),
        })
    });
    let carriage = Carriage {
        wedges: drawn.collect(),
        bolsters: bolsters.iter().map(part).collect(),
        side_frames: side_frames.iter().map(part).collect(),
        springs: springs.collect(),
        axles: axles.collect(),
        limit: 0.15 * size.height,
    };
    let contacts = carriage.wedges.iter().flat_map(|wedge| {
        let id = &wedge.body.id;
        let bolster = &carriage.bolsters[wedge.bolster].id;
        let contact = |face: &str, point, on: String, normal| SceneContact {
            id: format!("{id}_{face}"),
            name: format!("{}, {face}", wedge.name),
            body: id.clone(),
            point,
            on,
            normal,
            normal_force: format!("{id}_{face}_normal_force"),
            friction: match face {
                "column" => ["x", "y", "z"].map(|axis| format!("{id}_column_friction_{axis}")),
                _ => [
                    format!("{id}_slope_friction_x"),
                    format!("{id}_column_friction_x"),
                    format!("{id}_slope_friction_z"),
                ],
            },
            state: match face {
                "column" => format!("{id}_state"),
                _ => format!("{id}_slope_state"),
            },
            gap: None,
        };
        [
            contact("column", [0.0; 3], wedge.column(), [-wedge.ahead, 0.0, 0.0]),
            contact(
                "slope",
                wedge.middle_of_slope(),
                bolster.clone(),
                wedge.slope_normal(),
            ),
        ]
    });
    carriage.scene(contacts.collect())
}

fn distinct(all: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut found = Vec::new();
    for one in all {
        if !found.contains(&one) {
            found.push(one);
        }
    }
    found
}

/// What its plots may show.
#[must_use]
pub fn plots(truck: &Truck) -> Vec<Plot> {
    let wedges = wedges(truck);
    let labels: Vec<String> = wedges
        .iter()
        .map(|wedge| format!("wedge {}", wedge.number))
        .collect();
    let of_all = |title: &str, what: &str| {
        let names: Vec<String> = wedges
            .iter()
            .map(|wedge| format!("{}_{what}", wedge.id()))
            .collect();
        let curves = names
            .iter()
            .map(String::as_str)
            .zip(labels.iter().map(String::as_str));
        Plot::new(title, curves)
    };
    let mut plots = vec![
        of_all("Column friction on the side frame, up", "column_friction"),
        of_all("Normal forces of the columns", "column_normal_force"),
        of_all("Strokes, vertical", "stroke"),
        of_all("Vertical forces on the side frames", "vertical_force"),
        of_all("Normal forces of the slopes", "slope_normal_force"),
        of_all("Friction of the slopes, up", "slope_friction"),
        of_all("Coil forces", "coil_force"),
        of_all("Rises of the wedges", "rise"),
        of_all("Jammed", "jammed"),
        of_all("States: 0 open, 1 stick, 2 slip", "state"),
    ];
    let mut bodies: Vec<usize> = distinct(wedges.iter().map(|wedge| wedge.bolster));
    bodies.extend(distinct(wedges.iter().map(|wedge| wedge.side_frame)));
    for body in bodies {
        let free = &truck.model.bodies[body].free;
        let (id, name) = (body_id(truck, body), &truck.model.bodies[body].name);
        let names = mechanics::body::COORDINATES;
        for (what, range) in [("displacements", 0..3), ("angles", 3..6)] {
            let own: Vec<String> = range
                .clone()
                .filter(|k| free[*k])
                .map(|k| format!("{id}_{}", names[k]))
                .collect();
            let labels = range.filter(|k| free[*k]).map(|k| names[k]);
            if !own.is_empty() {
                plots.push(Plot::new(
                    &format!("{name}: {what}"),
                    own.iter().map(String::as_str).zip(labels),
                ));
            }
        }
    }
    plots.retain(|plot| !plot.curves.is_empty());
    plots
}
