//! SIMD lanes with derivatives.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use super::{LaneMask, Lanes};
use crate::scalar::{Blend, Number};

/// Four values with their `N` partial derivatives.
#[derive(Clone, Copy, Debug)]
pub struct LaneDual<const N: usize> {
    /// The values.
    pub value: Lanes,
    /// The partial derivatives.
    pub derivative: [Lanes; N],
}

impl<const N: usize> LaneDual<N> {
    /// Returns the independent variable number `index`.
    #[inline(always)]
    #[must_use]
    pub fn variable(value: Lanes, index: usize) -> Self {
        let mut derivative = [Lanes::from(0.0); N];
        derivative[index] = Lanes::from(1.0);
        Self { value, derivative }
    }
}

#[inline(always)]
fn each<const N: usize>(f: impl Fn(usize) -> Lanes) -> [Lanes; N] {
    // Written out: `array::map` is not always inlined.
    let mut out = [Lanes::from(0.0); N];
    for i in 0..N {
        out[i] = f(i);
    }
    out
}

impl<const N: usize> From<f64> for LaneDual<N> {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self::lift(Lanes::from(value))
    }
}

impl<const N: usize> Blend<LaneMask> for LaneDual<N> {
    #[inline(always)]
    fn blend(mask: LaneMask, yes: Self, no: Self) -> Self {
        Self {
            value: Lanes::blend(mask, yes.value, no.value),
            derivative: each(|i| Lanes::blend(mask, yes.derivative[i], no.derivative[i])),
        }
    }
}

impl<const N: usize> Add for LaneDual<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self {
            value: self.value + o.value,
            derivative: each(|i| self.derivative[i] + o.derivative[i]),
        }
    }
}

impl<const N: usize> Sub for LaneDual<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self {
            value: self.value - o.value,
            derivative: each(|i| self.derivative[i] - o.derivative[i]),
        }
    }
}

impl<const N: usize> Mul for LaneDual<N> {
    type Output = Self;
    #[inline(always)]
    // The product rule is a sum.
    #[allow(clippy::suspicious_arithmetic_impl)]
    fn mul(self, o: Self) -> Self {
        Self {
            value: self.value * o.value,
            derivative: each(|i| self.derivative[i] * o.value + self.value * o.derivative[i]),
        }
    }
}

impl<const N: usize> Div for LaneDual<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        let r = 1.0 / o.value;
        let q = self.value * r;
        Self {
            value: q,
            derivative: each(|i| (self.derivative[i] - q * o.derivative[i]) * r),
        }
    }
}

impl<const N: usize> Neg for LaneDual<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            derivative: each(|i| -self.derivative[i]),
        }
    }
}

impl<const N: usize> Add<f64> for LaneDual<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: f64) -> Self {
        Self {
            value: self.value + o,
            ..self
        }
    }
}

impl<const N: usize> Sub<f64> for LaneDual<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: f64) -> Self {
        Self {
            value: self.value - o,
            ..self
        }
    }
}

impl<const N: usize> Mul<f64> for LaneDual<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: f64) -> Self {
        self.by(Lanes::from(o))
    }
}

impl<const N: usize> AddAssign for LaneDual<N> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl<const N: usize> SubAssign for LaneDual<N> {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl<const N: usize> Number for LaneDual<N> {
    type Mask = LaneMask;
    type Plain = Lanes;
    #[inline(always)]
    fn plain(self) -> Lanes {
        self.value
    }
    #[inline(always)]
    fn lift(value: Lanes) -> Self {
        Self {
            value,
            derivative: [Lanes::from(0.0); N],
        }
    }
    #[inline(always)]
    fn by(self, factor: Lanes) -> Self {
        self.chain(self.value * factor, factor)
    }
    #[inline(always)]
    fn below(self, bound: Lanes) -> LaneMask {
        self.value.below(bound)
    }
    #[inline(always)]
    fn at_most(self, bound: Lanes) -> LaneMask {
        self.value.at_most(bound)
    }
    #[inline(always)]
    fn chain(self, value: Lanes, slope: Lanes) -> Self {
        Self {
            value,
            derivative: each(|i| self.derivative[i] * slope),
        }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, 0.5 / root)
    }
    #[inline(always)]
    fn tanh_ratio(self) -> Self {
        let (value, slope) = self.value.tanh_ratio_with::<true>();
        self.chain(value, slope)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value.sin_cos();
        (self.chain(s, c), self.chain(c, -s))
    }
}
