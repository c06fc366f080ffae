//! Assembly of a car from its parameters, and its start.
//!
//! The model is put together in the nominal layout on straight track, along the fixed axes; so elements
//! know where on their bodies they act. Then the bodies are moved to where they start. Those that do not
//! spin turn by heading, pitch and roll, wheelsets by heading, roll and spin ([`rolling::wheelset`]);
//! adapters stand on carriers of the wheelsets, which do not spin. A truck starts as one layout whose axles
//! stand on the track, the body as one between its trucks.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use mechanics::body::Body;
use mechanics::connection::{Options, SlopeDirection};
use mechanics::frame::Frame;
use mechanics::link::Marker;
use mechanics::orientation::fixed;
use mechanics::system::{Model, System};
use mechanics::vector::{Matrix, Vector, rotation_z};
use rolling::beam::RailBeam;
use rolling::linear::LinearOnTrack;
use rolling::track::{RailSupport, rail_bed, rail_body};
use rolling::wheel::{Search, WheelElement, WheelOnRail};
use rolling::wheelset::{WheelsetPlace, leave_spin_uncontrolled, marker};
use truck::{Bolster, Mount, MountedTruck, WedgeKind, WedgeLoads};
use wheelrail::contact::{ContactPair, ContactTable, Side, VaryingRail, WheelForm};
use wheelrail::track::RailLines;

use crate::body::{Carried, Pose, angles};
use crate::coupler::{Coupler, CouplerPlace, Couplers, MountedCoupler};
use crate::drive::{Between, SpeedControl, over_distance};
use crate::error::BuildError;
use crate::parameters::{Drive, Parameters, StartKind, Wheels};
use crate::shaken::shaken;
use crate::start::{Placement, at_rest, internal_states};
use crate::torsion::{self, joint};

/// Height of the couplers above the top of rail, at which the drive acts: 34.5 in, m.
const COUPLERS: f64 = 34.5 * 0.0254;
/// Overlap up to which contact tables reach, m.
const OVERLAP: f64 = 2e-4;
/// Speed on the slope over which the friction of a wedge without mass changes its sign, m/s.
const SLOPE_SLIP: f64 = 1e-3;
/// Smallest reference speed of creepages with linear wheels, m/s.
const SLOWEST: f64 = 0.1;
/// Reference frames of bodies that do not spin have their axes along x, z, -y of the track.
const UPRIGHT: [f64; 3] = [FRAC_PI_2, 0.0, 0.0];

/// The numbers of a car's bodies in its system.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Numbers {
    /// The ground.
    pub ground: usize,
    /// The car body, or its front half if it twists.
    pub body: usize,
    /// Its rear half, if it twists.
    pub rear_half: Option<usize>,
    /// The bolsters, front and rear.
    pub bolsters: [usize; 2],
    /// The side frames of each truck, left and right.
    pub side_frames: [[usize; 2]; 2],
    /// The wedges of each truck in the order of [`truck::WEDGE_NAMES`], then the inboard halves of split
    /// ones; those without mass stand still.
    pub wedges: [Vec<usize>; 2],
    /// The wheelsets from the front.
    pub wheelsets: [usize; 4],
    /// The carriers of the wheelsets, on which adapters stand.
    pub carriers: [usize; 4],
    /// The sprung rails under each wheelset, left and right.
    pub rails: Option<[[usize; 2]; 4]>,
    /// The beds of the rails under each wheelset, if that can be moved, left and right: displacements along
    /// the track's own axes.
    pub beds: Option<[[usize; 2]; 4]>,
}

impl Numbers {
    /// Returns the body on the front (0) or the rear (1) truck: both are one if it does not twist.
    #[must_use]
    pub fn body_at(&self, end: usize) -> usize {
        [self.body, self.rear_half.unwrap_or(self.body)][end]
    }

    /// Returns the body, or its halves.
    pub fn body_parts(&self) -> impl Iterator<Item = usize> {
        [self.body].into_iter().chain(self.rear_half)
    }

    /// Returns the body that a wheel (of a wheelset from the front; left 0, right 1) rolls on.
    pub(crate) fn under(&self, wheelset: usize, side: usize) -> usize {
        let under = self.rails.or(self.beds);
        under.map_or(self.ground, |bodies| bodies[wheelset][side])
    }
}

/// A car on a track, ready to be integrated.
#[derive(Clone, Debug)]
pub struct Car {
    /// The equations of motion, of which all names of elements of the trucks begin with `truck_1_` (front)
    /// or `truck_2_` (rear).
    pub system: System,
    /// The state at time zero.
    pub initial_state: Vec<f64>,
    /// The warning of a start at rest that is nearly at rest.
    pub start_warning: Option<String>,
    /// The wedges of both trucks before the shaking, in the equilibrium without friction; none of other
    /// starts.
    pub before_shaking: Option<[[WedgeLoads; 4]; 2]>,
    /// The lines of the rails.
    pub lines: Arc<RailLines>,
    /// The numbers of its bodies.
    pub numbers: Numbers,
    /// The trucks, for their loads.
    pub trucks: [MountedTruck; 2],
    /// From the track's own axes to fixed axes: a heading.
    pub(crate) axes: Matrix<f64>,
    pub(crate) wheels: WheelElements,
    /// Center of gravity of the body, and its axes, in the nominal layout.
    pub(crate) carried: Carried,
    /// The same of its halves, or of the whole twice.
    pub(crate) halves: [Carried; 2],
    pub(crate) truck_distance: f64,
    pub(crate) couplers: Couplers,
    /// Couplers with a force, leading and trailing.
    pub(crate) mounted_couplers: [Option<MountedCoupler>; 2],
    /// Heights of the center plates, m.
    pub(crate) plates: [f64; 2],
    /// Heights of the accelerometers above the truck centers, m.
    pub(crate) accelerometers: [f64; 2],
    pub(crate) gravity: f64,
    /// The rails as beams, and the wheelbases of both trucks, m.
    pub(crate) beams: Option<(RailBeam, [f64; 2])>,
    /// The bodies of the front truck, the rear truck (0, 1) and the car body (2).
    pub(crate) groups: Vec<(usize, usize)>,
}

/// The elements that carry the wheelsets.
#[derive(Clone, Debug)]
pub(crate) enum WheelElements {
    /// Of each wheelset the left and the right wheel, and half the distance of the tape circles (m).
    OnRails(Box<[[WheelElement; 2]; 4]>, f64),
    Linear(Box<LinearOnTrack>),
}

/// A model in the nominal layout.
pub(crate) struct Nominal {
    pub model: Model,
    pub numbers: Numbers,
    pub trucks: [MountedTruck; 2],
    wheels: WheelElements,
    /// The bodies of the front truck, the rear truck (0, 1) and the car body (2).
    pub groups: Vec<(usize, usize)>,
}

impl Car {
    /// Returns the car with these parameters at its start.
    ///
    /// # Errors
    /// The parameters make no car, or there is no equilibrium to start from.
    pub fn new(parameters: &Parameters) -> Result<Self, BuildError> {
        parameters.check()?;
        if let Wheels::OnRails(wheels) = &parameters.wheels {
            for wheelset in distinct(&wheels.geometry) {
                wheelset
                    .check_reach()
                    .map_err(|reason| BuildError::Reach { reason })?;
            }
        }
        let carried = Carried::new(parameters);
        let offsets = parameters.rail_offsets();
        let searches = searches(&parameters.wheels)?;
        let lines = Arc::new(RailLines::new(parameters.track.clone(), offsets));
        let heading = parameters.start.heading;
        let mut nominal = Nominal::new(parameters, &carried, &searches, &lines, heading);
        let mut states = Vec::new();
        let (poses, internal, start_warning, before_shaking) = match parameters.start.kind {
            StartKind::Nominal => (nominal.poses(), Vec::new(), None, None),
            StartKind::Equilibrium => {
                let standing = standing_searches(&parameters.wheels, &searches)?;
                let found = at_rest(parameters, &carried, &standing, offsets)?;
                states = found.states;
                (found.poses, Vec::new(), found.warning, None)
            }
            StartKind::Shaken => {
                let found = shaken(parameters)?;
                let rest = found.rest.clone();
                (rest.poses, rest.internal, rest.warning, Some(found.before))
            }
        };
        let mounted_couplers = [0, 1].map(|end| nominal.couple(parameters, &carried, &lines, end));
        let axes: Matrix<f64> = rotation_z(libm::sincos(heading));
        let start = Placement::new(parameters, &lines, axes);
        let speeds = start.put(&mut nominal, &poses, parameters);
        let mut system = System::new(nominal.model)?;
        for wheelset in nominal.numbers.wheelsets {
            leave_spin_uncontrolled(&mut system, wheelset);
        }
        let mut initial_state = system.initial_state();
        let own = internal_states(&system);
        if internal.len() == own.len() {
            initial_state[own].copy_from_slice(&internal);
        }
        system.set_element_states(&states, &mut initial_state);
        let first = system.layout().speeds;
        for (body, rates) in speeds {
            for (k, rate) in rates.into_iter().enumerate() {
                if let Some(place) = system.position_of(body, k) {
                    initial_state[first + place] = rate;
                }
            }
        }
        Ok(Self {
            system,
            initial_state,
            start_warning,
            before_shaking,
            lines,
            numbers: nominal.numbers,
            groups: nominal.groups,
            trucks: nominal.trucks,
            axes,
            wheels: nominal.wheels,
            carried,
            halves: halves(parameters, &carried),
            truck_distance: parameters.truck_distance,
            couplers: parameters.couplers.clone(),
            mounted_couplers,
            plates: parameters.plate_heights(),
            accelerometers: parameters
                .accelerometer_height
                .map_or(parameters.plate_heights(), |own| [own; 2]),
            gravity: parameters.gravity,
            beams: parameters.support.as_ref().and_then(|support| {
                let wheelbases = parameters.trucks.each_ref().map(|own| own.geometry.wheelbase);
                Some((support.beam.clone()?, wheelbases))
            }),
        })
    }
}

/// Returns those of four values that are not the same as one before them.
pub(crate) fn distinct<T>(all: &[Arc<T>; 4]) -> impl Iterator<Item = &Arc<T>> {
    let own = all.iter().enumerate();
    own.filter(|(k, one)| !all[..*k].iter().any(|other| Arc::ptr_eq(one, other)))
        .map(|(_, one)| one)
}

/// Returns the searches for patches at the left and the right wheel of each wheelset; none of linear wheels.
///
/// # Errors
/// A table of contacts cannot be made.
pub fn searches(wheels: &Wheels) -> Result<Vec<[Search; 2]>, BuildError> {
    let Wheels::OnRails(wheels) = wheels else {
        return Ok(Vec::new());
    };
    let over = match wheels.geometry.first() {
        Some(first) => first.rails_over(wheels.rails_over.each_ref().map(Option::as_deref))?,
        None => [None, None],
    };
    let search = |pair: &ContactPair, over: &Option<Arc<VaryingRail>>, form: &Option<WheelForm>| {
        let mut pair = pair.clone();
        if let Some(rail) = over {
            pair = pair.on(rail.clone());
        }
        if let Some(form) = form {
            pair = pair.under(form.clone());
        }
        Ok::<_, BuildError>(match wheels.tables {
            false => Search::Exact(Arc::new(pair)),
            true => Search::Table(Arc::new(ContactTable::new(pair, OVERLAP)?)),
        })
    };
    let round = |w: usize| wheels.forms[w].iter().all(Option::is_none);
    let mut searches: Vec<[Search; 2]> = Vec::with_capacity(wheels.geometry.len());
    for (w, own) in wheels.geometry.iter().enumerate() {
        let mut before = wheels.geometry[..w].iter().enumerate();
        let same =
            before.position(|(other, geometry)| Arc::ptr_eq(own, geometry) && round(other) && round(w));
        let ([left, right], [left_form, right_form]) = (own.pairs(), &wheels.forms[w]);
        searches.push(match same {
            Some(same) => searches[same].clone(),
            None => [
                search(left, &over[0], left_form)?,
                search(right, &over[1], right_form)?,
            ],
        });
    }
    Ok(searches)
}

/// Returns the searches of a car that stands: `running` are those with which it runs, on rails that may
/// change along the track and wheels that may not be round.
fn standing_searches(wheels: &Wheels, running: &[[Search; 2]]) -> Result<Vec<[Search; 2]>, BuildError> {
    match wheels {
        Wheels::OnRails(own) if !own.stands() => searches(&Wheels::OnRails(own.standing())),
        _ => Ok(running.to_vec()),
    }
}

/// Returns a body that does not spin with its reference frame turned, so that its angles are heading, pitch,
/// roll: see [`rolling::wheelset`].
#[must_use]
pub fn upright(mut body: Body) -> Body {
    let [x, y, z] = body.inertia;
    body.inertia = [x, z, y];
    let axes = fixed(UPRIGHT);
    let center: Vector<f64> = axes.apply_transposed(Vector(body.center_of_gravity));
    body.center_of_gravity = center.0;
    body.frame.orientation = UPRIGHT;
    body.initial = [0.0; 6];
    body
}

impl Nominal {
    pub fn new(
        parameters: &Parameters,
        carried: &Carried,
        searches: &[[Search; 2]],
        lines: &Arc<RailLines>,
        heading: f64,
    ) -> Self {
        let mut bodies = vec![Body::prescribed("ground", Frame::fixed([0.0; 3], [0.0; 3]))];
        let body = bodies.len();
        let halves = halves(parameters, carried);
        bodies.push(car_body(&halves[0]));
        let (half, mut groups) = (0.5 * parameters.truck_distance, vec![(body, 2)]);
        let rear_half = parameters.torsion.map(|_| {
            bodies[body].name = "front_half_of_car_body".to_owned();
            let mut rear = car_body(&halves[1]);
            rear.name = "rear_half_of_car_body".to_owned();
            groups.push((bodies.len(), 2));
            bodies.push(rear);
            bodies.len() - 1
        });
        let centers = [half, -half].map(|x| [x, 0.0, 0.0]);
        let parts = [0, 1].map(|t| free(&parameters.trucks[t]));
        let mut mounts = [Mount::ALONE, Mount::ALONE];
        let mut wheelsets = [0; 4];
        for (t, mount) in mounts.iter_mut().enumerate() {
            mount.center = centers[t];
            mount.prefix = ["truck_1_", "truck_2_"][t].into();
            let prefix = ["front", "rear"][t];
            let own = truck::bodies(&parts[t], centers[t]);
            for (number, own) in truck::numbers(&parts[t]).into_iter().zip(own) {
                if number == truck::CAR_BODY {
                    mount.bodies[number] = [body, rear_half.unwrap_or(body)][t];
                    continue;
                }
                let place = own.frame.origin;
                if number < truck::BOLSTER {
                    wheelsets[2 * t + number] = bodies.len();
                    let mut wheelset = parameters.wheelset.body(
                        &format!("wheelset_{}", 2 * t + number + 1),
                        &WheelsetPlace::default(),
                    );
                    wheelset.frame.origin = place;
                    groups.push((bodies.len(), t));
                    bodies.push(wheelset);
                    continue;
                }
                mount.bodies[number] = bodies.len();
                groups.push((bodies.len(), t));
                let mut own = upright(own);
                own.name = format!("{prefix}_{}", own.name);
                bodies.push(own);
            }
        }
        let mut model = Model::new(bodies, [0.0, 0.0, -parameters.gravity]);
        model.options = massless_options();
        let track = Marker::new([0.0; 3], [0.0, 0.0, heading]);
        let movable = parameters.movable_rails && matches!(parameters.wheels, Wheels::OnRails(_));
        let beds = movable.then(|| beds(&mut model));
        let mut rails = None;
        if let Some(support) = &parameters.support {
            let mut numbers = [[0; 2]; 4];
            for (w, pair) in numbers.iter_mut().enumerate() {
                for (i, (number, side)) in pair.iter_mut().zip(["left", "right"]).enumerate() {
                    *number = model.bodies.len();
                    let mut rail = rail_body(support);
                    rail.name = format!("rail_{}_{side}", w + 1);
                    model.bodies.push(rail);
                    let beam = support.beam.as_ref();
                    let wheelbase = parts[w / 2].geometry.wheelbase;
                    let ground = beam.map(|beam| beam.shared(support, wheelbase).ground);
                    let own = RailSupport {
                        name: format!("{}_{}_{}", support.name, w + 1, ["left", "right"][i]),
                        ..ground.unwrap_or(support.clone())
                    };
                    let on = beds.map_or(0, |beds| beds[w][i]);
                    model.add(own, (*number, track), (on, track));
                }
            }
            for (t, pair) in parts.iter().enumerate() {
                let shared = support.beam.as_ref();
                let Some(shared) = shared.map(|beam| beam.shared(support, pair.geometry.wheelbase)) else {
                    continue;
                };
                for (i, side) in ["left", "right"].into_iter().enumerate() {
                    let [front, rear] = [0, 1].map(|axle| numbers[2 * t + axle][i]);
                    let between = RailSupport {
                        name: format!("{}_between_{}_and_{}_{side}", support.name, 2 * t + 1, 2 * t + 2),
                        ..shared.between.clone()
                    };
                    model.add(between, (front, track), (rear, track));
                }
            }
            rails = Some(numbers);
        }
        let mut carriers = [0; 4];
        for (w, wheelset) in wheelsets.into_iter().enumerate() {
            carriers[w] = model.add_carrier(&format!("bearings_{}", w + 1), wheelset);
            mounts[w / 2].bodies[truck::WHEELSETS + w % 2] = carriers[w];
        }
        if let (Some(torsion), Some(rear)) = (&parameters.torsion, rear_half) {
            let joint = joint(carried, torsion, parameters.truck_distance, parameters.gravity);
            let [a, b] = halves.each_ref().map(|own| body_marker(own, carried.center));
            model.add(joint, (body, a), (rear, b));
        }
        // The plates carry half of the body each, whatever its place.
        let trucks =
            [0, 1].map(|t| truck::mounted(&mut model, &with_half_body(&parts[t], carried), &mounts[t]));
        let on = (wheelsets, rails.or(beds), track);
        let wheels = wheels(&mut model, parameters, searches, lines, on);
        let control = match &parameters.drive {
            Drive::Coasting => None,
            Drive::Held { gain } => Some((*gain, vec![[0.0, parameters.start.speed]], Between::Speed)),
            Drive::Over { gain, speeds } => Some((*gain, speeds.clone(), Between::Speed)),
            Drive::History { gain, speeds } => {
                let speeds = over_distance(speeds, parameters.start.distance);
                Some((*gain, speeds, Between::Square))
            }
        };
        if let Some((gain, speeds, between)) = control {
            let control = SpeedControl {
                lines: lines.clone(),
                gain,
                speeds,
                between,
            };
            let at = body_marker(&halves[0], [0.0, 0.0, COUPLERS]);
            model.add(control, (body, at), (0, track));
        }
        let numbers = Numbers {
            ground: 0,
            body,
            rear_half,
            bolsters: [0, 1].map(|t| mounts[t].bodies[truck::BOLSTER]),
            side_frames: [0, 1].map(|t| [0, 1].map(|k| mounts[t].bodies[truck::SIDE_FRAMES + k])),
            wedges: [0, 1].map(|t| {
                let own = parts[t].wedge_parts();
                own.iter().map(|part| mounts[t].bodies[part.number]).collect()
            }),
            wheelsets,
            carriers,
            rails,
            beds,
        };
        Self {
            model,
            numbers,
            trucks,
            wheels,
            groups,
        }
    }

    /// Adds the coupler at an end (0 leading, 1 trailing), if a force can act there. A car rests without it.
    fn couple(
        &mut self,
        parameters: &Parameters,
        carried: &Carried,
        lines: &Arc<RailLines>,
        end: usize,
    ) -> Option<MountedCoupler> {
        let couplers = &parameters.couplers;
        if !couplers.acts(end) {
            return None;
        }
        let place = CouplerPlace {
            pivot: [1.0, -1.0][end] * couplers.pivot(),
            height: couplers.height,
            length: couplers.length,
            truck_distance: parameters.truck_distance,
        };
        let law = Coupler {
            name: ["coupler_leading", "coupler_trailing"][end].to_owned(),
            lines: lines.clone(),
            place,
            direction: couplers.ends[end].direction,
            course: None,
        };
        let at = body_marker(
            &halves(parameters, carried)[end],
            [place.pivot, 0.0, place.height],
        );
        let track = Marker::new([0.0; 3], [0.0, 0.0, parameters.start.heading]);
        let ends = ((self.numbers.body_at(end), at), (self.numbers.ground, track));
        Some(MountedCoupler::add(
            &mut self.model,
            couplers,
            law,
            end,
            ends.0,
            ends.1,
        ))
    }

    /// Lets carriers start where the wheelsets do.
    pub fn carry(&mut self) {
        for [carrier, of] in self.model.carriers.clone() {
            let body = self.model.bodies[of].clone();
            let carrier = &mut self.model.bodies[carrier];
            carrier.frame = body.frame;
            let [x, y, z, _, pitch, yaw] = body.initial;
            carrier.initial = [x, y, z, 0.0, pitch, yaw];
        }
    }

    /// Returns the poses of all bodies of the car in the nominal layout, by their numbers, with the
    /// displacements of rails.
    fn poses(&self) -> Vec<Pose> {
        let pose = |body: &Body| Pose {
            place: Vector(body.frame.origin),
            rotation: fixed(body.frame.orientation),
        };
        self.model.bodies.iter().map(pose).collect()
    }
}

/// Returns the choices of wedges without mass: friction of the slope against the wedge's slip there, and a
/// rise that counts in the slip on the column, so that no friction feeds energy.
///
/// By the toe, as in half-trucks from files, slope friction of a wedge without toe follows the column's: it
/// then makes the bolster swing along the track.
#[must_use]
pub fn massless_options() -> Options {
    Options {
        slope: SlopeDirection::OwnSlip {
            reference_speed: SLOPE_SLIP,
        },
        rise_in_slip: true,
        ..Options::default()
    }
}

/// Returns a truck with all of its bodies free.
#[must_use]
pub fn free(own: &truck::Parameters) -> truck::Parameters {
    let mut own = truck::held(own);
    own.bolster = Bolster {
        free: [true; 6],
        ..own.bolster
    };
    for side_frame in &mut own.side_frames {
        side_frame.free = [true; 6];
    }
    for wedge in own
        .wedges
        .iter_mut()
        .filter(|wedge| wedge.kind != WedgeKind::Massless)
    {
        wedge.free = [true; 6];
    }
    own.lift = 0.0;
    own
}

/// Returns a truck under half of a body.
fn with_half_body(own: &truck::Parameters, carried: &Carried) -> truck::Parameters {
    let mut own = own.clone();
    if let Some(car) = &mut own.car_body {
        car.body.mass = 0.5 * carried.mass;
    }
    own
}

/// Returns the halves of the body, front and rear, or twice the whole if it does not twist.
fn halves(parameters: &Parameters, carried: &Carried) -> [Carried; 2] {
    match parameters.torsion {
        Some(_) => torsion::halves(carried),
        None => [*carried; 2],
    }
}

/// Returns the body with its lading, or a half of it.
fn car_body(carried: &Carried) -> Body {
    let [x, y, z] = carried.inertia;
    let mut body = Body::free("car_body", carried.mass, [x, z, y], [0.0; 6]);
    // Its own axes are the principal ones, in the order forward, up, right.
    let turned: Matrix<f64> = carried.axes.times(fixed(UPRIGHT));
    body.frame = Frame::fixed(carried.center, angles(&turned));
    body
}

/// Returns a marker on the body at a place of the nominal layout (m).
pub(crate) fn body_marker(carried: &Carried, place: [f64; 3]) -> Marker {
    let own = car_body(carried);
    let axes = fixed(own.frame.orientation);
    Marker {
        origin: axes.apply_transposed(Vector(place) - Vector(own.frame.origin)),
        rotation: axes.transpose(),
    }
}

/// Adds what rails lie on where it can be moved.
fn beds(model: &mut Model) -> [[usize; 2]; 4] {
    [0, 1, 2, 3].map(|w| {
        ["left", "right"].map(|side| {
            model.bodies.push(rail_bed(&format!("rail_bed_{}_{side}", w + 1)));
            model.bodies.len() - 1
        })
    })
}

/// Adds wheels.
fn wheels(
    model: &mut Model,
    parameters: &Parameters,
    searches: &[[Search; 2]],
    lines: &Arc<RailLines>,
    (wheelsets, rails, track): ([usize; 4], Option<[[usize; 2]; 4]>, Marker),
) -> WheelElements {
    match &parameters.wheels {
        Wheels::OnRails(own) => {
            let half = 0.5 * own.tape_distance;
            let elements = [0, 1, 2, 3].map(|w| {
                [0, 1].map(|i| {
                    let wheel = WheelOnRail {
                        name: format!("wheel_{}_{}", w + 1, ["left", "right"][i]),
                        lines: lines.clone(),
                        side: [Side::Left, Side::Right][i],
                        search: searches[w][i].clone(),
                        law: own.laws[i].clone(),
                        roll: parameters.support.as_ref().and_then(RailSupport::rolling),
                    };
                    let on = rails.map_or(0, |rails| rails[w][i]);
                    let at = (wheelsets[w], marker([half, -half][i]));
                    WheelElement::add(model, wheel, at, (on, track))
                })
            });
            WheelElements::OnRails(Box::new(elements), half)
        }
        Wheels::Linear { wheelset, support } => {
            let element = |name: String| LinearOnTrack {
                name,
                lines: lines.clone(),
                wheelset: *wheelset,
                support: *support,
                slowest: SLOWEST,
            };
            for (w, own) in wheelsets.into_iter().enumerate() {
                let element = element(format!("wheelset_{}", w + 1));
                model.add(element, (own, marker(0.0)), (0, track));
            }
            WheelElements::Linear(Box::new(element(String::new())))
        }
    }
}
