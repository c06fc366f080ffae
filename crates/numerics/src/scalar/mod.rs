//! Scalars that carry derivatives.
//!
//! Every law of the workspace is written once, generic over [`Real`]. With `f64` it gives values, with
//! [`Dual`] it gives values and exact partial derivatives from the same lines (forward automatic
//! differentiation). Elementary functions come from a Rust library, so that results do not depend
//! on the system's mathematical library.
//!
//! Derivatives are computed in explicit pairs of lanes. Left to the compiler's own vectorization, these loops
//! were translated wrongly at the highest optimization (rustc 1.95: a Jacobian with wrong entries from right
//! source; see docs/decisions/0008), which is why the tests that check Jacobians also run on the released
//! build.

mod dual;

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

pub use dual::{Component, Dual, DualOf};

/// The result of a comparison: one for a number, one for each lane.
pub trait Mask: Copy + std::fmt::Debug {
    /// Returns whether it is true in all lanes.
    fn all(self) -> bool;
    /// Returns whether it is false in all lanes.
    fn none(self) -> bool;
}

impl Mask for bool {
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
    #[inline(always)]
    fn none(self) -> bool {
        !self
    }
}

/// A value that can be selected lane by lane from two values.
pub trait Blend<M> {
    /// Returns `yes` where the mask is true, `no` elsewhere.
    #[must_use]
    fn blend(mask: M, yes: Self, no: Self) -> Self;
}

/// Returns `yes` where the mask is true, `no` elsewhere; a branch that no lane needs is not computed.
#[inline(always)]
pub fn choose<M: Mask, T: Blend<M>>(mask: M, yes: impl FnOnce() -> T, no: impl FnOnce() -> T) -> T {
    if mask.all() {
        yes()
    } else if mask.none() {
        no()
    } else {
        T::blend(mask, yes(), no())
    }
}

/// The scalar of laws: a real number or four of them in lanes, possibly with derivatives.
pub trait Number:
    Copy
    + std::fmt::Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + AddAssign
    + SubAssign
    + From<f64>
    + Blend<Self::Mask>
{
    /// The result of a comparison.
    type Mask: Mask;
    /// The same without derivatives.
    type Plain: Number<Plain = Self::Plain, Mask = Self::Mask>;

    /// Returns the value without derivatives.
    fn plain(self) -> Self::Plain;
    /// Returns a value as a number whose derivatives are zero.
    #[must_use]
    fn lift(value: Self::Plain) -> Self;
    /// This number times one without derivatives.
    #[must_use]
    fn by(self, factor: Self::Plain) -> Self;
    /// Returns whether the value is less than a bound.
    fn below(self, bound: Self::Plain) -> Self::Mask;
    /// Returns whether the value is at most a bound.
    fn at_most(self, bound: Self::Plain) -> Self::Mask;
    /// Returns a function given by its value and its derivative at [`Number::plain`].
    #[must_use]
    fn chain(self, value: Self::Plain, slope: Self::Plain) -> Self;
    /// Returns the square root; its derivative at zero is infinite.
    #[must_use]
    fn sqrt(self) -> Self;
    /// `tanh(sqrt(s)) / sqrt(s)` for `s ≥ 0`: smooth, also at `s = 0`, where it is 1.
    #[must_use]
    fn tanh_ratio(self) -> Self;
    /// Sine and cosine.
    #[must_use]
    fn sin_cos(self) -> (Self, Self);

    /// Zero.
    #[inline(always)]
    #[must_use]
    fn zero() -> Self {
        Self::from(0.0)
    }
}

/// A real number, possibly with derivatives.
pub trait Real: Number<Plain = f64, Mask = bool> {
    /// Returns the value without derivatives.
    #[inline(always)]
    fn value(self) -> f64 {
        self.plain()
    }
    /// Returns the reciprocal.
    #[inline(always)]
    #[must_use]
    fn recip(self) -> Self {
        let r = 1.0 / self.value();
        self.chain(r, -r * r)
    }
    /// Returns the hyperbolic tangent.
    #[inline(always)]
    #[must_use]
    fn tanh(self) -> Self {
        let t = tanh(self.value());
        self.chain(t, 1.0 - t * t)
    }
    /// Returns the exponential.
    #[inline(always)]
    #[must_use]
    fn exp(self) -> Self {
        let e = libm::exp(self.value());
        self.chain(e, e)
    }
}

/// tanh; from 20 on it is 1 to the last bit.
#[inline(always)]
fn tanh(x: f64) -> f64 {
    if x.abs() > 20.0 {
        f64::copysign(1.0, x)
    } else {
        libm::tanh(x)
    }
}

/// Below this, `tanh(√s)/√s` comes from its series.
pub(crate) const SERIES: f64 = 1e-3;

/// Returns the series of `tanh(√s)/√s` and of its slope: 1 - s/3 + 2 s²/15 - 17 s³/315 + 62 s⁴/2835 - ...
#[inline(always)]
pub(crate) fn series<S: Number>(s: S) -> (S, S) {
    (
        s * (s * (s * (s * (62.0 / 2835.0) - 17.0 / 315.0) + 2.0 / 15.0) - 1.0 / 3.0) + 1.0,
        s * (s * (s * (248.0 / 2835.0) - 17.0 / 105.0) + 4.0 / 15.0) - 1.0 / 3.0,
    )
}

/// Up to this size sine and cosine come from their polynomials: `π/4`, less what the highest word of a number
/// leaves out.
pub(crate) const EIGHTH_TURN: f64 = 0.785_397_5;

/// Sine and cosine of at most [`EIGHTH_TURN`], with the bits that `libm` gives: by its polynomials (those of
/// FreeBSD's `k_sin.c` and `k_cos.c`, error below one unit in the last place).
#[inline(always)]
pub(crate) fn small_sin_cos<S>(x: S) -> (S, S)
where
    S: Number,
    f64: Add<S, Output = S> + Sub<S, Output = S>,
{
    let z = x * x;
    let w = z * z;
    let r = 8.333_333_333_322_49e-3
        + z * (z * 2.755_731_370_707_006_8e-6 + -1.984_126_982_985_795e-4)
        + z * w * (z * 1.589_690_995_211_55e-10 + -2.505_076_025_340_686_3e-8);
    let sine = x + z * x * (z * r + -1.666_666_666_666_663_2e-1);
    let r = z * (z * (z * 2.480_158_728_947_673e-5 + -1.388_888_888_887_411e-3) + 4.166_666_666_666_66e-2)
        + w * w
            * (z * (z * -1.135_964_755_778_819_5e-11 + 2.087_572_321_298_175e-9)
                + -2.755_731_435_139_066_3e-7);
    let half = z * 0.5;
    let w = 1.0 - half;
    (sine, w + (((1.0 - w) - half) + z * r))
}

/// Value and slope by `s` of `tanh(√s)/√s`.
#[inline(always)]
fn tanh_ratio(s: f64) -> (f64, f64) {
    if s < SERIES {
        series(s)
    } else {
        let x = s.sqrt();
        let t = tanh(x);
        let ratio = t / x;
        (ratio, (1.0 - t * t - ratio) / (2.0 * s))
    }
}

impl Blend<bool> for f64 {
    #[inline(always)]
    fn blend(mask: bool, yes: f64, no: f64) -> f64 {
        if mask { yes } else { no }
    }
}

impl Number for f64 {
    type Mask = bool;
    type Plain = f64;
    #[inline(always)]
    fn plain(self) -> f64 {
        self
    }
    #[inline(always)]
    fn lift(value: f64) -> f64 {
        value
    }
    #[inline(always)]
    fn by(self, factor: f64) -> f64 {
        self * factor
    }
    #[inline(always)]
    fn below(self, bound: f64) -> bool {
        self < bound
    }
    #[inline(always)]
    fn at_most(self, bound: f64) -> bool {
        self <= bound
    }
    #[inline(always)]
    fn chain(self, value: f64, _slope: f64) -> f64 {
        value
    }
    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn tanh_ratio(self) -> f64 {
        if self < SERIES {
            tanh_ratio(self).0
        } else {
            let x = self.sqrt();
            tanh(x) / x
        }
    }
    /// Returns the bits that `libm` gives, without its call where the angle is small.
    #[inline(always)]
    fn sin_cos(self) -> (f64, f64) {
        if self.abs() <= EIGHTH_TURN {
            small_sin_cos(self)
        } else {
            libm::sincos(self)
        }
    }
}

impl Real for f64 {}
