//! The files: that all are whole, and what bad ones say.

use std::fs;

use quantity::Quantity;
use study::car::builtin;
use study::car::regime::Regime;
use study::case::CaseError;

use super::case;

const WHOLE: &str = "\
name = \"mine\"
source = \"measured\"
speeds = [\"30 mph\", \"40 mph\"]
range = [\"20 mph\", \"60 mph\"]
reason = \"it was measured at 60 mph\"
distance = \"300 ft\"
settle = \"60 ft\"
[set]
wheels.friction = 0.3
[track]
segments = [{ tangent = \"500 ft\" }]
";

/// Every message with its help and its place.
fn messages(error: &CaseError) -> String {
    let problems = error.problems().iter().map(|problem| {
        let place = problem.line_and_column();
        format!("{problem} {} {place:?}\n", problem.advice().unwrap_or_default())
    });
    problems.collect()
}

/// All built-in regimes are there in their order; each says that its numbers are remembered, has six speeds
/// or two, and makes a valid case of the loaded and the empty car at all of them and at both ends of its
/// range.
#[test]
fn input_built_in_regimes_are_whole() {
    let names = [
        "hunting",
        "twist_and_roll",
        "pitch_and_bounce",
        "yaw_and_sway",
        "dynamic_curving",
        "constant_curve",
        "spiral",
        "bunched_spiral",
        "constant_curve_10",
        "constant_curve_12",
        "single_bump",
        "curve_with_bump",
        "curve_with_dip",
        "lean",
        "static_curve",
        "buff_curve",
        "draft_curve",
        "fra_class_1",
        "fra_class_2",
        "fra_class_3",
        "fra_class_4",
        "fra_class_5",
    ];
    let found: Vec<&str> = Regime::all().iter().map(|own| own.name.as_str()).collect();
    assert_eq!(found, names);
    for regime in Regime::all() {
        let name = &regime.name;
        let remembered = ["remembered", "check against your edition"].map(|own| regime.source.contains(own));
        let read = regime.source.contains("read in 49 CFR 213.57");
        assert!(read || remembered == [true; 2], "{name}: {}", regime.source);
        assert!(!regime.title.is_empty() && !regime.looks_at.is_empty() && !regime.reason.is_empty());
        // A car that creeps has the same loads at every speed: two show it.
        let speeds = if name == "static_curve" { 2 } else { 6 };
        assert_eq!(regime.speeds.len(), speeds, "{name}");
        for speed in regime.speeds.iter().chain(&regime.range) {
            for lading in ["loaded", "empty"] {
                let own = case(name, lading, speed.text(), &[]);
                let way = own.speed() * own.simulation.duration;
                let wanted = regime.distance.to_si();
                assert!((own.speed() / speed.to_si() - 1.0).abs() < 1e-12);
                assert!(
                    way >= wanted && way < wanted + 0.051 * own.speed(),
                    "{name} {speed}"
                );
            }
        }
    }
}

/// A built-in case with the name of a regime is the regime's at one of its speeds. Those that slow down on a
/// track of their own have every key that the regime sets, but for the start.
#[test]
fn input_built_in_cases_share_the_settings_of_their_regimes() {
    let mut found = Vec::new();
    for name in builtin::names() {
        let ladings = ["_loaded", "_empty"];
        let own = ladings.iter().find_map(|lading| name.strip_suffix(lading));
        let own = own.and_then(|own| own.strip_prefix("car_")).unwrap_or_default();
        let slows_down = own.starts_with("hunting");
        let Some(regime) = Regime::named(if slows_down { "hunting" } else { own }) else {
            continue;
        };
        let with = |settings: &[String]| builtin::case_with(name, settings).unwrap();
        let case = with(&[]);
        for line in &regime.set {
            let same = with(std::slice::from_ref(line)) == case;
            assert!(
                same || (slows_down && line.starts_with("start.")),
                "{name}: {line}"
            );
        }
        let at = |speed: &Quantity| with(&regime.settings(speed).unwrap()) == case;
        assert!(slows_down != regime.speeds.iter().any(at), "{name}");
        found.push(regime.name.as_str());
    }
    found.dedup();
    // Each regime has one.
    let missing: Vec<_> = Regime::all()
        .iter()
        .filter(|own| !found.contains(&own.name.as_str()))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// Settings of a regime reach the case; other settings stay the car's.
#[test]
fn input_settings_reach_the_case() {
    let regime = Regime::parse("mine.toml", WHOLE).unwrap();
    let text = "model = \"car\"\nwheels.friction = 0.5\nspeed.kind = \"over_distance\"\n\
                speed.over_distance = [[\"0 ft\", \"60 mph\"]]\ntruck.condition = \"mu_0.25\"\n\
                track.segments = [{ tangent = \"1 mi\" }]\n";
    let settings = regime.settings(&Quantity::parse("30 mph").unwrap()).unwrap();
    let read = |settings: &[String]| {
        study::car::CarCase::parse("car.toml", text, study::case::Tables::nowhere(), settings).unwrap()
    };
    let own = read(&settings);
    assert!((own.parameters.track.center_line.length() - 500.0 * 0.3048).abs() < 1e-9);
    assert!((own.speed() - 30.0 * 0.447_04).abs() < 1e-12);
    // 300 ft at 44 ft/s are 6.818 s, 60 ft 1.364 s.
    assert!(
        (own.simulation.duration - 6.85).abs() < 1e-12,
        "{}",
        own.simulation.duration
    );
    assert!((own.parameters.start.settle - 1.364).abs() < 1e-12);
    assert_eq!(own.parameters.trucks, read(&[]).parameters.trucks);
    assert!(own.to_toml().contains("friction = 0.3"));
}

/// Speeds beyond what the track bears are refused with the reason of the file; digits of units are not.
#[test]
fn input_speeds_outside_of_the_range_are_explained() {
    let regime = Regime::named("fra_class_3").unwrap();
    let error = regime.settings(&Quantity::parse("45 mph").unwrap()).unwrap_err();
    let message = messages(&error);
    assert!(
        message.contains("fra_class_3 is for 5 mph to 40 mph, not for 45 mph"),
        "{message}"
    );
    assert!(message.contains("49 CFR 213.9"), "{message}");
    assert!(
        regime
            .settings(&Quantity::parse("64.37376 km/h").unwrap())
            .is_ok()
    );
    assert!(regime.settings(&Quantity::parse("4.9 mph").unwrap()).is_err());
}

/// Mistakes are shown at their lines, and say what to write.
#[test]
fn input_mistakes_are_shown_where_they_are() {
    for (from, to, line, parts) in [
        (
            "distance",
            "distanze",
            6,
            &["no key `distanze` in a regime", "did you mean `distance`?"][..],
        ),
        (
            "source = \"measured\"\n",
            "",
            0,
            &["`source` is missing", "write source"],
        ),
        (
            "\"30 mph\", \"40 mph\"",
            "\"40 mph\", \"30 mph\"",
            3,
            &["`speeds` has 30 mph after 40 mph"],
        ),
        ("\"30 mph\", \"40 mph\"", "", 3, &["`speeds` has 0 entries"]),
        (
            "\"30 mph\", \"40 mph\"",
            "\"30 lbf\"",
            3,
            &["this is a force", "a speed is expected"],
        ),
        (
            "\"40 mph\"]",
            "\"70 mph\"]",
            3,
            &["70 mph, outside of the range, 20 mph to 60 mph", "widen"],
        ),
        (
            "[\"20 mph\", \"60 mph\"]",
            "[\"60 mph\"]",
            4,
            &["`range` has 1 speeds; two are expected"],
        ),
        (
            "[\"20 mph\", \"60 mph\"]",
            "\"60 mph\"",
            4,
            &["`range` is text; a list is expected"],
        ),
        (
            "\"60 ft\"",
            "\"400 ft\"",
            7,
            &["`settle` is 400 ft, but the car runs 300 ft"],
        ),
        ("\"60 ft\"", "\"60 s\"", 7, &["this is a time"]),
        (
            "wheels.friction = 0.3",
            "speed.value = \"3 mph\"",
            9,
            &["`set.speed` cannot be set", "speeds ="],
        ),
        (
            "wheels.friction = 0.3",
            "simulation.duration = \"3 s\"",
            9,
            &["set.simulation.duration", "distance ="],
        ),
        ("tangent", "tangens", 11, &["one of tangent, spiral, curve"]),
        (
            "[track]\nsegments = [{ tangent = \"500 ft\" }]\n",
            "",
            0,
            &["`track` is missing", "write [track]"],
        ),
        (
            "source = ",
            "lading = \"full\"\nsource = ",
            2,
            &["`lading` cannot be \"full\"", "\"loaded\""],
        ),
    ] {
        let text = WHOLE.replacen(from, to, 1);
        assert_ne!(text, WHOLE);
        let error = Regime::parse("mine.toml", &text).unwrap_err();
        let message = messages(&error);
        for part in parts {
            assert!(message.contains(part), "{part}: {message}");
        }
        if line > 0 {
            let lines = error.problems().iter().filter_map(|own| own.line_and_column());
            assert!(
                lines.map(|(own, _)| own).any(|own| own == line),
                "{line}: {message}"
            );
        }
    }
}

/// A file is tried on a car: a track that is too short and a key that no case has are shown in the file.
/// Files that the track names are found from anywhere.
#[test]
fn input_files_are_tried_on_a_car() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    fs::write(&path, WHOLE.replace("name = \"mine\"\n", "")).unwrap();
    assert_eq!(Regime::read(&path).unwrap().name, "mine");
    for (from, to, line, part) in [
        ("500 ft", "300 ft", 10, "the track is 300 ft long"),
        (
            "wheels.friction = 0.3",
            "wheels.frictoin = 0.3",
            9,
            "there is no key `frictoin`",
        ),
        (
            "wheels.friction = 0.3",
            "wheels.friction = \"0.3\"",
            9,
            "a number without quotes",
        ),
    ] {
        fs::write(&path, WHOLE.replacen(from, to, 1)).unwrap();
        let error = Regime::read(&path).unwrap_err();
        let message = messages(&error);
        assert!(message.contains(part), "{message}");
        let own = &error.problems()[0];
        assert_eq!(
            own.source_name(),
            Some(path.display().to_string().as_str()),
            "{message}"
        );
        assert_eq!(
            own.line_and_column().map(|(line, _)| line),
            Some(line),
            "{message}"
        );
    }
    fs::write(
        folder.path().join("my_track.toml"),
        "[[segments]]\ntangent = \"500 ft\"\n",
    )
    .unwrap();
    let track = "[track]\nsegments = [{ tangent = \"500 ft\" }]";
    fs::write(&path, WHOLE.replace(track, "[track]\nfile = \"my_track.toml\"")).unwrap();
    let regime = Regime::read(&path).unwrap();
    let settings = regime.settings(&regime.speeds[0]).unwrap();
    let elsewhere = std::path::Path::new("/");
    let own = study::car::CarCase::parse("car.toml", "model = \"car\"", elsewhere, &settings).unwrap();
    assert!((own.parameters.track.center_line.length() - 500.0 * 0.3048).abs() < 1e-9);
    fs::write(&path, WHOLE.replace(track, "[track]\nfile = \"none.toml\"")).unwrap();
    let message = messages(&Regime::read(&path).unwrap_err());
    assert!(
        message.contains("none.toml") && message.contains("(11,"),
        "{message}"
    );
}

/// Names and files; a name that is nearly one.
#[test]
fn input_regimes_are_named_or_read() {
    assert_eq!(Regime::named_or_read("spiral").unwrap().name, "spiral");
    let message = messages(&Regime::named_or_read("twist_and_rol").unwrap_err());
    assert!(message.contains("did you mean twist_and_roll?"), "{message}");
    assert!(messages(&Regime::named_or_read("none.toml").unwrap_err()).contains("none.toml"));
}
