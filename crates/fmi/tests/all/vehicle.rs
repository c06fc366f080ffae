//! A vehicle of bodies and elements behind the variables: its motions by the case and by inputs.

use std::path::Path;

use fmi::description::{Description, Version};
use fmi::element::Interface;
use fmi::instance::Instance;
use fmi::source::Source;
use study::run::Run;
use study::vehicle::VehicleCase;

const INTERVAL: f64 = 0.01;
const NAMES: [&str; 3] = ["frame_z", "leading_force", "trailing_compression"];

fn case() -> VehicleCase {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/own_vehicle.toml");
    let set = ["simulation.duration=1 s", "simulation.relative_tolerance=1e-8"].map(str::to_owned);
    VehicleCase::read(&path, &set).unwrap()
}

/// Co-simulation gives the columns of the run: with the rail moved by the case, and by inputs that are the
/// same sine.
#[test]
fn cross_code_a_vehicle_moves_as_its_run() {
    let result = Run::new(&case()).unwrap().finish(|_| ());
    for by_inputs in [false, true] {
        let source = Source::Vehicle(Box::new(case()));
        let description = Description::new(&source).unwrap();
        let mut instance =
            Instance::of("vehicle", None, source, Version::Three, Interface::CoSimulation).unwrap();
        let reference = |name: &str| {
            let mut all = description.variables.iter();
            all.find(|own| own.name == name)
                .unwrap_or_else(|| panic!("there is no variable {name}"))
                .reference
        };
        instance
            .set_integer(reference("motion"), i32::from(!by_inputs))
            .unwrap();
        let omega = 4.0 * std::f64::consts::PI;
        let rail = |time: f64| {
            [
                0.1 * 0.0254 * (omega * time).sin(),
                0.1 * 0.0254 * omega * (omega * time).cos(),
            ]
        };
        let moved = ["rail_z_motion", "rail_z_motion_rate"].map(reference);
        if by_inputs {
            for (own, value) in moved.iter().zip(rail(0.0)) {
                instance.set_float(*own, value).unwrap();
            }
            instance.set_boolean(reference("inputs_at_end"), true).unwrap();
        }
        instance.enter_initialization().unwrap();
        instance.exit_initialization().unwrap();
        let mut worst = [0.0_f64; 3];
        for row in 0..result.rows() {
            if row > 0 {
                if by_inputs {
                    for (own, value) in moved.iter().zip(rail(instance.time() + INTERVAL)) {
                        instance.set_float(*own, value).unwrap();
                    }
                }
                instance.do_step(instance.time(), INTERVAL).unwrap();
            }
            for (name, worst) in NAMES.iter().zip(&mut worst) {
                let own = instance.get_float(reference(name)).unwrap();
                *worst = worst.max((own - result.column(name).unwrap()[row]).abs());
            }
        }
        for (name, worst) in NAMES.iter().zip(worst) {
            let size = result
                .column(name)
                .unwrap()
                .iter()
                .fold(0.0, |most: f64, own| most.max(own.abs()));
            // Cubics between communication points follow a sine to 1e-6.
            assert!(size > 0.0 && worst < 2e-5 * size, "{name}: {worst:e} of {size:e}");
        }
    }
}
