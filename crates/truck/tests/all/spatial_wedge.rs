//! The spatial wedge: a slope that is inclined across the truck too.

use crate::common;
use common::{INCH, POUND_FORCE, run};
use integrate::Method;
use mechanics::motion::{Motion, RampProfile};
use mechanics::system::StaticFriction;
use truck::{ControlCoil, Parameters, Spring, Truck};
use wedge::parameters::{Damping, Start};

const ACROSS: f64 = 8.0 * std::f64::consts::PI / 180.0;

/// Wedges without friction and side frames that are held; contacts so stiff that they hardly give.
fn held(damping: Damping, across: f64, coil: Spring) -> Parameters {
    let mut parameters = Parameters::new(damping).with_wedge_friction(0.0);
    for side_frame in &mut parameters.side_frames {
        side_frame.free = [false; 6];
    }
    for wedge in &mut parameters.wedges {
        wedge.slope_across = across;
        wedge.contact.stiffness *= 100.0;
        wedge.control_coil = ControlCoil::Shear(coil);
    }
    parameters
}

fn coil(shear_stiffness: f64) -> Spring {
    Spring {
        preload: 6303.0 * POUND_FORCE,
        stiffness: 1937.0 * POUND_FORCE / INCH,
        shear_stiffness: shear_stiffness * POUND_FORCE / INCH,
        damping: 1.0,
        solid: None,
    }
}

/// The nominal layout touches all along both faces, on both sides and at both ends.
#[test]
fn analytic_the_faces_touch_in_the_nominal_layout() {
    let mut truck = Truck::new(&held(Damping::Variable, ACROSS, coil(0.0))).unwrap();
    let x = truck.system.initial_state();
    let seen = truck.system.observe(0.0, &x);
    for face in &seen.faces[..8] {
        for point in &face.points {
            assert!(point.gap.abs() < 1e-15, "{}", point.gap);
        }
    }
}

/// Three planes carry the coil: N_s = F / (sin θ cos β), N_c = F cot θ, and the side of the pocket takes
/// N_s sin β = F tan β / sin θ, outboard on both sides.
#[test]
fn analytic_a_frictionless_wedge_presses_on_three_planes() {
    for across in [ACROSS, -ACROSS] {
        let mut parameters = held(Damping::Variable, across, coil(0.0));
        for wedge in &mut parameters.wedges {
            wedge.pocket_sides.clearance = 0.0;
        }
        let mut truck = Truck::new(&parameters).unwrap();
        let x = truck.system.initial_state();
        let rest = truck
            .system
            .equilibrium(0.0, &x, StaticFriction::Without)
            .unwrap();
        let seen = truck.system.observe(0.0, &rest);
        let loads = truck.loads(&seen);
        for (number, own) in loads.wedges.iter().enumerate() {
            let (wedge, way) = (
                &parameters.wedges[number],
                if number % 2 == 0 { 1.0 } else { -1.0 },
            );
            let (sine, cosine) = libm::sincos(wedge.angle);
            let preload = 6303.0 * POUND_FORCE;
            let stiffness = 1937.0 * POUND_FORCE / INCH;
            let force = preload - stiffness * own.displacement[2] - wedge.mass * parameters.gravity;
            let slope = force / (sine * libm::cos(across));
            let near = |found: f64, expected: f64| {
                assert!((found / expected - 1.0).abs() < 1e-4, "{found} {expected}");
            };
            near(own.slope_normal, slope);
            near(own.column_normal, force * cosine / sine);
            let thrust = force * libm::tan(across) / sine;
            near(own.displacement[1] * wedge.pocket_sides.stiffness, thrust * way);
        }
    }
}

/// A bolster that is moved aside by d: each wedge follows its slope, z = t (d - y), t = tan β / sin θ,
/// against the coil (k) and its shear (k_s): t² k k_s / (k_s + t² k) a wedge. The thrusts of left and right
/// cancel.
#[test]
fn analytic_mirrored_wedges_center_the_bolster() {
    let shear = 1317.0;
    for across in [ACROSS, -ACROSS] {
        let forces = [-0.05, 0.0, 0.05].map(|aside| {
            let mut parameters = held(Damping::Variable, across, coil(shear));
            for wedge in &mut parameters.wedges {
                wedge.pocket_sides.clearance = 5.0;
                // Wedges that do not turn: their points stay flush.
                wedge.free[3..].fill(false);
            }
            parameters.bolster.motion.coordinates[1] = Motion::Constant(aside * INCH);
            let mut truck = Truck::new(&parameters).unwrap();
            let x = truck.system.initial_state();
            let rest = truck
                .system
                .equilibrium(0.0, &x, StaticFriction::Without)
                .unwrap();
            let seen = truck.system.observe(0.0, &rest);
            let slopes = [1, 3, 5, 7].map(|face| {
                let forces = &seen.faces[face].normal_forces;
                -forces.iter().map(|force| force.0[1]).sum::<f64>()
            });
            // Left and right push the bolster inboard by the same.
            if aside == 0.0 {
                assert!(slopes[0] * across < 0.0);
            }
            slopes.iter().sum::<f64>()
        });
        let tangent = libm::tan(across) / libm::sin(32.0_f64.to_radians());
        let k = tangent * tangent * 1937.0;
        let expected = 4.0 * k * shear / (shear + k);
        let found = -(forces[2] - forces[0]) / 0.1 / POUND_FORCE;
        assert!(forces[1].abs() < 1e-6 * 6303.0 * POUND_FORCE, "{}", forces[1]);
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
    }
}

/// Normal forces of column and slope of a wedge that slides steadily on both with a friction of `mu`, and its
/// lateral speed over the bolster's, from the balance of its forces alone: bisection of the lateral speed.
fn sliding([theta, phi, across]: [f64; 3], mu: f64, force: f64, up: f64) -> [f64; 3] {
    let column = [phi.cos(), 0.0, -phi.sin()];
    let slope = [
        -theta.cos() * across.cos(),
        across.sin(),
        -theta.sin() * across.cos(),
    ];
    let unit = |v: [f64; 3]| {
        let size = v.iter().map(|part| part * part).sum::<f64>().sqrt();
        v.map(|part| part / size)
    };
    let balance = |aside: f64| {
        // n_c·v = 0 and n_s·(v - v_b) = 0 for v = (x, aside, z).
        let right = slope[2] * up - slope[1] * aside;
        let determinant = column[0] * slope[2] - column[2] * slope[0];
        let (x, z) = (-column[2] * right / determinant, column[0] * right / determinant);
        let [on_column, on_slope] = [unit([x, aside, z]), unit([x, aside, z - up])];
        let [c, s] = [(column, on_column), (slope, on_slope)]
            .map(|(normal, slip)| [0, 1, 2].map(|k| normal[k] - mu * slip[k]));
        let determinant = c[0] * s[2] - c[2] * s[0];
        let (n_c, n_s) = (force * s[0] / determinant, -force * c[0] / determinant);
        ([n_c, n_s, aside / up.abs()], n_c * c[1] + n_s * s[1])
    };
    let (mut low, mut high) = (0.0, 20.0 * up.abs());
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        // Pushed outboard faster than friction holds.
        if balance(middle).1 > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    balance(low).0
}

/// A wedge that slides slowly on both faces, with toe out, and is free across.
#[test]
fn limits_slow_sliding_is_the_balance_of_forces_with_friction() {
    let (toe, mu) = (4.0_f64.to_radians(), 0.3);
    for up in [1.0, -1.0] {
        let speed = 0.2 * INCH * up;
        let mut parameters = held(
            Damping::Constant,
            ACROSS,
            Spring {
                stiffness: 1.0,
                damping: 0.0,
                ..coil(0.0)
            },
        )
        .with_wedge_friction(mu);
        parameters.start = Start::Touching;
        for wedge in &mut parameters.wedges {
            wedge.toe = toe;
            wedge.pocket_sides.clearance = 5.0;
            wedge.free[3..].fill(false);
        }
        parameters.bolster.motion.coordinates[2] = Motion::Ramp {
            amplitude: speed,
            start: 0.0,
            duration: 1.0,
            profile: RampProfile::Linear,
        };
        let ran = run(&parameters, 0.9, Method::default(), 1e-7);
        let wedge = &parameters.wedges[2];
        let force = 6303.0 * POUND_FORCE - wedge.mass * parameters.gravity;
        let [n_c, n_s, aside] = sliding([wedge.angle, toe, ACROSS], mu, force, speed);
        let [before, after] = [ran.loads[35].wedges, ran.loads[45].wedges];
        for number in 0..4 {
            let (own, way) = (after[number], if number % 2 == 0 { 1.0 } else { -1.0 });
            let moved = own.displacement[1] - before[number].displacement[1];
            for (found, expected) in [
                (own.column_normal, n_c),
                (own.slope_normal, n_s),
                (moved * way / (0.2 * speed.abs()), aside),
            ] {
                assert!(
                    (found / expected - 1.0).abs() < 2e-3,
                    "up {up}, {number}: {found} {expected}"
                );
            }
        }
        assert!(ran.residual < 1e-5, "{}", ran.residual);
    }
}
