//! What is said of a car's run is true of its own values.

use std::fmt::Write;
use std::path::Path;

use study::car::CarCase;
use study::case::Tables;
use study::run::Run;
use wheelrail::profile::{Profile, nominal};

/// Returns what is said of a run of a car with these lines, files from a folder.
fn said(lines: &str, folder: Option<&Path>) -> String {
    let text = format!("model = \"car\"\n{lines}");
    let tables = folder.map_or(Tables::nowhere(), Tables::from);
    let case = CarCase::parse("case.toml", &text, tables, &[]).unwrap();
    Run::new(&case)
        .unwrap()
        .result(None)
        .summary
        .assumptions
        .join("\n")
}

fn points(profile: &Profile) -> String {
    let mut text = "y [mm], z [mm]\n".to_owned();
    for (_, at) in profile.curve().sample(0.5e-3) {
        let [y, z] = at.position;
        writeln!(text, "{:.6}, {:.6}", 1e3 * y, 1e3 * z).unwrap();
    }
    text
}

#[test]
fn issue_047_assumptions_name_the_profiles_of_the_case() {
    let built_in = said("", None);
    for words in [
        "The profile of the wheels is aar_1b: nominal, from memory",
        "The profile of the rails is 136re: nominal, from memory",
    ] {
        assert!(built_in.contains(words), "{words}: {built_in}");
    }
    let folder = tempfile::tempdir().unwrap();
    let files = [
        ("my_wheel.csv", nominal::aar_1b()),
        ("my_rail.csv", nominal::rail_136re()),
    ];
    for (name, profile) in files {
        std::fs::write(folder.path().join(name), points(&profile.unwrap())).unwrap();
    }
    let own = said(
        "wheels.profile = \"my_wheel.csv\"\nrails.profile = \"my_rail.csv\"\nrails.inclination = 0.025",
        Some(folder.path()),
    );
    for words in [
        "The profile of the wheels is my_wheel.csv.",
        "The profile of the rails is my_rail.csv.",
    ] {
        assert!(own.contains(words), "{words}: {own}");
    }
    for words in ["nominal, from memory", "aar_1b", "AAR-1B", "136"] {
        assert!(!own.contains(words), "{words}: {own}");
    }
    let cone = said("wheels.profile = \"cone_1:20\"", None);
    assert!(cone.contains("cone_1:20, a cone without a flange"), "{cone}");
    assert!(!cone.contains("aar_1b"), "{cone}");
}

#[test]
fn issue_047_assumptions_are_those_of_other_values() {
    let usual = said("", None);
    for (lines, gone, there) in [
        (
            "wheels.creep = \"frictionless\"",
            "friction 0.4",
            "no creep forces.",
        ),
        (
            "wheels.creep = \"fastsim\"\nwheels.friction = 0.3",
            "creep after Polach, friction 0.4",
            "creep by FASTSIM, friction 0.3",
        ),
        (
            "[track]\nsegments = [{ tangent = \"5000 ft\" }]\n[track.support]\nkind = \"sprung\"\n\
             mass = \"300 kg\"",
            "its values are guesses",
            "on springs, with the values of the track.",
        ),
        (
            "output.wheel_filter = \"20 Hz\"",
            "Filters, times, distances and limits of the statistics are remembered",
            "are the case's own ([output])",
        ),
        (
            "start.settle = \"0 s\"\nstart.axle_shift = \"0.2 in\"",
            "wheels rolling; statistics begin at 2 s",
            "wheels rolling, moved aside by the shifts of [start]; statistics begin at 0 s",
        ),
        (
            "front_truck.warp_spring.kind = \"new\"",
            "never",
            "warp is counted twice",
        ),
    ] {
        let own = said(lines, None);
        assert!(own.contains(there) && !usual.contains(there), "{there}: {own}");
        assert!(!own.contains(gone), "{gone}: {own}");
    }
}

/// A body that twists and hysteresis of side bearings are told, and not told where there are none.
#[test]
fn input_twist_and_hysteresis_are_told() {
    let plain = said("", None);
    assert!(
        !plain.contains("two rigid halves") && !plain.contains("Hysteresis"),
        "{plain}"
    );
    let text = said(
        "car.torsion_stiffness = \"1e8 lbf in\"\n\
         truck.side_bearing = { kind = \"constant_contact\", hysteresis = \"600 lbf\" }",
        None,
    );
    // 4 x 1e8 lbf in over 1.81e6 lbf in s^2.
    assert!(text.contains("freely at 2.37 Hz"), "{text}");
    assert!(text.contains("a slider behind a spring"), "{text}");
}
