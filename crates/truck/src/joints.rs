//! Joints between two bodies of a model: center plates, side bearings, adapters, springs and stops, at places
//! of the nominal layout. Trucks have theirs from here; so can any model.
//!
//! Both bodies stand in their nominal places, along the fixed axes (their reference frames may be turned).
//! The upper body carries the points of faces and the markers A of elements, the lower one planes and seats.

use std::f64::consts::{FRAC_PI_2, PI};

use mechanics::connection::{Accumulator, Connection, Law as ConnectionLaw, SurfaceFriction};
use mechanics::contact::{FrictionDirections, Interface};
use mechanics::curve::Curve;
use mechanics::elements::{RadialStop, Raised, Stop};
use mechanics::link::Marker;
use mechanics::system::Model;
use wedge::parameters::{Contact, FaceFriction};

use crate::elements::Law;
use crate::parameters::{
    Adapter, AdapterPad, CenterPlate, Clearance, FrictionAdapter, Hysteresis, SideBearing, Spring,
};
use crate::wedge_mount::{plane, point};

/// An element between the two bodies, with its markers.
pub(crate) type Joining = (Law, [(usize, Marker); 2]);

/// Two bodies of a model between which there is a joint.
#[derive(Debug)]
pub struct Joint<'m> {
    /// The model, with both bodies.
    pub model: &'m mut Model,
    /// The numbers of the upper and the lower body.
    pub bodies: [usize; 2],
    /// The place from which places are counted, m.
    pub from: [f64; 3],
    /// True if adapters pitch with the upper body where the lower one is the carrier of an axle that spins.
    pub pitching: bool,
}

impl Joint<'_> {
    /// Returns the marker of a body (0 upper, 1 lower) at a place (m), turned by roll, pitch, yaw (rad).
    fn marker(&self, body: usize, at: [f64; 3], angles: [f64; 3]) -> (usize, Marker) {
        let number = self.bodies[body];
        let place = std::array::from_fn(|k| at[k] + self.from[k]);
        (number, self.model.bodies[number].marker(place, angles))
    }

    /// Returns a spring that carries the upper body.
    pub(crate) fn spring(&self, name: String, at: [f64; 3], spring: &Spring) -> Joining {
        let ends = [0, 1].map(|body| self.marker(body, at, [0.0; 3]));
        (Law::Spring(spring.law(name)), ends)
    }

    /// Returns a stop along x of the lower body or, with a quarter turn of yaw, along its y.
    pub(crate) fn stop(&self, name: String, at: [f64; 3], yaw: f64, clearance: &Clearance) -> Joining {
        let law = Stop {
            name,
            clearances: [clearance.clearance; 2],
            stiffness: clearance.stiffness,
            damping: clearance.damping,
        };
        let ends = [self.marker(0, at, [0.0; 3]), self.marker(1, at, [0.0, 0.0, yaw])];
        (Law::Stop(law), ends)
    }

    /// Adds a face whose points (m) on the upper body touch a level plane of the lower one, which lies
    /// `depth` (m) above the first point in the nominal layout. Each point has its share of the friction.
    fn face(
        &mut self,
        name: String,
        places: &[[f64; 3]],
        depth: f64,
        contact: &Contact,
        friction: &FaceFriction,
        middle: [f64; 2],
    ) {
        let share = 1.0 / places.len() as f64;
        let points = places.iter().map(|place| {
            let (_, marker) = self.marker(0, *place, [0.0; 3]);
            point(marker.origin.0, contact, share)
        });
        let points = points.collect();
        let [.., height] = places[0];
        let origin = [middle[0], middle[1], height + depth];
        let (lower, marker) = self.marker(1, origin, [0.0, -FRAC_PI_2, 0.0]);
        let face = plane(name, points, friction);
        self.model.faces.push((self.bodies[0], lower, marker, face));
    }

    /// Adds the face of a center plate about `at` (x, y, m), which carries `load` (N) in the nominal layout.
    /// Returns its rim.
    pub(crate) fn plate(&mut self, name: &str, at: [f64; 2], plate: &CenterPlate, load: f64) -> Joining {
        let [x, y] = at;
        let mut places = Vec::new();
        for radius in &plate.rings {
            for i in 0..plate.points {
                let (sine, cosine) = libm::sincos(2.0 * PI * i as f64 / plate.points as f64);
                places.push([x + radius * cosine, y + radius * sine, plate.height]);
            }
        }
        let depth = load / (places.len() as f64 * plate.contact.stiffness);
        self.face(
            name.to_owned(),
            &places,
            depth,
            &plate.contact,
            &plate.friction,
            at,
        );
        let rim = RadialStop {
            name: format!("{name}_rim"),
            clearance: plate.rim.clearance,
            stiffness: plate.rim.stiffness,
            damping: plate.rim.damping,
        };
        let ends = [0, 1].map(|body| self.marker(body, [x, y, plate.height], [0.0; 3]));
        (Law::Rim(rim), ends)
    }

    /// Adds the faces of a side bearing, or returns its stop. Its planes are counted from `middle` (x, y, m).
    pub(crate) fn bearing(
        &mut self,
        name: String,
        at: [f64; 3],
        bearing: &SideBearing,
        middle: [f64; 2],
    ) -> Option<Joining> {
        match bearing {
            SideBearing::Roller(clearance) => {
                let law = Stop {
                    name,
                    clearances: [clearance.clearance, f64::INFINITY],
                    stiffness: clearance.stiffness,
                    damping: clearance.damping,
                };
                // The x axis of the marker is the lower body's z axis.
                let upright = self.marker(1, at, [0.0, -FRAC_PI_2, 0.0]);
                Some((Law::Stop(law), [self.marker(0, at, [0.0; 3]), upright]))
            }
            SideBearing::ConstantContact {
                preload,
                contact,
                travel,
                solid,
                friction,
                hysteresis,
            } => {
                let depth = preload / contact.stiffness;
                self.face(name.clone(), &[at], depth, contact, friction, middle);
                self.face(format!("{name}_solid"), &[at], -travel, solid, friction, middle);
                if let Some(hysteresis) = hysteresis {
                    self.hysteresis(name, at, [*preload, contact.stiffness], hysteresis);
                }
                None
            }
        }
    }

    /// Adds the hysteresis of a spring of this preload (N) and stiffness (N/m) along z of the lower body: a
    /// slider whose limit is never more than the spring's force.
    fn hysteresis(&mut self, name: String, at: [f64; 3], [preload, stiffness]: [f64; 2], own: &Hysteresis) {
        let ends = [0, 1].map(|body| self.marker(body, at, [0.0; 3]));
        let [(a, marker_a), (b, marker_b)] = ends;
        if a == b {
            return;
        }
        // Between markers it acts at any heading; bodies whose frames move have differences of coordinates.
        let rest = [a, b]
            .iter()
            .all(|body| self.model.bodies[*body].frame.is_fixed());
        self.model.connections.push(Connection {
            account: name.clone(),
            name,
            a,
            b,
            point: std::array::from_fn(|k| at[k] + self.from[k]),
            markers: rest.then_some([marker_a, marker_b]),
            law: ConnectionLaw::Surface(SurfaceFriction {
                coordinates: [2, 0, 2],
                directions: FrictionDirections::One,
                // By the extension, negative in compression.
                spring: Curve::linear(stiffness)
                    .scaled(1.0, -preload)
                    .clamped(-own.limit, 0.0),
                damper: None,
                coefficient: 1.0,
                accumulator: Accumulator::Bristle {
                    stiffness: own.stiffness,
                    damping: own.damping,
                },
                clamped: true,
            }),
        });
    }

    /// Adds the face of an adapter of steel; returns its stops, or the springs of a pad. `across` are the
    /// distances (m) from its middle to each of its two points and to each of its two longitudinal stops.
    pub(crate) fn adapter(
        &mut self,
        name: &str,
        place: [f64; 3],
        adapter: &Adapter,
        across: [f64; 2],
    ) -> Vec<Joining> {
        match adapter {
            Adapter::Friction(adapter) => self.steel(name, place, adapter, across),
            Adapter::Pad(pad) => self.pad(name, place, pad),
        }
    }

    /// Returns the distance of the axle below an adapter at a height (m), if the lower body is the carrier of
    /// an axle that spins. On such bearings adapters pitch with the upper body: forces along and up pass
    /// through the axle, those across act at the adapter.
    fn arm(&self, height: f64) -> Option<f64> {
        let lower = self.bodies[1];
        let spins = self.pitching && self.model.carriers.iter().any(|[carrier, _]| *carrier == lower);
        spins.then(|| height + self.from[2] - self.model.bodies[lower].frame.origin[2])
    }

    fn steel(
        &mut self,
        name: &str,
        [x, y, height]: [f64; 3],
        adapter: &FrictionAdapter,
        [points, stops]: [f64; 2],
    ) -> Vec<Joining> {
        let across = [points, -points];
        let arm = self.arm(height);
        let depth = adapter.preload / adapter.contact.stiffness;
        // Points on the carrier, above its axle, or on the upper body.
        let (carried, on) = if arm.is_some() { (1, 0) } else { (0, 1) };
        let level = height - arm.unwrap_or(0.0);
        let points = across.map(|y_point| {
            let (_, place) = self.marker(carried, [x, y + y_point, level], [0.0; 3]);
            point(place.origin.0, &adapter.contact, 0.5)
        });
        let (top, tilt) = match arm {
            Some(_) => (level - depth, FRAC_PI_2),
            None => (height + depth, -FRAC_PI_2),
        };
        let (on, marker) = self.marker(on, [x, y, top], [0.0, tilt, 0.0]);
        let face = plane(name.to_owned(), points.to_vec(), &adapter.friction);
        self.model.faces.push((self.bodies[carried], on, marker, face));
        if let Some(arm) = arm {
            // The normal points down, to the bearing.
            let own = Interface {
                first_arm: -arm,
                ..Interface::default()
            };
            self.model.interfaces.push((self.model.faces.len() - 1, own));
        }
        let mut all: Vec<Joining> = Vec::with_capacity(3);
        for across in [stops, -stops] {
            let name = format!("{name}_longitudinal_stop");
            all.push(self.stop(name, [x, y + across, level], 0.0, &adapter.longitudinal));
        }
        let name = format!("{name}_lateral_stop");
        all.push(self.stop(name, [x, y, height], FRAC_PI_2, &adapter.lateral));
        all
    }

    fn pad(&self, name: &str, [x, y, height]: [f64; 3], pad: &AdapterPad) -> Vec<Joining> {
        let half = Spring {
            preload: 0.5 * pad.preload,
            stiffness: 0.5 * pad.stiffness,
            shear_stiffness: 0.5 * pad.shear_stiffness,
            damping: 0.5 * pad.damping,
            solid: None,
        };
        let halves = [(pad.half_distance, "left"), (-pad.half_distance, "right")];
        let springs = halves.map(|(across, half_name)| {
            let name = format!("{name}_pad_{half_name}");
            let Some(arm) = self.arm(height) else {
                return self.spring(name, [x, y + across, height], &half);
            };
            // Upside down: it stands on the upper body, and carries the bearing.
            let at = [x, y + across, height - arm];
            let ends = [1, 0].map(|body| self.marker(body, at, [PI, 0.0, 0.0]));
            let raised = Raised {
                law: half.law(name),
                height: -arm,
            };
            (Law::Pad(raised), ends)
        });
        springs.into()
    }

    /// Adds a center plate about `at` (x, y, m) that carries `load` (N) in the nominal layout: its face
    /// `NAME` and its rim `NAME_rim`.
    pub fn add_center_plate(&mut self, name: &str, at: [f64; 2], plate: &CenterPlate, load: f64) {
        let rim = self.plate(name, at, plate, load);
        self.join([rim]);
    }

    /// Adds a side bearing at a place (m): a stop `NAME`, or faces `NAME` and `NAME_solid`.
    pub fn add_side_bearing(&mut self, name: &str, at: [f64; 3], bearing: &SideBearing) {
        let [x, y, _] = at;
        let stop = self.bearing(name.to_owned(), at, bearing, [x, y]);
        self.join(stop);
    }

    /// Adds an adapter at a place (m): a face `NAME` and stops, or the springs of a pad. `across` are the
    /// distances (m) from its middle to each of its points and of its longitudinal stops.
    pub fn add_adapter(&mut self, name: &str, at: [f64; 3], adapter: &Adapter, across: [f64; 2]) {
        let all = self.adapter(name, at, adapter, across);
        self.join(all);
    }

    fn join(&mut self, all: impl IntoIterator<Item = Joining>) {
        for (law, [a, b]) in all {
            law.add(self.model, a, b);
        }
    }
}
