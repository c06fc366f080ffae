//! Wheelsets and trucks of a description, and the track that they run on.
//!
//! The vehicle begins on straight track: until beyond its last axle the center line must not curve. There
//! it is put as it rests on straight perfect track, and all of it moves at the speed of the start; wheels
//! roll.

use std::sync::Arc;

use car::{ClimbLimits, Drive, ProfiledWheels, WheelLoads};
use mechanics::body::Body;
use mechanics::link::Marker;
use mechanics::system::{BodyState, Model, Observation};
use mechanics::vector::{Matrix, Vector};
use rolling::beam::SharedSprings;
use rolling::track::{RailSupport, rail_bed, rail_body};
use rolling::wheel::{Search, WheelOnRail, motion_of};
use rolling::wheelset::{WheelsetBody, WheelsetPlace, coordinate, marker};
use wheelrail::contact::Side;
use wheelrail::loaded::Seat;
use wheelrail::track::{CenterLine, Line, RailLines, Segment, Track, TrackError, TrackSection};

/// Length of straight track before and behind a vehicle that comes to rest, m.
const ROOM: f64 = 10.0;
/// The names of the sides in columns.
pub(crate) const SIDES: [&str; 2] = ["left", "right"];

/// What runs on a track.
#[derive(Clone, Debug)]
pub struct OnTrack {
    /// The track.
    pub track: Track,
    /// Profiles, gauge, creep; all wheelsets are as the first one of these.
    pub wheels: ProfiledWheels,
    /// Mass properties of each wheelset.
    pub wheelset: WheelsetBody,
    /// Springs under each rail; none: rails do not give way.
    pub support: Option<RailSupport>,
    /// True if what each rail lies on under each wheel can be moved
    /// ([`mechanics::system::System::set_motions`]): a bridge, a rig.
    pub movable_rails: bool,
    /// Wheelsets outside of trucks.
    pub wheelsets: Vec<WheelsetPart>,
    /// Trucks.
    pub trucks: Vec<TruckPart>,
    /// What keeps the vehicle moving.
    pub drive: Drive,
    /// The body that the drive pushes (1: the first of the description), and the height at which, m.
    pub driven: (usize, f64),
    /// Accelerometers besides those above the centers of trucks.
    pub accelerometers: Vec<Accelerometer>,
    /// Distance along the track of the layout's origin at the start, m.
    pub distance: f64,
    /// Speed at the start, m/s.
    pub speed: f64,
}

/// A wheelset.
#[derive(Clone, Debug, PartialEq)]
pub struct WheelsetPart {
    /// Its name.
    pub name: String,
    /// Its place along the track in the nominal layout, m.
    pub x: f64,
    /// The name of the truck that it belongs to, for the forces of a truck's side; none: to none.
    pub truck: Option<String>,
}

/// What the accelerations of an accelerometer are taken as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AccelerometerOf {
    /// Of a vehicle's body: ride, low-pass filtered.
    #[default]
    Body,
    /// Of the frame of a truck: hunting, in a band.
    Truck,
}

/// An accelerometer on a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Accelerometer {
    /// Its name, with which its columns begin.
    pub name: String,
    /// The body that it is on (1: the first of the description).
    pub body: usize,
    /// Its place in the nominal layout, m.
    pub at: [f64; 3],
    /// What it is taken as.
    pub of: AccelerometerOf,
}

/// A three-piece truck under a body.
#[derive(Clone, Debug, PartialEq)]
pub struct TruckPart {
    /// Its name, with which those of its bodies, elements and columns begin.
    pub name: String,
    /// The place of its center along the track in the nominal layout, m.
    pub x: f64,
    /// The body that stands on it (1: the first of the description).
    pub body: usize,
    /// Its parameters, with wheelsets, center plate and side bearings.
    pub parameters: Box<truck::Parameters>,
}

impl OnTrack {
    /// Returns the names of all wheelsets with their places along the track, m: those of trucks first.
    #[must_use]
    pub fn all_wheelsets(&self) -> Vec<(String, f64)> {
        let of_trucks = self.trucks.iter().flat_map(|own| {
            let axle = own.parameters.geometry.axle();
            [(1, axle), (2, -axle)]
                .map(|(number, at)| (format!("{}_wheelset_{number}", own.name), own.x + at))
        });
        let single = self.wheelsets.iter().map(|own| (own.name.clone(), own.x));
        of_trucks.chain(single).collect()
    }

    /// Returns all accelerometers: those on the body above the center of each truck, at the height of its
    /// center plate, by the name `BODY_at_TRUCK` (the names of the bodies are given), then the others.
    #[must_use]
    pub fn all_accelerometers(&self, bodies: &[&str]) -> Vec<Accelerometer> {
        let above = self.trucks.iter().map(|own| {
            let plate = own.parameters.car_body.as_ref();
            Accelerometer {
                name: format!("{}_at_{}", bodies.get(own.body - 1).unwrap_or(&"body"), own.name),
                body: own.body,
                at: [own.x, 0.0, plate.map_or(0.0, |car| car.center_plate.height)],
                of: AccelerometerOf::Body,
            }
        });
        above.chain(self.accelerometers.iter().cloned()).collect()
    }

    /// Returns what the flanges of all wheelsets climb at.
    #[must_use]
    pub fn climb_limits(&self) -> ClimbLimits {
        let count = 2 * self.trucks.len() + self.wheelsets.len();
        ClimbLimits::of_wheels(&self.wheels).of_axles(count)
    }

    /// Returns the largest distance of a wheelset from the layout's origin, m.
    #[must_use]
    pub fn reach(&self) -> f64 {
        let places = self.all_wheelsets().into_iter();
        places.map(|(_, x)| x.abs()).fold(0.0, f64::max)
    }

    /// Returns the nominal radius of the wheels, m.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.wheels.geometry[0].pairs()[0].nominal_radius()
    }

    /// Returns the longest step (s) that does not miss a flat or a wave of a wheel; infinite of round wheels.
    #[must_use]
    pub fn longest_step(&self) -> f64 {
        self.wheels.longest_step(self.drive.fastest(self.speed))
    }

    /// Returns the springs of rails that the wheels of a truck share; none where rails are no beams.
    fn shared(&self, truck: &TruckPart) -> Option<SharedSprings> {
        let support = self.support.as_ref()?;
        let wheelbase = truck.parameters.geometry.wheelbase;
        Some(support.beam.as_ref()?.shared(support, wheelbase))
    }

    /// Returns the rails of the track.
    pub(crate) fn lines(&self) -> Arc<RailLines> {
        let offsets = self.wheels.geometry[0].rail_origins();
        Arc::new(RailLines::new(self.track.clone(), offsets))
    }

    /// Returns the same on straight perfect track without a drive, with so much of it ahead (m), and the
    /// place on it where the layout's origin then is, m.
    pub(crate) fn standing(&self, ahead: f64) -> Result<(Self, f64), TrackError> {
        let middle = self.reach() + ROOM;
        let distance = self.track.center_line.rail_distance();
        let center_line = CenterLine::new(&[Segment::Tangent(2.0 * middle + ahead)], distance, &[])?;
        let standing = Self {
            track: Track {
                center_line,
                irregularities: Vec::new(),
            },
            wheels: self.wheels.standing(),
            drive: Drive::Coasting,
            distance: middle,
            speed: 0.0,
            ..self.clone()
        };
        Ok((standing, middle))
    }

    /// Returns the places of the wheelsets in the nominal layout (m, rising) with the level of the actual
    /// rails there at the start: to the left, up (m), and roll (rad).
    pub(crate) fn levels(&self) -> Vec<(f64, [f64; 3])> {
        let lines = self.lines();
        let apart = self.track.center_line.rail_distance();
        let mut levels: Vec<(f64, [f64; 3])> = self
            .all_wheelsets()
            .into_iter()
            .map(|(_, x)| {
                let [left, right] = lines.irregularities(self.distance + x);
                let lateral = 0.5 * (left[0] + right[0]);
                let vertical = 0.5 * (left[1] + right[1]);
                (x, [lateral, vertical, (left[1] - right[1]) / apart])
            })
            .collect();
        levels.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        levels
    }

    /// Returns why the vehicle cannot start where it is to; `None` if it can.
    #[must_use]
    pub fn misplaced(&self) -> Option<String> {
        let (reach, length) = (self.reach(), self.track.center_line.length());
        let [first, last] = [self.distance - reach, self.distance + reach];
        if first < 0.0 || last > length {
            return Some(format!(
                "its axles would be from {first:.2} to {last:.2} m on a track of {length:.2} m"
            ));
        }
        let steps = 200;
        let curves = (0..=steps).any(|step| {
            let at = last * f64::from(step) / f64::from(steps);
            self.track.center_line.at(at).curvature[0] != 0.0
        });
        curves.then(|| {
            format!(
                "the track curves before {last:.2} m, but a vehicle of one's own starts on straight track"
            )
        })
    }
}

/// A wheelset of a vehicle in its system.
#[derive(Clone, Debug)]
pub struct Axle {
    /// Its name.
    pub name: String,
    /// The number of its body.
    pub body: usize,
    /// The bodies that its left and right rail lie on, if they can be moved.
    pub beds: Option<[usize; 2]>,
    /// The bodies under its left and right wheel.
    under: [usize; 2],
    wheels: [WheelOnRail; 2],
    /// The numbers of the wheels among the elements.
    elements: [usize; 2],
    /// The rails under it, if they are beams.
    beam: Option<UnderAxle>,
    half: f64,
    radius: f64,
    lines: Arc<RailLines>,
}

/// Rails that are beams, under a wheelset.
#[derive(Clone, Copy, Debug)]
struct UnderAxle {
    /// Height of the heads, m.
    height: f64,
    /// The share of the rolls under another wheelset that is felt here, and the numbers of its wheels among
    /// the elements.
    neighbor: Option<(f64, [usize; 2])>,
}

/// A wheelset against the track, with its wheels on the rails.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxleState {
    /// Distance along the track, m.
    pub distance: f64,
    /// To the left of the center line, m.
    pub lateral: f64,
    /// Center above the nominal radius, square to the plane of the rails, m.
    pub vertical_place: f64,
    /// Roll to the plane of the track, left side up, rad.
    pub roll: f64,
    /// Yaw to the track, positive to the left, rad.
    pub yaw: f64,
    /// Angle of the spin, rad.
    pub spin: f64,
    /// The left and the right wheel on their rails.
    pub wheels: [WheelLoads; 2],
    /// By how much the heads of both rails have moved apart under it, m: zero where rails do not give way.
    pub gauge_widening: f64,
}

impl Axle {
    /// Returns its state at an observation.
    #[must_use]
    pub fn state(&self, seen: &Observation) -> AxleState {
        let own = &seen.bodies[self.body];
        let section = section(&self.lines, own);
        let axle = section.of(own.rotation.column(0).0);
        let [_, lateral, height] = section.of((own.origin - Vector(section.origin)).0);
        let mut state = AxleState {
            distance: section.distance,
            lateral,
            vertical_place: height - self.radius,
            roll: libm::asin(axle[2].clamp(-1.0, 1.0)),
            spin: own.coordinates[coordinate::SPIN],
            yaw: -libm::asin(axle[0].clamp(-1.0, 1.0)),
            ..AxleState::default()
        };
        state.wheels = [0, 1].map(|i| {
            let motion = self.motion(seen, i);
            WheelLoads::of((&self.wheels[i], i), (&motion, self.states(seen, i)), &section)
        });
        if let Some(beam) = &self.beam {
            for (i, sign) in [1.0, -1.0].into_iter().enumerate() {
                let roll = &mut state.wheels[i].rail_roll;
                if let Some((share, elements)) = beam.neighbor {
                    let states = seen.elements[elements[i]].states;
                    *roll += share * self.wheels[i].rail_roll(states)[0];
                }
                let bed = self.beds.map_or(0, |beds| beds[i]);
                let moved = seen.bodies[self.under[i]].origin - seen.bodies[bed].origin;
                state.gauge_widening += sign * section.of(moved.0)[1] + beam.height * *roll;
            }
        }
        state
    }

    fn states(&self, seen: &Observation, side: usize) -> [f64; 2] {
        seen.elements[self.elements[side]].states
    }

    /// Returns whether the rails under it are beams.
    #[must_use]
    pub fn is_on_beams(&self) -> bool {
        self.beam.is_some()
    }

    fn motion(&self, seen: &Observation, side: usize) -> mechanics::link::RelativeMotion<f64> {
        let left = [self.half, -self.half][side];
        let under = &seen.bodies[self.under[side]];
        motion_of(&seen.bodies[self.body], left, under, Matrix::identity())
    }

    /// Returns the distance along the track (m) at which one of its wheels has left its rail, and this in
    /// words.
    #[must_use]
    pub fn left_rail(&self, seen: &Observation) -> Option<(f64, String)> {
        let left = |side: &usize| {
            self.wheels[*side].seat(&self.motion(seen, *side), self.states(seen, *side)) != Seat::OnRail
        };
        let side = SIDES[[0, 1].into_iter().find(left)?];
        let (at, name) = (self.state(seen).distance, self.name.replace('_', " "));
        let words = format!("the {side} wheel of {name} left its rail at {at:.1} m along the track");
        Some((at, words))
    }
}

/// Returns the section of the track's center line at a body.
pub(crate) fn section(lines: &RailLines, body: &BodyState) -> TrackSection<f64> {
    lines.section(Line::Center, body.center_of_gravity.0)
}

/// Returns the body of a wheelset at a place of the nominal layout.
pub(crate) fn wheelset_body(on: &OnTrack, name: &str, x: f64) -> Body {
    let mut body = on.wheelset.body(name, &WheelsetPlace::default());
    body.frame.origin = [x, 0.0, on.radius()];
    body
}

/// Adds rails and wheels of these wheelsets (names and numbers) to a model.
pub(crate) fn add_wheels(
    model: &mut Model,
    on: &OnTrack,
    searches: &[Search; 2],
    lines: &Arc<RailLines>,
    wheelsets: &[(String, usize)],
) -> Vec<Axle> {
    let track = Marker::new([0.0; 3], [0.0; 3]);
    let beds: Vec<Option<[usize; 2]>> = wheelsets
        .iter()
        .map(|(name, _)| {
            on.movable_rails.then(|| {
                SIDES.map(|side| {
                    model.bodies.push(rail_bed(&format!("{name}_{side}_rail_bed")));
                    model.bodies.len() - 1
                })
            })
        })
        .collect();
    // The wheelsets of trucks come first. Rails that are beams are shared within trucks.
    let shared: Vec<_> = on.trucks.iter().map(|truck| on.shared(truck)).collect();
    let ground = |number: usize, support: &RailSupport| match shared.get(number / 2) {
        Some(Some(own)) => own.ground.clone(),
        _ => support.clone(),
    };
    let under: Vec<[usize; 2]> = wheelsets
        .iter()
        .zip(&beds)
        .enumerate()
        .map(|(axle, ((name, _), beds))| {
            let beds = beds.unwrap_or([0; 2]);
            let Some(support) = &on.support else { return beds };
            [0, 1].map(|i| {
                let side = SIDES[i];
                let number = model.bodies.len();
                let mut rail = rail_body(support);
                rail.name = format!("{name}_{side}_rail");
                model.bodies.push(rail);
                let own = RailSupport {
                    name: format!("{name}_{side}_rail_support"),
                    ..ground(axle, support)
                };
                model.add(own, (number, track), (beds[i], track));
                number
            })
        })
        .collect();
    for (truck, shared) in shared.iter().enumerate() {
        let Some(shared) = shared else { continue };
        for (i, side) in SIDES.into_iter().enumerate() {
            let [front, rear] = [2 * truck, 2 * truck + 1].map(|axle| under[axle][i]);
            let between = RailSupport {
                name: format!("{}_{side}_rails", on.trucks[truck].name),
                ..shared.between.clone()
            };
            model.add(between, (front, track), (rear, track));
        }
    }
    let half = 0.5 * on.wheels.tape_distance;
    let axles = wheelsets.iter().zip(beds).zip(under);
    axles
        .map(|(((name, body), beds), under)| Axle {
            name: name.clone(),
            body: *body,
            beds,
            under,
            wheels: [0, 1].map(|i| WheelOnRail {
                name: format!("{name}_{}_wheel", SIDES[i]),
                lines: lines.clone(),
                side: [Side::Left, Side::Right][i],
                search: searches[i].clone(),
                law: on.wheels.laws[i].clone(),
                roll: on.support.as_ref().and_then(RailSupport::rolling),
            }),
            elements: [0; 2],
            beam: None,
            half,
            radius: on.radius(),
            lines: lines.clone(),
        })
        .collect()
}

/// Adds the elements of all wheels; wheelsets of trucks, which come first, share rails that are beams.
pub(crate) fn mount_wheels(model: &mut Model, axles: &mut [Axle], on: &OnTrack) {
    let track = Marker::new([0.0; 3], [0.0; 3]);
    for axle in &mut *axles {
        for i in 0..2 {
            let left = [axle.half, -axle.half][i];
            let at = (axle.body, marker(left));
            axle.elements[i] = model.elements.len();
            model.add(axle.wheels[i].clone(), at, (axle.under[i], track));
        }
    }
    let Some(beam) = on.support.as_ref().and_then(|support| support.beam.as_ref()) else {
        return;
    };
    let elements: Vec<[usize; 2]> = axles.iter().map(|axle| axle.elements).collect();
    for (number, axle) in axles.iter_mut().enumerate() {
        let neighbor = on.trucks.get(number / 2).and_then(|truck| {
            let share = beam.roll(truck.parameters.geometry.wheelbase) / beam.roll(0.0);
            Some((share, *elements.get(number ^ 1)?))
        });
        let height = beam.height;
        axle.beam = Some(UnderAxle { height, neighbor });
    }
}
