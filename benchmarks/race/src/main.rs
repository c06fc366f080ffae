//! The solver race; `cargo xtask race` builds what it needs and starts it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use integrate::Method;
use race::contest::{SOLVERS, Tools};
use race::outcome::{repeated, write_states};
use race::page::{MeasuredOn, Results};
use race::runner::{RacePlan, TOLERANCES};
use race::{diffsol, figures, own, problem, standings, tables};

const USAGE: &str = "\
race solve SOLVER CASE TOLERANCE LIMIT FILE [ROWS]   one run of a solver that is compiled in
race all --library FILE --drivers FOLDER --out FOLDER [--cvode FILE] [--python FILE] [--exudyn FILE]
         [--octave FILE --mex FOLDER] [--cases PART,...] [--solvers PART,...] [--tolerances T,...] [--limit \
SECONDS]
         [--starts NUMBER] [--short SECONDS] [--kept-only yes]
         [--docs FOLDER --machine TEXT --cores NUMBER --date DATE --rustc VERSION]
race page RESULTS PAGE                               the page of stored results";

/// From how many starts a case runs of which only means are compared.
const STARTS: u32 = 5;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        ["solve", solver, rest @ ..] => solve(solver, rest),
        ["all", rest @ ..] => all(rest),
        ["page", results, page] => {
            Results::read(Path::new(results)).and_then(|results| write_page(&results, Path::new(page)))
        }
        _ => Err(USAGE.to_owned()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Runs a solver that is compiled in.
fn solve(solver: &str, words: &[&str]) -> Result<(), String> {
    let [case, tolerance, limit, file, rest @ ..] = words else {
        return Err(USAGE.to_owned());
    };
    let (tolerance, limit) = (number(tolerance)?, number(limit)?);
    let rows = match rest {
        [rows, ..] => number(rows)? as usize,
        [] => usize::MAX,
    };
    let own = |method, recorded| repeated(|| own::run(case, method, recorded, tolerance, limit, rows));
    let other = |method, fresh| repeated(|| diffsol::run(case, method, fresh, tolerance, limit, rows));
    let (outcome, states) = match solver {
        "rodas5p" => own(Method::Rodas5P, false),
        "rodas5p_recorded" => own(Method::Rodas5P, true),
        "own_tr_bdf2" => own(Method::TrBdf2, false),
        "own_esdirk3" => own(Method::Esdirk3, false),
        "bdf" => other(diffsol::Method::Bdf, false),
        "tr_bdf2" => other(diffsol::Method::TrBdf2, false),
        "esdirk34" => other(diffsol::Method::Esdirk34, false),
        "bdf_fresh" => other(diffsol::Method::Bdf, true),
        "tr_bdf2_fresh" => other(diffsol::Method::TrBdf2, true),
        "esdirk34_fresh" => other(diffsol::Method::Esdirk34, true),
        _ => Err(format!("there is no solver {solver}")),
    }?;
    write_states(Path::new(file), &states).map_err(|error| format!("cannot write {file}: {error}"))?;
    let line = serde_json::to_string(&outcome).map_err(|error| error.to_string())?;
    println!("{line}");
    Ok(())
}

fn number(word: &str) -> Result<f64, String> {
    word.parse::<f64>().map_err(|_| format!("`{word}` is no number"))
}

/// Returns a number of starts.
fn whole(word: &str) -> Result<u32, String> {
    let number = word.parse().ok().filter(|number| *number > 0);
    number.ok_or_else(|| format!("--starts {word}: expected 1, 2, 3, ..."))
}

/// Runs the whole race.
fn all(words: &[&str]) -> Result<(), String> {
    let mut options = std::collections::BTreeMap::new();
    for pair in words.chunks(2) {
        let [name, value] = pair else {
            return Err(USAGE.to_owned());
        };
        options.insert(*name, *value);
    }
    let file = |name: &str| options.get(name).map(PathBuf::from);
    let needed = |name: &str| file(name).ok_or_else(|| format!("{name} is missing\n{USAGE}"));
    let tools = Tools {
        own: std::env::current_exe().map_err(|error| error.to_string())?,
        library: needed("--library")?,
        drivers: needed("--drivers")?,
        cvode: file("--cvode"),
        python: file("--python"),
        exudyn: file("--exudyn"),
        octave: file("--octave").zip(file("--mex")),
    };
    // Names that contain one of the parts; of a part that is a whole name, only this one.
    let chosen = |option: &str, names: Vec<String>| -> Result<Vec<String>, String> {
        let Some(parts) = options.get(option) else {
            return Ok(names);
        };
        let found: Vec<String> = names
            .iter()
            .filter(|name| {
                parts.split(',').any(|part| {
                    let whole = names.iter().any(|name| name == part);
                    if whole { *name == part } else { name.contains(part) }
                })
            })
            .cloned()
            .collect();
        if found.is_empty() {
            return Err(format!("{option} {parts}: none of {}", names.join(", ")));
        }
        Ok(found)
    };
    let owned = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
    let solvers: Vec<&str> = SOLVERS.iter().map(|solver| solver.name).collect();
    let folder = needed("--out")?;
    let plan = RacePlan {
        cases: chosen("--cases", problem::names())?,
        solvers: chosen("--solvers", owned(&solvers))?,
        tolerances: chosen("--tolerances", owned(&TOLERANCES))?,
        limit: options.get("--limit").map_or(Ok(60.0), |limit| number(limit))?,
        folder: folder.clone(),
        short: options.get("--short").map(|short| number(short)).transpose()?,
        starts: options
            .get("--starts")
            .map_or(Ok(STARTS), |starts| whole(starts))?,
        kept_only: options.get("--kept-only") == Some(&"yes"),
    };
    let entries = plan.run(&tools)?;
    let standings = standings::judge(&folder, &entries)?;
    let write = |name: &str, bytes: &[u8]| {
        let file = folder.join(name);
        fs::write(&file, bytes).map_err(|error| format!("cannot write {}: {error}", file.display()))
    };
    write("runs.md", tables::everything(&standings).as_bytes())?;
    let json = serde_json::to_string_pretty(&standings).map_err(|error| error.to_string())?;
    write("race.json", json.as_bytes())?;
    for (name, figure) in figures::figures(&standings) {
        write(&format!("{name}.svg"), figure.to_svg().as_bytes())?;
        write(&format!("{name}.png"), &figure.to_png()?)?;
    }
    println!("\n{}", tables::ratios(&standings));
    println!("{}", folder.join("runs.md").display());
    let Some(docs) = file("--docs") else {
        return Ok(());
    };
    if ["--cases", "--solvers", "--tolerances"]
        .iter()
        .any(|part| options.contains_key(part))
    {
        println!("docs/race.md is written by a race over all cases, solvers and tolerances only.");
        return Ok(());
    }
    let option = |name: &str| options.get(name).copied().unwrap_or("unknown").to_owned();
    let measured = MeasuredOn {
        date: option("--date"),
        machine: option("--machine"),
        cores: option("--cores"),
        rustc: option("--rustc"),
        compiled_for: tables::processors().to_owned(),
        limit: plan.limit.to_string(),
    };
    let results = Results::of(&standings, measured);
    let file = docs.join("measured").join("race.json");
    fs::write(&file, results.to_json()?)
        .map_err(|error| format!("cannot write {}: {error}", file.display()))?;
    for (name, figure) in figures::figures(&standings) {
        let file = docs.join("figures").join(format!("{name}.svg"));
        fs::write(&file, figure.to_svg())
            .map_err(|error| format!("cannot write {}: {error}", file.display()))?;
    }
    write_page(&results, &docs.join("race.md"))
}

/// Writes the page.
fn write_page(results: &Results, page: &Path) -> Result<(), String> {
    fs::write(page, results.page()).map_err(|error| format!("cannot write {}: {error}", page.display()))?;
    println!("{}", page.display());
    Ok(())
}
