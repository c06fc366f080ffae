//! Traction over longitudinal creepage by four laws, for a wheel of 36 in on a rail's crown of 10 in.
//! `cargo run --release -p wheelrail --example creep_curve`

use wheelrail::creep::fastsim::{self, StripGrid};
use wheelrail::creep::{Creepage, Patch, linear, polach, shen_hedrick_elkins};
use wheelrail::hertz::{Hertz, HertzError, Material};

fn main() -> Result<(), HertzError> {
    let steel = Material {
        youngs_modulus: 207e9,
        poisson: 0.27,
    };
    let (load, friction) = (160e3, 0.3);
    let hertz = Hertz::new(steel, 1.0 / 0.4572, 1.0 / 0.254)?;
    let patch = Patch::new(&hertz, load, friction);
    let grid = StripGrid {
        cells: 50,
        strips: 50,
    };
    println!("creepage (1e-3)  traction over friction times load");
    println!("                 linear    Shen et al.  Polach    FASTSIM");
    for step in 1..=12 {
        let creepage = Creepage {
            longitudinal: 5e-4 * f64::from(step),
            lateral: 0.0,
            spin: 0.0,
        };
        let shares = [
            linear::forces(&patch, &creepage),
            shen_hedrick_elkins::forces(&patch, &creepage),
            polach::forces(&patch, &creepage, polach::DRY),
            fastsim::forces(&patch, &creepage, grid),
        ]
        .map(|forces| -forces.x / patch.limit());
        println!(
            "{:15.1}  {:8.3}  {:11.3}  {:8.3}  {:8.3}",
            1e3 * creepage.longitudinal,
            shares[0],
            shares[1],
            shares[2],
            shares[3]
        );
    }
    Ok(())
}
