//! The description of a system: bodies, the elements between them, and why they make none.

use thiserror::Error;

use super::AppliedLoad;
use crate::body::Body;
use crate::coil::Coil;
use crate::connection::{Connection, ConnectionError, Options};
use crate::contact::{ContactFace, Interface};
use crate::element::{Element, Placement};
use crate::frame::Frame;
use crate::link::Marker;
use crate::surface::Plane;

/// Bodies and the elements between them.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// All bodies, free and prescribed.
    pub bodies: Vec<Body>,
    /// Gravity in the fixed frame, m/s².
    pub gravity: [f64; 3],
    /// Contact faces: number of the body that carries the points (free), number of the body that carries the
    /// surface, marker of the surface.
    pub faces: Vec<(usize, usize, Marker, ContactFace<Plane>)>,
    /// Refinements of faces, by the number of the face: curved surfaces, friction by speed, load and place,
    /// pads.
    pub interfaces: Vec<(usize, Interface)>,
    /// Coils: number of the carried body (free), number of the body with the seat, marker of the seat.
    pub coils: Vec<(usize, usize, Marker, Coil)>,
    /// Other force elements.
    pub elements: Vec<Placement>,
    /// Connections: laws on differences of coordinates.
    pub connections: Vec<Connection>,
    /// Applied loads.
    pub loads: Vec<AppliedLoad>,
    /// Choices that the laws of connections leave open.
    pub options: Options,
    /// Carriers: see [`Model::add_carrier`]; the number of each and that of the body it goes with.
    pub carriers: Vec<[usize; 2]>,
}

impl Model {
    /// Returns a model of bodies without elements, in a field of gravity (m/s²).
    #[must_use]
    pub fn new(bodies: Vec<Body>, gravity: [f64; 3]) -> Self {
        Self {
            bodies,
            gravity,
            ..Self::default()
        }
    }

    /// Adds the carrier of a body and returns its number: what goes along with the body but does not turn
    /// with its last angle (roll), as bearings do with an axle that spins. Elements act on it as on a body
    /// of its own; their wrench acts on the body's coordinates but for the last angle, by virtual work:
    /// what moment about that axis is left, nothing takes. It has no mass.
    pub fn add_carrier(&mut self, name: &str, of: usize) -> usize {
        let frame = self
            .bodies
            .get(of)
            .map_or(Frame::fixed([0.0; 3], [0.0; 3]), |body| body.frame.clone());
        let initial = self.bodies.get(of).map_or([0.0; 6], |body| body.initial);
        let mut body = Body::prescribed(name, frame);
        body.initial = [initial[0], initial[1], initial[2], 0.0, initial[4], initial[5]];
        self.bodies.push(body);
        let number = self.bodies.len() - 1;
        self.carriers.push([number, of]);
        number
    }

    /// Adds a force element between marker A on one body (its number) and marker B on another. One of the two
    /// bodies must have free coordinates.
    pub fn add(&mut self, element: impl Element, a: (usize, Marker), b: (usize, Marker)) {
        self.elements.push(Placement::new(element, a, b));
    }
}

/// Reasons why a model cannot be assembled.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ModelError {
    /// An element names a body that does not exist.
    #[error("an element refers to body {number}, but there are only {count} (counted from 0)")]
    NoSuchBody {
        /// The number that it names.
        number: usize,
        /// Number of bodies.
        count: usize,
    },
    /// A face or a coil carries a body without free coordinates, or an element joins two such bodies.
    #[error("{body} carries an element, but none of its coordinates is free")]
    NotFree {
        /// The body's name.
        body: String,
    },
    /// An element joins a body to itself.
    #[error("an element joins {body} to itself")]
    Itself {
        /// The body's name.
        body: String,
    },
    /// An interface does not fit its face.
    #[error(
        "an interface is for face {face} of {faces} (counted from 0); it has {factors} factors of friction \
         for {points} points"
    )]
    Interface {
        /// The number of the face that it names.
        face: usize,
        /// Number of faces.
        faces: usize,
        /// Number of factors; none stand for 1 at all points.
        factors: usize,
        /// Number of points of the face.
        points: usize,
    },
    /// A face with an arm of its first tangent is curved.
    #[error(
        "face {face} (counted from 0) has an arm of its first tangent, but is curved; planes can have one"
    )]
    Arm {
        /// The number of the face.
        face: usize,
    },
    /// No coordinate at all is free.
    #[error("no body has a free coordinate: nothing can move")]
    NothingFree,
    /// A load is applied to a coordinate that is not free.
    #[error(
        "a load is applied to {coordinate} of {body}, which is not free: free it, or prescribe its motion"
    )]
    HeldUnderLoad {
        /// The body's name.
        body: String,
        /// The coordinate.
        coordinate: &'static str,
    },
    /// A free body with linearized kinematics has a frame that moves or is turned, or does not start in the
    /// drawn layout.
    #[error(
        "{body} has linearized kinematics; its reference frame must stand still along the fixed axes, and \
         all coordinates start at zero"
    )]
    Layout {
        /// The body's name.
        body: String,
    },
    /// A connection, or a choice that connections leave open, is not admissible.
    #[error(transparent)]
    Connection(#[from] ConnectionError),
    /// A mass or moment of inertia of a body with linearized kinematics is not positive.
    #[error("{what} of {body} is {value}; it must be positive, because {coordinate} is free")]
    Mass {
        /// The body.
        body: String,
        /// Mass or moment of inertia.
        what: &'static str,
        /// Its value, SI.
        value: f64,
        /// The coordinate that needs it.
        coordinate: &'static str,
    },
    /// A carrier goes with a body that has linearized kinematics or is a carrier itself, or a connection
    /// acts on it.
    #[error(
        "{carrier} cannot go with body {body} without its last angle: a carrier goes with a body of finite \
         kinematics, and no connections act on it"
    )]
    Carrier {
        /// The carrier's name.
        carrier: String,
        /// The number of the body.
        body: usize,
    },
    /// A free body has held coordinates in a moving frame.
    #[error(
        "{body} has held coordinates in a reference frame that moves: the work of what holds them would be \
         missing in the energy ledger; free all six coordinates, and hold the body by stiff elements"
    )]
    HeldInMovingFrame {
        /// The body's name.
        body: String,
    },
}
