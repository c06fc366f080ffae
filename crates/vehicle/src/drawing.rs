//! How a vehicle is drawn: solids on bodies, elements between places on them.

/// A solid on a body, in the axes of the body, about its center of gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solid {
    /// A box with its edges along x, y, z, m.
    Box([f64; 3]),
}

/// A body with its solid.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnBody {
    /// Its name.
    pub name: String,
    /// Its number in the system.
    pub number: usize,
    /// Its center of gravity in the nominal layout, m.
    pub place: [f64; 3],
    /// Its solid.
    pub solid: Solid,
}

/// The form in which an element is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawn {
    /// A coil from one end to the other.
    Coil,
    /// A line.
    Line,
    /// Not at all: its bodies show it.
    Nothing,
}

/// An element between places on two bodies (numbers in the system, and places in the nominal layout, m).
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnElement {
    /// Its name.
    pub name: String,
    /// Its ends.
    pub ends: [(usize, [f64; 3]); 2],
    /// Its form.
    pub form: Drawn,
}

/// The drawing of a vehicle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Its bodies.
    pub bodies: Vec<DrawnBody>,
    /// Its elements.
    pub elements: Vec<DrawnElement>,
}
