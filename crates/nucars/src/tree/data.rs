//! The data file (`.DAT`): which results are written.

use std::fmt;

use super::RawSection;
use super::system::Dof;
use crate::source::{At, Spanned};

/// A data file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DataFile {
    /// The requests in the order of the file, also those switched off.
    pub sections: Vec<DataSection>,
    /// Sections with unknown keywords.
    pub other: Vec<RawSection>,
}

impl DataFile {
    /// Returns the requests that are not switched off.
    pub fn active(&self) -> impl Iterator<Item = &DataSection> {
        self.sections.iter().filter(|section| !section.off)
    }
}

/// A section of a data file.
#[derive(Clone, Debug, PartialEq)]
pub struct DataSection {
    /// The keyword's place.
    pub keyword: At,
    /// Switched off by `$` before the `\`: NUCARS does not read it. What it says is kept as far as it can be
    /// read.
    pub off: bool,
    /// The request.
    pub request: DataRequest,
}

/// The request of a section. Counts are as typed and may disagree with the lists in sections that are
/// switched off; `None`: there is none.
#[derive(Clone, Debug, PartialEq)]
pub enum DataRequest {
    /// `\EQUILIBRIUM`.
    Equilibrium,
    /// `\DOF ...`: motions of and forces on bodies.
    Dofs {
        /// The quantity.
        quantity: DofQuantity,
        /// Number of all degrees of freedom.
        count: Option<Spanned<u32>>,
        /// Bodies with their degrees of freedom.
        bodies: Vec<BodyDofs>,
    },
    /// `\CONNECTION FORCE`, `STROKE`, `VELOCITY`.
    Components {
        /// The quantity.
        quantity: ElementQuantity,
        /// Number of components.
        count: Option<Spanned<u32>>,
        /// The components.
        components: Vec<Spanned<Component>>,
    },
    /// `\CONNECTION FORCE SUM`.
    Sums {
        /// Number of sums that NUCARS reads.
        count: Option<Spanned<u32>>,
        /// All that stand there, also those beyond the count.
        sums: Vec<Sum>,
    },
    /// `\CURVATURE` or `\SUPERELEVATION`: a count, and columns of the track file.
    Track {
        /// Superelevation instead of curvature.
        superelevation: bool,
        /// The numbers as typed.
        values: Vec<Spanned<u32>>,
    },
}

impl DataRequest {
    /// Returns the keyword without `\`.
    pub fn keyword(&self) -> &'static str {
        match self {
            DataRequest::Equilibrium => "EQUILIBRIUM",
            DataRequest::Dofs { quantity, .. } => quantity.keyword(),
            DataRequest::Components { quantity, .. } => quantity.keyword(),
            DataRequest::Sums { .. } => "CONNECTION FORCE SUM",
            DataRequest::Track {
                superelevation: false,
                ..
            } => "CURVATURE",
            DataRequest::Track {
                superelevation: true, ..
            } => "SUPERELEVATION",
        }
    }
}

/// A quantity of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DofQuantity {
    /// Displacement, in or rad.
    Displacement,
    /// Velocity, in/s or rad/s.
    Velocity,
    /// Acceleration.
    Acceleration,
    /// Force, lb or in·lb.
    Force,
}

impl DofQuantity {
    /// Returns the section's keyword without `\`.
    pub fn keyword(self) -> &'static str {
        match self {
            DofQuantity::Displacement => "DOF DISPLACEMENT",
            DofQuantity::Velocity => "DOF VELOCITY",
            DofQuantity::Acceleration => "DOF ACCELERATION",
            DofQuantity::Force => "DOF FORCE",
        }
    }
}

/// A quantity of a connection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementQuantity {
    /// Force, lb or in·lb.
    Force,
    /// Stroke, in or rad.
    Stroke,
    /// Rate of the stroke.
    Velocity,
}

impl ElementQuantity {
    /// Returns the section's keyword without `\`.
    pub fn keyword(self) -> &'static str {
        match self {
            ElementQuantity::Force => "CONNECTION FORCE",
            ElementQuantity::Stroke => "CONNECTION STROKE",
            ElementQuantity::Velocity => "CONNECTION VELOCITY",
        }
    }
}

/// Degrees of freedom of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyDofs {
    /// The body.
    pub body: Spanned<u32>,
    /// The degrees of freedom.
    pub dofs: Vec<Spanned<Dof>>,
}

/// A component of a connection, `127.1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Component {
    /// The connection.
    pub connection: u32,
    /// The position in its list of directions, from 1.
    pub position: u32,
}

impl fmt::Display for Component {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}.{}", self.connection, self.position)
    }
}

/// A weighted sum of forces.
#[derive(Clone, Debug, PartialEq)]
pub struct Sum {
    /// Its name, 25 characters.
    pub name: Spanned<String>,
    /// The terms of the sum.
    pub terms: Terms,
    /// The factor of each term.
    pub coefficients: Vec<Spanned<f64>>,
    /// The whole record.
    pub span: At,
}

/// The terms of a sum.
#[derive(Clone, Debug, PartialEq)]
pub enum Terms {
    /// Kind 1: forces of connections.
    Components(Vec<Spanned<Component>>),
    /// Kind 2: earlier sums, by their numbers.
    Sums(Vec<Spanned<u32>>),
}

impl Terms {
    /// Returns the kind as in the file.
    pub fn kind(&self) -> u32 {
        match self {
            Terms::Components(_) => 1,
            Terms::Sums(_) => 2,
        }
    }
}
