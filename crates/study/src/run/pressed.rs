//! Check that a curved face has enough points where it is pressed.
//!
//! With L spacings of the grid on the pressed part of a cylinder its normal force is off by at most 1/L²
//! (`mechanics/tests/system/surfaces.rs`): ten spacings are needed for 1 %.

use mechanics::output::Column;
use wedge::face::{FaceDirection, FaceProfile, FaceProperties, Grid};
use wedge::outputs::FACES;

/// Spacings on the pressed part for a normal force within 1 %.
const SPACINGS: usize = 10;

/// Returns the warning of a face with too few points, if it has too few at the time of its greatest force
/// after the first tenth of the run. `values` are the columns of the result.
pub(super) fn warning(
    face: usize,
    own: &FaceProperties,
    columns: &[Column],
    values: &[Vec<f64>],
) -> Option<String> {
    let profile = curved(own)?;
    let (name, grid) = (FACES[face], own.grid);
    let (count, way) = match profile.direction {
        FaceDirection::Up => (grid.up, "up"),
        FaceDirection::Across => (grid.across, "across"),
    };
    let wanted = |points: usize| match profile.direction {
        FaceDirection::Up => [points, grid.across],
        FaceDirection::Across => [grid.up, points],
    };
    if count < 3 {
        let [up, across] = wanted(4 * SPACINGS + 1);
        return Some(format!(
            "the {name} face is curved {way} but has {count} points there, at its edges: take more, for \
             example {name}_face.grid = [{up}, {across}]"
        ));
    }
    let (pressed, points) = (pressed(face, grid, profile.direction, columns, values)?, count);
    // Where it is pressed up to both edges nothing ends inside the face.
    if pressed == points || pressed >= SPACINGS {
        return None;
    }
    let error = 1.0 / (pressed.saturating_sub(1).max(1) as f64).powi(2);
    let more = ((points - 1) * SPACINGS).div_ceil(pressed.saturating_sub(1).max(1)) + 1;
    let [up, across] = wanted(more.min(wedge::face::LARGEST_GRID));
    Some(format!(
        "the curved {name} face is pressed at {pressed} of its {points} places {way} it: its normal force is \
         off by up to {:.0} %; for 1 % take {name}_face.grid = [{up}, {across}]",
        100.0 * error
    ))
}

/// Returns the curved surface of a face, if it has one.
pub(super) fn curved(own: &FaceProperties) -> Option<&FaceProfile> {
    let mut surfaces = [&own.wedge_surface, &own.counterface].into_iter();
    surfaces.find(|own| !own.profile.is_flat())
}

/// Returns at how many places along a direction a face is pressed when its force is greatest.
fn pressed(
    face: usize,
    grid: Grid,
    direction: FaceDirection,
    columns: &[Column],
    values: &[Vec<f64>],
) -> Option<usize> {
    let column = |name: &str| {
        let at = columns.iter().position(|column| column.name == name)?;
        Some(values[at].as_slice())
    };
    let times = column("time")?;
    let mut points = Vec::new();
    for point in grid.points() {
        let pressure = column(&format!("{}_{}_pressure", FACES[face], point.number()))?;
        points.push((point, pressure));
    }
    let first = times.partition_point(|time| *time < 0.1 * times.last().copied().unwrap_or_default());
    let force = |row: usize| {
        points
            .iter()
            .map(|(point, own)| point.weight * own[row])
            .sum::<f64>()
    };
    let worst = (first..times.len()).max_by(|a, b| force(*a).total_cmp(&force(*b)))?;
    let mut places: Vec<usize> = points
        .iter()
        .filter(|(_, own)| own[worst] > 0.0)
        .map(|(point, _)| match direction {
            FaceDirection::Up => point.row,
            FaceDirection::Across => point.column,
        })
        .collect();
    places.sort_unstable();
    places.dedup();
    (!places.is_empty()).then_some(places.len())
}
