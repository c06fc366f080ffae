//! Nests of single coils: which coils stand at which places of a 3 × 3 nest.
//!
//! D5 coils: 2,234 lbf/in (outer) and 1,153 lbf/in (inner), 3.6875 in from free to solid, from the loads at
//! solid height of two nests in input files of NUCARS. The pitch of 5.63 in and which places have inner coils
//! are guesses. In a nest with variable damping the control coils take the places in the middle of the
//! leading and of the trailing row.

use wedge::parameters::Damping;

use crate::parameters::{NestCoil, Spring};
use crate::units::{INCH, POUND_PER_INCH};

/// From one coil to the next, m.
const PITCH: f64 = 5.63 * INCH;
/// From free to solid height, m.
const TRAVEL: f64 = 3.6875 * INCH;
/// Stiffness of a solid nest, N/m, shared by its coils as their stiffnesses are.
const SOLID: f64 = 1e6 * POUND_PER_INCH;

/// A coil of the catalog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CatalogCoil {
    /// D5, outer.
    D5Outer,
    /// D5, inner.
    D5Inner,
}

impl CatalogCoil {
    /// Returns its stiffness, N/m.
    #[must_use]
    pub fn stiffness(self) -> f64 {
        POUND_PER_INCH
            * match self {
                Self::D5Outer => 2234.0,
                Self::D5Inner => 1153.0,
            }
    }
}

/// A coil at its place: column (-1, 0, 1 along x) and row (-1, 0, 1 along y).
pub type CoilPlace = (CatalogCoil, [i8; 2]);

/// Returns the coils of a whole nest: nine outer and five inner ones (constant damping), six outer and seven
/// inner ones (variable damping).
#[must_use]
pub fn whole_nest(damping: Damping) -> Vec<CoilPlace> {
    use CatalogCoil::{D5Inner, D5Outer};
    let places = (-1..=1).flat_map(|x| (-1..=1).map(move |y| [x, y]));
    let mut coils = Vec::new();
    for place in places {
        let [outer, inner] = match (damping, place) {
            (Damping::Constant, [x, y]) => [true, x * y != 0 || place == [0, 0]],
            (Damping::Variable, [_, -1 | 1]) => [true, true],
            (Damping::Variable, [0, _]) => [false, true],
            (Damping::Variable, _) => [false, false],
        };
        coils.extend(outer.then_some((D5Outer, place)));
        coils.extend(inner.then_some((D5Inner, place)));
    }
    coils
}

/// Returns the springs of the coils of a nest. `load` (N) is what the whole nest carries in the nominal
/// layout; all coils have one free height. `shear_ratio` is their shear stiffness over their stiffness (0.69
/// and 0.67 in the input files of NUCARS).
///
/// A broken or missing coil: leave it out of the result, not of `coils`; the others keep their loads, and the
/// truck settles.
#[must_use]
pub fn springs(coils: &[CoilPlace], load: f64, shear_ratio: f64) -> Vec<NestCoil> {
    let total: f64 = coils.iter().map(|(coil, _)| coil.stiffness()).sum();
    let deflection = load / total;
    let spring = |(coil, [x, y]): &CoilPlace| {
        let stiffness = coil.stiffness();
        NestCoil {
            place: [f64::from(*x) * PITCH, f64::from(*y) * PITCH],
            spring: Spring {
                preload: stiffness * deflection,
                stiffness,
                shear_stiffness: stiffness * shear_ratio,
                damping: 0.0,
                solid: Some([TRAVEL - deflection, SOLID * stiffness / total]),
            },
        }
    };
    coils.iter().map(spring).collect()
}
