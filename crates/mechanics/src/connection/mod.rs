//! Connections: the element laws of the industry's vehicle dynamics programs, functions of differences of
//! coordinates.
//!
//! The coordinates of each body are displacements of its origin and small rotations from the drawn layout
//! along the fixed axes; levers are those of the layout. The programs modeled here give all bodies
//! linearized kinematics: the mass matrix is diagonal and constant, there are no gyroscopic terms and no
//! geometric stiffness of weights (a heavy body on soft pitch springs would otherwise topple, which it does
//! not there). A body with finite kinematics takes connections too; then its rotations must stay small. Axes:
//! x forward, y left, z up. A connection acts on extensions (displacement of its point on body A less that on
//! body B, extension positive): a force f in the direction of the extension acts as -f on A and +f on B.
//!
//! Conversion of connections of the comparison program's files to [`Law`]s (its tables give ordinates first;
//! read with [`Curve::mirrored_from_origin`](crate::curve::Curve::mirrored_from_origin) as `[abscissa,
//! ordinate]`; no table: none, or zero):
//!
//! | type | law |
//! |---|---|
//! | 1, 1.1, 1.3 | [`Law::Springs`], one [`SpringDamper`] a coordinate, with its two limits |
//! | 1.2 | [`Law::Gap`] |
//! | 6.3 | [`Law::Wedge`], [`ColumnFace::Plain`] toe out, [`Accumulator::Viscous`], both coefficients the same |
//! | 6.7 | the same with two coefficients and a toe direction |
//! | 6.5 | [`Law::Surface`] with [`Accumulator::Bristle`], coordinates 2, 0, 1 |
//! | 6.8 | [`Law::Wedge`], [`ColumnFace::Plain`], [`Accumulator::Bristle`]; a constant force is `preload` with a zero `coil`, and stands in the bolster |
//! | 6.9 | [`Law::Wedge`], [`ColumnFace::Profile`], [`Accumulator::Bristle`], no `preload` |

mod accumulator;
mod assembler;
mod between;
mod between_jacobian;
mod check;
mod contact_states;
mod forces;
mod gap;
mod jacobian;
mod observe;
mod options;
mod site;
mod spring;
mod surface;
mod wedge;

use numerics::partitioned::Partitioned;

use crate::link::Marker;

use gap::Gap;
use site::Site;
use spring::Spring;
use surface::Surface;
use wedge::WedgeLaw;

pub use accumulator::Accumulator;
pub(crate) use accumulator::FrictionRule;
pub(crate) use assembler::ConnectionAssembler;
pub use check::ConnectionError;
pub use contact_states::{CLOSING_FORCE, OPENING_FORCE};
pub(crate) use contact_states::{FRICTION_VARIABLES, FrictionVariables};
pub use gap::GapDamper;
pub(crate) use jacobian::JacobianInputs;
pub use observe::ConnectionState;
pub use options::{Branch, GapTension, NegativeRise, Options, SlopeDirection};
pub use spring::SpringDamper;
pub use surface::SurfaceFriction;
pub use wedge::{ColumnFace, Wedge, WedgeState};

/// A connection of two bodies at a point.
///
/// Its extension in a coordinate is the displacement of the point on body A less that on body B: extension
/// positive. A force f in the direction of the extension acts as -f on body A and as +f on body B.
#[derive(Clone, Debug, PartialEq)]
pub struct Connection {
    /// Its name, for messages and outputs; names need not differ.
    pub name: String,
    /// Under which name its losses stand in the energy ledger; empty: together with those of all others of
    /// their kind.
    pub account: String,
    /// Number of body A.
    pub a: usize,
    /// Number of body B.
    pub b: usize,
    /// Its point in the drawn layout, m.
    pub point: [f64; 3],
    /// Markers on body A and body B, which coincide in the drawn layout. With them extensions are those of
    /// marker A relative to marker B along the axes of marker B, at any heading; without, differences of
    /// coordinates.
    pub markers: Option<[Marker; 2]>,
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
    /// Returns the coordinates (0 to 5) of its components, in the order of outputs.
    ///
    /// A wedge with a profile: vertical, longitudinal, lateral; without: vertical, lateral.
    #[must_use]
    pub fn coordinates(&self) -> Vec<usize> {
        match self {
            Self::Springs(springs) => springs.iter().map(|(coordinate, _)| *coordinate).collect(),
            Self::Gap(coordinate, _) => vec![*coordinate],
            Self::Surface(surface) => surface.coordinates.to_vec(),
            Self::Wedge(wedge) => match wedge.column {
                ColumnFace::Plain { .. } => vec![2, 1],
                ColumnFace::Profile { .. } => vec![2, 0, 1],
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

/// An element on one coordinate.
#[derive(Clone, Debug)]
struct Axis<L> {
    law: L,
    site: Site<1, 1>,
}

/// An element on three coordinates, with friction in two of them.
#[derive(Clone, Debug)]
struct Spatial<L> {
    law: L,
    site: Site<3, 3>,
    /// First internal state, if it has any.
    internal: Option<usize>,
    /// Rows of the powers and of the work by the pair of internal states.
    internal_rows: [Option<usize>; 4],
    /// Its number among the connections with friction.
    discrete_state: usize,
}

/// The rules by which friction is evaluated in each kind of element.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FrictionRules {
    pub surfaces: FrictionRule,
    pub wedges: FrictionRule,
}

/// Assembled connections, ready to be evaluated.
#[derive(Clone, Debug, Default)]
pub(crate) struct Connections {
    all: Vec<Connection>,
    springs: Vec<Axis<Spring>>,
    gaps: Vec<Axis<Gap>>,
    surfaces: Vec<Spatial<Surface>>,
    wedges: Vec<Spatial<WedgeLaw>>,
    /// The connections with friction, whose contact states are recorded.
    pub discrete_states: Vec<usize>,
    /// The rules of friction in surfaces and in wedges.
    pub friction_rules: FrictionRules,
}

impl Connections {
    /// Returns the connections.
    pub fn all(&self) -> &[Connection] {
        &self.all
    }

    /// Returns whether there is none.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Looks up the coupling blocks of all elements.
    pub fn find_pairs(&mut self, jacobian: &Partitioned) {
        self.springs.iter_mut().for_each(|e| e.site.find_pairs(jacobian));
        self.gaps.iter_mut().for_each(|e| e.site.find_pairs(jacobian));
        self.surfaces.iter_mut().for_each(|e| e.site.find_pairs(jacobian));
        self.wedges.iter_mut().for_each(|e| e.site.find_pairs(jacobian));
    }

    /// Returns the first of the two accumulator deflections of a connection among the internal states, if it
    /// has any.
    pub fn deflection_of(&self, connection: usize) -> Option<usize> {
        let (_, internal) = self
            .frictional()
            .find(|(site, _)| site.connection == connection)?;
        internal
    }

    /// Returns stiffness (N/m) and damping (N·s/m) of a connection's bristle, if it has one.
    pub fn bristle_of(&self, connection: usize) -> Option<[f64; 2]> {
        let surfaces = self
            .surfaces
            .iter()
            .map(|e| (e.site.connection, e.law.accumulator));
        let wedges = self.wedges.iter().map(|e| (e.site.connection, e.law.accumulator));
        let (_, own) = surfaces.chain(wedges).find(|(own, _)| *own == connection)?;
        match own {
            Accumulator::Bristle { stiffness, damping } => Some([stiffness, damping]),
            Accumulator::Viscous { .. } => None,
        }
    }

    /// Returns the sites and first internal states of all connections with friction.
    pub fn frictional(&self) -> impl Iterator<Item = (&Site<3, 3>, Option<usize>)> {
        let surfaces = self.surfaces.iter().map(|e| (&e.site, e.internal));
        surfaces.chain(self.wedges.iter().map(|e| (&e.site, e.internal)))
    }
}
