//! Latin hypercube sampling (McKay, Beckman and Conover, 1979), by number.
//!
//! Each of n runs has in each dimension a stratum of width 1/n of its own, and lies in it at random. Which
//! stratum, says a random permutation that needs no memory: a Feistel cipher over the next power of four,
//! walked until it falls below n (Black and Rogaway, *Ciphers with arbitrary finite domains*, 2002).

use super::random::{mix, unit};

const ROUNDS: u64 = 6;

/// A Latin hypercube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatinHypercube {
    runs: u64,
    seed: u64,
    /// Bits of half a number below the next power of four.
    half: u32,
}

impl LatinHypercube {
    /// Returns a hypercube of so many runs.
    #[must_use]
    pub fn new(runs: u64, seed: u64) -> Self {
        let bits = u64::BITS - runs.saturating_sub(1).leading_zeros();
        Self {
            runs: runs.max(1),
            seed,
            half: bits.div_ceil(2).max(1),
        }
    }

    /// Returns a coordinate of the run of this number (below the number of runs), from 0 to below 1.
    #[must_use]
    pub fn coordinate(&self, number: u64, dimension: usize) -> f64 {
        let stratum = self.stratum(number, dimension);
        let within = unit(mix(self.seed, &[1, dimension as u64, number]));
        // Rounding must not carry it into the next stratum, nor to 1.
        let below = ((stratum + 1) as f64 / self.runs as f64).next_down();
        ((stratum as f64 + within) / self.runs as f64).min(below)
    }

    /// Returns the stratum of a run: each number from 0 to below the number of runs stands once in each
    /// dimension.
    #[must_use]
    pub fn stratum(&self, number: u64, dimension: usize) -> u64 {
        let mut place = number % self.runs;
        loop {
            place = self.encipher(place, dimension as u64);
            if place < self.runs {
                return place;
            }
        }
    }

    fn encipher(&self, place: u64, dimension: u64) -> u64 {
        let mask = (1_u64 << self.half) - 1;
        let (mut left, mut right) = (place >> self.half, place & mask);
        for round in 0..ROUNDS {
            let scrambled = mix(self.seed, &[0, dimension, round, right]) & mask;
            (left, right) = (right, left ^ scrambled);
        }
        left << self.half | right
    }
}
