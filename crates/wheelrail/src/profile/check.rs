//! Checks of points before a profile is made of them.

use super::error::{ProfileError, ProfilePlace};
use super::points::Points;
use super::{ProfileKind, SMALLEST_SPACING, shape};

/// A flange or a rail's side reaches at least this far from the tread, m.
pub(super) const FLANGE: f64 = 0.015;

/// Widths that occur, m, and their words.
fn widths(kind: ProfileKind) -> ([f64; 2], &'static str) {
    match kind {
        ProfileKind::Wheel => ([0.05, 0.2], "50 to 200 mm"),
        ProfileKind::Rail => ([0.02, 0.2], "20 to 200 mm"),
    }
}

/// Orders points from the gauge side to the field side, takes away those closer than [`SMALLEST_SPACING`] to
/// their neighbor, and checks number, size, kind, orientation and crossings.
pub(super) fn checked(points: &Points, kind: ProfileKind) -> Result<Points, ProfileError> {
    let name = &points.name;
    if let Some(found) = points.kind
        && found != kind
    {
        return Err(ProfileError::Kind {
            place: ProfilePlace::whole(name),
            found: found.word(),
            expected: kind.word(),
        });
    }
    let kept = ordered(points);
    if kept.points.len() < 5 {
        return Err(ProfileError::TooFew {
            place: ProfilePlace::whole(name),
            points: kept.points.len(),
        });
    }
    units(&kept, kind)?;
    height(&kept)?;
    shape::check(&kept, kind)?;
    orientation(&kept, kind)?;
    crossings(&kept)?;
    Ok(kept)
}

fn ordered(points: &Points) -> Points {
    let mut kept = Points {
        points: Vec::with_capacity(points.points.len()),
        lines: Vec::with_capacity(points.points.len()),
        ..points.clone()
    };
    let backwards = match (points.points.first(), points.points.last()) {
        (Some(first), Some(last)) => last[0] < first[0],
        _ => false,
    };
    let count = points.points.len();
    for i in 0..count {
        let i = if backwards { count - 1 - i } else { i };
        let point = points.points[i];
        let far = kept.points.last().is_none_or(|last: &[f64; 2]| {
            libm::hypot(point[0] - last[0], point[1] - last[1]) >= SMALLEST_SPACING
        });
        if far {
            kept.points.push(point);
            kept.lines.push(points.lines[i]);
        }
    }
    kept
}

fn extent(points: &Points, axis: usize) -> [f64; 2] {
    let values = points.points.iter().map(|point| point[axis]);
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    })
}

fn units(points: &Points, kind: ProfileKind) -> Result<(), ProfileError> {
    let [low, high] = extent(points, 0);
    let (range, expected) = widths(kind);
    let width = high - low;
    let fits = |factor: f64| (range[0]..=range[1]).contains(&(width * factor));
    if fits(1.0) {
        return Ok(());
    }
    let guess = [
        (1e-3, "they seem to be mm that are called m"),
        (1e3, "they seem to be m that are called mm"),
        (0.0254, "they seem to be inches that are called m"),
        (25.4, "they seem to be inches that are called mm"),
        (1.0 / 25.4, "they seem to be mm that are called inches"),
    ];
    let words = guess
        .iter()
        .find(|(factor, _)| fits(*factor))
        .map_or("it belongs to another kind of profile", |(_, words)| words);
    Err(ProfileError::Units {
        place: ProfilePlace::whole(&points.name),
        kind: kind.word(),
        width,
        expected,
        remedy: format!("look at the unit in the header (CSV) or at units.len.f (Simpack): {words}"),
    })
}

/// No wheel's or rail's profile is higher than this, m: a rail with its foot has less than 0.2 m.
const HEIGHT: f64 = 0.3;

/// Refuses a point that lies far above or below the one before it.
fn height(points: &Points) -> Result<(), ProfileError> {
    let [low, high] = extent(points, 1);
    if high - low <= HEIGHT {
        return Ok(());
    }
    let jump = |i: &usize| (points.points[*i][1] - points.points[*i - 1][1]).abs();
    let worst = (1..points.points.len())
        .max_by(|a, b| jump(a).total_cmp(&jump(b)))
        .unwrap_or(0);
    Err(ProfileError::Line {
        place: points.place(worst),
        found: format!(
            "z is {:.4} mm here; the points span {:.4} mm in height, and no profile has more than {:.0} mm",
            1e3 * points.points[worst][1],
            1e3 * (high - low),
            1e3 * HEIGHT
        ),
        remedy: "look for a number that is mistyped here or in the line before".into(),
    })
}

fn orientation(points: &Points, kind: ProfileKind) -> Result<(), ProfileError> {
    let [low, high] = extent(points, 0);
    let refused = |found: &str, remedy: &str| {
        Err(ProfileError::Orientation {
            place: ProfilePlace::whole(&points.name),
            found: found.into(),
            remedy: remedy.into(),
        })
    };
    if !(low < 0.0 && high > 0.0) {
        return refused(
            "y = 0, the datum, lies outside of the points",
            match kind {
                ProfileKind::Wheel => {
                    "shift y so that y = 0 is the tape circle, where the nominal radius is measured"
                }
                ProfileKind::Rail => "shift y so that y = 0 lies in the rail head",
            },
        );
    }
    let at_zero = points.points.windows(2).find_map(|pair| {
        let [[y0, z0], [y1, z1]] = [pair[0], pair[1]];
        (y0 <= 0.0 && y1 > 0.0).then(|| z0 - y0 * (z1 - z0) / (y1 - y0))
    });
    let datum = at_zero.unwrap_or(0.0);
    let [bottom, top] = extent(points, 1);
    let upside_down = "z must point up: name its column z_down (CSV) or set mirror.z (Simpack)";
    match kind {
        ProfileKind::Wheel => {
            if top - datum > FLANGE && datum - bottom < FLANGE {
                return refused("the flange points up", upside_down);
            }
            let lowest = points.points.iter().min_by(|a, b| a[1].total_cmp(&b[1]));
            if lowest.is_some_and(|point| point[0] > 0.0 && datum - point[1] > FLANGE) {
                return refused(
                    "the flange lies at positive y, on the field side",
                    "y must grow from the flange to the field side: name its column y_gauge (CSV) or \
                     set mirror.y \
                     (Simpack)",
                );
            }
        }
        ProfileKind::Rail => {
            let ends = [points.points[0][1], points.points[points.points.len() - 1][1]];
            if ends.iter().all(|end| *end > datum) {
                return refused("both sides of the rail rise above its top", upside_down);
            }
        }
    }
    Ok(())
}

/// Looks for crossing chords: sorted by their smallest y, each is compared with those that begin before it
/// ends.
pub(super) fn crossings(points: &Points) -> Result<(), ProfileError> {
    let chords: Vec<_> = points.points.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let span = |chord: usize, axis: usize| {
        let [a, b] = chords[chord].map(|point| point[axis]);
        [a.min(b), a.max(b)]
    };
    let mut order: Vec<usize> = (0..chords.len()).collect();
    order.sort_by(|a, b| span(*a, 0)[0].total_cmp(&span(*b, 0)[0]).then(a.cmp(b)));
    for (rank, &chord) in order.iter().enumerate() {
        for &other in &order[rank + 1..] {
            if span(other, 0)[0] > span(chord, 0)[1] {
                break;
            }
            if chord.abs_diff(other) <= 1 {
                continue;
            }
            let ([low, high], [bottom, top]) = (span(chord, 1), span(other, 1));
            if top < low || bottom > high {
                continue;
            }
            if let Some(at) = crossing(chords[chord], chords[other]) {
                return Err(ProfileError::SelfCrossing {
                    place: points.place(chord.min(other)),
                    other: points.place(chord.max(other)),
                    at,
                });
            }
        }
    }
    Ok(())
}

/// Returns the point at which two chords cross.
fn crossing([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> Option<[f64; 2]> {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]]);
    let determinant = u[0] * v[1] - u[1] * v[0];
    if determinant == 0.0 {
        return None;
    }
    let w = [c[0] - a[0], c[1] - a[1]];
    let s = (w[0] * v[1] - w[1] * v[0]) / determinant;
    let t = (w[0] * u[1] - w[1] * u[0]) / determinant;
    let inside = |x: f64| (0.0..=1.0).contains(&x);
    (inside(s) && inside(t)).then(|| [a[0] + s * u[0], a[1] + s * u[1]])
}
