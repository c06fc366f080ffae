//! Center plate and side bearings: statics, turning moment, moment in roll.

use crate::common;
use common::{INCH, KIP_INCH, POUND_FORCE, Ran, run};
use integrate::{Method, Problem};
use mechanics::motion::{Motion, RampProfile};
use truck::{CAR_BODY, CarBody, Lading, Parameters, SideBearings, Truck};
use wedge::parameters::Damping;

fn parameters(side_bearings: SideBearings) -> Parameters {
    Parameters {
        car_body: Some(CarBody::new(Lading::Loaded, side_bearings)),
        ..Parameters::new(Damping::Variable)
    }
}

/// Half a loaded body weighs 121,730 lbf; constant-contact side bearings take 6,000 lbf each of it.
#[test]
fn analytic_plate_and_side_bearings_carry_the_body() {
    for (bearings, load) in [
        (SideBearings::rollers(), 121_730.0),
        (SideBearings::constant_contact(), 109_730.0),
    ] {
        let mut truck = Truck::new(&parameters(bearings)).unwrap();
        let x = truck.system.initial_state();
        let observation = truck.system.observe(0.0, &x);
        let plate = truck.loads(&observation).center_plate;
        assert!(
            (plate.load / POUND_FORCE - load).abs() < 1e-3,
            "{}",
            plate.load / POUND_FORCE
        );
        let mut dx = vec![0.0; x.len()];
        truck.system.derivative(0.0, &x, &mut dx);
        let z = truck.system.position_of(CAR_BODY, 2).unwrap();
        assert!(dx[truck.system.layout().speeds + z].abs() < 1e-9);
    }
}

/// Returns a truck whose bolster turns or rolls (coordinate 5 or 3) by `angle` (rad) within a second.
fn turned(coordinate: usize, angle: f64, bearings: SideBearings, free: [bool; 6]) -> Ran {
    let mut parameters = parameters(bearings);
    parameters.bolster.motion.coordinates[coordinate] = Motion::Ramp {
        amplitude: angle,
        start: 0.1,
        duration: 1.0,
        profile: RampProfile::HalfCosine,
    };
    if let Some(car) = &mut parameters.car_body {
        car.free = free;
    }
    run(&parameters, 1.5, Method::Rodas5P, 1e-6)
}

/// A plate that turns under a body is braked by (2/3) μ W R: 113.6 kip·in with a friction of 0.2 and a radius
/// of 7 in. Constant-contact side bearings add 2 P μ 25 in and take 2 P from the plate.
#[test]
fn analytic_turning_moment_of_a_loaded_plate() {
    let free = [false, false, true, true, false, false];
    for (bearings, load) in [
        (SideBearings::rollers(), 121.730),
        (SideBearings::constant_contact(), 109.730),
    ] {
        let ran = turned(5, 0.02, bearings, free);
        // In the middle of the turn all points slip.
        let moment = ran.loads[30].center_plate.moment[2] / KIP_INCH;
        let expected = -2.0 / 3.0 * 0.2 * load * 7.0;
        assert!(
            (moment / expected - 1.0).abs() < 2e-3,
            "{moment} kip·in, {expected} expected"
        );
        assert!(ran.residual < 1e-5, "residual {}", ran.residual);
    }
}

/// At 10 mrad of roll between body and bolster the plate stands on its edge: it carries at least 85 % of W R
/// as moment, and no more than W R.
#[test]
fn limits_a_rolled_plate_stands_on_its_edge() {
    let free = [false, false, true, false, false, false];
    let ran = turned(3, 0.010, SideBearings::rollers(), free);
    let plate = ran.loads.last().unwrap().center_plate;
    let most = plate.load * 7.0 * INCH;
    let moment = plate.moment[0].abs();
    assert!(moment > 0.85 * most && moment <= most, "{} of W R", moment / most);
    assert!(
        (plate.load / POUND_FORCE / 121_730.0 - 1.0).abs() < 0.02,
        "{}",
        plate.load / POUND_FORCE
    );
}
