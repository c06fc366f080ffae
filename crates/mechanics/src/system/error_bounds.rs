//! The widest admissible errors of positions and speeds: see [`scales::WIDEST_TOLERANCE`].

use numerics::partitioned::Layout;

use super::{FrameState, FreeBody, Mounted, scales};
use crate::contact::{ContactFace, Interface};
use crate::friction::FrictionLaw;

/// A normal whose part along a coordinate is smaller than this is taken as perpendicular to it: the part is
/// due to rounding.
const ALONG: f64 = 1e-12;

/// Returns for each coordinate of a free body whether gaps change with it.
pub(super) fn presses<'f>(
    free: &'f FreeBody,
    faces: &'f [Mounted<ContactFace<Interface>>],
    frames: &'f [FrameState],
) -> impl Iterator<Item = bool> + 'f {
    let turns = free.free.len() > free.translations;
    let may = move |coordinate: usize, face: &Mounted<ContactFace<Interface>>| {
        let ends = [face.body, face.on];
        let straight = !face.on_free && ends.iter().all(|&end| frames[end].keeps_orientation);
        let curved = face.points.is_curved();
        turns || !straight || curved || face.relative_frame.rotation.0[0][coordinate].abs() > ALONG
    };
    let own = free.faces.iter().map(|&face| &faces[face]);
    free.free
        .iter()
        .map(move |&coordinate| own.clone().any(|face| may(coordinate, face)))
}

/// Returns the widest admissible errors of positions and speeds, and those of speeds where a point sticks:
/// see [`scales::WIDEST_TOLERANCE`].
pub(super) fn error_bounds(
    error_scales: &[f64],
    layout: Layout,
    faces: &[Mounted<ContactFace<Interface>>],
    presses: &[bool],
) -> (Vec<f64>, Vec<f64>) {
    let mut reference = f64::INFINITY;
    let mut tanh_alone = !faces.is_empty();
    for face in faces {
        match face.element.law {
            FrictionLaw::Tanh { reference_speed } => reference = reference.min(reference_speed),
            FrictionLaw::Bristle { .. } => tanh_alone = false,
        }
    }
    let of_speeds = if tanh_alone {
        f64::INFINITY
    } else {
        scales::WIDEST_TOLERANCE
    };
    let in_layers = if faces.is_empty() {
        f64::INFINITY
    } else {
        scales::WIDEST_TOLERANCE.min(reference / scales::VELOCITY)
    };
    let [q, u, ..] = layout.split(error_scales);
    let where_pressed = |scales: &[f64], bound: f64| -> Vec<f64> {
        let bounds = scales.iter().zip(presses);
        bounds
            .map(|(scale, presses)| if *presses { scale * bound } else { f64::INFINITY })
            .collect()
    };
    let in_layers = u.iter().map(|scale| scale * in_layers);
    (
        [
            where_pressed(q, scales::WIDEST_TOLERANCE),
            where_pressed(u, of_speeds),
        ]
        .concat(),
        q.iter().map(|_| f64::INFINITY).chain(in_layers).collect(),
    )
}
