//! The view of a car's run: the body with its lading on two trucks whose wheels roll on the track, and what
//! its plots show.
//!
//! Trucks are as in a truck's run ([`super::truck`]), wheels, patches and rails as in a wheelset's
//! ([`super::rolling`]), each with the names of its columns. How far the body reaches is for the eye; a part
//! of the lading is a block whose center of gravity, length and width are those of the case, the latter by
//! its moments of inertia.

use std::sync::Arc;

use car::{Mass, Parameters, Wheels};
use study::car::CarCase;
use study::result::RunResult;
use truck::WEDGE_NAMES;
use wheelrail::profile::{Profile, ProfileError, nominal};
use wheelrail::track::RailLines;

use super::carriage::less;
use super::run::Plot;
use super::scene::{Look, Scene, SceneBody, Solid, SolidPose, SolidRole, extruded};
use super::{rolling, truck as three_piece};

const INCH: f64 = 0.0254;
/// Lengths of the track drawn behind the start and beyond the end, m.
const BEYOND: [f64; 2] = [60.0, 100.0];
/// Length of the arrow of a force that few exceed, m, and near a truck and a wedge.
const ARROWS: [f64; 3] = [0.5, 0.4, 0.25];
/// Of the body: how far it reaches beyond the trucks' centers, half its width, height of its floor and of
/// its top above the top of rail, thickness of its floor, m.
const BODY: [f64; 5] = [70.0 * INCH, 60.0 * INCH, 42.0 * INCH, 138.0 * INCH, 5.0 * INCH];
/// Thickness of walls, m.
const WALL: f64 = 1.5 * INCH;
/// The least edge of a part of the lading, m.
const EDGE: f64 = 0.3;
/// Names of the sides.
const SIDES: [&str; 2] = ["left", "right"];

/// Returns the scene; none if there are no profiles to draw.
#[must_use]
pub fn scene<S>(case: &CarCase, result: &RunResult<S>) -> Option<Scene> {
    let own = &case.parameters;
    let (wheels, rails) = profiles(own).ok()?;
    let half = 0.5 * own.truck_distance;
    let mut scene = Scene {
        factor: 1.0,
        limit: 0.1,
        arrow: ARROWS[0],
        looks: looks(own),
        follow: Some("car_body".to_owned()),
        ..Scene::default()
    };
    add_body(&mut scene, own);
    for (t, parameters) in own.trucks.iter().enumerate() {
        let prefix = format!("truck_{}_", t + 1);
        add_truck(&mut scene, parameters, &prefix);
    }
    let tape = tape_distance(own);
    for (axle, sides) in (1..=4).zip(&wheels) {
        let radius = own.axle_radius(axle - 1);
        let radii = match &own.wheels {
            Wheels::OnRails(wheels) => {
                let pairs = wheels.geometry[axle - 1].pairs();
                pairs.each_ref().map(|own| own.nominal_radius())
            }
            Wheels::Linear { .. } => [radius; 2],
        };
        let id = format!("axle_{axle}");
        let column = |name: &str| format!("axle_{axle}_{name}");
        let name = format!("wheelset {axle}");
        scene
            .bodies
            .extend(rolling::wheelset_bodies(&id, radius, &column));
        scene.solids.extend(rolling::wheelset_solids(
            &id,
            &name,
            sides.each_ref().map(|own| &**own),
            radii,
            tape,
        ));
        if matches!(own.wheels, Wheels::OnRails(_)) {
            scene.patches.extend(rolling::patches(&id, &column));
        }
    }
    for patch in &mut scene.patches {
        let axle = patch.body.replace('_', " ");
        patch.name = format!("{axle}, {}", patch.name);
    }
    let offsets = own.rail_offsets();
    scene.track = rolling::track_of_run(
        &RailLines::new(own.track.clone(), offsets),
        rails.each_ref().map(|own| &**own),
        offsets,
        (result.column("distance").unwrap_or_default(), half),
        BEYOND,
    );
    scene.round();
    Some(scene)
}

/// Profiles of the wheels (left, right) of four wheelsets, and of the rails.
type Profiles = ([[Arc<Profile>; 2]; 4], [Arc<Profile>; 2]);

/// Profiles of wheels and rails; nominal ones for the eye where wheels are linear.
fn profiles(own: &Parameters) -> Result<Profiles, ProfileError> {
    match &own.wheels {
        Wheels::OnRails(wheels) => Ok((wheels.wheels.clone(), wheels.rails.clone())),
        Wheels::Linear { .. } => {
            let (wheel, rail) = (Arc::new(nominal::aar_1b()?), Arc::new(nominal::rail_136re()?));
            let wheels = [[0; 2]; 4].map(|sides| sides.map(|_| wheel.clone()));
            Ok((wheels, [rail.clone(), rail]))
        }
    }
}

fn tape_distance(own: &Parameters) -> f64 {
    match &own.wheels {
        Wheels::OnRails(wheels) => wheels.tape_distance,
        Wheels::Linear { wheelset, .. } => 2.0 * wheelset.geometry.half_distance,
    }
}

/// Returns a point and the radius about it, from a direction.
fn near(name: &str, from: [f64; 3], at: [f64; 3], reach: f64, arrow: f64) -> Look {
    Look {
        at: Some((at, reach)),
        arrow: (arrow != ARROWS[0]).then_some(arrow),
        ..Look::all(name, from)
    }
}

fn looks(own: &Parameters) -> Vec<Look> {
    let half = 0.5 * own.truck_distance;
    let reach = half + BODY[0];
    let [x, ..] = own.center_of_gravity();
    // Places are counted from the center of gravity along the track.
    let front = [half - x, 0.0, 0.5];
    let rear = [-half - x, 0.0, 0.5];
    let [place, side, _] = own.trucks[0].geometry.wedge([1.0, 1.0]);
    let axle = own.trucks[0].geometry.axle();
    let rail = [half + axle - x, 0.5 * tape_distance(own), 0.0];
    let wedge = [half + place - x, side, 0.5];
    let [all, truck, corner] = ARROWS;
    vec![
        near("Oblique", [-1.0, 0.8, 0.42], [0.0, 0.0, 1.2], 0.95 * reach, all),
        near("Left side", [0.0, 1.0, 0.04], [0.0, 0.0, 1.5], 1.03 * reach, all),
        near("Along the track", [-1.0, 0.0, 0.1], [0.0, 0.0, 1.5], 4.0, all),
        near("Top", [0.0, 0.0, 1.0], [0.0, 0.0, 1.0], 1.03 * reach, all),
        near("Front truck", [0.5, 1.0, 0.25], front, 1.7, truck),
        near("Rear truck", [0.5, 1.0, 0.25], rear, 1.7, truck),
        near("Leading wedge, left", [0.12, 1.0, 0.12], wedge, 0.6, corner),
        near("Leading wheel, left", [1.0, 0.0, 0.12], rail, 0.12, 0.05),
    ]
}

/// The car body, its lading and the axes that they move in.
fn add_body(scene: &mut Scene, own: &Parameters) {
    let column = |name: &str| Some(name.to_owned());
    let center = own.center_of_gravity();
    let [_, aside, height] = center;
    scene.bodies.push(SceneBody {
        id: "car_body".to_owned(),
        along: column("distance"),
        position: [0.0, aside, height],
        coordinates: [
            None,
            column("body_lateral"),
            column("body_vertical"),
            column("body_turn_roll"),
            column("body_turn_pitch"),
            column("body_turn_yaw"),
        ],
        steady: [None, column("chord_lateral"), column("chord_vertical")],
        ..SceneBody::default()
    });
    let block = |id: &str, name: &str, role: SolidRole, at: [f64; 3], [length, width, high]: [f64; 3]| {
        let (l, h) = (0.5 * length, 0.5 * high);
        Solid {
            mount: SolidPose {
                position: less(at, center),
                angles: [0.0; 3],
            },
            ..extruded(
                (id, name, role, "car_body"),
                &[[-l, -h], [l, -h], [l, h], [-l, h]],
                width,
            )
        }
    };
    let [overhang, half_width, floor, top, thick] = BODY;
    let length = own.truck_distance + 2.0 * overhang;
    let (width, walls) = (2.0 * half_width, top - floor);
    let middle = 0.5 * (top + floor);
    let at = [0.0, 0.0, floor - 0.5 * thick];
    scene.solids.push(block(
        "floor",
        "floor of the car",
        SolidRole::Body,
        at,
        [length, width, thick],
    ));
    // Walls are one body of glass, through which the lading is seen.
    let mut hull = block(
        "walls",
        "walls of the car",
        SolidRole::Glass,
        [0.0, half_width, middle],
        [length, WALL, walls],
    );
    // Vertices are those of the first wall's mount.
    for (at, size) in [
        ([0.0, -2.0 * half_width, 0.0], [length, WALL, walls]),
        ([0.5 * length, -half_width, 0.0], [WALL, width, walls]),
        ([-0.5 * length, -half_width, 0.0], [WALL, width, walls]),
    ] {
        let mut wall = block("", "", SolidRole::Glass, [0.0; 3], size);
        for vertex in &mut wall.vertices {
            *vertex = std::array::from_fn(|k| vertex[k] + at[k]);
        }
        hull.join(wall);
    }
    for (number, mass) in own.lading.iter().enumerate() {
        let id = format!("lading_{}", number + 1);
        let part = block(&id, &mass.name, SolidRole::Lading, mass.place, edges(mass));
        scene.solids.push(part);
    }
    scene.solids.push(hull);
}

/// Edges of the block that is drawn for a part of the lading, m: length and width are those of a block of the
/// same density throughout that has its moments of inertia; it stands on the floor if its center of gravity
/// lies above it.
fn edges(mass: &Mass) -> [f64; 3] {
    let [x, y, z] = mass.inertia;
    let [length, width, high] =
        [y + z - x, x + z - y, x + y - z].map(|sum| (6.0 * sum / mass.mass).max(0.0).sqrt().max(EDGE));
    let [_, half_width, floor, ..] = BODY;
    let above = 2.0 * (mass.place[2] - floor);
    let high = if above > 0.0 { above } else { high };
    [length, width.min(2.0 * half_width), high]
}

/// A truck in the axes of the track at its bolster.
fn add_truck(scene: &mut Scene, parameters: &truck::Parameters, prefix: &str) {
    let frame = prefix.trim_end_matches('_').to_owned();
    let carriage = three_piece::carriage(parameters, prefix, &[None, None, None]);
    let contacts = carriage.wedges.iter().flat_map(|wedge| {
        carriage.faces(wedge, |face| {
            let own = |what: &str| format!("{}_{face}_{what}", wedge.key);
            let friction = ["x", "y", "z"].map(|axis| own(&format!("friction_on_wedge_{axis}")));
            (own("normal"), friction, own("state"))
        })
    });
    let Some(mut own) = carriage.scene(contacts.collect()) else {
        return;
    };
    scene.bodies.push(SceneBody {
        id: frame.clone(),
        along: Some(format!("{prefix}distance")),
        ..SceneBody::default()
    });
    for body in own.bodies.iter_mut().filter(|body| body.on.is_none()) {
        body.on = Some(frame.clone());
    }
    scene.bodies.append(&mut own.bodies);
    scene.solids.append(&mut own.solids);
    scene.coils.append(&mut own.coils);
    scene.contacts.append(&mut own.contacts);
}

/// Returns the quantities that its plots may show.
#[must_use]
pub fn plots<S>(result: &RunResult<S>) -> Vec<Plot> {
    let named = |title: &str, curves: Vec<(String, String)>| Plot {
        title: title.to_owned(),
        curves,
    };
    let wheels = |title: &str, truck: usize, what: &str| {
        let axles = [2 * truck - 1, 2 * truck].into_iter();
        let curves = axles.flat_map(|axle| {
            SIDES.map(|side| {
                (
                    format!("axle_{axle}_{side}_{what}"),
                    format!("axle {axle}, {side}"),
                )
            })
        });
        named(title, curves.collect())
    };
    let axles = |title: &str, what: &str| {
        let curve = |axle: usize| (format!("axle_{axle}_{what}"), format!("axle {axle}"));
        named(title, (1..=4).map(curve).collect())
    };
    let ends = |title: &str, what: &str| {
        let curve = |(end, label): (usize, &str)| (format!("body_at_truck_{end}_{what}"), label.to_owned());
        named(title, [(1, "front"), (2, "rear")].map(curve).to_vec())
    };
    let trucks = |title: &str, what: &str| {
        let curve = |(end, label): (usize, &str)| (format!("truck_{end}_{what}"), label.to_owned());
        named(title, [(1, "front"), (2, "rear")].map(curve).to_vec())
    };
    let nests = [(1, "front"), (2, "rear")].into_iter().flat_map(|(end, label)| {
        SIDES.map(|side| {
            let name = format!("truck_{end}_{side}_nest_vertical_force");
            (name, format!("{label}, {side}"))
        })
    });
    let wedges = |title: &str, truck: usize, what: &str| {
        let curve = |wedge: &str| (format!("truck_{truck}_{wedge}_{what}"), wedge.replace('_', " "));
        named(title, WEDGE_NAMES.map(curve).to_vec())
    };
    let one = |title: &str, name: &str, label: &str| Plot::new(title, [(name, label)]);
    let mut plots = vec![
        wheels("Vertical wheel forces, front truck", 1, "vertical"),
        wheels(
            "Lateral wheel forces, front truck, positive where they spread the gauge",
            1,
            "lateral",
        ),
        wedges("Normal forces of the columns, front truck", 1, "column_normal"),
        wheels("Vertical wheel forces, rear truck", 2, "vertical"),
        wheels("Lateral wheel forces, rear truck", 2, "lateral"),
        wheels("L/V, front truck", 1, "l_over_v"),
        wheels("L/V, rear truck", 2, "l_over_v"),
        axles("Axles, lateral, to the left", "lateral"),
        axles("Axles, yaw against the track", "yaw"),
        one("Roll of the body", "body_roll", "left side up"),
        ends("Lateral accelerations of the body", "lateral_acceleration"),
        ends("Vertical accelerations of the body", "vertical_acceleration"),
        trucks("Warp angles", "warp_angle"),
        trucks("Warp moments on the bolsters", "warp_moment"),
        named("Loads of the nests", nests.collect()),
        wedges("Normal forces of the columns, rear truck", 2, "column_normal"),
        wedges(
            "Column friction on the side frames, up, front truck",
            1,
            "column_friction_z",
        ),
        wedges(
            "Column friction on the side frames, up, rear truck",
            2,
            "column_friction_z",
        ),
        wheels("Wear numbers, front truck", 1, "wear_number"),
        wheels("Wear numbers, rear truck", 2, "wear_number"),
        one("Speed", "speed", "along the track"),
        one("Distance", "distance", "along the track"),
        Plot::new(
            "Energy ledger",
            [
                ("drive_work", "work of drive"),
                ("creep_loss", "lost in creep"),
                ("friction_loss", "lost in friction"),
                ("element_loss", "lost in coils, stops, rails"),
                ("stored_energy_change", "stored since the start"),
            ],
        ),
    ];
    for plot in &mut plots {
        plot.curves.retain(|(name, _)| result.column(name).is_some());
    }
    plots.retain(|plot| !plot.curves.is_empty());
    plots
}
