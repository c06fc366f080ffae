//! The wedge of Steets (2007): tables 3-1 to 3-4, and values for quantities that the tables leave open.

use mechanics::coil::{CoilLaw, CoilLine};
use mechanics::friction::FrictionLaw;
use mechanics::motion::Motion;

use crate::face::FaceProperties;
use crate::parameters::{
    Contact, ControlCoil, Damping, FaceFriction, NeighbourMotion, Parameters, STANDARD_GRAVITY, Start, Wear,
    WedgeBody,
};

const INCH: f64 = 0.0254;
const POUND: f64 = 0.453_592_37;
const POUND_FORCE: f64 = POUND * STANDARD_GRAVITY;

/// Returns the thesis's wedge with this damping, toe angle (rad, positive out) and bolster yaw (rad), the
/// bolster moving by `1 in · sin(2 rad/s · t)`.
#[must_use]
pub fn parameters(damping: Damping, toe: f64, yaw: f64) -> Parameters {
    let (angle, stiffness, free_length, nominal_length): (f64, f64, f64, f64) = match damping {
        Damping::Variable => (32.0, 3000.0, 10.25, 10.25),
        // Preloaded by 3702.2 lbf.
        Damping::Constant => (37.5, 1979.0, 7.25, 7.25 - 3702.2 / 1979.0),
    };
    let friction = FaceFriction {
        coefficient: 0.4,
        law: FrictionLaw::Tanh {
            reference_speed: 0.001 * INCH,
        },
    };
    let mut bolster = NeighbourMotion::fixed();
    bolster.coordinates[2] = Motion::Sine {
        amplitude: INCH,
        angular_frequency: 2.0,
        phase: 0.0,
    };
    bolster.coordinates[5] = Motion::Constant(yaw);
    Parameters {
        damping,
        wedge: WedgeBody {
            angle: angle.to_radians(),
            height: 6.125 * INCH,
            width: 10.5 * INCH,
            mass: 50.0 * POUND,
            inertia: [100.0 * POUND * INCH * INCH; 3],
            center_of_gravity: [-1.0734 * INCH, 0.0, 2.0417 * INCH],
            free: [true, false, true, false, true, true],
        },
        wear: Wear::default(),
        coil: ControlCoil {
            law: CoilLaw::Linear {
                stiffness: stiffness * POUND_FORCE / INCH,
            },
            free_length: free_length * INCH,
            nominal_length: nominal_length * INCH,
            damping: POUND_FORCE / INCH,
            rotational_damping: POUND_FORCE * INCH,
            acts_at: CoilLine::CenterOfGravity,
            pulls: true,
        },
        contact: Contact {
            stiffness: 2.5e5 * POUND_FORCE / INCH,
            damping: 0.0,
        },
        column_friction: friction,
        slope_friction: friction,
        column_face: FaceProperties::default(),
        slope_face: FaceProperties::default(),
        toe,
        toe_pivot: 0.0,
        side_frame: NeighbourMotion::fixed(),
        bolster,
        gravity: STANDARD_GRAVITY,
        start: Start::Rest,
    }
}
