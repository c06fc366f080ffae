//! The report on the three-piece truck: its rigs against closed forms, against the massless wedge, and
//! against independent calculations, and how far its answers hang on the stiffness of contacts and bristles.
//!
//! Every number is computed from runs; nothing is stored. [`shown`] and [`variants`] say which runs are
//! needed.

mod check;
mod checks;
mod massless;
mod rigs;
mod sensitivity;

use std::io::{self, Write};

use report::summary::write_json;
use serde::Serialize;

pub use check::{Basis, Check};
pub use checks::checks;
pub use rigs::{Rigs, Variant, shown, variants};
pub use sensitivity::{Sensitivity, sensitivities};

/// The file of the numbers.
pub const FILE_NAME: &str = "truck.json";
/// Its schema's name and version.
pub const SCHEMA: &str = "wedgelab.truck_checks/1";

/// All that is said.
#[derive(Clone, Debug, Serialize)]
pub struct TruckFindings {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// The value found against the expected one.
    pub checks: Vec<Check>,
    /// The effect of the stiffness of contacts and bristles.
    pub sensitivities: Vec<Sensitivity>,
}

impl TruckFindings {
    /// Returns the findings of these runs. A check whose runs are missing is left out.
    #[must_use]
    pub fn of(rigs: &Rigs) -> Self {
        Self {
            schema: SCHEMA,
            checks: checks(rigs),
            sensitivities: sensitivities(rigs),
        }
    }

    /// Writes them as JSON.
    ///
    /// # Errors
    /// The writer's.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        write_json(self, out)
    }
}
