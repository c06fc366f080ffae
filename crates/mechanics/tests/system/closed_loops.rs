//! Elements without friction and damping on bodies that are led around closed loops of large poses: what they
//! take they give back, and they lose nothing. The power is that of the equations of motion, by the rate of
//! the kinetic energy that all forces together make.

use std::f64::consts::TAU;

use crate::common::{ALL, Random, UP, body, coil, face, ground, rates};
use mechanics::characteristic::Characteristic;
use mechanics::coil::CoilLaw;
use mechanics::connection::{Connection, GapDamper, Law, SpringDamper};
use mechanics::contact::Interface;
use mechanics::curve::Curve;
use mechanics::elements::{RadialStop, ShearSpring, Solid, Stop, TableSpring};
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::surface::{ProfileDirection, SurfaceProfile, SurfaceShape};
use mechanics::system::{EnergyTermKind, Model, System};

/// Amplitudes: 6 cm, 0.8 rad.
const REACH: [f64; 6] = [0.06, 0.06, 0.06, 0.8, 0.8, 0.8];
const PLACES: usize = 120_000;
/// Admissible share of the net work: laws have kinks and jumps between the places.
const SHARE: f64 = 1e-4;
const LOOPS: usize = 3;

/// The works around a loop, J: of all forces, of it what is booked as work put in, without regard to signs,
/// and the greatest loss (W).
struct Around {
    net: f64,
    put_in: f64,
    gross: f64,
    loss: f64,
}

/// Leads the first body around a random loop.
fn around(system: &mut System, random: &mut Random) -> Around {
    let waves: [[f64; 3]; 6] = std::array::from_fn(|k| {
        let order = 1.0 + (random.bits() % 3) as f64;
        [
            REACH[k] * random.between(0.5, 1.0),
            order,
            random.between(0.0, TAU),
        ]
    });
    let mut x = system.initial_state();
    let start = x.clone();
    let kinds: Vec<EnergyTermKind> = system.energy_terms().iter().map(|own| own.kind).collect();
    let first = x.len() - kinds.len();
    let mut found = Around {
        net: 0.0,
        put_in: 0.0,
        gross: 0.0,
        loss: 0.0,
    };
    for place in 0..PLACES {
        let turn = TAU * place as f64 / PLACES as f64;
        for (k, [size, order, phase]) in waves.into_iter().enumerate() {
            x[k] = start[k] + size * (order * turn + phase).sin();
            x[6 + k] = size * order * (order * turn + phase).cos();
        }
        let slopes = rates(system, 0.0, &x);
        let mut kinetic = |step: f64| {
            let moved: Vec<f64> = x.iter().zip(&slopes).map(|(x, slope)| x + step * slope).collect();
            system.energies(0.0, &moved).kinetic
        };
        let step = 1e-6;
        let power = (kinetic(step) - kinetic(-step)) / (2.0 * step);
        found.net += power;
        found.gross += power.abs();
        for (kind, slope) in kinds.iter().zip(&slopes[first..]) {
            if kind.is_work() {
                found.put_in += slope;
            } else {
                found.loss = found.loss.max(slope.abs());
            }
        }
    }
    let share = TAU / PLACES as f64;
    Around {
        net: found.net * share,
        put_in: found.put_in * share,
        gross: found.gross * share,
        ..found
    }
}

/// Returns a body above the ground, without weight.
fn alone() -> Model {
    let one = body("one", 20.0, [0.3, 0.5, 0.4], [0.01, 0.0, -0.02], ALL, [0.0; 6]);
    Model::new(vec![one, ground()], [0.0; 3])
}

fn shear_spring() -> ShearSpring {
    ShearSpring {
        name: "spring".to_owned(),
        preload: 2000.0,
        stiffness: 1e5,
        shear_stiffness: 7e4,
        damping: 0.0,
        solid: Some(Solid {
            at: -0.03,
            stiffness: 4e6,
        }),
    }
}

fn table_spring() -> TableSpring {
    let points = vec![[-0.03, 8000.0], [-0.01, 3000.0], [0.0, 2000.0], [0.02, -100.0]];
    let mut spring = TableSpring::new("table_spring", &Curve::new(points).unwrap());
    (spring.shear_stiffness, spring.tilt_stiffness) = (7e4, 300.0);
    spring
}

fn of_connection(law: Law) -> Model {
    let mut model = alone();
    let marker = Marker::new([0.1, 0.0, -0.1], [0.0; 3]);
    model.connections.push(Connection {
        account: String::new(),
        name: "between".to_owned(),
        a: 0,
        b: 1,
        point: marker.origin.0,
        markers: Some([marker; 2]),
        law,
    });
    model
}

fn of_face(shape: SurfaceShape) -> Model {
    let mut model = alone();
    let points: Vec<[f64; 3]> = (0..9)
        .map(|i| [0.1 * f64::from(i % 3) - 0.1, 0.1 * f64::from(i / 3) - 0.1, -0.1])
        .collect();
    let law = FrictionLaw::Tanh {
        reference_speed: 1e-3,
    };
    let own = face("sole", &points, 1e6, 0.0, 0.0, law);
    model.faces.push((0, 1, Marker::new([0.0, 0.0, -0.1], UP), own));
    let interface = Interface {
        shape,
        ..Interface::default()
    };
    model.interfaces.push((0, interface));
    model
}

fn check(name: &str, model: Model) {
    let mut random = Random(47);
    let mut system = System::new(model).unwrap();
    for _ in 0..LOOPS {
        let Around {
            net,
            put_in,
            gross,
            loss,
        } = around(&mut system, &mut random);
        println!("{name}: {:.1e} of {gross:.3e} J, loss {loss:.1e} W", net - put_in);
        assert!(gross > 1.0, "{name}: nothing acts");
        assert!(
            (net - put_in).abs() < SHARE * gross,
            "{name}: {net} - {put_in} of {gross}"
        );
        assert!(loss < 1e-9 * gross, "{name}: it loses {loss} W");
    }
}

/// A marker on the body of this number.
type End = (usize, Marker);

#[test]
fn issue_047_elements_without_losses_do_no_work_around_a_loop() {
    let [top, foot] = [[0.02, 0.05, -0.1], [0.02, 0.05, -0.1]];
    let tilted = Marker::new(foot, [0.2, -0.3, 0.4]);
    let at = Marker::new(top, [0.1, 0.2, -0.1]);
    let with = |add: &dyn Fn(&mut Model, End, End)| {
        let mut ways = [alone(), alone()];
        add(&mut ways[0], (0, at), (1, tilted));
        add(&mut ways[1], (1, tilted), (0, at));
        ways
    };
    let stop = Stop {
        name: "stop".to_owned(),
        clearances: [0.004, 0.006],
        stiffness: 2e6,
        damping: 0.0,
    };
    let rim = RadialStop {
        name: "rim".to_owned(),
        clearance: 0.005,
        stiffness: 2e6,
        damping: 0.0,
    };
    let all = [
        (
            "shear spring",
            with(&|model, a, b| model.add(shear_spring(), a, b)),
        ),
        (
            "table spring",
            with(&|model, a, b| model.add(table_spring(), a, b)),
        ),
        ("stop", with(&|model, a, b| model.add(stop.clone(), a, b))),
        ("radial stop", with(&|model, a, b| model.add(rim.clone(), a, b))),
    ];
    for (name, [forward, reversed]) in all {
        check(name, forward);
        check(&format!("{name}, reversed"), reversed);
    }
}

#[test]
fn issue_047_coils_do_no_work_around_a_loop_but_that_of_their_guide() {
    let end = [0.02, 0.05, -0.1];
    let table = Characteristic::new(vec![[-0.1, -2e3], [0.0, 0.0], [0.05, 4e3], [0.3, 6e4]]).unwrap();
    let laws = [CoilLaw::Linear { stiffness: 1e5 }, CoilLaw::Table(table)];
    for (law, acts_at, pulls) in [
        (&laws[0], end, true),
        (&laws[0], end, false),
        (&laws[1], end, false),
        (&laws[0], [0.0; 3], false),
        (&laws[1], [0.0, 0.03, 0.0], true),
    ] {
        let mut model = alone();
        let mut own = coil(end, acts_at, 1.0, 0.25);
        (own.law, own.pulls) = (law.clone(), pulls);
        let seat = Marker::new([0.02, 0.05, -0.33], [0.2, -0.1, 0.3]);
        model.coils.push((0, 1, seat, own));
        check("coil", model);
    }
}

#[test]
fn issue_047_connections_and_faces_do_no_work_around_a_loop() {
    let curve = |points: &[[f64; 2]]| Curve::mirrored_from_origin(points.to_vec()).unwrap();
    let spring = SpringDamper {
        spring: Some(curve(&[[0.0, 0.0], [0.02, 2000.0], [0.05, 9000.0]])),
        damper: None,
        compression_limit: -4000.0,
        extension_limit: 3000.0,
    };
    let gap = GapDamper {
        spring: Some(curve(&[[0.0, 0.0], [1.0, 3e5]])),
        damper: None,
        low: -0.01,
        high: 0.015,
    };
    check(
        "springs",
        of_connection(Law::Springs((0..6).map(|k| (k, spring.clone())).collect())),
    );
    check("gap", of_connection(Law::Gap(2, gap)));
    check("plane", of_face(SurfaceShape::default()));
    for direction in [ProfileDirection::Y, ProfileDirection::Z] {
        for curvature in [1.5, -0.8] {
            let shape = SurfaceShape {
                profile: SurfaceProfile::Arc { curvature },
                direction,
                worn: None,
            };
            check("arc", of_face(shape));
        }
    }
}
