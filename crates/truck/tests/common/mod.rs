//! Runs of rigs.
#![allow(dead_code, missing_docs, clippy::unwrap_used, clippy::expect_used)]

use integrate::{Integrator, Method, Options};
use mechanics::energy_balance::EnergyBalance;
use truck::{Loads, Parameters, Truck};

pub const INCH: f64 = 0.0254;
pub const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// kip·in, in N·m.
pub const KIP_INCH: f64 = 1e3 * POUND_FORCE * INCH;

/// A run: the loads each 0.02 s, and the relative residual of the energy ledger.
pub struct Ran {
    pub times: Vec<f64>,
    pub loads: Vec<Loads>,
    pub residual: f64,
}

pub fn run(parameters: &Parameters, duration: f64, method: Method, tolerance: f64) -> Ran {
    let truck = Truck::new(parameters).unwrap();
    let mut observer = truck.system.clone();
    let x = observer.initial_state();
    let start = observer.observe(0.0, &x).energies.total();
    let options = Options {
        relative_tolerance: tolerance,
        ..Options::of(method)
    };
    let mut integrator = Integrator::new(truck.system.clone(), options, 0.0, &x).unwrap();
    let mut balance = EnergyBalance::new(start);
    let mut ran = Ran {
        times: Vec::new(),
        loads: Vec::new(),
        residual: 0.0,
    };
    let mut buffer = x.clone();
    while integrator.time() < duration {
        integrator.step_to(duration).unwrap();
        while ran.times.len() as f64 * 0.02 <= integrator.time() {
            let time = ran.times.len() as f64 * 0.02;
            integrator.interpolate(time, &mut buffer);
            observer.segment_like(integrator.problem());
            let observation = observer.observe(time, &buffer);
            balance.note(time, &observer.ledger_entries(&observation, start));
            ran.times.push(time);
            ran.loads.push(truck.loads(&observation));
        }
    }
    ran.residual = balance.relative_residual();
    ran
}

/// Returns the loads at a time (s), a multiple of 0.02.
pub fn at(ran: &Ran, time: f64) -> &Loads {
    &ran.loads[(time / 0.02).round() as usize]
}
