//! The view of a truck's run: bolster, side frames, wedges with their corners and coils, springs, wheelsets,
//! and what stands on the bolster.
//!
//! Wedges are as large as they are; wheelsets, car body and the rest are for the eye.

use std::f64::consts::PI;

use ::truck::{
    BOLSTER, CAR_BODY, ControlCoil, Mount, Parameters, SIDE_FRAMES, Truck, WEDGE_NAMES, WHEELSETS,
};
use mechanics::body::Body;
use study::contacts::corners;
use study::truck::TruckCase;
use study::truck::run::TruckResult;
use study::truck::warp::PARTS;
use wedge::parameters::Damping;

use super::carriage::{CORNER_ARROW, Carriage, CarriagePart, DrawnSpring, DrawnWedge};
use super::run::Plot;
use super::scene::{Scene, SceneBody, Solid, SolidPose, SolidRole, extruded};

const INCH: f64 = 0.0254;
/// The factor by which displacements are exaggerated at first: a warp of 20 mrad is then as large as the eye
/// takes for small.
const FACTOR: f64 = 5.0;
/// The exaggerated size beyond which displacements grow to scale, m.
const LIMIT: f64 = 4.0 * INCH;
/// Radius of axles, width and place of wheels as drawn, m.
const WHEEL: [f64; 3] = [3.5 * INCH, 5.0 * INCH, 29.5 * INCH];
/// Height of the floor of what stands on the bolster, as drawn, m: that of the center plate; its half length,
/// half width and thickness.
const FLOOR: [f64; 4] = [30.0 * INCH, 22.0 * INCH, 58.0 * INCH, 5.0 * INCH];
/// Names of coordinates in columns.
const COORDINATES: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];
/// Faces of wedges.
const FACES: [&str; 2] = ["column", "slope"];

fn columns_of(name: &str) -> [Option<String>; 6] {
    COORDINATES.map(|what| Some(format!("{name}_{what}")))
}

/// Returns a body's center of gravity in the nominal position, m.
fn nominal(body: &Body) -> [f64; 3] {
    std::array::from_fn(|k| body.frame.origin[k] + body.center_of_gravity[k])
}

/// Returns a name as people say it.
fn words(name: &str) -> String {
    name.replace('_', " ")
}

/// Returns the solids of a truck without its wheels and load. Names of bodies and columns begin with
/// `prefix`; bolster and wedges have these columns of travel.
pub(super) fn carriage(parameters: &Parameters, prefix: &str, travel: &[Option<String>; 3]) -> Carriage {
    let bodies = ::truck::bodies(parameters, [0.0; 3]);
    let part = |name: &str, body: usize, steady: &[Option<String>; 3]| {
        let id = format!("{prefix}{name}");
        CarriagePart {
            name: words(&id),
            center: nominal(&bodies[body]),
            coordinates: columns_of(&id),
            steady: steady.clone(),
            id,
        }
    };
    let still = [None, None, None];
    let names = ["left_side_frame", "right_side_frame"];
    let geometry = &parameters.geometry;
    let (side, journal, axle) = (geometry.nest(), geometry.journal(), geometry.axle());
    let parts = parameters.wedge_parts();
    let wedges = parts.iter().map(|part| {
        let (number, name, own) = (part.wedge, &part.name, &part.own);
        let (ahead, way) = (
            if number < 2 { 1.0 } else { -1.0 },
            if number.is_multiple_of(2) { 1.0 } else { -1.0 },
        );
        let third = own.height * libm::tan(own.angle) / 3.0;
        let [x, y, height] = geometry.wedge([ahead, way]);
        let at = [x, y + part.shift, height];
        let offset = [ahead * third, 0.0, own.height / 6.0];
        let key = format!("{prefix}{name}");
        DrawnWedge {
            name: format!("{} wedge", words(&key)),
            body: SceneBody {
                id: format!("{key}_wedge"),
                position: at,
                coordinates: columns_of(&key),
                steady: travel.clone(),
                ..SceneBody::default()
            },
            key,
            offset,
            point: std::array::from_fn(|k| at[k] + offset[k]),
            ahead,
            angle: own.angle,
            across: part.pushed() * own.slope_across,
            leans: part.leans(),
            toe: -ahead * own.toe,
            wear: own.wear.column,
            size: [own.height, own.width],
            bolster: 0,
            side_frame: number % 2,
            has_coil: own.control_coil != ControlCoil::Nothing,
            coil_in_bolster: parameters.damping == Damping::Constant,
            coil_force: None,
        }
    });
    let mut springs: Vec<DrawnSpring> = Vec::new();
    for (side_frame, (coils, way)) in parameters.load_coils.iter().zip([1.0, -1.0]).enumerate() {
        for coil in coils {
            let at = [coil.place[0], way * side + coil.place[1]];
            // Outer and inner coils stand in each other.
            if !springs.iter().any(|spring| spring.at == at) {
                springs.push(DrawnSpring {
                    name: format!("{}load coil {}", words(prefix), springs.len() + 1),
                    at,
                    bolster: 0,
                    side_frame,
                });
            }
        }
    }
    let high = geometry.adapter_height;
    let axles = [axle, -axle]
        .into_iter()
        .flat_map(|x| [(0, [x, journal, high]), (1, [x, -journal, high])]);
    Carriage {
        bolsters: vec![part("bolster", BOLSTER, travel)],
        side_frames: [0, 1].map(|k| part(names[k], SIDE_FRAMES + k, &still)).to_vec(),
        wedges: wedges.collect(),
        springs,
        axles: axles.collect(),
        limit: LIMIT,
    }
}

/// Returns the scene; none if the case makes no truck.
#[must_use]
pub fn scene(case: &TruckCase) -> Option<Scene> {
    let parameters = &case.parameters;
    let truck = Truck::new(parameters).ok()?;
    let system = &truck.system;
    let center = |body: usize| nominal(&system.bodies()[body]);
    // Bolster and wedges travel together, to scale.
    let travel = [None, Some("bolster_y".to_owned()), Some("bolster_z".to_owned())];
    let carriage = carriage(parameters, "", &travel);
    let numbers = Mount::alone(parameters).bodies;
    let parts = parameters.wedge_parts().into_iter();
    let bodies: Vec<usize> = parts.map(|part| numbers[part.number]).collect();
    let own = corners(system, &bodies);
    let wedge_of = |body: usize| carriage.wedges.get(bodies.iter().position(|own| *own == body)?);
    let contacts = carriage.corners(system, own, wedge_of);
    let mut scene = carriage.scene(contacts)?;
    scene.factor = FACTOR;
    // There are four corners to a face, not one contact.
    scene.arrow *= CORNER_ARROW;
    let mut add_body = |id: &str, body: usize| {
        scene.bodies.push(SceneBody {
            id: id.to_owned(),
            position: center(body),
            coordinates: columns_of(id),
            ..SceneBody::default()
        });
    };
    if parameters.wheelsets.is_some() {
        for (number, id) in ["leading_wheelset", "trailing_wheelset"].into_iter().enumerate() {
            add_body(id, WHEELSETS + number);
            scene.solids.push(wheelset(id, parameters.geometry.axle_height));
        }
        // Wheels reach beyond the side frames.
        for (_, radius) in scene.looks.iter_mut().take(4).filter_map(|look| look.at.as_mut()) {
            *radius *= 1.3;
        }
    }
    if parameters.car_body.is_some() {
        add_body("car_body", CAR_BODY);
        scene
            .solids
            .push(floor("car_body", "floor of the car", center(CAR_BODY)));
    } else if center(BOLSTER)[2] > FLOOR[0] {
        // A bolster whose center of gravity lies above its center plate carries half a car.
        scene
            .solids
            .push(floor("bolster", "floor of the half car", center(BOLSTER)));
    }
    scene.round();
    Some(scene)
}

/// Returns a prism about y: a cylinder as drawn.
fn cylinder(id: &str, body: &str, radius: f64, y: f64, width: f64) -> Solid {
    const SIDES: u32 = 16;
    let outline: Vec<[f64; 2]> = (0..SIDES)
        .map(|k| {
            let (sine, cosine) = libm::sincos(2.0 * PI * (f64::from(k) + 0.5) / f64::from(SIDES));
            [radius * cosine, radius * sine]
        })
        .collect();
    let mut solid = extruded((id, "wheelset", SolidRole::Wheelset, body), &outline, width);
    for vertex in &mut solid.vertices {
        vertex[1] += y;
    }
    solid
}

/// Returns a wheelset with wheels of a radius (m).
fn wheelset(id: &str, wheel: f64) -> Solid {
    let [axle, width, place] = WHEEL;
    let mut solid = cylinder(id, id, axle, 0.0, 2.0 * place + 20.0 * INCH);
    for y in [place, -place] {
        solid.join(cylinder(id, id, wheel, y, width));
    }
    Solid {
        name: words(id),
        ..solid
    }
}

/// Returns the floor of a car above the truck; its body's center of gravity is at `center` (m).
fn floor(body: &str, name: &str, center: [f64; 3]) -> Solid {
    let [height, length, width, thick] = FLOOR;
    Solid {
        mount: SolidPose {
            position: [-center[0], -center[1], height - center[2]],
            angles: [0.0; 3],
        },
        ..extruded(
            ("floor", name, SolidRole::Body, body),
            &[[-length, 0.0], [length, 0.0], [length, thick], [-length, thick]],
            2.0 * width,
        )
    }
}

/// Returns the quantities that its plots may show.
#[must_use]
pub fn plots(result: &TruckResult) -> Vec<Plot> {
    let labels = WEDGE_NAMES.map(words);
    let has = |name: &str| result.column(name).is_some();
    let moves = |name: &str| {
        let values = result.column(name).unwrap_or_default();
        values.iter().any(|value| (value - values[0]).abs() > 1e-12)
    };
    let of_all = |title: &str, what: &str| {
        let names = WEDGE_NAMES.map(|name| format!("{name}_{what}"));
        let curves = names.iter().zip(&labels).filter(|(name, _)| has(name));
        Plot::new(title, curves.map(|(name, label)| (name.as_str(), label.as_str())))
    };
    let some = |title: &str, curves: &[(&str, &str)]| {
        Plot::new(title, curves.iter().copied().filter(|(name, _)| has(name)))
    };
    let moments = some(
        "Warp moment",
        &[
            ("warp_moment", "on the bolster"),
            ("interaxle_shear_moment", "inter-axle shear moment"),
        ],
    );
    let angle = some("Warp angle", &[("warp_angle", "warp angle")]);
    let normals = of_all("Normal forces of the columns", "column_normal");
    let friction = of_all("Column friction on the side frames, up", "column_friction_z");
    let nests = some(
        "Loads of the nests",
        &[
            ("left_nest_vertical_force", "left"),
            ("right_nest_vertical_force", "right"),
        ],
    );
    let warps = result
        .column("warp_angle")
        .is_some_and(|angles| angles.iter().any(|angle| angle.abs() > 1e-3));
    let mut plots = if warps {
        vec![moments, normals, angle, friction, nests]
    } else {
        vec![friction, normals, nests, moments, angle]
    };
    plots.push(of_all("Normal forces of the slopes", "slope_normal"));
    if moves("bolster_roll") {
        plots.push(some(
            "Roll moment",
            &[("bolster_roll_moment", "on the bolster, of nests and stops")],
        ));
    }
    let parts = PARTS.map(|(name, words, _)| (format!("warp_moment_{name}"), words));
    plots.push(Plot::new(
        "Parts of the warp moment",
        parts
            .iter()
            .filter(|(name, _)| moves(name))
            .map(|(name, words)| (name.as_str(), *words)),
    ));
    for (what, title) in [
        ("x", "Wedges, longitudinal"),
        ("y", "Wedges, lateral"),
        ("z", "Wedges, vertical"),
        ("roll", "Wedges, roll"),
        ("pitch", "Wedges, pitch"),
        ("yaw", "Wedges, yaw"),
    ] {
        plots.push(of_all(title, what));
    }
    for body in [
        "bolster",
        "left_side_frame",
        "right_side_frame",
        "leading_wheelset",
        "trailing_wheelset",
        "car_body",
    ] {
        for (title, coordinates) in [("displacements", 0..3), ("angles", 3..6)] {
            let own: Vec<(String, &str)> = coordinates
                .map(|k| (format!("{body}_{}", COORDINATES[k]), COORDINATES[k]))
                .filter(|(name, _)| moves(name))
                .collect();
            let title = format!("{}: {title}", crate::figures::capital(&words(body)));
            plots.push(Plot::new(
                &title,
                own.iter().map(|(name, label)| (name.as_str(), *label)),
            ));
        }
    }
    for face in FACES {
        plots.push(of_all(
            &format!("Energy lost at the {face}s"),
            &format!("{face}_friction_loss"),
        ));
    }
    plots.push(some(
        "Energy ledger",
        &[
            ("motion_work", "work of the motions"),
            ("friction_loss", "lost in friction"),
            ("contact_damping_loss", "lost in contacts"),
            ("element_loss", "lost in coils and stops"),
            ("stored_energy_change", "stored since the start"),
        ],
    ));
    plots.retain(|plot| !plot.curves.is_empty());
    plots
}
