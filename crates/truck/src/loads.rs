//! Loads of a truck's elements, from an observation of its system.
//!
//! Signs: the *warp angle* is the mean yaw of the side frames less that of the bolster. The *warp moment*
//! acts on the bolster, about z through the truck's center. The *inter-axle shear moment* is the axle's
//! distance from the center times the difference of the lateral forces that the leading and the trailing
//! wheelset exert. The *vertical load of a nest* acts on the side frame, from all that bolster, wedges and
//! coils exert, positive down. Column friction acts on the side frame, positive up.

use mechanics::connection::ConnectionState;
use mechanics::element::{Element, Wrench};
use mechanics::link::{Marker, RelativeMotion};
use mechanics::system::{BodyState, FaceState, Observation};
use mechanics::vector::{Matrix, Vector};

use wedge::parameters::Damping;

use crate::PLACES;
use crate::assemble::{BOLSTER, INBOARD_HALVES, SIDE_FRAMES, Truck, WEDGES};
use crate::elements::{Law, Role, Suspended, WedgePlace};
use crate::mounted::{MountedTruck, TruckFrame, TruckView};
use crate::split::WAYS;

/// The moment about z that elements exert on the bolster, by kind of element, N·m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WarpMoment {
    /// Load coils.
    pub load_coils: f64,
    /// Control coils that stand on the bolster.
    pub control_coils: f64,
    /// Slopes of the pockets: normal forces and friction; all of a wedge without mass, whatever its coil
    /// stands on.
    pub slopes: f64,
    /// Sides of the pockets.
    pub pocket_sides: f64,
    /// Lands.
    pub lands: f64,
    /// Gibs.
    pub gibs: f64,
    /// Empirical warp springs.
    pub warp_springs: f64,
}

impl WarpMoment {
    /// Returns the sum.
    #[must_use]
    pub fn total(&self) -> f64 {
        let stops = self.pocket_sides + self.lands + self.gibs;
        self.load_coils + self.control_coils + self.slopes + stops + self.warp_springs
    }
}

/// A half of a split wedge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HalfLoads {
    /// Normal force of its half of the column, N.
    pub column_normal: f64,
    /// Normal force of its half of the slope, N.
    pub slope_normal: f64,
    /// Displacement of its center of gravity from its nominal place, m.
    pub displacement: [f64; 3],
    /// Roll, pitch, yaw, rad.
    pub angles: [f64; 3],
}

/// A wedge; of a split one forces are those of both halves, displacements and angles their means.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WedgeLoads {
    /// Normal force of the column, N.
    pub column_normal: f64,
    /// Vertical part of the column's friction alone, on the side frame, N.
    pub column_friction_z: f64,
    /// Normal force of the slope, N.
    pub slope_normal: f64,
    /// Displacement of the center of gravity from its nominal place, m. A wedge without mass goes with the
    /// column along x, with the bolster along y, and up by what the bolster and its rise in the pocket make.
    pub displacement: [f64; 3],
    /// Roll, pitch, yaw, rad; zero for a wedge without mass.
    pub angles: [f64; 3],
    /// Height in its pocket above that of an unworn wedge in the nominal layout, m: what an inspector's gauge
    /// shows, positive up.
    pub rise: f64,
    /// Extension of the control coil from its length in the nominal layout, m.
    pub coil_extension: f64,
    /// The halves of a split wedge, outboard and inboard; zero for others.
    pub halves: [HalfLoads; 2],
    /// Normal force between the halves, N.
    pub split_normal: f64,
}

/// The center plate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CenterPlateLoads {
    /// Normal force of all points, N.
    pub load: f64,
    /// Moment on the bolster about the truck's z axis and the plate's height (roll, pitch, turning), fixed
    /// axes, N·m.
    pub moment: [f64; 3],
}

/// A constant-contact side bearing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SideBearingLoads {
    /// Whole force on the car body along z of the bolster, N: spring, solid stop and hysteresis.
    pub force: f64,
    /// The part of the hysteresis, N: positive in compression.
    pub hysteresis: f64,
}

/// Loads and angles of a truck, SI.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loads {
    /// Warp angle, rad.
    pub warp_angle: f64,
    /// Warp moment on the bolster.
    pub warp_moment: WarpMoment,
    /// Moment on the bolster about the truck's x axis at the bolster's center of gravity, from coils, slopes
    /// and stops, N·m.
    pub roll_moment: f64,
    /// Inter-axle shear moment, N·m; zero without wheelsets.
    pub interaxle_shear_moment: f64,
    /// Vertical loads of the left and of the right nest, N.
    pub nest_vertical: [f64; 2],
    /// The wedges, in the order of [`WEDGE_NAMES`](crate::WEDGE_NAMES).
    pub wedges: [WedgeLoads; 4],
    /// The center plate; zero without a car body.
    pub center_plate: CenterPlateLoads,
    /// Left and right side bearing with hysteresis; zero for others.
    pub side_bearings: [SideBearingLoads; 2],
    /// The coil or stop with the largest force, as [`Truck::suspension_name`] knows it, and its force, N.
    pub largest: (usize, f64),
}

impl Truck {
    /// Returns the loads at an observation of [`Truck::system`].
    #[must_use]
    pub fn loads(&self, observation: &Observation) -> Loads {
        self.mounted
            .loads_of(&TruckView::new(&self.mounted, observation, None))
    }

    /// Returns the name of a coil or stop; empty if there is none of this number.
    #[must_use]
    pub fn suspension_name(&self, number: usize) -> &str {
        self.mounted.suspension_name(number)
    }

    /// Returns the stops that have no clearance left at an observation, with how far their parts are beyond
    /// it, m.
    #[must_use]
    pub fn closed_stops(&self, observation: &Observation) -> Vec<(&str, f64)> {
        self.mounted.closed_stops(observation)
    }
}

impl MountedTruck {
    /// Returns the loads at an observation of the system in which the truck is, in the axes of a frame.
    #[must_use]
    pub fn loads(&self, observation: &Observation, frame: &TruckFrame) -> Loads {
        self.loads_of(&TruckView::new(self, observation, Some(*frame)))
    }

    fn loads_of(&self, view: &TruckView<'_>) -> Loads {
        let yaw = |body: usize| view.yaw(body);
        let mut loads = Loads {
            warp_angle: 0.5 * (yaw(SIDE_FRAMES) + yaw(SIDE_FRAMES + 1)) - yaw(BOLSTER),
            ..Loads::default()
        };
        let arm = self.axle;
        let bolster = view.place(view.body(BOLSTER).center_of_gravity);
        let total = |forces: &[Vector<f64>]| view.vector(total(forces));
        for (number, wedge) in loads.wedges.iter_mut().enumerate() {
            let (first, split) = match self.added.wedges[number] {
                WedgePlace::Body { column } => (column, false),
                WedgePlace::Split { column } => (column, true),
                WedgePlace::Massless { connection } => {
                    let state = &view.seen.connections[connection];
                    let place = self.wedge_places[number];
                    let [vertical, longitudinal, lateral] = [0, 1, 2].map(|k| state.forces[k]);
                    // On the bolster; the opposite acts on the side frame.
                    let force = Vector([-longitudinal, -lateral, -vertical]);
                    loads.nest_vertical[number % 2] -= vertical;
                    loads.warp_moment.slopes += about_z(place, force);
                    loads.roll_moment += about_x(place - bolster, force);
                    *wedge = self.massless_wedge(number, state, view);
                    continue;
                }
            };
            let own = match split {
                false => self.one_piece(WEDGES + number, first, self.wedge_places[number], view),
                true => self.split(number, first, view),
            };
            let above = |body| own.displacement[2] - view.carried(body, self.wedge_places[number]).0[2];
            *wedge = WedgeLoads {
                rise: above(BOLSTER),
                coil_extension: above(self.seat_of_coil(number)),
                ..own
            };
            let side = number % 2;
            for first in (first..).step_by(2).take(1 + usize::from(split)) {
                let [column, slope] = [first, first + 1].map(|face| &view.seen.faces[face]);
                let on_wedge = total(&column.friction_forces) + total(&column.normal_forces);
                loads.nest_vertical[side] += on_wedge.0[2];
                for (i, place) in slope.point_positions.iter().enumerate() {
                    let force = view.vector(slope.normal_forces[i] + slope.friction_forces[i]);
                    let place = view.place(*place);
                    loads.warp_moment.slopes -= about_z(place, force);
                    loads.roll_moment -= about_x(place - bolster, force);
                }
            }
        }
        for (number, element) in self.added.suspension.iter().enumerate() {
            let size = self.add(&mut loads, element, view, bolster);
            if size > loads.largest.1 {
                loads.largest = (number, size);
            }
        }
        if let Some(moment) = &self.warp_spring {
            for side_frame in [SIDE_FRAMES, SIDE_FRAMES + 1] {
                loads.warp_moment.warp_springs -= moment.evaluate(yaw(BOLSTER) - yaw(side_frame));
            }
        }
        // Coils of the thesis, which end at the wedges' origins.
        let numbers = &self.mount.bodies;
        for coil in &view.seen.coils[self.added.coils.clone()] {
            let force = view.vector(coil.force);
            match (0..2).find(|side| coil.on == numbers[SIDE_FRAMES + side]) {
                Some(side) => loads.nest_vertical[side] += force.0[2],
                None => {
                    let place = view.place(view.seen.bodies[coil.body].origin);
                    loads.warp_moment.control_coils -= about_z(place, force);
                    loads.roll_moment -= about_x(place - bolster, force);
                }
            }
        }
        for (i, adapter) in view.seen.faces[self.added.adapters.clone()].iter().enumerate() {
            // Of adapters that pitch, the bearing carries the points.
            let sign = if self.added.adapters_pitch { -1.0 } else { 1.0 };
            let on_points = total(&adapter.friction_forces) + total(&adapter.normal_forces);
            let on_side_frame: Vector<f64> = on_points.scale(sign);
            loads.interaxle_shear_moment += [arm, -arm][i % 2] * on_side_frame.0[1];
        }
        if let Some(plate) = self.added.center_plate {
            let face = &view.seen.faces[plate];
            let mut moment = Vector::zero();
            for (i, place) in face.point_positions.iter().enumerate() {
                let arm = view.place(*place) - Vector([0.0, 0.0, self.plate_height]);
                let force = view.vector(face.normal_forces[i] + face.friction_forces[i]);
                moment = moment - arm.cross::<f64, f64>(force);
            }
            loads.center_plate = CenterPlateLoads {
                load: normal(face),
                moment: moment.0,
            };
        }
        for (own, place) in loads.side_bearings.iter_mut().zip(&self.added.side_bearings) {
            let Some(place) = place else { continue };
            let [spring, solid] = [place.face, place.face + 1].map(|face| normal(&view.seen.faces[face]));
            let hysteresis = -view.seen.connections[place.hysteresis].forces[2];
            *own = SideBearingLoads {
                force: spring + solid + hysteresis,
                hysteresis,
            };
        }
        loads
    }

    /// Returns the loads of a wedge in one piece, or of a half: a body of the truck, its first face, its
    /// nominal place.
    fn one_piece(&self, body: usize, first: usize, place: Vector<f64>, view: &TruckView<'_>) -> WedgeLoads {
        let [column, slope] = [first, first + 1].map(|face| &view.seen.faces[face]);
        let center = view.body(body).center_of_gravity;
        WedgeLoads {
            column_normal: normal(column),
            column_friction_z: -view.vector(total(&column.friction_forces)).0[2],
            slope_normal: normal(slope),
            displacement: (view.place(center) - place).0,
            angles: view.angles(body),
            ..WedgeLoads::default()
        }
    }

    /// Returns the loads of both halves of a split wedge.
    fn split(&self, number: usize, first: usize, view: &TruckView<'_>) -> WedgeLoads {
        let [_, way] = PLACES[number];
        let halves = [0, 1].map(|half| {
            let shift = WAYS[half] * way * self.half_shifts[number];
            let place = self.wedge_places[number] + Vector([0.0, shift, 0.0]);
            let body = [WEDGES, INBOARD_HALVES][half] + number;
            self.one_piece(body, first + 2 * half, place, view)
        });
        let [outboard, inboard] = &halves;
        let mean = |a: &[f64; 3], b: &[f64; 3]| std::array::from_fn(|k| 0.5 * (a[k] + b[k]));
        WedgeLoads {
            column_normal: outboard.column_normal + inboard.column_normal,
            column_friction_z: outboard.column_friction_z + inboard.column_friction_z,
            slope_normal: outboard.slope_normal + inboard.slope_normal,
            displacement: mean(&outboard.displacement, &inboard.displacement),
            angles: mean(&outboard.angles, &inboard.angles),
            halves: halves.map(|own| HalfLoads {
                column_normal: own.column_normal,
                slope_normal: own.slope_normal,
                displacement: own.displacement,
                angles: own.angles,
            }),
            split_normal: normal(&view.seen.faces[first + 4]),
            ..WedgeLoads::default()
        }
    }

    /// Returns the loads of a wedge without mass, and its place.
    fn massless_wedge(&self, number: usize, state: &ConnectionState, view: &TruckView<'_>) -> WedgeLoads {
        let Some(inside) = state.wedge else {
            return WedgeLoads::default();
        };
        let place = self.wedge_places[number];
        let moved = |body: usize| view.carried(body, place);
        let (bolster, side_frame) = (moved(BOLSTER), moved(SIDE_FRAMES + number % 2));
        WedgeLoads {
            column_normal: inside.column_normal,
            column_friction_z: -inside.column_friction * libm::cos(self.toes[number]),
            slope_normal: inside.slope_normal,
            displacement: [side_frame.0[0], bolster.0[1], bolster.0[2] + inside.rise],
            rise: inside.rise,
            coil_extension: bolster.0[2] + inside.rise - moved(self.seat_of_coil(number)).0[2],
            ..WedgeLoads::default()
        }
    }

    /// Returns the body on which the control coil of a wedge stands.
    fn seat_of_coil(&self, number: usize) -> usize {
        match self.damping {
            Damping::Variable => SIDE_FRAMES + number % 2,
            Damping::Constant => BOLSTER,
        }
    }

    /// Returns the name of a coil or stop; empty if there is none of this number.
    #[must_use]
    pub fn suspension_name(&self, number: usize) -> &str {
        self.added
            .suspension
            .get(number)
            .map_or("", |element| match &element.law {
                Law::Spring(spring) => &spring.name,
                Law::Pad(pad) => &pad.law.name,
                Law::Table(spring) => &spring.name,
                Law::Stop(stop) => &stop.name,
                Law::Rim(rim) => &rim.name,
            })
    }

    /// Returns the stops that have no clearance left at an observation, with how far their parts are beyond
    /// it, m.
    #[must_use]
    pub fn closed_stops(&self, observation: &Observation) -> Vec<(&str, f64)> {
        let depth = |element: &Suspended| {
            let motion = relative_motion(&element.ends, &observation.bodies).2;
            match &element.law {
                Law::Stop(stop) => {
                    let ([lower, upper], d) = (stop.clearances, motion.position.0[0]);
                    (d - upper).max(-d - lower)
                }
                Law::Rim(rim) => motion.position.0[0].hypot(motion.position.0[1]) - rim.clearance,
                Law::Spring(_) | Law::Pad(_) | Law::Table(_) => f64::NEG_INFINITY,
            }
        };
        let all = self.added.suspension.iter().enumerate();
        // A pocket may fit its wedge without play.
        let most = |element: &Suspended| match element.role {
            Role::PocketSide => f64::MIN_POSITIVE,
            _ => 0.0,
        };
        all.map(|(number, element)| (self.suspension_name(number), depth(element), most(element)))
            .filter(|(_, depth, most)| depth >= most)
            .map(|(name, depth, _)| (name, depth))
            .collect()
    }

    /// Adds what one element of the suspension does; returns the size of its force.
    fn add(&self, loads: &mut Loads, element: &Suspended, view: &TruckView<'_>, bolster: Vector<f64>) -> f64 {
        let [(a, _), (b, _)] = &element.ends;
        let numbers = &self.mount.bodies;
        let (place, axes, motion) = relative_motion(&element.ends, &view.seen.bodies);
        let wrench: Wrench<f64> = match &element.law {
            Law::Spring(spring) => spring.evaluate(&motion),
            Law::Pad(pad) => pad.evaluate(&motion),
            Law::Table(spring) => spring.evaluate(&motion),
            Law::Stop(stop) => stop.evaluate(&motion),
            Law::Rim(rim) => rim.evaluate(&motion),
        };
        let force: Vector<f64> = axes.apply(wrench.force);
        let size = force.dot::<f64, f64>(force).sqrt();
        let (place, force) = (view.place(place), view.vector(force));
        // On the bolster, and on the side frame of that side, N.
        let sign = match (*a == numbers[BOLSTER], *b == numbers[BOLSTER]) {
            (true, _) => 1.0,
            (_, true) => -1.0,
            _ => 0.0,
        };
        let moment = sign * about_z(place, force);
        let roll = sign * about_x(place - bolster, force);
        let parts = &mut loads.warp_moment;
        let part = match element.role {
            Role::LoadCoil => &mut parts.load_coils,
            Role::ControlCoil => &mut parts.control_coils,
            Role::PocketSide => &mut parts.pocket_sides,
            Role::Land => &mut parts.lands,
            Role::Gib => &mut parts.gibs,
            Role::CarBody => return size,
            Role::Adapter(axle) => {
                // Pads that pitch carry the bearing.
                let on_side_frame = match element.law {
                    Law::Pad(_) => -force.0[1],
                    _ => force.0[1],
                };
                loads.interaxle_shear_moment += [self.axle, -self.axle][axle] * on_side_frame;
                return size;
            }
        };
        *part += moment;
        loads.roll_moment += roll;
        // What acts on a side frame is the reaction on body B.
        if let Some(side) = (0..2).find(|side| *b == numbers[SIDE_FRAMES + side]) {
            loads.nest_vertical[side] += force.0[2];
        }
        size
    }
}

/// Returns the place of marker A and the axes of marker B in fixed axes, and the motion of A against B.
pub(crate) fn relative_motion(
    [(a, marker_a), (b, marker_b)]: &[(usize, Marker); 2],
    bodies: &[BodyState],
) -> (Vector<f64>, Matrix<f64>, RelativeMotion<f64>) {
    let (a, b) = (&bodies[*a], &bodies[*b]);
    let axes: Matrix<f64> = b.rotation.times(marker_b.rotation);
    let arm: Vector<f64> = a.rotation.apply(marker_a.origin);
    let seat: Vector<f64> = b.rotation.apply(marker_b.origin);
    let place = a.origin + arm;
    let own: Vector<f64> = a.angular_velocity.cross(arm);
    let carried: Vector<f64> = b.angular_velocity.cross(place - b.origin);
    let motion = RelativeMotion {
        position: axes.apply_transposed(place - b.origin - seat),
        rotation: axes
            .transpose()
            .times::<f64, f64>(a.rotation.times(marker_a.rotation)),
        velocity: axes.apply_transposed(a.velocity + own - b.velocity - carried),
        angular_velocity: axes.apply_transposed(a.angular_velocity - b.angular_velocity),
    };
    (place, axes, motion)
}

fn total(forces: &[Vector<f64>]) -> Vector<f64> {
    forces.iter().fold(Vector::zero(), |sum, force| sum + *force)
}

fn normal(face: &FaceState) -> f64 {
    face.points.iter().map(|point| point.normal).sum()
}

/// Returns the moment of a force with an arm about x, N·m.
fn about_x(arm: Vector<f64>, force: Vector<f64>) -> f64 {
    arm.0[1] * force.0[2] - arm.0[2] * force.0[1]
}

/// Returns the moment of a force at a place about z, N·m.
fn about_z(place: Vector<f64>, force: Vector<f64>) -> f64 {
    place.0[0] * force.0[1] - place.0[1] * force.0[0]
}
