//! Connections between markers: for bodies that turn far, at any heading.
//!
//! The extension along axis c of marker B is `s_c = e_c · d` with `e_c` that axis and d the way from marker B
//! to marker A; small rotations are half the antisymmetric part of the rotation of A relative to B, `sin` of
//! the angle times its axis ([`crate::link::RelativeMotion::small_rotations`]). Markers coincide in the drawn
//! layout, so that extensions are zero there. Their rates are those that an observer on body B sees.
//!
//! Laws see extensions and rates alone. A force f along an extension acts on the coordinates q of both bodies
//! by virtual work, `Q = -f ∂s/∂q`, so that its power is `-f s˙` to rounding. With w the axis of an angle,
//! `a` the arm from a body's origin to its marker, and f_j the axes of its reference frame:
//!
//! ```text
//! ∂s_c/∂x_A = e_c · f_j,   ∂s_c/∂angle_A = w · (a_A × e_c)
//! ∂s_c/∂x_B = -e_c · f_j,  ∂s_c/∂angle_B = -w · ((d + a_B) × e_c)
//! rotations:  ±w · g_c,    g_c = ½ (tr R e_c - Σ_i R_ci e_i)
//! ```
//!
//! Their derivatives, which make the geometric stiffness, come from the same lines by dual numbers. Units: m,
//! rad, N. Defect: `sin` of an angle does not grow beyond 90° (no wedge or warp spring comes near). Limit:
//! the reference frames of both bodies rest.

use std::ops::Mul;

use numerics::scalar::{Dual, Real};

use crate::body::Body;
use crate::link::Marker;
use crate::orientation::{Orientation, fixed};
use crate::vector::{Matrix, Vector};

/// The coordinates of both bodies, first those of body A.
pub(super) type Both = [f64; 12];

/// Markers and relative coordinates of a connection between markers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Between<const D: usize> {
    /// The relative coordinates (0 to 5).
    coordinates: [usize; D],
    ends: [Reference; 2],
}

/// The reference frame of a body, and the marker on it.
#[derive(Clone, Copy, Debug)]
struct Reference {
    body: usize,
    origin: Vector<f64>,
    axes: Matrix<f64>,
    marker: Marker,
}

/// Extensions at a state, and their derivatives by the coordinates of both bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Levers<S, const D: usize> {
    pub extensions: [S; D],
    pub by_coordinates: [[S; 12]; D],
}

/// The derivatives of the geometry by the coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change<const D: usize> {
    /// Derivatives of the extensions by the coordinates, and of their rates by the rates.
    pub levers: [Both; D],
    /// Derivatives of the extensions' rates by the coordinates.
    pub lever_rates: [Both; D],
    /// `Σ f ∂²s/∂q∂q` at fixed forces f.
    pub stiffness: [Both; 12],
}

/// The pose of one end.
struct Pose<S> {
    axes: Matrix<S>,
    /// Axes of roll, pitch, yaw, fixed axes.
    angles: [Vector<S>; 3],
    arm: Vector<S>,
    /// Of the marker.
    place: Vector<S>,
}

impl Reference {
    #[inline(always)]
    fn pose<S: Real>(&self, coordinates: &[S; 6]) -> Pose<S>
    where
        f64: Mul<S, Output = S>,
    {
        let [x, y, z, roll, pitch, yaw] = *coordinates;
        let orientation = Orientation::new([roll, pitch, yaw], true);
        let axes: Matrix<S> = self.axes.times(orientation.rotation);
        let arm: Vector<S> = axes.apply(self.marker.origin);
        let moved: Vector<S> = self.axes.apply(Vector([x, y, z]));
        Pose {
            angles: orientation.axes.map(|axis| axes.apply(axis)),
            place: moved + arm + self.origin,
            axes,
            arm,
        }
    }
}

impl<const D: usize> Between<D> {
    /// Returns the geometry of a connection between markers on two bodies (their numbers).
    pub(super) fn new(
        coordinates: [usize; D],
        numbers: [usize; 2],
        bodies: &[Body],
        [marker_a, marker_b]: [Marker; 2],
    ) -> Self {
        let reference = |body: usize, marker: Marker| Reference {
            body,
            origin: Vector(bodies[body].frame.origin),
            axes: fixed(bodies[body].frame.orientation),
            marker,
        };
        Self {
            coordinates,
            ends: [reference(numbers[0], marker_a), reference(numbers[1], marker_b)],
        }
    }

    /// Returns the values of both bodies out of those of all.
    #[inline(always)]
    pub(super) fn both(&self, all: &[[f64; 6]]) -> Both {
        let [a, b] = [&all[self.ends[0].body], &all[self.ends[1].body]];
        std::array::from_fn(|k| if k < 6 { a[k] } else { b[k - 6] })
    }

    /// Returns the extensions and their derivatives by the coordinates of both bodies.
    #[inline(always)]
    pub(super) fn levers<S: Real>(&self, coordinates: [[S; 6]; 2]) -> Levers<S, D>
    where
        f64: Mul<S, Output = S>,
    {
        let [reference_a, reference_b] = &self.ends;
        let (a, b) = (
            reference_a.pose(&coordinates[0]),
            reference_b.pose(&coordinates[1]),
        );
        let axes: Matrix<S> = b.axes.times(reference_b.marker.rotation);
        let way = a.place - b.place;
        let reach = way + b.arm;
        let mut levers = Levers {
            extensions: [S::zero(); D],
            by_coordinates: [[S::zero(); 12]; D],
        };
        let entries = levers.extensions.iter_mut().zip(&mut levers.by_coordinates);
        for ((extension, row), &coordinate) in entries.zip(&self.coordinates) {
            if coordinate < 3 {
                let along = axes.column(coordinate);
                *extension = along.dot(way);
                let about = [a.arm.cross::<S, S>(along), reach.cross::<S, S>(along)];
                for k in 0..3 {
                    row[k] = along.dot(reference_a.axes.column(k));
                    row[3 + k] = a.angles[k].dot(about[0]);
                    row[6 + k] = -along.dot::<f64, S>(reference_b.axes.column(k));
                    row[9 + k] = -b.angles[k].dot::<S, S>(about[1]);
                }
                continue;
            }
            let own: Matrix<S> = a.axes.times(reference_a.marker.rotation);
            let Matrix(r): Matrix<S> = axes.transpose().times(own);
            let (c, d, e) = (coordinate - 3, (coordinate - 2) % 3, (coordinate - 1) % 3);
            *extension = (r[e][d] - r[d][e]) * 0.5;
            let mut about = Vector([r[c][0], r[c][1], r[c][2]]).scale::<f64, S>(-0.5);
            about.0[c] = (r[d][d] + r[e][e]) * 0.5;
            let about: Vector<S> = axes.apply(about);
            for k in 0..3 {
                row[3 + k] = a.angles[k].dot(about);
                row[9 + k] = -b.angles[k].dot::<S, S>(about);
            }
        }
        levers
    }

    /// Returns the same from the coordinates of all bodies.
    #[inline(always)]
    pub(super) fn levers_at(&self, positions: &[[f64; 6]]) -> Levers<f64, D> {
        self.levers([positions[self.ends[0].body], positions[self.ends[1].body]])
    }

    /// Returns the derivatives of the geometry by the coordinates, at forces along the extensions.
    pub(super) fn change(&self, positions: &[[f64; 6]], rates: &[[f64; 6]], forces: &[f64]) -> Change<D> {
        // By the six angles; a displacement changes no lever but those of angles, as they change its own.
        let seeded = |end: usize| -> [Dual<6>; 6] {
            let own = &positions[self.ends[end].body];
            std::array::from_fn(|k| match k {
                0..3 => Dual::from(own[k]),
                _ => Dual::variable(own[k], 3 * end + k - 3),
            })
        };
        let levers = self.levers([seeded(0), seeded(1)]);
        let speeds = self.both(rates);
        let mut change = Change {
            levers: [[0.0; 12]; D],
            lever_rates: [[0.0; 12]; D],
            stiffness: [[0.0; 12]; 12],
        };
        for c in 0..D {
            let row = &levers.by_coordinates[c];
            let force = forces[c];
            for j in 0..12 {
                change.levers[c][j] = row[j].value;
                for (seed, by) in row[j].derivative.into_iter().enumerate() {
                    let angle = if seed < 3 { 3 + seed } else { 6 + seed };
                    change.lever_rates[c][angle] += by * speeds[j];
                    change.stiffness[j][angle] += force * by;
                    if j % 6 < 3 {
                        change.lever_rates[c][j] += by * speeds[angle];
                        change.stiffness[angle][j] += force * by;
                    }
                }
            }
        }
        change
    }
}
