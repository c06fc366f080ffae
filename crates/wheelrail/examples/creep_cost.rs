//! What an evaluation of each creep law costs.
//!
//! `cargo run --release -p wheelrail --example creep_cost`

use std::hint::black_box;
use std::time::Instant;

use wheelrail::creep::fastsim::Grid;
use wheelrail::creep::{Creepage, Patch, fastsim, linear, polach, shen_hedrick_elkins};
use wheelrail::hertz::{Hertz, HertzError, Material};

fn main() -> Result<(), HertzError> {
    let steel = Material {
        youngs_modulus: 207e9,
        poisson: 0.27,
    };
    let hertz = Hertz::new(steel, 1.0 / 0.4572, 1.0 / 0.254)?;
    let patch = Patch::new(&hertz, 160e3, 0.4);
    let creepage = Creepage {
        longitudinal: 8e-4,
        lateral: -5e-4,
        spin: 0.2,
    };
    let measure = |name: &str, repeats: u32, law: &dyn Fn() -> f64| {
        let begun = Instant::now();
        let mut sum = 0.0;
        for _ in 0..repeats {
            sum += law();
        }
        black_box(sum);
        println!(
            "{name:22} {:8.1} ns",
            begun.elapsed().as_secs_f64() * 1e9 / f64::from(repeats)
        );
    };
    let grid = Grid {
        cells: 21,
        strips: 21,
    };
    let (patch, creepage) = (&patch, &creepage);
    measure("linear", 1_000_000, &|| {
        linear::forces(black_box(patch), black_box(creepage)).x
    });
    measure("Shen-Hedrick-Elkins", 1_000_000, &|| {
        shen_hedrick_elkins::forces(black_box(patch), black_box(creepage)).x
    });
    measure("Polach", 1_000_000, &|| {
        polach::forces(black_box(patch), black_box(creepage), polach::DRY).x
    });
    measure("FASTSIM 21 × 21", 10_000, &|| {
        fastsim::forces(black_box(patch), black_box(creepage), grid).x
    });
    measure("patch of a contact", 100_000, &|| {
        Patch::new(black_box(&hertz), 160e3, 0.4).axes[0]
    });
    Ok(())
}
