//! A mass on a belt: a spring holds a block that rests on a moving plane with friction (Coulomb's, as an
//! elastic bristle in series with a slider). It is carried along, breaks away and slides until it stands
//! still against the belt.
//!
//! `cargo run --release -p mechanics --example stick_slip`

use std::f64::consts::FRAC_PI_2;

use integrate::{Integrator, Options};
use mechanics::body::Body;
use mechanics::coil::{Coil, CoilLaw};
use mechanics::contact::{ContactFace, ContactPoint};
use mechanics::frame::Frame;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::surface::Plane;
use mechanics::system::{Model, System};
use mechanics::vector::Vector;

const MASS: f64 = 1.0;
const GRAVITY: f64 = 10.0;
const FRICTION: f64 = 0.5;
const STIFFNESS: f64 = 100.0;
const BELT_SPEED: f64 = 0.1;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let ground = Body::prescribed("ground", Frame::fixed([0.0; 3], [0.0; 3]));
    let mut belt = ground.clone();
    belt.frame.motions[0] = Motion::line(0.0, [0.0, BELT_SPEED]);
    let block = Body {
        name: "block".into(),
        mass: MASS,
        free: [true, false, true, false, false, false],
        ..ground.clone()
    };
    let point = ContactPoint {
        position: Vector([0.0; 3]),
        stiffness: 1e6,
        damping: 0.0,
        share: 1.0,
    };
    let face = ContactFace {
        name: "belt".into(),
        points: vec![point],
        surface: Plane,
        coefficient: FRICTION,
        law: FrictionLaw::Bristle {
            stiffness: 1e5,
            damping: 100.0,
        },
    };
    let spring = Coil {
        end: Vector([0.0; 3]),
        acts_at: Vector([0.0; 3]),
        law: CoilLaw::Linear { stiffness: STIFFNESS },
        free_length: 1.0,
        damping: 0.0,
        rotational_damping: 0.0,
        pulls: true,
    };
    // The normal of a plane is the marker's x axis: here it points up.
    let up = Marker::new([0.0; 3], [0.0, -FRAC_PI_2, 0.0]);
    let model = Model {
        bodies: vec![ground, belt, block],
        gravity: [0.0, 0.0, -GRAVITY],
        faces: vec![(2, 1, up, face)],
        coils: vec![(2, 0, Marker::new([-1.0, 0.0, 0.0], [0.0; 3]), spring)],
        ..Model::default()
    };
    let mut system = System::new(model)?;
    let start = system.initial_state();
    let stored = system.observe(0.0, &start).energies.total();
    let mut integrator = Integrator::new(system.clone(), Options::default(), 0.0, &start)?;
    let mut farthest: f64 = 0.0;
    while integrator.time() < 2.0 {
        integrator.step_to(2.0)?;
        farthest = farthest.max(integrator.x()[0]);
    }
    let observation = system.observe(2.0, integrator.x());
    // Slipping begins where the spring pulls as hard as friction holds; the block then overshoots by its
    // speed.
    let (slips_at, omega) = (FRICTION * MASS * GRAVITY / STIFFNESS, (STIFFNESS / MASS).sqrt());
    println!("carried to {farthest:.4} m, friction holds up to {slips_at:.4} m");
    println!(
        "lost {:.4} J, residual {:.1e} J",
        observation.losses,
        observation.residual(stored)
    );
    assert!(farthest > 0.999 * slips_at && farthest < slips_at + 1.01 * BELT_SPEED / omega);
    assert!(observation.residual(stored).abs() < 1e-4 * observation.work.abs());
    Ok(())
}
