//! Parameters of a truck, SI units.
//!
//! Default values are one consistent set: a car of 263,000 lbf on two trucks. Those of bodies, coils, gibs
//! and adapters are from the NUCARS input files of a half-truck (with its bolster and wedge masses separated
//! and its control coils given as bodies' coils), wedges from Steets (2007). Decided where these are silent:
//! the damping of contacts (25 lbf·s/in a corner, so that runs converge), bristles instead of tanh (a loaded
//! truck must not creep), the clearances of pocket sides (0.25 in) and lands (0.21 in: 30 mrad of warp).

use mechanics::curve::Curve;
use mechanics::elements::{ShearSpring, Solid, TableSpring};
use mechanics::motion::Motion;
use wedge::face::FaceProperties;
use wedge::parameters::{
    Contact, ControlCoil as ThesisCoil, Damping, FaceFriction, NeighbourMotion, Start, Wear,
};

use crate::geometry::Geometry;

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
    /// The free coordinates among x, y, z, roll, pitch, yaw; the others are locked. If none is free, the
    /// motion is prescribed.
    pub free: [bool; 6],
    /// The prescribed motion, about the center of gravity if no center is given.
    pub motion: NeighbourMotion,
    /// Applied loads.
    pub applied: Applied,
}

/// Loads over time on the free coordinates of a body: forces along x, y, z at its center of gravity (N),
/// moments about the axes of roll, pitch, yaw (N·m).
pub type Applied = [Motion; 6];

/// Returns no load at all.
#[must_use]
pub fn unloaded() -> Applied {
    std::array::from_fn(|_| Motion::Constant(0.0))
}

/// A side frame.
#[derive(Clone, Debug, PartialEq)]
pub struct SideFrame {
    /// Its mass properties.
    pub body: RigidBody,
    /// As [`Bolster::free`].
    pub free: [bool; 6],
    /// As [`Bolster::motion`].
    pub motion: NeighbourMotion,
    /// Applied loads.
    pub applied: Applied,
}

/// The wheelsets, which are prescribed, and the adapters on them.
#[derive(Clone, Debug, PartialEq)]
pub struct Wheelsets {
    /// Motions of the leading and of the trailing one, about their centers if no others are given.
    pub motions: [NeighbourMotion; 2],
    /// The adapters.
    pub adapter: Adapter,
    /// True if adapters pitch with the side frames on the bearings of axles that spin, so that what they
    /// carry along and up passes through the axle. Else forces along act at the adapters, and what moment
    /// about the axle they have, nothing takes.
    pub pitching: bool,
}

/// A coil spring on a seat: see [`mechanics::elements::ShearSpring`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

/// The adapter between side frame and bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Adapter {
    /// Steel on steel.
    Friction(FrictionAdapter),
    /// An elastomeric pad.
    Pad(AdapterPad),
}

/// An elastomeric pad: two springs beside each other, which push, and hold sideways while they do; no stops.
/// Its stiffness in yaw is the shear stiffness times the square of their half distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdapterPad {
    /// Static load, N.
    pub preload: f64,
    /// Vertical stiffness, N/m.
    pub stiffness: f64,
    /// Stiffness along and across, N/m.
    pub shear_stiffness: f64,
    /// Half the distance of its springs, m.
    pub half_distance: f64,
    /// Damping of each direction, N·s/m.
    pub damping: f64,
}

/// An adapter: two points with friction between side frame and bearing, and stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionAdapter {
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

/// The kind of a wedge's model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WedgeKind {
    /// A rigid body with faces in contact.
    #[default]
    Body,
    /// The industry's element without mass ([`mechanics::connection::Wedge`] with a plane column):
    /// quasi-static balance on both faces, no moments, no sides of the pocket; its coil has neither shear
    /// stiffness nor damping. Its weight is the bolster's.
    Massless,
    /// Two rigid bodies beside each other: [`Split`].
    Split,
}

/// Parameters of a split wedge in addition to those of a one-piece wedge. Each half has half the width, and
/// its share of everything that a whole wedge has: stiffness and bristles of faces, control coil. Each half
/// leans on the slope, the column and the side of the pocket on its side; `slope_across` pushes the halves
/// apart where it is positive, and together where it is negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// Angle of the plane between the halves with the vertical plane along the track, rad; positive: the
    /// outboard half leans over the inboard one.
    pub angle: f64,
    /// Gap between the halves in the nominal layout, m.
    pub gap: f64,
    /// Friction between the halves.
    pub friction: FaceFriction,
    /// The outboard half's share of the mass.
    pub outboard_share: f64,
    /// Distance from the wedge's middle at which each half of the control coil presses, m: a quarter of the
    /// width for a coil under each half, 2/π of its mean radius for one coil under both.
    pub coil_distance: f64,
}

/// A wedge and what it touches.
#[derive(Clone, Debug, PartialEq)]
pub struct Wedge {
    /// The kind of its model.
    pub kind: WedgeKind,
    /// Wedge angle θ between the vertical and the slope in the plane along the track, rad.
    pub angle: f64,
    /// Angle across, rad: that of the slope's normal with the plane along the track. Positive: the slope
    /// pushes the wedge outboard, away from the truck's center line; left and right wedges mirror.
    pub slope_across: f64,
    /// Height of the vertical face, m.
    pub height: f64,
    /// Lateral width, m.
    pub width: f64,
    /// Mass, kg.
    pub mass: f64,
    /// Moments of inertia about the center of gravity (roll, pitch, yaw), kg·m².
    pub inertia: [f64; 3],
    /// The free coordinates among x, y, z, roll, pitch, yaw.
    pub free: [bool; 6],
    /// Toe of its column, rad: out is positive.
    pub toe: f64,
    /// Contact of each corner.
    pub contact: Contact,
    /// Friction on the column.
    pub column_friction: FaceFriction,
    /// Friction on the slope.
    pub slope_friction: FaceFriction,
    /// The vertical face.
    pub column_face: FaceProperties,
    /// The slope face.
    pub slope_face: FaceProperties,
    /// Wear of the column with the wedge's vertical face, and of the pocket's slope with the wedge's slope.
    pub wear: Wear,
    /// The rise that its pocket holds, m: above it the wedge stands out of its pocket, or beyond the mark of
    /// an inspector's gauge. It limits nothing in the model.
    pub rise_limit: f64,
    /// Its control coil.
    pub control_coil: ControlCoil,
    /// The sides of its pocket.
    pub pocket_sides: Clearance,
    /// The plane between the halves of a wedge that is [`WedgeKind::Split`].
    pub split: Split,
}

/// A control coil.
#[derive(Clone, Debug, PartialEq)]
pub enum ControlCoil {
    /// A spring with shear stiffness below the wedge's center of gravity.
    Shear(Spring),
    /// The coil of Steets (2007): its force acts along the line from the seat to the wedge; with the place of
    /// the wedge's center of gravity from the coil's end (x towards the bolster, y, z), m.
    Thesis(ThesisCoil, [f64; 3]),
    /// A spring whose load is a table, below the wedge's center of gravity. Its name is given where it is
    /// mounted.
    Table(TableSpring),
    /// None: it is broken or missing.
    Nothing,
}

/// The load of a car.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lading {
    /// A car of 263,000 lbf.
    Loaded,
    /// The same car without load: 62,600 lbf.
    Empty,
}

/// The load on the truck: half a car's body on the center plate and the side bearings.
#[derive(Clone, Debug, PartialEq)]
pub struct CarBody {
    /// Its mass properties.
    pub body: RigidBody,
    /// The free coordinates among x, y, z, roll, pitch, yaw; the others are locked. Half a car on one truck
    /// falls over in pitch.
    pub free: [bool; 6],
    /// Applied loads.
    pub applied: Applied,
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
    /// Their kind.
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
        /// The hysteresis of its elastomer; none: it gives back all that it takes.
        hysteresis: Option<Hysteresis>,
    },
}

/// The hysteresis of an elastomer: a spring in series with a slider, beside the elastic spring. The force on
/// the way in is greater than that on the way out by twice its limit, whatever the speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hysteresis {
    /// Force at which the slider slips, half the height of the loop, N. It is never more than the spring's
    /// force, so that the bearing does not pull.
    pub limit: f64,
    /// Stiffness of its spring, N/m.
    pub stiffness: f64,
    /// Damping of its spring, N·s/m; it must be positive.
    pub damping: f64,
}

/// A truck.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    /// The bodies on which the control coils stand: the bolster (constant) or the side frames (variable).
    pub damping: Damping,
    /// Gravity, m/s².
    pub gravity: f64,
    /// Where its parts are.
    pub geometry: Geometry,
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
    /// An empirical warp spring in each nest: its moment (N·m) by the yaw of bolster against side frame
    /// (rad). In the industry's models it stands for what massless wedges leave out.
    pub warp_spring: Option<Curve>,
    /// The load on the bolster, as a body of its own.
    pub car_body: Option<CarBody>,
    /// The start of a run.
    pub start: Start,
    /// Height above the nominal layout at which a free bolster starts, with wedges and car body, m.
    pub lift: f64,
}

impl Bolster {
    /// Returns whether its motion is prescribed.
    #[must_use]
    pub fn is_prescribed(&self) -> bool {
        !self.free.contains(&true)
    }
}

impl Spring {
    /// Returns the law of the spring, with its name in results.
    #[must_use]
    pub fn law(&self, name: String) -> ShearSpring {
        ShearSpring {
            name,
            preload: self.preload,
            stiffness: self.stiffness,
            shear_stiffness: self.shear_stiffness,
            damping: self.damping,
            solid: self.solid.map(|[travel, stiffness]| Solid {
                at: -travel,
                stiffness,
            }),
        }
    }
}

impl SideBearing {
    /// Returns its hysteresis, if it has one.
    #[must_use]
    pub fn hysteresis(&self) -> Option<&Hysteresis> {
        match self {
            Self::Roller(_) => None,
            Self::ConstantContact { hysteresis, .. } => hysteresis.as_ref(),
        }
    }
}

impl SideBearings {
    /// Returns the load of both in the nominal layout, N.
    #[must_use]
    pub fn preload(&self) -> f64 {
        match self.kind {
            SideBearing::Roller(_) => 0.0,
            SideBearing::ConstantContact { preload, .. } => 2.0 * preload,
        }
    }
}

impl Adapter {
    /// Returns the vertical stiffness of an adapter, N/m.
    #[must_use]
    pub fn stiffness(&self) -> f64 {
        match self {
            Self::Friction(adapter) => 2.0 * adapter.contact.stiffness,
            Self::Pad(pad) => pad.stiffness,
        }
    }

    /// Returns the load of an adapter in the nominal layout, N.
    #[must_use]
    pub fn preload(&self) -> f64 {
        match self {
            Self::Friction(adapter) => 2.0 * adapter.preload,
            Self::Pad(pad) => pad.preload,
        }
    }
}

impl Parameters {
    /// Returns the displacement of the bolster at the start, x, y, z, m, which wedges and car body take over.
    pub(crate) fn displacement_at_start(&self) -> [f64; 3] {
        let motions = &self.bolster.motion.coordinates;
        let mut start = [0, 1, 2].map(|k| motions[k].evaluate(0.0, 0.0)[0]);
        start[2] += self.lift;
        start
    }

    /// Returns the mass of all wedges, kg.
    #[must_use]
    pub fn wedge_mass(&self) -> f64 {
        self.wedges.iter().map(|wedge| wedge.mass).sum()
    }

    /// Returns the stiffness of the load coils of both nests, N/m.
    #[must_use]
    pub fn load_stiffness(&self) -> f64 {
        let coils = self.load_coils.iter().flatten();
        coils.map(|coil| coil.spring.stiffness).sum()
    }

    /// Returns the force that the load coils of both nests carry in the nominal layout, N.
    #[must_use]
    pub fn load_preload(&self) -> f64 {
        let coils = self.load_coils.iter().flatten();
        coils.map(|coil| coil.spring.preload).sum()
    }

    /// Returns the force of the coils in the nominal layout less the load on them, N: zero for a truck that
    /// rests there. `None` if the bolster's motion is prescribed.
    #[must_use]
    pub fn surplus(&self) -> Option<f64> {
        if self.bolster.is_prescribed() {
            return None;
        }
        let wedges = self.wedge_mass();
        let car = self.car_body.as_ref().map_or(0.0, |car| car.body.mass);
        let weight = (self.bolster.body.mass + wedges + car) * self.gravity;
        let load = self.load_preload();
        let control: f64 = match self.damping {
            Damping::Constant => 0.0,
            Damping::Variable => self.wedges.iter().map(|wedge| wedge.control_coil.preload()).sum(),
        };
        Some(load + control - weight)
    }
}

impl Wedge {
    /// Returns the angles by which wear lifts it, as [`Wear::rise`] takes them, rad.
    #[must_use]
    pub fn rise_angles(&self) -> [f64; 3] {
        [self.angle, self.toe, self.slope_across]
    }

    /// Returns the areas of the vertical face and of the slope face, m².
    #[must_use]
    pub fn face_areas(&self) -> [f64; 2] {
        let column = self.height * self.width;
        let tilt = libm::cos(self.angle) * libm::cos(self.slope_across);
        [column, column / tilt]
    }

    /// Returns the angle across (rad) at which the wedge runs out to an edge at one of its sides: there the
    /// slope's lines on the vertical face and on the bottom have left both.
    #[must_use]
    pub fn greatest_slope_across(&self) -> f64 {
        let width = match self.kind {
            WedgeKind::Split => 0.5 * self.width,
            WedgeKind::Body | WedgeKind::Massless => self.width,
        };
        libm::atan(2.0 * self.height * libm::sin(self.angle) / width)
    }

    /// Returns the place of the center of gravity from the body's origin, in the axes of the truck, m; `end`
    /// is that of the mount. Coordinates are those of the origin: the center of gravity, or the end of the
    /// thesis's coil, which the wedge of Steets (2007) turns about where y is locked.
    pub(crate) fn origin_to_center(&self, end: f64) -> [f64; 3] {
        match self.control_coil {
            ControlCoil::Shear(_) | ControlCoil::Table(_) | ControlCoil::Nothing => [0.0; 3],
            // Wedges at the leading end are turned by half a turn about z.
            ControlCoil::Thesis(_, [x, y, z]) => [-end * x, -end * y, z],
        }
    }
}

impl ControlCoil {
    /// Returns its force in the nominal layout, N.
    #[must_use]
    pub fn preload(&self) -> f64 {
        match self {
            Self::Shear(spring) => spring.preload,
            Self::Table(spring) => spring.load(0.0),
            Self::Nothing => 0.0,
            Self::Thesis(coil, _) => coil.law.force(coil.free_length - coil.nominal_length),
        }
    }
}
