//! `wedgelab regime`: the regimes of the assessment of freight cars, and a car in one of them.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use quantity::nearest;
use study::assessment::conditions;
use study::car::limits::LimitSet;
use study::car::regime::Regime;

use super::assess::{Common, assess};
use super::run::is_built_in;
use crate::failure::{Failure, Message};

/// Run a car in one regime of the assessment of freight cars, over speeds
///
/// Without arguments it lists the built-in regimes, conditions and limits. With a regime and a car it runs
/// the car at each speed, as `wedgelab assess` does. Tracks and limits are quoted from memory of AAR M-1001,
/// chapter XI: check them against your edition.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab regime
  wedgelab regime twist_and_roll my_car.toml --speeds \"10 mph..70 mph\" --steps 13
  wedgelab regime hunting car_hunting_roller_empty --conditions new rise_0.75
  wedgelab regime --show twist_and_roll > my_regime.toml     a regime to change, and to run by its file's name
  wedgelab regime --show aar_chapter_xi > my_limits.toml     limits to change, for --limits
  wedgelab regime --show conditions > my_conditions.toml     conditions to change, for --conditions")]
pub struct Arguments {
    /// Regime by name, or a file of your own
    regime: Option<String>,
    /// Case file of a car, or the name of a built-in case
    #[arg(requires = "regime")]
    car: Option<PathBuf>,
    /// Print a regime, a set of limits or the conditions as a file
    #[arg(long, value_name = "NAME", conflicts_with_all = ["regime", "car"])]
    show: Option<String>,
    #[command(flatten)]
    common: Common,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    if let Some(name) = &arguments.show {
        let text = text(name)?;
        io::stdout().lock().write_all(text.as_bytes())?;
        return Ok(ExitCode::SUCCESS);
    }
    if let Some(case) = arguments
        .regime
        .as_ref()
        .filter(|own| is_built_in(Path::new(own)))
    {
        let regime = arguments
            .car
            .as_deref()
            .and_then(Path::to_str)
            .unwrap_or("REGIME");
        let help = format!("`wedgelab regime {regime} {case}`; `wedgelab regime` lists the regimes");
        return Err(Message::new(format!("{case} is a case; the regime is named before it"), help).into());
    }
    match (&arguments.regime, &arguments.car) {
        (Some(regime), Some(car)) => {
            let stem = Path::new(regime).file_stem().and_then(|stem| stem.to_str());
            let ending = stem.unwrap_or("regime").to_owned();
            assess(car, std::slice::from_ref(regime), &arguments.common, &ending)
        }
        (Some(regime), None) => {
            let known = Regime::named_or_read(regime)?;
            let message = format!("which car shall run in the regime {}?", known.name);
            let help = format!("`wedgelab regime {regime} car_tangent_loaded`, or a case file of your own");
            Err(Message::new(message, help).into())
        }
        (None, _) => {
            list()?;
            Ok(ExitCode::SUCCESS)
        }
    }
}

/// Returns the file of what is built in under a name.
fn text(name: &str) -> Result<&'static str, Message> {
    let regimes = Regime::all()
        .iter()
        .map(|own| (own.name.as_str(), own.text.as_str()));
    let limits = LimitSet::built_in()
        .iter()
        .map(|own| (own.name.as_str(), own.text.as_str()));
    let all: Vec<(&str, &str)> = regimes
        .chain(limits)
        .chain([("conditions", conditions::BUILT_IN)])
        .collect();
    if let Some((_, text)) = all.iter().find(|(own, _)| *own == name) {
        return Ok(text);
    }
    let help = match nearest(name, all.iter().map(|(own, _)| *own)) {
        Some(near) => format!("did you mean {near}?"),
        None => "`wedgelab regime` lists what is built in".to_owned(),
    };
    Err(Message::new(
        format!("nothing built in is called \"{name}\""),
        help,
    ))
}

fn list() -> io::Result<()> {
    let mut out = io::stdout().lock();
    writeln!(out, "Regimes")?;
    for own in Regime::all() {
        let speeds = match own.speeds.as_slice() {
            [first, .., last] => format!("{first} to {last}"),
            [only] => only.to_string(),
            [] => String::new(),
        };
        let lading = own.lading.as_deref().unwrap_or("any lading");
        writeln!(out, "  {:<20} {} ({lading}, {speeds})", own.name, own.title)?;
    }
    writeln!(out, "\nConditions")?;
    for own in conditions::Condition::all() {
        writeln!(out, "  {:<20} {}", own.name, own.title)?;
    }
    writeln!(out, "\nLimits")?;
    for own in LimitSet::built_in() {
        writeln!(out, "  {:<20} {}; {}", own.name, own.title, own.source)?;
    }
    writeln!(
        out,
        "\n`wedgelab regime NAME CAR` runs a car in one of them, `wedgelab assess CAR` in all; \
         `wedgelab regime --show NAME` prints any of these as a file to change."
    )
}
