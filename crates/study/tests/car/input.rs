//! Bad input: every message says what was found and expected, and helps.

use crate::problems::in_words;
use study::car::{CarCase, builtin};
use study::case::Tables;
use wheelrail::profile::{Profile, nominal};

/// Returns the messages of a case with `model = "car"` and these lines, with their help.
fn refused(lines: &str) -> String {
    let text = format!("model = \"car\"\n{lines}");
    let error = CarCase::parse("case.toml", &text, Tables::nowhere(), &[]).unwrap_err();
    in_words(error.problems())
}

/// An override takes the place of what it excludes; keys with another mistake are not called unknown.
#[test]
fn issue_048_overrides_replace_what_they_exclude() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bend.toml");
    std::fs::write(&path, "[[segments]]\ntangent = \"700 ft\"\n").unwrap();
    let file = format!("track.file={:?}", path.display().to_string());
    let length = |case: &CarCase| case.parameters.track.center_line.length();
    for name in builtin::names() {
        let case = builtin::case_with(name, &[file.clone(), "simulation.duration=0.1 s".to_owned()]).unwrap();
        assert!((length(&case) - 700.0 * 0.3048).abs() < 1e-9, "{name}");
        assert!(case.parameters.track.irregularities.is_empty(), "{name}");
    }
    // And back again.
    let text = format!("model = \"car\"\n{file}\nsimulation.duration = \"0.1 s\"");
    let set = ["track.segments=[{ tangent = \"800 ft\" }]".to_owned()];
    let case = CarCase::parse("case.toml", &text, Tables::from(folder.path()), &set).unwrap();
    assert!((length(&case) - 800.0 * 0.3048).abs() < 1e-9);

    let text = "model = \"car\"\nlading.kind = \"masses\"\n[[lading.masses]]\nweight = \"1 kip\"\n\
                place = [\"0 in\", \"0 in\", \"70 in\"]\n\
                inertia = [\"0 lbf in s^2\", \"0 lbf in s^2\", \"0 lbf in s^2\"]\n";
    let over = |set: &str| CarCase::parse("case.toml", text, Tables::nowhere(), &[set.to_owned()]);
    assert!(over("lading.kind=empty").unwrap().parameters.lading.is_empty());
    assert_eq!(over("lading.kind=masses").unwrap().parameters.lading.len(), 1);

    let error = builtin::case_with("car_tangent_empty", &["speed.value=0 mph".to_owned()]).unwrap_err();
    assert_eq!(error.problems().len(), 1, "{}", in_words(error.problems()));
    // Two overrides that exclude each other are a mistake.
    let both = [file, "track.segments=[{ tangent = \"900 ft\" }]".to_owned()];
    let error = builtin::case_with("car_tangent_empty", &both).unwrap_err();
    assert!(in_words(error.problems()).contains("has no effect"));
}

#[test]
fn input_messages_say_what_is_wrong_and_what_to_write() {
    for (lines, parts) in [
        (
            "[front_truck.wedge]\nangel = \"30 deg\"",
            &[
                "there is no key `angel` in `front_truck.wedge`",
                "did you mean `angle`",
            ][..],
        ),
        (
            "[trucks]\ncondition = \"new\"",
            &["there is no key `trucks` in a car's case", "truck"],
        ),
        (
            "[car]\nwieght = \"1 lbf\"",
            &["there is no key `wieght` in `car`", "weight"],
        ),
        (
            "[truck]\ncondition = \"worn\"\n[front_truck]\ncondition = \"new\"\n[rear_truck]\n\
             condition = \"new\"",
            &[
                "`truck.condition` has no effect: both trucks have their own",
                "front_truck.condition",
            ],
        ),
        (
            "speed.value = \"0 mph\"",
            &[
                "`speed.value` is zero, but a car that is held at a speed rolls",
                "coasting",
            ],
        ),
        (
            "speed.value = \"40 lbf\"",
            &["this is a force", "a speed is expected"],
        ),
        (
            "speed.kind = \"over_distance\"",
            &["`speed.over_distance` is missing", "3000 ft"],
        ),
        (
            "speed.kind = \"over_time\"",
            &["`speed.over_time` is missing", "[\"40 s\", \"30 mph\"]"],
        ),
        (
            "speed.kind = \"over_time\"\nspeed.over_time = [[\"0 ft\", \"30 mph\"]]",
            &["this is a length", "a time is expected"],
        ),
        (
            "speed.kind = \"over_time\"\nspeed.over_time = [[\"0 s\", \"30 lbf\"]]",
            &["this is a force", "a speed is expected"],
        ),
        (
            "speed.kind = \"over_time\"\nspeed.over_time = [[\"3 s\", \"30 mph\"], [\"2 s\", \"20 mph\"]]",
            &["`speed.over_time` must have growing times", "write over_time ="],
        ),
        (
            "speed.kind = \"over_time\"\nspeed.over_time = [[\"-1 s\", \"30 mph\"]]",
            &["speed.over_time[0]", "zero or greater"],
        ),
        (
            "speed.kind = \"over_time\"\nspeed.over_time = [[\"0 s\", \"0 mph\"]]",
            &["speed.over_time[0]", "greater than zero"],
        ),
        (
            "speed.kind = \"over_time\"\nspeed.over_time = \"30 mph\"",
            &["`speed.over_time` is no list"],
        ),
        (
            "speed.kind = \"over_time\"\nspeed.over_times = [[\"0 s\", \"30 mph\"]]",
            &["there is no key `over_times`", "did you mean `over_time`?"],
        ),
        (
            "speed.over_time = [[\"0 s\", \"30 mph\"]]",
            &["there is no key `over_time` in `speed`"],
        ),
        (
            "[[track.segments]]\ntangent = \"200 ft\"",
            &[
                "the track is 200 ft long",
                "simulation.duration",
                "make the track longer",
            ],
        ),
        (
            "[[track.segments]]\ntangent = \"40 ft\"\n[[track.segments]]\nspiral = \"200 ft\"\n\
             [[track.segments]]\ncurve = \"5000 ft\"\ndegree = \"5 deg\"",
            &["a run begins on tangent track", "first tangent"],
        ),
        (
            "[[track.segments]]\ntangent = \"400 ft\"\n[[track.segments]]\nspiral = \"200 ft\"\n\
             [[track.segments]]\ncurve = \"5000 ft\"\nradius = \"100 ft\"",
            &[
                "tighter than the 150 ft",
                "side bearings would move",
                "flanges press",
            ],
        ),
        (
            "start.distance = \"3 ft\"",
            &["before the beginning of the track", "start.distance"],
        ),
        (
            "[[track.segments]]\ntangent = \"4000 ft\"\nlenght = \"3 ft\"",
            &["there is no key `lenght`", "track.segments[0]"],
        ),
        ("track.file = \"bend.toml\"", &["`track.file`", "is not read"]),
        (
            "track.file = \"bend.toml\"\ntrack.segments = [{ tangent = \"900 ft\" }]",
            &["`track.segments` has no effect: `track.file` is the whole track"],
        ),
        (
            "lading.kind = \"masses\"",
            &["`lading.kind` is \"masses\", but there are none", "weight = "],
        ),
        (
            "lading.masses = [{ weight = \"1 kip\" }]",
            &["`lading.masses` has no effect", "lading.kind = \"masses\""],
        ),
        (
            "lading.kind = \"masses\"\n\
             lading.masses = [{ weight = \"200 kip\", place = [\"0 in\", \"40 in\", \"80 in\"], inertia = \
             [\"0 lbf in s^2\", \"0 lbf in s^2\", \"0 lbf in s^2\"] }]",
            &[
                "to the left of the middle, beyond the side bearings",
                "tips over them",
            ],
        ),
        (
            "lading.kind = \"masses\"\n\
             lading.masses = [{ weight = \"200 kip\", place = [\"400 in\", \"0 in\", \"80 in\"], inertia \
             = [\"0 lbf in s^2\", \"0 lbf in s^2\", \"0 lbf in s^2\"] }]",
            &["beyond the front truck", "the car tips"],
        ),
        (
            "lading.kind = \"empty\"\ntruck.side_bearing.preload = \"15 kip\"",
            &["more than the", "lift it off the center plate"],
        ),
        (
            "lading.kind = \"empty\"\ntruck.side_bearing.hysteresis = \"7000 lbf\"",
            &[
                "hysteresis of a side bearing is 7000 lbf, more than its preload of 6000 lbf",
                "would not follow the body back",
                "half the height of the loop",
            ],
        ),
        (
            "lading.kind = \"empty\"\ntruck.side_bearing.hysteresis = \"600 lbf\"\n\
             truck.side_bearing.damping = \"10 lbf s/in\"",
            &["two losses of one elastomer", "leave out its damping"],
        ),
        (
            "lading.kind = \"empty\"\ntruck.side_bearing.hysteresis = \"-600 lbf\"",
            &["`truck.side_bearing.hysteresis` is -600 lbf; it must be zero or greater"],
        ),
        (
            "truck.side_bearing.kind = \"roller\"\ntruck.side_bearing.hysteresis = \"600 lbf\"",
            &["there is no key `hysteresis` in `truck.side_bearing`"],
        ),
        (
            "car.torsion_stiffness = \"0 lbf in\"",
            &["`car.torsion_stiffness` is 0 lbf in; it must be greater than zero"],
        ),
        (
            "car.torsion_damping = 0.05",
            &[
                "`car.torsion_damping` has no effect: the body is rigid",
                "torsion_stiffness",
            ],
        ),
        (
            "wheels.geometry = \"linear\"",
            &[
                "linear wheels roll on rails that do not give way",
                "track.support.kind = \"rigid\"",
            ],
        ),
        (
            "wheels.profile = \"aar_1b_1:5\"",
            &["the run of the tread is 5", "at least 10"],
        ),
        ("wheels.profile = \"cone_x\"", &["names no profile", "cone_1:20"]),
        ("wheels.profile = \"worn.prw\"", &["`wheels.profile`", "worn.prw"]),
        ("rails.gauge = \"50 in\"", &["gauge"]),
        ("model_car = 3", &["there is no key `model_car`"]),
        ("truck = 3", &["`truck` is a number; a table is expected"]),
    ] {
        let messages = refused(lines);
        for part in parts {
            assert!(messages.contains(part), "{lines}\nlacks: {part}\n{messages}");
        }
    }
}

/// A wheel as the rail, a rail as the wheel, and a rail whose z = 0 is its foot, from files beside the case.
#[test]
fn issue_047_profiles_of_the_other_kind_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let write = |file: &str, profile: &Profile, height: f64| {
        let sample = profile.curve().sample(5e-4);
        let rows = sample.iter().map(|(_, point)| {
            let [y, z] = point.position.map(|own| 1e3 * own);
            format!("{y},{}\n", z + height)
        });
        let text = format!("y [mm],z [mm]\n{}", rows.collect::<String>());
        std::fs::write(folder.path().join(file), text).unwrap();
    };
    write("wheel.csv", &nominal::aar_1b().unwrap(), 0.0);
    write("rail.csv", &nominal::rail_136re().unwrap(), 0.0);
    write("foot.csv", &nominal::rail_136re().unwrap(), 185.7);
    let read = |lines: &str| {
        let text = format!("model = \"car\"\n{lines}");
        CarCase::parse("case.toml", &text, folder.path(), &[])
    };
    read("wheels.profile = \"wheel.csv\"\nrails.profile = \"rail.csv\"").unwrap();
    for (lines, parts) in [
        (
            "rails.profile = \"wheel.csv\"",
            [
                "`rails.profile`",
                "wheel.csv: this looks like a wheel",
                "name a file of a rail here, or 136re",
            ],
        ),
        (
            "wheels.profile = \"rail.csv\"",
            [
                "`wheels.profile`",
                "rail.csv: this looks like a rail",
                "name a file of a wheel here, or aar_1b",
            ],
        ),
        (
            "rails.profile = \"foot.csv\"",
            [
                "`rails.profile`",
                "its highest point is at z = 185.7",
                "add -185.7",
            ],
        ),
    ] {
        let messages = in_words(read(lines).unwrap_err().problems());
        for part in parts {
            assert!(messages.contains(part), "{lines}\nlacks: {part}\n{messages}");
        }
    }
}

/// A case of a car where another model is wanted, and the other way.
#[test]
fn input_models_are_told_apart() {
    let text = "model = \"car\"";
    let error = study::truck::TruckCase::parse("c.toml", text, Tables::nowhere(), &[]).unwrap_err();
    assert!(
        error.problems()[0]
            .to_string()
            .contains("is the case of a car; a truck's is expected")
    );
    let error = study::case::Case::parse("c.toml", text, Tables::nowhere(), &[]).unwrap_err();
    assert!(
        error.problems()[0]
            .to_string()
            .contains("is the case of a car; a single wedge's is expected")
    );
    let error = CarCase::parse("c.toml", "model = \"truck\"", Tables::nowhere(), &[]).unwrap_err();
    assert!(
        error.problems()[0]
            .to_string()
            .contains("is the case of a truck; a car's is expected")
    );
}

/// Doubtful inputs that are not wrong are kept for the summary.
#[test]
fn input_coils_that_would_go_solid_are_reported() {
    let text = "model = \"car\"\ntruck.load_springs.preload = \"2 kip\"";
    let case = CarCase::parse("c.toml", text, Tables::nowhere(), &[]).unwrap();
    assert!(
        case.doubts.iter().any(|own| own.contains("go solid")),
        "{:?}",
        case.doubts
    );
    let usual = CarCase::parse("c.toml", "model = \"car\"", Tables::nowhere(), &[]).unwrap();
    assert!(usual.doubts.is_empty(), "{:?}", usual.doubts);
}

/// A track must be as long as the way of a speed history: 20 s from 60 to 20 mph are 1,173 ft, the front axle
/// starts at 49.6 ft.
#[test]
fn input_length_of_a_track_counts_the_speeds_over_time() {
    let slowing = |length: f64| {
        let text = format!(
            "model = \"car\"\nspeed.kind = \"over_time\"\n\
             speed.over_time = [[\"0 s\", \"60 mph\"], [\"20 s\", \"20 mph\"]]\n\
             simulation.duration = \"20 s\"\n[[track.segments]]\ntangent = \"{length} ft\""
        );
        CarCase::parse("c.toml", &text, Tables::nowhere(), &[])
    };
    assert!(slowing(1221.0).is_err());
    assert!(slowing(1225.0).is_ok());
}

/// A car that slows down comes less far than at its first speed.
#[test]
fn input_length_of_a_track_counts_the_speeds_over_distance() {
    let slowing = |length: f64| {
        let text = format!(
            "model = \"car\"\nspeed.kind = \"over_distance\"\n\
             speed.over_distance = [[\"0 ft\", \"60 mph\"], [\"1000 ft\", \"20 mph\"]]\n\
             simulation.duration = \"20 s\"\n[[track.segments]]\ntangent = \"{length} ft\""
        );
        CarCase::parse("c.toml", &text, Tables::nowhere(), &[])
    };
    // From 26.4 ft to 1,000 ft in 18.4 s (a logarithm), then 46 ft at 20 mph; the front axle is 23.2 ft
    // ahead: 1,069 ft.
    assert!(slowing(1060.0).is_err());
    assert!(slowing(1080.0).is_ok());
}

/// Of files that a case names, a program that serves others tells the name as typed, the line and the kind of
/// a mistake: no content, no folder.
#[test]
fn issue_048_profiles_and_tracks_are_not_quoted_to_others() {
    let folder = tempfile::tempdir().unwrap();
    let case = folder.path().join("case");
    std::fs::create_dir(&case).unwrap();
    let rows: String = (0..600).map(|at| format!("{at},0.1\n")).collect();
    for (name, text) in [
        ("points.csv", "y [mm],z [mm]\n0,0\n1,SECRET\n".to_owned()),
        ("shape.csv", "y [mm],z [mm]\n987654,0\n1,0\n".to_owned()),
        ("words.csv", "SECRET: hunter2\n".to_owned()),
        ("table.csv", format!("distance_ft,profile_in\n{rows}600,SECRET\n")),
        (
            "gap.csv",
            format!("distance_ft,profile_in\n{rows}987654,0.1\n987655,\n"),
        ),
        ("toml.toml", "[[segments]]\ntangent = SECRET\n".to_owned()),
        (
            "keys.toml",
            "[[segments]]\ntangent = \"987654 ft\"\nSECRET = 1\n".to_owned(),
        ),
        (
            "names.toml",
            "[[segments]]\ntangent = \"500 ft\"\n[[irregularities]]\ntable = \"table.csv\"\nform = \
             \"space_curve\"\nsigns = \"usual\"\n"
                .to_owned(),
        ),
    ] {
        std::fs::write(case.join(name), text).unwrap();
    }
    let track = "segments = [{ tangent = \"500 ft\" }]\nirregularities = [{ form = \"space_curve\", signs = \
                 \"usual\", table = ";
    let texts = [
        ("wheels.profile = \"points.csv\"", "points.csv, line 3"),
        ("rails.profile = \"shape.csv\"", "shape.csv"),
        ("rails.profile = \"words.csv\"", "words.csv, line 1"),
        (
            &format!("[track]\n{track}\"table.csv\" }}]"),
            "the table, line 602",
        ),
        (&format!("[track]\n{track}\"gap.csv\" }}]"), "the table"),
        ("track.file = \"toml.toml\"", "toml.toml, line 2"),
        ("track.file = \"keys.toml\"", "keys.toml, line 3"),
        ("track.file = \"names.toml\"", "names.toml, line 4"),
        ("track.file = \"points.csv\"", "points.csv: no track file"),
    ];
    for (text, told) in texts {
        let error = CarCase::parse(
            "case.toml",
            &format!("model = \"car\"\n{text}\n"),
            Tables::below(&case),
            &[],
        )
        .unwrap_err();
        let shown = format!("{:?}", miette::Report::new(error));
        assert!(shown.contains(told), "{text}: {shown}");
        let secrets = [
            "SECRET",
            "hunter2",
            "987654",
            "300.79",
            &folder.path().display().to_string(),
        ];
        assert!(
            !secrets.iter().any(|secret| shown.contains(secret)),
            "{text}: {shown}"
        );
    }
}

/// Numbers of metres that were meant in inches, and heights out of reach.
#[test]
fn issue_048_lengths_in_another_unit_are_hinted_at() {
    let text = "model = \"car\"\n";
    let error = CarCase::of_values(
        "case.toml",
        text,
        Some("car.truck_distance = 486"),
        Tables::nowhere(),
    );
    let words = in_words(error.unwrap_err().problems());
    for part in [
        "`car.truck_distance` is 486 m; it must be between 1 and 100 m",
        "did you give inches (\"486 in\")",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
    let words = refused("car.accelerometer_height = \"40 ft\"");
    assert!(words.contains("between 0 and 10 m"), "{words}");
    let words = refused("rails.gauge = \"66 in\"");
    for part in [
        "the wheels do not reach both rails",
        "66.00 in",
        "lower the gauge to",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
}

/// The words at the key say where the first joint lies, and it lies there.
#[test]
fn issue_048_the_start_of_joints_is_their_first_lowest_point() {
    let lines = "simulation.duration = \"0.1 s\"\n[[track.segments]]\ntangent = \"500 ft\"\n\
                 [[track.irregularities]]\nshape = \"joints\"\nrails = \"left\"\ndirection = \"vertical\"\n\
                 depth = \"0.75 in\"\nstart = \"100 ft\"\n";
    let text = format!("model = \"car\"\n{lines}");
    let case = CarCase::parse("case.toml", &text, Tables::nowhere(), &[]).unwrap();
    assert!(
        case.to_toml().contains("lowest point of the first joint"),
        "{}",
        case.to_toml()
    );
    let foot = 0.3048;
    let height = |feet: f64| case.parameters.track.rails(feet * foot)[0].vertical[0];
    assert_eq!(height(80.0), 0.0, "level until half a spacing before");
    let lowest = (0..5000)
        .map(|k| 75.0 + 0.01 * f64::from(k))
        .min_by(|a, b| height(*a).total_cmp(&height(*b)));
    assert!((lowest.unwrap() - 100.0).abs() < 0.02, "{lowest:?}");
}
