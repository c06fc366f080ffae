//! analytic, reproduction, input: rigid wheelsets, equivalent conicity, linear geometry.

use std::f64::consts::PI;
use std::path::Path;

use wheelrail::conicity::{ConicityError, LinearGeometry, RollingRadiusDifference};
use wheelrail::hertz::Material;
use wheelrail::profile::{Profile, ProfileError, ProfileKind, nominal};
use wheelrail::wheelset::{Layout, RigidWheelset};

const STEEL: Material = Material {
    youngs_modulus: 207e9,
    poisson: 0.28,
};
const RADIUS: f64 = 0.46;
const CROWN: f64 = 0.3;

/// Cones without flanges on arcs of 300 mm whose tops are 1.5 m apart.
fn cones(slope: f64) -> RigidWheelset {
    let wheel = nominal::cone(slope, 0.05).unwrap();
    let rail = nominal::cylinder(CROWN, 0.035).unwrap();
    let layout = Layout {
        tape_distance: 1.5,
        gauge: 1.5 + 2.0 * rail.gauge_point(0.001),
        gauge_depth: 0.001,
    };
    RigidWheelset::new([&wheel; 2], [RADIUS; 2], [&rail; 2], layout, STEEL).unwrap()
}

const INCH: f64 = 0.0254;
const FREIGHT: Layout = Layout {
    tape_distance: nominal::TAPE_DISTANCE,
    gauge: 56.5 * INCH,
    gauge_depth: nominal::GAUGE_DEPTH,
};

fn freight() -> RigidWheelset {
    let wheel = nominal::aar_1b().unwrap();
    let rail = nominal::rail_136re().unwrap().inclined(nominal::INCLINATION);
    RigidWheelset::new([&wheel; 2], [18.0 * INCH; 2], [&rail; 2], FREIGHT, STEEL).unwrap()
}

fn manchester() -> RigidWheelset {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/manchester");
    let wheel = Profile::read(&folder.join("MBench_S1002_v3.prw"), ProfileKind::Wheel, 0.0).unwrap();
    let rail = Profile::read(&folder.join("MBench_UIC60_v3.prr"), ProfileKind::Rail, 0.0).unwrap();
    let layout = Layout {
        tape_distance: 1.5,
        gauge: 1.435,
        gauge_depth: 0.014,
    };
    RigidWheelset::new([&wheel; 2], [RADIUS; 2], [&rail; 2], layout, STEEL).unwrap()
}

/// Cones have their slope as equivalent conicity at every amplitude, by both definitions; the wavelength is
/// Klingel's. EN 15302 has a coned wheel of 1:40 with 0.025.
#[test]
fn reproduction_conicity_of_coned_wheels() {
    for slope in [0.025, 0.05, 0.1] {
        let wheelset = cones(slope);
        let table = RollingRadiusDifference::of_positions(&wheelset.sweep(0.01, 100, true)).unwrap();
        for shift in [-7e-3, -1e-3, 2.5e-3, 9e-3] {
            assert!((table.value(shift) - 2.0 * slope * shift).abs() < 1e-12);
        }
        for amplitude in [0.5e-3, 3e-3, 8e-3] {
            let found = table.equivalent_conicity(amplitude, RADIUS, 1.5).unwrap();
            assert!((found.by_wavelength / slope - 1.0).abs() < 1e-8, "{found:?}");
            assert!((found.by_linearization / slope - 1.0).abs() < 1e-8, "{found:?}");
            let klingel = 2.0 * PI * (RADIUS * 0.75 / slope).sqrt();
            assert!((found.wavelength / klingel - 1.0).abs() < 1e-8);
            assert!(found.middle.abs() < 1e-9);
        }
    }
}

/// Narrow flanges: backs 53 3/8 in apart, flanges of 1 5/32 in where gauge is measured. In a gauge of 56 1/2
/// in that leaves (56.5 - 53.375 - 2 · 1.15625)/2 = 0.406 in to each side; the throat of the flange meets
/// the rail's corner a little before.
#[test]
fn analytic_narrow_flanges_touch_at_their_clearance() {
    let wheelset = freight();
    let clearance = 0.5 * (56.5 - 53.375 - 2.0 * (1.0 + 5.0 / 32.0));
    let flanges = |shift: f64| {
        let at = wheelset.level_position(shift * INCH).unwrap();
        let [left, right] = at.contact_angles().map(f64::to_degrees);
        left.abs().max(right.abs()) > 30.0
    };
    let touching = (0..600)
        .map(|k| 1e-3 * f64::from(k))
        .find(|shift| flanges(*shift))
        .unwrap();
    assert!((touching - clearance).abs() < 0.02, "{touching} {clearance}");
}

/// Rows of numbers of a file beside EN 15302's reference cases.
fn reference(file: &str) -> Vec<Vec<f64>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data/en15302")
        .join(file);
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().skip(2);
    rows.map(|line| line.split(',').map(|cell| cell.trim().parse().unwrap()).collect())
        .collect()
}

/// EN 15302, cases E1 to E3: the conicity of given rolling radius differences, to the digits of the reference
/// but one. The tables end at 6.8 mm.
#[test]
fn reproduction_conicities_of_en_15302_from_rolling_radius_differences() {
    for case in 1..=3 {
        let rows = reference(&format!("rolling_radius_difference_e{case}.csv"));
        let table =
            RollingRadiusDifference::new(rows.iter().map(|row| [1e-3 * row[0], 1e-3 * row[1]])).unwrap();
        let mut compared = 0;
        for row in reference(&format!("conicity_e{case}.csv")) {
            let Ok(found) = table.equivalent_conicity(1e-3 * row[0], RADIUS, 1.5) else {
                assert!(row[0] > 6.8, "E{case} at {} mm", row[0]);
                continue;
            };
            assert!(
                (found.by_wavelength - row[1]).abs() < 0.0015,
                "E{case} at {} mm: {}, {} in the standard",
                row[0],
                found.by_wavelength,
                row[1]
            );
            compared += 1;
        }
        assert!(compared > 50);
    }
}

/// EN 15302, case E1, from the profiles: rolling radius differences, and conicities within the limits. The
/// wheelset has 920 mm wheels with 1360 mm between their backs; the gauge of 1435 mm is measured 14 mm below
/// the rail's datum.
#[test]
fn reproduction_conicities_of_en_15302_from_profiles() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/en15302");
    let wheel = Profile::read(&folder.join("wheel_a.csv"), ProfileKind::Wheel, 0.0).unwrap();
    let rail = Profile::read(&folder.join("rail_a.csv"), ProfileKind::Rail, 0.0).unwrap();
    let layout = Layout {
        tape_distance: 1.5,
        gauge: 1.435,
        gauge_depth: 0.014,
    };
    let wheelset = RigidWheelset::new([&wheel; 2], [RADIUS; 2], [&rail; 2], layout, STEEL).unwrap();
    for row in reference("rolling_radius_difference_e1.csv") {
        if row[0].abs() > 6.5 {
            continue;
        }
        let found = 1e3
            * wheelset
                .level_position(1e-3 * row[0])
                .unwrap()
                .rolling_radius_difference();
        assert!(
            (found - row[1]).abs() < 0.1 + 0.02 * row[1].abs(),
            "at {} mm: {found}, {} in the standard",
            row[0],
            row[1]
        );
    }
    let table = RollingRadiusDifference::of_positions(&wheelset.sweep(9e-3, 360, true)).unwrap();
    for row in reference("conicity_e1.csv") {
        let found = table
            .equivalent_conicity(1e-3 * row[0], RADIUS, 1.5)
            .unwrap()
            .by_wavelength;
        assert!(
            found < row[2] && found > row[3],
            "at {} mm: {found}, limits {} to {}",
            row[0],
            row[3],
            row[2]
        );
        // The limits are 0.05 apart from it; the difference is a fifth of that up to the flange.
        assert!(
            row[0] > 6.5 || (found - row[1]).abs() < 0.01,
            "at {} mm: {found}",
            row[0]
        );
    }
}

/// EN 15302, cases E1 to E4, from the profiles: all conicities lie within the limits of the standard, and
/// the rail's axis 750 mm from the middle of the track, as the standard has it. The rail is inclined in its
/// points: its highest point lies 0.49 mm above its datum, on the field side. Measured below that, E4 is
/// outside of its limits.
#[test]
fn issue_047_the_gauge_is_measured_from_the_datum_of_the_rail() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/en15302");
    let rail = Profile::read(&folder.join("rail_a.csv"), ProfileKind::Rail, 0.0).unwrap();
    let [y, top] = rail.top();
    assert!((top - 0.492e-3).abs() < 1e-6 && y > 0.01, "{y} {top}");
    let outside = |case: usize, gauge_depth: f64| {
        let wheel = folder.join(format!("wheel_{}.csv", ["a", "b", "h", "i"][case - 1]));
        let wheel = Profile::read(&wheel, ProfileKind::Wheel, 0.0).unwrap();
        let layout = Layout {
            tape_distance: 1.5,
            gauge: 1.435,
            gauge_depth,
        };
        let wheelset = RigidWheelset::new([&wheel; 2], [RADIUS; 2], [&rail; 2], layout, STEEL).unwrap();
        let table = RollingRadiusDifference::of_positions(&wheelset.sweep(9e-3, 360, true)).unwrap();
        let (mut compared, mut outside) = (0, 0);
        for row in reference(&format!("conicity_e{case}.csv")) {
            // Where the difference is zero about the middle, the wheelset does not swing.
            let Ok(found) = table.equivalent_conicity(1e-3 * row[0], RADIUS, 1.5) else {
                continue;
            };
            compared += 1;
            outside += usize::from(!(row[3]..=row[2]).contains(&found.by_wavelength));
        }
        assert!(compared > 55, "E{case}: {compared}");
        (wheelset.rail_origins(), outside)
    };
    for case in 1..=4 {
        let (origins, outside) = outside(case, 0.014);
        assert!(
            origins.iter().all(|origin| (origin - 0.75).abs() < 1e-9),
            "{origins:?}"
        );
        assert_eq!(outside, 0, "E{case}");
    }
    assert_eq!(outside(4, 0.014 - top).1, 11);
}

/// A rail that is inclined by the program has its gauge below the highest point that it has then, as one that
/// stands on the track: 49 CFR 213.53 measures below the top of the rail.
#[test]
fn analytic_an_inclined_rail_keeps_its_datum_below_its_highest_point() {
    let rail = nominal::rail_136re().unwrap();
    for slope in [0.0, 0.025, 0.05] {
        let inclined = rail.inclined(slope).moved([0.0, 0.01]);
        assert_eq!(inclined.datum_depth(), 0.0);
        let level = inclined.top()[1] - nominal::GAUGE_DEPTH;
        let points = inclined.curve().sample(1e-5);
        let above = points.iter().filter(|(_, point)| point.position[1] >= level);
        let inner = above
            .map(|(_, point)| point.position[0])
            .fold(f64::INFINITY, f64::min);
        assert!((inclined.gauge_point(nominal::GAUGE_DEPTH) - inner).abs() < 1e-6);
    }
    let lifted = Profile::of_curve("lifted", ProfileKind::Rail, rail.curve().moved(0.0, [0.0, 1e-3]));
    assert!((lifted.datum_depth() - 1e-3).abs() < 1e-12);
    assert!((lifted.inclined(0.025).datum_depth() - 1e-3).abs() < 1e-12);
    assert!(lifted.gauge_point(0.005) < rail.gauge_point(0.005));
    assert!((lifted.gauge_point(0.005) - rail.gauge_point(0.006)).abs() < 1e-9);
}

/// A rail whose datum is not its top is not measured in silence: by the number of points above, below and
/// beside the levels at which gauge is measured.
#[test]
fn issue_047_a_datum_far_from_the_top_of_the_rail_is_told() {
    let (wheel, rail) = (nominal::aar_1b().unwrap(), nominal::rail_136re().unwrap());
    let with = |height: f64, gauge_depth: f64| {
        let curve = rail.curve().moved(0.0, [0.0, height]);
        let moved = Profile::of_curve("moved.csv", ProfileKind::Rail, curve);
        let layout = Layout {
            gauge_depth,
            ..FREIGHT
        };
        RigidWheelset::new([&wheel; 2], [0.4572; 2], [&moved; 2], layout, STEEL)
    };
    for height in [-1.9e-3, -6e-3, 1.9e-3] {
        with(height, 0.014).unwrap();
    }
    for height in [-0.1, -0.02, -8e-3, 5e-3, 0.03, 0.1857] {
        let error = with(height, 0.014).unwrap_err();
        assert!(matches!(error, ProfileError::Datum { .. }), "{height}: {error}");
        let (message, remedy) = (error.to_string(), error.remedy());
        assert!(
            message.contains(&format!("z = {:.3} mm", 1e3 * height)),
            "{message}"
        );
        assert!(
            remedy.contains(&format!("add {:.3} mm to z", -1e3 * height)),
            "{remedy}"
        );
        // The depth that is offered is accepted, and is as far below the highest point as the one given.
        let depth = 0.014 - height;
        assert_eq!(remedy.contains("a gauge depth of"), depth > 0.0, "{remedy}");
        if depth > 0.0 {
            let [origin, _] = with(height, depth).unwrap().rail_origins();
            let [upright, _] = with(0.0, 0.014).unwrap().rail_origins();
            assert!((origin - upright).abs() < 1e-9, "{height}: {origin} {upright}");
        }
    }
}

/// With roll: the roll is λ y / l, and the contact wanders on the rail by R times the roll, which adds R λ /
/// l to the conicity; the planes of contact turn with the roll. All to first order in λ.
#[test]
fn analytic_roll_of_coned_wheels() {
    for slope in [0.025, 0.05] {
        let wheelset = cones(slope);
        let found = LinearGeometry::of(&wheelset, 1e-3).unwrap();
        // The contacts lie inside of the tops, where the rail has the slope of the cone.
        let half = 0.75 - CROWN * slope;
        assert!(
            (found.half_distance - half).abs() < 2e-4,
            "{} {half}",
            found.half_distance
        );
        let roll = slope / half;
        assert!(
            (found.roll_coefficient / roll - 1.0).abs() < 5.0 * slope * slope,
            "{} {roll}",
            found.roll_coefficient
        );
        let conicity = slope * (1.0 + CROWN * roll);
        assert!(
            (found.conicity / conicity - 1.0).abs() < 5.0 * slope * slope,
            "{} {conicity}",
            found.conicity
        );
        assert!((found.contact_angle.tan() / slope - 1.0).abs() < 1e-6);
        assert!((found.contact_angle_rate / roll - 1.0).abs() < 0.02, "{found:?}");
        let simple = LinearGeometry::of_cones(slope, half, found.radius);
        assert!((found.roll_coefficient / simple.roll_coefficient - 1.0).abs() < 0.02);
        assert!((simple.gravitational_stiffness(1e5) - 1e5 * slope / half).abs() < 1e-9);
    }
    // Klingel's wavelengths of another source, to their digits: r0 = 0.4572 m, l = 0.7455 m.
    for (slope, wavelength) in [(0.025, 23.20), (0.05, 16.40), (0.1, 11.60), (0.2, 8.20)] {
        let found = LinearGeometry::of_cones(slope, 0.7455, 0.4572).klingel_wavelength();
        assert!((found - wavelength).abs() < 5e-3, "{found}");
    }
}

/// A rolling radius difference `a y + b y³`: by harmonic linearization `a/2 + 3 b A²/8`; the wavelength from
/// the pendulum-like integral, computed here by the arithmetic-geometric mean.
#[test]
fn analytic_conicity_of_a_cubic() {
    let (a, b, amplitude) = (0.1f64, 600.0f64, 5e-3f64);
    let entries = (-2000..=2000).map(|i| {
        let y = 5e-6 * f64::from(i);
        [y, a * y + b * y * y * y]
    });
    let table = RollingRadiusDifference::new(entries).unwrap();
    let found = table.equivalent_conicity(amplitude, RADIUS, 1.5).unwrap();
    let square = amplitude * amplitude;
    let linearized = 0.5 * a + 0.375 * b * square;
    assert!(
        (found.by_linearization / linearized - 1.0).abs() < 1e-5,
        "{found:?}"
    );
    // y'' = -(a y + b y³)/c: the period is 4 K(m)/ω with ω² = (a + b A²)/c and m = b A²/(2 (a + b A²)).
    let scale = 2.0 * 0.75 * RADIUS;
    let frequency = ((a + b * square) / scale).sqrt();
    let modulus = b * square / (2.0 * (a + b * square));
    let (mut x, mut y) = (1.0f64, (1.0 - modulus).sqrt());
    for _ in 0..10 {
        (x, y) = (0.5 * (x + y), (x * y).sqrt());
    }
    let wavelength = 4.0 * (0.5 * PI / x) / frequency;
    assert!(
        (found.wavelength / wavelength - 1.0).abs() < 1e-5,
        "{} {wavelength}",
        found.wavelength
    );
    let conicity = (2.0 * PI / wavelength).powi(2) * RADIUS * 0.75;
    assert!((found.by_wavelength / conicity - 1.0).abs() < 2e-5);
}

/// Rolls of the Manchester benchmark's wheelset, which are prescribed there: to the right by y, the roll is
/// negative.
#[test]
fn reproduction_rolls_of_the_manchester_benchmark() {
    let wheelset = manchester();
    for (y, roll) in [
        (1.0, -5.049e-5),
        (2.0, -1.128e-4),
        (3.0, -1.803e-4),
        (4.0, -2.557e-4),
        (5.0, -3.554e-4),
    ] {
        // There y is the place of the wheelset's center.
        let shift = -1e-3 * y + RADIUS * roll;
        let found = wheelset.position(shift, -2.4e-3 * y).unwrap();
        assert!((found.center + 1e-3 * y).abs() < 2e-5, "{}", found.center);
        // 5e-6 rad are 7.5 μm between the wheels: the heights to which the profiles are the same in both
        // programs.
        assert!((found.roll - roll).abs() < 5e-6, "{y}: {} {roll}", found.roll);
        // Both touch.
        assert!(found.touches.iter().all(|touch| touch.overlap.abs() < 1e-12));
    }
    // Symmetry.
    let [left, right] = [2e-3, -2e-3].map(|shift| wheelset.position(shift, 0.0).unwrap());
    assert!((left.roll + right.roll).abs() < 1e-12 && (left.height - right.height).abs() < 1e-12);
    assert!((left.rolling_radius_difference() + right.rolling_radius_difference()).abs() < 1e-9);
    assert!((left.contact_angles()[0] - right.contact_angles()[1]).abs() < 1e-9);
}

/// The nominal freight wheelset: 1:20 on the tread, free play and a flange contact as steep as the flange.
#[test]
fn analytic_the_nominal_freight_wheelset() {
    let wheelset = freight();
    let linear = LinearGeometry::of(&wheelset, 1e-3).unwrap();
    assert!(linear.conicity > 0.05 && linear.conicity < 0.053, "{linear:?}");
    assert!((linear.contact_angle.tan() - 0.05).abs() < 1e-6);
    let mut flange = None;
    for position in wheelset.sweep(0.02, 400, false) {
        let angles = position.contact_angles();
        if position.shift.abs() < 5e-3 {
            assert!(angles.iter().all(|angle| *angle < 0.06), "{position:?}");
        }
        if angles[0] > 0.5 && flange.is_none() {
            flange = Some((position.shift, angles[0]));
        }
    }
    let (shift, angle) = flange.unwrap();
    assert!(shift > 5e-3 && shift < 1.6e-2, "the flange touches at {shift} m");
    assert!(
        angle.to_degrees() < 75.0 + 1e-3 + 5.0 && angle.to_degrees() > 60.0,
        "{angle}"
    );
}

#[test]
fn input_tables_and_amplitudes_that_give_no_conicity() {
    let table = |entries: &[[f64; 2]]| RollingRadiusDifference::new(entries.iter().copied());
    assert_eq!(
        table(&[[0.0, 0.0], [1.0, 1.0]]).unwrap_err(),
        ConicityError::Table { entry: 2 }
    );
    assert_eq!(
        table(&[[0.0, 0.0], [1.0, 1.0], [1.0, 2.0]]).unwrap_err(),
        ConicityError::Table { entry: 3 }
    );
    let line = table(&[[-0.01, -1e-3], [0.0, 0.0], [0.01, 1e-3]]).unwrap();
    let error = line.equivalent_conicity(0.011, RADIUS, 1.5).unwrap_err();
    assert!(
        error.to_string().contains("the table has -10.00 to 10.00 mm"),
        "{error}"
    );
    assert!(line.equivalent_conicity(-1.0, RADIUS, 1.5).is_err());
    // A wheelset whose radius difference leads it away.
    let away = table(&[[-0.01, 1e-3], [0.0, 0.0], [0.01, -1e-3]]).unwrap();
    assert!(away.equivalent_conicity(0.005, RADIUS, 1.5).is_err());
    // One-sided: the middle of the motion lies where the difference is zero.
    let aside = table(&[[-0.01, -1.2e-3], [0.0, -0.2e-3], [0.01, 0.8e-3]]).unwrap();
    let found = aside.equivalent_conicity(0.003, RADIUS, 1.5).unwrap();
    assert!((found.middle - 0.002).abs() < 1e-9 && (found.by_wavelength - 0.05).abs() < 1e-9);
    // Off the rails.
    let wheelset = cones(0.05);
    assert!(wheelset.position(0.5, 0.0).is_none() && wheelset.level_position(0.5).is_none());
    assert!(matches!(
        LinearGeometry::of(&wheelset, 0.5),
        Err(ConicityError::OffRail { .. })
    ));
}

#[test]
fn input_wheelsets_that_do_not_fit_are_refused() {
    let wheel = nominal::aar_1b().unwrap();
    let rail = nominal::rail_136re().unwrap();
    let make = |tape_distance: f64, gauge: f64| {
        let layout = Layout {
            tape_distance,
            gauge,
            gauge_depth: nominal::GAUGE_DEPTH,
        };
        RigidWheelset::new([&wheel; 2], [0.4572; 2], [&rail; 2], layout, STEEL)
    };
    assert!(make(1.504, 1.4351).is_ok());
    assert!(matches!(
        make(1.55, 1.4351),
        Err(ProfileError::WiderThanGauge { .. })
    ));
    let error = make(1504.0, 1.4351).unwrap_err();
    assert!(
        error.to_string().contains("distance of the tape circles"),
        "{error}"
    );
}
