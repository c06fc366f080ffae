//! The structure of a second-order system, and the parts of its state vector.

/// The structure of a second-order system: which parts are coupled.
#[derive(Clone, Debug, Default)]
pub struct Structure {
    /// Number of coordinates of each body (at least 1).
    pub bodies: Vec<usize>,
    /// Pairs of bodies that an element couples.
    pub couplings: Vec<(usize, usize)>,
    /// For each pair of internal states the bodies that it is coupled to, each of at most six coordinates.
    pub internal_pairs: Vec<Vec<usize>>,
    /// Number of quadratures.
    pub quadratures: usize,
    /// Pairs of a quadrature and a body on which it depends.
    pub quadrature_bodies: Vec<(usize, usize)>,
    /// Pairs of a quadrature and a pair of internal states on which it depends.
    pub quadrature_pairs: Vec<(usize, usize)>,
}

/// The parts of a state vector `(q, u, s, w)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Number of positions, and of speeds.
    pub speeds: usize,
    /// Number of internal states.
    pub internals: usize,
    /// Number of quadratures.
    pub quadratures: usize,
}

impl Layout {
    /// Returns the length of the state vector.
    #[must_use]
    pub fn len(&self) -> usize {
        2 * self.speeds + self.internals + self.quadratures
    }
    /// Returns whether there is no state.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Returns positions, speeds, internal states and quadratures of a state vector.
    #[inline(always)]
    #[must_use]
    pub fn split<'x>(&self, x: &'x [f64]) -> [&'x [f64]; 4] {
        let (q, rest) = x.split_at(self.speeds);
        let (u, rest) = rest.split_at(self.speeds);
        let (s, w) = rest.split_at(self.internals);
        [q, u, s, w]
    }
    /// As [`Layout::split`], mutable.
    #[inline(always)]
    pub fn split_mut<'x>(&self, x: &'x mut [f64]) -> [&'x mut [f64]; 4] {
        let (q, rest) = x.split_at_mut(self.speeds);
        let (u, rest) = rest.split_at_mut(self.speeds);
        let (s, w) = rest.split_at_mut(self.internals);
        [q, u, s, w]
    }
}

/// The derivative of one quadrature by one body's positions (n) and speeds (n).
#[derive(Clone, Copy, Debug)]
pub(super) struct QuadratureOfBody {
    pub quadrature: usize,
    pub body: usize,
    pub start: usize,
}
