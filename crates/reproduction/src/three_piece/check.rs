//! A check of the report: a value found in runs against an expected one, with its basis.

use serde::Serialize;

/// The basis of an expected value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Basis {
    /// A formula for this truck.
    ClosedForm,
    /// The massless wedge in quasi-static sliding.
    MasslessWedge,
    /// A calculation of the same rigs in another program.
    IndependentCalculation,
}

impl Basis {
    /// All of them, in the order of the page.
    pub const ALL: [Self; 3] = [
        Self::ClosedForm,
        Self::MasslessWedge,
        Self::IndependentCalculation,
    ];

    /// Returns its heading.
    #[must_use]
    pub fn heading(self) -> &'static str {
        match self {
            Self::ClosedForm => "Against closed forms",
            Self::MasslessWedge => "Against the massless wedge",
            Self::IndependentCalculation => "Against an independent calculation of the rigs",
        }
    }
}

/// A number of the truck against what is expected of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// The compared model.
    pub what: String,
    /// The basis of the expectation.
    pub basis: Basis,
    /// The value from the runs.
    pub found: f64,
    /// The expected value, from and to; the same twice where it is one number.
    pub expected: [f64; 2],
    /// The unit of both.
    pub unit: &'static str,
    /// By how much more than expected was found, relative to that; zero within a range. In the unit of both
    /// where zero is expected.
    pub difference: f64,
    /// The most that counts as agreement, alike.
    pub margin: f64,
    /// True if they agree.
    pub agrees: bool,
    /// One sentence on it.
    pub remark: String,
}

/// Collects checks.
pub(super) struct Found {
    pub checks: Vec<Check>,
    pub basis: Basis,
}

impl Found {
    pub fn add(
        &mut self,
        what: impl Into<String>,
        found: Option<f64>,
        expected: impl Into<Option<[f64; 2]>>,
        (unit, margin): (&'static str, f64),
        remark: impl Into<String>,
    ) {
        let (Some(found), Some(expected)) = (found, expected.into()) else {
            return;
        };
        let [low, high] = expected;
        let nearest = found.clamp(low, high);
        let scale = if nearest == 0.0 { 1.0 } else { nearest.abs() };
        let difference = (found - nearest) / scale;
        self.checks.push(Check {
            what: what.into(),
            basis: self.basis,
            found,
            expected,
            unit,
            difference,
            margin,
            agrees: difference.abs() <= margin,
            remark: remark.into(),
        });
    }
}

/// Returns one number as a range.
pub(super) fn exactly(value: f64) -> [f64; 2] {
    [value; 2]
}
