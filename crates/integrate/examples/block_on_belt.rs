//! A block on a spring, carried along by a belt through regularized dry friction: it sticks, slips, and
//! sticks again. `cargo run --release -p integrate --example block_on_belt`

use integrate::{FunctionProblem, Integrator, Method, Options};

/// Speed of the belt, m/s; friction over mass, m/s²; square of the natural frequency, 1/s²; speed at which
/// friction is 0.76 of its limit, m/s.
const BELT: f64 = 0.1;
const FRICTION: f64 = 2.0;
const STIFFNESS: f64 = 40.0;
const REFERENCE: f64 = 1e-4;

/// Friction that falls with the slip, over mass, and its derivative.
fn friction(slip: f64) -> [f64; 2] {
    let (hold, fall) = ((slip / REFERENCE).tanh(), 1.0 / (1.0 + 4.0 * slip.abs()));
    let slope = (1.0 - hold * hold) / REFERENCE * fall - hold * 4.0 * slip.signum() * fall * fall;
    [FRICTION * hold * fall, FRICTION * slope]
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let problem = FunctionProblem::new(
        vec![0.05, 0.1],
        |_, x, dx| {
            dx[0] = x[1];
            dx[1] = -STIFFNESS * x[0] + friction(BELT - x[1])[0];
        },
        |_, x, jacobian| jacobian.copy_from_slice(&[0.0, 1.0, -STIFFNESS, -friction(BELT - x[1])[1]]),
    );
    let options = Options {
        method: Method::Rodas5P,
        relative_tolerance: 1e-6,
        ..Options::default()
    };
    let mut integrator = Integrator::new(problem, options, 0.0, &[0.0, 0.0])?;
    println!("time (s)  place (m)  speed (m/s)");
    let (mut next, mut x) = (0.0, [0.0; 2]);
    while integrator.time() < 6.0 {
        integrator.step_to(6.0)?;
        while next <= integrator.time() {
            integrator.interpolate(next, &mut x);
            println!("{next:8.2}  {:9.5}  {:11.5}", x[0], x[1]);
            next += 0.25;
        }
    }
    let statistics = integrator.statistics();
    println!("{} steps, {} rejected", statistics.steps, statistics.rejected());
    Ok(())
}
