//! analytic, convergence, energy: steps by collocation where nothing but a vibration goes on, against closed forms, against the explicit
//! method, and stopped and continued.
#![allow(missing_docs, clippy::unwrap_used)]

use integrate::partitioned::{Partitioned, Structure};
use integrate::{Integrator, KinkSigns, Options, Problem, Singular, State, Statistics};

/// Where [`Masses::striking`] start.
const HIGH: [f64; 5] = [1.5, 0.3, 0.0, 0.0, 0.0];

/// Masses on springs and dampers of their own, `m q'' = -k q - c q' + force`, and what the dampers take.
#[derive(Clone)]
struct Masses {
    mass: Vec<f64>,
    stiffness: Vec<f64>,
    damping: Vec<f64>,
    /// Amplitude and circular frequency of a force on each.
    force: (f64, f64),
    /// A stop that only pushes, at this place of the first mass, and how hard it is.
    stop: Option<(f64, f64)>,
    /// Whether it tells when it meets the stop.
    tells: bool,
    scales: Vec<f64>,
    jacobian: Partitioned,
}

impl Masses {
    fn new(parts: &[[f64; 3]], force: (f64, f64)) -> Self {
        let n = parts.len();
        let column = |k: usize| parts.iter().map(|part| part[k]).collect::<Vec<_>>();
        Self {
            mass: column(0),
            stiffness: column(1),
            damping: column(2),
            force,
            stop: None,
            tells: true,
            scales: vec![1.0; 2 * n + 1],
            jacobian: Partitioned::new(&Structure {
                bodies: vec![n],
                quadratures: 1,
                quadrature_bodies: vec![(0, 0)],
                ..Structure::default()
            }),
        }
    }

    /// Two masses that are shaken; the first one strikes a stop twenty times as hard as its spring, each time from another height.
    fn striking() -> Self {
        Self {
            stop: Some((-1.0, 2e7)),
            scales: vec![1.0, 1.0, 1000.0, 1000.0, 1e6],
            ..Self::new(&[[1.0, 1e6, 8.0], [1.0, 3e5, 4.0]], (4e5, 90.0))
        }
    }

    /// Force of the stop and its slope.
    fn push(&self, q: f64) -> (f64, f64) {
        match self.stop {
            Some((place, stiffness)) if q < place => (stiffness * (place - q), -stiffness),
            _ => (0.0, 0.0),
        }
    }

    fn energy(&self, x: &[f64]) -> f64 {
        let n = self.mass.len();
        let (q, u) = x.split_at(n);
        let own: f64 = (0..n)
            .map(|i| 0.5 * (self.mass[i] * u[i] * u[i] + self.stiffness[i] * q[i] * q[i]))
            .sum();
        let (push, slope) = self.push(q[0]);
        own + if slope == 0.0 {
            0.0
        } else {
            -0.5 * push * push / slope
        }
    }
}

impl Problem for Masses {
    fn dimension(&self) -> usize {
        self.scales.len()
    }
    fn read_states(&self) -> usize {
        2 * self.mass.len()
    }
    fn scales(&self) -> &[f64] {
        &self.scales
    }
    fn derivative(&mut self, time: f64, x: &[f64], dx: &mut [f64]) {
        let n = self.mass.len();
        let force = self.force.0 * libm::sin(self.force.1 * time);
        dx[2 * n] = 0.0;
        for i in 0..n {
            let (q, u) = (x[i], x[n + i]);
            let push = if i == 0 { self.push(q).0 } else { 0.0 };
            dx[i] = u;
            dx[n + i] = (force + push - self.stiffness[i] * q - self.damping[i] * u) / self.mass[i];
            dx[2 * n] += self.damping[i] * u * u;
        }
    }
    fn linearize(&mut self, time: f64, x: &[f64], _: &[f64], df_dt: &mut [f64]) {
        let n = self.mass.len();
        self.jacobian.clear();
        let slope = self.push(x[0]).1;
        let change = self.force.0 * self.force.1 * libm::cos(self.force.1 * time);
        for i in 0..n {
            self.jacobian.mass_mut(0)[i * n + i] = self.mass[i];
            let (k, d) = self.jacobian.blocks_mut(0);
            k[i * n + i] = -self.stiffness[i] + if i == 0 { slope } else { 0.0 };
            d[i * n + i] = -self.damping[i];
            self.jacobian.row_mut(0).1[i] = 2.0 * self.damping[i] * x[n + i];
            df_dt[n + i] = change / self.mass[i];
        }
    }
    fn factor(&mut self, shift: f64) -> Result<(), Singular> {
        self.jacobian.factor(shift)
    }
    fn solve(&mut self, b: &mut [f64]) {
        self.jacobian.solve(b);
    }
    fn complex_shifts(&self) -> usize {
        self.jacobian.complex_shifts()
    }
    fn factor_complex(&mut self, number: usize, shift: [f64; 2]) -> Result<(), Singular> {
        self.jacobian.factor_complex(number, shift)
    }
    fn solve_complex(&mut self, number: usize, re: &mut [f64], im: &mut [f64]) {
        self.jacobian.solve_complex(number, re, im);
    }
    fn kink_counts(&self) -> (usize, usize) {
        (usize::from(self.stop.is_some() && self.tells), 0)
    }
    fn kinks(&mut self, _: f64, x: &[f64], signs: &mut KinkSigns) {
        if let Some((place, _)) = self.stop {
            signs.values[0] = x[0] - place;
        }
    }
}

/// The free motion from 1 at rest, underdamped or creeping.
fn free([m, k, c]: [f64; 3], t: f64) -> f64 {
    let (a, square) = (0.5 * c / m, k / m);
    if square > a * a {
        let w = (square - a * a).sqrt();
        libm::exp(-a * t) * (libm::cos(w * t) + a / w * libm::sin(w * t))
    } else {
        // the small root without cancellation
        let fast = -a - (a * a - square).sqrt();
        let slow = square / fast;
        (fast * libm::exp(slow * t) - slow * libm::exp(fast * t)) / (fast - slow)
    }
}

fn options(tolerance: f64, collocation_steps: bool) -> Options {
    Options {
        relative_tolerance: tolerance,
        collocation_steps,
        ..Options::default()
    }
}

/// Goes to `end`, looks a hundred times on the way; what it cost.
fn follow(mut integrator: Integrator<Masses>, end: f64, mut look: impl FnMut(f64, &[f64])) -> Statistics {
    let mut out = vec![0.0; integrator.x().len()];
    let mut row = 1;
    while integrator.time() < end {
        integrator.step_to(end).unwrap();
        while row <= 100 && f64::from(row) * end / 100.0 <= integrator.time() {
            let time = f64::from(row) * end / 100.0;
            integrator.interpolate(time, &mut out);
            look(time, &out);
            row += 1;
        }
    }
    integrator.statistics().clone()
}

/// A fast vibration that hardly fades, a slower one that does, and a mass that a damper lets creep, 1e7 times as stiff: positions and the
/// energy that the dampers take, within the steps too.
#[test]
fn a_vibration_is_followed_by_long_steps() {
    let parts = [
        [2.0, 2.0 * 5000.0 * 5000.0, 60.0],
        [1.0, 1e6, 300.0],
        [0.5, 1e3, 5e6],
    ];
    let start = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0];
    let run = |tolerance: f64, collocation: bool| {
        let masses = Masses::new(&parts, (0.0, 0.0));
        let all = masses.energy(&start);
        // energies and speeds are large here
        let mut masses = masses;
        masses.scales = vec![1.0, 1.0, 1.0, 5000.0, 1000.0, 1000.0, all];
        let judge = masses.clone();
        let integrator = Integrator::new(masses, options(tolerance, collocation), 0.0, &start).unwrap();
        let (mut error, mut ledger) = (0.0_f64, 0.0_f64);
        let statistics = follow(integrator, 0.2, |time, x| {
            for (i, part) in parts.iter().enumerate() {
                error = error.max((x[i] - free(*part, time)).abs());
            }
            ledger = ledger.max((judge.energy(x) + x[6] - all).abs() / all);
        });
        (error, ledger, statistics)
    };
    for tolerance in [1e-5, 1e-7, 1e-9] {
        let (error, ledger, long) = run(tolerance, true);
        let (short_error, _, short) = run(tolerance, false);
        println!(
            "{tolerance}: {error:.1e} in {} steps, ledger {ledger:.1e}; {short_error:.1e} in {}",
            long.steps, short.steps
        );
        assert!(
            error < 30.0 * tolerance && error < short_error,
            "{tolerance}: {error} {short_error}"
        );
        assert!(ledger < 60.0 * tolerance, "{tolerance}: {ledger}");
        assert!(long.collocation_steps * 10 > long.steps * 9, "{long:?}");
        assert!(long.steps * 2 < short.steps, "{long:?} {short:?}");
        assert_eq!(short.collocation_steps, 0);
    }
}

/// A forced vibration: the guess of the first round knows how the force changes, and the rounds find the rest.
#[test]
fn a_forced_vibration_is_followed() {
    let part = [1.0, 1e6, 0.0];
    let (amplitude, circular) = (2e5, 700.0);
    let mut masses = Masses::new(&[part], (amplitude, circular));
    masses.scales = vec![1.0, 1000.0, 1e6];
    let integrator = Integrator::new(masses, options(1e-8, true), 0.0, &[0.0; 3]).unwrap();
    let swing = amplitude / (1e6 - circular * circular);
    let mut error = 0.0_f64;
    let statistics = follow(integrator, 0.3, |time, x| {
        let exact = swing * (libm::sin(circular * time) - circular / 1000.0 * libm::sin(1000.0 * time));
        error = error.max((x[0] - exact).abs());
    });
    assert!(error < 2e-7, "{error}");
    assert!(
        statistics.collocation_steps * 5 > statistics.steps * 4,
        "{statistics:?}"
    );
}

/// The estimate falls with the eighth power of the step: a tolerance a hundred thousand times smaller takes four times as many steps.
#[test]
fn long_steps_follow_the_tolerance() {
    let steps = |tolerance: f64| {
        let mut masses = Masses::new(&[[1.0, 1e6, 0.0]], (0.0, 0.0));
        masses.scales = vec![1.0, 1000.0, 1e6];
        let integrator = Integrator::new(masses, options(tolerance, true), 0.0, &[1.0, 0.0, 0.0]).unwrap();
        let mut error = 0.0_f64;
        let statistics = follow(integrator, 1.0, |time, x| {
            error = error.max((x[0] - libm::cos(1000.0 * time)).abs());
        });
        assert!(error < 20.0 * tolerance, "{tolerance}: {error}");
        statistics.steps as f64
    };
    let ratio = steps(1e-10) / steps(1e-5);
    assert!((3.2..5.5).contains(&ratio), "{ratio}");
}

/// A mass that vibrates above a stop and strikes it now and then, each time from another height: kinks end the long steps, and what comes out
/// is what steps of the linearly implicit method alone give.
#[test]
fn kinks_end_long_steps() {
    let run = |tolerance: f64, collocation: bool, tells: bool| {
        let masses = Masses {
            tells,
            ..Masses::striking()
        };
        let mut integrator = Integrator::new(masses, options(tolerance, collocation), 0.0, &HIGH).unwrap();
        while integrator.time() < 0.25 {
            integrator.step_to(0.25).unwrap();
        }
        (integrator.x().to_vec(), integrator.statistics().clone())
    };
    let (exact, _) = run(1e-12, false, true);
    let error = |x: &[f64]| (x[0] - exact[0]).abs().max((x[1] - exact[1]).abs());
    for told in [true, false] {
        let (long, statistics) = run(1e-8, true, told);
        let (short, _) = run(1e-8, false, told);
        println!(
            "told {told}: {:.1e} {:.1e} {statistics:?}",
            error(&long),
            error(&short)
        );
        assert!(statistics.collocation_steps > 20, "{statistics:?}");
        assert!(
            statistics.collocation_steps < statistics.steps - 10,
            "{statistics:?}"
        );
        assert!(
            error(&long) < 3.0 * error(&short).max(1e-6),
            "{told}: {long:?} {short:?} {exact:?}"
        );
    }
}

/// Stopped after any step, written as text, read and continued: the same bits.
#[test]
fn a_continued_run_has_the_same_bits() {
    let mut whole = Integrator::new(Masses::striking(), options(1e-8, true), 0.0, &HIGH).unwrap();
    let mut parts = Integrator::new(Masses::striking(), options(1e-8, true), 0.0, &HIGH).unwrap();
    while whole.time() < 0.05 {
        whole.step_to(f64::INFINITY).unwrap();
        let text = serde_json::to_string(&parts.state()).unwrap();
        let state: State = serde_json::from_str(&text).unwrap();
        parts = Integrator::resume(Masses::striking(), options(1e-8, true), state).unwrap();
        parts.step_to(f64::INFINITY).unwrap();
        assert_eq!(whole.time().to_bits(), parts.time().to_bits());
        assert_eq!(
            whole.x().iter().map(|x| x.to_bits()).collect::<Vec<_>>(),
            parts.x().iter().map(|x| x.to_bits()).collect::<Vec<_>>()
        );
    }
    // With other options it goes on by the linearly implicit method.
    let mut other = Integrator::resume(Masses::striking(), options(1e-8, false), whole.state()).unwrap();
    let before = other.statistics().collocation_steps;
    for _ in 0..10 {
        other.step_to(f64::INFINITY).unwrap();
    }
    assert_eq!(other.statistics().collocation_steps, before);
    assert_eq!(whole.statistics(), parts.statistics());
    assert!(whole.statistics().collocation_steps > 5);
}
