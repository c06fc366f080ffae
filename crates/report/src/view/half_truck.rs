//! What a half-truck's run looks like: bolster, side frames, wedges with their coils, springs.
//!
//! The comparison program's files have places, wedge angles and toes, but no sizes of bodies: these are for
//! the eye, with the wedge as large as the stand-alone one. Its wedges are massless and have no angles of
//! their own: they are drawn in the bolster's pocket, where they rise as the law says. The law has one state
//! a wedge, that of the friction at the column; the slope's friction follows it, and is shown with the same
//! state while it is pressed.

use std::collections::BTreeMap;

use mechanics::connection::{ColumnFace as Face, Law, Wedge};
use mechanics::output::Column;
use nucars::truck::Truck;
use quantity::Kind;
use study::half_truck::HalfTruckResult;
use wedge::parameters::Damping;

use super::run::Plot;
use super::scene::{
    End, FACTOR, Look, Role, Scene, SceneBody, SceneCoil, SceneContact, Solid, SolidPose, extruded,
};

const INCH: f64 = 0.0254;
/// Length of the springs as drawn, m.
const SPRING: f64 = 8.0 * INCH;
/// Radius of the springs as drawn, m.
const SPRING_RADIUS: f64 = 1.6 * INCH;
/// Width of a side frame as drawn, m.
const FRAME: f64 = 8.0 * INCH;

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

fn less(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

/// The scene; none without wedges.
#[must_use]
pub fn scene(truck: &Truck) -> Option<Scene> {
    let wedges = wedges(truck);
    let first = wedges.first()?;
    let size = wedge::thesis::parameters(Damping::Variable, 0.0, 0.0).wedge;
    let (height, width) = (size.height, size.width);
    let model = &truck.model;
    let center = |body: usize| model.bodies[body].frame.origin;
    let mut scene = Scene {
        factor: FACTOR,
        limit: 0.15 * height,
        arrow: 1.6 * height,
        looks: Vec::new(),
        bodies: Vec::new(),
        solids: Vec::new(),
        coils: Vec::new(),
        contacts: Vec::new(),
    };

    for (place, body) in model.bodies.iter().enumerate() {
        let carries = wedges.iter().any(|wedge| wedge.bolster == place);
        let held = wedges.iter().any(|wedge| wedge.side_frame == place);
        let free = &body.free;
        if !carries && !held {
            continue;
        }
        let id = body_id(truck, place);
        let names = mechanics::body::COORDINATES;
        let column = |k: usize| free[k].then(|| format!("{id}_{}", names[k]));
        scene.bodies.push(SceneBody {
            on: None,
            position: body.frame.origin,
            coordinates: std::array::from_fn(column),
            // The bolster goes up and down to scale.
            steady: [None, None, column(2).filter(|_| carries)],
            id,
        });
    }

    // Where bolster and springs end, below the wedges.
    let bottom = first.point[2] - 0.75 * height;
    let seat = bottom - SPRING;
    for bolster in distinct(wedges.iter().map(|wedge| wedge.bolster)) {
        let own: Vec<&Seen<'_>> = wedges.iter().filter(|wedge| wedge.bolster == bolster).collect();
        scene
            .solids
            .push(bolster_solid(truck, &own, (bottom, height, width)));
    }
    for side_frame in distinct(wedges.iter().map(|wedge| wedge.side_frame)) {
        let own: Vec<&Seen<'_>> = wedges
            .iter()
            .filter(|wedge| wedge.side_frame == side_frame)
            .collect();
        scene
            .solids
            .extend(side_frame_solids(truck, side_frame, &own, (seat, height)));
    }
    for (place, connection) in model.connections.iter().enumerate() {
        let Law::Springs(springs) = &connection.law else {
            continue;
        };
        let carried = wedges
            .iter()
            .any(|wedge| (wedge.bolster, wedge.side_frame) == (connection.a, connection.b));
        let [x, y, _] = connection.point;
        if !carried || !springs.iter().any(|(coordinate, _)| *coordinate == 2) {
            continue;
        }
        scene.coils.push(SceneCoil {
            name: format!("spring {}", truck.connections[place]),
            from: End {
                body: body_id(truck, connection.b),
                point: less([x, y, seat], center(connection.b)),
            },
            to: End {
                body: body_id(truck, connection.a),
                point: less([x, y, bottom], center(connection.a)),
            },
            nominal_length: SPRING,
            free_length: SPRING,
            radius: SPRING_RADIUS,
            turns: 5.0,
            force: None,
            length: None,
        });
    }
    for wedge in &wedges {
        add_wedge(&mut scene, truck, wedge, (height, width, seat));
    }
    scene.looks = looks(truck, &wedges, height);
    for solid in &mut scene.solids {
        // Sizes are for the eye: a micrometre will do, and is shorter to write.
        for part in solid.vertices.iter_mut().flatten() {
            *part = (*part * 1e6).round() / 1e6;
        }
    }
    Some(scene)
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

/// A beam across the track, whose sides are the slopes.
fn bolster_solid(truck: &Truck, own: &[&Seen<'_>], (bottom, height, width): (f64, f64, f64)) -> Solid {
    let place = own[0].bolster;
    let center = truck.model.bodies[place].frame.origin;
    let name = truck.model.bodies[place].name.clone();
    let side = |ahead: bool| -> Option<[[f64; 2]; 2]> {
        let wedge = own.iter().find(|wedge| (wedge.ahead > 0.0) == ahead)?;
        let tangent = libm::tan(wedge.law.angle);
        // The slope's line from the top of the wedge down.
        let at = |z: f64| {
            let below = wedge.point[2] + 0.5 * height - z;
            [
                wedge.point[0] - wedge.ahead * below * tangent - center[0],
                z - center[2],
            ]
        };
        Some([at(bottom), at(wedge.point[2] + 0.4 * height)])
    };
    let half = |k: usize, corner: usize| -> [f64; 2] {
        let own = side(k == 1);
        own.map_or_else(
            || [[-0.1, 0.1][k], [bottom, bottom + height][corner] - center[2]],
            |ends| ends[corner],
        )
    };
    let ys: Vec<f64> = own.iter().map(|wedge| wedge.point[1] - center[1]).collect();
    let reach = ys.iter().fold(0.0, |most: f64, y| most.max(y.abs()));
    let id = body_id(truck, place);
    Solid {
        name,
        ..extruded(
            (&id, "", Role::Pocket, &id),
            &[half(0, 0), half(1, 0), half(1, 1), half(0, 1)],
            2.0 * reach + 1.05 * width,
        )
    }
}

/// Columns, seat of the springs, top chord and arms to the axles.
fn side_frame_solids(
    truck: &Truck,
    body: usize,
    own: &[&Seen<'_>],
    (seat, height): (f64, f64),
) -> Vec<Solid> {
    let center = truck.model.bodies[body].frame.origin;
    let id = body_id(truck, body);
    let thick = 0.5 * height;
    let middle_z = own[0].point[2] - center[2];
    let (top, low) = (middle_z + 1.1 * height, seat - center[2]);
    let mut solids = Vec::new();
    for wedge in own {
        // The face is where the wedge's is, and turns about its middle.
        let ends = [0.0, wedge.ahead * thick];
        let (from, to) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let (above, below) = (0.95 * height, wedge.point[2] - seat);
        solids.push(Solid {
            mount: SolidPose {
                position: less(wedge.point, center),
                angles: [0.0, wedge.toe(), 0.0],
            },
            ..extruded(
                (
                    &format!("column_{}", wedge.number),
                    &format!("column at wedge {}", wedge.number),
                    Role::Column,
                    &id,
                ),
                &[[from, -below], [to, -below], [to, above], [from, above]],
                1.1 * FRAME,
            )
        });
    }
    let y = own[0].point[1] - center[1];
    let block = |what: &str, [from, to]: [f64; 2], [below, above]: [f64; 2]| Solid {
        mount: SolidPose {
            position: [0.0, y, 0.0],
            angles: [0.0; 3],
        },
        ..extruded(
            (
                &format!("{id}_{what}"),
                &format!("{what} of the side frame"),
                if what == "seat" { Role::Seat } else { Role::Column },
                &id,
            ),
            &[[from, below], [to, below], [to, above], [from, above]],
            FRAME,
        )
    };
    let faces = own.iter().map(|wedge| wedge.point[0] - center[0]);
    let (back, front) = faces.fold((0.0, 0.0), |(low, high): (f64, f64), x| (low.min(x), high.max(x)));
    let (back, front) = (back - thick, front + thick);
    solids.push(block("seat", [back, front], [low - 0.3 * height, low]));
    let mut chord = block("chord", [back, front], [top, top + 0.4 * height]);
    // Axles: where friction surfaces stand on the ground.
    let axles = truck.model.connections.iter().filter_map(|connection| {
        let on_it = connection.a == body && matches!(connection.law, Law::Surface(_));
        on_it.then(|| (connection.point[0] - center[0], connection.point[2] - center[2]))
    });
    let mut arms: BTreeMap<bool, (f64, f64)> = BTreeMap::new();
    for (x, z) in axles {
        arms.insert(x > 0.0, (x, z));
    }
    for (ahead, (x, z)) in arms {
        let ends = if ahead {
            [front, x + thick]
        } else {
            [x - thick, back]
        };
        join(&mut chord, block("arm", ends, [z, top + 0.4 * height]));
    }
    solids.push(chord);
    solids
}

/// Makes one solid of two on the same mount.
fn join(solid: &mut Solid, other: Solid) {
    let before = solid.vertices.len();
    solid.vertices.extend(other.vertices);
    let moved = other
        .triangles
        .into_iter()
        .map(|corners| corners.map(|corner| before + corner));
    solid.triangles.extend(moved);
}

/// The wedge in its pocket, its coil, and its two contacts.
fn add_wedge(scene: &mut Scene, truck: &Truck, wedge: &Seen<'_>, (height, width, seat): (f64, f64, f64)) {
    let center = |body: usize| truck.model.bodies[body].frame.origin;
    let (id, bolster, side_frame) = (
        wedge.id(),
        body_id(truck, wedge.bolster),
        body_id(truck, wedge.side_frame),
    );
    let (sine, cosine) = libm::sincos(wedge.law.angle);
    let (ahead, half) = (wedge.ahead, 0.5 * height);
    let length = height * sine / cosine;
    scene.bodies.push(SceneBody {
        id: id.clone(),
        on: Some(bolster.clone()),
        position: less(wedge.point, center(wedge.bolster)),
        coordinates: [
            Some(format!("{id}_shift")),
            None,
            Some(format!("{id}_rise")),
            None,
            None,
            None,
        ],
        steady: [None, None, None],
    });
    let mut outline = [[0.0, -half], [-ahead * length, -half], [0.0, half]];
    if ahead > 0.0 {
        outline.swap(0, 1);
    }
    scene.solids.push(extruded(
        (&id, &format!("wedge {}", wedge.number), Role::Wedge, &id),
        &outline,
        0.7 * width,
    ));

    let at = wedge.point[0] - 0.5 * ahead * length;
    let (on, on_id, foot) = if wedge.law.coil_in_bolster {
        // A seat in the pocket.
        let foot = wedge.point[2] - half - 0.6 * (wedge.point[2] - half - seat);
        let radius = 0.5 * length;
        scene.solids.push(Solid {
            mount: SolidPose {
                position: less([at, wedge.point[1], foot], center(wedge.bolster)),
                angles: [0.0; 3],
            },
            ..extruded(
                (
                    &format!("seat_{}", wedge.number),
                    "seat of the coil in the bolster",
                    Role::Seat,
                    &bolster,
                ),
                &[
                    [-radius, -0.1 * height],
                    [radius, -0.1 * height],
                    [radius, 0.0],
                    [-radius, 0.0],
                ],
                2.0 * radius,
            )
        });
        (wedge.bolster, bolster, foot)
    } else {
        (wedge.side_frame, side_frame, seat)
    };
    let nominal = wedge.point[2] - half - foot;
    scene.coils.push(SceneCoil {
        name: format!("control coil of wedge {}", wedge.number),
        from: End {
            body: on_id,
            point: less([at, wedge.point[1], foot], center(on)),
        },
        to: End {
            body: id.clone(),
            point: [-0.5 * ahead * length, 0.0, -half],
        },
        nominal_length: nominal,
        free_length: nominal,
        radius: 0.35 * length,
        turns: 5.0,
        force: Some(format!("{id}_coil_force")),
        length: None,
    });
    let contact = |face: &str, point, on: String, normal| SceneContact {
        id: format!("{id}_{face}"),
        name: format!("wedge {}, {face}", wedge.number),
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
    let bolster = body_id(truck, wedge.bolster);
    let column = format!("column_{}", wedge.number);
    scene.contacts.extend([
        contact("column", [0.0; 3], column, [-ahead, 0.0, 0.0]),
        contact(
            "slope",
            [-0.5 * ahead * length, 0.0, 0.0],
            bolster,
            [ahead * cosine, 0.0, -sine],
        ),
    ]);
}

fn looks(truck: &Truck, wedges: &[Seen<'_>], height: f64) -> Vec<Look> {
    let count = wedges.len().max(1) as f64;
    let middle: [f64; 3] =
        std::array::from_fn(|k| wedges.iter().map(|wedge| wedge.point[k]).sum::<f64>() / count);
    // Half the length and width of what is seen.
    let surfaces = truck.model.connections.iter();
    let surfaces = surfaces.filter(|connection| matches!(connection.law, Law::Surface(_)));
    let far = |points: &mut dyn Iterator<Item = [f64; 3]>, k: usize| {
        points.fold(6.0 * height, |most: f64, point| {
            most.max((point[k] - middle[k]).abs())
        })
    };
    let length = far(&mut surfaces.map(|connection| connection.point), 0);
    let width = far(&mut wedges.iter().map(|wedge| wedge.point), 1);
    let near = |name: &str, at: [f64; 3], radius: f64, from| Look {
        at: Some((at, radius)),
        ..Look::all(name, from)
    };
    let all = 0.85 * length.hypot(width);
    let mut looks = vec![
        near("Oblique", middle, all, [0.55, 0.9, 0.42]),
        near("Left side", middle, 1.1 * length, [0.0, 1.0, 0.0]),
        near("Along the track", middle, 1.2 * width, [-1.0, 0.0, 0.0]),
        near("Top", middle, all, [0.0, 0.0, 1.0]),
    ];
    if let Some(first) = wedges.first() {
        let name = format!("Wedge {}", first.number);
        looks.push(near(&name, first.point, 2.2 * height, [0.12, 1.0, 0.12]));
    }
    looks
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
