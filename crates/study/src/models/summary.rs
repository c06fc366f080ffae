//! The summary of a run of any model.

use serde::de::DeserializeOwned;
use serde::{Serialize, Serializer};

use super::AnySummary;
use crate::summary::RunSummary;

/// The summary of a run of one model.
pub trait ModelSummary: RunSummary + Clone + Serialize + DeserializeOwned + Into<AnySummary> {
    /// Returns it from the summary of a run of any model; `None` of another one.
    fn of(any: &AnySummary) -> Option<&Self>;

    /// Reads it from JSON.
    ///
    /// # Errors
    /// It is not what its schema says.
    fn of_json(json: &[u8]) -> serde_json::Result<AnySummary> {
        serde_json::from_slice::<Self>(json).map(Into::into)
    }
}

impl AnySummary {
    /// Returns the part that the summaries of all models have.
    #[must_use]
    pub fn shared(&self) -> &dyn RunSummary {
        each_summary!(self, own => &**own)
    }

    /// Writes the summary as `summary.json` has it: without the name of its variant.
    ///
    /// # Errors
    /// The serializer's.
    pub fn serialize_content<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        each_summary!(self, own => own.serialize(serializer))
    }
}
