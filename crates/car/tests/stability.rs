//! Stability of cars on linear wheels, and kinematics of trucks that steer themselves.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod common;

use std::f64::consts::TAU;

use car::{FrictionState, Mode, Parameters, SteadyCar, Wheels};
use common::{INCH, MPH, POUND_FORCE, empty, loaded, tangent};
use truck::{Adapter, Spring};
use wedge::parameters::Damping;
use wheelrail::conicity::LinearGeometry;
use wheelrail::contact::{CreepCoefficients, LinearWheelset};

/// Half the distance of the contacts and radius of the wheels, m.
const HALF: f64 = 29.75 * INCH;
const RADIUS: f64 = 18.0 * INCH;
/// Stiffness of a nest across, N/m.
const NEST: f64 = 17_800.0 * POUND_FORCE / INCH;

/// Returns the empty car of the benchmark on linear wheels that do not roll about x, with a warp stiffness
/// (N·m/rad); `harder` multiplies the shear stiffness of its coils.
fn reduced(conicity: f64, warp: f64, harder: f64) -> Parameters {
    let mut parameters = empty(tangent(300.0), 10.0);
    parameters.support = None;
    let axle_load = parameters.weight() / 4.0;
    parameters.wheels = Wheels::Linear {
        wheelset: LinearWheelset {
            geometry: LinearGeometry {
                roll_coefficient: 0.0,
                ..LinearGeometry::of_cones(conicity, HALF, RADIUS)
            },
            creep: CreepCoefficients {
                f11: 6.69e6,
                f22: 6.21e6,
                f23: 0.0,
                f33: 0.0,
            },
            spin: false,
            axle_load,
        },
        support: [1e9, 1e9],
    };
    for coil in parameters
        .trucks
        .iter_mut()
        .flat_map(|own| own.load_coils.iter_mut().flatten())
    {
        coil.spring = Spring {
            preload: 11_515.0 * POUND_FORCE / 4.0,
            stiffness: 6468.7 * POUND_FORCE / INCH,
            shear_stiffness: harder * NEST / 4.0,
            damping: 0.0,
            solid: None,
        };
    }
    parameters.tied(warp).unwrap()
}

/// 65, 45 and 32 mph at conicities of 0.05, 0.1 and 0.2 with 17 kip·in/mrad of warp stiffness: from a
/// separate linear model with nine coordinates.
#[test]
fn reproduction_critical_speeds_of_the_empty_car() {
    let warp = 17e6 * POUND_FORCE * INCH;
    for (conicity, expected) in [(0.05, 65.0), (0.1, 45.0), (0.2, 32.0)] {
        let mut car = SteadyCar::new(&reduced(conicity, warp, 1.0)).unwrap();
        let range = [0.8 * expected * MPH, 1.25 * expected * MPH];
        let found = car.critical_speed(range, FrictionState::Stuck).unwrap().unwrap();
        let speed = found.speed / MPH;
        println!("{conicity}: {speed} mph, {} Hz", found.frequency);
        assert!(
            (speed / expected - 1.0).abs() < 0.03,
            "{conicity}: {speed} mph, {expected} expected"
        );
    }
}

/// Vibrations with a frequency (Hz) near this one.
fn near(modes: &[Mode], frequency: f64, within: f64) -> Vec<Mode> {
    let own = modes
        .iter()
        .filter(|mode| (mode.frequency / frequency - 1.0).abs() < within);
    own.copied().collect()
}

/// Wheelsets of trucks that warp freely run like single ones, with the wavelength of Klingel; those of a
/// rigid truck with `√(1 + f22 b²/(f11 l²))` times it, b being half the wheelbase.
#[test]
fn analytic_wavelengths_of_trucks_that_warp_and_of_rigid_ones() {
    let speed = 2.0;
    for (rigid, factor) in [
        (false, 1.0),
        (true, (1.0_f64 + 6.21 / 6.69 * (35.0_f64 / 29.75).powi(2)).sqrt()),
    ] {
        let mut parameters = if rigid {
            reduced(0.05, 5e8, 1e2)
        } else {
            reduced(0.05, 1.0, 1.0)
        };
        if let Wheels::Linear { wheelset, .. } = &mut parameters.wheels {
            wheelset.axle_load = 0.0;
        }
        let modes = parameters.modes(speed, FrictionState::Stuck).unwrap();
        let wavelength = TAU * (RADIUS * HALF / 0.05).sqrt() * factor;
        let found = near(&modes, speed / wavelength, 0.01);
        assert!(
            found.len() >= 2,
            "{wavelength} m expected of {:?}",
            near(&modes, speed / wavelength, 0.6)
        );
        for mode in found {
            assert!(mode.growth.abs() < 0.02, "{mode:?}");
        }
    }
}

/// With plates and adapters that hold, on wheels that creep holds: bounce and upper sway are those of the
/// car on fixed side frames (2.027 and 2.996 Hz), the lower sway that with the give of the center plates
/// (0.762 Hz).
#[test]
fn analytic_frequencies_of_the_loaded_car_on_its_wheels() {
    let mut parameters = reduced(0.05, 1.0, 1.0);
    let whole = loaded(tangent(300.0), 2.0);
    (parameters.lading, parameters.body) = (whole.lading.clone(), whole.body);
    for (own, usual) in parameters.trucks.iter_mut().zip(&whole.trucks) {
        own.load_coils = truck::Parameters::new(Damping::Constant).load_coils;
        for coil in own.load_coils.iter_mut().flatten() {
            coil.spring.solid = None;
        }
        own.car_body = usual.car_body.clone();
        if let Some(wheelsets) = &mut own.wheelsets
            && let Adapter::Pad(pad) = &mut wheelsets.adapter
        {
            pad.preload = 31_382.0 * POUND_FORCE;
        }
    }
    if let Wheels::Linear { wheelset, support } = &mut parameters.wheels {
        (wheelset.creep.f11, wheelset.creep.f22, wheelset.axle_load) = (17.4e6, 16.2e6, 0.0);
        *support = [1e11, 1e11];
    }
    let modes = parameters.modes(0.5, FrictionState::Stuck).unwrap();
    for (name, frequency, within) in [
        ("bounce", 2.027, 0.01),
        ("lower sway", 0.762, 0.02),
        ("upper sway", 2.996, 0.03),
    ] {
        let found = near(&modes, frequency, within);
        let slow: Vec<f64> = modes
            .iter()
            .map(|mode| mode.frequency)
            .filter(|own| (0.3..5.0).contains(own))
            .collect();
        assert!(!found.is_empty(), "{name}: {frequency} Hz expected of {slow:?}");
    }
}

/// Returns the loaded car at 40 mph on linear wheels of conicity 0.1 without spin, with f11 = 2e6 and f22 =
/// 1.8e6 lbf a wheel times a factor.
fn on_linear_wheels(factor: f64) -> Parameters {
    let mut parameters = loaded(tangent(300.0), 40.0 * MPH);
    parameters.support = None;
    parameters.wheels = Wheels::Linear {
        wheelset: LinearWheelset {
            geometry: LinearGeometry {
                conicity: 0.1,
                contact_angle: 0.05,
                contact_angle_rate: 0.0,
                roll_coefficient: 0.0,
                half_distance: HALF,
                radius: RADIUS,
            },
            creep: CreepCoefficients {
                f11: 2e6 * POUND_FORCE * factor,
                f22: 1.8e6 * POUND_FORCE * factor,
                f23: 0.0,
                f33: 0.0,
            },
            spin: false,
            axle_load: parameters.weight() / 4.0,
        },
        support: [1e9, 1e9 * HALF * HALF],
    };
    // The separate model has wedges on their corners and softer adapters.
    let flat = truck::Parameters::new(Damping::Variable).wedges;
    for own in &mut parameters.trucks {
        own.wedges = flat.clone();
        let wheelsets = own.wheelsets.as_mut().unwrap();
        let Adapter::Friction(adapter) = &mut wheelsets.adapter else {
            unreachable!("built-in adapters have friction");
        };
        adapter.contact.stiffness = 5e5 * POUND_FORCE / INCH;
    }
    parameters
}

/// Growth (1/s) and frequency (Hz) of a separate linear model of the loaded car: 19 bodies as springs,
/// dampers and masses in lbf, in, s, linearized by automatic differentiation about its frictionless
/// equilibrium, its modes by the eigenvalues of `(M, C, K)`. With friction stuck the wheels' creep makes
/// 2.289 of the 2.342 1/s of the upper sway (2.459 Hz), so that twice the coefficients nearly halve its
/// damping.
#[test]
fn issue_047_stuck_vibrations_are_those_of_a_separate_linear_model() {
    for (factor, expected) in [
        (
            1.0,
            &[
                [-1.84184, 9.45667],
                [-2.34207, 2.45858],
                [-2.68410, 0.33199],
                [-4.09742, 14.10106],
                [-9.85570, 0.27199],
            ][..],
        ),
        (
            2.0,
            &[
                [-1.23743, 2.40902],
                [-1.84184, 9.45667],
                [-3.26327, 0.68721],
                [-4.09371, 14.10111],
                [-4.92903, 0.59584],
            ],
        ),
    ] {
        let modes = on_linear_wheels(factor)
            .modes(40.0 * MPH, FrictionState::Stuck)
            .unwrap();
        let found = modes.iter().filter(|mode| (0.05..30.0).contains(&mode.frequency));
        for (mode, [growth, frequency]) in found.zip(expected) {
            assert!(
                (mode.growth / growth - 1.0).abs() < 1e-3 && (mode.frequency / frequency - 1.0).abs() < 1e-3,
                "factor {factor}: {mode:?}, {growth} /s and {frequency} Hz expected"
            );
        }
    }
}
