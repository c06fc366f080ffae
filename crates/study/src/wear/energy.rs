//! Wear by dissipated energy: the worn volume is `V = α E` with the energy E lost in friction.
//!
//! Source: Fouvry, S., Kapsa, Ph., Vincent, L. (1996), Quantification of fretting damage, Wear 200, 186-205.
//! With one coefficient of friction μ it is Archard's law with `α = K / (μ H)`.
//!
//! Units: α in m³/J, E in J, V in m³.
//!
//! Defects: α is a number of the pair, known to an order of magnitude; all of the energy counts, also what is
//! lost in creep and in the dashpots of bristles; there is no energy below which nothing is worn.

/// The parameter of wear by energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WearByEnergy {
    /// Volume per energy α, m³/J.
    pub coefficient: f64,
}

impl WearByEnergy {
    /// Guess: the default of Archard's law at a coefficient of friction of 0.4.
    pub const COEFFICIENT: f64 = 1e-13;

    /// Returns the volume worn by an energy lost in friction (J), m³.
    #[must_use]
    pub fn volume(&self, energy: f64) -> f64 {
        self.coefficient * energy
    }
}
