//! An element in a system: between which bodies it is, and where its states and energies are.

use super::forces::pair_of;
use crate::contact::Points;
use crate::element::Marked;
use crate::element::tangent::{StateTangent, Tangent, TangentColumns};
use crate::link::{Marker, RelativeFrame, Translation};

impl Mounted<Marked> {
    /// Returns the pair of its internal states among those of the system; zeros if it has none.
    #[inline(always)]
    pub(super) fn states(&self, internal: &[f64]) -> [f64; 2] {
        pair_of(&internal[self.first_internal..][..self.internal_count])
    }
}

/// An element between two bodies of a system.
#[derive(Clone, Debug)]
pub struct Mounted<E> {
    /// The element.
    pub element: E,
    /// The body that it carries (free).
    pub body: usize,
    /// The body that it stands on.
    pub on: usize,
    /// Marker B, on the body that it stands on.
    pub marker: Marker,
    /// Its first internal state (relative to the internal states), and its first pair of them.
    pub first_internal: usize,
    /// Number of its internal states.
    pub internal_count: usize,
    /// The quadratures of its energy terms.
    pub energy_terms: [Option<usize>; 2],
    /// True if the body that it stands on has free coordinates.
    pub(super) on_free: bool,
    /// True if its relative frame changes with time alone.
    pub(super) moves: bool,
    /// True if the body that it stands on is prescribed and moves.
    pub(super) prescribed: bool,
    pub(super) relative_frame: RelativeFrame<f64>,
    /// The points of a face, for evaluation; none for other elements.
    pub(super) points: Points,
    /// The constant part of the relative frame if the body under the element only translates.
    pub(super) translation: Option<Translation>,
    /// True if the body under it is prescribed and does not rotate, nor does the frame of its body.
    pub(super) plain: bool,
    /// Its tangent where it was differentiated last, and that of the rates of its internal states, by four
    /// pairs.
    pub(super) tangent: Tangent,
    pub(super) rate_tangents: Vec<TangentColumns>,
    /// Its derivatives by internal states, of an element that is no face.
    pub(super) state_tangent: StateTangent,
    /// Bounds of how much a force at each of its points accelerates the point, 1/kg.
    pub(super) mobilities: Vec<f64>,
    /// Coupling blocks (body, on) and (on, body).
    pub(super) pairs: [usize; 2],
    /// Rows of the quadratures (energy terms, work) by `body` and by `on`.
    pub(super) rows: [[Option<usize>; 3]; 2],
    /// First row of the quadratures by pairs of internal states.
    pub(super) first_internal_row: usize,
}
