//! The solids of bolster, side frames, wedges and springs, of any model that has them.
//!
//! Models have places, angles and toes, but hardly sizes of bodies: how far columns, pockets, chords and
//! seats reach is for the eye.

use std::collections::BTreeMap;

use mechanics::system::System;
use mechanics::vector::Vector;
use study::contacts::Corner;

use super::pressure::of_contacts;
use super::scene::{
    CoilEnd, FACTOR, Look, Scene, SceneBody, SceneCoil, SceneContact, Solid, SolidPose, SolidRole, extruded,
};

const INCH: f64 = 0.0254;
/// Length of the springs as drawn, m.
const SPRING: f64 = 8.0 * INCH;
/// Radius of the springs as drawn, m.
const SPRING_RADIUS: f64 = 1.6 * INCH;
/// Width of a side frame as drawn, m.
const FRAME: f64 = 8.0 * INCH;

/// Arrows of a face with four corners, over those of a face with one contact.
pub(super) const CORNER_ARROW: f64 = 0.6;

/// Bolster or side frame.
#[derive(Clone, Debug)]
pub(super) struct CarriagePart {
    /// Its name in the scene.
    pub id: String,
    /// Its name for people.
    pub name: String,
    /// Its origin in the nominal position, m.
    pub center: [f64; 3],
    /// The columns of its coordinates.
    pub coordinates: [Option<String>; 6],
    /// The columns of its travel.
    pub steady: [Option<String>; 3],
}

/// A wedge with what is drawn of it.
#[derive(Clone, Debug)]
pub(super) struct DrawnWedge {
    /// The suffix of its solids' names, such as its number.
    pub key: String,
    /// Its name for people.
    pub name: String,
    /// The body that moves.
    pub body: SceneBody,
    /// From the body's origin to the middle of the vertical face, body axes, m.
    pub offset: [f64; 3],
    /// The middle of the vertical face in the nominal position, m.
    pub point: [f64; 3],
    /// +1: the column lies ahead of it (+x), -1: behind.
    pub ahead: f64,
    /// Wedge angle from the vertical, rad.
    pub angle: f64,
    /// Angle of the slope's normal with the plane along the track, positive towards +y, rad.
    pub across: f64,
    /// Inclination of its right and its left side towards +y, by the height.
    pub leans: [f64; 2],
    /// The column's inclination against the vertical: a turn about y, rad.
    pub toe: f64,
    /// Depth of wear of the column along its normal, m.
    pub wear: f64,
    /// Height and width as drawn, m.
    pub size: [f64; 2],
    /// The bolster that carries its pocket: a place in [`Carriage::bolsters`].
    pub bolster: usize,
    /// The side frame of its column: a place in [`Carriage::side_frames`].
    pub side_frame: usize,
    /// True if it has a coil.
    pub has_coil: bool,
    /// True if the coil stands in the bolster's pocket.
    pub coil_in_bolster: bool,
    /// The column of its coil's force.
    pub coil_force: Option<String>,
}

impl DrawnWedge {
    /// Returns the name of the solid of its column.
    pub fn column(&self) -> String {
        format!("column_{}", self.key)
    }

    /// Returns the prism, its slope inclined across and its sides leaning.
    fn solid(&self) -> Solid {
        let [height, width] = self.size;
        let (ahead, half, length) = (self.ahead, 0.5 * height, self.length());
        let id = &self.body.id;
        let mut outline = [[0.0, -half], [-ahead * length, -half], [0.0, half]];
        if ahead > 0.0 {
            outline.swap(0, 1);
        }
        let mut solid = extruded((id, &self.name, SolidRole::Wedge, id), &outline, width);
        let (sine, cosine) = libm::sincos(self.angle);
        for [x, y, z] in &mut solid.vertices {
            let aside = libm::tan(self.across) * *y;
            *y += self.leans[usize::from(*y > 0.0)] * *z;
            if *z > 0.0 {
                *z += aside / sine;
            } else if *x != 0.0 {
                *x -= ahead * aside / cosine;
            }
        }
        Solid {
            mount: SolidPose {
                position: self.offset,
                angles: [0.0; 3],
            },
            ..solid
        }
    }

    /// Length of its bottom, m.
    fn length(&self) -> f64 {
        let (sine, cosine) = libm::sincos(self.angle);
        self.size[0] * sine / cosine
    }

    /// Returns the slope's normal towards the wedge, axes of the bolster.
    pub fn slope_normal(&self) -> [f64; 3] {
        let (sine, cosine) = libm::sincos(self.angle);
        let (tilt, level) = libm::sincos(self.across);
        [self.ahead * cosine * level, tilt, -sine * level]
    }

    /// Returns the middle of the slope, from the middle of the vertical face, m.
    pub fn middle_of_slope(&self) -> [f64; 3] {
        [-0.5 * self.ahead * self.length(), 0.0, 0.0]
    }
}

/// A spring between bolster and side frame.
#[derive(Clone, Debug)]
pub(super) struct DrawnSpring {
    /// Its name for people.
    pub name: String,
    /// Its place, x and y, m.
    pub at: [f64; 2],
    /// The bolster on it: a place in [`Carriage::bolsters`].
    pub bolster: usize,
    /// The side frame under it: a place in [`Carriage::side_frames`].
    pub side_frame: usize,
}

/// All of it.
#[derive(Clone, Debug)]
pub(super) struct Carriage {
    /// The bolsters.
    pub bolsters: Vec<CarriagePart>,
    /// The side frames.
    pub side_frames: Vec<CarriagePart>,
    /// The wedges.
    pub wedges: Vec<DrawnWedge>,
    /// The springs.
    pub springs: Vec<DrawnSpring>,
    /// The points at which side frames stand on axles: a place in [`Carriage::side_frames`], the point, m.
    pub axles: Vec<(usize, [f64; 3])>,
    /// The exaggerated size (m) beyond which displacements grow to scale.
    pub limit: f64,
}

pub(super) fn less(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

impl Carriage {
    /// Returns the scene, with these contacts; none without wedges.
    pub fn scene(&self, contacts: Vec<SceneContact>) -> Option<Scene> {
        let first = self.wedges.first()?;
        let [height, width] = first.size;
        let body = |part: &CarriagePart| SceneBody {
            id: part.id.clone(),
            position: part.center,
            coordinates: part.coordinates.clone(),
            steady: part.steady.clone(),
            ..SceneBody::default()
        };
        let mut scene = Scene {
            factor: FACTOR,
            limit: self.limit,
            arrow: 1.6 * height,
            looks: self.looks(height),
            bodies: self.bolsters.iter().chain(&self.side_frames).map(body).collect(),
            solids: Vec::new(),
            pressures: of_contacts(&contacts),
            contacts,
            ..Scene::default()
        };
        // Where bolster and springs end, below the wedges.
        let bottom = first.point[2] - 0.75 * height;
        let seat = bottom - SPRING;
        for (place, bolster) in self.bolsters.iter().enumerate() {
            let own: Vec<&DrawnWedge> = self.wedges.iter().filter(|w| w.bolster == place).collect();
            scene
                .solids
                .push(bolster_solid(bolster, &own, (bottom, height, width)));
        }
        for (place, side_frame) in self.side_frames.iter().enumerate() {
            let own: Vec<&DrawnWedge> = self.wedges.iter().filter(|w| w.side_frame == place).collect();
            let axles = self.axles.iter().filter(|(on, _)| *on == place);
            let axles: Vec<[f64; 3]> = axles.map(|(_, point)| *point).collect();
            scene
                .solids
                .extend(side_frame_solids(side_frame, &own, &axles, (seat, height)));
        }
        for spring in &self.springs {
            let (bolster, side_frame) = (
                &self.bolsters[spring.bolster],
                &self.side_frames[spring.side_frame],
            );
            let [x, y] = spring.at;
            scene.coils.push(SceneCoil {
                name: spring.name.clone(),
                from: CoilEnd {
                    body: side_frame.id.clone(),
                    point: less([x, y, seat], side_frame.center),
                },
                to: CoilEnd {
                    body: bolster.id.clone(),
                    point: less([x, y, bottom], bolster.center),
                },
                nominal_length: SPRING,
                free_length: SPRING,
                radius: SPRING_RADIUS,
                turns: 5.0,
                force: None,
                length: None,
            });
        }
        for wedge in &self.wedges {
            self.add_wedge(&mut scene, wedge, seat);
        }
        scene.round();
        Some(scene)
    }

    /// Corners of wedges at column and slope; `wedge_of` finds the wedge of a body.
    pub fn corners<'w>(
        &self,
        system: &System,
        corners: Vec<Corner>,
        wedge_of: impl Fn(usize) -> Option<&'w DrawnWedge>,
    ) -> Vec<SceneContact> {
        let contact = |corner: Corner| {
            let mounted = &system.faces()[corner.face];
            let wedge = wedge_of(mounted.body)?;
            let body = &system.bodies()[mounted.body];
            // Columns are those of the center of gravity; points count from the body's origin.
            let point = less(
                mounted.element.points[corner.point].position.0,
                body.center_of_gravity,
            );
            let name = &mounted.element.name;
            let (on, normal) = if name.ends_with("column") {
                (wedge.column(), [-wedge.ahead, 0.0, 0.0])
            } else if name.ends_with("split") {
                // A plane of the other half.
                let Vector(normal) = mounted.marker.rotation.apply(Vector([1.0, 0.0, 0.0]));
                (wedge_of(mounted.on)?.body.id.clone(), normal)
            } else {
                (self.bolsters[wedge.bolster].id.clone(), wedge.slope_normal())
            };
            Some(SceneContact {
                name: corner.name.replace('_', " "),
                body: wedge.body.id.clone(),
                point,
                on,
                normal,
                normal_force: format!("{}_normal_force", corner.name),
                friction: ["x", "y", "z"].map(|axis| format!("{}_friction_force_{axis}", corner.name)),
                state: format!("{}_state", corner.name),
                gap: None,
                id: corner.name,
            })
        };
        corners.into_iter().filter_map(contact).collect()
    }

    /// Column and slope of a wedge, each with one contact in its middle. `columns` gives the names of normal
    /// force, friction and state of a face.
    pub fn faces(
        &self,
        wedge: &DrawnWedge,
        columns: impl Fn(&str) -> (String, [String; 3], String),
    ) -> [SceneContact; 2] {
        let id = &wedge.body.id;
        let contact = |face: &str, point, on: String, normal| {
            let (normal_force, friction, state) = columns(face);
            SceneContact {
                id: format!("{id}_{face}"),
                name: format!("{}, {face}", wedge.name),
                body: id.clone(),
                point,
                on,
                normal,
                normal_force,
                friction,
                state,
                gap: None,
            }
        };
        let bolster = self.bolsters[wedge.bolster].id.clone();
        let (middle, slope) = (wedge.offset, wedge.middle_of_slope());
        let slope = std::array::from_fn(|k| middle[k] + slope[k]);
        [
            contact("column", middle, wedge.column(), [-wedge.ahead, 0.0, 0.0]),
            contact("slope", slope, bolster, wedge.slope_normal()),
        ]
    }

    /// The wedge in its pocket and its coil.
    fn add_wedge(&self, scene: &mut Scene, wedge: &DrawnWedge, seat: f64) {
        let [height, _] = wedge.size;
        let (bolster, side_frame) = (&self.bolsters[wedge.bolster], &self.side_frames[wedge.side_frame]);
        let (ahead, half, length) = (wedge.ahead, 0.5 * height, wedge.length());
        let id = &wedge.body.id;
        scene.bodies.push(wedge.body.clone());
        scene.solids.push(wedge.solid());

        if !wedge.has_coil {
            return;
        }
        let at = wedge.point[0] - 0.5 * ahead * length;
        let (on, foot) = if wedge.coil_in_bolster {
            // A seat in the pocket.
            let foot = wedge.point[2] - half - 0.6 * (wedge.point[2] - half - seat);
            let radius = 0.5 * length;
            scene.solids.push(Solid {
                mount: SolidPose {
                    position: less([at, wedge.point[1], foot], bolster.center),
                    angles: [0.0; 3],
                },
                ..extruded(
                    (
                        &format!("seat_{}", wedge.key),
                        "seat of the coil in the bolster",
                        SolidRole::Seat,
                        &bolster.id,
                    ),
                    &[
                        [-radius, -0.1 * height],
                        [radius, -0.1 * height],
                        [radius, 0.0],
                        [-radius, 0.0],
                    ],
                    2.0 * radius,
                )
            });
            (bolster, foot)
        } else {
            (side_frame, seat)
        };
        let nominal = wedge.point[2] - half - foot;
        let [x, y, z] = wedge.offset;
        scene.coils.push(SceneCoil {
            name: format!("control coil of {}", wedge.name),
            from: CoilEnd {
                body: on.id.clone(),
                point: less([at, wedge.point[1], foot], on.center),
            },
            to: CoilEnd {
                body: id.clone(),
                point: [x - 0.5 * ahead * length, y, z - half],
            },
            nominal_length: nominal,
            free_length: nominal,
            radius: 0.35 * length,
            turns: 5.0,
            force: wedge.coil_force.clone(),
            length: None,
        });
    }

    fn looks(&self, height: f64) -> Vec<Look> {
        let wedges = &self.wedges;
        let count = wedges.len().max(1) as f64;
        let middle: [f64; 3] =
            std::array::from_fn(|k| wedges.iter().map(|wedge| wedge.point[k]).sum::<f64>() / count);
        // Half the length and width of what is seen.
        let far = |points: &mut dyn Iterator<Item = [f64; 3]>, k: usize| {
            points.fold(6.0 * height, |most: f64, point| {
                most.max((point[k] - middle[k]).abs())
            })
        };
        let length = far(&mut self.axles.iter().map(|(_, point)| *point), 0);
        let width = far(&mut wedges.iter().map(|wedge| wedge.point), 1);
        let near = |name: &str, at: [f64; 3], radius: f64, from| Look {
            at: Some((at, radius)),
            ..Look::all(name, from)
        };
        let all = 0.85 * length.hypot(width);
        let mut looks = vec![
            near("Oblique", middle, all, [0.55, 0.9, 0.42]),
            near("Left side", middle, 1.1 * length, [0.0, 1.0, 0.0]),
            near("Along the track", middle, 1.2 * width, [-1.0, 0.0, 0.0]),
            near("Top", middle, all, [0.0, 0.0, 1.0]),
        ];
        if let Some(first) = wedges.first() {
            let name = crate::figures::capital(&first.name);
            looks.push(near(&name, first.point, 2.2 * height, [0.12, 1.0, 0.12]));
        }
        looks
    }
}

/// Returns a beam across the track, whose sides are the slopes.
fn bolster_solid(
    part: &CarriagePart,
    own: &[&DrawnWedge],
    (bottom, height, width): (f64, f64, f64),
) -> Solid {
    let center = part.center;
    let side = |ahead: bool| -> Option<[[f64; 2]; 2]> {
        let wedge = own.iter().find(|wedge| (wedge.ahead > 0.0) == ahead)?;
        let (sine, cosine) = libm::sincos(wedge.angle);
        // The slope's line from the top of the wedge down.
        let at = |z: f64| {
            let below = wedge.point[2] + 0.5 * height - z;
            let behind = below * sine / cosine;
            [wedge.point[0] - wedge.ahead * behind - center[0], z - center[2]]
        };
        Some([at(bottom), at(wedge.point[2] + 0.4 * height)])
    };
    let half = |k: usize, corner: usize| -> [f64; 2] {
        let own = side(k == 1);
        own.map_or_else(
            || [[-0.1, 0.1][k], [bottom, bottom + height][corner] - center[2]],
            |ends| ends[corner],
        )
    };
    let ys: Vec<f64> = own.iter().map(|wedge| wedge.point[1] - center[1]).collect();
    let reach = ys.iter().fold(0.0, |most: f64, y| most.max(y.abs()));
    Solid {
        name: part.name.clone(),
        ..extruded(
            (&part.id, "", SolidRole::Pocket, &part.id),
            &[half(0, 0), half(1, 0), half(1, 1), half(0, 1)],
            2.0 * reach + 1.1 * width.max(10.0 * INCH),
        )
    }
}

/// Columns, seat of the springs, top chord and arms to the axles.
fn side_frame_solids(
    part: &CarriagePart,
    own: &[&DrawnWedge],
    axles: &[[f64; 3]],
    (seat, height): (f64, f64),
) -> Vec<Solid> {
    let (center, id) = (part.center, part.id.as_str());
    let thick = 0.5 * height;
    let Some(first) = own.first() else {
        return Vec::new();
    };
    let middle_z = first.point[2] - center[2];
    let (top, low) = (middle_z + 1.1 * height, seat - center[2]);
    let mut solids = Vec::new();
    for wedge in own {
        // The face is where the wedge's is but for its wear, and turns about its middle.
        let ends = [0.0, wedge.ahead * thick];
        let (from, to) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let (above, below) = (0.95 * height, wedge.point[2] - seat);
        let (sine, cosine) = libm::sincos(wedge.toe);
        let worn = [
            wedge.ahead * wedge.wear * cosine,
            0.0,
            -wedge.ahead * wedge.wear * sine,
        ];
        let face: [f64; 3] = std::array::from_fn(|k| wedge.point[k] + worn[k]);
        solids.push(Solid {
            mount: SolidPose {
                position: less(face, center),
                angles: [0.0, wedge.toe, 0.0],
            },
            ..extruded(
                (
                    &wedge.column(),
                    &format!("column at {}", wedge.name),
                    SolidRole::Column,
                    id,
                ),
                &[[from, -below], [to, -below], [to, above], [from, above]],
                (1.1 * FRAME).max(1.1 * wedge.size[1]),
            )
        });
    }
    let y = first.point[1] - center[1];
    let block = |what: &str, [from, to]: [f64; 2], [below, above]: [f64; 2]| Solid {
        mount: SolidPose {
            position: [0.0, y, 0.0],
            angles: [0.0; 3],
        },
        ..extruded(
            (
                &format!("{id}_{what}"),
                &format!("{what} of the side frame"),
                if what == "seat" {
                    SolidRole::Seat
                } else {
                    SolidRole::Column
                },
                id,
            ),
            &[[from, below], [to, below], [to, above], [from, above]],
            FRAME,
        )
    };
    let faces = own.iter().map(|wedge| wedge.point[0] - center[0]);
    let (back, front) = faces.fold((0.0, 0.0), |(low, high): (f64, f64), x| (low.min(x), high.max(x)));
    let (back, front) = (back - thick, front + thick);
    solids.push(block("seat", [back, front], [low - 0.3 * height, low]));
    let mut chord = block("chord", [back, front], [top, top + 0.4 * height]);
    let mut arms: BTreeMap<bool, (f64, f64)> = BTreeMap::new();
    for axle in axles {
        let [x, _, z] = less(*axle, center);
        arms.insert(x > 0.0, (x, z));
    }
    for (ahead, (x, z)) in arms {
        let ends = if ahead {
            [front, x + thick]
        } else {
            [x - thick, back]
        };
        chord.join(block("arm", ends, [z, top + 0.4 * height]));
    }
    solids.push(chord);
    solids
}
