//! `wedgelab reproduce`: all built-in cases, and a report on them.

mod interrupted;
mod sensitivity;
mod three_piece;
mod trucks;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use clap::Args;
use rayon::prelude::*;
use report::figures::{CaseOutcome, Exhibit};
use report::models::{WEDGE_NOTE, table_of_wedges};
use report::run_files;
use report::view::View;
use report::view::run::{Detail, Recording};
use reproduction::agreement::{self, TruckOutcome};
use reproduction::claims::{self, Claims, Evidence};
use reproduction::figures::groups;
use reproduction::page::{self, Contents};
use reproduction::sections::{self, Section};
use reproduction::sensitivity::Sensitivity;
use reproduction::three_piece::Basis;
use staging::{FileError, Folder};
use study::case::{Case, builtin};
use study::half_truck::HalfTruckCase;
use study::truck::TruckCase;

use crate::execute::{execute_whole, unsound, write_outcome};
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;
use crate::select::select;
use interrupted::Planned;

/// The folder unless another is named.
const USUAL: &str = "reproduction";

/// Run all built-in cases and write a report on them
///
/// Computes the twelve runs of Steets (2007), table 4-1 (variable and constant damping, toe out, none and in,
/// with and without yaw of the bolster), and the cases beyond the thesis. Writes the report index.html, its
/// statements with verdicts claims.json, each figure as SVG and PNG, and for each run runs/NAME/result.csv,
/// result.mat, case.toml and summary.json; prints a table of the runs. Without --only it also runs the
/// half-truck of the comparison program's files (28 runs: result.csv and summary.json) for the report's
/// comparison, and the three-piece truck with four wedges that have mass on 32 rigs, loaded and empty,
/// reported in truck.html (numbers in truck.json): loops, warp, wedges, closed forms, influence of contact
/// and bristle stiffness. With --sensitivity N the twelve runs are made at N points of the space of the
/// parameters that the thesis leaves open (contact stiffness and damping, line of action of the coil, start,
/// inertia, position of B), and the report states for each statement the part of that space in which it holds
/// and the deciding parameter (sensitivity.json). Points are kept in the folder sensitivity; a larger N
/// reuses them, and so does the same command after an interruption.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab reproduce
  wedgelab reproduce --out today --jobs 1
  wedgelab reproduce --sensitivity 200
  wedgelab reproduce --only 'vdrun*' cdrun_toe_0_psi_0 --force")]
pub struct Arguments {
    /// Folder to write into
    #[arg(long, value_name = "DIR", default_value = USUAL)]
    out: PathBuf,
    /// Run only these: names, beginnings that only one name has, or patterns such as 'vdrun*'
    #[arg(long, value_name = "NAME", num_args = 1..)]
    only: Vec<String>,
    /// Also decide the thesis's statements at N points of the space of the parameters that it leaves open
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=20_000))]
    sensitivity: Option<u32>,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    /// Number of runs at a time [default: number of processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// A run whose files are written.
struct ReproducedRun {
    outcome: CaseOutcome,
    /// The data for the page.
    recording: Recording,
    wall: Duration,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let cases = select(&arguments.only, builtin::names())?
        .into_iter()
        .map(builtin::case)
        .collect::<Result<Vec<Case>, _>>()?;
    let places = check(&arguments.out, &cases, arguments.force)?;
    // A choice of runs leaves the trucks out.
    let (half_trucks, rigs) = if arguments.only.is_empty() {
        let half_trucks = trucks::plan(&arguments.out, arguments.force)?;
        (half_trucks, three_piece::plan(&arguments.out, arguments.force)?)
    } else {
        (Vec::new(), Vec::new())
    };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(arguments.jobs.map_or(0, usize::from))
        .build()
        .map_err(|error| Failure::Failed(Message::new(error.to_string(), "try --jobs 1").into()))?;
    let explored = arguments
        .sensitivity
        .map(|points| sensitivity::explore(arguments, u64::from(points), &pool))
        .transpose()?;

    let progress = Progress::new(cases.len() + half_trucks.len() + rigs.len(), arguments.quiet);
    let names = three_piece::names(&rigs);
    let planned = Planned::of(arguments, &cases, &half_trucks, &names);
    interrupt::stops(
        "stopping: the runs under way are not written (once more: ends at once)",
        &format!(
            "the runs that were written before are whole, in {}",
            planned.runs.display()
        ),
    );
    let (kept, (half_trucks, rigs)): (Vec<Result<Option<ReproducedRun>, Failure>>, _) = pool.install(|| {
        let work = cases.into_par_iter().zip(&places.runs).with_max_len(1);
        let work = work.map(|(case, folder)| keep(case, folder, &progress));
        let of_trucks = || {
            rayon::join(
                || trucks::trucks(half_trucks, &progress),
                || three_piece::run(rigs, &progress),
            )
        };
        rayon::join(|| work.collect(), of_trucks)
    });
    progress.finish();
    let half_trucks: Vec<Option<trucks::ReproducedTruck>> = half_trucks?;
    let rigs: Vec<Option<three_piece::Made>> = rigs?;
    let kept = kept
        .into_iter()
        .collect::<Result<Vec<Option<ReproducedRun>>, Failure>>()?;
    interrupt::ends(&planned.without_report());
    if interrupt::wanted() {
        let wedges = kept.iter().map(Option::is_some);
        let trucks = half_trucks
            .iter()
            .map(Option::is_some)
            .chain(three_piece::written(&rigs, names.len()));
        return Err(planned.interrupted(wedges, trucks));
    }
    let (half_trucks, of_trucks): (Vec<TruckOutcome>, Vec<_>) = half_trucks.into_iter().flatten().unzip();
    let kept: Vec<ReproducedRun> = kept.into_iter().flatten().collect();
    let walls: Vec<Duration> = kept.iter().map(|kept| kept.wall).collect();
    let (outcomes, recordings): (Vec<CaseOutcome>, Vec<_>) = kept
        .into_iter()
        .map(|kept| (kept.outcome, kept.recording))
        .unzip();
    let recordings = recordings.into_iter().chain(of_trucks).collect();

    let rigs: Vec<three_piece::Made> = rigs.into_iter().flatten().collect();
    let truck_report = if rigs.is_empty() {
        None
    } else {
        Some(pool.install(|| three_piece::report_on(rigs, &places.figures))?)
    };
    let figures = pool.install(|| {
        write_report(
            &outcomes,
            &half_trucks,
            recordings,
            &places,
            truck_report.as_ref(),
            explored.as_ref(),
        )
    })?;

    let mut out = io::stdout().lock();
    for (_, result) in &outcomes {
        write_outcome(&result.summary, &mut out)?;
    }
    let summaries = outcomes.iter().map(|(_, result)| &result.summary);
    table_of_wedges(summaries.zip(walls.iter().copied())).write(&mut out)?;
    writeln!(
        out,
        "\n{WEDGE_NOTE}\n\n\
         Written into {}: {} (the report; open it in a browser), {}, {}/ ({figures} figures as SVG and \
         PNG), runs/NAME/{{{}}}.",
        places.sheets.path().display(),
        report::page::FILE_NAME,
        claims::FILE_NAME,
        page::FIGURES,
        run_files::NAMES.join(", "),
    )?;
    if let Some(truck_report) = &truck_report {
        let checks = &truck_report.findings.checks;
        let agreeing = Basis::ALL.map(|basis| {
            let of_basis = || checks.iter().filter(|check| check.basis == basis);
            let agreeing = of_basis().filter(|check| check.agrees).count();
            let count = of_basis().count();
            format!("{agreeing} of {count} {}", basis.heading().to_lowercase())
        });
        writeln!(
            out,
            "The three-piece truck: {} and {}. Numbers as expected: {}.",
            page::truck::FILE_NAME,
            reproduction::three_piece::FILE_NAME,
            agreeing.join(", ")
        )?;
    }
    if let Some(explored) = &explored {
        writeln!(out, "{}", sensitivity::in_short(explored))?;
    }
    out.flush()?;
    let mut code = ExitCode::SUCCESS;
    for ((_, result), folder) in outcomes.iter().zip(&places.runs) {
        if let Some(failure) = unsound::<Case>(&result.summary, folder.path()) {
            code = failure.report();
        }
    }
    for (_, result) in &half_trucks {
        if let Some(failure) =
            unsound::<HalfTruckCase>(&result.summary, &planned.runs.join(&result.summary.name))
        {
            code = failure.report();
        }
    }
    for summary in truck_report
        .iter()
        .flat_map(|truck_report| &truck_report.summaries)
    {
        if let Some(failure) = unsound::<TruckCase>(summary, &planned.runs.join(&summary.name)) {
            code = failure.report();
        }
    }
    Ok(code)
}

/// Runs a case and writes its files; `None` if it was interrupted.
fn keep(case: Case, folder: &Folder, progress: &Progress) -> Result<Option<ReproducedRun>, Failure> {
    let Some(done) = execute_whole(&case, folder, progress)? else {
        return Ok(None);
    };
    let mut outcome = (case, done.result);
    let of_thesis = is_of_thesis(&outcome.0);
    let detail = if of_thesis { Detail::Full } else { Detail::Thinned };
    let recording = Recording::of_wedge(&outcome, detail);
    if !of_thesis {
        outcome.1.keep_columns(groups::needs);
    }
    Ok(Some(ReproducedRun {
        outcome,
        recording,
        wall: done.wall,
    }))
}

fn is_of_thesis(case: &Case) -> bool {
    builtin::thesis_names().any(|name| name == case.name)
}

/// Writes all figures as pictures and drawings; gives the drawings.
///
/// A picture is written as soon as it is painted, and nothing of it is kept: its pixels need a hundred times
/// the memory of its drawing.
fn draw(exhibits: &[&Exhibit], folder: &Folder) -> Result<Vec<String>, Failure> {
    let mut svgs = Vec::new();
    folder.write(|files| {
        let files = Mutex::new(files);
        let add = |name: &str, bytes: &[u8]| {
            let mut files = files.lock().unwrap_or_else(PoisonError::into_inner);
            files.add(name, |out| out.write_all(bytes))
        };
        exhibits.par_iter().try_for_each(|exhibit| {
            let png = exhibit.figure.to_png().map_err(|reason| FileError::Write {
                file: folder.path().join(format!("{}.png", exhibit.name)),
                reason: io::Error::other(reason),
            })?;
            add(&format!("{}.png", exhibit.name), &png)
        })?;
        svgs = exhibits
            .par_iter()
            .map(|exhibit| exhibit.figure.to_svg())
            .collect();
        exhibits
            .iter()
            .zip(&svgs)
            .try_for_each(|(exhibit, svg)| add(&format!("{}.svg", exhibit.name), svg.as_bytes()))
    })?;
    Ok(svgs)
}

/// Draws all figures and writes them and the page; gives the number of figures.
fn write_report(
    outcomes: &[CaseOutcome],
    half_trucks: &[TruckOutcome],
    recordings: Vec<Recording>,
    places: &Places,
    truck_report: Option<&three_piece::TruckReport>,
    explored: Option<&Sensitivity>,
) -> Result<usize, Failure> {
    let units = outcomes.first().map(|(_, result)| result.summary.units);
    // The thesis's runs come first in the list of cases.
    let first_beyond = outcomes.partition_point(|(case, _)| is_of_thesis(case));
    let (outcomes, others) = outcomes.split_at(first_beyond);
    let mut sections: Vec<Section> = sections::thesis(outcomes);
    let run_by_run = sections.partition_point(|section| !section.folded);
    let more = explored.and_then(sections::sensitivity).into_iter();
    let more = more.chain(sections::comparison(outcomes, half_trucks));
    sections.splice(run_by_run..run_by_run, more.chain(sections::beyond(others)));
    sections.extend(sections::moving(others, half_trucks));
    let exhibits: Vec<&Exhibit> = sections.iter().flat_map(|section| &section.exhibits).collect();
    let svgs = draw(&exhibits, &places.figures)?;
    let count = exhibits.len();
    let view = View::new(units.unwrap_or_default(), recordings, exhibits.iter().copied())
        .to_json()
        .map_err(|error| {
            let message = format!("cannot write the page's data: {error}");
            Failure::Failed(Message::new(message, "").into())
        })?;
    let mut svgs = svgs.into_iter();
    for section in &mut sections {
        section.svgs = svgs.by_ref().take(section.exhibits.len()).collect();
    }
    let curved = claims::curved_slope_runs(outcomes);
    let evidence = Evidence::new(
        outcomes
            .iter()
            .chain(&curved)
            .map(|(case, result)| (case, result)),
    )
    .with_trucks(half_trucks.iter().map(|(entry, result)| (entry, result)));
    let verdicts = Claims::of(claims::evaluate(&evidence));
    let groups = agreement::groups(outcomes, half_trucks);
    let comparison = units.filter(|_| !half_trucks.is_empty());
    let page = page::render(&Contents {
        outcomes,
        beyond: others,
        claims: &verdicts,
        sensitivity: explored,
        sections: &sections,
        view: &view,
        comparison: comparison.map(|units| page::Comparison {
            groups: &groups,
            trucks: half_trucks,
            units,
        }),
        truck: truck_report.is_some(),
    });
    places.sheets.write(|files| {
        files.add(report::page::FILE_NAME, |out| out.write_all(page.as_bytes()))?;
        if let Some(truck_report) = truck_report {
            three_piece::add(files, truck_report)?;
        }
        if let Some(explored) = explored {
            files.add(reproduction::sensitivity::FILE_NAME, |out| explored.write(out))?;
        }
        files.add(claims::FILE_NAME, |out| claims::write(&verdicts, out))
    })?;
    Ok(count + truck_report.map_or(0, |truck_report| truck_report.figures))
}

/// The folders that are written into.
struct Places {
    sheets: Folder,
    figures: Folder,
    runs: Vec<Folder>,
}

/// Returns the folders, found fit before anything is computed.
fn check(out: &Path, cases: &[Case], force: bool) -> Result<Places, Failure> {
    let figures = out.join(page::FIGURES);
    // Which figures there will be is not known yet: all that lie there are in the way.
    let present: Vec<String> = std::fs::read_dir(&figures).map_or(Vec::new(), |entries| {
        let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
        names
            .filter(|name| name.ends_with(".svg") || name.ends_with(".png"))
            .collect()
    });
    let present: Vec<&str> = present.iter().map(String::as_str).collect();
    let sheets = [
        report::page::FILE_NAME,
        claims::FILE_NAME,
        page::truck::FILE_NAME,
        reproduction::three_piece::FILE_NAME,
        reproduction::sensitivity::FILE_NAME,
    ];
    let folders = [(out.to_owned(), sheets.as_slice()), (figures, present.as_slice())];
    let runs = cases
        .iter()
        .map(|case| (out.join("runs").join(&case.name), run_files::NAMES.as_slice()));
    let mut folders = folders::check_all(folders.into_iter().chain(runs), force)?;
    let runs = folders.split_off(2);
    let mut folders = folders.into_iter();
    match (folders.next(), folders.next()) {
        (Some(sheets), Some(figures)) => Ok(Places {
            sheets,
            figures,
            runs,
        }),
        _ => unreachable!("a folder was given for each"),
    }
}
