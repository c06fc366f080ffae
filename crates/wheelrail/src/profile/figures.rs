//! Figures of wheels as inspectors measure them, and the flangeway clearance of a wheelset in a track.
//!
//! | figure | |
//! |---|---|
//! | flange height Sh | from the tape circle down to the tip of the flange |
//! | flange thickness Sd | from the back of the flange to its face, 10 mm below the tape circle |
//! | qR | across the track, from the face 2 mm above the tip to the face 10 mm below the tape circle |
//! | hollow depth | deepest fall of the tread towards the field side, from its highest point until there |
//!
//! Sh, Sd and qR are those of EN 15313 for a tape circle 70 mm from the back. The hollow depth is what a
//! straight edge on the field side of the rim shows, parallel to the axle; new treads rise all the way.

use super::{Profile, ProfileKind};

/// Depth below the tape circle at which flanges are measured, m.
pub const FLANGE_DEPTH: f64 = 10e-3;
/// Height above the tip at which qR begins, m.
pub const ABOVE_TIP: f64 = 2e-3;
/// A flangeway clearance to each side below this is doubted, m.
pub const LEAST_CLEARANCE: f64 = 2e-3;
/// Spacing of the points that are looked at, m.
const FINE: f64 = 5e-5;

/// Figures of a wheel with a flange, m and rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelFigures {
    /// Flange height Sh.
    pub height: f64,
    /// Flange thickness Sd; none where the back of the flange is not known.
    pub thickness: Option<f64>,
    /// qR; none where the points do not reach as far down.
    pub slope: Option<f64>,
    /// Largest angle of the flange's face between these two points.
    pub angle: f64,
    /// Hollow depth.
    pub hollow: f64,
}

impl Profile {
    /// Returns the figures of a wheel; none of rails and of wheels without a flange.
    #[must_use]
    pub fn wheel_figures(&self) -> Option<WheelFigures> {
        if self.kind() != ProfileKind::Wheel {
            return None;
        }
        let face = self.flange_face(FLANGE_DEPTH)?;
        let sample = self.curve().sample(FINE);
        let at_zero = sample.windows(2).find_map(|pair| {
            let [[y0, z0], [y1, z1]] = [pair[0].1.position, pair[1].1.position];
            (y0 <= 0.0 && y1 > 0.0).then(|| z0 - y0 * (z1 - z0) / (y1 - y0))
        });
        let [tip, bottom] = self.bottom();
        let height = at_zero.unwrap_or(0.0) - bottom;
        let low = self.flange_face(-(bottom + ABOVE_TIP));
        let on_face = |[y, z]: [f64; 2]| y >= tip && y <= face && z >= bottom + ABOVE_TIP;
        let angle = sample
            .iter()
            .filter(|(_, point)| on_face(point.position))
            .map(|(_, point)| point.angle())
            .fold(0.0, f64::max);
        let tread = sample.iter().map(|(_, point)| point.position);
        let hollow = hollow_depth(tread.filter(|[y, _]| *y > face));
        Some(WheelFigures {
            height,
            thickness: self.flange_back().map(|back| face - back),
            slope: low.filter(|low| *low > tip).map(|low| face - low),
            angle,
            hollow,
        })
    }
}

/// Returns the hollow depth of a tread (m), whose points (m) run towards the field side: the deepest fall
/// behind the highest point so far.
pub(super) fn hollow_depth(tread: impl Iterator<Item = [f64; 2]>) -> f64 {
    let (_, fall) = tread.fold((f64::NEG_INFINITY, 0.0_f64), |(highest, fall), [_, z]| {
        let highest = highest.max(z);
        (highest, fall.max(highest - z))
    });
    fall
}

/// Returns the clearance (m) by which a wheelset can move from the middle of the track to each side until its
/// flanges touch the rails at the height where gauge is measured, half of what both sides have together; none
/// if a wheel has no flange. `depth` (m) is that of the gauge below the datums of the rails.
#[must_use]
pub fn flangeway_clearance(
    wheels: [&Profile; 2],
    rails: [&Profile; 2],
    tape_distance: f64,
    gauge: f64,
    depth: f64,
) -> Option<f64> {
    let face = |side: usize| wheels[side].flange_face(depth + rails[side].datum_depth());
    let (left, right) = (face(0)?, face(1)?);
    Some(0.5 * (gauge - (tape_distance + left + right)))
}
