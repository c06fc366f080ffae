//! The system file (`.SYS`): bodies, connections, their laws.

use std::fmt;

use super::element::{Characteristic, DirectionGroup, DirectionPair, Single, Triple};
use super::{RawSection, Title};
use crate::source::{At, Spanned};

/// A system file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SystemFile {
    /// `\SYSTEM TITLE`.
    pub title: Title,
    /// `\BODY DATA`.
    pub bodies: Vec<Body>,
    /// `\INPUT BODY DATA`: bodies without mass whose motion is prescribed.
    pub input_bodies: Vec<InputBody>,
    /// `\CONNECTION DATA`.
    pub connections: Vec<Connection>,
    /// `\CHARACTERISTIC DATA`.
    pub characteristics: Vec<Characteristic>,
    /// `\PWL DATA`.
    pub piecewise_linear: Vec<PiecewiseLinear>,
    /// Sections that are switched off or unknown.
    pub other: Vec<RawSection>,
    pub(crate) lost: Lost,
}

/// Sections of which a record could not be read: what refers to them is not checked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Lost {
    pub bodies: bool,
    pub connections: bool,
    pub characteristics: bool,
    pub piecewise_linear: bool,
}

impl SystemFile {
    /// Returns the body with this number; the first one if there are several.
    pub fn body(&self, id: u32) -> Option<&Body> {
        self.bodies.iter().find(|body| *body.id == id)
    }

    /// Returns the input body with this number.
    pub fn input_body(&self, id: u32) -> Option<&InputBody> {
        self.input_bodies.iter().find(|body| *body.id == id)
    }

    /// Returns the connection with this number.
    pub fn connection(&self, id: u32) -> Option<&Connection> {
        self.connections.iter().find(|connection| *connection.id == id)
    }

    /// Returns the characteristic with this number.
    pub fn characteristic(&self, id: u32) -> Option<&Characteristic> {
        self.characteristics
            .iter()
            .find(|characteristic| *characteristic.id == id)
    }

    /// Returns the piecewise linear function with this number.
    pub fn function(&self, id: u32) -> Option<&PiecewiseLinear> {
        self.piecewise_linear.iter().find(|function| *function.id == id)
    }
}

/// The kind of degree of freedom, by the code in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DofKind {
    /// 1: x, forward, in.
    X,
    /// 2: y, to the left, in.
    Y,
    /// 3: z, up, in.
    Z,
    /// 4: φ, roll about x, rad.
    Roll,
    /// 5: θ, pitch about y, rad.
    Pitch,
    /// 6: ψ, yaw about z, rad.
    Yaw,
    /// 7: ε about x, flexible.
    FlexX,
    /// 8: ε about y, flexible.
    FlexY,
    /// 9: ε about z, flexible.
    FlexZ,
}

impl DofKind {
    /// All of them, by their codes 1 to 9.
    pub const ALL: [DofKind; 9] = [
        DofKind::X,
        DofKind::Y,
        DofKind::Z,
        DofKind::Roll,
        DofKind::Pitch,
        DofKind::Yaw,
        DofKind::FlexX,
        DofKind::FlexY,
        DofKind::FlexZ,
    ];

    /// Returns the kind with this code, 1 to 9.
    pub fn from_code(code: u32) -> Option<Self> {
        let index = usize::try_from(code).ok()?.checked_sub(1)?;
        DofKind::ALL.get(index).copied()
    }

    /// Returns its code, 1 to 9.
    pub fn code(self) -> u32 {
        self as u32 + 1
    }

    /// Returns its short name.
    pub fn name(self) -> &'static str {
        ["x", "y", "z", "roll", "pitch", "yaw", "eps x", "eps y", "eps z"][self as usize]
    }

    /// Returns true for a displacement in x, y or z; the others are rotations or modes.
    pub fn is_translation(self) -> bool {
        self <= DofKind::Z
    }

    /// Returns true for a rotation about x, y or z.
    pub fn is_rotation(self) -> bool {
        (DofKind::Roll..=DofKind::Yaw).contains(&self)
    }

    /// Returns true for a mode of a flexible body.
    pub fn is_flexible(self) -> bool {
        self >= DofKind::FlexX
    }
}

/// A degree of freedom.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Dof {
    /// The motion.
    pub kind: DofKind,
    /// The mode of a flexible body (`7.01` is mode 1), or 0.
    pub mode: u8,
}

impl From<DofKind> for Dof {
    fn from(kind: DofKind) -> Self {
        Dof { kind, mode: 0 }
    }
}

impl fmt::Display for Dof {
    /// Writes the value as in the file.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.mode {
            0 => write!(out, "{}", self.kind.code()),
            mode => write!(out, "{}.{mode:02}", self.kind.code()),
        }
    }
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its number, which connections and data files use.
    pub id: Spanned<u32>,
    /// Its name, 15 characters with blanks.
    pub name: Spanned<String>,
    /// Centre of gravity x, y, z, in.
    pub position: [Spanned<f64>; 3],
    /// Its degrees of freedom.
    pub dofs: Vec<Spanned<Dof>>,
    /// Mass, lb·s²/in.
    pub mass: Spanned<f64>,
    /// Moments of inertia about x, y, z through the centre of gravity, lb·in·s².
    pub inertia: [Spanned<f64>; 3],
    /// The whole record.
    pub span: At,
}

/// A body without mass whose motion is prescribed.
#[derive(Clone, Debug, PartialEq)]
pub struct InputBody {
    /// Its number, in one sequence with the bodies'.
    pub id: Spanned<u32>,
    /// Its name.
    pub name: Spanned<String>,
    /// Position x, y, z, in.
    pub position: [Spanned<f64>; 3],
    /// Its degrees of freedom.
    pub dofs: Vec<Spanned<Dof>>,
    /// The input history that drives each of them.
    pub histories: Vec<Spanned<u32>>,
    /// True if the histories come late by position over speed.
    pub lag: Spanned<bool>,
    /// The whole record.
    pub span: At,
}

/// A force element between two bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct Connection {
    /// Its number, which data files use.
    pub id: Spanned<u32>,
    /// Its name; not unique.
    pub name: Spanned<String>,
    /// The place of the type in the file.
    pub kind: At,
    /// The body A; 0 is the ground. Strokes are A's displacement less B's.
    pub body_a: Spanned<u32>,
    /// The body B; 0 is the ground.
    pub body_b: Spanned<u32>,
    /// The point on both bodies, undeformed, x, y, z, in.
    pub position: [Spanned<f64>; 3],
    /// Type, directions and characteristics.
    pub element: Element,
    /// The whole record.
    pub span: At,
}

/// The types of connections, with what their records say after the position.
#[derive(Clone, Debug, PartialEq)]
pub enum Element {
    /// 1: spring and damper in parallel in one direction.
    Parallel(Single),
    /// 1.1: the same in several directions, which do not act on one another.
    ParallelGroup(DirectionGroup),
    /// 1.2: spring and damper that act outside a gap.
    Gap(Single),
    /// 1.3: group of coils: lateral, vertical, roll.
    CoilGroup(DirectionGroup),
    /// 6.3: wedge with viscous friction: vertical, lateral.
    ViscousWedge(DirectionPair),
    /// 6.5: friction on a surface: normal direction, two directions of friction.
    SurfaceFriction(Triple),
    /// 6.7: wedge with viscous friction, toe and two coefficients: vertical, lateral.
    ViscousToeWedge(DirectionPair),
    /// 6.8: wedge with stick-slip: vertical, lateral.
    StickSlipWedge(DirectionPair),
    /// 6.9: wedge with stick-slip: vertical, longitudinal, lateral.
    StickSlipWedge3d(Triple),
}

impl Element {
    /// Returns the type as in the file.
    pub fn code(&self) -> &'static str {
        match self {
            Element::Parallel(_) => "1",
            Element::ParallelGroup(_) => "1.1",
            Element::Gap(_) => "1.2",
            Element::CoilGroup(_) => "1.3",
            Element::ViscousWedge(_) => "6.3",
            Element::SurfaceFriction(_) => "6.5",
            Element::ViscousToeWedge(_) => "6.7",
            Element::StickSlipWedge(_) => "6.8",
            Element::StickSlipWedge3d(_) => "6.9",
        }
    }

    /// Returns the name of the type.
    pub fn name(&self) -> &'static str {
        match self {
            Element::Parallel(_) => "spring and damper",
            Element::ParallelGroup(_) => "springs and dampers",
            Element::Gap(_) => "spring and damper with gap",
            Element::CoilGroup(_) => "coil group",
            Element::ViscousWedge(_) => "viscous wedge",
            Element::SurfaceFriction(_) => "surface friction",
            Element::ViscousToeWedge(_) => "viscous wedge with toe",
            Element::StickSlipWedge(_) => "stick-slip wedge",
            Element::StickSlipWedge3d(_) => "stick-slip wedge, 3 directions",
        }
    }

    /// Returns its directions in the order of the file: component `.1` is the first.
    pub fn dofs(&self) -> &[Spanned<Dof>] {
        match self {
            Element::Parallel(element) | Element::Gap(element) => std::slice::from_ref(&element.dof),
            Element::ParallelGroup(element) | Element::CoilGroup(element) => &element.dofs,
            Element::ViscousWedge(element)
            | Element::ViscousToeWedge(element)
            | Element::StickSlipWedge(element) => &element.dofs,
            Element::SurfaceFriction(element) | Element::StickSlipWedge3d(element) => &element.dofs,
        }
    }

    /// Returns its characteristics: one for each direction (types 1, 1.1, 1.2, 1.3), or one for all.
    pub fn characteristics(&self) -> &[Spanned<u32>] {
        match self {
            Element::Parallel(element) | Element::Gap(element) => {
                std::slice::from_ref(&element.characteristic)
            }
            Element::ParallelGroup(element) | Element::CoilGroup(element) => &element.characteristics,
            Element::ViscousWedge(element)
            | Element::ViscousToeWedge(element)
            | Element::StickSlipWedge(element) => std::slice::from_ref(&element.characteristic),
            Element::SurfaceFriction(element) | Element::StickSlipWedge3d(element) => {
                std::slice::from_ref(&element.characteristic)
            }
        }
    }
}

/// A piecewise linear function; in the file the ordinates stand before the abscissae.
#[derive(Clone, Debug, PartialEq)]
pub struct PiecewiseLinear {
    /// Its number, which characteristics use.
    pub id: Spanned<u32>,
    /// Values: lb, in·lb, lb·s/in; for a column face: in.
    pub ordinates: Vec<Spanned<f64>>,
    /// Arguments, strictly increasing: in, rad, or their rates; as many as ordinates.
    pub abscissae: Vec<Spanned<f64>>,
    /// The whole record.
    pub span: At,
}

impl PiecewiseLinear {
    /// Returns whether it is mirrored, f(-s) = -f(s): its first point is (0, 0). A first abscissa of 0 alone
    /// does not do it.
    pub fn is_mirrored(&self) -> bool {
        let zero = |list: &[Spanned<f64>]| list.first().is_some_and(|first| **first == 0.0);
        zero(&self.ordinates) && zero(&self.abscissae)
    }

    /// Returns the points (abscissa, ordinate).
    pub fn points(&self) -> impl DoubleEndedIterator<Item = (f64, f64)> + ExactSizeIterator + '_ {
        let pairs = self.abscissae.iter().zip(&self.ordinates);
        pairs.map(|(abscissa, ordinate)| (**abscissa, **ordinate))
    }

    /// Returns the value at an argument: linear between the points, the outermost slopes go on outside,
    /// mirrored if [`is_mirrored`](Self::is_mirrored). 0 without points; a single point is a constant.
    pub fn value(&self, at: f64) -> f64 {
        if at < 0.0 && self.is_mirrored() {
            return -self.value(-at);
        }
        let (low, high) = match self.abscissae.len().min(self.ordinates.len()) {
            0 => return 0.0,
            1 => return *self.ordinates[0],
            points => {
                let above = self.abscissae[..points].partition_point(|abscissa| **abscissa <= at);
                let high = above.clamp(1, points - 1);
                (high - 1, high)
            }
        };
        let (x, y) = (*self.abscissae[low], *self.ordinates[low]);
        y + self.slope_between(low, high) * (at - x)
    }

    /// Returns the slope right of an argument. 0 where there is none.
    pub fn slope(&self, at: f64) -> f64 {
        if at < 0.0 && self.is_mirrored() {
            return self.slope(-at);
        }
        let points = self.abscissae.len().min(self.ordinates.len());
        if points < 2 {
            return 0.0;
        }
        let above = self.abscissae[..points].partition_point(|abscissa| **abscissa <= at);
        let high = above.clamp(1, points - 1);
        self.slope_between(high - 1, high)
    }

    fn slope_between(&self, low: usize, high: usize) -> f64 {
        let run = *self.abscissae[high] - *self.abscissae[low];
        if run > 0.0 {
            (*self.ordinates[high] - *self.ordinates[low]) / run
        } else {
            0.0
        }
    }
}
