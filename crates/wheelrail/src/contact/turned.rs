//! A wheel as it is turned: round, not round, or with profiles that change around it.
//!
//! **Slices around a wheel.** Between two slices points at equal shares of the visible lengths of both
//! profiles are joined by straight lines over the angle, from the last slice on to the first; within 5 mm of
//! circumference on both sides of a slice the straight lines are rounded by a parabola (`ROUNDED`, a choice).
//! Where the radius at a place of the profile grows with the angle by r', the wheel touches r' ahead of the
//! plane of its axle, with the radius of that plane: it stands lower than it should by r'²/(2 r) (0.1 μm for
//! 1 mm within a quarter of a turn, but all of it for a flat, which has a form of its own,
//! [`OutOfRound`](super::OutOfRound)).

use std::f64::consts::TAU;
use std::sync::Arc;

use numerics::scalar::Real;

use super::out_of_round::{OutOfRound, around};
use super::section::{self, STATIONS, STRIDE, WheelPoint, WheelSection, hermite, second, slope, value};
use crate::profile::{ProfileError, ProfileKind, SlicedProfile};

/// Distance along the circumference on both sides of a slice over which the slope changes, m.
const ROUNDED: f64 = 5e-3;

/// Cubics of y and z over one share each.
type Cells = Vec<[[f64; 4]; 2]>;

/// A wheel whose profile changes around it.
#[derive(Clone, Debug)]
pub struct SlicedWheel {
    radius: f64,
    /// Angles of the slices, rad, rising.
    angles: Vec<f64>,
    slices: Vec<Arc<Cells>>,
}

/// The form of a wheel that is no body of revolution.
#[derive(Clone, Debug)]
pub enum WheelForm {
    /// The same change of the radius over the whole width.
    OutOfRound(Arc<OutOfRound>),
    /// Profiles that change around the wheel.
    Sliced(Arc<SlicedWheel>),
}

/// A wheel at the angle that is down.
#[derive(Clone, Debug)]
pub(super) enum TurnedWheel<'w> {
    /// A body of revolution.
    Round(&'w WheelSection),
    /// The same with another height of the axle, its first and second derivative by the angle.
    Grown(&'w WheelSection, [f64; 3]),
    /// Between slices.
    Blend(Blend<'w>),
}

/// A wheel between slices.
#[derive(Clone, Debug)]
pub(super) struct Blend<'w> {
    wheel: &'w SlicedWheel,
    slices: [&'w [[[f64; 4]; 2]]; 3],
    /// Weights of the slices, their first and second derivatives by the angle.
    weights: [[f64; 3]; 3],
}

impl SlicedWheel {
    /// Returns a wheel of a nominal radius (m) from slices around it.
    ///
    /// # Errors
    /// A profile is no wheel with its datum, or the slices span more than a turn.
    pub fn new(wheel: &SlicedProfile, radius: f64) -> Result<Self, ProfileError> {
        let places = wheel.places();
        let span = places[places.len() - 1] - places[0];
        if span >= TAU {
            return Err(ProfileError::Number {
                what: "angle from the first to the last slice of a wheel (rad)",
                value: span,
                must: "less than a turn, 2π: the last slice goes over into the first one",
            });
        }
        let mut ranges = Vec::with_capacity(places.len());
        let mut count = 0;
        for profile in wheel.profiles() {
            let range = section::prepared(profile, ProfileKind::Wheel)?;
            count = count.max(section::cells(range));
            ranges.push(range);
        }
        let mut slices: Vec<Arc<Cells>> = Vec::with_capacity(places.len());
        for (i, profile) in wheel.profiles().iter().enumerate() {
            let mut before = wheel.profiles()[..i].iter();
            if let Some(known) = before.position(|other| Arc::ptr_eq(profile, other)) {
                slices.push(slices[known].clone());
                continue;
            }
            let [start, end] = ranges[i];
            let step = (end - start) / count as f64;
            let points: Vec<_> = (0..=count)
                .map(|k| profile.curve().at(start + step * k as f64))
                .collect();
            let cells = points.windows(2).map(|pair| {
                [0, 1].map(|axis| {
                    let [a, b] = [&pair[0], &pair[1]];
                    let slopes = [a.tangent[axis] * step, b.tangent[axis] * step];
                    hermite(1.0, [a.position[axis], b.position[axis]], slopes)
                })
            });
            slices.push(Arc::new(cells.collect()));
        }
        Ok(Self {
            radius,
            angles: places.to_vec(),
            slices,
        })
    }

    /// Returns the shortest way of the rolling wheel between two slices, m.
    #[must_use]
    pub fn finest(&self) -> f64 {
        let count = self.angles.len();
        let ways = (0..count).map(|k| self.radius * self.gap(k));
        ways.fold(f64::INFINITY, f64::min)
    }

    /// Returns the angle from a slice to the next one, rad.
    fn gap(&self, k: usize) -> f64 {
        match self.angles.get(k + 1) {
            Some(next) => next - self.angles[k],
            None => self.angles[0] + TAU - self.angles[k],
        }
    }

    fn cells(&self) -> usize {
        self.slices[0].len()
    }

    fn stride(&self) -> usize {
        STRIDE.max(self.cells().div_ceil(STATIONS - 2))
    }

    /// Returns the knot between cubics at which a station lies.
    fn knot(&self, station: usize) -> usize {
        (station * self.stride()).min(self.cells())
    }

    /// Returns the wheel at the angle that is down, rad.
    fn at(&self, angle: f64) -> Blend<'_> {
        let count = self.angles.len();
        let angle = around(angle - self.angles[0]);
        let angle = self.angles[0] + if angle < 0.0 { angle + TAU } else { angle };
        let k = self.angles.partition_point(|own| *own <= angle).max(1) - 1;
        let (next, before) = ((k + 1) % count, (k + count - 1) % count);
        let from = angle - self.angles[k];
        let gap = self.gap(k);
        let rounded = |slice: usize| {
            let beside = self.gap((slice + count - 1) % count).min(self.gap(slice));
            (ROUNDED / self.radius).min(0.5 * beside)
        };
        let near = if from < rounded(k) {
            Some((before, k, next, from))
        } else if gap - from < rounded(next) {
            Some((k, next, (next + 1) % count, from - gap))
        } else {
            None
        };
        let (slices, weights) = match near {
            Some((before, own, next, t)) => {
                let rounded = rounded(own);
                let per = [before, own].map(|slice| 1.0 / (4.0 * rounded * self.gap(slice)));
                let [behind, ahead] = [t - rounded, t + rounded];
                let first = [behind * behind, 2.0 * behind, 2.0].map(|value| value * per[0]);
                let last = [ahead * ahead, 2.0 * ahead, 2.0].map(|value| value * per[1]);
                let weights = [0, 1, 2].map(|order| {
                    let whole = if order == 0 { 1.0 } else { 0.0 };
                    [first[order], whole - first[order] - last[order], last[order]]
                });
                ([before, own, next], weights)
            }
            None => {
                let (share, rate) = (from / gap, 1.0 / gap);
                let weights = [[1.0 - share, share, 0.0], [-rate, rate, 0.0], [0.0; 3]];
                ([k, next, next], weights)
            }
        };
        Blend {
            wheel: self,
            slices: slices.map(|slice| self.slices[slice].as_slice()),
            weights,
        }
    }
}

impl WheelForm {
    /// Returns the wheel at the angle that is down; `round` is the body of revolution that it departs from.
    #[inline(always)]
    pub(super) fn at<'w>(&'w self, round: &'w WheelSection, angle: f64) -> TurnedWheel<'w> {
        match self {
            Self::OutOfRound(own) => TurnedWheel::Grown(round, own.at(angle)),
            Self::Sliced(own) => TurnedWheel::Blend(own.at(angle)),
        }
    }

    /// Returns the shortest way of the rolling wheel over which its height changes much, m: steps of an
    /// integration should not be longer.
    #[must_use]
    pub fn finest(&self) -> f64 {
        match self {
            Self::OutOfRound(own) => own.finest(),
            Self::Sliced(own) => own.finest(),
        }
    }

    /// Returns the height of the axle above that at no spin, over the angle that is down (rad), and its
    /// derivative by the angle, as far as it is the same over the whole width.
    #[must_use]
    pub fn height(&self, angle: f64) -> [f64; 2] {
        match self {
            Self::OutOfRound(own) => {
                let [height, rate, _] = own.at(angle);
                [height, rate]
            }
            Self::Sliced(_) => [0.0; 2],
        }
    }
}

impl TurnedWheel<'_> {
    /// Returns the nominal radius, m.
    #[inline(always)]
    pub fn nominal_radius(&self) -> f64 {
        match self {
            Self::Round(section) | Self::Grown(section, _) => section.nominal_radius(),
            Self::Blend(blend) => blend.wheel.radius,
        }
    }

    /// Returns the parameter of a station.
    #[inline(always)]
    pub fn parameter(&self, station: usize) -> f64 {
        match self {
            Self::Round(section) | Self::Grown(section, _) => section.parameter(station),
            Self::Blend(blend) => blend.wheel.knot(station) as f64,
        }
    }

    /// Returns the number of stations of the scan.
    #[inline(always)]
    pub fn count(&self) -> usize {
        match self {
            Self::Round(section) | Self::Grown(section, _) => section.stations().len(),
            Self::Blend(blend) => blend.wheel.cells().div_ceil(blend.wheel.stride()) + 1,
        }
    }

    /// Returns the first station whose y is not below this (m).
    #[inline(always)]
    pub fn first_from(&self, y: f64) -> usize {
        let (mut from, mut to) = (0, self.count());
        while from < to {
            let middle = from.midpoint(to);
            match self.station(middle)[0] < y {
                true => from = middle + 1,
                false => to = middle,
            }
        }
        from
    }

    /// Returns y, radius and slope of the radius at a station of the scan.
    #[inline(always)]
    pub fn station(&self, station: usize) -> [f64; 3] {
        match self {
            Self::Round(section) => section.stations()[station],
            Self::Grown(section, grown) => {
                let [y, radius, slope] = section.stations()[station];
                [y, radius + grown[0], slope]
            }
            Self::Blend(blend) => blend.knot(blend.wheel.knot(station)),
        }
    }

    /// Returns the point at a parameter of the profile, and how far ahead of the plane of the axle the wheel
    /// touches there: nothing if it is round. `angle` is the one that is down.
    #[inline(always)]
    pub fn at<S: Real>(&self, parameter: S, angle: S) -> (WheelPoint<S>, Option<S>) {
        match self {
            Self::Round(section) => (section.at(parameter), None),
            Self::Grown(section, [height, rate, bend]) => {
                let mut point = section.at(parameter);
                point.radius += angle.chain(*height, *rate);
                (point, Some(angle.chain(*rate, *bend)))
            }
            Self::Blend(blend) => blend.at(parameter, angle),
        }
    }
}

impl Blend<'_> {
    /// Returns a sum over the slices by weights or one of their derivatives: y and z, with their first and
    /// second derivatives by the parameter.
    fn sum(&self, order: usize, parameter: f64) -> [[f64; 3]; 2] {
        let cell = (parameter.max(0.0) as usize).min(self.wheel.cells() - 1);
        let t = parameter - cell as f64;
        let mut sum = [[0.0; 3]; 2];
        for (cells, weight) in self.slices.iter().zip(self.weights[order]) {
            if weight == 0.0 {
                continue;
            }
            for (sum, cubic) in sum.iter_mut().zip(&cells[cell]) {
                sum[0] += weight * value(cubic, t);
                sum[1] += weight * slope(cubic, t);
                sum[2] += weight * second(cubic, t);
            }
        }
        sum
    }

    /// Returns y, radius and slope of the radius at a knot.
    #[inline(always)]
    fn knot(&self, knot: usize) -> [f64; 3] {
        let (mut at, mut along) = ([0.0; 2], [0.0; 2]);
        for (cells, weight) in self.slices.iter().zip(self.weights[0]) {
            for axis in 0..2 {
                let (own, rate) = match cells.get(knot) {
                    Some(cubics) => (cubics[axis][0], cubics[axis][1]),
                    None => {
                        let last = &cells[knot - 1][axis];
                        (value(last, 1.0), slope(last, 1.0))
                    }
                };
                at[axis] += weight * own;
                along[axis] += weight * rate;
            }
        }
        [at[0], self.wheel.radius - at[1], -along[1] / along[0]]
    }

    #[inline(never)]
    fn at<S: Real>(&self, parameter: S, angle: S) -> (WheelPoint<S>, Option<S>) {
        let at = parameter.value();
        let [[y, dy, ddy], [z, dz, ddz]] = self.sum(0, at);
        let [[y_turn, dy_turn, _], [z_turn, dz_turn, _]] = self.sum(1, at);
        let [[y_bend, ..], [z_bend, ..]] = self.sum(2, at);
        // The slope of z, and how it changes along the profile and around the wheel.
        let rise = dz / dy;
        let (rise_by, rise_turn) = ((ddz - rise * ddy) / dy, (dz_turn - rise * dy_turn) / dy);
        // z at a fixed y over the angle.
        let climb = z_turn - rise * y_turn;
        let climb_by = dz_turn - rise_by * y_turn - rise * dy_turn;
        let climb_turn = z_bend - rise_turn * y_turn - rise * y_bend;
        let both = |value: f64, by: f64, turn: f64| parameter.chain(value, by) + angle.chain(0.0, turn);
        let point = WheelPoint {
            y: both(y, dy, y_turn),
            radius: both(self.wheel.radius - z, -dz, -z_turn),
            slope: both(-rise, -rise_by, -rise_turn),
        };
        (point, Some(both(-climb, -climb_by, -climb_turn)))
    }
}
