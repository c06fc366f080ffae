//! The kind of a profile by its shape: a wheel that is given as a rail, or a rail that is given as a wheel.
//!
//! **Wheel.** It has one flange and a tread. The flange is the lowest part; from its tip the curve steepens
//! to the face of the flange and flattens again to the tread, [`HEIGHTS`] above the tip, which does not fall
//! on its other side. That holds for new, worn and hollow wheels, with the back of the flange or from its tip
//! on. The curve of a rail's gauge side does not steepen above its lowest point: it is convex. The groove of
//! a grooved rail has the shape of a flange, but beyond it the keeper is level again, and the field side
//! falls.
//!
//! **Rail.** It is highest inside and falls on both sides, by [`HEAD`] where there is no flange, by more than
//! any hollow of a wheel where there is one.
//!
//! Nothing is said of what may be either: lines and arcs without a flange, a rail's crown alone, a wheel
//! without the tip of its flange, a wheel upside down, which has the shape of a crossing's nose. The datum
//! does not count, nor does the side of the flange.

use super::ProfileKind;
use super::error::{ProfileError, ProfilePlace};
use super::points::Points;

/// Spacing of the points that are looked at, m; directions are those over two of them.
const SPACING: f64 = 1e-3;
/// Heights of flanges above their tips, m: 25 to 36 mm new, more on worn treads.
const HEIGHTS: [f64; 2] = [15e-3, 45e-3];
/// Directions up to this are level, rad: treads of 1:20 have 3°, treads of 1:6.7 have 9°.
const LEVEL: f64 = 0.35;
/// A flange's face is at least so steep, rad, and so much steeper than the tip.
const FACE: [f64; 2] = [0.8, 0.44];
/// Largest width of a flange 5 mm above its tip, m: the floor of a flangeway is wider.
const FLANGE: f64 = 35e-3;
/// Least width of a tread, m.
const TREAD: f64 = 20e-3;
/// Least width of a keeper, m.
const KEEPER: f64 = 4e-3;
/// Deepest hollow of a wheel's tread, m: wheels are condemned at 5 mm.
const HOLLOW: f64 = 10e-3;
/// Least fall on both sides of a rail's head, m; concave treads without a flange fall by less.
const HEAD: f64 = 5e-3;

/// Most points that are looked at: the outline of a rail with its foot has 0.7 m.
const LONGEST: usize = 2000;

/// Refuses points whose shape is that of the other kind.
///
/// # Errors
/// [`ProfileError::Shape`].
pub(super) fn check(points: &Points, kind: ProfileKind) -> Result<(), ProfileError> {
    let Some(curve) = evenly(&points.points) else {
        return Ok(());
    };
    // With the flange at smaller y, or at larger y.
    let wheel = |upright: f64| {
        [1.0, -1.0]
            .into_iter()
            .find_map(|side| flange(&curve, [side, upright]))
    };
    let (found, sign) = match (kind, wheel(1.0)) {
        (ProfileKind::Rail, None) => return Ok(()),
        (ProfileKind::Rail, Some(flange)) => {
            let [height, at] = [flange.height, flange.at].map(|length| 1e3 * length);
            let sign =
                format!("it has a flange of {height:.1} mm at y = {at:.1} mm, and a tread beside that");
            (ProfileKind::Wheel, sign)
        }
        (ProfileKind::Wheel, flange) => {
            let least = if flange.is_some() { HOLLOW } else { HEAD };
            let head = head(&curve).filter(|(_, falls)| falls.iter().all(|fall| *fall > least));
            // A wheel upside down has its own message.
            let Some((top, falls)) = head.filter(|_| wheel(-1.0).is_none()) else {
                return Ok(());
            };
            let [top, left, right] = [top, falls[0], falls[1]].map(|length| 1e3 * length);
            let sign = format!(
                "it is highest at y = {top:.1} mm, and falls by {left:.1} mm towards smaller y, by \
                 {right:.1} mm towards larger y"
            );
            (ProfileKind::Rail, sign)
        }
    };
    Err(ProfileError::Shape {
        place: ProfilePlace::whole(&points.name),
        found: found.word(),
        expected: kind.word(),
        sign,
    })
}

/// Returns on which side of its flange the tread of a wheel lies: 1 for larger y, -1 for smaller y; none if
/// there is no flange.
pub(super) fn flange_side(points: &[[f64; 2]]) -> Option<f64> {
    let curve = evenly(points)?;
    [1.0, -1.0]
        .into_iter()
        .find(|side| flange(&curve, [*side, 1.0]).is_some())
}

/// Returns points along a chain of chords, [`SPACING`] apart along it; none if it is no section but noise.
pub(super) fn evenly(points: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
    let mut even = Vec::new();
    let mut rest = 0.0;
    for chord in points.windows(2) {
        let ([y, z], [dy, dz]) = (chord[0], [chord[1][0] - chord[0][0], chord[1][1] - chord[0][1]]);
        let length = libm::hypot(dy, dz);
        while rest < length {
            if even.len() > LONGEST {
                return None;
            }
            even.push([y + dy * rest / length, z + dz * rest / length]);
            rest += SPACING;
        }
        rest -= length;
    }
    Some(even)
}

/// A flange.
struct Flange {
    /// y of its tip in the file, m.
    at: f64,
    /// Height of the tread above the tip, m.
    height: f64,
}

/// Returns the flange with a tread beyond it, towards larger y, of points whose y and z have these signs.
fn flange(points: &[[f64; 2]], signs: [f64; 2]) -> Option<Flange> {
    let mut points: Vec<[f64; 2]> = points.iter().map(|[y, z]| [signs[0] * y, signs[1] * z]).collect();
    if signs[0] < 0.0 {
        points.reverse();
    }
    let (tip, [at, bottom]) = lowest(&points)?;
    let angle = |i: usize| {
        let [[y0, z0], [y1, z1]] = [points[i], points[(i + 2).min(points.len() - 1)]];
        libm::atan2(z1 - z0, y1 - y0)
    };
    // Level stretches above the tip, beyond the face and behind the flange: width and mean height.
    let level = |stretch: std::ops::Range<usize>| {
        let parts = stretch.filter(|i| points[*i][1] - bottom > HEIGHTS[0] && angle(*i).abs() < LEVEL);
        let (count, sum) = parts.fold((0, 0.0), |(count, sum), i| (count + 1, sum + points[i][1]));
        (f64::from(count) * SPACING, sum / f64::from(count.max(1)))
    };
    let last = points.len().saturating_sub(2);
    let (tread, height) = level(tip..last);
    let (keeper, _) = level(0..tip);
    let begin = (tip..last).find(|i| points[*i][1] - bottom > HEIGHTS[0] && angle(*i).abs() < LEVEL)?;
    let steepest = (tip..begin).map(angle).fold(f64::NEG_INFINITY, f64::max);
    let flange = points[..begin].iter().filter(|[_, z]| z - bottom < 5e-3).count() as f64 * SPACING;
    let falls = points[begin..].iter().any(|[_, z]| height - z > HOLLOW);
    let from_tip = angle(tip);
    let found = tread > TREAD
        && flange < FLANGE
        && keeper < KEEPER
        && height - bottom < HEIGHTS[1]
        && !falls
        && steepest > FACE[0]
        && from_tip.abs() < steepest - FACE[1];
    found.then_some(Flange {
        at: signs[0] * at,
        height: height - bottom,
    })
}

fn lowest(points: &[[f64; 2]]) -> Option<(usize, [f64; 2])> {
    let points = points.iter().copied().enumerate();
    points.min_by(|(_, a), (_, b)| a[1].total_cmp(&b[1]))
}

/// Returns y of the highest point and how far the curve falls on both sides of it, m.
fn head(points: &[[f64; 2]]) -> Option<(f64, [f64; 2])> {
    let (top, [y, z]) = points
        .iter()
        .copied()
        .enumerate()
        .max_by(|(_, a), (_, b)| a[1].total_cmp(&b[1]))?;
    let fall = |side: &[[f64; 2]]| side.iter().map(|point| z - point[1]).fold(0.0, f64::max);
    Some((y, [fall(&points[..top]), fall(&points[top..])]))
}
