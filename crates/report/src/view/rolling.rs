//! The view of vehicles on a track: the track with its rails and ties, wheels as bodies of revolution,
//! contact patches with their forces. One wheelset or the four of a car use the same functions, with the
//! names of their columns.
//!
//! Treads, flanges and railheads are those of the profiles; webs, feet, plates, hubs, axles and ties are for
//! the eye.

use std::collections::BTreeMap;

use study::patches::PATCHES;
use wheelrail::contact::Side;
use wheelrail::profile::Profile;
use wheelrail::track::{Line, RailLines};

use super::scene::{SceneBody, ScenePatch, SceneTrack, Solid, SolidPose, SolidRole};

const INCH: f64 = 0.0254;
/// Distance between samples of a track, m, and the most samples.
const STEP: f64 = 0.25;
const SAMPLES: f64 = 6000.0;
/// Distance of the points of outlines, m.
const FINE: f64 = 3e-3;
/// Height of a rail, half its web and its foot, thickness of the foot's edge, m: those of 136RE, rounded.
const RAIL: [f64; 4] = [186e-3, 8.7e-3, 76e-3, 11e-3];
/// Ties: spacing, half length, half width, height of their tops, thickness, m.
const TIES: [f64; 5] = [21.0 * INCH, 51.0 * INCH, 4.5 * INCH, -RAIL[0], 5.0 * INCH];
/// Of a wheel: thickness of its rim, half its plate, radius and half width of its hub, m.
const WHEEL: [f64; 4] = [60e-3, 13e-3, 0.14, 0.09];
/// Radius of an axle and how far it stands out of the wheels, m.
const AXLE: [f64; 2] = [0.085, 0.25];

/// Points along a profile, y to the field side and z up, from the gauge side to the field side.
fn outline(profile: &Profile) -> Vec<[f64; 2]> {
    let sample = profile.curve().sample(FINE);
    sample.iter().map(|(_, point)| point.position).collect()
}

/// Returns the [`track`] along which something was at these distances (m) that reaches so far (m) ahead and
/// back, and of the track so much behind and beyond it (m); none without distances.
#[must_use]
pub fn track_of_run(
    lines: &RailLines,
    rails: [&Profile; 2],
    offsets: [f64; 2],
    (distances, reach): (&[f64], f64),
    [behind, beyond]: [f64; 2],
) -> Option<SceneTrack> {
    let first = distances.iter().copied().fold(f64::INFINITY, f64::min);
    let last = distances.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let range = [first - reach - behind, last + reach + beyond];
    first.is_finite().then(|| track(lines, rails, offsets, range))
}

/// Returns the track between two distances (m), with rails of profiles (left, right) as they stand on it.
#[must_use]
pub fn track(lines: &RailLines, rails: [&Profile; 2], offsets: [f64; 2], [from, to]: [f64; 2]) -> SceneTrack {
    let step = STEP.max((to - from) / SAMPLES);
    let count = ((to - from) / step).ceil().max(1.0) as usize + 1;
    let names = ["x", "y", "z", "heading", "grade", "roll"];
    let columns = ["left_lateral", "left_vertical", "right_lateral", "right_vertical"];
    let mut lists: BTreeMap<&'static str, Vec<f64>> = BTreeMap::new();
    for k in 0..count {
        let distance = from + k as f64 * step;
        let section = lines.section_at(Line::Center, distance);
        let station = lines.center_line().at(distance);
        let [x, y, z] = section.origin;
        let roll = libm::asin(section.axes[1][2].clamp(-1.0, 1.0));
        let own = [x, y, z, station.heading, station.grade, roll];
        for (name, value) in names.into_iter().zip(own) {
            lists.entry(name).or_default().push(value);
        }
        let beside = lines.irregularities(distance);
        for (name, value) in columns.into_iter().zip(beside.into_iter().flatten()) {
            lists.entry(name).or_default().push(value);
        }
    }
    // Perfect rails lie in their places.
    lists.retain(|name, values| names.contains(name) || values.iter().any(|value| *value != 0.0));
    let [left, mut right] = [0, 1].map(|side| -> Vec<[f64; 2]> {
        let sign = if side == 0 { 1.0 } else { -1.0 };
        let section = section(&outline(rails[side]), rails[side].top()[1]).into_iter();
        section.map(|[y, z]| [sign * (y + offsets[side]), z]).collect()
    });
    right.reverse();
    SceneTrack {
        from,
        step,
        samples: BTreeMap::new(),
        rails: [left, right],
        ties: TIES,
        lists,
    }
}

/// Returns the section of a rail: its head, below it web and foot; anticlockwise seen from behind.
fn section(head: &[[f64; 2]], top: f64) -> Vec<[f64; 2]> {
    let [height, web, foot, edge] = RAIL;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for [y, _] in head {
        (low, high) = (low.min(*y), high.max(*y));
    }
    let middle = 0.5 * (low + high);
    let beside = |y: f64, below: f64| [middle + y, top - below];
    let mut points: Vec<[f64; 2]> = head.to_vec();
    // Down the field side, along the bottom, up the gauge side.
    points.extend([
        beside(web, 48e-3),
        beside(web, height - 32e-3),
        beside(foot, height - edge),
        beside(foot, height),
        beside(-foot, height),
        beside(-foot, height - edge),
        beside(-web, height - 32e-3),
        beside(-web, 48e-3),
    ]);
    for point in &mut points {
        point[1] -= top;
    }
    points
}

/// Returns the two bodies of a wheelset whose columns have these names: one that goes along with it, and one
/// on it that spins. Their names are `id` and `id_spin`.
#[must_use]
pub fn wheelset_bodies(id: &str, radius: f64, column: &dyn Fn(&str) -> String) -> [SceneBody; 2] {
    let coordinates = [
        None,
        Some("lateral"),
        Some("vertical"),
        Some("roll"),
        None,
        Some("yaw"),
    ];
    let body = |id: String| SceneBody {
        id,
        ..SceneBody::default()
    };
    [
        SceneBody {
            along: Some(column("distance")),
            position: [0.0, 0.0, radius],
            coordinates: coordinates.map(|name| name.map(column)),
            ..body(id.to_owned())
        },
        SceneBody {
            on: Some(id.to_owned()),
            spin: Some(column("spin")),
            ..body(format!("{id}_spin"))
        },
    ]
}

/// Returns wheels (left, right; nominal radii in m) and axle of a wheelset: bodies of revolution on its
/// spinning body.
#[must_use]
pub fn wheelset_solids(
    id: &str,
    name: &str,
    wheels: [&Profile; 2],
    radii: [f64; 2],
    tape_distance: f64,
) -> Vec<Solid> {
    let body = format!("{id}_spin");
    let solid = |what: &str, role: SolidRole, revolved: Vec<[f64; 2]>| Solid {
        id: format!("{id}_{}", what.replace(' ', "_")),
        name: format!("{what} of the {name}"),
        role,
        body: body.clone(),
        mount: SolidPose::default(),
        vertices: Vec::new(),
        triangles: Vec::new(),
        revolved,
    };
    let half = 0.5 * tape_distance;
    let [left, right] = [0, 1].map(|side| revolved(&outline(wheels[side]), radii[side]));
    let left = left.iter().map(|[y, r]| [half + y, *r]).collect();
    let right = right.iter().rev().map(|[y, r]| [-half - y, *r]).collect();
    let [thick, beyond] = AXLE;
    let end = half + beyond;
    let axle = vec![[-end, 0.0], [-end, thick], [end, thick], [end, 0.0]];
    vec![
        solid("left wheel", SolidRole::Wheel, left),
        solid("right wheel", SolidRole::Wheel, right),
        solid("axle", SolidRole::Wheelset, axle),
    ]
}

/// Outline of a wheel: y from the tape circle and radius, from the bore on the gauge side over the tread to
/// the bore on the field side.
fn revolved(profile: &[[f64; 2]], nominal: f64) -> Vec<[f64; 2]> {
    let [rim, plate, hub, wide] = WHEEL;
    let mut points: Vec<[f64; 2]> = profile.iter().map(|[y, z]| [*y, nominal - z]).collect();
    let (Some(first), Some(last)) = (points.first().copied(), points.last().copied()) else {
        return Vec::new();
    };
    let middle = 0.5 * (first[0] + last[0]);
    let inside = nominal - rim;
    let side = |end: [f64; 2], way: f64| {
        [
            [middle + way * wide, AXLE[0]],
            [middle + way * wide, hub],
            [middle + way * plate, hub + 0.02],
            [middle + way * plate, inside - 0.01],
            [end[0], inside],
        ]
    };
    let (mut all, mut back) = (side(first, -1.0).to_vec(), side(last, 1.0).to_vec());
    back.reverse();
    all.append(&mut points);
    all.append(&mut back);
    all
}

/// Returns the patches of both wheels of a wheelset, with the names of their columns.
#[must_use]
pub fn patches(id: &str, column: &dyn Fn(&str) -> String) -> Vec<ScenePatch> {
    let of = |side: Side, number: usize| {
        let word = ["left", "right"][usize::from(side == Side::Right)];
        let own = |what: &str| column(&format!("{word}_patch_{number}_{what}"));
        ScenePatch {
            id: column(&format!("{word}_patch_{number}")),
            name: format!("{word} wheel, patch {number}"),
            body: id.to_owned(),
            place: ["x", "y", "z"].map(own),
            angle: own("angle"),
            right: side == Side::Right,
            normal_force: own("normal_force"),
            creep: ["creep_x", "creep_y"].map(own),
            axes: ["a", "b"].map(own),
        }
    };
    let sides = [Side::Left, Side::Right].into_iter();
    sides
        .flat_map(|side| (1..=PATCHES).map(move |number| (side, number)))
        .map(|(side, number)| of(side, number))
        .collect()
}
