//! Points of the Sobol' sequence, by number.
//!
//! Direction numbers of S. Joe and F. Y. Kuo, *Constructing Sobol sequences with better two-dimensional
//! projections*, SIAM J. Sci. Comput. 30 (2008), file `new-joe-kuo-6.21201`, in the Gray-code order of I. A.
//! Antonov and V. M. Saleev (1979), in which SciPy and others give the points too. A seed shifts all points
//! by the same random bits (a digital shift), which keeps their evenness.

use super::random::mix;

/// Bits of a coordinate: as many points differ as 2 to this power.
const BITS: u32 = 52;

/// For each dimension after the first: degree and coefficients of its primitive polynomial, first direction
/// numbers.
const DIRECTIONS: [(u32, u32, &[u64]); DIMENSIONS - 1] = [
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
    (5, 4, &[1, 1, 5, 5, 5]),
    (5, 7, &[1, 1, 7, 11, 19]),
    (5, 11, &[1, 1, 5, 1, 1]),
    (5, 13, &[1, 1, 1, 3, 11]),
    (5, 14, &[1, 3, 5, 5, 31]),
    (6, 1, &[1, 3, 3, 9, 7, 49]),
    (6, 13, &[1, 1, 1, 15, 21, 21]),
    (6, 16, &[1, 3, 1, 13, 27, 49]),
    (6, 19, &[1, 1, 1, 15, 7, 5]),
    (6, 22, &[1, 3, 1, 15, 13, 25]),
    (6, 25, &[1, 1, 5, 5, 19, 61]),
    (7, 1, &[1, 3, 7, 11, 23, 15, 103]),
    (7, 4, &[1, 3, 7, 13, 13, 15, 69]),
];

/// Number of dimensions with direction numbers.
pub const DIMENSIONS: usize = 21;

/// The Sobol' sequence in some dimensions.
#[derive(Clone, Debug, PartialEq)]
pub struct Sobol {
    /// For each dimension its direction numbers, the first one's leading bit being bit [`BITS`] - 1.
    directions: Vec<[u64; BITS as usize]>,
    /// For each dimension the bits that shift it.
    shifts: Vec<u64>,
}

impl Sobol {
    /// Returns the sequence in this many dimensions, at most [`DIMENSIONS`]; without a seed as it is, its
    /// first point zero.
    #[must_use]
    pub fn new(dimensions: usize, seed: Option<u64>) -> Self {
        let dimensions = dimensions.min(DIMENSIONS);
        Self {
            directions: (0..dimensions).map(directions).collect(),
            shifts: (0..dimensions as u64)
                .map(|dimension| seed.map_or(0, |seed| mix(seed, &[dimension]) >> (64 - BITS)))
                .collect(),
        }
    }

    /// Returns a coordinate of the point of this number, from 0 to below 1; zero for a dimension that it does
    /// not have.
    #[must_use]
    pub fn coordinate(&self, number: u64, dimension: usize) -> f64 {
        let (Some(directions), Some(shift)) = (self.directions.get(dimension), self.shifts.get(dimension))
        else {
            return 0.0;
        };
        let mut gray = number ^ (number >> 1);
        let mut bits = *shift;
        for direction in directions {
            if gray & 1 == 1 {
                bits ^= direction;
            }
            gray >>= 1;
        }
        bits as f64 / (1_u64 << BITS) as f64
    }
}

/// Returns the direction numbers of a dimension, `v_k = m_k / 2^k` as fixed-point numbers.
fn directions(dimension: usize) -> [u64; BITS as usize] {
    let mut v = [0; BITS as usize];
    let Some((degree, coefficients, first)) = dimension.checked_sub(1).map(|place| DIRECTIONS[place]) else {
        for (k, v) in v.iter_mut().enumerate() {
            *v = 1 << (BITS as usize - 1 - k);
        }
        return v;
    };
    let s = degree as usize;
    for k in 0..BITS as usize {
        v[k] = if k < s {
            first[k] << (BITS as usize - 1 - k)
        } else {
            let mut next = v[k - s] ^ (v[k - s] >> s);
            for j in 1..s {
                if coefficients >> (s - 1 - j) & 1 == 1 {
                    next ^= v[k - j];
                }
            }
            next
        };
    }
    v
}
