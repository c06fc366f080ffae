//! The accelerations against Lagrange's equations `d/dt ∂T/∂u - ∂T/∂q + ∂V/∂q + ∂D/∂u = 0`, with T, V and D
//! written here from positions and rotation matrices alone: velocities and angular velocities come from
//! differentiating these by numbers with three nilpotent units (exact to rounding), so that no formula of the
//! library is used twice.

use crate::common::{ALL, Random, UP, body, coil, face, ground, model, rates};
use integrate::Problem;
use mechanics::body::Body;
use mechanics::frame::Frame;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::system::System;
use std::ops::{Add, Mul, Sub};

/// A number with three units e1, e2, e3 whose squares are zero; component `s` belongs to the product of the
/// units in the bit set `s`.
#[derive(Clone, Copy, Debug)]
struct N([f64; 8]);

fn n(value: f64) -> N {
    let mut out = [0.0; 8];
    out[0] = value;
    N(out)
}
/// Returns the unit with this bit, times a number.
fn unit(bit: usize) -> N {
    let mut out = [0.0; 8];
    out[bit] = 1.0;
    N(out)
}
impl Add for N {
    type Output = N;
    fn add(self, o: N) -> N {
        N(std::array::from_fn(|k| self.0[k] + o.0[k]))
    }
}
impl Sub for N {
    type Output = N;
    fn sub(self, o: N) -> N {
        N(std::array::from_fn(|k| self.0[k] - o.0[k]))
    }
}
impl Mul for N {
    type Output = N;
    fn mul(self, o: N) -> N {
        let mut out = [0.0; 8];
        for a in 0..8 {
            for b in 0..8 {
                if a & b == 0 {
                    out[a | b] += self.0[a] * o.0[b];
                }
            }
        }
        N(out)
    }
}
impl N {
    /// Returns a function by its value and three derivatives at the plain part (the fourth power of the rest
    /// is zero).
    fn chain(self, f: [f64; 4]) -> N {
        let mut rest = self;
        rest.0[0] = 0.0;
        let square = rest * rest;
        n(f[0]) + rest * n(f[1]) + square * n(f[2] / 2.0) + square * rest * n(f[3] / 6.0)
    }
    fn sin(self) -> N {
        let (s, c) = self.0[0].sin_cos();
        self.chain([s, c, -s, -c])
    }
    fn cos(self) -> N {
        let (s, c) = self.0[0].sin_cos();
        self.chain([c, -s, -c, s])
    }
    fn sqrt(self) -> N {
        let (x, r) = (self.0[0], self.0[0].sqrt());
        self.chain([r, 0.5 / r, -0.25 / (r * x), 0.375 / (r * x * x)])
    }
    /// Returns the coefficient of e3.
    fn rate(self) -> N {
        N(std::array::from_fn(|k| if k < 4 { self.0[k + 4] } else { 0.0 }))
    }
}

type V3 = [N; 3];
type M3 = [[N; 3]; 3];

fn apply(m: &M3, v: &V3) -> V3 {
    std::array::from_fn(|i| m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2])
}
fn product(a: &M3, b: &M3) -> M3 {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j])
    })
}
fn transposed(m: &M3) -> M3 {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}
fn plus(a: &V3, b: &V3) -> V3 {
    std::array::from_fn(|k| a[k] + b[k])
}
fn minus(a: &V3, b: &V3) -> V3 {
    std::array::from_fn(|k| a[k] - b[k])
}
fn inner(a: &V3, b: &V3) -> N {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn lift(v: [f64; 3]) -> V3 {
    v.map(n)
}
/// Ry(pitch) Rz(yaw) Rx(roll).
fn rotation(roll: N, pitch: N, yaw: N) -> M3 {
    let (o, i) = (n(0.0), n(1.0));
    let m = |x: N| o - x;
    let ry = [
        [pitch.cos(), o, pitch.sin()],
        [o, i, o],
        [m(pitch.sin()), o, pitch.cos()],
    ];
    let rz = [[yaw.cos(), m(yaw.sin()), o], [yaw.sin(), yaw.cos(), o], [o, o, i]];
    let rx = [
        [i, o, o],
        [o, roll.cos(), m(roll.sin())],
        [o, roll.sin(), roll.cos()],
    ];
    product(&ry, &product(&rz, &rx))
}

/// Position of the origin and rotation of a body. The frame's motions are sines: (amplitude, frequency,
/// phase).
struct Pose {
    origin: V3,
    turn: M3,
}
fn pose(body: &Body, sines: &[[f64; 3]; 6], q: &[N; 6], time: N) -> Pose {
    let [a, b, c] = body.frame.orientation.map(n);
    let base = rotation(a, b, c);
    let s: [N; 6] = sines.map(|[amplitude, w, phase]| n(amplitude) * (time * n(w) + n(phase)).sin());
    let frame = product(&base, &rotation(s[3], s[4], s[5]));
    let origin = plus(&lift(body.frame.origin), &apply(&base, &[s[0], s[1], s[2]]));
    Pose {
        origin: plus(&origin, &apply(&frame, &[q[0], q[1], q[2]])),
        turn: product(&frame, &rotation(q[3], q[4], q[5])),
    }
}
fn point(pose: &Pose, at: [f64; 3]) -> V3 {
    plus(&pose.origin, &apply(&pose.turn, &lift(at)))
}

/// Kinetic energy, from a pose whose e3 part is its rate.
fn kinetic(body: &Body, pose: &Pose) -> N {
    let velocity = point(pose, body.center_of_gravity).map(N::rate);
    // Rᵀ R˙ = ω× in body axes
    let rate = pose.turn.map(|row| row.map(N::rate));
    let plain = pose
        .turn
        .map(|row| row.map(|v| N(std::array::from_fn(|k| if k < 4 { v.0[k] } else { 0.0 }))));
    let skew = product(&transposed(&plain), &rate);
    let omega = [skew[2][1], skew[0][2], skew[1][0]];
    let [i1, i2, i3] = body.inertia.map(n);
    let spin = i1 * omega[0] * omega[0] + i2 * omega[1] * omega[1] + i3 * omega[2] * omega[2];
    n(0.5) * (n(body.mass) * inner(&velocity, &velocity) + spin)
}

/// A function of the poses.
type Scalar<'m> = Box<dyn Fn(&[Pose]) -> N + 'm>;

/// Several bodies, with a potential and a dissipation function (power lost / 2) of their poses.
struct Mechanism<'m> {
    bodies: Vec<Body>,
    sines: Vec<[[f64; 3]; 6]>,
    gravity: [f64; 3],
    potential: Scalar<'m>,
    dissipation: Scalar<'m>,
}

impl Mechanism<'_> {
    fn free_coordinates(&self) -> Vec<(usize, usize)> {
        let coordinates = (0..self.bodies.len()).flat_map(|b| (0..6).map(move |k| (b, k)));
        coordinates.filter(|(b, k)| self.bodies[*b].free[*k]).collect()
    }

    /// Poses with the e3 part as rate.
    fn poses(&self, q: &[N], u: &[N], time: N) -> Vec<Pose> {
        let mut all: Vec<[N; 6]> = self.bodies.iter().map(|body| body.initial.map(n)).collect();
        for (i, (b, k)) in self.free_coordinates().iter().enumerate() {
            all[*b][*k] = q[i] + u[i] * unit(4);
        }
        let clock = time + unit(4);
        let bodies = self.bodies.iter().zip(&self.sines).zip(&all);
        bodies
            .map(|((body, sines), q)| pose(body, sines, q, clock))
            .collect()
    }

    /// Returns the left side of Lagrange's equations.
    fn lagrange(&self, time: f64, q: &[f64], u: &[f64], a: &[f64]) -> Vec<f64> {
        (0..q.len())
            .map(|i| {
                let kinetic_of = |poses: &[Pose]| {
                    let each = self.bodies.iter().zip(poses).map(|(b, p)| kinetic(b, p));
                    each.fold(n(0.0), Add::add)
                };
                let plain = |v: &[f64]| v.iter().map(|v| n(*v)).collect::<Vec<N>>();
                // Along the motion by e2, u_i by e1.
                let moved: Vec<N> = q.iter().zip(u).map(|(q, u)| n(*q) + n(*u) * unit(2)).collect();
                let mut speeds: Vec<N> = u.iter().zip(a).map(|(u, a)| n(*u) + n(*a) * unit(2)).collect();
                speeds[i] = speeds[i] + unit(1);
                let along = self.poses(&moved, &speeds, n(time) + unit(2));
                let momentum_rate = kinetic_of(&along).0[3];
                // ∂/∂q_i by e1.
                let mut shifted = plain(q);
                shifted[i] = shifted[i] + unit(1);
                let poses = self.poses(&shifted, &plain(u), n(time));
                let weight = self.bodies.iter().zip(&poses).fold(n(0.0), |sum, (body, pose)| {
                    let position = point(pose, body.center_of_gravity);
                    sum - n(body.mass) * inner(&lift(self.gravity), &position)
                });
                let field = (self.potential)(&poses).0[1] + weight.0[1];
                // ∂D/∂u_i by e1.
                let mut pushed = plain(u);
                pushed[i] = pushed[i] + unit(1);
                let lost = (self.dissipation)(&self.poses(&plain(q), &pushed, n(time)));
                momentum_rate - kinetic_of(&poses).0[1] + field + lost.0[1]
            })
            .collect()
    }

    /// Lagrange's equations solved for the accelerations.
    fn accelerations(&self, time: f64, q: &[f64], u: &[f64]) -> Vec<f64> {
        let count = q.len();
        let mut right = self.lagrange(time, q, u, &vec![0.0; count]);
        let mut matrix = vec![vec![0.0; count]; count];
        for j in 0..count {
            let mut a = vec![0.0; count];
            a[j] = 1.0;
            for (i, value) in self.lagrange(time, q, u, &a).iter().enumerate() {
                matrix[i][j] = value - right[i];
            }
        }
        right.iter_mut().for_each(|value| *value = -*value);
        for k in 0..count {
            let pivot = (k..count)
                .max_by(|a, b| matrix[*a][k].abs().total_cmp(&matrix[*b][k].abs()))
                .unwrap();
            matrix.swap(k, pivot);
            right.swap(k, pivot);
            for i in k + 1..count {
                let factor = matrix[i][k] / matrix[k][k];
                for j in k..count {
                    matrix[i][j] -= factor * matrix[k][j];
                }
                right[i] -= factor * right[k];
            }
        }
        for k in (0..count).rev() {
            for j in k + 1..count {
                right[k] -= matrix[k][j] * right[j];
            }
            right[k] /= matrix[k][k];
        }
        right
    }

    fn compare(&self, system: &mut System, random: &mut Random, turn: f64) {
        let count = self.free_coordinates().len();
        let time = random.between(0.1, 3.0);
        let mut x = vec![0.0; system.layout().len()];
        for (i, (_, k)) in self.free_coordinates().iter().enumerate() {
            x[i] = random.between(-1.0, 1.0) * if *k < 3 { 0.2 } else { turn };
            x[count + i] = random.between(-3.0, 3.0);
        }
        system.next_time_discontinuity(0.0);
        let dx = rates(system, time, &x);
        let expected = self.accelerations(time, &x[..count], &x[count..2 * count]);
        let size = expected.iter().fold(1.0, |m: f64, a| m.max(a.abs()));
        for i in 0..count {
            assert_eq!(dx[i], x[count + i]);
            let error = (dx[count + i] - expected[i]).abs();
            assert!(
                error <= 1e-10 * size,
                "coordinate {:?}: {} instead of {} (largest {size})",
                self.free_coordinates()[i],
                dx[count + i],
                expected[i]
            );
        }
    }
}

const STILL: [[f64; 3]; 6] = [[0.0; 3]; 6];

fn alone<'m>(body: Body, sines: [[f64; 3]; 6], gravity: [f64; 3]) -> Mechanism<'m> {
    Mechanism {
        bodies: vec![body],
        sines: vec![sines],
        gravity,
        potential: Box::new(|_| n(0.0)),
        dissipation: Box::new(|_| n(0.0)),
    }
}

#[test]
fn every_choice_of_free_coordinates() {
    let mut random = Random(1);
    for choice in 1..64 {
        let free: [bool; 6] = std::array::from_fn(|k| choice >> k & 1 == 1);
        let mut initial = random.vector(0.6);
        // Also with roll held at zero, which the library treats on its own.
        if choice % 3 == 0 {
            initial[3] = 0.0;
        }
        let one = body("b", 3.0, [0.2, 0.5, 0.7], [-0.3, 0.2, 0.4], free, initial);
        let gravity = random.vector(10.0);
        let mechanism = alone(one.clone(), STILL, gravity);
        let mut system = System::new(model(vec![one], gravity)).unwrap();
        for _ in 0..3 {
            mechanism.compare(&mut system, &mut random, 1.2);
        }
    }
}

/// The thesis's wedge: x, z, pitch, yaw free.
#[test]
fn four_free_coordinates() {
    let mut random = Random(2);
    let free = [true, false, true, false, true, true];
    let mut one = body(
        "wedge",
        22.7,
        [0.03, 0.04, 0.02],
        [-0.027, 0.01, 0.052],
        free,
        [0.0; 6],
    );
    one.frame = Frame::fixed([0.3, -0.2, 0.5], [0.4, -0.3, 0.9]);
    let gravity = [0.3, -0.2, -9.80665];
    let mechanism = alone(one.clone(), STILL, gravity);
    let mut system = System::new(model(vec![one], gravity)).unwrap();
    for _ in 0..50 {
        mechanism.compare(&mut system, &mut random, 1.2);
    }
}

fn swinging_frame(random: &mut Random) -> (Frame, [[f64; 3]; 6]) {
    let sines: [[f64; 3]; 6] = std::array::from_fn(|k| {
        [
            random.between(0.1, if k < 3 { 0.5 } else { 0.9 }),
            random.between(0.5, 4.0),
            random.between(-3.0, 3.0),
        ]
    });
    let frame = Frame {
        origin: random.vector(1.0),
        orientation: random.vector(1.0),
        motions: sines.map(|[amplitude, angular_frequency, phase]| Motion::Sine {
            amplitude,
            angular_frequency,
            phase,
        }),
    };
    (frame, sines)
}

#[test]
fn in_a_frame_that_moves_and_turns() {
    let mut random = Random(3);
    for _ in 0..20 {
        let (frame, sines) = swinging_frame(&mut random);
        let mut one = body("b", 3.0, [0.2, 0.5, 0.7], [-0.3, 0.2, 0.4], ALL, [0.0; 6]);
        one.frame = frame;
        let gravity = random.vector(10.0);
        let mechanism = alone(one.clone(), sines, gravity);
        let mut system = System::new(model(vec![one], gravity)).unwrap();
        for _ in 0..3 {
            mechanism.compare(&mut system, &mut random, 1.2);
        }
    }
}

/// A frame that moves without turning is evaluated by lines of its own.
#[test]
fn in_a_frame_that_moves_without_turning() {
    let mut random = Random(4);
    let (mut frame, mut sines) = swinging_frame(&mut random);
    for k in 3..6 {
        frame.motions[k] = Motion::Constant(0.0);
        sines[k] = [0.0; 3];
    }
    let mut one = body("b", 3.0, [0.2, 0.5, 0.7], [-0.3, 0.2, 0.4], ALL, [0.0; 6]);
    one.frame = frame;
    let mechanism = alone(one.clone(), sines, [0.0, 0.0, -9.8]);
    let mut system = System::new(model(vec![one], [0.0, 0.0, -9.8])).unwrap();
    for _ in 0..20 {
        mechanism.compare(&mut system, &mut random, 1.2);
    }
}

/// Two bodies (one of them in a frame that moves and turns) between which a damped coil and a frictionless
/// face act, and which stand on a prescribed third one: elements as a potential and a dissipation function.
#[test]
fn elements_between_bodies() {
    let mut random = Random(5);
    let (end, seat_a, seat_b) = ([0.1, 0.2, -0.3], [0.2, -0.1, 0.3], [-0.4, 0.1, 0.2]);
    let tip = [0.05, -0.1, -0.2];
    let (stiffness, free_length, damping, hardness) = (400.0, 0.9, 7.0, 900.0);
    let marker_angles = [0.3, -0.8, 0.5];
    for case in 0..12 {
        let (frame, sines) = swinging_frame(&mut random);
        let (prescribed, prescribed_sines) = swinging_frame(&mut random);
        let mut a = body("a", 3.0, [0.2, 0.5, 0.7], [-0.3, 0.2, 0.4], ALL, [0.0; 6]);
        let b_free = if case % 2 == 0 {
            ALL
        } else {
            [true, false, true, false, true, true]
        };
        let mut b = body(
            "b",
            5.0,
            [0.4, 0.3, 0.6],
            [0.1, 0.3, -0.2],
            b_free,
            [0.1, 0.2, 0.0, 0.0, 0.0, 0.0],
        );
        if case % 2 == 0 {
            b.frame = frame;
        } else {
            a.frame = frame;
        }
        let sines_of = |of_b: bool| if (case % 2 == 0) == of_b { sines } else { STILL };
        let base = Body {
            initial: [0.1, -0.2, 0.3, 0.2, 0.1, -0.3],
            linearized: false,
            ..Body::prescribed("base", prescribed)
        };
        let gravity = random.vector(10.0);
        let mut parts = model(vec![a.clone(), b.clone(), base.clone()], gravity);
        for (body, on, seat) in [(0, 1, seat_a), (1, 0, seat_b), (1, 2, seat_b)] {
            let mut spring = coil(end, end, stiffness, free_length);
            if on == 2 {
                spring.damping = 0.0;
            }
            parts
                .coils
                .push((body, on, Marker::new(seat, marker_angles), spring));
        }
        // Absolute damping needs a seat that neither turns nor moves.
        parts.bodies.push(ground());
        let mut damper = coil(end, end, stiffness, free_length);
        damper.damping = damping;
        damper.rotational_damping = 2.5;
        parts
            .coils
            .push((0, 3, Marker::new(seat_b, marker_angles), damper));
        let no_friction = FrictionLaw::Tanh { reference_speed: 0.1 };
        for (body, on) in [(0, 1), (1, 0), (1, 2)] {
            let one = face("face", &[tip], hardness, 0.0, 0.0, no_friction);
            parts
                .faces
                .push((body, on, Marker::new([0.1, 0.2, 0.3], UP), one));
        }
        let length_energy = move |pose: &[Pose], body: usize, on: usize, seat: [f64; 3]| {
            let d = minus(&point(&pose[body], end), &point(&pose[on], seat));
            let stretch = inner(&d, &d).sqrt() - n(free_length);
            n(0.5 * stiffness) * stretch * stretch
        };
        let contact_energy = move |pose: &[Pose], body: usize, on: usize| {
            let d = minus(&point(&pose[body], tip), &point(&pose[on], [0.1, 0.2, 0.3]));
            // Its normal is the z axis of the body under it.
            let gap = inner(&d, &std::array::from_fn(|i| pose[on].turn[i][2]));
            if gap.0[0] < 0.0 {
                n(0.5 * hardness) * gap * gap
            } else {
                n(0.0)
            }
        };
        let mechanism = Mechanism {
            bodies: vec![a, b, base, ground()],
            sines: vec![sines_of(false), sines_of(true), prescribed_sines, STILL],
            gravity,
            potential: Box::new(move |pose| {
                length_energy(pose, 0, 1, seat_a)
                    + length_energy(pose, 1, 0, seat_b)
                    + length_energy(pose, 1, 2, seat_b)
                    + length_energy(pose, 0, 3, seat_b)
                    + contact_energy(pose, 0, 1)
                    + contact_energy(pose, 1, 0)
                    + contact_energy(pose, 1, 2)
            }),
            dissipation: Box::new(move |pose| {
                let velocity = point(&pose[0], end).map(N::rate);
                let skew = product(
                    &transposed(&pose[0].turn),
                    &pose[0].turn.map(|row| row.map(N::rate)),
                );
                let omega = [skew[2][1], skew[0][2], skew[1][0]];
                n(0.5 * damping) * inner(&velocity, &velocity) + n(0.5 * 2.5) * inner(&omega, &omega)
            }),
        };
        let mut system = System::new(parts).unwrap();
        for _ in 0..5 {
            mechanism.compare(&mut system, &mut random, 0.8);
        }
    }
}
