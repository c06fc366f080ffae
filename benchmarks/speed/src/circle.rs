//! A free body carried once round a circle of track: which coordinates can a car on track have?
//!
//! A guide runs along a circle to the left at constant speed, and holds the body by a bushing. [`Carried`] is
//! the body in absolute coordinates, written here for this question alone, with any order of its three
//! angles; [`on_core`] is a body of the core, in absolute coordinates or in coordinates relative to the
//! moving guide. No gravity. SI units.
//!
//! Equations: rotation `R = R_1(q4) R_2(q5) R_3(q6)` about the axes of [`Order`], angular velocity
//! `ω = Σ q˙_k e_k`, and by Kane's method `e_k · (I ω˙ + ω × I ω) = e_k · M` in fixed axes. With the spin
//! last the bushing holds the carrier, which does not spin: `M` does no work on the spin.

use std::f64::consts::{FRAC_PI_2, TAU};

use integrate::{FunctionProblem, Integrator, Method, Options, Problem, SetupError, StepError};
use mechanics::body::Body;
use mechanics::coil::{Coil, CoilLaw};
use mechanics::energy_balance::Entries;
use mechanics::frame::Frame;
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::system::{Model, System};
use mechanics::vector::{Matrix, Vector, rotation_x, rotation_y, rotation_z};
use numerics::scalar::{Dual, Real};

/// Radius of a curve of 7.5 degrees, m, and 60 km/h, m/s.
pub const RADIUS: f64 = 232.9;
/// Speed, m/s.
pub const SPEED: f64 = 60.0 / 3.6;
/// Rate of heading, rad/s.
pub const HEADING_RATE: f64 = SPEED / RADIUS;
/// Spin of a wheel of 36 in, rad/s.
pub const SPIN: f64 = SPEED / 0.4572;
/// A wheelset: mass, kg, moments of inertia, kg·m².
pub const MASS: f64 = 1353.7;
/// Moments of inertia, kg·m².
pub const INERTIA: [f64; 3] = [776.2, 115.0, 776.2];
/// The bushing: N/m, N·s/m, N·m, N·m·s.
pub const STIFFNESS: f64 = 1e7;
const DAMPING: f64 = 5e4;
const ROTATIONAL_STIFFNESS: f64 = 1e6;
const ROTATIONAL_DAMPING: f64 = 2e4;

/// Time of one circle, s.
pub const CIRCLE: f64 = TAU / HEADING_RATE;

/// Returns the lateral force in the steady state, N: `m ω² (R + d)`, where it stretches the bushing by d.
#[must_use]
pub fn steady_force() -> f64 {
    let inertia = MASS * HEADING_RATE * HEADING_RATE;
    inertia * RADIUS * STIFFNESS / (STIFFNESS - inertia)
}

/// The order in which the angles turn a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Pitch, yaw, roll: the core's, singular at 90° of yaw.
    PitchYawRoll,
    /// Yaw, pitch, roll: heading first, singular at 90° of pitch.
    YawPitchRoll,
    /// Yaw, roll, pitch: heading first and spin last, singular at 90° of roll.
    YawRollPitch,
}

impl Order {
    /// Returns the axes, first to last.
    fn axes(self) -> [usize; 3] {
        match self {
            Self::PitchYawRoll => [1, 2, 0],
            Self::YawPitchRoll => [2, 1, 0],
            Self::YawRollPitch => [2, 0, 1],
        }
    }

    /// Returns whether pitch is a spin, which the bushing leaves free.
    fn spins(self) -> bool {
        self == Self::YawRollPitch
    }
}

/// A body in absolute coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Carried {
    /// The order of its angles.
    pub order: Order,
    /// Heading of the track at the start, rad.
    pub heading: f64,
    /// Rate of pitch at the start, rad/s. With the spin last the bushing leaves it free.
    pub spin: f64,
}

/// States: position, angles in their order, the rates of both, the guide's work, losses.
pub const STATES: usize = 14;

/// Force and moment of the bushing on the body, guide axes.
#[derive(Clone, Copy, Debug)]
pub struct Bushing<S> {
    /// N.
    pub force: Vector<S>,
    /// N·m.
    pub moment: Vector<S>,
    /// Stored energy, J.
    pub energy: S,
    loss: S,
    work: S,
}

/// Returns the states of [`Carried`] in a vector of them.
///
/// # Panics
/// If there are fewer.
#[must_use]
pub fn states(x: &[f64]) -> [f64; STATES] {
    std::array::from_fn(|k| x[k])
}

struct Pose<S> {
    rotation: Matrix<S>,
    /// Axes of the angles, fixed axes.
    axes: [Vector<S>; 3],
    angular_velocity: Vector<S>,
    /// Angular acceleration at constant rates.
    bias: Vector<S>,
    carrier: Matrix<S>,
    carrier_velocity: Vector<S>,
}

impl Carried {
    /// At the guide's pose and velocity.
    #[must_use]
    pub fn start(&self) -> [f64; STATES] {
        let (s, c) = libm::sincos(self.heading);
        let mut x = [0.0; STATES];
        (x[0], x[1]) = (RADIUS * s, -RADIUS * c);
        (x[6], x[7]) = (SPEED * c, SPEED * s);
        for (k, axis) in self.order.axes().into_iter().enumerate() {
            match axis {
                1 => x[9 + k] = self.spin,
                2 => (x[3 + k], x[9 + k]) = (self.heading, HEADING_RATE),
                _ => {}
            }
        }
        x
    }

    fn pose<S: Real>(&self, x: &[S; STATES]) -> Pose<S> {
        let mut rotation: Matrix<S> = Matrix::identity();
        let mut carrier = rotation;
        let (mut velocity, mut carrier_velocity, mut bias) = (Vector::zero(), Vector::zero(), Vector::zero());
        let mut axes = [Vector::zero(); 3];
        for (k, axis) in self.order.axes().into_iter().enumerate() {
            (carrier, carrier_velocity) = (rotation, velocity);
            axes[k] = rotation.column(axis);
            let own: Vector<S> = axes[k].scale(x[9 + k]);
            bias += velocity.cross::<S, S>(own);
            velocity += own;
            let turn = [rotation_x, rotation_y, rotation_z][axis](x[3 + k].sin_cos());
            rotation = rotation.times(turn);
        }
        if !self.order.spins() {
            (carrier, carrier_velocity) = (rotation, velocity);
        }
        Pose {
            rotation,
            axes,
            angular_velocity: velocity,
            bias,
            carrier,
            carrier_velocity,
        }
    }

    fn guide<S: Real>(&self, time: S) -> (Matrix<S>, Vector<S>) {
        let (s, c) = (time * HEADING_RATE + self.heading).sin_cos();
        let place = Vector([s * RADIUS, -(c * RADIUS), S::zero()]);
        (rotation_z((s, c)), place)
    }

    fn bushing<S: Real>(&self, time: S, x: &[S; STATES], pose: &Pose<S>) -> Bushing<S> {
        let (guide, place) = self.guide(time);
        let angular_velocity: Vector<S> = Vector::lift(Vector([0.0, 0.0, HEADING_RATE]));
        let position = Vector([x[0], x[1], x[2]]);
        // The circle's center is the origin: the guide turns about it.
        let carried = angular_velocity.cross::<S, S>(position);
        let velocity = Vector([x[6], x[7], x[8]]) - carried;
        let offset: Vector<S> = guide.apply_transposed(position - place);
        let rate: Vector<S> = guide.apply_transposed(velocity);
        let turned: Matrix<S> = guide.transpose().times(pose.carrier);
        let turn_rate: Vector<S> = guide.apply_transposed(pose.carrier_velocity - angular_velocity);
        let [a, b, c] = turned.0;
        let half = S::from(0.5);
        let angle = Vector([(c[1] - b[2]) * half, (a[2] - c[0]) * half, (b[0] - a[1]) * half]);
        let scaled = |v: Vector<S>, by: f64| -> Vector<S> { v.scale(by) };
        let force = -(scaled(offset, STIFFNESS) + scaled(rate, DAMPING));
        let moment = -(scaled(angle, ROTATIONAL_STIFFNESS) + scaled(turn_rate, ROTATIONAL_DAMPING));
        let trace = a[0] + b[1] + c[2];
        let power = guide.apply::<S, S>(force).dot::<S, S>(carried);
        Bushing {
            force,
            moment,
            energy: offset.dot::<S, S>(offset) * (0.5 * STIFFNESS)
                + (S::from(3.0) - trace) * (0.5 * ROTATIONAL_STIFFNESS),
            loss: rate.dot::<S, S>(rate) * DAMPING + turn_rate.dot::<S, S>(turn_rate) * ROTATIONAL_DAMPING,
            work: power + moment.0[2] * HEADING_RATE,
        }
    }

    /// Returns the wrench of the bushing on the body.
    #[must_use]
    pub fn loads(&self, time: f64, x: &[f64; STATES]) -> Bushing<f64> {
        self.bushing(time, x, &self.pose(x))
    }

    /// Stored and kinetic energy, J.
    #[must_use]
    pub fn energy(&self, time: f64, x: &[f64; STATES]) -> f64 {
        let pose = self.pose(x);
        let own: Vector<f64> = pose.rotation.apply_transposed(pose.angular_velocity);
        let spin: f64 = (0..3).map(|k| INERTIA[k] * own.0[k] * own.0[k]).sum();
        let speed: f64 = x[6..9].iter().map(|u| u * u).sum();
        0.5 * (MASS * speed + spin) + self.bushing(time, x, &pose).energy
    }

    /// Returns the energies of a state for an energy balance; `start` is the energy at the start, J.
    #[must_use]
    pub fn ledger(&self, time: f64, x: &[f64; STATES], start: f64) -> Entries {
        let [.., work, losses] = *x;
        let stored_change = self.energy(time, x) - start;
        Entries {
            work,
            losses,
            stored_change,
            residual: work - stored_change - losses,
            admissible: 0.0,
            exchanged: 0.0,
        }
    }

    /// Returns the right-hand side.
    pub fn rates<S: Real>(&self, time: S, x: &[S; STATES]) -> [S; STATES] {
        let pose = self.pose(x);
        let bushing = self.bushing(time, x, &pose);
        let (guide, _) = self.guide(time);
        let force: Vector<S> = guide.apply(bushing.force);
        let moment: Vector<S> = guide.apply(bushing.moment);
        let inertia = |v: Vector<S>| -> Vector<S> {
            let [a, b, c] = pose.rotation.apply_transposed::<S, S>(v).0;
            let own = Vector([a * INERTIA[0], b * INERTIA[1], c * INERTIA[2]]);
            pose.rotation.apply(own)
        };
        let momentum = inertia(pose.angular_velocity);
        let gyration = pose.angular_velocity.cross::<S, S>(momentum) + inertia(pose.bias);
        let spins = self.order.spins();
        let right = [0, 1, 2].map(|k| {
            let active = if spins && k == 2 { Vector::zero() } else { moment };
            pose.axes[k].dot::<S, S>(active - gyration)
        });
        let rows = pose.axes.map(|axis| {
            let own = inertia(axis);
            Vector(pose.axes.map(|other| other.dot::<S, S>(own)))
        });
        let adjoint: [Vector<S>; 3] = [
            rows[1].cross(rows[2]),
            rows[2].cross(rows[0]),
            rows[0].cross(rows[1]),
        ];
        let inverse = rows[0].dot::<S, S>(adjoint[0]).recip();
        let mut out = [S::zero(); STATES];
        for k in 0..3 {
            (out[k], out[3 + k]) = (x[6 + k], x[9 + k]);
            out[6 + k] = force.0[k] * (1.0 / MASS);
            out[9 + k] = (0..3).fold(S::zero(), |sum, row| sum + adjoint[row].0[k] * right[row]) * inverse;
        }
        (out[12], out[13]) = (bushing.work, bushing.loss);
        out
    }

    /// Derivatives of the right-hand side by states (rows of the matrix) and by time, exact.
    #[must_use]
    pub fn linearize(&self, time: f64, x: &[f64; STATES]) -> ([[f64; STATES]; STATES], [f64; STATES]) {
        // The last two states are quadratures: on them nothing depends, and time takes a place of theirs.
        let states = std::array::from_fn(|k| match k {
            0..12 => Dual::<STATES>::variable(x[k], k),
            _ => Dual::from(x[k]),
        });
        let rates = self.rates(Dual::variable(time, 12), &states);
        let mut matrix = rates.map(|rate| rate.derivative);
        let by_time = matrix.map(|row| row[12]);
        for row in &mut matrix {
            row[12] = 0.0;
        }
        (matrix, by_time)
    }

    /// Returns the problem for the integrator; the spin's angle is not error controlled where it is free.
    #[must_use]
    pub fn problem(self) -> FunctionProblem<'static> {
        let mut scales = vec![
            0.1, 0.1, 0.1, 1.0, 1.0, 1.0, 10.0, 10.0, 10.0, 100.0, 100.0, 100.0, 10.0, 10.0,
        ];
        if self.order.spins() {
            scales[5] = f64::INFINITY;
        }
        FunctionProblem::new(
            scales,
            move |time, x, dx| dx.copy_from_slice(&self.rates(time, &states(x))),
            move |time, x, matrix| {
                let (rows, _) = self.linearize(time, &states(x));
                matrix.copy_from_slice(rows.as_flattened());
            },
        )
        .displacements(6)
        .time_derivative(move |time, x, df_dt| df_dt.copy_from_slice(&self.linearize(time, &states(x)).1))
    }
}

/// Integrates until `end`, s, or as far as it goes, and shows the run after each step; returns why it
/// stopped.
///
/// # Errors
/// It cannot begin.
pub fn travel<P: Problem>(
    problem: P,
    start: &[f64],
    (method, relative_tolerance): (Method, f64),
    end: f64,
    mut each: impl FnMut(&Integrator<P>),
) -> Result<(Integrator<P>, Option<StepError>), SetupError> {
    let options = Options {
        relative_tolerance,
        maximum_steps: 200_000,
        ..Options::of(method)
    };
    let mut integrator = Integrator::new(problem, options, 0.0, start)?;
    while integrator.time() < end {
        if let Err(error) = integrator.step_to(end) {
            return Ok((integrator, Some(error)));
        }
        each(&integrator);
    }
    Ok((integrator, None))
}

/// The coordinates of a body of the core.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinates {
    /// Relative to the fixed frame.
    Absolute,
    /// Relative to the moving guide.
    Relative,
}

/// Returns the same body, held by six coils, as a system of the core, and its state at the start; body 1.
///
/// # Errors
/// It makes no system, which would be a defect.
pub fn on_core(coordinates: Coordinates) -> Result<(System, Vec<f64>), String> {
    let sine = |amplitude: f64, phase: f64| Motion::Sine {
        amplitude,
        angular_frequency: HEADING_RATE,
        phase,
    };
    let mut guide = Frame::fixed([0.0; 3], [0.0; 3]);
    guide.motions[0] = sine(RADIUS, 0.0);
    guide.motions[1] = sine(-RADIUS, FRAC_PI_2);
    guide.motions[5] = Motion::line(0.0, [0.0, HEADING_RATE]);
    let mut body = Body::prescribed("body", guide.clone());
    (body.mass, body.inertia, body.free) = (MASS, INERTIA, [true; 6]);
    if coordinates == Coordinates::Absolute {
        body.frame = Frame::fixed([0.0, -RADIUS, 0.0], [0.0; 3]);
    }
    let mut coils = Vec::new();
    for (axis, arm) in [(0, 1), (1, 2), (2, 0)] {
        for side in [1.0, -1.0] {
            let mut end = [0.0; 3];
            end[arm] = side;
            let mut seat = end;
            seat[axis] -= 10.0;
            let coil = Coil {
                end: Vector(end),
                acts_at: Vector(end),
                law: CoilLaw::Linear {
                    stiffness: 0.5 * STIFFNESS,
                },
                // One of those along z is longer: the body leans, so that no angle stays zero.
                free_length: if axis == 2 && side > 0.0 { 10.01 } else { 10.0 },
                damping: 0.5 * DAMPING,
                rotational_damping: 0.0,
                pulls: true,
            };
            coils.push((1, 0, Marker::new(seat, [0.0; 3]), coil));
        }
    }
    let model = Model {
        bodies: vec![Body::prescribed("guide", guide), body],
        gravity: [0.0; 3],
        coils,
        ..Model::default()
    };
    let system = System::new(model).map_err(|error| error.to_string())?;
    let mut x = system.initial_state();
    if coordinates == Coordinates::Absolute {
        (x[6], x[11]) = (SPEED, HEADING_RATE);
    }
    Ok((system, x))
}
