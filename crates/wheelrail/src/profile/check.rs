//! Checks of points before a profile is made of them.

use super::error::{ProfileError, ProfilePlace};
use super::points::Points;
use super::{ProfileKind, ProfileNotice, SMALLEST_SPACING, datum, shape};

/// A flange or a rail's side reaches at least this far from the tread, m.
pub(super) const FLANGE: f64 = 0.015;

/// Widths that occur, m, and their words.
fn widths(kind: ProfileKind) -> ([f64; 2], &'static str) {
    match kind {
        ProfileKind::Wheel => ([0.05, 0.2], "50 to 200 mm"),
        ProfileKind::Rail => ([0.02, 0.2], "20 to 200 mm"),
    }
}

/// Puts the datum in its place, orders points from the gauge side to the field side, takes away those closer
/// than [`SMALLEST_SPACING`] to their neighbor and loops smaller than [`LOOP`], and checks number, size,
/// kind, orientation and crossings.
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
    let mut kept = ordered(&datum::placed(points, kind)?);
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
    without_loops(&mut kept)?;
    if kind == ProfileKind::Wheel
        && let Some([tip, bottom]) = kept.points.iter().copied().min_by(|a, b| a[1].total_cmp(&b[1]))
        && bottom < -FLANGE
    {
        kept.notices.extend(datum::doubt(&kept, tip));
    }
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
        return Err(datum::outside(points, kind));
    }
    let datum = datum::height_at_zero(&points.points).unwrap_or(0.0);
    let [bottom, top] = extent(points, 1);
    let upside_down = "z must point up: name its column z_down (CSV) or set mirror.z (Simpack)";
    match kind {
        ProfileKind::Wheel => {
            let lowest = points.points.iter().min_by(|a, b| a[1].total_cmp(&b[1]));
            let outside = lowest.is_some_and(|point| point[0] > 0.0);
            if outside && shape::flange_side(&points.points) == Some(1.0) {
                return refused(
                    "y = 0 lies behind the tip of the flange: it is not the tape circle",
                    "if y is measured from the back of the flange, say so (--datum flange_back, in a case \
                     wheels.datum = \"flange_back\", with --tape-from-back \"70 mm\", or a column \
                     y_from_back in CSV)",
                );
            }
            if top - datum > FLANGE && datum - bottom < FLANGE {
                return refused("the flange points up", upside_down);
            }
            if outside && datum - bottom > FLANGE {
                return refused(
                    "the flange lies at positive y, on the field side",
                    "y must grow from the flange to the field side: name its column y_gauge (CSV) or set \
                     mirror.y (Simpack)",
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

/// Loops of a measured profile smaller than this are noise, m.
const LOOP: f64 = 1e-4;
/// Times that points are looked through for loops.
const ROUNDS: usize = 20;
/// Most crossings that are looked for at once.
const MOST: usize = 10_000;

/// Takes away loops that are smaller than [`LOOP`], and tells how many.
///
/// # Errors
/// [`ProfileError::SelfCrossing`].
fn without_loops(points: &mut Points) -> Result<(), ProfileError> {
    let mut removed = 0;
    let mut first = None;
    for _ in 0..ROUNDS {
        let found = all_crossings(&points.points);
        // Of the loops that overlap the first one goes; the next round finds what is left.
        let mut loops: Vec<Crossing> = Vec::new();
        for own in found {
            let size = points.points[own.chords[0] + 1..=own.chords[1]]
                .iter()
                .map(|[y, z]| libm::hypot(y - own.at[0], z - own.at[1]))
                .fold(0.0, f64::max);
            if size >= LOOP {
                return Err(own.refused(points));
            }
            if loops.last().is_none_or(|last| last.chords[1] < own.chords[0]) {
                loops.push(own);
            }
        }
        if loops.is_empty() {
            if let Some(place) = first {
                points.notices.push(ProfileNotice {
                    text: format!(
                        "{place}: {removed} {} smaller than {:.1} mm taken away, the first one here",
                        if removed == 1 { "loop" } else { "loops" },
                        1e3 * LOOP
                    ),
                    advice: "measure again if this is more than the noise of the device".into(),
                });
            }
            return Ok(());
        }
        removed += loops.len();
        first.get_or_insert_with(|| points.place(loops[0].chords[0]));
        let mut keep = vec![true; points.points.len()];
        for own in &loops {
            keep[own.chords[0] + 1..=own.chords[1]].fill(false);
        }
        let mut kept = keep.iter();
        points.points.retain(|_| kept.next() == Some(&true));
        let mut kept = keep.iter();
        points.lines.retain(|_| kept.next() == Some(&true));
    }
    crossings(points)
}

/// Two chords that cross, by number, the smaller one first.
struct Crossing {
    chords: [usize; 2],
    at: [f64; 2],
}

impl Crossing {
    fn refused(&self, points: &Points) -> ProfileError {
        ProfileError::SelfCrossing {
            place: points.place(self.chords[0]),
            other: points.place(self.chords[1]),
            at: self.at,
        }
    }
}

/// Refuses points whose chords cross.
///
/// # Errors
/// [`ProfileError::SelfCrossing`].
pub(super) fn crossings(points: &Points) -> Result<(), ProfileError> {
    match all_crossings(&points.points).first() {
        Some(first) => Err(first.refused(points)),
        None => Ok(()),
    }
}

/// Returns crossing chords by the smaller number: sorted by their smallest y, each is compared with those
/// that begin before it ends. No more than [`MOST`] are looked for.
fn all_crossings(points: &[[f64; 2]]) -> Vec<Crossing> {
    let mut found = Vec::new();
    let chords: Vec<_> = points.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let span = |chord: usize, axis: usize| {
        let [a, b] = chords[chord].map(|point| point[axis]);
        [a.min(b), a.max(b)]
    };
    let mut order: Vec<usize> = (0..chords.len()).collect();
    order.sort_by(|a, b| span(*a, 0)[0].total_cmp(&span(*b, 0)[0]).then(a.cmp(b)));
    'all: for (rank, &chord) in order.iter().enumerate() {
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
                found.push(Crossing {
                    chords: [chord.min(other), chord.max(other)],
                    at,
                });
                if found.len() == MOST {
                    break 'all;
                }
            }
        }
    }
    found.sort_by_key(|own| own.chords);
    found
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
