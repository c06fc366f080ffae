//! The case as typed: what a case file holds once it is complete.
//!
//! Quantities keep the text they were written with. A document need not be valid; reading one,
//! and making a [`Case`](super::Case) of one, checks it.

use super::face::FaceSection;
use super::face_values::Surface;
use super::motion::{CaseMotion, MotionProfile};
use super::rise::RiseSection;
use super::section::{Names, name_of};
use super::table::QuantityTable;
use integrate::Method;
use mechanics::contact::FrictionDirections;
use quantity::{Quantity, System};

/// A complete case as typed.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseDocument {
    /// A name that can be the name of a folder.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// `[wedge]`
    pub wedge: WedgeSection,
    /// `[control_coil]`
    pub control_coil: CoilSection,
    /// `[contact]`
    pub contact: ContactSection,
    /// `[friction]`
    pub friction: FrictionSection,
    /// `[column_face]` and `[slope_face]`
    pub faces: [FaceSection; 2],
    /// `toe` of `[side_frame]`
    pub toe: Toe,
    /// `toe_pivot` of `[side_frame]`
    pub toe_pivot: Quantity,
    /// The motions of `[side_frame]`
    pub side_frame: NeighbourSection,
    /// `[bolster]`
    pub bolster: NeighbourSection,
    /// `[environment]`
    pub environment: EnvironmentSection,
    /// `[simulation]`
    pub simulation: SimulationSection,
}

impl CaseDocument {
    /// The sections of a case file.
    pub(crate) const SECTIONS: [&str; 10] = [
        "wedge",
        "control_coil",
        "contact",
        "friction",
        "column_face",
        "slope_face",
        "side_frame",
        "bolster",
        "environment",
        "simulation",
    ];

    /// Returns the rows of all its tables.
    pub(super) fn table_rows(&self) -> usize {
        let coil = match &self.control_coil.force {
            CoilForce::Table(table) => table.rows.len(),
            CoilForce::Stiffness(_) => 0,
        };
        let neighbours = [&self.side_frame, &self.bolster].into_iter();
        let tables = neighbours
            .flat_map(|neighbour| &neighbour.coordinates)
            .flat_map(CaseMotion::tables);
        let surfaces = self
            .faces
            .iter()
            .flat_map(|face| [&face.wedge_surface, &face.counterface]);
        let maps = self
            .faces
            .iter()
            .flat_map(|face| face.wedge_wear.iter().chain(&face.counterface_wear));
        coil + surfaces.map(Surface::rows).sum::<usize>()
            + maps.map(|map| map.rows.len()).sum::<usize>()
            + tables.map(|table| table.rows.len()).sum::<usize>()
    }
}

/// `[wedge]`
#[derive(Clone, Debug, PartialEq)]
pub struct WedgeSection {
    /// The body on which the control coil stands.
    pub damping: Damping,
    /// Angle between the slope and the vertical.
    pub angle: Quantity,
    /// Height of the vertical face.
    pub height: Quantity,
    /// Lateral width.
    pub width: Quantity,
    /// Weight, a force under standard gravity.
    pub weight: Quantity,
    /// Moments of inertia about the centre of gravity: roll, pitch, yaw.
    pub inertia: [Quantity; 3],
    /// Centre of gravity from the wedge frame's origin: x, y, z.
    pub center_of_gravity: [Quantity; 3],
    /// Depth of wear of the column and the wedge's vertical face together.
    pub column_wear: Quantity,
    /// Depth of wear of the pocket's slope and the wedge's slope face together.
    pub slope_wear: Quantity,
    /// Both by the wedge's rise.
    pub rise: RiseSection,
    /// Coordinates that are free; the others are held.
    pub free_coordinates: Vec<Coordinate>,
}

/// `[control_coil]`
#[derive(Clone, Debug, PartialEq)]
pub struct CoilSection {
    /// Force by compression.
    pub force: CoilForce,
    /// Length without force.
    pub free_length: Quantity,
    /// Length in the nominal position.
    pub nominal_length: Quantity,
    /// Viscous damping along the coil.
    pub damping: Quantity,
    /// Viscous damping of the wedge's rotations.
    pub rotational_damping: Quantity,
    /// Line of action.
    pub acts_at: ActsAt,
    /// True if it can pull.
    pub pulls: bool,
}

/// The force of a coil by its compression.
#[derive(Clone, Debug, PartialEq)]
pub enum CoilForce {
    /// A constant stiffness.
    Stiffness(Quantity),
    /// Compression against force.
    Table(QuantityTable),
}

/// `[contact]`
#[derive(Clone, Debug, PartialEq)]
pub struct ContactSection {
    /// Stiffness per corner.
    pub stiffness: Quantity,
    /// Damping per corner.
    pub damping: Quantity,
}

/// `[friction]`
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionSection {
    /// Law at the column.
    pub column_law: FrictionLaw,
    /// Law at the slope.
    pub slope_law: FrictionLaw,
    /// Coefficient of friction at the column.
    pub column: f64,
    /// Coefficient of friction at the slope.
    pub slope: f64,
    /// The directions in which it acts on a face.
    pub directions: FrictionDirections,
    /// Speed v0 of the tanh law.
    pub reference_speed: Quantity,
    /// Tangential stiffness of the bristle law, per face.
    pub bristle_stiffness: Quantity,
    /// Tangential damping of the bristle law, per face.
    pub bristle_damping: Quantity,
}

/// The toe angle of the column, written with its direction in words.
#[derive(Clone, Debug, PartialEq)]
pub struct Toe {
    /// Its size, never negative.
    pub angle: Quantity,
    /// Its direction; may be left out for a toe of zero.
    pub direction: Option<ToeDirection>,
}

impl Toe {
    /// Returns the angle in rad, positive for toe out (eq. 5-1 of the thesis).
    pub fn to_si(&self) -> f64 {
        match self.direction {
            Some(ToeDirection::In) => -self.angle.to_si(),
            _ => self.angle.to_si(),
        }
    }

    /// Returns it as written in a case file: `0.2 deg out`.
    pub fn text(&self) -> String {
        match self.direction {
            Some(ToeDirection::In) => format!("{} in", self.angle),
            Some(ToeDirection::Out) => format!("{} out", self.angle),
            None => self.angle.to_string(),
        }
    }
}

/// The direction in which the gap between column and bolster opens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToeDirection {
    /// It closes downwards.
    In,
    /// It opens downwards.
    Out,
}

impl ToeDirection {
    /// Returns its name in case files.
    pub fn name(self) -> &'static str {
        match self {
            ToeDirection::In => "in",
            ToeDirection::Out => "out",
        }
    }
}

/// The motion of the side frame or the bolster.
#[derive(Clone, Debug, PartialEq)]
pub struct NeighbourSection {
    /// The point it turns about; left out, the centre of its face.
    pub center: Option<[Quantity; 3]>,
    /// Motions in the order of [`NeighbourSection::COORDINATES`].
    pub coordinates: [CaseMotion; 6],
}

impl NeighbourSection {
    /// The keys of the coordinates: three displacements, three angles.
    pub const COORDINATES: [&str; 6] = ["longitudinal", "lateral", "vertical", "roll", "pitch", "yaw"];
}

/// `[environment]`
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentSection {
    /// Gravity.
    pub gravity: Quantity,
}

/// `[simulation]`
#[derive(Clone, Debug, PartialEq)]
pub struct SimulationSection {
    /// Time the run ends.
    pub duration: Quantity,
    /// Time between two rows of the result.
    pub output_interval: Quantity,
    /// Relative tolerance of the integrator, between 0 and 1.
    pub relative_tolerance: f64,
    /// The start of the run.
    pub start: Start,
    /// Units of the result.
    pub output_units: System,
    /// Integration method.
    pub method: Method,
}

/// Defines an enum whose variants have names in case files.
macro_rules! named {
    ($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident = $text:literal,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $name {
            $($(#[$variant_doc])* $variant,)+
        }

        impl $name {
            pub(crate) const NAMES: Names<Self> = &[$(($text, Self::$variant)),+];

            /// Returns its name in case files.
            pub fn name(self) -> &'static str {
                name_of(Self::NAMES, &self)
            }
        }
    };
}

named! {
    /// The body on which the control coil stands.
    Damping {
        /// On the side frame: the coil force follows the bolster's travel.
        Variable = "variable",
        /// In the bolster: the coil force is nearly constant.
        Constant = "constant",
    }
}

named! {
    /// A coordinate of the wedge.
    Coordinate {
        /// Longitudinal.
        X = "x",
        /// Lateral.
        Y = "y",
        /// Vertical.
        Z = "z",
        /// About x.
        Roll = "roll",
        /// About y.
        Pitch = "pitch",
        /// About z.
        Yaw = "yaw",
    }
}

named! {
    /// Line of action of the coil.
    ActsAt {
        /// Through the centre of gravity.
        CenterOfGravity = "center_of_gravity",
        /// At the coil's end.
        Seat = "seat",
    }
}

named! {
    /// A friction law.
    FrictionLaw {
        /// Smoothed Coulomb friction; creeps.
        Tanh = "tanh",
        /// An elastic element in series with the slider; holds.
        Bristle = "bristle",
    }
}

named! {
    /// The start of a run.
    Start {
        /// The nominal position, at rest.
        Rest = "rest",
        /// The same, with the neighbours moved apart until nothing penetrates.
        Touching = "touching",
        /// Static equilibrium.
        Equilibrium = "equilibrium",
    }
}

/// Names of the unit systems.
pub(crate) const SYSTEMS: Names<System> = &[("us", System::Us), ("si", System::Si)];

/// Names of the directions in which friction acts on a face.
pub(crate) const DIRECTIONS: Names<FrictionDirections> =
    &[("two", FrictionDirections::Two), ("one", FrictionDirections::One)];

/// Names of the integration methods.
pub(crate) const METHODS: Names<Method> = &[
    ("rodas5p", Method::Rodas5P),
    ("tr-bdf2", Method::TrBdf2),
    ("esdirk3", Method::Esdirk3),
];

/// Names of the ramp profiles.
pub(crate) const PROFILES: Names<MotionProfile> = &[
    ("smooth", MotionProfile::Smooth),
    ("linear", MotionProfile::Linear),
    ("half_cosine", MotionProfile::HalfCosine),
];
