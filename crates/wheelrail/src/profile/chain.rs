//! Chains of lines and arcs that join tangentially.
//!
//! A chain is a list of directed lines and circles, along the direction in which y grows overall. A radius is
//! positive where the chain turns from y towards z (to the left of its direction), so the center lies at
//! `point + radius · normal` with the normal to the left. Neighbors must touch with the same direction; a
//! [`ChainElement::Fillet`] between two of them is given by its radius alone, and its center is solved for:
//! it lies at the signed distance `radius` from a line, and `|radius - other radius|` from the center of a
//! circle.

use std::f64::consts::{PI, TAU};

use super::curve::{CurveForm, Piece, ProfileCurve};
use super::error::{ProfileError, ProfilePlace};

/// An element of a chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ChainElement {
    /// A line through a point (m) in a direction (rad from the y axis).
    Line {
        /// A point of it.
        point: [f64; 2],
        /// Its direction.
        angle: f64,
    },
    /// A circle with center (m) and signed radius (m).
    Circle {
        /// Its center.
        center: [f64; 2],
        /// Its radius, positive where the chain turns from y towards z.
        radius: f64,
    },
    /// A circle that touches both neighbors, which must be lines or circles, by its signed radius (m).
    Fillet {
        /// Its radius, positive where the chain turns from y towards z.
        radius: f64,
    },
}

/// Touching within this distance is a joint, m.
const TOUCHING: f64 = 1e-8;

/// Returns the curve of elements from the point of the first one nearest to `start` (m) to the point of the
/// last one nearest to `end`.
///
/// # Errors
/// Neighbors do not touch, a fillet has no place, or the chain runs backwards.
pub fn chain(
    name: &str,
    start: [f64; 2],
    elements: &[ChainElement],
    end: [f64; 2],
) -> Result<ProfileCurve, ProfileError> {
    let error = |element: usize, found: String, remedy| ProfileError::Joint {
        place: ProfilePlace::whole(name),
        element: element + 1,
        found,
        remedy,
    };
    if elements.is_empty() {
        return Err(error(0, "is missing".into(), "give at least one line or circle"));
    }
    for (number, element) in elements.iter().enumerate() {
        let numbers = match *element {
            ChainElement::Line { point, angle } => [point[0], point[1], angle],
            ChainElement::Circle { center, radius } => [center[0], center[1], radius],
            ChainElement::Fillet { radius } => [radius, 0.0, 0.0],
        };
        let flat = matches!(
            *element,
            ChainElement::Circle { radius, .. } | ChainElement::Fillet { radius } if radius == 0.0
        );
        if flat || !numbers.iter().all(|number| number.is_finite()) {
            return Err(error(
                number,
                "has a radius of zero or a number that is not finite".into(),
                "correct its numbers",
            ));
        }
    }
    let mut fixed = Vec::with_capacity(elements.len());
    for (number, element) in elements.iter().enumerate() {
        let solved = match *element {
            ChainElement::Fillet { radius } => {
                let (before, after) = (
                    number.checked_sub(1).map(|i| elements[i]),
                    elements.get(number + 1),
                );
                let (Some(before), Some(after)) = (before, after) else {
                    return Err(error(
                        number,
                        "is a fillet at an end".into(),
                        "put fillets between lines and circles",
                    ));
                };
                let center = fillet(&before, radius, after).ok_or_else(|| {
                    error(
                        number,
                        format!("has no place: no circle of {radius} m touches both neighbors"),
                        "change the radius, or one of the neighbors",
                    )
                })?;
                ChainElement::Circle { center, radius }
            }
            other => other,
        };
        fixed.push(solved);
    }
    let mut points = vec![nearest(&fixed[0], start)];
    for (number, pair) in fixed.windows(2).enumerate() {
        let joint = joint(&pair[0], &pair[1]).ok_or_else(|| {
            error(
                number + 1,
                "does not touch the one before it".into(),
                "make them tangent, or put a fillet between",
            )
        })?;
        points.push(joint);
    }
    points.push(nearest(&fixed[fixed.len() - 1], end));
    let mut pieces = Vec::with_capacity(fixed.len());
    let mut parameter = 0.0;
    for (number, element) in fixed.iter().enumerate() {
        let (from, to) = (points[number], points[number + 1]);
        let (angle, curvature, length) = match *element {
            ChainElement::Line { angle, .. } => {
                let (sine, cosine) = libm::sincos(angle);
                let length = (to[0] - from[0]) * cosine + (to[1] - from[1]) * sine;
                (angle, 0.0, length)
            }
            ChainElement::Circle { center, radius } => {
                let [first, last] = [from, to].map(|point| direction_on(center, radius, point));
                let mut turn = (last - first) * radius.signum();
                turn -= TAU * libm::floor((turn + 1e-9) / TAU);
                (
                    first,
                    1.0 / radius,
                    if turn > PI { f64::NAN } else { turn * radius.abs() },
                )
            }
            ChainElement::Fillet { .. } => unreachable!("fillets have become circles"),
        };
        if length.is_nan() || length <= -TOUCHING {
            return Err(error(
                number,
                "ends before it begins".into(),
                "give smaller radii, or order the elements along the profile",
            ));
        }
        if length > TOUCHING {
            let form = CurveForm::Arc {
                start: from,
                angle,
                curvature,
            };
            pieces.push(Piece {
                start: parameter,
                form,
            });
            parameter += length;
        }
    }
    if pieces.is_empty() {
        return Err(error(0, "has no length".into(), "move start and end apart"));
    }
    Ok(ProfileCurve::new(pieces, parameter))
}

/// Returns the direction (rad) of a directed circle at a point of it.
fn direction_on(center: [f64; 2], radius: f64, point: [f64; 2]) -> f64 {
    // The normal to the left is (center - point) / radius; the direction is a quarter turn to its right.
    let normal = [0, 1].map(|i| (center[i] - point[i]) / radius);
    libm::atan2(-normal[0], normal[1])
}

/// Returns the point of an element nearest to a point.
fn nearest(element: &ChainElement, point: [f64; 2]) -> [f64; 2] {
    match *element {
        ChainElement::Line { point: own, angle } => {
            let (sine, cosine) = libm::sincos(angle);
            let along = (point[0] - own[0]) * cosine + (point[1] - own[1]) * sine;
            [own[0] + along * cosine, own[1] + along * sine]
        }
        ChainElement::Circle { center, radius } => {
            let away = [point[0] - center[0], point[1] - center[1]];
            let factor = radius.abs() / libm::hypot(away[0], away[1]);
            [center[0] + away[0] * factor, center[1] + away[1] * factor]
        }
        ChainElement::Fillet { .. } => point,
    }
}

/// Returns the point where two neighbors touch with the same direction.
fn joint(before: &ChainElement, after: &ChainElement) -> Option<[f64; 2]> {
    match (*before, *after) {
        (ChainElement::Line { point, angle }, ChainElement::Circle { center, radius })
        | (ChainElement::Circle { center, radius }, ChainElement::Line { point, angle }) => {
            let (sine, cosine) = libm::sincos(angle);
            let distance = (center[1] - point[1]) * cosine - (center[0] - point[0]) * sine;
            let foot = [center[0] + radius * sine, center[1] - radius * cosine];
            ((distance - radius).abs() < TOUCHING).then_some(foot)
        }
        (ChainElement::Circle { center: c, radius: r }, ChainElement::Circle { center: d, radius: s }) => {
            let apart = libm::hypot(d[0] - c[0], d[1] - c[1]);
            if r == s || (apart - (r - s).abs()).abs() > TOUCHING {
                return None;
            }
            let normal = [0, 1].map(|i| (c[i] - d[i]) / (r - s));
            Some([c[0] - r * normal[0], c[1] - r * normal[1]])
        }
        _ => None,
    }
}

/// Returns the center of a circle that touches two neighbors; of several, the one whose arc turns least.
fn fillet(before: &ChainElement, radius: f64, after: &ChainElement) -> Option<[f64; 2]> {
    let candidates = match (locus(before, radius)?, locus(after, radius)?) {
        (Locus::Line(p, a), Locus::Line(q, b)) => {
            let determinant = libm::sin(b - a);
            if determinant.abs() < 1e-12 {
                return None;
            }
            let (sine, cosine) = libm::sincos(b);
            let along = ((q[0] - p[0]) * sine - (q[1] - p[1]) * cosine) / determinant;
            let (sine, cosine) = libm::sincos(a);
            vec![[p[0] + along * cosine, p[1] + along * sine]]
        }
        (Locus::Line(p, a), Locus::Circle(c, r)) | (Locus::Circle(c, r), Locus::Line(p, a)) => {
            let (sine, cosine) = libm::sincos(a);
            let along = (c[0] - p[0]) * cosine + (c[1] - p[1]) * sine;
            let foot = [p[0] + along * cosine, p[1] + along * sine];
            let square = r * r - (c[0] - foot[0]).powi(2) - (c[1] - foot[1]).powi(2);
            if square < 0.0 {
                return None;
            }
            let half = square.sqrt();
            [half, -half]
                .map(|t| [foot[0] + t * cosine, foot[1] + t * sine])
                .to_vec()
        }
        (Locus::Circle(c, r), Locus::Circle(d, s)) => {
            let away = [d[0] - c[0], d[1] - c[1]];
            let apart = libm::hypot(away[0], away[1]);
            let along = (apart * apart + r * r - s * s) / (2.0 * apart);
            let square = r * r - along * along;
            if square.is_nan() || square < 0.0 {
                return None;
            }
            let half = square.sqrt();
            let unit = [away[0] / apart, away[1] / apart];
            [half, -half]
                .map(|t| {
                    [
                        c[0] + along * unit[0] - t * unit[1],
                        c[1] + along * unit[1] + t * unit[0],
                    ]
                })
                .to_vec()
        }
    };
    let turn = |center: &[f64; 2]| {
        let own = ChainElement::Circle {
            center: *center,
            radius,
        };
        let (Some(first), Some(last)) = (joint(before, &own), joint(&own, after)) else {
            return f64::INFINITY;
        };
        let [first, last] = [first, last].map(|point| direction_on(*center, radius, point));
        let turn = (last - first) * radius.signum();
        turn - TAU * libm::floor(turn / TAU)
    };
    candidates
        .into_iter()
        .filter(|center| turn(center).is_finite())
        .min_by(|a, b| turn(a).total_cmp(&turn(b)))
}

/// The locus of the center of a touching circle.
enum Locus {
    Line([f64; 2], f64),
    Circle([f64; 2], f64),
}

fn locus(element: &ChainElement, radius: f64) -> Option<Locus> {
    match *element {
        ChainElement::Line { point, angle } => {
            let (sine, cosine) = libm::sincos(angle);
            Some(Locus::Line(
                [point[0] - radius * sine, point[1] + radius * cosine],
                angle,
            ))
        }
        ChainElement::Circle { center, radius: own } => Some(Locus::Circle(center, (own - radius).abs())),
        ChainElement::Fillet { .. } => None,
    }
}
