//! Four numbers side by side, with and without derivatives: a law written over [`Number`] does four points at
//! once.
//!
//! The lanes are explicit (`wide`): nothing is left to the compiler's vectorizer. Every lane gives the same
//! bits wherever it stands; elementary functions agree with those of single numbers to rounding.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use wide::f64x4;

use crate::scalar::{Blend, Component, DualOf, EIGHTH_TURN, Mask, Number, SERIES, series, small_sin_cos};

/// Number of lanes.
pub const LANES: usize = 4;

/// s from which on tanh(√s) is 1 to the last bit.
const SATURATED: f64 = 400.0;

/// An operation lane by lane.
macro_rules! lane_by_lane {
    ($($trait:ident $method:ident),*) => {$(
        impl $trait for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                Self(self.0.$method(o.0))
            }
        }
        impl $trait<f64> for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: f64) -> Self {
                Self(self.0.$method(f64x4::splat(o)))
            }
        }
        impl $trait<Lanes> for f64 {
            type Output = Lanes;
            #[inline(always)]
            fn $method(self, o: Lanes) -> Lanes {
                Lanes(f64x4::splat(self).$method(o.0))
            }
        }
    )*};
}

/// Four numbers.
#[derive(Clone, Copy, Debug)]
pub struct Lanes(f64x4);

/// Four numbers with their `N` partial derivatives.
pub type LaneDual<const N: usize> = DualOf<Lanes, N>;

/// Four results of a comparison.
#[derive(Clone, Copy, Debug)]
pub struct LaneMask(f64x4);

impl Lanes {
    /// Zeros.
    pub const ZERO: Self = Self(f64x4::ZERO);

    /// Returns four numbers as lanes.
    #[inline(always)]
    #[must_use]
    pub fn new(values: [f64; LANES]) -> Self {
        Self(f64x4::new(values))
    }
    /// Returns the four numbers.
    #[inline(always)]
    #[must_use]
    pub fn to_array(self) -> [f64; LANES] {
        self.0.to_array()
    }
    /// Returns the number in a lane.
    ///
    /// # Panics
    /// If there is no such lane.
    #[inline(always)]
    #[must_use]
    pub fn at(self, lane: usize) -> f64 {
        self.0.to_array()[lane]
    }
    /// Returns `tanh(√s)/√s`, and its derivative by `s` if `SLOPE` is set.
    #[inline(always)]
    fn tanh_ratio_with<const SLOPE: bool>(self) -> (Self, Self) {
        if !self.0.simd_le(f64x4::splat(SATURATED)).any() {
            let ratio = 1.0 / self.sqrt();
            return (ratio, if SLOPE { ratio * -0.5 / self } else { self });
        }
        self.unsaturated::<SLOPE>()
    }

    /// As [`Lanes::tanh_ratio_with`], where a lane needs tanh itself.
    #[inline(never)]
    fn unsaturated<const SLOPE: bool>(self) -> (Self, Self) {
        let x = self.sqrt();
        // Not near zero, where there is the series: 1 - 2/(e^2x + 1) has all digits but one or two.
        let t = 1.0 - 2.0 / (Self((x * 2.0).0.exp()) + 1.0);
        let ratio = t / x;
        let small = self.below(Self::from(SERIES));
        let (near, near_slope) = series(self);
        let value = Self::blend(small, near, ratio);
        if !SLOPE {
            return (value, self);
        }
        let slope = (1.0 - t * t - ratio) / (self * 2.0);
        (value, Self::blend(small, near_slope, slope))
    }

    #[cold]
    #[inline(never)]
    fn large_angles(self) -> (Self, Self) {
        let pairs = self.to_array().map(libm::sincos);
        (
            Self::new(pairs.map(|(sine, _)| sine)),
            Self::new(pairs.map(|(_, cosine)| cosine)),
        )
    }
}

impl Mask for LaneMask {
    #[inline(always)]
    fn all(self) -> bool {
        self.0.all()
    }
    #[inline(always)]
    fn none(self) -> bool {
        !self.0.any()
    }
}

impl Blend<LaneMask> for Lanes {
    #[inline(always)]
    fn blend(mask: LaneMask, yes: Self, no: Self) -> Self {
        Self(mask.0.bitselect(yes.0, no.0))
    }
}

lane_by_lane!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl SubAssign for Lanes {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl From<f64> for Lanes {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self(f64x4::splat(value))
    }
}

impl Component for Lanes {
    #[inline(always)]
    fn tanh_ratio_and_slope(self) -> (Self, Self) {
        self.tanh_ratio_with::<true>()
    }
    // Written out: `array::map` is not always inlined.
    #[inline(always)]
    fn combine<const N: usize>(a: &[Self; N], s: Self, b: &[Self; N], t: Self) -> [Self; N] {
        let mut out = [Self::ZERO; N];
        for i in 0..N {
            out[i] = a[i] * s + b[i] * t;
        }
        out
    }
    #[inline(always)]
    fn scale<const N: usize>(a: &[Self; N], s: Self) -> [Self; N] {
        let mut out = [Self::ZERO; N];
        for i in 0..N {
            out[i] = a[i] * s;
        }
        out
    }
}

impl Number for Lanes {
    type Mask = LaneMask;
    type Plain = Self;
    #[inline(always)]
    fn plain(self) -> Self {
        self
    }
    #[inline(always)]
    fn lift(value: Self) -> Self {
        value
    }
    #[inline(always)]
    fn by(self, factor: Self) -> Self {
        self * factor
    }
    #[inline(always)]
    fn below(self, bound: Self) -> LaneMask {
        LaneMask(self.0.simd_lt(bound.0))
    }
    #[inline(always)]
    fn at_most(self, bound: Self) -> LaneMask {
        LaneMask(self.0.simd_le(bound.0))
    }
    #[inline(always)]
    fn chain(self, value: Self, _slope: Self) -> Self {
        value
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn tanh_ratio(self) -> Self {
        self.tanh_ratio_with::<false>().0
    }
    /// Returns the bits that `libm` gives: by its polynomials where all are small, by itself elsewhere.
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let x = self;
        if !Self(x.0.abs()).at_most(Self::from(EIGHTH_TURN)).all() {
            return x.large_angles();
        }
        small_sin_cos(x)
    }
}

impl Lanes {
    /// Returns for each of four vectors the sum of its lanes.
    #[inline(always)]
    #[must_use]
    pub fn sums(rows: [Self; LANES]) -> Self {
        let [a, b, c, d] = f64x4::transpose(rows.map(|row| row.0));
        Self((a + b) + (c + d))
    }
}

impl LaneMask {
    /// Returns a mask of four results.
    #[inline(always)]
    #[must_use]
    pub fn new(answers: [bool; LANES]) -> Self {
        let bits = |answer| if answer { f64::from_bits(u64::MAX) } else { 0.0 };
        Self(f64x4::new([
            bits(answers[0]),
            bits(answers[1]),
            bits(answers[2]),
            bits(answers[3]),
        ]))
    }
    /// Returns the lanes in which both masks are true.
    #[inline(always)]
    #[must_use]
    pub fn and(self, o: Self) -> Self {
        Self(self.0 & o.0)
    }
    /// Returns whether the mask is true in a lane.
    #[inline(always)]
    #[must_use]
    pub fn at(self, lane: usize) -> bool {
        self.0.to_bitmask() >> lane & 1 == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::{Dual, choose};

    /// Returns a law with branches, over every operation.
    fn law<S: Number>(x: S, y: S) -> S {
        let r = (x * x + y * y + 0.1).sqrt();
        let inside = choose(x.below(S::Plain::zero()), || x.by(r.plain()) * 2.0, || y / r - x);
        inside + (r * 30.0).tanh_ratio() - (x * x).tanh_ratio() + (x * x * 1e-3).tanh_ratio() - y
    }

    #[test]
    fn each_lane_is_what_a_single_number_gives() {
        let (x, y) = ([0.3, -0.7, 2.0, -1e-3], [1.0, 0.2, -20.0, 0.0]);
        let lanes = law(
            LaneDual::<2>::variable(Lanes::new(x), 0),
            LaneDual::variable(Lanes::new(y), 1),
        );
        let plain = law(Lanes::new(x), Lanes::new(y)).to_array();
        for i in 0..LANES {
            let one = law(Dual::<2>::variable(x[i], 0), Dual::variable(y[i], 1));
            let near = |a: f64, b: f64| assert!((a - b).abs() <= 4e-14 * (1.0 + b.abs()), "{i}: {a} {b}");
            near(lanes.value.to_array()[i], one.value);
            near(plain[i], one.value);
            near(lanes.derivative[0].to_array()[i], one.derivative[0]);
            near(lanes.derivative[1].to_array()[i], one.derivative[1]);
        }
    }

    #[test]
    fn sines_and_cosines_have_the_bits_of_single_numbers() {
        let edges = [
            0.0,
            -0.0,
            1e-300,
            1e-9,
            2e-8,
            0.785_397_4,
            0.785_398_3,
            f64::MIN_POSITIVE,
        ];
        let sweep = (0..20_000).map(|i| 1e-8 * libm::exp(1e-3 * f64::from(i)) * (1.0 + 1e-7 * f64::from(i)));
        for x in edges.into_iter().chain(sweep) {
            for x in [x, -x] {
                let (s, c) = Lanes::new([x, 0.1, -0.3, 0.7]).sin_cos();
                let (sine, cosine) = libm::sincos(x);
                assert_eq!(Number::sin_cos(x), (sine, cosine), "{x}");
                assert_eq!((s.at(0), c.at(0)), (sine, cosine), "{x}");
                let first = Lanes::new([x * x, 0.0, 1e6, 2.0]).tanh_ratio();
                let second = Lanes::new([3.0, x * x, 0.1, 5.0]).tanh_ratio();
                assert_eq!(first.at(0), second.at(1), "{x}");
                let (tenth, _) = libm::sincos(0.1);
                assert_eq!(s.at(1), tenth);
            }
        }
    }

    #[test]
    fn masks_and_sums() {
        let a = Lanes::new([1.0, 2.0, 3.0, 4.0]);
        let mask = a
            .below(Lanes::from(2.5))
            .and(LaneMask::new([false, true, true, true]));
        assert_eq!([0, 1, 2, 3].map(|i| mask.at(i)), [false, true, false, false]);
        assert!(!mask.all() && !mask.none() && a.at_most(Lanes::from(4.0)).all());
        assert_eq!(
            Lanes::sums([a, a * 2.0, -a, Lanes::from(0.0)]).to_array(),
            [10.0, 20.0, -10.0, 0.0]
        );
    }
}
