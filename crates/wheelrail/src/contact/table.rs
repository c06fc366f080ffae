//! Contact tables: a fast mode of the search.
//!
//! The silhouette without yaw is compared with the rail once, over lateral places of its lowest point 0.1 mm
//! apart and inclinations of the axle 5 mrad apart, in two parts of the wheel: the flange, up to the place of
//! its throat where the profile has a slope of 45°, and the tread. For each part a table holds the height of
//! the center at which it touches, and place, slope, radius, curvature and share of its patch, taken from
//! moments of the overlap at a given overlap as in the search. Between its points a table is a bicubic of
//! Catmull and Rom: values and derivatives are continuous.
//!
//! A part whose overlap only grows towards the other part has no patch of its own: its share falls to zero as
//! its largest overlap comes within 20 μm of that at the division. Yaw is added to second order: the
//! silhouette leads by `-r τ m` along the rail and overlaps by `r τ² m² / 2` more, with the slope m and the
//! tangent τ of yaw.
//!
//! Limits: one patch for each part, so that a tread that touches at two places has the mean of both;
//! curvatures are those at the given overlap, which should be that of the static load (0.1 mm for a loaded
//! freight car); places do not move with yaw. Beyond the table the search itself answers.

use numerics::scalar::Real;

use super::patch::ContactPatch;
use super::pose::{Frame, ProfileNode, WheelPose};
use super::search::{ContactPair, FindPatches};
use super::strips::StripLoads;
use super::turned::{TurnedWheel, WheelForm};
use crate::hertz::Material;
use crate::profile::ProfileError;

/// Largest lateral distance of the wheel's lowest point from the origin of the rail's profile, m, and largest
/// inclination of the axle.
const LATERAL: f64 = 0.025;
const INCLINATION: f64 = 0.01;
/// Points over both.
const COLUMNS: usize = 501;
const ROWS: usize = 5;
/// Spacing of samples of the silhouette, m.
const SAMPLE: f64 = 1e-4;
/// Overlap over which the share of a part falls to zero, m.
const FADE: f64 = 2e-5;
/// Values of a point of the table.
const VALUES: usize = 7;

/// A wheel and a rail with their tables.
#[derive(Clone, Debug)]
pub struct ContactTable {
    pair: ContactPair,
    /// Flange and tread; rows by inclination, columns by lateral place.
    parts: [Vec<[f64; VALUES]>; 2],
}

impl ContactTable {
    /// Returns the tables of a pair, from patches at an overlap (m, positive); that takes some tenths of a
    /// second.
    ///
    /// # Errors
    /// The overlap is not admissible, the rail's section changes along the track, or the wheel's around it.
    pub fn new(pair: ContactPair, overlap: f64) -> Result<Self, ProfileError> {
        if pair.varies() {
            return Err(ProfileError::Varying);
        }
        if let Some(WheelForm::Sliced(_)) = pair.form() {
            return Err(ProfileError::Sliced);
        }
        if !(1e-6..=1e-3).contains(&overlap) {
            return Err(ProfileError::Number {
                what: "overlap of a contact table (m)",
                value: overlap,
                must: "between 1e-6 and 1e-3 m",
            });
        }
        let mut parts = [Vec::new(), Vec::new()];
        let [start, division, end] = pair.wheel.division();
        for row in 0..ROWS {
            for column in 0..COLUMNS {
                let inclination = INCLINATION * (2.0 * row as f64 / (ROWS - 1) as f64 - 1.0);
                let lateral = LATERAL * (2.0 * column as f64 / (COLUMNS - 1) as f64 - 1.0);
                let found = [[start, division], [division, end]]
                    .map(|range| sample(&pair, overlap, lateral, inclination, range));
                let apart = found.map(|(_, prominence)| {
                    let part = (prominence / FADE).clamp(0.0, 1.0);
                    part * part * (3.0 - 2.0 * part)
                });
                let rest = match division > start {
                    true => 0.5 * (1.0 - apart[0]) * (1.0 - apart[1]),
                    false => 1.0 - apart[1],
                };
                for (part, (mut values, _)) in found.into_iter().enumerate() {
                    values[VALUES - 1] = apart[part] + rest;
                    parts[part].push(values);
                }
            }
        }
        Ok(Self { pair, parts })
    }

    /// Returns the pair.
    #[must_use]
    pub fn pair(&self) -> &ContactPair {
        &self.pair
    }

    /// Returns the values of a part at a lateral place and an inclination, given in spacings of the table.
    #[inline(always)]
    fn at<S: Real>(&self, part: usize, column: S, row: S) -> [S; VALUES] {
        let (i, u) = span(column.value(), COLUMNS);
        let (j, v) = span(row.value(), ROWS);
        let (wu, wv) = (weights(u), weights(v));
        let mut sums = [[0.0; 3]; VALUES];
        for (b, [weight, rate]) in wv.into_iter().enumerate() {
            let row = clamped(j, b, ROWS) * COLUMNS;
            for (a, [own, own_rate]) in wu.into_iter().enumerate() {
                let values = &self.parts[part][row + clamped(i, a, COLUMNS)];
                let (value, along, across) = (own * weight, own_rate * weight, own * rate);
                for (sum, entry) in sums.iter_mut().zip(values) {
                    sum[0] += value * entry;
                    sum[1] += along * entry;
                    sum[2] += across * entry;
                }
            }
        }
        // The function of two variables as a value and two slopes.
        sums.map(|[value, along, across]| column.chain(value, along) + row.chain(0.0, across))
    }
}

/// Returns the cell of a coordinate, and the place within it.
#[inline(always)]
fn span(value: f64, count: usize) -> (usize, f64) {
    let cell = (value.max(0.0) as usize).min(count - 2);
    (cell, value - cell as f64)
}

/// Returns the point `offset - 1` beside a cell, within the table.
#[inline(always)]
fn clamped(cell: usize, offset: usize, count: usize) -> usize {
    (cell + offset).saturating_sub(1).min(count - 1)
}

/// Weights of four points of Catmull and Rom's cubic, and their derivatives.
#[inline(always)]
fn weights(t: f64) -> [[f64; 2]; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        [0.5 * (2.0 * t2 - t - t3), 0.5 * (4.0 * t - 1.0 - 3.0 * t2)],
        [0.5 * (3.0 * t3 - 5.0 * t2 + 2.0), 0.5 * (9.0 * t2 - 10.0 * t)],
        [0.5 * (t + 4.0 * t2 - 3.0 * t3), 0.5 * (1.0 + 8.0 * t - 9.0 * t2)],
        [0.5 * (t3 - t2), 0.5 * (3.0 * t2 - 2.0 * t)],
    ]
}

/// Height at which a part touches, place, slope, profile coordinate, radius and logarithm of the sum of
/// curvatures across the track in the vertical direction; and by how much its largest overlap exceeds that at
/// the division.
fn sample(
    pair: &ContactPair,
    nominal: f64,
    lateral: f64,
    inclination: f64,
    [from, to]: [f64; 2],
) -> ([f64; VALUES], f64) {
    let height = pair.nominal_radius();
    if from == to {
        // There is no such part.
        return ([-height, 0.0, 0.0, 0.0, height, 0.0, 0.0], 0.0);
    }
    let level = (1.0 - inclination * inclination).sqrt();
    let rail = pair.rail.at(0.0);
    let pose = WheelPose {
        center: [lateral - inclination * height, height],
        axle: [0.0, level, inclination],
        along: 0.0,
        angle: 0.0,
    };
    // A wheel that is not round grows as a whole.
    let wheel = TurnedWheel::Round(&pair.wheel);
    let frame = Frame::new(&pose, &wheel, &rail);
    let count = ((to - from) / SAMPLE).ceil().max(1.0) as usize;
    let at = |i: usize| -> ProfileNode<f64> {
        let parameter = from + (to - from) * i as f64 / count as f64;
        frame.node(parameter)
    };
    let highest = (0..=count)
        .map(|i| at(i).overlap)
        .fold(f64::NEG_INFINITY, f64::max);
    // The division is the end of the flange and the beginning of the tread.
    let is_flange = pair.wheel.division()[1] == to;
    let border = at(if is_flange { count } else { 0 }).overlap;
    let offset = nominal - highest;
    let (mut squares, mut cubes) = (0.0, 0.0);
    let mut means = [0.0; 4];
    let mut before: Option<(ProfileNode<f64>, f64)> = None;
    for i in 0..=count {
        let node = at(i);
        let overlap = (node.overlap + offset).max(0.0);
        if let Some((old, old_overlap)) = before {
            let width = node.place[1] - old.place[1];
            for (node, overlap) in [(&old, old_overlap), (&node, overlap)] {
                let own = 0.5 * width * overlap * overlap;
                squares += own;
                cubes += own * overlap;
                let values = [node.place[1], node.slope, node.profile, node.radius];
                for (mean, value) in means.iter_mut().zip(values) {
                    *mean += own * value;
                }
            }
        }
        before = Some((node, overlap));
    }
    let [y, slope, profile, radius] = means.map(|mean| mean / squares);
    let depth = 7.0 / 6.0 * cubes / squares;
    let half_width = 15.0 / 16.0 * squares / (depth * depth);
    let touching = height - offset + depth;
    // The logarithm: a cubic through curvatures that change by a factor of 100 from point to point would
    // become negative.
    let curvature = libm::log(2.0 * depth / (half_width * half_width));
    (
        [touching, y, slope, profile, radius, curvature, 0.0],
        highest - border,
    )
}

impl FindPatches for ContactTable {
    fn find<S: Real>(
        &self,
        pose: &WheelPose<S>,
        mut take: impl FnMut(ContactPatch<S>, Option<&StripLoads<S>>),
    ) {
        let [x, y, z] = pose.axle;
        // The lateral place of the lowest point of the tape circle: rolling about it moves no flange aside.
        let lateral = pose.center[0] + z * self.pair.nominal_radius();
        let column = (lateral + LATERAL) * ((COLUMNS - 1) as f64 / (2.0 * LATERAL));
        let row = (z + INCLINATION) * ((ROWS - 1) as f64 / (2.0 * INCLINATION));
        let inside = |value: f64, count: usize| value >= 0.0 && value <= (count - 1) as f64;
        if !(inside(column.value(), COLUMNS) && inside(row.value(), ROWS) && y.value() > 0.0) {
            return self.pair.find(pose, take);
        }
        let tangent = x / ((x * x - 1.0) * -1.0).sqrt();
        let grown = match self.pair.turned(pose.angle.value()) {
            TurnedWheel::Grown(_, [height, rate, bend]) => Some([(height, rate), (rate, bend)]),
            _ => None,
        };
        let grown = grown.map(|both| both.map(|(value, slope)| pose.angle.chain(value, slope)));
        for part in 0..2 {
            let [touching, place, slope, profile, radius, curvature, share] = self.at(part, column, row);
            let curvature = curvature.exp();
            let lead = tangent * slope;
            let mut depth = touching - pose.center[1] + radius * lead * lead * 0.5;
            let mut ahead = profile * x - radius * lead;
            let mut radius = radius;
            if let Some([height, rate]) = grown {
                depth += height;
                radius += height;
                ahead += rate;
            }
            if depth.value() <= 0.0 || share.value() <= 0.0 {
                continue;
            }
            let cosine = (slope * slope + 1.0).sqrt().recip();
            let rolling = cosine / radius;
            let curvatures = [rolling, curvature * cosine * cosine * cosine];
            // The wheel's point: the center's height less the radius, raised by the inclination of the axle.
            let down = pose.center[1] + profile * z - radius * y;
            let patch = ContactPatch {
                share,
                place: [ahead, place, down],
                slope,
                cosine,
                climb: None,
                profile,
                radius,
                approach: depth * cosine,
                half_width: (depth * 2.0 / curvature).sqrt(),
                curvatures,
                ellipse: self.pair.ellipses.of(curvatures[0], curvatures[1]),
            };
            take(patch, None);
        }
    }

    fn material(&self) -> Material {
        self.pair.material()
    }
}
