//! Matrices that a problem keeps at once, of which one is in use.

use std::ops::{Deref, DerefMut};

/// Matrices with their factors, under numbers from 0 on, see [`Problem::take_matrix`](crate::Problem::take_matrix); it stands for the one in use.
#[derive(Clone, Debug)]
pub struct Matrices<M> {
    all: Vec<M>,
    in_use: usize,
}

impl<M: Clone> Matrices<M> {
    /// One matrix, number 0, which is in use.
    #[must_use]
    pub fn new(matrix: M) -> Self {
        Self {
            all: vec![matrix],
            in_use: 0,
        }
    }

    /// From here on the matrix with this number is in use. Memory is taken when a number is asked for first.
    pub fn take(&mut self, number: usize) {
        if number >= self.all.len() {
            let another = self.all[self.in_use].clone();
            self.all.resize(number + 1, another);
        }
        self.in_use = number;
    }
}

impl<M> Deref for Matrices<M> {
    type Target = M;

    #[inline(always)]
    fn deref(&self) -> &M {
        &self.all[self.in_use]
    }
}

impl<M> DerefMut for Matrices<M> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut M {
        &mut self.all[self.in_use]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_number_has_its_own() {
        let mut matrices = Matrices::new(vec![1.0]);
        matrices.take(2);
        matrices[0] = 3.0;
        matrices.take(1);
        assert_eq!(*matrices, [1.0]);
        matrices[0] = 2.0;
        for (number, value) in [(0, 1.0), (2, 3.0), (1, 2.0)] {
            matrices.take(number);
            assert_eq!(*matrices, [value]);
        }
    }
}
