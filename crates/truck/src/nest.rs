//! Nests of single coils: which coils stand at which places of a 3 × 3 nest.
//!
//! The pitch of 5.63 in and which places have inner coils are guesses. In a nest with variable damping the
//! control coils take the places in the middle of the leading and of the trailing row.

use wedge::parameters::Damping;

use crate::coils::{Coil, CoilKind};
use crate::parameters::NestCoil;
use crate::units::{INCH, POUND_PER_INCH};

/// From one coil to the next, m.
pub const PITCH: f64 = 5.63 * INCH;
/// Stiffness of a solid nest, N/m, shared by its coils as their stiffnesses are.
const SOLID: f64 = 1e6 * POUND_PER_INCH;

/// Which of two coils that stand in each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ring {
    /// The outer one.
    Outer,
    /// The inner one.
    Inner,
}

/// A coil at its place: column (-1, 0, 1 along x) and row (-1, 0, 1 along y).
pub type CoilPlace = (Ring, [i8; 2]);

/// Returns the places of so many coils in a nest, the same on both sides of its middle lines; none if there
/// are fewer places.
fn places(damping: Damping, count: usize) -> Option<Vec<[i8; 2]>> {
    const CORNERS: [[i8; 2]; 4] = [[-1, -1], [-1, 1], [1, -1], [1, 1]];
    const SIDES: [[i8; 2]; 2] = [[0, -1], [0, 1]];
    const ENDS: [[i8; 2]; 2] = [[-1, 0], [1, 0]];
    let has_ends = damping == Damping::Constant;
    let (corners, sides, ends) = match (count, has_ends) {
        (0 | 1, _) => (false, false, false),
        (2 | 3, _) => (false, true, false),
        (4 | 5, _) => (true, false, false),
        (6 | 7, _) => (true, true, false),
        (8 | 9, true) => (true, true, true),
        _ => return None,
    };
    let mut all: Vec<[i8; 2]> = Vec::new();
    all.extend(CORNERS.iter().filter(|_| corners));
    all.extend(SIDES.iter().filter(|_| sides));
    all.extend(ENDS.iter().filter(|_| ends));
    all.extend([[0, 0]].iter().filter(|_| count % 2 == 1));
    Some(all)
}

/// Returns the numbers of outer and of inner coils of a whole nest: nine and five (constant damping), six and
/// seven (variable damping).
#[must_use]
pub fn usual_counts(damping: Damping) -> [usize; 2] {
    match damping {
        Damping::Constant => [9, 5],
        Damping::Variable => [6, 7],
    }
}

/// Returns the coils of a nest with so many outer and inner ones, the same on both sides of its middle lines;
/// none if there are fewer places: nine with constant damping, seven with variable.
#[must_use]
pub fn nest(damping: Damping, [outer, inner]: [usize; 2]) -> Option<Vec<CoilPlace>> {
    let [outer, inner] = [places(damping, outer)?, places(damping, inner)?];
    let mut coils = Vec::new();
    for place in (-1..=1).flat_map(|x| (-1..=1).map(move |y| [x, y])) {
        let here = [(Ring::Outer, &outer), (Ring::Inner, &inner)];
        let here = here.into_iter().filter(|(_, all)| all.contains(&place));
        coils.extend(here.map(|(ring, _)| (ring, place)));
    }
    Some(coils)
}

/// Where the coils of a nest are, and how they stand there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// Height of the coils in the nominal layout, m.
    pub height: f64,
    /// Shear stiffness over stiffness: 0.69 and 0.67 in the input files of NUCARS.
    pub shear_ratio: f64,
    /// From one coil to the next, m.
    pub pitch: f64,
}

/// Returns the height (m) at which the coils of a nest carry a load (N); none of a nest without stiffness.
#[must_use]
pub fn height(coils: &[CoilPlace], kind: &CoilKind, load: f64) -> Option<f64> {
    let all = || coils.iter().filter_map(|(ring, _)| kind.coil(*ring));
    let total: f64 = all().map(|coil| coil.stiffness).sum();
    let free: f64 = all().map(|coil| coil.stiffness * coil.free_height).sum();
    (total > 0.0).then(|| (free - load) / total)
}

/// Returns the springs of the coils of a nest; a coil that its kind does not have is left out.
///
/// A broken or missing coil: leave it out of the result, not of `coils`; the others keep their loads, and the
/// truck settles.
#[must_use]
pub fn springs(coils: &[CoilPlace], kind: &CoilKind, standing: Standing) -> Vec<(CoilPlace, NestCoil)> {
    let Standing {
        height,
        shear_ratio,
        pitch,
    } = standing;
    let own = || coils.iter().filter_map(|own| Some((*own, kind.coil(own.0)?)));
    let total: f64 = own().map(|(_, coil)| coil.stiffness).sum();
    let spring = |(own, coil): (CoilPlace, Coil)| {
        let [x, y] = own.1;
        let solid = SOLID * coil.stiffness / total;
        let coil = NestCoil {
            place: [f64::from(x) * pitch, f64::from(y) * pitch],
            spring: coil.spring(height, shear_ratio, solid),
        };
        (own, coil)
    };
    own().map(spring).collect()
}

impl CoilKind {
    /// Returns one of its coils.
    #[must_use]
    pub fn coil(&self, ring: Ring) -> Option<Coil> {
        match ring {
            Ring::Outer => self.outer,
            Ring::Inner => self.inner,
        }
    }
}
