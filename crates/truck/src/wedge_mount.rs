//! A wedge with mass between a pocket and a column: its body, its two faces, its control coil and the sides
//! of its pocket. Trucks mount four of them; so can any model that has a body with a pocket and a body with a
//! column.

use std::f64::consts::{FRAC_PI_2, PI};

use mechanics::body::Body;
use mechanics::coil::{Coil, CoilLine};
use mechanics::contact::{ContactFace, ContactPoint, Interface};
use mechanics::elements::Stop;
use mechanics::frame::Frame;
use mechanics::link::Marker;
use mechanics::orientation::fixed;
use mechanics::surface::Plane;
use mechanics::system::Model;
use mechanics::vector::Vector;
use wedge::face::{FaceProperties, Rectangle};
use wedge::parameters::{Contact, ControlCoil as ThesisCoil, Damping, FaceFriction};

use crate::elements::{Law, Role, Suspended, join};
use crate::parameters::{ControlCoil, Wedge};

/// The place of a wedge in a model with all its bodies, at rest in their nominal places. Its neighbors stand
/// along the fixed axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WedgeMount<'n> {
    /// Its name, with which those of its elements begin.
    pub name: &'n str,
    /// The number of its body.
    pub body: usize,
    /// The number of the body with the column.
    pub side_frame: usize,
    /// The number of the body with the pocket.
    pub bolster: usize,
    /// The place of its coil: in the pocket (constant) or on the body with the column (variable).
    pub damping: Damping,
    /// +1: the column lies ahead of it (+x), -1: behind.
    pub end: f64,
    /// Its center of gravity in the nominal layout, from [`WedgeMount::from`], m.
    pub center: [f64; 3],
    /// The place from which its center of gravity is counted, m.
    pub from: [f64; 3],
    /// Shifts of column and slope along their normals, m.
    pub gaps: [f64; 2],
}

/// The elements of a wedge by their numbers in the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WedgeElements {
    /// Column and slope, among the faces.
    pub faces: [usize; 2],
    /// The control coil among the elements; `None` without one, and for a coil of the thesis, which is among
    /// the coils.
    pub coil: Option<usize>,
    /// The sides of the pocket, among the elements.
    pub pocket_sides: usize,
}

/// Returns the body of a wedge whose center of gravity is at `center` (m) in the nominal layout; `end` is +1
/// where its column lies ahead of it, else -1.
#[must_use]
pub fn wedge_body(name: &str, wedge: &Wedge, center: [f64; 3], end: f64) -> Body {
    let to_center = wedge.origin_to_center(end);
    let mut body = Body::free(name, wedge.mass, wedge.inertia, [0.0; 6]);
    body.frame = Frame::fixed(std::array::from_fn(|k| center[k] - to_center[k]), [0.0; 3]);
    body.free = wedge.free;
    body.center_of_gravity = to_center;
    body
}

/// Adds faces, control coil and pocket sides of a wedge to a model.
pub fn add_wedge(model: &mut Model, wedge: &Wedge, at: &WedgeMount<'_>) -> WedgeElements {
    let (face, element) = (model.faces.len(), model.elements.len());
    let suspension = attach(model, wedge, at);
    join(model, &suspension);
    let place = |role: Role| suspension.iter().position(|own| own.role == role);
    WedgeElements {
        faces: [face, face + 1],
        coil: place(Role::ControlCoil).map(|place| element + place),
        pocket_sides: element + place(Role::PocketSide).unwrap_or_default(),
    }
}

/// The position of a wedge, or of a half of one, in its pocket.
pub(crate) struct Lies {
    /// The direction in which a positive angle across pushes it: +1 to +y, -1 to -y.
    pub pushed: f64,
    /// Clearances of its pocket's sides towards -y and +y, m.
    pub sides: [f64; 2],
    /// Offset of the control coil towards +y from its center of gravity, m.
    pub coil: f64,
}

impl Lies {
    /// Returns a wedge that has its pocket for itself.
    fn alone(wedge: &Wedge, at: &WedgeMount<'_>) -> Self {
        Self {
            pushed: outboard(at.center[1]),
            sides: [wedge.pocket_sides.clearance; 2],
            coil: 0.0,
        }
    }
}

/// Returns which way is outboard at a lateral place: +1 at the left, -1 at the right.
pub(crate) fn outboard(y: f64) -> f64 {
    if y < 0.0 { -1.0 } else { 1.0 }
}

/// Adds the faces of a wedge, and its coil if it is that of the thesis; returns the other elements.
pub(crate) fn attach(model: &mut Model, wedge: &Wedge, at: &WedgeMount<'_>) -> Vec<Suspended> {
    attach_lying(model, wedge, at, &Lies::alone(wedge, at))
}

/// Returns the same of a wedge that lies in its pocket as said.
pub(crate) fn attach_lying(
    model: &mut Model,
    wedge: &Wedge,
    at: &WedgeMount<'_>,
    lies: &Lies,
) -> Vec<Suspended> {
    let ([x, y, z], end, name) = (at.center, at.end, at.name);
    let length = wedge.height * libm::tan(wedge.angle);
    let middle = z + wedge.height / 6.0;
    let column = x + end * (length / 3.0);
    // Wedges at the leading end are turned by half a turn about z, and so are the normals that they meet.
    let pitch = |pitch: f64| if end > 0.0 { PI - pitch } else { pitch };
    let [column_gap, slope_gap] = at.gaps;
    let faces = [
        (
            at.side_frame,
            "column",
            column,
            pitch(wedge.toe),
            wedge.wear.column + column_gap,
            (&wedge.column_friction, &wedge.column_face),
        ),
        (
            at.bolster,
            "slope",
            column - end * (0.5 * length),
            pitch(PI - wedge.angle),
            wedge.wear.slope + slope_gap,
            (&wedge.slope_friction, &wedge.slope_face),
        ),
    ];
    for (on, face, x, pitch, gap, (friction, properties)) in faces {
        let [of_column, of_slope] = wedge.rectangles();
        let (rectangle, across) = match face {
            "column" => (of_column, 0.0),
            _ => (of_slope, wedge.slope_across * lies.pushed),
        };
        let mut points = contact_points(wedge, properties, end, &rectangle);
        incline(&mut points, wedge, end, across);
        for point in &mut points {
            point.position = Vector(in_axes_of(&model.bodies[at.body], point.position.0));
        }
        let friction = properties.friction(friction);
        // The normal is the marker's x axis.
        let (sine, cosine) = libm::sincos(pitch);
        let (tilt, level) = libm::sincos(across);
        let surface = [
            x - gap * (cosine * level),
            y - gap * tilt,
            middle + gap * (sine * level),
        ];
        let place = std::array::from_fn(|k| surface[k] + at.from[k]);
        let marker = model.bodies[on].marker(place, [0.0, pitch, across]);
        let interface = properties.interface(&friction, reversed(face == "column", end));
        if interface != Interface::default() {
            model.interfaces.push((model.faces.len(), interface));
        }
        let face = plane(format!("{name}_{face}"), points, &friction);
        model.faces.push((at.body, on, marker, face));
    }
    let seat = match at.damping {
        Damping::Constant => at.bolster,
        Damping::Variable => at.side_frame,
    };
    let bottom = [x, y + lies.coil, z - wedge.height / 3.0];
    let coil_name = format!("{name}_control_coil");
    let law = match &wedge.control_coil {
        ControlCoil::Shear(spring) => Some(Law::Spring(spring.law(coil_name))),
        ControlCoil::Table(spring) => Some(Law::Table(spring.named(coil_name))),
        ControlCoil::Thesis(coil, _) => {
            thesis_coil(model, at, seat, wedge.origin_to_center(end), coil);
            None
        }
        ControlCoil::Nothing => None,
    };
    let coil = law.map(|law| Suspended {
        role: Role::ControlCoil,
        law,
        ends: [at.body, seat].map(|body| at.marker(model, body, bottom, 0.0)),
    });
    let sides = Stop {
        name: format!("{name}_pocket_sides"),
        clearances: lies.sides,
        stiffness: wedge.pocket_sides.stiffness,
        damping: wedge.pocket_sides.damping,
    };
    let ends = [
        at.marker(model, at.body, at.center, 0.0),
        at.marker(model, at.bolster, at.center, FRAC_PI_2),
    ];
    let sides = Suspended {
        role: Role::PocketSide,
        law: Law::Stop(sides),
        ends,
    };
    coil.into_iter().chain([sides]).collect()
}

impl WedgeMount<'_> {
    /// Returns the marker of a body at a place (m), turned about z (rad).
    pub(crate) fn marker(&self, model: &Model, body: usize, at: [f64; 3], yaw: f64) -> (usize, Marker) {
        let place = std::array::from_fn(|k| at[k] + self.from[k]);
        (body, model.bodies[body].marker(place, [0.0, 0.0, yaw]))
    }
}

/// Returns a vector along the fixed axes in the axes of a body in its nominal place.
pub(crate) fn in_axes_of(body: &Body, vector: [f64; 3]) -> [f64; 3] {
    if body.frame.orientation == [0.0; 3] {
        return vector;
    }
    let own: Vector<f64> = fixed(body.frame.orientation).apply_transposed(Vector(vector));
    own.0
}

/// Adds the coil of Steets (2007), which ends at the wedge's origin; the center of gravity is `to_center` (m)
/// from there.
fn thesis_coil(model: &mut Model, at: &WedgeMount<'_>, seat: usize, to_center: [f64; 3], coil: &ThesisCoil) {
    let law = Coil {
        end: Vector::zero(),
        acts_at: match coil.acts_at {
            CoilLine::CenterOfGravity => Vector(in_axes_of(&model.bodies[at.body], to_center)),
            CoilLine::Seat => Vector::zero(),
        },
        law: coil.law.clone(),
        free_length: coil.free_length,
        damping: coil.damping,
        rotational_damping: coil.rotational_damping,
        pulls: coil.pulls,
    };
    let mut foot: [f64; 3] = std::array::from_fn(|k| at.center[k] - to_center[k]);
    foot[2] -= coil.nominal_length;
    let (seat, marker) = at.marker(model, seat, foot, 0.0);
    model.coils.push((at.body, seat, marker, law));
}

/// Returns whether the z and y axes of a face's marker point down and to the right of the wedge, which has
/// its column ahead (`end` +1) or behind (-1): z points down where the marker is pitched beyond a right
/// angle, and a wedge that is turned by half a turn has its left on the right.
#[must_use]
pub fn reversed(is_column: bool, end: f64) -> [bool; 2] {
    [is_column == (end > 0.0), end > 0.0]
}

impl Wedge {
    /// Returns its faces, column and slope, in its own axes from its center of gravity.
    #[must_use]
    pub fn rectangles(&self) -> [Rectangle; 2] {
        let length = self.height * libm::tan(self.angle);
        let [column, slope] = [-1.0, 2.0].map(|lower| lower * length / 3.0);
        [(column, true), (slope, false)].map(|(lower, faces_backward)| Rectangle {
            lower: [lower, -self.height / 3.0],
            upper: [-length / 3.0, 2.0 * self.height / 3.0],
            width: self.width,
            faces_backward,
        })
    }
}

/// Returns the points of a wedge's face.
fn contact_points(
    wedge: &Wedge,
    face: &FaceProperties,
    end: f64,
    rectangle: &Rectangle,
) -> Vec<ContactPoint> {
    let to_center = wedge.origin_to_center(end);
    let mut points = face.points(rectangle, &wedge.contact);
    for point in &mut points {
        let Vector([x, y, z]) = point.position;
        let own = [-end * x, -end * y, z];
        point.position = Vector(std::array::from_fn(|k| own[k] + to_center[k]));
    }
    points
}

/// Moves the points of a slope that is inclined across by `across` (rad, positive towards +y) from the plane
/// without that angle onto it: those of the lower edge stay on the bottom, those of the upper edge on the
/// vertical face, those between go both ways.
fn incline(points: &mut [ContactPoint], wedge: &Wedge, end: f64, across: f64) {
    if across == 0.0 {
        return;
    }
    let tangent = libm::tan(across);
    let (sine, cosine) = libm::sincos(wedge.angle);
    let [_, y, z] = wedge.origin_to_center(end);
    for point in points {
        let Vector(place) = &mut point.position;
        let aside = tangent * (place[1] - y);
        let up = (place[2] - z) / wedge.height + 1.0 / 3.0;
        place[0] -= (1.0 - up) * end * aside / cosine;
        place[2] += up * aside / sine;
    }
}

pub(crate) fn point(place: [f64; 3], contact: &Contact, share: f64) -> ContactPoint {
    ContactPoint {
        position: Vector(place),
        stiffness: contact.stiffness,
        damping: contact.damping,
        share,
    }
}

pub(crate) fn plane(name: String, points: Vec<ContactPoint>, friction: &FaceFriction) -> ContactFace<Plane> {
    ContactFace {
        name,
        points,
        surface: Plane,
        coefficient: friction.coefficient,
        law: friction.law,
    }
}
