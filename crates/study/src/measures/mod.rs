//! What a study keeps of a run: one number for each measure, without the table of the run.
//!
//! Definitions are those of [`metrics`](crate::metrics) and of the summary, taken at the same output times from the same
//! functions; a test holds every measure against the summary of the whole run. What is more here:
//!
//! - *lift-off time* of a face: time of the whole run in which none of its corners touches, from the contact events;
//! - *stick share* of a face: of the time in which corners touch, counted corner by corner, the part in which they stick;
//! - *wear power* of a face: energy lost in its friction over time;
//! - *peak moments*: the largest size at any output time after the first half period, so that the release at the start does
//!   not count; where there is no whole cycle, of the whole run;
//! - *column force ratio*: of the sums over a branch, the column's normal forces along x over the load on the wedge
//!   ([`closed_form::load`](crate::closed_form::load)); beside it that of the massless wedge, which depends on angles and
//!   frictions alone;
//! - *ledger residual*: the relative residual of the energy ledger ([`mechanics::energy_balance`]); a variant for which it exceeds
//!   1e-2 has failed, and keeps its measures;
//! - *jam margin*: of the massless wedge ([`mechanics::quasi_static`]), going down, going up, and the smaller one.
//!
//! Stick share and wear power are taken over the whole cycles after the first half period, as energies are; where there
//! are none, over the whole run. A measure that a run does not have is `NaN`.

mod clock;
mod measuring;

use quantity::Kind;

pub use measuring::{Judged, Unmeasured, judge, measure};

/// A measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// Its name, without unit.
    pub name: &'static str,
    /// What it is, in a few words.
    pub text: &'static str,
    /// What kind of quantity it is; values are SI.
    pub kind: Kind,
}

const fn define(name: &'static str, kind: Kind, text: &'static str) -> Measure {
    Measure { name, text, kind }
}

/// The measures, in the order of [`Measures`].
pub const ALL: [Measure; COUNT] = [
    define("cycles", Kind::Count, "whole cycles after the first half period"),
    define(
        "energy_per_cycle_side_frame",
        Kind::Energy,
        "lost in the column's friction each cycle",
    ),
    define(
        "energy_per_cycle_bolster",
        Kind::Energy,
        "lost in the slope's friction each cycle",
    ),
    define(
        "equivalent_damping",
        Kind::Damping,
        "of the column's friction: energy per cycle over pi omega A^2",
    ),
    define(
        "equivalent_stiffness",
        Kind::Stiffness,
        "first harmonic of the vertical force of wedge and coil on the bolster, in phase",
    ),
    define(
        "equivalent_damping_on_bolster",
        Kind::Damping,
        "the same first harmonic, out of phase",
    ),
    define(
        "mean_vertical_wedge_force_up",
        Kind::Force,
        "column friction on the side frame, positive up; mean while the bolster rises",
    ),
    define(
        "mean_vertical_wedge_force_down",
        Kind::Force,
        "the same while the bolster falls",
    ),
    define(
        "mean_vertical_force_on_side_frame_up",
        Kind::Force,
        "the same with the spring force of a coil on the side frame; mean while the bolster rises",
    ),
    define(
        "mean_vertical_force_on_side_frame_down",
        Kind::Force,
        "the same while the bolster falls",
    ),
    define(
        "mean_longitudinal_wedge_force_up",
        Kind::Force,
        "normal forces of the column along x; mean while the bolster rises",
    ),
    define(
        "mean_longitudinal_wedge_force_down",
        Kind::Force,
        "the same while the bolster falls",
    ),
    define(
        "peak_side_frame_roll_moment",
        Kind::Moment,
        "largest moment of the column's forces on the wedge about x",
    ),
    define("peak_side_frame_pitch_moment", Kind::Moment, "about y"),
    define("peak_side_frame_yaw_moment", Kind::Moment, "about z"),
    define(
        "peak_bolster_roll_moment",
        Kind::Moment,
        "largest moment of the slope's forces on the wedge about x",
    ),
    define("peak_bolster_pitch_moment", Kind::Moment, "about y"),
    define("peak_bolster_yaw_moment", Kind::Moment, "about z"),
    define(
        "lift_off_time_column",
        Kind::Time,
        "time in which no corner touches the column",
    ),
    define(
        "lift_off_time_slope",
        Kind::Time,
        "time in which no corner touches the slope",
    ),
    define(
        "stick_share_column",
        Kind::Dimensionless,
        "of the time in which corners touch the column, the part in which they stick",
    ),
    define("stick_share_slope", Kind::Dimensionless, "the same at the slope"),
    define(
        "column_force_ratio_up",
        Kind::Dimensionless,
        "normal forces of the column along x over the coil's force less the wedge's weight; means while the bolster rises",
    ),
    define(
        "column_force_ratio_down",
        Kind::Dimensionless,
        "the same while the bolster falls",
    ),
    define(
        "quasi_static_column_force_ratio_up",
        Kind::Dimensionless,
        "the same of the massless wedge in steady sliding (eq. 5-1); none where it jams",
    ),
    define(
        "quasi_static_column_force_ratio_down",
        Kind::Dimensionless,
        "the same while the bolster falls",
    ),
    define("jam_margin", Kind::Angle, "the smaller of the next two"),
    define(
        "jam_margin_down",
        Kind::Angle,
        "of the massless wedge while the bolster falls; it jams at zero and below",
    ),
    define("jam_margin_up", Kind::Angle, "the same while the bolster rises"),
    define("wear_power_column", Kind::Power, "lost in the column's friction"),
    define("wear_power_slope", Kind::Power, "lost in the slope's friction"),
    define(
        "ledger_residual",
        Kind::Dimensionless,
        "relative residual of the energy ledger: the largest residual over the largest of work, losses and change of stored energy",
    ),
    define(
        "contact_events",
        Kind::Count,
        "changes between open, stick and slip",
    ),
    define("steps", Kind::Count, "accepted steps of the integrator"),
];

/// Number of measures.
pub const COUNT: usize = 34;

/// Places of the measures.
pub(crate) mod place {
    pub const CYCLES: usize = 0;
    pub const ENERGY_PER_CYCLE: usize = 1;
    pub const EQUIVALENT_DAMPING: usize = 3;
    pub const EQUIVALENT_STIFFNESS: usize = 4;
    pub const EQUIVALENT_DAMPING_ON_BOLSTER: usize = 5;
    /// Up and down by turns.
    pub const MEANS: usize = 6;
    pub const PEAKS: usize = 12;
    pub const LIFT_OFF: usize = 18;
    pub const STICK: usize = 20;
    /// Up and down by turns.
    pub const RATIOS: usize = 22;
    pub const QUASI_STATIC_RATIOS: usize = 24;
    pub const JAM_MARGIN: usize = 26;
    pub const WEAR: usize = 29;
    pub const RESIDUAL: usize = 31;
    pub const EVENTS: usize = 32;
    pub const STEPS: usize = 33;
}

/// The measures of a run, SI, in the order of [`ALL`]; `NaN` for what it does not have.
#[derive(Clone, Copy, Debug)]
pub struct Measures(pub [f64; COUNT]);

impl Measures {
    /// None of them.
    pub const NONE: Self = Self([f64::NAN; COUNT]);

    /// The measure of this name, if there is one and the run has it; SI.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<f64> {
        let place = ALL.iter().position(|measure| measure.name == name)?;
        Some(self.0[place]).filter(|value| !value.is_nan())
    }
}

impl Measures {
    /// The name of the first measure that is infinite, or is no number although every run has it.
    pub(crate) fn not_finite(&self) -> Option<&'static str> {
        let always = [place::PEAKS..place::STICK, place::WEAR..place::EVENTS];
        let wrong = |(place, value): (usize, &f64)| {
            let has_it = always.iter().any(|places| places.contains(&place));
            value.is_infinite() || (value.is_nan() && has_it)
        };
        let found = self
            .0
            .iter()
            .enumerate()
            .find(|(place, value)| wrong((*place, value)));
        found.map(|(place, _)| ALL[place].name)
    }
}

impl PartialEq for Measures {
    /// The same bits, but any `NaN` equals any other.
    fn eq(&self, other: &Self) -> bool {
        let mut pairs = self.0.iter().zip(&other.0);
        pairs.all(|(a, b)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()))
    }
}
