//! Contact patches from intervals of overlap.
//!
//! From moments of the overlap h(y) over an interval come, with `I2 = ∫ h² dy` and `I3 = ∫ h³ dy`,
//!
//! ```text
//! depth d = (7/6) I3 / I2,   half width w = (15/16) I2 / d²
//! ```
//!
//! which are those of the overlap itself where it is a parabola, as of two arcs; the place, the slope and the
//! radius are means weighted with h². The approach is `d cos δ`, the sum of curvatures across the rolling
//! direction `2 d cos³δ / w²`, along it `cos δ / r`. So curvatures are means over the patch, places move
//! continuously where profiles conform, and no curvature of a measured profile is needed. Moments of a lower
//! order give more weight to shallow parts of the overlap, which elastic bodies do not touch with (decision
//! 0053).
//!
//! **Blending.** Two intervals that grow together would change from two patches to one at once. An interval
//! with a valley of overlap v between maxima is therefore given as one patch with a share c and as its two
//! parts with a share `1 - c`; c rises smoothly from 0 at v = 0 to 1 at v = 0.8 of the smaller maximum.
//! Forces are sums over patches, weighted with their shares; they are continuous. An interval is divided at
//! one valley only.

use numerics::scalar::Real;

use super::ellipse::Ellipse;
use super::pose::{Frame, ProfileNode};
use super::search::{ContactPair, Interval, NOTHING, Scan};
use super::section::STATIONS;
use crate::vector::cross;

/// Cells of the integrals over an interval.
const CELLS: usize = 10;
/// Share of the smaller maximum at which a valley joins two parts wholly.
const JOINED: f64 = 0.8;

/// A contact patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPatch<S> {
    /// Share with which its forces count; see the head of this module.
    pub share: S,
    /// Its place on the wheel: x from the center, y and z in the axes of the contact, m.
    pub place: [S; 3],
    /// Slope of the plane of contact: the tangent of the contact angle δ, positive if it rises to the field
    /// side.
    pub slope: S,
    /// cos δ.
    pub cosine: S,
    /// Rise of the rail along the track at the place, where its section changes along it; else none.
    pub climb: Option<S>,
    /// y on the wheel's profile, m.
    pub profile: S,
    /// Radius of the wheel there, m.
    pub radius: S,
    /// Approach along the normal, m.
    pub approach: S,
    /// Half width of the overlap across the track, m: a measure of the area, not the ellipse's semi-axis.
    pub half_width: S,
    /// Sums of curvatures along and across the rolling direction, 1/m.
    pub curvatures: [S; 2],
    /// Hertz's contact.
    pub ellipse: Ellipse<S>,
}

impl<S: Real> ContactPatch<S> {
    /// Returns the unit normal from the rail into the wheel.
    #[inline(always)]
    pub fn normal(&self) -> [S; 3] {
        let Some(climb) = self.climb else {
            return [S::zero(), -(self.slope * self.cosine), self.cosine];
        };
        let whole = (self.slope * self.slope + climb * climb + 1.0).sqrt().recip();
        [-(climb * whole), -(self.slope * whole), whole]
    }

    /// Returns the unit vector in the plane of contact along the rail.
    #[inline(always)]
    pub fn along(&self) -> [S; 3] {
        match self.climb {
            None => [S::from(1.0), S::zero(), S::zero()],
            Some(_) => cross(self.across(), self.normal()),
        }
    }

    /// Returns the unit vector across the rolling direction, towards the field side.
    #[inline(always)]
    pub fn across(&self) -> [S; 3] {
        [S::zero(), self.cosine, self.slope * self.cosine]
    }

    /// Returns the same patch in another scalar, without derivatives.
    #[inline(always)]
    pub(super) fn lifted<T: Real>(&self) -> ContactPatch<T> {
        let lift = |value: S| T::from(value.value());
        ContactPatch {
            share: lift(self.share),
            place: self.place.map(lift),
            slope: lift(self.slope),
            cosine: lift(self.cosine),
            climb: self.climb.map(lift),
            profile: lift(self.profile),
            radius: lift(self.radius),
            approach: lift(self.approach),
            half_width: lift(self.half_width),
            curvatures: self.curvatures.map(lift),
            ellipse: Ellipse {
                stiffness: lift(self.ellipse.stiffness),
                axes: self.ellipse.axes.map(lift),
            },
        }
    }

    /// Returns the contact angle, rad, positive on treads and flanges that rise to the field side.
    #[must_use]
    pub fn angle(&self) -> f64 {
        libm::atan(self.slope.value())
    }
}

impl ContactPair {
    /// Gives the patches of an interval to `take`.
    pub(super) fn patches<S: Real>(
        &self,
        frame: &Frame<'_, S>,
        plain: &Frame<'_, f64>,
        scan: &Scan,
        interval: &Interval,
        take: &mut impl FnMut(ContactPatch<S>),
    ) {
        if interval.peak <= NOTHING {
            return;
        }
        let [left, right] = interval.ends.map(|end| self.end(frame, plain, end));
        let mut give = |from: S, to: S, share: S| {
            if let Some(patch) = self.patch(frame, from, to, share) {
                take(patch);
            }
        };
        match self.division(frame, plain, scan, interval.stations, JOINED) {
            None => give(left, right, S::from(1.0)),
            Some((valley, part)) => {
                let joined = match part.value() > 0.0 {
                    true => part * part * (part * -2.0 + 3.0),
                    false => S::zero(),
                };
                if joined.value() > 0.0 {
                    give(left, right, joined);
                }
                let apart = (joined - 1.0) * -1.0;
                give(left, valley, apart);
                give(valley, right, apart);
            }
        }
    }

    /// Returns the valley at which an interval is divided, and its overlap as a share (less than 1) of
    /// that at which it joins the parts wholly, which is the share `joined` of the smaller maximum;
    /// nothing if it has no valley that divides it.
    pub(super) fn division<S: Real>(
        &self,
        frame: &Frame<'_, S>,
        plain: &Frame<'_, f64>,
        scan: &Scan,
        [first, last]: [usize; 2],
        joined: f64,
    ) -> Option<(S, S)> {
        let overlap = &scan.overlap;
        // Largest overlap from each station to the last one, as a station.
        let mut right = [last; STATIONS];
        for k in (first..last).rev() {
            right[k] = if overlap[k] > overlap[right[k + 1]] {
                k
            } else {
                right[k + 1]
            };
        }
        let mut left = first;
        let mut best: Option<(f64, [usize; 3])> = None;
        for k in first + 1..last {
            let lower = overlap[left].min(overlap[right[k + 1]]);
            let prominence = lower - overlap[k];
            if prominence > best.map_or(0.0, |best| best.0) {
                best = Some((prominence, [left, k, right[k + 1]]));
            }
            if overlap[k] > overlap[left] {
                left = k;
            }
        }
        let (prominence, stations) = best?;
        if prominence < 0.5 * (1.0 - joined) * overlap[stations[0]].min(overlap[stations[2]]) {
            return None;
        }
        let [(low, _), (valley, turns), (high, _)] = stations.map(|k| self.turning(plain, scan, k));
        let at = |parameter: f64| frame.node(S::from(parameter));
        let (bottom, tops) = (at(valley), [low, high].map(|parameter| at(parameter).overlap));
        let smaller = if tops[0].value() < tops[1].value() {
            tops[0]
        } else {
            tops[1]
        };
        let part = bottom.overlap / (smaller * joined);
        if part.value() >= 1.0 {
            return None;
        }
        let valley = match turns {
            true => {
                let bend = self.along(plain, valley).overlap_slope.derivative[0];
                S::from(valley) - bottom.overlap_slope * bend.recip()
            }
            false => S::from(valley),
        };
        Some((valley, part))
    }

    /// Returns the patch of an interval of the parameter.
    fn patch<S: Real>(&self, frame: &Frame<'_, S>, from: S, to: S, share: S) -> Option<ContactPatch<S>> {
        let zero = S::zero();
        let mut nodes = [ProfileNode {
            overlap: zero,
            overlap_slope: zero,
            place: [zero; 3],
            slope: zero,
            profile: zero,
            radius: zero,
        }; CELLS + 1];
        for (i, node) in nodes.iter_mut().enumerate() {
            let parameter = from + (to - from) * (i as f64 / CELLS as f64);
            *node = frame.node(parameter);
        }
        let (mut squares, mut cubes, mut weight) = (zero, zero, zero);
        let mut means = [zero; 6];
        for pair in nodes.windows(2) {
            let [a, b] = [&pair[0], &pair[1]];
            let width = b.place[1] - a.place[1];
            // Hermite's rule: the trapezoid corrected by the slopes.
            let correction = width * width * (1.0 / 12.0);
            let [[a2, da2], [a3, da3]] = powers(a);
            let [[b2, db2], [b3, db3]] = powers(b);
            squares += width * (a2 + b2) * 0.5 + correction * (da2 - db2);
            cubes += width * (a3 + b3) * 0.5 + correction * (da3 - db3);
            for (node, square) in [(a, a2), (b, b2)] {
                let own = width * square;
                weight += own;
                let [x, y, z] = node.place;
                let values = [x, y, z, node.slope, node.profile, node.radius];
                for (mean, value) in means.iter_mut().zip(values) {
                    *mean += own * value;
                }
            }
        }
        if !(squares.value() > 0.0 && cubes.value() > 0.0 && weight.value() > 0.0) {
            return None;
        }
        let [x, y, z, slope, profile, radius] = means.map(|mean| mean / weight);
        let depth = cubes / squares * (7.0 / 6.0);
        let half_width = squares / (depth * depth) * (15.0 / 16.0);
        let cosine = (slope * slope + 1.0).sqrt().recip();
        let rolling = cosine / radius;
        let lateral = depth * cosine * cosine * cosine * 2.0 / (half_width * half_width);
        let climb = frame.climb(y);
        // On a rail that rises the wheel touches ahead of its axle.
        let x = climb.map_or(x, |climb| x + radius * climb);
        Some(ContactPatch {
            share,
            place: [x, y, z],
            slope,
            cosine,
            climb,
            profile,
            radius,
            approach: depth * cosine,
            half_width,
            curvatures: [rolling, lateral],
            ellipse: self.ellipses.of(rolling, lateral),
        })
    }
}

/// Square and cube of the overlap at a node, each with its derivative by y.
#[inline(always)]
fn powers<S: Real>(node: &ProfileNode<S>) -> [[S; 2]; 2] {
    let (h, slope) = (node.overlap, node.overlap_slope);
    let square = h * h;
    [[square, h * slope * 2.0], [square * h, square * slope * 3.0]]
}
