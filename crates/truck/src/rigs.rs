//! Rigs: what is done to a truck, by name.

use std::f64::consts::PI;

use mechanics::motion::{Motion, Piece, RampProfile};
use wedge::parameters::Damping;

use crate::parameters::{Parameters, body, still};
use crate::units::INCH;

/// What a rig does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Bolster up and down, 0.5 in, 2 rad/s.
    Vertical,
    /// Bolster sideways, 0.4 in, 0.5 Hz.
    Lateral,
    /// Bolster rolls by 0.01 rad, 0.5 Hz.
    Roll,
    /// Bolster held after a rise (-1) or a fall (1); both side frames yaw, a triangle of 20 mrad and 0.1 Hz.
    WarpByNests(i8),
    /// The same by wheelsets that move sideways; side frames free on their adapters.
    WarpByAxles,
    /// Under its half car, released 0.5 in above the nominal height.
    Drop,
}

/// A truck with what is done to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rig {
    /// Its name.
    pub name: &'static str,
    /// Duration of its run, s.
    pub duration: f64,
    damping: Damping,
    kind: Kind,
    /// Toe out of all columns, degrees.
    toe: f64,
}

/// All rigs.
pub const RIGS: [Rig; 16] = {
    const fn rig(name: &'static str, damping: Damping, kind: Kind, duration: f64, toe: f64) -> Rig {
        Rig {
            name,
            duration,
            damping,
            kind,
            toe,
        }
    }
    use Damping::{Constant, Variable};
    use Kind::{Drop, Lateral, Roll, Vertical, WarpByAxles, WarpByNests};
    [
        rig("truck_vertical_constant", Constant, Vertical, 10.0, 0.0),
        rig("truck_vertical_variable", Variable, Vertical, 10.0, 0.0),
        rig("truck_vertical_constant_toe_out", Constant, Vertical, 10.0, 0.2),
        rig("truck_vertical_variable_toe_out", Variable, Vertical, 10.0, 0.2),
        rig(
            "truck_warp_nest_constant_rising",
            Constant,
            WarpByNests(-1),
            22.0,
            0.0,
        ),
        rig(
            "truck_warp_nest_constant_sinking",
            Constant,
            WarpByNests(1),
            22.0,
            0.0,
        ),
        rig(
            "truck_warp_nest_variable_rising",
            Variable,
            WarpByNests(-1),
            22.0,
            0.0,
        ),
        rig(
            "truck_warp_nest_variable_sinking",
            Variable,
            WarpByNests(1),
            22.0,
            0.0,
        ),
        rig(
            "truck_warp_axles_constant_rising",
            Constant,
            WarpByAxles,
            22.0,
            0.0,
        ),
        rig(
            "truck_warp_axles_variable_rising",
            Variable,
            WarpByAxles,
            22.0,
            0.0,
        ),
        rig("truck_drop_constant", Constant, Drop, 5.0, 0.0),
        rig("truck_drop_variable", Variable, Drop, 5.0, 0.0),
        rig("truck_roll_constant", Constant, Roll, 10.0, 0.0),
        rig("truck_roll_variable", Variable, Roll, 10.0, 0.0),
        rig("truck_lateral_constant", Constant, Lateral, 10.0, 0.0),
        rig("truck_lateral_variable", Variable, Lateral, 10.0, 0.0),
    ]
};

/// Returns a sine from zero; angular frequency in rad/s.
fn sine(amplitude: f64, angular_frequency: f64) -> Motion {
    Motion::Sine {
        amplitude,
        angular_frequency,
        phase: 0.0,
    }
}

/// Returns the approach to height 0 within 0.2 to 1.2 s by a half cosine, from below (-1) or above (1).
fn approach(from: i8) -> Motion {
    let from = f64::from(from) * 0.2 * INCH;
    Motion::Sum(vec![
        Motion::Constant(from),
        Motion::Ramp {
            amplitude: -from,
            start: 0.2,
            duration: 1.0,
            profile: RampProfile::HalfCosine,
        },
    ])
}

/// Returns the triangle of warp tests from 2 s on: amplitude, then minus amplitude, 0.1 Hz.
fn triangle(amplitude: f64) -> Motion {
    Motion::Sequence(vec![Piece {
        start: 2.0,
        motion: Motion::Triangle {
            amplitude,
            angular_frequency: 0.2 * PI,
        },
    }])
}

impl Rig {
    /// Returns the rig of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        RIGS.into_iter().find(|rig| rig.name == name)
    }

    /// Returns the truck's parameters.
    #[must_use]
    pub fn parameters(&self) -> Parameters {
        let mut parameters = Parameters::new(self.damping);
        for wedge in &mut parameters.wedges {
            wedge.toe = self.toe.to_radians();
        }
        let axle = parameters.distances[2];
        let bolster = &mut parameters.bolster;
        match self.kind {
            Kind::Vertical => bolster.motion[2] = sine(0.5 * INCH, 2.0),
            Kind::Lateral => bolster.motion[1] = sine(0.4 * INCH, PI),
            Kind::Roll => bolster.motion[3] = sine(0.01, PI),
            Kind::Drop => {
                bolster.body = body(123_030.0, [0.922_76e6, 8.3502e6, 8.352_76e6], 83.0);
                bolster.free = [false, false, true, false, false, false];
                bolster.lift = 0.5 * INCH;
            }
            Kind::WarpByNests(from) => {
                bolster.motion[2] = approach(from);
                for side_frame in &mut parameters.side_frames {
                    let mut motion = still();
                    motion[5] = triangle(0.020);
                    side_frame.motion = Some(motion);
                }
                parameters.wheelsets = None;
            }
            Kind::WarpByAxles => {
                bolster.motion[2] = approach(-1);
                if let Some(wheelsets) = &mut parameters.wheelsets {
                    for (motion, sign) in wheelsets.motions.iter_mut().zip([1.0, -1.0]) {
                        motion[1] = triangle(sign * axle * 0.020);
                    }
                }
            }
        }
        parameters
    }
}
