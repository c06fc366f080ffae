//! Static wheel loads.

use car::{Parameters, Wheels};

/// Returns the static loads of the wheels on level track by axle from the front, left and right, N: each axle
/// carries half of its truck, and the body by the place of its center of gravity.
pub(super) fn static_loads(parameters: &Parameters) -> [[f64; 2]; 4] {
    let [forward, left, _] = parameters.center_of_gravity();
    let half = match &parameters.wheels {
        Wheels::OnRails(own) => 0.5 * own.tape_distance,
        Wheels::Linear { wheelset, .. } => wheelset.geometry.half_distance,
    };
    let gravity = parameters.gravity;
    [0, 1, 2, 3].map(|axle| {
        let truck = axle / 2;
        let own = &parameters.trucks[truck];
        let frames: f64 = own.side_frames.iter().map(|frame| frame.body.mass).sum();
        let share = 0.5 + [forward, -forward][truck] / parameters.truck_distance;
        let carried = 0.5 * share * parameters.carried_mass() * gravity;
        let rest =
            (0.5 * (own.bolster.body.mass + own.wedge_mass() + frames) + parameters.wheelset.mass) * gravity;
        [1.0, -1.0].map(|side| 0.5 * (carried * (1.0 + side * left / half) + rest))
    })
}
