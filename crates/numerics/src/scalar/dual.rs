//! Numbers with derivatives: forward automatic differentiation.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use wide::f64x2;

use super::{Blend, Number, Real, tanh_ratio};

/// The components of values and derivatives: real numbers, or lanes of them.
pub trait Component: Number<Plain = Self> + Mul<Self, Output = Self> {
    /// Returns [`Number::tanh_ratio`] and its derivative.
    fn tanh_ratio_and_slope(self) -> (Self, Self);
    /// Returns `a_i s + b_i t`.
    fn combine<const N: usize>(a: &[Self; N], s: Self, b: &[Self; N], t: Self) -> [Self; N];
    /// Returns `a_i s`.
    fn scale<const N: usize>(a: &[Self; N], s: Self) -> [Self; N];
}

/// A value with its `N` partial derivatives, over real numbers ([`Dual`]) or lanes
/// ([`crate::lanes::LaneDual`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DualOf<S, const N: usize> {
    /// The value.
    pub value: S,
    /// The partial derivatives.
    pub derivative: [S; N],
}

/// A real number with its `N` partial derivatives.
///
/// ```
/// use numerics::scalar::{Dual, Number};
/// let x = Dual::<1>::variable(0.5, 0);
/// let y = x * x + x.sin_cos().0;
/// assert_eq!(y.derivative[0], 2.0 * 0.5 + libm::cos(0.5));
/// ```
pub type Dual<const N: usize> = DualOf<f64, N>;

impl Component for f64 {
    #[inline(always)]
    fn tanh_ratio_and_slope(self) -> (f64, f64) {
        tanh_ratio(self)
    }
    /// Returns two derivatives at a time.
    #[inline(always)]
    fn combine<const N: usize>(a: &[f64; N], s: f64, b: &[f64; N], t: f64) -> [f64; N] {
        let (s, t) = (f64x2::splat(s), f64x2::splat(t));
        let mut out = [0.0; N];
        for i in 0..N / 2 {
            let (a, b) = ([a[2 * i], a[2 * i + 1]], [b[2 * i], b[2 * i + 1]]);
            let [x, y] = (f64x2::new(a) * s + f64x2::new(b) * t).to_array();
            (out[2 * i], out[2 * i + 1]) = (x, y);
        }
        if N % 2 == 1 {
            out[N - 1] = (f64x2::splat(a[N - 1]) * s + f64x2::splat(b[N - 1]) * t).to_array()[0];
        }
        out
    }
    #[inline(always)]
    fn scale<const N: usize>(a: &[f64; N], s: f64) -> [f64; N] {
        let s = f64x2::splat(s);
        let mut out = [0.0; N];
        for i in 0..N / 2 {
            let [x, y] = (f64x2::new([a[2 * i], a[2 * i + 1]]) * s).to_array();
            (out[2 * i], out[2 * i + 1]) = (x, y);
        }
        if N % 2 == 1 {
            out[N - 1] = (f64x2::splat(a[N - 1]) * s).to_array()[0];
        }
        out
    }
}

impl<S: Component, const N: usize> DualOf<S, N> {
    /// Returns the independent variable number `index`.
    #[inline(always)]
    #[must_use]
    pub fn variable(value: S, index: usize) -> Self {
        let mut derivative = [S::zero(); N];
        derivative[index] = S::from(1.0);
        Self { value, derivative }
    }
}

impl<S: Component, const N: usize> From<f64> for DualOf<S, N> {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self::lift(S::from(value))
    }
}

impl<M: Copy, S: Component + Blend<M>, const N: usize> Blend<M> for DualOf<S, N> {
    #[inline(always)]
    fn blend(mask: M, yes: Self, no: Self) -> Self {
        let mut derivative = no.derivative;
        for i in 0..N {
            derivative[i] = S::blend(mask, yes.derivative[i], no.derivative[i]);
        }
        Self {
            value: S::blend(mask, yes.value, no.value),
            derivative,
        }
    }
}

impl<S: Component, const N: usize> Number for DualOf<S, N> {
    type Mask = S::Mask;
    type Plain = S;
    #[inline(always)]
    fn plain(self) -> S {
        self.value
    }
    #[inline(always)]
    fn lift(value: S) -> Self {
        Self {
            value,
            derivative: [S::zero(); N],
        }
    }
    #[inline(always)]
    fn by(self, factor: S) -> Self {
        self.chain(self.value * factor, factor)
    }
    #[inline(always)]
    fn below(self, bound: S) -> S::Mask {
        self.value.below(bound)
    }
    #[inline(always)]
    fn at_most(self, bound: S) -> S::Mask {
        self.value.at_most(bound)
    }
    #[inline(always)]
    fn chain(self, value: S, slope: S) -> Self {
        Self {
            value,
            derivative: S::scale(&self.derivative, slope),
        }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, S::from(0.5) / root)
    }
    #[inline(always)]
    fn tanh_ratio(self) -> Self {
        let (value, slope) = self.value.tanh_ratio_and_slope();
        self.chain(value, slope)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value.sin_cos();
        (self.chain(s, c), self.chain(c, -s))
    }
}

impl<const N: usize> Real for Dual<N> {}

impl<S: Component, const N: usize> Add for DualOf<S, N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        let one = S::from(1.0);
        Self {
            value: self.value + o.value,
            derivative: S::combine(&self.derivative, one, &o.derivative, one),
        }
    }
}

impl<S: Component, const N: usize> Sub for DualOf<S, N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self {
            value: self.value - o.value,
            derivative: S::combine(&self.derivative, S::from(1.0), &o.derivative, S::from(-1.0)),
        }
    }
}

impl<S: Component, const N: usize> Mul for DualOf<S, N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        Self {
            value: self.value * o.value,
            derivative: S::combine(&self.derivative, o.value, &o.derivative, self.value),
        }
    }
}

impl<S: Component, const N: usize> Div for DualOf<S, N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        let r = S::from(1.0) / o.value;
        let q = self.value * r;
        let change = S::combine(&self.derivative, S::from(1.0), &o.derivative, -q);
        Self {
            value: q,
            derivative: S::scale(&change, r),
        }
    }
}

impl<S: Component, const N: usize> Neg for DualOf<S, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.chain(-self.value, S::from(-1.0))
    }
}

impl<S: Component, const N: usize> Add<f64> for DualOf<S, N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: f64) -> Self {
        Self {
            value: self.value + o,
            ..self
        }
    }
}

impl<S: Component, const N: usize> Sub<f64> for DualOf<S, N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: f64) -> Self {
        Self {
            value: self.value - o,
            ..self
        }
    }
}

impl<S: Component, const N: usize> Mul<f64> for DualOf<S, N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: f64) -> Self {
        self.by(S::from(o))
    }
}

impl<const N: usize> Mul<Dual<N>> for f64 {
    type Output = Dual<N>;
    #[inline(always)]
    fn mul(self, o: Dual<N>) -> Dual<N> {
        o * self
    }
}

impl<const N: usize> Add<Dual<N>> for f64 {
    type Output = Dual<N>;
    #[inline(always)]
    fn add(self, o: Dual<N>) -> Dual<N> {
        o + self
    }
}

impl<const N: usize> Sub<Dual<N>> for f64 {
    type Output = Dual<N>;
    #[inline(always)]
    fn sub(self, o: Dual<N>) -> Dual<N> {
        -o + self
    }
}

impl<S: Component, const N: usize> AddAssign for DualOf<S, N> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl<S: Component, const N: usize> SubAssign for DualOf<S, N> {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a function that uses every operation.
    fn f<S: Real>(x: S, y: S) -> S {
        let (s, c) = (x * y).sin_cos();
        let r = (x * x + y * y + 0.1).sqrt();
        (s / r - c * 2.0).tanh() + (x * x).tanh_ratio() * y.recip() - (x * 1e-2 * x).tanh_ratio()
            + (-x).exp() * r
    }

    #[test]
    fn derivatives_agree_with_differences() {
        for (x, y) in [(0.3, 0.7), (-1.2, 0.4), (0.02, 2.0), (3.0, -0.5)] {
            let d = f(Dual::<2>::variable(x, 0), Dual::<2>::variable(y, 1));
            let h = 1e-6;
            let dx = (f(x + h, y) - f(x - h, y)) / (2.0 * h);
            let dy = (f(x, y + h) - f(x, y - h)) / (2.0 * h);
            assert_eq!(d.value, f(x, y), "values and duals share their bits");
            assert!(
                (d.derivative[0] - dx).abs() < 1e-8 * (1.0 + dx.abs()),
                "{} {dx}",
                d.derivative[0]
            );
            assert!(
                (d.derivative[1] - dy).abs() < 1e-8 * (1.0 + dy.abs()),
                "{} {dy}",
                d.derivative[1]
            );
        }
    }

    #[test]
    fn tanh_ratio_is_smooth_across_its_branches() {
        let (below, above) = (tanh_ratio(1e-3 * (1.0 - 1e-12)), tanh_ratio(1e-3));
        assert!((below.0 - above.0).abs() < 1e-14 && (below.1 - above.1).abs() < 1e-11);
        assert_eq!(tanh_ratio(0.0), (1.0, -1.0 / 3.0));
        assert_eq!(tanh_ratio(1e6).0, 1e-3);
    }
}
