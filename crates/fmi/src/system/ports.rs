//! Ports of a system: what its inputs do, and what its outputs read.

use integrate::Options;
use mechanics::body::Body;
use mechanics::coil::CoilLaw;
use mechanics::orientation::fixed;
use mechanics::system::{ElementEvaluation, Observation, System};
use mechanics::vector::Matrix;
use numerics::scalar::Real;

use super::{MOTION, START, SystemElement};
use crate::Error;
use crate::element::{Element, Entries, Setting};
use crate::source::Made;

/// Values of x, y, z (m), roll, pitch, yaw (rad); their rates; or forces (N) and moments (N·m).
pub type Six = [f64; 6];

/// A displacement of a point of a body with linearized kinematics: a linear function of the body's six
/// coordinates. The same row gives its rate from the rates of the coordinates, and the generalized forces of
/// a force along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PortDirection {
    /// The number of the body.
    pub body: usize,
    /// The derivatives of the displacement by the coordinates.
    pub row: Six,
}

impl PortDirection {
    /// Returns the coordinate (0 to 5) of a body itself: a displacement of its center of gravity, or an
    /// angle.
    #[must_use]
    pub fn coordinate(body: usize, coordinate: usize) -> Self {
        Self {
            body,
            row: std::array::from_fn(|k| if k == coordinate { 1.0 } else { 0.0 }),
        }
    }

    /// Returns the displacement of a body along a fixed axis (0 to 2), or its turn about that one (3 to 5),
    /// whose reference frame stands in any way in the nominal layout.
    #[must_use]
    pub fn along_axis((body, own): (usize, &Body), axis: usize) -> Self {
        let Matrix(frame) = fixed(own.frame.orientation);
        let first = axis / 3 * 3;
        let mut row = [0.0; 6];
        row[first..first + 3].copy_from_slice(&frame[axis - first]);
        Self { body, row }
    }

    /// Returns the six displacements of a point of a body that lies at `lever` (m) from its center of
    /// gravity: x, y, z of the point, and the angles of the body. In axes that are `turned` by 180° about z,
    /// x, y, roll and pitch change their signs.
    #[must_use]
    pub fn of_point(body: usize, lever: [f64; 3], turned: bool) -> [Self; 6] {
        let [x, y, z] = lever;
        let rows = [
            [1.0, 0.0, 0.0, 0.0, z, -y],
            [0.0, 1.0, 0.0, -z, 0.0, x],
            [0.0, 0.0, 1.0, y, -x, 0.0],
            [0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        ];
        let sign = if turned { -1.0 } else { 1.0 };
        let signs = [sign, sign, 1.0, sign, sign, 1.0];
        std::array::from_fn(|k| Self {
            body,
            row: rows[k].map(|entry| signs[k] * entry),
        })
    }

    /// Returns the displacement at these coordinates of its body, or its rate at their rates.
    #[must_use]
    pub fn value(&self, coordinates: &Six) -> f64 {
        self.row
            .iter()
            .zip(coordinates)
            .map(|(entry, value)| entry * value)
            .sum()
    }
}

/// An input that is a force (N) or a moment (N·m) along a displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadPort {
    /// The number of the input.
    pub input: usize,
    /// The displacement.
    pub direction: PortDirection,
}

/// Two inputs that move a coordinate of a prescribed body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionPort {
    /// The number of the body.
    pub body: usize,
    /// The coordinate, 0 to 5.
    pub coordinate: usize,
    /// The number of the input that is its value.
    pub position: usize,
    /// The number of the input that is its rate.
    pub rate: usize,
}

/// A parameter that is the value of a coordinate of a free body, or of its rate, at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartPort {
    /// The number of the body.
    pub body: usize,
    /// The coordinate, 0 to 5.
    pub coordinate: usize,
    /// True if it is the rate.
    pub rate: bool,
}

/// What an input says of the spring force of a coil.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoilSource {
    /// The stiffness (N/m), by which the compression is multiplied.
    Stiffness,
    /// The force (N), positive when it pushes.
    Force,
}

/// An input from which a coil has its spring force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CoilPort {
    /// The number of the coil.
    pub coil: usize,
    /// The number of the input.
    pub input: usize,
    /// What the input is.
    pub source: CoilSource,
}

impl CoilPort {
    /// Returns the law of the coil under a value of the input.
    pub(super) fn law(&self, value: f64) -> CoilLaw {
        match self.source {
            CoilSource::Stiffness => CoilLaw::Linear { stiffness: value },
            CoilSource::Force => CoilLaw::Given { force: value },
        }
    }

    /// Returns the change of the spring force (N) by a change of the input, at this value of it and this
    /// compression (m).
    pub(super) fn force_change(&self, system: &System, compression: f64, [value, change]: [f64; 2]) -> f64 {
        let pulls = system.coils()[self.coil].element.pulls;
        match self.source {
            CoilSource::Stiffness if pulls || compression > 0.0 => change * compression,
            CoilSource::Force if pulls || value > 0.0 => change,
            _ => 0.0,
        }
    }
}

/// An input that is the factor of an element's wrench, times a sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FactorPort {
    /// The number of the input.
    pub input: usize,
    /// The number of the element.
    pub element: usize,
    /// By which the input is multiplied.
    pub sign: f64,
}

/// A parameter that is the coefficient of friction of a face, and may change on the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrictionPort {
    /// The number of the parameter.
    pub parameter: usize,
    /// The number of the face.
    pub face: usize,
}

/// The quantity that an output reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// A displacement.
    Displacement(PortDirection),
    /// The rate of a displacement.
    Rate(PortDirection),
    /// The value of this number in the table.
    Table(usize),
    /// Of all elements on a body: force (0 to 2, N) or moment about its origin (3 to 5, N·m), fixed axes.
    Load(usize, usize),
    /// The compression of a coil: free length less length, m.
    CoilCompression(usize),
    /// The spring force of a coil, N: positive when it pushes.
    CoilForce(usize),
    /// The sum of the normal forces of a face, N.
    NormalForce(usize),
    /// The power lost in friction at a face, W.
    FrictionLoss(usize),
}

impl Reading {
    /// Returns whether [`Reading::of_elements`] reads it.
    pub(super) fn is_of_elements(&self) -> bool {
        !matches!(self, Self::Displacement(_) | Self::Rate(_) | Self::Table(_))
    }

    /// Reads what elements do, or its derivative; none if it is something else.
    pub(super) fn of_elements<S: Real>(&self, elements: &ElementEvaluation<S>, system: &System) -> Option<S> {
        match *self {
            Self::Displacement(_) | Self::Rate(_) | Self::Table(_) => None,
            Self::Load(body, component) => {
                let load = elements.loads.get(body)?;
                let part = if component < 3 { load.force } else { load.moment };
                Some(part.0[component % 3])
            }
            Self::CoilCompression(coil) => {
                let free_length = system.coils().get(coil)?.element.free_length;
                Some(-elements.coils.get(coil)?.length + free_length)
            }
            Self::CoilForce(coil) => Some(elements.coils.get(coil)?.spring),
            Self::NormalForce(face) => {
                let mut counts = system.faces().iter().map(|own| own.element.points.len());
                let first: usize = counts.by_ref().take(face).sum();
                let own = elements.points.get(first..first + counts.next()?)?;
                Some(own.iter().fold(S::zero(), |sum, point| sum + point.normal))
            }
            Self::FrictionLoss(face) => match system.faces().get(face)?.energy_terms[0] {
                Some(term) => elements.powers.get(term).copied(),
                None => Some(S::zero()),
            },
        }
    }

    /// Reads an observation and the row of the table.
    pub(super) fn of_observation(&self, seen: &Observation, row: &[f64]) -> Option<f64> {
        match self {
            Self::Displacement(direction) => Some(direction.value(&seen.bodies[direction.body].coordinates)),
            Self::Rate(direction) => Some(direction.value(&seen.bodies[direction.body].speeds)),
            Self::Table(number) => row.get(*number).copied(),
            _ => None,
        }
    }
}

/// Appends the values of a table's columns (SI) at an instant; the rates of its state are given if
/// [`Plant::table_takes_rates`].
pub type TableReader = Box<dyn FnMut(&Observation, &[f64], &mut Vec<f64>) + Send>;

/// What says in words, at an observation, that a wheel has left its rail.
pub type DerailmentWatch = Box<dyn Fn(&Observation) -> Option<String> + Send>;

/// The ports of a system, by the numbers of its inputs, outputs, parameters and columns among its
/// [`Entries`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ports {
    /// Inputs that are loads.
    pub loads: Vec<LoadPort>,
    /// Inputs that move prescribed bodies.
    pub motions: Vec<MotionPort>,
    /// Inputs that are stiffness or force of a coil.
    pub coils: Vec<CoilPort>,
    /// Inputs that are factors of elements.
    pub factors: Vec<FactorPort>,
    /// Parameters that are values at the start: the first ones, in their order.
    pub starts: Vec<StartPort>,
    /// Parameters that are coefficients of friction.
    pub frictions: Vec<FrictionPort>,
    /// The reading of each output.
    pub outputs: Vec<Reading>,
    /// The values in the table that are columns: all, or those before the three of the energy ledger.
    pub columns: Vec<usize>,
}

/// A system with named ports: what a [`super::SystemElement`] is made of.
pub struct Plant {
    /// The system.
    pub system: System,
    /// Its quantities. Its states are those of the system, or these and the work of all loads; columns that
    /// the ports do not name are stored change, residual and relative residual of the energy ledger; modes
    /// and indicators are those of all contact states, or none.
    pub entries: Entries,
    /// Its ports.
    pub ports: Ports,
    /// The reader of the table at an instant; none if no port reads it.
    pub table: Option<TableReader>,
    /// True if the table reads the rates of the state, which cost an evaluation more.
    pub table_takes_rates: bool,
    /// What says in words that a wheel has left its rail, at an observation; none of what runs on none.
    pub derailed: Option<DerailmentWatch>,
    /// Numbers of bodies and of connections in files, for messages; may be empty.
    pub numbers: [Vec<u32>; 2],
    /// True if it runs along a track: that it leaves its place is not implausible.
    pub rolls: bool,
    /// True if the ledger's residual is the stored and lost energy less the work; else it is its negative.
    pub residual_of_stored: bool,
    /// Options of its integration; their relative tolerance holds if the importer gives none.
    pub options: Options,
    /// The state at the start; none: that of the system.
    pub initial: Option<Vec<f64>>,
    /// How it starts.
    pub start: StartState,
    /// True if inputs move prescribed bodies; else these follow motions of their own.
    pub driven: bool,
}

/// The start of a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartState {
    /// At its initial coordinates and at rest, or as its parameters say.
    Initial,
    /// In static equilibrium without friction, prescribed bodies being where they are.
    Equilibrium,
}

impl StartState {
    /// Returns the one that the option `start` asks for.
    pub(crate) fn asked(setting: Option<&Setting>) -> Self {
        match setting.map_or(0, |setting| setting.option(START)) {
            0 => Self::Initial,
            _ => Self::Equilibrium,
        }
    }
}

/// Returns whether the option `motion` says that inputs move prescribed bodies.
pub(crate) fn is_driven(setting: Option<&Setting>) -> bool {
    setting.is_none_or(|setting| setting.option(MOTION) == 0)
}

/// Largest size of an input, SI: no motion and no load of a machine comes near it, and steps under larger
/// ones would be so short that they lead nowhere.
const LARGEST_INPUT: f64 = 1e15;

impl Plant {
    /// Returns the plant of a system without a table, which starts where the system does and is driven.
    #[must_use]
    pub fn new(system: System, entries: Entries, ports: Ports, options: Options) -> Self {
        Self {
            system,
            entries,
            ports,
            table: None,
            table_takes_rates: false,
            derailed: None,
            numbers: [Vec::new(), Vec::new()],
            rolls: false,
            residual_of_stored: false,
            options,
            initial: None,
            start: StartState::Initial,
            driven: true,
        }
    }

    /// Returns its quantities, and under a setting what has them, at its start.
    pub(crate) fn made(self, setting: Option<&Setting>) -> Result<Made, Error> {
        let entries = self.entries.clone();
        let element = setting
            .map(|setting| SystemElement::new(self, setting))
            .transpose()?;
        Ok((
            entries,
            element.map(|element| Box::new(element) as Box<dyn Element>),
        ))
    }

    /// Checks the values of all inputs.
    pub(super) fn check_inputs(&self, inputs: &[f64]) -> Result<(), Error> {
        let (found, own) = (inputs.len(), self.entries.inputs.len());
        if found != own {
            return Err(Error::new(format!("{found} inputs are given; there are {own}")));
        }
        let wrong = |number: usize, expected: &str| {
            let (name, value) = (&self.entries.inputs[number].name, inputs[number]);
            Err(Error::new(format!("the input `{name}` is {value:e}{expected}")))
        };
        if let Some(number) = inputs.iter().position(|value| !value.is_finite()) {
            return wrong(number, "; it must be finite");
        }
        if let Some(number) = inputs.iter().position(|value| value.abs() > LARGEST_INPUT) {
            let most = format!(", out of all proportion: at most {LARGEST_INPUT:e} (SI units) is admissible");
            return wrong(number, &most);
        }
        let mut coils = self.ports.coils.iter();
        let stiffness = |port: &&CoilPort| port.source == CoilSource::Stiffness && inputs[port.input] < 0.0;
        match coils.find(stiffness) {
            Some(port) => wrong(port.input, "; a stiffness must be zero or positive"),
            None => Ok(()),
        }
    }
}

/// Returns the body and the coordinate of each position of a system.
pub(crate) fn coordinates(system: &System) -> Vec<(usize, usize)> {
    let mut coordinates = vec![(0, 0); system.layout().speeds];
    // Carriers, which have the coordinates of a body before them, are not named.
    for body in (0..system.bodies().len()).rev() {
        for coordinate in 0..6 {
            if let Some(place) = system.position_of(body, coordinate) {
                coordinates[place] = (body, coordinate);
            }
        }
    }
    coordinates
}
