//! The tangent of a force element: how its wrench changes with the relative motion of the markers at its
//! ends.
//!
//! With χ = (d, φ) the position and rotation of marker A relative to marker B, χ˙ = (v, ω) the relative
//! twist, all in the axes of B, and (F, M) the wrench on A, the tangent holds the columns of
//! `∂(F, M, powers)/∂(d, φ, v, ω)`: stiffness and damping, but for their signs. φ is a small rotation in
//! addition to R: `δR = φ × R`. The chain rule for the coordinates of the two bodies is the same for all
//! elements ([`crate::system`]); so an element states one function over any scalar, and its derivatives come
//! from [`Tangent::of`].

use numerics::lanes::Lanes;
use numerics::scalar::Dual;

use crate::element::{Element, Inputs, Wrench};
use crate::link::RelativeMotion;
use crate::vector::{Matrix, Vector};

impl Wrench<Dual<1>> {
    /// Returns the wrench of a tangent with a change as its derivative; the powers have no value.
    #[inline(always)]
    pub(crate) fn with_change(tangent: &Tangent, change: &TangentColumn) -> Self {
        let [[fx, fy, fz, first], [mx, my, mz, second]] = change.map(Lanes::to_array);
        let dual = |value: f64, derivative: f64| Dual {
            value,
            derivative: [derivative],
        };
        let with = |v: Vector<f64>, change: [f64; 3]| Vector([0, 1, 2].map(|i| dual(v.0[i], change[i])));
        Self {
            force: with(tangent.force, [fx, fy, fz]),
            moment: with(tangent.moment, [mx, my, mz]),
            powers: [dual(0.0, first), dual(0.0, second)],
        }
    }
}

/// A change of eight quantities: of a wrench those of force and first power, moment and second power.
pub(crate) type TangentColumn = [Lanes; 2];

/// No change.
pub(crate) const NO_CHANGE: TangentColumn = [Lanes::ZERO; 2];

/// A small change of a relative motion, axes of marker B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Change {
    /// Of the position d.
    pub position: Vector<f64>,
    /// The small rotation φ.
    pub rotation: Vector<f64>,
    /// Of the velocity v.
    pub velocity: Vector<f64>,
    /// Of the angular velocity ω.
    pub angular_velocity: Vector<f64>,
}

/// Derivatives of up to eight quantities by the relative motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TangentColumns {
    /// By the position d.
    pub position: [TangentColumn; 3],
    /// By the rotation φ.
    pub rotation: [TangentColumn; 3],
    /// By the velocity v.
    pub velocity: [TangentColumn; 3],
    /// By the angular velocity ω.
    pub angular_velocity: [TangentColumn; 3],
}

/// The wrench of an element, and its derivatives and those of its powers by the relative motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tangent {
    /// Force, N.
    pub force: Vector<f64>,
    /// Moment about marker A, N·m.
    pub moment: Vector<f64>,
    /// The derivatives.
    pub by: TangentColumns,
}

/// Derivatives of and by the pair of internal states of an element.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StateTangent {
    /// Of both rates, in the first place of both halves, by the relative motion.
    pub rates: TangentColumns,
    /// Of wrench and powers by the states.
    pub wrench: [TangentColumn; 2],
    /// Of the rates by the states, row by row.
    pub own: [f64; 4],
}

impl StateTangent {
    /// No derivatives.
    pub const NONE: Self = Self {
        rates: TangentColumns::NONE,
        wrench: [NO_CHANGE; 2],
        own: [0.0; 4],
    };
}

/// `Σ_i weights_i columns_i`.
#[inline(always)]
pub(crate) fn combined(columns: &[TangentColumn; 3], weights: Vector<f64>) -> TangentColumn {
    let [x, y, z] = weights.0;
    [0, 1].map(|o| columns[0][o] * x + columns[1][o] * y + columns[2][o] * z)
}

/// Returns the sum of two changes.
#[inline(always)]
pub(crate) fn sum(a: TangentColumn, b: TangentColumn) -> TangentColumn {
    [a[0] + b[0], a[1] + b[1]]
}

/// Returns the force of a column.
#[inline(always)]
pub(crate) fn force_of(column: &TangentColumn) -> Vector<f64> {
    let [x, y, z, _] = column[0].to_array();
    Vector([x, y, z])
}

/// Returns the moment of a column.
#[inline(always)]
pub(crate) fn moment_of(column: &TangentColumn) -> Vector<f64> {
    let [x, y, z, _] = column[1].to_array();
    Vector([x, y, z])
}

impl Tangent {
    /// No wrench, and no derivatives.
    pub const NONE: Self = Self {
        force: Vector([0.0; 3]),
        moment: Vector([0.0; 3]),
        by: TangentColumns::NONE,
    };

    /// Returns the tangent of the wrench and the powers times a factor.
    #[inline(always)]
    pub fn times(self, factor: f64) -> Self {
        if factor == 1.0 {
            return self;
        }
        let columns = |own: [TangentColumn; 3]| own.map(|column| column.map(|lanes| lanes * factor));
        Self {
            force: self.force.scale(factor),
            moment: self.moment.scale(factor),
            by: TangentColumns {
                position: columns(self.by.position),
                rotation: columns(self.by.rotation),
                velocity: columns(self.by.velocity),
                angular_velocity: columns(self.by.angular_velocity),
            },
        }
    }

    /// Returns the tangent of a law that is written over any scalar.
    #[inline(always)]
    pub fn of(inputs: Inputs, relative: &RelativeMotion<f64>, law: &impl Element) -> Self {
        match inputs {
            Inputs::Points => Self::by_columns(&law.evaluate(&seeded::<6>(relative))),
            Inputs::Motion => {
                let (wrench, _) = law.evaluate_with(&seeded::<12>(relative), [Dual::from(0.0); 2]);
                Self::by_columns(&wrench)
            }
        }
    }

    /// Returns the tangent of a law with internal states, and the derivatives of and by these.
    pub fn with_states(
        relative: &RelativeMotion<f64>,
        states: [f64; 2],
        law: &impl Element,
    ) -> (Self, StateTangent) {
        let (wrench, rates) = law.evaluate_with(&seeded::<12>(relative), states.map(Dual::from));
        let of_rates = |k: usize| rates.map(|rate| Lanes::new([rate.derivative[k], 0.0, 0.0, 0.0]));
        let rows = |first: usize| [0, 1, 2].map(|k| of_rates(first + k));
        // On their own: numbers with 14 derivatives of every law would be more code.
        let lifted = RelativeMotion {
            position: Vector::lift(relative.position),
            rotation: Matrix::lift(relative.rotation),
            velocity: Vector::lift(relative.velocity),
            angular_velocity: Vector::lift(relative.angular_velocity),
        };
        let own = [0, 1].map(|k| Dual::<2>::variable(states[k], k));
        let (by_states, [first, second]) = law.evaluate_with(&lifted, own);
        let states = StateTangent {
            rates: TangentColumns {
                position: rows(0),
                velocity: rows(3),
                rotation: rows(6),
                angular_velocity: rows(9),
            },
            wrench: [0, 1].map(|k| column(&by_states, k)),
            own: [
                first.derivative[0],
                first.derivative[1],
                second.derivative[0],
                second.derivative[1],
            ],
        };
        (Self::by_columns(&wrench), states)
    }

    /// Returns the tangent of a wrench with `N` derivatives: by position and velocity, and from 12 on by
    /// rotation and angular velocity.
    #[inline(always)]
    fn by_columns<const N: usize>(wrench: &Wrench<Dual<N>>) -> Self {
        let mut tangent = Self {
            force: wrench.force.value(),
            moment: wrench.moment.value(),
            ..Self::NONE
        };
        for k in 0..3 {
            tangent.by.position[k] = column(wrench, k);
            tangent.by.velocity[k] = column(wrench, 3 + k);
            if N >= 12 {
                tangent.by.rotation[k] = column(wrench, 6 + k);
                tangent.by.angular_velocity[k] = column(wrench, 9 + k);
            }
        }
        tangent
    }
}

/// Returns the derivatives of a wrench and its powers by the input with this number.
#[inline(always)]
fn column<const N: usize>(wrench: &Wrench<Dual<N>>, k: usize) -> TangentColumn {
    let lanes = |v: &Vector<Dual<N>>, power: &Dual<N>| {
        let [x, y, z] = &v.0;
        Lanes::new([x, y, z, power].map(|value| value.derivative[k]))
    };
    [
        lanes(&wrench.force, &wrench.powers[0]),
        lanes(&wrench.moment, &wrench.powers[1]),
    ]
}

/// Returns a motion as variables: position and velocity, and from 12 on rotation and angular velocity.
#[inline(always)]
fn seeded<const N: usize>(relative: &RelativeMotion<f64>) -> RelativeMotion<Dual<N>> {
    let seed = |vector: Vector<f64>, first: usize| {
        Vector(std::array::from_fn(|i| {
            Dual::<N>::variable(vector.0[i], first + i)
        }))
    };
    let mut rotation = Matrix::<Dual<N>>::lift(relative.rotation);
    let mut angular_velocity = Vector::lift(relative.angular_velocity);
    if N >= 12 {
        angular_velocity = seed(relative.angular_velocity, 9);
        for j in 0..3 {
            let [x, y, z] = relative.rotation.column(j).0;
            // e_k × column, for the three axes
            for (k, moved) in [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]].into_iter().enumerate() {
                for (i, moved) in moved.into_iter().enumerate() {
                    rotation.0[i][j].derivative[6 + k] = moved;
                }
            }
        }
    }
    RelativeMotion {
        position: seed(relative.position, 0),
        rotation,
        velocity: seed(relative.velocity, 3),
        angular_velocity,
    }
}

impl TangentColumns {
    /// No derivatives.
    pub const NONE: Self = Self {
        position: [NO_CHANGE; 3],
        rotation: [NO_CHANGE; 3],
        velocity: [NO_CHANGE; 3],
        angular_velocity: [NO_CHANGE; 3],
    };

    /// Returns the change along a change of the relative motion.
    #[inline(always)]
    pub fn along(&self, change: &Change) -> TangentColumn {
        sum(
            sum(
                combined(&self.position, change.position),
                combined(&self.rotation, change.rotation),
            ),
            sum(
                combined(&self.velocity, change.velocity),
                combined(&self.angular_velocity, change.angular_velocity),
            ),
        )
    }
}

impl Change {
    /// No change.
    pub const NONE: Self = Self {
        position: Vector([0.0; 3]),
        rotation: Vector([0.0; 3]),
        velocity: Vector([0.0; 3]),
        angular_velocity: Vector([0.0; 3]),
    };

    /// Returns the change that a relative motion carries as its only derivative.
    pub fn of(relative: &RelativeMotion<Dual<1>>) -> Self {
        let part = |v: &Vector<Dual<1>>| Vector([0, 1, 2].map(|i| v.0[i].derivative[0]));
        let Matrix(r) = &relative.rotation;
        // δR Rᵀ is the skew matrix of φ.
        let entry =
            |i: usize, j: usize| -> f64 { (0..3).map(|k| r[i][k].derivative[0] * r[j][k].value).sum() };
        Self {
            position: part(&relative.position),
            rotation: Vector([entry(2, 1), entry(0, 2), entry(1, 0)]),
            velocity: part(&relative.velocity),
            angular_velocity: part(&relative.angular_velocity),
        }
    }
}
