//! Stability of cars on linear wheels, and kinematics of trucks that steer themselves.

use crate::common;
use std::f64::consts::TAU;

use car::{FrictionState, Mode, Neutral, OverAmplitude, Parameters, SteadyCar, Wheels};
use common::{INCH, MPH, POUND_FORCE, empty, loaded, tangent, with_hysteresis};
use mechanics::linear::{LinearMode, SecondOrder, SliderPlace};
use nalgebra::DMatrix;
use truck::{Adapter, Hysteresis, SideBearing, Spring};
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

/// Returns the critical speed (m/s) of nine coordinates: lateral displacement, roll and yaw of the body with
/// its bolsters, and of each truck lateral displacement, yaw of the side frames and yaw of the axles with the
/// bolster. Side frames and axles are a parallelogram with a warp spring; the nests' shear is between truck
/// and bolster. Where the body is held the first three are none.
fn nine_coordinates(conicity: f64, warp: f64, held: bool) -> f64 {
    let car = empty(tangent(300.0), 10.0);
    let truck = &car.trucks[0];
    let [nest, base] = [truck.geometry.nest(), truck.geometry.axle()];
    let [f11, f22] = [6.69e6, 6.21e6];
    let weight = car.weight() / 4.0;
    let side_frame = &truck.side_frames[0].body;
    let bolster = &truck.bolster.body;
    let plate = truck.car_body.as_ref().unwrap().center_plate.height;
    let half = 0.5 * car.truck_distance;
    // From the center of gravity of the body down to the bolsters.
    let [above, arm] = [bolster.height, plate].map(|height| car.body.height - height);
    let n = 9;
    let mut system = SecondOrder {
        mass: DMatrix::zeros(n, n),
        stiffness: DMatrix::zeros(n, n),
        damping: DMatrix::zeros(n, n),
    };
    let quadratic = |matrix: &mut DMatrix<f64>, factor: f64, row: &[(usize, f64)]| {
        for (i, a) in row {
            for (j, b) in row {
                matrix[(*i, *j)] += factor * a * b;
            }
        }
    };
    let (y, roll, yaw) = (0, 1, 2);
    quadratic(&mut system.mass, car.body.mass, &[(y, 1.0)]);
    quadratic(
        &mut system.mass,
        car.body.inertia[0] + 2.0 * bolster.inertia[0],
        &[(roll, 1.0)],
    );
    quadratic(&mut system.mass, car.body.inertia[2], &[(yaw, 1.0)]);
    // All nests carry the roll.
    let vertical = 16.0 * 5369.5 * POUND_FORCE / INCH;
    quadratic(&mut system.stiffness, -vertical * nest * nest, &[(roll, 1.0)]);
    let carried = (car.body.mass + 2.0 * bolster.mass) * car.gravity;
    quadratic(&mut system.stiffness, carried * arm, &[(roll, 1.0)]);
    for (t, side) in [1.0, -1.0].into_iter().enumerate() {
        let (own, frames, axles) = (3 + 3 * t, 4 + 3 * t, 5 + 3 * t);
        quadratic(
            &mut system.mass,
            bolster.mass,
            &[(y, 1.0), (yaw, side * half), (roll, above)],
        );
        quadratic(&mut system.mass, 2.0 * side_frame.mass, &[(own, 1.0)]);
        quadratic(&mut system.mass, 2.0 * side_frame.inertia[2], &[(frames, 1.0)]);
        let turning = bolster.inertia[2] + 2.0 * side_frame.mass * nest * nest;
        quadratic(
            &mut system.mass,
            turning + 2.0 * car.wheelset.about_diameter,
            &[(axles, 1.0)],
        );
        quadratic(&mut system.stiffness, -warp, &[(frames, 1.0), (axles, -1.0)]);
        let shear = [(own, 1.0), (y, -1.0), (yaw, -side * half), (roll, -above)];
        quadratic(&mut system.stiffness, -2.0 * NEST, &shear);
        for end in [base, -base] {
            let lateral = [(own, 1.0), (frames, end)];
            quadratic(&mut system.mass, car.wheelset.mass, &lateral);
            quadratic(&mut system.stiffness, -weight * conicity / HALF, &lateral);
            quadratic(&mut system.damping, -2.0 * f22, &lateral);
            quadratic(&mut system.damping, -2.0 * f11 * HALF * HALF, &[(axles, 1.0)]);
            for (place, by) in lateral {
                system.stiffness[(place, axles)] += 2.0 * f22 * by;
                system.stiffness[(axles, place)] -= 2.0 * f11 * HALF * conicity / RADIUS * by;
            }
        }
        system.stiffness[(axles, axles)] += 2.0 * weight * HALF * conicity;
    }
    let grows = |speed: f64| {
        let mut own = system.clone();
        own.damping /= speed;
        if held {
            for matrix in [&mut own.mass, &mut own.stiffness, &mut own.damping] {
                *matrix = matrix.view((3, 3), (6, 6)).into_owned();
            }
        }
        let modes = own.modes(10.0, 2 * own.mass.nrows()).unwrap();
        modes
            .iter()
            .any(|mode| mode.frequency() > 0.3 && mode.growth() > 0.0)
    };
    let (mut low, mut high) = (5.0 * MPH, 300.0 * MPH);
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        *(if grows(middle) { &mut high } else { &mut low }) = middle;
    }
    low
}

/// The same speeds by an eigenproblem of nine coordinates.
#[test]
fn analytic_critical_speeds_of_nine_coordinates() {
    let warp = 17e6 * POUND_FORCE * INCH;
    for (conicity, expected) in [(0.05, 65.0), (0.1, 45.0), (0.2, 32.0)] {
        let speed = nine_coordinates(conicity, warp, false) / MPH;
        println!("{conicity}: {speed} mph");
        assert!((speed / expected - 1.0).abs() < 0.01, "{conicity}: {speed} mph");
    }
}

/// Trucks alone, their body being held, hunt where those of nine coordinates less three do.
#[test]
fn cross_code_critical_speed_of_trucks_alone() {
    let warp = 17e6 * POUND_FORCE * INCH;
    for conicity in [0.1, 0.2] {
        let expected = nine_coordinates(conicity, warp, true);
        let mut car = SteadyCar::new(&reduced(conicity, warp, 1.0)).unwrap();
        car.hold_body();
        let range = [0.7 * expected, 1.4 * expected];
        let found = car.critical_speed(range, FrictionState::Stuck).unwrap().unwrap();
        let speed = found.speed;
        println!("{conicity}: {} mph, {} expected", speed / MPH, expected / MPH);
        assert!(
            (speed / expected - 1.0).abs() < 0.03,
            "{conicity}: {speed} {expected}"
        );
        // Nothing of the body moves.
        let system = &car.car().system;
        let body = (0..6).filter_map(|k| system.position_of(car.car().numbers.body, k));
        let most = found.shape.iter().fold(0.0_f64, |most, own| most.max(own.norm()));
        for place in body {
            assert!(found.shape[place].norm() < 1e-9 * most);
        }
    }
}

/// Wheels with profiles do not roll at their nominal radius: in steady running they push neither forward nor
/// back, at any speed.
#[test]
fn analytic_wheels_in_steady_running_do_not_creep() {
    let parameters = empty(tangent(300.0), 10.0);
    let steady = SteadyCar::new(&parameters).unwrap();
    let mut system = steady.car().system.clone();
    for speed in [10.0, 20.0, 40.0] {
        let state = steady.state(speed);
        let mut rates = vec![0.0; state.len()];
        integrate::Problem::derivative(&mut system, 0.0, &state, &mut rates);
        let seen = system.observe(0.0, &state);
        let loads = steady.car().loads(&seen, &rates);
        for wheel in loads.wheels.iter().flatten() {
            assert!(
                wheel.longitudinal.abs() < 1e-3 * wheel.vertical,
                "{speed}: {wheel:?}"
            );
        }
        // They roll on another radius than the nominal one.
        let radius = speed / loads.axles[0].spin;
        assert!(
            (radius / parameters.axle_radius(0) - 1.0).abs() > 5e-4,
            "{radius}"
        );
    }
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
    // The separate model has wedges on their corners and softer adapters, which do not pitch.
    let flat = truck::Parameters::new(Damping::Variable).wedges;
    for own in &mut parameters.trucks {
        own.wedges = flat.clone();
        let wheelsets = own.wheelsets.as_mut().unwrap();
        let Adapter::Friction(adapter) = &mut wheelsets.adapter else {
            unreachable!("built-in adapters have friction");
        };
        adapter.contact.stiffness = 5e5 * POUND_FORCE / INCH;
        wheelsets.pitching = false;
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

/// The linear model with stuck sliders has the eigenvalues of the whole Jacobian matrix with the bristles as
/// states; without sliders those of the car whose parts have no friction.
#[test]
fn cross_code_linear_models_are_the_ends_of_the_whole_system() {
    let parameters = on_linear_wheels(1.0);
    let mut car = SteadyCar::new(&parameters).unwrap();
    let speed = 40.0 * MPH;
    let state = car.state(speed);
    let mut system = car.car().system.clone();
    // Growth and angular frequency of those that a car's motions have.
    let slow = |values: Vec<[f64; 2]>| -> Vec<[f64; 2]> {
        let own = values.into_iter().filter(|[growth, frequency]| {
            let hertz = frequency / TAU;
            *growth > -50.0 && (0.05..20.0).contains(&hertz)
        });
        own.collect()
    };
    let stuck = slow(system.eigenvalues(0.0, &state, 20.0).unwrap());
    let mut free = parameters.clone();
    for own in &mut free.trucks {
        for wedge in &mut own.wedges {
            (
                wedge.column_friction.coefficient,
                wedge.slope_friction.coefficient,
            ) = (0.0, 0.0);
        }
        if let Some(wheelsets) = &mut own.wheelsets
            && let Adapter::Friction(adapter) = &mut wheelsets.adapter
        {
            adapter.friction.coefficient = 0.0;
        }
        if let Some(body) = &mut own.car_body {
            body.center_plate.friction.coefficient = 0.0;
            if let truck::SideBearing::ConstantContact { friction, .. } = &mut body.side_bearings.kind {
                friction.coefficient = 0.0;
            }
        }
    }
    let mut system = car.with(&free).unwrap().car().system.clone();
    let absent = slow(system.eigenvalues(0.0, &state, 20.0).unwrap());
    for (friction, expected) in [(FrictionState::Stuck, stuck), (FrictionState::Absent, absent)] {
        let found = car.vibrations(speed, friction).unwrap();
        assert!(expected.len() >= 4, "{friction:?}: {}", expected.len());
        for [growth, frequency] in expected {
            let near = found.iter().any(|own| {
                let apart = (own.growth() - growth).hypot(TAU * own.frequency() - frequency);
                apart < 1e-6 * frequency.hypot(growth)
            });
            assert!(near, "{friction:?}: {growth} {frequency}");
        }
    }
}

/// About steady running stuck hysteresis of side bearings is a spring beside theirs, and absent it is none.
#[test]
fn cross_code_hysteresis_is_a_spring_or_nothing() {
    let plain = empty(tangent(300.0), 10.0);
    let parameters = with_hysteresis(plain.clone());
    let mut stiffer = plain.clone();
    let bodies = stiffer.trucks.iter_mut().flat_map(|own| &mut own.car_body);
    for body in bodies {
        if let SideBearing::ConstantContact { contact, .. } = &mut body.side_bearings.kind {
            contact.stiffness += Hysteresis::default().stiffness;
        }
    }
    let mut car = SteadyCar::new(&parameters).unwrap();
    let speed = 50.0 * MPH;
    let sliders = car.model(speed).unwrap().sliders;
    let own = sliders
        .iter()
        .filter(|own| matches!(own.place, SliderPlace::Connection(_)));
    let limits: Vec<f64> = own.map(|own| own.slider.limit / POUND_FORCE).collect();
    assert_eq!(limits.len(), 4);
    assert!(limits.iter().all(|own| (own - 600.0).abs() < 1e-6), "{limits:?}");
    for (friction, same) in [(FrictionState::Stuck, stiffer), (FrictionState::Absent, plain)] {
        let found = car.vibrations(speed, friction).unwrap();
        let expected = SteadyCar::new(&same)
            .unwrap()
            .vibrations(speed, friction)
            .unwrap();
        assert!(expected.len() > 5, "{friction:?}: {}", expected.len());
        for other in expected {
            let apart = |own: &LinearMode| {
                (own.growth() - other.growth()).hypot(TAU * (own.frequency() - other.frequency()))
            };
            let nearest = found.iter().map(apart).fold(f64::INFINITY, f64::min);
            let scale = other.growth().hypot(TAU * other.frequency());
            assert!(nearest < 2e-3 * scale, "{friction:?}: {nearest} of {scale}");
        }
    }
}

/// Eigenvalues are found at speeds at which rounding keeps entries beside the diagonal of fast motions above
/// the smallest bound: a conicity of 0.15 at 60 mph is one.
#[test]
fn issue_051_eigenvalues_are_found_at_all_speeds() {
    let mut parameters = empty(tangent(300.0), 10.0);
    parameters.support = None;
    let axle_load = parameters.weight() / 4.0;
    let Wheels::Linear {
        mut wheelset,
        support,
    } = on_linear_wheels(1.0).wheels
    else {
        unreachable!("linear wheels");
    };
    (wheelset.geometry.conicity, wheelset.axle_load) = (0.15, axle_load);
    parameters.wheels = Wheels::Linear { wheelset, support };
    let mut car = SteadyCar::new(&parameters).unwrap();
    for speed in 55..70 {
        let modes = car
            .vibrations(f64::from(speed) * MPH, FrictionState::Absent)
            .unwrap();
        assert!(modes.len() > 5, "{speed} mph: {}", modes.len());
    }
}

fn neutral_speed(found: &Neutral) -> f64 {
    match found {
        Neutral::At(own) => own.speed,
        other => unreachable!("{other:?}"),
    }
}

/// Neutral motions grow neither with a larger amplitude at their speed nor die: the curve is that of a car
/// whose friction gives way; the same search gives the same bits again.
#[test]
fn limits_critical_speeds_over_the_amplitude() {
    let mut parameters = empty(tangent(300.0), 10.0);
    for own in &mut parameters.trucks {
        own.car_body.as_mut().unwrap().side_bearings.kind = truck::SideBearing::Roller(truck::Clearance {
            clearance: 0.25 * INCH,
            stiffness: 1e6 * POUND_FORCE / INCH,
            damping: 500.0 * POUND_FORCE / INCH,
        });
    }
    let mut car = OverAmplitude::new(&parameters).unwrap();
    let clearance = car.clearance();
    // 0.406 in between flanges and rails.
    assert!((clearance / INCH - 0.4).abs() < 0.015, "{}", clearance / INCH);
    let amplitudes = [clearance, 0.8 * clearance, 0.6 * clearance];
    let go_on = |_| std::ops::ControlFlow::Continue(());
    let found = car.neutral_motions(&amplitudes, 35.0, go_on).unwrap();
    let speeds: Vec<f64> = found.iter().map(|own| neutral_speed(own) / MPH).collect();
    // Friction that slides more gives way more.
    assert!(speeds.windows(2).all(|pair| pair[0] < pair[1]), "{speeds:?}");
    assert!(speeds.iter().all(|own| (60.0..115.0).contains(own)), "{speeds:?}");
    let again = OverAmplitude::new(&parameters)
        .unwrap()
        .neutral_motions(&amplitudes, 35.0, go_on);
    let same: Vec<u64> = again
        .unwrap()
        .iter()
        .map(|own| neutral_speed(own).to_bits())
        .collect();
    let first: Vec<u64> = found.iter().map(|own| neutral_speed(own).to_bits()).collect();
    assert_eq!(same, first);
}
