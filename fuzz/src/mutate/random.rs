//! Random numbers that are the same everywhere.

use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

/// The numbers behind one input.
pub struct Random(Xoshiro256PlusPlus);

impl Random {
    /// Those of a reader, a seed and a number.
    #[must_use]
    pub fn of(reader: &str, seed: u64, number: u64) -> Self {
        let bytes = reader
            .bytes()
            .chain(seed.to_le_bytes())
            .chain(number.to_le_bytes());
        // FNV-1a: it tells apart, the generator's own seeding mixes.
        let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        Self(Xoshiro256PlusPlus::seed_from_u64(hash))
    }

    /// Any number.
    pub fn any(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// Returns a number from zero and below `most`; zero, if that is zero.
    pub fn below(&mut self, most: usize) -> usize {
        let product = u128::from(self.any()) * most as u128;
        (product >> 64) as usize
    }

    /// True once in so many times.
    pub fn once_in(&mut self, times: usize) -> bool {
        self.below(times) == 0
    }

    /// Returns one of these, if there are any.
    pub fn pick<'a, T>(&mut self, list: &'a [T]) -> Option<&'a T> {
        list.get(self.below(list.len()))
    }

    /// Returns a number of repetitions: mostly a few times, now and then a hundred thousand times.
    pub fn many(&mut self) -> usize {
        let most = match self.below(40) {
            0 => 100_000,
            1..=3 => 2_000,
            _ => 20,
        };
        1 + self.below(most)
    }
}
