//! The shaken start: what friction holds in a car that has run for a while.
//!
//! From its equilibrium the car runs 3 s at 60 mph on tangent track of FRA class 3, realized by the spectra
//! and seeds of the built-in regime `fra_class_3`. Then the irregularities fade within 30 m, and it runs on
//! for 2 s on perfect track, where its own friction stops what still moves: a car that were stopped while it
//! rolls would keep that roll. Times, speed and class are choices (guess). Its bodies, as they then stand to
//! each other, and all bristles and accumulators are put on straight perfect track, where the car comes to
//! rest with its whole friction: what sticks goes on sticking, up to its limit. Wheelsets stand in the middle
//! there. This state is the start of every speed, on every track; it is computed once a car in a program.

use std::sync::{Arc, Mutex, PoisonError};

use integrate::{Integrator, Method, Options};
use mechanics::vector::{Matrix, Vector, rotation_z};
use rolling::wheel::Search;
use truck::WedgeLoads;
use wheelrail::track::spectrum::{Realization, Spectrum};
use wheelrail::track::{CenterLine, Direction, Irregularity, Placed, Rails, Samples, Segment, Track};

use crate::assemble::{Car, searches};
use crate::body::{Carried, Pose};
use crate::derailment::Derailment;
use crate::error::BuildError;
use crate::parameters::{Drive, Parameters, Start, Wheels};
use crate::start::{Resting, at_rest, at_rest_from, internal_states};

/// Time for which a car is shaken, s; its speed, mph; the class of the track.
pub(crate) const SECONDS: f64 = 3.0;
pub(crate) const MILES_PER_HOUR: f64 = 60.0;
pub(crate) const CLASS: u8 = 3;
/// The speed, m/s.
const SPEED: f64 = MILES_PER_HOUR * 0.447_04;
/// Wavelengths (m), number and taper (m) of the waves of its irregularities, as track files have them.
const WAVES: [f64; 2] = [1.5, 91.44];
const TERMS: usize = 1000;
const TAPER: f64 = 30.0;
/// Distance of the samples of its irregularities, m: 15 for the shortest wave.
const STEP: f64 = 0.1;
/// Time on perfect track afterwards, s, and of the whole run.
const RUN_OUT: f64 = 2.0;
const DURATION: f64 = SECONDS + TAPER / SPEED + RUN_OUT;
/// Gain of the drive, N·s/m.
const GAIN: f64 = 1e5;
/// Relative tolerance of the run by TR-BDF2, which damps the vibrations of contacts: columns come within
/// 0.5 % of those at 1e-5, and of those by ESDIRK3 at 1e-6.
const TOLERANCE: f64 = 1e-4;
/// Time between two looks at whether the wheels are on their rails, s.
const LOOK: f64 = 0.02;
/// A run of more steps does not move on.
const MOST_STEPS: usize = 50_000;
/// The most cars that are kept, the last ones.
const KEPT: usize = 16;

/// A shaken car.
#[derive(Clone, Debug)]
pub(crate) struct Shaken {
    /// At rest on straight track, wheelsets in the middle.
    pub rest: Resting,
    /// The wedges of both trucks before, in the equilibrium without friction.
    pub before: [[WedgeLoads; 4]; 2],
}

/// Who asks for the same car while it is shaken waits for it.
type Kept = (String, Arc<Mutex<Option<Arc<Shaken>>>>);
static KNOWN: Mutex<Vec<Kept>> = Mutex::new(Vec::new());

/// Returns the car shaken: whatever its track, its speed and the place of its start are, it has the same
/// bits.
pub(crate) fn shaken(parameters: &Parameters) -> Result<Arc<Shaken>, BuildError> {
    let mut own = shaking(parameters)?;
    let key = format!("{own:?}");
    let place = {
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        match known.iter().find(|(other, _)| *other == key) {
            Some((_, place)) => place.clone(),
            None => {
                let place = Arc::new(Mutex::new(None));
                if known.len() >= KEPT {
                    known.remove(0);
                }
                known.push((key, place.clone()));
                place
            }
        }
    };
    let mut place = place.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(found) = &*place {
        return Ok(found.clone());
    }
    own.track.irregularities = irregularities(own.start.distance)?;
    let found = Arc::new(compute(&own)?);
    *place = Some(found.clone());
    Ok(found)
}

/// Returns the car on the track on which it is shaken, which is perfect yet.
fn shaking(parameters: &Parameters) -> Result<Parameters, BuildError> {
    let mut own = parameters.clone();
    let reach = own.reach();
    let length = 2.0 * reach + 1.05 * DURATION * SPEED + 10.0;
    own.track = Track {
        center_line: CenterLine::new(
            &[Segment::Tangent(length)],
            parameters.track.center_line.rail_distance(),
            &[],
        )?,
        irregularities: Vec::new(),
    };
    own.start = Start::at(reach + 1.0, SPEED);
    own.drive = Drive::Held { gain: GAIN };
    own.couplers = own.couplers.idle();
    if let Wheels::OnRails(wheels) = &mut own.wheels {
        *wheels = wheels.standing();
        // Tables have no flanges.
        wheels.tables = false;
    }
    Ok(own)
}

/// Returns the irregularities of the track for a car that starts at this distance, m.
fn irregularities(start: f64) -> Result<Vec<Placed>, BuildError> {
    let all = [
        (Spectrum::FraVertical(CLASS), Rails::Both, Direction::Vertical),
        (
            Spectrum::FraCrossLevel(CLASS),
            Rails::Against,
            Direction::Vertical,
        ),
        (Spectrum::FraLateral(CLASS), Rails::Both, Direction::Lateral),
    ];
    let end = start + SECONDS * SPEED + TAPER;
    let count = (end / STEP).ceil() as usize;
    let distances: Vec<f64> = (0..=count).map(|k| k as f64 * STEP).collect();
    let placed = (1..).zip(all).map(|(seed, (spectrum, rails, direction))| {
        let whole = Realization::new(spectrum, WAVES, TERMS, f64::MIN_POSITIVE, seed)
            .map_err(|error| BuildError::ShakingTrack(error.to_string()))?;
        let values = distances.iter().map(|distance| whole.at(*distance)[0]).collect();
        let tapered = Samples::new(distances.clone(), values, TAPER)
            .map_err(|error| BuildError::ShakingTrack(error.to_string()))?;
        Ok(Placed {
            rails,
            direction,
            irregularity: Irregularity::Samples(tapered),
        })
    });
    placed.collect()
}

fn compute(own: &Parameters) -> Result<Shaken, BuildError> {
    let carried = Carried::new(own);
    let searches: Vec<[Search; 2]> = searches(&own.wheels)?;
    let offsets = own.rail_offsets();
    let before = at_rest(own, &carried, &searches, offsets)?;
    let (car, mut poses, mut state) = run(own)?;
    // Wheels stand on the track as before, and rails under them roll as before.
    car.system.set_element_states(&before.states, &mut state);
    let internal = state[internal_states(&car.system)].to_vec();
    let wheelsets = car.numbers.wheelsets;
    let [from, to] = [&poses, &before.poses].map(|own| frames(own, wheelsets, false));
    let rails = car.numbers.rails.into_iter().flatten().flatten();
    let on_track: Vec<usize> = wheelsets.into_iter().chain(rails).collect();
    for (number, group) in car.groups.iter().copied() {
        poses[number] = poses[number].before(&from[group]).after(&to[group]);
    }
    for number in on_track {
        poses[number] = before.poses[number];
    }
    let parts = (own, &carried, &*searches, offsets);
    // Free wheelsets relax what the adapters hold, and move aside by it; then they stand in the middle.
    let mut loose = at_rest_from(parts, &poses, &internal, false)?;
    center(&mut loose.poses, &before.poses, wheelsets, &car.groups);
    Ok(Shaken {
        rest: at_rest_from(parts, &loose.poses, &loose.internal, true)?,
        before: before.wedges,
    })
}

/// Runs the car; returns it with the poses of its bodies and its internal states at the end.
fn run(own: &Parameters) -> Result<(Car, Vec<Pose>, Vec<f64>), BuildError> {
    let car = Car::new(own)?;
    let fails = |time: f64, reason: String| BuildError::Shaking { time, reason };
    let options = Options {
        relative_tolerance: TOLERANCE,
        ..Options::of(Method::TrBdf2)
    };
    let mut system = car.system.clone();
    let rates = vec![0.0; car.initial_state.len()];
    let seen = system.observe(0.0, &car.initial_state);
    let heights = car.loads(&seen, &rates).axles.map(|axle| axle.height);
    let mut integrator = Integrator::new(car.system.clone(), options, 0.0, &car.initial_state)
        .map_err(|error| fails(0.0, format!("the run cannot begin: {error}")))?;
    let (mut steps, mut next) = (0, LOOK);
    while integrator.time() < DURATION {
        let before = integrator.time();
        integrator
            .step_to(DURATION)
            .map_err(|error| fails(before, format!("the run stops: {error}")))?;
        steps += 1;
        if steps > MOST_STEPS {
            return Err(fails(
                before,
                format!("the car has not come further in {MOST_STEPS} steps"),
            ));
        }
        if integrator.time() >= next {
            next += LOOK;
            let seen = system.observe(integrator.time(), integrator.x());
            let loads = car.loads(&seen, &rates);
            if let Some(left) = Derailment::of(&loads, &own.track, [None; 2], heights) {
                let words = left.words(&format!("{:.1} m", left.distance));
                return Err(fails(integrator.time(), words));
            }
        }
    }
    let x = integrator.x();
    let seen = system.observe(integrator.time(), x);
    let poses = seen.bodies.iter().map(|state| Pose {
        place: state.origin,
        rotation: state.rotation,
    });
    Ok((car, poses.collect(), x.to_vec()))
}

/// Returns the axes of front truck, rear truck and body that go with their wheelsets: forward, left, up;
/// flat ones leave heights, pitch and roll alone.
fn frames(poses: &[Pose], wheelsets: [usize; 4], flat: bool) -> [Pose; 3] {
    let axes = |along: Vector<f64>, left: Vector<f64>| -> Matrix<f64> {
        let (along, up) = match flat {
            true => (Vector([along.0[0], along.0[1], 0.0]), Vector([0.0, 0.0, 1.0])),
            false => (along, along.cross(left)),
        };
        let [x, z] = [along, up].map(unit);
        let y: Vector<f64> = z.cross(x);
        Matrix([0, 1, 2].map(|row| [x.0[row], y.0[row], z.0[row]]))
    };
    let middle = |a: Vector<f64>, b: Vector<f64>| -> Vector<f64> {
        let Vector([x, y, z]) = (a + b).scale::<f64, f64>(0.5);
        Vector([x, y, if flat { 0.0 } else { z }])
    };
    let trucks = [0, 1].map(|t| {
        let [front, rear] = [0, 1].map(|k| &poses[wheelsets[2 * t + k]]);
        // A wheelset's first axis is its axle, to the left.
        let left = front.rotation.column(0) + rear.rotation.column(0);
        Pose {
            place: middle(front.place, rear.place),
            rotation: axes(front.place - rear.place, left),
        }
    });
    let [front, rear] = trucks;
    let left = front.rotation.column(1) + rear.rotation.column(1);
    let body = Pose {
        place: middle(front.place, rear.place),
        rotation: axes(front.place - rear.place, left),
    };
    [front, rear, body]
}

/// Moves trucks and body aside and turns them so that the wheelsets stand as in `to`, then each wheelset.
fn center(poses: &mut [Pose], to: &[Pose], wheelsets: [usize; 4], groups: &[(usize, usize)]) {
    let [from, wanted] = [&*poses, to].map(|own| frames(own, wheelsets, true));
    for (number, group) in groups.iter().copied() {
        poses[number] = poses[number].before(&from[group]).after(&wanted[group]);
    }
    for number in wheelsets {
        let (own, to) = (&mut poses[number], &to[number]);
        let heading = |pose: &Pose| {
            let [x, y, _] = pose.rotation.column(0).0;
            libm::atan2(-x, y)
        };
        let turn: Matrix<f64> = rotation_z(libm::sincos(heading(to) - heading(own)));
        own.rotation = turn.times(own.rotation);
        let [x, y, _] = to.place.0;
        own.place = Vector([x, y, own.place.0[2]]);
    }
}

fn unit(v: Vector<f64>) -> Vector<f64> {
    v.scale::<f64, f64>(1.0 / v.dot::<f64, f64>(v).sqrt())
}
