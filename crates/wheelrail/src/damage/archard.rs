//! Wear by Archard's law, with a map of coefficients over pressure and sliding speed.
//!
//! **Law** (Archard 1953). Volume per time that sliding under pressure takes from a surface of hardness H:
//!
//! ```text
//! dV/dt = k/H ∫ p |s| dA = k/H P / μ,   P = ∫ μ p |s| dA
//! ```
//!
//! P is what creep takes, μ the friction where it slides. So a patch that slides as a whole under N at the
//! speed v wears by `k N v / H`, and one that adheres in part by what its creep forces say, without a grid.
//! The mean sliding speed of a patch is `P / (μ N)`.
//!
//! **Map** (Jendel 2002, KTH, with Lewis and Olofsson 2004; numbers remembered). k depends on the largest
//! pressure p and on the sliding speed v: mild wear 1 to 10e-4 below 0.2 m/s and above 0.7 m/s, severe wear
//! 30 to 40e-4 between, 300 to 400e-4 where p passes 0.8 H; the defaults are the middle of each. H is 3 GPa
//! (remembered, a usual wheel or rail steel). It was measured dry, on disks and pins of wheel and rail
//! steels.
//!
//! **Limits.** One coefficient a patch, by its largest pressure and its mean sliding speed; the map has
//! edges, where wear jumps. Lubricated and wet contacts wear less by an order of magnitude: scale the
//! coefficients. The volume is that of one of the two surfaces: both wear alike.

/// A map of coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WearMap {
    /// Hardness, Pa.
    pub hardness: f64,
    /// Coefficients at slow, at middling and at fast sliding.
    pub coefficients: [f64; 3],
    /// That of high pressures.
    pub pressed: f64,
    /// Where sliding is middling: from, to, m/s.
    pub speeds: [f64; 2],
    /// Where pressure is high: share of the hardness.
    pub share: f64,
}

impl Default for WearMap {
    fn default() -> Self {
        Self {
            hardness: 3e9,
            coefficients: [5e-4, 35e-4, 5e-4],
            pressed: 350e-4,
            speeds: [0.2, 0.7],
            share: 0.8,
        }
    }
}

impl WearMap {
    /// Returns the coefficient at a pressure (Pa) and a sliding speed (m/s).
    #[must_use]
    pub fn coefficient(&self, pressure: f64, sliding: f64) -> f64 {
        let [from, to] = self.speeds;
        if pressure > self.share * self.hardness {
            self.pressed
        } else if sliding < from {
            self.coefficients[0]
        } else if sliding <= to {
            self.coefficients[1]
        } else {
            self.coefficients[2]
        }
    }

    /// Returns the volume that wears a second (m³/s) where creep takes a power (W) under a normal force (N)
    /// and a largest pressure (Pa), with a coefficient of friction.
    #[must_use]
    pub fn rate(&self, power: f64, normal: f64, pressure: f64, friction: f64) -> f64 {
        if !(power > 0.0 && normal > 0.0 && friction > 0.0) {
            return 0.0;
        }
        let sliding = power / (friction * normal);
        self.coefficient(pressure, sliding) * normal * sliding / self.hardness
    }
}
