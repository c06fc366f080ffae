//! The cost of a half-truck with 18 coordinates and 50 connections: right-hand side, Jacobian, factorization,
//! solution, a run.
#![allow(clippy::unwrap_used)] // it may stop where it stands

#[path = "../tests/common/half_truck.rs"]
mod half_truck;

use std::hint::black_box;
use std::time::Instant;

use integrate::{Integrator, Method, Options, Problem};
use mechanics::system::{Held, StaticFriction, System};

/// Returns the best of several rounds, microseconds a call.
fn measure(mut call: impl FnMut()) -> f64 {
    const CALLS: u32 = 2000;
    let rounds = (0..9).map(|_| {
        let start = Instant::now();
        for _ in 0..CALLS {
            call();
        }
        start.elapsed().as_secs_f64() * 1e6 / f64::from(CALLS)
    });
    rounds.fold(f64::INFINITY, f64::min)
}

fn main() {
    for (name, constant, spatial) in [
        ("variable, plain column", false, false),
        ("constant, plain column", true, false),
        ("variable, toe 0.2 deg out", false, true),
        ("constant, toe 0.2 deg out", true, true),
    ] {
        let model = half_truck::model(constant, spatial);
        let connections = model.connections.len();
        let mut system = System::new(model).unwrap();
        let x = system.initial_state();
        let settings = Options {
            method: Method::Rodas5P,
            relative_tolerance: 1e-6,
            ..Options::default()
        };
        let start = Instant::now();
        let mut integrator = Integrator::new(system.clone(), settings, 0.0, &x).unwrap();
        let energy = system.observe(0.0, &x).energies.total();
        while integrator.time() < 20.0 {
            integrator.step_to(20.0).unwrap();
        }
        let wall = start.elapsed().as_secs_f64();
        let (time, x) = (integrator.time(), integrator.x().to_vec());
        let observation = system.observe(time, &x);
        let statistics = integrator.statistics();
        println!("{name}: {} states, {connections} connections", x.len());
        println!(
            "  20 s in {wall:.2} s, {} steps, {} rejected, {} events; residual {:.1e} of {:.0} J lost",
            statistics.steps,
            statistics.rejected(),
            statistics.events,
            observation.residual(energy),
            observation.quadratures[1..].iter().sum::<f64>(),
        );
        for (energy_term, value) in system.energy_terms().iter().zip(&observation.quadratures) {
            println!("    {:22} {value:12.3} J", energy_term.kind.name());
        }
        let (mut dx, mut df_dt) = (vec![0.0; x.len()], vec![0.0; x.len()]);
        let mut at = time;
        let derivative = measure(|| {
            at += 1e-9;
            system.derivative(at, black_box(&x), &mut dx);
        });
        let jacobian = measure(|| {
            df_dt.fill(0.0);
            system.linearize(at, black_box(&x), &dx, &mut df_dt);
        });
        let factor = measure(|| system.factor(black_box(1e4)).unwrap());
        let mut b = dx.clone();
        let solve = measure(|| {
            b.copy_from_slice(&dx);
            system.solve(black_box(&mut b));
        });
        println!(
            "  right-hand side {derivative:.2} us, Jacobian {jacobian:.2} us (ratio {:.1}), factor \
             {factor:.2} us, solve {solve:.2} us",
            jacobian / derivative
        );
        let x = system.initial_state();
        if let Ok(rest) = system.equilibrium(0.0, &x, StaticFriction::Without) {
            let inch = |body: usize| rest[system.position_of(body, 2).unwrap()] / half_truck::INCH;
            println!(
                "  at rest without friction: bolster {:.4} in, left side frame {:.4} in",
                inch(0),
                inch(1)
            );
        }
        let vibrations = system.vibrations(0.0, &x, Held::All).unwrap();
        let frequencies: Vec<String> = vibrations
            .modes
            .iter()
            .map(|mode| format!("{:.2}", mode.frequency))
            .collect();
        println!(
            "  Hz: {} (asymmetry {:.1e})",
            frequencies.join(" "),
            vibrations.asymmetry
        );
    }
}
