//! Poses of the bodies of a car in a run, forces of its wedges' faces and contact points of its wheels: what
//! a picture of it needs beyond the result. It is taken along only where it is asked for, since it has more
//! columns than the result.

use std::array::from_fn;

use car::{Car, Parameters};
use mechanics::output::Column;
use mechanics::system::Observation;
use mechanics::vector::Vector;
use quantity::Kind;
use wheelrail::contact::Side;

use super::statistics::SIDES;
use crate::patches::{self, Patches, unspun};

/// Names of the coordinates of bodies.
const COORDINATES: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];
/// Bolster and side frames.
const PARTS: [&str; 3] = ["bolster", "left_side_frame", "right_side_frame"];
/// Faces of wedges.
const FACES: [&str; 2] = ["column", "slope"];

/// The motions of a run, row by row as the result has them; SI. Columns that the result has are not here.
///
/// | columns | what |
/// |---|---|
/// | `body_lateral`, `body_vertical`, `body_turn_roll`, `_pitch`, `_yaw` | of body and lading in the axes of
/// the track at their center of gravity, from the nominal layout |
/// | `chord_lateral`, `chord_vertical` | the middle between the feet of the bolsters on the center line,
/// there |
/// | `truck_1_distance`, `truck_1_bolster_x`, ..., `truck_1_left_side_frame_yaw` | in the axes of the track
/// at the bolster |
/// | `truck_1_leading_left_column_friction_on_wedge_x`, ..., `_state` | of column and slope: sums over the
/// points, on the wedge; of a split one on each half, `truck_1_leading_left_outboard_...` |
/// | `axle_1_distance`, `_vertical`, `_roll`, `_spin`; `axle_1_left_patch_1_x`, ... | as of a wheelset's run
/// |
#[derive(Clone, Debug)]
pub struct MotionTable {
    /// The columns.
    pub columns: Vec<Column>,
    /// Their values, one vector a column.
    pub values: Vec<Vec<f64>>,
    /// Nominal radius of each wheelset, m.
    radii: [f64; 4],
    row: Vec<f64>,
}

impl MotionTable {
    /// Returns an empty table of a car.
    pub(super) fn new(car: &Parameters) -> Self {
        let mut columns = Vec::new();
        let mut add = |name: String, kind: Kind, text: &str| {
            columns.push(Column {
                name,
                kind,
                frame: "of the track: forward, left, up".into(),
                reference: "".into(),
                text: text.to_owned(),
            });
        };
        let kind = |coordinate: usize| [Kind::Length, Kind::Angle][coordinate / 3];
        for name in ["lateral", "vertical"] {
            let text = "center of gravity of body and lading, from the nominal layout";
            add(format!("body_{name}"), Kind::Length, text);
        }
        for name in ["roll", "pitch", "yaw"] {
            let text = "of the body against the track: angles about its left, its up and its forward axis";
            add(format!("body_turn_{name}"), Kind::Angle, text);
        }
        for name in ["lateral", "vertical"] {
            let text = "middle between the feet of the bolsters on the center line, where the body is";
            add(format!("chord_{name}"), Kind::Length, text);
        }
        for (truck, parameters) in (1..).zip(&car.trucks) {
            let text = "distance of the bolster along the track";
            add(format!("truck_{truck}_distance"), Kind::Distance, text);
            for part in PARTS {
                for (k, name) in COORDINATES.into_iter().enumerate() {
                    let text = "from the nominal layout, in the axes of the track at the bolster";
                    add(format!("truck_{truck}_{part}_{name}"), kind(k), text);
                }
            }
            for part in parameters.wedge_parts() {
                for face in FACES {
                    let stem = format!("truck_{truck}_{}_{face}", part.name);
                    for axis in ["x", "y", "z"] {
                        let text = "friction of the face on the wedge, axes of the truck";
                        add(format!("{stem}_friction_on_wedge_{axis}"), Kind::Force, text);
                    }
                    let text = "0 open, 1 stick, 2 slip: of the face as a whole";
                    add(format!("{stem}_state"), Kind::Count, text);
                }
            }
        }
        for axle in 1..=4 {
            let stem = format!("axle_{axle}");
            add(format!("{stem}_distance"), Kind::Distance, "along the track");
            let text = "center of the wheelset above the nominal radius, up";
            add(format!("{stem}_vertical"), Kind::Length, text);
            add(
                format!("{stem}_roll"),
                Kind::Angle,
                "of the axle to the plane of the track",
            );
            add(
                format!("{stem}_spin"),
                Kind::Angle,
                "angle of the spin about the axle",
            );
            for side in SIDES {
                let side = format!("{stem}_{side}");
                patches::columns(&side, |name, kind, text| add(name, kind, &text));
            }
        }
        Self {
            values: vec![Vec::new(); columns.len()],
            row: Vec::with_capacity(columns.len()),
            columns,
            radii: [0, 1, 2, 3].map(|w| car.axle_radius(w)),
        }
    }

    /// Appends a row.
    pub(super) fn take(&mut self, car: &Car, seen: &Observation) {
        let motions = car.motions(seen);
        let row = &mut self.row;
        row.clear();
        row.extend(&motions.body.coordinates[1..]);
        row.extend(motions.body.chord);
        for truck in &motions.trucks {
            let parts = &truck.parts;
            row.push(truck.distance);
            row.extend(parts.bolster);
            row.extend(parts.side_frames.iter().flatten());
            for face in parts.faces.iter().flatten() {
                row.extend(face.friction);
                row.push(f64::from(face.state as u8));
            }
        }
        let axles: [_; 4] = from_fn(|w| car.wheelset_axes(seen, w));
        let mut wheels: [[Patches; 2]; 4] = from_fn(|_| from_fn(|_| Patches::default()));
        car.patches(seen, |w, i, patch| {
            let own = &axles[w];
            // Places are counted from the rail, which gives way.
            let rail = car.rail(seen, w, i);
            let axes = unspun(own.axle, &own.section);
            wheels[w][i].take(&patch, [Side::Left, Side::Right][i], axes, own.center - rail);
        });
        for ((own, pair), radius) in axles.iter().zip(&mut wheels).zip(&self.radii) {
            let section = &own.section;
            let arm = own.center - Vector(section.origin);
            let [_, _, height] = section.of(arm.0);
            let [_, _, rise] = section.of(own.axle.0);
            let roll = libm::asin(rise.clamp(-1.0, 1.0));
            row.extend([section.distance, height - radius, roll, own.spin]);
            for wheel in pair {
                wheel.merge();
                row.extend(wheel.values());
            }
        }
        for (column, value) in self.values.iter_mut().zip(row) {
            column.push(*value);
        }
    }

    /// Returns the values (SI) of the column with this name.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let index = self.columns.iter().position(|column| column.name == name)?;
        Some(&self.values[index])
    }
}
