//! The energy balance of a run, and the one measure of how well its ledger closes.
//!
//! The ledger compares the work done on the bodies with the change of the energy that they store and with the
//! losses. Each loss is integrated from its own force and velocity, so the difference is no entry that is
//! chosen to fit: it is the *residual*,
//!
//! ```text
//! residual = work − change of stored energy − losses,
//! ```
//!
//! zero but for the errors of the integration. Its size alone has no meaning: a residual of 1 J is large for
//! a wedge that is dropped, and small for a wagon that rolls over a joint. [`relative_residual`] is the
//! measure for all runs.

use serde::{Deserialize, Serialize};

/// A run whose relative residual exceeds this has a warning: its energies are wrong in the third digit.
pub const DOUBTFUL: f64 = 1e-3;

/// A run whose relative residual exceeds this has failed: its energies are wrong in the second digit. Its
/// results are kept.
pub const FAILED: f64 = 1e-2;

/// Energies up to this share of the stored energy are rounding: stored energy is a difference of sums with
/// some ten entries, so that smaller energies cannot be distinguished from zero.
const ROUNDING: f64 = 1e-12;

/// Returns the relative residual of an energy ledger (a pure number): the absolute residual, over the largest
/// of
///
/// - the absolute work that the prescribed motions have done,
/// - the sum of all losses,
/// - the largest absolute change of the stored energy (kinetic, elastic, gravity) since the start, over the
///   run.
///
/// All arguments are energies in one unit, such as J. Three scales are needed: the work is zero in a drop
/// test; losses are zero without friction and damping; and a motion that comes back to where it began has
/// done little work in the end, although much energy went to and fro. Returns 0 if all three are zero:
/// nothing has happened. Returns NaN if the residual is NaN.
///
/// ```
/// use mechanics::energy_balance::relative_residual;
/// assert_eq!(relative_residual(-0.2, 50.0, 100.0, 20.0), 0.002);
/// assert_eq!(relative_residual(0.0, 0.0, 0.0, 0.0), 0.0);
/// ```
#[must_use]
pub fn relative_residual(residual: f64, work: f64, losses: f64, largest_stored_change: f64) -> f64 {
    let scale = work.abs().max(losses.abs()).max(largest_stored_change.abs());
    if scale > 0.0 || residual.is_nan() {
        residual.abs() / scale
    } else {
        0.0
    }
}

/// An energy ledger at one time, J; work, losses and change since the start of the run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Entries {
    /// Work done by the prescribed motions.
    pub work: f64,
    /// Sum of all losses.
    pub losses: f64,
    /// Change of the stored energy.
    pub stored_change: f64,
    /// Work less change and losses, other entries included.
    pub residual: f64,
}

impl Entries {
    /// Returns the [`relative_residual`] of this time alone. It needs no history: an importer of an FMU may
    /// go back in time.
    #[must_use]
    pub fn relative_residual(&self) -> f64 {
        relative_residual(self.residual, self.work, self.losses, self.stored_change)
    }
}

/// The energy balance of a run, followed from output time to output time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyBalance {
    /// Absolute stored energy at the start, J: the scale of rounding.
    pub stored_at_start: f64,
    /// Work done by the prescribed motions until the last output time, J.
    pub work: f64,
    /// Sum of the losses until the last output time, J.
    pub losses: f64,
    /// Largest absolute change of the stored energy at any output time, J.
    pub largest_stored_change: f64,
    /// Largest absolute residual at any output time, J.
    pub largest_residual: f64,
    /// The first output time with this residual, s.
    pub largest_residual_time: f64,
}

impl EnergyBalance {
    /// Returns the balance of a run at its start, where the stored energy is `stored` (J).
    #[must_use]
    pub fn new(stored: f64) -> Self {
        Self {
            stored_at_start: stored.abs(),
            ..Self::default()
        }
    }

    /// Takes the ledger at an output time (s) into account.
    pub fn note(&mut self, time: f64, entries: &Entries) {
        let residual = entries.residual.abs();
        // Also a residual that is not a number.
        if residual > self.largest_residual || residual.is_nan() {
            (self.largest_residual, self.largest_residual_time) = (residual, time);
        }
        self.largest_stored_change = self.largest_stored_change.max(entries.stored_change.abs());
        (self.work, self.losses) = (entries.work, entries.losses);
    }

    /// Returns the [`relative_residual`] of the run: of the largest residual at any output time, by work and
    /// losses at the last output time. Where all of them are rounding (a wedge at rest), it is 0.
    #[must_use]
    pub fn relative_residual(&self) -> f64 {
        let change = self.largest_stored_change;
        let rounding = ROUNDING * (self.stored_at_start + change);
        if self.largest_residual <= rounding {
            return 0.0;
        }
        relative_residual(self.largest_residual, self.work, self.losses, change)
    }

    /// Returns the verdict on the run.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        Verdict::of(self.relative_residual())
    }
}

/// The verdict on a run by its energy ledger.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The ledger closes.
    Closed,
    /// It closes badly: the run has a warning ([`DOUBTFUL`]).
    Doubtful,
    /// It does not close: the run has failed ([`FAILED`]); its results are kept.
    Failed,
}

impl Verdict {
    /// Returns the verdict on a relative residual; NaN fails.
    #[must_use]
    pub fn of(relative_residual: f64) -> Self {
        if relative_residual <= DOUBTFUL {
            Self::Closed
        } else if relative_residual <= FAILED {
            Self::Doubtful
        } else {
            Self::Failed
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{EnergyBalance, Entries, Verdict, relative_residual};

    fn entries(work: f64, losses: f64, stored_change: f64) -> Entries {
        Entries {
            work,
            losses,
            stored_change,
            residual: work - losses - stored_change,
        }
    }

    #[test]
    fn energy_the_largest_of_work_losses_and_stored_change_is_the_scale() {
        assert_eq!(relative_residual(1.0, -100.0, 20.0, 30.0), 0.01);
        assert_eq!(relative_residual(-1.0, 1.0, 200.0, 30.0), 0.005);
        assert_eq!(relative_residual(1.0, 0.0, 0.0, 50.0), 0.02);
    }

    #[test]
    fn limits_nothing_happens_and_what_is_no_number() {
        assert_eq!(relative_residual(0.0, 0.0, 0.0, 0.0), 0.0);
        assert_eq!(EnergyBalance::new(500.0).relative_residual(), 0.0);
        assert!(relative_residual(f64::NAN, 1.0, 0.0, 0.0).is_nan());
        assert!(relative_residual(f64::NAN, 0.0, 0.0, 0.0).is_nan());
        assert_eq!(Verdict::of(f64::NAN), Verdict::Failed);
        let mut balance = EnergyBalance::new(1.0);
        balance.note(1.0, &entries(f64::NAN, 0.0, 0.0));
        balance.note(2.0, &entries(1.0, 0.0, 0.0));
        assert_eq!(balance.verdict(), Verdict::Failed);
    }

    #[test]
    fn limits_rounding_of_a_wedge_at_rest_is_no_residual() {
        let mut balance = EnergyBalance::new(-500.0);
        balance.note(1.0, &entries(0.0, 0.0, 1e-13));
        assert_eq!(balance.relative_residual(), 0.0);
    }

    #[test]
    fn energy_what_goes_to_and_fro_counts_although_it_is_back_at_the_end() {
        let mut balance = EnergyBalance::new(0.0);
        for (time, entries) in [
            (0.0, entries(0.0, 0.0, 0.0)),
            (1.0, entries(100.0, 0.0, 99.9)),
            (2.0, entries(0.5, 0.45, 0.0)),
        ] {
            balance.note(time, &entries);
        }
        assert_eq!(balance.largest_residual_time, 1.0);
        assert!((balance.relative_residual() - 0.1 / 99.9).abs() < 1e-12);
        assert_eq!(balance.verdict(), Verdict::Doubtful);
    }
}
