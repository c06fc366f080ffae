//! Figures of a vehicle that limits of rules depend on.

use car::{ClimbLimits, Parameters};

use super::derailment::static_loads;

/// Figures of a vehicle that limits depend on, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarFigures {
    /// Least static load of an axle on level track, N.
    pub least_static_axle_load: f64,
    /// Greatest static load of an axle, N.
    pub greatest_static_axle_load: f64,
    /// Least static load of a wheel, N.
    pub least_static_wheel_load: f64,
    /// Greatest static load of a wheel, N.
    pub greatest_static_wheel_load: f64,
    /// Least of the largest angles of the flanges' faces, of all wheels, rad; `NaN` with linear wheels and
    /// without flanges.
    pub least_flange_angle: f64,
    /// Greatest friction of a wheel on its rail at the angle of its flange, of all places along the track and
    /// where nothing slips; `NaN` with linear wheels and without flanges.
    pub flange_friction: f64,
}

impl CarFigures {
    /// Names and units of measures with these figures, in the order of [`CarFigures::values`].
    pub const NAMES: [&'static str; 6] = [
        "least_static_axle_load",
        "greatest_static_axle_load",
        "least_static_wheel_load",
        "greatest_static_wheel_load",
        "least_flange_angle",
        "flange_friction",
    ];

    /// Returns those of a car.
    #[must_use]
    pub fn of(parameters: &Parameters) -> Self {
        let climb = ClimbLimits::of(parameters);
        Self::with(&static_loads(parameters), climb.as_ref())
    }

    /// Returns those of a vehicle whose wheels have these static loads (by axle, left and right, N) and
    /// flanges.
    #[must_use]
    pub fn with(loads: &[[f64; 2]], climb: Option<&ClimbLimits>) -> Self {
        let axles: Vec<f64> = loads.iter().map(|[left, right]| left + right).collect();
        // `min` and `max` leave `NaN` out.
        let least = |values: &[f64]| values.iter().copied().fold(f64::NAN, f64::min);
        let greatest = |values: &[f64]| values.iter().copied().fold(f64::NAN, f64::max);
        let flanges = climb.map(ClimbLimits::flanges).unwrap_or_default();
        let [angles, friction]: [Vec<f64>; 2] = [0, 1].map(|k| flanges.iter().map(|own| own[k]).collect());
        Self {
            least_static_axle_load: least(&axles),
            greatest_static_axle_load: greatest(&axles),
            least_static_wheel_load: least(loads.as_flattened()),
            greatest_static_wheel_load: greatest(loads.as_flattened()),
            least_flange_angle: least(&angles),
            flange_friction: greatest(&friction),
        }
    }

    /// Returns the figure with the name of a measure; `None` if there is none, or it is not known.
    #[must_use]
    pub fn named(&self, name: &str) -> Option<f64> {
        let place = Self::NAMES.iter().position(|own| *own == name)?;
        Some(self.values()[place]).filter(|own| own.is_finite())
    }

    /// Returns the figures in the order of [`CarFigures::NAMES`].
    #[must_use]
    pub fn values(&self) -> [f64; 6] {
        [
            self.least_static_axle_load,
            self.greatest_static_axle_load,
            self.least_static_wheel_load,
            self.greatest_static_wheel_load,
            self.least_flange_angle,
            self.flange_friction,
        ]
    }
}
