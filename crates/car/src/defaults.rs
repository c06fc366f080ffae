//! Default values: a car of 263,000 lbf.

use std::sync::{Arc, OnceLock};

use rolling::track::RailSupport;
use rolling::wheelset::WheelsetBody;
use truck::{CarBody, Lading, RigidBody, SideBearings};
use wedge::parameters::{Damping, STANDARD_GRAVITY};
use wheelrail::contact::{ContactLaw, CreepLaw};
use wheelrail::creep::polach;
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;
use wheelrail::profile::{Profile, ProfileError, nominal};
use wheelrail::track::Track;
use wheelrail::wheelset::{Layout, RigidWheelset};

use crate::coupler::Couplers;
use crate::parameters::{Drive, Mass, Parameters, ProfiledWheels, Start, StartKind, Wheels};

/// in, in m.
const INCH: f64 = 0.0254;
/// Mass that weighs one lbf, in kg.
const POUND: f64 = 0.453_592_37;
/// lbf·in·s², in kg·m².
const POUND_INCH: f64 = 4.448_221_615_260_5 * INCH;

/// Weight (lbf), height (in) and moments of inertia (lbf·in·s²) of the loaded body and of the empty one.
const LOADED: (f64, f64, [f64; 3]) = (243_460.0, 83.75, [1.81e6, 1.624e7, 1.624e7]);
const EMPTY: (f64, f64, [f64; 3]) = (43_060.0, 65.0, [3.75e5, 3.61e6, 3.61e6]);

impl Mass {
    /// Returns the lading of a car of 263,000 lbf: what its loaded body has more than the empty one
    /// (200,400 lbf, its center of gravity 87.8 in above the top of rail).
    #[must_use]
    pub fn usual() -> Self {
        let (whole, whole_height, whole_inertia) = LOADED;
        let (body, body_height, body_inertia) = EMPTY;
        let mass = whole - body;
        let height = (whole * whole_height - body * body_height) / mass;
        // Both parts move away from the common center of gravity: roll and pitch take that, yaw does not.
        let apart = [(body, body_height), (mass, height)]
            .map(|(own, at)| own * POUND * ((at - whole_height) * INCH).powi(2));
        let [body_apart, apart] = apart;
        let inertia = [0, 1, 2].map(|k| {
            let steiner = if k < 2 { body_apart + apart } else { 0.0 };
            (whole_inertia[k] - body_inertia[k]) * POUND_INCH - steiner
        });
        Self {
            name: "lading".to_owned(),
            mass: mass * POUND,
            place: [0.0, 0.0, height * INCH],
            inertia,
        }
    }
}

/// The geometry of new wheels on new rails, and the profiles of a wheel and a rail. Each car begins with it;
/// it takes 25 ms.
type NewWheels = (Arc<RigidWheelset>, [Arc<Profile>; 2]);
static NEW: OnceLock<NewWheels> = OnceLock::new();

fn new_wheels() -> Result<NewWheels, ProfileError> {
    if let Some(own) = NEW.get() {
        return Ok(own.clone());
    }
    let wheel = nominal::aar_1b()?;
    let rail = nominal::rail_136re()?.inclined(nominal::INCLINATION);
    let layout = Layout {
        tape_distance: nominal::TAPE_DISTANCE,
        gauge: 56.5 * INCH,
        gauge_depth: nominal::GAUGE_DEPTH,
    };
    let steel = Material {
        youngs_modulus: 207e9,
        poisson: 0.28,
    };
    let geometry = RigidWheelset::new([&wheel; 2], [18.0 * INCH; 2], [&rail; 2], layout, steel)?;
    let own = (Arc::new(geometry), [Arc::new(wheel), Arc::new(rail)]);
    Ok(NEW.get_or_init(|| own).clone())
}

impl ProfiledWheels {
    /// Returns new wheels of 36 in with the nominal profile AAR-1B on nominal rails 136RE inclined by 1:40,
    /// gauge 56.5 in, friction 0.4 by Polach's law; `sprung` tells whether the rails give way, for the
    /// contacts' damping.
    ///
    /// # Errors
    /// None of these values is at fault; the profiles' checks can only fail for others.
    pub fn usual(sprung: bool) -> Result<Self, ProfileError> {
        let (geometry, [wheel, rail]) = new_wheels()?;
        Ok(Self {
            geometry: [0; 4].map(|_| geometry.clone()),
            wheels: [[0; 2]; 4].map(|sides| sides.map(|_| wheel.clone())),
            rails: [0; 2].map(|_| rail.clone()),
            rails_over: [None, None],
            forms: Default::default(),
            tape_distance: nominal::TAPE_DISTANCE,
            tables: false,
            laws: Box::new([0; 2].map(|_| ContactLaw {
                friction: Friction::constant(0.4),
                damping: if sprung { 0.3 } else { 2.0 },
                creep: CreepLaw::Polach(polach::DRY),
                slowest: 0.1,
            })),
        })
    }
}

impl Start {
    /// Returns a start from equilibrium in the middle of the track, at a distance (m) and a speed (m/s).
    #[must_use]
    pub fn at(distance: f64, speed: f64) -> Self {
        Self {
            distance,
            speed,
            heading: 0.0,
            wheelset_shifts: [0.0; 4],
            body_shift: 0.0,
            kind: StartKind::Equilibrium,
            settle: 2.0,
        }
    }
}

impl Parameters {
    /// Returns a car on this track, loaded with 200,400 lbf or empty, that holds the speed (m/s): trucks
    /// with variable damping and crowned wedges, rollers as side bearings of the loaded car and constant
    /// contact of the empty one, sprung rails. It starts as near to the beginning of the track as its length
    /// allows, with 1 m to spare.
    ///
    /// # Errors
    /// See [`ProfiledWheels::usual`].
    pub fn new(lading: Lading, track: Track, speed: f64) -> Result<Self, ProfileError> {
        let (weight, height, inertia) = EMPTY;
        let bearings = match lading {
            Lading::Loaded => SideBearings::rollers(),
            Lading::Empty => SideBearings::constant_contact(),
        };
        let mut own = truck::Parameters::new(Damping::Variable).in_service();
        own.bolster.free = [true; 6];
        own.car_body = Some(CarBody::new(lading, bearings));
        let mut parameters = Self {
            gravity: STANDARD_GRAVITY,
            body: RigidBody {
                mass: weight * POUND,
                inertia: inertia.map(|i| i * POUND_INCH),
                height: height * INCH,
            },
            lading: match lading {
                Lading::Loaded => vec![Mass::usual()],
                Lading::Empty => Vec::new(),
            },
            torsion: None,
            truck_distance: 486.0 * INCH,
            accelerometer_height: None,
            couplers: Couplers::default(),
            trucks: [own.clone(), own],
            wheelset: WheelsetBody {
                mass: 2984.5 * POUND,
                about_axle: 1018.0 * POUND_INCH,
                about_diameter: 6870.0 * POUND_INCH,
            },
            wheels: Wheels::OnRails(ProfiledWheels::usual(true)?),
            track,
            support: Some(RailSupport::default_support("rail", STANDARD_GRAVITY)),
            movable_rails: false,
            drive: Drive::Held { gain: 1e5 },
            start: Start::at(0.0, speed),
        };
        parameters.start.distance = parameters.reach() + 1.0;
        Ok(parameters)
    }
}
