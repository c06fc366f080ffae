//! The energy ledger closes, and every entry of it is needed.

use integrate::Method;
use mechanics::body::Body;
use mechanics::connection::{
    Accumulator, ColumnFace, GapDamper, Law, Options, SpringDamper, SurfaceFriction,
};
use mechanics::contact::FrictionDirections;
use mechanics::curve::Curve;
use mechanics::motion::Motion;
use mechanics::system::{EnergyTermKind, Model, System};

use crate::half_truck::{self, ALL, INCH, LBF_PER_INCH, curve, straight, vertical, wedge};
use crate::models::{connection, model, observation, run};

/// Returns the ledger's residual over the work done by the inputs (in and out), and the run's end.
fn residual(system: &System, tolerance: f64, end: f64) -> (f64, mechanics::system::Observation) {
    let x = system.initial_state();
    let start = system.clone().observe(0.0, &x).energies.total();
    let done = run(system, Method::Rodas5P, tolerance, &x, end);
    let observation = observation(&done);
    let size: f64 = observation.quadratures.iter().map(|w| w.abs()).sum();
    (observation.residual(start) / size, observation)
}

/// Returns a body on springs and two wedges with a toe, excited through a spring; bearings with friction
/// below.
fn body_on_wedges(constant: bool, toe: f64, options: Options) -> Model {
    let motion = Motion::Sine {
        amplitude: INCH,
        angular_frequency: 6.0,
        phase: 0.0,
    };
    let mut motions = vertical(motion);
    motions[0] = Motion::Sine {
        amplitude: 0.1 * INCH,
        angular_frequency: 3.0,
        phase: 1.0,
    };
    let bodies = vec![
        Body::linearized("body", [0.0, 0.0, 0.2], ALL, 5000.0, [900.0, 1000.0, 1100.0]),
        Body::linearized("frame", [0.0, 0.0, 0.0], ALL, 500.0, [100.0, 160.0, 160.0]),
        Body::linearized_prescribed("input", [0.0; 3], motions),
        Body::ground(),
    ];
    let mut drive = SpringDamper::spring(Curve::linear(1e5 * LBF_PER_INCH));
    drive.damper = Some(Curve::linear(1e2 * LBF_PER_INCH));
    let along = |k: usize, stiffness: f64| (k, SpringDamper::spring(Curve::linear(stiffness)));
    let nest = SpringDamper {
        spring: Some(curve(&[
            [-1.0, -9000.0],
            [0.0, -1500.0],
            [0.3, 0.0],
            [2.0, 200.0],
        ])),
        damper: Some(curve(&[[0.0, 0.0], [10.0, 400.0]])),
        compression_limit: -4e4,
        extension_limit: 0.0,
    };
    let bearing = SurfaceFriction {
        clamped: false,
        directions: FrictionDirections::Two,
        coordinates: [2, 0, 1],
        spring: curve(&[[0.0, -2000.0], [0.03, 0.0], [1.0, 0.0]]),
        damper: Some(curve(&[[0.0, 0.0], [1.0, 100.0]])),
        coefficient: 0.5,
        accumulator: Accumulator::Bristle {
            stiffness: 1e5 * LBF_PER_INCH,
            damping: 1e2 * LBF_PER_INCH,
        },
    };
    let gap = GapDamper {
        spring: Some(curve(&[[0.0, 0.0], [1.0, 2e4]])),
        damper: Some(curve(&[[0.0, 0.0], [1.0, 100.0]])),
        low: 0.02 * INCH,
        high: 0.2 * INCH,
    };
    let mut connections = vec![
        connection(0, 2, [0.0; 3], Law::Springs(vec![(2, drive.clone()), (0, drive)])),
        connection(
            0,
            1,
            [0.05, 0.1, 0.0],
            Law::Springs(vec![(2, nest.clone()), along(1, 3e6)]),
        ),
        connection(
            0,
            1,
            [-0.05, -0.1, 0.0],
            Law::Springs(vec![
                (2, nest),
                along(1, 3e6),
                along(5, 1e6),
                along(4, 1e6),
                along(3, 1e6),
            ]),
        ),
    ];
    for (x, y) in [(0.9, 0.1), (0.9, -0.1), (-0.9, 0.1), (-0.9, -0.1)] {
        connections.push(connection(1, 3, [x, y, 0.1], Law::Surface(bearing.clone())));
        connections.push(connection(1, 3, [x, y, 0.1], Law::Gap(2, gap.clone())));
    }
    for direction in [1.0, -1.0] {
        let mut law = wedge(constant, straight(toe, direction));
        law.accumulator = bearing.accumulator;
        connections.push(connection(0, 1, [0.2 * direction, 0.0, 0.0], Law::Wedge(law)));
    }
    let mut model = model(bodies, connections);
    model.gravity[2] = -9.80665;
    model.options = options;
    model
}

#[test]
fn the_ledger_closes() {
    for constant in [false, true] {
        for toe in [0.2, -0.2, 2.0] {
            let system = System::new(body_on_wedges(constant, toe, Options::default())).unwrap();
            let (residual, _) = residual(&system, 1e-8, 1.2);
            assert!(residual.abs() < 1e-6, "{constant} {toe}: {residual:e}");
        }
    }
}

#[test]
fn the_ledger_closes_for_other_options() {
    let options = Options {
        rise_in_slip: true,
        negative_rise: mechanics::connection::NegativeRise::Stop,
        branch: mechanics::connection::Branch::Velocity {
            reference_speed: 0.01,
        },
        ..Options::default()
    };
    let system = System::new(body_on_wedges(true, 2.0, options)).unwrap();
    let (residual, _) = residual(&system, 1e-8, 0.6);
    assert!(residual.abs() < 1e-6, "{residual:e}");
}

#[test]
fn the_half_trucks_ledger_closes() {
    for (constant, spatial) in [(false, false), (true, true)] {
        let system = System::new(half_truck::model(constant, spatial)).unwrap();
        let (residual, observation) = residual(&system, 1e-7, 1.0);
        assert!(residual.abs() < 1e-5, "{constant}: {residual:e}");
        assert!(observation.quadratures[0].abs() > 100.0);
    }
}

/// By its own slip slope friction never gives energy back; by the toe it may, where the bolster also moves
/// longitudinally.
#[test]
fn slope_friction_by_its_own_slip_only_loses() {
    let own = Options {
        slope: mechanics::connection::SlopeDirection::OwnSlip {
            reference_speed: 1e-5,
        },
        ..Options::default()
    };
    let mut least = Vec::new();
    for options in [own, Options::default()] {
        let system = System::new(body_on_wedges(true, -0.2, options)).unwrap();
        let slope = system
            .energy_terms()
            .iter()
            .position(|own| own.kind == EnergyTermKind::SlopeFriction)
            .unwrap();
        let x = system.initial_state();
        let start = system.clone().observe(0.0, &x).energies.total();
        let settings = integrate::Options {
            relative_tolerance: 1e-8,
            ..integrate::Options::default()
        };
        let mut integrator = integrate::Integrator::new(system.clone(), settings, 0.0, &x).unwrap();
        let at = integrator.x().len() - system.energy_terms().len() + slope;
        let mut smallest = f64::INFINITY;
        while integrator.time() < 1.2 {
            integrator.step_to(1.2).unwrap();
            smallest = (integrator.x()[at] - integrator.previous_x()[at]).min(smallest);
        }
        let observation = observation(&integrator);
        let size: f64 = observation.quadratures.iter().map(|w| w.abs()).sum();
        assert!(observation.residual(start).abs() < 1e-6 * size);
        least.push(smallest);
    }
    // one step, J
    assert!(least[0] > -1e-6 && least[1] < -1e-3, "{least:?}");
}

/// Corners of the motion, where the velocities of dampers jump, are stepped on.
#[test]
fn the_ledger_closes_across_breaks() {
    let mut model = body_on_wedges(true, 0.2, Options::default());
    model.bodies[2] = Body::linearized_prescribed(
        "input",
        [0.0; 3],
        vertical(Motion::Triangle {
            amplitude: INCH,
            angular_frequency: 6.0,
        }),
    );
    let system = System::new(model).unwrap();
    let (residual, observation) = residual(&system, 1e-8, 1.2);
    assert!(residual.abs() < 1e-6, "{residual:e}");
    assert!(observation.quadratures[1] > 0.0);
}

/// A ledger from which any one entry is left out does not close: so the ones above say something.
#[test]
fn a_ledger_without_one_entry_fails() {
    let system = System::new(body_on_wedges(true, 2.0, Options::default())).unwrap();
    let x = system.initial_state();
    let start = system.clone().observe(0.0, &x).energies.total();
    let done = run(&system, Method::Rodas5P, 1e-8, &x, 1.2);
    let observation = observation(&done);
    let size: f64 = observation.quadratures.iter().map(|w| w.abs()).sum();
    assert!(observation.residual(start).abs() < 1e-6 * size);
    let kinds = system.energy_terms();
    assert_eq!(kinds.len(), 8);
    for (i, kind) in kinds.iter().map(|own| own.kind).enumerate() {
        let mut without = observation.clone();
        match kind {
            EnergyTermKind::MotionWork => without.work -= observation.quadratures[i],
            _ => without.losses -= observation.quadratures[i],
        }
        let residual = without.residual(start).abs() / size;
        assert!(residual > 1e-5, "without {kind:?}: {residual:e}");
        let never_gives_back = !matches!(
            kind,
            EnergyTermKind::MotionWork | EnergyTermKind::SlopeFriction | EnergyTermKind::WedgeKinematics
        );
        if never_gives_back {
            assert!(observation.quadratures[i] > 0.0, "{kind:?}");
        }
    }
}

/// Losses of a clamped spring and damper never fall.
#[test]
fn a_clamped_damper_never_gives_energy_back() {
    let law = SpringDamper {
        spring: Some(Curve::linear(5e3)),
        damper: Some(Curve::linear(2e2)),
        compression_limit: -30.0,
        extension_limit: 10.0,
    };
    let free = Body::linearized(
        "b",
        [0.0; 3],
        [false, false, true, false, false, false],
        2.0,
        [1.0; 3],
    );
    let laws = vec![connection(0, 1, [0.0; 3], Law::Springs(vec![(2, law)]))];
    let system = System::new(model(vec![free, Body::ground()], laws)).unwrap();
    let mut x = system.initial_state();
    x[1] = 0.3;
    let start = system.clone().observe(0.0, &x).energies.total();
    let mut lost = 0.0;
    for step in 1..40 {
        let done = run(&system, Method::Rodas5P, 1e-9, &x, 0.02 * f64::from(step));
        let observation = observation(&done);
        assert!(observation.quadratures[1] >= lost - 1e-7);
        lost = observation.quadratures[1];
        assert!(observation.residual(start).abs() < 1e-6 * start);
    }
    assert!(lost > 0.3 * start);
}

/// A plain wedge loses on its column only.
#[test]
fn a_plain_wedge_has_no_slope_entry() {
    let system = System::new(half_truck::model(true, false)).unwrap();
    assert!(
        system
            .energy_terms()
            .iter()
            .all(|own| own.kind != EnergyTermKind::SlopeFriction)
    );
    let law = Law::Wedge(wedge(true, ColumnFace::Plain { toe_out: true }));
    assert_eq!(law.coordinates(), [2, 1]);
}
