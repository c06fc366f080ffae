//! Standard test problems with their reference solutions.

use integrate::FunctionProblem;

/// An initial value problem from time zero with a reference solution at its end.
pub struct TestProblem {
    pub name: &'static str,
    /// Source of the problem and of the reference solution.
    pub citation: &'static str,
    pub problem: fn() -> FunctionProblem<'static>,
    pub start: &'static [f64],
    pub end: f64,
    /// Reference solution at the end, and the error scales.
    pub reference: &'static [f64],
    pub scales: &'static [f64],
}

/// Problems with published reference solutions. All digits agree with SciPy's Radau at a relative tolerance
/// of 1e-12 to ten digits and better.
pub const PUBLISHED: [TestProblem; 4] = [ROBERTSON_40, ROBERTSON, VAN_DER_POL, HIRES];

/// Robertson's problem over the interval of the Test Set.
pub const ROBERTSON: TestProblem = TestProblem {
    name: "Robertson",
    citation: "H. H. Robertson (1966); F. Mazzia, C. Magherini: Test Set for Initial Value Problem Solvers, \
               release 2.4 (2008), problem ROBER",
    problem: robertson,
    start: &[1.0, 0.0, 0.0],
    end: 1e11,
    reference: &[
        0.208_334_014_970_125_5e-7,
        0.833_336_077_033_471_3e-13,
        0.999_999_979_166_505,
    ],
    scales: ROBERTSON_SCALES,
};

/// Robertson's problem at the time at which it is printed most often.
pub const ROBERTSON_40: TestProblem = TestProblem {
    name: "Robertson to t = 40",
    citation: "SUNDIALS, example cvRoberts_dns (7.158e-1, 9.185e-6, 2.842e-1); more digits by SciPy's Radau",
    end: 40.0,
    reference: &[0.715_827_068_719_4, 9.185_534_764_56e-6, 0.284_163_745_745_8],
    ..ROBERTSON
};

/// Van der Pol's equation with μ = 1000.
pub const VAN_DER_POL: TestProblem = TestProblem {
    name: "Van der Pol, μ = 1000",
    citation: "Mazzia & Magherini (2008), problem VDPOL, whose time is t/μ and whose second state is μ x'",
    problem: van_der_pol,
    start: &[2.0, 0.0],
    end: 2000.0,
    reference: &[1.706_167_732_170_483, -0.892_809_701_024_797_5e-3],
    scales: VAN_DER_POL_SCALES,
};

/// HIRES: High Irradiance RESponse of photomorphogenesis.
pub const HIRES: TestProblem = TestProblem {
    name: "HIRES",
    citation: "E. Schäfer (1975); Mazzia & Magherini (2008), problem HIRES; Hairer & Wanner (1996), IV.10",
    problem: hires,
    start: &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0057],
    end: 321.8122,
    reference: &[
        0.737_131_257_332_566_8e-3,
        0.144_248_572_631_618_5e-3,
        0.588_872_974_096_757_5e-4,
        0.117_565_134_328_314_9e-2,
        0.238_635_619_883_133_1e-2,
        0.623_896_825_274_279_6e-2,
        0.284_999_839_518_576_9e-2,
        0.285_000_160_481_423_1e-2,
    ],
    scales: &[1.0; 8],
};

/// Stick-slip oscillator: it sticks, slips and rings at 7 Hz, see [`stick_slip`].
pub const STICK_SLIP: TestProblem = TestProblem {
    name: "stick-slip oscillator",
    citation: "friction of Coulomb regularized by tanh on a spring whose end moves, as in J. P. Den Hartog, \
               Trans. ASME 53 (1931) 107; reference by SciPy's Radau at 1e-11 and 1e-12",
    problem: stick_slip,
    start: &[0.0, 0.0],
    end: 4.0,
    reference: &[0.013_245_409_041_3, 0.109_211_240_934],
    scales: &[1.0, 1.0],
};

const ROBERTSON_SCALES: &[f64] = &[1.0, 1e-4, 1.0];
const VAN_DER_POL_SCALES: &[f64] = &[1.0, 1.0];

pub fn robertson() -> FunctionProblem<'static> {
    FunctionProblem::new(
        ROBERTSON_SCALES.to_vec(),
        |_, x, dx| {
            dx[0] = -0.04 * x[0] + 1e4 * x[1] * x[2];
            dx[2] = 3e7 * x[1] * x[1];
            dx[1] = -dx[0] - dx[2];
        },
        |_, x, j| {
            j[..3].copy_from_slice(&[-0.04, 1e4 * x[2], 1e4 * x[1]]);
            j[6..].copy_from_slice(&[0.0, 6e7 * x[1], 0.0]);
            for k in 0..3 {
                j[3 + k] = -j[k] - j[6 + k];
            }
        },
    )
}

/// x'' = μ (1 - x²) x' - x with μ = 1000.
pub const MU: f64 = 1000.0;

pub fn van_der_pol() -> FunctionProblem<'static> {
    FunctionProblem::new(
        VAN_DER_POL_SCALES.to_vec(),
        |_, x, dx| {
            dx[0] = x[1];
            dx[1] = MU * (1.0 - x[0] * x[0]) * x[1] - x[0];
        },
        |_, x, j| {
            let row = [-2.0 * MU * x[0] * x[1] - 1.0, MU * (1.0 - x[0] * x[0])];
            j.copy_from_slice(&[0.0, 1.0, row[0], row[1]]);
        },
    )
}

pub fn hires() -> FunctionProblem<'static> {
    FunctionProblem::new(
        vec![1.0; 8],
        |_, x, dx| {
            let bound = 280.0 * x[5] * x[7];
            dx[0] = -1.71 * x[0] + 0.43 * x[1] + 8.32 * x[2] + 0.0007;
            dx[1] = 1.71 * x[0] - 8.75 * x[1];
            dx[2] = -10.03 * x[2] + 0.43 * x[3] + 0.035 * x[4];
            dx[3] = 8.32 * x[1] + 1.71 * x[2] - 1.12 * x[3];
            dx[4] = -1.745 * x[4] + 0.43 * (x[5] + x[6]);
            dx[5] = -bound + 0.69 * x[3] + 1.71 * x[4] - 0.43 * x[5] + 0.69 * x[6];
            dx[6] = bound - 1.81 * x[6];
            dx[7] = -dx[6];
        },
        |_, x, j| {
            let (by_6, by_8) = (280.0 * x[7], 280.0 * x[5]);
            let entries = [
                (0, 0, -1.71),
                (0, 1, 0.43),
                (0, 2, 8.32),
                (1, 0, 1.71),
                (1, 1, -8.75),
                (2, 2, -10.03),
                (2, 3, 0.43),
                (2, 4, 0.035),
                (3, 1, 8.32),
                (3, 2, 1.71),
                (3, 3, -1.12),
                (4, 4, -1.745),
                (4, 5, 0.43),
                (4, 6, 0.43),
                (5, 3, 0.69),
                (5, 4, 1.71),
                (5, 5, -by_6 - 0.43),
                (5, 6, 0.69),
                (5, 7, -by_8),
                (6, 5, by_6),
                (6, 6, -1.81),
                (6, 7, by_8),
                (7, 5, -by_6),
                (7, 6, 1.81),
                (7, 7, -by_8),
            ];
            for (row, column, value) in entries {
                j[8 * row + column] = value;
            }
        },
    )
}

/// Reference speed of the friction of [`stick_slip`], m/s.
pub const STICK_SLIP_SPEED: f64 = 1e-5;

/// Returns a mass of 1 kg under friction of 10 N on a spring of 2000 N/m whose end moves as 0.02 sin 5t.
pub fn stick_slip() -> FunctionProblem<'static> {
    FunctionProblem::new(
        vec![1.0, 1.0],
        |t, x, dx| {
            dx[0] = x[1];
            dx[1] = 2000.0 * (0.02 * libm::sin(5.0 * t) - x[0]) - 10.0 * libm::tanh(x[1] / STICK_SLIP_SPEED);
        },
        |_, x, j| {
            let cosh = libm::cosh(x[1] / STICK_SLIP_SPEED);
            j.copy_from_slice(&[0.0, 1.0, -2000.0, -10.0 / (STICK_SLIP_SPEED * cosh * cosh)]);
        },
    )
    .time_derivative(|t, _, df_dt| df_dt[1] = 2000.0 * 0.02 * 5.0 * libm::cos(5.0 * t))
    .displacements(1)
}

/// [`stick_slip`] with its slip, all its discontinuities.
pub fn stick_slip_with_discontinuities() -> FunctionProblem<'static> {
    stick_slip()
        .discontinuities(0, 1, |_, x, functions| {
            functions.slips[0] = [x[1] / STICK_SLIP_SPEED, 0.0];
        })
        .discontinuities_complete()
}

/// A. Prothero, A. Robinson, Math. Comp. 28 (1974) 145: `x' = λ (x - φ(t)) + φ'(t)` with φ = sin(t + 1/2),
/// solved by `φ(t) + (x(0) - φ(0)) exp(λt)`.
pub fn prothero_robinson(lambda: f64) -> FunctionProblem<'static> {
    FunctionProblem::new(
        vec![1.0],
        move |t, x, dx| dx[0] = lambda * (x[0] - prothero_robinson_solution(t)) + libm::cos(t + 0.5),
        move |_, _, j| j[0] = lambda,
    )
    .time_derivative(move |t, _, f| f[0] = -lambda * libm::cos(t + 0.5) - libm::sin(t + 0.5))
}

/// φ(t).
pub fn prothero_robinson_solution(t: f64) -> f64 {
    libm::sin(t + 0.5)
}

/// A ball that bounces on a unilateral spring without loss: its height and speed; closed form piece by piece.
#[derive(Clone, Copy, Debug)]
pub struct BouncingBall {
    pub gravity: f64,
    /// Angular frequency of the ball on the spring.
    pub omega: f64,
    /// Height at the start, at rest.
    pub height: f64,
}

impl BouncingBall {
    /// Returns the problem; its discrete state is 1 in contact.
    pub fn problem(self) -> FunctionProblem<'static> {
        let Self { gravity, omega, .. } = self;
        let stiffness = omega * omega;
        FunctionProblem::new(
            vec![1.0, omega * 0.01],
            move |_, x, dx| {
                dx[0] = x[1];
                dx[1] = -gravity - stiffness * x[0].min(0.0);
            },
            move |_, x, j| {
                j.copy_from_slice(&[0.0, 1.0, if x[0] < 0.0 { -stiffness } else { 0.0 }, 0.0]);
            },
        )
        .events(
            1,
            |_, x, states| states[0] = u8::from(x[0] < 0.0),
            |_, x, states, functions| functions[0] = if states[0] == 0 { x[0] } else { -x[0] },
            |_, _, _, state| 1 - state,
        )
    }

    /// Duration of the first fall, and the speed at its end.
    pub fn fall(&self) -> (f64, f64) {
        let fall = (2.0 * self.height / self.gravity).sqrt();
        (fall, self.gravity * fall)
    }

    /// Durations of a contact and of a flight. In contact x = -g/ω² + (g/ω²) cos ωt - (v/ω) sin ωt, which is
    /// zero again where tan(ωt/2) = -vω/g.
    pub fn contact_and_flight(&self) -> (f64, f64) {
        let (fall, speed) = self.fall();
        let angle = std::f64::consts::PI - libm::atan(speed * self.omega / self.gravity);
        (2.0 * angle / self.omega, 2.0 * fall)
    }

    /// Height at a time.
    pub fn solution(&self, time: f64) -> f64 {
        let Self {
            gravity,
            omega,
            height,
        } = *self;
        let ((fall, speed), (contact, flight)) = (self.fall(), self.contact_and_flight());
        if time < fall {
            return height - 0.5 * gravity * time * time;
        }
        let since = (time - fall) % (contact + flight);
        if since < contact {
            let sag = gravity / (omega * omega);
            sag * (libm::cos(omega * since) - 1.0) - speed / omega * libm::sin(omega * since)
        } else {
            let t = since - contact;
            speed * t - 0.5 * gravity * t * t
        }
    }
}

/// Reference speed of the friction of [`shaken`], m/s.
pub const SHAKEN_SPEED: f64 = 1e-5;

/// Returns a mass shaken across a rough floor, `v' = 3 sin 5t - tanh(v/v0)`, and the energy lost. It reverses
/// 12 times in 8 s.
pub fn shaken() -> FunctionProblem<'static> {
    FunctionProblem::new(
        vec![1.0, 1.0],
        |t, x, dx| {
            let friction = libm::tanh(x[0] / SHAKEN_SPEED);
            dx[0] = 3.0 * libm::sin(5.0 * t) - friction;
            dx[1] = friction * x[0];
        },
        |_, x, j| {
            let friction = libm::tanh(x[0] / SHAKEN_SPEED);
            let slope = (1.0 - friction * friction) / SHAKEN_SPEED;
            j.copy_from_slice(&[-slope, 0.0, slope * x[0] + friction, 0.0]);
        },
    )
    .time_derivative(|t, _, df_dt| df_dt[0] = 15.0 * libm::cos(5.0 * t))
}

/// [`shaken`] with its slip.
pub fn shaken_with_slip() -> FunctionProblem<'static> {
    shaken().discontinuities(0, 1, |_, x, functions| {
        functions.slips[0] = [x[0] / SHAKEN_SPEED, 0.0];
    })
}

/// [`shaken`] with its slip and an error bound in its regularization zone.
pub fn shaken_with_bound() -> FunctionProblem<'static> {
    shaken_with_slip().zone_error_bounds(vec![SHAKEN_SPEED, f64::INFINITY])
}
