//! The warp loop of a truck: both side frames yaw by ±20 mrad while the bolster is held. Prints the warp
//! moment on the bolster over the warp angle as CSV, with what load coils and slopes do of it, and the
//! column's normal force of one wedge. (`wedgelab warp` does that and more.)
//!
//! `cargo run --release -p truck --example warp -- 0.25 > warp.csv`

use std::f64::consts::PI;

use integrate::{Integrator, Method, Options};
use mechanics::motion::Motion;
use truck::{Parameters, Truck};
use wedge::parameters::Damping;

/// kip·in in N·m, and lbf in N.
const KIP_INCH: f64 = 112.984_829_027_616_7;
const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// Duration, s.
const DURATION: f64 = 20.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let friction: f64 = std::env::args().nth(1).map_or(Ok(0.25), |text| text.parse())?;
    let mut parameters = Parameters::new(Damping::Constant).with_wedge_friction(friction);
    for side_frame in &mut parameters.side_frames {
        side_frame.free = [false; 6];
        side_frame.motion.coordinates[5] = Motion::Triangle {
            amplitude: 0.020,
            angular_frequency: 0.2 * PI,
        };
    }
    parameters.wheelsets = None;
    let truck = Truck::new(&parameters)?;
    let mut observer = truck.system.clone();
    let mut x = truck.initial_state.clone();
    let options = Options {
        relative_tolerance: 1e-5,
        ..Options::of(Method::Rodas5P)
    };
    let mut integrator = Integrator::new(truck.system.clone(), options, 0.0, &x)?;
    println!("time_s,warp_angle_rad,warp_moment_kip_in,load_coils_kip_in,slopes_kip_in,column_normal_lbf");
    let (mut row, mut largest) = (0.0, 0.0_f64);
    while integrator.time() < DURATION {
        integrator.step_to(DURATION)?;
        while 0.1 * row <= integrator.time() {
            let time = 0.1 * row;
            integrator.interpolate(time, &mut x);
            observer.segment_like(integrator.problem());
            let loads = truck.loads(&observer.observe(time, &x));
            let parts = loads.warp_moment;
            let [total, coils, slopes] =
                [parts.total(), parts.load_coils, parts.slopes].map(|moment| moment / KIP_INCH);
            let normal = loads.wedges[0].column_normal / POUND_FORCE;
            println!(
                "{time:.1},{:.6},{total:.3},{coils:.3},{slopes:.3},{normal:.1}",
                loads.warp_angle
            );
            largest = largest.max(total.abs());
            row += 1.0;
        }
    }
    // Coils alone would give 20 kip·in.
    if largest < 20.0 {
        return Err(format!("the warp moment stayed below {largest} kip·in: has the rig no warp?").into());
    }
    Ok(())
}
