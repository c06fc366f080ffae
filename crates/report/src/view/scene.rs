//! The scene of a run: bodies that move as columns say, solids and coils on them, contacts between them.
//!
//! The scene knows no wedge: any number of bodies, solids, coils and contacts make one.
//!
//! Where a viewer exaggerates displacements by a factor f: a body's place is its `position`, plus its
//! `steady` columns to scale, plus f times what its displacements have more than these (up to `limit`, and to
//! scale beyond it); its angles and those of a solid's mount are multiplied by f. Gaps of touching faces then
//! grow by f, since a sum of small displacements is linear.

use std::collections::BTreeMap;

use serde::Serialize;

pub use super::pressure::ScenePressure;

/// The factor by which displacements are exaggerated at first.
pub(super) const FACTOR: f64 = 10.0;

/// Bodies, solids, coils and contacts; m, rad; x longitudinal, y lateral, z up.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Scene {
    /// The factor by which displacements are exaggerated at first.
    pub factor: f64,
    /// The exaggerated size (m) beyond which displacements grow to scale.
    pub limit: f64,
    /// The length (m) of the arrow of a force that few exceed.
    pub arrow: f64,
    /// Named views, the first one shown first.
    pub looks: Vec<Look>,
    /// The bodies that move.
    pub bodies: Vec<SceneBody>,
    /// The solids that show them.
    pub solids: Vec<Solid>,
    /// Coils between bodies.
    pub coils: Vec<SceneCoil>,
    /// Corners of solids at surfaces of others.
    pub contacts: Vec<SceneContact>,
    /// Pressures over faces with grids of points.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub pressures: Vec<ScenePressure>,
    /// Contact patches of wheels.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub patches: Vec<ScenePatch>,
    /// The track that bodies run along.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub track: Option<SceneTrack>,
    /// The body that the view goes along with: all is drawn in the axes of the track where it is. None: in
    /// the fixed axes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub follow: Option<String>,
}

/// A named view.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Look {
    /// Its name.
    pub name: String,
    /// From what is looked at towards the eye; any length.
    pub from: [f64; 3],
    /// The target of the view: a point and the radius (m) about it that is to be seen; none: everything.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<([f64; 3], f64)>,
    /// The length (m) of the arrow of a force that few exceed; none: the scene's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arrow: Option<f64>,
}

impl Look {
    /// Returns a view of everything.
    pub(super) fn all(name: &str, from: [f64; 3]) -> Self {
        Self {
            name: name.to_owned(),
            from,
            at: None,
            arrow: None,
        }
    }
}

/// A body: R = Ry(pitch) Rz(yaw) Rx(roll).
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SceneBody {
    /// Its name.
    pub id: String,
    /// The body in whose axes place and angles are given; none: the fixed ones.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
    /// The column of its distance along the track: place and angles are given in the track's axes there
    /// (along, to the left, up).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub along: Option<String>,
    /// The column of a turn about its own y axis that is never exaggerated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spin: Option<String>,
    /// Its origin in the nominal position.
    pub position: [f64; 3],
    /// The columns of its displacements x, y, z and its angles roll, pitch, yaw.
    pub coordinates: [Option<String>; 6],
    /// The columns of the parts of x, y, z that are never exaggerated.
    pub steady: [Option<String>; 3],
}

/// The pose of something on its body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct SolidPose {
    /// From the body's origin, body axes.
    pub position: [f64; 3],
    /// Roll, pitch, yaw relative to the body.
    pub angles: [f64; 3],
}

/// The role of a solid, for its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SolidRole {
    /// A friction wedge.
    Wedge,
    /// A column of a side frame.
    Column,
    /// A pocket of a bolster.
    Pocket,
    /// The seat of a coil.
    Seat,
    /// A wheelset, which stands before what is looked at.
    Wheelset,
    /// A wheel on its rail.
    Wheel,
    /// Any other body.
    Body,
    /// Walls that others are seen through.
    Glass,
    /// The kinds of lading.
    Lading,
}

/// A solid of flat faces.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Solid {
    /// Its name in the scene.
    pub id: String,
    /// Its name for people.
    pub name: String,
    /// The description.
    pub role: SolidRole,
    /// Its body.
    pub body: String,
    /// Its pose on the body.
    pub mount: SolidPose,
    /// Its corners in the mount's axes.
    pub vertices: Vec<[f64; 3]>,
    /// Its faces, anticlockwise seen from outside: places in `vertices`.
    pub triangles: Vec<[usize; 3]>,
    /// Instead of these, of a body of revolution about y: y and radius along its outline, towards +y on the
    /// outside.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub revolved: Vec<[f64; 2]>,
}

/// A contact patch of a wheel, of which there are as many as the wheel may have; it is seen while it presses.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ScenePatch {
    /// Its name, as in columns.
    pub id: String,
    /// Its name for people.
    pub name: String,
    /// The wheelset's body, which does not spin.
    pub body: String,
    /// The columns of its place in the body's axes.
    pub place: [String; 3],
    /// The column of its contact angle: how far its plane rises to the field side.
    pub angle: String,
    /// True if the field side is on the right (-y).
    pub right: bool,
    /// The column of the normal force.
    pub normal_force: String,
    /// The columns of the creep force on the wheel: forward, and in the plane of the patch to the left.
    pub creep: [String; 2],
    /// The columns of the semi-axes of its ellipse, forward and across.
    pub axes: [String; 2],
}

/// A track: its center line, how its rails lie beside their nominal places, what a rail looks like.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneTrack {
    /// Distance of the first sample.
    pub from: f64,
    /// Distance between samples.
    pub step: f64,
    /// The samples: places in `data`.
    pub samples: BTreeMap<&'static str, usize>,
    /// The sections of the left and the right rail, y and z in the axes of the track, anticlockwise seen from
    /// behind.
    pub rails: [Vec<[f64; 2]>; 2],
    /// Ties: spacing, half length, half width, height of their tops (negative), thickness.
    pub ties: [f64; 5],
    /// The samples by their names, until they are put to the data.
    #[serde(skip)]
    pub lists: BTreeMap<&'static str, Vec<f64>>,
}

/// An end of a coil.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CoilEnd {
    /// The body.
    pub body: String,
    /// The point, body axes.
    pub point: [f64; 3],
}

/// A coil.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneCoil {
    /// Its name.
    pub name: String,
    /// Its seat.
    pub from: CoilEnd,
    /// Its other end.
    pub to: CoilEnd,
    /// Length in the nominal position.
    pub nominal_length: f64,
    /// Free length.
    pub free_length: f64,
    /// Radius, for the eye: cases have none.
    pub radius: f64,
    /// Number of turns, for the eye.
    pub turns: f64,
    /// The column of its force.
    pub force: Option<String>,
    /// The column of its length.
    pub length: Option<String>,
}

/// A point of a body at a surface of a solid.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneContact {
    /// Its name, as in columns.
    pub id: String,
    /// Its name for people.
    pub name: String,
    /// The body that has the point.
    pub body: String,
    /// The point, body axes.
    pub point: [f64; 3],
    /// The solid that has the surface.
    pub on: String,
    /// The surface's normal towards the point, in the axes of that solid's mount.
    pub normal: [f64; 3],
    /// The column of the normal force on the body of the point.
    pub normal_force: String,
    /// The columns of the friction force on it: axes of the track where its body runs along, else fixed
    /// axes.
    pub friction: [String; 3],
    /// The column of the state: 0 open, 1 stick, 2 slip.
    pub state: String,
    /// The column of the gap, if there is one.
    pub gap: Option<String>,
}

impl Scene {
    /// Returns the columns that it needs.
    pub fn columns(&self) -> impl Iterator<Item = &String> {
        let bodies = self
            .bodies
            .iter()
            .flat_map(|body| body.coordinates.iter().chain(&body.steady).flatten());
        let coils = self
            .coils
            .iter()
            .flat_map(|coil| coil.force.iter().chain(&coil.length));
        let contacts = self.contacts.iter().flat_map(|contact| {
            [&contact.normal_force, &contact.state]
                .into_iter()
                .chain(&contact.friction)
                .chain(&contact.gap)
        });
        let patches = self.patches.iter().flat_map(|patch| {
            [&patch.angle, &patch.normal_force]
                .into_iter()
                .chain(&patch.place)
                .chain(&patch.creep)
                .chain(&patch.axes)
        });
        let pressures = self.pressures.iter().flat_map(|face| &face.pressures);
        let exact = self.exact_columns();
        let of_contacts = contacts.chain(patches).chain(pressures);
        bodies.chain(coils).chain(of_contacts).chain(exact)
    }

    /// Leaves out contacts, where a run has no columns of them.
    pub(super) fn clear_contacts(&mut self) {
        self.contacts.clear();
        self.pressures.clear();
    }

    /// Those that grow without bound, and are not rounded.
    pub fn exact_columns(&self) -> impl Iterator<Item = &String> {
        self.bodies
            .iter()
            .flat_map(|body| body.along.iter().chain(&body.spin))
    }

    /// Rounds sizes to a micrometre: they are for the eye, and shorter to write.
    pub(super) fn round(&mut self) {
        let round = |part: &mut f64| *part = (*part * 1e6).round() / 1e6;
        for solid in &mut self.solids {
            solid.vertices.iter_mut().flatten().for_each(round);
            solid.revolved.iter_mut().flatten().for_each(round);
        }
        let rails = self.track.iter_mut().flat_map(|track| &mut track.rails);
        rails.flatten().flatten().for_each(round);
    }
}

impl Solid {
    /// Makes one solid of two on the same mount.
    pub(super) fn join(&mut self, other: Self) {
        let before = self.vertices.len();
        self.vertices.extend(other.vertices);
        let moved = other
            .triangles
            .into_iter()
            .map(|corners| corners.map(|corner| before + corner));
        self.triangles.extend(moved);
    }
}

/// Returns a convex outline in the plane of x and z, anticlockwise with x to the right and z up, drawn out to
/// both sides along y.
pub(super) fn extruded(
    (id, name, role, body): (&str, &str, SolidRole, &str),
    outline: &[[f64; 2]],
    width: f64,
) -> Solid {
    let count = outline.len();
    let side = |y: f64| outline.iter().map(move |[x, z]| [*x, y, *z]);
    let mut triangles = Vec::new();
    for i in 1..count.saturating_sub(1) {
        triangles.push([0, i, i + 1]);
        triangles.push([count, count + i + 1, count + i]);
    }
    for i in 0..count {
        let next = (i + 1) % count;
        triangles.push([i, count + i, count + next]);
        triangles.push([i, count + next, next]);
    }
    Solid {
        id: id.to_owned(),
        name: name.to_owned(),
        role,
        body: body.to_owned(),
        mount: SolidPose::default(),
        vertices: side(-0.5 * width).chain(side(0.5 * width)).collect(),
        triangles,
        revolved: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use mechanics::vector::Vector;

    use super::*;

    /// The volume by the divergence theorem: positive if all faces look outwards.
    #[test]
    fn solids_are_closed_and_look_outwards() {
        let outline = [[0.0, 0.0], [3.0, 0.0], [0.0, 5.0]];
        let solid = extruded(("a", "a", SolidRole::Body, "b"), &outline, 2.0);
        let six_volumes: f64 = solid
            .triangles
            .iter()
            .map(|corners| {
                let [a, b, c] = corners.map(|corner| Vector(solid.vertices[corner]));
                let cross: Vector<f64> = b.cross(c);
                a.dot::<f64, f64>(cross)
            })
            .sum();
        assert!((six_volumes / 6.0 - 15.0).abs() < 1e-12, "{six_volumes}");
    }
}
