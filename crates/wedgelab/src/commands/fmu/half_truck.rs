//! Half-trucks that are exported: run files and built-in runs.

use std::path::Path;

use clap::Args;
use fmi::half_truck::HalfTruck;
use study::half_truck::files::Settings;

use crate::commands::nucars::files::Instead;
use crate::commands::nucars::run::{RunToMake, YawArgument, built_in, check_built_in, choices, read_run};
use crate::failure::{Failure, Message};

/// Endings of files of NUCARS.
const ENDINGS: [&str; 4] = ["run", "sys", "inp", "dat"];

/// Options of a half-truck besides its files.
#[derive(Debug, Args)]
pub struct Choice {
    #[command(flatten)]
    instead: Instead,
    /// Means by which a half-truck's bolster reaches its yaw
    #[arg(long, value_name = "HOW")]
    yaw: Option<YawArgument>,
    /// A choice where the files of a half-truck leave one open, as in `wedgelab nucars run`
    #[arg(long, value_name = "NAME=VALUE")]
    option: Vec<String>,
}

impl Choice {
    /// Returns the first option that is given, as typed.
    pub fn given(&self) -> Option<String> {
        let typed = self.instead.files().given().into_iter();
        typed
            .chain(self.yaw.map(|_| "--yaw".to_owned()))
            .chain(self.option.iter().map(|option| format!("--option {option}")))
            .next()
    }

    /// Returns the half-truck of a run file or of a built-in run, with the values of `set` over it; none if
    /// neither is named.
    pub fn half_truck(&self, named: &Path, set: &[String]) -> Result<Option<HalfTruck>, Failure> {
        let ending = named.extension().and_then(|ending| ending.to_str());
        let of_nucars =
            ending.is_some_and(|ending| ENDINGS.iter().any(|own| own.eq_ignore_ascii_case(ending)));
        let entry = built_in(named)?;
        if entry.is_none() && !of_nucars {
            return Ok(None);
        }
        let settings = Settings {
            choices: choices(self.yaw, &self.option)?,
            set: set.to_vec(),
            ..Settings::default()
        };
        let Some(entry) = entry else {
            let RunToMake { path, files, again } = read_run(named, &self.instead.files())?;
            let made = HalfTruck::of_files(files.texts(), &settings).map_err(|error| {
                Message::new(
                    format!("{} cannot be exported: {error}", path.display()),
                    format!("`{again}` tells what is doubtful about the files"),
                )
            })?;
            return Ok(Some(made));
        };
        check_built_in(entry, &self.instead, self.yaw)?;
        let made = HalfTruck::built_in(&entry.name(), &settings);
        Ok(Some(made.map_err(|error| {
            Message::new(error.to_string(), "choose another option or value")
        })?))
    }
}
