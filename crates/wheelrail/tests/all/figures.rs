//! analytic, reproduction, cross_code: figures of wheels, flangeway clearance, nominal profiles of Europe.

use std::path::Path;

use wheelrail::profile::{Points, Profile, ProfileKind, european, flangeway_clearance, names, nominal};

const INCH: f64 = 0.0254;

fn manchester(file: &str, kind: ProfileKind) -> Profile {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/manchester");
    Profile::read(&folder.join(file), kind, 0.0).unwrap()
}

/// Largest distance (m) of points of one profile, from which `chosen` takes some, to the other one.
fn apart(from: &Profile, to: &Profile, chosen: impl Fn([f64; 2]) -> bool) -> f64 {
    let dense: Vec<[f64; 2]> = to.curve().sample(1e-5).iter().map(|(_, p)| p.position).collect();
    let sample = from.curve().sample(5e-4);
    let points = sample.iter().map(|(_, p)| p.position).filter(|p| chosen(*p));
    points
        .map(|[y, z]| {
            let squares = dense.iter().map(|[a, b]| (a - y).powi(2) + (b - z).powi(2));
            squares.fold(f64::INFINITY, f64::min).sqrt()
        })
        .fold(0.0, f64::max)
}

/// The figures of the AAR-1B from its dimensions: the face of 75° goes through 1 5/32 in from the back at 5/8
/// in below the tape circle, the tip is 1 in below it.
#[test]
fn analytic_figures_of_the_nominal_wheel() {
    for (wheel, angle) in [
        (nominal::aar_1b().unwrap(), 75f64),
        (nominal::aar_1_20().unwrap(), 70.0),
    ] {
        let found = wheel.wheel_figures().unwrap();
        assert!((found.height - INCH).abs() < 1e-9, "{found:?}");
        assert!((found.angle.to_degrees() - angle).abs() < 1e-6, "{found:?}");
        assert!(found.hollow.abs() < 1e-9, "{found:?}");
        let face = |depth: f64| {
            let [y, z] = [(1.0 + 5.0 / 32.0) * INCH, -0.625 * INCH];
            y + (-depth - z) / angle.to_radians().tan()
        };
        // Where the throat has not begun yet.
        let from_back = wheel.flange_face(0.6 * INCH).unwrap() - wheel.flange_back().unwrap();
        let line = face(0.6 * INCH);
        assert!((from_back - line).abs() < 1e-7, "{from_back} {line}");
        let thickness = found.thickness.unwrap();
        assert!(
            thickness >= face(10e-3) - 1e-9 && thickness < face(10e-3) + 2e-3,
            "{thickness}"
        );
    }
    assert!(nominal::cone(0.05, 0.05).unwrap().wheel_figures().is_none());
    assert!(nominal::rail_136re().unwrap().wheel_figures().is_none());
}

/// S1002's flange: 28 mm high, 32.5 mm thick, qR of 10.8 mm, a face of 70° (EN 13715, EN 15313; remembered).
/// Where the face joins its arcs, splines of points are up to 0.2° steeper.
#[test]
fn reproduction_figures_of_s1002() {
    for wheel in [
        european::s1002().unwrap(),
        manchester("MBench_S1002_v3.prw", ProfileKind::Wheel),
    ] {
        let found = wheel.wheel_figures().unwrap();
        assert!((found.height - 28e-3).abs() < 2e-5, "{found:?}");
        assert!((found.slope.unwrap() - 10.79e-3).abs() < 5e-5, "{found:?}");
        assert!((found.angle.to_degrees() - 70.0).abs() < 0.2, "{found:?}");
        assert!(found.hollow < 1e-5, "{found:?}");
    }
    let thickness = european::s1002()
        .unwrap()
        .wheel_figures()
        .unwrap()
        .thickness
        .unwrap();
    assert!((thickness - 32.5e-3).abs() < 5e-5, "{thickness}");
}

/// The built-in profiles of Europe lie on the files of the Manchester contact benchmark.
#[test]
fn cross_code_profiles_of_europe_lie_on_the_benchmark_files() {
    let (own, file) = (
        european::s1002().unwrap(),
        manchester("MBench_S1002_v3.prw", ProfileKind::Wheel),
    );
    let far = apart(&own, &file, |[y, _]| y > -0.069);
    assert!(far < 1e-5, "{far}");
    let rail = european::rail_60e1().unwrap();
    let file = manchester("MBench_UIC60_v3.prr", ProfileKind::Rail);
    // The file is inclined, and its y = 0 is another point: heads lie on each other by gauge point and top.
    let far = [1.0 / 40.0, 1.0 / 20.0].map(|slope| {
        let own = rail.inclined(slope);
        let y = file.gauge_point(14e-3 - file.datum_depth()) - own.gauge_point(14e-3 - own.datum_depth());
        let placed = own.moved([y, file.top()[1] - own.top()[1]]);
        apart(&placed, &file, |[_, z]| z > -0.012)
    });
    assert!(far[0] < 5e-5 && far[1] > 3e-4, "{far:?}");
    // The shoulders end where the drawing says.
    let joints: Vec<f64> = rail
        .curve()
        .joints()
        .map(|at| rail.curve().at(at).position[0])
        .collect();
    assert!(joints.iter().any(|y| (y - 26.026e-3).abs() < 2e-5), "{joints:?}");
}

/// A hollow of 2 mm, an arc in the tread of a cone: a straight edge on the field side shows it.
#[test]
fn analytic_hollow_depth_of_a_worn_tread() {
    let wheel = nominal::aar_1b().unwrap();
    let worn: Vec<[f64; 2]> = wheel
        .curve()
        .sample(5e-4)
        .iter()
        .map(|(_, p)| {
            let [y, z] = p.position;
            let deep = (std::f64::consts::FRAC_PI_2 * y / 0.03).cos().max(0.0).powi(2);
            [y, if y.abs() < 0.03 { z + 3e-3 * deep } else { z }]
        })
        .collect();
    let made = Profile::of_points(&Points::new("hollow", &worn), ProfileKind::Wheel, 0.0).unwrap();
    let expected = {
        // The highest point inside and the lowest one beyond it.
        let highest = worn
            .iter()
            .filter(|p| p[0] < 0.02)
            .map(|p| p[1])
            .fold(f64::MIN, f64::max);
        let lowest = worn
            .iter()
            .filter(|p| p[0] > 0.02)
            .map(|p| p[1])
            .fold(f64::MAX, f64::min);
        highest - lowest
    };
    let found = made.wheel_figures().unwrap().hollow;
    assert!(
        found > 1e-3 && (found - expected).abs() < 2e-5,
        "{found} {expected}"
    );
}

/// Clearance of nominal wheels in 56.5 in: 13/32 in to each side; of unlike flanges the mean.
#[test]
fn analytic_flangeway_clearance() {
    let (wheel, rail) = (nominal::aar_1b().unwrap(), nominal::rail_136re().unwrap());
    let of = |wheels: [&Profile; 2]| {
        flangeway_clearance(
            wheels,
            [&rail; 2],
            nominal::TAPE_DISTANCE,
            56.5 * INCH,
            nominal::GAUGE_DEPTH,
        )
    };
    let both = of([&wheel; 2]).unwrap();
    assert!((both - 13.0 / 32.0 * INCH).abs() < 1e-6, "{both}");
    let thin = wheel.moved([-4e-3, 0.0]);
    let unlike = of([&wheel, &thin]).unwrap();
    assert!((unlike - both - 2e-3).abs() < 1e-9, "{unlike}");
    assert!(of([&wheel, &nominal::cone(0.05, 0.05).unwrap()]).is_none());
}

/// Names: what is built in, and what is not, in any letters.
#[test]
fn input_names_of_profiles() {
    for name in [
        "aar_1b",
        "AAR_1B",
        "aar_1b_1:40",
        "aar_1:20",
        "s1002",
        "cylinder",
        "cone_1:10",
    ] {
        assert!(names::wheel(name).unwrap().is_some(), "{name}");
    }
    for name in ["136re", "136RE", "136re_10in", "136re_8in", "60e1"] {
        assert!(names::rail(name).unwrap().is_some(), "{name}");
    }
    let crown = |name: &str| {
        let (rail, _) = names::rail(name).unwrap().unwrap();
        let [start, end] = rail.curve().range();
        1.0 / rail.convexity(0.5 * (start + end)) / INCH
    };
    assert!((crown("136re_8in") - 8.0).abs() < 1e-9 && (crown("136re_10in") - 10.0).abs() < 1e-9);
    assert_eq!(names::rail("136re").unwrap(), names::rail("136re_10in").unwrap());
    assert!(names::wheel("wheel.csv").unwrap().is_none() && names::rail("aar_2a").unwrap().is_none());
    for name in ["aar_2a", "AAR-2A", "aar2a"] {
        let error = names::wheel(name).unwrap_err();
        assert!(
            error.to_string().contains("AAR-2A is the primary profile"),
            "{error}"
        );
        assert!(error.remedy().contains("name a file"), "{}", error.remedy());
    }
    assert!(names::wheel("cone_x").is_err() && names::wheel("aar_1b_1:x").is_err());
}
