//! Many wedges in one system, to see how the cost grows with their number.

use mechanics::body::Body;
use mechanics::coil::{Coil, CoilLaw};
use mechanics::frame::Frame;
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::system::{Model, System};
use mechanics::vector::{Matrix, Vector};
use std::f64::consts::PI;
use wedge::parameters::Damping;
use wedge::{BOLSTER, SIDE_FRAME, WEDGE, Wedge, thesis};

/// Toe out of all columns, rad.
const TOE: f64 = 0.2 * PI / 180.0;
/// Half the thickness of bolsters and of columns between wedges, m: wedges do not overlap.
const HALF_THICKNESS: f64 = 0.25;
/// Mass (kg) and moments of inertia (kg·m²) of a free bolster or column.
const MASS: f64 = 300.0;
const INERTIA: [f64; 3] = [10.0; 3];
/// Stiffness (N/m), damping (N·s/m) and length (m) of what supports them.
const STIFFNESS: f64 = 2e7;
const DAMPING: f64 = 2e4;
const LENGTH: f64 = 0.2;

/// The coupling of the wedges of a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrangement {
    /// Each between a column and a bolster of its own, whose motions are prescribed.
    Uncoupled,
    /// Column, wedge, bolster, wedge, column, wedge ...: all but the first column are free bodies on stiff
    /// supports, so that every body is coupled to its two neighbors.
    Chained,
    /// The free bodies of the chain on their supports, without wedges: what of the chain's cost is not that
    /// of wedges between free bodies.
    Supports,
}

/// The pose of a wedge of the chain: moved along x, and turned by half a turn about the vertical axis if it
/// looks backwards.
struct WedgePose {
    shift: f64,
    center: f64,
    turned: bool,
}

impl WedgePose {
    fn point(&self, p: [f64; 3]) -> [f64; 3] {
        let p = if self.turned {
            [2.0 * self.center - p[0], -p[1], p[2]]
        } else {
            p
        };
        [p[0] + self.shift, p[1], p[2]]
    }

    /// Returns a marker on a body of one wedge as a marker on a body with this origin.
    fn marker(&self, marker: &Marker, from: [f64; 3], on: [f64; 3]) -> Marker {
        let pose = self.point(std::array::from_fn(|k| from[k] + marker.origin.0[k]));
        let rotation: Matrix<f64> = if self.turned {
            mechanics::orientation::fixed([0.0, 0.0, PI]).times(marker.rotation)
        } else {
            marker.rotation
        };
        Marker {
            origin: Vector(std::array::from_fn(|k| pose[k] - on[k])),
            rotation,
        }
    }
}

/// Returns a system of `count` wedges of the thesis, variable damping, toe out, whose bolsters (or their
/// supports) move down and up.
///
/// # Errors
/// They make no system, which would be a defect.
pub fn wedges(count: usize, arrangement: Arrangement) -> Result<System, String> {
    let mut parameters = thesis::parameters(Damping::Variable, TOE, 0.0);
    parameters.bolster.coordinates[2] = downwards();
    let one = Wedge::new(parameters).map_err(|error| error.to_string())?;
    let model = match arrangement {
        Arrangement::Uncoupled => uncoupled(&one, count),
        Arrangement::Chained => chained(&one, count, true),
        Arrangement::Supports => chained(&one, count, false),
    };
    System::new(model).map_err(|error| error.to_string())
}

fn uncoupled(one: &Wedge, count: usize) -> Model {
    let system = &one.system;
    let each = system.bodies().len();
    let mut model = empty(one);
    for number in 0..count {
        let first = number * each;
        model.bodies.extend_from_slice(system.bodies());
        for face in system.faces() {
            let element = face.element.plain();
            model
                .faces
                .push((first + face.body, first + face.on, face.marker, element));
        }
        for coil in system.coils() {
            let element = coil.element.clone();
            model
                .coils
                .push((first + coil.body, first + coil.on, coil.marker, element));
        }
    }
    model
}

fn chained(one: &Wedge, count: usize, with_wedges: bool) -> Model {
    let system = &one.system;
    let bodies = system.bodies();
    let (column, pocket) = (bodies[SIDE_FRAME].frame.origin, bodies[BOLSTER].frame.origin);
    // The first bolster's center, and the way from one column to the next but one wedge.
    let center = pocket[0] + HALF_THICKNESS;
    let period = 2.0 * (center - column[0]) + 2.0 * HALF_THICKNESS;
    let mut model = empty(one);
    let mut frame = Frame::fixed([0.0; 3], [0.0; 3]);
    frame.motions[2] = downwards();
    let table = Body::prescribed("table", frame);
    model.bodies.extend([bodies[SIDE_FRAME].clone(), table]);
    let (ground, table) = (0, 1);
    let mut behind = ground;
    for number in 0..count {
        let turned = number % 2 == 1;
        let pose = WedgePose {
            shift: (number / 2) as f64 * period,
            center,
            turned,
        };
        // What the wedge leans on in front: a bolster of its own, or the next column.
        let ahead = model.bodies.len();
        let x = pose.shift
            + if turned {
                period - HALF_THICKNESS + column[0]
            } else {
                center
            };
        let (name, support) = if turned {
            ("column", ground)
        } else {
            ("bolster", table)
        };
        let origin = [x, 0.0, pocket[2]];
        model
            .bodies
            .push(free_body(&format!("{name}_{}", number / 2 + 1), origin));
        let from = model.bodies[support].frame.origin;
        add_supports(&mut model, ahead, support, origin, from);
        if !with_wedges {
            continue;
        }
        let wedge = model.bodies.len();
        let mut body = bodies[WEDGE].clone();
        body.name = format!("wedge_{}", number + 1);
        body.frame.origin = pose.point(body.frame.origin);
        body.frame.orientation = [0.0, 0.0, if turned { PI } else { 0.0 }];
        model.bodies.push(body);
        // A wedge that looks backwards has its bolster behind and its column ahead.
        let on = |role: usize| {
            if (role == BOLSTER) == turned {
                behind
            } else {
                ahead
            }
        };
        for face in system.faces() {
            let on = on(face.on);
            let (from, to) = (bodies[face.on].frame.origin, model.bodies[on].frame.origin);
            let marker = pose.marker(&face.marker, from, to);
            model.faces.push((wedge, on, marker, face.element.plain()));
        }
        for coil in system.coils() {
            let on = on(coil.on);
            let (from, to) = (bodies[coil.on].frame.origin, model.bodies[on].frame.origin);
            let marker = pose.marker(&coil.marker, from, to);
            model.coils.push((wedge, on, marker, coil.element.clone()));
        }
        behind = ahead;
    }
    model
}

fn empty(one: &Wedge) -> Model {
    Model {
        bodies: Vec::new(),
        gravity: [0.0, 0.0, -one.parameters.gravity],
        faces: Vec::new(),
        coils: Vec::new(),
        ..Model::default()
    }
}

/// Returns the motion of the thesis's bolsters, but downwards first, which presses the wedges.
fn downwards() -> Motion {
    Motion::Sine {
        amplitude: -0.0254,
        angular_frequency: 2.0,
        phase: 0.0,
    }
}

/// Returns a body between two wedges, with the coordinates of a wedge.
fn free_body(name: &str, origin: [f64; 3]) -> Body {
    Body {
        name: name.to_owned(),
        mass: MASS,
        inertia: INERTIA,
        center_of_gravity: [0.0; 3],
        frame: Frame::fixed(origin, [0.0; 3]),
        free: [true, false, true, false, true, true],
        initial: [0.0; 6],
        linearized: false,
    }
}

/// Two springs below the body and two behind it hold x, z, pitch and yaw.
fn add_supports(model: &mut Model, body: usize, on: usize, origin: [f64; 3], from: [f64; 3]) {
    let below = |x: f64| ([x, 0.0, 0.0], [x, 0.0, -LENGTH]);
    let behind = |y: f64| ([0.0, y, 0.0], [-LENGTH, y, 0.0]);
    for (end, seat) in [below(-0.1), below(0.1), behind(-0.1), behind(0.1)] {
        let coil = Coil {
            end: Vector(end),
            acts_at: Vector(end),
            law: CoilLaw::Linear { stiffness: STIFFNESS },
            free_length: LENGTH,
            damping: DAMPING,
            rotational_damping: 0.0,
            pulls: true,
        };
        let seat = std::array::from_fn(|k| origin[k] + seat[k] - from[k]);
        model.coils.push((body, on, Marker::new(seat, [0.0; 3]), coil));
    }
}
