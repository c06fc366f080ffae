//! The option `--units`.

use clap::ValueEnum;
use quantity::System as Units;

/// Units of results.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum OutputUnits {
    /// US customary units
    Us,
    /// SI units
    Si,
}

impl OutputUnits {
    /// Returns the system of units.
    pub fn system(self) -> Units {
        match self {
            Self::Us => Units::Us,
            Self::Si => Units::Si,
        }
    }
}
