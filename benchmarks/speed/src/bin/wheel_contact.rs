//! The cost of an evaluation of the contact of one wheel: search or table, normal force, creep forces; and
//! what the rails in space and creep laws alone do. Each number is the best of 40 batches: machines are
//! shared.

use std::hint::black_box;
use std::time::Instant;

use numerics::scalar::{Dual, Number};
use wheelrail::contact::{
    ContactLaw, ContactPair, ContactTable, CreepLaw, FindPatches, Side, WheelMotion, WheelPose,
};
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::creep::{Creepage, Patch, fastsim, linear, polach, shen_hedrick_elkins};
use wheelrail::friction::Friction;
use wheelrail::hertz::{Hertz, Material};
use wheelrail::profile::nominal;

const BATCHES: u32 = 40;
const GRID: StripGrid = StripGrid {
    cells: 21,
    strips: 21,
};
const STEEL: Material = Material {
    youngs_modulus: 207e9,
    poisson: 0.28,
};

/// Prints the shortest time of a call.
fn measure(name: &str, calls: u32, mut call: impl FnMut() -> f64) {
    let mut shortest = f64::INFINITY;
    for _ in 0..BATCHES {
        let started = Instant::now();
        let mut sum = 0.0;
        for _ in 0..calls {
            sum += call();
        }
        black_box(sum);
        shortest = shortest.min(started.elapsed().as_secs_f64() / f64::from(calls));
    }
    println!("{name:62} {:8.2} µs", shortest * 1e6);
}

fn law(creep: CreepLaw) -> ContactLaw {
    ContactLaw {
        friction: Friction::constant(0.4),
        damping: 0.3,
        creep,
        slowest: 0.1,
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rail = nominal::rail_136re()?.inclined(nominal::INCLINATION);
    let [_, top] = rail.top();
    let pair = ContactPair::new(&nominal::aar_1b()?, 0.4572, &rail, STEEL)?;
    let started = Instant::now();
    let table = ContactTable::new(pair.clone(), 1e-4)?;
    println!(
        "{:62} {:8.2} s",
        "a table is made in",
        started.elapsed().as_secs_f64()
    );
    let motion = WheelMotion {
        velocity: [20.0, 0.01, 0.0],
        angular_velocity: [0.0, 43.7, 0.0],
    };
    // The height at which the overlap is 0.1 mm.
    let place = |lateral: f64| {
        let touch = pair.touch(&WheelPose::of(Side::Left, [lateral, top + 0.457], 0.0, 0.0));
        top + 0.457 + touch.map_or(0.0, |touch| touch.overlap) - 1e-4
    };
    for lateral in [-0.002, 0.0, 0.0065] {
        let height = place(lateral);
        let pose = WheelPose::of(Side::Left, [lateral, height], 1e-3, 0.0);
        let mut count = 0;
        pair.search(&pose, |_| count += 1);
        let patches = if count == 1 {
            "one patch"
        } else {
            "two areas growing together"
        };
        let named = |what: &str| format!("{:4.1} mm, {patches}: {what}", 1e3 * lateral);
        measure(&named("search"), 2000, || {
            let mut sum = 0.0;
            pair.search(black_box(&pose), |patch| sum += patch.approach);
            sum
        });
        for (name, creep) in [
            ("search, Polach", CreepLaw::Polach(polach::DRY)),
            ("search, FASTSIM 21 × 21", CreepLaw::Fastsim(GRID)),
        ] {
            let law = law(creep);
            measure(&named(name), 1000, || {
                law.on_wheel(&pair, Side::Left, black_box(&pose), &motion, |_, _| {})
                    .force[1]
            });
        }
        let law = law(CreepLaw::Polach(polach::DRY));
        measure(&named("table, Polach"), 2000, || {
            law.on_wheel(&table, Side::Left, black_box(&pose), &motion, |_, _| {})
                .force[1]
        });
        measure(&named("search, Polach, 10 derivatives"), 500, || {
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
    let hertz = Hertz::new(STEEL, 1.0 / 0.4572, 1.0 / 0.254)?;
    let patch = &Patch::new(&hertz, 160e3, 0.4);
    let creepage = &Creepage {
        longitudinal: 8e-4,
        lateral: -5e-4,
        spin: 0.2,
    };
    measure("creep forces of a patch: linear", 20_000, || {
        linear::forces(black_box(patch), black_box(creepage)).x
    });
    measure("creep forces of a patch: Shen-Hedrick-Elkins", 20_000, || {
        shen_hedrick_elkins::forces(black_box(patch), black_box(creepage)).x
    });
    measure("creep forces of a patch: Polach", 20_000, || {
        polach::forces(black_box(patch), black_box(creepage), polach::DRY).x
    });
    measure("creep forces of a patch: FASTSIM 21 × 21", 500, || {
        fastsim::forces(black_box(patch), black_box(creepage), GRID).x
    });
    Ok(())
}
