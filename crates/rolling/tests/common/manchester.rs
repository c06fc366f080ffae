//! Vehicle 1 of the Manchester benchmarks (Iwnicki 1998): body, two bogies, four wheelsets on linear springs
//! and dampers. On the core, and as mass, damping and stiffness matrices by themselves.
//!
//! Masses, stiffnesses and dampings are those of the published table. Heights and the lateral places of
//! springs are guesses: the sources at hand lack them. Each spring acts at one height; bump stops, traction
//! rods and anti-yaw dampers are left out.

use std::f64::consts::TAU;
use std::sync::Arc;

use mechanics::body::Body;
use mechanics::frame::Frame;
use mechanics::link::Marker;
use mechanics::system::{Held, Model, System};
use nalgebra::{DMatrix, DVector, RowDVector, SymmetricEigen};
use rolling::linear::LinearOnTrack;
use rolling::wheelset::{WheelsetBody, WheelsetPlace, coordinate, leave_spin_uncontrolled, marker};
use wheelrail::conicity::LinearGeometry;
use wheelrail::contact::{CreepCoefficients, LinearWheelset};
use wheelrail::track::{RailLines, Segment};

use super::bushing::Bushing;
use super::{bisection, track};

/// Mass (kg), moments of inertia in roll, pitch, yaw (kg·m²), height (m; guesses but for the wheelsets').
const BODY: (f64, [f64; 3], f64) = (32_000.0, [56_800.0, 1.97e6, 1.97e6], 1.8);
const BOGIE: (f64, [f64; 3], f64) = (2615.0, [1722.0, 1476.0, 3067.0], 0.6);
const WHEELSET: (f64, [f64; 3], f64) = (1813.0, [1120.0, 112.0, 1120.0], R);
/// Radius, half wheelbase of a bogie, half distance of the bogies, m.
const R: f64 = 0.46;
const HALF_WHEELBASE: f64 = 1.28;
const HALF_PIVOT: f64 = 9.5;
/// Per axle box and per side of a bogie: stiffness (N/m) and damping (N·s/m) forward, left, up; half distance
/// and height (m), guesses.
const PRIMARY: ([f64; 3], [f64; 3], [f64; 2]) = ([31_391e3, 3884e3, 1220e3], [0.0, 0.0, 4e3], [1.0, R]);
const SECONDARY: ([f64; 3], [f64; 3], [f64; 2]) = ([160e3, 160e3, 430e3], [0.0, 32e3, 20e3], [1.0, 0.83]);
/// Roll bar of a bogie, N·m/rad.
const ROLL_BAR: f64 = 940e3;
/// Half distance of the contacts (m), creep coefficients (N), stiffnesses that carry a wheelset (N/m,
/// N·m/rad): guesses.
const HALF: f64 = 0.75;
const CREEP: [f64; 2] = [10e6, 9e6];
const SUPPORT: [f64; 2] = [1e9, 1e9];

/// Wheelsets 0 to 3, bogies 4 and 5, body 6: mass, moments of inertia, place.
fn parts() -> Vec<(f64, [f64; 3], [f64; 3])> {
    let bogies = [HALF_PIVOT, -HALF_PIVOT];
    let axles = bogies
        .into_iter()
        .flat_map(|x| [x + HALF_WHEELBASE, x - HALF_WHEELBASE]);
    let at = |(mass, inertia, height): (f64, [f64; 3], f64), x: f64| (mass, inertia, [x, 0.0, height]);
    let mut own: Vec<_> = axles.map(|x| at(WHEELSET, x)).collect();
    own.extend(bogies.map(|x| at(BOGIE, x)));
    own.push(at(BODY, 0.0));
    own
}

/// A spring with a damper between two parts at a place: stiffness and damping forward, left, up; about x.
struct Spring {
    between: [usize; 2],
    place: [f64; 3],
    stiffness: [f64; 3],
    damping: [f64; 3],
    roll: f64,
}

fn springs() -> Vec<Spring> {
    let mut own = Vec::new();
    for (bogie, x) in [HALF_PIVOT, -HALF_PIVOT].into_iter().enumerate() {
        for side in [1.0, -1.0] {
            for (axle, ahead) in [HALF_WHEELBASE, -HALF_WHEELBASE].into_iter().enumerate() {
                let (stiffness, damping, [half, height]) = PRIMARY;
                own.push(Spring {
                    between: [2 * bogie + axle, 4 + bogie],
                    place: [x + ahead, side * half, height],
                    stiffness,
                    damping,
                    roll: 0.0,
                });
            }
            let (stiffness, damping, [half, height]) = SECONDARY;
            own.push(Spring {
                between: [6, 4 + bogie],
                place: [x, side * half, height],
                stiffness,
                damping,
                roll: 0.5 * ROLL_BAR,
            });
        }
    }
    own
}

/// Returns the vehicle on the core: on linear wheels of a conicity at a speed (m/s), or its wheelsets held.
/// No gravity: springs have no preload.
fn on_the_core(running: Option<(f64, f64)>) -> (System, Vec<f64>) {
    let mut bodies = vec![Body::prescribed("ground", Frame::fixed([0.0; 3], [0.0; 3]))];
    let middle = 50.0;
    for (number, (mass, inertia, [x, y, z])) in parts().into_iter().enumerate() {
        let place = [x + middle, y, z];
        let body = if number < 4 {
            let wheelset = WheelsetBody {
                mass,
                about_axle: inertia[1],
                about_diameter: inertia[0],
            };
            let at = WheelsetPlace {
                position: place,
                ..WheelsetPlace::default()
            };
            let mut own = wheelset.body(&format!("wheelset {}", number + 1), &at);
            own.free = [running.is_some(); 6];
            own
        } else {
            let name = ["front bogie", "rear bogie", "body"][number - 4];
            let mut own = Body::free(name, mass, inertia, [0.0; 6]);
            own.frame = Frame::fixed(place, [0.0; 3]);
            own
        };
        bodies.push(body);
    }
    let mut model = Model::new(bodies, [0.0; 3]);
    let parts = parts();
    for spring in springs() {
        let [a, b] = spring.between;
        let from = |number: usize| [0, 1, 2].map(|k| spring.place[k] - parts[number].2[k]);
        // The axle boxes are on the axle, whose spin does not move them.
        let at = if a < 4 {
            marker(spring.place[1])
        } else {
            Marker::new(from(a), [0.0; 3])
        };
        let bushing = Bushing {
            along: spring.stiffness,
            about: [spring.roll, 0.0, 0.0],
            damping: spring.damping,
            turning: [0.0; 3],
        };
        model.add(bushing, (a + 1, at), (b + 1, Marker::new(from(b), [0.0; 3])));
    }
    let Some((conicity, speed)) = running else {
        let system = System::new(model).unwrap();
        let x = system.initial_state();
        return (system, x);
    };
    let lines = Arc::new(RailLines::new(
        track(&[Segment::Tangent(100.0)], Vec::new()),
        [HALF; 2],
    ));
    let wheels = LinearOnTrack {
        name: "wheels".to_owned(),
        lines,
        wheelset: LinearWheelset {
            geometry: LinearGeometry {
                roll_coefficient: 0.0,
                ..LinearGeometry::of_cones(conicity, HALF, R)
            },
            creep: CreepCoefficients {
                f11: CREEP[0],
                f22: CREEP[1],
                f23: 0.0,
                f33: 0.0,
            },
            spin: false,
            axle_load: 0.0,
        },
        support: SUPPORT,
        slowest: 1e-3,
    };
    for wheelset in 1..=4 {
        model.add(
            wheels.clone(),
            (wheelset, marker(0.0)),
            (0, Marker::new([0.0; 3], [0.0; 3])),
        );
    }
    let mut system = System::new(model).unwrap();
    let mut x = system.initial_state();
    let speeds = system.layout().speeds;
    for number in 1..=7 {
        let forward = if number <= 4 { coordinate::FORWARD } else { 0 };
        x[speeds + system.position_of(number, forward).unwrap()] = speed;
        if number <= 4 {
            x[speeds + system.position_of(number, coordinate::SPIN).unwrap()] = speed / R;
            leave_spin_uncontrolled(&mut system, number);
        }
    }
    (system, x)
}

/// Mass, damping and stiffness matrix of the vehicle by itself: six small displacements and rotations (about
/// x, y, z) of each part, from the extensions of the springs; with linear wheels where it runs.
struct Matrices {
    mass: DVector<f64>,
    damping: DMatrix<f64>,
    stiffness: DMatrix<f64>,
}

fn by_itself(running: Option<(f64, f64)>) -> Matrices {
    let parts = parts();
    let n = 6 * parts.len();
    let mut own = Matrices {
        mass: DVector::from_iterator(
            n,
            parts
                .iter()
                .flat_map(|(mass, [x, y, z], _)| [*mass, *mass, *mass, *x, *y, *z]),
        ),
        damping: DMatrix::zeros(n, n),
        stiffness: DMatrix::zeros(n, n),
    };
    for spring in springs() {
        for k in 0..3 {
            // The displacement of the place along axis k: d + θ × arm.
            let mut row = RowDVector::zeros(n);
            for (part, sign) in spring.between.into_iter().zip([1.0, -1.0]) {
                let [x, y, z] = [0, 1, 2].map(|i| spring.place[i] - parts[part].2[i]);
                let turned = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]][k];
                row[6 * part + k] = sign;
                for (i, own) in turned.into_iter().enumerate() {
                    row[6 * part + 3 + i] = sign * own;
                }
            }
            own.stiffness += row.transpose() * &row * spring.stiffness[k];
            own.damping += row.transpose() * &row * spring.damping[k];
        }
        let mut row = RowDVector::zeros(n);
        row[6 * spring.between[0] + 3] = 1.0;
        row[6 * spring.between[1] + 3] = -1.0;
        own.stiffness += row.transpose() * &row * spring.roll;
    }
    let Some((conicity, speed)) = running else {
        return own;
    };
    for first in (0..4).map(|axle| 6 * axle) {
        let spin = speed / R;
        // The axle turns with the heading and the roll: its angular momentum does.
        own.damping[(first + 3, first + 5)] -= WHEELSET.1[1] * spin;
        own.damping[(first + 5, first + 3)] += WHEELSET.1[1] * spin;
        own.stiffness[(first + 2, first + 2)] += SUPPORT[0];
        own.stiffness[(first + 3, first + 3)] += SUPPORT[1];
        for side in [1.0, -1.0] {
            // Slip at the contact, forward and left, by the rates and by the displacements: the radius there
            // grows with the shift at the height of the rails, not with the roll on the support, and the
            // axle yaws.
            let rates = [
                [1.0, 0.0, 0.0, 0.0, -R, -side * HALF],
                [0.0, 1.0, 0.0, R, 0.0, 0.0],
            ];
            let places = [
                [
                    0.0,
                    -spin * side * conicity,
                    0.0,
                    -spin * side * conicity * R,
                    0.0,
                    0.0,
                ],
                [0.0, 0.0, 0.0, 0.0, 0.0, -speed],
            ];
            for ((rate, place), creep) in rates.iter().zip(&places).zip(CREEP) {
                for i in 0..6 {
                    for j in 0..6 {
                        own.damping[(first + i, first + j)] += creep / speed * rate[i] * rate[j];
                        own.stiffness[(first + i, first + j)] += creep / speed * rate[i] * place[j];
                    }
                }
            }
        }
    }
    own
}

/// A natural frequency: what moves most, the frequency (Hz) on the core and by itself.
pub struct Natural {
    pub name: String,
    pub found: f64,
    pub expected: f64,
}

/// Returns all natural frequencies on wheelsets that are held, rising.
pub fn natural() -> Vec<Natural> {
    let (mut system, x) = on_the_core(None);
    let found = system.vibrations(0.0, &x, Held::All).unwrap();
    let Matrices { mass, stiffness, .. } = by_itself(None);
    let n = 18;
    let root = mass.rows(24, n).map(f64::sqrt);
    let scaled = DMatrix::from_fn(n, n, |i, j| stiffness[(24 + i, 24 + j)] / (root[i] * root[j]));
    let solved = SymmetricEigen::new(scaled);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| solved.eigenvalues[*a].total_cmp(&solved.eigenvalues[*b]));
    let named = |k: usize| {
        let shape = solved.eigenvectors.column(k);
        let most = (0..n)
            .max_by(|a, b| shape[*a].abs().total_cmp(&shape[*b].abs()))
            .unwrap();
        let motion = ["forward", "lateral", "bounce", "roll", "pitch", "yaw"][most % 6];
        if most >= 12 {
            return format!("body {motion}");
        }
        let alike = shape[most % 6] * shape[6 + most % 6] > 0.0;
        format!("bogies {motion}, {}", if alike { "alike" } else { "opposed" })
    };
    let pairs = order.into_iter().zip(&found.modes);
    pairs
        .map(|(k, mode)| Natural {
            name: named(k),
            found: mode.frequency,
            expected: solved.eigenvalues[k].sqrt() / TAU,
        })
        .collect()
}

/// Bounce of the body (Hz) in closed form: the lower frequency of body and bogies as two masses on springs.
pub fn bounce() -> f64 {
    let ([.., k1], [.., k2]) = (PRIMARY.0, SECONDARY.0);
    // Body and both bogies: M1 ẍ1 + 4 k2 (x1 - x2) = 0, M2 ẍ2 + 4 k2 (x2 - x1) + 8 k1 x2 = 0.
    let (m1, m2) = (BODY.0, 2.0 * BOGIE.0);
    let (a, b) = (4.0 * k2 / m1, (4.0 * k2 + 8.0 * k1) / m2);
    let mixed = 16.0 * k2 * k2 / (m1 * m2);
    let square = 0.5 * (a + b - ((a - b) * (a - b) + 4.0 * mixed).sqrt());
    square.sqrt() / TAU
}

/// Returns the least damped vibration of 0.3 to 15 Hz at a speed (m/s): growth (1/s) and frequency (Hz).
pub fn least_on_the_core(conicity: f64, speed: f64) -> [f64; 2] {
    let (mut system, x) = on_the_core(Some((conicity, speed)));
    let found = system.eigenvalues(0.0, &x, 20.0).unwrap();
    least(found.into_iter())
}

/// Returns the same by itself.
pub fn least_by_itself(conicity: f64, speed: f64) -> [f64; 2] {
    let own = by_itself(Some((conicity, speed)));
    let n = own.mass.len();
    let mut first_order = DMatrix::zeros(2 * n, 2 * n);
    for i in 0..n {
        first_order[(i, n + i)] = 1.0;
        for j in 0..n {
            first_order[(n + i, j)] = -own.stiffness[(i, j)] / own.mass[i];
            first_order[(n + i, n + j)] = -own.damping[(i, j)] / own.mass[i];
        }
    }
    let found = first_order.complex_eigenvalues();
    least(found.iter().map(|own| [own.re, own.im]))
}

fn least(found: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    let vibrations = found.filter(|[_, turning]| (0.3 * TAU..15.0 * TAU).contains(turning));
    let [growth, turning] = vibrations
        .max_by(|a, b| a[0].total_cmp(&b[0]))
        .expect("a vibration");
    [growth, turning / TAU]
}

/// Critical speed (m/s) and frequency (Hz) of a conicity, on the core and by itself.
pub fn critical(conicity: f64) -> [[f64; 2]; 2] {
    let solve = |of: fn(f64, f64) -> [f64; 2]| {
        let (mut low, mut high) = (20.0, 20.0);
        while of(conicity, high)[0] < 0.0 && high < 400.0 {
            (low, high) = (high, high + 20.0);
        }
        let found = bisection([low, high], |speed| of(conicity, speed)[0]);
        [found, of(conicity, found)[1]]
    };
    [solve(least_on_the_core), solve(least_by_itself)]
}
