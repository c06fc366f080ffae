//! The model of a system file.

use std::collections::HashMap;

use mechanics::body::Body;
use mechanics::connection::{
    Accumulator, ColumnFace, Connection, GapDamper, Law, SpringDamper, SurfaceFriction, Wedge,
};
use mechanics::contact::FrictionDirections;
use mechanics::curve::{Curve, CurveError};
use mechanics::motion::Motion;
use mechanics::system::Model;
use thiserror::Error;

use super::choices::Choices;
use super::history::motion;
use super::units::{DEGREE, INCH, INERTIA, MASS, POUND, factors};
use super::yaw::intended_yaw;
use crate::source::Spanned;
use crate::tree::{self, Dof, Element, InputFile, SystemFile, Toe};

/// Standard gravity, m/s², which is the files' 386.09 in/s².
const GRAVITY: f64 = 9.806_65;

/// Reasons why files make no model. Checking the files ([`check`](crate::check)) tells most of these with
/// their places.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum BuildError {
    /// A reference leads nowhere.
    #[error("{by} refers to {what} {number}, which is not there; `wedgelab nucars check` shows where")]
    Missing {
        /// The thing that refers to it.
        by: String,
        /// The kind of the missing thing.
        what: &'static str,
        /// Its number.
        number: u32,
    },
    /// A characteristic does not serve the element that names it.
    #[error("characteristic {number} has the values of another type than {by}")]
    WrongCharacteristic {
        /// The thing that refers to it.
        by: String,
        /// Its number.
        number: u32,
    },
    /// A flexible freedom.
    #[error("{by} has the flexible degree of freedom {dof}; bodies are rigid here")]
    Flexible {
        /// The body or connection.
        by: String,
        /// The freedom.
        dof: Dof,
    },
    /// A function makes no curve.
    #[error("function {number}: {error}")]
    Function {
        /// Its number.
        number: u32,
        /// The reason.
        error: CurveError,
    },
    /// Something needs a speed along the track.
    #[error("{what}, which needs a speed along the track: give one with --speed")]
    NoSpeed {
        /// The thing that needs it.
        what: String,
    },
}

/// A model with the numbers that the files give to its parts.
#[derive(Clone, Debug)]
pub struct Truck {
    /// The model.
    pub model: Model,
    /// For each of the model's bodies its number in the file; 0 is the ground.
    pub bodies: Vec<u32>,
    /// For each of the model's connections its number in the file.
    pub connections: Vec<u32>,
    /// Numbers of connections that were left out for the intended yaw.
    pub left_out: Vec<u32>,
}

impl Truck {
    /// Returns the model of a system file; without an input file its input bodies rest.
    ///
    /// # Errors
    /// [`BuildError`]: an error that a check of the files would have reported with its place.
    pub fn new(
        system: &SystemFile,
        input: Option<&InputFile>,
        choices: &Choices,
    ) -> Result<Self, BuildError> {
        let mut bodies = vec![Body::ground()];
        let mut numbers = vec![0];
        for body in &system.bodies {
            bodies.push(free_body(body)?);
            numbers.push(*body.id);
        }
        for body in &system.input_bodies {
            bodies.push(input_body(body, input, choices)?);
            numbers.push(*body.id);
        }
        let places: HashMap<u32, usize> = numbers.iter().copied().zip(0..).collect();
        let mut connections = Vec::new();
        for connection in &system.connections {
            let by = || format!("connection {}", connection.id);
            let body = |number: u32| {
                places.get(&number).copied().ok_or_else(|| BuildError::Missing {
                    by: by(),
                    what: "body",
                    number,
                })
            };
            connections.push(Connection {
                account: String::new(),
                name: connection.name.trim().to_owned(),
                a: body(*connection.body_a)?,
                b: body(*connection.body_b)?,
                point: point(&connection.position),
                markers: None,
                law: Laws { system, by: by() }.law(&connection.element)?,
            });
        }
        let mut ids: Vec<u32> = system
            .connections
            .iter()
            .map(|connection| *connection.id)
            .collect();
        let mut model = Model {
            bodies,
            connections,
            gravity: [0.0, 0.0, -GRAVITY],
            options: choices.elements.clone(),
            ..Model::default()
        };
        let inputs = system.bodies.len() + 1..model.bodies.len();
        let dropped = intended_yaw(&mut model, inputs, choices.yaw);
        let left_out: Vec<u32> = dropped.iter().map(|number| ids[*number]).collect();
        ids.retain(|id| !left_out.contains(id));
        Ok(Self {
            model,
            bodies: numbers,
            connections: ids,
            left_out,
        })
    }

    /// Returns the place in the model of the body with this number in the file.
    #[must_use]
    pub fn body(&self, number: u32) -> Option<usize> {
        self.bodies.iter().position(|body| *body == number)
    }

    /// Returns the place in the model of the connection with this number in the file.
    #[must_use]
    pub fn connection(&self, number: u32) -> Option<usize> {
        self.connections
            .iter()
            .position(|connection| *connection == number)
    }

    /// Returns the places of the friction wedges in the model.
    pub fn wedges(&self) -> impl Iterator<Item = usize> + '_ {
        let all = self.model.connections.iter().enumerate();
        all.filter_map(|(place, connection)| matches!(connection.law, Law::Wedge(_)).then_some(place))
    }
}

fn point(position: &[Spanned<f64>; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| *position[k] * INCH)
}

/// Returns the coordinate (0 to 5) of a degree of freedom.
fn coordinate(dof: Dof, by: &str) -> Result<usize, BuildError> {
    if dof.kind.is_flexible() {
        return Err(BuildError::Flexible {
            by: by.to_owned(),
            dof,
        });
    }
    Ok(dof.kind as usize)
}

fn free_body(body: &tree::Body) -> Result<Body, BuildError> {
    let by = format!("body {}", body.id);
    let mut free = [false; 6];
    for dof in &body.dofs {
        free[coordinate(**dof, &by)?] = true;
    }
    let inertia = [0, 1, 2].map(|k| *body.inertia[k] * INERTIA);
    Ok(Body::linearized(
        body.name.trim(),
        point(&body.position),
        free,
        *body.mass * MASS,
        inertia,
    ))
}

fn input_body(
    body: &tree::InputBody,
    input: Option<&InputFile>,
    choices: &Choices,
) -> Result<Body, BuildError> {
    let by = format!("input body {}", body.id);
    let position = point(&body.position);
    let mut motions: [Motion; 6] = std::array::from_fn(|_| Motion::Constant(0.0));
    // The first axle is at x = 0; what lies behind it comes there later.
    let delay = if *body.lag {
        let speed = choices.speed.ok_or(BuildError::NoSpeed {
            what: format!("{by} has a lag"),
        })?;
        -position[0] / speed
    } else {
        0.0
    };
    for (dof, number) in body.dofs.iter().zip(&body.histories) {
        let coordinate = coordinate(**dof, &by)?;
        let Some(input) = input else { continue };
        let history = input.history(**number).ok_or_else(|| BuildError::Missing {
            by: by.clone(),
            what: "history",
            number: **number,
        })?;
        let (factor, _) = factors(coordinate);
        motions[coordinate] = motion(history, choices, factor, delay)?;
    }
    Ok(Body::linearized_prescribed(body.name.trim(), position, motions))
}

/// The laws of one connection.
struct Laws<'s> {
    system: &'s SystemFile,
    by: String,
}

impl Laws<'_> {
    fn characteristic(&self, number: u32) -> Result<&tree::Law, BuildError> {
        let found = self
            .system
            .characteristic(number)
            .ok_or_else(|| BuildError::Missing {
                by: self.by.clone(),
                what: "characteristic",
                number,
            })?;
        Ok(&found.law)
    }

    /// Returns a function with its abscissae and ordinates times factors; none if its number is 0.
    fn curve(&self, number: u32, (x, y): (f64, f64)) -> Result<Option<Curve>, BuildError> {
        if number == 0 {
            return Ok(None);
        }
        let function = self.system.function(number).ok_or_else(|| BuildError::Missing {
            by: self.by.clone(),
            what: "function",
            number,
        })?;
        let points = function.points().map(|(own_x, own_y)| [own_x * x, own_y * y]);
        Curve::mirrored_from_origin(points.collect())
            .map(Some)
            .map_err(|error| BuildError::Function { number, error })
    }

    fn wrong(&self, number: u32) -> BuildError {
        BuildError::WrongCharacteristic {
            by: self.by.clone(),
            number,
        }
    }

    fn law(&self, element: &Element) -> Result<Law, BuildError> {
        Ok(match element {
            Element::Parallel(single) => {
                Law::Springs(vec![self.spring(*single.dof, *single.characteristic)?])
            }
            Element::ParallelGroup(group) | Element::CoilGroup(group) => Law::Springs(
                group
                    .dofs
                    .iter()
                    .zip(&group.characteristics)
                    .map(|(dof, number)| self.spring(**dof, **number))
                    .collect::<Result<_, _>>()?,
            ),
            Element::Gap(single) => self.gap(*single.dof, *single.characteristic)?,
            Element::SurfaceFriction(triple) => self.surface(triple)?,
            Element::ViscousWedge(pair) | Element::ViscousToeWedge(pair) | Element::StickSlipWedge(pair) => {
                Law::Wedge(self.wedge(*pair.characteristic)?)
            }
            Element::StickSlipWedge3d(triple) => Law::Wedge(self.wedge(*triple.characteristic)?),
        })
    }

    fn spring(&self, dof: Dof, number: u32) -> Result<(usize, SpringDamper), BuildError> {
        let coordinate = coordinate(dof, &self.by)?;
        let tree::Law::Limits {
            stiffness,
            damping,
            extension,
            compression,
        } = self.characteristic(number)?
        else {
            return Err(self.wrong(number));
        };
        let factors = factors(coordinate);
        Ok((
            coordinate,
            SpringDamper {
                spring: self.curve(**stiffness, factors)?,
                damper: self.curve(**damping, factors)?,
                compression_limit: **compression * factors.1,
                extension_limit: **extension * factors.1,
            },
        ))
    }

    fn gap(&self, dof: Dof, number: u32) -> Result<Law, BuildError> {
        let coordinate = coordinate(dof, &self.by)?;
        let tree::Law::Gap {
            stiffness,
            damping,
            high,
            low,
        } = self.characteristic(number)?
        else {
            return Err(self.wrong(number));
        };
        let factors = factors(coordinate);
        let gap = GapDamper {
            spring: self.curve(**stiffness, factors)?,
            damper: self.curve(**damping, factors)?,
            low: **low * factors.0,
            high: **high * factors.0,
        };
        Ok(Law::Gap(coordinate, gap))
    }

    fn surface(&self, triple: &tree::Triple) -> Result<Law, BuildError> {
        let number = *triple.characteristic;
        let tree::Law::SurfaceFriction {
            normal,
            damping,
            stiffness,
            bristle_damping,
            friction,
        } = self.characteristic(number)?
        else {
            return Err(self.wrong(number));
        };
        let mut coordinates = [0; 3];
        for (place, dof) in coordinates.iter_mut().zip(&triple.dofs) {
            *place = coordinate(**dof, &self.by)?;
        }
        let both = (INCH, POUND);
        Ok(Law::Surface(SurfaceFriction {
            clamped: false,
            directions: FrictionDirections::Two,
            coordinates,
            spring: self
                .curve(**normal, both)?
                .unwrap_or_else(|| Curve::constant(0.0)),
            damper: self.curve(**damping, both)?,
            coefficient: **friction,
            accumulator: bristle(**stiffness, **bristle_damping),
        }))
    }

    /// Returns a wedge whose toe is only a direction. Without a function for its coil the coil's force is
    /// constant: it stands in the bolster.
    fn plain_wedge(
        &self,
        coil: u32,
        angle: f64,
        force: f64,
        toe: Toe,
        [slope_friction, column_friction]: [f64; 2],
        accumulator: Accumulator,
        normal_limit: f64,
    ) -> Result<Wedge, BuildError> {
        Ok(Wedge {
            angle: angle * DEGREE,
            coil: self.coil(coil)?,
            preload: force * POUND,
            coil_in_bolster: coil == 0,
            column: ColumnFace::Plain {
                toe_out: toe == Toe::Out,
            },
            slope_friction,
            column_friction,
            accumulator,
            normal_limit,
        })
    }

    /// Returns the force of a coil over its stroke; zero without a function.
    fn coil(&self, number: u32) -> Result<Curve, BuildError> {
        let curve = self.curve(number, (INCH, POUND))?;
        Ok(curve.unwrap_or_else(|| Curve::constant(0.0)))
    }

    fn wedge(&self, number: u32) -> Result<Wedge, BuildError> {
        match self.characteristic(number)? {
            tree::Law::ViscousWedge {
                coil,
                angle,
                force,
                viscosity,
                friction,
                ..
            } => self.plain_wedge(
                **coil,
                **angle,
                **force,
                Toe::Out,
                [**friction; 2],
                viscous(**viscosity),
                f64::INFINITY,
            ),
            tree::Law::ViscousToeWedge {
                coil,
                angle,
                force,
                viscosity,
                slope_friction,
                column_friction,
                toe,
                ..
            } => self.plain_wedge(
                **coil,
                **angle,
                **force,
                **toe,
                [**slope_friction, **column_friction],
                viscous(**viscosity),
                f64::INFINITY,
            ),
            tree::Law::StickSlipWedge {
                coil,
                angle,
                force,
                stiffness,
                bristle_damping,
                slope_friction,
                column_friction,
                toe,
                normal_limit,
                ..
            } => self.plain_wedge(
                **coil,
                **angle,
                **force,
                **toe,
                [**slope_friction, **column_friction],
                bristle(**stiffness, **bristle_damping),
                **normal_limit * POUND,
            ),
            tree::Law::StickSlipWedge3d {
                coil,
                face,
                angle,
                variable,
                stiffness,
                bristle_damping,
                slope_friction,
                column_friction,
                direction,
                normal_limit,
            } => Ok(Wedge {
                angle: **angle * DEGREE,
                coil: self.coil(**coil)?,
                preload: 0.0,
                coil_in_bolster: !**variable,
                column: ColumnFace::Profile {
                    depth: self.profile(**face)?,
                    direction: **direction,
                },
                slope_friction: **slope_friction,
                column_friction: **column_friction,
                accumulator: bristle(**stiffness, **bristle_damping),
                normal_limit: **normal_limit * POUND,
            }),
            _ => Err(self.wrong(number)),
        }
    }

    /// Returns the depth of a column face over the vertical stroke, both lengths. A face is never mirrored.
    fn profile(&self, number: u32) -> Result<Curve, BuildError> {
        if number == 0 {
            return Ok(Curve::constant(0.0));
        }
        let function = self.system.function(number).ok_or_else(|| BuildError::Missing {
            by: self.by.clone(),
            what: "function",
            number,
        })?;
        let points = function
            .points()
            .map(|(stroke, depth)| [stroke * INCH, depth * INCH]);
        Curve::new(points.collect()).map_err(|error| BuildError::Function { number, error })
    }
}

fn bristle(stiffness: f64, damping: f64) -> Accumulator {
    Accumulator::Bristle {
        stiffness: stiffness * POUND / INCH,
        damping: damping * POUND / INCH,
    }
}

fn viscous(damping: f64) -> Accumulator {
    Accumulator::Viscous {
        damping: damping * POUND / INCH,
    }
}
