//! `wedgelab stability`: stability of a car over speed, linear and by ramps of its speed.

use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use quantity::{Kind, Quantity, System as Units};
use report::drawn::Drawn;
use report::stability_files::NAMES;
use report::terminal::TerminalTable;
use report::{hunting_files, onset_files, stability_files};
use study::car::CarCase;
use study::car::hunting::{Boundary, Hunting, HuntingError, HuntingSettings, hunting};
use study::car::onset::onset;
use study::car::stability::{BEYOND, Branch, BranchKind, Stability, left_out, stability};
use study::outcome::Outcome;

use super::run::read_any;
use super::stability_locus::{Around, VaryArguments};
use super::stability_vehicle;
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;

/// Stability of a car over speed: growth and frequency of its vibrations, critical speeds, hunting
///
/// Of a vehicle of bodies and elements (model = "vehicle") it prints the natural vibrations; if it runs on a
/// track, also the critical speed of small motions, and it writes stability.csv, .json, .svg and .png: its
/// vibrations at each speed, friction stuck. Of a car:
///
/// Linearizes the car about steady running on straight track without irregularities, at each speed: with all
/// friction of wedges, center plates, adapters and side bearings stuck (bristles are springs), without it,
/// and, if [stability] warp_moment is set, as the linear benchmark of textbooks. [stability] body = "held"
/// looks at each truck alone. Between stuck and absent lies the critical speed over the amplitude: friction,
/// conicity and creep by equivalent linearization. Writes stability.csv (all vibrations of 0.05 to 30 Hz),
/// critical_speed.csv, stability.json, stability.svg and stability.png.
///
/// With --onset it also runs the car at held speeds on perfect track and on track of FRA class 4, and finds
/// the speeds from which on measures of hunting pass their limits. Writes onset.csv, onset.json, onset.svg,
/// onset.png.
///
/// With --nonlinear it also runs the car at falling and at rising speed, and finds the speeds at which
/// hunting ends after a lateral start at the highest speed, and at which hunting begins over small dips of
/// the rails. Writes hunting.csv (amplitudes over speed), hunting.json, hunting.svg and hunting.png.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab stability car_hunting_empty
  wedgelab stability my_car.toml --speeds \"30 mph\"..\"80 mph\" --steps 6
  wedgelab stability car_hunting_roller_empty --nonlinear --ramp-time \"180 s\"
  wedgelab stability car_hunting_roller_empty --onset 4 --speeds \"45 mph\"..\"70 mph\"
  wedgelab stability my_car.toml --set wheels.geometry=linear --set track.support.kind=rigid")]
pub struct Arguments {
    /// Case file, or the name of a built-in case
    case: PathBuf,
    /// The lowest and the highest speed
    #[arg(long, value_name = "FROM..TO", default_value = "30 mph..80 mph", value_parser = range)]
    speeds: [f64; 2],
    /// Number of speeds, at least 2
    #[arg(
        long,
        value_name = "N",
        default_value_t = 11,
        value_parser = clap::value_parser!(u32).range(2..=1000),
    )]
    steps: u32,
    /// Also run the car at this many held speeds, on perfect track and on track of FRA class 4: onset of
    /// hunting by the standard deviation of the body's lateral acceleration over 2,000 ft and the truck's RMS
    /// over 2 s
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=50))]
    onset: Option<u32>,
    /// Also run the car at falling and at rising speed, to find the speeds at which it hunts
    #[arg(long)]
    nonlinear: bool,
    /// Time in which the speed falls, and in which it rises; slower is more exact
    #[arg(
        long,
        value_name = "TIME",
        default_value = "90 s",
        value_parser = ramp_time,
        requires = "nonlinear",
    )]
    ramp_time: f64,
    /// Lateral amplitude of a wheelset from which on it hunts
    #[arg(long, value_name = "LENGTH", default_value = "0.05 in", value_parser = threshold,
          requires = "nonlinear")]
    threshold: f64,
    #[command(flatten)]
    vary: VaryArguments,
    /// Set one value over those of the case
    #[arg(long, value_name = "PATH.KEY=VALUE")]
    set: Vec<String>,
    /// Folder to write into [default: NAME_stability]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// Returns a speed, m/s.
pub(super) fn speed(text: &str) -> Result<f64, String> {
    let quantity = Quantity::parse_as(text.trim(), Kind::TravelSpeed).map_err(|error| error.to_string())?;
    match quantity.to_si() {
        own if own > 0.0 && own < 1e3 => Ok(own),
        _ => Err("speeds must be positive, below 1000 m/s".to_owned()),
    }
}

/// Returns a range of speeds, m/s, rising; whichever end comes first in the text.
pub(super) fn range(text: &str) -> Result<[f64; 2], String> {
    const HOW: &str = "write for example \"30 mph\"..\"80 mph\"";
    let (from, to) = text.split_once("..").ok_or(HOW)?;
    let [from, to] = [speed(from)?, speed(to)?];
    match from == to {
        true => Err(format!("this is one speed only; {HOW}")),
        false => Ok([from.min(to), from.max(to)]),
    }
}

/// Returns that many speeds, evenly spaced over a range.
pub(super) fn spaced([from, to]: [f64; 2], count: u32) -> Vec<f64> {
    let last = count - 1;
    let speed = |k| from + (to - from) * f64::from(k) / f64::from(last);
    (0..=last).map(speed).collect()
}

fn ramp_time(text: &str) -> Result<f64, String> {
    let quantity = Quantity::parse_as(text.trim(), Kind::Time).map_err(|error| error.to_string())?;
    match quantity.to_si() {
        own if (5.0..=1e4).contains(&own) => Ok(own),
        _ => Err("the ramp must take 5 s to 10000 s".to_owned()),
    }
}

fn threshold(text: &str) -> Result<f64, String> {
    let quantity = Quantity::parse_as(text.trim(), Kind::Length).map_err(|error| error.to_string())?;
    match quantity.to_si() {
        own if own > 0.0 && own < 0.1 => Ok(own),
        _ => Err("the threshold must be positive, below 0.1 m".to_owned()),
    }
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let any = read_any(&arguments.case, &arguments.set)?;
    let around = Around {
        path: &arguments.case,
        set: &arguments.set,
        speeds: arguments.speeds,
        out: arguments.out.as_ref(),
        force: arguments.force,
        quiet: arguments.quiet,
    };
    let speeds = spaced(arguments.speeds, arguments.steps);
    if let Some(vehicle) = any.vehicle() {
        if arguments.nonlinear || arguments.onset.is_some() || arguments.vary.is_given() {
            let message = format!(
                "{} is a vehicle; --nonlinear, --onset and --vary are for cars",
                any.name()
            );
            let advice = "leave them out; a study varies its keys and has its slowest vibration";
            return Err(Message::new(message, advice).into());
        }
        return stability_vehicle::execute(vehicle, &around, &speeds);
    }
    let Some(case) = any.car() else {
        let message = format!("{} is no car: hunting is what a car on track does", any.name());
        let advice = "take car_hunting_empty, or a case with model = \"car\"";
        return Err(Message::new(message, advice).into());
    };
    if case.stability.body_held && (arguments.nonlinear || arguments.onset.is_some()) {
        let message = "stability.body is \"held\", but --nonlinear and --onset run the whole car";
        let advice = "leave them out, or write stability.body = \"free\"";
        return Err(Message::new(message, advice).into());
    }
    if let Some(done) = arguments.vary.execute(case, around) {
        return done;
    }
    let path = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}_stability", case.name)));
    let settings = HuntingSettings {
        speeds: arguments.speeds,
        ramp: arguments.ramp_time,
        threshold: arguments.threshold,
    };
    if arguments.nonlinear {
        settings.check(case).map_err(|error| cannot_hunt(case, &error))?;
    }
    let mut names: Vec<&str> = NAMES.to_vec();
    if arguments.nonlinear {
        names.extend(hunting_files::NAMES);
    }
    if arguments.onset.is_some() {
        names.extend(onset_files::NAMES);
    }
    let folder = folders::check(path, &names, arguments.force)?;
    let progress = Progress::new(1, arguments.quiet);
    interrupt::stops_run();
    let mut reached = progress.of_run(1.0);
    let part = match (arguments.nonlinear, arguments.onset.is_some()) {
        (false, false) => 1.0,
        (true, true) => 0.1,
        _ => 0.3,
    };
    // Ramps, then runs at held speeds.
    let ramps = if arguments.onset.is_some() { 0.4 } else { 1.0 };
    let found = stability(case, &speeds, |share| {
        reached(part * share);
        match interrupt::wanted() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    });
    let runs = match &found {
        Ok(found) if found.complete && arguments.nonlinear => Some(hunting(case, settings, |share| {
            reached(part + ramps * (1.0 - part) * share);
            interrupt::go_on()
        })),
        _ => None,
    };
    let whole = match (&found, &runs) {
        (Ok(found), None) => found.complete,
        (Ok(found), Some(Ok(runs))) => found.complete && runs.complete,
        _ => false,
    };
    let held = match arguments.onset {
        Some(count) if whole => {
            let before = if arguments.nonlinear {
                part + ramps * (1.0 - part)
            } else {
                part
            };
            Some(onset(case, &spaced(arguments.speeds, count), |share| {
                reached(before + (1.0 - before) * share);
                interrupt::go_on()
            }))
        }
        _ => None,
    };
    progress.finish();
    let found = found.map_err(|error| {
        let message = format!("{} cannot be linearized: {error}", case.name);
        let advice = "look at its speeds, lading and side bearings; `wedgelab run` shows how it runs";
        Message::new(message, advice)
    })?;
    let runs = runs.transpose().map_err(|error| cannot_hunt(case, &error))?;
    let held = held.transpose().map_err(|error| {
        let message = format!("{} cannot be run at held speeds: {error}", case.name);
        Message::new(
            message,
            "look at its speeds and wheels; `wedgelab run` shows how it runs",
        )
    })?;
    let units = case.simulation.output_units;
    let figure = Drawn::of(&stability_files::figure(&case.name, &found, units))?;
    let hunting = match &runs {
        None => None,
        Some(runs) => {
            let figure = Drawn::of(&hunting_files::figure(&case.name, runs, &found, units))?;
            Some((runs, figure))
        }
    };
    let onset_drawn = match &held {
        None => None,
        Some(held) => {
            let figure = Drawn::of(&onset_files::figure(&case.name, held, units))?;
            Some((held, figure))
        }
    };
    folder.write(|files| {
        files.add(stability_files::TABLE, |out| {
            stability_files::write_table(&found, units, out)
        })?;
        files.add(stability_files::CURVE, |out| {
            stability_files::write_curve(&found, units, out)
        })?;
        files.add(stability_files::NUMBERS, |out| {
            stability_files::write_numbers(case, &found, units, out)
        })?;
        figure.add(files, stability_files::FIGURE, stability_files::PICTURE)?;
        files.add(stability_files::PAGE, |out| {
            report::page::stability::write(case, &found, units, out)
        })?;
        if let Some((held, figure)) = &onset_drawn {
            files.add(onset_files::TABLE, |out| {
                onset_files::write_table(held, units, out)
            })?;
            files.add(onset_files::NUMBERS, |out| {
                onset_files::write_numbers(&case.name, held, units, out)
            })?;
            figure.add(files, onset_files::FIGURE, onset_files::PICTURE)?;
        }
        let Some((runs, figure)) = &hunting else {
            return Ok(());
        };
        files.add(hunting_files::TABLE, |out| {
            hunting_files::write_table(runs, units, out)
        })?;
        files.add(hunting_files::NUMBERS, |out| {
            hunting_files::write_numbers(&case.name, (runs, &found), units, out)
        })?;
        figure.add(files, hunting_files::FIGURE, hunting_files::PICTURE)
    })?;
    let mut out = io::stdout().lock();
    table(&found, units).write(&mut out)?;
    writeln!(out)?;
    if !found.curve.is_empty() {
        over_amplitude(&found, units).write(&mut out)?;
        writeln!(out)?;
    }
    if let Some(what) = left_out(case) {
        writeln!(out, "On straight track without irregularities: {what}.")?;
    }
    for branch in &found.branches {
        writeln!(out, "{}", line_of(branch, units))?;
    }
    if found.complete {
        writeln!(out, "{}", found.verdict(units))?;
    }
    for line in runs.iter().flat_map(|runs| lines_of(runs, units)) {
        writeln!(out, "{line}")?;
    }
    if let Some(runs) = runs.as_ref().filter(|runs| runs.complete) {
        writeln!(out, "{}", verdict(runs, units))?;
    }
    if let Some(held) = &held {
        for line in onset_files::sentences(held, units) {
            writeln!(out, "{line}")?;
        }
        for warning in onset_files::warnings(held, units) {
            writeln!(out, "warning: {warning}")?;
        }
    }
    let mut written: Vec<&str> = NAMES.to_vec();
    if runs.is_some() {
        written.extend(hunting_files::NAMES);
    }
    if held.is_some() {
        written.extend(onset_files::NAMES);
    }
    writeln!(
        out,
        "\nGrowth and frequency of the vibration that grows most, of 0.05 to 30 Hz; positive growth is \
         hunting. Over the amplitude: the speed beyond\nwhich a motion of this lateral amplitude of a \
         wheelset \
         grows, by equivalent linearization{}\n\nWritten into {}: {}.",
        if runs.is_some() {
            "."
        } else {
            "; --nonlinear runs the car."
        },
        folder.path().display(),
        written.join(", ")
    )?;
    let ramps = runs
        .iter()
        .flat_map(|runs| [Some(&runs.falling), runs.rising.as_ref()]);
    let failed = ramps.flatten().find_map(|ramp| match &ramp.outcome {
        Outcome::Failed(reason) => Some(reason),
        _ => None,
    });
    let failed = failed.cloned().or_else(|| {
        let (track, at, reason) = held.as_ref()?.failed()?;
        let unit = Kind::TravelSpeed.label(units);
        let at = at * Kind::TravelSpeed.from_si(units);
        Some(format!("{} at {at:.1} {unit}: {reason}", track.words()))
    });
    let whole = found.complete
        && runs.as_ref().is_none_or(|runs| runs.complete)
        && held.as_ref().is_none_or(|held| held.complete);
    if whole {
        let Some(reason) = failed else {
            return Ok(ExitCode::SUCCESS);
        };
        let message = format!("a run of {} over speeds has failed: {reason}", case.name);
        let advice = "its files are written; do not use the numbers of that run";
        Err(Failure::Failed(Message::new(message, advice).into()))
    } else {
        let message = "interrupted: the speeds that were computed are written".to_owned();
        Err(Failure::Interrupted(Message::new(message, "").into()))
    }
}

/// Returns in a sentence over which speeds it hunts.
fn verdict(runs: &Hunting, units: Units) -> String {
    let speed = |si: f64| {
        let unit = Kind::TravelSpeed.label(units);
        format!("{:.0} {unit}", si * Kind::TravelSpeed.from_si(units))
    };
    let [low, high] = runs.settings.speeds;
    let once = match runs.falling.boundary {
        Boundary::At(own) => format!("Once disturbed it hunts above {}", speed(own)),
        Boundary::Everywhere => format!("Once disturbed it hunts at all speeds from {} on", speed(low)),
        Boundary::Nowhere => format!(
            "Once disturbed it comes to rest at all speeds up to {}",
            speed(high)
        ),
        Boundary::Derails(own) => format!("Once disturbed it derails at {}", speed(own)),
    };
    let itself = match runs.rising.as_ref().map(|own| own.boundary) {
        Some(Boundary::At(own)) => format!("; by itself, over small dips, from {} on.", speed(own)),
        Some(Boundary::Everywhere) => format!("; by itself, over small dips, from {} on.", speed(low)),
        Some(Boundary::Nowhere) => format!("; by itself, over small dips, not up to {}.", speed(high)),
        Some(Boundary::Derails(own)) => format!("; over small dips it derails at {}.", speed(own)),
        None => ".".to_owned(),
    };
    format!("{once}{itself}")
}

fn cannot_hunt(case: &CarCase, error: &HuntingError) -> Message {
    let advice = match error {
        HuntingError::LinearWheels => "take wheels.geometry = \"profiles\", or leave out --nonlinear",
        _ => "look at its speeds, lading and side bearings; `wedgelab run` shows how it runs",
    };
    Message::new(
        format!("{} cannot be run over speeds: {error}", case.name),
        advice,
    )
}

/// Returns the speeds at which hunting ends and begins, in words.
fn lines_of(runs: &Hunting, units: Units) -> Vec<String> {
    let speed = |si: f64| {
        let unit = Kind::TravelSpeed.label(units);
        format!("{:.1} {unit}", si * Kind::TravelSpeed.from_si(units))
    };
    let falling = match runs.falling.boundary {
        Boundary::At(own) => format!("hunting dies at {}.", speed(own)),
        Boundary::Everywhere => "it hunts down to the lowest speed.".to_owned(),
        Boundary::Nowhere => "the start dies away at the highest speed.".to_owned(),
        Boundary::Derails(own) => format!("a wheel leaves its rail at {}.", speed(own)),
    };
    let mut lines = vec![format!("Speed falls: {falling}")];
    if let Some(rising) = &runs.rising {
        let rising = match rising.boundary {
            Boundary::At(own) => format!("hunting begins at {}.", speed(own)),
            Boundary::Everywhere => "it hunts from the lowest speed on.".to_owned(),
            Boundary::Nowhere => "nothing grows up to the highest speed.".to_owned(),
            Boundary::Derails(own) => format!("a wheel leaves its rail at {}.", speed(own)),
        };
        lines.push(format!("Speed rises: {rising}"));
    }
    let ramps = [("falling", Some(&runs.falling)), ("rising", runs.rising.as_ref())];
    for (name, ramp) in ramps {
        let warnings = ramp.iter().flat_map(|ramp| &ramp.warnings);
        lines.extend(warnings.map(|warning| format!("warning: {name} speed: {warning}")));
    }
    lines
}

/// Returns what a branch says in a line.
fn line_of(branch: &Branch, units: Units) -> String {
    let words = branch.kind.words();
    let words = words[..1].to_uppercase() + &words[1..];
    let Some(own) = &branch.critical else {
        return format!("{words}: no vibration grows at these speeds.");
    };
    let speed = own.speed * Kind::TravelSpeed.from_si(units);
    let unit = Kind::TravelSpeed.label(units);
    let (frequency, name) = (own.frequency, &own.name);
    match (own.at_lowest, branch.kind) {
        (true, BranchKind::Absent) => format!(
            "{words}: {name} at {frequency:.2} Hz grows at {speed:.1} {unit} already: wheelsets that \
             nothing holds."
        ),
        (true, _) => format!("{words}: {name} at {frequency:.2} Hz grows at {speed:.1} {unit} already."),
        (false, _) => format!("{words}: {name} at {frequency:.2} Hz grows from {speed:.1} {unit} on."),
    }
}

/// Returns the vibration that grows most at each speed.
fn table(found: &Stability, units: Units) -> TerminalTable {
    let unit = Kind::TravelSpeed.label(units);
    let names: Vec<String> = found
        .branches
        .iter()
        .map(|own| format!("{}, growth", own.kind.words()))
        .collect();
    let mut head = vec![("speed", unit)];
    for name in &names {
        head.extend([(name.as_str(), "1/s"), ("frequency", "Hz")]);
    }
    let mut table = TerminalTable::new(0, &head);
    for (row, speed) in found.speeds.iter().enumerate() {
        let mut cells = vec![format!("{:.1}", speed * Kind::TravelSpeed.from_si(units))];
        for branch in &found.branches {
            let mode = branch.modes.get(row).and_then(|modes| modes.first());
            cells.push(mode.map_or("-".to_owned(), |own| format!("{:.3}", own.growth)));
            cells.push(mode.map_or("-".to_owned(), |own| format!("{:.3}", own.frequency)));
        }
        table.row(cells);
    }
    table
}

/// Returns the critical speed of each amplitude, from small to large.
fn over_amplitude(found: &Stability, units: Units) -> TerminalTable {
    let (length, speed) = (Kind::Length, Kind::TravelSpeed);
    let head = [
        ("amplitude", length.label(units)),
        ("critical speed", speed.label(units)),
        ("frequency", "Hz"),
        ("motion", ""),
    ];
    let mut table = TerminalTable::new(0, &head);
    let beyond = found.speeds.last().copied().unwrap_or_default() * BEYOND * speed.from_si(units);
    for own in found.curve.iter().rev() {
        let mut cells = vec![format!("{:.3}", own.amplitude * length.from_si(units))];
        cells.extend(match &own.critical {
            Some(own) => [
                format!("{:.1}", own.speed * speed.from_si(units)),
                format!("{:.2}", own.frequency),
                own.name.clone(),
            ],
            None if own.unsolved => ["not found".to_owned(), "-".to_owned(), "-".to_owned()],
            None => [format!("above {beyond:.0}"), "-".to_owned(), "-".to_owned()],
        });
        table.row(cells);
    }
    table
}
