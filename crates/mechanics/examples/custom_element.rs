//! A force element of one's own: a body hangs in a rubber bushing on a wall, is pulled aside and let go.
//!
//! `cargo run --release -p mechanics --example custom_element`

use integrate::{Integrator, Options};
use mechanics::body::Body;
use mechanics::element::{Element, Wrench};
use mechanics::frame::Frame;
use mechanics::link::{Marker, RelativeMotion};
use mechanics::system::{Model, System};
use numerics::scalar::Real;

/// Linear springs (N/m, N·m/rad) and dampers (N·s/m, N·m·s/rad) along and about the axes of marker B, for
/// small rotations.
#[derive(Clone, Debug)]
struct Bushing {
    stiffness: [f64; 2],
    damping: [f64; 2],
}

impl Element for Bushing {
    fn name(&self) -> &str {
        "bushing"
    }
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let ([k, kr], [c, cr]) = (self.stiffness, self.damping);
        let (v, w) = (motion.velocity, motion.angular_velocity);
        Wrench {
            force: motion.position.scale::<f64, S>(-k) - v.scale::<f64, S>(c),
            moment: motion.small_rotations().scale::<f64, S>(-kr) - w.scale::<f64, S>(cr),
            powers: [v.dot::<S, S>(v) * c + w.dot::<S, S>(w) * cr, S::zero()],
        }
    }
    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        let ([k, kr], d, r) = (self.stiffness, motion.position, motion.small_rotations());
        0.5 * (k * d.dot::<f64, f64>(d) + kr * r.dot::<f64, f64>(r))
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let at = Marker::new([0.0; 3], [0.0; 3]);
    let wall = Body::prescribed("wall", Frame::fixed([0.0; 3], [0.0; 3]));
    let aside = [0.01, 0.0, -0.02, 0.002, 0.0, 0.001];
    let body = Body::free("body", 10.0, [0.1, 0.2, 0.3], aside);
    let (stiffness, damping) = ([1e5, 100.0], [20.0, 0.05]);
    let mut model = Model::new(vec![wall, body], [0.0; 3]);
    model.add(Bushing { stiffness, damping }, (1, at), (0, at));
    let mut system = System::new(model)?;
    let start = system.initial_state();
    let stored = system.observe(0.0, &start).energies.total();
    let mut integrator = Integrator::new(system.clone(), Options::default(), 0.0, &start)?;
    while integrator.time() < 1.0 {
        integrator.step_to(1.0)?;
    }
    let observation = system.observe(1.0, integrator.x());
    let (lost, residual) = (observation.losses, observation.residual(stored));
    println!("after 1 s: {lost:.2} of {stored:.2} J lost, residual of the energy ledger {residual:.1e} J");
    assert!(lost > 0.5 * stored && residual.abs() < 1e-4 * stored);
    Ok(())
}
