//! A vehicle from its description, and its start.

use std::borrow::Cow;
use std::collections::BTreeSet;

use mechanics::body::Body;
use mechanics::connection::Options;
use mechanics::frame::Frame;
use mechanics::system::{Model, Observation, StaticFriction, System};
use mechanics::vector::{Matrix, Vector};
use quantity::{Kind, STANDARD_GRAVITY};

use crate::GROUND;
use crate::body::RigidBody;
use crate::catalog::{Element, Place};
use crate::channel::Channel;
use crate::drawing::{Drawing, DrawnBody, DrawnElement, Solid};
use crate::error::VehicleError;

/// The start of a vehicle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StartKind {
    /// In the nominal layout.
    #[default]
    Nominal,
    /// At rest, with motions and loads held as they are at time zero; wedges and dry friction without
    /// friction, since rest would depend on how it was reached.
    Equilibrium,
}

/// What a vehicle is made of.
#[derive(Clone, Debug)]
pub struct Description {
    /// Its bodies; elements count them from 1, after the ground.
    pub bodies: Vec<RigidBody>,
    /// The elements between them.
    pub elements: Vec<Element>,
    /// Gravity, m/s², downwards.
    pub gravity: f64,
    /// How it starts; what bodies say of their start comes on top.
    pub start: StartKind,
}

impl Default for Description {
    fn default() -> Self {
        Self {
            bodies: Vec::new(),
            elements: Vec::new(),
            gravity: STANDARD_GRAVITY,
            start: StartKind::Nominal,
        }
    }
}

/// A vehicle, ready to be integrated.
#[derive(Clone, Debug)]
pub struct Vehicle {
    /// The equations of motion.
    pub system: System,
    /// The state at time zero.
    pub initial_state: Vec<f64>,
    /// The same without what bodies say of their start: at rest, or in the nominal layout.
    pub rest: Vec<f64>,
    /// What is seen of it: bodies, then elements.
    pub channels: Vec<Channel>,
    /// How it is drawn.
    pub drawing: Drawing,
    /// The warning of a start at rest that is nearly at rest.
    pub start_warning: Option<String>,
}

/// A model in the nominal layout, with what is seen of it.
struct Nominal {
    model: Model,
    channels: Vec<Channel>,
}

impl Vehicle {
    /// Returns the vehicle of a description at its start.
    ///
    /// # Errors
    /// Bodies and elements make no system, or there is no rest to start from.
    pub fn new(description: &Description) -> Result<Self, VehicleError> {
        let Nominal { model, channels } = Nominal::new(&description.bodies, description, false)?;
        let mut names = BTreeSet::new();
        if let Some(channel) = channels.iter().find(|own| !names.insert(&own.column.name)) {
            let name = channel.column.name.clone();
            return Err(VehicleError::SameColumn { name });
        }
        let system = System::new(model)?;
        let mut initial_state = system.initial_state();
        let mut start_warning = None;
        if description.start == StartKind::Equilibrium {
            let held: Vec<RigidBody> = description.bodies.iter().map(RigidBody::held).collect();
            let mut still = System::new(Nominal::new(&held, description, true)?.model)?;
            let start = still.initial_state();
            let rest = still.start_at_rest(0.0, &start, StaticFriction::Following)?;
            start_warning = rest.warning;
            let speeds = system.layout().speeds;
            initial_state[..speeds].copy_from_slice(&rest.state[..speeds]);
        }
        let rest = initial_state.clone();
        let speeds = system.layout().speeds;
        for (number, body) in (1..).zip(&description.bodies) {
            for k in 0..6 {
                if let Some(place) = system.position_of(number, k) {
                    initial_state[place] += body.start.displacement[k];
                    initial_state[speeds + place] += body.start.rates[k];
                }
            }
        }
        Ok(Self {
            drawing: drawing(description, &system),
            system,
            initial_state,
            rest,
            channels,
            start_warning,
        })
    }

    /// Returns all derived quantities of its start.
    pub fn observe_start(&mut self) -> Observation {
        self.system.observe(0.0, &self.initial_state)
    }
}

impl Nominal {
    /// Returns the model of these bodies and of a description's elements, as they are or without the friction
    /// that a rest may not depend on.
    fn new(
        bodies: &[RigidBody],
        description: &Description,
        without_friction: bool,
    ) -> Result<Self, VehicleError> {
        let mut all = vec![Body::prescribed(GROUND, Frame::fixed([0.0; 3], [0.0; 3]))];
        all.extend(bodies.iter().map(RigidBody::body));
        let mut channels: Vec<Channel> = Vec::new();
        for (number, body) in (1..).zip(bodies) {
            channels.extend(body_channels(number, body));
        }
        let mut own = Vec::with_capacity(description.elements.len());
        for element in &description.elements {
            let first = all.len();
            let places = element.ends.map(|end| end.at);
            all.extend(element.law.bodies(&element.name, places));
            own.push((first..all.len()).collect::<Vec<usize>>());
            for number in first..all.len() {
                channels.extend(own_channels(number, &all[number]));
            }
        }
        let mut model = Model::new(all, [0.0, 0.0, -description.gravity]);
        model.options = Options::default();
        for body in (1..).zip(bodies) {
            add_loads(&mut model, body);
        }
        for (element, own) in description.elements.iter().zip(&own) {
            let still = element.law.without_friction().filter(|_| without_friction);
            let law = still.as_ref().unwrap_or(&element.law);
            let mut place = Place {
                name: &element.name,
                model: &mut model,
                ends: element.ends.map(|end| (end.body, end.at)),
                own,
                channels: &mut channels,
            };
            law.add(&mut place).map_err(|reason| VehicleError::Element {
                element: element.name.clone(),
                reason,
            })?;
        }
        Ok(Self { model, channels })
    }
}

fn add_loads(model: &mut Model, (number, body): (usize, &RigidBody)) {
    for (coordinate, course) in body.applied.iter().enumerate() {
        let nothing = course.is_constant() && course.evaluate(0.0, 0.0)[0] == 0.0;
        if body.free[coordinate] && !nothing {
            model.loads.push(mechanics::system::AppliedLoad {
                body: number,
                coordinate,
                course: course.clone(),
            });
        }
    }
}

/// Names of coordinates in columns, with what they measure.
const COORDINATES: [(&str, &str); 6] = [
    ("x", "forward"),
    ("y", "to the left"),
    ("z", "up"),
    ("roll", "roll"),
    ("pitch", "pitch"),
    ("yaw", "yaw"),
];

/// Returns what is seen of a body: displacements of its center of gravity and rotations from the nominal
/// layout, their rates, accelerations.
fn body_channels(number: usize, body: &RigidBody) -> Vec<Channel> {
    let moves = std::array::from_fn(|k| body.moves(k));
    channels_of(number, &body.name, body.place, moves, !body.is_prescribed())
}

/// Returns the same of a body of an element's own.
fn own_channels(number: usize, body: &Body) -> Vec<Channel> {
    channels_of(number, &body.name, center_of(body), body.free, false)
}

/// Returns the center of gravity of a body in the nominal layout.
fn center_of(body: &Body) -> [f64; 3] {
    std::array::from_fn(|k| body.frame.origin[k] + body.center_of_gravity[k])
}

fn channels_of(number: usize, name: &str, place: [f64; 3], moves: [bool; 6], is_free: bool) -> Vec<Channel> {
    let mut all = Vec::new();
    let mut add = |suffix: &str, kind: Kind, text: String, read: Read| {
        let mut channel = Channel::new(format!("{name}_{suffix}"), kind, format!("{name}: {text}"), read);
        channel.column.reference = Cow::Borrowed("center of gravity");
        all.push(channel);
    };
    for (k, (suffix, along)) in COORDINATES.into_iter().enumerate().filter(|(k, _)| moves[*k]) {
        let (kind, text) = match k {
            0..3 => (
                Kind::Length,
                format!("displacement of the center of gravity {along}"),
            ),
            _ => (Kind::Angle, format!("{along} from the nominal layout")),
        };
        add(suffix, kind, text, displacement(number, k, place));
    }
    for (k, (suffix, along)) in COORDINATES.into_iter().enumerate().filter(|(k, _)| moves[*k]) {
        let (kind, text) = match k {
            0..3 => (Kind::Speed, format!("velocity of the center of gravity {along}")),
            _ => (
                Kind::AngularSpeed,
                format!("angular velocity about the axis of {along}"),
            ),
        };
        add(&format!("{suffix}_rate"), kind, text, rate(number, k));
    }
    let accelerated = COORDINATES.into_iter().enumerate().take(3);
    for (k, (suffix, along)) in accelerated.filter(|(k, _)| moves[*k] && is_free) {
        let text = format!("acceleration {along}");
        add(
            &format!("{suffix}_acceleration"),
            Kind::RideAcceleration,
            text,
            Box::new(move |view| view.acceleration(number, k)),
        );
    }
    all
}

type Read = Box<dyn Fn(&crate::View<'_>) -> f64 + Send + Sync>;

fn displacement(number: usize, k: usize, place: [f64; 3]) -> Read {
    match k {
        0..3 => Box::new(move |view| view.seen.bodies[number].center_of_gravity.0[k] - place[k]),
        _ => Box::new(move |view| {
            let own = &view.seen.bodies[number];
            match view.system.bodies()[number].is_prescribed() {
                true => angle(&own.rotation, k),
                false => own.coordinates[k],
            }
        }),
    }
}

/// Returns roll, pitch or yaw (3, 4, 5) of a rotation `Ry(pitch) Rz(yaw) Rx(roll)`, rad; yaw beyond a quarter
/// turn where it is the only one.
fn angle(rotation: &Matrix<f64>, k: usize) -> f64 {
    let Matrix(r) = rotation;
    match k {
        3 => libm::atan2(-r[1][2], r[1][1]),
        4 => libm::atan2(-r[2][0], r[0][0]),
        _ if r[2][2] == 1.0 => libm::atan2(r[1][0], r[0][0]),
        _ => libm::asin(r[1][0].clamp(-1.0, 1.0)),
    }
}

fn rate(number: usize, k: usize) -> Read {
    match k {
        0..3 => Box::new(move |view| {
            let own = &view.seen.bodies[number];
            let arm = own.center_of_gravity - own.origin;
            let swing: Vector<f64> = own.angular_velocity.cross(arm);
            (own.velocity + swing).0[k]
        }),
        _ => Box::new(move |view| view.seen.bodies[number].angular_velocity.0[k - 3]),
    }
}

/// Returns the drawing: a box for each body, the elements, and solids of their own bodies.
fn drawing(description: &Description, system: &System) -> Drawing {
    let mut drawing = Drawing::default();
    for (number, body) in (1..).zip(&description.bodies) {
        drawing.bodies.push(DrawnBody {
            name: body.name.clone(),
            number,
            place: body.place,
            solid: Solid::Box(body.box_size()),
        });
    }
    let rest = system.bodies().iter().enumerate();
    for (number, body) in rest.skip(1 + description.bodies.len()) {
        let own = RigidBody::new(&body.name, body.mass, body.inertia, [0.0; 3]);
        drawing.bodies.push(DrawnBody {
            name: body.name.clone(),
            number,
            place: center_of(body),
            solid: Solid::Box(own.box_size()),
        });
    }
    for element in &description.elements {
        let between = element.law.drawn_between(element.ends.map(|end| end.at));
        drawing.elements.push(DrawnElement {
            name: element.name.clone(),
            ends: [0, 1].map(|end| (element.ends[end].body, between[end])),
            form: element.law.drawn(),
        });
    }
    drawing
}
