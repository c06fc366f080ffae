//! Rolling contact fatigue by a damage function of the wear number.
//!
//! **Law** (Burstow 2004, whole life rail model; numbers remembered). A wheel that passes a place damages it
//! by a function of its wear number Tγ, what creep takes by the distance: none up to 15 N, rising in
//! proportion to 1 at 65 N, falling from there through 0 at 175 N. Beyond, wear takes away more than cracks
//! grow: the function goes on falling along its last piece, below zero. 1 stands for 1e-5 of the life up to a
//! visible crack: 100,000 passages at 65 N.
//!
//! **Limits.** Fitted to cracks on rails of the grade R220 in Great Britain; for wheels, other grades and
//! axle loads it ranks, it does not predict. Pressure does not enter. It takes the size of Tγ, not its
//! direction: cracks of rails grow by forces against the travel, those of wheels by forces along it.

/// A damage function.
#[derive(Clone, Debug, PartialEq)]
pub struct DamageFunction {
    /// Pairs of wear number (N, rising) and damage; it is zero before the first one and straight after the
    /// last two.
    pub points: Vec<[f64; 2]>,
}

impl Default for DamageFunction {
    fn default() -> Self {
        Self {
            points: vec![[15.0, 0.0], [65.0, 1.0], [175.0, 0.0]],
        }
    }
}

impl DamageFunction {
    /// Returns the damage by a wear number, N.
    #[must_use]
    pub fn at(&self, wear_number: f64) -> f64 {
        let Some([first, value]) = self.points.first() else {
            return 0.0;
        };
        if wear_number < *first {
            return 0.0;
        }
        let pieces = self.points.windows(2);
        let piece = pieces
            .clone()
            .find(|pair| wear_number <= pair[1][0])
            .or(pieces.last());
        piece.map_or(*value, |pair| {
            let [[x, a], [y, b]] = [pair[0], pair[1]];
            a + (b - a) * (wear_number - x) / (y - x)
        })
    }
}
