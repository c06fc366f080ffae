//! Right-hand sides of several systems at once.

use integrate::{Call, Together};

use super::System;

/// Evaluates the right-hand sides of systems of one kind at once.
#[derive(Debug)]
pub struct Abreast;

impl Abreast {
    /// Places for systems like this one; none: such systems cannot be evaluated at once.
    #[must_use]
    pub fn of(_: &System) -> Option<Self> {
        Some(Self)
    }

    /// Whether a system may sit beside those for which this was made.
    #[must_use]
    pub fn admits(&self, _: &System) -> bool {
        true
    }
}

impl Together for Abreast {
    type Problem = System;

    fn places(&self) -> usize {
        4
    }

    fn put(&mut self, _: usize, _: &System) {}

    fn derivatives(&mut self, calls: &mut [Option<Call<'_, System>>]) {
        for call in calls.iter_mut().flatten() {
            call.evaluate();
        }
    }
}
