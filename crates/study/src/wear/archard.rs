//! Archard's law of wear: the worn volume is `V = K ∫ N |v| dt / H`.
//!
//! Source: Archard, J. F. (1953), Contact and rubbing of flat surfaces, Journal of Applied Physics 24,
//! 981-988: worn volume in proportion to load and sliding distance, in inverse proportion to the hardness; at
//! a place of the face the depth grows by `K p |v| / H` with the pressure p.
//!
//! Units: K has none, H is the hardness of the softer partner in Pa, N |v| dt in J, V in m³.
//!
//! Defects: K is a number of the pair, its lubrication and its temperature, known to an order of magnitude;
//! the law has no running-in, no oxides, no transition from mild to severe wear. |v| is the speed of the
//! point over the surface, so that with bristles what deflects them counts as sliding, and with tanh the
//! creep of a contact that holds.

/// The parameters of Archard's law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Archard {
    /// Wear coefficient K.
    pub coefficient: f64,
    /// Hardness H, Pa.
    pub hardness: f64,
}

impl Archard {
    /// Guess: unlubricated steel on steel or iron in mild wear is worn by 1e-5 to 1e-3.
    pub const COEFFICIENT: f64 = 1e-4;
    /// Guess: about 250 on Brinell's scale.
    pub const HARDNESS: f64 = 2.45e9;

    /// Returns the volume worn by `∫ N |v| dt` (J), m³.
    #[must_use]
    pub fn volume(&self, load_times_path: f64) -> f64 {
        self.coefficient * load_times_path / self.hardness
    }
}
