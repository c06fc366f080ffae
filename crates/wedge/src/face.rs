//! The faces of a wedge: grids of weighted points, crowns and worn profiles, friction over the face, pads.
//!
//! A face of the wedge is where its points lie; a profile moves them into the wedge. What the counterface,
//! friction and a pad are beyond a plain face is the [`Interface`] of the contact.

mod depth_map;
mod grid;

use mechanics::contact::{ContactPoint, FrictionDirections, Interface, Sliding};
use mechanics::friction::FrictionLaw;
use mechanics::surface::{ProfileDirection, SurfaceProfile, SurfaceShape};
use mechanics::vector::Vector;
use serde::{Deserialize, Serialize};

pub use self::depth_map::{DepthMap, DepthMapError};
pub use self::grid::{Grid, GridPoint, LARGEST_GRID};
use crate::parameters::{Contact, FaceFriction, ParameterError, check, not_negative, positive};

/// Points, profiles, wear and friction of a face and of the surface that it touches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct FaceProperties {
    /// Its points.
    pub grid: Grid,
    /// The profile of the wedge's face.
    pub wedge_surface: FaceProfile,
    /// The further recession of the wedge's face, as by wear: a map over the face.
    pub wedge_wear: Option<DepthMap>,
    /// The profile of the surface that it touches: of the column, or of the slope of the pocket.
    pub counterface: FaceProfile,
    /// The further recession of it, as by wear: a map over the face in its nominal place.
    pub counterface_wear: Option<DepthMap>,
    /// Coefficient of sliding; without one it is that of rest.
    pub sliding_friction: Option<f64>,
    /// Slip speed at which half of the way from rest to sliding is gone, m/s.
    pub stribeck_speed: f64,
    /// Load of the face at which its coefficients are half of those without load, N; without one they do not
    /// depend on the load.
    pub friction_half_load: Option<f64>,
    /// The directions in which friction acts: on both tangents of the face, or along its line of travel
    /// alone.
    pub friction_directions: FrictionDirections,
    /// Factors of the coefficients over the face; empty: 1 everywhere.
    pub friction_map: FrictionMap,
    /// A resilient pad.
    pub pad: Option<Pad>,
}

/// The Stribeck speed unless another is given, m/s: 0.1 in/s, a hundred times the thesis's reference speed of
/// tanh.
pub const STRIBECK_SPEED: f64 = 0.1 * 0.0254;

impl Default for FaceProperties {
    fn default() -> Self {
        Self {
            grid: Grid::default(),
            wedge_surface: FaceProfile::default(),
            wedge_wear: None,
            counterface: FaceProfile::default(),
            counterface_wear: None,
            sliding_friction: None,
            stribeck_speed: STRIBECK_SPEED,
            friction_half_load: None,
            friction_directions: FrictionDirections::Two,
            friction_map: FrictionMap::new(),
            pad: None,
        }
    }
}

/// Factors over a face: rows from the lower to the upper edge, each from the right to the left edge. Between
/// them they are bilinear.
pub type FrictionMap = Vec<Vec<f64>>;

/// Recession of a face or of its counterface.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FaceProfile {
    /// Depth over the distance from the middle of the face, up or to the left, m.
    pub profile: SurfaceProfile,
    /// The direction of the profile.
    pub direction: FaceDirection,
    /// The depth to which its highest part is worn flat, m: where the profile is deeper it is as it was.
    /// Depths are counted from the flat. Of the wedge's surface alone.
    #[serde(default)]
    pub worn_flat: f64,
}

impl FaceProfile {
    /// Returns the depth (m) at a distance from the middle (m).
    fn depth(&self, distance: f64) -> f64 {
        let [depth, ..] = self.profile.depth(distance);
        match self.worn_flat {
            0.0 => depth,
            flat => (depth - flat).max(0.0),
        }
    }

    /// Returns half of the width of its flat (m), if it is an arc that is worn flat.
    #[must_use]
    pub fn half_flat(&self) -> Option<f64> {
        match &self.profile {
            SurfaceProfile::Arc { curvature } if self.worn_flat > 0.0 => {
                Some((self.worn_flat * (2.0 / curvature - self.worn_flat)).sqrt())
            }
            _ => None,
        }
    }
}

/// A direction along a face.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FaceDirection {
    /// From the lower to the upper edge.
    #[default]
    Up,
    /// From the right to the left edge.
    Across,
}

/// A resilient pad on a face, in place of the contact of steel on steel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pad {
    /// Normal stiffness of the whole pad at small compressions, N/m.
    pub stiffness: f64,
    /// Normal damping of the whole pad, N·s/m; it never pulls.
    pub damping: f64,
    /// Compression at which its force is twice that of a linear spring, m; without one it is linear.
    pub hardening: Option<f64>,
    /// Coefficient of friction of its surface (of rest, if there is one of sliding).
    pub friction: f64,
    /// Shear stiffness (N/m) and damping (N·s/m) of the whole pad: its friction is by bristles then.
    pub shear: Option<[f64; 2]>,
}

/// A face of a wedge, seen along y: it leads from its lower to its upper edge. Lengths in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// x and z of the lower edge.
    pub lower: [f64; 2],
    /// x and z of the upper edge.
    pub upper: [f64; 2],
    /// Width along y, which is zero in the middle.
    pub width: f64,
    /// True if the wedge lies on the side of +x.
    pub faces_backward: bool,
}

impl Rectangle {
    /// Returns its length from the lower to the upper edge, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        libm::hypot(self.upper[0] - self.lower[0], self.upper[1] - self.lower[1])
    }

    /// Returns the offsets of a point from the middle, up and to the left, m.
    #[must_use]
    pub fn distances(&self, point: &GridPoint) -> (f64, f64) {
        (self.length() * (point.up - 0.5), 0.5 * self.width * point.across)
    }

    /// Returns the unit vector (x, z) into the wedge.
    fn inward(&self) -> [f64; 2] {
        let sign = if self.faces_backward { 1.0 } else { -1.0 };
        let length = self.length();
        [
            sign * (self.upper[1] - self.lower[1]) / length,
            -sign * (self.upper[0] - self.lower[0]) / length,
        ]
    }

    /// Returns the place of a point.
    fn place(&self, point: &GridPoint) -> [f64; 3] {
        let between = |low: f64, high: f64| match point.up {
            up if up >= 1.0 => high,
            up => low + (high - low) * up,
        };
        let [x, z] = [0, 1].map(|k| between(self.lower[k], self.upper[k]));
        [x, 0.5 * self.width * point.across, z]
    }
}

impl FaceProperties {
    /// Returns the contact points of a face. `contact` is that of each of four corners: each point has its
    /// share of the stiffness and damping of all four. Positions as those of the rectangle.
    #[must_use]
    pub fn points(&self, face: &Rectangle, contact: &Contact) -> Vec<ContactPoint> {
        let contact = match &self.pad {
            None => *contact,
            Some(pad) => Contact {
                stiffness: 0.25 * pad.stiffness,
                damping: 0.25 * pad.damping,
            },
        };
        let point = |own: &GridPoint| ContactPoint {
            position: Vector(self.place(face, own)),
            stiffness: contact.stiffness * (4.0 * own.weight),
            damping: contact.damping * (4.0 * own.weight),
            share: own.weight,
        };
        self.grid.points().iter().map(point).collect()
    }

    /// Returns the place of a point of the wedge's surface.
    fn place(&self, face: &Rectangle, point: &GridPoint) -> [f64; 3] {
        let flat = face.place(point);
        if self.wedge_surface.profile.is_flat() && self.wedge_wear.is_none() {
            return flat;
        }
        let (up, across) = face.distances(point);
        let distance = match self.wedge_surface.direction {
            FaceDirection::Up => up,
            FaceDirection::Across => across,
        };
        let mut depth = self.wedge_surface.depth(distance);
        if let Some(map) = &self.wedge_wear {
            depth += map.depth(up, across);
        }
        let inward = face.inward();
        [flat[0] + depth * inward[0], flat[1], flat[2] + depth * inward[1]]
    }

    /// Returns whether the counterface is a plane.
    #[must_use]
    pub fn touches_a_plane(&self) -> bool {
        self.counterface.profile.is_flat() && self.counterface_wear.is_none()
    }

    /// Returns the area of the face (m²) that each of its points stands for.
    #[must_use]
    pub fn areas(&self, face: &Rectangle) -> Vec<f64> {
        let area = face.length() * face.width;
        self.grid
            .points()
            .iter()
            .map(|point| area * point.weight)
            .collect()
    }

    /// Returns the friction at rest: that of the pad, if there is one.
    #[must_use]
    pub fn friction(&self, steel: &FaceFriction) -> FaceFriction {
        let Some(pad) = &self.pad else {
            return *steel;
        };
        FaceFriction {
            coefficient: pad.friction,
            law: match pad.shear {
                Some([stiffness, damping]) => FrictionLaw::Bristle { stiffness, damping },
                None => steel.law,
            },
        }
    }

    /// Returns the refinements of the contact with this friction at rest. `reversed` says whether the
    /// marker's axes z and y point down and to the right.
    #[must_use]
    pub fn interface(&self, friction: &FaceFriction, reversed: [bool; 2]) -> Interface {
        // That there is one, `validate` has checked.
        let worn = self.counterface_wear.as_ref();
        let worn = worn.and_then(|map| map.surface(reversed).ok());
        let (direction, reversed) = match self.counterface.direction {
            FaceDirection::Up => (ProfileDirection::Z, reversed[0]),
            FaceDirection::Across => (ProfileDirection::Y, reversed[1]),
        };
        let profile = &self.counterface.profile;
        let sliding = self.sliding_friction.filter(|_| friction.coefficient > 0.0);
        let factors = match self.friction_map.is_empty() {
            true => Vec::new(),
            false => self
                .grid
                .points()
                .iter()
                .map(|point| self.factor(point))
                .collect(),
        };
        Interface {
            shape: SurfaceShape {
                profile: if reversed {
                    profile.mirrored()
                } else {
                    profile.clone()
                },
                direction,
                worn,
            },
            sliding: Sliding {
                ratio: sliding.map_or(1.0, |sliding| sliding / friction.coefficient),
                stribeck_speed: match sliding {
                    Some(_) => self.stribeck_speed,
                    None => Sliding::default().stribeck_speed,
                },
                half_load: self.friction_half_load.unwrap_or(f64::INFINITY),
            },
            directions: self.friction_directions,
            friction_factors: factors,
            hardening: self.pad.and_then(|pad| pad.hardening),
            first_arm: 0.0,
        }
    }

    /// Returns the factor of friction at a point.
    fn factor(&self, point: &GridPoint) -> f64 {
        let between = |share: f64, count: usize| {
            let place = share * (count - 1) as f64;
            let low = (place.floor() as usize).min(count.saturating_sub(2));
            (low, (low + 1).min(count - 1), place - low as f64)
        };
        let (below, above, up) = between(point.up, self.friction_map.len());
        let (right, left, across) = between(0.5 * (point.across + 1.0), self.friction_map[0].len());
        let row = |row: usize| {
            let row = &self.friction_map[row];
            row[right] + (row[left] - row[right]) * across
        };
        row(below) + (row(above) - row(below)) * up
    }

    /// Checks every range; `face` is its place, `number` that of [`crate::outputs::FACES`].
    ///
    /// # Errors
    /// The first value that is outside its range.
    pub fn validate(&self, face: &Rectangle, number: usize) -> Result<(), ParameterError> {
        let paths = &PATHS[number.min(1)];
        for points in [self.grid.up, self.grid.across] {
            let holds = (2..=LARGEST_GRID).contains(&points);
            check(
                paths.grid,
                points as f64,
                holds,
                "from 2 to 100 points in each direction",
            )?;
        }
        let extent = |profile: &FaceProfile| match profile.direction {
            FaceDirection::Up => 0.5 * face.length(),
            FaceDirection::Across => 0.5 * face.width,
        };
        for (path, own) in [
            (paths.wedge_surface, &self.wedge_surface),
            (paths.counterface, &self.counterface),
        ] {
            let holds = own.worn_flat >= 0.0 && own.worn_flat.is_finite();
            check(path, own.worn_flat, holds, "worn flat by zero or more")?;
            match &own.profile {
                SurfaceProfile::Flat => {}
                SurfaceProfile::Arc { curvature } => {
                    let radius = 1.0 / curvature.abs();
                    check(
                        path,
                        radius,
                        radius > extent(own),
                        "a radius of more than half of the face",
                    )?;
                    let [depth, ..] = own.profile.depth(extent(own));
                    check(
                        path,
                        own.worn_flat,
                        own.worn_flat < depth || own.worn_flat == 0.0,
                        "worn flat by less than its depth at the edges: else it is flat",
                    )?;
                }
                SurfaceProfile::Table(table) => {
                    let (first, last) = table.range();
                    let holds = first <= -extent(own) && last >= extent(own);
                    let expected = "a table from edge to edge of the face, its places from the middle";
                    check(path, last - first, holds, expected)?;
                }
            }
        }
        for (path, map) in [
            (paths.wedge_wear, &self.wedge_wear),
            (paths.counterface_wear, &self.counterface_wear),
        ] {
            let Some(map) = map else { continue };
            let [up, across] = map.places();
            let holds = map.covers(face.length(), face.width);
            let reach = (up[up.len() - 1] - up[0]).min(across[across.len() - 1] - across[0]);
            let expected = "a map from edge to edge of the face, up and across, its places from the middle";
            check(path, reach, holds, expected)?;
        }
        if let Some(map) = &self.counterface_wear {
            let [up, across] = map.places();
            let holds = map.surface([false; 2]).is_ok();
            let expected = "a map of at least four places up and four across, to have a smooth surface";
            check(
                paths.counterface_wear,
                up.len().min(across.len()) as f64,
                holds,
                expected,
            )?;
        }
        if let Some(sliding) = self.sliding_friction {
            check(
                paths.sliding_friction,
                sliding,
                sliding >= 0.0,
                "zero or positive",
            )?;
            positive(paths.stribeck_speed, self.stribeck_speed)?;
        }
        if let Some(load) = self.friction_half_load {
            positive(paths.friction_half_load, load)?;
        }
        let width = self.friction_map.first().map_or(0, Vec::len);
        for row in &self.friction_map {
            let even = row.len() == width && width > 0;
            check(
                paths.friction_map,
                row.len() as f64,
                even,
                "rows of the same number of factors",
            )?;
            for factor in row {
                let holds = *factor >= 0.0 && factor.is_finite();
                check(paths.friction_map, *factor, holds, "factors of zero or more")?;
            }
        }
        if let Some(pad) = &self.pad {
            positive(paths.pad, pad.stiffness)?;
            not_negative(paths.pad, pad.damping)?;
            not_negative(paths.pad, pad.friction)?;
            for value in pad.hardening.into_iter().chain(pad.shear.into_iter().flatten()) {
                positive(paths.pad, value)?;
            }
        }
        Ok(())
    }
}

/// The keys of a face in a case file.
struct FacePaths {
    grid: &'static str,
    wedge_surface: &'static str,
    wedge_wear: &'static str,
    counterface: &'static str,
    counterface_wear: &'static str,
    sliding_friction: &'static str,
    stribeck_speed: &'static str,
    friction_half_load: &'static str,
    friction_map: &'static str,
    pad: &'static str,
}

/// Names the keys of a face.
macro_rules! paths {
    ($section:literal) => {
        FacePaths {
            grid: concat!($section, ".grid"),
            wedge_surface: concat!($section, ".wedge_surface"),
            wedge_wear: concat!($section, ".wedge_wear"),
            counterface: concat!($section, ".counterface"),
            counterface_wear: concat!($section, ".counterface_wear"),
            sliding_friction: concat!($section, ".sliding_friction"),
            stribeck_speed: concat!($section, ".stribeck_speed"),
            friction_half_load: concat!($section, ".friction_half_load"),
            friction_map: concat!($section, ".friction_map"),
            pad: concat!($section, ".pad"),
        }
    };
}

/// The keys of both faces.
const PATHS: [FacePaths; 2] = [paths!("column_face"), paths!("slope_face")];
