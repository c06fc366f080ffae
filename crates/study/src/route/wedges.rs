//! Wear of wedges by the energy of their friction.
//!
//! Archard's law with a coefficient of friction μ: `V = K/H ∫ N |v| dt = K E / (μ H)`, with the energy E that
//! the ledger has for each face. The depth is the mean over the face. Column and pocket wear by a ratio of
//! what the wedge's faces lose; a car's keys `column_wear` and `slope_wear` are the sums of both.
//!
//! Limits: one depth a face; where on a face it wears, `wedgelab wear` says for a single wedge. K is a guess,
//! known to an order of magnitude at best.

use quantity::Kind;

use crate::case::problem::Problems;
use crate::case::section::{CaseSection, Range};

/// The law by which wedges wear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WedgeLaw {
    /// Archard's K.
    pub coefficient: f64,
    /// Hardness of the softer partner, Pa.
    pub hardness: f64,
    /// Wear of column and pocket over that of the wedge's faces.
    pub counterface: f64,
}

impl Default for WedgeLaw {
    /// The guesses of `wedgelab wear`; both partners wear alike.
    fn default() -> Self {
        Self {
            coefficient: 1e-4,
            hardness: 2450e6,
            counterface: 1.0,
        }
    }
}

impl WedgeLaw {
    /// Reads it.
    pub(super) fn read(section: &CaseSection<'_>, problems: &mut Problems) -> Self {
        let mut own = Self::default();
        section.allow(&["coefficient", "hardness", "counterface"], &[], problems);
        let given = |key: &str| section.table.get(key).is_some();
        if given("coefficient") {
            let found = section.number("coefficient", Range::NotNegative, "1e-4", problems);
            own.coefficient = found.unwrap_or(own.coefficient);
        }
        if given("hardness") {
            let found = section.quantity("hardness", Kind::Pressure, Range::Positive, problems);
            own.hardness = found.map_or(own.hardness, |own| own.to_si());
        }
        if given("counterface") {
            let found = section.number("counterface", Range::NotNegative, "1.0", problems);
            own.counterface = found.unwrap_or(own.counterface);
        }
        own
    }

    /// Returns the depth (m) that a face and its counterface lose together by an energy (J), with a
    /// coefficient of friction, over an area (m²).
    #[must_use]
    pub fn depth(&self, energy: f64, friction: f64, area: f64) -> f64 {
        if !(friction > 0.0 && area > 0.0) {
            return 0.0;
        }
        (1.0 + self.counterface) * self.coefficient * energy / (friction * self.hardness * area)
    }
}
