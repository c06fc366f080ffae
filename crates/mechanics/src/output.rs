//! The output table: one description a column, from which every writer takes its names, units and texts.

use std::borrow::Cow;

use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};

/// The contents of a column of a result. Values are kept in SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// Its name without the unit, such as `wedge_x`.
    pub name: String,
    /// The kind of quantity.
    pub kind: Kind,
    /// The axes in which components are given.
    pub frame: Cow<'static, str>,
    /// The point that it refers to (of moments, displacements).
    pub reference: Cow<'static, str>,
    /// Its meaning, in a few words.
    pub text: String,
}

impl Column {
    /// Returns a column without a point of reference; `frame` names the axes of its components.
    #[must_use]
    pub fn new(name: impl Into<String>, kind: Kind, frame: &'static str, text: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            kind,
            frame: Cow::Borrowed(frame),
            reference: Cow::Borrowed(""),
            text: text.into(),
        }
    }

    /// Returns the column's name with its unit, as in files: `wedge_x_in`.
    #[must_use]
    pub fn full_name(&self, units: Units) -> String {
        let suffix = self.kind.suffix(units);
        if suffix.is_empty() {
            self.name.clone()
        } else {
            format!("{}_{suffix}", self.name)
        }
    }
}
