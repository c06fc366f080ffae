//! Track files: what they become, and what is said of mistakes in them.
#![allow(missing_docs, clippy::unwrap_used)]

use study::track::TrackFile;

const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;

const CURVE: &str = r#"
[[segments]]
tangent = "500 ft"
[[segments]]
spiral = "200 ft"
[[segments]]
curve = "600 ft"
degree = "10 deg"
direction = "right"
superelevation = "4 in"
[[segments]]
spiral = "200 ft"
[[segments]]
tangent = "300 ft"
[[irregularities]]
shape = "sine"
direction = "vertical"
rails = "against"
amplitude = "1 in"
wavelength = "62 ft"
cycles = 4
start = "100 ft"
[[irregularities]]
shape = "jog"
direction = "lateral"
rails = "left"
offset = "0.5 in"
length = "20 ft"
start = "50 ft"
"#;

fn refused(text: &str) -> String {
    let error = TrackFile::parse("track.toml", text).unwrap_err();
    let problems = error.problems().iter();
    problems
        .map(|problem| {
            let help = miette::Diagnostic::help(problem).map(|help| help.to_string());
            format!("{problem}\n{}\n", help.unwrap_or_default())
        })
        .collect()
}

/// A curve of 10 degrees has a radius of 573.7 ft, right curves and their superelevation have the signs of the
/// conventions, and irregularities are on the rails that they are said to be on.
#[test]
fn analytic_a_track_is_what_its_file_says() {
    let file = TrackFile::parse("curve_10.toml", CURVE).unwrap();
    assert_eq!(file.name, "curve_10");
    let line = &file.track.center_line;
    assert!((line.length() / FOOT - 1800.0).abs() < 1e-9);
    let middle = line.at(1000.0 * FOOT);
    assert!(
        (-1.0 / middle.curvature[0] / FOOT - 573.686).abs() < 1e-2,
        "{:?}",
        middle.curvature
    );
    assert!(
        (middle.superelevation[0] / INCH + 4.0).abs() < 1e-9,
        "the left rail is the outer one"
    );
    let half = line.at(600.0 * FOOT);
    assert!((half.curvature[0] / middle.curvature[0] - 0.5).abs() < 1e-9);
    // A quarter of a wavelength of 62 ft after its beginning: 1 in of cross level.
    let [left, right] = file.track.rails((100.0 + 15.5) * FOOT);
    assert!((left.vertical[0] - right.vertical[0] - INCH).abs() < 1e-12);
    assert!((left.vertical[0] + right.vertical[0]).abs() < 1e-12);
    assert!((left.lateral[0] - 0.5 * INCH).abs() < 1e-12 && right.lateral[0] == 0.0);
}

#[test]
fn input_messages_of_track_files_say_what_to_write() {
    for (from, to, parts) in [
        (
            "spiral = \"200 ft\"",
            "spirl = \"200 ft\"",
            &["must have one of tangent, spiral, curve"][..],
        ),
        (
            "degree = \"10 deg\"",
            "degree = \"10 ft\"",
            &["`segments[2].degree`", "an angle is expected"],
        ),
        (
            "degree = \"10 deg\"",
            "degree = \"10 deg\"\nradius = \"500 ft\"",
            &["both `degree` and `radius`"],
        ),
        (
            "tangent = \"500 ft\"",
            "tangent = \"-5 ft\"",
            &["it must be positive"],
        ),
        (
            "tangent = \"500 ft\"",
            "tangent = 500",
            &["a length in quotes is expected"],
        ),
        (
            "direction = \"right\"",
            "direction = \"rihgt\"",
            &["cannot be \"rihgt\"", "right"],
        ),
        (
            "shape = \"sine\"",
            "shape = \"sin\"",
            &["cannot be \"sin\"", "did you mean \"sine\""],
        ),
        (
            "shape = \"jog\"",
            "spectrum = \"fra_lateral\"",
            &["there is no key `offset`"],
        ),
        ("cycles = 4", "cycles = 4.5", &["a whole number is expected"]),
        (
            "rails = \"left\"",
            "rail = \"left\"",
            &["there is no key `rail`", "did you mean `rails`"],
        ),
        (
            "[[segments]]\nspiral = \"200 ft\"\n[[segments]]\ncurve",
            "[[segments]]\ncurve",
            &["put a spiral between"],
        ),
    ] {
        assert!(CURVE.contains(from), "{from}");
        let message = refused(&CURVE.replacen(from, to, 1));
        for part in parts {
            assert!(message.contains(part), "{to}: {message}");
        }
    }
    assert!(refused("title = \"no track\"").contains("`segments` is missing"));
    let spectrum = "[[segments]]\ntangent = \"500 ft\"\n[[irregularities]]\nspectrum = \"fra_vertical\"\nclass = 9\ndirection = \"vertical\"\n";
    assert!(refused(spectrum).contains("no class 9"));
}
