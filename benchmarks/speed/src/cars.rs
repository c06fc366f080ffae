//! Built-in cars and regimes as they are measured: the list of runs, counters and CPU time of each, errors of
//! its statistics against a run with a tight tolerance.

use std::collections::BTreeMap;
use std::path::Path;

use cpu_time::ThreadTime;
use integrate::Method;
use quantity::Quantity;
use study::car::CarCase;
use study::car::builtin;
use study::car::regime::Regime;
use study::car::statistics::Statistic;
use study::car::summary::CarSummary;
use study::run::Run;

/// Relative tolerance of the runs that statistics are compared with.
pub const TIGHT: f64 = 1e-7;
/// Ladings of cars.
const LADINGS: [&str; 2] = ["loaded", "empty"];
/// A reference runs at least so long after the settling time, s.
const LEAST: f64 = 2.0;

/// A run to be measured.
#[derive(Debug)]
pub struct Listed {
    /// Its name; that of the built-in car where there is one.
    pub name: String,
    /// Its speed at the start, mph.
    pub speed: f64,
    /// The case.
    pub case: CarCase,
}

/// Returns all runs: the built-in cars, and every regime with the loaded and with the empty car, at the speed
/// of the built-in car of the regime, or else the fourth of its speeds.
///
/// # Errors
/// A built-in case or regime cannot be read, which would be a defect.
pub fn all() -> Result<Vec<Listed>, String> {
    let words = |error: study::case::CaseError| error.to_string();
    let mut listed = Vec::new();
    let mut rest: Vec<&str> = builtin::names().collect();
    for regime in Regime::all() {
        let names = LADINGS.map(|lading| format!("car_{}_{lading}", regime.name));
        // Cars that slow down have the name of the regime `hunting`, but not its speed.
        let of_regime = |name: &String| regime.name != "hunting" && rest.contains(&name.as_str());
        let own = names.iter().find(|name| of_regime(name)).cloned();
        for (lading, name) in LADINGS.iter().zip(&names) {
            let case = match &own {
                Some(own) => builtin::case_with(own, &[format!("lading.kind={lading}")]).map_err(words)?,
                None => in_regime(regime, lading).map_err(words)?,
            };
            let is_built_in = of_regime(name);
            let name = if is_built_in {
                name.clone()
            } else {
                format!("{}_{lading}", regime.name)
            };
            listed.push(Listed::new(name, case));
        }
        rest.retain(|name| !names.iter().any(|own| own == name) || regime.name == "hunting");
    }
    let mut own = Vec::new();
    for name in rest {
        own.push(Listed::new(
            name.to_owned(),
            builtin::case_with(name, &[]).map_err(words)?,
        ));
    }
    own.extend(listed);
    Ok(own)
}

/// Returns the case of a regime that no built-in car runs on.
fn in_regime(regime: &Regime, lading: &str) -> Result<CarCase, study::case::CaseError> {
    let place = regime.speeds.len().min(4) - 1;
    let speed: &Quantity = &regime.speeds[place];
    let settings = regime.settings(speed)?.join("\n");
    let text = format!("model = \"car\"\nlading.kind = \"{lading}\"\n{settings}\n");
    CarCase::parse(&format!("{}.toml", regime.name), &text, Path::new(""), &[])
}

impl Listed {
    fn new(name: String, case: CarCase) -> Self {
        let speed = case.speed() / 0.447_04;
        Self { name, speed, case }
    }

    /// Returns whether its car is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.case.parameters.lading.is_empty()
    }
}

/// A run with what it cost.
#[derive(Debug)]
pub struct Measured {
    /// Its results.
    pub summary: CarSummary,
    /// CPU time of reading the start: equilibrium, shaking, s.
    pub start: f64,
    /// CPU time of the run with rows and statistics, s.
    pub cpu: f64,
    /// Time reached, s.
    pub time: f64,
    /// Time at which the number of steps was made that was asked for, s; the end if they were not.
    pub reached: f64,
    /// The most memory that the process held meanwhile, MB, where the system tells it.
    pub memory: Option<f64>,
}

/// Runs a case; notes the time at which it has made so many steps.
///
/// # Errors
/// The run cannot begin.
pub fn measure(case: &CarCase, steps: u64) -> Result<Measured, String> {
    forget_memory();
    let beginning = ThreadTime::now();
    let mut run = Run::new(case).map_err(|error| format!("{}: {error}", case.name))?;
    let start = beginning.elapsed().as_secs_f64();
    let (beginning, mut count, mut reached) = (ThreadTime::now(), 0, None);
    let mut stopped = None;
    while stopped.is_none() && !run.is_finished() {
        if let Err(error) = run.advance() {
            stopped = Some(run.stopped(error.to_string()));
        }
        count += 1;
        if count == steps {
            reached = Some(run.time());
        }
    }
    let time = run.time();
    let summary = run.result(stopped).summary;
    Ok(Measured {
        summary,
        start,
        cpu: beginning.elapsed().as_secs_f64(),
        time,
        reached: reached.unwrap_or(time),
        memory: most_memory(),
    })
}

/// Returns how long a reference runs, s: as long as the run had made the steps, in whole half seconds, but at
/// least beyond the settling time, and not beyond the end.
#[must_use]
pub fn compared(case: &CarCase, reached: f64) -> f64 {
    let least = case.parameters.start.settle + LEAST;
    let whole = (2.0 * reached).floor() / 2.0;
    whole
        .max((2.0 * least).ceil() / 2.0)
        .min(case.simulation.duration)
}

/// Returns the same case until a time (s).
#[must_use]
pub fn until(case: &CarCase, time: f64) -> CarCase {
    let mut case = case.clone();
    case.simulation.duration = time;
    case
}

/// Returns the case with the tight tolerance, by this method.
#[must_use]
pub fn tight(case: &CarCase, method: Method) -> CarCase {
    let mut case = case.clone();
    case.simulation.relative_tolerance = TIGHT;
    case.simulation.method = method;
    case
}

/// Statistics whose errors have a column: the name of the column, and what begins and ends their names.
pub const COLUMNS: [(&str, &str, &str); 6] = [
    ("roll", "body_roll", "_peak_to_peak"),
    ("vert.", "body_at_truck_", "_vertical_acceleration_rms"),
    ("lateral", "body_at_truck_", "_lateral_acceleration_rms"),
    ("peaks", "body_at_truck_", "_acceleration_peak_to_peak"),
    ("load", "axle_", "_least_load_time"),
    ("L/V", "axle_", "_l_over_v_time"),
];

/// Errors of the statistics of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Errors {
    /// Largest of each of [`COLUMNS`], %; none without such statistics.
    pub columns: [Option<f64>; 6],
    /// Median and 95 % value over all statistics, %.
    pub all: [Option<f64>; 2],
}

/// Returns a statistic's number, filtered where there is one, and its unit.
fn value(own: &Statistic) -> Option<(f64, &str)> {
    let value = own.filtered.as_ref().or(own.raw.as_ref())?;
    Some((value.value, &value.unit))
}

/// Returns the least size that errors are related to: what is smaller is nothing (choices).
fn least(unit: &str) -> f64 {
    match unit {
        "g" => 0.01,
        "rad" => 1e-3,
        "lbf" => 500.0,
        "in" => 0.01,
        // Errors of a least load are in % of the static one.
        "%" => 100.0,
        _ => 0.05,
    }
}

/// Returns a name without the numbers and sides of wheels, axles and trucks: statistics of one kind.
fn kind(name: &str) -> String {
    let parts = name.split('_');
    let parts = parts.filter(|part| part.parse::<u32>().is_err() && !matches!(*part, "left" | "right"));
    parts.collect::<Vec<_>>().join("_")
}

/// Returns the errors of statistics against those of a reference, in % of the largest of their kind.
#[must_use]
pub fn errors(found: &BTreeMap<String, Statistic>, reference: &BTreeMap<String, Statistic>) -> Errors {
    let mut scales: BTreeMap<String, f64> = BTreeMap::new();
    for (name, own) in reference {
        if let Some((value, unit)) = value(own) {
            let scale = scales.entry(kind(name)).or_insert_with(|| least(unit));
            *scale = if unit == "%" {
                100.0
            } else {
                scale.max(value.abs())
            };
        }
    }
    let mut all: Vec<(&str, f64)> = Vec::new();
    for (name, own) in reference {
        let other = found.get(name).and_then(value);
        if let (Some((value, _)), Some((other, _)), Some(scale)) =
            (value(own), other, scales.get(&kind(name)))
        {
            all.push((name, 100.0 * (other - value).abs() / scale));
        }
    }
    let columns = COLUMNS.map(|(_, begin, end)| {
        let of_column = all
            .iter()
            .filter(|(name, _)| name.starts_with(begin) && name.ends_with(end));
        of_column.map(|(_, error)| *error).max_by(f64::total_cmp)
    });
    let mut sizes: Vec<f64> = all.iter().map(|(_, error)| *error).collect();
    sizes.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let last = sizes.len().checked_sub(1)?;
        sizes.get((share * last as f64).round() as usize).copied()
    };
    Errors {
        columns,
        all: [at(0.5), at(0.95)],
    }
}

/// Lets the system count the most memory from now on, where it can.
fn forget_memory() {
    // Elsewhere than on Linux the most memory is not known anyway.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}

/// Returns the most memory that this process has held, MB, where the system tells it.
#[must_use]
pub fn most_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.trim().trim_end_matches(" kB").parse().ok()?;
    Some(kilobytes / 1024.0)
}
