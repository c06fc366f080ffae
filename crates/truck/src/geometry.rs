//! Where the parts of a truck are in the nominal layout, the loaded one.

use crate::units::{INCH, inches};

/// Places in the nominal layout, m; heights are above the top of rail. Axes: x forward, y left, z up, origin
/// at the truck's center.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// From axle to axle.
    pub wheelbase: f64,
    /// From the middle of one nest across to that of the other; side frames, wedges and gibs are there too.
    pub nest_distance: f64,
    /// From the middle of one journal across to that of the other, where adapters are.
    pub journal_distance: f64,
    /// Height of the axles: the nominal radius of the wheels that the truck is made for.
    pub axle_height: f64,
    /// From the truck's center along the track to the wedges' centers of gravity; lands are at the same
    /// place.
    pub wedge_distance: f64,
    /// Height of the wedges' centers of gravity.
    pub wedge_height: f64,
    /// Height at which load coils hold sideways.
    pub seat_height: f64,
    /// Height of the gibs, and of the empirical warp springs.
    pub gib_height: f64,
    /// Height of the lands' middle.
    pub land_height: f64,
    /// From the middle of the lands to each of the four stops of a column: across, and up or down.
    pub lands: [f64; 2],
    /// Height of the adapters.
    pub adapter_height: f64,
    /// From the middle of an adapter of steel across to each of its two points, and to each of its two
    /// longitudinal stops.
    pub adapter: [f64; 2],
}

impl Default for Geometry {
    /// Returns that of a truck of 100 tons with wheels of 36 in: all from the NUCARS files of a half-truck
    /// but the places of the adapters' and the lands' stops, which are chosen so that 30 mrad of yaw and of
    /// warp are free.
    fn default() -> Self {
        Self {
            wheelbase: 70.0 * INCH,
            nest_distance: 79.0 * INCH,
            journal_distance: 79.0 * INCH,
            axle_height: 18.0 * INCH,
            wedge_distance: 8.5 * INCH,
            wedge_height: 18.0 * INCH,
            seat_height: 13.0 * INCH,
            gib_height: 18.0 * INCH,
            land_height: 18.0 * INCH,
            lands: inches([7.0, 3.0]),
            adapter_height: 22.5 * INCH,
            adapter: inches([3.0, 1.56]),
        }
    }
}

impl Geometry {
    /// Returns half of the wheelbase: x of the leading axle, m.
    #[must_use]
    pub fn axle(&self) -> f64 {
        0.5 * self.wheelbase
    }

    /// Returns half of the distance of the nests: y of the left one, m.
    #[must_use]
    pub fn nest(&self) -> f64 {
        0.5 * self.nest_distance
    }

    /// Returns half of the distance of the journals: y of the left ones, m.
    #[must_use]
    pub fn journal(&self) -> f64 {
        0.5 * self.journal_distance
    }

    /// Returns the place of the center of gravity of a wedge; its end is 1 (leading) or -1, its side 1 (left)
    /// or -1, m.
    #[must_use]
    pub fn wedge(&self, [end, side]: [f64; 2]) -> [f64; 3] {
        [self.wedge_distance * end, self.nest() * side, self.wedge_height]
    }
}
