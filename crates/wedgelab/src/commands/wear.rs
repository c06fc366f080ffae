//! `wedgelab wear`: the wear of a wedge's faces over many cycles.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use quantity::{Kind, Quantity};
use report::drawn::Drawn;
use report::wear_files::{self as files, Given, NAMES};
use study::wear::archard::Archard;
use study::wear::energy::WearByEnergy;
use study::wear::{WearError, WearHistory, WearLaw, WearPlan, WearStop, advance};

use super::run::read;
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;

/// Wear of a wedge's faces over many cycles
///
/// Runs a case of a single wedge, computes the wear of its last whole cycle at each contact point by a law of
/// wear, extrapolates the depths of the wedge's faces over many cycles, and runs the worn wedge again, step
/// by step. Writes wear.csv (volumes, losses, forces, rise over the cycles), wear_points.csv (depth and
/// pressure of every point at every step), column_wear.csv and slope_wear.csv (for wedge_wear), worn.toml
/// (the worn case), wear.svg, wear.png and wear.txt (the result in words). With --counterface column and
/// pocket wear too, where the wedge slides over them: column_counterface_wear.csv, slope_counterface_wear.csv
/// (for counterface_wear).
///
/// The laws' default numbers are guesses, known to an order of magnitude at best.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab wear vdrun_toe_0_psi_0 --cycles 100000
  wedgelab wear my.toml --cycles 1e6 --steps 20 --coefficient 3e-5 --hardness '2000 MPa' --set \
'column_face.grid=[5, 5]'
  wedgelab wear my.toml --cycles 1e6 --law energy --coefficient 2e-14
  wedgelab wear my.toml --cycles 1e6 --counterface 0.5 --set 'column_face.grid=[5, 5]'")]
pub struct Arguments {
    /// Case file of a single wedge, or the name of a built-in case
    case: PathBuf,
    /// Cycles of the bolster
    #[arg(long, value_name = "N", value_parser = cycles, allow_hyphen_values = true)]
    cycles: f64,
    /// Least number of steps; steps that would wear a point by more than half of its penetration are divided
    #[arg(
        long,
        value_name = "M",
        default_value_t = 10,
        value_parser = clap::value_parser!(u32).range(1..=10_000),
    )]
    steps: u32,
    /// Largest number of steps
    #[arg(
        long,
        value_name = "M",
        default_value_t = 200,
        value_parser = clap::value_parser!(u32).range(1..=10_000),
    )]
    most_steps: u32,
    /// Law of wear
    #[arg(long, value_enum, default_value_t = Law::Archard)]
    law: Law,
    /// Archard's K, dimensionless [default: 1e-4, a guess]; for wear by energy the volume per energy, m³/J
    /// [default: 1e-13, a guess]
    #[arg(long, value_name = "NUMBER", value_parser = coefficient, allow_hyphen_values = true)]
    coefficient: Option<f64>,
    /// Hardness of the softer partner in Archard's law [default: 2450 MPa, a guess]
    #[arg(long, value_name = "PRESSURE", value_parser = hardness)]
    hardness: Option<Quantity>,
    /// Wear of column and pocket over that of the wedge's faces: the ratio of their coefficients of wear
    #[arg(
        long,
        value_name = "RATIO",
        value_parser = ratio,
        allow_hyphen_values = true,
        default_value_t = 0.0,
    )]
    counterface: f64,
    /// Set one value over those of the case; VALUE is TOML (quotes around text may be left out)
    #[arg(long, value_name = "PATH.KEY=VALUE")]
    set: Vec<String>,
    /// Folder to write into [default: NAME_wear]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// The laws, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Law {
    /// By load and path of sliding
    Archard,
    /// By energy lost in friction
    Energy,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let case = read(&arguments.case, &arguments.set)?;
    let plan = WearPlan {
        cycles: arguments.cycles,
        steps: arguments.steps,
        most_steps: arguments.most_steps.max(arguments.steps),
        law: law(arguments)?,
        counterface: arguments.counterface,
    };
    let given = Given {
        coefficient: arguments.coefficient.is_some(),
        hardness: arguments.hardness.is_some(),
    };
    let path = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}_wear", case.name)));
    let counterfaces: &[&str] = match plan.counterface > 0.0 {
        true => &files::COUNTERFACES,
        false => &[],
    };
    let names = [&NAMES[..], counterfaces].concat();
    let folder = folders::check(path, &names, arguments.force)?;
    let progress = Progress::new(1, arguments.quiet);
    let first =
        "stopping: the steps that were computed are written (once more: ends at once and writes nothing)";
    interrupt::stops(first, "nothing was written");
    let mut reached = progress.of_run(1.0);
    let history = advance(&case, &plan, |done, _| {
        reached(done);
        interrupt::go_on()
    });
    progress.finish();
    let history = history.map_err(|stop| nothing(&case.name, stop))?;
    let words = files::words(&history, &plan, given);
    let figure = Drawn::of(&files::figure(&history))?;
    folder.write(|all| {
        all.add(files::COURSE, |out| files::write_course(&history, out))?;
        all.add(files::POINTS, |out| files::write_points(&history, out))?;
        for (face, name) in files::DEPTHS.into_iter().enumerate() {
            all.add(name, |out| files::write_depths(&history, face, out))?;
        }
        for (face, name) in counterfaces.iter().enumerate() {
            all.add(name, |out| files::write_counterface(&history, face, out))?;
        }
        all.add(files::CASE, |out| {
            out.write_all(history.case.to_toml_embedded().as_bytes())
        })?;
        figure.add(all, files::FIGURE, files::PICTURE)?;
        all.add(files::WORDS, |out| out.write_all(words.as_bytes()))
    })?;
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "{words}\nWritten into {}: {}.",
        folder.path().display(),
        names.join(", ")
    )?;
    stopped(&history, &plan)
}

/// Returns the law of wear with its numbers.
fn law(arguments: &Arguments) -> Result<WearLaw, Failure> {
    Ok(match arguments.law {
        Law::Archard => WearLaw::Archard(Archard {
            coefficient: arguments.coefficient.unwrap_or(Archard::COEFFICIENT),
            hardness: arguments
                .hardness
                .as_ref()
                .map_or(Archard::HARDNESS, Quantity::to_si),
        }),
        Law::Energy => {
            if arguments.hardness.is_some() {
                let message = "--hardness is of no effect with --law energy";
                let advice = "leave it out: the coefficient holds it, K / (friction * hardness)";
                return Err(Message::new(message, advice).into());
            }
            WearLaw::Energy(WearByEnergy {
                coefficient: arguments.coefficient.unwrap_or(WearByEnergy::COEFFICIENT),
            })
        }
    })
}

/// Returns the reason why there is not even a first state.
fn nothing(name: &str, stop: WearStop) -> Failure {
    match stop {
        WearStop::Interrupted(_) => {
            let message = format!("the wear of {name} was interrupted in its first run");
            Failure::Interrupted(Message::new(message, "nothing is written").into())
        }
        WearStop::Error(error) => {
            let advice = advice(&error);
            Message::new(format!("the wear of {name} is not computed: {error}"), advice).into()
        }
    }
}

fn advice(error: &WearError) -> &'static str {
    match error {
        WearError::NoCycle => {
            "give bolster.vertical one sine or triangle, and simulation.duration one and a half of its \
             periods"
        }
        WearError::TooManySteps { .. } => {
            "give fewer --cycles or a smaller --coefficient, or more --most-steps"
        }
        WearError::Run(_) | WearError::Failed(_) | WearError::Case(_) => {
            "`wedgelab run` with the same case shows more"
        }
    }
}

/// Returns the exit of the command when its files are written.
fn stopped(history: &WearHistory, plan: &WearPlan) -> Result<ExitCode, Failure> {
    let Some(stop) = &history.stopped else {
        return Ok(ExitCode::SUCCESS);
    };
    let cycles = history.states.last().map_or(0.0, |state| state.cycles);
    let (reason, tried) = match stop {
        WearStop::Interrupted(reason) => (reason.clone(), ""),
        WearStop::Error(error) => (error.to_string(), advice(error)),
    };
    let message = format!("wear stopped after {cycles} of {} cycles: {reason}", plan.cycles);
    let kept = "what was computed until then is written; go on from worn.toml";
    let advice = [kept, tried].join(if tried.is_empty() { "" } else { "; " });
    let message = Message::new(message, advice).into();
    Err(match stop {
        WearStop::Interrupted(_) => Failure::Interrupted(message),
        WearStop::Error(_) => Failure::Failed(message),
    })
}

fn cycles(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if (1.0..=1e12).contains(&value) => Ok(value),
        _ => Err("a number of cycles from 1 to 1e12 is expected, for example 100000 or 1e5".to_owned()),
    }
}

fn coefficient(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value > 0.0 && value <= 1.0 => Ok(value),
        _ => Err(
            "a number above 0 up to 1 is expected, for example 1e-4 (Archard's K) or 1e-13 (by energy, m³/J)"
                .to_owned(),
        ),
    }
}

fn ratio(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if (0.0..=1e3).contains(&value) => Ok(value),
        _ => Err(
            "a ratio from 0 (not worn) to 1000 is expected, for example 1 where both wear alike".to_owned(),
        ),
    }
}

fn hardness(text: &str) -> Result<Quantity, String> {
    let quantity = Quantity::parse_as(text, Kind::Pressure).map_err(|error| error.to_string())?;
    if (1e6..=1e12).contains(&quantity.to_si()) {
        Ok(quantity)
    } else {
        Err("a hardness from 1 MPa to 1000000 MPa is expected, for example \"2450 MPa\"".to_owned())
    }
}
