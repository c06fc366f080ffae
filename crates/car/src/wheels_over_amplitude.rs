//! Conicity, gravitational stiffness and creep of a wheelset over the amplitude of its motion, by harmonic
//! linearization.
//!
//! For a lateral motion `y = A sin u` of a rigid wheelset on rigid rails:
//!
//! ```text
//! conicity   λ(A) = (1/(2 π A)) ∮ Δr(y) sin u du         Δr: rolling radius difference
//! stiffness  k(A) = (W/(π A)) ∮ z'(y) sin u du           z: height of the wheelset, W: axle load
//! creep      η(S) = (1/(π S)) ∮ F(S sin u) sin u du      S: amplitude of the linear creep force over μN
//! ```
//!
//! (de Pater 1961, Cooperrider et al. 1975, remembered.) Defects: the wheels touch at one point each and do
//! not give way; a flange that bears is a stiff spring and a steep cone here, which slides in truth. Creep
//! along and across saturate together by the larger semi-axis of the ellipse of their sum; spin's part goes
//! with it.

use std::f64::consts::PI;

use wheelrail::contact::CreepLaw;
use wheelrail::wheelset::RigidWheelset;

/// Largest amplitude of the tables, m: 0.6 in, beyond the flanges. The number of their steps.
const LARGEST: f64 = 0.6 * 0.0254;
const STEPS: usize = 120;
/// Shifts to each side at which the geometry is taken.
const SHIFTS: usize = 300;
/// Points of the midpoint rule over half a cycle, of the geometry and of creep.
const POINTS: usize = 200;
const CREEP_POINTS: usize = 32;
/// Stiffness over axle load from which on a flange bears, 1/m: a wheelset that is lifted by a twentieth of
/// its shift at an amplitude of 0.4 in.
const FLANGE: f64 = 5.0;

/// The tables of a wheelset.
#[derive(Clone, Debug)]
pub(crate) struct WheelsOverAmplitude {
    /// For each step of the amplitude: conicity, and stiffness over axle load, 1/m.
    values: Vec<[f64; 2]>,
}

impl WheelsOverAmplitude {
    /// Returns the tables, as far as the wheelset stays over its rails.
    pub fn new(wheelset: &RigidWheelset) -> Self {
        let reach = LARGEST * (1.0 + 2.0 / SHIFTS as f64);
        let sweep = wheelset.sweep(reach, 2 * SHIFTS + 1, false);
        let mut values = Vec::with_capacity(STEPS);
        'steps: for step in 1..=STEPS {
            let amplitude = LARGEST * step as f64 / STEPS as f64;
            let (mut radii, mut slopes) = (0.0, 0.0);
            for i in 0..POINTS {
                let sine = libm::sin(PI * ((i as f64 + 0.5) / POINTS as f64 - 0.5));
                let shift = amplitude * sine;
                let next = sweep.partition_point(|own| own.shift <= shift);
                let low = next.checked_sub(1).and_then(|k| sweep.get(k));
                let (Some(low), Some(high)) = (low, sweep.get(next)) else {
                    break 'steps;
                };
                let width = high.shift - low.shift;
                let [a, b] = [low, high].map(|own| own.rolling_radius_difference());
                radii += (a + (shift - low.shift) / width * (b - a)) * sine;
                slopes += (high.height - low.height) / width * sine;
            }
            let mean = 1.0 / (POINTS as f64 * amplitude);
            values.push([radii * mean, 2.0 * slopes * mean]);
        }
        Self { values }
    }

    /// Returns the largest amplitude at which no flange bears, m.
    pub fn clearance(&self) -> f64 {
        let free = self
            .values
            .iter()
            .take_while(|[_, stiffness]| *stiffness < FLANGE);
        LARGEST * free.count() as f64 / STEPS as f64
    }

    /// Returns by how much conicity and stiffness over axle load (1/m) are larger at an amplitude (m) than at
    /// the smallest of the table, for which a linearization about the middle stands.
    pub fn beyond_middle(&self, amplitude: f64) -> [f64; 2] {
        let Some(first) = self.values.first() else {
            return [0.0; 2];
        };
        let last = self.values.len() - 1;
        let place = (amplitude / LARGEST * STEPS as f64 - 1.0).clamp(0.0, last as f64);
        let index = (place as usize).min(last.saturating_sub(1));
        let next = (index + 1).min(last);
        let share = place - index as f64;
        [0, 1].map(|k| {
            let (from, to) = (self.values[index][k], self.values[next][k]);
            from + share * (to - from) - first[k]
        })
    }
}

/// Creep force over the linear one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Saturation {
    /// No saturation.
    None,
    /// Polach's, with kA and kS.
    Polach([f64; 2]),
    /// The cubic of Vermeulen, Johnson, Shen, Hedrick and Elkins, which stands for FASTSIM's too.
    Cubic,
}

impl Saturation {
    /// Returns that of a creep law.
    pub fn of(law: CreepLaw) -> Self {
        match law {
            CreepLaw::Polach(own) => Self::Polach([own.adhesion, own.slip]),
            CreepLaw::ShenHedrickElkins | CreepLaw::Fastsim(_) => Self::Cubic,
            CreepLaw::Linear | CreepLaw::Frictionless => Self::None,
        }
    }

    /// Returns the force over the friction limit where linear creep has this one.
    fn force(self, linear: f64) -> f64 {
        match self {
            Self::None => linear,
            Self::Polach([adhesion, slip]) => {
                let gradient = PI * linear / (2.0 * (adhesion + slip));
                let (a, s) = (adhesion * gradient, slip * gradient);
                (2.0 / PI) * (a / (1.0 + a * a) + libm::atan(s))
            }
            Self::Cubic => {
                let s = linear.min(3.0);
                s - s * s / 3.0 + s * s * s / 27.0
            }
        }
    }

    /// Returns the factor of linear creep at an amplitude of its force over the friction limit.
    pub fn factor(self, amplitude: f64) -> f64 {
        if self == Self::None || amplitude < 1e-6 {
            return 1.0;
        }
        let sum = (0..CREEP_POINTS).map(|i| {
            let cosine = libm::cos(0.5 * PI * (i as f64 + 0.5) / CREEP_POINTS as f64);
            self.force(amplitude * cosine) * cosine
        });
        2.0 * sum.sum::<f64>() / (CREEP_POINTS as f64 * amplitude)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wheelrail::hertz::Material;
    use wheelrail::profile::nominal;
    use wheelrail::wheelset::Layout;

    /// Between cones and round rails conicity is that of the cone at all amplitudes, and the wheelset is
    /// hardly lifted.
    #[test]
    fn analytic_cones_have_one_conicity() {
        let (wheel, rail) = (nominal::cone(0.05, 0.06).unwrap(), nominal::rail_136re().unwrap());
        let layout = Layout {
            tape_distance: nominal::TAPE_DISTANCE,
            gauge: 56.5 * 0.0254,
            gauge_depth: nominal::GAUGE_DEPTH,
        };
        let steel = Material {
            youngs_modulus: 207e9,
            poisson: 0.28,
        };
        let own = RigidWheelset::new([&wheel; 2], [0.4572; 2], [&rail; 2], layout, steel).unwrap();
        let tables = WheelsOverAmplitude::new(&own);
        for [conicity, _] in &tables.values {
            assert!((conicity / 0.05 - 1.0).abs() < 0.02, "{conicity}");
        }
        let largest = tables.values.len() as f64 / STEPS as f64 * LARGEST;
        assert_eq!(tables.clearance(), largest);
    }

    /// The factor is 1 for small forces; for large ones the force is a square wave, `4/(π S)`.
    #[test]
    fn analytic_factors_of_creep_at_both_ends() {
        for own in [Saturation::Polach([1.0, 1.0]), Saturation::Cubic] {
            assert!((own.factor(1e-3) - 1.0).abs() < 1e-3);
            let large = own.factor(1e3) * PI * 1e3 / 4.0;
            assert!((large - 1.0).abs() < 5e-3, "{own:?}: {large}");
        }
        assert_eq!(Saturation::None.factor(1e3), 1.0);
    }
}
