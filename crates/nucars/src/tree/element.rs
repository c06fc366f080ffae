//! Directions of elements and their characteristics.

use super::system::{Dof, Element};
use crate::source::{At, Spanned};

/// One direction with its characteristic.
#[derive(Clone, Debug, PartialEq)]
pub struct Single {
    /// The direction.
    pub dof: Spanned<Dof>,
    /// Its characteristic.
    pub characteristic: Spanned<u32>,
}

/// Several directions, each with a characteristic of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionGroup {
    /// The directions.
    pub dofs: Vec<Spanned<Dof>>,
    /// The characteristic of each.
    pub characteristics: Vec<Spanned<u32>>,
}

/// Two directions with one characteristic: vertical, lateral.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionPair {
    /// Vertical, lateral.
    pub dofs: [Spanned<Dof>; 2],
    /// The characteristic of both.
    pub characteristic: Spanned<u32>,
}

/// Three directions with one characteristic.
#[derive(Clone, Debug, PartialEq)]
pub struct Triple {
    /// Type 6.5: normal, then two of friction. Type 6.9: vertical, longitudinal, lateral.
    pub dofs: [Spanned<Dof>; 3],
    /// The characteristic of all.
    pub characteristic: Spanned<u32>,
}

/// A record of `\CHARACTERISTIC DATA`. Its form follows from the type of the connections that use it.
#[derive(Clone, Debug, PartialEq)]
pub struct Characteristic {
    /// Its number, which connections use.
    pub id: Spanned<u32>,
    /// Its law.
    pub law: Law,
    /// The whole record.
    pub span: At,
}

/// The direction in which the column's face of a two-dimensional wedge leans.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Toe {
    /// `.T.`: the gap opens downwards.
    Out,
    /// `.F.`: the gap closes downwards.
    In,
}

/// The forms of a characteristic. Functions are numbers of piecewise linear functions; 0 is none.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// Types 1, 1.1, 1.3: a force K(s) + C(v), held between two limits.
    Limits {
        /// K, lb or in·lb against in or rad.
        stiffness: Spanned<u32>,
        /// C against in/s or rad/s.
        damping: Spanned<u32>,
        /// The largest force, in extension, lb or in·lb.
        extension: Spanned<f64>,
        /// The least force, in compression, lb or in·lb.
        compression: Spanned<f64>,
    },
    /// Type 1.2: a force K(s) + C(v) only outside a gap of strokes.
    Gap {
        /// K.
        stiffness: Spanned<u32>,
        /// C.
        damping: Spanned<u32>,
        /// Upper end of the gap, in or rad.
        high: Spanned<f64>,
        /// Lower end of the gap, in or rad.
        low: Spanned<f64>,
    },
    /// Type 6.3: F = viscosity · v, at most μN.
    ViscousWedge {
        /// The coil's function.
        coil: Spanned<u32>,
        /// C.
        damping: Spanned<u32>,
        /// Wedge angle from the vertical, degrees.
        angle: Spanned<f64>,
        /// The coil's force besides its function, lb.
        force: Spanned<f64>,
        /// LVB, taken as lb·s/in.
        viscosity: Spanned<f64>,
        /// μ on both faces.
        friction: Spanned<f64>,
    },
    /// Type 6.7: the same with two coefficients and toe.
    ViscousToeWedge {
        /// The coil's function.
        coil: Spanned<u32>,
        /// C.
        damping: Spanned<u32>,
        /// Wedge angle from the vertical, degrees.
        angle: Spanned<f64>,
        /// The coil's force besides its function, lb.
        force: Spanned<f64>,
        /// LVB, taken as lb·s/in.
        viscosity: Spanned<f64>,
        /// Mu1.
        slope_friction: Spanned<f64>,
        /// Mu2.
        column_friction: Spanned<f64>,
        /// Toe.
        toe: Spanned<Toe>,
    },
    /// Type 6.5: friction under the normal force of a function.
    SurfaceFriction {
        /// The normal force's function.
        normal: Spanned<u32>,
        /// C.
        damping: Spanned<u32>,
        /// Ka, stiffness of the friction force, lb/in.
        stiffness: Spanned<f64>,
        /// Ca, damping of the friction force, lb·s/in.
        bristle_damping: Spanned<f64>,
        /// μ.
        friction: Spanned<f64>,
    },
    /// Type 6.8: wedge with stick-slip, vertical and lateral.
    StickSlipWedge {
        /// The coil's function; 0: the force is constant.
        coil: Spanned<u32>,
        /// C.
        damping: Spanned<u32>,
        /// Wedge angle from the vertical, degrees.
        angle: Spanned<f64>,
        /// The coil's force besides its function, lb.
        force: Spanned<f64>,
        /// Ka, lb/in.
        stiffness: Spanned<f64>,
        /// Ca, lb·s/in.
        bristle_damping: Spanned<f64>,
        /// Mu1.
        slope_friction: Spanned<f64>,
        /// Mu2.
        column_friction: Spanned<f64>,
        /// Toe.
        toe: Spanned<Toe>,
        /// FWNMAX, the largest normal force at the column, lb.
        normal_limit: Spanned<f64>,
    },
    /// Type 6.9: wedge with stick-slip in three directions.
    StickSlipWedge3d {
        /// The coil's function.
        coil: Spanned<u32>,
        /// The profile of the column's face: depth, in, against vertical stroke, in.
        face: Spanned<u32>,
        /// Wedge angle from the vertical, degrees.
        angle: Spanned<f64>,
        /// V/C: whether damping is variable (`.T.`, coil on the side frame) or constant (coil in the
        /// bolster).
        variable: Spanned<bool>,
        /// Ka, lb/in.
        stiffness: Spanned<f64>,
        /// Ca, lb·s/in.
        bristle_damping: Spanned<f64>,
        /// Mu1.
        slope_friction: Spanned<f64>,
        /// Mu2.
        column_friction: Spanned<f64>,
        /// XDIR: +1 for leading wedges, -1 for trailing ones.
        direction: Spanned<f64>,
        /// FWNMAX, lb.
        normal_limit: Spanned<f64>,
    },
    /// No connection uses it, so its form is not known.
    Unused {
        /// The values of its line.
        values: Vec<Spanned<UnknownValue>>,
    },
}

/// A value whose meaning is not known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum UnknownValue {
    /// A number.
    Number(f64),
    /// A truth value.
    Logical(bool),
}

impl Law {
    /// Returns whether a connection of this type can use it.
    pub fn serves(&self, element: &Element) -> bool {
        match self {
            Law::Limits { .. } => {
                matches!(
                    element,
                    Element::Parallel(_) | Element::ParallelGroup(_) | Element::CoilGroup(_)
                )
            }
            Law::Gap { .. } => matches!(element, Element::Gap(_)),
            Law::ViscousWedge { .. } => matches!(element, Element::ViscousWedge(_)),
            Law::ViscousToeWedge { .. } => matches!(element, Element::ViscousToeWedge(_)),
            Law::SurfaceFriction { .. } => matches!(element, Element::SurfaceFriction(_)),
            Law::StickSlipWedge { .. } => matches!(element, Element::StickSlipWedge(_)),
            Law::StickSlipWedge3d { .. } => matches!(element, Element::StickSlipWedge3d(_)),
            Law::Unused { .. } => false,
        }
    }

    /// Returns the types of connections that can use it, as in the file.
    pub fn types(&self) -> &'static str {
        match self {
            Law::Limits { .. } => "1, 1.1 or 1.3",
            Law::Gap { .. } => "1.2",
            Law::ViscousWedge { .. } => "6.3",
            Law::ViscousToeWedge { .. } => "6.7",
            Law::SurfaceFriction { .. } => "6.5",
            Law::StickSlipWedge { .. } => "6.8",
            Law::StickSlipWedge3d { .. } => "6.9",
            Law::Unused { .. } => "none",
        }
    }

    /// Returns the piecewise linear functions it uses, without zeros.
    pub fn functions(&self) -> impl Iterator<Item = Spanned<u32>> {
        let pair = match self {
            Law::Limits {
                stiffness, damping, ..
            }
            | Law::Gap {
                stiffness, damping, ..
            } => [*stiffness, *damping],
            Law::ViscousWedge { coil, damping, .. }
            | Law::ViscousToeWedge { coil, damping, .. }
            | Law::StickSlipWedge { coil, damping, .. } => [*coil, *damping],
            Law::SurfaceFriction { normal, damping, .. } => [*normal, *damping],
            Law::StickSlipWedge3d { coil, face, .. } => [*coil, *face],
            Law::Unused { .. } => [0.into(), 0.into()],
        };
        pair.into_iter().filter(|function| function.value != 0)
    }
}
