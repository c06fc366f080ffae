//! input: a wheel that is given as a rail, and a rail that is given as a wheel.

use std::path::Path;

use wheelrail::profile::{Points, Profile, ProfileError, ProfileKind, check_gauge, nominal};

/// Points along a profile, m.
fn sampled(profile: &Profile, spacing: f64) -> Vec<[f64; 2]> {
    let sample = profile.curve().sample(spacing);
    sample.iter().map(|(_, point)| point.position).collect()
}

fn file(name: &str) -> Points {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    Points {
        kind: None,
        ..Points::read(&folder.join(name), None).unwrap()
    }
}

fn made(points: &[[f64; 2]], kind: ProfileKind) -> Result<Profile, ProfileError> {
    Profile::of_points(&Points::new("points.csv", points), kind, 2e-5)
}

#[track_caller]
fn refused(points: &[[f64; 2]], given: ProfileKind, what: &str) {
    let expected = match given {
        ProfileKind::Wheel => "this looks like a rail, where a wheel is expected",
        ProfileKind::Rail => "this looks like a wheel, where a rail is expected",
    };
    let Err(error) = made(points, given) else {
        panic!("{what} is read as a {}", given.word());
    };
    let message = error.to_string();
    assert!(
        message.contains(expected) && message.starts_with("points.csv: "),
        "{what}: {message}"
    );
    assert!(
        error
            .remedy()
            .contains(&format!("name a file of a {}", given.word())),
        "{what}: {}",
        error.remedy()
    );
}

/// Points of lines and arcs by directions: from a start, pieces of length (m) over which the direction goes
/// from one angle (deg, from y towards z) to another.
fn drawn(start: [f64; 2], pieces: &[(f64, f64, f64)]) -> Vec<[f64; 2]> {
    const STEP: f64 = 2.5e-4;
    let mut points = vec![start];
    let [mut y, mut z] = start;
    for (length, from, to) in pieces {
        let count = (length / STEP).round();
        for i in 0..count as usize {
            let angle = (from + (to - from) * (i as f64 + 0.5) / count).to_radians();
            (y, z) = (y + STEP * angle.cos(), z + STEP * angle.sin());
            points.push([y, z]);
        }
    }
    points
}

/// An arc of a radius (mm) that turns from one angle to another (deg).
fn arc(radius: f64, from: f64, to: f64) -> (f64, f64, f64) {
    (1e-3 * radius * (from - to).abs().to_radians(), from, to)
}

fn line(length: f64, angle: f64) -> (f64, f64, f64) {
    (1e-3 * length, angle, angle)
}

/// Moves points so that the one nearest to a place across (m) is the origin.
fn placed(mut points: Vec<[f64; 2]>, at: f64) -> Vec<[f64; 2]> {
    let nearest = |a: &&[f64; 2], b: &&[f64; 2]| (a[0] - at).abs().total_cmp(&(b[0] - at).abs());
    let origin = *points.iter().min_by(nearest).unwrap();
    for point in &mut points {
        *point = [point[0] - origin[0], point[1] - origin[1]];
    }
    points
}

fn turned(points: &[[f64; 2]], angle: f64) -> Vec<[f64; 2]> {
    let (sine, cosine) = angle.sin_cos();
    points
        .iter()
        .map(|[y, z]| [y * cosine - z * sine, y * sine + z * cosine])
        .collect()
}

/// Noise of a measurement: 0.02 mm, the same each time.
fn noisy(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let noise = |i: usize| 2e-5 * (7.1 * i as f64).sin() * (1.3 * i as f64).cos();
    points
        .iter()
        .enumerate()
        .map(|(i, [y, z])| [*y, z + noise(i)])
        .collect()
}

/// Wheels: new, worn, hollow, with a steep or a vertical flange, from the flange's tip on, without back.
fn wheels() -> Vec<(&'static str, Vec<[f64; 2]>)> {
    let aar = sampled(&nominal::aar_1b().unwrap(), 4e-4);
    let tip = nominal::aar_1b().unwrap().bottom()[0];
    let from_tip: Vec<[f64; 2]> = aar.iter().copied().filter(|[y, _]| *y >= tip).collect();
    let to_tape: Vec<[f64; 2]> = from_tip.iter().copied().filter(|[y, _]| *y < 0.012).collect();
    // Hollow by 7 mm at the tape circle, with a false flange.
    let hollow = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
        let worn = |y: f64| 7e-3 * (-(y / 0.022).powi(2)).exp();
        points.iter().map(|[y, z]| [*y, z + worn(*y)]).collect()
    };
    // The flange thinned to a face of 85°, a tread of 1:40, a chamfer of 45°, a back of 20 mm.
    let thin = placed(
        drawn(
            [-0.07, -0.01],
            &[
                line(20.0, -90.0),
                arc(9.0, -90.0, 0.0),
                arc(8.0, 0.0, 85.0),
                line(14.0, 85.0),
                arc(14.0, 85.0, 2.0),
                line(70.0, 1.4),
                line(6.0, 45.0),
            ],
        ),
        0.0,
    );
    let mut wheels = vec![
        ("AAR-1B", aar.clone()),
        ("AAR-1B from its tip", from_tip),
        ("AAR-1B from its tip to its tape circle", to_tape),
        ("hollow", hollow(&aar)),
        ("thin flange", thin),
        ("1:10", sampled(&nominal::aar_1b_with_tread(10.0).unwrap(), 4e-4)),
        ("S1002", file("manchester/MBench_S1002_v3.prw").points),
    ];
    for (name, letter) in [("A", "a"), ("B", "b"), ("H", "h"), ("I", "i")] {
        wheels.push((name, file(&format!("en15302/wheel_{letter}.csv")).points));
    }
    wheels
}

/// Rails: new, inclined, worn, with foot, with the head's top only, from one side, grooved.
fn rails() -> Vec<(&'static str, Vec<[f64; 2]>)> {
    let upright = sampled(&nominal::rail_136re().unwrap(), 4e-4);
    // A side worn to 65°, with a ledge 18 mm down, below it the old side.
    let side_worn = placed(
        drawn(
            [-0.036, -0.03],
            &[
                line(12.0, 90.0),
                line(4.0, 15.0),
                line(12.0, 65.0),
                arc(12.0, 65.0, 8.0),
                arc(250.0, 8.0, -5.0),
                arc(12.0, -5.0, -88.0),
                line(20.0, -88.0),
            ],
        ),
        0.0,
    );
    // Half of a grooved rail's head, its groove and its keeper, which is 12 mm wide.
    let grooved = placed(
        drawn(
            [-0.075, -0.04],
            &[
                line(30.0, 90.0),
                arc(3.0, 90.0, 0.0),
                line(6.0, 0.0),
                arc(3.0, 0.0, -80.0),
                line(28.0, -80.0),
                arc(16.0, -80.0, 80.0),
                line(24.0, 80.0),
                arc(13.0, 80.0, 5.0),
                arc(225.0, 5.0, -5.0),
                arc(13.0, -5.0, -88.0),
                line(25.0, -88.0),
            ],
        ),
        0.012,
    );
    // A crossing's nose of 20 mm beside a plateau 38 mm below, and a wing rail beside its flangeway.
    let nose = placed(
        drawn(
            [-0.005, -0.034],
            &[
                line(32.0, 80.0),
                arc(4.5, 80.0, 0.0),
                line(10.0, 0.0),
                arc(4.5, 0.0, -80.0),
                line(30.0, -80.0),
                arc(4.5, -80.0, 0.0),
                line(45.0, 0.0),
            ],
        ),
        0.008,
    );
    let mirrored = |points: &[[f64; 2]]| points.iter().map(|[y, z]| [-y, *z]).collect::<Vec<_>>();
    let wing = mirrored(&nose);
    let stock = placed(
        drawn(
            [0.0, 0.0],
            &[
                line(45.0, 0.0),
                arc(4.5, 0.0, 80.0),
                line(30.0, 80.0),
                arc(13.0, 80.0, 3.0),
                line(30.0, 0.0),
            ],
        ),
        0.07,
    );
    // A rail with head, web and foot: 136RE's sizes.
    let head = upright.clone();
    let mut whole = vec![[-0.0762, -0.1857], [-0.0762, -0.174]];
    whole.extend([
        [-0.012, -0.15],
        [-0.0087, -0.14],
        [-0.0087, -0.06],
        [-0.036, -0.045],
    ]);
    whole.extend(head.iter().copied());
    whole.extend([[0.036, -0.045], [0.0087, -0.06], [0.0087, -0.14], [0.012, -0.15]]);
    whole.extend([[0.0762, -0.174], [0.0762, -0.1857]]);
    let keep = |low: f64, high: f64| -> Vec<[f64; 2]> {
        upright
            .iter()
            .copied()
            .filter(|[y, _]| *y > low && *y < high)
            .collect()
    };
    vec![
        ("136RE", upright.clone()),
        ("136RE with its foot", whole),
        ("136RE, inclined by 1:20", turned(&upright, 0.05)),
        ("136RE, inclined by 1:8 the other way", turned(&upright, -0.125)),
        ("136RE's top", keep(-0.03, 0.03)),
        ("136RE's gauge side", keep(-0.1, 0.012)),
        ("136RE's gauge side and top", keep(-0.1, 0.033)),
        ("136RE's field side and top", keep(-0.033, 0.1)),
        ("side-worn", side_worn),
        ("grooved", grooved.clone()),
        (
            "grooved, without its field side",
            grooved.iter().copied().filter(|[y, _]| *y < 0.03).collect(),
        ),
        ("the nose, part of a crossing without its other side", nose),
        ("the wing, without its other side", wing),
        ("a head beside a wide flangeway, without its field side", stock),
        ("UIC60", file("manchester/MBench_UIC60_v3.prr").points),
        ("S-UIC 519-A", file("en15302/rail_a.csv").points),
        (
            "the top of an arc of 300 mm",
            sampled(&nominal::cylinder(0.3, 0.035).unwrap(), 4e-4),
        ),
    ]
}

/// Every wheel is read as a wheel and refused as a rail, with noise, from either end and mirrored. Upside
/// down it may be a crossing's nose; then its datum is far from its highest point, which is told where gauge
/// is measured.
#[test]
fn issue_047_a_wheel_is_no_rail() {
    for (name, points) in wheels() {
        made(&points, ProfileKind::Wheel).unwrap_or_else(|error| panic!("{name}: {error}"));
        made(&noisy(&points), ProfileKind::Wheel).unwrap_or_else(|error| panic!("{name}: {error}"));
        for side in [1.0, -1.0] {
            let image: Vec<[f64; 2]> = points.iter().map(|[y, z]| [side * y, *z]).collect();
            refused(&image, ProfileKind::Rail, name);
            refused(&noisy(&image), ProfileKind::Rail, name);
        }
        let backwards: Vec<[f64; 2]> = points.iter().rev().copied().collect();
        refused(&backwards, ProfileKind::Rail, name);
        // The datum does not count: from the back of the flange on.
        let shifted: Vec<[f64; 2]> = points.iter().map(|[y, z]| [y + 0.1, z + 0.03]).collect();
        refused(&shifted, ProfileKind::Rail, name);
        let upside_down: Vec<[f64; 2]> = points.iter().map(|[y, z]| [*y, -z]).collect();
        let wheel = nominal::cone(0.05, 0.05).unwrap();
        let error = made(&upside_down, ProfileKind::Rail)
            .and_then(|rail| check_gauge([&wheel; 2], [&rail; 2], 1.5, 1.435, 0.014))
            .unwrap_err();
        assert!(
            matches!(
                error,
                ProfileError::Datum { .. } | ProfileError::Orientation { .. }
            ),
            "{name}: {error}"
        );
    }
}

/// Every rail is read as a rail, with noise and from either end; as a wheel it is refused, but for those of
/// which too little is seen.
#[test]
fn issue_047_a_rail_is_no_wheel() {
    for (name, points) in rails() {
        made(&points, ProfileKind::Rail).unwrap_or_else(|error| panic!("{name}: {error}"));
        made(&noisy(&points), ProfileKind::Rail).unwrap_or_else(|error| panic!("{name}: {error}"));
        let mirrored: Vec<[f64; 2]> = points.iter().map(|[y, z]| [-y, *z]).collect();
        made(&mirrored, ProfileKind::Rail).unwrap_or_else(|error| panic!("{name}, mirrored: {error}"));
        let part = name.contains("top") || name.contains("gauge side") || name.contains("without");
        if !part {
            refused(&points, ProfileKind::Wheel, name);
            refused(&noisy(&points), ProfileKind::Wheel, name);
        }
    }
}

/// Treads without a flange may be what they are called: cones, convex and concave arcs.
#[test]
fn limits_treads_without_a_flange_are_wheels() {
    let tread = |height: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
        (-70..=70)
            .map(|i| 5e-4 * f64::from(i))
            .map(|y| [y, height(y)])
            .collect()
    };
    for points in [
        tread(&|y| 0.05 * y),
        tread(&|_| 0.0),
        tread(&|y| 0.05 * y + 0.5 * y * y / 0.1),
        tread(&|y| 0.05 * y - 0.5 * y * y / 0.33),
        tread(&|y| -0.5 * y * y / 0.2),
    ] {
        made(&points, ProfileKind::Wheel).unwrap();
    }
    // A wheel upside down is told so.
    let upside_down: Vec<[f64; 2]> = wheels()[0].1.iter().map(|[y, z]| [*y, -z]).collect();
    let error = made(&upside_down, ProfileKind::Wheel).unwrap_err();
    assert!(error.to_string().contains("the flange points up"), "{error}");
}

/// A profile that its own file calls the other kind is judged by its shape all the same.
#[test]
fn issue_047_the_shape_counts_beside_the_type_of_a_file() {
    let mut points = file("manchester/MBench_S1002_v3.prw");
    points.kind = Some(ProfileKind::Rail);
    let error = Profile::of_points(&points, ProfileKind::Rail, 0.0).unwrap_err();
    assert!(matches!(error, ProfileError::Shape { .. }), "{error}");
}
