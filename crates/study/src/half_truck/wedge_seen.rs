//! The observation of a wedge, massless or a body.

use mechanics::system::{ContactState, FaceState, Observation, System};
use mechanics::vector::Vector;
use wedge::parameters::Damping;

use super::HalfTruckCase;
use super::wedge_bodies::MountedWedge;

/// A wedge of the model.
#[derive(Clone, Debug)]
pub(super) enum Source {
    /// A massless one: its connection.
    Massless(usize),
    /// A body.
    Body(Box<MountedWedge>),
}

/// A wedge at one instant, SI.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SeenWedge {
    /// Friction of the column on the side frame, positive up.
    pub column_friction: f64,
    pub column_normal: f64,
    pub slope_normal: f64,
    /// Friction of the slope on the wedge, positive up the slope.
    pub slope_friction: f64,
    /// Force of the coil, positive pushing.
    pub coil: f64,
    /// Force on the side frame, x, y, z: column, and the coil where it stands on the side frame.
    pub force: [f64; 3],
    /// Power of the column's friction.
    pub friction_power: f64,
    /// Rise in the pocket.
    pub rise: f64,
    pub jammed: bool,
    /// Contact state of the column.
    pub state: Option<ContactState>,
}

impl HalfTruckCase {
    /// Returns the places of the connections that are wedges, massless ones and bodies, in their order.
    #[must_use]
    pub fn wedges(&self) -> Vec<usize> {
        let mut places: Vec<usize> = self.truck.wedges().collect();
        places.extend(self.wedge_bodies.iter().map(|wedge| wedge.connection));
        places.sort_unstable();
        places
    }

    /// Returns the wedge body of a connection, if it has one.
    #[must_use]
    pub fn wedge_body(&self, connection: usize) -> Option<&MountedWedge> {
        self.wedge_bodies
            .iter()
            .find(|wedge| wedge.connection == connection)
    }

    /// Returns the wedge of a connection.
    pub(super) fn source(&self, connection: usize) -> Source {
        match self.wedge_body(connection) {
            Some(wedge) => Source::Body(Box::new(wedge.clone())),
            None => Source::Massless(connection),
        }
    }
}

impl Source {
    /// Returns the wedge at an observation.
    pub fn at(&self, seen: &Observation) -> SeenWedge {
        match self {
            Self::Massless(place) => massless(seen, *place),
            Self::Body(wedge) => body(seen, wedge),
        }
    }
}

fn massless(seen: &Observation, place: usize) -> SeenWedge {
    let own = &seen.connections[place];
    let inside = own.wedge.unwrap_or_default();
    // Vertical and lateral, or vertical, longitudinal and lateral.
    let [z, x, y] = match own.forces[..] {
        [z, y] => [z, 0.0, y],
        [z, x, y] => [z, x, y],
        _ => [0.0; 3],
    };
    SeenWedge {
        column_friction: -inside.column_friction,
        column_normal: inside.column_normal,
        slope_normal: inside.slope_normal,
        slope_friction: inside.slope_friction,
        coil: inside.coil_force,
        force: [x, y, z],
        friction_power: inside.column_friction * own.velocities[0],
        rise: inside.rise,
        jammed: inside.jammed,
        state: own.contact_state,
    }
}

fn body(seen: &Observation, wedge: &MountedWedge) -> SeenWedge {
    let [column, slope] = wedge.faces.map(|face| &seen.faces[face]);
    let normal = |face: &FaceState| face.points.iter().map(|point| point.normal).sum();
    let friction = total(&column.friction_forces);
    let coil = seen.elements[wedge.coil].force;
    let mut force = -(friction + total(&column.normal_forces));
    if wedge.damping == Damping::Variable {
        force = force - coil;
    }
    let (sine, cosine) = libm::sincos(wedge.wedge.angle);
    let up_slope = Vector([wedge.end * sine, 0.0, cosine]);
    // The rise against the pocket, at the wedge's place in the drawn layout.
    let bolster = &seen.bodies[wedge.bolster];
    let arm = Vector(wedge.center) - (bolster.origin - bolster.travel);
    let pocket = bolster.origin + bolster.rotation.apply::<f64, f64>(arm);
    SeenWedge {
        column_friction: -friction.0[2],
        column_normal: normal(column),
        slope_normal: normal(slope),
        slope_friction: total(&slope.friction_forces).dot::<f64, f64>(up_slope),
        coil: coil.0[2],
        force: force.0,
        friction_power: column.friction_power,
        rise: (seen.bodies[wedge.body].center_of_gravity - pocket).0[2],
        jammed: false,
        state: Some(column.contact_state()),
    }
}

/// Returns the moment (fixed axes, N·m) of the column's forces on a wedge's body about its center of gravity.
pub(super) fn column_moment(seen: &Observation, wedge: &MountedWedge) -> [f64; 3] {
    let (face, center) = (
        &seen.faces[wedge.faces[0]],
        seen.bodies[wedge.body].center_of_gravity,
    );
    let forces = face.normal_forces.iter().zip(&face.friction_forces);
    let mut moment = Vector::zero();
    for (place, (normal, friction)) in face.point_positions.iter().zip(forces) {
        moment += (*place - center).cross::<f64, f64>(*normal + *friction);
    }
    moment.0
}

/// Returns the place of the loss of a face's friction among the energy terms.
pub(super) fn friction_loss(system: &System, face: usize) -> Option<usize> {
    let [place, _] = system.faces().get(face)?.energy_terms;
    place
}

fn total(forces: &[Vector<f64>]) -> Vector<f64> {
    forces.iter().fold(Vector::zero(), |sum, force| sum + *force)
}
