//! Parameters of a car on track, SI units.
//!
//! Default values are one consistent set: a car of 263,000 lbf with all that it carries, on two of the
//! trucks of [`truck::Parameters`], truck centers 486 in apart. Weights of wheelsets are what these leave
//! of the car's weight.

use std::sync::Arc;

use quantity::length_hint;
use rolling::track::RailSupport;
use rolling::wheelset::WheelsetBody;
use truck::{RigidBody, WedgeKind};
use wheelrail::contact::{ContactLaw, LinearWheelset, WheelForm};
use wheelrail::profile::{Profile, SlicedProfile};
use wheelrail::track::Track;
use wheelrail::wheelset::RigidWheelset;

use crate::body::Carried;
use crate::coupler::Couplers;
use crate::error::InvalidParameter;

/// A rigid mass that the car body carries, fastened to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Mass {
    /// Its name, for messages.
    pub name: String,
    /// Mass, kg.
    pub mass: f64,
    /// The place of its center of gravity: forward of the middle between the trucks, to the left of the
    /// middle, above the top of rail, m, in the nominal layout of the trucks.
    pub place: [f64; 3],
    /// Moments of inertia about its center of gravity (roll, pitch, yaw), kg·m².
    pub inertia: [f64; 3],
}

/// Wheels and what they touch.
#[derive(Clone, Debug)]
pub enum Wheels {
    /// Profiles of wheels on profiles of rails.
    OnRails(ProfiledWheels),
    /// Linear geometry and creep, for stability on straight or gently curved track without irregularities,
    /// whose rails do not give way.
    Linear {
        /// Geometry and coefficients.
        wheelset: LinearWheelset,
        /// Stiffness of what carries a wheelset: vertically N/m, and in roll N·m/rad.
        support: [f64; 2],
    },
}

/// Wheels on rails.
#[derive(Clone, Debug)]
pub struct ProfiledWheels {
    /// Of each wheelset: profiles of both wheels and both rails, gauge and distance of the tape circles.
    /// Alike wheelsets share one.
    pub geometry: [Arc<RigidWheelset>; 4],
    /// Profiles of the left and the right wheel of each wheelset.
    pub wheels: [[Arc<Profile>; 2]; 4],
    /// Profiles of the left and the right rail.
    pub rails: [Arc<Profile>; 2],
    /// Rails whose sections change along the track, left and right. The car comes to rest on `rails`, which
    /// these are where it starts.
    pub rails_over: [Option<Arc<SlicedProfile>>; 2],
    /// Forms of the left and the right wheel of each wheelset that are not round. The car comes to rest on
    /// round wheels.
    pub forms: [[Option<WheelForm>; 2]; 4],
    /// Distance of the tape circles, m.
    pub tape_distance: f64,
    /// True if patches come from tables: faster, for motion on treads only.
    pub tables: bool,
    /// Friction, creep law and damping of the contacts on the left and on the right rail.
    pub laws: Box<[ContactLaw; 2]>,
}

impl ProfiledWheels {
    /// Returns round wheels on rails that do not change along the track.
    #[must_use]
    pub fn standing(&self) -> Self {
        Self {
            rails_over: [None, None],
            forms: Default::default(),
            ..self.clone()
        }
    }

    /// Returns whether wheels are round on rails that do not change along the track.
    #[must_use]
    pub fn stands(&self) -> bool {
        self.rails_over.iter().all(Option::is_none) && self.forms.iter().flatten().all(Option::is_none)
    }

    /// Returns the height of a wheelset on wheels that are not round above that on round ones (m) with the
    /// roll of its axle (rad, left side up), and their derivatives by the spin, at no spin.
    #[must_use]
    pub fn rise(&self, wheelset: usize) -> [[f64; 2]; 2] {
        let of = |form: &Option<WheelForm>| form.as_ref().map_or([0.0; 2], |form| form.height(0.0));
        let [left, right] = self.forms[wheelset].each_ref().map(of);
        [0, 1].map(|order| {
            let (left, right) = (left[order], right[order]);
            [0.5 * (left + right), (left - right) / self.tape_distance]
        })
    }

    /// Returns the longest step (s) that does not miss a flat or a wave at a speed (m/s); infinite of round
    /// wheels.
    #[must_use]
    pub fn longest_step(&self, speed: f64) -> f64 {
        let forms = self.forms.iter().flatten().flatten();
        forms.map(WheelForm::finest).fold(f64::INFINITY, f64::min) / speed.abs()
    }
}

/// Speed control of a car.
#[derive(Clone, Debug, PartialEq)]
pub enum Drive {
    /// A force on the car body along the track, proportional to what lacks in speed, that of the start.
    Held {
        /// Force by speed, N·s/m.
        gain: f64,
    },
    /// As `Held`, to a speed that depends on the distance along the track: pairs of distance (m, rising)
    /// and speed (m/s), linear between them, constant before and after.
    Over {
        /// Force by speed, N·s/m.
        gain: f64,
        /// Distances (m) and speeds (m/s).
        speeds: Vec<[f64; 2]>,
    },
    /// As `Held`, to the speed of a history: pairs of time (s, from zero on, rising) and speed (m/s,
    /// positive), linear between them, constant before and after. What is wanted at a place is the speed of
    /// the history at the time when a car that follows it comes there: a car that lags meets it later.
    History {
        /// Force by speed, N·s/m.
        gain: f64,
        /// Times (s) and speeds (m/s).
        speeds: Vec<[f64; 2]>,
    },
    /// Nothing.
    Coasting,
}

impl Drive {
    /// Returns the largest speed that is asked for, m/s, from a start at a speed.
    #[must_use]
    pub fn fastest(&self, start: f64) -> f64 {
        match self {
            Self::Held { .. } | Self::Coasting => start,
            Self::Over { speeds, .. } | Self::History { speeds, .. } => {
                speeds.iter().map(|[_, speed]| *speed).fold(start, f64::max)
            }
        }
    }

    /// Returns the force by speed, N·s/m; none of a car that coasts.
    #[must_use]
    pub fn gain(&self) -> Option<f64> {
        match self {
            Self::Held { gain } | Self::Over { gain, .. } | Self::History { gain, .. } => Some(*gain),
            Self::Coasting => None,
        }
    }
}

/// Place and speed at which a run begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Distance along the track of the middle between the trucks, m.
    pub distance: f64,
    /// Speed, m/s; wheels roll.
    pub speed: f64,
    /// Heading of the track's own axes in the fixed frame, rad: of no consequence.
    pub heading: f64,
    /// Shift of each wheelset, front to rear, to the left from the middle of the track, m: a disturbance.
    pub wheelset_shifts: [f64; 4],
    /// Shift of the body to the left from the middle of the track, m: a disturbance.
    pub body_shift: f64,
    /// The start of coils, plates, wedges and wheels.
    pub kind: StartKind,
    /// Time that the car settles after the start, s: statistics leave this out.
    pub settle: f64,
}

/// The start of coils, plates and wheels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StartKind {
    /// In the equilibrium of the car at rest on straight track, without friction, moved along the track.
    #[default]
    Equilibrium,
    /// In the nominal layout, each body at its place along the track.
    Nominal,
    /// At rest on straight track as the car is that has run 3 s at 60 mph on tangent track of FRA class 3
    /// from its equilibrium, with what friction holds then, moved along the track. Time, speed and class are
    /// choices.
    Shaken,
}

/// Checks pairs of a distance or time and a speed (m/s).
fn check_speeds(over: &str, unit: &str, speeds: &[[f64; 2]]) -> Result<(), InvalidParameter> {
    if speeds.is_empty() {
        let message = format!("the speeds over {over} are an empty list");
        return Err(InvalidParameter::missing(&message));
    }
    let what = format!("a {over} of the speeds over {over} ({unit})");
    for (number, [at, speed]) in speeds.iter().enumerate() {
        if !at.is_finite() {
            return Err(InvalidParameter::new(&what, *at, "a number"));
        }
        if number > 0 && *at <= speeds[number - 1][0] {
            return Err(InvalidParameter::new(&what, *at, "more than the one before it"));
        }
        if !(*speed >= 0.0 && speed.is_finite()) {
            let what = format!("a speed over {over} (m/s)");
            return Err(InvalidParameter::new(&what, *speed, "zero or positive"));
        }
    }
    Ok(())
}

/// Distances between the trucks of a car, m: shorter than any wagon's, longer than any's.
pub const TRUCK_DISTANCES: [f64; 2] = [1.0, 100.0];

/// Heights at which a body can have accelerometers, m.
pub const ACCELEROMETER_HEIGHTS: [f64; 2] = [0.0, 10.0];

/// Twist of the body: two halves on a torsion spring about the longitudinal axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torsion {
    /// Stiffness of the body between the truck centers, N·m/rad.
    pub stiffness: f64,
    /// Damping as a share of the critical one of its free vibration.
    pub damping: f64,
}

/// A car on a track.
#[derive(Clone, Debug)]
pub struct Parameters {
    /// Gravity, m/s².
    pub gravity: f64,
    /// The car body without lading; its height is that of the center of gravity above the top of rail in
    /// the nominal layout, which is that of the loaded car.
    pub body: RigidBody,
    /// Its load.
    pub lading: Vec<Mass>,
    /// Twist of body and lading; none: they are rigid.
    pub torsion: Option<Torsion>,
    /// From the center of one truck to that of the other, m.
    pub truck_distance: f64,
    /// Height of the accelerometers on the body above the truck centers, above the top of rail in the nominal
    /// layout, m; none: that of each truck's center plate.
    pub accelerometer_height: Option<f64>,
    /// Its couplers.
    pub couplers: Couplers,
    /// Front and rear truck. Each has wheelsets and a car body, of which the center plate and the side
    /// bearings count: mass, freedom and loads of the half body and of the wheelsets' motions are not used.
    /// Bolsters, side frames and wedge bodies are free in all six coordinates.
    pub trucks: [truck::Parameters; 2],
    /// Each of the four wheelsets.
    pub wheelset: WheelsetBody,
    /// The rails or the ground that they roll on.
    pub wheels: Wheels,
    /// The track.
    pub track: Track,
    /// Springs under each rail; none: rails do not give way.
    pub support: Option<RailSupport>,
    /// True if the base under each rail can be moved (`mechanics::system::System::set_motions`): a bridge, a
    /// rig. Rails under linear wheels cannot.
    pub movable_rails: bool,
    /// The drive that keeps it moving.
    pub drive: Drive,
    /// The start.
    pub start: Start,
}

impl Parameters {
    /// Returns the mass of body and lading, kg.
    #[must_use]
    pub fn carried_mass(&self) -> f64 {
        self.body.mass + self.lading.iter().map(|own| own.mass).sum::<f64>()
    }

    /// Returns the weight of the car, N: all that stands on the wheels.
    #[must_use]
    pub fn weight(&self) -> f64 {
        let trucks = self.trucks.iter().map(|own| {
            let frames: f64 = own.side_frames.iter().map(|frame| frame.body.mass).sum();
            own.bolster.body.mass + own.wedge_mass() + frames
        });
        (self.carried_mass() + trucks.sum::<f64>() + 4.0 * self.wheelset.mass) * self.gravity
    }

    /// Returns the height of the center of gravity of the whole car above the top of rail, m.
    #[must_use]
    pub fn height_of_center(&self) -> f64 {
        let [.., carried] = self.center_of_gravity();
        let mut moment = carried * self.carried_mass();
        for own in &self.trucks {
            let frames = own
                .side_frames
                .iter()
                .map(|frame| frame.body.mass * frame.body.height);
            moment += own.bolster.body.mass * own.bolster.body.height
                + own.wedge_mass() * own.geometry.wedge_height
                + frames.sum::<f64>()
                + 2.0 * self.wheelset.mass * own.geometry.axle_height;
        }
        moment * self.gravity / self.weight()
    }

    /// Returns the place of the center of gravity of body and lading: forward, to the left, above the top
    /// of rail, m.
    #[must_use]
    pub fn center_of_gravity(&self) -> [f64; 3] {
        let mut moment = [0.0, 0.0, self.body.mass * self.body.height];
        for own in &self.lading {
            for (sum, place) in moment.iter_mut().zip(own.place) {
                *sum += own.mass * place;
            }
        }
        moment.map(|own| own / self.carried_mass())
    }

    /// Checks all that makes a car.
    ///
    /// # Errors
    /// The first value that makes none.
    pub fn check(&self) -> Result<(), InvalidParameter> {
        let positive = |what: &str, value: f64| match value > 0.0 && value.is_finite() {
            true => Ok(()),
            false => Err(InvalidParameter::new(what, value, "positive")),
        };
        let finite = |what: &str, value: f64| match value.is_finite() {
            true => Ok(()),
            false => Err(InvalidParameter::new(what, value, "a number")),
        };
        positive("the car body's mass (kg)", self.body.mass)?;
        for value in self.body.inertia {
            positive("a moment of inertia of the car body (kg·m²)", value)?;
        }
        positive(
            "the height of the car body's center of gravity (m)",
            self.body.height,
        )?;
        for own in &self.lading {
            positive(&format!("the mass of {} (kg)", own.name), own.mass)?;
            for value in own.place {
                finite(&format!("the place of {} (m)", own.name), value)?;
            }
            for value in own.inertia {
                if !(value >= 0.0 && value.is_finite()) {
                    let what = format!("a moment of inertia of {} (kg·m²)", own.name);
                    return Err(InvalidParameter::new(&what, value, "zero or positive"));
                }
            }
        }
        if let Some(torsion) = &self.torsion {
            positive("the torsional stiffness of the body (N·m/rad)", torsion.stiffness)?;
            if !(torsion.damping >= 0.0 && torsion.damping.is_finite()) {
                let what = "the damping of the body's twist";
                return Err(InvalidParameter::new(what, torsion.damping, "zero or positive"));
            }
        }
        let [low, high] = TRUCK_DISTANCES;
        if !(self.truck_distance > low && self.truck_distance < high) {
            return Err(InvalidParameter::new(
                "the distance between the trucks (m)",
                self.truck_distance,
                &format!("between {low} and {high} m"),
            )
            .with(length_hint(self.truck_distance, TRUCK_DISTANCES)));
        }
        if let Some(height) = self.accelerometer_height {
            let [low, high] = ACCELEROMETER_HEIGHTS;
            if !(low..=high).contains(&height) {
                return Err(InvalidParameter::new(
                    "the height of the accelerometers (m)",
                    height,
                    &format!("between {low} and {high} m"),
                )
                .with(length_hint(height, ACCELEROMETER_HEIGHTS)));
            }
        }
        positive("the mass of a wheelset (kg)", self.wheelset.mass)?;
        positive(
            "a wheelset's moment of inertia about the axle (kg·m²)",
            self.wheelset.about_axle,
        )?;
        positive(
            "a wheelset's moment of inertia about a diameter (kg·m²)",
            self.wheelset.about_diameter,
        )?;
        for (own, which) in self.trucks.iter().zip(["front", "rear"]) {
            if own.wheelsets.is_none() {
                return Err(InvalidParameter::missing(&format!(
                    "the {which} truck has no wheelsets"
                )));
            }
            if own.car_body.is_none() {
                return Err(InvalidParameter::missing(&format!(
                    "the {which} truck has no center plate and side bearings"
                )));
            }
        }
        let Start {
            distance,
            speed,
            heading,
            settle,
            ..
        } = self.start;
        finite("the distance of the start (m)", distance)?;
        finite("the heading (rad)", heading)?;
        for (what, value) in [
            ("the speed of the start (m/s)", speed),
            ("the settling time (s)", settle),
        ] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(InvalidParameter::new(what, value, "zero or positive"));
            }
        }
        let reach = self.reach();
        let length = self.track.center_line.length();
        if 2.0 * reach > length {
            return Err(InvalidParameter::missing(&format!(
                "the track is {length:.2} m long, but the outermost axles of the car are {:.2} m apart",
                2.0 * reach
            ))
            .with(Some("make the track longer".to_owned())));
        }
        if distance < reach || distance + reach > length {
            return Err(InvalidParameter::new(
                "the distance of the start (m)",
                distance,
                &format!(
                    "between {reach:.2} and {:.2} m, so that all wheels are on the track",
                    length - reach
                ),
            ));
        }
        match &self.drive {
            Drive::Coasting => {}
            Drive::Held { gain } => positive("the gain of the drive (N·s/m)", *gain)?,
            Drive::Over { gain, speeds } => {
                positive("the gain of the drive (N·s/m)", *gain)?;
                check_speeds("distance", "m", speeds)?;
            }
            Drive::History { gain, speeds } => {
                positive("the gain of the drive (N·s/m)", *gain)?;
                check_speeds("time", "s", speeds)?;
                for [time, speed] in speeds {
                    positive("a speed over time (m/s)", *speed)?;
                    if *time < 0.0 {
                        let what = "a time of the speeds over time (s)";
                        return Err(InvalidParameter::new(what, *time, "zero or positive"));
                    }
                }
            }
        }
        if matches!(self.wheels, Wheels::Linear { .. }) && self.start.kind == StartKind::Shaken {
            return Err(InvalidParameter::missing(
                "a car on linear wheels cannot be shaken: these have no flanges and are for small motions",
            )
            .with(Some(
                "start in the equilibrium or in the nominal layout, or take wheels with profiles".to_owned(),
            )));
        }
        if matches!(self.wheels, Wheels::Linear { .. }) && self.support.is_some() {
            return Err(InvalidParameter::missing(
                "linear wheels roll on rails that do not give way: leave the support out",
            ));
        }
        Ok(())
    }

    /// Returns the heights of the center plates above the top of rail, m.
    #[must_use]
    pub fn plate_heights(&self) -> [f64; 2] {
        let height =
            |own: &truck::Parameters| own.car_body.as_ref().map_or(0.0, |car| car.center_plate.height);
        self.trucks.each_ref().map(height)
    }

    /// Returns the frequency of the free twist of body and lading, Hz; none of a rigid body.
    #[must_use]
    pub fn torsion_frequency(&self) -> Option<f64> {
        let [inertia, ..] = Carried::new(self).inertia;
        self.torsion.map(|own| own.frequency(inertia))
    }

    /// Returns whether a truck has wedges without mass or an empirical warp spring.
    #[must_use]
    pub fn has_connections(&self) -> bool {
        let massless = |wedge: &truck::Wedge| wedge.kind == WedgeKind::Massless;
        let has = |own: &truck::Parameters| own.warp_spring.is_some() || own.wedges.iter().any(massless);
        self.trucks.iter().any(has)
    }

    /// Returns the distances of the rails' origins from the middle of the track, left and right, m.
    #[must_use]
    pub fn rail_offsets(&self) -> [f64; 2] {
        match &self.wheels {
            Wheels::OnRails(wheels) => wheels.geometry[0].rail_origins(),
            Wheels::Linear { wheelset, .. } => [wheelset.geometry.half_distance; 2],
        }
    }

    /// Returns the mean of the nominal radii of all wheels, m.
    #[must_use]
    pub fn wheel_radius(&self) -> f64 {
        let [a, b, c, d] = [0, 1, 2, 3].map(|w| self.axle_radius(w));
        // Exactly the radius where all are alike.
        0.5 * (0.5 * (a + b) + 0.5 * (c + d))
    }

    /// Returns the mean of the nominal radii of a wheelset, m.
    #[must_use]
    pub fn axle_radius(&self, wheelset: usize) -> f64 {
        match &self.wheels {
            Wheels::OnRails(wheels) => wheels.geometry[wheelset].nominal_radius(),
            Wheels::Linear { wheelset, .. } => wheelset.geometry.radius,
        }
    }

    /// Returns the longest step (s) that does not miss a flat or a wave of a wheel; infinite of round wheels.
    #[must_use]
    pub fn longest_step(&self) -> f64 {
        match &self.wheels {
            Wheels::OnRails(wheels) => wheels.longest_step(self.drive.fastest(self.start.speed)),
            Wheels::Linear { .. } => f64::INFINITY,
        }
    }

    /// Returns the distance of the outermost axles from the middle of the car, m.
    #[must_use]
    pub fn reach(&self) -> f64 {
        let axles = self.trucks.iter().map(|own| own.geometry.axle());
        0.5 * self.truck_distance + axles.fold(0.0, f64::max)
    }
}
