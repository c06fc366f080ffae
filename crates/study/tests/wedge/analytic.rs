//! Metrics and cases against closed forms.

use std::f64::consts::PI;

use crate::runs::{INCH, LBF, column};
use mechanics::quasi_static::{QuasiStaticWedge, SlidingDirection, SlopeFriction};
use study::case::{Case, builtin};
use study::closed_form;
use study::metrics::{Cycle, first_harmonic};
use study::result::RunResult;
use study::run::Run;

const LBF_S_PER_IN: f64 = LBF / INCH;

fn run(name: &str, overrides: &[&str]) -> (Case, RunResult) {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let case = builtin::case_with(name, &overrides).unwrap();
    let result = Run::new(&case).unwrap().finish(|_| {});
    assert!(result.summary.complete, "{name}");
    (case, result)
}

/// Times, displacement and force of a law F(z, ż) under A sin(ωt).
fn sine(
    amplitude: f64,
    frequency: f64,
    rows: usize,
    end: f64,
    force: impl Fn(f64, f64) -> f64,
) -> [Vec<f64>; 3] {
    let times: Vec<f64> = (0..=rows).map(|i| end * i as f64 / rows as f64).collect();
    let z = |t: &f64| amplitude * (frequency * t).sin();
    let rate = |t: &f64| amplitude * frequency * (frequency * t).cos();
    let forces = times.iter().map(|t| force(z(t), rate(t))).collect();
    let displacements = times.iter().map(z).collect();
    [times, displacements, forces]
}

#[test]
fn spring_and_dashpot_come_back() {
    for (k, c, offset) in [
        (3e5, 0.0, 0.0),
        (0.0, 2e3, 0.0),
        (3e5, 2e3, 5e4),
        (-1e4, 50.0, 1.0),
    ] {
        let frequency = 7.0;
        let [times, z, f] = sine(0.01, frequency, 5000, 3.0, |z, rate| offset - k * z - c * rate);
        // A window that does not begin or end at a row, and a displacement about another place.
        let z: Vec<f64> = z.iter().map(|z| z - 0.3).collect();
        let start = 0.123_456;
        let window = (start, start + 2.0 * 2.0 * PI / frequency);
        let found = first_harmonic(&times, &z, &f, frequency, window).unwrap();
        let scale = k.abs() + c * frequency;
        assert!((found.stiffness - k).abs() < 1e-5 * scale, "{found:?} {k} {c}");
        assert!(
            (found.damping - c).abs() * frequency < 1e-5 * scale,
            "{found:?} {k} {c}"
        );
    }
}

/// The quasi-static wedge of the thesis under 1 in · sin(2 rad/s t): W/(π ω A²) = 1059 lbf·s/in (constant)
/// and 263 (variable, the coil just free at mid-stroke); in phase nothing, and K/2 (1 + (f_down - f_up)/2).
#[test]
fn the_damping_of_the_quasi_static_wedge() {
    let wedge = |angle: f64| QuasiStaticWedge {
        angle: angle.to_radians(),
        toe: 0.0,
        column_friction: 0.4,
        slope_friction: 0.4,
    };
    let friction = |wedge: QuasiStaticWedge, direction, coil| {
        let slide = wedge.slide(direction, wedge.branch(direction), coil);
        slide.unwrap().column_friction
    };
    let constant = wedge(37.5);
    let (up, down) = (
        friction(constant, SlidingDirection::Up, 3702.2),
        friction(constant, SlidingDirection::Down, 3702.2),
    );
    let [times, z, f] = sine(
        1.0,
        2.0,
        200_000,
        2.0 * PI,
        |_, rate| if rate > 0.0 { -up } else { down },
    );
    let window = (0.5 * PI, 1.5 * PI);
    let found = first_harmonic(&times, &z, &f, 2.0, window).unwrap();
    assert!((found.damping - 1059.0).abs() < 0.6, "{found:?}");
    assert!(found.stiffness.abs() < 0.1, "{found:?}");

    let variable = wedge(32.0);
    let (up, down) = (
        friction(variable, SlidingDirection::Up, 1.0),
        friction(variable, SlidingDirection::Down, 1.0),
    );
    let [times, z, f] = sine(1.0, 2.0, 200_000, 2.0 * PI, |z, rate| {
        let coil = 3000.0 * (-z).max(0.0);
        if rate > 0.0 {
            coil * (1.0 - up)
        } else {
            coil * (1.0 + down)
        }
    });
    let found = first_harmonic(&times, &z, &f, 2.0, window).unwrap();
    assert!((found.damping - 263.0).abs() < 0.6, "{found:?}");
    // f_down = 0.4139, f_up = 0.6898.
    assert!(
        (found.stiffness - 1500.0 * (1.0 - 0.137_95)).abs() < 0.2,
        "{found:?}"
    );
}

/// Coulomb friction F under a triangle: harmonics 4F/π and 8A/π².
#[test]
fn coulomb_friction_under_a_triangle() {
    let (friction, amplitude, frequency) = (100.0, 0.5, 2.0 * PI);
    let times: Vec<f64> = (0..=100_000).map(|i| 3.0 * f64::from(i) / 100_000.0).collect();
    let z: Vec<f64> = times
        .iter()
        .map(|t| amplitude * 2.0 / PI * (frequency * t).sin().asin())
        .collect();
    let f: Vec<f64> = times
        .iter()
        .map(|t| {
            if (frequency * t).cos() > 0.0 {
                -friction
            } else {
                friction
            }
        })
        .collect();
    let found = first_harmonic(&times, &z, &f, frequency, (0.5, 2.5)).unwrap();
    let expected = (4.0 * friction / PI) / (8.0 * amplitude / (PI * PI)) / frequency;
    assert!(
        (found.damping / expected - 1.0).abs() < 1e-3,
        "{found:?} {expected}"
    );
    assert!(found.stiffness.abs() < 1e-3 * expected * frequency);
}

#[test]
fn no_harmonic_where_there_is_none() {
    let [times, z, f] = sine(1.0, 2.0, 1000, 2.0 * PI, |z, _| -z);
    let still = vec![0.4; z.len()];
    assert_eq!(first_harmonic(&times, &still, &f, 2.0, (0.0, PI)), None);
    assert_eq!(first_harmonic(&times, &z, &f[1..], 2.0, (0.0, PI)), None);
    assert_eq!(first_harmonic(&times, &z, &f, 2.0, (PI, 3.0 * PI)), None);
    assert_eq!(first_harmonic(&times, &z, &f, 2.0, (-1.0, PI - 1.0)), None);
    assert_eq!(first_harmonic(&times, &z, &f, 2.0, (2.0, 2.0)), None);
    assert_eq!(first_harmonic(&times, &z, &f, 0.0, (0.0, PI)), None);
    assert_eq!(first_harmonic(&[], &[], &[], 2.0, (0.0, PI)), None);
}

/// Out of phase, the force on the bolster takes up what friction and dashpots lose: the one comes from forces
/// at output times, the other from the integrals of the losses.
#[test]
fn the_damping_on_the_bolster_is_what_is_lost() {
    for name in [
        "sweep_constant_0.5in_1hz",
        "sweep_variable_1in_2hz",
        "wear_variable_0.2in",
    ] {
        let (case, result) = run(name, &["simulation.output_interval=0.001 s"]);
        let cycle = Cycle::of(&case.parameters).unwrap();
        let (start, end, cycles) = cycle.window(case.simulation.duration).unwrap();
        let row = |time: f64| (time / 0.001).round() as usize;
        let lost: f64 = [
            "side_frame_friction_loss",
            "bolster_friction_loss",
            "contact_damping_loss",
            "coil_damping_loss",
            "stored_energy_change",
        ]
        .iter()
        .map(|name| {
            let values = result.column(name).unwrap();
            values[row(end)] - values[row(start)]
        })
        .sum();
        let guide = result.column("coil_guide_work").unwrap();
        let work = (lost - guide[row(end)] + guide[row(start)]) / f64::from(cycles);
        let expected = work / (PI * cycle.angular_frequency * cycle.amplitude * cycle.amplitude);
        let found = result.summary.averages.equivalent_damping_on_bolster.unwrap();
        assert_eq!(found.unit, "lbf·s/in");
        let found = found.value * LBF_S_PER_IN;
        assert!(
            (found / expected - 1.0).abs() < 2e-3,
            "{name}: {found} {expected}"
        );
    }
}

/// A planar wedge with so much toe that the slope slides: at the end of each stroke of the rig test its
/// forces are those of the quasi-static wedge under the coil's force less the weight. As the wedge moves
/// along x its coil leans; seen from a frame that leans with the coil by λ, the angles are θ + λ and φ - λ.
#[test]
fn the_rig_test_reaches_the_quasi_static_forces() {
    for name in ["rig_constant", "rig_variable"] {
        let (case, result) = run(
            name,
            &[
                r#"wedge.free_coordinates=["x","z"]"#,
                r#"side_frame.toe="2 deg out""#,
            ],
        );
        let values = |name, unit| column(&result, name, unit);
        let (force, coil) = (values("vertical_wedge_force", LBF), values("coil_force", LBF));
        let (aside, length) = (values("wedge_x", INCH), values("coil_length", INCH));
        let toe = case.parameters.toe;
        // The triangle turns at 2.5, 7.5, ... s; rows are 0.02 s apart.
        for (time, direction, sign) in [
            (12.48, SlidingDirection::Up, 1.0),
            (17.48, SlidingDirection::Down, -1.0),
        ] {
            let row = (time / 0.02_f64).round() as usize;
            let lean = (aside[row] / length[row]).asin();
            let wedge = QuasiStaticWedge {
                angle: case.parameters.wedge.angle + lean,
                toe: toe - lean,
                column_friction: 0.4,
                slope_friction: 0.4,
            };
            let slide = wedge
                .slide(direction, wedge.branch(direction), coil[row] - 50.0)
                .unwrap();
            let expected = sign * slide.column_friction * toe.cos();
            assert!(
                (force[row] / expected - 1.0).abs() < 0.002,
                "{name} {direction:?}: {} {expected}",
                force[row]
            );
        }
    }
}

/// As built in, with the thesis's toe of 0.2°, only the upward strokes get there; no force is greater.
#[test]
fn the_rig_test_as_built_in_stays_within_the_quasi_static_forces() {
    for name in ["rig_constant", "rig_variable"] {
        let (case, result) = run(name, &[]);
        let wedge = QuasiStaticWedge {
            angle: case.parameters.wedge.angle,
            toe: case.parameters.toe,
            column_friction: 0.4,
            slope_friction: 0.4,
        };
        let (force, coil) = (
            column(&result, "vertical_wedge_force", LBF),
            column(&result, "coil_force", LBF),
        );
        let share = |row: usize| {
            let slide = wedge.slide(SlidingDirection::Up, SlopeFriction::UpSlope, coil[row] - 50.0);
            force[row] / slide.unwrap().column_friction
        };
        let end = share(624);
        assert!((0.97..1.005).contains(&end), "{name}: {end}");
        let most = (500..force.len()).map(share).fold(0.0, f64::max);
        assert!(most < 1.01, "{name}: {most}");
    }
}

/// The reference lines in the thesis's numbers, a massless wedge: the table of theory.md, W/(π ω A²), and the
/// edge-loading limit of a nest of two wedges, 30.3 to 57.1 kip·in.
#[test]
fn reference_lines_in_numbers() {
    let mut parameters = builtin::case("cdrun_toe_0_psi_0").unwrap().parameters;
    parameters.gravity = 0.0;
    let force = |direction| closed_form::vertical_wedge_force(&parameters, 0.01, direction).unwrap() / LBF;
    assert!((force(SlidingDirection::Up) - 2174.4).abs() < 0.1);
    assert!((force(SlidingDirection::Down) + 1153.1).abs() < 0.1);
    let found = closed_form::first_harmonic(&parameters).unwrap();
    assert!((found.damping / LBF_S_PER_IN - 1059.0).abs() < 0.5, "{found:?}");
    assert!(found.stiffness.abs() < 1e-6 * found.damping);
    let energy = closed_form::energy_per_cycle(&parameters).unwrap() / crate::runs::LBF_IN;
    assert!((energy - 6655.0).abs() < 0.5, "{energy}");
    for (normal, nest) in [(2882.7, 30_300.0), (5435.9, 57_100.0)] {
        let limit = 2.0 * closed_form::edge_loading_limit(&parameters, normal * LBF) / crate::runs::LBF_IN;
        assert!((limit - nest).abs() < 50.0, "{limit}");
    }
    // Below the free coil by 1 in, 0.5 in each way: K (1 + (f_down - f_up)/2), and (f_up + f_down) K h 2A a
    // cycle.
    let set =
        [r#"bolster.vertical=[{ shape = "sine", amplitude = "0.5 in", frequency = "2 rad/s" }, "-1 in"]"#];
    let set: Vec<String> = set.iter().map(|text| (*text).to_owned()).collect();
    let mut parameters = builtin::case_with("vdrun_toe_0_psi_0", &set).unwrap().parameters;
    parameters.gravity = 0.0;
    let found = closed_form::first_harmonic(&parameters).unwrap();
    assert!((found.stiffness / LBF_S_PER_IN / (3000.0 * (1.0 - 0.137_95)) - 1.0).abs() < 1e-4);
    let damping = (0.6898 + 0.4139) * 3000.0 / (PI * 2.0 * 0.25);
    assert!((found.damping / LBF_S_PER_IN / damping - 1.0).abs() < 1e-4);
    // At 1 in each way the thesis's bolster lifts off: no straight lines.
    let thesis = builtin::case("vdrun_toe_0_psi_0").unwrap().parameters;
    assert_eq!(closed_form::first_harmonic(&thesis), None);
    // Toe in jams on the way down at friction 0.4.
    let jam = builtin::case("cdrun_toe_in_0.2_psi_0").unwrap().parameters;
    assert_eq!(
        closed_form::vertical_wedge_force(&jam, 0.0, SlidingDirection::Down),
        None
    );
}

/// The cases' wedges rise by the closed form, less what the contacts give under the smaller force of the
/// coil.
#[test]
fn the_worn_cases_rise_by_the_closed_form() {
    for damping in ["constant", "variable"] {
        let height = |depth: &str| {
            let name = format!("wear_{damping}_{depth}in");
            let (case, result) = run(&name, &["simulation.duration=0.02 s"]);
            (
                column(&result, "wedge_z", INCH)[0],
                case.parameters.wedge_rise() / INCH,
            )
        };
        let (unworn, none) = height("0");
        assert_eq!(none, 0.0);
        for depth in ["0.1", "0.2", "0.3"] {
            let (worn, expected) = height(depth);
            let share = (worn - unworn) / expected;
            assert!((0.93..1.0).contains(&share), "{damping} {depth}: {share}");
        }
    }
}
