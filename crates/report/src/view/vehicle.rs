//! The view of a vehicle's run, and its plots: what its drawing and its channels say.

use mechanics::output::Column;
use quantity::Kind;
use study::vehicle::VehicleCase;
use vehicle::{Drawing, Drawn, Solid as Shape};

use super::run::Plot;
use super::scene::{CoilEnd, Look, Scene, SceneBody, SceneCoil, Solid, SolidRole, extruded};
use vehicle::GROUND;

/// Names of coordinates in columns.
const COORDINATES: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];
/// The exaggerated size (m) beyond which displacements grow to scale.
const LIMIT: f64 = 0.5;

/// Returns the scene of a vehicle whose run has these columns; none where the case makes no vehicle.
#[must_use]
pub fn scene(case: &VehicleCase, columns: &[Column]) -> Option<Scene> {
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
            on: None,
            along: None,
            spin: None,
            position: [0.0; 3],
            coordinates: Default::default(),
            steady: Default::default(),
        }],
        ..Scene::default()
    };
    for body in &drawing.bodies {
        let column = |name: &str| Some(format!("{}_{name}", body.name)).filter(|name| has(name));
        scene.bodies.push(SceneBody {
            id: body.name.clone(),
            on: None,
            along: None,
            spin: None,
            position: body.place,
            coordinates: COORDINATES.map(column),
            steady: Default::default(),
        });
        let Shape::Box(size) = body.solid;
        scene.solids.push(cuboid(&body.name, size));
    }
    let place_of = |number: usize| {
        let body = drawing.bodies.iter().find(|own| own.number == number);
        body.map_or((GROUND.to_owned(), [0.0; 3]), |own| (own.name.clone(), own.place))
    };
    for element in &drawing.elements {
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
    scene.round();
    Some(scene)
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
#[must_use]
pub fn plots(columns: &[Column]) -> Vec<Plot> {
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
