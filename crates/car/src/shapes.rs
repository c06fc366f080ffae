//! Names of motions about steady running, by the bodies that move and how.
//!
//! The share of a body's coordinate is that of its kinetic energy, `m |φ|²`, couplings within a body left
//! out. Wedges go with their bolsters, rails with nothing.

use mechanics::linear::LinearModel;
use nalgebra::Complex;

use crate::assemble::Car;

/// Motions along the coordinates of bodies that do not spin: reference axes x, z, -y.
const UPRIGHT: [&str; 6] = ["along the track", "bounce", "lateral", "roll", "yaw", "pitch"];
/// Along those of wheelsets.
const WHEELSET: [&str; 6] = ["lateral", "bounce", "along the track", "spin", "yaw", "roll"];
/// Least share of a part's motions, and of a motion among those of its part, that is named.
const NAMED: [f64; 2] = [0.25, 0.2];
/// How much more one truck moves than the other to be named alone.
const ALONE: f64 = 3.0;
/// Lateral amplitude of a wheelset over the largest lateral amplitude of body and bolsters from which on the
/// motion is hunting: wheels steer it.
const HUNTING: f64 = 0.4;

/// Parts of a car that are named.
const PARTS: [&str; 4] = ["body", "bolsters", "side frames", "wheelsets"];

/// Returns the name of a motion: what moves, where, and how.
#[must_use]
pub fn name_of(car: &Car, model: &LinearModel, shape: &[Complex<f64>]) -> String {
    let numbers = &car.numbers;
    let mut bodies: Vec<_> = numbers.body_parts().map(|body| (0, 2, body)).collect();
    for truck in 0..2 {
        bodies.push((1, truck, numbers.bolsters[truck]));
        bodies.extend(numbers.side_frames[truck].map(|body| (2, truck, body)));
        let wheelsets = &numbers.wheelsets[2 * truck..2 * truck + 2];
        bodies.extend(wheelsets.iter().map(|body| (3, truck, *body)));
    }
    let mut shares = [[0.0; 6]; 4];
    let mut of_trucks = [0.0; 2];
    let mut lateral = [0.0_f64; 2];
    for (part, truck, body) in bodies {
        for k in 0..6 {
            let Some(place) = car.system.position_of(body, k) else {
                continue;
            };
            let share = model.without_friction.mass[(place, place)] * shape[place].norm_sqr();
            // By name, so that motions of wheelsets and of others add up.
            let motion = if part == 3 { WHEELSET[k] } else { UPRIGHT[k] };
            let to = UPRIGHT.iter().position(|own| *own == motion);
            shares[part][to.unwrap_or(0)] += share;
            if let Some(own) = of_trucks.get_mut(truck) {
                *own += share;
            }
            if motion == "lateral" && part != 2 {
                let own = &mut lateral[usize::from(part == 3)];
                *own = own.max(shape[place].norm());
            }
        }
    }
    let totals = shares.map(|own| own.iter().sum::<f64>());
    let whole: f64 = totals.iter().sum();
    let mut parts: Vec<usize> = (0..4).filter(|part| totals[*part] >= NAMED[0] * whole).collect();
    parts.sort_by(|a, b| totals[*b].total_cmp(&totals[*a]));
    let words = parts.iter().take(2).map(|part| {
        let own = &shares[*part];
        let mut motions: Vec<usize> = (0..6).filter(|k| own[*k] >= NAMED[1] * totals[*part]).collect();
        motions.sort_by(|a, b| own[*b].total_cmp(&own[*a]));
        let motions: Vec<&str> = motions.into_iter().map(|k| UPRIGHT[k]).collect();
        format!("{} {}", PARTS[*part], motions.join(" and "))
    });
    let words: Vec<String> = words.collect();
    let [front, rear] = of_trucks;
    let place = match (front > ALONE * rear, rear > ALONE * front) {
        (true, _) => ", front truck",
        (_, true) => ", rear truck",
        _ => "",
    };
    let [others, wheelsets] = lateral;
    let hunting = if wheelsets >= HUNTING * others {
        "hunting: "
    } else {
        ""
    };
    format!("{hunting}{}{place}", words.join(", "))
}
