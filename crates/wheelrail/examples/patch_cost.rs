//! What patches on strips cost: the time of the forces on both wheels of a wheelset, over that with ellipses.
//!
//! `cargo run --release -p wheelrail --example patch_cost`

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use numerics::scalar::{Dual, Real};
use wheelrail::contact::{ContactLaw, ContactPair, CreepLaw, PatchForm, Side, WheelMotion, WheelPose};
use wheelrail::creep::{fastsim::StripGrid, polach};
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;
use wheelrail::profile::nominal;

/// Numbers with derivatives by the pose and the velocities.
type Derived = Dual<10>;
/// Evaluations of a timing, and timings of which the shortest counts.
const EVALUATIONS: usize = 2000;
const TIMINGS: usize = 20;

/// Returns the shortest time of one evaluation, μs.
fn time(mut evaluate: impl FnMut()) -> f64 {
    let timings = (0..TIMINGS).map(|_| {
        let start = Instant::now();
        for _ in 0..EVALUATIONS {
            evaluate();
        }
        start.elapsed().as_secs_f64() / EVALUATIONS as f64 * 1e6
    });
    timings.fold(f64::INFINITY, f64::min)
}

/// Evaluates the forces on both wheels.
fn wheelset<S: Real>(pair: &ContactPair, law: &ContactLaw, values: [S; 10]) -> [S; 2] {
    [Side::Left, Side::Right].map(|side| {
        let [y, z, yaw, roll, a, b, c, d, e, f] = values;
        let pose = WheelPose::of(side, [y, z], yaw, roll);
        let motion = WheelMotion {
            velocity: [a, b, c],
            angular_velocity: [d, e, f],
        };
        law.on_wheel(pair, side, &pose, &motion, |_, _| {}).force[2]
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let steel = Material {
        youngs_modulus: 207e9,
        poisson: 0.28,
    };
    let rail = nominal::rail_136re()?.inclined(nominal::INCLINATION);
    let rail = rail.moved([0.0, -rail.top()[1]]);
    let pair = ContactPair::new(&nominal::aar_1b()?, 0.4572, &rail, steel)?;
    let grid = StripGrid {
        cells: 21,
        strips: 21,
    };
    println!("derivatives  creep law  place   patches  ellipses, us  strips, us  ratio");
    for (name, creep) in [
        ("Polach", CreepLaw::Polach(polach::DRY)),
        ("FASTSIM", CreepLaw::Fastsim(grid)),
    ] {
        let law = ContactLaw {
            friction: Friction::constant(0.4),
            damping: 0.3,
            creep,
            slowest: 0.1,
        };
        for (place, lateral, yaw) in [("tread", 0.0, 0.0), ("flange", 8.2e-3, 5e-3)] {
            let level = WheelPose::of(Side::Left, [lateral, 0.4582], yaw, 0.0);
            let touching = 0.4582 + pair.touch(&level).map_or(0.0, |touch| touch.overlap);
            let values = [
                lateral,
                touching - 1e-4,
                yaw,
                0.0,
                15.0,
                0.02,
                -0.01,
                0.03,
                32.8,
                0.05,
            ];
            let pose = WheelPose::of(Side::Left, [lateral, touching - 1e-4], yaw, 0.0);
            let derived: [Derived; 10] = std::array::from_fn(|i| Dual::variable(values[i], i));
            let forms = [PatchForm::Ellipse, PatchForm::Strips].map(|form| pair.with_patches(form));
            let plain = [0, 1].map(|i| {
                time(|| {
                    black_box(wheelset(&forms[i], &law, black_box(values)));
                })
            });
            let exact = [0, 1].map(|i| {
                time(|| {
                    black_box(wheelset(&forms[i], &law, black_box(derived)));
                })
            });
            let patches = pair.patches_at(&pose).len();
            for (what, [ellipse, strips]) in [("none", plain), ("10", exact)] {
                println!(
                    "{what:<11}  {name:<9}  {place:<6}  {patches:<7}  {ellipse:<12.1}  {strips:<10.1}  {:.2}",
                    strips / ellipse
                );
            }
        }
    }
    Ok(())
}
