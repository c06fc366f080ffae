//! Neutral motions: speeds at which a motion of a given amplitude neither grows nor dies, by equivalent
//! linearization.
//!
//! At an amplitude A every slider of friction has the stiffness and damping of its describing function
//! ([`mechanics::linear::Slider`]) at the amplitude that the shape of the motion gives it, and every wheelset
//! conicity, gravitational stiffness and creep of its own amplitude (`wheels_over_amplitude.rs`). A is the
//! lateral amplitude of the wheelset that moves most. Solved for V, λ, φ at each A is
//!
//! ```text
//! (λ² M - λ D(V, φ A) - K(V, φ A)) φ = 0,   Re λ = 0
//! ```
//!
//! Beyond this speed a motion of this amplitude grows. Where the speed falls with the amplitude, it is the
//! disturbance that is needed for hunting; where it rises, that of a limit cycle. The quasi-linear method of
//! Cooperrider, Hedrick, Law and Malstrom 1975, and Hull and Cooperrider 1977 (remembered).
//!
//! Inverse iteration for λ and φ, a Newton step for V and a part of the way to the new equivalents share one
//! loop; amplitudes fall, each begins with the solution before it. Limits: one harmonic; normal forces are
//! those of steady running, so that what the start locks in counts; side bearings and stops neither open nor
//! close. Motions on the flanges are left out: a flange that bears is a steep cone for the harmonic
//! linearization, while in truth it slides, and critical speeds fall by a third within the first hundredth of
//! an inch.

use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::sync::Arc;

use mechanics::linear::{Equivalent, LinearModel, SecondOrder};
use nalgebra::{Complex, DMatrix, DVector};
use rolling::wheelset::coordinate;
use wheelrail::conicity::LinearGeometry;
use wheelrail::contact::CreepLaw;

use crate::linearize::{CriticalSpeed, LinearizeError, SteadyCar, VIBRATIONS, vibrations};
use crate::parameters::{Parameters, Wheels};
use crate::wheels_over_amplitude::{Saturation, WheelsOverAmplitude};

/// Steps of an iteration.
const STEPS: usize = 80;
/// Steps after which the derivative by the speed is taken again.
const RENEWED: usize = 8;
/// Part of the way to new equivalents and to a new speed.
const PART: f64 = 0.5;
/// Relative changes of equivalents and of the speed at which it has converged.
const SETTLED: [f64; 2] = [1e-2, 1e-3];
/// Slowest speed that is looked at, m/s, and the fastest one over the fastest that is asked for.
const SLOWEST: f64 = 1.0;
const FASTEST: f64 = 1.5;
/// Motions without friction that an iteration is begun with.
const BEGINNINGS: usize = 4;
/// Relative distance of speeds of one and the same motion.
const SAME: f64 = 1e-3;
/// Motions that are followed over the amplitude.
const FOLLOWED: usize = 3;
/// Shift of a wheelset for the geometry in the middle, m; half the distance of the contacts where there is
/// none.
const MIDDLE: f64 = 1e-4;
const HALF_DISTANCE: f64 = 29.75 * 0.0254;
/// Largest amplitude of linear wheels, which have no flanges, m: 0.4 in.
const WITHOUT_FLANGES: f64 = 0.4 * 0.0254;

/// What has been found of an amplitude.
#[derive(Clone, Debug)]
pub enum Neutral {
    /// The slowest neutral motion; in its shape the wheelset that moves most has the amplitude 1.
    At(CriticalSpeed),
    /// Its motions die up to one and a half of the fastest speed that was asked for.
    Above,
    /// An iteration came to no end: there may be one.
    Unsolved,
}

/// The end of an iteration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    /// A neutral motion.
    Neutral,
    /// It would be faster than is looked for.
    Above,
    /// It does not converge.
    Lost,
}

/// What an iteration has come to.
#[derive(Clone, Debug)]
struct Iterate {
    speed: f64,
    value: Complex<f64>,
    shape: DVector<Complex<f64>>,
    sliders: Vec<Equivalent>,
    /// Factor of the linear creep of each wheelset.
    creep: Vec<f64>,
}

/// A model, and the same without creep.
struct Models {
    whole: LinearModel,
    without_creep: LinearModel,
}

/// A car over the amplitude of its motions.
#[derive(Clone, Debug)]
pub struct OverAmplitude {
    car: SteadyCar,
    without_creep: Option<SteadyCar>,
    /// Of each wheelset; none of linear wheels.
    wheels: Option<[Arc<WheelsOverAmplitude>; 4]>,
    saturation: Saturation,
    /// Of each wheelset: places of its lateral displacement and of its heading, and of all coordinates that
    /// its creep acts on.
    places: Vec<([usize; 2], Vec<usize>)>,
    axle_load: f64,
    /// Friction limit of a wheel, N.
    limit: f64,
    radius: f64,
    half_distance: f64,
}

impl OverAmplitude {
    /// Returns the car in steady running; it starts as [`SteadyCar::new`] says.
    ///
    /// # Errors
    /// [`LinearizeError`].
    pub fn new(parameters: &Parameters) -> Result<Self, LinearizeError> {
        Self::of(SteadyCar::new(parameters)?, parameters)
    }

    /// Returns the same of a car of these parameters that is in steady running already.
    ///
    /// # Errors
    /// [`LinearizeError`].
    pub fn of(car: SteadyCar, parameters: &Parameters) -> Result<Self, LinearizeError> {
        let axle_load = parameters.weight() / 4.0;
        let mut own = Self {
            without_creep: None,
            wheels: None,
            saturation: Saturation::None,
            places: places(&car),
            axle_load,
            limit: f64::INFINITY,
            radius: parameters.wheel_radius(),
            half_distance: HALF_DISTANCE,
            car,
        };
        match &parameters.wheels {
            Wheels::Linear { wheelset, .. } => own.half_distance = wheelset.geometry.half_distance,
            Wheels::OnRails(wheels) => {
                own.saturation = Saturation::of(wheels.laws[0].creep);
                let mut tables = wheels.geometry.each_ref().map(|_| None);
                for (w, geometry) in wheels.geometry.iter().enumerate() {
                    let same = wheels.geometry[..w]
                        .iter()
                        .position(|other| Arc::ptr_eq(geometry, other));
                    tables[w] = match same {
                        Some(same) => tables[same].clone(),
                        None => Some(Arc::new(WheelsOverAmplitude::new(geometry))),
                    };
                }
                let [Some(a), Some(b), Some(c), Some(d)] = tables else {
                    unreachable!("all are made")
                };
                own.wheels = Some([a, b, c, d]);
                let [left, right] = wheels.laws.each_ref().map(|law| law.friction.zones.tread);
                own.limit = 0.25 * axle_load * (left + right);
                if let Ok(middle) = LinearGeometry::of(&wheels.geometry[0], MIDDLE) {
                    own.half_distance = middle.half_distance;
                }
                let mut bare = parameters.clone();
                if let Wheels::OnRails(wheels) = &mut bare.wheels {
                    for law in wheels.laws.iter_mut() {
                        law.creep = CreepLaw::Frictionless;
                    }
                }
                own.without_creep = Some(own.car.with(&bare)?);
            }
        }
        Ok(own)
    }

    /// Returns the car in steady running.
    #[must_use]
    pub fn steady(&mut self) -> &mut SteadyCar {
        &mut self.car
    }

    /// Returns the largest amplitude at which no flange bears, m; of linear wheels 0.4 in.
    #[must_use]
    pub fn clearance(&self) -> f64 {
        self.wheels.as_ref().map_or(WITHOUT_FLANGES, |wheels| {
            let clearances = wheels.iter().map(|own| own.clearance());
            clearances.fold(f64::INFINITY, f64::min)
        })
    }

    /// Returns the slowest neutral motion of each amplitude (m, falling). `go_on` receives the share that is
    /// done; where it breaks, what was found comes back, for fewer amplitudes.
    ///
    /// # Errors
    /// [`LinearizeError`].
    pub fn neutral_motions(
        &mut self,
        amplitudes: &[f64],
        fastest: f64,
        mut go_on: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Vec<Neutral>, LinearizeError> {
        let mut found = Vec::new();
        let mut followed: Vec<Iterate> = Vec::new();
        for (number, amplitude) in amplitudes.iter().enumerate() {
            let (mut next, mut lost) = self.from(followed, *amplitude, fastest)?;
            if next.is_empty() {
                // A motion may come from others than those that were followed.
                let beginnings = self.beginnings(fastest)?;
                (next, lost) = self.from(beginnings, *amplitude, fastest)?;
            }
            found.push(match next.first() {
                Some(own) => Neutral::At(self.motion(own)),
                None if lost => Neutral::Unsolved,
                None => Neutral::Above,
            });
            followed = next;
            if go_on((number + 1) as f64 / amplitudes.len() as f64).is_break() {
                break;
            }
        }
        Ok(found)
    }

    /// Returns the neutral motions of an amplitude that iterations from these beginnings come to, by rising
    /// speed, and whether one came to no end.
    fn from(
        &mut self,
        beginnings: Vec<Iterate>,
        amplitude: f64,
        fastest: f64,
    ) -> Result<(Vec<Iterate>, bool), LinearizeError> {
        let (mut next, mut lost): (Vec<Iterate>, bool) = (Vec::new(), false);
        for mut own in beginnings {
            let end = self.converge(amplitude, fastest, &mut own)?;
            lost |= end == End::Lost;
            let known = |other: &Iterate| (other.speed / own.speed - 1.0).abs() < SAME;
            if end == End::Neutral && !next.iter().any(known) {
                next.push(own);
            }
        }
        next.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        next.truncate(FOLLOWED);
        Ok((next, lost))
    }

    fn motion(&self, own: &Iterate) -> CriticalSpeed {
        let size = self.largest(&own.shape);
        CriticalSpeed {
            speed: own.speed,
            frequency: own.value.im / TAU,
            shape: own.shape.iter().map(|value| value / size).collect(),
        }
    }

    /// Returns the motions of the car without friction that grow most at a speed.
    fn beginnings(&mut self, speed: f64) -> Result<Vec<Iterate>, LinearizeError> {
        let model = self.car.model(speed)?;
        let none = vec![Equivalent::NONE; model.sliders.len()];
        let modes = vibrations(&model, none.iter().copied())?;
        let beginning = |mode: mechanics::linear::LinearMode| Iterate {
            speed,
            value: mode.value,
            shape: DVector::from_vec(mode.shape),
            sliders: none.clone(),
            creep: vec![1.0; self.places.len()],
        };
        Ok(modes.into_iter().take(BEGINNINGS).map(beginning).collect())
    }

    /// Iterates to a neutral motion of an amplitude.
    fn converge(&mut self, amplitude: f64, fastest: f64, own: &mut Iterate) -> Result<End, LinearizeError> {
        let mut slope = None;
        for step in 0..STEPS {
            let models = self.models(own.speed)?;
            let Some((value, shape)) = nearest(&self.matrices(&models, own, amplitude), own) else {
                return Ok(End::Lost);
            };
            (own.value, own.shape) = (value, shape);
            if step % RENEWED == 0 || slope.is_none() {
                let faster = Iterate {
                    speed: 1.01 * own.speed,
                    ..own.clone()
                };
                let models = self.models(faster.speed)?;
                let next = nearest(&self.matrices(&models, &faster, amplitude), own);
                slope = next.map(|(value, _)| (value.re - own.value.re) / (faster.speed - own.speed));
            }
            let change = self.renew(&models, amplitude, own);
            // Where it grows less with the speed, look further on.
            let wanted = match slope {
                Some(slope) if slope > 0.0 => -own.value.re / slope,
                _ => 0.05 * own.speed,
            };
            let moved = wanted.clamp(-0.1 * own.speed, 0.1 * own.speed);
            let [equivalents, speeds] = SETTLED;
            if change < equivalents && moved.abs() < speeds * own.speed {
                let vibrates = own.value.im > TAU * VIBRATIONS[0];
                return Ok(if vibrates { End::Neutral } else { End::Lost });
            }
            own.speed += 1.4 * PART * moved;
            if own.speed > FASTEST * fastest {
                return Ok(End::Above);
            }
            if own.speed < SLOWEST {
                return Ok(End::Lost);
            }
        }
        Ok(End::Lost)
    }

    /// Moves the equivalents of sliders and creep towards those of a motion. Returns the largest relative
    /// change that was wanted.
    fn renew(&self, models: &Models, amplitude: f64, own: &mut Iterate) -> f64 {
        let mut change = 0.0_f64;
        let scale = amplitude / self.largest(&own.shape);
        let frequency = own.value.im.max(TAU * VIBRATIONS[0]);
        let shape = own.shape.as_slice();
        for (slider, pair) in own.sliders.iter_mut().zip(&models.whole.sliders) {
            let to = pair.slider.equivalent(pair.amplitude(shape) * scale, frequency);
            let apart = [to.stiffness - slider.stiffness, to.damping - slider.damping];
            let size = libm::hypot(to.stiffness, frequency * to.damping) + 1e-3 * pair.slider.stiffness;
            change = change.max(libm::hypot(apart[0], frequency * apart[1]) / size);
            slider.stiffness += PART * apart[0];
            slider.damping += PART * apart[1];
        }
        let factors = self.creep_factors(models, own, scale);
        for (creep, to) in own.creep.iter_mut().zip(factors) {
            change = change.max((to - *creep).abs() / to);
            *creep += PART * (to - *creep);
        }
        change
    }

    /// Returns the lateral amplitude of the wheelset that moves most.
    fn largest(&self, shape: &DVector<Complex<f64>>) -> f64 {
        let own = self.places.iter().map(|([lateral, _], _)| shape[*lateral].norm());
        own.fold(0.0, f64::max)
    }

    fn models(&mut self, speed: f64) -> Result<Models, LinearizeError> {
        let whole = self.car.model(speed)?;
        let without_creep = match &mut self.without_creep {
            Some(own) => own.model(speed)?,
            None => whole.clone(),
        };
        Ok(Models { whole, without_creep })
    }

    fn matrices(&self, models: &Models, own: &Iterate, amplitude: f64) -> SecondOrder {
        let mut matrices = models.whole.with(own.sliders.iter().copied());
        for ((_, group), factor) in self.places.iter().zip(&own.creep) {
            for at in group.iter().flat_map(|i| group.iter().map(move |j| (*i, *j))) {
                let [by_position, by_speed] = models.creep(at);
                matrices.stiffness[at] -= (1.0 - factor) * by_position;
                matrices.damping[at] -= (1.0 - factor) * by_speed;
            }
        }
        let Some(wheels) = &self.wheels else {
            return matrices;
        };
        let scale = amplitude / self.largest(&own.shape);
        for (([lateral, heading], _), wheels) in self.places.iter().zip(wheels) {
            let [conicity, stiffness] = wheels.beyond_middle(own.shape[*lateral].norm() * scale);
            // Of the damping of the heading, 2 f11 l²/V, follows the moment by the shift, 2 f11 l λ/r.
            let turning = matrices.damping[(*heading, *heading)] * own.speed / self.half_distance;
            matrices.stiffness[(*heading, *lateral)] += turning * conicity / self.radius;
            matrices.stiffness[(*lateral, *lateral)] -= self.axle_load * stiffness;
        }
        matrices
    }

    /// Returns the factor of the linear creep of each wheelset in a motion.
    fn creep_factors(&self, models: &Models, own: &Iterate, scale: f64) -> Vec<f64> {
        let of = |([lateral, heading], group): &([usize; 2], Vec<usize>)| {
            let force = |row: usize| {
                let terms = group.iter().map(|column| {
                    let [by_position, by_speed] = models.creep((row, *column));
                    (own.value * by_speed + by_position) * own.shape[*column]
                });
                terms.sum::<Complex<f64>>() * scale
            };
            let (across, along) = (
                force(*lateral) * 0.5,
                force(*heading) / (2.0 * self.half_distance),
            );
            let squares = across * across + along * along;
            let size = (0.5 * (across.norm_sqr() + along.norm_sqr() + squares.norm())).sqrt();
            self.saturation.factor(size / self.limit)
        };
        self.places.iter().map(of).collect()
    }
}

impl Models {
    /// Returns what creep adds to an entry of stiffness and damping.
    fn creep(&self, at: (usize, usize)) -> [f64; 2] {
        let [all, none] = [&self.whole, &self.without_creep].map(|own| &own.without_friction);
        [
            all.stiffness[at] - none.stiffness[at],
            all.damping[at] - none.damping[at],
        ]
    }
}

/// Returns the places of lateral displacement and heading of each wheelset, and of all coordinates that its
/// creep acts on: its own and those of the rails under it.
fn places(car: &SteadyCar) -> Vec<([usize; 2], Vec<usize>)> {
    let system = &car.car().system;
    let numbers = &car.car().numbers;
    let all = numbers.wheelsets.iter().enumerate().filter_map(|(w, wheelset)| {
        let mut bodies = vec![*wheelset];
        bodies.extend(numbers.rails.iter().flat_map(|own| own[w]));
        let coordinates = bodies.into_iter().flat_map(|body| (0..6).map(move |k| (body, k)));
        let group = coordinates.filter_map(|(body, k)| system.position_of(body, k));
        let place = |k| system.position_of(*wheelset, k);
        Some((
            [place(coordinate::LATERAL)?, place(coordinate::HEADING)?],
            group.collect(),
        ))
    });
    all.collect()
}

/// Returns value and shape of the motion nearest to one that is known, by Newton's method with inverse
/// iteration: `A(σ) x = A'(σ) φ`, `λ = σ - φ_k/x_k`.
fn nearest(matrices: &SecondOrder, known: &Iterate) -> Option<(Complex<f64>, DVector<Complex<f64>>)> {
    let n = matrices.mass.nrows();
    let (mut value, mut shape) = (known.value, known.shape.clone());
    for _ in 0..6 {
        // Beside it: with an exact eigenvalue there is nothing to solve.
        let shift = value + Complex::new(1e-7 * value.norm(), 0.0);
        let matrix = DMatrix::from_fn(n, n, |i, j| {
            let at = (i, j);
            shift * shift * matrices.mass[at] - shift * matrices.damping[at] - matrices.stiffness[at]
        });
        let right = DVector::from_fn(n, |i, _| {
            let terms = (0..n).map(|j| (i, j)).filter_map(|at| {
                let (m, d) = (matrices.mass[at], matrices.damping[at]);
                (m != 0.0 || d != 0.0).then(|| (shift * (2.0 * m) - d) * shape[at.1])
            });
            terms.sum::<Complex<f64>>()
        });
        let next = matrix.lu().solve(&right)?;
        let at = (0..n).max_by(|a, b| shape[*a].norm().total_cmp(&shape[*b].norm()))?;
        let moved = shape[at] / next[at];
        value = shift - moved;
        let size = next[at] / shape[at].norm();
        shape = next / size;
        if !(value.re.is_finite() && value.im.is_finite()) {
            return None;
        }
        // Each step squares the error.
        if moved.norm() < 1e-4 * value.norm() {
            break;
        }
    }
    Some((value, shape))
}
