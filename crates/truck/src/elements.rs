//! The elements between the bodies of a truck.

use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::Range;

use mechanics::elements::{RadialStop, ShearSpring, Stop, TableSpring};
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::orientation::fixed;
use mechanics::system::{AppliedLoad, Model};
use wedge::parameters::{Contact, FaceFriction};

use crate::assemble::{BOLSTER, CAR_BODY, INBOARD_HALVES, NUMBERS, SIDE_FRAMES, WEDGES, WHEELSETS};
use crate::bodies::numbers;
use crate::massless::{Joint, massless_wedge, warp_spring};
use crate::mounted::MountedTruck;
use crate::parameters::{
    Adapter, AdapterPad, CarBody, Clearance, FrictionAdapter, Parameters, SideBearing, Spring, WedgeKind,
};
use crate::split::{self, SplitMount};
use crate::wedge_mount::{WedgeMount, attach, marker_on, plane, point};
use crate::{PLACES, WEDGE_NAMES};

/// The role of an element of the suspension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    LoadCoil,
    /// Of this wedge.
    ControlCoil,
    PocketSide,
    Land,
    Gib,
    /// A stop or a pad of the leading (0) or the trailing (1) wheelset.
    Adapter(usize),
    /// Rim or roller side bearing: between car body and bolster.
    CarBody,
}

/// The law of an element of the suspension.
#[derive(Clone, Debug)]
pub(crate) enum Law {
    Spring(ShearSpring),
    Table(TableSpring),
    Stop(Stop),
    Rim(RadialStop),
}

impl Law {
    fn name(&mut self) -> &mut String {
        match self {
            Self::Spring(law) => &mut law.name,
            Self::Table(law) => &mut law.name,
            Self::Stop(law) => &mut law.name,
            Self::Rim(law) => &mut law.name,
        }
    }
}

/// An element of the suspension: its bodies with markers A and B.
#[derive(Clone, Debug)]
pub(crate) struct Suspended {
    pub role: Role,
    pub law: Law,
    pub ends: [(usize, Marker); 2],
}

/// The objects added to a model, for the results.
#[derive(Clone, Debug, Default)]
pub(crate) struct Added {
    pub suspension: Vec<Suspended>,
    /// Of each wedge: its first face, or its connection if it has no mass.
    pub wedges: [WedgePlace; 4],
    /// The coils of the thesis.
    pub coils: Range<usize>,
    /// The faces of the adapters, and that of the center plate.
    pub adapters: Range<usize>,
    pub center_plate: Option<usize>,
}

/// The place of a wedge in a model.
#[derive(Clone, Copy, Debug)]
pub(crate) enum WedgePlace {
    Body {
        column: usize,
    },
    /// Column and slope of the outboard half, of the inboard half, and the plane between.
    Split {
        column: usize,
    },
    Massless {
        connection: usize,
    },
}

impl Default for WedgePlace {
    fn default() -> Self {
        Self::Body { column: 0 }
    }
}

/// The place of a truck in a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mount {
    /// The numbers of its bodies there, in the order of [`WHEELSETS`] to [`CAR_BODY`] and the inboard halves
    /// of split wedges ([`numbers`](crate::numbers)). Two may be one: the bolster and a car that is rigid
    /// with it. Of wheelsets that spin it is their carriers (`Model::add_carrier`).
    pub bodies: [usize; NUMBERS],
    /// Its center, m.
    pub center: [f64; 3],
    /// The prefix of the names of its elements.
    pub prefix: &'static str,
}

impl Mount {
    /// A truck alone, its center at the origin, without split wedges.
    pub const ALONE: Self = Self {
        bodies: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0, 0, 0, 0],
        center: [0.0; 3],
        prefix: "",
    };

    /// Returns a truck alone, its center at the origin, whose bodies are in the order of
    /// [`bodies`](crate::bodies).
    #[must_use]
    pub fn alone(parameters: &Parameters) -> Self {
        let mut alone = Self::ALONE;
        for (place, number) in numbers(parameters).into_iter().enumerate() {
            alone.bodies[number] = place;
        }
        alone
    }
}

/// Adds the elements of a truck to a model whose bodies are there, at rest in their nominal places. (Those
/// between two prescribed bodies, or between two that are one, are left out: nothing depends on their
/// forces.)
pub fn add_elements(model: &mut Model, parameters: &Parameters, mount: &Mount) {
    add(model, parameters, mount, [[0.0; 2]; 4]);
    let joins = |face: usize| {
        model
            .faces
            .get(face)
            .is_some_and(|(carried, on, ..)| carried != on)
    };
    // The numbers of the faces that stay.
    let interfaces = std::mem::take(&mut model.interfaces);
    let kept = interfaces.into_iter().filter(|(face, _)| joins(*face));
    let kept: Vec<_> = kept
        .map(|(face, interface)| ((0..face).filter(|before| joins(*before)).count(), interface))
        .collect();
    model.interfaces = kept;
    model.faces.retain(|(carried, on, ..)| carried != on);
}

/// Adds the elements of a truck to a model whose bodies are there, each a body of its own, at rest in their
/// nominal places along the fixed axes; their reference frames may be turned. Returns the truck, for its
/// loads. Afterwards the bodies may be moved to where they start.
#[must_use]
pub fn mounted(model: &mut Model, parameters: &Parameters, mount: &Mount) -> MountedTruck {
    let axes = mount.bodies.map(|body| match model.bodies.get(body) {
        Some(body) => fixed(body.frame.orientation),
        None => fixed([0.0; 3]),
    });
    let added = add(model, parameters, mount, [[0.0; 2]; 4]);
    MountedTruck::new(parameters, *mount, added, axes)
}

/// Adds them, and returns what was added; `gaps` (m) are how far column and slope of each wedge are moved
/// away along their normals.
pub(crate) fn add(model: &mut Model, parameters: &Parameters, mount: &Mount, gaps: [[f64; 2]; 4]) -> Added {
    let first = (model.faces.len(), model.connections.len(), model.coils.len());
    let builder = Builder {
        parameters,
        mount,
        gaps,
        model,
        added: Added::default(),
    };
    let mut added = builder.build();
    added.coils = first.2..model.coils.len();
    let prefix = mount.prefix;
    if !prefix.is_empty() {
        let (faces, connections) = (&mut model.faces[first.0..], &mut model.connections[first.1..]);
        let names = faces.iter_mut().map(|(.., face)| &mut face.name);
        let names = names.chain(connections.iter_mut().map(|own| &mut own.name));
        for name in names.chain(added.suspension.iter_mut().map(|own| own.law.name())) {
            name.insert_str(0, prefix);
        }
        for connection in connections.iter_mut().filter(|own| !own.account.is_empty()) {
            connection.account.insert_str(0, prefix);
        }
    }
    join(model, &added.suspension);
    added
}

/// Adds elements to a model, but for those between two prescribed bodies, or between two that are one.
pub(crate) fn join(model: &mut Model, suspension: &[Suspended]) {
    for element in suspension {
        let [a, b] = element.ends;
        if a.0 == b.0 || (model.bodies[a.0].is_prescribed() && model.bodies[b.0].is_prescribed()) {
            continue;
        }
        match &element.law {
            Law::Spring(spring) => model.add(spring.clone(), a, b),
            Law::Table(spring) => model.add(spring.clone(), a, b),
            Law::Stop(stop) => model.add(stop.clone(), a, b),
            Law::Rim(rim) => model.add(rim.clone(), a, b),
        }
    }
}

struct Builder<'p> {
    parameters: &'p Parameters,
    mount: &'p Mount,
    /// Shifts of column and slope of each wedge away from it, m.
    gaps: [[f64; 2]; 4],
    model: &'p mut Model,
    added: Added,
}

impl Builder<'_> {
    fn build(mut self) -> Added {
        for number in 0..4 {
            self.added.wedges[number] = match self.parameters.wedges[number].kind {
                WedgeKind::Body => WedgePlace::Body {
                    column: self.model.faces.len(),
                },
                WedgeKind::Split => WedgePlace::Split {
                    column: self.model.faces.len(),
                },
                WedgeKind::Massless => WedgePlace::Massless {
                    connection: self.model.connections.len(),
                },
            };
            self.wedge(number);
        }
        self.added.adapters.start = self.model.faces.len();
        for number in 0..2 {
            self.adapters(number);
        }
        self.added.adapters.end = self.model.faces.len();
        for (number, side) in [1.0, -1.0].into_iter().enumerate() {
            self.nest(number, side * self.parameters.geometry.nest());
        }
        self.applied_loads();
        if let Some(car) = &self.parameters.car_body {
            self.added.center_plate = Some(self.model.faces.len());
            self.center_plate(car);
            for (side, name) in [(1.0, "left"), (-1.0, "right")] {
                self.side_bearing(car, side * car.side_bearings.distance, name);
            }
        }
        self.added
    }

    /// The loads on bolster, side frames and car body.
    fn applied_loads(&mut self) {
        let Parameters {
            bolster,
            side_frames,
            car_body,
            ..
        } = self.parameters;
        let mut all = vec![(BOLSTER, &bolster.applied)];
        all.extend((SIDE_FRAMES..).zip(side_frames.iter().map(|own| &own.applied)));
        all.extend(car_body.iter().map(|car| (CAR_BODY, &car.applied)));
        for (body, applied) in all {
            for (coordinate, course) in applied.iter().enumerate() {
                if *course != Motion::Constant(0.0) {
                    self.model.loads.push(AppliedLoad {
                        body: self.mount.bodies[body],
                        coordinate,
                        course: course.clone(),
                    });
                }
            }
        }
    }

    /// Returns the marker of a body at a place (m), turned about z (rad).
    fn marker(&self, body: usize, at: [f64; 3], yaw: f64) -> (usize, Marker) {
        self.turned_marker(body, at, [0.0, 0.0, yaw])
    }

    /// Returns the marker of a body at a place (m), turned by roll, pitch, yaw (rad).
    fn turned_marker(&self, body: usize, at: [f64; 3], angles: [f64; 3]) -> (usize, Marker) {
        let number = self.mount.bodies[body];
        let place = std::array::from_fn(|k| at[k] + self.mount.center[k]);
        (number, marker_on(&self.model.bodies[number], place, angles))
    }

    /// Returns the joint of a connection of two bodies (their numbers in the model) at a place (m).
    fn joint(&self, bodies: [usize; 2], at: [f64; 3]) -> Joint {
        let point = std::array::from_fn(|k| at[k] + self.mount.center[k]);
        let bodies = bodies.map(|body| &self.model.bodies[body]);
        let turned = bodies.iter().any(|body| body.frame.orientation != [0.0; 3]);
        Joint {
            point,
            markers: turned.then(|| bodies.map(|body| marker_on(body, point, [0.0; 3]))),
        }
    }

    /// Adds a spring that carries body `a` on the seat of body `b`.
    fn spring(&mut self, role: Role, name: String, [a, b]: [usize; 2], at: [f64; 3], spring: &Spring) {
        self.added.suspension.push(Suspended {
            role,
            law: Law::Spring(spring.law(name)),
            ends: [self.marker(a, at, 0.0), self.marker(b, at, 0.0)],
        });
    }

    /// Adds a stop between bodies `a` and `b`, along x of `b` or, with a quarter turn, along its y.
    fn stop(
        &mut self,
        role: Role,
        name: String,
        [a, b]: [usize; 2],
        at: [f64; 3],
        yaw: f64,
        clearance: &Clearance,
    ) {
        let law = Stop {
            name,
            clearances: [clearance.clearance; 2],
            stiffness: clearance.stiffness,
            damping: clearance.damping,
        };
        self.added.suspension.push(Suspended {
            role,
            law: Law::Stop(law),
            ends: [self.marker(a, at, 0.0), self.marker(b, at, yaw)],
        });
    }

    /// A wedge's two faces, its control coil and the sides of its pocket.
    fn wedge(&mut self, number: usize) {
        let parameters = self.parameters;
        let [end, way] = PLACES[number];
        let wedge = &parameters.wedges[number];
        let center = parameters.geometry.wedge([end, way]);
        let bodies = &self.mount.bodies;
        let [bolster, side_frame] = [BOLSTER, SIDE_FRAMES + usize::from(way < 0.0)].map(|body| bodies[body]);
        if wedge.kind == WedgeKind::Massless {
            let wedge = (wedge, parameters.damping, end);
            let at = self.joint([bolster, side_frame], center);
            let connection = massless_wedge(WEDGE_NAMES[number], [bolster, side_frame], at, wedge);
            self.model.connections.push(connection);
            return;
        }
        let at = WedgeMount {
            name: WEDGE_NAMES[number],
            body: bodies[WEDGES + number],
            side_frame,
            bolster,
            damping: parameters.damping,
            end,
            center,
            from: self.mount.center,
            gaps: self.gaps[number],
        };
        let own = match wedge.kind {
            WedgeKind::Split => {
                let halves = [WEDGES, INBOARD_HALVES].map(|first| bodies[first + number]);
                let at = SplitMount {
                    whole: at,
                    bodies: halves,
                };
                split::attach(self.model, wedge, &at)
            }
            WedgeKind::Body | WedgeKind::Massless => attach(self.model, wedge, &at),
        };
        self.added.suspension.extend(own);
    }

    /// Load coils, gib and lands of one side.
    fn nest(&mut self, number: usize, y: f64) {
        let (parameters, side_frame) = (self.parameters, SIDE_FRAMES + number);
        let ends = [BOLSTER, side_frame];
        let geometry = &parameters.geometry;
        let side = ["left", "right"][number];
        for (i, coil) in parameters.load_coils[number].iter().enumerate() {
            let at = [coil.place[0], y + coil.place[1], geometry.seat_height];
            let name = format!("{side}_load_coil_{}", i + 1);
            self.spring(Role::LoadCoil, name, ends, at, &coil.spring);
        }
        if let Some(moment) = &parameters.warp_spring {
            let [a, b] = ends.map(|body| self.mount.bodies[body]);
            let at = self.joint([a, b], [0.0, y, geometry.gib_height]);
            if ![a, b].iter().all(|body| self.model.bodies[*body].is_prescribed()) {
                let spring = warp_spring(format!("{side}_warp_spring"), [a, b], at, moment);
                self.model.connections.push(spring);
            }
        }
        let gib = format!("{side}_gib");
        let at = [0.0, y, geometry.gib_height];
        self.stop(Role::Gib, gib, ends, at, FRAC_PI_2, &parameters.gib);
        for (end, end_name) in [(1.0, "leading"), (-1.0, "trailing")] {
            for (i, (across, up)) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
                .into_iter()
                .enumerate()
            {
                let [aside, high] = geometry.lands;
                let at = [
                    end * geometry.wedge_distance,
                    y + across * aside,
                    geometry.land_height + up * high,
                ];
                let name = format!("{end_name}_{side}_land_{}", i + 1);
                self.stop(Role::Land, name, ends, at, 0.0, &parameters.lands);
            }
        }
    }

    /// Adds a face whose points (m, truck's axes) on the car body touch a plane of the bolster, with a
    /// penetration of `depth` (m) in the nominal layout.
    fn car_face(
        &mut self,
        name: String,
        places: &[[f64; 3]],
        depth: f64,
        contact: &Contact,
        friction: &FaceFriction,
    ) {
        let share = 1.0 / places.len() as f64;
        let points = places.iter().map(|place| {
            let (_, marker) = self.marker(CAR_BODY, *place, 0.0);
            point(marker.origin.0, contact, share)
        });
        let points = points.collect();
        let [.., height] = places[0];
        let (bolster, marker) =
            self.turned_marker(BOLSTER, [0.0, 0.0, height + depth], [0.0, -FRAC_PI_2, 0.0]);
        let face = plane(name, points, friction);
        self.model
            .faces
            .push((self.mount.bodies[CAR_BODY], bolster, marker, face));
    }

    fn center_plate(&mut self, car: &CarBody) {
        let plate = &car.center_plate;
        let mut places = Vec::new();
        for radius in &plate.rings {
            for i in 0..plate.points {
                let (sine, cosine) = libm::sincos(2.0 * PI * i as f64 / plate.points as f64);
                places.push([radius * cosine, radius * sine, plate.height]);
            }
        }
        let weight = car.body.mass * self.parameters.gravity;
        let depth = (weight - car.side_bearings.preload()) / (places.len() as f64 * plate.contact.stiffness);
        self.car_face(
            "center_plate".to_owned(),
            &places,
            depth,
            &plate.contact,
            &plate.friction,
        );
        let rim = RadialStop {
            name: "center_plate_rim".to_owned(),
            clearance: plate.rim.clearance,
            stiffness: plate.rim.stiffness,
            damping: plate.rim.damping,
        };
        let at = [0.0, 0.0, plate.height];
        self.added.suspension.push(Suspended {
            role: Role::CarBody,
            law: Law::Rim(rim),
            ends: [self.marker(CAR_BODY, at, 0.0), self.marker(BOLSTER, at, 0.0)],
        });
    }

    fn side_bearing(&mut self, car: &CarBody, y: f64, side: &str) {
        let (name, at) = (format!("{side}_side_bearing"), [0.0, y, car.center_plate.height]);
        match &car.side_bearings.kind {
            SideBearing::Roller(clearance) => {
                let law = Stop {
                    name,
                    clearances: [clearance.clearance, f64::INFINITY],
                    stiffness: clearance.stiffness,
                    damping: clearance.damping,
                };
                // The x axis of the marker is the bolster's z axis.
                let upright = self.turned_marker(BOLSTER, at, [0.0, -FRAC_PI_2, 0.0]);
                self.added.suspension.push(Suspended {
                    role: Role::CarBody,
                    law: Law::Stop(law),
                    ends: [self.marker(CAR_BODY, at, 0.0), upright],
                });
            }
            SideBearing::ConstantContact {
                preload,
                contact,
                travel,
                solid,
                friction,
            } => {
                self.car_face(
                    name.clone(),
                    &[at],
                    preload / contact.stiffness,
                    contact,
                    friction,
                );
                self.car_face(format!("{name}_solid"), &[at], -travel, solid, friction);
            }
        }
    }

    /// Adds the adapters of a side frame on both axles.
    fn adapters(&mut self, number: usize) {
        let parameters = self.parameters;
        let Some(wheelsets) = &parameters.wheelsets else {
            return;
        };
        let side = ["left", "right"][number];
        let geometry = &parameters.geometry;
        let y = geometry.journal() * [1.0, -1.0][number];
        for (axle, end, end_name) in [(0, 1.0, "leading"), (1, -1.0, "trailing")] {
            let name = format!("{end_name}_{side}_adapter");
            let place = [geometry.axle() * end, y, geometry.adapter_height];
            let ends = [SIDE_FRAMES + number, WHEELSETS + axle].map(|body| self.mount.bodies[body]);
            // As with springs and stops, nothing is joined between two prescribed bodies.
            if ends.iter().all(|body| self.model.bodies[*body].is_prescribed()) {
                continue;
            }
            match &wheelsets.adapter {
                Adapter::Friction(adapter) => self.friction_adapter(&name, [number, axle], place, adapter),
                Adapter::Pad(pad) => self.adapter_pad(&name, [number, axle], place, pad),
            }
        }
    }

    fn friction_adapter(
        &mut self,
        name: &str,
        [side, axle]: [usize; 2],
        [x, y, height]: [f64; 3],
        adapter: &FrictionAdapter,
    ) {
        let side_frame = SIDE_FRAMES + side;
        let [points, stops] = self.parameters.geometry.adapter;
        let points = [points, -points].map(|y_point| {
            let (_, place) = self.marker(side_frame, [x, y + y_point, height], 0.0);
            point(place.origin.0, &adapter.contact, 0.5)
        });
        let top = height + adapter.preload / adapter.contact.stiffness;
        let (number, marker) = self.turned_marker(WHEELSETS + axle, [x, y, top], [0.0, -FRAC_PI_2, 0.0]);
        let face = plane(name.to_owned(), points.to_vec(), &adapter.friction);
        self.model
            .faces
            .push((self.mount.bodies[side_frame], number, marker, face));
        let (role, ends) = (Role::Adapter(axle), [side_frame, WHEELSETS + axle]);
        for across in [stops, -stops] {
            let at = [x, y + across, height];
            let name = format!("{name}_longitudinal_stop");
            self.stop(role, name, ends, at, 0.0, &adapter.longitudinal);
        }
        let (name, at) = (format!("{name}_lateral_stop"), [x, y, height]);
        self.stop(role, name, ends, at, FRAC_PI_2, &adapter.lateral);
    }

    fn adapter_pad(
        &mut self,
        name: &str,
        [side, axle]: [usize; 2],
        [x, y, height]: [f64; 3],
        pad: &AdapterPad,
    ) {
        let half = Spring {
            preload: 0.5 * pad.preload,
            stiffness: 0.5 * pad.stiffness,
            shear_stiffness: 0.5 * pad.shear_stiffness,
            damping: 0.5 * pad.damping,
            solid: None,
        };
        for (across, half_name) in [(pad.half_distance, "left"), (-pad.half_distance, "right")] {
            let at = [x, y + across, height];
            let ends = [SIDE_FRAMES + side, WHEELSETS + axle];
            self.spring(
                Role::Adapter(axle),
                format!("{name}_pad_{half_name}"),
                ends,
                at,
                &half,
            );
        }
    }
}
