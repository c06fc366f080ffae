//! Bodies and elements put together: the equations of motion as a problem for the integrator.
//!
//! State vector `(q, u, s, w)`: free coordinates of all free bodies, their rates, internal states of the
//! elements (bristle deflections), and quadratures (work of the prescribed motions, every dissipation). SI
//! units.

mod applied_load;
mod assembler;
mod build;
mod chain;
mod contact_losses;
mod contact_states;
mod contacts;
mod eigenvalues;
mod energies;
mod equilibrium;
mod error_bounds;
mod evaluation;
mod forces;
mod inputs;
mod jacobian;
mod jacobian_vector_product;
mod kinematics;
mod linear_model;
mod loads;
mod model;
mod mounted;
mod observe;
mod relative;
mod spectral_radius;
mod time;
mod vibration;

use std::ops::Range;

use integrate::{DiscontinuityFunctions, EventGroup, Problem, ProblemStructure};
use numerics::Singular;
use numerics::partitioned::{Layout, Partitioned, Structure};

use self::jacobian::Gathered;
use crate::body::{Body, Kinematics, Rigid};
use crate::coil::Coil;
use crate::connection::{Connection, Connections, FRICTION_VARIABLES, FrictionVariables};
use crate::contact::{ContactFace, Interface};
use crate::element::Marked;
use crate::frame::FrameMotion;
use crate::friction::FrictionLaw;
use crate::link::Marker;
use crate::motion::Motion;
use crate::vector::Vector;

pub use crate::contact_state::{ContactState, SLIP_LOAD, STICK_LOAD};
pub use crate::energy::{Energies, EnergyTerm, EnergyTermKind};
use crate::parts::Parts;
pub use applied_load::AppliedLoad;
use applied_load::MountedLoad;
pub use contact_states::{CLOSING_GAP, OPENING_GAP};
pub use contacts::Contacts;
pub use equilibrium::{AtRest, NEARLY_AT_REST, NoEquilibrium, StaticFriction};
pub use evaluation::{CoilEvaluation, ElementEvaluation, Load, PointEvaluation};
pub use inputs::InputError;
pub use jacobian_vector_product::{JacobianVectorProduct, MotionChange, StateDirection};
pub use loads::{CoilLoad, FaceLoad, SystemLoads};
pub use model::{Model, ModelError};
pub use mounted::Mounted;
pub use observe::{BodyState, CoilState, ElementState, FaceState, Observation};
pub use vibration::{Held, Vibration, Vibrations};

/// Fixed error scales, by kind of state: the error of a step is measured against
/// `relative tolerance × scale`.
///
/// They are fixed, not the size of the state, because the contacts turn a relative error of an absolute
/// position into a force. Rotations are weighted with a lever of 0.1 m, velocities with the frequency of
/// ringing contacts (100 rad/s). Work and losses are controlled too: they resolve the contacts within a step,
/// and with them the energy ledger of the thesis's runs closes to 1e-6 of the work done, and better, at a
/// relative tolerance of 1e-6.
pub mod scales {
    /// Displacements, m.
    pub const DISPLACEMENT: f64 = 0.1;
    /// Angles, rad.
    pub const ANGLE: f64 = 1.0;
    /// Velocities, m/s.
    pub const VELOCITY: f64 = 10.0;
    /// Angular velocities, rad/s.
    pub const ANGULAR_VELOCITY: f64 = 100.0;
    /// Bristle deflections, m.
    pub const DEFLECTION: f64 = 0.1;
    /// Work of the motions and losses, J.
    pub const ENERGY: f64 = 10.0;
    /// Energy lost in contact damping, J. The scale is smaller, because the loss continues while an unloaded
    /// point springs back, which changes no other state.
    pub const CONTACT_DAMPING_LOSS: f64 = 1.0;
    /// The largest tolerance for positions and speeds, whatever is requested: 1e-6 m and 1e-4 m/s. Where all
    /// friction is by tanh, speeds are held to its reference speed instead (of a point 0.1 m from the axis,
    /// if they are angular) while a point sticks or is about to; while all of them slide, to a twentieth of
    /// the slowest slip. With a larger tolerance a wedge slides to and fro by admissible errors of the
    /// integrator: steps follow the reversals, and the run is slower and wrong.
    ///
    /// Not held to it are coordinates along which no gap changes, those of a mass that can only slide along
    /// its plane, say: there an error does not press on a stiff contact. (Speeds are held to the reference
    /// speed there too.)
    pub const WIDEST_TOLERANCE: f64 = 1e-5;
}

/// A free body and its position in the state vector.
#[derive(Clone, Debug)]
struct FreeBody {
    /// Its number among all bodies.
    body: usize,
    /// Its free coordinates.
    free: Vec<usize>,
    /// Number of translations among them; the others are angles.
    translations: usize,
    /// Mass properties and free coordinates.
    rigid: Rigid,
    /// Its first position among q, and its first speed among u.
    offset: usize,
    /// Its diagonal block in the Jacobian.
    pair: usize,
    /// The faces at it, in their order.
    faces: Vec<usize>,
    /// The coils at it, in their order.
    coils: Vec<usize>,
    /// Inertia and weight, if its kinematics are linearized.
    linear: Option<Linear>,
    /// True if force elements act on it, which need its pose.
    touched: bool,
    /// True if connections act on it, which need its coordinates.
    connected: bool,
    /// True if there are loads on its coordinates.
    loaded: bool,
    /// The number of the body that goes along without its last angle.
    carrier: Option<usize>,
}

/// Inertia (kg, kg·m²) and weight (N, N·m) along each free coordinate of a body with linearized kinematics.
#[derive(Clone, Debug)]
struct Linear {
    inertia: Vec<f64>,
    weight: Vec<f64>,
}

/// A prescribed body that moves, and whose coordinates connections need.
#[derive(Clone, Debug)]
struct MovedBody {
    body: usize,
    motions: Box<[Motion; 6]>,
}

/// A body's reference frame.
#[derive(Clone, Debug)]
struct FrameState {
    fixed: bool,
    keeps_orientation: bool,
    motion: FrameMotion<f64>,
    /// The translations that move, and where it would be without them.
    moves: Vec<Move>,
    rest: Vector<f64>,
}

/// A translation of a frame that moves.
#[derive(Clone, Copy, Debug)]
struct Move {
    /// The coordinate (0 to 5).
    coordinate: usize,
    /// Its axis, fixed axes.
    axis: Vector<f64>,
    /// Its value with rate and second derivative.
    jet: [f64; 3],
}

/// A system of bodies and elements, ready to be integrated.
#[derive(Clone, Debug)]
pub struct System {
    bodies: Vec<Body>,
    gravity: Vector<f64>,
    faces: Vec<Mounted<ContactFace<Interface>>>,
    coils: Vec<Mounted<Coil>>,
    elements: Vec<Mounted<Marked>>,
    /// Elements (their numbers) with a factor over time.
    factors: Vec<(usize, Motion)>,
    /// The number of each face's first point among all points.
    first_points: Vec<usize>,
    energy_terms: Vec<EnergyTerm>,
    layout: Layout,
    scales: Vec<f64>,
    error_bounds: Vec<f64>,
    layer_bounds: Vec<f64>,
    free: Vec<FreeBody>,
    /// For each body its number among the free ones.
    free_number: Vec<Option<usize>>,
    frames: Vec<FrameState>,
    /// The time at which `frames` and the relative frames that depend on time alone were evaluated.
    frames_at: f64,
    /// Start of the smooth piece of the motions, and a time inside it.
    reference: f64,
    kinematics: Vec<Kinematics<f64>>,
    /// Coordinates and rates of bodies with linearized kinematics and of those that connections act on.
    positions: Vec<[f64; 6]>,
    rates: Vec<[f64; 6]>,
    /// Loads on the coordinates of free bodies (N, N·m): of connections, and given ones.
    loads: Vec<[f64; 6]>,
    /// Given loads: constant until a caller changes them, and over time.
    given: Vec<[f64; 6]>,
    applied: Vec<MountedLoad>,
    connections: Connections,
    moved: Vec<MovedBody>,
    /// The free bodies that each pair of internal states depends on.
    internal_ends: Vec<Vec<usize>>,
    /// The quadratures that connections share.
    added: Range<usize>,
    /// Accelerations of free bodies where they are differentiated, and of prescribed ones that connections
    /// act on.
    accelerations: Vec<[f64; 6]>,
    force: Vec<Vector<f64>>,
    moment: Vec<Vector<f64>>,
    /// Derivatives summed for each free body and each carrier, and where those of a body are.
    gathered: Vec<Gathered>,
    gathered_at: Vec<usize>,
    /// Derivative by time of the force on each body and of the moments about the axes of its angles.
    load_rate: Vec<(Vector<f64>, [f64; 3])>,
    jacobian: Partitioned,
    /// True if anything depends on time explicitly.
    moves: bool,
    /// True if all elements are plain.
    plain: bool,
    /// True if the spectral radius can be bounded.
    bounded: bool,
    /// True if the laws of all points report their discontinuities.
    discontinuities_complete: bool,
    /// Positions and speeds of the last evaluation.
    current_state: Vec<f64>,
    /// The face that alone was updated, and the time, if `frames_at` is NaN.
    current_face: (usize, f64),
    /// True if the contact kinematics of the points are up to date.
    points_updated: bool,
}

impl System {
    /// Returns the system of a model.
    ///
    /// # Errors
    /// The model refers to bodies that do not exist, has no free body, or something else that
    /// [`ModelError`] names.
    pub fn new(model: Model) -> Result<Self, ModelError> {
        build::build(model)
    }

    /// Returns the bodies.
    #[must_use]
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }
    /// Returns the contact faces.
    #[must_use]
    pub fn faces(&self) -> &[Mounted<ContactFace<Interface>>] {
        &self.faces
    }
    /// Returns the coils.
    #[must_use]
    pub fn coils(&self) -> &[Mounted<Coil>] {
        &self.coils
    }
    /// Returns the energy terms that the quadratures integrate.
    #[must_use]
    pub fn energy_terms(&self) -> &[EnergyTerm] {
        &self.energy_terms
    }
    /// Returns the parts of the state vector.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.layout
    }
    /// Returns the connections.
    #[must_use]
    pub fn connections(&self) -> &[Connection] {
        self.connections.all()
    }
    /// Returns the connection of each contact state beyond those of the points: connections with friction, in
    /// their order.
    #[must_use]
    pub fn frictional_connections(&self) -> &[usize] {
        &self.connections.discrete_states
    }
    /// Returns the first of the two accumulator deflections of a connection in the state vector, if it has
    /// any.
    #[must_use]
    pub fn deflection_of(&self, connection: usize) -> Option<usize> {
        Some(2 * self.layout.speeds + self.connections.deflection_of(connection)?)
    }
    /// Returns the number of contact points, each a discrete state with the values of [`ContactState`].
    #[must_use]
    pub fn point_count(&self) -> usize {
        self.faces.iter().map(|face| face.element.points.len()).sum()
    }
    /// Returns the state at the start: initial coordinates, at rest, bristles relaxed.
    #[must_use]
    pub fn initial_state(&self) -> Vec<f64> {
        let mut x = vec![0.0; self.layout.len()];
        for free in &self.free {
            for (j, &k) in free.free.iter().enumerate() {
                x[free.offset + j] = self.bodies[free.body].initial[k];
            }
        }
        x
    }

    /// Takes the smooth piece of the motions from another copy of the same system, so that a copy for
    /// observation is on the same side of a break as the integrated one.
    pub fn segment_like(&mut self, other: &Self) {
        if self.reference != other.reference {
            self.reference = other.reference;
            self.invalidate_kinematics();
        }
    }

    /// Returns the index of a body's coordinate (0..6) among the positions, if it is free.
    #[must_use]
    pub fn position_of(&self, body: usize, coordinate: usize) -> Option<usize> {
        let free = &self.free[self.free_number[body]?];
        free.free
            .iter()
            .position(|k| *k == coordinate)
            .map(|j| free.offset + j)
    }

    /// Returns the internal states (m) in a state of the system of all elements that have some and are no
    /// faces, with their names.
    #[must_use]
    pub fn element_states(&self, x: &[f64]) -> Vec<(String, [f64; 2])> {
        let internal = self.internal(x);
        let with_states = self.elements.iter().filter(|own| own.internal_count > 0);
        with_states
            .map(|own| (own.element.element.name().to_owned(), own.states(internal)))
            .collect()
    }

    /// Writes these into a state of a system with elements of these names.
    pub fn set_element_states(&self, states: &[(String, [f64; 2])], x: &mut [f64]) {
        let first = 2 * self.layout.speeds;
        for own in self.elements.iter().filter(|own| own.internal_count > 0) {
            let found = states.iter().find(|(name, _)| name == own.element.element.name());
            if let Some((_, states)) = found {
                x[first + own.first_internal..][..2].copy_from_slice(states);
            }
        }
    }

    /// Leaves the error of a body's coordinate (0..6) out of the error control, as that of the angle of a
    /// wheel that spins: its error is without consequence, while its rate's has some. Returns false if it is
    /// not free.
    pub fn leave_uncontrolled(&mut self, body: usize, coordinate: usize) -> bool {
        let Some(position) = self.position_of(body, coordinate) else {
            return false;
        };
        self.scales[position] = f64::INFINITY;
        self.error_bounds[position] = f64::INFINITY;
        true
    }

    /// Returns the internal states.
    fn internal<'x>(&self, x: &'x [f64]) -> &'x [f64] {
        let [_, _, internal, _] = self.layout.split(x);
        internal
    }

    /// Writes the event variables of the connections.
    fn connection_event_variables(&mut self, x: &[f64], variables: &mut [f64]) {
        let [_, _, internal, _] = self.layout.split(x);
        let coordinates = (&self.positions[..], &self.rates[..]);
        self.connections.event_variables(coordinates, internal, variables);
    }

    /// Returns the coordinates and rates of a body from the state vector.
    #[inline(always)]
    fn coordinates(&self, free: &FreeBody, x: &[f64]) -> ([f64; 6], [f64; 6]) {
        let mut coordinates = self.bodies[free.body].initial;
        let mut speeds = [0.0; 6];
        let n = free.free.len();
        let (q, u) = (
            &x[free.offset..][..n],
            &x[self.layout.speeds + free.offset..][..n],
        );
        for ((k, q), u) in free.free.iter().zip(q).zip(u) {
            (coordinates[*k], speeds[*k]) = (*q, *u);
        }
        (coordinates, speeds)
    }
}

impl Problem for System {
    /// Returns the structure; a discrete state is the contact state of a point, or of a connection with
    /// friction.
    ///
    /// Event variables: gap (m) and load of each point: the gaps of a face's points, their loads, and so on
    /// face by face; then of each connection with friction what presses it (N) and the load of its
    /// accumulator. The points of each face are a group, and all connections together.
    ///
    /// Bristles come to slip without a discontinuity function. (So do coils that go solid, but they change no
    /// more than their own stiffness.)
    fn structure(&self) -> ProblemStructure {
        let (points, others) = (self.point_count(), self.connections.discrete_states.len());
        let dynamic_states = self.layout.len() - self.layout.quadratures;
        let mut event_groups = self.point_groups();
        if others > 0 {
            event_groups.push(EventGroup {
                discrete_states: points..points + others,
                variables: 2 * points..2 * points + FRICTION_VARIABLES * others,
                states: std::iter::once(0..dynamic_states).collect(),
            });
        }
        ProblemStructure {
            dynamic_states,
            displacements: self.layout.speeds,
            scales: self.scales.clone(),
            error_bounds: self.error_bounds.clone(),
            zone_error_bounds: self.layer_bounds.clone(),
            discontinuity_values: points,
            slips: points,
            discontinuities_complete: self.discontinuities_complete,
            event_groups,
        }
    }

    fn next_time_discontinuity(&mut self, start: f64) -> f64 {
        let motions = self.bodies.iter().filter_map(|body| body.frame.next_break(start));
        let given = self.applied.iter();
        let end = motions
            .chain(given.filter_map(|load| load.applied.course.next_break(start)))
            .chain(
                self.factors
                    .iter()
                    .filter_map(|(_, factor)| factor.next_break(start)),
            )
            .min_by(f64::total_cmp)
            .unwrap_or(f64::INFINITY);
        self.reference = if end.is_finite() {
            0.5 * (start + end)
        } else {
            start + 1.0
        };
        self.invalidate_kinematics();
        end
    }

    fn derivative(&mut self, time: f64, x: &[f64], dx: &mut [f64]) {
        self.update_kinematics(time, x);
        self.forces(x, dx);
    }

    fn settle(&mut self, time: f64, shift: f64, base: &[f64], x: &mut [f64]) {
        self.update_kinematics(time, x);
        self.settle_bristles(1.0 / shift, base, x);
    }

    fn linearize(&mut self, time: f64, x: &[f64], dx: &[f64], df_dt: &mut [f64]) {
        self.update_kinematics(time, x);
        self.differentiate(x, dx, true);
        self.differentiate_loads(x, df_dt);
        if self.moves {
            self.differentiate_time(time, x, df_dt);
        }
    }

    fn linearize_for_newton(&mut self, time: f64, x: &[f64], dx: &[f64], unused: &mut [f64]) {
        self.update_kinematics(time, x);
        self.differentiate(x, dx, false);
        self.differentiate_loads(x, unused);
    }

    fn spectral_radius_bound(&mut self, time: f64, x: &[f64]) -> f64 {
        if !self.bounded {
            return f64::INFINITY;
        }
        self.update_kinematics(time, x);
        self.spectral_radius()
    }

    fn factor(&mut self, shift: f64) -> Result<(), Singular> {
        self.jacobian.factor(shift)
    }

    fn solve(&mut self, b: &mut [f64]) {
        self.jacobian.solve(b);
    }

    fn discontinuities(&mut self, time: f64, x: &[f64], functions: &mut DiscontinuityFunctions) {
        self.discontinuity_functions(time, x, functions);
    }

    fn initial_discrete_states(&mut self, time: f64, x: &[f64], states: &mut [u8]) {
        self.update_kinematics(time, x);
        let (points, others) = states.split_at_mut(self.point_count());
        self.find_contact_states(x, points);
        self.connections
            .find_contact_states((&self.positions, &self.rates), self.internal(x), others);
    }

    fn event_variables(&mut self, group: Option<usize>, time: f64, x: &[f64], variables: &mut [f64]) {
        match group {
            Some(face) if face < self.faces.len() => self.face_event_variables(face, time, x, variables),
            Some(_) => {
                self.update_kinematics(time, x);
                self.connection_event_variables(x, variables);
            }
            None => {
                self.update_kinematics(time, x);
                let (points, others) = variables.split_at_mut(2 * self.point_count());
                self.point_event_variables(x, points);
                self.connection_event_variables(x, others);
            }
        }
    }

    fn event_functions(&mut self, group: usize, variables: &[f64], states: &[u8], functions: &mut [f64]) {
        if group < self.faces.len() {
            self.face_margins(group, variables, states, functions);
        } else {
            for (i, (function, state)) in functions.iter_mut().zip(states).enumerate() {
                *function = FrictionVariables::of(variables, i).margin(ContactState::from_number(*state));
            }
        }
    }

    fn next_discrete_state(&mut self, group: usize, variables: &[f64], index: usize, state: u8) -> u8 {
        if group < self.faces.len() {
            self.next_contact_state(group, variables, index, state)
        } else {
            FrictionVariables::of(variables, index).next(ContactState::from_number(state)) as u8
        }
    }
}

/// Returns the parts of the state vector and the structure of the Jacobian.
fn structure(free: &[FreeBody], couplings: Vec<(usize, usize)>, model: &Parts) -> Structure {
    Structure {
        bodies: free.iter().map(|free| free.free.len()).collect(),
        couplings,
        internal_pairs: model.internal_pairs.clone(),
        quadratures: model.energy_terms.len(),
        quadrature_bodies: model.quadrature_bodies.clone(),
        quadrature_pairs: model.quadrature_pairs.clone(),
    }
}

/// Returns the error scale of one coordinate (0..6).
fn scale_of(coordinate: usize) -> (f64, f64) {
    if coordinate < 3 {
        (scales::DISPLACEMENT, scales::VELOCITY)
    } else {
        (scales::ANGLE, scales::ANGULAR_VELOCITY)
    }
}

/// Returns whether a law has internal states, two a point.
fn is_bristle(law: &FrictionLaw) -> bool {
    law.states_per_point() == 2
}

/// Returns the identity marker, for tests and simple models.
#[must_use]
pub fn marker_at(origin: [f64; 3]) -> Marker {
    Marker::new(origin, [0.0; 3])
}
