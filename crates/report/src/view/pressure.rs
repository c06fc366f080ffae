//! The pressure over a face whose contact points are a grid, as the 3D view colours it.

use serde::Serialize;

use super::scene::SceneContact;

/// A face with the pressures of its points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ScenePressure {
    /// Its name for people.
    pub name: String,
    /// The body that has the face.
    pub body: String,
    /// Number of points across it.
    pub across: usize,
    /// Its points, body axes: place by place across, each from the lower edge up.
    pub points: Vec<[f64; 3]>,
    /// The columns of their pressures.
    pub pressures: Vec<String>,
}

impl ScenePressure {
    /// Returns a face of points with the columns of their pressures, in any order; `None` if they are no grid
    /// of more than four. Places across are told apart by y, in which a face is straight.
    #[must_use]
    pub fn new(name: &str, body: &str, mut points: Vec<([f64; 3], String)>) -> Option<Self> {
        points.sort_by(|([_, y, z], _), ([_, v, w], _)| y.total_cmp(v).then(z.total_cmp(w)));
        let up = points
            .iter()
            .take_while(|(point, _)| point[1] == points[0].0[1])
            .count();
        let across = points.len().checked_div(up)?;
        if points.len() <= 4 || up < 2 || across < 2 || across * up != points.len() {
            return None;
        }
        let (points, pressures) = points.into_iter().unzip();
        Some(Self {
            name: name.to_owned(),
            body: body.to_owned(),
            across,
            points,
            pressures,
        })
    }
}

/// Returns the faces of contacts that are points of grids, by the names of their columns.
pub(super) fn of_contacts(contacts: &[SceneContact]) -> Vec<ScenePressure> {
    let face = |contact: &SceneContact| {
        let end = |name: &str| {
            contact
                .id
                .find(&format!("_{name}_"))
                .map(|at| at + 1 + name.len())
        };
        let end = end("column").or_else(|| end("slope")).unwrap_or(0);
        contact.id[..end].to_owned()
    };
    let faces = contacts.chunk_by(|one, next| face(one) == face(next));
    faces
        .filter_map(|own| {
            let first = own.first()?;
            let points = own.iter();
            let points = points.map(|contact| (contact.point, format!("{}_pressure", contact.id)));
            ScenePressure::new(&face(first).replace('_', " "), &first.body, points.collect())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn input_points_in_any_order_are_a_grid() {
        let mut points = Vec::new();
        for (row, z) in [0.0, 1.0, 2.5].into_iter().enumerate() {
            for (column, y) in [2.0, -1.0].into_iter().enumerate() {
                points.push(([0.1 * z, y, z], format!("{row}_{column}")));
            }
        }
        let face = ScenePressure::new("column", "wedge", points.clone()).unwrap();
        assert_eq!(face.across, 2);
        assert_eq!(face.pressures, ["0_1", "1_1", "2_1", "0_0", "1_0", "2_0"]);
        assert_eq!(face.points[4], [0.1, 2.0, 1.0]);
        // Four corners and what is no grid have no map.
        assert_eq!(ScenePressure::new("column", "wedge", points[..4].to_vec()), None);
        assert_eq!(ScenePressure::new("column", "wedge", points[..5].to_vec()), None);
        assert_eq!(ScenePressure::new("column", "wedge", Vec::new()), None);
    }
}
