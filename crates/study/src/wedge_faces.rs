//! The faces of a truck's wedges in words, and whether their points are enough for a crown.
//!
//! The springs of a face of stiffness K and width w across a crown of radius R under a normal force N are
//! pressed over the half width a: `N = (2/3) (K / w) a³ / R`. Hertz's contact of the castings is narrower by
//! far (0.13 in against 3 in at 7 kip and 240 in): the radius of the model stands for crown and bed
//! together.

use quantity::SixDigits;
use truck::{CROWN_RADIUS, WEDGE_NAMES, Wedge, WedgeKind};
use wedge::face::{FaceDirection, FaceProfile, FaceProperties, LARGEST_GRID};

use crate::assumptions::of_face;
use crate::geometry;

const INCH: f64 = 0.0254;
const POUND_FORCE: f64 = 4.448_221_615_260_5;
const FACES: [&str; 2] = ["column", "slope"];
/// Spacings of the grid on the pressed part of a crown, from which on warp from 0.5 mrad is within 5 % of
/// that of finer grids.
const SPACINGS: f64 = 3.0;

fn faces(wedge: &Wedge) -> [&FaceProperties; 2] {
    [&wedge.column_face, &wedge.slope_face]
}

/// Returns all wedges of trucks with the names that `prefixes` begin.
pub(crate) fn named<'w>(trucks: &[(&str, &'w [Wedge; 4])]) -> Vec<(String, &'w Wedge)> {
    let all = trucks.iter().flat_map(|(prefix, wedges)| {
        let own = WEDGE_NAMES.iter().zip(wedges.iter());
        own.map(move |(name, wedge)| (format!("{prefix}{}", name.replace('_', " ")), wedge))
    });
    all.collect()
}

/// Returns what the faces of wedges with faces are beyond four corners and flat surfaces; faces that all
/// wedges have alike once.
pub(crate) fn assumptions(wedges: &[(String, &Wedge)]) -> Vec<String> {
    let mut list = Vec::new();
    let with_faces = || wedges.iter().filter(|(_, own)| own.kind != WedgeKind::Massless);
    for (number, face) in FACES.into_iter().enumerate() {
        let first = with_faces().next().map(|(_, own)| faces(own)[number]);
        let alike = with_faces().all(|(_, own)| Some(faces(own)[number]) == first);
        match first.filter(|_| alike) {
            Some(own) => list.extend(of_face(&format!("{face} face of every wedge"), own)),
            None => list
                .extend(with_faces().filter_map(|(name, own)| {
                    of_face(&format!("{name} wedge's {face}"), faces(own)[number])
                })),
        }
    }
    let chosen = |own: &FaceProfile| {
        let radius = own.profile.radius();
        radius.is_some_and(|radius| (radius / CROWN_RADIUS - 1.0).abs() < 1e-9)
    };
    if with_faces().any(|(_, own)| faces(own).iter().any(|face| chosen(&face.wedge_surface))) {
        list.push(
            "The crown's radius of 240 in is a choice: no source gives one. It sets the warp stiffness below \
             some 10 mrad; 60 in and flat beside it show how much (docs/wedge-faces.md)."
                .to_owned(),
        );
    }
    list
}

/// Returns the warnings about the wedges' shape: crowns that too few points carry, angles that none have.
pub(crate) fn warnings(wedges: &[(String, &Wedge)]) -> Vec<String> {
    // The words of each warning, the first wedge that it is about, and how many more there are.
    let mut found: Vec<(String, &str, usize)> = Vec::new();
    for (name, wedge) in wedges {
        let coarse = (0..FACES.len()).filter_map(|number| too_coarse(wedge, number));
        for words in coarse.chain(geometry::of_angle(wedge.angle)) {
            match found.iter_mut().find(|(other, ..)| *other == words) {
                Some((.., more)) => *more += 1,
                None => found.push((words, name, 0)),
            }
        }
    }
    let words = found.into_iter().map(|(words, name, more)| match more {
        0 => format!("wedge {name}: {words}"),
        more => format!("wedge {name}: {words} (and the same at {more} more wedges)"),
    });
    words.collect()
}

/// Returns the warning of a face whose points are too few for its crown under the force that its control coil
/// makes without friction.
fn too_coarse(wedge: &Wedge, number: usize) -> Option<String> {
    if wedge.kind == WedgeKind::Massless {
        return None;
    }
    let face = faces(wedge)[number];
    let surfaces = [&face.wedge_surface, &face.counterface];
    let mut crowns = surfaces
        .into_iter()
        .filter_map(|own| Some((own, own.profile.radius()?)));
    let (own, radius) = crowns.next()?;
    let preload = wedge.control_coil.preload();
    let (sine, cosine) = libm::sincos(wedge.angle);
    let (force, length) = match number {
        0 => (preload * cosine / sine, wedge.height),
        _ => (preload / sine, wedge.height / cosine),
    };
    let share = if wedge.kind == WedgeKind::Split { 0.5 } else { 1.0 };
    let (extent, points) = match own.direction {
        FaceDirection::Up => (length, face.grid.up),
        FaceDirection::Across => (share * wedge.width, face.grid.across),
    };
    let stiffness = face
        .pad
        .as_ref()
        .map_or(4.0 * wedge.contact.stiffness, |pad| pad.stiffness);
    let half = libm::cbrt(1.5 * force * radius * extent / stiffness) + own.half_flat().unwrap_or(0.0);
    let pressed = (2.0 * half).min(extent);
    let spacings = pressed / extent * (points - 1) as f64;
    if spacings >= SPACINGS || force <= 0.0 {
        return None;
    }
    let needed = ((SPACINGS * extent / pressed).ceil() as usize + 1).min(LARGEST_GRID);
    let (way, grid) = match own.direction {
        FaceDirection::Up => ("up", [needed, face.grid.across]),
        FaceDirection::Across => ("across", [face.grid.up, needed]),
    };
    Some(format!(
        "the {} face is crowned {way} by {} in, so that {:.1} in of its {:.1} in bear on their springs under \
         the {:.0} lbf that its coil makes there, and {points} points {way} have {spacings:.1} spacings on \
         them: the warp stiffness below 1 mrad is off by more than 5 %. Take grid = [{}, {}] or more for it",
        FACES[number],
        SixDigits(radius / INCH),
        pressed / INCH,
        extent / INCH,
        force / POUND_FORCE,
        grid[0],
        grid[1],
    ))
}
