//! Track files: what they become, and what is said of mistakes in them.

use crate::problems::in_words;
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
    in_words(error.problems())
}

/// A curve of 10 degrees has a radius of 573.7 ft, right curves and their superelevation have the signs of
/// the conventions, and irregularities are on the rails that they are said to be on.
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
    let spectrum = "[[segments]]\ntangent = \"500 ft\"\n[[irregularities]]\nspectrum = \"fra_vertical\"\n\
                    class = 9\ndirection = \"vertical\"\n";
    assert!(refused(spectrum).contains("no class 9"));
}

/// A circle may be run but not closed: its ends must stay 6 m (19.7 ft) apart, as chord; a track that crosses
/// itself is refused with both distances, a table as well as segments.
#[test]
fn input_tracks_that_come_back_near_themselves_are_refused() {
    let radius = 150.0;
    let circle = |gap: f64| {
        let length = std::f64::consts::TAU * radius - gap;
        format!("[[segments]]\ncurve = \"{length} m\"\nradius = \"{radius} m\"\n")
    };
    assert!(TrackFile::parse("open.toml", &circle(6.1)).is_ok());
    let message = refused(&circle(5.9));
    // 2 π 150 m - 5.9 m = 3072.7 ft
    for part in [
        "at 3073 ft (937 m)",
        "within 20 ft",
        "at 0 ft (0 m)",
        "end the track before",
    ] {
        assert!(message.contains(part), "{message}");
    }
    // Straight on, 270 deg around, and across: the loop leaves the tangent's end, at 100 m, to the left and
    // crosses the tangent 100 m before it ends.
    let mut table = "distance [m],curvature [1/m]\n,left\n0,0\n200,0\n".to_owned();
    let turn = 1.5 * std::f64::consts::PI * 100.0;
    table += &format!("200.001,0.01\n{},0.01\n{},0\n", 200.001 + turn, 200.002 + turn);
    let crossing = |after: f64| {
        let table = format!("{table}{},0\n", 200.002 + turn + after);
        let track = "[center_line]\ntable = \"loop.csv\"\n";
        let folder = in_folder(&[("loop.csv", table), ("track.toml", track.to_owned())]);
        TrackFile::read(&folder.path().join("track.toml"))
            .err()
            .map(|error| error.to_string())
    };
    assert_eq!(crossing(90.0), None);
    let message = crossing(110.0).unwrap();
    // The first pair within 6 m: the tangent at 94 .. 96 m; 200 m + 471.2 m + 100 m = 771 m.
    let distance = |mark: &str| -> f64 {
        let (_, rest) = message.split_once(mark).unwrap();
        let (_, metres) = rest.split_once('(').unwrap();
        metres.split_once(" m)").unwrap().0.parse().unwrap()
    };
    assert!((distance("at ") - 771.0).abs() <= 6.0, "{message}");
    assert!((distance("lies at ") - 100.0).abs() <= 6.0, "{message}");
}

fn in_folder(files: &[(&str, String)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn refused_file(folder: &tempfile::TempDir) -> String {
    let error = TrackFile::read(&folder.path().join("track.toml")).unwrap_err();
    in_words(error.problems())
}

/// A table beside the track file gives irregularities and the center line; support and cubic spirals are
/// read.
#[test]
fn analytic_measured_tables_are_part_of_a_track() {
    use study::track::Support;
    let mut table =
        "distance [ft],left_profile [in],curvature [1/ft],superelevation [in]\n,down,right,right_high\n"
            .to_owned();
    for k in 0..=1000 {
        table += &format!("{k},0.25,-0.001,3\n");
    }
    let track = "support = { kind = \"rigid\" }\n[center_line]\ntable = \"car.csv\"\n[[irregularities]]\n\
                 table = \"car.csv\"\nform = \"space_curve\"\n";
    let folder = in_folder(&[("car.csv", table.clone()), ("track.toml", track.to_owned())]);
    let file = TrackFile::read(&folder.path().join("track.toml")).unwrap();
    assert_eq!(file.support, Support::Rigid);
    let middle = file.track.center_line.at(500.0 * FOOT);
    assert!(
        (middle.curvature[0] * FOOT - 0.001).abs() < 1e-12,
        "right is negative, twice"
    );
    assert!((middle.superelevation[0] - 3.0 * INCH).abs() < 1e-12);
    let [left, right] = file.track.rails(500.0 * FOOT);
    assert!((left.vertical[0] + 0.25 * INCH).abs() < 1e-12 && right.vertical[0] == 0.0);
    let cubic = CURVE.replace("spiral = \"200 ft\"", "spiral = \"200 ft\"\nform = \"cubic\"");
    let cubic = TrackFile::parse("cubic.toml", &cubic).unwrap();
    let line = &cubic.track.center_line;
    let quarter = line.at(550.0 * FOOT).curvature[0] / line.at(900.0 * FOOT).curvature[0];
    assert!((quarter - 0.156_25).abs() < 1e-9, "{quarter}");
    let Support::Sprung(rail) = cubic.support else {
        panic!("tracks are sprung if nothing is said");
    };
    assert_eq!([rail.stiffness[1], rail.mass], [80e6, 345.0]);
    assert!((rail.damping[0] - 140e3 / 3.0).abs() < 1e-9);
    let stiff = format!(
        "{CURVE}\n[support]\nkind = \"sprung\"\nvertical_stiffness = \"100 kN/mm\"\nmass = \"200 kg\"\n"
    );
    let Support::Sprung(rail) = TrackFile::parse("stiff.toml", &stiff).unwrap().support else {
        panic!("sprung");
    };
    assert!((rail.stiffness[1] - 1e8).abs() < 1.0);
    // It rests on its spring.
    assert!((rail.preload - 200.0 * 9.806_65).abs() < 1e-9);
}

/// Spirals by their names: lateral offset at the end of 100 m into 1000 m; the older names are the first two.
#[test]
fn analytic_spirals_by_their_names() {
    let offset = |form: &str| {
        let text = format!(
            "[[segments]]\ntangent = \"30 m\"\n[[segments]]\nspiral = \"100 m\"\nform = \"{form}\"\n\
             [[segments]]\ncurve = \"50 m\"\nradius = \"1000 m\"\nsuperelevation = \"0.1 m\"\n"
        );
        let file = TrackFile::parse("spiral.toml", &text);
        file.map(|file| file.track.center_line.at(130.0).position[1])
    };
    for (form, expected) in [
        ("clothoid", 1.6667),
        ("bloss", 1.5),
        ("cosine", 1.4868),
        ("sine", 1.4134),
        ("helmert", 1.4583),
        ("cubic_parabola", 1.6721),
        ("linear", 1.6667),
        ("cubic", 1.5),
    ] {
        let found = offset(form).unwrap();
        assert!((found / expected - 1.0).abs() < 2e-3, "{form}: {found}");
    }
    let message = in_words(offset("euler").unwrap_err().problems());
    assert!(
        message.contains("clothoid") && message.contains("helmert"),
        "{message}"
    );
}

/// FRA's class 4 written by its coefficients, in units of several sources, gives the same rails; without
/// units, with a negative density or with unknown units it is refused.
#[test]
fn input_spectra_of_users_state_their_units() {
    let track = |spectrum: &str| {
        format!(
            "[[segments]]\ntangent = \"500 ft\"\n[[irregularities]]\n{spectrum}\n\
             direction = \"vertical\"\nseed = 3\n"
        )
    };
    let read = |spectrum: &str| TrackFile::parse("own.toml", &track(spectrum));
    let published = read("spectrum = \"fra_vertical\"\nclass = 4").unwrap();
    // k A Ωc² / (Ωc² Ω² + Ω⁴): A in cm² rad/m, by rad/m; then by cycles/m in mm².
    let (a, corner) = (0.25 * 0.5376, 0.8245_f64 * 0.8245);
    let radians = format!(
        "spectrum = \"rational\"\nnumerator = [{}]\ndenominator = [0, 0, {corner}, 0, 1]\n\
         wavenumber = \"rad/m\"\ndensity = \"cm²/(rad/m)\"",
        a * corner
    );
    let tau = std::f64::consts::TAU;
    let cycles = format!(
        "spectrum = \"rational\"\nnumerator = [{}]\ndenominator = [0, 0, {}, 0, {}]\n\
         wavenumber = \"cycle/m\"\ndensity = \"mm^2/(cycle/m)\"",
        100.0 * tau * a * corner,
        corner * tau * tau,
        tau.powi(4)
    );
    for own in [&radians, &cycles] {
        let own = read(own).unwrap();
        for distance in [20.0, 77.0, 140.0] {
            let [[left, _], [expected, _]] = [&own, &published].map(|file| file.track.rails(distance));
            let difference = left.vertical[0] - expected.vertical[0];
            assert!(
                difference.abs() < 1e-12 && expected.vertical[0].abs() > 1e-5,
                "{difference}"
            );
        }
    }
    for (spectrum, parts) in [
        (
            radians.replace("wavenumber = \"rad/m\"\n", ""),
            &["wavenumber` is missing", "another track"][..],
        ),
        (
            radians.replace("density = \"cm²/(rad/m)\"", ""),
            &["density` is missing", "cm^2/(rad/m)"],
        ),
        (
            radians.replace("cm²/(rad/m)", "cm²"),
            &["cannot be \"cm²\"", "the square of m, cm, mm or in"],
        ),
        (
            radians.replace("numerator = [", "numerator = [-"),
            &["the density is -", "by rising powers"],
        ),
        (
            radians.replace("numerator = [", "numerator = [\"1 m\", "),
            &["a list of 1 to 8 plain numbers"],
        ),
    ] {
        let text = refused(&track(&spectrum));
        for part in parts {
            assert!(text.contains(part), "{part}\n{text}");
        }
    }
}

#[test]
fn input_irregularities_must_cover_the_track_and_be_space_curves() {
    let mut table = "distance [ft],left_profile [in]\n,up\n".to_owned();
    for k in 0..=800 {
        table += &format!("{k},0.25\n");
    }
    let track = |length: u32, more: &str| {
        format!("[[segments]]\ntangent = \"{length} ft\"\n[[irregularities]]\ntable = \"car.csv\"\n{more}")
    };
    for (length, more, parts) in [
        (700, "", &["form` is missing", "mid-chord"][..]),
        (
            900,
            "form = \"space_curve\"",
            &["ends at 800.0 ft", "900.0 ft long", "beyond = \"level\""],
        ),
        (700, "form = \"mid_chord\"", &["chord"]),
        (
            700,
            "form = \"mid_chord\"\nchord = \"62 ft\"\nshortest = \"20 ft\"\nlongest = \"200 ft\"",
            &["cannot be inverted"],
        ),
        (
            700,
            "form = \"space_curve\"\nsigns = \"row\"\ntaper = \"500 ft\"",
            &["taper"],
        ),
        (
            700,
            "form = \"space_curve\"\nsigns = \"usual\"",
            &["car.csv:2", "a number is missing, under distance"],
        ),
    ] {
        let folder = in_folder(&[("car.csv", table.clone()), ("track.toml", track(length, more))]);
        let message = refused_file(&folder);
        assert!(
            parts.iter().all(|part| message.contains(part)),
            "{more}: {message}"
        );
    }
    let level = in_folder(&[
        ("car.csv", table.clone()),
        (
            "track.toml",
            track(900, "form = \"space_curve\"\nbeyond = \"level\""),
        ),
    ]);
    assert!(TrackFile::read(&level.path().join("track.toml")).is_ok());
    let none = in_folder(&[("track.toml", track(700, "form = \"space_curve\""))]);
    assert!(refused_file(&none).contains("car.csv"));
    let both = format!("{CURVE}\n[center_line]\ntable = \"car.csv\"\n");
    assert!(refused(&both).contains("either `center_line` or `segments`"));
    // 1000 waves from 1.5 to 91.44 m repeat themselves after 5003 ft.
    let long = "[[segments]]\ntangent = \"9000 ft\"\n[[irregularities]]\nspectrum = \"fra_vertical\"\n\
                direction = \"vertical\"\n";
    let message = refused(long);
    assert!(
        message.contains("repeats itself after 5003 ft") && message.contains("terms = 1799"),
        "{message}"
    );
    let own = long.replace("fra_vertical", "psd.csv");
    assert!(refused(&own).contains("unit"), "{}", refused(&own));
}
