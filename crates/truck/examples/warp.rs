//! The warp loop of a truck: both side frames yaw by ±20 mrad while the bolster is held. Prints the warp moment
//! on the bolster over the warp angle as CSV, with what load coils and slopes do of it, and the column's normal
//! force of one wedge.
//!
//! `cargo run --release -p truck --example warp -- truck_warp_nest_constant_rising 0.25 > warp.csv`

use integrate::{Integrator, Method, Options};
use truck::{Rig, Truck};

/// kip·in in N·m, and lbf in N.
const KIP_INCH: f64 = 112.984_829_027_616_7;
const POUND_FORCE: f64 = 4.448_221_615_260_5;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let name = arguments
        .first()
        .map_or("truck_warp_nest_constant_rising", String::as_str);
    let rig = Rig::named(name).ok_or_else(|| format!("no rig is called `{name}`"))?;
    let friction: f64 = arguments.get(1).map_or(Ok(0.25), |text| text.parse())?;
    let truck = Truck::new(&rig.parameters().with_wedge_friction(friction))?;
    let mut observer = truck.system.clone();
    let mut x = observer.initial_state();
    let options = Options {
        relative_tolerance: 1e-5,
        ..Options::of(Method::Rodas5P)
    };
    let mut integrator = Integrator::new(truck.system.clone(), options, 0.0, &x)?;
    println!("time_s,warp_angle_rad,warp_moment_kip_in,load_coils_kip_in,slopes_kip_in,column_normal_lbf");
    let (mut row, mut largest) = (0.0, 0.0_f64);
    while integrator.time() < rig.duration {
        integrator.step_to(rig.duration)?;
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
