//! input, analytic, limits: MiniProf, VAMPIRE, CONTACT's slices; datum, senses, loops.
//!
//! All files are written here from lines and arcs, so that the right numbers are closed forms.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use wheelrail::conicity::RollingRadiusDifference;
use wheelrail::contact::Side;
use wheelrail::hertz::Material;
use wheelrail::profile::{
    Points, Profile, ProfileError, ProfileKind, ReadOptions, SlicedProfile, WheelDatum, nominal,
};
use wheelrail::wheelset::{Layout, RigidWheelset};

const STEEL: Material = Material {
    youngs_modulus: 207e9,
    poisson: 0.28,
};
const LAYOUT: Layout = Layout {
    tape_distance: 1.5,
    gauge: 1.45,
    gauge_depth: 14e-3,
};

/// Points (mm) of a wheel with a tread of 1:20 and a flange of 28 mm, y from the tape circle to the field
/// side and z up, from the field side to the flange: a tread up to -38 mm, a face of 70° and a tip of radius
/// 12 mm.
fn wheel() -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = (0..=196)
        .map(|i| 60.0 - 0.5 * f64::from(i))
        .map(|y| [y, 0.05 * y])
        .collect();
    let (slope, radius) = (70f64.to_radians(), 12.0);
    let bottom = -28.0;
    // The face begins where the tread ends, and touches the circle of the tip.
    let [y0, z0] = [-38.0, -1.9];
    let center_z = bottom + radius;
    let center_y = y0 + (center_z - z0 - radius / slope.cos()) / slope.tan();
    let from = slope - std::f64::consts::FRAC_PI_2;
    for i in 0..=60 {
        let angle = from - f64::from(i) * (from + std::f64::consts::PI) / 60.0;
        points.push([center_y + radius * angle.cos(), center_z + radius * angle.sin()]);
    }
    points
}

/// Points (mm) of a rail: a crown of radius 300 mm, z up, top at zero.
fn rail() -> Vec<[f64; 2]> {
    (-60..=60)
        .map(|i| 0.5 * f64::from(i))
        .map(|y| [y, (300.0 * 300.0 - y * y).sqrt() - 300.0])
        .collect()
}

fn rows(points: &[[f64; 2]], third: &str) -> String {
    let mut text = String::new();
    for [x, y] in points {
        writeln!(text, " {x:.6} {y:.6}{third}").unwrap();
    }
    text
}

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn file(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    }
}

fn read(path: &Path, kind: ProfileKind) -> Result<Profile, ProfileError> {
    Profile::read(path, kind, 2e-5)
}

/// Conicity of cones of 1:20 on crowns of radius 0.3 m, whose centers are `half` (m) from the middle of the
/// track: the roll of the wheelset moves its contacts along the crowns.
fn on_crowns(half: f64) -> f64 {
    let angle = libm::atan(0.05);
    0.05 * half / (half - 0.3 * libm::sin(angle))
}

fn conicity(wheels: [&Profile; 2], radii: [f64; 2], rails: [&Profile; 2], amplitude: f64) -> f64 {
    let wheelset = RigidWheelset::new(wheels, radii, rails, LAYOUT, STEEL).unwrap();
    let positions = wheelset.sweep(0.018, 360, false);
    let difference = RollingRadiusDifference::of_positions(&positions).unwrap();
    let [left, right] = radii;
    difference
        .equivalent_conicity(amplitude, 0.5 * (left + right), LAYOUT.tape_distance)
        .unwrap()
        .by_wavelength
}

/// Points of a wheel from the back of its flange, y positive to the tip: as MiniProf has them.
fn from_back(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().map(|[y, z]| [y + 70.0, 0.3 - z]).collect()
}

/// The same wheel in both headers of MiniProf, with a third column, from either side, with offsets, capitals,
/// other taper lines: the taper line lies in the origin, and the tread has its slope.
#[test]
fn input_miniprof_wheels_of_both_headers() {
    let folder = Folder::new();
    let own = from_back(&wheel());
    let key = "ProgramName=MiniProf for Windows\nSide=L\nXYPoints=258\n";
    let rest = "ColumnDef=X,Y\nDiameterTaperline=840.0\n\n";
    let backwards: Vec<[f64; 2]> = own.iter().rev().copied().collect();
    let shifted: Vec<[f64; 2]> = own.iter().map(|[x, y]| [x - 3.0, y + 1.0]).collect();
    let turned: Vec<[f64; 2]> = own.iter().map(|[x, y]| [*x, -y]).collect();
    let exchanged: Vec<[f64; 2]> = own.iter().map(|[x, y]| [*y, *x]).collect();
    let far: Vec<[f64; 2]> = own.iter().map(|[x, y]| [x + 7.0, *y]).collect();
    let old: String = (1..=8)
        .map(|line| format!("\"old header\" line {line}\n"))
        .collect();
    let commas = rows(&own, "\t0,5").replace('.', ",");
    let files = [
        ("new.whl", format!("{key}{rest}{}", rows(&own, ""))),
        ("CAPITALS.WHL", format!("{key}{rest}{}", rows(&own, ""))),
        ("backwards.whl", format!("{key}{rest}{}", rows(&backwards, ""))),
        (
            "offset.whl",
            format!("{key}XOffset=3\nYOffset=-1\n{rest}{}", rows(&shifted, "")),
        ),
        ("down.whl", format!("{key}{rest}{}", rows(&turned, ""))),
        (
            "columns.whl",
            format!(
                "{key}ColumnDef=Y,X,A\nDiameterTaperline=840\n\n{}",
                rows(&exchanged, " 0.1")
            ),
        ),
        (
            "line.whl",
            format!("{key}WheelDiameterTaperline=77\n{rest}{}", rows(&far, "")),
        ),
        ("third.mpt", format!("{key}{rest}{}", rows(&own, " 0.25"))),
        ("old.whl", format!("{old}{}", rows(&own, ""))),
        ("commas.whl", format!("{old}{commas}")),
        ("bare.whl", rows(&own, "")),
    ];
    for (name, text) in files {
        let wheel = read(&folder.file(name, &text), ProfileKind::Wheel).unwrap();
        assert_eq!(wheel.notices(), [], "{name}");
        let bottom = wheel.bottom();
        assert!((bottom[1] + 28e-3).abs() < 3e-5, "{name}: {bottom:?}");
        for (_, point) in wheel.curve().sample(1e-3) {
            let [y, z] = point.position;
            assert!(y < -0.037 || (z - 0.05 * y).abs() < 3e-5, "{name}: {y} {z}");
        }
        let stated = (!text.starts_with('"') && name != "bare.whl").then_some(0.42);
        assert_eq!(wheel.stated().radius, stated, "{name}");
        let back = if name == "line.whl" { -77e-3 } else { -70e-3 };
        assert!((wheel.flange_back().unwrap() - back).abs() < 1e-12);
        let rail = nominal::cylinder(0.3, 0.03).unwrap();
        for amplitude in [1e-3, 3e-3, 5e-3] {
            let found = conicity([&wheel; 2], [0.42; 2], [&rail; 2], amplitude);
            assert!((found - on_crowns(0.755)).abs() < 2e-4, "{name}: {found}");
        }
    }
}

/// MiniProf's rails, y up or down: top at zero, the crown's radius.
#[test]
fn input_miniprof_rails_up_and_down() {
    let folder = Folder::new();
    let key = "Filename=a.ban\nProgramName=MiniProf for Windows\nRail=Left\nColumnDef=X,Y\n\n";
    let down: Vec<[f64; 2]> = rail().iter().map(|[y, z]| [*y, -z]).collect();
    for (name, points) in [("up.ban", rail()), ("down.BAN", down)] {
        let path = folder.file(name, &format!("{key}{}", rows(&points, "")));
        let rail = Profile::read(&path, ProfileKind::Rail, 0.0).unwrap();
        assert!(rail.top()[1].abs() < 1e-8, "{:?}", rail.top());
        let [start, end] = rail.curve().range();
        let crown = 1.0 / rail.convexity(0.5 * (start + end));
        assert!((crown - 0.3).abs() < 1e-3, "{name}: {crown}");
        let cone = nominal::cone(0.05, 0.05).unwrap();
        for amplitude in [1e-3, 4e-3, 8e-3] {
            let found = conicity([&cone; 2], [0.46; 2], [&rail; 2], amplitude);
            assert!((found - on_crowns(0.755)).abs() < 2e-4, "{name}: {found}");
        }
        // The extension tells the kind.
        let error = Profile::read(&path, ProfileKind::Wheel, 0.0).unwrap_err();
        assert!(
            error.to_string().contains("this is the profile of a rail"),
            "{error}"
        );
    }
}

/// VAMPIRE: both sides, tape circles by name, the distance of the tape circles; unlike sides are told.
#[test]
fn input_vampire_wheels_and_rails() {
    let folder = Folder::new();
    for (datum, from_back) in [
        ("EUROPEAN", 70.0),
        ("US1", 72.231_25),
        ("US2", 77.7875),
        ("CUSTOM 71.5", 71.5),
    ] {
        let mut text = format!("WHEELPROFILE\na title\nTREADDATUM {datum}\nFLANGEBACK 1360.0\n");
        for [y, z] in wheel() {
            let y = 680.0 + from_back + y;
            writeln!(text, "{:.6}, {z:.6}, {y:.6}, {z:.6} ! comment", -y).unwrap();
        }
        let path = folder.file("wheels.WHE", &text);
        let wheel = read(&path, ProfileKind::Wheel).unwrap();
        assert_eq!(wheel.notices(), []);
        let [_, bottom] = wheel.bottom();
        assert!((bottom + 28e-3).abs() < 3e-5, "{bottom}");
        let distance = wheel.stated().tape_distance.unwrap();
        assert!(
            (distance - 1e-3 * (1360.0 + 2.0 * from_back)).abs() < 1e-9,
            "{distance}"
        );
        for (_, point) in wheel.curve().sample(1e-3) {
            let [y, z] = point.position;
            assert!(y < -0.037 || (z - 0.05 * y).abs() < 3e-5, "{datum}: {y} {z}");
        }
    }
    // A rail whose left section is worn by 2 mm; z from the middle of the track's plane.
    let mut text = "RAILPROFILE\nunlike\nGAUGEPOINT US\nGAUGE 1435.1\n".to_owned();
    for [y, z] in rail() {
        writeln!(
            text,
            "{:.6} {:.6} {:.6} {:.6}",
            -750.0 - y,
            z - 2.0,
            750.0 + y,
            0.7 * z
        )
        .unwrap();
    }
    let path = folder.file("rails.rai", &text);
    let one = read(&path, ProfileKind::Rail).unwrap();
    assert_eq!(one.notices().len(), 1);
    let notice = &one.notices()[0];
    assert!(
        notice.text.contains("differ by up to 2.451 mm; the right one"),
        "{}",
        notice.text
    );
    assert!(notice.advice.contains("--left-rail"), "{}", notice.advice);
    assert!((one.stated().gauge_depth.unwrap() - 15.875e-3).abs() < 1e-12);
    let of = |side| {
        let options = ReadOptions {
            side: Some(side),
            ..ReadOptions::default()
        };
        Profile::read_with(&path, ProfileKind::Rail, &options).unwrap()
    };
    let [left, right] = [of(Side::Left), of(Side::Right)];
    assert!(left.notices().is_empty() && right.notices().is_empty());
    let fall = |rail: &Profile| rail.curve().at(0.0).position[1];
    let depth = 1e-3 * (300.0 - (300f64 * 300.0 - 900.0).sqrt());
    assert!((fall(&left) + depth).abs() < 1e-8, "{}", fall(&left));
    assert!((fall(&right) + 0.7 * depth).abs() < 1e-8, "{}", fall(&right));
}

/// Points from the back of the flange in a file that does not say so: refused or doubted with the way out,
/// which is right.
#[test]
fn input_points_from_the_back_of_the_flange() {
    let folder = Folder::new();
    let csv = |title: &str, back: f64| {
        let mut text = format!("{title} [mm], z [mm]\n");
        for [y, z] in wheel() {
            writeln!(text, "{:.6}, {:.6}", y + back, z).unwrap();
        }
        text
    };
    let path = folder.file("wheel.csv", &csv("y", 70.0));
    let error = read(&path, ProfileKind::Wheel).unwrap_err();
    let (text, remedy) = (error.to_string(), error.remedy());
    assert!(
        text.contains("y = 0, the datum, lies outside of the points"),
        "{text}"
    );
    assert!(
        remedy.contains("--datum flange_back") && remedy.contains("--tape-from-back"),
        "{remedy}"
    );
    let options = |back: f64| ReadOptions {
        datum: Some(WheelDatum::FlangeBack),
        tape_from_back: Some(back),
        ..ReadOptions::default()
    };
    let placed = Profile::read_with(&path, ProfileKind::Wheel, &options(70e-3)).unwrap();
    let column = folder.file("column.csv", &csv("y_from_back", 70.0));
    let named = Profile::read(&column, ProfileKind::Wheel, 0.0).unwrap();
    for wheel in [&placed, &named] {
        let rail = nominal::cylinder(0.3, 0.03).unwrap();
        let found = conicity([wheel; 2], [0.46; 2], [&rail; 2], 3e-3);
        assert!((found - on_crowns(0.755)).abs() < 2e-4, "{found}");
        assert!(wheel.notices().is_empty());
    }
    let error = Profile::read_with(&path, ProfileKind::Wheel, &options(0.2)).unwrap_err();
    assert!(error.to_string().contains("200.000 mm from the back"), "{error}");
    // The datum within the points, but not where it is on wheels: beside the tip, and behind it.
    for (back, found) in [(30.0, "doubt"), (-30.0, "doubt"), (60.0, "refused")] {
        let path = folder.file("wheel.csv", &csv("y", back));
        let made = read(&path, ProfileKind::Wheel);
        match found {
            "doubt" => {
                let wheel = made.unwrap();
                assert_eq!(wheel.notices().len(), 1, "{back}");
                let notice = &wheel.notices()[0];
                assert!(
                    notice.text.contains("the tip of the flange lies"),
                    "{}",
                    notice.text
                );
                assert!(notice.advice.contains("--datum flange_back"), "{}", notice.advice);
                let sure = ReadOptions {
                    datum: Some(WheelDatum::Tape),
                    ..ReadOptions::default()
                };
                let wheel = Profile::read_with(&path, ProfileKind::Wheel, &sure).unwrap();
                assert!(wheel.notices().is_empty());
            }
            _ => {
                let error = made.unwrap_err();
                assert!(error.to_string().contains("y = 0 lies behind the tip"), "{error}");
                assert!(error.remedy().contains("--datum flange_back"));
            }
        }
    }
    // Nominal wheels of both continents are not doubted.
    let wheel = nominal::aar_1b().unwrap();
    let points: Vec<[f64; 2]> = wheel
        .curve()
        .sample(5e-4)
        .iter()
        .map(|(_, p)| p.position)
        .collect();
    let wheel = Profile::of_points(&Points::new("aar", &points), ProfileKind::Wheel, 0.0).unwrap();
    assert_eq!(wheel.notices(), []);
}

/// Loops of noise go and are counted; a crossing of 5 mm is refused.
#[test]
fn limits_loops_of_noise_are_taken_away_and_crossings_refused() {
    let smooth = rail();
    let mut noisy = Vec::new();
    for (i, [y, z]) in smooth.iter().enumerate() {
        noisy.push([1e-3 * y, 1e-3 * z]);
        if [20, 70, 100].contains(&i) {
            // A loop of 0.05 mm.
            let [y, z] = [1e-3 * (y + 0.2), 1e-3 * z];
            noisy.extend([
                [y, z],
                [y + 5e-5, z + 4e-5],
                [y - 1e-5, z + 4e-5],
                [y + 3e-5, z - 4e-5],
            ]);
        }
    }
    let points = Points::new("noisy.csv", &noisy);
    let rail = Profile::of_points(&points, ProfileKind::Rail, 2e-5).unwrap();
    let notices = rail.notices();
    assert_eq!(notices.len(), 1, "{notices:?}");
    assert!(
        notices[0].text.contains("noisy.csv, line")
            && notices[0].text.contains(": 3 loops smaller than 0.1 mm"),
        "{}",
        notices[0].text
    );
    for [y, z] in smooth.iter().map(|point| point.map(|length| 1e-3 * length)) {
        let sample = rail.curve().sample(1e-5);
        let nearest = sample
            .iter()
            .map(|(_, point)| libm::hypot(point.position[0] - y, point.position[1] - z))
            .fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-4, "{y}: {nearest}");
    }
    let mut crossing: Vec<[f64; 2]> = smooth
        .iter()
        .map(|point| point.map(|length| 1e-3 * length))
        .collect();
    crossing.splice(
        60..60,
        [[3e-3, 1e-3], [3e-3, 5e-3], [-4e-3, 5e-3], [-4e-3, -2e-3]],
    );
    let error = Profile::of_points(&Points::new("crossing", &crossing), ProfileKind::Rail, 2e-5).unwrap_err();
    assert!(matches!(error, ProfileError::SelfCrossing { .. }), "{error}");
}

/// A rail whose crown falls by 2 mm in 1 m: linear between both slices.
#[test]
fn analytic_slices_are_linear_between_files() {
    let folder = Folder::new();
    let prr = |fall: f64| {
        let points: Vec<[f64; 2]> = rail().iter().map(|[y, z]| [*y, fall - z]).collect();
        format!(
            "header.begin\n type=0\nheader.end\nspline.begin\n units.len.f=1000.\n point.begin\n{} \
             point.end\n\
             spline.end\n",
            rows(&points, "")
        )
    };
    folder.file("a.prr", &prr(0.0));
    folder.file("b.prr", &prr(2.0));
    let text = "% two slices\n 0.000 1000.0 U_OFFSET, S_SCALE, m\n 2 NSLC\n 0 0 0 NFEAT, NKINK, NACCEL\n 1 \
                U_INTPOL\n \
                0.0 'a.prr'\n 1.0 'b.prr'\n";
    let path = folder.file("rails.slcs", text);
    let sliced = SlicedProfile::read(&path, &ReadOptions::default()).unwrap();
    assert_eq!(sliced.places(), [0.0, 1.0]);
    for place in [0.0, 0.25, 0.5, 1.0] {
        let rail = sliced.at(place).unwrap();
        let [_, top] = rail.top();
        assert!((top + 2e-3 * place).abs() < 1e-9, "{place}: {top}");
        let [start, end] = rail.curve().range();
        assert!((rail.convexity(0.5 * (start + end)) * 0.3 - 1.0).abs() < 0.01);
        let rise = sliced.rise(place, 1e-3).unwrap().unwrap();
        assert!((rise + 2e-3).abs() < 1e-9, "{rise}");
    }
    let error = Profile::read(&path, ProfileKind::Rail, 0.0).unwrap_err();
    assert!(error.to_string().contains("a list of sections"), "{error}");
    assert!(error.remedy().contains("--at"), "{}", error.remedy());
    let error = sliced.at(1.5).unwrap_err();
    assert!(error.to_string().contains("reach from 0 to 1 m"), "{error}");
    for (text, found) in [
        (
            "0 1000\n2\n0 0\n1\n0 'a.prr'\n",
            "the list has 1 slices; its header says 2",
        ),
        (
            "0 1000\n2\n0 0\n1\n1 'a.prr'\n1 'b.prr'\n",
            "line 6: the places of slices must grow",
        ),
        ("0 1000\n1\n0 0\n1\n1 a.prr\n", "line 5: 1 a.prr names no file"),
        ("0\n", "line 1: 2 numbers are expected"),
        ("0 1\n", "line 1: the list ends within its header"),
        ("0 1\n0.5\n", "line 2: a list has 1 to 2000 slices"),
        ("0 x\n", "line 1: x is no number"),
    ] {
        let error = SlicedProfile::list("list", text, ProfileKind::Rail).unwrap_err();
        assert!(error.to_string().contains(found), "{error}");
    }
    let missing = folder.file("other.SLCS", "0 1\n1\n0 0\n1\n0 'none.prr'\n");
    let error = SlicedProfile::read(&missing, &ReadOptions::default()).unwrap_err();
    assert!(error.to_string().contains("there is no profile"), "{error}");
}

/// Slices around a wheel: the angle comes back after a turn, and the gap between the last and the first slice
/// is linear too.
#[test]
fn analytic_slices_around_a_wheel() {
    let folder = Folder::new();
    for (name, fall) in [("a.csv", 0.0), ("b.csv", 1.0)] {
        let mut text = "y [mm], z [mm]\n".to_owned();
        for [y, z] in wheel() {
            writeln!(text, "{y:.6}, {:.6}", z + fall).unwrap();
        }
        folder.file(name, &text);
    }
    let path = folder.file("w.slcw", "0 1.0\n2\n0 0\n1\n-1.5 'a.csv'\n 1.5 'b.csv'\n");
    let sliced = SlicedProfile::read(&path, &ReadOptions::default()).unwrap();
    let turn = std::f64::consts::TAU;
    for (angle, raised) in [
        (-1.5, 0.0),
        (0.0, 0.5),
        (0.75, 0.75),
        (turn, 0.5),
        (0.5 * turn, 0.5),
        (1.5 + 0.25 * (turn - 3.0), 0.75),
    ] {
        let [_, bottom] = sliced.at(angle).unwrap().bottom();
        assert!(
            (bottom - 1e-3 * (raised - 28.0)).abs() < 1e-6,
            "{angle}: {bottom}"
        );
    }
}

/// Mistakes in files are told with their line.
#[test]
fn input_mistakes_in_other_formats_are_reported_with_place() {
    for (text, found) in [
        ("Side=L\n\n1 2\n3 x\n", "line 4: x is no number"),
        ("Side=L\n\n1 2\n3\n", "line 4: a number is missing"),
        ("ColumnDef=X,A\n", "line 1: ColumnDef names no column Y"),
        ("XOffset=a\n", "line 1: a is no number"),
    ] {
        let error = Points::from_miniprof("a.whl", text, None).unwrap_err();
        assert!(error.to_string().contains(found), "{error}");
    }
    for (text, found) in [
        ("", "line 1: the file ends within its header"),
        ("PROFILE\n", "line 1: neither WHEELPROFILE nor RAILPROFILE"),
        (
            "WHEELPROFILE\nt\nTREADDATUM ASIAN\nFLANGEBACK 1\n",
            "line 3: this line must name the TREADDATUM",
        ),
        (
            "WHEELPROFILE\nt\nTREADDATUM US1\nGAUGE 1\n",
            "line 4: this line must name the FLANGEBACK",
        ),
        (
            "RAILPROFILE\nt\nGAUGEPOINT CUSTOM x\nGAUGE 1\n",
            "line 3: x is no number",
        ),
        (
            "RAILPROFILE\nt\nGAUGEPOINT US\nGAUGE 1\n1 2 3\n",
            "line 5: a row has less than four",
        ),
    ] {
        let error = Points::from_vampire("a.whe", text, None).unwrap_err();
        assert!(
            error.to_string().to_lowercase().contains(&found.to_lowercase()),
            "{error}"
        );
    }
}

/// A cylinder on the left and a cone of 1:20 on the right: the difference of the radii is 0.05 y, half of
/// that of two cones.
#[test]
fn analytic_conicity_of_unlike_wheels() {
    let (cylinder, cone) = (
        nominal::cone(0.0, 0.05).unwrap(),
        nominal::cone(0.05, 0.05).unwrap(),
    );
    let rail = nominal::rail_136re().unwrap().inclined(nominal::INCLINATION);
    for amplitude in [1e-3, 3e-3, 5e-3, 7.9e-3] {
        let found = conicity([&cylinder, &cone], [0.46; 2], [&rail; 2], amplitude);
        assert!((found - 0.025).abs() < 5e-4, "{amplitude}: {found}");
    }
}

/// Cones of unlike radii: the kinematic motion is about y = (r2 - r1)/(2 λ), left positive.
#[test]
fn analytic_offset_of_unlike_radii() {
    let cone = nominal::cone(0.05, 0.06).unwrap();
    let rail = nominal::cylinder(0.3, 0.03).unwrap();
    for radii in [[0.46, 0.4595], [0.4598, 0.46], [0.46, 0.46]] {
        let wheelset = RigidWheelset::new([&cone; 2], radii, [&rail; 2], LAYOUT, STEEL).unwrap();
        let positions = wheelset.sweep(0.012, 240, false);
        let difference = RollingRadiusDifference::of_positions(&positions).unwrap();
        let expected = (radii[1] - radii[0]) / 0.1;
        let found = difference.equilibrium().unwrap();
        assert!(
            (found - expected).abs() <= 0.01 * expected.abs() + 1e-9,
            "{found} {expected}"
        );
        let of_motion = difference.equivalent_conicity(3e-3, 0.46, 1.5).unwrap();
        assert!((of_motion.middle - expected).abs() <= 0.01 * expected.abs() + 1e-9);
        assert!((of_motion.by_wavelength - on_crowns(0.755)).abs() < 2e-4);
    }
}
