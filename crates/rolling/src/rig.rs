//! One wheelset under a carriage on a track: bodies and elements put together, and where a run begins.

use std::sync::Arc;

use mechanics::body::Body;
use mechanics::frame::Frame;
use mechanics::link::{Marker, RelativeMotion};
use mechanics::system::{Model, ModelError, Observation, System};
use mechanics::vector::{Matrix, Vector, rotation_x, rotation_z};
use thiserror::Error;
use wheelrail::contact::{ContactLaw, CreepLaw, LinearWheelset, Side};
use wheelrail::track::{Line, RailLines};

use crate::carriage::Carriage;
use crate::linear::LinearOnTrack;
use crate::track::{RailSupport, rail_body};
use crate::wheel::{PatchState, Search, WheelElement, WheelOnRail, motion_of};
use crate::wheelset::{WheelsetBody, WheelsetPlace, coordinate, leave_spin_uncontrolled, marker};

/// The support of the wheelset.
#[derive(Clone, Debug)]
pub enum Wheels {
    /// Wheels on rails with patches.
    OnRails {
        /// Left and right.
        search: [Search; 2],
        /// Distance of the tape circles, m.
        tape_distance: f64,
        /// The laws of the contacts.
        law: ContactLaw,
    },
    /// Linear geometry and creep.
    Linear {
        /// Geometry and coefficients.
        wheelset: LinearWheelset,
        /// Stiffness of what carries it, N/m and N·m/rad.
        support: [f64; 2],
    },
}

/// One wheelset on a track.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The wheelset's mass properties.
    pub body: WheelsetBody,
    /// The support.
    pub wheels: Wheels,
    /// The track.
    pub lines: Arc<RailLines>,
    /// The carriage; its speed is that of the start.
    pub carriage: Carriage,
    /// Sprung rails; none: rigid ones. Linear wheels have none.
    pub support: Option<RailSupport>,
    /// Gravity, m/s².
    pub gravity: f64,
    /// Heading of the track's own axes in the fixed frame, rad.
    pub heading: f64,
}

/// The start of a run, relative to the track.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RigStart {
    /// Distance along the track, m.
    pub distance: f64,
    /// To the left, m.
    pub lateral: f64,
    /// Yaw to the left, rad.
    pub yaw: f64,
}

/// A rig cannot be made.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum RigError {
    /// The system cannot be assembled.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// No height carries the load.
    #[error(
        "the wheels do not carry {load} N at {distance} m along the track, {lateral} m to the left: the \
         wheelset is off its rails there, or the load is not positive"
    )]
    NotCarried {
        /// The load, N.
        load: f64,
        /// Along the track, m.
        distance: f64,
        /// To the left, m.
        lateral: f64,
    },
}

/// A rig, ready to run.
#[derive(Clone, Debug)]
pub struct Rig {
    /// The system.
    pub system: System,
    /// The state at the start.
    pub start: Vec<f64>,
    wheels: Option<([WheelElement; 2], f64)>,
    axes: Matrix<f64>,
}

/// A wheel, its motion on its rail, its internal states.
type Rolling<'r> = (&'r WheelOnRail, RelativeMotion<f64>, [f64; 2]);

/// Number of the ground among the bodies.
pub const GROUND: usize = 0;
/// Number of the wheelset.
pub const WHEELSET: usize = 1;
/// Numbers of sprung rails, left and right.
pub const RAILS: [usize; 2] = [2, 3];

impl Rig {
    /// Returns the rig at its start: at rest vertically, running at the carriage's speed, spinning as if it
    /// rolled.
    ///
    /// # Errors
    /// [`RigError`].
    pub fn new(setup: &Setup, start: RigStart) -> Result<Self, RigError> {
        let (sine, cosine) = libm::sincos(setup.heading);
        let axes: Matrix<f64> = rotation_z((sine, cosine));
        let section = setup.lines.section_at(Line::Center, start.distance);
        let load = setup.carriage.load + setup.body.mass * setup.gravity;
        let off = || RigError::NotCarried {
            load,
            distance: start.distance,
            lateral: start.lateral,
        };
        let wheels = on_rails(setup);
        let heading = libm::atan2(section.axes[0][1], section.axes[0][0]);
        let canted = libm::asin(section.axes[1][2]);
        let rotation = |roll: f64| -> Matrix<f64> {
            let turned: Matrix<f64> = rotation_z(libm::sincos(heading + start.yaw));
            turned.times(rotation_x(libm::sincos(canted + roll)))
        };
        let center = |height: f64| {
            let own = section.fixed([0.0, start.lateral, height]);
            Vector([0, 1, 2].map(|i| section.origin[i] + own[i]))
        };
        let (mut height, mut roll, mut radius, mut sunk) = (0.0, 0.0, 0.0, 0.0);
        match (&setup.wheels, &wheels) {
            (_, Some((wheels, half))) => {
                let still = still(wheels, *half);
                let at = |height: f64, roll: f64| still(center(height), rotation(roll));
                let nominal = match &wheels[0].search {
                    Search::Exact(pair) => pair.nominal_radius(),
                    Search::Table(table) => table.pair().nominal_radius(),
                };
                let range = [nominal - 0.01, nominal + 0.02];
                let sum = |[left, right]: [[f64; 2]; 2]| left[0] + right[0] - load;
                let carrying = |roll: f64| {
                    let [low, high] = range;
                    let holds = load > 0.0 && sum(at(low, roll)) > 0.0 && sum(at(high, roll)) < 0.0;
                    holds.then(|| bisect(range, |height| sum(at(height, roll))))
                };
                // Where the shift lifts one wheel, it rolls until both carry the same.
                height = carrying(0.0).ok_or_else(off)?;
                if start.lateral != 0.0 {
                    let difference = |roll: f64| {
                        let [left, right] = at(carrying(roll).unwrap_or(height), roll);
                        left[0] - right[0]
                    };
                    roll = bisect([-LARGEST_ROLL, LARGEST_ROLL], difference);
                    height = carrying(roll).ok_or_else(off)?;
                }
                let [left, right] = at(height, roll);
                radius = (left[0] * left[1] + right[0] * right[1]) / (left[0] + right[0]);
                if let Some(support) = &setup.support {
                    sunk = -0.5 * load / support.stiffness[1];
                }
            }
            (Wheels::Linear { wheelset, support }, None) => {
                radius = wheelset.geometry.radius;
                height = radius - load / support[0];
            }
            (Wheels::OnRails { .. }, None) => {}
        }
        let mut place = center(height);
        place.0[2] += sunk;
        let fixed: Vector<f64> = axes.apply(place);
        let body = setup.body.body(
            "wheelset",
            &WheelsetPlace {
                position: fixed.0,
                heading: setup.heading + heading + start.yaw,
                roll: canted + roll,
            },
        );
        let mut model = Model::new(
            vec![Body::prescribed("ground", Frame::fixed([0.0; 3], [0.0; 3])), body],
            [0.0, 0.0, -setup.gravity],
        );
        let track = Marker::new([0.0; 3], [0.0, 0.0, setup.heading]);
        let middle = (WHEELSET, marker(0.0));
        model.add(setup.carriage.clone(), middle, (GROUND, track));
        if let Wheels::Linear { wheelset, support } = &setup.wheels {
            let element = LinearOnTrack {
                name: "linear_wheels".to_owned(),
                lines: setup.lines.clone(),
                wheelset: *wheelset,
                support: *support,
                slowest: 0.1,
            };
            model.add(element, middle, (GROUND, track));
        }
        let mut elements = Vec::new();
        if let Some((wheels, half)) = &wheels {
            for (index, wheel) in wheels.iter().enumerate() {
                let on = match &setup.support {
                    None => GROUND,
                    Some(support) => {
                        let mut body = rail_body(support);
                        body.name = format!("{} {}", support.name, ["left", "right"][index]);
                        body.initial[2] = sunk;
                        model.bodies.push(body);
                        let support = RailSupport {
                            name: format!("{}_{}", support.name, ["l", "r"][index]),
                            ..support.clone()
                        };
                        model.add(support, (RAILS[index], track), (GROUND, track));
                        RAILS[index]
                    }
                };
                let left = [*half, -half][index];
                let at = (WHEELSET, marker(left));
                elements.push(WheelElement::add(&mut model, wheel.clone(), at, (on, track)));
            }
        }
        let mut system = System::new(model)?;
        leave_spin_uncontrolled(&mut system, WHEELSET);
        let mut x = system.initial_state();
        let speeds = system.layout().speeds;
        let speed = setup.carriage.speed;
        let along: Vector<f64> = axes.apply(Vector(section.axes[0]));
        let rates = [
            (coordinate::FORWARD, speed * along.0[0]),
            (coordinate::LATERAL, speed * along.0[1]),
            (coordinate::VERTICAL, speed * along.0[2]),
            (coordinate::SPIN, speed / radius),
            (coordinate::HEADING, speed * section.curvature),
        ];
        for (own, rate) in rates {
            if let Some(position) = system.position_of(WHEELSET, own) {
                x[speeds + position] = rate;
            }
        }
        Ok(Self {
            system,
            start: x,
            wheels: wheels.and_then(|(_, half)| Some((<[_; 2]>::try_from(elements).ok()?, half))),
            axes,
        })
    }

    /// Returns the wheelset relative to the track: distance along it (m), to the left at its center (m),
    /// height over the rails (m), yaw to the left and roll with the left side up (rad).
    #[must_use]
    pub fn relative(&self, lines: &RailLines, seen: &Observation) -> [f64; 5] {
        let body = &seen.bodies[WHEELSET];
        let place: Vector<f64> = self.axes.apply_transposed(body.origin);
        let axle: Vector<f64> = self.axes.apply_transposed(body.rotation.column(0));
        let section = lines.section(Line::Center, place.0);
        let [_, left, up] = section.of([0, 1, 2].map(|i| place.0[i] - section.origin[i]));
        let [forward, _, upward] = section.of(axle.0);
        [
            section.distance,
            left,
            up,
            -libm::asin(forward),
            libm::asin(upward),
        ]
    }

    /// Gives the patches of both wheels to `see`, with the side: none of linear wheels.
    pub fn patches(&self, seen: &Observation, mut see: impl FnMut(Side, PatchState)) {
        for (wheel, motion, states) in self.motions(seen).into_iter().flatten() {
            wheel.patches(&motion, states, |patch| see(wheel.side, patch));
        }
    }

    /// Returns a vector in the axes of the track.
    pub(crate) fn in_track(&self, vector: Vector<f64>) -> Vector<f64> {
        self.axes.apply_transposed::<f64, f64>(vector)
    }

    /// Returns both wheels with their motions on their rails and their internal states; none of linear
    /// wheels.
    pub(crate) fn motions(&self, seen: &Observation) -> Option<[Rolling<'_>; 2]> {
        let (wheels, half) = self.wheels.as_ref()?;
        Some([0, 1].map(|index| {
            let own = &wheels[index];
            let rail = seen.bodies.get(RAILS[index]).unwrap_or(&seen.bodies[GROUND]);
            let left = [*half, -half][index];
            let motion = motion_of(&seen.bodies[WHEELSET], left, rail, self.axes);
            (&own.wheel, motion, own.states(seen))
        }))
    }
}

/// Largest roll at the start, rad.
const LARGEST_ROLL: f64 = 0.02;

/// Returns a zero of a falling function within a range.
fn bisect([mut low, mut high]: [f64; 2], falling: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if falling(middle) > 0.0 {
            &mut low
        } else {
            &mut high
        }) = middle;
    }
    0.5 * (low + high)
}

/// Vertical force (N) and rolling radius (m) of both wheels of a wheelset at rest, without friction, at a
/// place of its center and an orientation, in the track's axes.
fn still(wheels: &[WheelOnRail; 2], half: f64) -> impl Fn(Vector<f64>, Matrix<f64>) -> [[f64; 2]; 2] {
    let mut still = wheels.clone();
    for wheel in &mut still {
        wheel.law.creep = CreepLaw::Frictionless;
    }
    move |center, rotation| {
        [0, 1].map(|index| {
            let arm: Vector<f64> = rotation.column(1).scale([half, -half][index]);
            let motion = RelativeMotion {
                position: center + arm,
                rotation,
                velocity: Vector::zero(),
                angular_velocity: Vector::zero(),
            };
            let (mut force, mut sums) = (0.0, [0.0; 2]);
            still[index].patches(&motion, [0.0; 2], |seen| {
                let normal = seen.forces.normal * seen.patch.share;
                force += normal * seen.normal.0[2];
                sums[0] += normal;
                sums[1] += normal * seen.patch.radius;
            });
            [force, if sums[0] > 0.0 { sums[1] / sums[0] } else { 0.0 }]
        })
    }
}

/// Returns the wheels of a setup, and half the distance of their tape circles.
fn on_rails(setup: &Setup) -> Option<([WheelOnRail; 2], f64)> {
    let Wheels::OnRails {
        search: [left, right],
        tape_distance,
        law,
    } = &setup.wheels
    else {
        return None;
    };
    let wheel = |name: &str, side, search: &Search| WheelOnRail {
        name: name.to_owned(),
        lines: setup.lines.clone(),
        side,
        search: search.clone(),
        law: law.clone(),
        roll: setup.support.as_ref().and_then(RailSupport::rolling),
    };
    let wheels = [
        wheel("wheel_l", Side::Left, left),
        wheel("wheel_r", Side::Right, right),
    ];
    Some((wheels, 0.5 * tape_distance))
}
