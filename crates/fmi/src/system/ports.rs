//! Ports of a system: what its inputs do, and what its outputs read.

use integrate::Options;
use mechanics::system::{Observation, System};

use crate::element::Entries;

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

/// The quantity that an output reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// A displacement.
    Displacement(PortDirection),
    /// The rate of a displacement.
    Rate(PortDirection),
    /// The value of this number in the table.
    Table(usize),
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
    /// The kind of each parameter.
    pub starts: Vec<StartPort>,
    /// The reading of each output.
    pub outputs: Vec<Reading>,
    /// The values in the table that are columns, before the three of the energy ledger.
    pub columns: Vec<usize>,
}

/// A system with named ports: what a [`super::SystemElement`] is made of.
pub struct Plant {
    /// The system.
    pub system: System,
    /// Its quantities. Its columns end with stored change, residual and relative residual of the energy
    /// ledger; modes and indicators are those of all contact states, or none.
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
