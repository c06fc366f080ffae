//! The law by which wedges of trucks and cars wear.
//!
//! Archard's law with a coefficient of friction μ: `V = K/H ∫ N |v| dt = K E / (μ H)`, with the energy E that
//! friction takes ([`super::super::archard`], [`super::super::energy`]). Column and pocket wear by a ratio of
//! what the wedge's faces lose.
//!
//! Limits: K is a guess, known to an order of magnitude at best.

use quantity::Kind;

use crate::case::field::Reach;
use crate::case::section::Range;
use crate::reader::{CaseReader, QuantityForm};
use crate::wear::archard::Archard;

/// The law by which wedges wear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WedgeLaw {
    /// Archard's K and the hardness.
    pub archard: Archard,
    /// Wear of column and pocket over that of the wedge's faces.
    pub counterface: f64,
}

impl Default for WedgeLaw {
    /// The guesses of `wedgelab wear`; both partners wear alike.
    fn default() -> Self {
        Self {
            archard: Archard {
                coefficient: Archard::COEFFICIENT,
                hardness: Archard::HARDNESS,
            },
            counterface: 1.0,
        }
    }
}

impl WedgeLaw {
    /// Reads its keys from the section `[damage]`.
    pub(crate) fn read(&mut self, r: &mut CaseReader<'_>) {
        let own = &mut self.archard;
        let (number, reach) = (Range::NotNegative, Reach::FromZero(1e-4));
        let comment = "Archard's K of wedges: a guess, known to an order of magnitude at best";
        r.number("wedge_coefficient", number, reach, &mut own.coefficient, comment);
        let pressure: QuantityForm = (Kind::Pressure, Range::Positive, Reach::Positive);
        let comment = "of the softer of wedge and counterface: a guess";
        r.quantity("wedge_hardness", pressure, &mut own.hardness, comment);
        let comment = "wear of column and pocket over that of the wedge's faces: a guess";
        let reach = Reach::FromZero(1.0);
        r.number("wedge_counterface", number, reach, &mut self.counterface, comment);
    }

    /// Returns the volume (m³) that a face loses by an energy (J), with a coefficient of friction.
    #[must_use]
    pub fn volume(&self, energy: f64, friction: f64) -> f64 {
        match friction > 0.0 {
            true => self.archard.volume(energy / friction),
            false => 0.0,
        }
    }
}
