//! The split wedge: two halves beside each other across the truck, each a rigid body.
//!
//! Each half leans on three planes: its half of the slope, its half of the column, and the side of the pocket
//! on its side. The slopes of the halves are inclined across in opposite senses, so that the control coil
//! presses the halves apart, against the sides (`slope_across` positive), or together (negative). Between
//! them is a plane with friction, vertical or inclined: an outboard half that leans over the inboard one is
//! carried and pushed outboard by it.
//!
//! Without friction a half that the coil presses with F has the normal force N_s = F / (sin θ cos β) on its
//! slope and the thrust F tan β / sin θ across; where halves are pressed together, that thrust is N cos γ of
//! the plane between them, and N sin γ of their loads goes over.
//!
//! Source: the patent application CA 2,554,935 tells of a pair of split wedges in one pocket, whose sloped
//! surfaces have a taper across, so that each bears on slope, column and side wall of the pocket; it gives no
//! sizes. The plane between the halves and its inclination are a general form of ours.
//!
//! Limits: the sides of the pocket have no friction, as those of other wedges; faces stay rectangular
//! whatever the inclination between the halves; each half has profiles, grids and maps of a face for itself.

use std::f64::consts::FRAC_PI_2;

use mechanics::coil::CoilLaw;
use mechanics::contact::ContactFace;
use mechanics::friction::FrictionLaw;
use mechanics::surface::Plane;
use mechanics::system::Model;
use wedge::face::FaceProperties;
use wedge::parameters::{Contact, FaceFriction};

use crate::assemble::{INBOARD_HALVES, WEDGES};
use crate::elements::Suspended;
use crate::parameters::{ControlCoil, Parameters, Spring, Wedge, WedgeKind};
use crate::wedge_mount::{Lies, WedgeMount, attach_lying, in_axes_of, outboard, plane, point};
use crate::{PLACES, WEDGE_NAMES};

/// The halves in the order of all arrays of two.
pub const HALVES: [&str; 2] = ["outboard", "inboard"];

/// Ways of the halves from the wedge's middle: outboard, inboard.
pub(crate) const WAYS: [f64; 2] = [1.0, -1.0];

/// A wedge in one piece, or a half of a split one.
#[derive(Clone, Debug)]
pub struct WedgePart {
    /// Its name: that of the wedge, and outboard or inboard.
    pub name: String,
    /// The number of its body in the truck.
    pub number: usize,
    /// The wedge to which it belongs.
    pub wedge: usize,
    /// Offset of its center of gravity towards +y from that of the wedge, m.
    pub shift: f64,
    /// It as a wedge in one piece.
    pub own: Wedge,
}

impl WedgePart {
    /// Returns the direction in which a positive angle across pushes it: +1 to +y, -1 to -y.
    #[must_use]
    pub fn pushed(&self) -> f64 {
        if self.shift == 0.0 {
            return PLACES[self.wedge][1];
        }
        self.shift.signum()
    }

    /// Returns the inclinations of its right and its left side towards +y, by the height: those of the plane
    /// between halves.
    #[must_use]
    pub fn leans(&self) -> [f64; 2] {
        let lean = -PLACES[self.wedge][1] * libm::tan(self.own.split.angle);
        if self.shift == 0.0 {
            return [0.0; 2];
        }
        if self.shift > 0.0 {
            [lean, 0.0]
        } else {
            [0.0, lean]
        }
    }
}

impl Parameters {
    /// Returns the wedges by what they consist of: wedges in one piece and outboard halves in the order of
    /// [`WEDGE_NAMES`], then inboard halves.
    #[must_use]
    pub fn wedge_parts(&self) -> Vec<WedgePart> {
        let half = |half: usize, wedge: usize| WedgePart {
            name: format!("{}_{}", WEDGE_NAMES[wedge], HALVES[half]),
            number: [WEDGES, INBOARD_HALVES][half] + wedge,
            wedge,
            shift: WAYS[half] * PLACES[wedge][1] * self.wedges[wedge].half_shift(),
            own: self.wedges[wedge].halves()[half].clone(),
        };
        let is_split = |wedge: usize| self.wedges[wedge].kind == WedgeKind::Split;
        let first = (0..4).map(|wedge| match is_split(wedge) {
            true => half(0, wedge),
            false => WedgePart {
                name: WEDGE_NAMES[wedge].to_owned(),
                number: WEDGES + wedge,
                wedge,
                shift: 0.0,
                own: self.wedges[wedge].clone(),
            },
        });
        let inboard = (0..4)
            .filter(|wedge| is_split(*wedge))
            .map(|wedge| half(1, wedge));
        first.chain(inboard).collect()
    }
}

impl Wedge {
    /// Returns the halves of a split wedge, outboard and inboard: each as a wedge in one piece. About the
    /// axes along the track and upwards the whole has the inertia of both halves about their own centers and
    /// that of their distance from its middle.
    #[must_use]
    pub fn halves(&self) -> [Self; 2] {
        let share = self.split.outboard_share;
        [share, 1.0 - share].map(|share| {
            let mass = share * self.mass;
            let shift = mass * self.half_shift() * self.half_shift();
            let [roll, pitch, yaw] = self.inertia.map(|inertia| share * inertia);
            Self {
                kind: WedgeKind::Body,
                width: 0.5 * self.width,
                mass,
                inertia: [roll - shift, pitch, yaw - shift],
                contact: half_contact(&self.contact),
                column_friction: half_friction(&self.column_friction),
                slope_friction: half_friction(&self.slope_friction),
                column_face: half_face(&self.column_face),
                slope_face: half_face(&self.slope_face),
                control_coil: half_coil(&self.control_coil),
                ..self.clone()
            }
        })
    }

    /// Returns the distances of the halves' centers of gravity from the wedge's middle across, m.
    #[must_use]
    pub fn half_shift(&self) -> f64 {
        0.25 * self.width
    }
}

fn half_contact(whole: &Contact) -> Contact {
    Contact {
        stiffness: 0.5 * whole.stiffness,
        damping: 0.5 * whole.damping,
    }
}

fn half_friction(whole: &FaceFriction) -> FaceFriction {
    FaceFriction {
        law: match whole.law {
            FrictionLaw::Bristle { stiffness, damping } => FrictionLaw::Bristle {
                stiffness: 0.5 * stiffness,
                damping: 0.5 * damping,
            },
            law @ FrictionLaw::Tanh { .. } => law,
        },
        ..*whole
    }
}

fn half_face(whole: &FaceProperties) -> FaceProperties {
    let mut half = whole.clone();
    half.friction_half_load = whole.friction_half_load.map(|load| 0.5 * load);
    if let Some(pad) = &mut half.pad {
        pad.stiffness *= 0.5;
        pad.damping *= 0.5;
        pad.shear = pad.shear.map(|values| values.map(|value| 0.5 * value));
    }
    half
}

fn half_coil(whole: &ControlCoil) -> ControlCoil {
    let mut half = whole.clone();
    match &mut half {
        ControlCoil::Shear(spring) => {
            *spring = Spring {
                preload: 0.5 * spring.preload,
                stiffness: 0.5 * spring.stiffness,
                shear_stiffness: 0.5 * spring.shear_stiffness,
                damping: 0.5 * spring.damping,
                solid: spring.solid.map(|[travel, stiffness]| [travel, 0.5 * stiffness]),
            }
        }
        ControlCoil::Thesis(coil, _) => {
            coil.damping *= 0.5;
            coil.rotational_damping *= 0.5;
            coil.law = match &coil.law {
                CoilLaw::Linear { stiffness } => CoilLaw::Linear {
                    stiffness: 0.5 * stiffness,
                },
                CoilLaw::Given { force } => CoilLaw::Given { force: 0.5 * force },
                CoilLaw::Table(table) => CoilLaw::Table(table.clone()),
            };
        }
        ControlCoil::Table(_) | ControlCoil::Nothing => {}
    }
    half
}

/// The place of a split wedge in a model: as [`WedgeMount`], with the bodies of both halves.
pub(crate) struct SplitMount<'n> {
    pub whole: WedgeMount<'n>,
    pub bodies: [usize; 2],
}

/// Adds the faces of both halves and the plane between them; returns the other elements.
pub(crate) fn attach(model: &mut Model, wedge: &Wedge, at: &SplitMount<'_>) -> Vec<Suspended> {
    let way = outboard(at.whole.center[1]);
    let mut all = Vec::new();
    for (half, (own, sign)) in wedge.halves().iter().zip(WAYS).enumerate() {
        let name = format!("{}_{}", at.whole.name, HALVES[half]);
        let mut center = at.whole.center;
        center[1] += sign * way * wedge.half_shift();
        let mount = WedgeMount {
            name: &name,
            body: at.bodies[half],
            center,
            ..at.whole
        };
        let free = f64::INFINITY;
        let clearance = wedge.pocket_sides.clearance;
        let lies = Lies {
            pushed: sign * way,
            sides: if sign * way > 0.0 {
                [free, clearance]
            } else {
                [clearance, free]
            },
            coil: sign * way * (wedge.split.coil_distance - wedge.half_shift()),
        };
        all.extend(attach_lying(model, own, &mount, &lies));
    }
    let face = between(model, wedge, at);
    model.faces.push(face);
    all
}

/// Returns the plane between the halves: a plane of the inboard half, which the corners of the outboard
/// half's inner side touch. It has the stiffness of a half's face.
fn between(
    model: &Model,
    wedge: &Wedge,
    at: &SplitMount<'_>,
) -> (usize, usize, mechanics::link::Marker, ContactFace<Plane>) {
    let ([x, y, z], end, way) = (at.whole.center, at.whole.end, outboard(at.whole.center[1]));
    let [carried, on] = at.bodies;
    let (sine, cosine) = libm::sincos(wedge.split.angle);
    let length = wedge.height * libm::tan(wedge.angle);
    let third = wedge.height / 3.0;
    let contact = half_contact(&wedge.contact);
    let middle = z + 0.5 * third;
    let corner = Contact {
        stiffness: 4.0 / 3.0 * contact.stiffness,
        damping: 4.0 / 3.0 * contact.damping,
    };
    // Column and toe at the bottom, column at the top.
    let corners = [
        [x + end * length / 3.0, z - third],
        [x - end * 2.0 * length / 3.0, z - third],
        [x + end * length / 3.0, z + 2.0 * third],
    ];
    let to_center = wedge.origin_to_center(end);
    let center = [x, y + way * wedge.half_shift(), z];
    let points = corners.map(|[x, z]| {
        let place = [x, y - way * (z - middle) * sine / cosine, z];
        let own = std::array::from_fn(|k| place[k] - center[k] + to_center[k]);
        point(in_axes_of(&model.bodies[carried], own), &corner, 1.0 / 3.0)
    });
    // The normal, which is the marker's x axis, points outboard and up.
    let gap = wedge.split.gap;
    let place = [x, y - way * gap * cosine, middle - gap * sine];
    let place = std::array::from_fn(|k| place[k] + at.whole.from[k]);
    let angles = [0.0, -FRAC_PI_2, way * (FRAC_PI_2 - wedge.split.angle)];
    let marker = model.bodies[on].marker(place, angles);
    let name = format!("{}_split", at.whole.name);
    let friction = half_friction(&wedge.split.friction);
    (carried, on, marker, plane(name, points.to_vec(), &friction))
}
