//! The problems of the race, each under a name.

use mechanics::body::Body;
use mechanics::coil::{Coil, CoilLaw};
use mechanics::contact::{ContactFace, ContactPoint};
use mechanics::frame::Frame;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::surface::Plane;
use mechanics::system::{Model, System};
use mechanics::vector::Vector;
use study::case::builtin;
use thiserror::Error;
use wedge::parameters::{Damping, Parameters};
use wedge::{Wedge, thesis};

/// Toe of the planar wedge: out, as in the thesis's runs, rad.
const TOE: f64 = 0.2 * std::f64::consts::PI / 180.0;

/// The place at which the mass of the stick test stays, m: from 0.2 m, each half cycle loses 2 μmg/k.
pub const STICK_REST: f64 = -0.00601;

/// Height by which the wedge starts lower from one start of a case to the next, m.
pub const START_STEP: f64 = 1e-5;

/// The separator of a case's name and the number of its start.
const START_MARK: char = '@';

/// On what a solver is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judged {
    /// Time series of the forces: the run converges.
    Series,
    /// Means over branches, and energy per cycle: the run rings, and is chaotic in detail.
    Means,
    /// The position.
    Position,
}

/// A problem with its start.
pub struct RaceProblem {
    /// Its name.
    pub name: String,
    /// Its equations.
    pub system: System,
    /// The state at the start, SI.
    pub start: Vec<f64>,
    /// Simulated time, s.
    pub duration: f64,
    /// Time between two rows of the result, s.
    pub interval: f64,
    /// The wedge's parameters, if it is a wedge.
    pub parameters: Option<Parameters>,
    /// On what a solver is judged.
    pub judged: Judged,
}

/// Reasons why there is no problem.
#[derive(Debug, Error)]
pub enum ProblemError {
    /// There is none of this name.
    #[error("there is no problem `{name}` in the race; there are {}", names().join(", "))]
    Unknown {
        /// The requested thing.
        name: String,
    },
    /// It has nothing that could start elsewhere.
    #[error("{case} has no wedge that could start elsewhere; ask for `{case}` alone")]
    NoOtherStart {
        /// The problem.
        case: String,
    },
    /// Its parameters make no system, which would be a defect.
    #[error("{name}: {reason}")]
    Build {
        /// Its name.
        name: String,
        /// The reason.
        reason: String,
    },
}

/// Returns the names of all problems: the thesis's twelve cases, the planar wedge, the stick test.
#[must_use]
pub fn names() -> Vec<String> {
    let others = [
        "planar_variable",
        "planar_constant",
        "stick_bristle",
        "stick_tanh",
    ];
    builtin::thesis_names()
        .map(str::to_owned)
        .chain(others.map(str::to_owned))
        .collect()
}

/// Returns whether this is one of the thesis's cases with a yawed bolster.
#[must_use]
pub fn is_yawed(name: &str) -> bool {
    builtin::thesis_names().any(|known| known == name) && !name.ends_with("psi_0")
}

/// Returns the name of a case from another start than its own, which is number 0: `vdrun_toe_0_psi_0@2`
/// begins with the wedge 2 steps of [`START_STEP`] lower. Drivers in other languages hand such a name on.
#[must_use]
pub fn with_start(case: &str, start: u32) -> String {
    match start {
        0 => case.to_owned(),
        _ => format!("{case}{START_MARK}{start}"),
    }
}

/// Returns the case and the number of its start in a name.
#[must_use]
pub fn start_of(name: &str) -> (&str, u32) {
    let parts = name.split_once(START_MARK);
    parts
        .and_then(|(case, start)| Some((case, start.parse().ok()?)))
        .unwrap_or((name, 0))
}

impl RaceProblem {
    /// Returns the problem of this name, which may ask for another start ([`with_start`]).
    ///
    /// # Errors
    /// There is none, or it makes no system, or it has no wedge to start elsewhere.
    pub fn named(name: &str) -> Result<Self, ProblemError> {
        let (case, start) = start_of(name);
        let mut problem = Self::from_its_own_start(case)?;
        if start > 0 {
            let wedge = problem
                .parameters
                .as_ref()
                .map(|parameters| &parameters.wedge.free);
            // Coordinates that are held are no states.
            let vertical =
                wedge.and_then(|free| free[2].then(|| free[..2].iter().filter(|free| **free).count()));
            let vertical = vertical.ok_or_else(|| ProblemError::NoOtherStart {
                case: case.to_owned(),
            })?;
            problem.start[vertical] -= f64::from(start) * START_STEP;
            name.clone_into(&mut problem.name);
        }
        Ok(problem)
    }

    fn from_its_own_start(name: &str) -> Result<Self, ProblemError> {
        let build = |reason: String| ProblemError::Build {
            name: name.to_owned(),
            reason,
        };
        if builtin::thesis_names().any(|known| known == name) {
            let case = builtin::case_with(name, &[]).map_err(|error| build(error.to_string()))?;
            let simulation = (case.simulation.duration, case.simulation.output_interval);
            let judged = if is_yawed(name) {
                Judged::Series
            } else {
                Judged::Means
            };
            return Self::of_wedge(name, case.parameters, simulation, judged);
        }
        match name {
            "planar_variable" => Self::planar(name, Damping::Variable, Judged::Means),
            "planar_constant" => Self::planar(name, Damping::Constant, Judged::Series),
            "stick_bristle" => Self::stick(
                name,
                FrictionLaw::Bristle {
                    stiffness: 1e7,
                    damping: 1e3,
                },
            )
            .map_err(build),
            "stick_tanh" => Self::stick(
                name,
                FrictionLaw::Tanh {
                    reference_speed: 1e-5,
                },
            )
            .map_err(build),
            _ => Err(ProblemError::Unknown {
                name: name.to_owned(),
            }),
        }
    }

    fn planar(name: &str, damping: Damping, judged: Judged) -> Result<Self, ProblemError> {
        let mut parameters = thesis::parameters(damping, TOE, 0.0);
        parameters.wedge.free = [true, false, true, false, false, false];
        Self::of_wedge(name, parameters, (10.0, 0.01), judged)
    }

    fn of_wedge(
        name: &str,
        parameters: Parameters,
        (duration, interval): (f64, f64),
        judged: Judged,
    ) -> Result<Self, ProblemError> {
        let wedge = Wedge::new(parameters).map_err(|error| ProblemError::Build {
            name: name.to_owned(),
            reason: error.to_string(),
        })?;
        Ok(Self {
            name: name.to_owned(),
            system: wedge.system,
            start: wedge.initial_state,
            duration,
            interval,
            parameters: Some(wedge.parameters),
            judged,
        })
    }

    /// Returns a mass of 10 kg that slides along x on a plane, pressed by its weight, friction 0.3, on a
    /// spring of 4000 N/m, released at 0.2 m. Its height is held at the depth at which the plane carries its
    /// weight.
    fn stick(name: &str, law: FrictionLaw) -> Result<Self, String> {
        let (mass, gravity, normal) = (10.0, 9.81, 1e6);
        let sunk = -mass * gravity / normal;
        let body = |name: &str, free: bool, initial: [f64; 6]| Body {
            name: name.to_owned(),
            mass,
            inertia: [1.0; 3],
            center_of_gravity: [0.0; 3],
            frame: Frame::fixed([0.0; 3], [0.0; 3]),
            free: [free, false, false, false, false, false],
            initial,
            linearized: false,
        };
        let floor = ContactFace {
            name: "floor".to_owned(),
            points: vec![ContactPoint {
                position: Vector([0.0; 3]),
                stiffness: normal,
                damping: 0.0,
                share: 1.0,
            }],
            surface: Plane,
            coefficient: 0.3,
            law,
        };
        let spring = Coil {
            end: Vector([0.0; 3]),
            acts_at: Vector([0.0; 3]),
            law: CoilLaw::Linear { stiffness: 4000.0 },
            free_length: 1.0,
            damping: 0.0,
            rotational_damping: 0.0,
            pulls: true,
        };
        let upwards = [0.0, -std::f64::consts::FRAC_PI_2, 0.0];
        let ground = Body::prescribed("ground", Frame::fixed([0.0; 3], [0.0; 3]));
        let model = Model {
            bodies: vec![body("mass", true, [0.2, 0.0, sunk, 0.0, 0.0, 0.0]), ground],
            gravity: [0.0, 0.0, -gravity],
            faces: vec![(0, 1, Marker::new([0.0; 3], upwards), floor)],
            coils: vec![(0, 1, Marker::new([-1.0, 0.0, sunk], [0.0; 3]), spring)],
            ..Model::default()
        };
        let system = System::new(model).map_err(|error| error.to_string())?;
        Ok(Self {
            name: name.to_owned(),
            start: system.initial_state(),
            system,
            duration: 10.0,
            interval: 0.01,
            parameters: None,
            judged: Judged::Position,
        })
    }

    /// Number of rows of a result: multiples of the interval from zero to the duration.
    #[must_use]
    pub fn rows(&self) -> usize {
        (self.duration / self.interval).round() as usize + 1
    }

    /// Time of a row, s.
    #[must_use]
    pub fn time(&self, row: usize) -> f64 {
        (row as f64 * self.interval).min(self.duration)
    }
}
