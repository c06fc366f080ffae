//! input, limits: profiles and radii of each wheel, profiles of each rail, files from measuring devices.

use std::sync::Arc;

use car::{ProfiledWheels, Wheels};
use study::car::CarCase;
use study::case::Tables;
use study::run::Run;

use crate::problems::in_words;

fn on_rails(case: &CarCase) -> &ProfiledWheels {
    match &case.parameters.wheels {
        Wheels::OnRails(own) => own,
        Wheels::Linear { .. } => panic!("profiles are expected"),
    }
}

fn read(lines: &str) -> CarCase {
    let text = format!("model = \"car\"\n{lines}");
    CarCase::parse("case.toml", &text, Tables::nowhere(), &[])
        .unwrap_or_else(|error| panic!("{}", in_words(error.problems())))
}

const EACH: &str = "
[wheels]
profile = \"cone_1:20\"
radius = \"18 in\"
[wheels.left]
profile = \"cylinder\"
[wheels.axle_2]
radius = \"17.9 in\"
[wheels.axle_2.right]
profile = \"cone_1:10\"
radius = \"17.8 in\"
[wheels.axle_4]
profile = \"aar_1b\"
[rails.right]
profile = \"136re_8in\"
[start]
kind = \"nominal\"
";

/// What is said of one wheel goes before its wheelset, that before its side, that before all; rails have
/// their own, too. Written and read again the car is the same.
#[test]
fn input_each_wheel_and_rail_may_have_its_own() {
    let case = read(EACH);
    let again = CarCase::parse("again.toml", case.to_toml_embedded(), Tables::nowhere(), &[]).unwrap();
    for case in [&case, &again] {
        let own = on_rails(case);
        let slope = |axle: usize, side: usize| {
            let wheel = &own.wheels[axle - 1][side];
            wheel.curve().at(wheel.curve().range()[1]).angle().tan()
        };
        for (axle, slopes) in [
            (1, [0.0, 0.05]),
            (2, [0.0, 0.1]),
            (3, [0.0, 0.05]),
            (4, [0.05, 0.05]),
        ] {
            for side in 0..2 {
                let (found, wanted) = (slope(axle, side), slopes[side]);
                assert!((found - wanted).abs() < 1e-12, "axle {axle}: {found} {wanted}");
            }
        }
        let radius =
            |axle: usize, side: usize| own.geometry[axle - 1].pairs()[side].nominal_radius() / 0.0254;
        for (axle, radii) in [(1, [18.0, 18.0]), (2, [17.9, 17.8]), (4, [18.0, 18.0])] {
            for side in 0..2 {
                assert!((radius(axle, side) - radii[side]).abs() < 1e-12, "axle {axle}");
            }
        }
        let crown = |rail: usize| {
            let curve = own.rails[rail].curve();
            let [start, end] = curve.range();
            1.0 / own.rails[rail].convexity(0.5 * (start + end)) / 0.0254
        };
        assert!((crown(0) - 10.0).abs() < 1e-9 && (crown(1) - 8.0).abs() < 1e-9);
        // Alike wheelsets are one.
        assert!(Arc::ptr_eq(&own.geometry[0], &own.geometry[2]));
        assert!(!Arc::ptr_eq(&own.geometry[0], &own.geometry[1]));
        let mean = (18.0 + 17.85 + 18.0 + 18.0) / 4.0 * 0.0254;
        assert!((case.parameters.wheel_radius() - mean).abs() < 1e-12);
        assert!((case.parameters.axle_radius(1) - 17.85 * 0.0254).abs() < 1e-12);
    }
    let words = Run::new(&case)
        .unwrap()
        .result(None)
        .summary
        .assumptions
        .join("\n");
    for part in [
        "the left wheel of axle 1 is cylinder",
        "the right wheel of axle 2 is cone_1:10",
        "the left wheel of axle 4 is aar_1b",
        "the left rail is 136re",
        "the right rail is 136re_8in",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
}

/// Wheels that are said to be what they are by default make the same car, bit by bit.
#[test]
fn limits_alike_wheels_are_the_same_car() {
    let usual = read("");
    let said = read("[wheels.left]\nprofile = \"aar_1b\"\n[wheels.axle_3.right]\nradius = \"18 in\"\n");
    let start = |case: &CarCase| {
        let car = car::Car::new(&case.parameters).unwrap();
        car.initial_state
            .iter()
            .map(|own| own.to_bits())
            .collect::<Vec<_>>()
    };
    assert_eq!(start(&usual), start(&said));
    assert!(
        on_rails(&usual)
            .geometry
            .iter()
            .all(|own| Arc::ptr_eq(own, &on_rails(&usual).geometry[0]))
    );
    assert!((usual.parameters.wheel_radius().to_bits()) == (18.0 * 0.0254_f64).to_bits());
}

/// A file of MiniProf beside a case: from the back of its flange; another radius than that of the case is
/// doubted; so is a gauge that leaves no clearance.
#[test]
fn input_files_of_measuring_devices() {
    let folder = tempfile::tempdir().unwrap();
    let wheel = wheelrail::profile::nominal::aar_1b().unwrap();
    let mut mini = "ProgramName=MiniProf for Windows\nDiameterTaperline=900\n\n".to_owned();
    let mut csv = "y [mm], z [mm]\n".to_owned();
    for (_, point) in wheel.curve().sample(5e-4) {
        let [y, z] = point.position.map(|own| 1e3 * own);
        mini += &format!("{:.5} {:.5}\n", y + 77.7875, -z);
        csv += &format!("{:.5}, {z:.5}\n", y + 77.7875);
    }
    std::fs::write(folder.path().join("worn.whl"), mini).unwrap();
    std::fs::write(folder.path().join("worn.csv"), csv).unwrap();
    let parse = |lines: &str| {
        let text = format!("model = \"car\"\n{lines}");
        CarCase::parse("case.toml", &text, folder.path(), &[])
    };
    let back = "wheels.tape_from_back = \"3.0625 in\"\n";
    let case = parse(&format!("wheels.left.profile = \"worn.whl\"\n{back}")).unwrap();
    let bottom = on_rails(&case).wheels[0][0].bottom();
    assert!((bottom[1] + 0.0254).abs() < 3e-5, "{bottom:?}");
    let doubt = case
        .doubts
        .iter()
        .find(|own| own.contains("states 450.00 mm for wheels.radius"));
    assert!(
        doubt.is_some_and(|own| own.contains("wheels.left.profile")),
        "{:?}",
        case.doubts
    );
    // Its name goes with the case into a folder.
    let (text, files) = case.packed();
    assert_eq!(files.len(), 1);
    assert!(text.contains("files/1_wheels_profile.whl"), "{text}");

    let messages = in_words(parse("wheels.profile = \"worn.csv\"").unwrap_err().problems());
    assert!(messages.contains("wheels.datum = \"flange_back\""), "{messages}");
    let said = format!("wheels.profile = \"worn.csv\"\nwheels.datum = \"flange_back\"\n{back}");
    assert!(parse(&said).is_ok());

    let narrow = parse("rails.gauge = \"55.75 in\"").unwrap();
    let doubt = narrow
        .doubts
        .iter()
        .find(|own| own.contains("flangeway clearance of wheelset 1"));
    assert!(doubt.is_some(), "{:?}", narrow.doubts);
    let messages = in_words(
        parse("wheels.axle_1.left.profile = \"aar_2a\"")
            .unwrap_err()
            .problems(),
    );
    assert!(
        messages.contains("AAR-2A") && messages.contains("wheels.axle_1.left.profile"),
        "{messages}"
    );
}

/// A car on strips runs through a curve: its wheel forces are those with ellipses within 3 % of the static
/// load; the assumptions name the patches; tables are refused.
#[test]
fn limits_a_car_runs_on_strips() {
    let lines = |patch: &str| {
        format!(
            "[track]\nsegments = [{{ tangent = \"60 ft\" }}, {{ spiral = \"60 ft\" }}, {{ curve = \
             \"100 ft\", degree = \"5 deg\" }}]\n[speed]\nvalue = \"30 mph\"\n[wheels]\npatch = \
             \"{patch}\"\n[start]\nsettle = \"0 s\"\n[simulation]\nduration = \"3 s\"\n"
        )
    };
    let [ellipse, strips] = ["ellipse", "strips"].map(|patch| {
        let case = read(&lines(patch));
        let result = Run::new(&case).unwrap().finish(|_| ());
        assert!(result.summary.complete, "{patch}: {:?}", result.summary.stopped);
        result
    });
    for name in ["axle_1_left_vertical", "axle_1_right_vertical"] {
        let [a, b] = [&ellipse, &strips].map(|result| result.column(name).unwrap());
        let (a, b) = (a[a.len() - 1], b[b.len() - 1]);
        assert!((a - b).abs() < 0.03 * a.abs(), "{name}: {a} {b}");
    }
    let words = strips.summary.assumptions.join("\n");
    assert!(words.contains("on strips of half-spaces"), "{words}");
    let text = "model = \"car\"\n[wheels]\npatch = \"strips\"\ntables = true\n";
    let error = CarCase::parse("case.toml", text, Tables::nowhere(), &[]).unwrap_err();
    let words = in_words(error.problems());
    assert!(words.contains("tables of contacts hold ellipses"), "{words}");
}
