//! The phases of an instance, and the calls that each admits.

use serde::{Deserialize, Serialize};

use super::Instance;
use crate::Error;

/// The states of the standard's state machines (those of both versions and kinds of interface together).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Phase {
    /// Made, or reset.
    Instantiated,
    /// Between the begin and the end of the initialization.
    Initialization,
    /// Events are handled (model exchange).
    Event,
    /// The importer integrates (model exchange).
    Continuous,
    /// Ready for the next step (co-simulation).
    Step,
    /// The simulation has ended.
    Terminated,
    /// A step has failed: a saved state can be restored, or the instance reset.
    Failed,
}

impl Phase {
    /// Returns its name, as the standard has it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "instantiated",
            Self::Initialization => "initialization mode",
            Self::Event => "event mode",
            Self::Continuous => "continuous-time mode",
            Self::Step => "step mode",
            Self::Terminated => "terminated",
            Self::Failed => "failed",
        }
    }

    /// Before the element has started.
    pub(super) fn is_before_start(self) -> bool {
        matches!(self, Self::Instantiated | Self::Initialization)
    }
}

impl Instance {
    /// Checks whether a call is in order.
    pub(super) fn require(&self, what: &str, phases: &[Phase]) -> Result<(), Error> {
        if phases.contains(&self.phase) {
            return Ok(());
        }
        let allowed: Vec<&str> = phases.iter().map(|phase| phase.name()).collect();
        let kind = match self.interface {
            crate::element::Interface::ModelExchange => "model exchange",
            crate::element::Interface::CoSimulation => "co-simulation",
        };
        Err(Error::new(format!(
            "out of order: {what} while the instance ({kind}) is in the state `{}`; this is allowed in: {}",
            self.phase.name(),
            allowed.join(", ")
        )))
    }
}
