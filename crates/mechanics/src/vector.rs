//! Vectors and matrices of three, generic over the scalar.
//!
//! Products may mix a plain matrix with a vector that carries derivatives: quantities that are constant in a
//! pass of differentiation cost no derivative arithmetic.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

use numerics::scalar::{Number, Real};

/// A vector of three components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector<S>(pub [S; 3]);

/// A 3 × 3 matrix by rows; mostly a rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrix<S>(pub [[S; 3]; 3]);

impl<S: Number> Vector<S> {
    /// Returns the zero vector.
    #[inline(always)]
    #[must_use]
    pub fn zero() -> Self {
        Self([S::zero(); 3])
    }
    /// Returns a plain vector as one with derivatives that are zero.
    #[inline(always)]
    #[must_use]
    pub fn lift(v: Vector<f64>) -> Self {
        Self([S::from(v.0[0]), S::from(v.0[1]), S::from(v.0[2])])
    }
    /// Returns the scalar product.
    #[inline(always)]
    #[must_use]
    pub fn dot<R: Copy, O>(self, o: Vector<R>) -> O
    where
        S: Mul<R, Output = O>,
        O: Add<Output = O>,
    {
        self.0[0] * o.0[0] + self.0[1] * o.0[1] + self.0[2] * o.0[2]
    }
    /// Returns the vector product.
    #[inline(always)]
    #[must_use]
    pub fn cross<R: Copy, O>(self, o: Vector<R>) -> Vector<O>
    where
        S: Mul<R, Output = O>,
        O: Sub<Output = O>,
    {
        let (a, b) = (self.0, o.0);
        Vector([
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ])
    }
    /// This vector times a number.
    #[inline(always)]
    #[must_use]
    pub fn scale<R: Copy, O>(self, factor: R) -> Vector<O>
    where
        S: Mul<R, Output = O>,
    {
        Vector([self.0[0] * factor, self.0[1] * factor, self.0[2] * factor])
    }
}

impl<S: Number> Matrix<S> {
    /// Returns the unit matrix.
    #[inline(always)]
    #[must_use]
    pub fn identity() -> Self {
        let (o, i) = (S::zero(), S::from(1.0));
        Self([[i, o, o], [o, i, o], [o, o, i]])
    }
    /// Returns a plain matrix as one with derivatives that are zero.
    #[inline(always)]
    #[must_use]
    pub fn lift(m: Matrix<f64>) -> Self {
        let row = |i: usize| Vector::<S>::lift(Vector(m.0[i])).0;
        Self([row(0), row(1), row(2)])
    }
    /// Returns the transposed matrix.
    #[inline(always)]
    #[must_use]
    pub fn transpose(self) -> Self {
        let m = self.0;
        Self([
            [m[0][0], m[1][0], m[2][0]],
            [m[0][1], m[1][1], m[2][1]],
            [m[0][2], m[1][2], m[2][2]],
        ])
    }
    /// Returns one column.
    #[inline(always)]
    #[must_use]
    pub fn column(self, j: usize) -> Vector<S> {
        Vector([self.0[0][j], self.0[1][j], self.0[2][j]])
    }
    /// This matrix times a vector.
    #[inline(always)]
    #[must_use]
    pub fn apply<R: Copy, O>(self, v: Vector<R>) -> Vector<O>
    where
        S: Mul<R, Output = O>,
        O: Add<Output = O>,
    {
        // Written out: `array::map` is not always inlined.
        let row = |i: usize| {
            let row = &self.0[i];
            row[0] * v.0[0] + row[1] * v.0[1] + row[2] * v.0[2]
        };
        Vector([row(0), row(1), row(2)])
    }
    /// Returns the transposed matrix times a vector.
    #[inline(always)]
    #[must_use]
    pub fn apply_transposed<R: Copy, O>(self, v: Vector<R>) -> Vector<O>
    where
        S: Mul<R, Output = O>,
        O: Add<Output = O>,
    {
        self.transpose().apply(v)
    }
    /// This matrix times another.
    #[inline(always)]
    #[must_use]
    pub fn times<R: Copy, O>(self, o: Matrix<R>) -> Matrix<O>
    where
        S: Mul<R, Output = O>,
        O: Copy + Add<Output = O>,
    {
        let entry = |i: usize, j: usize| {
            let row = &self.0[i];
            row[0] * o.0[0][j] + row[1] * o.0[1][j] + row[2] * o.0[2][j]
        };
        let row = |i: usize| [entry(i, 0), entry(i, 1), entry(i, 2)];
        Matrix([row(0), row(1), row(2)])
    }
}

impl<S: Real> Vector<S> {
    /// Returns the values without derivatives.
    #[inline(always)]
    #[must_use]
    pub fn value(self) -> Vector<f64> {
        Vector([self.0[0].value(), self.0[1].value(), self.0[2].value()])
    }
}

impl<S: Real> Matrix<S> {
    /// Returns the values without derivatives.
    #[inline(always)]
    #[must_use]
    pub fn value(self) -> Matrix<f64> {
        let row = |i: usize| Vector(self.0[i]).value().0;
        Matrix([row(0), row(1), row(2)])
    }
}

/// Returns the rotation about +x by the angle with this sine and cosine.
#[inline(always)]
#[must_use]
pub fn rotation_x<S: Number>((s, c): (S, S)) -> Matrix<S> {
    let (o, i) = (S::zero(), S::from(1.0));
    Matrix([[i, o, o], [o, c, -s], [o, s, c]])
}

/// Returns the rotation about +y by the angle with this sine and cosine.
#[inline(always)]
#[must_use]
pub fn rotation_y<S: Number>((s, c): (S, S)) -> Matrix<S> {
    let (o, i) = (S::zero(), S::from(1.0));
    Matrix([[c, o, s], [o, i, o], [-s, o, c]])
}

/// Returns the rotation about +z by the angle with this sine and cosine.
#[inline(always)]
#[must_use]
pub fn rotation_z<S: Number>((s, c): (S, S)) -> Matrix<S> {
    let (o, i) = (S::zero(), S::from(1.0));
    Matrix([[c, -s, o], [s, c, o], [o, o, i]])
}

impl<S: Copy + Add<R, Output = O>, R: Copy, O> Add<Vector<R>> for Vector<S> {
    type Output = Vector<O>;
    #[inline(always)]
    fn add(self, o: Vector<R>) -> Vector<O> {
        Vector([self.0[0] + o.0[0], self.0[1] + o.0[1], self.0[2] + o.0[2]])
    }
}

impl<S: Copy + Sub<R, Output = O>, R: Copy, O> Sub<Vector<R>> for Vector<S> {
    type Output = Vector<O>;
    #[inline(always)]
    fn sub(self, o: Vector<R>) -> Vector<O> {
        Vector([self.0[0] - o.0[0], self.0[1] - o.0[1], self.0[2] - o.0[2]])
    }
}

impl<S: Number> AddAssign for Vector<S> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl<S: Number> Neg for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self([-self.0[0], -self.0[1], -self.0[2]])
    }
}
