//! Observation of a car at a state: forces of the wheels, places on the track, accelerations, and its trucks.
//!
//! Signs: the *vertical* force of a wheel is that on the rail, along the normal of the track's plane,
//! positive down; the *lateral* one lies in that plane, positive where it spreads the gauge; the
//! *longitudinal* one is positive where the wheel pushes the rail forward. Places are relative to the
//! center line without irregularities: positive to the left; yaw is positive to the left, roll with the
//! left side up. The track's plane is that of the center line's section at the body in question.
//! *Accelerations* of the body are what accelerometers on it show, along its own left and up. They contain
//! gravity's part along these axes, by roll and superelevation, but for the whole of it up: a level body at
//! rest shows zero, one at rest that leans to the right by φ shows g sin φ laterally.

use mechanics::body::Kinematics;
use mechanics::element::Element;
use mechanics::link::RelativeMotion;
use mechanics::orientation::fixed;
use mechanics::system::{BodyState, Observation, System};
use mechanics::vector::{Matrix, Vector};
use rolling::wheel::{PatchState, WheelOnRail, motion_of};
use truck::TruckFrame;
use wheelrail::track::{Line, TrackSection};

use crate::assemble::{Car, WheelElements, body_marker};
use crate::body::Pose;
use crate::coupler::CouplerLoads;

/// Share of the static load below which a wheel has no ratio of forces.
const LEAST_SHARE: f64 = 0.01;
/// The parts of a truck that have accelerometers, in columns and in [`Loads::truck_accelerations`].
pub const TRUCK_PARTS: [&str; 3] = ["bolster", "left_side_frame", "right_side_frame"];

/// Lateral over vertical force; zero where the wheel carries next to nothing.
#[must_use]
pub fn ratio(lateral: f64, vertical: f64, static_load: f64) -> f64 {
    if vertical > LEAST_SHARE * static_load {
        lateral / vertical
    } else {
        0.0
    }
}

/// A wheel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WheelLoads {
    /// Vertical force on the rail, N.
    pub vertical: f64,
    /// Lateral force on the rail, N.
    pub lateral: f64,
    /// Longitudinal force on the rail, N.
    pub longitudinal: f64,
    /// Power lost by creep over the speed, N: the wear number Tγ. Zero with linear wheels.
    pub wear_number: f64,
    /// Angle of the plane of the patch that carries most, in the section of its rail, rad: positive where it
    /// rises to the field side, as on treads and flanges. Zero without a patch, and with linear wheels.
    pub contact_angle: f64,
    /// Roll of the rail under the wheel about its base, rad, outwards: zero where rails are no beams.
    pub rail_roll: f64,
    /// How far the wheel must be lowered until it bears on its rail, m: zero while it bears, where it is
    /// beside its rail, and with linear wheels.
    pub lift: f64,
}

impl WheelLoads {
    /// Returns those of a wheel on the left (0) or the right (1) rail at its motion on it and its internal
    /// states, in a section of the track.
    #[must_use]
    pub fn of(
        (wheel, side): (&WheelOnRail, usize),
        (motion, states): (&RelativeMotion<f64>, [f64; 2]),
        section: &TrackSection<f64>,
    ) -> Self {
        let (wrench, _) = wheel.evaluate_with::<f64>(motion, states);
        let [rail_roll, _] = wheel.rail_roll(states);
        let [x, y, z] = section.of(wrench.force.0);
        let [forward, ..] = section.of(motion.velocity.0);
        // Power of creep alone, without that of the contact's damping; the patch that carries most.
        let (mut creep, mut most) = (0.0, [0.0; 2]);
        let mut bears = false;
        wheel.patches(motion, states, |patch| {
            bears = true;
            let carried = patch.forces.normal * patch.patch.share;
            if carried > most[0] {
                most = [carried, patch.patch.slope];
            }
            creep += patch.wear_number;
        });
        Self {
            vertical: z,
            lateral: [-y, y][side],
            longitudinal: -x,
            wear_number: if forward == 0.0 { 0.0 } else { creep },
            contact_angle: libm::atan(most[1]),
            rail_roll,
            lift: match bears {
                true => 0.0,
                false => wheel.lift(motion, states).unwrap_or(0.0),
            },
        }
    }

    /// Returns the lateral force over the vertical one: zero where the wheel carries nothing.
    #[must_use]
    pub fn l_over_v(&self) -> f64 {
        match self.vertical > 0.0 {
            true => self.lateral / self.vertical,
            false => 0.0,
        }
    }
}

/// A wheelset relative to the track.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxleLoads {
    /// Distance along the track, m.
    pub distance: f64,
    /// Its center to the left of the center line, m.
    pub lateral: f64,
    /// Its center above the plane of the rails' nominal tops, m.
    pub height: f64,
    /// Yaw relative to the track, rad: minus the angle of attack of a wheelset in a curve to the left that
    /// steers outwards.
    pub yaw: f64,
    /// Roll relative to the track's plane, rad.
    pub roll: f64,
    /// Rate of the spin, rad/s.
    pub spin: f64,
    /// By how much the heads of both rails have moved apart under it, m: zero where rails do not give way.
    pub gauge_widening: f64,
}

/// The body above a truck's center, at the height of the center plate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EndMotion {
    /// To the left of the center line, m.
    pub lateral: f64,
    /// Above its height in the nominal layout, relative to the track's plane, m.
    pub vertical: f64,
    /// Lateral acceleration of the accelerometer above the truck's center, m/s², gravity's part by roll and
    /// superelevation included.
    pub lateral_acceleration: f64,
    /// Vertical acceleration of the accelerometer, m/s², less gravity.
    pub vertical_acceleration: f64,
}

/// All of it, SI.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loads {
    /// Distance along the track of the body's center of gravity, m.
    pub distance: f64,
    /// Speed of the body's center of gravity along the track, m/s.
    pub speed: f64,
    /// The wheels of each wheelset from the front, left and right.
    pub wheels: [[WheelLoads; 2]; 4],
    /// The wheelsets from the front.
    pub axles: [AxleLoads; 4],
    /// Roll, pitch (nose down), yaw of the body relative to the track, rad; of one that twists means of its
    /// halves.
    pub body_angles: [f64; 3],
    /// Roll of the body's front half against the rear one, rad; zero of a body that does not twist.
    pub body_twist: f64,
    /// The body above front and rear truck.
    pub ends: [EndMotion; 2],
    /// The trucks, front and rear, in axes of the track at their bolsters.
    pub trucks: [truck::Loads; 2],
    /// The couplers, leading and trailing; none where no force can act.
    pub couplers: [Option<CouplerLoads>; 2],
    /// Lateral accelerations of bolster, left and right side frame of each truck, m/s²: what an accelerometer
    /// at the body's center of gravity shows along its left, gravity's part included.
    pub truck_accelerations: [[f64; 3]; 2],
}

impl Car {
    /// Returns the loads at an observation of [`Car::system`]; `rates` are the rates of its state there
    /// (`integrate::Problem::derivative`), which the accelerations need.
    #[must_use]
    pub fn loads(&self, seen: &Observation, rates: &[f64]) -> Loads {
        let mut loads = Loads::default();
        let body = self.body_pose(seen);
        let section = self.section(body.place);
        loads.distance = section.distance;
        [loads.speed, ..] = section.of(self.own(self.body_velocity(seen)).0);
        for (w, number) in self.numbers.wheelsets.into_iter().enumerate() {
            let state = &seen.bodies[number];
            let section = self.section(state.origin);
            let axle = section.of(self.own(state.rotation.column(0)).0);
            let [_, lateral, height] = section.of(self.arm(state.origin, &section));
            loads.axles[w] = AxleLoads {
                distance: section.distance,
                lateral,
                height,
                yaw: -libm::asin(axle[0].clamp(-1.0, 1.0)),
                roll: libm::asin(axle[2].clamp(-1.0, 1.0)),
                spin: state.speeds[3],
                gauge_widening: self.moved_apart(w, seen, &section),
            };
            loads.wheels[w] = self.wheels(w, seen, &section);
        }
        self.roll_rails(&mut loads);
        let axes = [0, 1, 2].map(|k| section.of(self.own(body.rotation.column(k)).0));
        loads.body_angles = [
            libm::atan2(axes[1][2], axes[2][2]),
            libm::asin((-axes[0][2]).clamp(-1.0, 1.0)),
            libm::atan2(axes[0][1], axes[0][0]),
        ];
        for (t, end) in loads.ends.iter_mut().enumerate() {
            *end = self.end(t, seen, rates);
        }
        loads.body_twist = self.body_twist(seen);
        loads.couplers = [0, 1].map(|end| self.coupler(seen, end));
        for (t, truck) in self.trucks.iter().enumerate() {
            let bolster = &seen.bodies[self.numbers.bolsters[t]];
            loads.trucks[t] = truck.loads(seen, &self.frame_at(bolster.center_of_gravity));
            let [left, right] = self.numbers.side_frames[t];
            loads.truck_accelerations[t] = [self.numbers.bolsters[t], left, right].map(|number| {
                let own = &seen.bodies[number];
                let felt = accelerometer(
                    (&self.system, self.gravity),
                    (number, own),
                    own.center_of_gravity - own.origin,
                    rates,
                );
                self.axes_of(number, own).column(1).dot::<f64, f64>(felt)
            });
        }
        loads
    }

    /// Returns whether rails are beams that the wheels of a truck share.
    #[must_use]
    pub fn has_beams(&self) -> bool {
        self.beams.is_some()
    }

    /// Gives the patches of all wheels to `see`, with the number of the wheelset and of the side (left 0,
    /// right 1); places and normals are in the track's own axes (those of [`Car::lines`]). None of linear
    /// wheels.
    pub fn patches(&self, seen: &Observation, mut see: impl FnMut(usize, usize, PatchState)) {
        let WheelElements::OnRails(wheels, half) = &self.wheels else {
            return;
        };
        for (w, pair) in wheels.iter().enumerate() {
            for (i, wheel) in pair.iter().enumerate() {
                let motion = self.wheel_motion(seen, w, i, *half);
                wheel
                    .wheel
                    .patches(&motion, wheel.states(seen), |patch| see(w, i, patch));
            }
        }
    }

    /// Returns the track's axes at the foot of a place (fixed axes, m) on the center line: origin, and axes
    /// forward, left, up as columns.
    #[must_use]
    pub fn frame_at(&self, place: Vector<f64>) -> TruckFrame {
        let section = self.section(place);
        let columns = section
            .axes
            .map(|axis| self.axes.apply::<f64, f64>(Vector(axis)).0);
        TruckFrame {
            origin: self.axes.apply(Vector(section.origin)),
            axes: Matrix(columns).transpose(),
        }
    }

    /// Returns the center of gravity of the body, and its rotation from the nominal layout's axes forward,
    /// left, up to fixed axes: of one that twists the means of its halves.
    pub(crate) fn body_pose(&self, seen: &Observation) -> Pose {
        let [front, rear] = [0, 1].map(|end| {
            let number = self.numbers.body_at(end);
            let own = &seen.bodies[number];
            Pose {
                place: own.center_of_gravity,
                rotation: self.axes_of(number, own),
            }
        });
        match self.numbers.rear_half {
            None => front,
            Some(_) => front.between(&rear),
        }
    }

    /// Returns the velocity of the body's center of gravity, fixed axes, m/s.
    fn body_velocity(&self, seen: &Observation) -> Vector<f64> {
        let [front, rear] = [0, 1].map(|end| seen.bodies[self.numbers.body_at(end)].velocity);
        match self.numbers.rear_half {
            None => front,
            Some(_) => (front + rear).scale(0.5),
        }
    }

    /// Returns the roll of the body's front half against the rear one, rad; zero of a rigid body.
    fn body_twist(&self, seen: &Observation) -> f64 {
        let [front, rear] = [0, 1].map(|end| {
            let number = self.numbers.body_at(end);
            self.axes_of(number, &seen.bodies[number])
        });
        match self.numbers.rear_half {
            None => 0.0,
            Some(_) => {
                let Matrix(r): Matrix<f64> = rear.transpose().times(front);
                libm::asin((0.5 * (r[2][1] - r[1][2])).clamp(-1.0, 1.0))
            }
        }
    }

    /// Returns the rotation of a body from the nominal layout's axes to fixed axes.
    fn axes_of(&self, number: usize, body: &BodyState) -> Matrix<f64> {
        let nominal = fixed(self.system.bodies()[number].frame.orientation);
        body.rotation.times(nominal.transpose())
    }

    /// Returns a vector in the track's own axes.
    pub(crate) fn own(&self, vector: Vector<f64>) -> Vector<f64> {
        self.axes.apply_transposed(vector)
    }

    pub(crate) fn section(&self, place: Vector<f64>) -> TrackSection<f64> {
        self.lines.section(Line::Center, self.own(place).0)
    }

    pub(crate) fn arm(&self, place: Vector<f64>, section: &TrackSection<f64>) -> [f64; 3] {
        (self.own(place) - Vector(section.origin)).0
    }

    fn wheel_motion(&self, seen: &Observation, w: usize, i: usize, half: f64) -> RelativeMotion<f64> {
        let on = self.numbers.under(w, i);
        let wheelset = &seen.bodies[self.numbers.wheelsets[w]];
        motion_of(wheelset, [half, -half][i], &seen.bodies[on], self.axes)
    }

    pub(crate) fn wheels(
        &self,
        w: usize,
        seen: &Observation,
        section: &TrackSection<f64>,
    ) -> [WheelLoads; 2] {
        match &self.wheels {
            WheelElements::OnRails(wheels, half) => [0, 1].map(|i| {
                let motion = self.wheel_motion(seen, w, i, *half);
                let own = &wheels[w][i];
                WheelLoads::of((&own.wheel, i), (&motion, own.states(seen)), section)
            }),
            WheelElements::Linear(element) => {
                let state = &seen.bodies[self.numbers.wheelsets[w]];
                let motion = motion_of(state, 0.0, &seen.bodies[self.numbers.ground], self.axes);
                let wrench = element.evaluate::<f64>(&motion);
                let [x, y, z] = section.of(wrench.force.0);
                let [roll, ..] = section.of(wrench.moment.0);
                // The forces act at the rails' height.
                let half = element.wheelset.geometry.half_distance;
                let shift = 0.5 * (roll - y * element.wheelset.geometry.radius) / half;
                [1.0, -1.0].map(|side| WheelLoads {
                    vertical: 0.5 * z + side * shift,
                    lateral: -side * 0.5 * y,
                    longitudinal: -0.5 * x,
                    wear_number: 0.0,
                    contact_angle: 0.0,
                    rail_roll: 0.0,
                    lift: 0.0,
                })
            }
        }
    }

    /// Returns by how much the rails under a wheelset have moved apart against what they lie on, m.
    fn moved_apart(&self, w: usize, seen: &Observation, section: &TrackSection<f64>) -> f64 {
        let Some(rails) = &self.numbers.rails else {
            return 0.0;
        };
        let outwards = [1.0, -1.0].into_iter().enumerate().map(|(i, sign)| {
            let bed = self.numbers.beds.map_or(self.numbers.ground, |beds| beds[w][i]);
            let moved = seen.bodies[rails[w][i]].origin - seen.bodies[bed].origin;
            sign * section.of(self.own(moved).0)[1]
        });
        outwards.sum()
    }

    /// Adds to the roll of rails that are beams what the other wheel of the truck adds, and to the gauge what
    /// the rolls make.
    fn roll_rails(&self, loads: &mut Loads) {
        let Some((beam, wheelbases)) = &self.beams else {
            return;
        };
        for (t, wheelbase) in wheelbases.iter().enumerate() {
            for side in 0..2 {
                let axles = [2 * t, 2 * t + 1];
                let rolls = beam.rolls(axles.map(|w| loads.wheels[w][side].rail_roll), *wheelbase);
                for (w, roll) in axles.into_iter().zip(rolls) {
                    loads.wheels[w][side].rail_roll = roll;
                    loads.axles[w].gauge_widening += beam.height * roll;
                }
            }
        }
    }

    fn end(&self, t: usize, seen: &Observation, rates: &[f64]) -> EndMotion {
        let half = 0.5 * self.truck_distance;
        let number = self.numbers.body_at(t);
        let body = &seen.bodies[number];
        let turned = self.axes_of(number, body);
        let arm_to = |height: f64| -> Vector<f64> {
            let nominal = [[half, -half][t], 0.0, height];
            body.rotation.apply(body_marker(&self.halves[t], nominal).origin)
        };
        let place = body.origin + arm_to(self.plates[t]);
        let arm = arm_to(self.accelerometers[t]);
        let section = self.section(place);
        let [_, lateral, height] = section.of(self.arm(place, &section));
        let shown = accelerometer((&self.system, self.gravity), (number, body), arm, rates);
        let [_, left, up] = [0, 1, 2].map(|k| turned.column(k).dot::<f64, f64>(shown));
        EndMotion {
            lateral,
            vertical: height - self.plates[t],
            lateral_acceleration: left,
            vertical_acceleration: up - self.gravity,
        }
    }
}

/// Returns what an accelerometer shows (m/s², fixed axes) that a body of a system has at an arm (m, fixed
/// axes) from its origin: its acceleration less that of free fall (gravity in m/s², down). `rates` are those
/// of the state.
#[must_use]
pub fn accelerometer(
    (system, gravity): (&System, f64),
    (number, body): (usize, &BodyState),
    arm: Vector<f64>,
    rates: &[f64],
) -> Vector<f64> {
    let first = system.layout().speeds;
    let accelerations = [0, 1, 2, 3, 4, 5].map(|k| {
        let place = system.position_of(number, k);
        place.map_or(0.0, |place| rates[first + place])
    });
    let frame = fixed(system.bodies()[number].frame.orientation);
    let [x, y, z, roll, pitch, yaw] = accelerations;
    let kinematics = Kinematics::<f64>::new(body.coordinates, body.speeds, true);
    let spin_rate = kinematics
        .orientation
        .spin_rate(kinematics.rates, [roll, pitch, yaw], true);
    let alpha: Vector<f64> = body.rotation.apply(spin_rate);
    let origin: Vector<f64> = frame.apply(Vector([x, y, z]));
    let omega = body.angular_velocity;
    let swing: Vector<f64> = omega.cross(arm);
    origin + alpha.cross::<f64, f64>(arm) + omega.cross::<f64, f64>(swing) + Vector([0.0, 0.0, gravity])
}
