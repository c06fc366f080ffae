//! The chain rule of an element: derivatives of the relative motion by the coordinates of the bodies at both
//! ends, and the generalized forces of its wrench there. This part of the Jacobian is the same for all
//! elements.
//!
//! Marker A is on body a at `arm` from its origin, D leads from the origin of body b to it, all in the axes
//! of marker B. c are the axes of a body's reference frame, α and β those of the angles of a and b, and δω is
//! the change of an angular velocity at fixed rates of the angles. v and ω are the relative velocities, s the
//! angular velocity of b in its frame, Ω that of the frame of a relative to b:
//!
//! ```text
//!                     δd        φ    δv                          δω
//! position of a       c         0    Ω × c                       0
//! angle of a          α × arm   α    δω × arm + ω × (α × arm)    δω
//! rate of a                          c; α × arm                  0; α
//! position of b       -c        0    s × c                       0
//! angle of b          -β × D    -β   -β × v - δω × D             -β × ω - δω
//! rate of b                          -c; -β × D                  0; -β
//! ```
//!
//! The wrench (F, M) acts on a as the force F and the moment `M + arm × F` about its origin, on b as -F and
//! `-(M + D × F)`; the axes in which it is given rotate with b.

use numerics::lanes::Lanes;

use super::{FreeBody, Mounted};
use crate::body::Kinematics;
use crate::body::RotationAxes;
use crate::element::tangent::{
    Change, Tangent, TangentColumn, TangentColumns, combined, force_of, moment_of, sum,
};
use crate::link::RelativeMotion;
use crate::vector::{Matrix, Vector};

/// The rows of a generalized force at a body: of its translations (axes of its reference frame), and of its
/// free angles.
pub(super) type Rows = [Lanes; 2];

/// The derivatives of the load on a body by coordinates (first) and by their rates.
pub(super) type Block = [[Rows; 6]; 2];

/// No derivatives.
pub(super) const NO_BLOCK: Block = [[[Lanes::ZERO; 2]; 6]; 2];

/// Adds a block to the blocks of a body by the `n` coordinates of another or of itself.
#[inline(always)]
pub(super) fn add_block(
    block: &Block,
    free: &FreeBody,
    n: usize,
    (stiffness, damping): (&mut [f64], &mut [f64]),
) {
    for row in 0..free.free.len() {
        let (part, component) = free.row(row);
        for (target, columns) in [&mut *stiffness, &mut *damping].into_iter().zip(block) {
            for (entry, column) in target[row * n..][..n].iter_mut().zip(columns) {
                *entry += column[part].at(component);
            }
        }
    }
}

impl FreeBody {
    /// Returns the index of the row of a free coordinate in [`Rows`].
    #[inline(always)]
    pub(super) fn row(&self, index: usize) -> (usize, usize) {
        if index < self.translations {
            (0, self.free[index])
        } else {
            (1, index - self.translations)
        }
    }

    /// Returns the number of free angles.
    #[inline(always)]
    pub(super) fn angles(&self) -> usize {
        self.free.len() - self.translations
    }
}

/// Components of a vector (marker axes) along up to four other directions.
#[derive(Clone, Copy)]
struct Projection([Lanes; 3]);

impl Projection {
    /// Returns the components along these directions (marker axes).
    #[inline(always)]
    fn new(directions: [Vector<f64>; 4]) -> Self {
        let component = |i: usize| Lanes::new(std::array::from_fn(|k| directions[k].0[i]));
        Self([component(0), component(1), component(2)])
    }

    #[inline(always)]
    fn of(&self, v: Vector<f64>) -> Lanes {
        let [x, y, z] = v.0;
        self.0[0] * x + self.0[1] * y + self.0[2] * z
    }
}

/// Derivatives of the relative motion by the coordinates of the body at one end.
struct End {
    /// Derivatives of d by positions, and of v by their rates.
    ways: [Vector<f64>; 3],
    /// Derivatives of v by positions.
    carried: [Vector<f64>; 3],
    /// Derivatives by the angles. Those of v and ω by their rates equal those of d and φ by the angles.
    angles: [Change; 3],
    /// The axes of the body's reference frame (with a fourth direction), and of its free angles.
    along: Projection,
    about: Projection,
}

impl End {
    #[inline(always)]
    fn by_position(&self, free: &FreeBody, index: usize, columns: &TangentColumns) -> TangentColumn {
        match free.row(index) {
            (0, k) => sum(
                combined(&columns.position, self.ways[k]),
                combined(&columns.velocity, self.carried[k]),
            ),
            (_, l) => columns.along(&self.angles[l]),
        }
    }

    #[inline(always)]
    fn by_rate(&self, free: &FreeBody, index: usize, columns: &TangentColumns) -> TangentColumn {
        match free.row(index) {
            (0, k) => combined(&columns.velocity, self.ways[k]),
            (_, l) => {
                let change = &self.angles[l];
                sum(
                    combined(&columns.angular_velocity, change.rotation),
                    combined(&columns.velocity, change.position),
                )
            }
        }
    }

    /// Returns the rows of a force and a moment about the body's origin (marker axes).
    #[inline(always)]
    fn rows(&self, force: Vector<f64>, moment: Vector<f64>) -> Rows {
        [self.along.of(force), self.about.of(moment)]
    }
}

/// An element with its tangent, its relative motion, and the two ends.
pub(super) struct Chain<'c> {
    tangent: &'c Tangent,
    /// Marker A from the origins of the two bodies.
    arm: Vector<f64>,
    reach: Vector<f64>,
    /// Angular velocity of a prescribed marker, and marker A from it.
    spin: Option<(Vector<f64>, Vector<f64>)>,
    a: End,
    b: Option<End>,
}

fn cross(a: Vector<f64>, b: Vector<f64>) -> Vector<f64> {
    a.cross(b)
}

impl<'c> Chain<'c> {
    /// Returns the chain of an element; `arm` leads from the origin of body a to marker A in the axes of the
    /// marker, `relative` is the motion of marker A.
    #[inline(always)]
    pub fn new<E>(
        mounted: &'c Mounted<E>,
        relative: &RelativeMotion<f64>,
        arm: Vector<f64>,
        [a, b]: [&RotationAxes; 2],
        on: &Kinematics<f64>,
    ) -> Self {
        let relative_frame = &mounted.relative_frame;
        let to_marker = |v: Vector<f64>| -> Vector<f64> { relative.rotation.apply(v) };
        let ways = [0, 1, 2].map(|k| relative_frame.rotation.column(k));
        let axes = a.axes.map(to_marker);
        let mut angles = [Change::NONE; 3];
        for (l, axis) in axes.iter().enumerate() {
            let axis_rate = to_marker(cross(a.axes[l], a.spin) + a.axis_rates[l]);
            let position = cross(*axis, arm);
            angles[l] = Change {
                position,
                rotation: *axis,
                velocity: cross(axis_rate, arm) + cross(relative.angular_velocity, position),
                angular_velocity: axis_rate,
            };
        }
        let end_a = End {
            carried: ways.map(|way| cross(relative_frame.angular_velocity, way)),
            along: Projection::new([ways[0], ways[1], ways[2], relative_frame.marker_velocity]),
            about: Projection::new([axes[0], axes[1], axes[2], Vector::zero()]),
            ways,
            angles,
        };
        let seat: Vector<f64> = mounted.marker.rotation.apply_transposed(mounted.marker.origin);
        let reach = relative.position + seat;
        let end_b = mounted.on_free.then(|| {
            let to_frame: Matrix<f64> = on.orientation.rotation.times(mounted.marker.rotation);
            let to_marker = |v: Vector<f64>| -> Vector<f64> { mounted.marker.rotation.apply_transposed(v) };
            let spin = to_marker(b.spin);
            let directions = to_frame.0.map(Vector);
            let axes = b.axes.map(to_marker);
            let mut angles = [Change::NONE; 3];
            for (l, axis) in axes.iter().enumerate() {
                let axis_rate = to_marker(cross(b.axes[l], b.spin) + b.axis_rates[l]);
                angles[l] = Change {
                    position: -cross(*axis, reach),
                    rotation: -*axis,
                    velocity: -cross(*axis, relative.velocity) - cross(axis_rate, reach),
                    angular_velocity: -cross(*axis, relative.angular_velocity) - axis_rate,
                };
            }
            let [x, y, z] = directions;
            End {
                ways: directions.map(|way| -way),
                carried: directions.map(|way| cross(spin, way)),
                angles,
                along: Projection::new([x, y, z, Vector::zero()]),
                about: Projection::new([axes[0], axes[1], axes[2], Vector::zero()]),
            }
        });
        Self {
            tangent: &mounted.tangent,
            arm,
            reach,
            spin: mounted
                .prescribed
                .then_some((relative_frame.marker_angular_velocity, relative.position)),
            a: end_a,
            b: end_b,
        }
    }

    /// Returns the moment about the origin of body a of a force and a moment about marker A.
    #[inline(always)]
    fn about_a(&self, force: Vector<f64>, moment: Vector<f64>) -> Vector<f64> {
        moment + cross(self.arm, force)
    }

    /// Returns the rows at body b of a force and a moment about marker A on body a.
    #[inline(always)]
    fn rows_of_b(&self, b: &End, force: Vector<f64>, moment: Vector<f64>) -> Rows {
        b.rows(-force, -(moment + cross(self.reach, force)))
    }

    /// Returns the moment on body a about its origin, marker axes.
    pub fn moment_on_a(&self) -> Vector<f64> {
        self.about_a(self.tangent.force, self.tangent.moment)
    }

    /// Returns the moment on body b about its origin, marker axes.
    pub fn moment_on_b(&self) -> Vector<f64> {
        -(self.tangent.moment + cross(self.reach, self.tangent.force))
    }

    /// The derivatives by the coordinates of body a: of the load on it, added to `own`; of that on body b,
    /// added to `other`; and of the powers of the element and of a marker that translates.
    #[inline(always)]
    pub fn by_a(&self, free: &FreeBody, own: &mut Block, other: &mut Block, powers: &mut Powers) {
        let (force, moment) = (self.tangent.force, self.moment_on_a());
        for j in 0..free.free.len() {
            let column = self.a.by_position(free, j, &self.tangent.by);
            let (df, dm) = (force_of(&column), moment_of(&column));
            let mut about = self.about_a(df, dm);
            let moved = match free.row(j) {
                (0, k) => self.a.ways[k],
                (_, l) => {
                    let change = &self.a.angles[l];
                    about = about + cross(change.position, force) - cross(change.rotation, moment);
                    change.position
                }
            };
            let rate = self.a.by_rate(free, j, &self.tangent.by);
            let (rf, rm) = (force_of(&rate), moment_of(&rate));
            let rows = [self.a.rows(df, about), self.a.rows(rf, self.about_a(rf, rm))];
            let mut prescribed = [rows[0][0].at(3), rows[1][0].at(3)];
            if let Some((spin, position)) = self.spin {
                let by_position = dm + cross(moved, force) + cross(position, df);
                prescribed[0] += spin.dot::<f64, f64>(by_position);
                prescribed[1] += spin.dot::<f64, f64>(rm + cross(position, rf));
            }
            powers.keep(j, [&column, &rate], prescribed);
            for (block, rows) in own.iter_mut().zip(rows) {
                add(&mut block[j], rows);
            }
            if let Some(b) = &self.b {
                add(&mut other[0][j], self.rows_of_b(b, df, dm + cross(moved, force)));
                add(&mut other[1][j], self.rows_of_b(b, rf, rm));
            }
        }
    }

    /// The derivatives by the coordinates of body b: of the load on it, added to `own`; of that on body a,
    /// added to `other`; and of the powers.
    #[inline(always)]
    pub fn by_b(&self, free: &FreeBody, own: &mut Block, other: &mut Block, powers: &mut Powers) {
        let Some(b) = &self.b else {
            return;
        };
        let (force, moment) = (self.tangent.force, self.tangent.moment);
        for j in 0..free.free.len() {
            let column = b.by_position(free, j, &self.tangent.by);
            let (df, dm) = (force_of(&column), moment_of(&column));
            let (mut turned_force, mut turned_moment) = (df, dm);
            let moved = match free.row(j) {
                (0, k) => b.ways[k],
                (_, l) => {
                    // Vectors of body a rotate against the axes of b.
                    let change = &b.angles[l];
                    turned_force = turned_force - cross(change.rotation, force);
                    turned_moment = turned_moment - cross(change.rotation, moment);
                    change.position
                }
            };
            let on_b = dm + cross(moved, force) + cross(self.reach, df);
            add(&mut own[0][j], b.rows(-turned_force, -on_b));
            let on_a = self.about_a(turned_force, turned_moment);
            add(&mut other[0][j], self.a.rows(turned_force, on_a));
            let rate = b.by_rate(free, j, &self.tangent.by);
            let (rf, rm) = (force_of(&rate), moment_of(&rate));
            add(&mut own[1][j], self.rows_of_b(b, rf, rm));
            add(&mut other[1][j], self.a.rows(rf, self.about_a(rf, rm)));
            powers.keep(j, [&column, &rate], [0.0; 2]);
        }
    }

    /// Returns the derivatives of other quantities by position and rate of coordinate `index` of the body at
    /// an end.
    #[inline(always)]
    pub fn others(
        &self,
        side: usize,
        free: &FreeBody,
        index: usize,
        columns: &TangentColumns,
    ) -> [TangentColumn; 2] {
        let end = match &self.b {
            Some(b) if side == 1 => b,
            _ => &self.a,
        };
        [
            end.by_position(free, index, columns),
            end.by_rate(free, index, columns),
        ]
    }

    /// Returns the rows of a force and a moment about marker A at the body at an end.
    #[inline(always)]
    pub fn load(&self, side: usize, force: Vector<f64>, moment: Vector<f64>) -> Rows {
        match &self.b {
            Some(b) if side == 1 => self.rows_of_b(b, force, moment),
            _ => self.a.rows(force, self.about_a(force, moment)),
        }
    }
}

/// Derivatives of the powers of an element and of the prescribed motion of its marker, by coordinates (first)
/// and rates.
pub(super) struct Powers([[[f64; 6]; 3]; 2]);

impl Powers {
    /// None.
    pub const NONE: Self = Self([[[0.0; 6]; 3]; 2]);

    #[inline(always)]
    fn keep(&mut self, j: usize, columns: [&TangentColumn; 2], prescribed: [f64; 2]) {
        for ((own, column), prescribed) in self.0.iter_mut().zip(columns).zip(prescribed) {
            own[0][j] = column[0].at(3);
            own[1][j] = column[1].at(3);
            own[2][j] = prescribed;
        }
    }

    /// Returns the derivatives by coordinates and by rates of the power with this number.
    #[inline(always)]
    pub fn of(&self, power: usize) -> [&[f64; 6]; 2] {
        [&self.0[0][power], &self.0[1][power]]
    }
}

#[inline(always)]
fn add(sum: &mut Rows, term: Rows) {
    sum[0] += term[0];
    sum[1] += term[1];
}
