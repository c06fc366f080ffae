//! Profiles prepared for the contact search: tables of cubics that are evaluated in constant time.
//!
//! The visible part of a profile is the longest one around its datum whose direction stays within
//! 82° of level. A wheel is a curve by a parameter s close to arc length, from the back of the
//! flange over its tip to the field side; a rail is a function z(y), which goes on with its end slopes beyond
//! its ends. Both are cubics through points and tangents 0.1 mm apart: their slopes are continuous, and they
//! lie within 0.05 μm of the profile.

use numerics::scalar::Real;

use crate::profile::{Profile, ProfileError, ProfileKind, visible_from, zero_of};

/// Shortest section, m.
const SHORTEST: f64 = 5e-3;
/// Spacing of the cubics, m.
const SPACING: f64 = 1e-4;
/// Most stations of the scan.
pub(super) const STATIONS: usize = 512;
/// Least spacing of stations, in cubics.
pub(super) const STRIDE: usize = 5;

/// Returns the cubic (from its constant on) with values and slopes at 0 and at `length`.
pub(super) fn hermite(length: f64, [from, to]: [f64; 2], [slope, end_slope]: [f64; 2]) -> [f64; 4] {
    let mean = (to - from) / length;
    [
        from,
        slope,
        (3.0 * mean - 2.0 * slope - end_slope) / length,
        (slope + end_slope - 2.0 * mean) / (length * length),
    ]
}

pub(super) fn value([a, b, c, d]: &[f64; 4], t: f64) -> f64 {
    a + t * (b + t * (c + t * d))
}

pub(super) fn slope([_, b, c, d]: &[f64; 4], t: f64) -> f64 {
    b + t * (2.0 * c + t * 3.0 * d)
}

pub(super) fn second([_, _, c, d]: &[f64; 4], t: f64) -> f64 {
    2.0 * c + 6.0 * t * d
}

/// Checks kind and datum of a profile; returns the range that is visible.
pub(super) fn prepared(profile: &Profile, expected: ProfileKind) -> Result<[f64; 2], ProfileError> {
    let place = || crate::profile::ProfilePlace::whole(profile.name());
    if profile.kind() != expected {
        return Err(ProfileError::Kind {
            place: place(),
            found: profile.kind().word(),
            expected: expected.word(),
        });
    }
    let datum = zero_of(profile.curve()).ok_or_else(|| ProfileError::Orientation {
        place: place(),
        found: "the profile does not pass y = 0 towards the field side".into(),
        remedy: "give it with its datum: y = 0 in a wheel's tape circle, or in a rail's head".into(),
    })?;
    let [start, end] = visible_from(profile.curve(), datum);
    if end - start < SHORTEST {
        return Err(ProfileError::Orientation {
            place: place(),
            found: format!(
                "only {:.2} mm of the profile around y = 0 are less steep than 82°",
                (end - start) * 1e3
            ),
            remedy: "look at the order of its points, its unit and its datum".into(),
        });
    }
    Ok([start, end])
}

/// Returns the number of cubics of a visible range.
pub(super) fn cells([start, end]: [f64; 2]) -> usize {
    libm::ceil((end - start) / SPACING).max(1.0) as usize
}

/// A point of a wheel's profile with derivatives by the parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct WheelPoint<S> {
    /// y of the profile, m.
    pub y: S,
    /// Radius, m.
    pub radius: S,
    /// Derivative of the radius by y.
    pub slope: S,
}

/// A wheel prepared for the search.
#[derive(Clone, Debug)]
pub(super) struct WheelSection {
    /// Nominal radius, m.
    radius: f64,
    start: f64,
    step: f64,
    /// Cubics of y and z by the parameter.
    cells: Vec<[[f64; 4]; 2]>,
    /// Cubics between stations.
    stride: usize,
    /// y, radius, slope of the radius at stations.
    stations: Vec<[f64; 3]>,
}

impl WheelSection {
    pub fn new(profile: &Profile, radius: f64) -> Result<Self, ProfileError> {
        let [start, end] = prepared(profile, ProfileKind::Wheel)?;
        let count = cells([start, end]);
        let step = (end - start) / count as f64;
        let points: Vec<_> = (0..=count)
            .map(|i| profile.curve().at(start + step * i as f64))
            .collect();
        let cells = points.windows(2).map(|pair| {
            [0, 1].map(|axis| {
                let [a, b] = [&pair[0], &pair[1]];
                hermite(
                    step,
                    [a.position[axis], b.position[axis]],
                    [a.tangent[axis], b.tangent[axis]],
                )
            })
        });
        let mut section = Self {
            radius,
            start,
            step,
            cells: cells.collect(),
            stride: STRIDE.max(count.div_ceil(STATIONS - 2)),
            stations: Vec::new(),
        };
        let last = count.div_ceil(section.stride);
        section.stations = (0..=last)
            .map(|station| {
                let point = section.at(section.parameter(station));
                [point.y, point.radius, point.slope]
            })
            .collect();
        Ok(section)
    }

    /// Returns the nominal radius, m.
    pub fn nominal_radius(&self) -> f64 {
        self.radius
    }

    /// Returns the parameters (m) of the beginning, of the place in the throat of the flange with a slope of
    /// 45°, and of the end; the first two are equal if there is no flange.
    pub fn division(&self) -> [f64; 3] {
        let end = self.start + self.step * self.cells.len() as f64;
        let knots = (0..self.cells.len())
            .rev()
            .map(|cell| self.start + self.step * cell as f64);
        let division = knots
            .filter(|parameter| self.at(*parameter).y < 0.0)
            .find(|parameter| self.at(*parameter).slope < -1.0);
        [self.start, division.unwrap_or(self.start), end]
    }

    /// Returns y, radius and slope of the radius at the stations of the scan.
    pub fn stations(&self) -> &[[f64; 3]] {
        &self.stations
    }

    /// Returns the parameter of a station, m.
    pub fn parameter(&self, station: usize) -> f64 {
        let cell = (station * self.stride).min(self.cells.len());
        self.start + self.step * cell as f64
    }

    /// Returns the point at a parameter; beyond the ends the last cubics go on.
    #[inline(always)]
    pub fn at<S: Real>(&self, parameter: S) -> WheelPoint<S> {
        let relative = (parameter.value() - self.start) / self.step;
        let cell = (relative.max(0.0) as usize).min(self.cells.len() - 1);
        let [y, z] = &self.cells[cell];
        let t = parameter.value() - (self.start + self.step * cell as f64);
        let (dy, dz) = (slope(y, t), slope(z, t));
        let rise = dz / dy;
        let bend = (second(z, t) - rise * second(y, t)) / dy;
        WheelPoint {
            y: parameter.chain(value(y, t), dy),
            radius: parameter.chain(self.radius - value(z, t), -dz),
            slope: parameter.chain(-rise, -bend),
        }
    }
}

/// A rail prepared for the search.
#[derive(Clone, Debug)]
pub(super) struct RailSection {
    /// y at which each cubic begins; one more for the end.
    knots: Vec<f64>,
    cells: Vec<[f64; 4]>,
    /// Width of a bucket, and the first cubic that reaches into it.
    bucket: f64,
    buckets: Vec<u32>,
    /// z on the borders of buckets.
    coarse: Vec<f64>,
    /// Lines beyond the ends: z and slope there.
    ends: [[f64; 2]; 2],
}

impl RailSection {
    pub fn new(profile: &Profile) -> Result<Self, ProfileError> {
        let [start, end] = prepared(profile, ProfileKind::Rail)?;
        let count = cells([start, end]);
        let points: Vec<_> = (0..=count)
            .map(|i| {
                profile
                    .curve()
                    .at(start + (end - start) * (i as f64 / count as f64))
            })
            .collect();
        let knots: Vec<f64> = points.iter().map(|point| point.position[0]).collect();
        let rise = |i: usize| points[i].tangent[1] / points[i].tangent[0];
        let cells = (0..count).map(|i| {
            hermite(
                knots[i + 1] - knots[i],
                [points[i].position[1], points[i + 1].position[1]],
                [rise(i), rise(i + 1)],
            )
        });
        let ends = [0, count].map(|i| [points[i].position[1], rise(i)]);
        let width = knots[count] - knots[0];
        let bucket_count = libm::ceil(width / SPACING).max(1.0) as usize;
        let bucket = width / bucket_count as f64;
        let mut cell = 0;
        let buckets = (0..bucket_count).map(|i| {
            let begin = knots[0] + bucket * i as f64;
            while cell + 1 < count && knots[cell + 1] <= begin {
                cell += 1;
            }
            cell as u32
        });
        let mut section = Self {
            buckets: buckets.collect(),
            cells: cells.collect(),
            knots: knots.clone(),
            bucket,
            coarse: Vec::new(),
            ends,
        };
        section.coarse = (0..=bucket_count)
            .map(|i| section.at(knots[0] + bucket * i as f64)[0])
            .collect();
        Ok(section)
    }

    /// Returns its beginning and end, m.
    pub fn range(&self) -> [f64; 2] {
        [self.knots[0], self.knots[self.cells.len()]]
    }

    /// Returns height (m) and slope at y (m).
    #[inline(always)]
    pub fn at<S: Real>(&self, y: S) -> [S; 2] {
        let at = y.value();
        let [low, high] = self.range();
        let side = usize::from(at >= high);
        if at < low || at >= high {
            let [z, rise] = self.ends[side];
            let begin = [low, high][side];
            return [y.chain(z + rise * (at - begin), rise), S::from(rise)];
        }
        let bucket = (((at - low) / self.bucket) as usize).min(self.buckets.len() - 1);
        let mut cell = self.buckets[bucket] as usize;
        while cell + 1 < self.cells.len() && self.knots[cell + 1] <= at {
            cell += 1;
        }
        let (cubic, t) = (&self.cells[cell], at - self.knots[cell]);
        let rise = slope(cubic, t);
        [y.chain(value(cubic, t), rise), y.chain(rise, second(cubic, t))]
    }

    /// Returns the height (m) at y (m) by a straight line between neighbors 0.1 mm apart.
    #[inline(always)]
    pub fn coarse(&self, y: f64) -> f64 {
        let [low, high] = self.range();
        if y < low {
            return self.ends[0][0] + self.ends[0][1] * (y - low);
        }
        if y > high {
            return self.ends[1][0] + self.ends[1][1] * (y - high);
        }
        let relative = (y - low) / self.bucket;
        let index = (relative as usize).min(self.coarse.len() - 2);
        let (from, to) = (self.coarse[index], self.coarse[index + 1]);
        from + (to - from) * (relative - index as f64)
    }
}
