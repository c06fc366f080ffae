//! The split wedge: two halves beside each other, each a body.

use crate::common;
use common::{INCH, POUND_FORCE, at, run};
use integrate::Method;
use mechanics::motion::Motion;
use mechanics::system::StaticFriction;
use truck::{CarBody, ControlCoil, Lading, Loads, Parameters, SideBearings, Spring, Truck, WedgeKind};
use wedge::parameters::Damping;

const ACROSS: f64 = 8.0 * std::f64::consts::PI / 180.0;
const INNER: f64 = 15.0 * std::f64::consts::PI / 180.0;

/// Returns a truck whose wedges are split.
fn split(damping: Damping, across: f64, inner: f64) -> Parameters {
    let mut parameters = Parameters::new(damping);
    for wedge in &mut parameters.wedges {
        wedge.kind = WedgeKind::Split;
        wedge.slope_across = across;
        wedge.split.angle = inner;
    }
    parameters
}

/// Returns the same without friction, its side frames held, in pockets without play, on faces that hardly
/// give.
fn frictionless(across: f64, inner: f64, share: f64) -> Parameters {
    let mut parameters = split(Damping::Variable, across, inner).with_wedge_friction(0.0);
    for side_frame in &mut parameters.side_frames {
        side_frame.free = [false; 6];
    }
    for wedge in &mut parameters.wedges {
        wedge.contact.stiffness *= 100.0;
        wedge.pocket_sides.clearance = 0.0;
        wedge.pocket_sides.stiffness *= 100.0;
        wedge.split.friction.coefficient = 0.0;
        wedge.split.outboard_share = share;
        // Halves that do not turn: what they bear does not hang on where.
        wedge.free[3..].fill(false);
        if let ControlCoil::Shear(coil) = &mut wedge.control_coil {
            *coil = Spring {
                shear_stiffness: 0.0,
                solid: None,
                ..*coil
            };
        }
    }
    parameters
}

fn at_rest(parameters: &Parameters) -> Loads {
    let mut truck = Truck::new(parameters).unwrap();
    let x = truck.system.initial_state();
    let rest = truck
        .system
        .equilibrium(0.0, &x, StaticFriction::Without)
        .unwrap();
    let seen = truck.system.observe(0.0, &rest);
    truck.loads(&seen)
}

/// Returns the force of a half's part of the coil less its weight, N.
fn carried(parameters: &Parameters, half: usize, z: f64) -> f64 {
    let wedge = &parameters.wedges[0];
    let share = [wedge.split.outboard_share, 1.0 - wedge.split.outboard_share][half];
    let coil = 0.5 * (6303.0 * POUND_FORCE - 1937.0 * POUND_FORCE / INCH * z);
    coil - share * wedge.mass * parameters.gravity
}

fn near(what: &str, found: f64, expected: f64) {
    assert!(
        (found / expected - 1.0).abs() < 1e-4,
        "{what}: {found}, {expected} expected"
    );
}

/// All faces touch in the nominal layout, whatever their angles, on both sides and at both ends, with a car
/// body and without.
#[test]
fn analytic_halves_touch_in_the_nominal_layout() {
    for with_car in [false, true] {
        for inner in [INNER, 0.0, -INNER] {
            let mut parameters = split(Damping::Variable, ACROSS, inner);
            if with_car {
                parameters.car_body = Some(CarBody::new(Lading::Loaded, SideBearings::rollers()));
                parameters.bolster.free = [false, false, true, false, false, false];
            }
            let mut truck = Truck::new(&parameters).unwrap();
            let x = truck.system.initial_state();
            let seen = truck.system.observe(0.0, &x);
            for face in &seen.faces[..20] {
                for point in &face.points {
                    assert!(point.gap.abs() < 1e-15, "{}", point.gap);
                }
            }
            let bodies = truck.system.bodies();
            let wedges = bodies.iter().filter(|body| body.name.contains("board"));
            let mass: f64 = wedges.map(|body| body.mass).sum();
            near("mass", mass, parameters.wedge_mass());
        }
    }
}

/// Pressed apart, each half bears on three planes: N_s = F / (sin θ cos β), N_c = F cot θ, and the side of
/// the pocket has F tan β / sin θ; nothing goes over between them.
#[test]
fn analytic_halves_that_are_pressed_apart_bear_on_the_sides_of_the_pocket() {
    let parameters = frictionless(ACROSS, 0.0, 0.6);
    let loads = at_rest(&parameters);
    for (number, own) in loads.wedges.iter().enumerate() {
        let wedge = &parameters.wedges[number];
        let left = if number % 2 == 0 { 1.0 } else { -1.0 };
        let (sine, cosine) = libm::sincos(wedge.angle);
        assert_eq!(own.split_normal, 0.0);
        for (half, way) in [(0, left), (1, -left)] {
            let seen = &own.halves[half];
            let force = carried(&parameters, half, seen.displacement[2]);
            near("slope", seen.slope_normal, force / (sine * ACROSS.cos()));
            near("column", seen.column_normal, force * cosine / sine);
            let side = seen.displacement[1] * way * wedge.pocket_sides.stiffness;
            near("side", side, force * ACROSS.tan() / sine);
        }
    }
}

/// Pressed together, with an outboard half that leans over the inboard one: N_i cos γ = N_o sin β across,
/// N_o (sin θ cos β - sin β tan γ) = F upwards, and N_i sin γ less on the slope of the inboard half, whose
/// side of the pocket takes the rest.
#[test]
fn analytic_the_plane_between_the_halves_carries_load_over() {
    for share in [0.5, 0.7] {
        let parameters = frictionless(-ACROSS, INNER, share);
        let loads = at_rest(&parameters);
        for (number, own) in loads.wedges.iter().enumerate() {
            let wedge = &parameters.wedges[number];
            let left = if number % 2 == 0 { 1.0 } else { -1.0 };
            let sine = libm::sin(wedge.angle);
            let [outboard, inboard] = &own.halves;
            let upper = carried(&parameters, 0, outboard.displacement[2]);
            let lower = carried(&parameters, 1, inboard.displacement[2]);
            let slope = upper / (sine * ACROSS.cos() - ACROSS.sin() * INNER.tan());
            let between = slope * ACROSS.sin() / INNER.cos();
            near("outboard slope", outboard.slope_normal, slope);
            near("between", own.split_normal, between);
            let under = (lower - between * INNER.sin()) / (sine * ACROSS.cos());
            near("inboard slope", inboard.slope_normal, under);
            let side = -inboard.displacement[1] * left * wedge.pocket_sides.stiffness;
            near("side", side, between * INNER.cos() - under * ACROSS.sin());
        }
    }
}

/// A wedge in one piece between two planes, up and down: halves without angles do the same side by side,
/// whatever the friction between them.
#[test]
fn limits_halves_without_angles_are_a_wedge_in_one_piece() {
    for damping in [Damping::Constant, Damping::Variable] {
        let rig = |mut parameters: Parameters| {
            for wedge in &mut parameters.wedges {
                wedge.toe = 0.5_f64.to_radians();
                wedge.split.friction.coefficient = 5.0;
            }
            parameters.bolster.motion.coordinates[2] = Motion::Sine {
                amplitude: 0.5 * INCH,
                angular_frequency: 4.0,
                phase: 0.0,
            };
            run(&parameters, 1.6, Method::default(), 1e-8)
        };
        let whole = rig(Parameters::new(damping));
        let halves = rig(split(damping, 0.0, 0.0));
        let scale = 10_000.0 * POUND_FORCE;
        for time in [0.2, 0.4, 0.8, 1.2, 1.5] {
            for (a, b) in at(&whole, time).wedges.iter().zip(&at(&halves, time).wedges) {
                for (a, b) in [
                    (a.column_normal, b.column_normal),
                    (a.slope_normal, b.slope_normal),
                    (a.column_friction_z, b.column_friction_z),
                ] {
                    assert!((a - b).abs() < 1e-4 * scale, "{damping:?} {time} s: {a} {b}");
                }
                assert!((a.displacement[2] - b.displacement[2]).abs() < 1e-5 * INCH);
            }
        }
        assert!(halves.residual < 1e-5, "{}", halves.residual);
    }
}

/// Halves that rub on each other while the truck warps: the ledger has their losses.
#[test]
fn energy_of_halves_in_warp_is_accounted_for() {
    for (across, inner) in [(ACROSS, 0.0), (-ACROSS, INNER), (0.0, INNER)] {
        let mut parameters = split(Damping::Constant, across, inner);
        parameters.wheelsets = None;
        for side_frame in &mut parameters.side_frames {
            side_frame.free = [false; 6];
            side_frame.motion.coordinates[5] = Motion::Sine {
                amplitude: 0.01,
                angular_frequency: 6.0,
                phase: 0.0,
            };
        }
        let ran = run(&parameters, 1.2, Method::default(), 1e-6);
        assert!(ran.residual < 1e-5, "{across} {inner}: {}", ran.residual);
    }
}
