//! The view of a half-truck's run: bolster, side frames, wedges with their coils, springs.
//!
//! The comparison program's files have places, wedge angles and toes, but no sizes of bodies: its wedges are
//! as large as the stand-alone one, all else is for the eye. They are massless and have no angles of their
//! own: they are drawn in the bolster's pocket, where they rise as the law says. The law has one state a
//! wedge, that of the friction at the column; the slope's friction follows it, and is shown with the same
//! state while it is pressed. Wedges that are bodies are as large as they are, at their places, with the
//! forces of their corners.

use mechanics::connection::{ColumnFace as Face, Law, SpringDamper};
use mechanics::output::Column;
use mechanics::system::System;
use nucars::truck::Truck;
use quantity::Kind;
use study::contacts::corners;
use study::half_truck::{HalfTruckCase, HalfTruckResult};
use wedge::parameters::Damping;

use super::carriage::{CORNER_ARROW, Carriage, CarriagePart, DrawnSpring, DrawnWedge, less};
use super::run::Plot;
use super::scene::{Scene, SceneBody, SceneContact};

/// A wedge with what is drawn of it.
struct Seen {
    number: u32,
    angle: f64,
    /// The column's inclination against the vertical: a turn about y, rad.
    toe: f64,
    /// Distance of its column from its vertical face, m.
    wear: f64,
    /// Height and width as drawn, m.
    size: [f64; 2],
    coil_in_bolster: bool,
    bolster: usize,
    side_frame: usize,
    /// The place of its connection in the drawn layout, m.
    place: [f64; 3],
    /// From there to the middle of its vertical face, m.
    offset: [f64; 3],
    /// +1: the column lies ahead of it (+x), -1: behind.
    ahead: f64,
    is_body: bool,
}

impl Seen {
    fn id(&self) -> String {
        format!("wedge_{}", self.number)
    }
}

/// Returns all wedges, by their places.
fn wedges(case: &HalfTruckCase) -> Vec<Seen> {
    let truck = &case.truck;
    let all = case.wedges();
    let connection = |place: usize| &truck.model.connections[place];
    let middle = all.iter().map(|place| connection(*place).point[0]).sum::<f64>() / all.len().max(1) as f64;
    let size = wedge::thesis::parameters(Damping::Variable, 0.0, 0.0).wedge;
    let seen = |place: usize| {
        let (own, number) = (connection(place), truck.connections[place]);
        if let Some(body) = case.wedge_body(place) {
            let wedge = &body.wedge;
            let third = wedge.height * libm::tan(wedge.angle) / 3.0;
            return Some(Seen {
                number,
                angle: wedge.angle,
                toe: -body.end * wedge.toe,
                wear: wedge.wear.column,
                size: [wedge.height, wedge.width],
                coil_in_bolster: body.damping == Damping::Constant,
                bolster: body.bolster,
                side_frame: body.side_frame,
                place: body.center,
                offset: [body.end * third, 0.0, wedge.height / 6.0],
                ahead: body.end,
                is_body: true,
            });
        }
        let Law::Wedge(law) = &own.law else { return None };
        let (ahead, toe) = match &law.column {
            Face::Profile { direction, depth } => {
                let slope = depth.slopes().get(depth.piece(0.0)).copied().unwrap_or(0.0);
                (*direction, direction * libm::atan(slope))
            }
            Face::Plain { .. } => (f64::copysign(1.0, own.point[0] - middle), 0.0),
        };
        Some(Seen {
            number,
            angle: law.angle,
            toe,
            wear: 0.0,
            size: [size.height, 0.7 * size.width],
            coil_in_bolster: law.coil_in_bolster,
            bolster: own.a,
            side_frame: own.b,
            place: own.point,
            offset: [0.0; 3],
            ahead,
            is_body: false,
        })
    };
    all.into_iter().filter_map(seen).collect()
}

/// Columns that the scene needs of massless wedges and the table does not have: parts of forces in the fixed
/// axes, states of slopes, the wedges' shift.
#[must_use]
pub fn drawn(case: &HalfTruckCase, result: &HalfTruckResult) -> (Vec<Column>, Vec<Vec<f64>>) {
    let (mut columns, mut values) = (Vec::new(), Vec::new());
    for wedge in wedges(case).iter().filter(|wedge| !wedge.is_body) {
        let id = wedge.id();
        let of = |what: &str| result.column(&format!("{id}_{what}")).unwrap_or_default();
        let scaled =
            |what: &str, factor: f64| of(what).iter().map(|value| factor * value).collect::<Vec<f64>>();
        let (sine, cosine) = libm::sincos(wedge.angle);
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

/// Returns the scene; none without wedges.
#[must_use]
pub fn scene(case: &HalfTruckCase) -> Option<Scene> {
    let truck = &case.truck;
    let wedges = wedges(case);
    let [height, _] = wedges.first()?.size;
    let model = &truck.model;
    let bolsters = distinct(wedges.iter().map(|wedge| wedge.bolster));
    let side_frames = distinct(wedges.iter().map(|wedge| wedge.side_frame));
    let names = mechanics::body::COORDINATES;
    let column = |body: usize, k: usize| {
        let id = body_id(truck, body);
        model.bodies[body].free[k].then(|| format!("{id}_{}", names[k]))
    };
    let part = |place: &usize| CarriagePart {
        id: body_id(truck, *place),
        name: model.bodies[*place].name.clone(),
        center: model.bodies[*place].frame.origin,
        coordinates: std::array::from_fn(|k| column(*place, k)),
        // The bolster goes up and down to scale.
        steady: [None, None, column(*place, 2).filter(|_| bolsters.contains(place))],
    };
    let place_in = |list: &[usize], body: usize| list.iter().position(|own| *own == body);
    let springs = model
        .connections
        .iter()
        .enumerate()
        .filter_map(|(place, connection)| {
            // Where wedges are bodies, connections that only measure are left.
            let Law::Springs(springs) = &connection.law else {
                return None;
            };
            let carries = wedges
                .iter()
                .any(|wedge| (wedge.bolster, wedge.side_frame) == (connection.a, connection.b));
            let pushes = |(coordinate, own): &(usize, SpringDamper)| *coordinate == 2 && own.spring.is_some();
            if !carries || !springs.iter().any(pushes) {
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
        let own = |what: &str| Some(format!("{id}_{what}"));
        let body = if wedge.is_body {
            SceneBody {
                position: wedge.place,
                coordinates: names.map(own),
                // It goes with its pocket.
                steady: [None, None, column(wedge.bolster, 2)],
                id: id.clone(),
                ..SceneBody::default()
            }
        } else {
            SceneBody {
                on: Some(body_id(truck, wedge.bolster)),
                position: less(wedge.place, model.bodies[wedge.bolster].frame.origin),
                coordinates: [own("shift"), None, own("rise"), None, None, None],
                id: id.clone(),
                ..SceneBody::default()
            }
        };
        Some(DrawnWedge {
            key: wedge.number.to_string(),
            name: format!("wedge {}", wedge.number),
            body,
            offset: wedge.offset,
            point: std::array::from_fn(|k| wedge.place[k] + wedge.offset[k]),
            ahead: wedge.ahead,
            angle: wedge.angle,
            across: 0.0,
            leans: [0.0; 2],
            toe: wedge.toe,
            wear: wedge.wear,
            size: wedge.size,
            bolster: place_in(&bolsters, wedge.bolster)?,
            side_frame: place_in(&side_frames, wedge.side_frame)?,
            has_coil: true,
            coil_in_bolster: wedge.coil_in_bolster,
            coil_force: own("coil_force"),
        })
    });
    let carriage = Carriage {
        wedges: drawn.collect(),
        bolsters: bolsters.iter().map(part).collect(),
        side_frames: side_frames.iter().map(part).collect(),
        springs: springs.collect(),
        axles: axles.collect(),
        limit: 0.15 * height,
    };
    let massless = wedges
        .iter()
        .zip(&carriage.wedges)
        .filter(|(own, _)| !own.is_body);
    let mut contacts: Vec<SceneContact> = massless
        .flat_map(|(_, wedge)| carriage.faces(wedge, |face| columns_of_massless(&wedge.body.id, face)))
        .collect();
    let corners_start = contacts.len();
    if !case.wedge_bodies.is_empty() {
        let system = System::new(model.clone()).ok()?;
        let wedges: Vec<usize> = (truck.bodies.len()..model.bodies.len()).collect();
        let own = corners(&system, &wedges);
        let wedge_of = |body: usize| {
            let number = case
                .wedge_bodies
                .iter()
                .find(|wedge| wedge.body == body)?
                .connection;
            let key = truck.connections[number].to_string();
            carriage.wedges.iter().find(|wedge| wedge.key == key)
        };
        contacts.extend(carriage.corners(&system, own, wedge_of));
    }
    let mut scene = carriage.scene(contacts)?;
    if scene.contacts.len() > corners_start {
        // There are four corners to a face, not one contact.
        scene.arrow *= CORNER_ARROW;
    }
    Some(scene)
}

/// Names of normal force, friction and state of a face of a massless wedge.
fn columns_of_massless(id: &str, face: &str) -> (String, [String; 3], String) {
    let (friction, state) = match face {
        "column" => (
            ["x", "y", "z"].map(|axis| format!("{id}_column_friction_{axis}")),
            format!("{id}_state"),
        ),
        _ => (
            [
                format!("{id}_slope_friction_x"),
                format!("{id}_column_friction_x"),
                format!("{id}_slope_friction_z"),
            ],
            format!("{id}_slope_state"),
        ),
    };
    (format!("{id}_{face}_normal_force"), friction, state)
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

/// Returns the quantities that its plots may show.
#[must_use]
pub fn plots(case: &HalfTruckCase, result: &HalfTruckResult) -> Vec<Plot> {
    let truck = &case.truck;
    let wedges = wedges(case);
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
            .zip(labels.iter().map(String::as_str))
            .filter(|(name, _)| result.column(name).is_some());
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
        of_all("Wedges, lateral", "y"),
        of_all("Wedges, roll", "roll"),
        of_all("Wedges, pitch", "pitch"),
        of_all("Wedges, yaw", "yaw"),
        of_all("Energy lost at the columns", "column_friction_loss"),
        of_all("Energy lost at the slopes", "slope_friction_loss"),
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
