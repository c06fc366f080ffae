//! What an evaluation of the contact of one wheel costs: search, normal force, creep forces.
//!
//! `cargo run --release -p wheelrail --example contact_cost`

use std::hint::black_box;
use std::time::Instant;

use numerics::scalar::{Dual, Number};
use wheelrail::contact::{
    ContactLaw, ContactPair, ContactTable, CreepLaw, FindPatches, Side, WheelMotion, WheelPose,
};
use wheelrail::creep::fastsim::Grid;
use wheelrail::creep::polach;
use wheelrail::hertz::Material;
use wheelrail::profile::nominal;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let steel = Material {
        youngs_modulus: 207e9,
        poisson: 0.28,
    };
    let rail = nominal::rail_136re()?.inclined(nominal::INCLINATION);
    let [_, top] = rail.top();
    let pair = ContactPair::new(&nominal::aar_1b()?, 0.4572, &rail, steel)?;
    let begun = Instant::now();
    let table = ContactTable::new(pair.clone(), 1e-4)?;
    println!("table made in {:.2} s", begun.elapsed().as_secs_f64());
    let grid = Grid {
        cells: 21,
        strips: 21,
    };
    let place = |lateral: f64| {
        // The height at which the overlap is 0.1 mm.
        let touch = pair.touch(&WheelPose::of(Side::Left, [lateral, top + 0.457], 0.0, 0.0));
        top + 0.457 + touch.map_or(0.0, |touch| touch.overlap) - 1e-4
    };
    for lateral in [-0.002, 0.0, 0.0065] {
        let height = place(lateral);
        let pose = WheelPose::of(Side::Left, [lateral, height], 1e-3, 0.0);
        let mut count = 0;
        pair.search(&pose, |_| count += 1);
        println!("{:.1} mm, {count} patches", lateral * 1e3);
        let measure = |name: &str, evaluate: &dyn Fn() -> f64| {
            let repeats = 100_000;
            let begun = Instant::now();
            let mut sum = 0.0;
            for _ in 0..repeats {
                sum += evaluate();
            }
            black_box(sum);
            println!(
                "  {name:36} {:6.2} μs",
                begun.elapsed().as_secs_f64() * 1e6 / f64::from(repeats)
            );
        };
        measure("search", &|| {
            let mut sum = 0.0;
            pair.search(black_box(&pose), |patch| sum += patch.approach);
            sum
        });
        for (name, creep) in [
            ("with Polach", CreepLaw::Polach(polach::DRY)),
            ("with FASTSIM 21 × 21", CreepLaw::Fastsim(grid)),
        ] {
            let law = ContactLaw {
                friction: 0.4,
                damping: 0.3,
                creep,
                slowest: 0.1,
            };
            let motion = WheelMotion {
                velocity: [20.0, 0.01, 0.0],
                angular_velocity: [0.0, 43.7, 0.0],
            };
            measure(name, &|| {
                law.on_wheel(&pair, Side::Left, black_box(&pose), &motion, |_, _| {})
                    .force[1]
            });
        }
        let law = ContactLaw {
            friction: 0.4,
            damping: 0.3,
            creep: CreepLaw::Polach(polach::DRY),
            slowest: 0.1,
        };
        measure("table", &|| {
            let mut sum = 0.0;
            table.search(black_box(&pose), |patch| sum += patch.approach);
            sum
        });
        measure("table with Polach", &|| {
            let motion = WheelMotion {
                velocity: [20.0, 0.01, 0.0],
                angular_velocity: [0.0, 43.7, 0.0],
            };
            law.on_wheel(&table, Side::Left, black_box(&pose), &motion, |_, _| {})
                .force[1]
        });
        measure("with Polach and 10 derivatives", &|| {
            let variable = |value: f64, index: usize| Dual::<10>::variable(black_box(value), index);
            let pose = WheelPose::of(
                Side::Left,
                [variable(lateral, 0), variable(height, 1)],
                variable(1e-3, 2),
                variable(0.0, 3),
            );
            let motion = WheelMotion {
                velocity: [variable(20.0, 4), variable(0.01, 5), variable(0.0, 6)],
                angular_velocity: [variable(0.0, 7), variable(43.7, 8), variable(0.0, 9)],
            };
            let forces = law.on_wheel(&pair, Side::Left, &pose, &motion, |_, _| {});
            forces.force[1].plain()
        });
    }
    Ok(())
}
