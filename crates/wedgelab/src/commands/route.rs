//! `wedgelab route`: a car on the tracks of a route, in seasons, over many miles, with wheels and wedges that
//! wear.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Args;
use quantity::{Kind, Quantity};
use report::drawn::Drawn;
use report::route_files::{self as files, NAMES};
use staging::Folder;
use study::car::CarCase;
use study::car::summary::CarSummary;
use study::route::{OfRun, Route, RouteRun, RouteSummary, RouteWear, Worn};
use study::run::Run;

use crate::execute::jobs;
use crate::failure::{Failure, Message};
use crate::interrupt;
use crate::progress::Steady;

/// Run a car along a route: wear and fatigue of wheels and rails, wear of wedges, step by step
///
/// A route file names a car, tracks and seasons with their shares of the distance, and what each sets: track,
/// speed, lading, friction. Every track is run in every season; damage of a mile is the mean by the shares.
/// The service is cut into steps, after each of which wheels have their worn profiles and wedges their depth
/// maps, and all is run again. Writes route.json, route.csv, route.svg, route.png, route.txt; runs/ holds the
/// summary and case of each run, worn/ profiles and depth maps. The same command continues a route that was
/// stopped or killed.
///
/// Coefficients of wear and fatigue are remembered from publications, that of wedges is a guess: they rank
/// cars and tracks.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab route my_route.toml
  wedgelab route my_route.toml --out softer --jobs 2")]
pub struct Arguments {
    /// Route file
    route: PathBuf,
    /// Folder to write into, or to continue in [default: NAME_route]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Also tell after how much service each wedge stands higher by this
    #[arg(long, value_name = "LENGTH", value_parser = super::rise::length)]
    rise: Option<Quantity>,
    /// Number of runs at a time [default: number of processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let route = Route::read(&arguments.route)?;
    let path = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}_route", route.name)));
    let kept = "the runs that were computed are kept; the same command continues";
    interrupt::stops(&format!("stopping: {kept} (once more: ends at once)"), kept);
    let runs = route.runs();
    let all = runs.len() as u64 * u64::from(route.steps);
    let base = route.case([0, 0], &[])?;
    let mut wear = RouteWear::new(&route, base);
    let progress = Steady::new("runs", all, 0, arguments.quiet);
    for step in 1..=route.steps {
        let worn = wear.worn();
        let files = path.join("worn").join(format!("step_{step}"));
        write_worn(&worn, &files)?;
        let set = route.worn_settings(&worn, &files);
        let folder = path.join("runs").join(format!("step_{step}"));
        let cases = runs.iter().map(|run| route.case(run.of, &set));
        let cases: Vec<CarCase> = cases.collect::<Result<_, _>>()?;
        let found = step_of((&runs, &cases), &folder, jobs(arguments.jobs), &progress)?;
        wear.step(&found);
        if wear.too_long.is_some() {
            break;
        }
    }
    progress.finish();
    let summary = &wear.summary;
    let figure = Drawn::of(&files::figure(summary))?;
    let mut words = files::words(summary);
    if let Some(rise) = &arguments.rise {
        words += &miles(summary, rise);
    }
    let folder = Folder::check(&path, &NAMES, true)?;
    folder.write(|all| {
        all.add(files::SUMMARY, |out| files::write_summary(summary, out))?;
        all.add(files::TABLE, |out| files::write_table(summary, out))?;
        figure.add(all, files::FIGURE, files::PICTURE)?;
        all.add(files::WORDS, |out| out.write_all(words.as_bytes()))
    })?;
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "{words}\nWritten into {}: {}.",
        path.display(),
        NAMES.join(", ")
    )?;
    if let (Some(reason), true) = (&wear.too_long, summary.steps.len() < route.steps as usize) {
        let message = format!("the route stops after step {}: {reason}", summary.steps.len());
        let advice = "write more `steps`, or fewer `miles`; the steps that were made are written";
        return Err(Failure::Failed(Message::new(message, advice).into()));
    }
    let incomplete = summary
        .steps
        .iter()
        .flat_map(|step| &step.runs)
        .filter(|run| run.outcome != "complete");
    match incomplete.count() {
        0 => Ok(ExitCode::SUCCESS),
        count => {
            let message = format!("{count} runs of the route did not come to their end");
            let advice = "what they have worn until then counts; look at the warnings";
            Err(Failure::Failed(Message::new(message, advice).into()))
        }
    }
}

/// Returns when wedges stand higher by a rise, in words.
fn miles(summary: &RouteSummary, rise: &Quantity) -> String {
    let in_unit = rise.to_si() * Kind::Length.from_si(summary.units);
    let found = files::rise_reached(summary, in_unit);
    let lines = found.iter().map(|own| {
        let how = match own.beyond {
            true => ", beyond the route, at the pace of its last step",
            false => "",
        };
        let wedge = own.wedge.replace('_', " ");
        format!(
            "  {wedge}: after {:.0} {}{how}\n",
            own.service, summary.service.unit
        )
    });
    let lines: String = lines.collect();
    match lines.is_empty() {
        true => format!("\nNo wedge rises by {rise}: write [wedges] into the route.\n"),
        false => format!("\nWedges stand higher by {rise}:\n{lines}"),
    }
}

/// Writes the profiles of worn wheels and the maps of worn wedges.
fn write_worn(worn: &Worn, path: &Path) -> Result<(), Failure> {
    let profiles = worn.profiles.iter().map(|own| (own.file(), own.csv()));
    let maps = worn.wedges.iter().flat_map(|own| own.maps());
    let files: Vec<(String, String)> = profiles
        .chain(maps.map(|own| (own.file.clone(), own.csv())))
        .collect();
    if files.is_empty() {
        return Ok(());
    }
    let listed: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    let folder = Folder::check(path, &listed, true)?;
    folder.write(|all| {
        for (name, text) in &files {
            all.add(name, |out| out.write_all(text.as_bytes()))?;
        }
        Ok(())
    })?;
    Ok(())
}

/// Returns the runs of a step: those that are kept in a folder, the others computed and kept there.
fn step_of(
    (runs, cases): (&[RouteRun], &[CarCase]),
    folder: &Path,
    jobs: usize,
    progress: &Steady,
) -> Result<Vec<OfRun>, Failure> {
    let found: Vec<Mutex<Option<Result<CarSummary, Failure>>>> =
        runs.iter().map(|_| Mutex::new(None)).collect();
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..jobs.min(runs.len()) {
            scope.spawn(|| {
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    let (Some(run), false) = (runs.get(number), interrupt::wanted()) else {
                        return;
                    };
                    let own = kept(&cases[number], &folder.join(&run.name))
                        .map_or_else(|| compute(&cases[number], &folder.join(&run.name)), Ok);
                    progress.done();
                    *found[number].lock().unwrap_or_else(PoisonError::into_inner) = Some(own);
                }
            });
        }
    });
    let found = runs.iter().zip(found).map(|(run, own)| {
        let own = own.into_inner().unwrap_or_else(PoisonError::into_inner);
        let summary = own.unwrap_or_else(|| Err(stopped()))?;
        Ok(OfRun {
            run: run.clone(),
            summary,
        })
    });
    found.collect()
}

fn stopped() -> Failure {
    let advice = "the runs that were computed are kept; the same command continues";
    Failure::Interrupted(Message::new("the route was interrupted", advice).into())
}

const CASE: &str = "case.toml";
const SUMMARY: &str = "summary.json";

/// Returns the summary of a run that is kept in a folder, if it is one of this case.
fn kept(case: &CarCase, folder: &Path) -> Option<CarSummary> {
    let text = fs::read_to_string(folder.join(CASE)).ok()?;
    let same = text == case.to_toml_embedded();
    let summary = same.then(|| fs::read(folder.join(SUMMARY)).ok())??;
    serde_json::from_slice(&summary).ok()
}

/// Runs a case and keeps its summary.
fn compute(case: &CarCase, path: &Path) -> Result<CarSummary, Failure> {
    let run = Run::new(case).map_err(|error| {
        let message = format!("the run of {} cannot begin: {error}", path.display());
        Failure::Failed(Message::new(message, "look at what its track sets").into())
    })?;
    let result = run.finish_while(|_| interrupt::go_on());
    if interrupt::is_reason(result.summary.stopped.as_ref()) {
        return Err(stopped());
    }
    let summary = result.summary;
    let folder = Folder::check(path, &[CASE, SUMMARY], true)?;
    folder.write(|all| {
        all.add(CASE, |out| out.write_all(case.to_toml_embedded().as_bytes()))?;
        all.add(SUMMARY, |out| Ok(serde_json::to_writer(out, &summary)?))
    })?;
    Ok(summary)
}
