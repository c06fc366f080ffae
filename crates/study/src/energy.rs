//! The verdict of the energy ledger on a run, in words: the same for runs of wedges, trucks, cars,
//! half-trucks and wheelsets, studies and fits.
//!
//! The measure and its limits are those of [`mechanics::energy_balance`].

use mechanics::energy_balance::{DOUBTFUL, EnergyBalance, FAILED, Verdict};
use quantity::SixDigits;

/// The beginning of warnings about the energy ledger.
const BEGINNING: &str = "the energy ledger does not close";

/// Returns those of a run's warnings that are about its energy ledger.
pub fn among(warnings: &[String]) -> impl Iterator<Item = &str> {
    let own = warnings.iter().map(String::as_str);
    own.filter(|warning| warning.starts_with(BEGINNING))
}

/// Returns the warning about a ledger that does not close ([`DOUBTFUL`]): what, how much, where, and what to
/// do. Returns `None` if it closes.
#[must_use]
pub fn warning(balance: &EnergyBalance, what_to_do: &str) -> Option<String> {
    let limit = match balance.verdict() {
        Verdict::Closed => return None,
        Verdict::Doubtful => DOUBTFUL,
        Verdict::Failed => FAILED,
    };
    Some(format!(
        "{BEGINNING}: its relative residual is {:.2e} (above {limit:e}), the largest at {} s; {what_to_do}",
        balance.relative_residual(),
        SixDigits(balance.largest_residual_time)
    ))
}

/// Returns the reason why a run has failed by its energy ledger ([`FAILED`]); `None` if it has not.
#[must_use]
pub fn failure(balance: &EnergyBalance, what_to_do: &str) -> Option<String> {
    warning(balance, what_to_do).filter(|_| balance.verdict() == Verdict::Failed)
}

/// Advice on a wedge's ledger that does not close.
pub const WHAT_TO_DO: &str = "lower simulation.relative_tolerance, and look for values out of all proportion";

/// The same with a method that damps the vibrations of contacts.
pub const WHAT_TO_DO_WHERE_DAMPED: &str = "the method damps the vibrations of contacts, whose energy is \
                                           lost to the ledger: lower simulation.relative_tolerance, or take \
                                           the default method where they carry a part of the force";

/// Advice on a half-truck's ledger that does not close.
pub const WHAT_TO_DO_WITH_FILES: &str =
    "lower the relative tolerance, and look for values out of all proportion in the files";
