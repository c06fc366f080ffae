//! Conditions on connections and on the choices that their laws leave open.

use thiserror::Error;

use super::accumulator::Accumulator;
use super::options::{Branch, Options, SlopeDirection};
use super::wedge::ColumnFace;
use super::{Connection, Law};
use crate::body::Body;
use crate::contact::FrictionDirections;

/// Reasons why a connection makes no element.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ConnectionError {
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
        /// Number of bodies.
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
    /// A connection joins a body whose coordinates are not displacements from the drawn layout.
    #[error(
        "connection {index} ({name}) joins {body}, whose coordinates are no displacements along x, y, z: \
         its reference frame must not be turned, and must stand still if the body has free coordinates; or \
         give markers, or use a contact face, a coil or another element"
    )]
    NotDisplacements {
        /// Number of the connection.
        index: usize,
        /// Its name.
        name: String,
        /// The body.
        body: String,
    },
    /// A connection between markers joins a body whose reference frame moves.
    #[error(
        "connection {index} ({name}) between markers joins {body}, whose reference frame moves; it must \
         stand still: move the body by a load or an element instead, or leave the markers out"
    )]
    MovingFrame {
        /// Number of the connection.
        index: usize,
        /// Its name.
        name: String,
        /// The body.
        body: String,
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
        /// The condition.
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
        /// The condition.
        must: &'static str,
    },
    /// An option is not admissible.
    #[error("the option {name} is {value}; it must {must}")]
    Option {
        /// Its name.
        name: &'static str,
        /// Its value, SI.
        value: f64,
        /// The condition.
        must: &'static str,
    },
}

impl Options {
    /// Checks the choices.
    ///
    /// # Errors
    /// One is not admissible.
    pub(crate) fn check(&self) -> Result<(), ConnectionError> {
        let option = |name, value: f64, holds: bool, must| match holds {
            true => Ok(()),
            false => Err(ConnectionError::Option { name, value, must }),
        };
        let (toe, damping) = (self.plain_toe_angle, self.accumulator_damping);
        option(
            "plain_toe_angle",
            toe,
            (0.0..0.5).contains(&toe),
            "lie between 0 and 0.5 rad",
        )?;
        let positive = damping > 0.0 && damping.is_finite();
        option("accumulator_damping", damping, positive, "be positive and finite")?;
        let speeds = [
            match self.branch {
                Branch::Velocity { reference_speed } => reference_speed,
                Branch::FrictionForce => 1.0,
            },
            match self.slope {
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
        Ok(())
    }
}

impl Connection {
    /// Checks connection number `index` of a model.
    ///
    /// # Errors
    /// The first thing that makes no element.
    pub(crate) fn check(
        &self,
        index: usize,
        bodies: &[Body],
        options: &Options,
    ) -> Result<(), ConnectionError> {
        let Connection { name, a, b, law, .. } = self;
        let name = || name.clone();
        for number in [*a, *b] {
            if number >= bodies.len() {
                return Err(ConnectionError::NoSuchBody {
                    index,
                    name: name(),
                    number,
                    count: bodies.len(),
                });
            }
        }
        if a == b {
            return Err(ConnectionError::Itself {
                index,
                name: name(),
                body: bodies[*a].name.clone(),
            });
        }
        let displaced = |body: usize| {
            let Body { frame, .. } = &bodies[body];
            frame.orientation == [0.0; 3] && (bodies[body].is_prescribed() || frame.is_fixed())
        };
        let moving = |body: usize| !bodies[body].frame.is_fixed();
        if let Some(body) = [*a, *b]
            .into_iter()
            .find(|body| self.markers.is_some() && moving(*body))
        {
            return Err(ConnectionError::MovingFrame {
                index,
                name: name(),
                body: bodies[body].name.clone(),
            });
        }
        let along_axes = |body: usize| self.markers.is_some() || displaced(body);
        if let Some(body) = [*a, *b].into_iter().find(|body| !along_axes(*body)) {
            return Err(ConnectionError::NotDisplacements {
                index,
                name: name(),
                body: bodies[body].name.clone(),
            });
        }
        // Friction has a history between bodies that are moved, too.
        let free = [*a, *b].iter().any(|body| !bodies[*body].is_prescribed());
        if !free && law.accumulator().is_none() {
            return Err(ConnectionError::NothingToMove {
                index,
                name: name(),
                a: bodies[*a].name.clone(),
                b: bodies[*b].name.clone(),
            });
        }
        let coordinates = law.coordinates();
        let (end, must) = match law {
            Law::Surface(_) => (3, "be 0, 1 or 2 (x, y, z), each once"),
            _ => (6, "lie between 0 and 5 (x, y, z, roll, pitch, yaw)"),
        };
        // Friction in one direction may act along the normal coordinate.
        let twice = |i: usize| match law {
            Law::Surface(own) => {
                let along = i == 2 && own.directions == FrictionDirections::One;
                coordinates[usize::from(along)..i].contains(&coordinates[i])
            }
            _ => false,
        };
        for (i, &coordinate) in coordinates.iter().enumerate() {
            if coordinate >= end || twice(i) {
                return Err(ConnectionError::Coordinate {
                    index,
                    name: name(),
                    coordinate,
                    must,
                });
            }
        }
        let rule = |parameter, value: f64, holds: bool, must| match holds {
            true => Ok(()),
            false => Err(ConnectionError::Parameter {
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
                let must = "stay below π/2 less the slope's angle of friction: beyond, the slope cannot \
                            carry the wedge";
                rule("the wedge angle", angle, slides, must)?;
                let inclined =
                    |slope: f64| angle - libm::atan(slope) > 0.0 && angle - libm::atan(slope) < right;
                let must = "with the column's inclination lie between 0 and π/2 rad";
                let steepest = match &wedge.column {
                    ColumnFace::Plain { .. } => inclined(libm::tan(options.plain_toe_angle)),
                    ColumnFace::Profile { depth, direction } => {
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
