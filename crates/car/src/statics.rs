//! A car at rest: its weight, the loads of its wheels, its heights, its coils.

use mechanics::system::Observation;
use mechanics::vector::Vector;
use truck::TruckStatics;

use crate::assemble::{Car, body_marker};

/// A car in a state, which should be one at rest on straight track, SI. Heights are above the track's plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statics {
    /// Weight of all that stands on the rails, N.
    pub weight: f64,
    /// Vertical forces of the wheels of each wheelset from the front, left and right, N.
    pub wheels: [[f64; 2]; 4],
    /// Height of the center of gravity of body and lading, m.
    pub body_height: f64,
    /// Height of the center of gravity of the whole car, m.
    pub height: f64,
    /// Heights of the couplers, front and rear, m.
    pub couplers: [f64; 2],
    /// The coils of both trucks.
    pub trucks: [TruckStatics; 2],
}

impl Car {
    /// Returns the car at rest, from an observation of its system.
    #[must_use]
    pub fn statics(&self, seen: &Observation) -> Statics {
        let height = |place: Vector<f64>| {
            let section = self.section(place);
            let [.., up] = section.of(self.arm(place, &section));
            up
        };
        let on_wheels = [
            self.numbers.bolsters.to_vec(),
            self.numbers.side_frames.concat(),
            self.numbers.wedges.concat(),
            self.numbers.wheelsets.to_vec(),
            self.numbers.body_parts().collect(),
        ];
        let (mut mass, mut moment) = (0.0, 0.0);
        for number in on_wheels.concat() {
            let body = &self.system.bodies()[number];
            // A wedge without mass stands still, and is the bolster's.
            if !body.is_prescribed() {
                mass += body.mass;
                moment += body.mass * height(seen.bodies[number].center_of_gravity);
            }
        }
        let half = 0.5 * self.couplers.distance;
        let coupler = |end: usize| {
            let body = &seen.bodies[self.numbers.body_at(end)];
            let nominal = [[half, -half][end], 0.0, self.couplers.height];
            let own = body_marker(&self.halves[end], nominal);
            let arm: Vector<f64> = body.rotation.apply(own.origin);
            height(body.origin + arm)
        };
        Statics {
            weight: mass * self.gravity,
            wheels: [0, 1, 2, 3].map(|w| {
                let section = self.section(seen.bodies[self.numbers.wheelsets[w]].origin);
                self.wheels(w, seen, &section).map(|own| own.vertical)
            }),
            body_height: height(self.body_pose(seen).place),
            height: moment / mass,
            couplers: [0, 1].map(coupler),
            trucks: self.trucks.each_ref().map(|own| own.statics(seen)),
        }
    }
}
