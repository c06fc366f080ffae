//! The wedge with four coordinates, written a second time, from the specification alone: inch, pound-force,
//! second. Lagrange's equations; no angular velocity anywhere, only derivatives of the rotation matrix.

/// g, in/s².
pub const G: f64 = 386.088_582_677_165_35;

type V = [f64; 3];
type M = [[f64; 3]; 3];

/// The numbers of a wedge.
#[derive(Clone, Debug)]
pub struct Plain {
    pub variable: bool,
    /// Degrees from the vertical.
    pub angle: f64,
    pub height: f64,
    pub width: f64,
    pub cg: V,
    /// lbf.
    pub weight: f64,
    /// lb·in².
    pub inertia: V,
    pub coil_stiffness: f64,
    pub free_length: f64,
    pub nominal_length: f64,
    pub coil_damping: f64,
    pub turn_damping: f64,
    pub at_seat: bool,
    pub pulls: bool,
    pub corner_stiffness: f64,
    pub corner_damping: f64,
    /// Column, slope.
    pub friction: [f64; 2],
    pub reference_speed: f64,
    /// rad, positive out.
    pub toe: f64,
    pub yaw: f64,
    pub amplitude: f64,
    pub frequency: f64,
}

/// Outputs of the model at a state.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Of x, z, pitch, yaw.
    pub accelerations: [f64; 4],
    /// Column friction on the side frame, up.
    pub vertical: f64,
    /// Column normal force.
    pub longitudinal: f64,
    /// Power of the bolster's motion.
    pub drive: f64,
    /// Friction losses at column and slope.
    pub friction_loss: [f64; 2],
    pub contact_damping_loss: f64,
    pub coil_damping_loss: f64,
    /// Power of the couple that moves the coil's force to the center of gravity.
    pub guide: f64,
    /// Number of closed corners of the eight.
    pub closed: usize,
    /// Gaps: column, then slope; lower right (-y), lower left, upper right, upper left.
    pub gaps: [f64; 8],
}

impl Plain {
    /// Returns the wedge of the thesis.
    pub fn thesis(variable: bool, toe: f64, yaw: f64) -> Self {
        Self {
            variable,
            angle: if variable { 32.0 } else { 37.5 },
            height: 6.125,
            width: 10.5,
            cg: [-1.0734, 0.0, 2.0417],
            weight: 50.0,
            inertia: [100.0; 3],
            coil_stiffness: if variable { 3000.0 } else { 1979.0 },
            free_length: if variable { 10.25 } else { 7.25 },
            nominal_length: if variable { 10.25 } else { 7.25 - 3702.2 / 1979.0 },
            coil_damping: 1.0,
            turn_damping: 1.0,
            at_seat: false,
            pulls: true,
            corner_stiffness: 2.5e5,
            corner_damping: 0.0,
            friction: [0.4; 2],
            reference_speed: 1e-3,
            toe,
            yaw,
            amplitude: 1.0,
            frequency: 2.0,
        }
    }

    fn mass(&self) -> f64 {
        self.weight / G
    }

    /// Twice the kinetic energy at rates `u`, from the velocities of the mass: the rotational part by the
    /// second moments of the mass distribution, Σ S_k |Ṙ e_k|² with S_k = (I_i + I_j - I_k)/2.
    fn twice_kinetic(&self, q: &[f64; 4], u: &[f64; 4]) -> f64 {
        let r = Turn::at(q[2], q[3]);
        let rate = combine(&r.by_pitch, u[2], &r.by_yaw, u[3]);
        let swing = times(&rate, &self.cg);
        let v = [u[0] + swing[0], swing[1], u[1] + swing[2]];
        let total: f64 = self.inertia.iter().sum();
        let spin: f64 = (0..3)
            .map(|k| {
                let moment = 0.5 * (total - 2.0 * self.inertia[k]) / G;
                moment * (0..3).map(|i| rate[i][k] * rate[i][k]).sum::<f64>()
            })
            .sum();
        self.mass() * dot(&v, &v) + spin
    }

    /// Returns the mass matrix, from the kinetic energy alone (it is a quadratic form of the rates).
    fn mass_matrix(&self, q: &[f64; 4]) -> [[f64; 4]; 4] {
        let energy = |i: usize, j: usize| {
            let mut u = [0.0; 4];
            u[i] += 1.0;
            u[j] += 1.0;
            self.twice_kinetic(q, &u)
        };
        let mut m = [[0.0; 4]; 4];
        for i in 0..4 {
            for j in 0..4 {
                m[i][j] = if i == j {
                    0.25 * energy(i, i)
                } else {
                    0.5 * (energy(i, j) - 0.25 * energy(i, i) - 0.25 * energy(j, j))
                };
            }
        }
        m
    }

    /// d/dt(∂T/∂u) - ∂T/∂q at constant rates. The derivatives by q are differences of fourth order.
    fn bias(&self, q: &[f64; 4], u: &[f64; 4]) -> [f64; 4] {
        const H: f64 = 2e-3;
        let along = |direction: &[f64; 4], f: &dyn Fn(&[f64; 4]) -> [f64; 4]| {
            let at = |h: f64| f(&std::array::from_fn(|i| q[i] + h * direction[i]));
            let (a, b, c, d) = (at(-2.0 * H), at(-H), at(H), at(2.0 * H));
            let out: [f64; 4] = std::array::from_fn(|i| (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * H));
            out
        };
        let momentum = |q: &[f64; 4]| {
            let m = self.mass_matrix(q);
            std::array::from_fn(|i| (0..4).map(|j| m[i][j] * u[j]).sum())
        };
        // Unit steps, so that fast rates do not spoil the differences.
        let size = u[2].hypot(u[3]);
        let mut out = [0.0; 4];
        if size == 0.0 {
            return out;
        }
        let changes = along(&u.map(|u| u / size), &momentum);
        for i in 0..4 {
            let mut e = [0.0; 4];
            e[i] = 1.0;
            let slope = along(&e, &|q| [0.5 * self.twice_kinetic(q, u), 0.0, 0.0, 0.0]);
            out[i] = size * changes[i] - slope[0];
        }
        out
    }

    /// Everything at time `t`, coordinates `q` (from the nominal position) and rates `u` of x, z, pitch, yaw.
    pub fn evaluate(&self, t: f64, q: &[f64; 4], u: &[f64; 4]) -> Answer {
        let theta = self.angle.to_radians();
        let (sin, cos) = theta.sin_cos();
        let bottom = self.height * theta.tan();
        let face_x = self.cg[0] - bottom / 3.0;
        let (zb, vb) = (
            self.amplitude * (self.frequency * t).sin(),
            self.amplitude * self.frequency * (self.frequency * t).cos(),
        );
        let r = Turn::at(q[2], q[3]);
        let origin = [q[0], 0.0, self.nominal_length + q[1]];
        let rate = combine(&r.by_pitch, u[2], &r.by_yaw, u[3]);
        let place = |a: &V| add(&origin, &times(&r.matrix, a));
        let velocity = |a: &V| add(&[u[0], 0.0, u[1]], &times(&rate, a));

        let mut load = [0.0; 4];
        let mut push = |a: &V, force: &V| {
            load[0] += force[0];
            load[1] += force[2];
            load[2] += dot(force, &times(&r.by_pitch, a));
            load[3] += dot(force, &times(&r.by_yaw, a));
        };
        push(&self.cg, &[0.0, 0.0, -self.weight]);

        let middle = self.nominal_length + 0.5 * self.height;
        let planes: [(V, V, V); 2] = [
            (
                [face_x, 0.0, middle],
                [self.toe.cos(), 0.0, -self.toe.sin()],
                [0.0; 3],
            ),
            (
                [face_x + 0.5 * bottom, 0.0, middle + zb],
                [-cos * self.yaw.cos(), -cos * self.yaw.sin(), -sin],
                [0.0, 0.0, vb],
            ),
        ];
        let mut answer = Answer {
            accelerations: [0.0; 4],
            vertical: 0.0,
            longitudinal: 0.0,
            drive: 0.0,
            friction_loss: [0.0; 2],
            contact_damping_loss: 0.0,
            coil_damping_loss: 0.0,
            guide: 0.0,
            closed: 0,
            gaps: [0.0; 8],
        };
        for (face, (point, normal, surface_velocity)) in planes.iter().enumerate() {
            let lower_x = if face == 0 { face_x } else { face_x + bottom };
            for corner in 0..4 {
                let y = if corner % 2 == 0 { -0.5 } else { 0.5 } * self.width;
                let a = if corner < 2 {
                    [lower_x, y, 0.0]
                } else {
                    [face_x, y, self.height]
                };
                let gap = dot(&sub(&place(&a), point), normal);
                answer.gaps[4 * face + corner] = gap;
                if gap >= 0.0 {
                    continue;
                }
                answer.closed += 1;
                let v = sub(&velocity(&a), surface_velocity);
                let closing = dot(&v, normal);
                let n = (-self.corner_stiffness * gap - self.corner_damping * closing).max(0.0);
                answer.contact_damping_loss += -closing * (n + self.corner_stiffness * gap);
                let slip = sub(&v, &scale(normal, closing));
                let speed = dot(&slip, &slip).sqrt();
                let friction = if speed > 0.0 {
                    let size = self.friction[face] * n * (speed / self.reference_speed).tanh();
                    answer.friction_loss[face] += size * speed;
                    scale(&slip, -size / speed)
                } else {
                    [0.0; 3]
                };
                let force = add(&scale(normal, n), &friction);
                push(&a, &force);
                if face == 0 {
                    answer.vertical -= friction[2];
                    answer.longitudinal += n * normal[0];
                }
                answer.drive += dot(&force, surface_velocity);
            }
        }

        // The coil: between B and its seat, which with constant damping goes along with the bolster.
        let (mut seat, mut seat_velocity) = ([0.0; 3], [0.0; 3]);
        if !self.variable {
            let center = face_x + 0.5 * bottom;
            seat = [center * (1.0 - self.yaw.cos()), -center * self.yaw.sin(), zb];
            seat_velocity = [0.0, 0.0, vb];
        }
        let d = sub(&origin, &seat);
        let length = dot(&d, &d).sqrt();
        let mut spring = self.coil_stiffness * (self.free_length - length);
        if !self.pulls {
            spring = spring.max(0.0);
        }
        let d_rate = sub(&[u[0], 0.0, u[1]], &seat_velocity);
        let force = sub(&scale(&d, spring / length), &scale(&d_rate, self.coil_damping));
        if self.at_seat {
            push(&[0.0; 3], &force);
        } else {
            push(&self.cg, &force);
            answer.guide = dot(&force, &times(&rate, &self.cg));
        }
        load[2] -= self.turn_damping * u[2];
        load[3] -= self.turn_damping * u[3];
        answer.coil_damping_loss =
            self.coil_damping * dot(&d_rate, &d_rate) + self.turn_damping * (u[2] * u[2] + u[3] * u[3]);
        answer.drive += dot(&force, &seat_velocity);

        let bias = self.bias(q, u);
        answer.accelerations = solve(self.mass_matrix(q), std::array::from_fn(|i| load[i] - bias[i]));
        answer
    }
}

/// Rz after Ry: the rotation and its derivatives by the two angles.
struct Turn {
    matrix: M,
    by_pitch: M,
    by_yaw: M,
}

impl Turn {
    fn at(pitch: f64, yaw: f64) -> Self {
        let ((s, c), (sy, cy)) = (pitch.sin_cos(), yaw.sin_cos());
        let about_y = [[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]];
        let d_about_y = [[-s, 0.0, c], [0.0, 0.0, 0.0], [-c, 0.0, -s]];
        let about_z = [[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]];
        let d_about_z = [[-sy, -cy, 0.0], [cy, -sy, 0.0], [0.0, 0.0, 0.0]];
        Self {
            matrix: product(&about_y, &about_z),
            by_pitch: product(&d_about_y, &about_z),
            by_yaw: product(&about_y, &d_about_z),
        }
    }
}

fn dot(a: &V, b: &V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn add(a: &V, b: &V) -> V {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
fn sub(a: &V, b: &V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
fn scale(a: &V, f: f64) -> V {
    [a[0] * f, a[1] * f, a[2] * f]
}
fn times(m: &M, v: &V) -> V {
    [dot(&m[0], v), dot(&m[1], v), dot(&m[2], v)]
}
fn product(a: &M, b: &M) -> M {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}
fn combine(a: &M, fa: f64, b: &M, fb: f64) -> M {
    std::array::from_fn(|i| std::array::from_fn(|j| fa * a[i][j] + fb * b[i][j]))
}

/// Gaussian elimination with row exchanges.
fn solve(mut a: [[f64; 4]; 4], mut b: [f64; 4]) -> [f64; 4] {
    for k in 0..4 {
        let pivot = (k..4).fold(k, |p, i| if a[i][k].abs() > a[p][k].abs() { i } else { p });
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in k + 1..4 {
            let f = a[i][k] / a[k][k];
            for j in k..4 {
                a[i][j] -= f * a[k][j];
            }
            b[i] -= f * b[k];
        }
    }
    for k in (0..4).rev() {
        for j in k + 1..4 {
            b[k] -= a[k][j] * b[j];
        }
        b[k] /= a[k][k];
    }
    b
}
