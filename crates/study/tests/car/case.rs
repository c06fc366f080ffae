//! Cases are read and written by the same lines.

use car::{Drive, Wheels};
use study::car::{CarCase, builtin};
use study::case::Tables;
use study::models::AnyCase;

fn parse(lines: &str) -> CarCase {
    let text = match lines.contains("model = \"car\"") {
        true => lines.to_owned(),
        false => format!("model = \"car\"\n{lines}"),
    };
    match CarCase::parse("case.toml", &text, Tables::nowhere(), &[]) {
        Ok(case) => case,
        Err(error) => panic!("{:?}", error.problems()),
    }
}

/// Every built-in car, printed and read again, is the same case, and its text does not change any more.
#[test]
fn input_built_in_cars_read_back_to_the_same_case() {
    let names = [
        "car_tangent_loaded",
        "car_tangent_empty",
        "car_constant_curve_loaded",
        "car_constant_curve_empty",
        "car_286k_loaded",
        "car_spiral_loaded",
        "car_hunting_empty",
        "car_hunting_roller_empty",
        "car_twist_and_roll_loaded",
        "car_pitch_and_bounce_loaded",
        "car_yaw_and_sway_loaded",
        "car_dynamic_curving_loaded",
        "car_constant_curve_10_loaded",
        "car_constant_curve_12_loaded",
        "car_bunched_spiral_loaded",
        "car_single_bump_loaded",
        "car_curve_with_bump_loaded",
        "car_curve_with_dip_loaded",
        "car_lean_loaded",
        "car_static_curve_empty",
        "car_buff_curve_empty",
        "car_draft_curve_empty",
        "car_fra_class_1_loaded",
        "car_fra_class_1_empty",
        "car_fra_class_2_loaded",
        "car_fra_class_2_empty",
        "car_fra_class_3_loaded",
        "car_fra_class_3_empty",
        "car_fra_class_4_loaded",
        "car_fra_class_4_empty",
        "car_fra_class_5_loaded",
        "car_fra_class_5_empty",
    ];
    for name in names {
        let case = builtin::case_with(name, &[]).unwrap();
        assert_eq!(case.name, name);
        let again = CarCase::parse("again.toml", case.to_toml(), Tables::nowhere(), &[]).unwrap();
        assert_eq!(again.to_toml(), case.to_toml(), "{name}");
        let (own, other) = (&case.parameters, &again.parameters);
        assert_eq!(own.trucks, other.trucks);
        assert_eq!(own.lading, other.lading);
        assert_eq!(own.track, other.track);
        assert_eq!(own.drive, other.drive);
        assert_eq!(own.start, other.start);
        assert_eq!(own.support, other.support);
        assert_eq!(own.wheelset, other.wheelset);
        assert_eq!(case.simulation, again.simulation);
        assert_eq!(case.rules, again.rules);
        // The general reader finds the model in the text, and names without text.
        assert!(matches!(
            AnyCase::parse("c.toml", case.to_toml(), Tables::nowhere(), &[]),
            Ok(AnyCase::Car(_))
        ));
        assert!(matches!(AnyCase::built_in(name, &[]), Ok(Some(AnyCase::Car(_)))));
    }
    assert_eq!(builtin::names().count(), names.len());
}

/// The car of the specification: 263,000 lbf loaded, 62,600 lbf empty.
#[test]
fn limits_weights_of_the_loaded_and_the_empty_car() {
    const POUND_FORCE: f64 = 4.448_221_615_260_5;
    for (lading, weight) in [("loaded", 263_000.0), ("empty", 62_600.0)] {
        let case = parse(&format!("lading.kind = \"{lading}\""));
        let own = case.parameters.weight() / POUND_FORCE;
        assert!((own - weight).abs() < 1.0, "{lading}: {own}");
    }
}

/// `[truck]` sets both; `[front_truck]` lies over it and leaves the rear truck alone.
#[test]
fn input_front_and_rear_truck_lie_over_both() {
    let case = parse(
        "[truck]\ncondition = \"worn\"\n[truck.gib]\nclearance = \"0.4 in\"\n\
         [front_truck.friction]\ncolumn = 0.1\n[rear_truck.wedge.leading_left.friction]\nslope = 0.3",
    );
    let [front, rear] = &case.parameters.trucks;
    let friction = |truck: &truck::Parameters, wedge: usize| {
        let own = &truck.wedges[wedge];
        [own.column_friction.coefficient, own.slope_friction.coefficient]
    };
    assert_eq!(friction(front, 0), [0.1, 0.25]);
    assert_eq!(friction(rear, 0), [0.25, 0.3]);
    assert_eq!(friction(rear, 1), [0.25, 0.25]);
    assert!(
        [front, rear]
            .iter()
            .all(|own| (own.gib.clearance - 0.4 * 0.0254).abs() < 1e-15)
    );
    // Written, both stand in full, and read back to the same.
    assert!(case.to_toml().contains("[front_truck.friction]") && !case.to_toml().contains("\n[truck"));
    assert_eq!(parse(case.to_toml()).parameters.trucks, case.parameters.trucks);
}

/// Overrides reach every section, with units.
#[test]
fn input_set_reaches_trucks_track_and_speed() {
    let set = [
        "speed.value=30 mph",
        "truck.friction.column=0.1",
        "track.support.kind=rigid",
        "wheels.creep=fastsim",
        "start.axle_2_shift=0.1 in",
        "output.hold_time=60 ms",
        "output.wheel_filter=20 Hz",
        "simulation.duration=5 s",
    ]
    .map(str::to_owned);
    let case = builtin::case_with("car_tangent_empty", &set).unwrap();
    let own = &case.parameters;
    assert!((own.start.speed - 30.0 * 0.447_04).abs() < 1e-12);
    assert_eq!(own.trucks[1].wedges[3].column_friction.coefficient, 0.1);
    assert!(own.support.is_none());
    let Wheels::OnRails(wheels) = &own.wheels else {
        panic!("profiles are the default");
    };
    assert!(matches!(
        wheels.laws[0].creep,
        wheelrail::contact::CreepLaw::Fastsim(_)
    ));
    // Rigid rails bring the damping of their contacts.
    assert_eq!(wheels.laws[1].damping, 2.0);
    assert_eq!(own.start.wheelset_shifts, [0.0, 0.1 * 0.0254, 0.0, 0.0]);
    assert!((case.rules.hold_time - 0.06).abs() < 1e-15 && (case.rules.wheel_filter - 20.0).abs() < 1e-9);
}

/// Masses of a lading: mass, place and inertia arrive, the center of gravity follows.
#[test]
fn analytic_center_of_gravity_of_an_off_center_lading() {
    let case = parse(
        "lading.kind = \"masses\"\n[[lading.masses]]\nname = \"coil\"\nweight = \"43060 lbf\"\n\
         place = [\"20 in\", \"-10 in\", \"95 in\"]\n\
         inertia = [\"1e5 lbf in s^2\", \"2e5 lbf in s^2\", \"2e5 lbf in s^2\"]",
    );
    // As heavy as the empty body, whose center is at 65 in: halfway between.
    let center = case.parameters.center_of_gravity().map(|own| own / 0.0254);
    for (own, wanted) in center.into_iter().zip([10.0, -5.0, 80.0]) {
        assert!((own - wanted).abs() < 1e-9, "{center:?}");
    }
    assert_eq!(parse(case.to_toml()).parameters.lading, case.parameters.lading);
}

/// A speed over distance: the car starts with the speed at its place.
#[test]
fn analytic_start_speed_of_speeds_over_distance() {
    let case = parse(
        "speed.kind = \"over_distance\"\n\
         speed.over_distance = [[\"0 ft\", \"60 mph\"], [\"1000 ft\", \"40 mph\"]]\n\
         start.distance = \"500 ft\"\n",
    );
    assert!((case.speed() - 50.0 * 0.447_04).abs() < 1e-9);
    assert!(matches!(&case.parameters.drive, Drive::Over { speeds, .. } if speeds.len() == 2));
}

/// A speed over time: the car starts with the speed at time zero, and the case reads back.
#[test]
fn analytic_start_speed_of_speeds_over_time() {
    let case = parse(
        "speed.kind = \"over_time\"\n\
         speed.over_time = [[\"5 s\", \"50 mph\"], [\"15 s\", \"40 mph\"]]\n",
    );
    assert!((case.speed() - 50.0 * 0.447_04).abs() < 1e-9);
    let expected = [[5.0, 50.0 * 0.447_04], [15.0, 40.0 * 0.447_04]];
    let Drive::History { speeds, .. } = &case.parameters.drive else {
        panic!("{:?}", case.parameters.drive)
    };
    for (found, expected) in speeds.iter().flatten().zip(expected.iter().flatten()) {
        assert!((found - expected).abs() < 1e-9, "{speeds:?}");
    }
    assert_eq!(parse(case.to_toml()).parameters.drive, case.parameters.drive);
}

/// A track in a file: read from the case's folder, kept by name in the case, and with its contents in the
/// embedded text.
#[test]
fn input_a_track_in_a_file_is_embedded() {
    let folder = tempfile::tempdir().unwrap();
    let track = "[[segments]]\ntangent = \"700 ft\"\n[[segments]]\nspiral = \"100 ft\"\n[[segments]]\n\
                 curve = \"3000 ft\"\ndegree = \"3 deg\"\n[support]\nkind = \"rigid\"\n";
    std::fs::write(folder.path().join("bend.toml"), track).unwrap();
    let path = folder.path().join("case.toml");
    std::fs::write(&path, "model = \"car\"\ntrack.file = \"bend.toml\"\n").unwrap();
    let case = CarCase::read(&path, &[]).unwrap();
    assert!(case.parameters.support.is_none());
    assert!((case.parameters.track.center_line.length() - 3800.0 * 0.3048).abs() < 1e-9);
    assert!(case.to_toml().contains("file = \"bend.toml\""));
    assert!(!case.to_toml_embedded().contains("bend.toml"));
    let alone = CarCase::parse("alone.toml", case.to_toml_embedded(), Tables::nowhere(), &[]).unwrap();
    assert_eq!(alone.parameters.track, case.parameters.track);
    assert_eq!(alone.parameters.support, case.parameters.support);
}

/// Units of a run in Python are SI: bare numbers over a case, lists replaced.
#[test]
fn input_values_over_a_case_are_si() {
    let base = builtin::text("car_tangent_loaded").unwrap();
    let values = "speed.value = 10.0\nstart.settle = 1.0\ntruck.gib.clearance = 0.01\n";
    let case = CarCase::of_values("base.toml", base, Some(values), Tables::nowhere()).unwrap();
    assert!((case.speed() - 10.0).abs() < 1e-12);
    assert_eq!(case.parameters.trucks[0].gib.clearance, 0.01);
}

/// A case without a track is written with the usual one, and read again it is the same.
#[test]
fn input_a_case_that_is_written_reads_back_the_same() {
    for text in [
        "model = \"car\"\n",
        "model = \"car\"\n[track]\nsegments = [{ tangent = \"3000 ft\" }]\n",
    ] {
        let nowhere = std::path::Path::new("");
        let case = study::car::CarCase::parse("car.toml", text, nowhere, &[]).unwrap();
        let again = study::car::CarCase::parse("again.toml", case.to_toml(), nowhere, &[]).unwrap();
        assert!(case.to_toml() == again.to_toml() && case == again);
    }
}
