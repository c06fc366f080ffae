//! Wedges with mass in place of the files' massless ones: closed forms, the massless law as their limit, the
//! energy ledger, bodies with linearized against bodies with finite kinematics.
#![allow(clippy::unwrap_used)]

use mechanics::body::Body;
use mechanics::connection::Law;
use mechanics::curve::Curve;
use mechanics::motion::Motion;
use mechanics::system::System;
use study::half_truck::run::{run, start};
use study::half_truck::{HalfTruckCase, HalfTruckResult, HalfTruckStart};
use study::plausibility;

use crate::common::{INCH, POUND, POUND_INCH, bodies, run_cases, set_over};

const WEDGES: [u32; 4] = [127, 128, 129, 130];
/// Weight of a wedge, lb.
const WEIGHT: f64 = 50.0;

fn column<'r>(result: &'r HalfTruckResult, wedge: u32, what: &str) -> &'r [f64] {
    result.column(&format!("wedge_{wedge}_{what}")).unwrap()
}

/// Means of the column's friction going up and down (lb), and the energy of a cycle (lb·in).
fn branches(result: &HalfTruckResult) -> [f64; 3] {
    let wedge = &result.summary.wedges["127"];
    [&wedge.up, &wedge.down, &wedge.energy_per_cycle].map(|own| own.as_ref().unwrap().value)
}

/// Without friction a wedge at rest is a matter of two normal forces, its weight and its coil:
/// `N_c = ((F_z - W) cos θ + F_x sin θ) / sin(θ + φ)` with F_x the coil's shear towards the column.
#[test]
fn analytic_column_force_without_friction() {
    for (name, angle, toe) in [
        ("nucars_69_constant_toe_out", 37.5_f64, 0.2_f64),
        ("nucars_69_constant_toe_none", 37.5, 0.0),
        ("nucars_69_constant_toe_in", 37.5, -0.2),
        ("nucars_69_variable_toe_out", 32.0, 0.2),
    ] {
        let without = ["wedges.column_friction=0", "wedges.slope_friction=0"];
        let case = bodies(name, 1.0, &without);
        let mut system = System::new(case.truck.model.clone()).unwrap();
        let rest = start(&mut system, HalfTruckStart::Equilibrium).unwrap().state;
        let seen = system.observe(0.0, &rest);
        let (theta, phi) = (angle.to_radians(), toe.to_radians());
        for (wedge, end) in case.wedge_bodies.iter().zip([1.0, 1.0, -1.0, -1.0]) {
            let [x, _, z] = seen.elements[wedge.coil].force.0;
            let normal = |face: usize| seen.faces[face].points.iter().map(|own| own.normal).sum::<f64>();
            let [column, slope] = wedge.faces.map(normal);
            let load = z - WEIGHT * POUND;
            let expected = (load * theta.cos() + end * x * theta.sin()) / (theta + phi).sin();
            println!(
                "{name}: coil {:.3} lb, column {column:.6} N, by hand {expected:.6}",
                z / POUND
            );
            assert!(z > 100.0 * POUND, "{name}: {z}");
            // The slopes of a bolster that does not turn are as drawn.
            assert!(
                (column / expected - 1.0).abs() < 1e-6,
                "{name}: {column} {expected}"
            );
            let expected = (load * phi.cos() - end * x * phi.sin()) / (theta + phi).sin();
            assert!(
                (slope / expected - 1.0).abs() < 1e-6,
                "{name}: {slope} {expected}"
            );
        }
    }
}

/// A run that starts at rest starts there whatever the friction: its faces carry what they carry without, and
/// no friction.
#[test]
fn analytic_rest_with_friction_is_that_without() {
    let name = "nucars_69_constant_toe_out";
    let rest = "simulation.start=equilibrium";
    let without = [rest, "wedges.column_friction=0", "wedges.slope_friction=0"];
    let results = run_cases(&[bodies(name, 0.02, &[rest]), bodies(name, 0.02, &without)]);
    for number in WEDGES {
        let [found, expected] = [0, 1].map(|run| column(&results[run], number, "column_normal_force")[0]);
        println!("{number}: {found} N, without friction {expected} N");
        assert!(
            (found / expected - 1.0).abs() < 1e-9 && found > 4000.0 * POUND,
            "{found} {expected}"
        );
        assert!(
            column(&results[0], number, "column_friction")[0].abs() < 1e-3,
            "{number}"
        );
        assert!(
            column(&results[0], number, "column_friction")[1].abs() > 1.0,
            "{number}"
        );
    }
}

fn stiffer(factor: f64, with_bodies: bool) -> Vec<String> {
    let root = factor.sqrt();
    let mut set = vec![
        format!("wedges.stiffness=\"{} lbf/in\"", 1e6 * factor),
        format!("wedges.damping=\"{} lbf*s/in\"", 1e3 * root),
    ];
    if with_bodies {
        set.push("option.wedge_mass=\"5 lb\"".to_owned());
        set.push(format!(
            "option.wedge_contact_stiffness=\"{} lbf/in\"",
            2.5e5 * factor
        ));
        set.push(format!(
            "option.wedge_contact_damping=\"{} lbf*s/in\"",
            25.0 * root
        ));
    }
    set
}

/// With toe out the branches have a meaning: a light wedge with stiff contacts and stiff bristles goes to the
/// massless law with the same accumulators. Soft ones do not: over 1 in of travel the toe moves the wedge in
/// its pocket by 0.0045 in, and contacts and bristles of 1e6 lb/in take up as much as half of that before the
/// slope slips back. The massless law's energy is that of the bolster's way; the wedge's is shorter by its
/// rise, `tan φ / tan θ` of it. With variable damping the branches go with the travel, so that stiffer parts
/// are needed, and the ringing of the input springs must die down.
#[test]
fn convergence_of_a_light_stiff_wedge_to_the_massless_law() {
    for (name, angle, duration, factors, last) in [
        (
            "nucars_69_constant_toe_out",
            37.5_f64,
            7.0,
            [1.0, 3.0, 10.0],
            0.005,
        ),
        ("nucars_69_variable_toe_out", 32.0, 20.0, [1.0, 10.0, 30.0], 0.03),
    ] {
        let shorter = 1.0 - 0.2_f64.to_radians().tan() / angle.to_radians().tan();
        let mut cases = Vec::new();
        for factor in factors {
            for with_bodies in [true, false] {
                let set = stiffer(factor, with_bodies);
                let set: Vec<&str> = set.iter().map(String::as_str).collect();
                cases.push(match with_bodies {
                    true => bodies(name, duration, &set),
                    false => set_over(name, duration, &set),
                });
            }
        }
        let results = run_cases(&cases);
        let errors: Vec<[f64; 3]> = results
            .chunks(2)
            .map(|pair| {
                let (with_mass, mut massless) = (branches(&pair[0]), branches(&pair[1]));
                println!("{name}: with mass {with_mass:.1?}, massless {massless:.1?}");
                massless[2] *= shorter;
                std::array::from_fn(|k| (with_mass[k] / massless[k] - 1.0).abs())
            })
            .collect();
        println!("{name}: {errors:.4?}");
        for k in 0..3 {
            assert!(errors[2][k] < last, "{name}: {errors:?}");
            assert!(errors[2][k] < 0.2 * errors[0][k], "{name}: {errors:?}");
        }
    }
}

/// A slope without friction makes the normal force determinate, whatever the toe: then the wedge needs no
/// travel to come to the massless law, and only the give of its contacts (a share of the coil's stroke) parts
/// them.
#[test]
fn limits_a_slope_without_friction_leaves_nothing_to_the_start() {
    for name in ["nucars_69_constant_toe_none", "nucars_68_constant_toe_out"] {
        let own = |with_bodies: bool| {
            let mut set = stiffer(30.0, with_bodies);
            set.push("wedges.slope_friction=0".to_owned());
            set
        };
        let (heavy, light) = (own(true), own(false));
        let heavy: Vec<&str> = heavy.iter().map(String::as_str).collect();
        let light: Vec<&str> = light.iter().map(String::as_str).collect();
        let results = run_cases(&[bodies(name, 7.0, &heavy), set_over(name, 7.0, &light)]);
        let (with_mass, massless) = (branches(&results[0]), branches(&results[1]));
        println!("{name}: with mass {with_mass:.1?}, massless {massless:.1?}");
        for k in 0..3 {
            assert!(
                (with_mass[k] / massless[k] - 1.0).abs() < 0.005,
                "{name}: {with_mass:?} {massless:?}"
            );
        }
    }
}

/// With no toe the slope sticks, and the normal force is what the start locked in: the branches of the
/// massless law are not those of a wedge with mass.
#[test]
fn limits_without_toe_the_start_sets_the_normal_force() {
    let name = "nucars_69_constant_toe_none";
    let results = run_cases(&[bodies(name, 7.0, &[]), set_over(name, 7.0, &[])]);
    let ([up, down, _], [up_massless, down_massless, _]) = (branches(&results[0]), branches(&results[1]));
    println!("up {up} down {down}, massless {up_massless} {down_massless} lb");
    assert!((up / -down - 1.0).abs() < 0.02, "{up} {down}");
    assert!(
        up_massless / -down_massless > 1.8,
        "{up_massless} {down_massless}"
    );
}

#[test]
fn energy_ledgers_close_with_wedge_bodies() {
    let mut cases = Vec::new();
    for wedges in ["68", "69"] {
        for damping in ["variable", "constant"] {
            for toe in ["out", "none", "in"] {
                let name = format!("nucars_{wedges}_{damping}_toe_{toe}");
                cases.push(bodies(&name, 7.0, &["option.plain_toe_angle=0.2 deg"]));
            }
            cases.push(bodies(
                &format!("nucars_{wedges}_{damping}_toe_out_yaw"),
                4.0,
                &[],
            ));
        }
    }
    for (case, result) in cases.iter().zip(run_cases(&cases)) {
        let (name, summary) = (&case.name, &result.summary);
        assert!(summary.complete, "{name}: {:?}", summary.stopped);
        println!("{name}: {:.1e}", summary.largest_relative_residual);
        assert!(summary.largest_relative_residual < 1e-5, "{name}");
        let work = result.column("input_work").unwrap();
        let work = work.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        for loss in [
            "wedge_friction_loss",
            "contact_damping_loss",
            "element_loss",
            "wedge_127_column_friction_loss",
        ] {
            let lost = result.column(loss).unwrap();
            let most = lost.iter().fold(0.0, |most: f64, own| most.max(*own));
            assert!(most > 0.0, "{name}: {loss}");
            // What can only be lost never comes back.
            let falls = lost.windows(2).any(|pair| pair[1] < pair[0] - 1e-7 * work);
            assert!(!falls, "{name}: {loss} falls");
        }
        if !name.ends_with("yaw") {
            let found: Vec<&str> = plausibility::among(&summary.warnings).collect();
            assert!(found.is_empty(), "{name}: {found:?}");
        }
    }
}

/// Under yaw a wedge whose roll is free rolls by the difference of the yaws times cot θ, and stays flush on
/// both faces. Its column's moment about z stays within what its corners can carry: `N (h3/2 + μ h1/3)`.
#[test]
fn analytic_yawed_wedges_roll_and_stay_flush() {
    for (name, angle) in [
        ("nucars_69_constant_toe_out_yaw", 37.5_f64),
        ("nucars_68_constant_toe_out_yaw", 37.5),
    ] {
        let result = run(&bodies(name, 12.0, &[]), |_| ()).unwrap();
        let yaw = result.summary.yaw.as_ref().unwrap();
        assert!((yaw.reached.value - 0.012).abs() < 3e-4, "{name}: {yaw:?}");
        let late = |values: &[f64]| {
            values[values.len() / 2..].iter().sum::<f64>() / (values.len().div_ceil(2)) as f64
        };
        let body = |number: u32| late(result.column(&format!("body_{number}_yaw")).unwrap());
        for (number, side_frame) in [(127, 3), (128, 4), (129, 3), (130, 4)] {
            let end = if number < 129 { 1.0 } else { -1.0 };
            let roll = end * late(column(&result, number, "roll"));
            let expected = (body(1) - body(side_frame)) / angle.to_radians().tan();
            println!("{name} {number}: roll {roll:.6}, by hand {expected:.6}");
            assert!(
                (roll / expected - 1.0).abs() < 0.05,
                "{name} {number}: {roll} {expected}"
            );
            let normal = column(&result, number, "column_normal_force");
            let moment = column(&result, number, "column_moment_yaw");
            let depth = 6.125 * angle.to_radians().tan() / 3.0;
            let arm = (0.5 * 10.5 + 0.4 * depth) * INCH;
            let within = normal
                .iter()
                .zip(moment)
                .all(|(normal, moment)| moment.abs() <= normal * arm * 1.01 + 1.0);
            assert!(within, "{name} {number}");
        }
    }
}

/// Returns the half-truck with its input bodies turned: the bolster is driven in roll, pitch and yaw by stiff
/// springs of the middle one alone, by `size` (rad).
fn turned(size: f64, linearized: bool, set: &[&str]) -> HalfTruckCase {
    let mut case = bodies("nucars_69_constant_toe_out", 1.5, set);
    let middle = case.truck.body(8).unwrap();
    let outer = [7, 9].map(|number| case.truck.body(number).unwrap());
    let model = &mut case.truck.model;
    let frequencies = [5.0, 7.0, 4.0];
    for (k, frequency) in frequencies.into_iter().enumerate() {
        model.bodies[middle].frame.motions[3 + k] = Motion::Sine {
            amplitude: size,
            angular_frequency: frequency,
            phase: 0.0,
        };
    }
    for connection in &mut model.connections {
        let Law::Springs(springs) = &mut connection.law else {
            continue;
        };
        for (coordinate, spring) in springs {
            if connection.b == middle && *coordinate >= 3 {
                spring.spring = Some(Curve::linear(3e10 * POUND_INCH));
                spring.compression_limit = f64::NEG_INFINITY;
                spring.extension_limit = f64::INFINITY;
            } else if outer.contains(&connection.b) {
                spring.spring = None;
            }
        }
    }
    let files = case.truck.bodies.len();
    let finite = |body: &mut Body| body.linearized = false;
    if !linearized {
        model.bodies[..files].iter_mut().for_each(finite);
    }
    case
}

/// Returns the largest difference of all wedges' column forces (N) and rolls (rad), each with the largest
/// value.
fn differences(size: f64, set: &[&str]) -> [[f64; 2]; 2] {
    let results = run_cases(&[turned(size, true, set), turned(size, false, set)]);
    for result in &results {
        assert!(result.summary.complete, "{:?}", result.summary.stopped);
        assert!(result.summary.largest_relative_residual < 1e-5);
    }
    ["column_normal_force", "roll"].map(|what| {
        let mut most = [0.0_f64; 2];
        for number in WEDGES {
            let pairs = column(&results[0], number, what)
                .iter()
                .zip(column(&results[1], number, what));
            for (a, b) in pairs {
                most = [most[0].max((a - b).abs()), most[1].max(a.abs())];
            }
        }
        most
    })
}

/// Below 5 mrad bodies with linearized and with finite kinematics differ by less than 1 %, and the difference
/// falls with the square of the rotations.
#[test]
fn cross_code_linearized_against_finite_kinematics() {
    let smooth = [
        "wedges.column_friction=0",
        "wedges.slope_friction=0",
        "simulation.relative_tolerance=1e-8",
    ];
    let [coarse, fine] = [0.002, 0.001].map(|size| differences(size, &smooth));
    println!("without friction: 2 mrad {coarse:?}, 1 mrad {fine:?}");
    for (coarse, fine) in coarse.iter().zip(fine) {
        let order = (coarse[0] / fine[0]).log2();
        assert!((order - 2.0).abs() < 0.2, "order {order}: {coarse:?} {fine:?}");
    }
    let rough = ["simulation.relative_tolerance=1e-7"];
    for (what, set) in [("without friction", &smooth[..]), ("with friction", &rough)] {
        let found = differences(0.005, set);
        println!("{what}: 5 mrad {found:?}");
        for [difference, most] in found {
            assert!(difference < 0.01 * most, "{what}: {found:?}");
        }
    }
}
