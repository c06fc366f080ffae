//! Events: changes of discrete states.

use std::ops::Range;

use serde::{Deserialize, Serialize};

/// A discrete state changed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// Time of the change.
    pub time: f64,
    /// Index of the discrete state.
    pub index: usize,
    /// Value before the change.
    pub from: u8,
    /// Value after the change.
    pub to: u8,
}

/// Discrete states whose event functions are evaluated together and do not depend on those of other groups.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EventGroup {
    /// Indices of the discrete states.
    pub discrete_states: Range<usize>,
    /// Indices of their event variables among those of all groups, see [`crate::Problem::event_variables`].
    pub variables: Range<usize>,
    /// Indices of the states x on which the event variables depend.
    pub states: Vec<Range<usize>>,
}
