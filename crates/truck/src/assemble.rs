//! How parameters become a truck, and where it starts.

use std::ops::Range;

use mechanics::friction::FrictionLaw;
use mechanics::motion::Motion;
use mechanics::system::{Model, ModelError, NoEquilibrium, StaticFriction, System};
use mechanics::vector::Vector;
use thiserror::Error;
use wedge::parameters::{FaceFriction, Start};

use crate::PLACES;
use crate::bodies::bodies;
use crate::elements::{HEIGHT, Mount, Suspended, add};
use crate::parameters::{Adapter, Parameters, SideBearing};

/// Number of the leading wheelset among the bodies; the trailing one follows.
pub const WHEELSETS: usize = 0;
/// Number of the bolster.
pub const BOLSTER: usize = 2;
/// Number of the left side frame; the right one follows.
pub const SIDE_FRAMES: usize = 3;
/// Number of the first wedge.
pub const WEDGES: usize = 5;
/// Number of the car body, if there is one.
pub const CAR_BODY: usize = 9;

/// A truck, ready to be integrated.
#[derive(Clone, Debug)]
pub struct Truck {
    /// The equations of motion. Faces: column and slope of each wedge; with wheelsets the adapters of each side
    /// frame, leading and trailing; with a car body the center plate, and constant-contact side bearings.
    pub system: System,
    /// The state at time zero.
    pub initial_state: Vec<f64>,
    /// The faces of the adapters.
    pub(crate) adapters: Range<usize>,
    /// The face of the center plate, and its height, m.
    pub(crate) center_plate: Option<usize>,
    pub(crate) plate_height: f64,
    pub(crate) axle: f64,
    /// Nominal places of the wedges' centers of gravity, m.
    pub(crate) wedge_places: [Vector<f64>; 4],
    pub(crate) suspension: Vec<Suspended>,
}

/// Why parameters define no truck.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum BuildError {
    /// Bodies and elements make no system: a mass that is zero, say, or nothing that is free.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// There is no equilibrium to start from.
    #[error("cannot start from equilibrium: {0}; start.kind = \"rest\" or \"touching\" needs none")]
    Equilibrium(#[from] NoEquilibrium),
}

impl Truck {
    /// Returns the truck with these parameters, and its start.
    ///
    /// # Errors
    /// The parameters make no system, or there is no equilibrium to start from.
    pub fn new(parameters: &Parameters) -> Result<Self, BuildError> {
        let truck = Self::with_gaps(parameters, [[0.0; 2]; 4])?;
        match parameters.start {
            Start::Rest => Ok(truck),
            Start::Touching => {
                let mut system = truck.system;
                let observation = system.observe(0.0, &system.initial_state());
                let depth = |face: usize| {
                    let points = observation.faces[face].points.iter();
                    points.fold(0.0, |depth: f64, point| depth.max(-point.gap))
                };
                let gaps = [0, 1, 2, 3].map(|wedge| [0, 1].map(|face| depth(2 * wedge + face)));
                Ok(Self::with_gaps(parameters, gaps)?)
            }
            Start::Equilibrium => {
                let mut truck = truck;
                let mut still = Self::with_gaps(&without_friction(&held(parameters)), [[0.0; 2]; 4])?.system;
                let rest = still.equilibrium(0.0, &still.initial_state(), StaticFriction::Without)?;
                let positions = truck.system.layout().speeds;
                truck.initial_state[..positions].copy_from_slice(&rest[..positions]);
                Ok(truck)
            }
        }
    }

    /// Returns the truck with column and slope of each wedge moved away by so much (m) along their normals.
    fn with_gaps(parameters: &Parameters, gaps: [[f64; 2]; 4]) -> Result<Self, ModelError> {
        let bodies = bodies(parameters, Mount::ALONE.center);
        let mut model = Model::new(bodies, [0.0, 0.0, -parameters.gravity]);
        let suspension = add(&mut model, parameters, &Mount::ALONE, gaps);
        let with_friction = matches!(
            &parameters.wheelsets,
            Some(wheelsets) if matches!(wheelsets.adapter, Adapter::Friction(_))
        );
        let adapters = 8..if with_friction { 12 } else { 8 };
        let car = parameters.car_body.as_ref();
        let system = System::new(model)?;
        Ok(Self {
            initial_state: system.initial_state(),
            system,
            center_plate: car.map(|_| adapters.end),
            plate_height: car.map_or(0.0, |car| car.center_plate.height),
            adapters,
            axle: parameters.distances[2],
            wedge_places: PLACES.map(|[end, way]| {
                let [side, place, _] = parameters.distances;
                Vector([place * end, side * way, HEIGHT])
            }),
            suspension,
        })
    }
}

/// Returns the same truck with all that is prescribed held where it is at time zero.
#[must_use]
pub fn held(parameters: &Parameters) -> Parameters {
    let mut held = parameters.clone();
    let mut motions = vec![&mut held.bolster.motion];
    motions.extend(
        held.side_frames
            .iter_mut()
            .map(|side_frame| &mut side_frame.motion),
    );
    motions.extend(
        held.wheelsets
            .iter_mut()
            .flat_map(|wheelsets| &mut wheelsets.motions),
    );
    for motion in motions.into_iter().flat_map(|motion| &mut motion.coordinates) {
        *motion = Motion::Constant(motion.evaluate(0.0, 0.0)[0]);
    }
    held
}

fn without_friction(parameters: &Parameters) -> Parameters {
    let none = FaceFriction {
        coefficient: 0.0,
        law: FrictionLaw::Tanh { reference_speed: 1.0 },
    };
    let mut parameters = parameters.clone();
    for wedge in &mut parameters.wedges {
        wedge.column_friction = none;
        wedge.slope_friction = none;
    }
    if let Some(wheelsets) = &mut parameters.wheelsets
        && let Adapter::Friction(adapter) = &mut wheelsets.adapter
    {
        adapter.friction = none;
    }
    if let Some(car) = &mut parameters.car_body {
        car.center_plate.friction = none;
        if let SideBearing::ConstantContact { friction, .. } = &mut car.side_bearings.kind {
            *friction = none;
        }
    }
    parameters
}
