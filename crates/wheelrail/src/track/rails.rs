//! The rails in space: where each rail lies, how it leads, and the foot of a point on it.
//!
//! A rail is the curve `r(s) = C(s) + w e_y + h e_z` beside the center line C, with the axes e_y (to the
//! left) and e_z (up) of the track's plane at its roll φ, the distance w from the middle and the height h,
//! both with irregularities. With the curvature κ, the grade g and the level forward direction e_f,
//!
//! ```text
//! r' = e_f (1 - κ w cos φ + κ h sin φ) + g z + (w' - h φ') e_y + (h' + w φ') e_z
//! ```
//!
//! The axes of a section are the tangent `r'/|r'|`, and left and up in the plane square to it: they are
//! tilted with the actual rail. The rail is at rest; what moves over it sees other sections.
//!
//! The **foot** of a point is where the section holds it: `(p - r(s)) · r'(s) = 0`. It is found from the
//! point alone: places every 2 m, each skipping as far as the point is away, then Newton's method. Where a
//! track passes a point more than once, the first passage counts; [`CenterLine::near_itself`] tells of such
//! tracks.
//!
//! Irregularities and roll are kept at points 1/8 m apart with their derivatives, and are quintics between
//! them (relative error 5e-7 at a wavelength of 1.5 m). Corners of the superelevation are rounded: it is
//! averaged over 2 m, since a rail does not bend sharply. Before the start and beyond the end the
//! irregularities go on as they are defined there, the superelevation is held.

use numerics::scalar::{Dual, Number, Real};

use super::center_line::CenterLine;
use super::layout::Track;
use crate::vector::{cross, dot};

/// Distance of the points between which irregularities are interpolated, m.
const SPACING: f64 = 0.125;
/// Distance of the places from which feet are looked for, m.
pub(super) const STRIDE: f64 = 2.0;
/// A place this near begins Newton's method, m.
pub(super) const CLOSE: f64 = 5.0;
/// Points that are searched for lie within this distance of the center line, m; less than [`CLOSE`] by half a
/// stride.
const BESIDE: f64 = 4.0;
/// Half the length over which superelevation is averaged, m.
const ROUNDING: f64 = 1.0;
/// Intervals of that average.
const AVERAGED: usize = 128;
/// Newton's method ends at steps below this, m; what they leave is taken by the last linear step.
const CONVERGED: f64 = 1e-6;
/// Distances of rails and their heights (left, right) and the roll, each with two derivatives by the
/// distance.
type Node = [[f64; 3]; 5];

/// A line of the track.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// The left rail.
    Left,
    /// The right rail.
    Right,
    /// The center line, without irregularities.
    Center,
}

/// Both rails of a track in space.
#[derive(Clone, Debug)]
pub struct RailLines {
    track: Track,
    /// Distances of the rails' origins from the middle, m.
    offsets: [f64; 2],
    rail_distance: f64,
    /// Irregularities and roll at multiples of [`SPACING`]; empty if there are none.
    nodes: Vec<Node>,
    /// Places in plan at multiples of [`STRIDE`], m.
    places: Vec<[f64; 2]>,
}

/// A section of a line: origin (m) and axes along, left, up, in the fixed axes of the track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackSection<S> {
    /// Distance along the track, m.
    pub distance: S,
    /// Its origin, m.
    pub origin: [S; 3],
    /// Unit vectors along the line, to the left, and up.
    pub axes: [[S; 3]; 3],
    /// Curvature of the center line in plan, 1/m.
    pub curvature: f64,
}

/// The foot of a point on a line.
#[derive(Clone, Debug)]
pub struct Foot {
    distance: f64,
    at: At,
    /// Minus the derivative of `(p - r) · r'` by the distance.
    slope: f64,
}

/// A line at a distance, with derivatives by it.
#[derive(Clone, Debug)]
struct At {
    origin: [Dual<1>; 3],
    /// r', not of unit length.
    leads: [Dual<1>; 3],
    axes: [[Dual<1>; 3]; 3],
    curvature: f64,
}

impl<S: Real> TrackSection<S> {
    /// Returns a vector in the axes of the section.
    #[inline(always)]
    pub fn of(&self, vector: [S; 3]) -> [S; 3] {
        self.axes.map(|axis| dot(axis, vector))
    }

    /// Returns a vector that is given in the axes of the section in the track's fixed axes.
    #[inline(always)]
    pub fn fixed(&self, [x, y, z]: [S; 3]) -> [S; 3] {
        let [a, b, c] = self.axes;
        [0, 1, 2].map(|i| a[i] * x + b[i] * y + c[i] * z)
    }
}

impl RailLines {
    /// Returns the rails of a track; the origins of their profiles are `offsets` (m, left and right, both
    /// positive) away from the middle.
    #[must_use]
    pub fn new(track: Track, offsets: [f64; 2]) -> Self {
        let line = &track.center_line;
        let strides = (line.length() / STRIDE).ceil() as usize;
        let places = (0..=strides).map(|k| {
            let [x, y, _] = line.at(k as f64 * STRIDE).position;
            [x, y]
        });
        let places = places.collect();
        let rail_distance = line.rail_distance();
        let mut lines = Self {
            track,
            offsets,
            rail_distance,
            nodes: Vec::new(),
            places,
        };
        let line = &lines.track.center_line;
        let level = line.is_level_across();
        if !(level && lines.track.irregularities.is_empty()) {
            let count = (line.length() / SPACING).ceil() as usize + 1;
            lines.nodes = (0..=count).map(|k| lines.exact(k as f64 * SPACING)).collect();
        }
        lines
    }

    /// Returns the center line.
    #[must_use]
    pub fn center_line(&self) -> &CenterLine {
        &self.track.center_line
    }

    /// Irregularities and roll at a distance.
    fn exact(&self, distance: f64) -> Node {
        let [left, right] = self.track.rails(distance);
        let raised = |at: f64| self.track.center_line.at(at).superelevation;
        let step = 2.0 * ROUNDING / AVERAGED as f64;
        let inner: f64 = (1..AVERAGED)
            .map(|k| raised(distance - ROUNDING + k as f64 * step)[0])
            .sum();
        let [low, high] = [raised(distance - ROUNDING), raised(distance + ROUNDING)];
        let mean = (inner + 0.5 * (low[0] + high[0])) / AVERAGED as f64;
        let [sine, slope, second] = [
            mean,
            (high[0] - low[0]) / (2.0 * ROUNDING),
            (high[1] - low[1]) / (2.0 * ROUNDING),
        ]
        .map(|value| value / self.rail_distance);
        let cosine = (1.0 - sine * sine).sqrt();
        let roll = [
            -libm::asin(sine),
            -slope / cosine,
            -(second + sine * slope * slope / (cosine * cosine)) / cosine,
        ];
        [left.lateral, left.vertical, right.lateral, right.vertical, roll]
    }

    /// Returns the same by interpolation.
    #[inline(always)]
    fn interpolated(&self, distance: f64) -> Node {
        if self.nodes.is_empty() {
            return [[0.0; 3]; 5];
        }
        let at = distance / SPACING;
        if !(at >= 0.0 && at < (self.nodes.len() - 1) as f64) {
            return self.exact(distance);
        }
        let number = at as usize;
        let t = at - number as f64;
        let (from, to) = (&self.nodes[number], &self.nodes[number + 1]);
        let mut node = [[0.0; 3]; 5];
        for (own, (from, to)) in node.iter_mut().zip(from.iter().zip(to)) {
            *own = quintic(from, to, t);
        }
        node
    }

    /// Returns a line at a distance.
    #[inline(always)]
    fn at(&self, line: Line, distance: f64) -> At {
        let station = self.track.center_line.at(distance);
        let node = self.interpolated(distance);
        let zero = Dual::<1>::from(0.0);
        let dual = |value: f64, slope: f64| Dual {
            value,
            derivative: [slope],
        };
        let pair = |signal: &[f64; 3]| [dual(signal[0], signal[1]), dual(signal[1], signal[2])];
        let ([mut w, dw], [h, dh]) = match line {
            Line::Left => (pair(&node[0]), pair(&node[1])),
            Line::Right => (pair(&node[2]), pair(&node[3])),
            Line::Center => ([zero; 2], [zero; 2]),
        };
        w = match line {
            Line::Left => w + self.offsets[0],
            Line::Right => w - self.offsets[1],
            Line::Center => w,
        };
        let [roll, roll_rate] = pair(&node[4]);
        let curvature = dual(station.curvature[0], station.curvature[1]);
        let grade = dual(station.grade, station.grade_rate);
        let (sine, cosine) = dual(station.heading, station.curvature[0]).sin_cos();
        let (tilt, upright) = roll.sin_cos();
        let forward = [cosine, sine, zero];
        let left = [-(sine * upright), cosine * upright, tilt];
        let up = [sine * tilt, -(cosine * tilt), upright];
        let place =
            [0, 1, 2].map(|i| dual(station.position[i], [cosine.value, sine.value, station.grade][i]));
        let origin = [0, 1, 2].map(|i| place[i] + left[i] * w + up[i] * h);
        let along = curvature * (h * tilt - w * upright) + 1.0;
        let (sideways, upwards) = (dw - h * roll_rate, dh + w * roll_rate);
        let mut leads = [0, 1, 2].map(|i| forward[i] * along + left[i] * sideways + up[i] * upwards);
        leads[2] += grade;
        let tangent = unit(leads);
        let up = unit(cross(tangent, left));
        At {
            origin,
            leads,
            axes: [tangent, cross(up, tangent), up],
            curvature: station.curvature[0],
        }
    }

    /// Returns the section of a line at a distance (m).
    #[must_use]
    pub fn section_at(&self, line: Line, distance: f64) -> TrackSection<f64> {
        let at = self.at(line, distance);
        TrackSection {
            distance,
            origin: at.origin.map(Real::value),
            axes: at.axes.map(|axis| axis.map(Real::value)),
            curvature: at.curvature,
        }
    }

    /// Returns the section of a line at a distance (m), with the derivatives of the distance.
    #[must_use]
    pub fn section_over<S: Real>(&self, line: Line, distance: S) -> TrackSection<S> {
        let at = self.at(line, distance.value());
        let rest = distance - distance.value();
        let lift = |own: Dual<1>| rest.chain(own.value, own.derivative[0]);
        TrackSection {
            distance,
            origin: at.origin.map(lift),
            axes: at.axes.map(|axis| axis.map(lift)),
            curvature: at.curvature,
        }
    }

    /// Returns the irregularities (m) of the left and the right rail at a distance (m): to the left, and up.
    #[must_use]
    pub fn irregularities(&self, distance: f64) -> [[f64; 2]; 2] {
        let [left_lateral, left_vertical, right_lateral, right_vertical, _] = self.interpolated(distance);
        [
            [left_lateral[0], left_vertical[0]],
            [right_lateral[0], right_vertical[0]],
        ]
    }

    /// Returns a distance near the foot of a point in plan, from the point alone.
    fn near(&self, point: [f64; 2]) -> f64 {
        let away = |place: [f64; 2]| libm::hypot(point[0] - place[0], point[1] - place[1]);
        let last = self.places.len() - 1;
        let mut number = 0;
        loop {
            let distance = away(self.places[number]);
            if distance <= CLOSE {
                return number as f64 * STRIDE;
            }
            if number == last {
                break;
            }
            let skipped = ((distance - BESIDE) / STRIDE) as usize;
            number = number.saturating_add(skipped.max(1)).min(last);
        }
        // Before the start or beyond the end.
        match away(self.places[0]) < away(self.places[last]) {
            true => 0.0,
            false => self.track.center_line.length(),
        }
    }

    /// Returns the foot of a point (m, fixed axes of the track) on a line.
    #[must_use]
    pub fn foot(&self, line: Line, point: [f64; 3]) -> Foot {
        let mut distance = self.near([point[0], point[1]]);
        let mut at = self.at(line, distance);
        let mut slope = 1.0;
        for _ in 0..30 {
            let arm = [0, 1, 2].map(|i| point[i] - at.origin[i].value);
            let (mut along, mut bend, mut square) = (0.0, 0.0, 0.0);
            for (arm, leads) in arm.iter().zip(&at.leads) {
                along += arm * leads.value;
                bend += arm * leads.derivative[0];
                square += leads.value * leads.value;
            }
            // Zero at the center of curvature.
            slope = (square - bend).max(0.1 * square);
            let step = along / slope;
            if step.abs() < CONVERGED || !step.is_finite() {
                break;
            }
            distance += step;
            at = self.at(line, distance);
        }
        Foot { distance, at, slope }
    }

    /// Returns the section of a line that holds a point (m, fixed axes of the track).
    #[inline(always)]
    pub fn section<S: Real>(&self, line: Line, point: [S; 3]) -> TrackSection<S> {
        self.foot(line, point.map(Real::value)).section(point)
    }
}

impl Foot {
    /// Returns the section that holds the point, with the derivatives of the point.
    #[inline(always)]
    pub fn section<S: Real>(&self, point: [S; 3]) -> TrackSection<S> {
        let at = &self.at;
        let mut step = S::zero();
        for i in 0..3 {
            step += (point[i] - at.origin[i].value) * at.leads[i].value;
        }
        let step = step * (1.0 / self.slope);
        let lift = |value: Dual<1>| {
            let slope = value.derivative[0];
            step.chain(value.value + slope * step.value(), slope)
        };
        TrackSection {
            distance: step + self.distance,
            origin: at.origin.map(lift),
            axes: at.axes.map(|axis| axis.map(lift)),
            curvature: at.curvature,
        }
    }
}

/// Returns value and derivatives at the share t of a cell between nodes with value and two derivatives.
#[inline(always)]
fn quintic(from: &[f64; 3], to: &[f64; 3], t: f64) -> [f64; 3] {
    let h = SPACING;
    let ([p0, v0, a0], [p1, v1, a1]) = (
        [from[0], from[1] * h, from[2] * h * h],
        [to[0], to[1] * h, to[2] * h * h],
    );
    let d = p1 - p0;
    let c2 = 0.5 * a0;
    let c3 = 10.0 * d - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1;
    let c4 = -15.0 * d + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1;
    let c5 = 6.0 * d - 3.0 * (v0 + v1) - 0.5 * (a0 - a1);
    [
        p0 + t * (v0 + t * (c2 + t * (c3 + t * (c4 + t * c5)))),
        (v0 + t * (2.0 * c2 + t * (3.0 * c3 + t * (4.0 * c4 + t * 5.0 * c5)))) / h,
        (2.0 * c2 + t * (6.0 * c3 + t * (12.0 * c4 + t * 20.0 * c5))) / (h * h),
    ]
}

#[inline(always)]
fn unit<S: Real>(v: [S; 3]) -> [S; 3] {
    let inverse = dot(v, v).sqrt().recip();
    v.map(|component| component * inverse)
}
