//! A vehicle from its description, and its start.

use std::collections::BTreeSet;
use std::sync::Arc;

use car::drive::{Between, SpeedControl, over_distance};
use car::{Drive, Wheels, free_truck, massless_options, searches, upright};
use mechanics::connection::Law as ConnectionLaw;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::output::Column;
use rolling::wheelset::{coordinate, leave_spin_uncontrolled};
use truck::{CAR_BODY, Mount, MountedTruck, SIDE_FRAMES, WHEELSETS};
use wheelrail::track::RailLines;

use mechanics::body::Body;
use mechanics::frame::Frame;
use mechanics::system::{Model, Observation, StaticFriction, System};
use mechanics::vector::Vector;
use quantity::STANDARD_GRAVITY;

use crate::GROUND;
use crate::body::{BodyStart, RigidBody};
use crate::catalog::{Element, Place};
use crate::channel::Channels;
use crate::drawing::{Drawing, DrawnBody, DrawnElement, Solid};
use crate::error::VehicleError;
use crate::on_track::{Axle, OnTrack, add_wheels, mount_wheels, wheelset_body};
use crate::seen;

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
    /// Wheelsets, trucks and the track that they run on; none: it runs on none.
    pub on_track: Option<OnTrack>,
}

impl Default for Description {
    fn default() -> Self {
        Self {
            bodies: Vec::new(),
            elements: Vec::new(),
            gravity: STANDARD_GRAVITY,
            start: StartKind::Nominal,
            on_track: None,
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
    pub channels: Vec<Channels>,
    /// How it is drawn.
    pub drawing: Drawing,
    /// The warning of a start at rest that is nearly at rest.
    pub start_warning: Option<String>,
    /// Its wheelsets.
    pub axles: Vec<Axle>,
    /// Static loads of their wheels, left and right, at rest on straight perfect track, N; none if there is
    /// no rest.
    pub static_loads: Vec<[f64; 2]>,
    /// The bodies that run along, with the number of the coordinate that is forward.
    pub(crate) running: Vec<(usize, usize)>,
}

/// A vehicle at rest, on straight perfect track if it runs on one.
struct Resting {
    positions: Vec<f64>,
    /// Internal states of elements, such as the rolls of rails.
    states: Vec<(String, [f64; 2])>,
    /// The warning of a state that is nearly at rest.
    warning: Option<String>,
    /// Vertical forces of the wheels of each wheelset on the rails, left and right, N.
    loads: Vec<[f64; 2]>,
}

/// A model in the nominal layout, with what is seen of it.
struct Nominal {
    model: Model,
    channels: Vec<Channels>,
    axles: Vec<Axle>,
    /// The bodies that run along, with the number of the coordinate that is forward.
    running: Vec<(usize, usize)>,
}

/// The body of each wedge, bolster and so on of a truck in a model.
struct Mounting {
    mount: Mount,
    wedges: Vec<usize>,
}

impl Vehicle {
    /// Returns the vehicle of a description at its start.
    ///
    /// # Errors
    /// Bodies and elements make no system, or there is no rest to start from.
    pub fn new(description: &Description) -> Result<Self, VehicleError> {
        let bodies = &description.bodies;
        if let Some(on) = &description.on_track {
            if let Some(body) = bodies.iter().find(|own| own.free != [true; 6]) {
                let body = body.name.clone();
                return Err(VehicleError::Held { body });
            }
            if let Some(reason) = on.misplaced() {
                let distance = on.distance;
                return Err(VehicleError::Misplaced { distance, reason });
            }
        }
        let on = description.on_track.as_ref();
        let rest = match description.start {
            StartKind::Equilibrium => {
                let held: Vec<RigidBody> = bodies.iter().map(RigidBody::held).collect();
                Some(at_rest(&held, description)?)
            }
            // On a track its static loads count, if it has any.
            StartKind::Nominal => on.and_then(|_| at_rest(bodies, description).ok()),
        };
        let static_loads = rest.as_ref().map_or(Vec::new(), |own| own.loads.clone());
        let nominal = Nominal::new(bodies, description, on, (&static_loads, false))?;
        let channels = nominal.channels;
        let mut names = BTreeSet::new();
        let mut columns = channels.iter().flat_map(|own| &own.columns);
        if let Some(column) = columns.find(|own| !names.insert(&own.name)) {
            let name = column.name.clone();
            return Err(VehicleError::SameColumn { name });
        }
        let mut system = System::new(nominal.model)?;
        for axle in &nominal.axles {
            leave_spin_uncontrolled(&mut system, axle.body);
        }
        let mut initial_state = system.initial_state();
        let mut start_warning = None;
        let speeds = system.layout().speeds;
        if let (StartKind::Equilibrium, Some(rest)) = (description.start, rest) {
            start_warning = rest.warning;
            initial_state[..speeds].copy_from_slice(&rest.positions);
            system.set_element_states(&rest.states, &mut initial_state);
        }
        let rest = initial_state.clone();
        let on_track = description.on_track.is_some();
        for (number, body) in (1..).zip(bodies) {
            let [displacement, rates] = body.start_in_frame(on_track);
            for k in 0..6 {
                if let Some(place) = system.position_of(number, k) {
                    initial_state[place] += displacement[k];
                    initial_state[speeds + place] += rates[k];
                }
            }
        }
        let mut rolling = rest.clone();
        if let Some(on) = &description.on_track {
            for state in [&mut initial_state, &mut rolling] {
                roll(state, &system, &nominal.running, &nominal.axles, on);
            }
        }
        Ok(Self {
            drawing: drawing(description, &system),
            system,
            initial_state,
            rest: rolling,
            channels,
            start_warning,
            axles: nominal.axles,
            static_loads,
            running: nominal.running,
        })
    }

    /// Returns the vehicle in equilibrium on straight perfect track of a length (m) before it, if it has
    /// wheelsets; it rolls at a speed (m/s), and nothing drives it.
    ///
    /// # Errors
    /// As [`Vehicle::new`].
    pub fn rolling(description: &Description, speed: f64, length: f64) -> Result<Self, VehicleError> {
        let mut own = description.clone();
        own.start = StartKind::Equilibrium;
        for body in &mut own.bodies {
            body.start = BodyStart::default();
        }
        if let Some(on) = &description.on_track {
            own.on_track = Some(OnTrack {
                speed,
                ..on.standing(length)?.0
            });
        }
        Self::new(&own)
    }

    /// Returns the columns of its channels.
    pub fn columns(&self) -> impl Iterator<Item = &Column> {
        self.channels.iter().flat_map(|own| &own.columns)
    }

    /// Returns all derived quantities of its start.
    pub fn observe_start(&mut self) -> Observation {
        self.system.observe(0.0, &self.initial_state)
    }
}

/// Puts a state along the track, on its actual rails, all of it at the speed of the start; wheels roll.
fn roll(state: &mut [f64], system: &System, running: &[(usize, usize)], axles: &[Axle], on: &OnTrack) {
    let speeds = system.layout().speeds;
    let levels = on.levels();
    for (body, forward) in running {
        if let Some(place) = system.position_of(*body, *forward) {
            state[place] += on.distance;
            state[speeds + place] += on.speed;
        }
        let is_wheelset = *forward == coordinate::FORWARD;
        let center = nominal_center(&system.bodies()[*body]);
        for (k, moved) in on_rails(&levels, center, is_wheelset) {
            if let Some(place) = system.position_of(*body, k) {
                state[place] += moved;
            }
        }
    }
    let spin = on.speed / on.radius();
    let [rise, rate] = on.wheels.rise(0);
    for axle in axles {
        let moved = [
            (coordinate::SPIN, 0.0, spin),
            (coordinate::VERTICAL, rise[0], rate[0] * spin),
            (coordinate::ROLL, rise[1], rate[1] * spin),
        ];
        for (own, way, speed) in moved {
            if let Some(place) = system.position_of(axle.body, own) {
                state[place] += way;
                state[speeds + place] += speed;
            }
        }
    }
}

/// Returns how the coordinates of a body at a place of the nominal layout (m) follow the actual rails:
/// straight between the levels under the wheelsets.
fn on_rails(levels: &[(f64, [f64; 3])], [x, y, z]: [f64; 3], is_wheelset: bool) -> [(usize, f64); 5] {
    let after = levels.partition_point(|(at, _)| *at < x);
    let (level, slope) = match (after.checked_sub(1).map(|i| levels[i]), levels.get(after)) {
        (Some((from, a)), Some(&(to, b))) => {
            let slope = [0, 1, 2].map(|k| (b[k] - a[k]) / (to - from));
            ([0, 1, 2].map(|k| a[k] + slope[k] * (x - from)), slope)
        }
        (Some((_, only)), None) | (None, Some(&(_, only))) => (only, [0.0; 3]),
        (None, None) => ([0.0; 3], [0.0; 3]),
    };
    let [lateral, vertical, roll] = level;
    let (lateral, vertical) = (lateral - roll * z, vertical + roll * y);
    match is_wheelset {
        true => [
            (coordinate::LATERAL, lateral),
            (coordinate::VERTICAL, vertical),
            (coordinate::ROLL, roll),
            (coordinate::HEADING, 0.0),
            (coordinate::SPIN, 0.0),
        ],
        // Frames of bodies that do not spin have their axes along x, z, -y.
        false => [
            (2, -lateral),
            (1, vertical),
            (3, roll),
            (4, slope[0]),
            (5, slope[1]),
        ],
    }
}

/// Returns a vehicle at rest.
fn at_rest(bodies: &[RigidBody], description: &Description) -> Result<Resting, VehicleError> {
    let standing = description.on_track.as_ref();
    let standing = standing.map(|on| on.standing(0.0)).transpose()?;
    let on = standing.as_ref().map(|(on, _)| on);
    let mut nominal = Nominal::new(bodies, description, on, (&[], true))?;
    if let Some((_, middle)) = &standing {
        for (body, _) in &nominal.running {
            nominal.model.bodies[*body].frame.origin[0] += middle;
        }
        carry(&mut nominal.model);
    }
    let mut still = System::new(nominal.model)?;
    let start = still.initial_state();
    let rest = still.start_at_rest(0.0, &start, StaticFriction::Following)?;
    let speeds = still.layout().speeds;
    let mut positions = rest.state[..speeds].to_vec();
    let seen = still.observe(0.0, &rest.state);
    let loads = nominal.axles.iter();
    let loads = loads.map(|axle| axle.state(&seen).wheels.map(|wheel| wheel.vertical));
    let loads = loads.collect();
    if !nominal.axles.is_empty() {
        // Nothing holds it along the track.
        let rolled = |axle: &Axle| {
            still
                .position_of(axle.body, coordinate::FORWARD)
                .map(|place| positions[place])
        };
        let all: Vec<f64> = nominal.axles.iter().filter_map(rolled).collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        for (body, forward) in &nominal.running {
            if let Some(place) = still.position_of(*body, *forward) {
                positions[place] -= mean;
            }
        }
    }
    Ok(Resting {
        states: still.element_states(&rest.state),
        positions,
        warning: rest.warning,
        loads,
    })
}

/// Lets carriers stand where their wheelsets do.
fn carry(model: &mut Model) {
    for [carrier, of] in model.carriers.clone() {
        let frame = model.bodies[of].frame.clone();
        model.bodies[carrier].frame = frame;
    }
}

impl Nominal {
    /// Returns the model of these bodies, of a description's elements, and of what runs on a track, whose
    /// wheels have these static loads (N; none: not known), as they are or without the friction that a rest
    /// may not depend on.
    fn new(
        bodies: &[RigidBody],
        description: &Description,
        on: Option<&OnTrack>,
        (static_loads, without_friction): (&[[f64; 2]], bool),
    ) -> Result<Self, VehicleError> {
        let on_track = on.is_some();
        let turned = |body: Body| match on_track {
            true => upright(body),
            false => body,
        };
        let lines = on.map(OnTrack::lines);
        let mut all = vec![Body::prescribed(GROUND, Frame::fixed([0.0; 3], [0.0; 3]))];
        all.extend(bodies.iter().map(|own| turned(own.body())));
        let mut running: Vec<(usize, usize)> = (1..all.len()).map(|number| (number, 0)).collect();
        let mut channels: Vec<Channels> = Vec::new();
        for (number, body) in (1..).zip(bodies) {
            match &lines {
                Some(lines) => channels.push(seen::on_track(number, &body.name, body.place, lines)),
                None => channels.extend(seen::body_channels(number, body)),
            }
        }
        let mut mountings = Vec::new();
        let mut wheelsets: Vec<(String, usize)> = Vec::new();
        if let (Some(on), Some(lines)) = (on, &lines) {
            for own in &on.trucks {
                let first = all.len();
                mountings.push(truck_bodies(own, on, &mut all, &mut running, &mut wheelsets));
                for (number, body) in all.iter().enumerate().skip(first + 2) {
                    channels.push(seen::on_track(number, &body.name, nominal_center(body), lines));
                }
            }
            for own in &on.wheelsets {
                running.push((all.len(), coordinate::FORWARD));
                wheelsets.push((own.name.clone(), all.len()));
                all.push(wheelset_body(on, &own.name, own.x));
            }
        }
        let mut own_bodies = Vec::with_capacity(description.elements.len());
        for element in &description.elements {
            let first = all.len();
            let places = element.ends.map(|end| end.at);
            for body in element.law.bodies(&element.name, places) {
                let (number, place) = (all.len(), nominal_center(&body));
                match &lines {
                    Some(lines) => channels.push(seen::on_track(number, &body.name, place, lines)),
                    None => channels.extend(seen::own_channels(number, &body)),
                }
                running.push((number, 0));
                all.push(turned(body));
            }
            own_bodies.push((first..all.len()).collect::<Vec<usize>>());
        }
        let mut model = Model::new(all, [0.0, 0.0, -description.gravity]);
        model.options = massless_options();
        for (number, body) in (1..).zip(bodies) {
            add_loads(&mut model, number, body, on_track);
        }
        // What elements call a body, and its number in the model.
        let mut numbers: Vec<usize> = (0..=bodies.len()).collect();
        let mut axles = Vec::new();
        if let (Some(on), Some(lines)) = (on, &lines) {
            let found = searches(&Wheels::OnRails(on.wheels.clone()))?;
            if let Some(found) = found.first() {
                axles = add_wheels(&mut model, on, found, lines, &wheelsets);
            }
            let carriers: Vec<usize> = wheelsets
                .iter()
                .map(|(name, body)| model.add_carrier(&format!("{name}_bearings"), *body))
                .collect();
            numbers.extend(&carriers[2 * on.trucks.len()..]);
            for (number, (own, mounting)) in on.trucks.iter().zip(&mut mountings).enumerate() {
                for axle in 0..2 {
                    mounting.mount.bodies[WHEELSETS + axle] = carriers[2 * number + axle];
                }
                let parameters = under(own, description, on);
                let first = (model.faces.len(), model.connections.len());
                let mounted: MountedTruck = truck::mounted(&mut model, &parameters, &mounting.mount);
                if without_friction {
                    free_wedges(&mut model, first, &mounting.wedges);
                }
                let places = [truck::BOLSTER, SIDE_FRAMES, SIDE_FRAMES + 1];
                let parts = places.map(|place| mounting.mount.bodies[place]);
                channels.push(seen::of_truck(&own.name, parts[0], &mounted, lines));
                channels.push(seen::of_truck_parts(&own.name, parts, description.gravity));
                numbers.extend(parts);
            }
            let limits = Arc::new(on.climb_limits());
            mount_wheels(&mut model, &mut axles, on);
            for (number, axle) in axles.iter().enumerate() {
                let loads = static_loads.get(number).copied().unwrap_or_default();
                channels.push(seen::of_axle((axle, number), loads, &limits));
            }
            for (number, (truck, pair)) in on.trucks.iter().zip(axles.chunks_exact(2)).enumerate() {
                let [front, rear] = [&pair[0], &pair[1]];
                if front.is_on_beams() {
                    let own = [2 * number, 2 * number + 1];
                    let loads = own.map(|axle| static_loads.get(axle).copied().unwrap_or_default());
                    channels.push(seen::of_sides(&truck.name, [front, rear], loads));
                }
            }
            for own in on.all_accelerometers(&names_of(bodies)) {
                let center = bodies.get(own.body - 1).map_or(own.at, |body| body.place);
                channels.push(seen::of_accelerometer(&own, center, description.gravity));
            }
            drive(&mut model, on, lines);
        }
        for (element, own) in description.elements.iter().zip(&own_bodies) {
            let still = element.law.at_rest().filter(|_| without_friction);
            let law = still.as_ref().unwrap_or(&element.law);
            let mut place = Place {
                name: &element.name,
                model: &mut model,
                ends: element.ends.map(|end| (numbers[end.body], end.at)),
                own,
                lines: lines.as_ref(),
                channels: &mut channels,
            };
            law.add(&mut place).map_err(|reason| VehicleError::Element {
                element: element.name.clone(),
                reason,
            })?;
        }
        Ok(Self {
            model,
            channels,
            axles,
            running,
        })
    }
}

fn names_of(bodies: &[RigidBody]) -> Vec<&str> {
    bodies.iter().map(|own| own.name.as_str()).collect()
}

/// Adds the bodies of a truck.
fn truck_bodies(
    own: &crate::TruckPart,
    on: &OnTrack,
    all: &mut Vec<Body>,
    running: &mut Vec<(usize, usize)>,
    wheelsets: &mut Vec<(String, usize)>,
) -> Mounting {
    let parameters = free_truck(&own.parameters);
    let center = [own.x, 0.0, 0.0];
    let mut mount = Mount {
        center,
        prefix: format!("{}_", own.name).into(),
        ..Mount::ALONE
    };
    let bodies = truck::bodies(&parameters, center);
    for (number, body) in truck::numbers(&parameters).into_iter().zip(bodies) {
        if number == CAR_BODY {
            mount.bodies[number] = own.body;
            continue;
        }
        let place = all.len();
        if number < truck::BOLSTER {
            let name = format!("{}_wheelset_{}", own.name, number + 1);
            let mut wheelset = wheelset_body(on, &name, 0.0);
            wheelset.frame.origin = body.frame.origin;
            running.push((place, coordinate::FORWARD));
            wheelsets.push((name, place));
            all.push(wheelset);
            continue;
        }
        mount.bodies[number] = place;
        running.push((place, 0));
        let mut body = upright(body);
        body.name = format!("{}_{}", own.name, body.name);
        all.push(body);
    }
    let wedges = parameters.wedge_parts().into_iter();
    let wedges = wedges.map(|part| mount.bodies[part.number]).collect();
    Mounting { mount, wedges }
}

/// Returns a truck under its share of a body: its center plate carries that in the nominal layout.
fn under(own: &crate::TruckPart, description: &Description, on: &OnTrack) -> truck::Parameters {
    let mut parameters = free_truck(&own.parameters);
    let share = on.trucks.iter().filter(|other| other.body == own.body).count();
    if let (Some(car), Some(body)) = (&mut parameters.car_body, description.bodies.get(own.body - 1)) {
        car.body.mass = body.mass / share as f64;
    }
    parameters.gravity = description.gravity;
    parameters
}

/// Takes the friction of a truck's wedges, whose faces and connections come from these numbers on.
fn free_wedges(model: &mut Model, (faces, connections): (usize, usize), wedges: &[usize]) {
    for (carried, .., face) in &mut model.faces[faces..] {
        if wedges.contains(carried) {
            face.coefficient = 0.0;
            face.law = FrictionLaw::Tanh { reference_speed: 1.0 };
        }
    }
    for connection in &mut model.connections[connections..] {
        if let ConnectionLaw::Wedge(wedge) = &mut connection.law {
            (wedge.column_friction, wedge.slope_friction) = (0.0, 0.0);
        }
    }
}

/// Adds what keeps a vehicle moving.
fn drive(model: &mut Model, on: &OnTrack, lines: &Arc<RailLines>) {
    let (gain, speeds, between) = match &on.drive {
        Drive::Coasting => return,
        Drive::Held { gain } => (*gain, vec![[0.0, on.speed]], Between::Speed),
        Drive::Over { gain, speeds } => (*gain, speeds.clone(), Between::Speed),
        Drive::History { gain, speeds } => (*gain, over_distance(speeds, on.distance), Between::Square),
    };
    let control = SpeedControl {
        lines: lines.clone(),
        gain,
        speeds,
        between,
    };
    let (body, height) = on.driven;
    let at = model.bodies[body].marker([0.0, 0.0, height], [0.0; 3]);
    let track = Marker::new([0.0; 3], [0.0; 3]);
    model.add(control, (body, at), (0, track));
}

fn add_loads(model: &mut Model, number: usize, body: &RigidBody, on_track: bool) {
    for (coordinate, course) in body.loads_in_frame(on_track).into_iter().enumerate() {
        let nothing = course.is_constant() && course.evaluate(0.0, 0.0)[0] == 0.0;
        if model.bodies[number].free[coordinate] && !nothing {
            model.loads.push(mechanics::system::AppliedLoad {
                body: number,
                coordinate,
                course,
            });
        }
    }
}

/// Returns the drawing: a box for each body, the elements.
fn drawing(description: &Description, system: &System) -> Drawing {
    let mut drawing = Drawing::default();
    for (number, body) in system.bodies().iter().enumerate().skip(1) {
        if description.on_track.is_some() && body.free != [true; 6] && body.mass > 0.0 {
            continue;
        }
        let own = description.bodies.get(number - 1);
        let place = match own {
            Some(own) => own.place,
            None => nominal_center(body),
        };
        let size = match own {
            Some(own) => own.box_size(),
            None => {
                let [x, y, z] = body.inertia;
                let inertia = if description.on_track.is_some() {
                    [x, z, y]
                } else {
                    [x, y, z]
                };
                RigidBody::new(&body.name, body.mass, inertia, [0.0; 3]).box_size()
            }
        };
        if own.is_some() || body.mass > 0.0 {
            drawing.bodies.push(DrawnBody {
                name: body.name.clone(),
                number,
                place,
                solid: Solid::Box(size),
            });
        }
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

/// Returns the center of gravity of a body in the nominal layout, whose frame may be turned.
pub(crate) fn nominal_center(body: &Body) -> [f64; 3] {
    let axes = mechanics::orientation::fixed(body.frame.orientation);
    let arm: Vector<f64> = axes.apply(Vector(body.center_of_gravity));
    (Vector(body.frame.origin) + arm).0
}
