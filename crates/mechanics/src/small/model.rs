//! The description of a system with small displacements. Plain data, SI units; axes x forward, y left, z up.

use thiserror::Error;

use super::law::Accumulator;
use super::law::gap::GapDamper;
use super::law::spring::SpringDamper;
use super::law::surface::SurfaceFriction;
use super::law::wedge::{Column, Wedge};
use super::options::{Branch, Options, SlopeDirection};
use crate::motion::Motion;

/// Names of the coordinates: translations (m), rotations (rad) about x, y, z.
pub const COORDINATES: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];

/// Bodies and the connections between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// All bodies.
    pub bodies: Vec<Body>,
    /// All connections.
    pub connections: Vec<Connection>,
    /// Gravity, m/s², positive downwards.
    pub gravity: f64,
    /// Choices that the laws leave open.
    pub options: Options,
}

/// A body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its name, for messages and outputs; names need not differ.
    pub name: String,
    /// Its centre of gravity in the drawn layout, m.
    pub center_of_gravity: [f64; 3],
    /// What moves it.
    pub kind: Kind,
}

/// What moves a body.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// Forces.
    Free {
        /// Which coordinates (x, y, z, roll, pitch, yaw) are free; the others stay at zero.
        free: [bool; 6],
        /// Mass, kg.
        mass: f64,
        /// Principal moments of inertia about x, y, z, kg·m².
        inertia: [f64; 3],
    },
    /// Prescribed motions of its centre of gravity (x, y, z) and of its rotations (roll, pitch, yaw), from the drawn layout.
    Prescribed {
        /// The motions, m and rad.
        motions: Box<[Motion; 6]>,
    },
}

impl Body {
    /// A free body.
    #[must_use]
    pub fn free(
        name: &str,
        center_of_gravity: [f64; 3],
        free: [bool; 6],
        mass: f64,
        inertia: [f64; 3],
    ) -> Self {
        Self {
            name: name.to_owned(),
            center_of_gravity,
            kind: Kind::Free { free, mass, inertia },
        }
    }

    /// A body with prescribed motions.
    #[must_use]
    pub fn prescribed(name: &str, center_of_gravity: [f64; 3], motions: [Motion; 6]) -> Self {
        Self {
            name: name.to_owned(),
            center_of_gravity,
            kind: Kind::Prescribed {
                motions: Box::new(motions),
            },
        }
    }

    /// A body that does not move, with its centre at the origin.
    #[must_use]
    pub fn ground() -> Self {
        Self::prescribed("ground", [0.0; 3], std::array::from_fn(|_| Motion::Constant(0.0)))
    }
}

/// A connection of two bodies at a point.
///
/// Its stroke in a coordinate is the displacement of the point on body A less that on body B: extension positive. A force f in the
/// stroke's sense acts as -f on body A and as +f on body B.
#[derive(Clone, Debug, PartialEq)]
pub struct Connection {
    /// Its name, for messages and outputs; names need not differ.
    pub name: String,
    /// Number of body A.
    pub a: usize,
    /// Number of body B.
    pub b: usize,
    /// Its point in the drawn layout, m.
    pub point: [f64; 3],
    /// Its law.
    pub law: Law,
}

/// The law of a connection.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// Springs with dampers on single coordinates (0 to 5), independent of each other: types 1, 1.1, 1.3.
    Springs(Vec<(usize, SpringDamper)>),
    /// A damper behind a gap on one coordinate (0 to 5): type 1.2.
    Gap(usize, GapDamper),
    /// Friction on a surface: type 6.5.
    Surface(SurfaceFriction),
    /// A friction wedge: types 6.3, 6.7, 6.8, 6.9.
    Wedge(Wedge),
}

impl Law {
    /// The coordinates (0 to 5) of its components, in the order of outputs.
    ///
    /// A wedge with a profile: vertical, longitudinal, lateral; without: vertical, lateral.
    #[must_use]
    pub fn coordinates(&self) -> Vec<usize> {
        match self {
            Self::Springs(springs) => springs.iter().map(|(coordinate, _)| *coordinate).collect(),
            Self::Gap(coordinate, _) => vec![*coordinate],
            Self::Surface(surface) => surface.coordinates.to_vec(),
            Self::Wedge(wedge) => match wedge.column {
                Column::Plain { .. } => vec![2, 1],
                Column::Profile { .. } => vec![2, 0, 1],
            },
        }
    }

    fn accumulator(&self) -> Option<Accumulator> {
        match self {
            Self::Surface(surface) => Some(surface.accumulator),
            Self::Wedge(wedge) => Some(wedge.accumulator),
            _ => None,
        }
    }
}

/// Why a model makes no system.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ModelError {
    /// A connection names a body that does not exist.
    #[error(
        "connection {index} ({name}) refers to body {number}, but there are only {count} (counted from 0)"
    )]
    NoSuchBody {
        /// Number of the connection.
        index: usize,
        /// Its name.
        name: String,
        /// The number that it names.
        number: usize,
        /// How many bodies there are.
        count: usize,
    },
    /// A connection joins two bodies of which none can move.
    #[error("connection {index} ({name}) joins {a} and {b}, of which none is free to move: leave it out")]
    NothingToMove {
        /// Number of the connection.
        index: usize,
        /// Its name.
        name: String,
        /// Name of body A.
        a: String,
        /// Name of body B.
        b: String,
    },
    /// A connection joins a body to itself.
    #[error("connection {index} ({name}) joins {body} to itself: name two bodies")]
    Itself {
        /// Number of the connection.
        index: usize,
        /// Its name.
        name: String,
        /// The body.
        body: String,
    },
    /// A coordinate number does not exist.
    #[error("connection {index} ({name}) acts on coordinate {coordinate}; it must {must}")]
    Coordinate {
        /// Number of the connection.
        index: usize,
        /// Its name.
        name: String,
        /// The coordinate.
        coordinate: usize,
        /// What it must be.
        must: &'static str,
    },
    /// A parameter of a law is not admissible.
    #[error("{parameter} of connection {index} ({name}) is {value}; it must {must}")]
    Parameter {
        /// Number of the connection.
        index: usize,
        /// Its name.
        name: String,
        /// The parameter.
        parameter: &'static str,
        /// Its value, SI.
        value: f64,
        /// What it must be.
        must: &'static str,
    },
    /// A mass or moment of inertia is not positive.
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
    /// An option is not admissible.
    #[error("the option {name} is {value}; it must {must}")]
    Option {
        /// Its name.
        name: &'static str,
        /// Its value, SI.
        value: f64,
        /// What it must be.
        must: &'static str,
    },
    /// No coordinate at all is free.
    #[error("no body has a free coordinate: nothing can move")]
    NothingFree,
}

impl Model {
    /// Checks numbers and names.
    ///
    /// # Errors
    /// The first thing that makes no system.
    pub fn check(&self) -> Result<(), ModelError> {
        let mut any = false;
        for body in &self.bodies {
            let Kind::Free { free, mass, inertia } = &body.kind else {
                continue;
            };
            for k in (0..6).filter(|k| free[*k]) {
                any = true;
                let (what, value) = match k {
                    0..3 => ("the mass", *mass),
                    _ => ("a moment of inertia", inertia[k - 3]),
                };
                if !(value > 0.0 && value.is_finite()) {
                    return Err(ModelError::Mass {
                        body: body.name.clone(),
                        what,
                        value,
                        coordinate: COORDINATES[k],
                    });
                }
            }
        }
        if !any {
            return Err(ModelError::NothingFree);
        }
        let option = |name, value: f64, holds: bool, must| match holds {
            true => Ok(()),
            false => Err(ModelError::Option { name, value, must }),
        };
        let options = &self.options;
        let (toe, damping) = (options.plain_toe_angle, options.accumulator_damping);
        option(
            "plain_toe_angle",
            toe,
            (0.0..0.5).contains(&toe),
            "lie between 0 and 0.5 rad",
        )?;
        let positive = damping > 0.0 && damping.is_finite();
        option("accumulator_damping", damping, positive, "be positive and finite")?;
        let speeds = [
            match options.branch {
                Branch::Velocity { reference_speed } => reference_speed,
                Branch::FrictionForce => 1.0,
            },
            match options.slope {
                SlopeDirection::OwnSlip { reference_speed } => reference_speed,
                SlopeDirection::Toe => 1.0,
            },
        ];
        for reference_speed in speeds {
            let positive = reference_speed > 0.0 && reference_speed.is_finite();
            option(
                "reference_speed",
                reference_speed,
                positive,
                "be positive and finite",
            )?;
        }
        let connections = self.connections.iter().enumerate();
        connections
            .into_iter()
            .try_for_each(|(index, connection)| self.check_connection(index, connection))
    }

    fn is_free(&self, body: usize) -> bool {
        matches!(&self.bodies[body].kind, Kind::Free { free, .. } if free.contains(&true))
    }

    fn check_connection(&self, index: usize, connection: &Connection) -> Result<(), ModelError> {
        let Connection { name, a, b, law, .. } = connection;
        let name = || name.clone();
        for number in [*a, *b] {
            if number >= self.bodies.len() {
                return Err(ModelError::NoSuchBody {
                    index,
                    name: name(),
                    number,
                    count: self.bodies.len(),
                });
            }
        }
        if a == b {
            return Err(ModelError::Itself {
                index,
                name: name(),
                body: self.bodies[*a].name.clone(),
            });
        }
        if !self.is_free(*a) && !self.is_free(*b) {
            return Err(ModelError::NothingToMove {
                index,
                name: name(),
                a: self.bodies[*a].name.clone(),
                b: self.bodies[*b].name.clone(),
            });
        }
        let coordinates = law.coordinates();
        let (end, must) = match law {
            Law::Surface(_) => (3, "be 0, 1 or 2 (x, y, z), each once"),
            _ => (6, "lie between 0 and 5 (x, y, z, roll, pitch, yaw)"),
        };
        let surface = end == 3;
        for (i, &coordinate) in coordinates.iter().enumerate() {
            if coordinate >= end || (surface && coordinates[..i].contains(&coordinate)) {
                return Err(ModelError::Coordinate {
                    index,
                    name: name(),
                    coordinate,
                    must,
                });
            }
        }
        let rule = |parameter, value: f64, holds: bool, must| match holds {
            true => Ok(()),
            false => Err(ModelError::Parameter {
                index,
                name: name(),
                parameter,
                value,
                must,
            }),
        };
        let finite_positive = |value: f64| value > 0.0 && value.is_finite();
        match law.accumulator() {
            Some(Accumulator::Bristle { stiffness, damping }) => {
                let what = "the accumulator's stiffness";
                rule(what, stiffness, finite_positive(stiffness), "be positive")?;
                let what = "the accumulator's damping";
                rule(what, damping, finite_positive(damping), "be positive")?;
            }
            Some(Accumulator::Viscous { damping }) => {
                rule(
                    "the damping LVB",
                    damping,
                    finite_positive(damping),
                    "be positive",
                )?;
            }
            None => {}
        }
        let coefficient =
            |what, value: f64| rule(what, value, value >= 0.0 && value.is_finite(), "be 0 or more");
        match law {
            Law::Springs(springs) => springs.iter().try_for_each(|(_, spring)| {
                let (low, high) = (spring.compression_limit, spring.extension_limit);
                rule(
                    "the extension limit",
                    high,
                    low <= high,
                    "not lie below the compression limit",
                )
            }),
            Law::Gap(_, gap) => rule(
                "the gap's upper end",
                gap.high,
                gap.low <= gap.high,
                "not lie below the lower end",
            ),
            Law::Surface(surface) => coefficient("the coefficient of friction", surface.coefficient),
            Law::Wedge(wedge) => {
                coefficient("the column's coefficient of friction", wedge.column_friction)?;
                coefficient("the slope's coefficient of friction", wedge.slope_friction)?;
                let angle = wedge.angle;
                let right = 0.5 * std::f64::consts::PI;
                rule(
                    "the wedge angle",
                    angle,
                    angle > 0.0 && angle < right,
                    "lie between 0 and π/2 rad",
                )?;
                let slides = wedge.slope_friction * libm::tan(angle) < 1.0;
                let must = "stay below π/2 less the slope's angle of friction: beyond, the slope cannot carry the wedge";
                rule("the wedge angle", angle, slides, must)?;
                let inclined =
                    |slope: f64| angle - libm::atan(slope) > 0.0 && angle - libm::atan(slope) < right;
                let must = "with the column's inclination lie between 0 and π/2 rad";
                let steepest = match &wedge.column {
                    Column::Plain { .. } => inclined(libm::tan(self.options.plain_toe_angle)),
                    Column::Profile { depth, direction } => {
                        rule(
                            "the column's direction",
                            *direction,
                            direction.abs() == 1.0,
                            "be 1 or -1",
                        )?;
                        depth.slopes().iter().all(|slope| inclined(*slope))
                    }
                };
                rule("the wedge angle", angle, steepest, must)?;
                rule(
                    "the normal limit",
                    wedge.normal_limit,
                    wedge.normal_limit > 0.0,
                    "be positive",
                )
            }
        }
    }
}
