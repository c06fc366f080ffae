//! Coils by their drawings: free height, height at which the windings touch, stiffness.
//!
//! [`catalog`] has kinds of the AAR (standard M-946, which is not public). Marks: **derived** are the D5
//! coils, from the loads at solid height of two nests in input files of NUCARS. **Remembered** are the
//! others, from tables in US patents of National Steel Car of 2003 and later; there stiffness times travel is
//! the load at solid height, to the digits given. The remembered D5 coils (2,241.6 and 1,121.6 lbf/in; the
//! inner one is free at 10.3125 in) differ from the derived ones by 0.3 % and 2.7 %, and the sum of B-353 and
//! B-354, 1,936.0 lbf/in, from the 1,937 lbf/in of a pair in those input files by 0.05 %. D3 is in no source
//! at hand.

use crate::parameters::Spring;
use crate::units::{INCH, POUND_PER_INCH};

/// A coil: a spring that pushes from its free height down to its solid one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coil {
    /// Height without load, m.
    pub free_height: f64,
    /// Height at which its windings touch, m.
    pub solid_height: f64,
    /// Stiffness, N/m.
    pub stiffness: f64,
}

/// A kind of coils: an outer coil and the inner one that stands in it; one of them may be missing.
#[derive(Clone, Debug, PartialEq)]
pub struct CoilKind {
    /// Its name.
    pub name: String,
    /// The outer coil.
    pub outer: Option<Coil>,
    /// The inner coil.
    pub inner: Option<Coil>,
    /// Where its numbers come from.
    pub source: String,
}

const DERIVED: &str = "derived from input files of NUCARS";
const REMEMBERED: &str = "remembered from patents of National Steel Car";
const PAIRS: [&str; 3] = [
    "outer B-353, inner B-354; remembered from patents of National Steel Car",
    "outer B-355, inner B-356; remembered from patents of National Steel Car",
    "outer B-432, inner B-433; remembered from patents of National Steel Car",
];

/// Name; free height, solid height (in) and stiffness (lbf/in) of the outer and of the inner coil; source.
type Row = (&'static str, [f64; 3], [f64; 3], &'static str);

const ROWS: [Row; 5] = [
    ("D5", [10.25, 6.5625, 2234.0], [10.25, 6.5625, 1153.0], DERIVED),
    (
        "D7",
        [10.8125, 6.5625, 2033.6],
        [10.75, 6.5625, 980.8],
        REMEMBERED,
    ),
    (
        "B-353",
        [11.1875, 6.5625, 1358.4],
        [11.5, 6.5625, 577.6],
        PAIRS[0],
    ),
    ("B-355", [10.75, 6.5625, 1358.8], [10.25, 6.5625, 913.4], PAIRS[1]),
    (
        "B-432",
        [11.0625, 6.5625, 1030.4],
        [11.375, 6.5625, 459.2],
        PAIRS[2],
    ),
];

/// Returns the kinds of coils that are known by name: D5 and D7 for nests, B-353, B-355 and B-432 for wedges.
#[must_use]
pub fn catalog() -> Vec<CoilKind> {
    let coil = |[free, solid, stiffness]: [f64; 3]| {
        Some(Coil {
            free_height: free * INCH,
            solid_height: solid * INCH,
            stiffness: stiffness * POUND_PER_INCH,
        })
    };
    ROWS.map(|(name, outer, inner, source)| CoilKind {
        name: name.to_owned(),
        outer: coil(outer),
        inner: coil(inner),
        source: source.to_owned(),
    })
    .to_vec()
}

impl Coil {
    /// Returns its load at a height (m) between the solid and the free one, N.
    #[must_use]
    pub fn load(&self, height: f64) -> f64 {
        self.stiffness * (self.free_height - height)
    }

    /// Returns the spring of a coil that has this height (m) in the nominal layout, with a shear stiffness by
    /// its stiffness and a stiffness (N/m) beyond its solid height; without damping.
    #[must_use]
    pub fn spring(&self, height: f64, shear_ratio: f64, solid: f64) -> Spring {
        Spring {
            preload: self.load(height),
            stiffness: self.stiffness,
            shear_stiffness: shear_ratio * self.stiffness,
            damping: 0.0,
            solid: Some([height - self.solid_height, solid]),
        }
    }
}
