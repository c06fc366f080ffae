//! Wedges without mass in the truck: the industry's model, against closed forms, published numbers, and the
//! same truck with linearized kinematics; loads in place of motions.

use crate::common;
use common::{INCH, KIP_INCH, POUND_FORCE, at, run};
use integrate::{Integrator, Method, Options};
use mechanics::body::Body;
use mechanics::connection::{Accumulator, Connection, Law, SpringDamper, SurfaceFriction};
use mechanics::contact::FrictionDirections;
use mechanics::curve::Curve;
use mechanics::friction::FrictionLaw;
use mechanics::motion::Motion;
use mechanics::quasi_static::{QuasiStaticWedge, SlidingDirection, SlopeFriction};
use mechanics::system::{Held, Model, StaticFriction, System};
use truck::{
    Adapter, BOLSTER, Bolster, ControlCoil, Lading, Parameters, SIDE_FRAMES, Truck, WedgeKind, empirical_warp,
};
use wedge::parameters::Damping;

const POUND_PER_INCH: f64 = POUND_FORCE / INCH;

/// 0.2 deg out.
const TOE: f64 = 0.2 * std::f64::consts::PI / 180.0;

fn massless(damping: Damping) -> Parameters {
    let mut parameters = Parameters::new(damping);
    for wedge in &mut parameters.wedges {
        wedge.kind = WedgeKind::Massless;
    }
    parameters
}

fn law(parameters: &Parameters) -> QuasiStaticWedge {
    let wedge = &parameters.wedges[0];
    QuasiStaticWedge {
        angle: wedge.angle,
        toe: wedge.toe,
        column_friction: wedge.column_friction.coefficient,
        slope_friction: wedge.slope_friction.coefficient,
    }
}

/// Returns the force of a control coil that is longer by so much than in the nominal layout.
fn coil_force(parameters: &Parameters, extension: f64) -> f64 {
    match &parameters.wedges[0].control_coil {
        ControlCoil::Shear(coil) => coil.preload - coil.stiffness * extension,
        _ => panic!("a coil with shear stiffness"),
    }
}

fn sine(amplitude: f64, angular_frequency: f64) -> Motion {
    Motion::Sine {
        amplitude,
        angular_frequency,
        phase: 0.0,
    }
}

/// With the coils of NUCARS's half-truck (6500 lbf/in a quarter nest) one truck under its half car bounces at
/// 2.018 Hz, as that half-truck does; its wedges add nothing where they do not slip.
#[test]
fn analytic_bounce_with_massless_wedges_is_that_of_the_half_truck() {
    let mut parameters = Parameters {
        bolster: Bolster::with_half_car(Lading::Loaded),
        ..massless(Damping::Constant)
    };
    for coil in parameters.load_coils.iter_mut().flatten() {
        coil.spring.stiffness = 6500.0 * POUND_PER_INCH;
    }
    let mut truck = Truck::new(&parameters).unwrap();
    let x = truck.initial_state.clone();
    let rest = truck
        .system
        .equilibrium(0.0, &x, StaticFriction::Without)
        .unwrap();
    let z = truck.system.position_of(BOLSTER, 2).unwrap();
    let modes = truck.system.vibrations(0.0, &rest, Held::Surfaces).unwrap().modes;
    let share = |mode: &mechanics::system::Vibration| mode.shape[z].abs();
    let moving = modes.iter().filter(|mode| mode.frequency > 0.5);
    let bounce = moving.max_by(|a, b| share(a).total_cmp(&share(b))).unwrap();
    assert!(
        (bounce.frequency / 2.018 - 1.0).abs() < 5e-4,
        "{} Hz",
        bounce.frequency
    );
}

/// Up and down by 1 in with 0.2 deg of toe out, side frames fixed: branches of the column's friction and loss
/// per cycle of each wedge are those of the half-truck's elements: 1148 and 2165 lbf, 6.63e3 lbf·in (constant
/// damping). With variable damping and the half-truck's coil (3000 lbf/in without preload) they are 1235 and
/// 2058 lbf at 1 in down, 1646 lbf·in, without the rise of the wedge that the toe makes there.
#[test]
fn reproduction_loops_are_those_of_the_half_truck() {
    for (damping, [loading, unloading, loop_area]) in [
        (Damping::Constant, [1148.0, 2165.0, 6630.0]),
        (Damping::Variable, [1235.0, 2058.0, 1646.0]),
    ] {
        let mut parameters = massless(damping);
        parameters.bolster.motion.coordinates[2] = sine(INCH, 2.0);
        for wedge in &mut parameters.wedges {
            wedge.toe = TOE;
            if let (ControlCoil::Shear(coil), Damping::Variable) = (&mut wedge.control_coil, damping) {
                coil.preload = 0.0;
                coil.stiffness = 3000.0 * POUND_PER_INCH;
                coil.solid = None;
            }
        }
        // Wheelsets and adapters: as stiff as rock.
        let Some(Adapter::Friction(adapter)) = parameters.wheelsets.as_mut().map(|own| &mut own.adapter)
        else {
            panic!("no adapters");
        };
        adapter.contact.stiffness *= 1e3;
        let ran = run(&parameters, 10.0, Method::default(), 1e-7);
        let rise = match damping {
            Damping::Constant => 0.0,
            Damping::Variable => libm::tan(TOE) / libm::tan(parameters.wedges[0].angle),
        };
        let [loading, loop_area] = [loading, loop_area].map(|value: f64| value * (1.0 - rise));
        let friction = |number: usize| {
            ran.loads
                .iter()
                .map(move |loads| loads.wedges[number].column_friction_z)
        };
        for number in 0..4 {
            // On the side frame, positive up: down it goes where the bolster does.
            let down = friction(number).fold(0.0, f64::min) / POUND_FORCE;
            let up = friction(number).fold(0.0, f64::max) / POUND_FORCE;
            assert!((down / -loading - 1.0).abs() < 5e-3, "{damping:?}: {down}");
            match damping {
                // Its coil is all but as long throughout.
                Damping::Constant => assert!((up / unloading - 1.0).abs() < 5e-3, "{up}"),
                Damping::Variable => assert!(up / unloading < 1.0 && up / unloading > 0.99, "{up}"),
            }
            let (mut work, mut last) = (0.0, None);
            for (time, loads) in ran.times.iter().zip(&ran.loads) {
                if *time >= std::f64::consts::PI && *time < 2.0 * std::f64::consts::PI + 0.02 {
                    let point = (
                        INCH * libm::sin(2.0 * time),
                        loads.wedges[number].column_friction_z,
                    );
                    if let Some((z, force)) = last {
                        work += 0.5 * (point.1 + force) * (point.0 - z);
                    }
                    last = Some(point);
                }
            }
            let area = work / (POUND_FORCE * INCH);
            assert!(
                (area / loop_area - 1.0).abs() < 2e-2,
                "{damping:?}: {area} lbf in"
            );
        }
        assert!(ran.residual < 1e-5, "{:e}", ran.residual);
    }
}

/// The branches of eq. 5-1 (Steets 2007) while the wedges slide down and up, with toe out.
#[test]
fn analytic_sliding_wedges_follow_the_quasi_static_balance() {
    let mut parameters = massless(Damping::Constant);
    parameters.bolster.motion.coordinates[2] = sine(0.5 * INCH, 2.0);
    for wedge in &mut parameters.wedges {
        wedge.toe = TOE;
    }
    let ran = run(&parameters, 5.0, Method::default(), 1e-7);
    // Through the nominal height on the way down and up, side frames where they are then.
    for (time, direction, slope) in [
        (1.58, SlidingDirection::Down, SlopeFriction::DownSlope),
        (3.12, SlidingDirection::Up, SlopeFriction::UpSlope),
    ] {
        let loads = at(&ran, time);
        let rise = loads.wedges[0].displacement[2] - 0.5 * INCH * libm::sin(2.0 * time);
        let force = coil_force(&parameters, rise);
        let sliding = law(&parameters).slide(direction, slope, force).unwrap();
        let found = loads.wedges[0].column_normal;
        assert!(
            (found / sliding.column_normal - 1.0).abs() < 1e-6,
            "{direction:?}: {found} {}",
            sliding.column_normal
        );
    }
}

/// Without wedge bodies the warp moment is that of coil shear (0.5006e6 in·lbf/rad a nest) and of the
/// empirical springs (3.5 kip·in/mrad of a worn truck), which stand for what is left out.
#[test]
fn analytic_warp_by_empirical_springs() {
    let moment = 52.5 * KIP_INCH;
    let triangle = |amplitude: f64| Motion::Triangle {
        amplitude,
        angular_frequency: 0.2 * std::f64::consts::PI,
    };
    for (warp_spring, springs) in [(None, 0.0), (Some(empirical_warp(moment).unwrap()), 70.0)] {
        let mut parameters = Parameters {
            warp_spring,
            ..massless(Damping::Constant)
        };
        // Connections between two prescribed bodies count too; one wedge is a body, which can move.
        parameters.wedges[3].kind = WedgeKind::Body;
        parameters.wheelsets = None;
        for frame in &mut parameters.side_frames {
            frame.free = [false; 6];
            frame.motion.coordinates[5] = triangle(0.02);
        }
        let ran = run(&parameters, 2.5, Method::default(), 1e-7);
        let loads = at(&ran, 2.5);
        let expected = springs * KIP_INCH;
        let found = loads.warp_moment.warp_springs;
        assert!((found - expected).abs() < 1e-6 * KIP_INCH, "{found} {expected}");
        let coils = loads.warp_moment.load_coils / (0.02 * POUND_FORCE * INCH);
        assert!((coils / 1.0012e6 - 1.0).abs() < 2e-3, "{coils}");
        assert!(ran.residual < 1e-5, "{:e}", ran.residual);
    }
}

/// Wedges with mass and without in one truck: between neighbors that are prescribed the bodies do to the last
/// bit what they do among themselves, and the others follow the quasi-static balance.
#[test]
fn limits_wedges_of_both_kinds_in_one_truck() {
    let rig = |kinds: [WedgeKind; 4]| {
        let mut parameters = Parameters::new(Damping::Variable);
        parameters.bolster.motion.coordinates[2] = sine(0.5 * INCH, 2.0);
        parameters.wheelsets = None;
        for frame in &mut parameters.side_frames {
            frame.free = [false; 6];
        }
        for (wedge, kind) in parameters.wedges.iter_mut().zip(kinds) {
            wedge.kind = kind;
            wedge.toe = TOE;
        }
        let ran = run(&parameters, 4.0, Method::default(), 1e-8);
        (parameters, ran)
    };
    let [body, none] = [WedgeKind::Body, WedgeKind::Massless];
    let (_, bodies) = rig([body; 4]);
    let (parameters, both) = rig([none, body, body, none]);
    assert!(both.residual < 1e-5, "{:e}", both.residual);
    for (time, direction, slope) in [
        (1.2, SlidingDirection::Down, SlopeFriction::DownSlope),
        (2.0, SlidingDirection::Down, SlopeFriction::DownSlope),
        (3.0, SlidingDirection::Up, SlopeFriction::UpSlope),
        (3.9, SlidingDirection::Up, SlopeFriction::UpSlope),
    ] {
        for number in [1, 2] {
            let [found, expected] = [&both, &bodies].map(|ran| at(ran, time).wedges[number].column_normal);
            assert!(
                (found / expected - 1.0).abs() < 1e-6,
                "{time} s: {found} {expected}"
            );
        }
        for number in [0, 3] {
            let loads = at(&both, time).wedges[number];
            let coil = coil_force(&parameters, loads.displacement[2]);
            let expected = law(&parameters)
                .slide(direction, slope, coil)
                .unwrap()
                .column_normal;
            let found = loads.column_normal;
            assert!(
                (found / expected - 1.0).abs() < 1e-6,
                "{time} s: {found} {expected}"
            );
        }
    }
}

/// A load on a free coordinate in place of a motion: the half car, without friction, sinks by the load over
/// the stiffness of coils and adapters in series.
#[test]
fn analytic_a_load_on_the_half_car() {
    let load = -10e3 * POUND_FORCE;
    let rest = |load: f64| {
        let mut bolster = Bolster::with_half_car(Lading::Loaded);
        bolster.applied[2] = Motion::Constant(load);
        let parameters = Parameters {
            bolster,
            ..massless(Damping::Constant).with_wedge_friction(0.0)
        };
        let mut truck = Truck::new(&parameters).unwrap();
        let x = truck.initial_state.clone();
        let rest = truck
            .system
            .equilibrium(0.0, &x, StaticFriction::Without)
            .unwrap();
        rest[truck.system.position_of(BOLSTER, 2).unwrap()]
    };
    let expected = load * (1.0 / (8.0 * 6468.7) + 1.0 / (8.0 * 5e5)) / POUND_PER_INCH;
    let found = rest(load) - rest(0.0);
    assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
}

/// Returns the truck with massless wedges again, of bodies with linearized kinematics and of connections
/// alone, as the industry's programs have it.
fn linearized(parameters: &Parameters) -> System {
    let truck = Truck::new(parameters).unwrap();
    let mut bodies: Vec<Body> = truck.system.bodies().to_vec();
    for body in &mut bodies {
        body.linearized = true;
        body.center_of_gravity = [0.0; 3];
    }
    let mut model = Model::new(bodies, [0.0, 0.0, -parameters.gravity]);
    model.connections = truck.system.connections().to_vec();
    let mut link = |name: &str, a: usize, b: usize, point: [f64; 3], law: Law| {
        model.connections.push(Connection {
            account: String::new(),
            name: name.to_owned(),
            a,
            b,
            point,
            markers: None,
            law,
        });
    };
    let [side, axle] = [parameters.geometry.nest(), parameters.geometry.axle()];
    for (number, way) in [1.0, -1.0].into_iter().enumerate() {
        let frame = SIDE_FRAMES + number;
        for coil in &parameters.load_coils[number] {
            let spring = &coil.spring;
            let shear = SpringDamper::spring(Curve::linear(spring.shear_stiffness));
            let vertical = SpringDamper::spring(Curve::linear(spring.stiffness).scaled(1.0, -spring.preload));
            let point = [coil.place[0], way * side + coil.place[1], 13.0 * INCH];
            let springs = vec![(0, shear.clone()), (1, shear), (2, vertical)];
            link("load_coil", BOLSTER, frame, point, Law::Springs(springs));
        }
        let Some(Adapter::Friction(adapter)) = parameters.wheelsets.as_ref().map(|own| &own.adapter) else {
            panic!("no adapters")
        };
        let FrictionLaw::Bristle { stiffness, damping } = adapter.friction.law else {
            panic!("no bristles")
        };
        for (wheelset, end) in [(0, 1.0), (1, -1.0)] {
            let stop = &adapter.longitudinal;
            let [near, far] = [stop.clearance, stop.clearance + 1.0];
            let curve = vec![
                [-far, -stop.stiffness],
                [-near, 0.0],
                [near, 0.0],
                [far, stop.stiffness],
            ];
            let curve = Curve::new(curve).unwrap();
            for across in [1.56 * INCH, -1.56 * INCH] {
                let point = [axle * end, way * side + across, 22.5 * INCH];
                let law = Law::Springs(vec![(0, SpringDamper::spring(curve.clone()))]);
                link("adapter_stop", frame, wheelset, point, law);
            }
            for across in [3.0 * INCH, -3.0 * INCH] {
                let law = SurfaceFriction {
                    clamped: false,
                    directions: FrictionDirections::Two,
                    coordinates: [2, 0, 1],
                    spring: Curve::linear(adapter.contact.stiffness).scaled(1.0, -adapter.preload),
                    damper: Some(Curve::linear(adapter.contact.damping)),
                    coefficient: adapter.friction.coefficient,
                    accumulator: Accumulator::Bristle {
                        stiffness: 0.5 * stiffness,
                        damping: 0.5 * damping,
                    },
                };
                let point = [axle * end, way * side + across, 22.5 * INCH];
                link("adapter", frame, wheelset, point, Law::Surface(law));
            }
        }
    }
    System::new(model).unwrap()
}

/// Small rotations agree with the exact ones: below 5 mrad of roll or of yaw of the bolster the wedges'
/// normal forces, heights and yaw of the side frames are the same within 1 % of what changes (4 mrad: lands
/// do not meet). (Levers of the layout leave out the moment of a nest's load on its own lateral travel, which
/// rolls the side frames by a tenth of a milliradian.)
#[test]
fn limits_linearized_kinematics_agree_with_exact_ones() {
    for coordinate in [3, 5] {
        let mut parameters = massless(Damping::Variable);
        parameters.bolster.motion.coordinates[coordinate] = sine(4e-3, 2.0 * std::f64::consts::PI);
        let exact = Truck::new(&parameters).unwrap();
        let mut systems = [exact.system.clone(), linearized(&parameters)];
        let runs = systems.each_mut().map(|system| {
            let start = system.initial_state();
            let options = Options {
                relative_tolerance: 1e-8,
                ..Options::default()
            };
            let mut integrator = Integrator::new(system.clone(), options, 0.0, &start).unwrap();
            let mut rows = Vec::new();
            for i in 1..=50 {
                let time = 0.02 * f64::from(i);
                while integrator.time() < time {
                    integrator.step_to(time).unwrap();
                }
                system.segment_like(integrator.problem());
                let seen = system.observe(time, integrator.x());
                let wedge = |number: usize| seen.connections[number].wedge.unwrap().column_normal;
                let frame = seen.bodies[SIDE_FRAMES].coordinates;
                let mut row = vec![wedge(0), wedge(1), wedge(2), wedge(3)];
                row.extend([frame[2], frame[5]]);
                rows.push(row);
            }
            rows
        });
        for column in 0..6 {
            let values = |run: usize| runs[run].iter().map(move |row| row[column]);
            let [least, most] = [
                values(0).fold(f64::INFINITY, f64::min),
                values(0).fold(f64::NEG_INFINITY, f64::max),
            ];
            // Roll does not yaw the side frames, and yaw lifts them in the second order only.
            if matches!((coordinate, column), (3, 5) | (5, 4)) {
                assert!(most - least < 1e-7, "{most} {least}");
                continue;
            }
            let apart = values(0)
                .zip(values(1))
                .fold(0.0, |apart: f64, (a, b)| apart.max((a - b).abs()));
            assert!(
                apart < 0.01 * (most - least),
                "{coordinate} {column}: {apart} of {}",
                most - least
            );
        }
    }
}
