//! analytic: statics and frequencies of the truck.

use crate::common;
use common::{INCH, POUND_FORCE};
use mechanics::system::{Held, StaticFriction};
use truck::{BOLSTER, Bolster, Lading, Parameters, Truck};
use wedge::parameters::Damping;

/// Returns a truck without friction under its half car.
fn half_car(damping: Damping) -> Parameters {
    Parameters {
        bolster: Bolster::with_half_car(Lading::Loaded),
        ..Parameters::new(damping).with_wedge_friction(0.0)
    }
}

/// Half of what a nest of a 263,000 lbf car carries: the sum of its coils' static loads, within 1 lbf.
#[test]
fn analytic_nests_and_adapters_carry_the_car_in_the_nominal_layout() {
    for damping in [Damping::Constant, Damping::Variable] {
        let mut truck = Truck::new(&Parameters::new(damping)).unwrap();
        let x = truck.system.initial_state();
        let observation = truck.system.observe(0.0, &x);
        let loads = truck.loads(&observation);
        for nest in loads.nest_vertical {
            assert!(
                (nest / POUND_FORCE - 61_615.0).abs() < 1.0,
                "{}",
                nest / POUND_FORCE
            );
        }
        for adapter in &observation.faces[8..] {
            let load: f64 = adapter.points.iter().map(|point| point.normal).sum();
            assert!(
                (load / POUND_FORCE - 31_382.0).abs() < 0.1,
                "{}",
                load / POUND_FORCE
            );
        }
        assert_eq!(loads.warp_angle, 0.0);
        assert!(loads.warp_moment.total().abs() < 1e-6);
    }
}

/// Without friction the half car rests where coils and adapters carry the weights. With constant damping the
/// wedges' forces are internal to bolster and wedges, so that the height has a closed form: coils and
/// adapters less the weights on them, over their stiffnesses. With variable damping the control coils stand
/// on the side frames and the faces give way: 0.0058 in, from a calculation in another program.
#[test]
fn analytic_the_frictionless_equilibrium_lies_at_the_nominal_height() {
    let on_coils = (8.0 * 15_403.8 - 123_230.0) / (8.0 * 6468.7);
    let on_adapters = (8.0 * 15_691.0 - 123_230.0 - 2.0 * 1150.5) / (8.0 * 5e5);
    let constant = on_coils + on_adapters;
    for (damping, expected, margin) in [
        (Damping::Constant, constant, 1e-9),
        (Damping::Variable, -0.0058, 5e-5),
    ] {
        let mut truck = Truck::new(&half_car(damping)).unwrap();
        let x = truck.system.initial_state();
        let rest = truck
            .system
            .equilibrium(0.0, &x, StaticFriction::Without)
            .unwrap();
        let z = rest[truck.system.position_of(BOLSTER, 2).unwrap()] / INCH;
        assert!(
            (z - expected).abs() < margin,
            "{damping:?}: {z} in, {expected} expected"
        );
    }
}

/// One truck under its half car, adapters in series, friction off: 2.014 Hz of bounce (constant damping),
/// from a separate calculation.
#[test]
fn analytic_bounce_of_a_truck_under_its_half_car() {
    let mut truck = Truck::new(&half_car(Damping::Constant)).unwrap();
    let x = truck.system.initial_state();
    let rest = truck
        .system
        .equilibrium(0.0, &x, StaticFriction::Without)
        .unwrap();
    let z = truck.system.position_of(BOLSTER, 2).unwrap();
    let modes = truck.system.vibrations(0.0, &rest, Held::Nothing).unwrap().modes;
    let share = |mode: &mechanics::system::Vibration| mode.shape[z].abs();
    let bounce = modes
        .iter()
        .filter(|mode| mode.frequency > 0.5)
        .max_by(|a, b| share(a).total_cmp(&share(b)))
        .unwrap();
    assert!(
        (bounce.frequency / 2.014 - 1.0).abs() < 2e-3,
        "{} Hz",
        bounce.frequency
    );
}
