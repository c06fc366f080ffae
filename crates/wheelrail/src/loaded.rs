//! A wheelset under given vertical loads, as another program of rolling contact is asked: frame of CONTACT.
//!
//! **Frame.** x forward, y to the right, z down, on the middle of the track at the height of the rails' tops.
//! A lateral place is positive to the right, a yaw turns the axle's front to the right, a positive roll
//! lowers the right wheel, and forward rolling is a negative pitch rate. Forces and creepages are those of
//! the rail against the wheel: forces act on the rail, creepages are the velocity of the rail less that of
//! the wheel over the rolling speed. Angles of planes of contact are positive about x: on treads that rise to
//! the field side positive on the left, negative on the right. This is the frame of the program CONTACT
//! (Vollebregt); everything else in this crate has y to the left and z up.
//!
//! Each wheel finds its own height: that at which the vertical force, with its creep forces' part, is the
//! load.

use quantity::length_hint;
use thiserror::Error;

use crate::contact::{ContactLaw, ContactPair, Side, StripLoads, WheelMotion};
use crate::wheelset::RigidWheelset;

/// Deepest rigid overlap at which a height is looked for, m. Hertz's theory ends long before.
const DEEPEST: f64 = 1e-3;
/// Smallest overlap of the search, m.
const SHALLOWEST: f64 = 1e-7;
/// Relative tolerance of the vertical force against the load.
const WITHIN: f64 = 1e-10;
/// Distance to its outer edge within which a rim stands on its edge, m.
const EDGE: f64 = 1e-3;
/// Farthest lateral place of a wheelset, m, and its name in messages.
const FARTHEST: f64 = 1.0;
const LATERAL: &str = "the lateral place (m)";

/// Position and velocity of a wheelset, in the frame of CONTACT.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attitude {
    /// Lateral place of the middle of the axle, m: to the right.
    pub lateral: f64,
    /// Yaw, rad: to the right.
    pub yaw: f64,
    /// Roll, rad: right side down.
    pub roll: f64,
    /// Forward speed, m/s: positive.
    pub speed: f64,
    /// Pitch rate, rad/s: negative where the wheelset rolls forward.
    pub pitch_rate: f64,
}

/// The part of a wheel on which it stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seat {
    /// On its tread or on the face of its flange.
    OnRail,
    /// On the tip of its flange, above the face: it has climbed the rail.
    FlangeTip,
    /// On the outer edge of its rim: it is about to fall between the rails.
    RimEdge,
    /// Beside the rail: it has derailed.
    OffRail,
}

impl Seat {
    /// Returns the part of a wheel over its rail on which it stands, by the place of contact on its profile
    /// (m).
    pub(crate) fn of(pair: &ContactPair, profile: f64) -> Self {
        let [_, rim] = pair.wheel_range();
        if pair.flange_crest().is_some_and(|crest| profile < crest) {
            Self::FlangeTip
        } else if profile > rim - EDGE {
            Self::RimEdge
        } else {
            Self::OnRail
        }
    }

    /// Returns its name in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::OnRail => "on_rail",
            Self::FlangeTip => "flange_tip",
            Self::RimEdge => "rim_edge",
            Self::OffRail => "off_rail",
        }
    }
}

/// A patch of a loaded wheel, in the frame of CONTACT.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadedPatch {
    /// Share with which the patch counts (1 but where two areas grow together); forces and moment contain it.
    pub share: f64,
    /// Lateral place on the track, m.
    pub y: f64,
    /// Angle of the plane of contact about x, rad.
    pub angle: f64,
    /// Normal force, N.
    pub normal: f64,
    /// Creep force on the rail along x, N.
    pub fx: f64,
    /// Creep force on the rail in the plane of contact, to the right, N.
    pub fy: f64,
    /// Moment on the rail about the normal that points down, N·m.
    pub spin_moment: f64,
    /// Creepages along x and in the plane of contact.
    pub creepage: [f64; 2],
    /// Spin, 1/m.
    pub spin: f64,
    /// Semi-axes of the whole ellipse along and across the rolling direction, m; on strips those of the
    /// ellipse with the same load.
    pub axes: [f64; 2],
    /// Greatest pressure of the whole ellipse, or on its strips, Pa.
    pub greatest_pressure: f64,
    /// Loads on the strips, `across` to the right; none of an ellipse.
    pub strips: Option<StripLoads<f64>>,
}

/// A loaded wheel.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadedWheel {
    /// The part of the wheel on which it stands.
    pub seat: Seat,
    /// Lateral place of the wheel's center on the track, m: to the right.
    pub center: f64,
    /// Height of the wheel's center above the rail's top, m: up. Not a number off the rail.
    pub height: f64,
    /// Lateral force on the rail, m to the right, and vertical force, down, N.
    pub force: [f64; 2],
    /// Moment of the rail's forces on the wheel about the axle, N·m: positive where it turns the wheel
    /// forward.
    pub torque: f64,
    /// Its patches, the deepest first; none off the rail.
    pub patches: Vec<LoadedPatch>,
}

/// Reasons why there is no loaded wheel.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum LoadError {
    /// A number is not admissible.
    #[error("{what} is {value}; it must be {must}")]
    Number {
        /// The number's name.
        what: &'static str,
        /// Its value, in SI units.
        value: f64,
        /// The condition on it.
        must: &'static str,
    },
    /// No height carries the load.
    #[error(
        "no height of the {side} wheel carries {load:.0} N: pressed down by up to {:.1} mm, its vertical \
         force is at most {most:.0} N, at y = {:.1} mm",
        DEEPEST * 1e3, place * 1e3
    )]
    NoHeight {
        /// Left or right.
        side: &'static str,
        /// The load, N.
        load: f64,
        /// The largest vertical force, N.
        most: f64,
        /// Lateral place of the first contact in the frame of CONTACT, m.
        place: f64,
    },
    /// No pitch rate frees the axle from torque.
    #[error(
        "at no pitch rate between {fastest:.2} and {slowest:.2} rad/s does the wheelset roll freely: the \
         torque on its axle is {:.0} and {:.0} N·m there, of one sign",
        torques[0], torques[1]
    )]
    NoFreeRolling {
        /// The pitch rate of the fastest rolling that was tried, rad/s.
        fastest: f64,
        /// That of the slowest, rad/s.
        slowest: f64,
        /// The torques there, N·m: positive where they turn the wheelset forward.
        torques: [f64; 2],
    },
}

impl LoadError {
    /// Returns the advice.
    #[must_use]
    pub fn remedy(&self) -> String {
        let words = match self {
            Self::Number { what, value, .. } => {
                let hint = (*what == LATERAL).then(|| length_hint(*value, [-FARTHEST, FARTHEST]));
                return hint
                    .flatten()
                    .unwrap_or_else(|| "give a number in that range".to_owned());
            }
            Self::NoHeight { .. } => {
                "give the load of one wheel (freight cars have 30 to 160 kN); on a steep flange creep \
                 forces can carry or pull down the whole load: look at yaw, friction and creep law"
            }
            Self::NoFreeRolling { .. } => {
                "give the pitch rate; or look at the yaw, which turns the wheels across their rails"
            }
        };
        words.to_owned()
    }
}

/// A wheel pressed down.
struct Pressed {
    force: [f64; 3],
    /// About the axle.
    torque: f64,
    patches: Vec<LoadedPatch>,
    /// y on the wheel's profile of the patch that carries most, m.
    profile: Option<f64>,
}

impl RigidWheelset {
    /// Returns the wheel at a side under a vertical load (N).
    ///
    /// The damping of `law` counts, and its smallest reference speed; 0 for both compares with CONTACT.
    ///
    /// # Errors
    /// [`LoadError`]: a number is not admissible, or no height carries the load. A derailed wheel is none:
    /// see [`LoadedWheel::seat`].
    pub fn loaded(
        &self,
        side: Side,
        attitude: &Attitude,
        load: f64,
        law: &ContactLaw,
    ) -> Result<LoadedWheel, LoadError> {
        check(attitude, load, law)?;
        let index = usize::from(side == Side::Right);
        let pair = &self.pairs()[index];
        let sign = if side == Side::Left { 1.0 } else { -1.0 };
        let origin = self.rail_origins()[index];
        let on_track = |y: f64| -sign * (origin + y);
        let level = self.nominal_radius();
        let pose = |height| self.pose(side, [-attitude.lateral, height], -attitude.yaw, attitude.roll);
        let off = |center: f64| LoadedWheel {
            seat: Seat::OffRail,
            center,
            height: f64::NAN,
            force: [0.0; 2],
            torque: 0.0,
            patches: Vec::new(),
        };
        let center = on_track(pose(level).center[0]);
        let Some(touch) = pair.touch_over_rail(&pose(level)) else {
            return Ok(off(center));
        };
        let touching = level + touch.overlap;
        let press = |depth: f64| self.pressed(side, attitude, touching - depth, law);
        // The first depth, by doublings, at which the load is carried.
        let (mut shallow, mut deep) = ([0.0, -load], None);
        let mut depth = SHALLOWEST;
        let mut most = f64::NEG_INFINITY;
        loop {
            let force = press(depth).force[2];
            most = most.max(force);
            if force >= load {
                deep = Some([depth, force - load]);
                break;
            }
            shallow = [depth, force - load];
            if depth >= DEEPEST {
                break;
            }
            depth = (2.0 * depth).min(DEEPEST);
        }
        let Some(mut deep) = deep else {
            return Err(LoadError::NoHeight {
                side: ["left", "right"][index],
                load,
                most: most.max(0.0),
                place: on_track(touch.place[1]),
            });
        };
        // False position; where an end stays, its value is halved (Illinois).
        let mut found = deep[0];
        for step in 0..100 {
            let share = shallow[1] / (shallow[1] - deep[1]);
            found = match step % 8 == 7 {
                true => 0.5 * (shallow[0] + deep[0]),
                false => shallow[0] + (deep[0] - shallow[0]) * share,
            };
            let excess = press(found).force[2] - load;
            if excess.abs() < WITHIN * load || deep[0] - shallow[0] < 1e-16 {
                break;
            }
            if excess > 0.0 {
                deep = [found, excess];
                shallow[1] *= 0.5;
            } else {
                shallow = [found, excess];
                deep[1] *= 0.5;
            }
        }
        let pressed = press(found);
        let profile = pressed.profile.unwrap_or(touch.profile);
        let seat = Seat::of(pair, profile);
        let pose = pose(touching - found);
        Ok(LoadedWheel {
            seat,
            center: on_track(pose.center[0]),
            height: pose.center[1],
            // On the rail, y to the right, z down: y turns twice, z turns twice.
            force: [pressed.force[1], pressed.force[2]],
            torque: pressed.torque,
            patches: pressed.patches,
        })
    }

    /// Returns the forces on a wheel (x forward, y to the left, z up) at a height of the wheelset's center
    /// (m).
    fn pressed(&self, side: Side, attitude: &Attitude, height: f64, law: &ContactLaw) -> Pressed {
        let index = usize::from(side == Side::Right);
        let sign = if side == Side::Left { 1.0 } else { -1.0 };
        let origin = self.rail_origins()[index];
        let (yaw, roll) = (-attitude.yaw, attitude.roll);
        let pose = self.pose(side, [-attitude.lateral, height], yaw, roll);
        let ((sin_yaw, cos_yaw), (sin_roll, cos_roll)) = (libm::sincos(yaw), libm::sincos(roll));
        let axle = [-sin_yaw * cos_roll, cos_yaw * cos_roll, sin_roll];
        let motion = WheelMotion {
            velocity: [attitude.speed, 0.0, 0.0],
            angular_velocity: axle.map(|part| -attitude.pitch_rate * part),
        };
        let (mut patches, mut most, mut profile) = (Vec::new(), 0.0, None);
        let pair = &self.pairs()[index];
        let total = law.on_wheel_by_strips(pair, side, &pose, &motion, |patch, forces, strips| {
            let normal = patch.share * forces.normal;
            if normal > most {
                (most, profile) = (normal, Some(patch.profile));
            }
            if normal <= 0.0 {
                return;
            }
            let [a, b] = forces.axes;
            patches.push(LoadedPatch {
                share: patch.share,
                y: -sign * (origin + patch.place[1]),
                angle: sign * patch.angle(),
                normal,
                fx: -patch.share * forces.creep.x,
                fy: sign * patch.share * forces.creep.y,
                spin_moment: sign * patch.share * forces.creep.spin_moment,
                creepage: [-forces.creepage.longitudinal, sign * forces.creepage.lateral],
                spin: sign * forces.creepage.spin,
                axes: [a, b],
                greatest_pressure: forces.greatest_pressure(strips),
                strips: strips.map(|own| StripLoads {
                    across: own.across.map(|y| -sign * y),
                    ..*own
                }),
            });
        });
        Pressed {
            force: total.force,
            torque: axle
                .iter()
                .zip(total.moment)
                .map(|(axis, moment)| axis * moment)
                .sum(),
            patches,
            profile,
        }
    }
}

pub(crate) fn check(attitude: &Attitude, load: f64, law: &ContactLaw) -> Result<(), LoadError> {
    let wrong_friction = law.friction.inadmissible();
    let within = |limit: f64| move |value: f64| value.abs() <= limit;
    let positive = |value: f64| value > 0.0 && value.is_finite();
    let numbers: [(&'static str, f64, bool, &'static str); 7] = [
        (
            LATERAL,
            attitude.lateral,
            within(FARTHEST)(attitude.lateral),
            "within 1 m",
        ),
        (
            "the yaw (rad)",
            attitude.yaw,
            within(0.5)(attitude.yaw),
            "within 0.5 rad",
        ),
        (
            "the roll (rad)",
            attitude.roll,
            within(0.5)(attitude.roll),
            "within 0.5 rad",
        ),
        (
            "the speed (m/s)",
            attitude.speed,
            positive(attitude.speed),
            "positive: creepages are velocities over the speed",
        ),
        (
            "the pitch rate (rad/s)",
            attitude.pitch_rate,
            attitude.pitch_rate.is_finite(),
            "a finite number",
        ),
        ("the load (N)", load, positive(load), "positive"),
        (
            "the coefficient of friction",
            wrong_friction.unwrap_or_default(),
            wrong_friction.is_none(),
            "between 0 and 2",
        ),
    ];
    match numbers.into_iter().find(|(_, _, holds, _)| !holds) {
        None => Ok(()),
        Some((what, value, _, must)) => Err(LoadError::Number { what, value, must }),
    }
}
