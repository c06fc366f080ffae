//! Surfaces that contact points touch: signed distance and directions, in the axes of the surface's marker.

use numerics::scalar::Number;
use serde::{Deserialize, Serialize};

use crate::vector::Vector;

/// A surface, described in the axes of its marker.
pub trait Surface {
    /// Returns the signed distance of a point from the surface, m: positive outside, negative inside.
    fn gap<S: Number>(&self, point: Vector<S>) -> S;
    /// Returns the components of a vector along the outward normal and two tangents of the surface next to
    /// `point`.
    fn resolve<S: Number>(&self, point: Vector<S>, vector: Vector<S>) -> [S; 3];
    /// Returns the vector with the given components along the normal and the two tangents.
    fn compose<S: Number>(&self, point: Vector<S>, components: [S; 3]) -> Vector<S>;
}

/// The plane through the marker's origin; its outward normal is the marker's x axis, its tangents are y and
/// z.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Plane;

impl Surface for Plane {
    #[inline(always)]
    fn gap<S: Number>(&self, point: Vector<S>) -> S {
        point.0[0]
    }
    #[inline(always)]
    fn resolve<S: Number>(&self, _point: Vector<S>, vector: Vector<S>) -> [S; 3] {
        vector.0
    }
    #[inline(always)]
    fn compose<S: Number>(&self, _point: Vector<S>, components: [S; 3]) -> Vector<S> {
        Vector(components)
    }
}
