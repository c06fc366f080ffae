//! The three-piece truck on one core: six free bodies, built from the library alone, to see what a truck asks
//! of the assembly and of the integrator.
//!
//! Axes: x forward, y left, z up from the top of rail, origin at the truck's center. Two side frames and four
//! wedges have six free coordinates each; the bolster's motion is prescribed, the wheelsets stand still. A
//! side frame stands on each axle by two points with bristle friction (the adapter). Wedges meet a column and
//! the bolster's slope by four corners a face, with bristle friction.
//!
//! Load and control coils are springs with shear stiffness. Stops (gibs, lands, pocket sides, adapter stops) are
//! left out: no motion here reaches them.

use std::f64::consts::PI;

use mechanics::body::Body;
use mechanics::contact::{ContactFace, ContactPoint};
use mechanics::elements::{ShearSpring, Solid};
use mechanics::frame::Frame;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::surface::Plane;
use mechanics::system::{Model, System};
use mechanics::vector::Vector;
use wedge::parameters::Damping;

const INCH: f64 = 0.0254;
/// lbf, in N.
pub const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// lb, in kg.
const POUND: f64 = 0.453_592_37;
/// lbf/in, in N/m; lbf·s/in, in N·s/m.
const POUND_PER_INCH: f64 = POUND_FORCE / INCH;
/// lbf·in·s², in kg·m².
const POUND_INCH: f64 = POUND_FORCE * INCH;
const GRAVITY: f64 = 9.806_65;

/// Height (in) of a bolster's center of gravity, and of those of side frames and wedges.
const BOLSTER_HEIGHT: f64 = 22.0;
const HEIGHT: f64 = 18.0;
/// From the truck's center to side frames (y), wedges (x) and axles (x), in.
const SIDE: f64 = 39.5;
const WEDGE_PLACE: f64 = 8.5;
const AXLE: f64 = 35.0;
/// Height and width of a wedge, in.
const WEDGE_HEIGHT: f64 = 6.125;
const WEDGE_WIDTH: f64 = 10.5;

/// The number of the first wedge among the bodies, and of the bolster and of the left side frame.
const BOLSTER: usize = 1;
const SIDE_FRAMES: usize = 2;
const WEDGES: usize = 4;
/// Ends (leading, trailing) and sides (left, right) of the four wedges.
const PLACES: [(f64, f64); 4] = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];

/// How the bolster moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BolsterMotion {
    /// Up and down by 0.5 in, 2 rad/s.
    Vertical,
    /// Sideways by 0.4 in, 0.5 Hz.
    Lateral,
    /// About its center of gravity by 0.01 rad, 0.5 Hz.
    Roll,
}

/// A truck and what is done to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rig {
    /// Its name.
    pub name: &'static str,
    /// Where the control coils stand: on the bolster (constant damping) or on the side frames (variable
    /// damping).
    pub damping: Damping,
    /// Toe out of all columns, degrees.
    pub toe: f64,
    /// The bolster's motion.
    pub motion: BolsterMotion,
}

/// The trucks that are measured.
pub const RIGS: [Rig; 8] = {
    const fn rig(name: &'static str, damping: Damping, toe: f64, motion: BolsterMotion) -> Rig {
        Rig {
            name,
            damping,
            toe,
            motion,
        }
    }
    use BolsterMotion::{Lateral, Roll, Vertical};
    [
        rig("vertical_constant", Damping::Constant, 0.0, Vertical),
        rig("vertical_variable", Damping::Variable, 0.0, Vertical),
        rig("vertical_constant_toe_out", Damping::Constant, 0.2, Vertical),
        rig("vertical_variable_toe_out", Damping::Variable, 0.2, Vertical),
        rig("lateral_constant", Damping::Constant, 0.0, Lateral),
        rig("lateral_variable", Damping::Variable, 0.0, Lateral),
        rig("roll_constant", Damping::Constant, 0.0, Roll),
        rig("roll_variable", Damping::Variable, 0.0, Roll),
    ]
};

impl Rig {
    /// The truck as a system, faces in contact without load, coils at their static loads.
    ///
    /// # Errors
    /// It makes no system, which would be a defect.
    pub fn system(&self) -> Result<System, String> {
        let mut model = Model {
            bodies: self.bodies(),
            gravity: [0.0, 0.0, -GRAVITY],
            faces: Vec::new(),
            coils: Vec::new(),
            ..Model::default()
        };
        for (number, side) in [1.0, -1.0].into_iter().enumerate() {
            let side_frame = SIDE_FRAMES + number;
            adapters(&mut model, side_frame, side);
            for (x, y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                let at = [3.75 * x, SIDE * side + 3.75 * y, 13.0];
                add_spring(&mut model, BOLSTER, side_frame, at, self.load_coil());
            }
        }
        for (number, (end, side)) in PLACES.into_iter().enumerate() {
            self.add_wedge(&mut model, WEDGES + number, end, side);
        }
        System::new(model).map_err(|error| error.to_string())
    }

    fn bodies(&self) -> Vec<Body> {
        let mut frame = Frame::fixed(inches([0.0, 0.0, BOLSTER_HEIGHT]), [0.0; 3]);
        let sine = |amplitude: f64, angular_frequency: f64| Motion::Sine {
            amplitude,
            angular_frequency,
            phase: 0.0,
        };
        match self.motion {
            BolsterMotion::Vertical => frame.motions[2] = sine(0.5 * INCH, 2.0),
            BolsterMotion::Lateral => frame.motions[1] = sine(0.4 * INCH, PI),
            BolsterMotion::Roll => frame.motions[3] = sine(0.01, PI),
        }
        let mut bodies = vec![
            Body::prescribed("wheelsets", Frame::fixed([0.0; 3], [0.0; 3])),
            Body::prescribed("bolster", frame),
        ];
        for (name, side) in [("left_side_frame", 1.0), ("right_side_frame", -1.0)] {
            let place = [0.0, SIDE * side, HEIGHT];
            bodies.push(free_body(name, 1150.5, [900.0, 1370.0, 1370.0], place));
        }
        for (name, (end, side)) in [
            "leading_left_wedge",
            "leading_right_wedge",
            "trailing_left_wedge",
            "trailing_right_wedge",
        ]
        .into_iter()
        .zip(PLACES)
        {
            let place = [WEDGE_PLACE * end, SIDE * side, HEIGHT];
            bodies.push(free_body(name, 50.0, [1.461, 0.3756, 1.295], place));
        }
        bodies
    }

    fn load_coil(&self) -> ShearSpring {
        let (law, solid) = match self.damping {
            Damping::Constant => ([15_403.8, 6468.7, 4450.0, 0.0], -1.306),
            Damping::Variable => ([12_252.1, 5369.5, 3616.0, 0.0], -1.406),
        };
        spring("load_coil", law, Some(solid))
    }

    fn control_coil(&self) -> ShearSpring {
        match self.damping {
            Damping::Constant => spring("control_coil", [3702.2, 1979.0, 1346.0, 1.0], None),
            Damping::Variable => spring("control_coil", [6303.0, 1937.0, 1317.0, 1.0], Some(-1.4085)),
        }
    }

    /// A wedge's two faces and its control coil.
    fn add_wedge(&self, model: &mut Model, wedge: usize, end: f64, side: f64) {
        let angle = match self.damping {
            Damping::Constant => 37.5_f64.to_radians(),
            Damping::Variable => 32_f64.to_radians(),
        };
        let length = WEDGE_HEIGHT * angle.tan();
        let side_frame = if side > 0.0 { SIDE_FRAMES } else { SIDE_FRAMES + 1 };
        // Leading wedges are turned by half a turn about z: their points, and the normals of what they meet.
        let turned = |p: [f64; 3]| [-end * p[0], -end * p[1], p[2]];
        let pitch = |pitch: f64| if end > 0.0 { PI - pitch } else { pitch };
        let points = |lower: f64, upper: f64| {
            let (bottom, top) = (-WEDGE_HEIGHT / 3.0, 2.0 * WEDGE_HEIGHT / 3.0);
            let half = 0.5 * WEDGE_WIDTH;
            [
                [lower, -half, bottom],
                [lower, half, bottom],
                [upper, -half, top],
                [upper, half, top],
            ]
            .map(|p| point(turned(p), 2.5e5, 25.0, 0.25))
            .to_vec()
        };
        let behind = -length / 3.0;
        let column = points(behind, behind);
        let slope = points(2.0 * length / 3.0, behind);
        let middle = HEIGHT + WEDGE_HEIGHT / 6.0;
        let at = WEDGE_PLACE + length / 3.0;
        let column_place = [end * at, 0.0, middle - HEIGHT];
        let slope_place = [end * (at - 0.5 * length), SIDE * side, middle - BOLSTER_HEIGHT];
        let toe = self.toe.to_radians();
        let markers = [
            (side_frame, "column", column, column_place, pitch(toe)),
            (BOLSTER, "slope", slope, slope_place, pitch(PI - angle)),
        ];
        for (on, name, points, place, pitch) in markers {
            let marker = Marker::new(inches(place), [0.0, pitch, 0.0]);
            let face = face(name, points, 0.4, 1e6, 1e3);
            model.faces.push((wedge, on, marker, face));
        }
        let seat = match self.damping {
            Damping::Constant => BOLSTER,
            Damping::Variable => side_frame,
        };
        let bottom = [WEDGE_PLACE * end, SIDE * side, HEIGHT - WEDGE_HEIGHT / 3.0];
        add_spring(model, wedge, seat, bottom, self.control_coil());
    }
}

/// Where the side frame stands on both axles.
fn adapters(model: &mut Model, side_frame: usize, side: f64) {
    const STIFFNESS: f64 = 5e5;
    let top = 22.5 + 15_691.0 / STIFFNESS;
    for (name, end) in [("leading_adapter", 1.0), ("trailing_adapter", -1.0)] {
        let points = [3.0, -3.0].map(|y| point([AXLE * end, y, 22.5 - HEIGHT], STIFFNESS, 1000.0, 0.5));
        let marker = Marker::new(inches([AXLE * end, SIDE * side, top]), [0.0, -0.5 * PI, 0.0]);
        let face = face(name, points.to_vec(), 0.5, 2e6, 2e3);
        model.faces.push((side_frame, 0, marker, face));
    }
}

/// Preload lbf, stiffness and shear stiffness lbf/in, damping lbf·s/in; where it goes solid, in.
fn spring(name: &str, [preload, stiffness, shear, damping]: [f64; 4], solid: Option<f64>) -> ShearSpring {
    ShearSpring {
        name: name.to_owned(),
        preload: preload * POUND_FORCE,
        stiffness: stiffness * POUND_PER_INCH,
        shear_stiffness: shear * POUND_PER_INCH,
        damping: damping * POUND_PER_INCH,
        solid: solid.map(|at| Solid {
            at: at * INCH,
            stiffness: 250_000.0 * POUND_PER_INCH,
        }),
    }
}

/// Adds a spring that carries `body` on the seat of another at a place (in).
fn add_spring(model: &mut Model, body: usize, seat: usize, at: [f64; 3], spring: ShearSpring) {
    let marker = |body: usize| {
        let (at, origin) = (inches(at), model.bodies[body].frame.origin);
        Marker::new(std::array::from_fn(|k| at[k] - origin[k]), [0.0; 3])
    };
    let ends = [(body, marker(body)), (seat, marker(seat))];
    model.add(spring, ends[0], ends[1]);
}

/// Weight lbf, moments of inertia lbf·in·s², place in.
fn free_body(name: &str, weight: f64, inertia: [f64; 3], place: [f64; 3]) -> Body {
    Body {
        name: name.to_owned(),
        mass: weight * POUND,
        inertia: inertia.map(|i| i * POUND_INCH),
        center_of_gravity: [0.0; 3],
        frame: Frame::fixed(inches(place), [0.0; 3]),
        free: [true; 6],
        initial: [0.0; 6],
        linearized: false,
    }
}

/// Place in, stiffness lbf/in, damping lbf·s/in.
fn point(place: [f64; 3], stiffness: f64, damping: f64, share: f64) -> ContactPoint {
    ContactPoint {
        position: Vector(inches(place)),
        stiffness: stiffness * POUND_PER_INCH,
        damping: damping * POUND_PER_INCH,
        share,
    }
}

/// A plane face with bristles, of stiffness lbf/in and damping lbf·s/in.
fn face(
    name: &str,
    points: Vec<ContactPoint>,
    coefficient: f64,
    stiffness: f64,
    damping: f64,
) -> ContactFace<Plane> {
    ContactFace {
        name: name.to_owned(),
        points,
        surface: Plane,
        coefficient,
        law: FrictionLaw::Bristle {
            stiffness: stiffness * POUND_PER_INCH,
            damping: damping * POUND_PER_INCH,
        },
    }
}

fn inches(place: [f64; 3]) -> [f64; 3] {
    place.map(|x| x * INCH)
}
