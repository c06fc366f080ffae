//! `calls KIND NUMBER`: calls the wedge's `right-hand-side` or `jacobian` that many times, or the right-hand sides of as many wedges as there are lanes, side by
//! side (`abreast`); for counting instructions.

use std::hint::black_box;
use std::process::ExitCode;

use benchmarks::sliding_wedge;
use integrate::lanes::Runs;
use integrate::{Call, Problem, Together};
use mechanics::system::{Abreast, System};
use wedge::parameters::Damping;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [kind, number] = arguments.as_slice() else {
        eprintln!("usage: calls right-hand-side|jacobian|abreast NUMBER");
        return ExitCode::from(2);
    };
    let (Ok(number), Ok((mut wedge, x))) = (number.parse::<u32>(), sliding_wedge(Damping::Variable)) else {
        eprintln!("NUMBER must be a whole number");
        return ExitCode::from(2);
    };
    let system = &mut wedge.system;
    system.segment(0.0);
    if kind == "abreast" {
        return abreast(system, &x, number);
    }
    let (mut dx, mut df_dt) = (vec![0.0; x.len()], vec![0.0; x.len()]);
    let mut time = 2.0;
    for _ in 0..number {
        time += 1e-9;
        if kind == "jacobian" {
            df_dt.fill(0.0);
            system.linearize(time, black_box(&x), &dx, &mut df_dt);
        } else {
            system.derivative(time, black_box(&x), &mut dx);
        }
        black_box((&dx, &df_dt));
    }
    ExitCode::SUCCESS
}

/// The right-hand sides of as many wedges as there are lanes, side by side, that many times.
fn abreast(system: &System, x: &[f64], number: u32) -> ExitCode {
    let Some(mut lanes) = Abreast::of(system) else {
        eprintln!("such wedges cannot sit side by side");
        return ExitCode::FAILURE;
    };
    let mut systems = [0; Runs::COUNT].map(|_| system.clone());
    let mut rates = [0; Runs::COUNT].map(|_| vec![0.0; x.len()]);
    let mut time = 2.0;
    for _ in 0..number {
        time += 1e-9;
        let mut places = systems.iter_mut().zip(&mut rates);
        let mut calls = [0; Runs::COUNT].map(|_| {
            let (problem, dx) = places.next()?;
            let x = black_box(x);
            Some(Call { problem, time, x, dx })
        });
        lanes.derivatives(&mut calls);
        black_box(&rates);
    }
    ExitCode::SUCCESS
}
