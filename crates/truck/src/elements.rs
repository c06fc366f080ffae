//! The elements between the bodies of a truck.

use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;
use std::ops::Range;

use mechanics::elements::{RadialStop, Raised, ShearSpring, Stop, TableSpring};
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::orientation::fixed;
use mechanics::system::{AppliedLoad, Model};

use crate::assemble::{BOLSTER, CAR_BODY, INBOARD_HALVES, NUMBERS, SIDE_FRAMES, WEDGES, WHEELSETS};
use crate::bodies::numbers;
use crate::joints::{Joining, Joint};
use crate::massless::{Seat, massless_wedge, warp_spring};
use crate::mounted::MountedTruck;
use crate::parameters::{CarBody, Parameters, WedgeKind};
use crate::split::{self, SplitMount};
use crate::wedge_mount::{WedgeMount, attach};
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
    Pad(Raised<ShearSpring>),
    Table(TableSpring),
    Stop(Stop),
    Rim(RadialStop),
}

impl Law {
    fn name(&mut self) -> &mut String {
        match self {
            Self::Spring(law) => &mut law.name,
            Self::Pad(pad) => &mut pad.law.name,
            Self::Table(law) => &mut law.name,
            Self::Stop(law) => &mut law.name,
            Self::Rim(law) => &mut law.name,
        }
    }

    /// Adds the element to a model.
    pub fn add(self, model: &mut Model, a: (usize, Marker), b: (usize, Marker)) {
        match self {
            Self::Spring(law) => model.add(law, a, b),
            Self::Pad(law) => model.add(law, a, b),
            Self::Table(law) => model.add(law, a, b),
            Self::Stop(law) => model.add(law, a, b),
            Self::Rim(law) => model.add(law, a, b),
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
    /// True if adapters pitch with the side frames, on bearings of axles that spin: these carry the points.
    pub adapters_pitch: bool,
    pub center_plate: Option<usize>,
    /// The left and the right side bearing, if they have hysteresis.
    pub side_bearings: [Option<BearingPlace>; 2],
}

/// The place of a side bearing with hysteresis in a model.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BearingPlace {
    /// The face of its spring; that of its solid stop follows.
    pub face: usize,
    /// Its connection.
    pub hysteresis: usize,
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
#[derive(Clone, Debug, PartialEq)]
pub struct Mount {
    /// The numbers of its bodies there, in the order of [`WHEELSETS`] to [`CAR_BODY`] and the inboard halves
    /// of split wedges ([`numbers`](crate::numbers)). Two may be one: the bolster and a car that is rigid
    /// with it. Of wheelsets that spin it is their carriers (`Model::add_carrier`).
    pub bodies: [usize; NUMBERS],
    /// Its center, m.
    pub center: [f64; 3],
    /// The prefix of the names of its elements.
    pub prefix: Cow<'static, str>,
}

impl Mount {
    /// A truck alone, its center at the origin, without split wedges.
    pub const ALONE: Self = Self {
        bodies: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0, 0, 0, 0],
        center: [0.0; 3],
        prefix: Cow::Borrowed(""),
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
    MountedTruck::new(parameters, mount.clone(), added, axes)
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
    let prefix = mount.prefix.as_ref();
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
        element.law.clone().add(model, a, b);
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
        let on = self.mount.bodies[WHEELSETS];
        let pitching = self.parameters.wheelsets.as_ref().is_some_and(|own| own.pitching);
        self.added.adapters_pitch = pitching && self.model.carriers.iter().any(|[carrier, _]| *carrier == on);
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
            for (number, (side, name)) in [(1.0, "left"), (-1.0, "right")].into_iter().enumerate() {
                let place = BearingPlace {
                    face: self.model.faces.len(),
                    hysteresis: self.model.connections.len(),
                };
                self.side_bearing(car, side * car.side_bearings.distance, name);
                if self.model.connections.len() > place.hysteresis {
                    self.added.side_bearings[number] = Some(place);
                }
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

    /// Returns the joint of two bodies of the truck.
    fn between(&mut self, bodies: [usize; 2]) -> Joint<'_> {
        Joint {
            pitching: true,
            bodies: bodies.map(|body| self.mount.bodies[body]),
            from: self.mount.center,
            model: &mut *self.model,
        }
    }

    /// Takes elements of the suspension.
    fn take(&mut self, role: Role, all: impl IntoIterator<Item = Joining>) {
        let suspended = |(law, ends)| Suspended { role, law, ends };
        self.added.suspension.extend(all.into_iter().map(suspended));
    }

    /// Returns the seat of a connection of two bodies (their numbers in the model) at a place (m).
    fn seat(&self, bodies: [usize; 2], at: [f64; 3]) -> Seat {
        let point = std::array::from_fn(|k| at[k] + self.mount.center[k]);
        let bodies = bodies.map(|body| &self.model.bodies[body]);
        let turned = bodies.iter().any(|body| body.frame.orientation != [0.0; 3]);
        Seat {
            point,
            markers: turned.then(|| bodies.map(|body| body.marker(point, [0.0; 3]))),
        }
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
            let at = self.seat([bolster, side_frame], center);
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
            let spring = self.between(ends).spring(name, at, &coil.spring);
            self.take(Role::LoadCoil, [spring]);
        }
        if let Some(moment) = &parameters.warp_spring {
            let [a, b] = ends.map(|body| self.mount.bodies[body]);
            let at = self.seat([a, b], [0.0, y, geometry.gib_height]);
            if ![a, b].iter().all(|body| self.model.bodies[*body].is_prescribed()) {
                let spring = warp_spring(format!("{side}_warp_spring"), [a, b], at, moment);
                self.model.connections.push(spring);
            }
        }
        let gib = format!("{side}_gib");
        let at = [0.0, y, geometry.gib_height];
        let stop = self.between(ends).stop(gib, at, FRAC_PI_2, &parameters.gib);
        self.take(Role::Gib, [stop]);
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
                let stop = self.between(ends).stop(name, at, 0.0, &parameters.lands);
                self.take(Role::Land, [stop]);
            }
        }
    }

    fn center_plate(&mut self, car: &CarBody) {
        let weight = car.body.mass * self.parameters.gravity;
        let load = weight - car.side_bearings.preload();
        let mut joint = self.between([CAR_BODY, BOLSTER]);
        let rim = joint.plate("center_plate", [0.0; 2], &car.center_plate, load);
        self.take(Role::CarBody, [rim]);
    }

    fn side_bearing(&mut self, car: &CarBody, y: f64, side: &str) {
        let (name, at) = (format!("{side}_side_bearing"), [0.0, y, car.center_plate.height]);
        let mut joint = self.between([CAR_BODY, BOLSTER]);
        let stop = joint.bearing(name, at, &car.side_bearings.kind, [0.0; 2]);
        self.take(Role::CarBody, stop);
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
            let mut joint = self.between([SIDE_FRAMES + number, WHEELSETS + axle]);
            joint.pitching = wheelsets.pitching;
            let all = joint.adapter(&name, place, &wheelsets.adapter, geometry.adapter);
            self.take(Role::Adapter(axle), all);
        }
    }
}
