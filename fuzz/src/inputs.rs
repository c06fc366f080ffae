//! The inputs of a reader: input `n` of a seed.

use crate::limits::LONGEST_INPUT;
use crate::mutate::{Material, Mutation, Random};
use crate::readers::{self, Reader};

/// Number of stacked mutations: mostly one, so that many inputs are nearly right.
const STACKED: [usize; 8] = [1, 1, 1, 1, 2, 2, 3, 5];

/// The inputs of one reader.
pub struct Inputs {
    reader: &'static Reader,
    material: Material,
}

impl Inputs {
    /// Collects the corpus of a reader and, for splices, those of the others.
    #[must_use]
    pub fn of(reader: &'static Reader) -> Self {
        let others = readers::ALL.iter().filter(|other| other.name != reader.name);
        let material = Material {
            own: (reader.corpus)(),
            foreign: others.flat_map(|other| (other.corpus)()).collect(),
            dictionary: reader.dictionary,
        };
        Self { reader, material }
    }

    /// Number of entries of the reader's own corpus.
    #[must_use]
    pub fn corpus_size(&self) -> u64 {
        self.material.own.len() as u64
    }

    /// Returns the input of this number: first the corpus as it is, then mutations of it.
    #[must_use]
    pub fn input(&self, seed: u64, number: u64) -> Vec<u8> {
        self.made(seed, number).0
    }

    /// Returns the kinds of mutation that the input of this number went through.
    #[must_use]
    pub fn mutations(&self, seed: u64, number: u64) -> Vec<Mutation> {
        self.made(seed, number).1
    }

    fn made(&self, seed: u64, number: u64) -> (Vec<u8>, Vec<Mutation>) {
        let own = &self.material.own;
        if let Some(entry) = usize::try_from(number).ok().and_then(|number| own.get(number)) {
            return (entry.clone(), Vec::new());
        }
        let mut random = Random::of(self.reader.name, seed, number);
        let mut bytes = random.pick(own).cloned().unwrap_or_default();
        let count = random.pick(&STACKED).copied().unwrap_or(1);
        let mut done = Vec::with_capacity(count);
        for _ in 0..count {
            let mutation = random.pick(&Mutation::ALL).copied().unwrap_or(Mutation::Truncate);
            mutation.apply(&mut bytes, &mut random, &self.material);
            bytes.truncate(LONGEST_INPUT);
            done.push(mutation);
        }
        (bytes, done)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_input_is_a_function_of_reader_seed_and_number() {
        let reader = readers::find("units").unwrap();
        let (one, other) = (Inputs::of(reader), Inputs::of(reader));
        let numbers = one.corpus_size()..one.corpus_size() + 200;
        let all: Vec<_> = numbers.clone().map(|number| one.input(3, number)).collect();
        let backwards: Vec<_> = numbers
            .clone()
            .rev()
            .map(|number| other.input(3, number))
            .collect();
        assert!(all.iter().eq(backwards.iter().rev()));
        let differ = numbers.filter(|number| one.input(3, *number) != one.input(4, *number));
        assert!(differ.count() > 150);
        assert_eq!(one.input(3, 0), (reader.corpus)()[0]);
    }

    #[test]
    fn every_kind_of_mutation_is_drawn() {
        let inputs = Inputs::of(readers::find("units").unwrap());
        let drawn: Vec<Mutation> = (100..600)
            .flat_map(|number| inputs.mutations(1, number))
            .collect();
        assert!(Mutation::ALL.iter().all(|kind| drawn.contains(kind)));
    }
}
