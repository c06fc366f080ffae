//! The state that an interrupted `wedgelab reproduce` leaves, and the command that continues it.

use std::path::{Path, PathBuf};

use study::case::Case;

use super::{Arguments, trucks};
use crate::failure::{Failure, Message, say};
use crate::interrupt;

/// The runs that are to be made, by name.
pub struct Planned {
    /// The folder with the folders of the runs.
    pub runs: PathBuf,
    out: PathBuf,
    only: Vec<String>,
    sensitivity: Option<u32>,
    force: bool,
    wedges: Vec<String>,
    trucks: Vec<String>,
}

impl Planned {
    /// Those of these cases, half-trucks and rigs of trucks.
    pub fn of(arguments: &Arguments, cases: &[Case], trucks: &[trucks::Planned], rigs: &[String]) -> Self {
        Self {
            runs: arguments.out.join("runs"),
            out: arguments.out.clone(),
            only: arguments.only.clone(),
            sensitivity: arguments.sensitivity,
            force: arguments.force,
            wedges: cases.iter().map(|case| case.name.clone()).collect(),
            trucks: trucks
                .iter()
                .map(|truck| truck.name().to_owned())
                .chain(rigs.iter().cloned())
                .collect(),
        }
    }

    fn count(&self) -> usize {
        self.wedges.len() + self.trucks.len()
    }

    /// Returns the message if all runs are there, and the report is not.
    pub fn without_report(&self) -> String {
        format!(
            "all {} runs are whole, in {}; the report and its figures are not written. \
             The same command with --force begins anew.",
            self.count(),
            self.runs.display()
        )
    }

    /// Tells what is missing and how to go on, when those runs of the wedge and of trucks are there
    /// for which true comes.
    pub fn interrupted(
        &self,
        wedges: impl Iterator<Item = bool>,
        trucks: impl Iterator<Item = bool>,
    ) -> Failure {
        let wedges = missing(&self.wedges, wedges);
        let trucks = missing(&self.trucks, trucks);
        let written = self.count() - wedges.len() - trucks.len();
        // Plain lines: a command that is broken for the width of a terminal cannot be copied.
        let mut advice = String::new();
        if !wedges.is_empty() {
            let force = if self.force { " --force" } else { "" };
            advice += &format!(
                "The missing runs of the wedge alone are computed by\n  \
                 wedgelab reproduce{}{force} --only {}\n",
                self.place(),
                wedges.join(" ")
            );
        }
        if !trucks.is_empty() {
            advice += &format!(
                "The missing runs of trucks are computed with all others only:\n  {}\n",
                trucks.join(" ")
            );
        }
        let only = match self.only.as_slice() {
            [] => String::new(),
            names => format!(" --only '{}'", names.join("' '")),
        };
        let sensitivity = self
            .sensitivity
            .map_or(String::new(), |points| format!(" --sensitivity {points}"));
        advice += &format!(
            "The report of all of them is written by this, which computes them anew:\n  \
             wedgelab reproduce{}{sensitivity} --force{only}",
            self.place()
        );
        say(&advice);
        let message = format!(
            "{}: {written} of {} runs are whole, in {}; the report is not written",
            interrupt::REASON,
            self.count(),
            self.runs.display()
        );
        Failure::Interrupted(Message::new(message, "the lines above say how to go on").into())
    }

    /// Returns the option for the folder, unless it is the usual one.
    fn place(&self) -> String {
        if self.out == Path::new(super::USUAL) {
            String::new()
        } else {
            format!(" --out {}", shown(&self.out))
        }
    }
}

/// Returns the names of the runs that are not written.
fn missing(names: &[String], written: impl Iterator<Item = bool>) -> Vec<&str> {
    let names = names.iter().zip(written).filter(|(_, written)| !written);
    names.map(|(name, _)| name.as_str()).collect()
}

/// Returns a path as a shell takes it.
fn shown(path: &Path) -> String {
    let text = path.display().to_string();
    let plain = |sign: char| sign.is_alphanumeric() || "/._-+=:,@".contains(sign);
    if text.chars().all(plain) {
        text
    } else {
        format!("'{}'", text.replace('\'', "'\\''"))
    }
}
