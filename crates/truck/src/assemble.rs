//! Assembly of a truck from its parameters, and its start.

use mechanics::friction::FrictionLaw;
use mechanics::motion::Motion;
use mechanics::system::{Model, ModelError, NoEquilibrium, StaticFriction, System};
use thiserror::Error;
use wedge::parameters::{FaceFriction, Start};

use crate::bodies::bodies;
use crate::elements::{Mount, WedgePlace, add};
use crate::mounted::MountedTruck;
use crate::parameters::{Adapter, Parameters, SideBearing};

/// Number of the leading wheelset among the bodies; the trailing one follows.
pub const WHEELSETS: usize = 0;
/// Number of the bolster.
pub const BOLSTER: usize = 2;
/// Number of the left side frame; the right one follows.
pub const SIDE_FRAMES: usize = 3;
/// Number of the first wedge; of a split wedge it is its outboard half.
pub const WEDGES: usize = 5;
/// Number of the car body, if there is one.
pub const CAR_BODY: usize = 9;
/// Number of the inboard half of the first wedge; those of wedges that are not split are no bodies.
pub const INBOARD_HALVES: usize = 10;
/// Number of numbers.
pub(crate) const NUMBERS: usize = 14;

/// A truck, ready to be integrated.
#[derive(Clone, Debug)]
pub struct Truck {
    /// The equations of motion. Faces: column and slope of each wedge; with wheelsets the adapters of each
    /// side frame, leading and trailing; with a car body the center plate, and constant-contact side
    /// bearings. Connections: wedges without mass, empirical warp springs, hysteresis of side bearings.
    pub system: System,
    /// The state at time zero.
    pub initial_state: Vec<f64>,
    /// The warning of a start in equilibrium that is nearly at rest.
    pub start_warning: Option<String>,
    pub(crate) mounted: MountedTruck,
}

/// Reasons why parameters define no truck.
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
                let (mut truck, mut gaps) = (truck, [[0.0; 2]; 4]);
                let mut faces = parameters
                    .wedges
                    .iter()
                    .flat_map(|own| [&own.column_face, &own.slope_face]);
                // Over a plane a shift opens all gaps by as much; over a curved counterface the next one
                // corrects it.
                let passes = match faces.any(|face| !face.touches_a_plane()) {
                    false => 1,
                    true => 5,
                };
                for _ in 0..passes {
                    let depths = truck.depths();
                    for (gaps, depths) in gaps.as_flattened_mut().iter_mut().zip(depths.as_flattened()) {
                        *gaps += depths;
                    }
                    truck = Self::with_gaps(parameters, gaps)?;
                }
                Ok(truck)
            }
            Start::Equilibrium => {
                let mut truck = truck;
                let mut still = Self::with_gaps(&without_friction(&held(parameters)), [[0.0; 2]; 4])?.system;
                let rest = still.start_at_rest(0.0, &still.initial_state(), StaticFriction::Without)?;
                truck.start_warning = rest.warning;
                let positions = truck.system.layout().speeds;
                truck.initial_state[..positions].copy_from_slice(&rest.state[..positions]);
                Ok(truck)
            }
        }
    }

    /// Returns the penetrations of column and slope of each wedge at the start, m.
    fn depths(&mut self) -> [[f64; 2]; 4] {
        let observation = self.system.observe(0.0, &self.system.initial_state());
        let depth = |face: usize| -> f64 {
            let points = observation.faces[face].points.iter();
            points.fold(0.0, |depth: f64, point| depth.max(-point.gap))
        };
        self.mounted.added.wedges.map(|place| match place {
            WedgePlace::Body { column } => [column, column + 1].map(depth),
            WedgePlace::Split { column } => [column, column + 1].map(|face| depth(face).max(depth(face + 2))),
            WedgePlace::Massless { .. } => [0.0; 2],
        })
    }

    /// Returns the truck with column and slope of each wedge moved away by so much (m) along their normals.
    fn with_gaps(parameters: &Parameters, gaps: [[f64; 2]; 4]) -> Result<Self, ModelError> {
        let mount = Mount::alone(parameters);
        let bodies = bodies(parameters, mount.center);
        let mut model = Model::new(bodies, [0.0, 0.0, -parameters.gravity]);
        let added = add(&mut model, parameters, &mount, gaps);
        let system = System::new(model)?;
        Ok(Self {
            initial_state: system.initial_state(),
            start_warning: None,
            system,
            mounted: MountedTruck::alone(parameters, mount, added),
        })
    }
}

/// Returns the same truck with all motions and loads held as they are at time zero.
#[must_use]
pub fn held(parameters: &Parameters) -> Parameters {
    let mut held = parameters.clone();
    let Parameters {
        bolster,
        side_frames,
        wheelsets,
        car_body,
        ..
    } = &mut held;
    let mut courses: Vec<&mut Motion> = Vec::new();
    courses.extend(bolster.motion.coordinates.iter_mut().chain(&mut bolster.applied));
    for own in side_frames {
        courses.extend(own.motion.coordinates.iter_mut().chain(&mut own.applied));
    }
    for motion in wheelsets.iter_mut().flat_map(|wheelsets| &mut wheelsets.motions) {
        courses.extend(&mut motion.coordinates);
    }
    courses.extend(car_body.iter_mut().flat_map(|car| &mut car.applied));
    for course in courses {
        *course = Motion::Constant(course.evaluate(0.0, 0.0)[0]);
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
        wedge.split.friction = none;
        for pad in [&mut wedge.column_face.pad, &mut wedge.slope_face.pad]
            .into_iter()
            .flatten()
        {
            (pad.friction, pad.shear) = (0.0, None);
        }
    }
    if let Some(wheelsets) = &mut parameters.wheelsets
        && let Adapter::Friction(adapter) = &mut wheelsets.adapter
    {
        adapter.friction = none;
    }
    if let Some(car) = &mut parameters.car_body {
        car.center_plate.friction = none;
        if let SideBearing::ConstantContact {
            friction, hysteresis, ..
        } = &mut car.side_bearings.kind
        {
            *friction = none;
            *hysteresis = None;
        }
    }
    parameters
}
