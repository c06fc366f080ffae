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
//!
//! It has a floor: what the integrator does not promise is no fault. A step is accepted while the error of
//! each speed is at most the tolerance times its scale ([`crate::system::scales`]), which changes the kinetic
//! energy of what moves by as much as [`crate::system::System::energy_of_speed_errors`]. A residual of this
//! size, the *admissible* one, is at the limit of [`DOUBTFUL`], however little else has happened: a blow at
//! the start of a short run, say. A tolerance above [`LOOSEST`] excuses no more: that it is too loose is what
//! the ledger is to tell. And the floor holds for what stays. A residual that goes on growing, by more than
//! [`GROWING`] of what is turned over meanwhile, as that of an element that creates energy, has none.

use serde::{Deserialize, Serialize};

/// A run whose relative residual exceeds this has a warning: its energies are wrong in the third digit.
pub const DOUBTFUL: f64 = 1e-3;

/// A run whose relative residual exceeds this has failed: its energies are wrong in the second digit. Its
/// results are kept.
pub const FAILED: f64 = 1e-2;

/// A residual that grows by more than this share of what is turned over meanwhile has no floor. Coarse steps
/// that damp the end of a blow take up to some hundredths.
pub const GROWING: f64 = 0.05;

/// The loosest tolerance whose errors are admissible in a ledger.
pub const LOOSEST: f64 = 1e-4;

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
    over(residual, turnover(work, losses, largest_stored_change))
}

/// Returns the largest of work, losses and change of the stored energy, J.
fn turnover(work: f64, losses: f64, stored_change: f64) -> f64 {
    work.abs().max(losses.abs()).max(stored_change.abs())
}

/// Returns the absolute residual over its scale; 0 without a scale.
fn over(residual: f64, scale: f64) -> f64 {
    if scale > 0.0 || residual.is_nan() {
        residual.abs() / scale
    } else {
        0.0
    }
}

/// Returns the scale of a ledger (J) whose admissible residual is this (J): there the relative residual is
/// [`DOUBTFUL`].
fn floor(admissible: f64) -> f64 {
    admissible / DOUBTFUL
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
    /// The residual that the error of one step may leave: the tolerance, at most [`LOOSEST`], times
    /// [`crate::system::System::energy_of_speed_errors`].
    pub admissible: f64,
    /// Change of the kinetic energy alone, of models that may swing freely: nothing is put in or lost then,
    /// and the stored energy does not change, but kinetic energy goes to and fro. Zero of others.
    pub exchanged: f64,
}

impl Entries {
    /// Returns the relative residual of this time alone, with the floor of the admissible one. It needs no
    /// history: an importer of an FMU may go back in time.
    #[must_use]
    pub fn relative_residual(&self) -> f64 {
        let scale = turnover(self.work, self.losses, self.stored_change).max(self.exchanged.abs());
        over(self.residual, scale.max(floor(self.admissible)))
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
    /// Largest admissible residual at any output time, J.
    pub admissible: f64,
    /// Largest change of the kinetic energy at any output time, J: see [`Entries::exchanged`].
    #[serde(default)]
    pub largest_exchange: f64,
    /// What happened since two earlier output times: the first is a quarter to a half of the time back, the
    /// second a half to all of it.
    pub since: [Since; 2],
}

/// What happened since an output time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Since {
    /// The output time, s.
    pub time: f64,
    /// Work, losses, change of the stored energy and residual then, J.
    pub entries: [f64; 4],
    /// Largest absolute change of the stored energy since then, J.
    pub largest_stored_change: f64,
    /// Largest absolute change of the residual since then, J.
    pub largest_growth: f64,
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
        self.admissible = self.admissible.max(entries.admissible);
        self.largest_exchange = self.largest_exchange.max(entries.exchanged.abs());
        let Entries {
            work,
            losses,
            stored_change,
            residual,
            ..
        } = *entries;
        for since in &mut self.since {
            let [.., stored_then, residual_then] = since.entries;
            since.largest_stored_change = since
                .largest_stored_change
                .max((stored_change - stored_then).abs());
            since.largest_growth = since.largest_growth.max((residual - residual_then).abs());
        }
        let [_, last] = self.since;
        if time >= 2.0 * last.time {
            let now = Since {
                time,
                entries: [work, losses, stored_change, residual],
                ..Since::default()
            };
            self.since = [last, now];
        }
        (self.work, self.losses) = (entries.work, entries.losses);
    }

    /// Returns the largest of work, losses (both by the last output time), change of the stored energy and
    /// exchange, J.
    #[must_use]
    pub fn turnover(&self) -> f64 {
        turnover(self.work, self.losses, self.largest_stored_change).max(self.largest_exchange)
    }

    /// Returns whether the residual goes on growing: since a half to three quarters of the run ago by more
    /// than [`GROWING`] of what was turned over meanwhile, and by more than [`DOUBTFUL`] of all.
    #[must_use]
    pub fn grows(&self) -> bool {
        let [since, _] = self.since;
        let [work, losses, ..] = since.entries;
        let meanwhile = turnover(
            self.work - work,
            self.losses - losses,
            since.largest_stored_change,
        );
        let least = (GROWING * meanwhile).max(DOUBTFUL * self.turnover());
        // With a single output time nothing has been seen to grow.
        since.time > 0.0 && since.largest_growth > least
    }

    /// Returns the relative residual of the run: the largest residual at any output time over the
    /// [turnover](Self::turnover), or, if that is larger and the residual does not [grow](Self::grows), over
    /// a thousand (1 / [`DOUBTFUL`]) times the admissible residual. Where all of them are rounding (a wedge
    /// at rest), it is 0.
    #[must_use]
    pub fn relative_residual(&self) -> f64 {
        let rounding = ROUNDING * (self.stored_at_start + self.largest_stored_change);
        if self.largest_residual <= rounding {
            return 0.0;
        }
        let least = if self.grows() { 0.0 } else { floor(self.admissible) };
        over(self.largest_residual, self.turnover().max(least))
    }

    /// Returns the energy (J) by which a loss must be below zero to be no error of the integration: the
    /// largest residual, and a millionth of what happened.
    #[must_use]
    pub fn resolution(&self) -> f64 {
        self.largest_residual.max(1e-6 * self.turnover())
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
            admissible: 0.0,
            exchanged: 0.0,
        }
    }

    #[test]
    fn issue_047_a_residual_is_judged_by_what_one_step_may_err() {
        let mut balance = EnergyBalance::new(1e6);
        // A blow at the start of a car that rolls: 50 J of 1000 J, where one step may err by 60 J.
        let mut blow = Entries {
            admissible: 60.0,
            exchanged: 0.0,
            ..entries(0.0, 1000.0, -950.0)
        };
        balance.note(0.1, &blow);
        assert_eq!(balance.verdict(), Verdict::Closed);
        assert!((balance.relative_residual() - 50.0 / 60.0 * 1e-3).abs() < 1e-15);
        assert_eq!(blow.relative_residual(), balance.relative_residual());
        // With a tolerance of a hundredth it is none of the integrator's.
        blow.admissible = 0.6;
        let mut exact = EnergyBalance::new(1e6);
        exact.note(0.1, &blow);
        assert_eq!(exact.verdict(), Verdict::Failed);
    }

    #[test]
    fn issue_047_a_residual_that_goes_on_growing_has_no_floor() {
        // A blow of 50 J, then losses of 1000 J a second, of which a share comes from nowhere.
        let created = |share: f64| {
            let mut balance = EnergyBalance::new(1e6);
            for row in 0..=400 {
                let time = f64::from(row) * 0.01;
                let blow = if row > 0 { 50.0 } else { 0.0 };
                let own = Entries {
                    admissible: 600.0,
                    exchanged: 0.0,
                    ..entries(0.0, 1000.0 * time, -1000.0 * (1.0 - share) * time - blow)
                };
                balance.note(time, &own);
            }
            balance
        };
        assert_eq!(created(0.0).verdict(), Verdict::Closed);
        assert_eq!(created(0.04).verdict(), Verdict::Closed);
        let caught = created(0.06);
        assert_eq!(caught.verdict(), Verdict::Failed, "{caught:?}");
        // As it would be without a floor.
        assert!((caught.relative_residual() - 190.0 / 4000.0).abs() < 1e-9);
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
