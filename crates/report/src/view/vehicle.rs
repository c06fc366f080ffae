//! The view of a vehicle's run, and its plots: what its drawing and its channels say.

use mechanics::output::Column;
use quantity::Kind;
use study::vehicle::VehicleCase;
use study::vehicle::run::VehicleResult;
use vehicle::{Axle, Drawing, Drawn, GROUND, OnTrack, Solid as Shape};
use wheelrail::track::RailLines;

use super::rolling;
use super::run::{Detail, Plot, Recording, table};
use super::scene::{CoilEnd, Look, Scene, SceneBody, SceneCoil, Solid, SolidRole, extruded};

/// Names of coordinates in columns.
const COORDINATES: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];
/// Length of the track drawn behind and beyond the run, m.
const BEYOND: f64 = 30.0;
/// The exaggerated size (m) beyond which displacements grow to scale.
const LIMIT: f64 = 0.5;

impl Recording {
    /// Makes the view of a vehicle of bodies and elements.
    #[must_use]
    pub fn of_vehicle(case: &VehicleCase, result: &VehicleResult, detail: Detail) -> Self {
        let columns = &result.columns;
        let distances = columns.iter().position(|own| own.kind == Kind::Distance);
        let distances = distances.map_or(&[][..], |place| &result.values[place]);
        let (all, scene) = (table(columns, &result.values), scene(case, columns, distances));
        Self::new((&case.name, &case.title), &all, plots(columns), scene, detail)
    }
}

/// Returns the scene of a vehicle whose run has these columns; none where the case makes no vehicle.
/// `distances` (m) are those of its first wheelset along the track, if it runs on one.
fn scene(case: &VehicleCase, columns: &[Column], distances: &[f64]) -> Option<Scene> {
    let vehicle = case.vehicle().ok()?;
    let drawing = &vehicle.drawing;
    let has = |name: &String| columns.iter().any(|own| own.name == *name);
    let mut scene = Scene {
        factor: 1.0,
        limit: LIMIT,
        arrow: 0.3 * size(drawing),
        looks: vec![
            Look::all("Oblique", [-1.0, 0.9, 0.5]),
            Look::all("Side", [0.0, 1.0, 0.0]),
            Look::all("Front", [1.0, 0.0, 0.0]),
            Look::all("Top", [0.0, 0.0, 1.0]),
        ],
        bodies: vec![SceneBody {
            id: GROUND.to_owned(),
            ..SceneBody::default()
        }],
        ..Scene::default()
    };
    let on_track = case.description.on_track.as_ref();
    for body in &drawing.bodies {
        let column = |name: &str| Some(format!("{}_{name}", body.name)).filter(|name| has(name));
        let along = column("distance").filter(|_| on_track.is_some());
        if on_track.is_some() && along.is_none() {
            continue;
        }
        scene.bodies.push(SceneBody {
            id: body.name.clone(),
            // On a track places are counted from the center line, where the body is.
            position: match along {
                Some(_) => [0.0, 0.0, body.place[2]],
                None => body.place,
            },
            along,
            coordinates: COORDINATES.map(column),
            ..SceneBody::default()
        });
        let Shape::Box(size) = body.solid;
        scene.solids.push(cuboid(&body.name, size));
    }
    let place_of = |number: usize| {
        let body = drawing.bodies.iter().find(|own| own.number == number);
        body.map_or((GROUND.to_owned(), [0.0; 3]), |own| (own.name.clone(), own.place))
    };
    let count = case.description.bodies.len();
    for element in &drawing.elements {
        // Bearings of wheelsets are no bodies of the picture.
        if element.ends.iter().any(|(number, _)| *number > count) {
            continue;
        }
        let turns = match element.form {
            Drawn::Coil => 6.0,
            Drawn::Line => 0.0,
            Drawn::Nothing => continue,
        };
        let [a, b] = element.ends.map(|(number, at)| {
            let (body, place) = place_of(number);
            CoilEnd {
                body,
                point: std::array::from_fn(|k| at[k] - place[k]),
            }
        });
        let [from, to] = element.ends.map(|(_, at)| at);
        let way = [0, 1, 2].map(|k| from[k] - to[k]);
        let length = way.iter().fold(0.0, |sum: f64, own| libm::hypot(sum, *own));
        if length == 0.0 {
            continue;
        }
        scene.coils.push(SceneCoil {
            name: element.name.replace('_', " "),
            from: b,
            to: a,
            nominal_length: length,
            free_length: length,
            radius: if turns > 0.0 { 0.15 * length } else { 0.02 * length },
            turns: if turns > 0.0 { turns } else { 1.0 },
            force: Some(format!("{}_force", element.name)).filter(|name| has(name)),
            length: None,
        });
    }
    if let Some(on) = on_track {
        add_track(&mut scene, on, &vehicle.axles, distances);
    }
    scene.round();
    Some(scene)
}

/// Adds wheelsets and the track under them; `distances` (m) are those of the first wheelset.
fn add_track(scene: &mut Scene, on: &OnTrack, axles: &[Axle], distances: &[f64]) {
    let ([wheels, ..], rails) = (&on.wheels.wheels, &on.wheels.rails);
    for axle in axles {
        let column = |name: &str| {
            let own = match name {
                "lateral" => "y",
                "vertical" => "z",
                own => own,
            };
            format!("{}_{own}", axle.name)
        };
        let radius = on.radius();
        let bodies = rolling::wheelset_bodies(&axle.name, radius, &column);
        scene.bodies.extend(bodies);
        let shown = axle.name.replace('_', " ");
        scene.solids.extend(rolling::wheelset_solids(
            &axle.name,
            &shown,
            wheels.each_ref().map(|own| &**own),
            [radius; 2],
            on.wheels.tape_distance,
        ));
    }
    let offsets = on.wheels.geometry[0].rail_origins();
    scene.track = rolling::track_of_run(
        &RailLines::new(on.track.clone(), offsets),
        rails.each_ref().map(|own| &**own),
        offsets,
        (distances, 2.0 * on.reach() + BEYOND),
        [0.0; 2],
    );
    scene.follow = scene.bodies.get(1).map(|body| body.id.clone());
    scene.limit = 0.1;
}

/// Returns the size of a drawing, m.
fn size(drawing: &Drawing) -> f64 {
    let reach = drawing.bodies.iter().flat_map(|own| own.place);
    reach.fold(0.5, |most: f64, own| most.max(own.abs()))
}

fn cuboid(name: &str, [x, y, z]: [f64; 3]) -> Solid {
    let (a, c) = (0.5 * x, 0.5 * z);
    let outline = [[-a, -c], [a, -c], [a, c], [-a, c]];
    let shown = name.replace('_', " ");
    extruded((name, &shown, SolidRole::Body, name), &outline, y)
}

/// Returns the plots of a run: of each body its displacements and its rotations, of each element its forces.
fn plots(columns: &[Column]) -> Vec<Plot> {
    let of = |kinds: &[Kind]| -> Vec<&Column> {
        let own = columns.iter();
        own.filter(|column| kinds.contains(&column.kind) && column.name != "time")
            .collect()
    };
    let mut plots: Vec<Plot> = Vec::new();
    for (title, kinds) in [
        ("displacements", &[Kind::Length][..]),
        ("rotations", &[Kind::Angle]),
        ("forces", &[Kind::Force]),
        ("moments", &[Kind::Moment]),
        ("accelerations", &[Kind::RideAcceleration]),
        ("power lost", &[Kind::Power]),
    ] {
        for column in of(kinds) {
            // The owner is what the text names first.
            let (owner, _) = column.text.split_once(':').unwrap_or((column.name.as_str(), ""));
            let title = format!("{}: {title}", owner.replace('_', " "));
            let label = column.name.strip_prefix(owner).unwrap_or(&column.name);
            let label = label.trim_matches('_').replace('_', " ");
            let curve = (column.name.clone(), label);
            match plots.iter_mut().find(|plot| plot.title == title) {
                Some(plot) => plot.curves.push(curve),
                None => plots.push(Plot {
                    title,
                    curves: vec![curve],
                }),
            }
        }
    }
    let energies = [
        ("work", "work"),
        ("losses", "losses"),
        ("stored_energy_change", "stored"),
    ];
    plots.push(Plot::new("Energies since the start", energies));
    plots
}
