//! Four numbers side by side, with and without derivatives: a law written over [`Number`] does four points at once.
//!
//! The lanes are explicit (`wide`): nothing is left to the compiler's vectorizer. Every lane gives the same bits wherever it stands;
//! elementary functions agree with those of single numbers to rounding.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use wide::f64x4;

use crate::scalar::{Blend, Mask, Number, SERIES, series};

/// How many numbers stand side by side.
pub const LANES: usize = 4;

/// Four numbers.
#[derive(Clone, Copy, Debug)]
pub struct Lanes(f64x4);

/// Four answers.
#[derive(Clone, Copy, Debug)]
pub struct LaneMask(f64x4);

impl Lanes {
    /// Four zeros.
    pub const ZERO: Self = Self(f64x4::ZERO);

    /// These four numbers.
    #[inline(always)]
    #[must_use]
    pub fn new(values: [f64; LANES]) -> Self {
        Self(f64x4::new(values))
    }
    /// The four numbers.
    #[inline(always)]
    #[must_use]
    pub fn to_array(self) -> [f64; LANES] {
        self.0.to_array()
    }
    /// One of the four numbers.
    ///
    /// # Panics
    /// If there is no such lane.
    #[inline(always)]
    #[must_use]
    pub fn at(self, lane: usize) -> f64 {
        self.0.to_array()[lane]
    }
    /// Replaces one of the four numbers.
    ///
    /// # Panics
    /// If there is no such lane.
    #[inline(always)]
    pub fn put(&mut self, lane: usize, value: f64) {
        self.0.as_mut_array()[lane] = value;
    }
    /// The sum of the lanes of each of four.
    #[inline(always)]
    #[must_use]
    pub fn sums(rows: [Self; LANES]) -> Self {
        let [a, b, c, d] = f64x4::transpose(rows.map(|row| row.0));
        Self((a + b) + (c + d))
    }
}

impl LaneMask {
    /// These four answers.
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
    /// Where both hold.
    #[inline(always)]
    #[must_use]
    pub fn and(self, o: Self) -> Self {
        Self(self.0 & o.0)
    }
    /// Whether it holds in a lane.
    #[inline(always)]
    #[must_use]
    pub fn at(self, lane: usize) -> bool {
        self.0.to_bitmask() >> lane & 1 == 1
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

macro_rules! lanewise {
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
lanewise!(Add add, Sub sub, Mul mul, Div div);

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

/// From `x = √s = 20` on, tanh is 1 to the last bit.
const SATURATED: f64 = 400.0;

/// Value of `tanh(√s)/√s`, and its slope by `s` if it is asked for.
#[inline(always)]
fn tanh_ratio<const SLOPE: bool>(s: Lanes) -> (Lanes, Lanes) {
    if !s.0.simd_le(f64x4::splat(SATURATED)).any() {
        let ratio = 1.0 / s.sqrt();
        return (ratio, if SLOPE { ratio * -0.5 / s } else { s });
    }
    unsaturated::<SLOPE>(s)
}

/// The same where a lane needs tanh itself.
#[inline(never)]
fn unsaturated<const SLOPE: bool>(s: Lanes) -> (Lanes, Lanes) {
    let x = s.sqrt();
    // Not near zero, where there is the series: 1 - 2/(e^2x + 1) has all digits but one or two.
    let t = 1.0 - 2.0 / (Lanes((x * 2.0).0.exp()) + 1.0);
    let ratio = t / x;
    let small = s.below(Lanes::from(SERIES));
    let (near, near_slope) = series(s);
    let value = Lanes::blend(small, near, ratio);
    if !SLOPE {
        return (value, s);
    }
    let slope = (1.0 - t * t - ratio) / (s * 2.0);
    (value, Lanes::blend(small, near_slope, slope))
}

/// Up to this size sine and cosine come from their polynomials: `π/4`, less what the highest word of a number leaves out.
const EIGHTH_TURN: f64 = 0.785_397_5;

/// Sine and cosine, with the bits that `libm` gives: its polynomials (those of FreeBSD's `k_sin.c` and `k_cos.c`, error below one unit in
/// the last place) where all are small, itself elsewhere.
#[inline(always)]
fn sin_cos(x: Lanes) -> (Lanes, Lanes) {
    let size = Lanes(x.0.abs());
    if !size.at_most(Lanes::from(EIGHTH_TURN)).all() {
        return large_angles(x);
    }
    let z = x * x;
    let w = z * z;
    let r = 8.333_333_333_322_49e-3
        + z * (-1.984_126_982_985_795e-4 + z * 2.755_731_370_707_006_8e-6)
        + z * w * (-2.505_076_025_340_686_3e-8 + z * 1.589_690_995_211_55e-10);
    let sine = x + z * x * (-1.666_666_666_666_663_2e-1 + z * r);
    let r = z * (4.166_666_666_666_66e-2 + z * (-1.388_888_888_887_411e-3 + z * 2.480_158_728_947_673e-5))
        + w * w
            * (-2.755_731_435_139_066_3e-7
                + z * (2.087_572_321_298_175e-9 + z * -1.135_964_755_778_819_5e-11));
    let half = z * 0.5;
    let w = 1.0 - half;
    let cosine = w + (((1.0 - w) - half) + z * r);
    (sine, cosine)
}

#[cold]
#[inline(never)]
fn large_angles(x: Lanes) -> (Lanes, Lanes) {
    let pairs = x.to_array().map(libm::sincos);
    (
        Lanes::new(pairs.map(|(s, _)| s)),
        Lanes::new(pairs.map(|(_, c)| c)),
    )
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
        tanh_ratio::<false>(self).0
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        sin_cos(self)
    }
}

/// Four values with their `N` partial derivatives.
#[derive(Clone, Copy, Debug)]
pub struct LaneDual<const N: usize> {
    /// The values.
    pub value: Lanes,
    /// The partial derivatives.
    pub derivative: [Lanes; N],
}

impl<const N: usize> LaneDual<N> {
    /// The independent variable number `index`.
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
        let (value, slope) = tanh_ratio::<true>(self.value);
        self.chain(value, slope)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = sin_cos(self.value);
        (self.chain(s, c), self.chain(c, -s))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::{Dual, choose};

    /// A law with branches, over every operation.
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
                assert_eq!((s.at(0), c.at(0)), (sine, cosine), "{x}");
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
