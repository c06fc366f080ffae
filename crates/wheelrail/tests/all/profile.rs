//! analytic, input, limits: profiles of arcs and lines, from points and files, and what is refused.

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

use wheelrail::profile::{ChainElement, Points, Profile, ProfileError, ProfileKind, check_gauge, nominal};

const INCH: f64 = 0.0254;

fn manchester(file: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data/manchester")
        .join(file)
}

/// Directions are continuous at joints and along the curve, curvatures are the radii's.
fn assert_tangential(profile: &Profile) {
    let curve = profile.curve();
    let [_, end] = curve.range();
    for joint in curve.joints().skip(1) {
        let (before, after) = (curve.at(joint - 1e-9), curve.at(joint));
        for axis in 0..2 {
            let jump = (after.position[axis] - before.position[axis]).abs();
            assert!(
                jump < 2e-9,
                "{}: a gap of {jump} m at {joint} of {end}",
                profile.name()
            );
        }
        let turn = (after.angle() - before.angle()).abs();
        assert!(
            turn < 1e-6,
            "{}: a corner of {turn} rad at {joint} of {end}",
            profile.name()
        );
    }
}

/// A quarter circle between two lines at a right angle: the length and the points are known.
#[test]
fn analytic_a_fillet_between_lines() {
    let elements = [
        ChainElement::Line {
            point: [-1.0, 0.0],
            angle: 0.0,
        },
        ChainElement::Fillet { radius: -0.25 },
        ChainElement::Line {
            point: [0.0, -1.0],
            angle: -FRAC_PI_2,
        },
    ];
    let profile =
        Profile::of_chain("corner", ProfileKind::Rail, [-1.0, 0.0], &elements, [0.0, -1.0]).unwrap();
    let [start, end] = profile.curve().range();
    assert_eq!(start, 0.0);
    assert!((end - (1.5 + 0.125 * PI)).abs() < 1e-12, "{end}");
    let middle = profile.curve().at(0.5 * end);
    let expected = 0.25 * 0.5f64.sqrt() - 0.25;
    assert!((middle.position[0] - expected).abs() < 1e-12 && (middle.position[1] - expected).abs() < 1e-12);
    assert!((middle.angle() + 0.25 * PI).abs() < 1e-12);
    assert!((profile.convexity(0.5 * end) - 4.0).abs() < 1e-12);
    assert_tangential(&profile);
}

/// Circles of 10 and 2 with a fillet of 3 between them, turning the other way: the center lies 13 and 5 from
/// theirs.
#[test]
fn analytic_a_fillet_between_circles() {
    let elements = [
        ChainElement::Circle {
            center: [0.0, 0.0],
            radius: -10.0,
        },
        ChainElement::Fillet { radius: 3.0 },
        ChainElement::Circle {
            center: [14.0, 4.0],
            radius: -2.0,
        },
    ];
    let profile = Profile::of_chain("wave", ProfileKind::Rail, [-10.0, 0.0], &elements, [14.0, 6.0]).unwrap();
    assert_tangential(&profile);
    let joints: Vec<f64> = profile.curve().joints().collect();
    let [p, q] = [joints[1], joints[2]].map(|joint| profile.curve().at(joint).position);
    let center = p.map(|coordinate| coordinate * 1.3);
    for (point, apart) in [([0.0, 0.0], 13.0), ([14.0, 4.0], 5.0), (q, 3.0)] {
        let found = f64::hypot(center[0] - point[0], center[1] - point[1]);
        assert!((found - apart).abs() < 1e-9, "{found} {apart}");
    }
}

/// Every dimension that the heads of the nominal profiles name.
#[test]
fn analytic_dimensions_of_the_nominal_wheel() {
    let wheel = nominal::aar_1b().unwrap();
    assert_tangential(&wheel);
    assert!(wheel.note().contains("from memory"));
    assert!(
        (wheel.bottom()[1] + INCH).abs() < 1e-9,
        "the flange is 1 in high: {:?}",
        wheel.bottom()
    );
    let back = -(3.0 + 1.0 / 16.0) * INCH;
    let face = wheel.flange_face(0.625 * INCH).unwrap();
    assert!(
        (face - back - (1.0 + 5.0 / 32.0) * INCH).abs() < 1e-7,
        "thickness {}",
        face - back
    );
    let [start, end] = wheel.curve().range();
    let [first, last] = [start, end].map(|at| wheel.curve().at(at).position);
    assert!((last[0] - first[0] - (5.0 + 23.0 / 32.0) * INCH).abs() < 1e-9);
    // The tread passes the tape circle with 1:20; nothing is steeper than the flange's 75° before its tip.
    let sample = wheel.curve().sample(1e-4);
    let steepest = sample
        .iter()
        .filter(|(_, point)| point.position[1] > -0.6 * INCH)
        .map(|(_, point)| point.angle())
        .filter(|angle| *angle > 0.0)
        .fold(0.0, f64::max);
    assert!(
        (steepest - 75f64.to_radians()).abs() < 1e-9,
        "{}",
        steepest.to_degrees()
    );
    let outer: Vec<_> = sample
        .iter()
        .filter(|(_, point)| point.position[0] > 0.0)
        .collect();
    assert!(outer.iter().all(|(_, p)| {
        (p.position[1] - p.position[0] / 20.0).abs() < 1e-12 && (p.angle().tan() - 0.05).abs() < 1e-12
    }));
    // Radii: throat 9/16 and 1 1/2 in, concave; tip 1/2 in, convex.
    let joints: Vec<f64> = wheel.curve().joints().chain([end]).collect();
    let radii: Vec<f64> = joints
        .windows(2)
        .map(|ends| 1.0 / wheel.convexity(0.5 * (ends[0] + ends[1])) / INCH)
        .collect();
    for (found, expected) in radii[1..]
        .iter()
        .zip([0.5, f64::INFINITY, -9.0 / 16.0, -1.5, f64::INFINITY])
    {
        assert!(
            found == &expected || (found - expected).abs() < 1e-9,
            "{found} {expected}"
        );
    }
    assert_eq!(radii.len(), 6);
    assert_eq!(nominal::cone(0.05, 0.05).unwrap().flange_face(0.001), None);
}

#[test]
fn analytic_dimensions_of_the_nominal_rail() {
    let rail = nominal::rail_136re().unwrap();
    assert_tangential(&rail);
    assert!(rail.note().contains("from memory"));
    assert!(
        rail.top().iter().all(|coordinate| coordinate.abs() < 1e-8),
        "{:?}",
        rail.top()
    );
    let width = -2.0 * rail.gauge_point(nominal::GAUGE_DEPTH);
    assert!(
        (width / INCH - (2.0 + 15.0 / 16.0)).abs() < 1e-6,
        "{}",
        width / INCH
    );
    let [start, end] = rail.curve().range();
    assert!((rail.convexity(0.5 * (start + end)) - 0.1 / INCH).abs() < 1e-9);
    // It is its own mirror image.
    let sample = rail.curve().sample(1e-3);
    for ((_, a), (_, b)) in sample.iter().zip(sample.iter().rev()) {
        assert!((a.position[0] + b.position[0]).abs() < 1e-9 && (a.position[1] - b.position[1]).abs() < 1e-9);
    }
    // Inclined towards the track's center, its top lies further out, by the crown's radius times the angle.
    let top = rail.inclined(nominal::INCLINATION).top();
    assert!(
        (top[0] - 10.0 * INCH * 0.025 / (1.0f64 + 0.025 * 0.025).sqrt()).abs() < 1e-6,
        "{top:?}"
    );
}

/// A spline through points of a circle of 300 mm: deviation zero at the points, fourth order between them.
#[test]
fn analytic_a_spline_through_points_of_a_circle() {
    let error = |count: usize| {
        let points: Vec<[f64; 2]> = (0..=count)
            .map(|i| {
                let angle = 0.25 * (i as f64 / count as f64 - 0.5);
                [0.3 * angle.sin(), 0.3 * angle.cos() - 0.3]
            })
            .collect();
        let profile = Profile::of_points(&Points::new("arc", &points), ProfileKind::Rail, 0.0).unwrap();
        assert!(profile.deviation().largest < 1e-16);
        assert_eq!(profile.deviation().points, count + 1);
        let sample = profile.curve().sample(1e-4);
        // Natural ends bend straight: the middle half is judged.
        let middle = sample[sample.len() / 4..3 * sample.len() / 4].iter();
        middle
            .map(|(_, p)| (f64::hypot(p.position[0], p.position[1] + 0.3) - 0.3).abs())
            .fold(0.0, f64::max)
    };
    let [coarse, fine] = [20, 40].map(error);
    assert!(coarse < 1e-8 && fine < coarse / 12.0, "{coarse} {fine}");
}

/// Noise of 5 μm on a circle: the fit stays within the stated deviation, uses it, and its curvature is nearer
/// to the circle's than that of the spline through the points.
#[test]
fn analytic_smoothing_keeps_the_stated_deviation() {
    let mut random = 1u64;
    let mut noise = || {
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        5e-6 * ((random >> 11) as f64 / (1u64 << 52) as f64 - 1.0)
    };
    let points: Vec<[f64; 2]> = (0..=200)
        .map(|i| {
            let angle = 0.25 * (f64::from(i) / 200.0 - 0.5);
            [0.3 * angle.sin(), 0.3 * angle.cos() - 0.3 + noise()]
        })
        .collect();
    let points = Points::new("noisy", &points);
    let roughness = |deviation: f64| {
        let profile = Profile::of_points(&points, ProfileKind::Rail, deviation).unwrap();
        let found = profile.deviation();
        assert!(
            found.largest <= deviation.max(1e-15),
            "{} {deviation}",
            found.largest
        );
        assert!(
            deviation == 0.0 || found.largest > 0.99 * deviation,
            "{} {deviation}",
            found.largest
        );
        assert!(found.rms <= found.largest);
        let [_, end] = profile.curve().range();
        (1..100)
            .map(|i| (profile.convexity(end * f64::from(i) / 100.0) - 1.0 / 0.3).abs())
            .fold(0.0, f64::max)
    };
    let [through, smooth] = [0.0, 7e-6].map(roughness);
    assert!(smooth < 0.02 * through, "{smooth} {through}");
}

/// CSV: units, senses of columns, other columns and separators, the order of points.
#[test]
fn input_csv_with_units_and_senses() {
    let up = "# measured\ny [mm], z [mm]\n-40,-15\n-20,-0.8\n0,0\n20,-0.8\n40,-14\n";
    let other = "n;z_down (in);y_gauge (in)\n1;0.551181102362205;-1.574803149606299\n\
                 2;0.031496062992126;-0.787401574803150\n\
                 3;0;0\n4;0.031496062992126;0.787401574803150\n5;0.590551181102362;1.574803149606299\n";
    let [up, other] = [up, other].map(|text| Points::from_csv("rail.csv", text).unwrap());
    assert_eq!(up.lines, [3, 4, 5, 6, 7]);
    let [up, other] = [up, other].map(|points| Profile::of_points(&points, ProfileKind::Rail, 0.0).unwrap());
    assert_eq!(up.kind(), ProfileKind::Rail);
    for ((_, a), (_, b)) in up
        .curve()
        .sample(1e-3)
        .iter()
        .zip(other.curve().sample(1e-3).iter())
    {
        assert!((a.position[0] - b.position[0]).abs() < 1e-9 && (a.position[1] - b.position[1]).abs() < 1e-9);
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("rail.csv");
    std::fs::write(&file, "y [mm], z [mm]\n-40,-15\n-20,-0.8\n0,0\n20,-0.8\n40,-14\n").unwrap();
    let read = Profile::read(&file, ProfileKind::Rail, 0.0).unwrap();
    assert_eq!(read.curve(), up.curve());
}

/// The benchmark's files: units, mirroring, orientation; the wheel's flange and radius, the rail's gauge
/// face.
#[test]
fn input_simpack_profiles_of_the_manchester_benchmark() {
    let wheel = Profile::read(&manchester("MBench_S1002_v3.prw"), ProfileKind::Wheel, 0.0).unwrap();
    let [_, bottom] = wheel.bottom();
    assert!(
        (bottom + 0.028).abs() < 1e-5,
        "S1002's flange is 28 mm high: {bottom}"
    );
    let tip = wheel.bottom()[0];
    assert!(tip > -0.058 && tip < -0.052, "{tip}");
    let rail = Profile::read(&manchester("MBench_UIC60_v3.prr"), ProfileKind::Rail, 0.0).unwrap();
    let [y, z] = rail.top();
    assert!(y.abs() < 3e-3 && z.abs() < 1e-5, "{y} {z}");
    let gauge = rail.gauge_point(0.014);
    // Between the points (-43.0502, 14.1520) and (-43.0081, 13.8106) of the file.
    assert!((gauge + 0.043_032).abs() < 3e-6, "{gauge}");
    // Tape circles 1500 mm apart fit the gauge, 1520 mm apart do not.
    check_gauge([&wheel; 2], [&rail; 2], 1.5, 1.435, 0.014).unwrap();
    let error = check_gauge([&wheel; 2], [&rail; 2], 1.52, 1.435, 0.014).unwrap_err();
    assert!(
        matches!(error, ProfileError::WiderThanGauge { .. }) && error.to_string().contains("1435.0 mm"),
        "{error}"
    );
    let exchanged = Profile::read(&manchester("MBench_UIC60_v3.prr"), ProfileKind::Wheel, 0.0).unwrap_err();
    assert!(exchanged.to_string().contains("profile of a rail"), "{exchanged}");
    assert!(exchanged.remedy().contains("exchange"));
}

/// Comments of Simpack stand between points, too, behind `%` as behind `!`; decimal commas are read where
/// commas separate nothing, and noticed where they do.
#[test]
fn issue_048_comments_and_decimal_commas_of_points() {
    let bare = "header.begin\n type = 0\nheader.end\nspline.begin\n units.len.f = 1000.\n point.begin\n \
                -1.5 0.1\n 0. 0.0\n 1.5 0.1\n point.end\nspline.end\n";
    let commented = bare
        .replace(" 0. 0.0", "% top = 0\n 0. 0.0 % the top")
        .replace(" point.end", "! last\n point.end");
    let [bare, commented] = [bare, &commented].map(|text| Points::from_simpack("a.prr", text).unwrap());
    assert_eq!(bare.points, commented.points);
    assert_eq!(bare.points.len(), 3);

    let points = Points::from_csv("a.csv", "y [mm]; z [mm]\n-1,5; 0,25\n1;2\n").unwrap();
    assert_eq!(points.points, [[-1.5e-3, 0.25e-3], [1e-3, 2e-3]]);
    for (text, parts) in [
        (
            "y [mm], z [mm]\n-1,5, 0,25\n",
            ["line 2: there are 4 cells", "points"],
        ),
        (
            "y [mm]; z [mm]\n-1,5; 0.25\n",
            ["line 2: 0.25 has a decimal point", "decimal commas"],
        ),
    ] {
        let error = Points::from_csv("a.csv", text).unwrap_err().to_string();
        assert!(parts.iter().all(|part| error.contains(part)), "{error}");
    }
}

/// The keys of Simpack that change points, in the order of their numbers.
#[test]
fn input_simpack_keys_are_applied() {
    let text = "header.begin\n type = 0 ! rail\nheader.end\nspline.begin\n \
                shift.y = 2.0\n shift.z = 1.0\n rotate = 90.0\n \
                bound.y.min = -5.0\n bound.y.max = 5.0\n mirror.y = 1\n units.len.f = 1.0E+03\n \
                units.ang.f = 57.29577951308232\n \
                point.begin\n 1.0 2.0 1.0\n 1.0 7.0\n !3 4\n point.end\nspline.end\n";
    let points = Points::from_simpack("a.prr", text).unwrap();
    assert_eq!(points.kind, Some(ProfileKind::Rail));
    assert_eq!(points.lines, [14], "the second point lies beyond the bound");
    // (1, 2) + (2, 1) = (3, 3), turned (-3, 3), mirrored (3, 3), z up and mm: (0.003, -0.003).
    let [y, z] = points.points[0];
    assert!((y - 0.003).abs() < 1e-15 && (z + 0.003).abs() < 1e-15, "{y} {z}");
}

/// Every mistake names file and line, and a remedy.
#[test]
fn input_mistakes_in_files_are_reported_with_place_and_remedy() {
    for (text, found, remedy) in [
        ("", "rail.csv, line 1: there is no header", "y [mm]"),
        (
            "#\ny, z [mm]\n",
            "rail.csv, line 2: the column y has no unit",
            "y [mm]",
        ),
        (
            "y [mm], z [kg]\n",
            "rail.csv, line 1: the unit of the column z [kg]",
            "",
        ),
        ("y [mm], q [mm]\n", "line 1: the header has no column z", "z_down"),
        ("y [mm], y_gauge [mm], z [mm]\n", "two columns y", "keep one"),
        ("y [mm], z [mm]\n1,2\n1,abc\n", "line 3: abc", "decimal points"),
        (
            "y [mm], z [mm]\n1,nan\n",
            "line 2: a number is missing",
            "decimal points",
        ),
        (
            "y [mm], z [mm]\n1\n",
            "line 2: a number is missing",
            "one point a line",
        ),
    ] {
        let error = Points::from_csv("rail.csv", text).unwrap_err();
        assert!(error.to_string().contains(found), "{error}");
        assert!(error.remedy().contains(remedy), "{}", error.remedy());
    }
    for (text, found) in [
        ("header.begin\ntype = 7\n", "line 2: the type 7"),
        (
            "spline.begin\npoint.begin\n1 2\n",
            "line 3: the block of points does not end",
        ),
        ("units.len.f = 0\n", "line 1: the unit factor 0"),
        ("point.begin\n1\n", "line 2: a number is missing"),
    ] {
        let error = Points::from_simpack("a.prr", text).unwrap_err();
        assert!(error.to_string().contains(found), "{error}");
    }
    let unknown = Points::read(Path::new("wheel.xyz"), None).unwrap_err();
    assert!(unknown.to_string().contains("wheel.xyz") && unknown.remedy().contains(".prw"));
    let none = Points::read(Path::new("no such file.csv"), None).unwrap_err();
    assert!(none.to_string().contains("there is no profile"), "{none}");
}

/// Points that make no profile.
#[test]
fn input_wrong_units_orientation_and_crossings_are_refused() {
    let rail: Vec<[f64; 2]> = (-8..=8)
        .map(|i| [5e-3 * f64::from(i), -9.0 * (5e-3 * f64::from(i)).powi(2)])
        .collect();
    let judge = |points: &[[f64; 2]], kind| Profile::of_points(&Points::new("p", points), kind, 0.0);
    assert!(judge(&rail, ProfileKind::Rail).is_ok());
    let scaled = |factor: f64| -> Vec<[f64; 2]> { rail.iter().map(|p| p.map(|x| factor * x)).collect() };
    for (factor, words) in [(1e3, "mm that are called m"), (1e-3, "m that are called mm")] {
        let error = judge(&scaled(factor), ProfileKind::Rail).unwrap_err();
        assert!(
            matches!(error, ProfileError::Units { .. }) && error.remedy().contains(words),
            "{}",
            error.remedy()
        );
    }
    let upside_down: Vec<[f64; 2]> = rail.iter().map(|[y, z]| [*y, -z]).collect();
    let error = judge(&upside_down, ProfileKind::Rail).unwrap_err();
    assert!(error.remedy().contains("z_down"), "{error}");
    let aside: Vec<[f64; 2]> = rail.iter().map(|[y, z]| [y + 0.1, *z]).collect();
    assert!(
        judge(&aside, ProfileKind::Rail)
            .unwrap_err()
            .to_string()
            .contains("datum")
    );
    let mut crossing = rail.clone();
    crossing.swap(6, 10);
    let error = judge(&crossing, ProfileKind::Rail).unwrap_err();
    assert!(
        matches!(error, ProfileError::SelfCrossing { .. }) && error.to_string().contains("p, line"),
        "{error}"
    );
    assert!(matches!(
        judge(&rail[..4], ProfileKind::Rail),
        Err(ProfileError::TooFew { points: 4, .. })
    ));
    assert!(matches!(
        Profile::of_points(&Points::new("p", &rail), ProfileKind::Rail, -1e-6),
        Err(ProfileError::Number { .. })
    ));
    // A wheel whose flange lies on the field side, and one whose flange points up.
    let wheel = nominal::aar_1b().unwrap();
    let sample: Vec<[f64; 2]> = wheel
        .curve()
        .sample(1e-3)
        .iter()
        .map(|(_, p)| p.position)
        .collect();
    assert!(judge(&sample, ProfileKind::Wheel).is_ok());
    let mirrored: Vec<[f64; 2]> = sample.iter().map(|[y, z]| [-y, *z]).collect();
    assert!(
        judge(&mirrored, ProfileKind::Wheel)
            .unwrap_err()
            .remedy()
            .contains("mirror.y")
    );
    let raised: Vec<[f64; 2]> = sample.iter().map(|[y, z]| [*y, -z]).collect();
    assert!(
        judge(&raised, ProfileKind::Wheel)
            .unwrap_err()
            .remedy()
            .contains("mirror.z")
    );
}

/// Chains that cannot be.
#[test]
fn input_elements_that_do_not_join_are_refused_with_their_number() {
    let line = |z: f64, angle: f64| ChainElement::Line {
        point: [0.0, z],
        angle,
    };
    let circle = |z: f64, radius: f64| ChainElement::Circle {
        center: [0.0, z],
        radius,
    };
    let ends = ([-0.05, 0.0], [0.05, 0.0]);
    for (elements, found) in [
        (vec![], "element 1 (from 1) is missing"),
        (
            vec![line(0.0, 0.0), line(0.1, 0.0)],
            "element 2 (from 1) does not touch",
        ),
        (
            vec![line(0.0, 0.0), circle(-0.2, -0.1)],
            "element 2 (from 1) does not touch",
        ),
        (
            vec![line(0.0, 0.0), ChainElement::Fillet { radius: 0.01 }],
            "element 2 (from 1) is a fillet at an end",
        ),
        (
            vec![
                line(0.0, 0.0),
                ChainElement::Fillet { radius: 0.01 },
                line(0.1, 0.0),
            ],
            "element 2 (from 1) has no place",
        ),
        (vec![circle(0.0, 0.0)], "element 1 (from 1) has a radius of zero"),
        (vec![line(0.0, PI)], "element 1 (from 1) ends before it begins"),
    ] {
        let error = Profile::of_chain("c", ProfileKind::Rail, ends.0, &elements, ends.1).unwrap_err();
        assert!(error.to_string().contains(found), "{error}, not {found}");
        assert!(!error.remedy().is_empty());
    }
    assert!(nominal::cone(0.05, -1.0).is_err() && nominal::cylinder(0.3, 0.4).is_err());
}

/// A point file with points closer than can be told apart keeps its shape.
#[test]
fn limits_repeated_points_are_left_out() {
    let mut points = Vec::new();
    for i in -20..=20 {
        let y = 2e-3 * f64::from(i);
        let z = 0.3 - (0.09 + y * y).sqrt();
        points.extend([[y, z], [y + 1e-9, z], [y, z]]);
    }
    let profile = Profile::of_points(&Points::new("repeated", &points), ProfileKind::Rail, 0.0).unwrap();
    assert_eq!(profile.deviation().points, 41);
    let [start, end] = profile.curve().range();
    let middle = profile.convexity(0.5 * (start + end));
    assert!((middle - 1.0 / 0.3).abs() < 0.02, "{middle}");
}

/// A number that is mistyped must not make a profile of a kilometer, whose sampling would take all memory.
#[test]
fn input_a_point_far_off_is_refused_with_its_line() {
    let text = "y [mm], z [mm]\n-30, -1.5\n-20, -0.7\n-10, -0846723\n0, 0\n10, -0.2\n20, -0.7\n30, -1.5\n";
    let points = Points::from_csv("rail.csv", text).unwrap();
    let error = Profile::of_points(&points, ProfileKind::Rail, 0.0).unwrap_err();
    let message = error.to_string();
    assert!(
        message.contains("rail.csv, line") && message.contains("no profile has more than 300 mm"),
        "{message}"
    );
}
