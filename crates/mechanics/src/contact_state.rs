//! The state of a contact with friction, and the loads of the friction laws at which it changes.

/// Load at which slip begins: tanh (|v|/v0; the force is 0.96 of its limit), bristle (|T|/(μN)).
pub const SLIP_LOAD: [f64; 2] = [2.0, 1.0];
/// Load at which stick begins: tanh (|v|/v0; the force is 0.76 of its limit), bristle (|T|/(μN)).
pub const STICK_LOAD: [f64; 2] = [1.0, 0.999];

/// State of a contact point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum ContactState {
    /// No contact.
    Open = 0,
    /// In contact, not slipping.
    Stick = 1,
    /// In contact, slipping.
    Slip = 2,
}

impl ContactState {
    /// Returns the contact state with this number; other numbers mean slip.
    #[must_use]
    pub fn from_number(number: u8) -> Self {
        match number {
            0 => Self::Open,
            1 => Self::Stick,
            _ => Self::Slip,
        }
    }

    /// Returns its name, as in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::Stick => "stick",
            Self::Slip => "slip",
        }
    }
}
