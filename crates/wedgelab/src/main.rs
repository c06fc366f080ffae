//! The command line of Wedgelab.

mod adjust;
mod commands;
mod cost;
mod execute;
mod failure;
mod folders;
mod interrupt;
mod json;
mod progress;
mod saved;
mod select;
mod start;
mod units;

use std::io::Write;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use numerics::processor::{OldProcessor, check};

use commands::{
    assess, case, compare, completions, coupon, curves, energy, explore, fit, fmu, lock_up, man, nucars,
    plot, probability, quasi_static, regime, report as report_command, reproduce, rise, route, run,
    stability, study, tables, track, warp, wear, wheelrail,
};
use failure::Failure;

/// A laboratory for railway friction wedges, three-piece trucks and freight cars on track.
///
/// Wedgelab computes the friction wedge of a three-piece truck: a rigid body between side frame and bolster,
/// with unilateral contact, stick-slip friction and its control coil, as in Steets (2007); whole trucks with
/// four of them; and freight cars with two such trucks, whose wheels roll on track.
#[derive(Debug, Parser)]
#[command(
    name = "wedgelab",
    version,
    max_term_width = 100,
    after_help = "\
Begin with:
  wedgelab reproduce                 the thesis's twelve runs, into the folder reproduction/
  wedgelab case                      the built-in cases
  wedgelab case NAME > my.toml       a complete case file to change ...
  wedgelab run my.toml               ... and to run: a wedge, a truck, a car
  wedgelab energy NAME               where the energy of a cycle goes
  wedgelab warp                      warp of a whole truck with four wedges
  wedgelab tables TRUCK              nest and warp as tables for other programs, with their error
  wedgelab lock-up                   where a wedge locks up, over two of its parameters
  wedgelab stability CAR             vibrations of a whole car over speed
  wedgelab assess CAR               a car in the regimes of its assessment, beside limits
  wedgelab explore my.toml           a page to change it and see its loop move
  wedgelab study STUDY.toml          many variants of a case, into one table
  wedgelab compare RESULT RESULT     differences and overlay figures
  wedgelab report RUN RUN            a page of any runs, side by side

Exit codes: 0 done; 1 a run could not finish or has failed, or files could not be written;
2 the input is wrong; 3 a wheel left its rail, where the run ended (its files are written, marked
incomplete); 129, 130, 143 ended by SIGHUP, SIGINT (Ctrl-C), SIGTERM.
A first signal stops runs at their next step: what was computed is written, marked incomplete.
A second one ends the program at once. Neither leaves half a file."
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Reproduce(reproduce::Arguments),
    Run(run::Arguments),
    Study(study::Arguments),
    Probability(probability::Arguments),
    Fit(fit::Arguments),
    Compare(compare::Arguments),
    Plot(plot::Arguments),
    Report(report_command::Arguments),
    Case(case::Arguments),
    Explore(explore::Arguments),
    QuasiStatic(quasi_static::Arguments),
    Warp(warp::Arguments),
    Tables(tables::Arguments),
    LockUp(lock_up::Arguments),
    Coupon(coupon::Arguments),
    Curves(curves::Arguments),
    Energy(energy::Arguments),
    Wear(wear::Arguments),
    Rise(rise::Arguments),
    Route(route::Arguments),
    Stability(stability::Arguments),
    Regime(regime::Arguments),
    #[command(alias = assess::BEFORE)]
    Assess(assess::Arguments),
    Wheelrail(wheelrail::Arguments),
    Track(track::Arguments),
    Nucars(nucars::Arguments),
    Fmu(fmu::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
}

impl Cli {
    fn execute(self) -> Result<ExitCode, Failure> {
        match self.command {
            Command::Reproduce(arguments) => reproduce::execute(&arguments),
            Command::Run(arguments) => run::execute(&arguments),
            Command::Study(arguments) => study::execute(&arguments),
            Command::Probability(arguments) => probability::execute(&arguments),
            Command::Fit(arguments) => fit::execute(&arguments),
            Command::Compare(arguments) => compare::execute(&arguments),
            Command::Plot(arguments) => plot::execute(&arguments),
            Command::Report(arguments) => report_command::execute(&arguments),
            Command::Case(arguments) => case::execute(&arguments),
            Command::Explore(arguments) => explore::execute(&arguments),
            Command::QuasiStatic(arguments) => quasi_static::execute(&arguments),
            Command::Warp(arguments) => warp::execute(&arguments),
            Command::Tables(arguments) => tables::execute(&arguments),
            Command::LockUp(arguments) => lock_up::execute(&arguments),
            Command::Coupon(arguments) => coupon::execute(&arguments),
            Command::Curves(arguments) => curves::execute(&arguments),
            Command::Energy(arguments) => energy::execute(&arguments),
            Command::Wear(arguments) => wear::execute(&arguments),
            Command::Rise(arguments) => rise::execute(&arguments),
            Command::Route(arguments) => route::execute(&arguments),
            Command::Stability(arguments) => stability::execute(&arguments),
            Command::Regime(arguments) => regime::execute(&arguments),
            Command::Assess(arguments) => assess::execute(&arguments),
            Command::Wheelrail(arguments) => wheelrail::execute(&arguments),
            Command::Track(arguments) => track::execute(&arguments),
            Command::Nucars(arguments) => nucars::execute(&arguments),
            Command::Fmu(arguments) => fmu::execute(&arguments),
            Command::Completions(arguments) => completions::execute(&arguments, Self::command()),
            Command::Man(arguments) => man::execute(&arguments, Self::command()),
        }
    }
}

fn main() -> ExitCode {
    // As plain as can be: what renders other messages may be compiled to instructions that are not there.
    if let Err(error) = check() {
        failure::say(&format!("error: {error}\n{}", OldProcessor::ADVICE));
        return ExitCode::from(failure::FAILED);
    }
    start()
}

/// Not part of `main`, whose first instructions every processor must have.
#[inline(never)]
fn start() -> ExitCode {
    failure::set_up();
    let done = match Cli::try_parse() {
        Ok(cli) => cli.execute(),
        Err(message) => {
            // Help and version are messages too. If nobody listens there is nothing to be done.
            let _ = message.print();
            return ExitCode::from(if message.use_stderr() { failure::INPUT } else { 0 });
        }
    };
    let flushed = std::io::stdout().flush();
    let done = done.and_then(|code| Ok(flushed.map(|()| code)?));
    match (done, interrupt::code()) {
        (Ok(_), Some(code)) => {
            failure::say("interrupted when everything was done: what was written is whole");
            ExitCode::from(code)
        }
        (Ok(code), None) => code,
        (Err(failure), _) => failure.report(),
    }
}
