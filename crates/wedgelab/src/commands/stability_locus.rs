//! `wedgelab stability --vary`: the root locus of a car over any one parameter of its case.

use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use miette::Diagnostic;
use quantity::{Kind, Number};
use report::drawn::Drawn;
use report::locus_files;
use report::terminal::TerminalTable;
use study::car::CarCase;
use study::case::CaseError;
use study::locus::{Locus, LocusError, Vary, VaryError, locus};
use study::models::AnyCase;

use super::run::is_built_in;
use super::stability::speed;
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;

/// The options of the root locus over a parameter.
#[derive(Debug, Args)]
pub struct VaryArguments {
    /// Only vary one number of the case at one speed, and write locus.csv, locus.svg and locus.png
    #[arg(long, value_name = "KEY=FROM..TO", conflicts_with_all = ["nonlinear", "steps"])]
    vary: Option<String>,
    /// Number of values, at least 2
    #[arg(
        long,
        value_name = "N",
        default_value_t = 6,
        value_parser = clap::value_parser!(u32).range(2..=1000),
        requires = "vary",
    )]
    vary_steps: u32,
    /// The speed [default: the middle of --speeds]
    #[arg(long, value_name = "SPEED", value_parser = speed, requires = "vary")]
    vary_speed: Option<f64>,
}

/// What the command around it was told.
#[derive(Clone, Copy, Debug)]
pub struct Around<'a> {
    /// The case as named.
    pub path: &'a Path,
    /// Values over those of the case.
    pub set: &'a [String],
    /// The lowest and the highest speed, m/s.
    pub speeds: [f64; 2],
    /// The folder to write into; none: one named after the case.
    pub out: Option<&'a PathBuf>,
    /// Whether existing results are overwritten.
    pub force: bool,
    /// Whether there is no progress.
    pub quiet: bool,
}

impl VaryArguments {
    /// Returns whether a number is varied.
    pub fn is_given(&self) -> bool {
        self.vary.is_some()
    }

    /// Executes the command if a parameter is varied; none if not.
    pub fn execute(&self, case: &CarCase, around: Around<'_>) -> Option<Result<ExitCode, Failure>> {
        let text = self.vary.as_ref()?;
        Some(self.varied(text, case, around))
    }

    fn varied(&self, text: &str, case: &CarCase, around: Around<'_>) -> Result<ExitCode, Failure> {
        let refused = |error: VaryError| Message::new(format!("--vary: {error}"), error.remedy());
        let vary = Vary::parse(text, self.vary_steps).map_err(refused)?;
        vary.check(case).map_err(refused)?;
        let [from, to] = around.speeds;
        let speed = self.vary_speed.unwrap_or(0.5 * (from + to));
        let usual = || PathBuf::from(format!("{}_locus", case.name));
        let path = around.out.cloned().unwrap_or_else(usual);
        let folder = folders::check(path, &locus_files::NAMES, around.force)?;
        let progress = Progress::new(1, around.quiet);
        interrupt::stops_run();
        let mut reached = progress.of_run(1.0);
        let read = |set: &[String]| read(around, set, case);
        let found = locus(&vary, speed, read, |share| {
            reached(share);
            match interrupt::wanted() {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        progress.finish();
        let found = found.map_err(failure)?;
        let units = case.simulation.output_units;
        let figure = Drawn::of(&locus_files::figure(&case.name, &found, units))?;
        folder.write(|files| {
            files.add(locus_files::TABLE, |out| locus_files::write_table(&found, out))?;
            figure.add(files, locus_files::FIGURE, locus_files::PICTURE)
        })?;
        let mut out = io::stdout().lock();
        table(&found).write(&mut out)?;
        if found.is_flat() {
            writeln!(
                out,
                "\n{} changes no vibration: what only limits friction counts neither where it sticks nor \
                 where there is none.",
                found.key
            )?;
        }
        writeln!(
            out,
            "\nThe vibration that grows most, of 0.05 to 30 Hz, at {:.1} {} on straight track without \
             irregularities; positive growth is hunting.\n\nWritten into {}: {}.",
            speed * Kind::TravelSpeed.from_si(units),
            Kind::TravelSpeed.label(units),
            folder.path().display(),
            locus_files::NAMES.join(", ")
        )?;
        match found.complete {
            true => Ok(ExitCode::SUCCESS),
            false => {
                let message = "interrupted: the values that were computed are written".to_owned();
                Err(Failure::Interrupted(Message::new(message, "").into()))
            }
        }
    }
}

/// Reads the case again with a value set.
fn read(around: Around<'_>, set: &[String], case: &CarCase) -> Result<CarCase, CaseError> {
    let all = [around.set, set].concat();
    let built_in = match around.path.to_str().filter(|_| is_built_in(around.path)) {
        Some(name) => AnyCase::built_in(name, &all)?,
        None => None,
    };
    let any = match built_in {
        Some(own) => own,
        None => AnyCase::read(around.path, &all)?,
    };
    // Numbers change no model.
    Ok(any.car().map_or(case, |own| &**own).clone())
}

fn failure(error: LocusError) -> Failure {
    let message = error.to_string();
    let advice = match error {
        LocusError::Case { error, .. } => {
            let helps = error.problems().iter().filter_map(Diagnostic::help);
            let helps: Vec<String> = helps.map(|own| own.to_string()).collect();
            match error.problems() {
                [_] if !helps.is_empty() => helps.join("; "),
                [_] => "take other ends".to_owned(),
                several => {
                    let words: Vec<String> = several.iter().map(ToString::to_string).collect();
                    words.join("; ")
                }
            }
        }
        LocusError::Linearize { .. } => "take a narrower range, or another speed".to_owned(),
    };
    Message::new(message, advice).into()
}

/// Returns the vibration that grows most at each value, with friction stuck and absent.
fn table(found: &Locus) -> TerminalTable {
    let [stuck, absent] = found.branches.each_ref().map(|own| own.kind.words());
    let [stuck, absent] = [stuck, absent].map(|words| format!("{words}, growth"));
    let head = [
        (found.key.as_str(), found.unit.as_str()),
        (stuck.as_str(), "1/s"),
        ("frequency", "Hz"),
        (absent.as_str(), "1/s"),
        ("frequency", "Hz"),
    ];
    let mut table = TerminalTable::new(0, &head);
    for (number, value) in found.values.iter().enumerate() {
        let mut cells = vec![Number(report::csv::rounded(*value)).to_string()];
        for branch in &found.branches {
            let most = branch.most(number);
            cells.push(most.map_or("-".to_owned(), |own| format!("{:.3}", own.growth)));
            cells.push(most.map_or("-".to_owned(), |own| format!("{:.3}", own.frequency)));
        }
        table.row(cells);
    }
    table
}
