//! The view of a wheelset's run, and its plots.

use study::wheelset::WheelsetCase;
use study::wheelset::run::WheelsetResult;
use wheelrail::wheelset::RigidWheelset;

use super::rolling;
use super::run::{Detail, Plot, Recording, table};
use super::scene::{Look, Scene};

/// Lengths of the track drawn behind the start and beyond the end, m.
const BEYOND: [f64; 2] = [30.0, 60.0];
/// Length of the arrow of a force that few exceed, m.
const ARROW: f64 = 0.35;
/// Name of the wheelset's body.
const ID: &str = "wheelset";

impl Recording {
    /// Makes the view of a wheelset on a track.
    #[must_use]
    pub fn of_wheelset(case: &WheelsetCase, result: &WheelsetResult, detail: Detail) -> Self {
        let table = table(&result.columns, &result.values);
        let (name, title) = (case.wheelset.name.as_str(), "A wheelset on a track");
        Self::new((name, title), &table, plots(), Some(scene(case, result)), detail)
    }
}

/// Returns the scene.
fn scene(case: &WheelsetCase, result: &WheelsetResult) -> Scene {
    let own = &case.wheelset;
    let column = |name: &str| name.to_owned();
    let distances = result.column("distance").unwrap_or_default();
    let radius = own.nominal_radius();
    let half = 0.5 * own.layout.tape_distance;
    let near = |name: &str, from: [f64; 3], at: [f64; 3], reach: f64| Look {
        at: Some((at, reach)),
        arrow: (reach < ARROW).then_some(0.4 * reach),
        ..Look::all(name, from)
    };
    let rails = RigidWheelset::new(
        own.wheels.each_ref(),
        own.radii,
        own.rails.each_ref(),
        own.layout,
        own.material,
    );
    let track = rails.ok().and_then(|rails| {
        rolling::track_of_run(
            &case.setup.lines,
            own.rails.each_ref(),
            rails.rail_origins(),
            (distances, 0.0),
            BEYOND,
        )
    });
    let mut scene = Scene {
        factor: 1.0,
        limit: 0.1,
        arrow: ARROW,
        looks: vec![
            near("Oblique", [-1.0, 0.75, 0.45], [0.0, 0.0, 0.35], 1.15),
            near("Left side", [0.0, 1.0, 0.0], [0.0, 0.0, 0.3], 0.75),
            near("Along the track", [-1.0, 0.0, 0.12], [0.0, 0.0, 0.3], 1.0),
            near("Top", [0.0, 0.0, 1.0], [0.0; 3], 1.1),
            near("Left contact", [-1.0, 0.0, 0.12], [0.0, half, 0.0], 0.09),
            near("Right contact", [-1.0, 0.0, 0.12], [0.0, -half, 0.0], 0.09),
        ],
        bodies: rolling::wheelset_bodies(ID, radius, &column).to_vec(),
        solids: rolling::wheelset_solids(
            ID,
            "wheelset",
            own.wheels.each_ref(),
            own.radii,
            own.layout.tape_distance,
        ),
        patches: rolling::patches(ID, &column),
        track,
        follow: Some(ID.to_owned()),
        ..Scene::default()
    };
    scene.round();
    scene
}

/// Returns the quantities that its plots may show.
fn plots() -> Vec<Plot> {
    let both = |title: &str, what: &str| {
        let names = ["left", "right"].map(|side| format!("{side}_{what}"));
        Plot::new(title, names.iter().map(String::as_str).zip(["left", "right"]))
    };
    let one = |title: &str, name: &str, label: &str| Plot::new(title, [(name, label)]);
    vec![
        one("Lateral place", "lateral", "to the left"),
        both(
            "Lateral forces on the rails, positive where they spread the gauge",
            "lateral_force",
        ),
        both("Vertical forces on the rails", "vertical_force"),
        one("Yaw", "yaw", "angle of attack"),
        both("Lateral over vertical force", "lateral_over_vertical"),
        both("Longitudinal forces on the wheels", "longitudinal_force"),
        both("Wear number: energy lost by distance", "wear_number"),
        both("Contact patches", "patches"),
        Plot::new(
            "Rails under the wheels, lateral",
            [("left_rail_lateral", "left"), ("right_rail_lateral", "right")],
        ),
        Plot::new(
            "Rails under the wheels, vertical",
            [("left_rail_vertical", "left"), ("right_rail_vertical", "right")],
        ),
        one("Roll", "roll", "left side up"),
        one("Height", "vertical", "above the nominal radius"),
        one("Speed", "speed", "along the track"),
        one("Distance", "distance", "along the track"),
        Plot::new(
            "Energy ledger",
            [
                ("work", "work of drive, load and contacts"),
                ("losses", "lost in creep and damping"),
                ("stored_energy_change", "stored since the start"),
            ],
        ),
    ]
}
