//! Checks of the members of saved states.

use crate::error::SetupError;
use crate::limits::MAXIMUM_COUNT;

/// Checks that a member is positive and finite.
pub(crate) fn check_positive(name: &'static str, value: f64) -> Result<(), SetupError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(SetupError::Damaged { name, value })
}

/// Checks that a member is finite and not negative.
pub(crate) fn check_not_negative(name: &'static str, value: f64) -> Result<(), SetupError> {
    if value >= 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(SetupError::Damaged { name, value })
}

/// Checks that a member is finite.
pub(crate) fn check_finite(name: &'static str, value: f64) -> Result<(), SetupError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(SetupError::Damaged { name, value })
}

/// Checks that a counter is one that a run can reach.
pub(crate) fn check_count(name: &'static str, found: u64) -> Result<(), SetupError> {
    if found <= MAXIMUM_COUNT {
        return Ok(());
    }
    Err(SetupError::Counter { name, found })
}

/// Returns the first of the values that is not finite.
pub(crate) fn first_not_finite(values: &[f64]) -> Option<f64> {
    values.iter().copied().find(|value| !value.is_finite())
}
