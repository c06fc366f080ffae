//! Worn wheels and wedges: profiles from those of the start and depths over them, depths of faces.

use std::fmt::Write;

use wedge::face::DepthMap;
use wedge::outputs::FACES;
use wheelrail::profile::Profile;

/// Distance of the points of a worn profile, m.
const SPACING: f64 = 0.5e-3;

/// The wear of a car after some service.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Worn {
    /// Profiles of wheels.
    pub profiles: Vec<WornProfile>,
    /// Depths of wedges.
    pub wedges: Vec<WornWedge>,
}

/// A worn profile of a wheel.
#[derive(Clone, Debug, PartialEq)]
pub struct WornProfile {
    /// The wheel in a case, such as `axle_1.left`; empty: all of them.
    pub wheel: String,
    /// Its points: y to the field side, z down, m.
    pub points: Vec<[f64; 2]>,
}

/// Worn faces of a wedge.
#[derive(Clone, Debug, PartialEq)]
pub struct WornWedge {
    /// Its name, such as `truck_1_leading_left`.
    pub name: String,
    /// Mean depths of column and slope, of both partners together, m.
    pub depths: [f64; 2],
    /// What is beyond them at column and slope: on the wedge's face and on its counterface.
    pub beyond: [[Option<DepthMap>; 2]; 2],
}

/// A map of a worn face, as a file.
#[derive(Clone, Debug, PartialEq)]
pub struct WornMap<'m> {
    /// `column` or `slope`.
    pub face: &'static str,
    /// Its key in the face's section.
    pub key: &'static str,
    /// The name of its file.
    pub file: String,
    map: &'m DepthMap,
}

impl WornMap<'_> {
    /// Returns the text of its file.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = "up [mm], across [mm], depth [mm]\n".to_owned();
        for point in self.map.points() {
            let [up, across, depth] = point.map(|own| 1e3 * own);
            // Writing into a string does not fail.
            let _ = writeln!(text, "{up}, {across}, {depth}");
        }
        text
    }
}

impl WornWedge {
    /// Returns its maps.
    pub fn maps(&self) -> impl Iterator<Item = WornMap<'_>> {
        let faces = FACES.into_iter().zip(&self.beyond);
        faces.flat_map(move |(face, own)| {
            let keys = [("wedge_wear", ""), ("counterface_wear", "_counterface")];
            keys.into_iter().zip(own).filter_map(move |((key, of), map)| {
                Some(WornMap {
                    face,
                    key,
                    file: format!("{}_{face}{of}.csv", self.name),
                    map: map.as_ref()?,
                })
            })
        })
    }

    /// Returns the table of a case that has its keys.
    #[must_use]
    pub fn key(&self) -> String {
        let (truck, wedge) = match self.name.strip_prefix("truck_1_") {
            Some(wedge) => ("front_truck", wedge),
            None => ("rear_truck", self.name.trim_start_matches("truck_2_")),
        };
        format!("{truck}.wedge.{wedge}")
    }
}

impl WornProfile {
    /// Returns a profile that has lost depths along its normals: pairs of y and depth, m, rising in y.
    ///
    /// Depths between places are linear, smoothed over three of them; beyond the places nothing is lost.
    #[must_use]
    pub fn new(wheel: &str, profile: &Profile, depths: &[[f64; 2]]) -> Self {
        let smooth: Vec<[f64; 2]> = (0..depths.len())
            .map(|i| {
                let beside = [i.saturating_sub(1), i, (i + 1).min(depths.len() - 1)];
                let mean = beside.iter().map(|k| depths[*k][1]).sum::<f64>() / 3.0;
                [depths[i][0], mean]
            })
            .collect();
        let depth = |y: f64| {
            let next = smooth.partition_point(|own| own[0] <= y);
            match (next.checked_sub(1).and_then(|k| smooth.get(k)), smooth.get(next)) {
                (Some([a, from]), Some([b, to])) => from + (to - from) * (y - a) / (b - a),
                _ => 0.0,
            }
        };
        let points = profile.curve().sample(SPACING).into_iter().map(|(_, point)| {
            let [y, z] = point.position;
            let [along, up] = point.tangent;
            let size = libm::hypot(along, up);
            let lost = depth(y);
            // The material of a wheel lies above its profile where y grows along it.
            [y - lost * up / size, -(z + lost * along / size)]
        });
        Self {
            wheel: wheel.to_owned(),
            points: points.collect(),
        }
    }

    /// Returns the name of its file.
    #[must_use]
    pub fn file(&self) -> String {
        match self.wheel.is_empty() {
            true => "wheels.csv".to_owned(),
            false => format!("{}.csv", self.wheel.replace('.', "_")),
        }
    }

    /// Returns the text of its file.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = "y [mm], z_down [mm]\n".to_owned();
        for [y, z] in &self.points {
            // Writing into a string does not fail.
            let _ = writeln!(text, "{:.5}, {:.5}", 1e3 * y, 1e3 * z);
        }
        text
    }
}
