//! The energy ledger of all elements together, and momentum between bodies.

use mechanics::motion::Motion;
use mechanics::system::EnergyTermKind;
use truck::{Adapter, CarBody, Hysteresis, Lading, Parameters, SideBearing, SideBearings, Spring};
use vehicle::StartKind;
use vehicle::catalog::{
    AppliedForce, AxisStop, AxleAdapter, Bearing, Bushing, Coil, DryFriction, FrictionWedge, Line, Plate,
};
use wedge::parameters::Damping;

use crate::{body, element, run, vehicle};

const ALL: [usize; 6] = [0, 1, 2, 3, 4, 5];

/// A body on every kind of element, shaken: work less losses less stored energy is the error of integration.
#[test]
fn energy_the_ledger_of_all_kinds_closes() {
    let carried = body("frame", 800.0, 300.0, [0.0, 0.0, 1.0], &ALL);
    let mut moved = body("table", 1.0, 1.0, [0.0; 3], &[]);
    moved.motion.coordinates[2] = Motion::Sine {
        amplitude: 0.01,
        angular_frequency: 15.0,
        phase: 0.0,
    };
    let upper = body("upper", 500.0, 200.0, [0.0, 0.0, 1.6], &ALL);
    let coil = |x: f64, y: f64| {
        let spring = Spring {
            preload: 3300.0,
            stiffness: 2e5,
            shear_stiffness: 1e5,
            damping: 800.0,
            solid: Some([0.03, 2e6]),
        };
        let place = [x, y, 0.7];
        let name = format!(
            "coil_{}_{}",
            if x > 0.0 { "front" } else { "rear" },
            if y > 0.0 { "left" } else { "right" }
        );
        element(&name, Coil { spring, length: 0.2 }, (1, place), (2, place))
    };
    let place = [0.0, 0.0, 1.3];
    let friction = DryFriction {
        axis: 1,
        normal_force: 600.0,
        normal_stiffness: 1e4,
        coefficient: 0.3,
        bristle_stiffness: 1e6,
        bristle_damping: 500.0,
        pushes: false,
    };
    let bushing = Bushing {
        load: [0.0, 0.0, 500.0 * 9.80665],
        stiffness: [4e5, 5e5, 6e5],
        damping: [900.0, 800.0, 700.0],
        rotational_stiffness: [1e5, 2e5, 3e5],
        rotational_damping: [300.0, 200.0, 100.0],
        turned: [0.2, 0.1, 0.3],
    };
    let force = AppliedForce {
        direction: [0.6, 0.8, 0.0],
        course: Motion::Sine {
            amplitude: 400.0,
            angular_frequency: 11.0,
            phase: 0.3,
        },
    };
    let stop = AxisStop {
        axis: 2,
        clearances: [0.004, 0.004],
        stiffness: 1e6,
        damping: 100.0,
    };
    let gap = Line {
        slack: Some([0.001, 0.001]),
        ..Line::linear(0.0, 3e5, 200.0)
    };
    let own = vehicle(
        vec![carried, moved, upper],
        vec![
            coil(0.8, 0.6),
            coil(0.8, -0.6),
            coil(-0.8, 0.6),
            coil(-0.8, -0.6),
            element("bushing", bushing, (3, place), (1, place)),
            element("stop", stop, (1, [0.5, 0.0, 0.7]), (2, [0.5, 0.0, 0.7])),
            element("gap", gap, (3, [0.9, 0.0, 1.6]), (1, [0.9, 0.0, 1.0])),
            element(
                "damper",
                Line::linear(0.0, 0.0, 4e3),
                (3, [0.0, 0.9, 1.6]),
                (2, [0.0, 0.9, 0.0]),
            ),
            element("friction", friction, (1, [0.0, 0.7, 0.9]), (0, [0.0, 0.7, 0.9])),
            element("force", force, (3, [0.0, 0.0, 1.8]), (0, [0.0; 3])),
        ],
        9.80665,
        StartKind::Nominal,
    );
    let start = own
        .system
        .clone()
        .observe(0.0, &own.initial_state)
        .energies
        .total();
    let (mut work, mut lost) = (0.0, 0.0);
    run(&own, &[0.5, 1.0, 2.0], 1e-7, |time, seen, _| {
        let residual = seen.residual(start).abs();
        (work, lost) = (seen.work, seen.losses);
        assert!(
            residual < 2e-4 * seen.losses,
            "{time}: {residual:.3e} of {:.3e}",
            seen.losses
        );
    });
    assert!(lost > 20.0 && work.abs() > 5.0, "{work} {lost}");
}

/// Wedge, center plate, side bearings and adapters: what trucks are made of, in a vehicle of one's own.
#[test]
fn energy_the_ledger_of_the_parts_of_trucks_closes() {
    let damping = Damping::Variable;
    let parameters = Parameters::new(damping);
    let wedge = FrictionWedge {
        wedge: parameters.wedges[0].clone(),
        damping,
        end: 1.0,
    };
    let usual = CarBody::new(Lading::Loaded, SideBearings::constant_contact());
    let plate = Plate {
        plate: usual.center_plate,
        load: 4e5,
    };
    let mut kind = usual.side_bearings.kind;
    if let SideBearing::ConstantContact { hysteresis, .. } = &mut kind {
        *hysteresis = Some(Hysteresis {
            limit: 50.0,
            ..Hysteresis::default()
        });
    }
    let bearing = Bearing(kind);
    let bolster = body("bolster", 4e4, 2e4, [0.0, 0.0, 0.5], &[2, 4]);
    let mut frame = body("frame", 1.0, 1.0, [0.0, 0.0, 0.4], &[]);
    frame.motion.coordinates[2] = Motion::Sine {
        amplitude: 0.008,
        angular_frequency: 12.0,
        phase: 0.0,
    };
    let upper = body("body", 4e4, 8e4, [0.0, 0.0, 1.5], &[2, 3]);
    let spring = Spring {
        preload: 8e5,
        stiffness: 8e6,
        shear_stiffness: 2e6,
        damping: 2e4,
        solid: None,
    };
    let at = [0.0, 0.0, 0.33];
    let wedge_at = [parameters.geometry.wedge_distance, 0.5, 0.457];
    let seat = [0.0, 0.0, 0.6];
    let adapter = AxleAdapter {
        adapter: Adapter::pad(),
        across: [0.0; 2],
    };
    let own = vehicle(
        vec![bolster, frame, upper],
        vec![
            element("coils", Coil { spring, length: 0.2 }, (1, at), (2, at)),
            element("wedge", wedge, (1, wedge_at), (2, wedge_at)),
            element("plate", plate, (3, seat), (1, seat)),
            element(
                "bearing_left",
                bearing.clone(),
                (3, [0.0, 0.6, 0.6]),
                (1, [0.0, 0.6, 0.6]),
            ),
            element(
                "bearing_right",
                bearing,
                (3, [0.0, -0.6, 0.6]),
                (1, [0.0, -0.6, 0.6]),
            ),
            element("pad", adapter, (3, [0.3, 0.0, 0.6]), (1, [0.3, 0.0, 0.6])),
        ],
        9.80665,
        StartKind::Nominal,
    );
    let start = own
        .system
        .clone()
        .observe(0.0, &own.initial_state)
        .energies
        .total();
    let (mut lost, mut quadratures) = (0.0, Vec::new());
    run(&own, &[0.25, 0.5, 1.0], 1e-7, |time, seen, _| {
        let residual = seen.residual(start).abs();
        (lost, quadratures) = (seen.losses, seen.quadratures.clone());
        assert!(
            residual < 1e-3 * seen.losses,
            "{time}: {residual:.3e} of {:.3e}",
            seen.losses
        );
    });
    assert!(lost > 100.0, "{lost}");
    let terms = own.system.energy_terms().iter().zip(&quadratures);
    for name in ["bearing_left", "bearing_right"] {
        let mut own = terms
            .clone()
            .filter(|(term, _)| term.kind == EnergyTermKind::SurfaceFriction && term.element == name);
        let (_, hysteresis) = own.next().unwrap();
        assert!(*hysteresis > 0.01, "{name}: {hysteresis} J");
    }
}
