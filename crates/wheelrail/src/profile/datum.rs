//! Where the points of a file lie: the sense of z, and the tape circle of a wheel.

use super::error::{ProfileError, ProfilePlace};
use super::points::Points;
use super::{ProfileKind, ProfileNotice, shape};

/// Where y = 0 of the points of a wheel lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WheelDatum {
    /// In the tape circle, where the nominal radius is measured.
    Tape,
    /// At the back of the flange, as with measuring devices.
    FlangeBack,
}

/// Distance of the tape circle from the back of the flange where nothing is said, m: EN 13715, and the
/// taper line of MiniProf. In North America it is 3 1/16 in (narrow flange, remembered).
pub const TAPE_FROM_BACK: f64 = 70e-3;

/// Distances at which the tip of a flange lies from the tape circle, m, with reserve: 55 mm for S1002, 63 mm
/// for AAR-1B, 49 mm where a flange is thick and its tip far out.
const TIP: [f64; 2] = [35e-3, 75e-3];

/// Returns the points with z up, those of a wheel with the tape circle in y = 0, with z = 0 there if they
/// were measured from the back of the flange.
///
/// # Errors
/// The datum lies outside of the points.
pub(super) fn placed(points: &Points, kind: ProfileKind) -> Result<Points, ProfileError> {
    let mut placed = points.clone();
    if points.any_sense && points_down(&points.points, kind) {
        placed.points.iter_mut().for_each(|point| point[1] = -point[1]);
    }
    if kind == ProfileKind::Rail {
        if points.top_is_datum {
            let top = placed
                .points
                .iter()
                .map(|point| point[1])
                .fold(f64::NEG_INFINITY, f64::max);
            placed.points.iter_mut().for_each(|point| point[1] -= top);
        }
        return Ok(placed);
    }
    if points.datum == Some(WheelDatum::FlangeBack) {
        let from_back = points.tape_from_back.unwrap_or(TAPE_FROM_BACK);
        placed.points.iter_mut().for_each(|point| point[0] -= from_back);
        let Some(height) = height_at_zero(&placed.points) else {
            return Err(outside(points, kind));
        };
        placed.points.iter_mut().for_each(|point| point[1] -= height);
    }
    Ok(placed)
}

/// Returns the refusal of points that do not reach the datum.
pub(super) fn outside(points: &Points, kind: ProfileKind) -> ProfileError {
    let [low, high] = points
        .points
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [y, _]| {
            [low.min(*y), high.max(*y)]
        });
    let [low, high] = [low, high].map(|y| 1e3 * y);
    let (found, remedy) = match (kind, points.datum) {
        (ProfileKind::Wheel, Some(WheelDatum::FlangeBack)) => (
            format!(
                "the tape circle, {:.3} mm from the back of the flange, lies outside of the points, which \
                 reach from {low:.3} to {high:.3} mm",
                1e3 * points.tape_from_back.unwrap_or(TAPE_FROM_BACK)
            ),
            "state how far the tape circle lies from the back of the flange (--tape-from-back \"70 mm\"), \
             or where y = 0 is (--datum tape)",
        ),
        (ProfileKind::Wheel, _) => (
            format!(
                "y = 0, the datum, lies outside of the points, which reach from {low:.3} to {high:.3} mm"
            ),
            "y = 0 must be the tape circle, where the nominal radius is measured: if the points are \
             measured from the back of the flange, say so (--datum flange_back, in a case wheels.datum = \
             \"flange_back\", with --tape-from-back \"70 mm\", or a column y_from_back in CSV), else shift y",
        ),
        (ProfileKind::Rail, _) => (
            format!(
                "y = 0, the datum, lies outside of the points, which reach from {low:.3} to {high:.3} mm"
            ),
            "shift y so that y = 0 lies in the rail head",
        ),
    };
    ProfileError::Orientation {
        place: ProfilePlace::whole(&points.name),
        found,
        remedy: remedy.into(),
    }
}

/// Returns z (m) at y = 0, between points on both of its sides.
pub(super) fn height_at_zero(points: &[[f64; 2]]) -> Option<f64> {
    points.windows(2).find_map(|pair| {
        let [[y0, z0], [y1, z1]] = [pair[0], pair[1]];
        ((y0 <= 0.0) != (y1 <= 0.0)).then(|| z0 - y0 * (z1 - z0) / (y1 - y0))
    })
}

/// Returns the doubt about the datum of a wheel of which nothing was said; none if the tip of its flange, at
/// `tip` (m), lies where it does on wheels.
pub(super) fn doubt(points: &Points, tip: f64) -> Option<ProfileNotice> {
    if points.datum.is_some() || (TIP[0]..=TIP[1]).contains(&-tip) {
        return None;
    }
    Some(ProfileNotice {
        text: format!(
            "{}: the tip of the flange lies {:.1} mm from y = 0, which is taken as the tape circle; on \
             wheels it lies {:.0} to {:.0} mm from there",
            points.name,
            1e3 * tip.abs(),
            1e3 * TIP[0],
            1e3 * TIP[1]
        ),
        advice: "if y is measured from the back of the flange say --datum flange_back, if y = 0 is the \
                 tape circle --datum tape"
            .into(),
    })
}

/// Returns whether z of points points down, by their shape: the flange is the part of a wheel that lies
/// furthest from its middle height, a rail bulges upwards between its ends.
fn points_down(points: &[[f64; 2]], kind: ProfileKind) -> bool {
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return false;
    };
    let even = shape::evenly(points);
    let points = even.as_deref().unwrap_or(points);
    // The largest distance with its sign.
    let furthest = |heights: &mut dyn Iterator<Item = f64>| {
        heights.fold(
            0.0,
            |most: f64, own| if own.abs() > most.abs() { own } else { most },
        )
    };
    match kind {
        ProfileKind::Wheel => {
            let mut heights: Vec<f64> = points.iter().map(|point| point[1]).collect();
            heights.sort_by(f64::total_cmp);
            let middle = heights.get(heights.len() / 2).copied().unwrap_or_default();
            furthest(&mut heights.iter().map(|height| height - middle)) > 0.0
        }
        ProfileKind::Rail => {
            let slope = (last[1] - first[1]) / (last[0] - first[0]);
            let above = |point: &[f64; 2]| point[1] - first[1] - slope * (point[0] - first[0]);
            furthest(&mut points.iter().map(above)) < 0.0
        }
    }
}
