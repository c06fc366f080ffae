//! Parameters of a truck, SI units.
//!
//! Default values are one consistent set: a car of 263,000 lbf on two trucks. Those of bodies, coils, gibs
//! and adapters are from the NUCARS input files of a half-truck (with its bolster and wedge masses separated
//! and its control coils given as bodies' coils), wedges from Steets (2007). Decided where these are silent:
//! the damping of contacts (25 lbf·s/in a corner, so that runs converge), bristles instead of tanh (a loaded
//! truck must not creep), the clearances of pocket sides (0.25 in) and lands (0.21 in: 30 mrad of warp).

use std::f64::consts::PI;

use mechanics::friction::FrictionLaw;
use mechanics::motion::Motion;
use wedge::parameters::{Contact, Damping, FaceFriction, STANDARD_GRAVITY};

use crate::units::{INCH, POUND, POUND_FORCE, POUND_INCH, POUND_PER_INCH, inches};

/// Mass and principal moments of inertia about the center of gravity, along the truck's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidBody {
    /// Mass, kg.
    pub mass: f64,
    /// Moments of inertia about x, y, z, kg·m².
    pub inertia: [f64; 3],
    /// Height of the center of gravity above the top of rail, m.
    pub height: f64,
}

/// The bolster, alone or with a half car that is rigid with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Bolster {
    /// Its mass properties.
    pub body: RigidBody,
    /// Which of x, y, z, roll, pitch, yaw are free; all others follow [`Bolster::motion`] (if none is free)
    /// or are held.
    pub free: [bool; 6],
    /// Prescribed motions of x, y, z (m), roll, pitch, yaw (rad) of its center of gravity, if nothing is free.
    pub motion: [Motion; 6],
    /// Height above the nominal layout from which a free bolster starts, with the wedges, m.
    pub lift: f64,
}

/// A side frame.
#[derive(Clone, Debug, PartialEq)]
pub struct SideFrame {
    /// Its mass properties.
    pub body: RigidBody,
    /// Prescribed motions of its center of gravity; `None`: all six coordinates are free.
    pub motion: Option<[Motion; 6]>,
}

/// The wheelsets, which are prescribed, and the adapters on them.
#[derive(Clone, Debug, PartialEq)]
pub struct Wheelsets {
    /// Motions of the leading and of the trailing one.
    pub motions: [[Motion; 6]; 2],
    /// The adapters.
    pub adapter: Adapter,
}

/// A coil spring on a seat: see [`mechanics::elements::ShearSpring`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// Load in the nominal layout, N.
    pub preload: f64,
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Shear stiffness, N/m.
    pub shear_stiffness: f64,
    /// Damping, N·s/m.
    pub damping: f64,
    /// Travel to solid height from the nominal layout, m (positive), and the stiffness beyond, N/m.
    pub solid: Option<[f64; 2]>,
}

/// A load coil, or a group of them, at its place in the nest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NestCoil {
    /// From the nest's center, x and y, m.
    pub place: [f64; 2],
    /// The coil.
    pub spring: Spring,
}

/// Clearance to each side, then a spring and a damper that never pull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// Clearance to each side, m.
    pub clearance: f64,
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N·s/m.
    pub damping: f64,
}

/// An adapter: two points with friction between side frame and bearing, and stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adapter {
    /// Static load of a point, N.
    pub preload: f64,
    /// Stiffness (N/m) and damping (N·s/m) of a point.
    pub contact: Contact,
    /// Friction of the two points together.
    pub friction: FaceFriction,
    /// Two stops a side along x.
    pub longitudinal: Clearance,
    /// One stop along y.
    pub lateral: Clearance,
}

/// A wedge and what it touches.
#[derive(Clone, Debug, PartialEq)]
pub struct Wedge {
    /// Wedge angle θ between the vertical and the slope, rad.
    pub angle: f64,
    /// Height of the vertical face, m.
    pub height: f64,
    /// Lateral width, m.
    pub width: f64,
    /// Mass, kg.
    pub mass: f64,
    /// Moments of inertia about the center of gravity (roll, pitch, yaw), kg·m².
    pub inertia: [f64; 3],
    /// Which of x, y, z, roll, pitch, yaw are free.
    pub free: [bool; 6],
    /// Toe of its column, rad: out is positive.
    pub toe: f64,
    /// Contact of each corner.
    pub contact: Contact,
    /// Friction on the column.
    pub column_friction: FaceFriction,
    /// Friction on the slope.
    pub slope_friction: FaceFriction,
    /// Its control coil.
    pub control_coil: Spring,
    /// The sides of its pocket.
    pub pocket_sides: Clearance,
}

/// What stands on the truck: half a car's body on the center plate and the side bearings.
#[derive(Clone, Debug, PartialEq)]
pub struct CarBody {
    /// Its mass properties.
    pub body: RigidBody,
    /// Which of x, y, z, roll, pitch, yaw are free; the others are held. Half a car on one truck falls over in
    /// pitch.
    pub free: [bool; 6],
    /// The center plate.
    pub center_plate: CenterPlate,
    /// The side bearings.
    pub side_bearings: SideBearings,
}

/// A flat center plate: rings of points with friction, and a rim.
#[derive(Clone, Debug, PartialEq)]
pub struct CenterPlate {
    /// Height of its surface above the top of rail, m.
    pub height: f64,
    /// Radii of the rings, m.
    pub rings: Vec<f64>,
    /// Points of a ring.
    pub points: usize,
    /// Contact of each point.
    pub contact: Contact,
    /// Friction of all points together.
    pub friction: FaceFriction,
    /// The rim: its clearance is on the radius.
    pub rim: Clearance,
}

/// Side bearings.
#[derive(Clone, Debug, PartialEq)]
pub struct SideBearings {
    /// From the truck's center, y, m.
    pub distance: f64,
    /// What they are.
    pub kind: SideBearing,
}

/// A side bearing.
#[derive(Clone, Debug, PartialEq)]
pub enum SideBearing {
    /// A roller: a vertical clearance, no friction.
    Roller(Clearance),
    /// Constant contact: a preloaded spring that goes solid after a travel, with friction.
    ConstantContact {
        /// Load in the nominal layout, N.
        preload: f64,
        /// Stiffness (N/m) until solid, and damping.
        contact: Contact,
        /// Travel until solid, m.
        travel: f64,
        /// Stiffness (N/m) and damping when solid.
        solid: Contact,
        /// Friction.
        friction: FaceFriction,
    },
}

impl SideBearings {
    /// Returns rollers with a clearance of 0.25 in.
    #[must_use]
    pub fn rollers() -> Self {
        Self {
            distance: 25.0 * INCH,
            kind: SideBearing::Roller(clearance([0.25, 1e6, 500.0])),
        }
    }

    /// Returns constant-contact side bearings of 6,000 lbf with 5/8 in of travel.
    #[must_use]
    pub fn constant_contact() -> Self {
        Self {
            distance: 25.0 * INCH,
            kind: SideBearing::ConstantContact {
                preload: 6000.0 * POUND_FORCE,
                contact: contact(6000.0, 0.0),
                travel: 0.625 * INCH,
                solid: contact(1e6, 500.0),
                friction: bristle(0.3, 1e5, 100.0),
            },
        }
    }

    /// Returns the load of both in the nominal layout, N.
    #[must_use]
    pub fn preload(&self) -> f64 {
        match self.kind {
            SideBearing::Roller(_) => 0.0,
            SideBearing::ConstantContact { preload, .. } => 2.0 * preload,
        }
    }
}

impl CarBody {
    /// Returns half of the loaded body of a car of 263,000 lbf, free to bounce and to roll, on a center plate of
    /// 14 in with a friction of 0.2.
    ///
    /// The plate's stiffness (3e6 lbf/in a point) and the rim's clearance (0.1875 in) are guesses.
    #[must_use]
    pub fn loaded(side_bearings: SideBearings) -> Self {
        Self {
            body: body(121_730.0, [0.905e6, 8.12e6, 8.12e6], 83.75),
            free: [false, false, true, true, false, false],
            center_plate: CenterPlate {
                height: 30.0 * INCH,
                rings: vec![7.0 * INCH, 7.0 * INCH / 3.0],
                points: 8,
                contact: contact(3e6, 500.0),
                friction: bristle(0.2, 16e6, 16e3),
                rim: clearance([0.1875, 1e6, 500.0]),
            },
            side_bearings,
        }
    }
}

/// A truck.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    /// Where the control coils stand: on the bolster (constant) or on the side frames (variable).
    pub damping: Damping,
    /// Gravity, m/s².
    pub gravity: f64,
    /// From the truck's center to the side frames (y), to the wedges' and to the axles' places (x), m.
    pub distances: [f64; 3],
    /// The bolster.
    pub bolster: Bolster,
    /// Left and right side frame.
    pub side_frames: [SideFrame; 2],
    /// The wheelsets; `None`: wheelsets and adapters are left out.
    pub wheelsets: Option<Wheelsets>,
    /// The wedges, in the order of [`WEDGE_NAMES`](crate::WEDGE_NAMES).
    pub wedges: [Wedge; 4],
    /// Load coils of the left and of the right nest.
    pub load_coils: [Vec<NestCoil>; 2],
    /// Lateral stop between bolster and side frame.
    pub gib: Clearance,
    /// Longitudinal stops between bolster and side frame, four a column.
    pub lands: Clearance,
    /// What stands on the bolster, as a body of its own.
    pub car_body: Option<CarBody>,
}

/// No motion.
pub(crate) fn still() -> [Motion; 6] {
    std::array::from_fn(|_| Motion::Constant(0.0))
}

/// Weight lbf, moments of inertia lbf·in·s², height in.
pub(crate) fn body(weight: f64, inertia: [f64; 3], height: f64) -> RigidBody {
    RigidBody {
        mass: weight * POUND,
        inertia: inertia.map(|i| i * POUND_INCH),
        height: height * INCH,
    }
}

/// Clearance in, stiffness lbf/in, damping lbf·s/in.
fn clearance([clearance, stiffness, damping]: [f64; 3]) -> Clearance {
    Clearance {
        clearance: clearance * INCH,
        stiffness: stiffness * POUND_PER_INCH,
        damping: damping * POUND_PER_INCH,
    }
}

/// Preload lbf, stiffness and shear stiffness lbf/in, damping lbf·s/in; travel to solid height, in.
fn spring([preload, stiffness, shear, damping]: [f64; 4], solid: Option<f64>) -> Spring {
    Spring {
        preload: preload * POUND_FORCE,
        stiffness: stiffness * POUND_PER_INCH,
        shear_stiffness: shear * POUND_PER_INCH,
        damping: damping * POUND_PER_INCH,
        solid: solid.map(|travel| [travel * INCH, 250_000.0 * POUND_PER_INCH]),
    }
}

/// Stiffness lbf/in and damping lbf·s/in of a point.
fn contact(stiffness: f64, damping: f64) -> Contact {
    Contact {
        stiffness: stiffness * POUND_PER_INCH,
        damping: damping * POUND_PER_INCH,
    }
}

/// Bristle stiffness lbf/in and damping lbf·s/in of a face.
fn bristle(coefficient: f64, stiffness: f64, damping: f64) -> FaceFriction {
    FaceFriction {
        coefficient,
        law: FrictionLaw::Bristle {
            stiffness: stiffness * POUND_PER_INCH,
            damping: damping * POUND_PER_INCH,
        },
    }
}

impl Parameters {
    /// Returns a new truck of a loaded car of 263,000 lbf: bolster held, side frames free on wheelsets that
    /// stand still.
    #[must_use]
    pub fn new(damping: Damping) -> Self {
        let (degrees, coil, control) = match damping {
            Damping::Constant => (
                37.5,
                spring([15_403.8, 6468.7, 4450.0, 0.0], Some(1.306)),
                spring([3702.2, 1979.0, 1346.0, 1.0], None),
            ),
            Damping::Variable => (
                32.0,
                spring([12_252.1, 5369.5, 3616.0, 0.0], Some(1.406)),
                spring([6303.0, 1937.0, 1317.0, 1.0], Some(1.4085)),
            ),
        };
        let angle = degrees * PI / 180.0;
        let prism = body(50.0, [1.461, 0.3756, 1.295], 18.0);
        let wedge = Wedge {
            angle,
            height: 6.125 * INCH,
            width: 10.5 * INCH,
            mass: prism.mass,
            inertia: prism.inertia,
            free: [true; 6],
            toe: 0.0,
            contact: contact(2.5e5, 25.0),
            column_friction: bristle(0.4, 1e6, 1e3),
            slope_friction: bristle(0.4, 1e6, 1e3),
            control_coil: control,
            pocket_sides: clearance([0.25, 1e6, 100.0]),
        };
        let quarter = |x: f64, y: f64| NestCoil {
            place: inches([3.75 * x, 3.75 * y]),
            spring: coil,
        };
        let nest = vec![
            quarter(1.0, 1.0),
            quarter(1.0, -1.0),
            quarter(-1.0, 1.0),
            quarter(-1.0, -1.0),
        ];
        let side_frame = SideFrame {
            body: body(1150.5, [900.0, 1370.0, 1370.0], 18.0),
            motion: None,
        };
        Self {
            damping,
            gravity: STANDARD_GRAVITY,
            distances: inches([39.5, 8.5, 35.0]),
            bolster: Bolster {
                body: body(1300.0, [2915.0, 142.0, 2930.0], 22.0),
                free: [false; 6],
                motion: still(),
                lift: 0.0,
            },
            side_frames: [side_frame.clone(), side_frame],
            wheelsets: Some(Wheelsets {
                motions: [still(), still()],
                adapter: Adapter {
                    preload: 15_691.0 * POUND_FORCE,
                    contact: contact(5e5, 1000.0),
                    friction: bristle(0.5, 2e6, 2e3),
                    longitudinal: clearance([0.0468, 5e5, 50.0]),
                    lateral: clearance([0.25, 1e6, 100.0]),
                },
            }),
            wedges: [wedge.clone(), wedge.clone(), wedge.clone(), wedge],
            load_coils: [nest.clone(), nest],
            gib: clearance([0.5, 4e6, 1000.0]),
            lands: clearance([0.21, 5e5, 50.0]),
            car_body: None,
        }
    }

    /// Sets the friction of all wedges on both faces.
    #[must_use]
    pub fn with_wedge_friction(mut self, coefficient: f64) -> Self {
        for wedge in &mut self.wedges {
            wedge.column_friction.coefficient = coefficient;
            wedge.slope_friction.coefficient = coefficient;
        }
        self
    }

    /// Returns the displacement of the bolster at the start, x, y, z, m, which the wedges take over.
    pub(crate) fn start(&self) -> [f64; 3] {
        let mut start = [0, 1, 2].map(|k| self.bolster.motion[k].evaluate(0.0, 0.0)[0]);
        start[2] += self.bolster.lift;
        start
    }
}
