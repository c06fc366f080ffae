//! Static balance, rest, natural frequencies and yaw of the printed half-truck, against hand calculations
//! with the numbers of its files (lb, in).
#![allow(clippy::unwrap_used)]

use integrate::Problem;
use mechanics::system::{Held, StaticFriction, System, Vibration};

use crate::common::{INCH, POUND, case, result};

/// Weight of half a car and its bolster, lb: 319.175 lb s²/in.
const WEIGHT: f64 = 319.175 * 386.088_582_677_165_35;
/// Body and side frames in the model: the ground is 0.
const BODY: usize = 1;
const LEFT: usize = 2;

fn system(name: &str) -> System {
    System::new(case(name, 1.0).truck.model).unwrap()
}

/// Returns the system without the springs that drive it.
fn without_inputs(name: &str) -> System {
    let mut model = case(name, 1.0).truck.model;
    let inputs: Vec<bool> = model
        .bodies
        .iter()
        .map(|body| body.is_prescribed() && body.frame.origin != [0.0; 3])
        .collect();
    model.connections.retain(|own| !inputs[own.a] && !inputs[own.b]);
    System::new(model).unwrap()
}

/// Vertical forces on the bodies in the drawn layout, lb.
fn residuals(name: &str) -> [f64; 2] {
    let mut system = system(name);
    let x = system.initial_state();
    let seen = system.observe(0.0, &x);
    [BODY, LEFT].map(|body| system.bodies()[body].mass * seen.bodies[body].accelerations[2] / POUND)
}

#[test]
fn forces_in_the_drawn_layout() {
    for (name, body, frame, digit) in [
        ("nucars_68_constant_toe_out", 0.4, -1.7, 0.1),
        ("nucars_69_constant_toe_out", -67.0, 32.0, 1.0),
        ("nucars_68_variable_toe_out", -123_230.0, 61_614.0, 1.0),
        ("nucars_69_variable_toe_out", -123_230.0, 61_614.0, 1.0),
    ] {
        let found = residuals(name);
        println!("{name}: {found:?} lb");
        for (found, expected) in found.into_iter().zip([body, frame]) {
            assert!(
                (found - expected).abs() <= digit,
                "{name}: {found} instead of {expected} lb"
            );
        }
    }
}

/// Vertical coordinates of body and left side frame at rest, in.
fn rest(system: &mut System) -> [f64; 2] {
    let x = system.initial_state();
    let rest = system.equilibrium(0.0, &x, StaticFriction::Without).unwrap();
    [BODY, LEFT].map(|body| rest[system.position_of(body, 2).unwrap()] / INCH)
}

#[test]
fn the_variably_damped_truck_hangs_on_its_input_springs() {
    // (3e6 + k) z - k f = -W;  (2 * 2e6 + k) f - k z = 8 * 15691 - 2301 of both frames
    for (name, springs) in [
        ("nucars_68_variable_toe_out", VARIABLE_PLAIN),
        ("nucars_69_variable_toe_out", variable_with_toe()),
    ] {
        let (inputs, bearings) = (3e6, 4e6);
        let frames = 8.0 * 15_691.0 - 2.0 * 1150.5;
        let determinant = (inputs + springs) * (bearings + springs) - springs * springs;
        let z = (-WEIGHT * (bearings + springs) + springs * frames) / determinant;
        let f = ((inputs + springs) * frames - springs * WEIGHT) / determinant;
        let [body, frame] = rest(&mut system(name));
        println!("{name}: {body} {frame} in, by hand {z} {f}");
        assert!(
            (body - z).abs() < 1e-6 && (frame - f).abs() < 1e-6,
            "{body} {z}, {frame} {f}"
        );
        assert!((body + 0.0402).abs() < 5e-5 && (frame - 0.0302).abs() < 5e-5);
        let [body, frame] = rest(&mut without_inputs(name));
        println!("  without inputs {body} {frame}, by hand {}", -WEIGHT / springs);
        assert!((body - frame + WEIGHT / springs).abs() < 2e-4, "{body} {frame}");
        if springs == VARIABLE_PLAIN {
            assert!((body + 3.42).abs() < 0.005);
        }
    }
}

/// Eight springs and four coils of 3000 lb/in, between bolster and side frames, lb/in.
const VARIABLE_PLAIN: f64 = 36_000.0;

/// Returns the same with an inclined column, 0.0034907 in/in out, without friction: the rise r = -s tan φ /
/// tan θ takes from the coil's stroke, and the column's normal force N = F cos θ / sin(θ + φ) pushes by -N
/// sin φ.
fn variable_with_toe() -> f64 {
    let (theta, phi) = (32.0_f64.to_radians(), 0.003_490_7_f64.atan());
    let stroke = 1.0 - phi.tan() / theta.tan();
    let force = 1.0 - theta.cos() * phi.sin() / (theta + phi).sin();
    24_000.0 + 12_000.0 * stroke * force
}

/// Returns the vibration whose motion is, by its energy, most of all in this coordinate of a body.
fn mode_of(system: &System, modes: &[Vibration], body: usize, coordinate: usize) -> Vibration {
    let share = |mode: &Vibration| {
        let mut all = 0.0;
        let mut own = 0.0;
        for (place, free) in system.bodies().iter().enumerate() {
            for k in (0..6).filter(|k| free.free[*k]) {
                let entry = mode.shape[system.position_of(place, k).unwrap()];
                let energy = if k < 3 { free.mass } else { free.inertia[k - 3] } * entry * entry;
                all += energy;
                if (place, k) == (body, coordinate) {
                    own += energy;
                }
            }
        }
        own / all
    };
    let best = modes.iter().max_by(|a, b| share(a).total_cmp(&share(b)));
    best.unwrap().clone()
}

/// Frequency of the body's motion in a coordinate, Hz, wedges sliding.
fn frequency(system: &mut System, x: &[f64], held: Held, coordinate: usize) -> f64 {
    let found = system.vibrations(0.0, x, held).unwrap();
    mode_of(system, &found.modes, BODY, coordinate).frequency
}

/// Returns a state at the drawn layout with the body a hair lower, so that springs with a change of stiffness
/// there are on their compression side.
fn compressed(system: &System) -> Vec<f64> {
    let mut x = system.initial_state();
    x[system.position_of(BODY, 2).unwrap()] = -1e-6;
    x
}

fn hertz(stiffness: f64) -> f64 {
    (stiffness / 319.175).sqrt() / (2.0 * std::f64::consts::PI)
}

/// Returns two springs one after the other.
fn series(a: f64, b: f64) -> f64 {
    a * b / (a + b)
}

#[test]
fn vertical_frequencies() {
    for (name, springs, free, driven) in [
        ("nucars_68_variable_toe_out", VARIABLE_PLAIN, 1.683, 15.52),
        // the inclined column takes 0.4 % of the stiffness
        ("nucars_69_variable_toe_out", variable_with_toe(), 1.680, 15.52),
        ("nucars_68_constant_toe_out", 52_000.0, 2.018, 15.56),
        ("nucars_69_constant_toe_out", 52_000.0, 2.018, 15.56),
    ] {
        let mut own = without_inputs(name);
        let x = compressed(&own);
        let found = frequency(&mut own, &x, Held::Surfaces, 2);
        // the side frames on their bearings, 4e6 lb/in, are in series
        let by_hand = hertz(series(springs, 4e6));
        println!("{name}: without inputs {found} Hz, by hand {by_hand}");
        assert!((found - by_hand).abs() < 2e-4 * by_hand, "{found} {by_hand}");
        assert!((found - free).abs() < 6e-4, "{name}: {found}");
        let mut own = system(name);
        let x = compressed(&own);
        let found = frequency(&mut own, &x, Held::Surfaces, 2);
        let by_hand = hertz(3e6 + series(springs, 4e6));
        println!("{name}: with inputs {found} Hz, by hand {by_hand}");
        assert!((found - by_hand).abs() < 2e-4 * by_hand, "{found} {by_hand}");
        assert!((found - driven).abs() < 6e-3, "{name}: {found}");
    }
}

/// Returns the system without its wedges.
fn without_wedges(name: &str) -> System {
    let mut model = case(name, 1.0).truck.model;
    model
        .connections
        .retain(|own| !matches!(own.law, mechanics::connection::Law::Wedge(_)));
    System::new(model).unwrap()
}

/// Surfaces stick as bristles, wedges slide (vertical and lateral) or are left out (longitudinal, yaw): a
/// sliding wedge of type 6.9 adds to the longitudinal stiffness, because its normal force goes with the gap,
/// by up to 0.7 % of the frequency of yaw.
#[test]
fn the_other_frequencies() {
    for (name, yaw, longitudinal) in [
        ("nucars_68_variable_toe_out", 4.13, 20.6),
        ("nucars_68_constant_toe_out", 4.13, 20.6),
        ("nucars_69_variable_toe_out", 3.11, 16.7),
        ("nucars_69_constant_toe_out", 3.11, 16.7),
    ] {
        let mut own = system(name);
        let x = compressed(&own);
        let mut bare = without_wedges(name);
        let sliding = [5, 1, 0, 4].map(|k| frequency(&mut own, &x, Held::Surfaces, k));
        let found = [5, 1, 0, 4].map(|k| frequency(&mut bare, &x, Held::Surfaces, k));
        let all = own.vibrations(0.0, &x, Held::Surfaces).unwrap();
        let list: Vec<f64> = all.modes.iter().map(|mode| mode.frequency).collect();
        println!(
            "{name}: yaw, lateral, longitudinal, pitch {found:.4?}, with sliding wedges {sliding:.4?}; \
             {list:.2?}"
        );
        let close = |k: usize, expected: f64, digit: f64| {
            assert!(
                (found[k] - expected).abs() <= digit,
                "{name}: {} {expected}",
                found[k]
            );
        };
        close(0, yaw, 0.005);
        close(2, longitudinal, 0.05);
        assert!((sliding[1] - 5.7).abs() < 0.05, "{name}: {sliding:?}");
        assert!((sliding[3] - 0.10).abs() < 0.005, "{name}: {sliding:?}");
        assert!((sliding[0] / found[0] - 1.0).abs() < 0.008, "{name}: {sliding:?}");
        // from roll of the side frames to their yaw
        assert!(
            list.iter()
                .any(|own| (own - 22.6).abs() < 0.05 || (own - 22.9).abs() < 0.05),
            "{list:?}"
        );
        assert!((list[17] - 302.0).abs() < 0.5, "{name}: {list:?}");
    }
}

/// Solves a system of linear equations, given row-major with its right-hand side.
fn solve(mut matrix: Vec<f64>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|i, j| matrix[i * n + k].abs().total_cmp(&matrix[j * n + k].abs()));
        let pivot = pivot.unwrap();
        for j in 0..n {
            matrix.swap(k * n + j, pivot * n + j);
        }
        b.swap(k, pivot);
        for i in (0..n).filter(|i| *i != k) {
            let factor = matrix[i * n + k] / matrix[k * n + k];
            for j in k..n {
                matrix[i * n + j] -= factor * matrix[k * n + j];
            }
            b[i] -= factor * b[k];
        }
    }
    (0..n).map(|i| b[i] / matrix[i * n + i]).collect()
}

/// Returns the body's yaw, rad, where 0.012 rad are commanded through 1e6 in-lb/rad: the linear system about
/// the drawn layout, without wedges (sliding ones of type 6.9 take another 2 %).
fn linear_yaw(name: &str, held: Held) -> f64 {
    let mut system = without_wedges(name);
    let x = compressed(&system);
    let stiffness = system.stiffness_matrix(0.0, &x, held);
    let yaw = system.position_of(BODY, 5).unwrap();
    let mut moments = vec![0.0; system.layout().speeds];
    moments[yaw] = 1e6 * POUND * INCH * 0.012;
    solve(stiffness, moments)[yaw]
}

/// Where side frames stick to their bearings, the stiff longitudinal connections of the 6.8 files (1e6 lb/in)
/// hold the bolster besides the input springs: 2.1e-6 rad; else, and with 6.9, the input springs alone: 0.012
/// / (2 * 39.5^2 + 1) = 3.8e-6 rad. The bearings carry little with variable damping, so that side frames slip
/// in a run, and the mean of its yaw lies between.
#[test]
fn the_printed_yaw_input_hardly_yaws() {
    for (wedges, damping, expected) in [
        ("68", "variable", 2.1e-6),
        ("68", "constant", 2.1e-6),
        ("69", "variable", 3.8e-6),
        ("69", "constant", 3.8e-6),
    ] {
        let name = format!("nucars_{wedges}_{damping}_toe_out_yaw_as_printed");
        let stuck = linear_yaw(&name, Held::Surfaces);
        let free = linear_yaw(&name, Held::Nothing);
        println!("{name}: {stuck:e}, side frames free {free:e}");
        assert!((stuck - expected).abs() < 0.06e-6, "{name}: {stuck:e}");
        let inputs = 0.012 / (2.0 * 39.5 * 39.5 + 1.0);
        assert!(
            free < inputs && free > 0.98 * inputs,
            "{name}: {free:e} {inputs:e}"
        );
        let result = result(&name, 10.0);
        let yaw = result.summary.yaw.as_ref().unwrap();
        println!("  in the run {yaw:?}");
        assert!((yaw.commanded.value - 0.012).abs() < 1e-12);
        let between = 0.96 * stuck..1.02 * inputs;
        assert!(
            between.contains(&yaw.reached.value),
            "{name}: {yaw:?}, {between:?}"
        );
        assert!(yaw.is_missed());
        let warnings = &result.summary.warnings;
        assert!(
            warnings.iter().any(|text| text.contains("yaw by 0.0120 rad")),
            "{warnings:?}"
        );
    }
}

/// Returns the body's yaw at rest without friction, with the commanded yaw held, rad.
fn yaw_at_rest(name: &str) -> f64 {
    let mut system = system(name);
    let x = system.initial_state();
    // Prescribed bodies are where the smooth piece around this time says.
    system.next_time_discontinuity(10.0);
    let held = system.equilibrium(10.0, &x, StaticFriction::Without).unwrap();
    held[system.position_of(BODY, 5).unwrap()]
}

/// The yaw as intended reaches its command but for the springs' share: 1e10 in-lb/rad against those of the
/// suspension.
#[test]
fn the_intended_yaw_is_reached() {
    for name in [
        "nucars_68_variable_toe_out_yaw",
        "nucars_68_constant_toe_out_yaw",
        "nucars_69_variable_toe_out_yaw",
        "nucars_69_constant_toe_out_yaw",
    ] {
        let found = yaw_at_rest(name);
        let result = result(name, 10.0);
        let yaw = result.summary.yaw.as_ref().unwrap();
        println!("{name}: {found}, in the run {}", yaw.reached.value);
        assert!((found - 0.012).abs() < 0.000_05, "{name}: {found}");
        assert!((yaw.reached.value - 0.012).abs() < 0.000_1, "{name}: {yaw:?}");
        assert!(!yaw.is_missed());
    }
}
