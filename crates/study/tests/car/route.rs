//! analytic, limits, input: routes.

use std::path::Path;

use study::car::CarCase;
use study::route::{OfRun, Route, RouteWear, WornProfile};
use study::run::Run;
use wheelrail::profile::{Points, Profile, ProfileKind, nominal};

use crate::problems::in_words;

const ROUTE: &str = "title = \"two tracks\"\ncase = \"car_constant_curve_loaded\"\nmiles = 40\nsteps = 2
[set]
simulation.duration = \"8 s\"
simulation.output_interval = \"10 ms\"
start.settle = \"5 s\"
start.kind = \"equilibrium\"
[wedges]
coefficient = 2e-6
[tracks.curve]
share = 0.25
[tracks.curve.set]
track.segments = [{ tangent = \"60 ft\" }, { spiral = \"99 ft\" }, { curve = \"600 ft\", degree = \"8 deg\" }]
[tracks.tangent]
share = 0.75
[tracks.tangent.set]
track.segments = [{ tangent = \"800 ft\" }]
";

fn parse(text: &str) -> Result<Route, String> {
    let error = |error: study::case::CaseError| in_words(error.problems());
    Route::parse("route.toml", text, Path::new("")).map_err(error)
}

fn run(case: &CarCase) -> study::car::summary::CarSummary {
    Run::new(case).unwrap().finish(|_| ()).summary
}

/// Damage of a mile is the mean of the runs by their shares; wheels lose what the step's pace says, and the
/// worn car runs on with it; wedges lose K E / (μ H A).
#[test]
fn analytic_a_step_is_the_mean_of_its_runs() {
    let route = parse(ROUTE).unwrap();
    let base = route.case([0, 0], &[]).unwrap();
    let mut wear = RouteWear::new(&route, base.clone());
    assert!(wear.worn().profiles.is_empty() && wear.worn().wedges.is_empty());
    let runs: Vec<OfRun> = route
        .runs()
        .into_iter()
        .map(|own| OfRun {
            summary: run(&route.case(own.of, &[]).unwrap()),
            run: own,
        })
        .collect();
    assert_eq!(
        runs.iter().map(|own| own.run.name.as_str()).collect::<Vec<_>>(),
        ["curve", "tangent"]
    );
    wear.step(&runs);
    let step = &wear.summary.steps[0];
    let of = |number: usize| runs[number].summary.damage.as_ref().unwrap();
    let mean = |read: &dyn Fn(&study::damage::DamageSummary) -> f64| 0.25 * read(of(0)) + 0.75 * read(of(1));
    let near = |found: f64, expected: f64, within: f64| {
        assert!((found / expected - 1.0).abs() < within, "{found} {expected}");
    };
    near(
        step.creep_resistance.value,
        mean(&|own| own.creep_resistance.value),
        1e-12,
    );
    let name = "axle_1_right";
    near(
        step.wheels[name].worn_mass.value,
        mean(&|own| own.wheels[name].worn_mass.value),
        1e-12,
    );
    // Depths over the profile hold the volume.
    let sum = |places: &[study::damage::PlaceDamage]| places.iter().map(|place| place.depth).sum::<f64>();
    let depths: f64 = sum(&step.wheels[name].profile);
    near(depths, mean(&|own| sum(&own.wheels[name].profile)), 1e-9);
    // The rate of a wheel in the curve is more than that on the tangent.
    assert!(of(0).wheels[name].worn_mass.value > 5.0 * of(1).wheels[name].worn_mass.value);

    let worn = wear.worn();
    let [profile] = &worn.profiles[..] else {
        panic!("{}", worn.profiles.len())
    };
    assert_eq!(profile.wheel, "");
    // Wedges lose what the runs say, with their counterfaces, which wear alike: maps are beside the mean.
    let paces = |number: usize| {
        let own = runs[number].summary.wedge_wear.as_ref().unwrap();
        own.wedges["truck_1_leading_left"].column.mean_depth.value * 0.0254
    };
    let face = (0.25 * paces(0) + 0.75 * paces(1)) * 20.0 / 1e5;
    let found = worn
        .wedges
        .iter()
        .find(|own| own.name == "truck_1_leading_left")
        .unwrap();
    assert_eq!(found.key(), "front_truck.wedge.leading_left");
    let expected = found.depths[0];
    assert!(
        (1.5 * face..2.0001 * face).contains(&expected),
        "{expected} {face}"
    );
    let keys: Vec<String> = found.maps().map(|own| own.file).collect();
    let files = ["column", "column_counterface", "slope", "slope_counterface"];
    assert_eq!(keys, files.map(|own| format!("truck_1_leading_left_{own}.csv")));

    // The worn car is a car: wedges stand higher, and it runs.
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(profile.file()), profile.csv()).unwrap();
    for map in worn.wedges.iter().flat_map(|own| own.maps()) {
        std::fs::write(folder.path().join(&map.file), map.csv()).unwrap();
    }
    let set = route.worn_settings(&worn, folder.path());
    let case = route.case([0, 0], &set).unwrap();
    near(case.parameters.trucks[0].wedges[0].wear.column, expected, 1e-6);
    let after = run(&case);
    assert!(after.complete, "{:?}", after.stopped);
    assert!(after.damage.is_some());
    let worn = &case.parameters.trucks[0].wedges[0];
    let volume = |face: &wedge::face::FaceProperties| {
        let map = face.wedge_wear.as_ref().unwrap();
        // By the trapezoidal rule: the outer points of a row stand for half as much.
        let weighed = map
            .points()
            .enumerate()
            .map(|(k, own)| if k % 9 % 8 == 0 { 0.5 * own[2] } else { own[2] });
        weighed.sum::<f64>()
    };
    assert!(volume(&worn.column_face).abs() < 1e-2 * expected);
    assert!(worn.slope_face.counterface_wear.is_some());
}

/// A case that begins with a rise, and wheels of several profiles, keep them: wear comes on top.
#[test]
fn issue_058_wear_comes_on_top_of_what_the_case_has() {
    let text = ROUTE.replace(
        "start.settle = \"5 s\"",
        "start.settle = \"0 s\"\nfront_truck.wedge.rise = \"0.25 in\"\n\
         wheels.axle_2.left.profile = \"aar_1:20\"",
    );
    let route = parse(&text.replace("\"8 s\"", "\"0.5 s\"")).unwrap();
    let base = route.case([0, 0], &[]).unwrap();
    let mut wear = RouteWear::new(&route, base.clone());
    let runs = route.runs().into_iter().map(|own| OfRun {
        summary: run(&route.case(own.of, &[]).unwrap()),
        run: own,
    });
    wear.step(&runs.collect::<Vec<_>>());
    let worn = wear.worn();
    let names: Vec<&str> = worn.profiles.iter().map(|own| own.wheel.as_str()).collect();
    assert_eq!(names.len(), 8, "{names:?}");
    let folder = tempfile::tempdir().unwrap();
    for own in &worn.profiles {
        std::fs::write(folder.path().join(own.file()), own.csv()).unwrap();
    }
    for map in worn.wedges.iter().flat_map(|own| own.maps()) {
        std::fs::write(folder.path().join(&map.file), map.csv()).unwrap();
    }
    let after = route
        .case([0, 0], &route.worn_settings(&worn, folder.path()))
        .unwrap();
    for truck in 0..2 {
        let depth = |case: &CarCase| case.parameters.trucks[truck].wedges[0].wear.slope;
        assert!(depth(&after) > depth(&base), "{truck}");
        assert!(depth(&after) < depth(&base) + 1e-4, "{truck}");
    }
    assert!(base.parameters.trucks[0].wedges[0].wear.slope > 1e-3);
    let (car::Wheels::OnRails(before), car::Wheels::OnRails(after)) =
        (&base.parameters.wheels, &after.parameters.wheels)
    else {
        panic!("wheels are on rails")
    };
    let thickness = |own: &Profile| own.flange_face(0.012).unwrap();
    for (before, after) in before.wheels.iter().flatten().zip(after.wheels.iter().flatten()) {
        assert!((thickness(before) - thickness(after)).abs() < 1e-4);
    }
}

/// A profile loses depths along its normals; what is written is read as the same profile.
#[test]
fn analytic_a_worn_profile_has_lost_its_depth() {
    let profile = nominal::aar_1b().unwrap();
    let depths: Vec<[f64; 2]> = (-70..=70).map(|k| [1e-3 * f64::from(k), 0.5e-3]).collect();
    let worn = WornProfile::new("axle_1.left", &profile, &depths);
    assert_eq!(worn.file(), "axle_1_left.csv");
    let points = Points::from_csv("worn.csv", &worn.csv()).unwrap();
    let read = Profile::of_points(&points, ProfileKind::Wheel, 20e-6).unwrap();
    // The tread of 1:20 stands 0.5 mm higher, square to it; so does the flange's face, to the back.
    let height = |own: &Profile, y: f64| {
        own.curve()
            .sample(1e-4)
            .iter()
            .map(|(_, point)| point.position)
            .fold([f64::INFINITY, 0.0], |best: [f64; 2], [at, z]| {
                if (at - y).abs() < best[0] {
                    [(at - y).abs(), z]
                } else {
                    best
                }
            })[1]
    };
    let lost = height(&read, 0.02) - height(&profile, 0.02);
    assert!((lost - 0.5e-3 * (1.0 + 1.0 / 800.0)).abs() < 2e-5, "{lost}");
    let face = |own: &Profile| own.flange_face(0.012).unwrap();
    let thinner = face(&read) - face(&profile);
    let angle = 75.0_f64.to_radians();
    assert!((thinner.abs() - 0.5e-3 / angle.sin()).abs() < 5e-5, "{thinner}");
}

#[test]
fn input_routes() {
    let with = |old: &str, new: &str| parse(&ROUTE.replace(old, new)).unwrap_err();
    for (old, new, expected) in [
        ("share = 0.25", "share = 0.2", "sum to 0.95"),
        ("share = 0.25", "share = 2", "between 0 and 1"),
        ("share = 0.25\n", "", "share"),
        ("steps = 2", "steps = 1.5", "whole"),
        ("miles = 40", "miles = \"40000 mi\"", "number"),
        ("miles = 40", "miles = 40\nkilometers = 3", "twice"),
        ("car_constant_curve_loaded", "truck_vertical_variable", "truck"),
        ("case = \"car_constant_curve_loaded\"\n", "", "case"),
        ("simulation.duration", "simulation.durations", "durations"),
        ("track.segments", "track.segment", "segment"),
        ("coefficient = 2e-6", "K = 2e-6", "K"),
        ("steps = 2", "wheels = \"all\"", "mean"),
        ("[tracks.curve]", "[track.curve]", "track"),
    ] {
        let words = with(old, new);
        assert!(words.contains(expected), "{new}: {words}");
    }
    let seasons = format!(
        "{ROUTE}[seasons.dry]\nshare = 0.5\nset = {{ wheels.friction = 0.5 }}\n[seasons.wet]\nshare = 0.5\n"
    );
    let names: Vec<String> = parse(&seasons)
        .unwrap()
        .runs()
        .into_iter()
        .map(|own| own.name)
        .collect();
    assert_eq!(names, ["curve.dry", "curve.wet", "tangent.dry", "tangent.wet"]);
    let no_share = with("[tracks.curve]", "[tracks.a.b]\nshare = 0.1\n[tracks.curve]");
    assert!(no_share.contains("share"), "{no_share}");
}

#[test]
fn input_documented_routes_are_valid() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/routes");
    let files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|file| file.unwrap().path())
        .collect();
    assert!(!files.is_empty());
    for file in files {
        let route = Route::read(&file)
            .map_err(|error| in_words(error.problems()))
            .unwrap();
        for run in route.runs() {
            route
                .case(run.of, &[])
                .map_err(|error| in_words(error.problems()))
                .unwrap();
        }
    }
}
