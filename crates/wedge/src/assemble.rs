//! Assembly of the wedge, its neighbors, faces and coil.
//!
//! Nominal position: the wedge frame's origin B at (0, 0, L) with L the nominal coil length; with no toe and
//! no yaw both faces just touch.
//! - Column: plane through (x_A, 0, L + h2/2), normal (cos φ, 0, -sin φ) for toe-out φ.
//!   With the toe's pivot p above that point it passes through (x_A - p sin φ, 0, L + h2/2 + p (1 - cos φ)).
//! - Slope: plane through the pocket's center (x_A + h1/2, 0, L + h2/2), normal (-cos θ, 0, -sin θ) in the
//!   bolster's axes. The bolster turns about that center unless another is named.
//! - Worn faces: column and slope lie deeper by the depth of wear, along their normals.
//! - Coil: its seat is the origin, on the side frame (variable damping) or on the bolster (constant damping).

use std::f64::consts::PI;

use mechanics::body::Body;
use mechanics::coil::{Coil, CoilLine};
use mechanics::contact::{ContactFace, ContactPoint};
use mechanics::frame::Frame;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::surface::Plane;
use mechanics::system::{Model, ModelError, NoEquilibrium, StaticFriction, System};
use mechanics::vector::Vector;
use thiserror::Error;

use crate::parameters::{Damping, FaceFriction, NeighbourMotion, ParameterError, Parameters, Start};

/// The side frame's number among the bodies.
pub const SIDE_FRAME: usize = 0;
/// The bolster's number among the bodies.
pub const BOLSTER: usize = 1;
/// The wedge's number among the bodies.
pub const WEDGE: usize = 2;
/// The column's number among the faces.
pub const COLUMN: usize = 0;
/// The slope's number among the faces.
pub const SLOPE: usize = 1;

/// Reasons why parameters define no wedge.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum BuildError {
    /// A parameter is outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The bodies and elements make no system.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// There is no equilibrium to start from.
    #[error("cannot start from equilibrium: {0}; start = \"rest\" or \"touching\" needs none")]
    Equilibrium(#[from] NoEquilibrium),
}

/// A stand-alone wedge, ready to run.
#[derive(Clone, Debug)]
pub struct Wedge {
    /// Its parameters.
    pub parameters: Parameters,
    /// Its equations of motion.
    pub system: System,
    /// Shift of the column along -x for a touching start, m.
    pub column_shift: f64,
    /// Shift of the pocket along the bolster's x axis for a touching start, m.
    pub pocket_shift: f64,
    /// The state at time zero.
    pub initial_state: Vec<f64>,
    /// The warning of a start in equilibrium that is nearly at rest.
    pub start_warning: Option<String>,
}

impl Wedge {
    /// Builds the wedge and finds its start.
    ///
    /// # Errors
    /// A parameter is outside its range, or there is no equilibrium to start from.
    pub fn new(parameters: Parameters) -> Result<Self, BuildError> {
        parameters.validate()?;
        let mut shifts = [0.0; 2];
        if parameters.start == Start::Touching {
            shifts = touching_shifts(&parameters)?;
        }
        let system = System::new(model(&parameters, shifts))?;
        let mut initial_state = system.initial_state();
        let mut start_warning = None;
        if parameters.start == Start::Equilibrium {
            let mut still = System::new(model(&held(&parameters), shifts))?;
            let rest = still.start_at_rest(0.0, &still.initial_state(), StaticFriction::Without)?;
            start_warning = rest.warning;
            let positions = system.layout().speeds;
            initial_state[..positions].copy_from_slice(&rest.state[..positions]);
        }
        Ok(Self {
            parameters,
            system,
            column_shift: shifts[0],
            pocket_shift: shifts[1],
            initial_state,
            start_warning,
        })
    }
}

/// Returns the distances by which column and pocket must move apart, each along the x axis of its body, until
/// no corner penetrates at time zero, m.
fn touching_shifts(parameters: &Parameters) -> Result<[f64; 2], ModelError> {
    let faces = [&parameters.column_face, &parameters.slope_face];
    let mut shifts = more_shifts(parameters, [0.0; 2])?;
    // Over a plane a shift opens all gaps by as much; over a curved counterface the next one corrects it.
    if faces.iter().any(|face| !face.touches_a_plane()) {
        for _ in 0..CORRECTIONS {
            let more = more_shifts(parameters, shifts)?;
            shifts = [shifts[0] + more[0], shifts[1] + more[1]];
        }
    }
    Ok(shifts)
}

/// Corrections of a touching start over curved counterfaces.
const CORRECTIONS: usize = 4;

/// Returns the further distances by which they must move apart.
fn more_shifts(parameters: &Parameters, shifts: [f64; 2]) -> Result<[f64; 2], ModelError> {
    let mut system = System::new(model(parameters, shifts))?;
    let start = system.initial_state();
    let observation = system.observe(0.0, &start);
    Ok([COLUMN, SLOPE].map(|face| {
        let depth = observation.faces[face]
            .points
            .iter()
            .fold(0.0, |depth: f64, point| depth.max(-point.gap));
        depth / system.faces()[face].marker.rotation.0[0][0].abs()
    }))
}

/// Returns the same wedge without friction, its neighbors held where they are at time zero.
fn held(parameters: &Parameters) -> Parameters {
    let mut held = parameters.clone();
    for neighbour in [&mut held.side_frame, &mut held.bolster] {
        for motion in &mut neighbour.coordinates {
            *motion = Motion::Constant(motion.evaluate(0.0, 0.0)[0]);
        }
    }
    for face in [&mut held.column_friction, &mut held.slope_friction] {
        *face = FaceFriction {
            coefficient: 0.0,
            law: FrictionLaw::Tanh { reference_speed: 1.0 },
        };
    }
    for pad in [&mut held.column_face.pad, &mut held.slope_face.pad]
        .into_iter()
        .flatten()
    {
        (pad.friction, pad.shear) = (0.0, None);
    }
    held
}

/// Returns bodies and elements; `shifts` move column and pocket apart.
fn model(parameters: &Parameters, shifts: [f64; 2]) -> Model {
    let Parameters { wedge, coil, .. } = parameters;
    let (bottom, face_x, length) = (
        parameters.bottom_length(),
        parameters.column_face_position(),
        coil.nominal_length,
    );
    let middle = length + 0.5 * wedge.height;
    let column_center = [face_x, 0.0, middle];
    let pocket_center = [face_x + 0.5 * bottom, 0.0, middle];

    let (side_frame, side_frame_origin) = neighbour("side_frame", &parameters.side_frame, column_center);
    let (bolster, bolster_origin) = neighbour("bolster", &parameters.bolster, pocket_center);
    let body = Body {
        name: "wedge".to_owned(),
        mass: wedge.mass,
        inertia: wedge.inertia,
        center_of_gravity: wedge.center_of_gravity,
        frame: Frame::fixed([0.0, 0.0, length], [0.0; 3]),
        free: wedge.free,
        initial: [0.0; 6],
        linearized: false,
    };

    let face = |name: &str, points: Vec<ContactPoint>, friction: &FaceFriction| ContactFace {
        name: name.to_owned(),
        points,
        surface: Plane,
        coefficient: friction.coefficient,
        law: friction.law,
    };
    let [vertical, inclined] = parameters.rectangles();
    let (on_column, on_slope) = (&parameters.column_face, &parameters.slope_face);
    let frictions = [
        on_column.friction(&parameters.column_friction),
        on_slope.friction(&parameters.slope_friction),
    ];
    let column = on_column.points(&vertical, &parameters.contact);
    let column = face("column", column, &frictions[0]);
    let slope = on_slope.points(&inclined, &parameters.contact);
    let slope = face("slope", slope, &frictions[1]);
    // The slope's marker is pitched beyond a right angle: its z axis points down.
    let interfaces = vec![
        (COLUMN, on_column.interface(&frictions[0], [false, false])),
        (SLOPE, on_slope.interface(&frictions[1], [true, false])),
    ];
    let worn_column = along(parameters.wear.column, parameters.toe);
    let worn_slope = along(parameters.wear.slope, PI - wedge.angle);
    let column_marker = Marker::new(
        sub(
            sub(
                sub([face_x - shifts[0], 0.0, middle], turned(parameters)),
                worn_column,
            ),
            side_frame_origin,
        ),
        [0.0, parameters.toe, 0.0],
    );
    let slope_marker = Marker::new(
        sub(
            sub([pocket_center[0] + shifts[1], 0.0, middle], worn_slope),
            bolster_origin,
        ),
        [0.0, PI - wedge.angle, 0.0],
    );

    let (seat_body, seat_origin) = match parameters.damping {
        Damping::Variable => (SIDE_FRAME, side_frame_origin),
        Damping::Constant => (BOLSTER, bolster_origin),
    };
    let end = Vector::zero();
    let control_coil = Coil {
        end,
        acts_at: match coil.acts_at {
            CoilLine::CenterOfGravity => Vector(wedge.center_of_gravity),
            CoilLine::Seat => end,
        },
        law: coil.law.clone(),
        free_length: coil.free_length,
        damping: coil.damping,
        rotational_damping: coil.rotational_damping,
        pulls: coil.pulls,
    };
    Model {
        bodies: vec![side_frame, bolster, body],
        gravity: [0.0, 0.0, -parameters.gravity],
        faces: vec![
            (WEDGE, SIDE_FRAME, column_marker, column),
            (WEDGE, BOLSTER, slope_marker, slope),
        ],
        interfaces,
        coils: vec![(
            WEDGE,
            seat_body,
            Marker::new(sub([0.0; 3], seat_origin), [0.0; 3]),
            control_coil,
        )],
        ..Model::default()
    }
}

/// Returns a prescribed neighbor and its origin: the point that it turns about.
fn neighbour(name: &str, motion: &NeighbourMotion, center: [f64; 3]) -> (Body, [f64; 3]) {
    let origin = motion.center.unwrap_or(center);
    let frame = Frame {
        origin,
        orientation: [0.0; 3],
        motions: motion.coordinates.clone(),
    };
    (Body::prescribed(name, frame), origin)
}

/// Returns by how much toe moves the middle of the column where it turns about another point: from there to
/// where it was; nothing for nothing, to the last bit.
fn turned(parameters: &Parameters) -> [f64; 3] {
    let pivot = parameters.toe_pivot;
    if pivot == 0.0 {
        return [0.0; 3];
    }
    let (sin, cos) = libm::sincos(parameters.toe);
    [pivot * sin, 0.0, -pivot * (1.0 - cos)]
}

/// Returns a length along the normal of a surface that is pitched by this angle; nothing for nothing, to the
/// last bit.
fn along(length: f64, pitch: f64) -> [f64; 3] {
    if length == 0.0 {
        return [0.0; 3];
    }
    [length * libm::cos(pitch), 0.0, -length * libm::sin(pitch)]
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}
