//! The view of a stand-alone wedge's run: side frame, pocket, wedge, coil and contacts.

use mechanics::vector::Vector;
use study::result::RunResult;
use wedge::outputs::{CORNERS, FACES};
use wedge::parameters::{Damping, Parameters};
use wedge::{BOLSTER, COLUMN, SIDE_FRAME, SLOPE, WEDGE, Wedge};

use super::pressure::ScenePressure;
use super::scene::{
    CoilEnd, FACTOR, Look, Scene, SceneBody, SceneCoil, SceneContact, Solid, SolidPose, SolidRole, extruded,
};

/// Returns the scene of a stand-alone wedge; none if the parameters make no wedge.
#[must_use]
pub fn scene(parameters: &Parameters, result: &RunResult) -> Option<Scene> {
    let wedge = Wedge::new(parameters.clone()).ok()?;
    let system = &wedge.system;
    let (height, width, bottom) = (
        parameters.wedge.height,
        parameters.wedge.width,
        parameters.bottom_length(),
    );
    let travel = ["wedge_z", "bolster_vertical"]
        .into_iter()
        .filter_map(|name| result.column(name))
        .flatten()
        .fold(0.0, |most: f64, value| most.max(value.abs()));
    let origin = |body: usize| system.bodies()[body].frame.origin;
    let own = |names: [&str; 6]| names.map(|name| Some(name.to_owned()));
    let neighbour = |name: &str| {
        ["longitudinal", "lateral", "vertical", "roll", "pitch", "yaw"]
            .map(|what| Some(format!("{name}_{what}")))
    };
    let travels = [None, None, Some("wedge_z".to_owned())];
    let bodies = vec![
        SceneBody {
            id: "side_frame".to_owned(),
            position: origin(SIDE_FRAME),
            coordinates: neighbour("side_frame"),
            ..SceneBody::default()
        },
        SceneBody {
            id: "bolster".to_owned(),
            position: origin(BOLSTER),
            coordinates: neighbour("bolster"),
            steady: travels.clone(),
            ..SceneBody::default()
        },
        SceneBody {
            id: "wedge".to_owned(),
            position: origin(WEDGE),
            coordinates: own([
                "wedge_x",
                "wedge_y",
                "wedge_z",
                "wedge_roll",
                "wedge_pitch",
                "wedge_yaw",
            ]),
            steady: travels,
            ..SceneBody::default()
        },
    ];

    let face_x = parameters.column_face_position();
    let wedge_solid = Solid {
        mount: SolidPose::default(),
        ..extruded(
            ("wedge", "wedge", SolidRole::Wedge, "wedge"),
            &[[face_x, 0.0], [face_x + bottom, 0.0], [face_x, height]],
            width,
        )
    };
    let half = 0.5 * height + travel + 0.1 * height;
    let column = Solid {
        mount: SolidPose {
            position: system.faces()[COLUMN].marker.origin.0,
            angles: [0.0, parameters.toe, 0.0],
        },
        ..extruded(
            (
                "column",
                "column of the side frame",
                SolidRole::Column,
                "side_frame",
            ),
            &[
                [-0.2 * height, -half],
                [0.0, -half],
                [0.0, half],
                [-0.2 * height, half],
            ],
            1.1 * width,
        )
    };
    let slope = &system.faces()[SLOPE].marker;
    let normal: Vector<f64> = slope.rotation.apply(Vector([1.0, 0.0, 0.0]));
    // Down along the slope, in the plane of x and z; the surface goes on a little beyond the wedge.
    let down = [-normal.0[2], normal.0[0]];
    let reach = 0.6 * height / parameters.wedge.angle.cos();
    let (top, low) = (
        [-reach * down[0], -reach * down[1]],
        [reach * down[0], reach * down[1]],
    );
    let back = low[0] + 0.3 * height;
    let pocket = Solid {
        mount: SolidPose {
            position: slope.origin.0,
            angles: [0.0; 3],
        },
        ..extruded(
            ("pocket", "pocket of the bolster", SolidRole::Pocket, "bolster"),
            &[top, low, [back, low[1]], [back, top[1]]],
            1.1 * width,
        )
    };
    let seat_body = match parameters.damping {
        Damping::Variable => "side_frame",
        Damping::Constant => "bolster",
    };
    let control = &system.coils()[0];
    let radius = 0.4 * bottom;
    let seat = Solid {
        mount: SolidPose {
            position: control.marker.origin.0,
            angles: [0.0; 3],
        },
        ..extruded(
            ("seat", "seat of the coil", SolidRole::Seat, seat_body),
            &[
                [-1.4 * radius, -0.06 * height],
                [1.4 * radius, -0.06 * height],
                [1.4 * radius, 0.0],
                [-1.4 * radius, 0.0],
            ],
            2.8 * radius,
        )
    };
    let coil = SceneCoil {
        name: "control coil".to_owned(),
        from: CoilEnd {
            body: seat_body.to_owned(),
            point: control.marker.origin.0,
        },
        to: CoilEnd {
            body: "wedge".to_owned(),
            point: control.element.end.0,
        },
        nominal_length: parameters.coil.nominal_length,
        free_length: parameters.coil.free_length,
        radius,
        turns: 6.0,
        force: Some("coil_force".to_owned()),
        length: Some("coil_length".to_owned()),
    };
    let mut contacts = Vec::new();
    for (face, (on, normal)) in [("column", [1.0, 0.0, 0.0]), ("pocket", normal.0)]
        .into_iter()
        .enumerate()
    {
        let points = &system.faces()[face].element.points;
        for (point, corner) in points.iter().zip(CORNERS) {
            let id = format!("{}_{corner}", FACES[face]);
            contacts.push(SceneContact {
                name: format!("{}, {}", FACES[face], corner.replace('_', " ")),
                body: "wedge".to_owned(),
                point: point.position.0,
                on: on.to_owned(),
                normal,
                normal_force: format!("{id}_normal_force"),
                friction: ["x", "y", "z"].map(|axis| format!("{id}_friction_force_{axis}")),
                state: format!("{id}_state"),
                gap: Some(format!("{id}_gap")),
                id,
            });
        }
    }
    let pressures = [&parameters.column_face, &parameters.slope_face]
        .into_iter()
        .enumerate()
        .filter_map(|(face, own)| {
            let points = system.faces()[face].element.points.iter();
            let named = points.zip(own.grid.points()).map(|(point, place)| {
                let column = format!("{}_{}_pressure", FACES[face], place.number());
                (point.position.0, column)
            });
            ScenePressure::new(FACES[face], "wedge", named.collect())
        });
    Some(Scene {
        pressures: pressures.collect(),
        factor: FACTOR,
        limit: 0.15 * height,
        arrow: 0.65 * height,
        looks: looks(),
        bodies,
        solids: vec![column, pocket, seat, wedge_solid],
        coils: vec![coil],
        contacts,
        ..Scene::default()
    })
}

fn looks() -> Vec<Look> {
    vec![
        Look::all("Oblique", [0.45, -1.0, 0.28]),
        Look::all("Side", [0.0, -1.0, 0.0]),
        Look::all("Column", [-1.0, 0.0, 0.0]),
        Look::all("Slope", [1.0, 0.0, 0.25]),
        Look::all("Top", [0.0, 0.0, 1.0]),
    ]
}
