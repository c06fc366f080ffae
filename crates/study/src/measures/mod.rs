//! The metrics of a run in a study: one number each, without the table of the run. Files call them measures.
//!
//! Each model has a file of its own. The definitions of wedges' measures are those of
//! [`metrics`](crate::metrics) and of the summary, taken at the same output times from the same functions; a
//! test holds every measure against the summary of the whole run. What is more here:
//!
//! - *lift-off time* of a face: time of the whole run in which none of its corners touches, from the contact
//!   events;
//! - *stick share* of a face: of the time in which corners touch, counted corner by corner, the part in which
//!   they stick;
//! - *wear power* of a face: energy lost in its friction over time;
//! - *peak moments*: the largest size at any output time after the first half period, so that the release at
//!   the start does not count; where there is no whole cycle, of the whole run;
//! - *column force ratio*: of the sums over a branch, the column's normal forces along x over the load on the
//!   wedge ([`closed_form::load`](crate::closed_form::load)); beside it that of the massless wedge, which
//!   depends on angles and frictions alone;
//! - *ledger residual*: the relative residual of the energy ledger ([`mechanics::energy_balance`]); a variant
//!   for which it exceeds 1e-2 has failed, and keeps its measures;
//! - *jam margin*: of the massless wedge ([`mechanics::quasi_static`]), going down, going up, and the smaller
//!   one.
//!
//! Stick share and wear power are taken over the whole cycles after the first half period, as energies are;
//! where there are none, over the whole run. A measure that a run does not have is `NaN`.

mod car;
mod contact_times;
mod half_truck;
mod measuring;
mod of_rules;
mod truck;
mod vehicle;

use std::borrow::Cow;
use std::ops::Deref;
use std::sync::LazyLock;

use quantity::Kind;

pub use measuring::{Judged, Unmeasured, measure};

/// The description of a metric.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// Its name, without unit.
    pub name: Cow<'static, str>,
    /// The description, a few words.
    pub text: Cow<'static, str>,
    /// The kind of quantity; values are SI.
    pub kind: Kind,
    /// True if every run has it.
    pub always: bool,
}

impl Measure {
    fn new(
        name: impl Into<Cow<'static, str>>,
        kind: Kind,
        text: impl Into<Cow<'static, str>>,
        always: bool,
    ) -> Self {
        Self {
            name: name.into(),
            text: text.into(),
            kind,
            always,
        }
    }
}

/// The measures that a study keeps, in the order of [`Measures`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Definitions(Vec<Measure>);

impl Definitions {
    /// Returns the place of the measure of this name.
    #[must_use]
    pub fn place(&self, name: &str) -> Option<usize> {
        self.0.iter().position(|measure| measure.name == name)
    }

    /// Returns the measure of this name, if there is one and the run has it; SI.
    #[must_use]
    pub fn get(&self, measures: &Measures, name: &str) -> Option<f64> {
        let value = *measures.0.get(self.place(name)?)?;
        Some(value).filter(|value| !value.is_nan())
    }

    /// Returns the name of the first measure that is infinite, or is no number although every run has it.
    pub(crate) fn not_finite(&self, measures: &Measures) -> Option<&str> {
        let wrong =
            |(measure, value): &(&Measure, &f64)| value.is_infinite() || (value.is_nan() && measure.always);
        let found = self.0.iter().zip(&measures.0).find(wrong);
        found.map(|(measure, _)| &*measure.name)
    }
}

impl Deref for Definitions {
    type Target = [Measure];

    fn deref(&self) -> &[Measure] {
        &self.0
    }
}

/// Returns the measures of wedges.
#[must_use]
pub fn of_wedges() -> &'static Definitions {
    static ALL: LazyLock<Definitions> = LazyLock::new(|| {
        let always = [place::PEAKS..place::STICK, place::WEAR..place::EVENTS];
        let measures = WEDGE.iter().enumerate().map(|(place, (name, kind, text))| {
            let always = always.iter().any(|places| places.contains(&place));
            Measure::new(*name, *kind, *text, always)
        });
        Definitions(measures.collect())
    });
    &ALL
}

/// The measures of a wedge: name, kind, text.
const WEDGE: [(&str, Kind, &str); COUNT] = [
    ("cycles", Kind::Count, "whole cycles after the first half period"),
    (
        "energy_per_cycle_side_frame",
        Kind::Energy,
        "lost in the column's friction each cycle",
    ),
    (
        "energy_per_cycle_bolster",
        Kind::Energy,
        "lost in the slope's friction each cycle",
    ),
    (
        "equivalent_damping",
        Kind::Damping,
        "of the column's friction: energy per cycle over pi omega A^2",
    ),
    (
        "equivalent_stiffness",
        Kind::Stiffness,
        "first harmonic of the vertical force of wedge and coil on the bolster, in phase",
    ),
    (
        "equivalent_damping_on_bolster",
        Kind::Damping,
        "the same first harmonic, out of phase",
    ),
    (
        "mean_vertical_wedge_force_up",
        Kind::Force,
        "column friction on the side frame, positive up; mean while the bolster rises, at mid stroke with \
         constant damping, in the lower stroke with variable damping",
    ),
    (
        "mean_vertical_wedge_force_down",
        Kind::Force,
        "the same while the bolster falls",
    ),
    (
        "mean_vertical_force_on_side_frame_up",
        Kind::Force,
        "the same friction with the spring force of a coil on the side frame; mean while the bolster rises, \
         in the same window",
    ),
    (
        "mean_vertical_force_on_side_frame_down",
        Kind::Force,
        "the same while the bolster falls",
    ),
    (
        "mean_longitudinal_wedge_force_up",
        Kind::Force,
        "normal forces of the column along x; mean while the bolster rises, in the same window",
    ),
    (
        "mean_longitudinal_wedge_force_down",
        Kind::Force,
        "the same while the bolster falls",
    ),
    (
        "peak_side_frame_roll_moment",
        Kind::Moment,
        "largest moment of the column's forces on the wedge about x",
    ),
    ("peak_side_frame_pitch_moment", Kind::Moment, "about y"),
    ("peak_side_frame_yaw_moment", Kind::Moment, "about z"),
    (
        "peak_bolster_roll_moment",
        Kind::Moment,
        "largest moment of the slope's forces on the wedge about x",
    ),
    ("peak_bolster_pitch_moment", Kind::Moment, "about y"),
    ("peak_bolster_yaw_moment", Kind::Moment, "about z"),
    (
        "lift_off_time_column",
        Kind::Time,
        "time in which no corner touches the column",
    ),
    (
        "lift_off_time_slope",
        Kind::Time,
        "time in which no corner touches the slope",
    ),
    (
        "stick_share_column",
        Kind::Dimensionless,
        "of the time in which corners touch the column, the part in which they stick",
    ),
    ("stick_share_slope", Kind::Dimensionless, "the same at the slope"),
    (
        "column_force_ratio_up",
        Kind::Dimensionless,
        "normal forces of the column along x over the coil's force less the wedge's weight; means while the \
         bolster rises",
    ),
    (
        "column_force_ratio_down",
        Kind::Dimensionless,
        "the same while the bolster falls",
    ),
    (
        "quasi_static_column_force_ratio_up",
        Kind::Dimensionless,
        "the same of the massless wedge in steady sliding (eq. 5-1); none where it jams",
    ),
    (
        "quasi_static_column_force_ratio_down",
        Kind::Dimensionless,
        "the same while the bolster falls",
    ),
    ("jam_margin", Kind::Angle, "the smaller of the next two"),
    (
        "jam_margin_down",
        Kind::Angle,
        "of the massless wedge while the bolster falls; it jams at zero and below",
    ),
    ("jam_margin_up", Kind::Angle, "the same while the bolster rises"),
    ("wear_power_column", Kind::Power, "lost in the column's friction"),
    ("wear_power_slope", Kind::Power, "lost in the slope's friction"),
    (
        "ledger_residual",
        Kind::Dimensionless,
        "relative residual of the energy ledger: the largest residual over the largest of work, losses and \
         change of stored energy",
    ),
    (
        "contact_events",
        Kind::Count,
        "changes between open, stick and slip",
    ),
    ("steps", Kind::Count, "accepted steps of the integrator"),
];

/// Number of measures of a wedge.
const COUNT: usize = 34;

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

/// The measures of a run, SI, in the order of the [`Definitions`]; `NaN` for what it does not have.
/// Empty where nothing was measured.
#[derive(Clone, Debug, Default)]
pub struct Measures(pub Vec<f64>);

impl PartialEq for Measures {
    /// Returns whether the bits are the same, but any `NaN` equals any other.
    fn eq(&self, other: &Self) -> bool {
        let mut pairs = self.0.iter().zip(&other.0);
        self.0.len() == other.0.len()
            && pairs.all(|(a, b)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()))
    }
}
