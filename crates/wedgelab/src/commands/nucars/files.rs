//! Files instead of those that runs name, as options.

use std::path::PathBuf;

use clap::Args;
use nucars::file_sets;

/// Files instead of those that runs name.
#[derive(Debug, Default, Args)]
pub struct Instead {
    /// This system file instead of the one that runs name; data files are checked against it
    #[arg(long, value_name = "FILE")]
    system: Option<PathBuf>,
    /// This data file instead of the one that runs name
    #[arg(long, value_name = "FILE")]
    data: Option<PathBuf>,
    /// This input file instead of the one that runs name; system files are checked with it
    #[arg(long, value_name = "FILE")]
    input: Option<PathBuf>,
}

impl Instead {
    /// Returns the files as the reader takes them.
    pub fn files(&self) -> file_sets::Instead {
        file_sets::Instead {
            system: self.system.clone(),
            data: self.data.clone(),
            input: self.input.clone(),
        }
    }
}
