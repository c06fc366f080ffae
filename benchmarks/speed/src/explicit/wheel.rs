//! Coned wheels on rigid rails: Hertz's normal force, creep forces by Kalker's coefficients with the
//! saturation of Shen, Hedrick and Elkins (1983) without spin moment, a spring at the flange.

use super::INCH;
use super::vector::{M, V, cross, dot, times};

/// Radius of wheels, m.
pub const RADIUS: f64 = 18.0 * INCH;
/// Half of the distance of the tape circles, m.
const TAPE: f64 = 29.75 * INCH;
/// Cone of the treads.
const CONE: f64 = 0.05;
/// Radius of the rails' heads, m (a guess: one circle).
const HEAD: f64 = 10.0 * INCH;
/// Steel: Young's modulus Pa and Poisson's ratio.
const STEEL: (f64, f64) = (207e9, 0.28);
/// Kalker's C11, C22, C23 at a/b = 1/0.7 and a Poisson's ratio of 1/4 (Kalker 1967).
const KALKER: [f64; 3] = [4.54, 4.21, 1.95];
/// Damping of contacts: the load grows by 1.5 of it times the rate of the overlap, s/m.
const DAMPING: f64 = 2.0;
/// The flange: clearance m, stiffness N/m (a sprung rail's), damping N·s/m.
const FLANGE: [f64; 3] = [0.41 * INCH, 26.7e6, 47e3];

/// A wave of the track from `start` on: `(1 - cos)/2` of the distance, m.
#[derive(Clone, Copy, Debug)]
pub struct Wave {
    pub start: f64,
    pub length: f64,
    /// Amplitudes, vertical and lateral, m.
    pub size: [f64; 2],
    /// True if the rails move against each other vertically.
    pub against: bool,
}

/// Hertz's constants of the contact: load by overlap^1.5, N/m^1.5, and product of the semi-axes by overlap,
/// m; by the approximations of Brewe and Hamrock (1977), within 3 %.
#[derive(Clone, Copy, Debug)]
pub struct Hertz {
    stiffness: f64,
    area: f64,
}

impl Hertz {
    /// Returns those of a wheel on a rail of steel.
    pub fn steel() -> Self {
        let (radius, ratio) = (1.0 / (1.0 / RADIUS + 1.0 / HEAD), RADIUS / HEAD);
        let ellipticity = ratio.powf(2.0 / std::f64::consts::PI);
        let quarter = std::f64::consts::FRAC_PI_2;
        let (second, first) = (
            1.0 + (quarter - 1.0) / ratio,
            quarter + (quarter - 1.0) * ratio.ln(),
        );
        let modulus = STEEL.0 / (1.0 - STEEL.1 * STEEL.1);
        let pi = std::f64::consts::PI;
        let stiffness = pi * ellipticity * modulus * (radius * second / (4.5 * first.powi(3))).sqrt();
        let longer = 6.0 * ellipticity.powi(2) * second * stiffness * radius / (pi * modulus);
        Self {
            stiffness,
            area: longer.powf(2.0 / 3.0) / ellipticity,
        }
    }

    /// Returns the stiffness at a load, N/m.
    pub fn stiffness_at(&self, load: f64) -> f64 {
        1.5 * self.stiffness.powf(2.0 / 3.0) * load.cbrt()
    }
}

/// A wheel's answer: force (N) in fixed axes, the arm (m) from the wheelset's center to it, stored energy J.
pub struct OnRail {
    pub force: V,
    pub arm: V,
    pub energy: f64,
}

/// Returns the force on the wheel of a side (+1 left) of a wheelset with its pose and its rates in axes that
/// move along the track at `speed`; `rates` turn in fixed axes, spin included. `along` is where it is on the
/// track (m).
#[inline(always)]
pub fn on_rail(
    (hertz, friction, damped): (&Hertz, f64, f64),
    waves: &[Wave],
    side: f64,
    (place, velocity): (V, V),
    (turned, rates): (&M, V),
    (along, speed): (f64, f64),
) -> OnRail {
    let arm = times(turned, [0.0, side * TAPE, -RADIUS]);
    let (at, slip) = ([place[1] + arm[1], place[2] + arm[2]], cross(rates, arm));
    // Rail: displacements and rates, vertical and lateral.
    let mut rail = [[0.0; 2]; 2];
    for wave in waves {
        let distance = along + arm[0] - wave.start;
        if distance > 0.0 {
            let number = std::f64::consts::TAU / wave.length;
            let (sine, cosine) = (number * distance).sin_cos();
            let own = [0.5 * (1.0 - cosine), 0.5 * number * sine * speed];
            let up = if wave.against {
                side * wave.size[0]
            } else {
                wave.size[0]
            };
            for k in 0..2 {
                rail[0][k] += up * own[k];
                rail[1][k] += wave.size[1] * own[k];
            }
        }
    }
    let across = at[0] - side * TAPE - rail[1][0];
    let velocity = [
        velocity[0] + speed + slip[0],
        velocity[1] + slip[1],
        velocity[2] + slip[2],
    ];
    // Force of the flange, which a sprung rail takes.
    let over = side * across - FLANGE[0];
    let (mut flange, mut energy) = (0.0, 0.0);
    if over > 0.0 {
        flange = -side * (FLANGE[1] * over + damped * FLANGE[2] * side * (velocity[1] - rail[1][1])).max(0.0);
        energy = 0.5 * FLANGE[1] * over * over;
    }
    let overlap = rail[0][0] - at[1] + CONE * side * across;
    if overlap <= 0.0 {
        return OnRail {
            force: [0.0, flange, 0.0],
            arm,
            energy,
        };
    }
    let rate = rail[0][1] - velocity[2] + CONE * side * (velocity[1] - rail[1][1]);
    let root = overlap.sqrt();
    let elastic = hertz.stiffness * overlap * root;
    energy += 0.4 * elastic * overlap;
    let load = (elastic * (1.0 + 1.5 * DAMPING * damped * rate)).max(0.0);
    // Creep, relative to the speed; the radius grows where the flange comes nearer.
    let creep = [
        (velocity[0] - rates[1] * CONE * side * across) / speed,
        (velocity[1] - rail[1][1]) / speed,
        dot(rates, [0.0, -CONE * side, 1.0]) / speed,
    ];
    let (area, shear) = (hertz.area * overlap, STEEL.0 / (2.0 * (1.0 + STEEL.1)));
    let linear = [
        -shear * area * KALKER[0] * creep[0],
        -shear * area * (KALKER[1] * creep[1] + area.sqrt() * KALKER[2] * creep[2]),
    ];
    let size = (linear[0] * linear[0] + linear[1] * linear[1]).sqrt();
    let ratio = size / (friction * load).max(1e-9);
    let share = if ratio < 3.0 {
        1.0 - ratio / 3.0 + ratio * ratio / 27.0
    } else {
        1.0 / ratio
    };
    let [x, y] = linear.map(|own| share * own);
    OnRail {
        force: [x, flange + y - CONE * side * load, load + CONE * side * y],
        arm,
        energy,
    }
}
