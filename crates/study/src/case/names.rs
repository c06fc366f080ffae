//! The names that choices have in cases of more than one model.

use integrate::Method;
use mechanics::coil::CoilLine;
use mechanics::contact::FrictionDirections;
use quantity::System;
use wedge::parameters::{Damping, Start};

use super::section::Names;

/// A law of friction, still without its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Law {
    /// Smoothed Coulomb friction; creeps.
    Tanh,
    /// An elastic element in series with the slider; holds.
    Bristle,
}

pub(crate) const LAWS: Names<Law> = &[("tanh", Law::Tanh), ("bristle", Law::Bristle)];

pub(crate) const DAMPINGS: Names<Damping> =
    &[("variable", Damping::Variable), ("constant", Damping::Constant)];

/// Coordinates of a body, by their number.
pub(crate) const COORDINATES: Names<usize> = &[
    ("x", 0),
    ("y", 1),
    ("z", 2),
    ("roll", 3),
    ("pitch", 4),
    ("yaw", 5),
];

/// The keys of a body's motions: three displacements, three angles.
pub(crate) const MOTIONS: [&str; 6] = ["longitudinal", "lateral", "vertical", "roll", "pitch", "yaw"];

/// Lines of action of a control coil.
pub(crate) const COIL_LINES: Names<CoilLine> = &[
    ("center_of_gravity", CoilLine::CenterOfGravity),
    ("seat", CoilLine::Seat),
];

pub(crate) const STARTS: Names<Start> = &[
    ("rest", Start::Rest),
    ("touching", Start::Touching),
    ("equilibrium", Start::Equilibrium),
];

pub(crate) const SYSTEMS: Names<System> = &[("us", System::Us), ("si", System::Si)];

/// Directions in which friction acts on a face.
pub(crate) const DIRECTIONS: Names<FrictionDirections> =
    &[("two", FrictionDirections::Two), ("one", FrictionDirections::One)];

pub(crate) const METHODS: Names<Method> = &[
    ("rodas5p", Method::Rodas5P),
    ("tr-bdf2", Method::TrBdf2),
    ("esdirk3", Method::Esdirk3),
];
