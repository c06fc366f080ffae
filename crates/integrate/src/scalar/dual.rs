//! Numbers with derivatives: forward automatic differentiation.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use wide::f64x2;

use super::{Blend, Number, Real, tanh_ratio};

/// A value with its `N` partial derivatives.
///
/// ```
/// use integrate::scalar::{Dual, Number};
/// let x = Dual::<1>::variable(0.5, 0);
/// let y = x * x + x.sin_cos().0;
/// assert_eq!(y.derivative[0], 2.0 * 0.5 + libm::cos(0.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize> {
    /// The value.
    pub value: f64,
    /// The partial derivatives.
    pub derivative: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// Returns the independent variable number `index`.
    #[inline(always)]
    #[must_use]
    pub fn variable(value: f64, index: usize) -> Self {
        let mut derivative = [0.0; N];
        derivative[index] = 1.0;
        Self { value, derivative }
    }
}

impl<const N: usize> From<f64> for Dual<N> {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self {
            value,
            derivative: [0.0; N],
        }
    }
}

impl<const N: usize> Blend<bool> for Dual<N> {
    #[inline(always)]
    fn blend(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

impl<const N: usize> Number for Dual<N> {
    type Mask = bool;
    type Plain = f64;
    #[inline(always)]
    fn plain(self) -> f64 {
        self.value
    }
    #[inline(always)]
    fn lift(value: f64) -> Self {
        Self::from(value)
    }
    #[inline(always)]
    fn by(self, factor: f64) -> Self {
        self * factor
    }
    #[inline(always)]
    fn below(self, bound: f64) -> bool {
        self.value < bound
    }
    #[inline(always)]
    fn at_most(self, bound: f64) -> bool {
        self.value <= bound
    }
    #[inline(always)]
    fn chain(self, value: f64, slope: f64) -> Self {
        Self {
            value,
            derivative: lane(&self.derivative, |d| d * slope),
        }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, 0.5 / root)
    }
    #[inline(always)]
    fn tanh_ratio(self) -> Self {
        let (value, slope) = tanh_ratio(self.value);
        self.chain(value, slope)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = libm::sincos(self.value);
        (self.chain(s, c), self.chain(c, -s))
    }
}

impl<const N: usize> Real for Dual<N> {}

/// Applies a function to the derivatives of a number, two lanes at a time.
#[inline(always)]
fn lane<const N: usize>(a: &[f64; N], f: impl Fn(f64x2) -> f64x2) -> [f64; N] {
    let mut out = [0.0; N];
    for i in 0..N / 2 {
        let [x, y] = f(f64x2::new([a[2 * i], a[2 * i + 1]])).to_array();
        (out[2 * i], out[2 * i + 1]) = (x, y);
    }
    if N % 2 == 1 {
        out[N - 1] = f(f64x2::splat(a[N - 1])).to_array()[0];
    }
    out
}

/// Applies a function to the derivatives of two numbers, two lanes at a time.
#[inline(always)]
fn lanes<const N: usize>(a: &[f64; N], b: &[f64; N], f: impl Fn(f64x2, f64x2) -> f64x2) -> [f64; N] {
    let mut out = [0.0; N];
    for i in 0..N / 2 {
        let (a, b) = ([a[2 * i], a[2 * i + 1]], [b[2 * i], b[2 * i + 1]]);
        let [x, y] = f(f64x2::new(a), f64x2::new(b)).to_array();
        (out[2 * i], out[2 * i + 1]) = (x, y);
    }
    if N % 2 == 1 {
        out[N - 1] = f(f64x2::splat(a[N - 1]), f64x2::splat(b[N - 1])).to_array()[0];
    }
    out
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self {
            value: self.value + o.value,
            derivative: lanes(&self.derivative, &o.derivative, |a, b| a + b),
        }
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self {
            value: self.value - o.value,
            derivative: lanes(&self.derivative, &o.derivative, |a, b| a - b),
        }
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    #[inline(always)]
    // The product rule is a sum.
    #[allow(clippy::suspicious_arithmetic_impl)]
    fn mul(self, o: Self) -> Self {
        Self {
            value: self.value * o.value,
            derivative: lanes(&self.derivative, &o.derivative, |a, b| {
                a * o.value + self.value * b
            }),
        }
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        let r = 1.0 / o.value;
        let q = self.value * r;
        Self {
            value: q,
            derivative: lanes(&self.derivative, &o.derivative, |a, b| (a - q * b) * r),
        }
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            derivative: lane(&self.derivative, |d| -d),
        }
    }
}

impl<const N: usize> Add<f64> for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: f64) -> Self {
        Self {
            value: self.value + o,
            ..self
        }
    }
}

impl<const N: usize> Sub<f64> for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: f64) -> Self {
        Self {
            value: self.value - o,
            ..self
        }
    }
}

impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: f64) -> Self {
        Self {
            value: self.value * o,
            derivative: lane(&self.derivative, |d| d * o),
        }
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

impl<const N: usize> AddAssign for Dual<N> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl<const N: usize> SubAssign for Dual<N> {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A function that uses every operation.
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
