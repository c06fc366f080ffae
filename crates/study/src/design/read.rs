//! From the text of a study file to the study, with every mistake shown where it was written.

mod groups;
mod vary;

use std::collections::HashSet;
use std::path::Path;

use input::file::{Expected, Reason, read_text};
use input::{FileType, limits};

use super::factor::{Factor, Value};
use super::{Accuracy, DIMENSIONS, Sampling, Study, StudySource, accuracy_overrides};
use crate::case::name;
use crate::case::problem::{Problem, Problems, TomlLocation, TomlSource};
use crate::case::section::{CaseSection, Names};
use crate::case::tree::{self, NodeValue as Toml, TableNode, TreeNode};
use crate::case::{CASE_FILE, CASE_TABLES, CaseError};
use crate::models::{self, CaseSource};
use vary::{RANGE_HELP, TRIED, assignments, check_paths, factors, variants};
pub(crate) use vary::{below, value};

const KEYS: [&str; 11] = [
    "name", "title", "case", "sampling", "runs", "seed", "accuracy", "set", "groups", "vary", "variants",
];
const MOST_RUNS: f64 = (1_u64 << 52) as f64;
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Factorial,
    Hypercube,
    Sobol,
    List,
}

const SAMPLINGS: Names<Kind> = &[
    ("full_factorial", Kind::Factorial),
    ("latin_hypercube", Kind::Hypercube),
    ("sobol", Kind::Sobol),
    ("list", Kind::List),
];
const ACCURACIES: Names<Accuracy> = &[("case", Accuracy::Case), ("engineering", Accuracy::Engineering)];

/// A value and where it stands.
type Written = (Value, TomlLocation);

/// Values by path, as written.
type Assigned = Vec<(String, Written)>;

/// A factor being read.
struct Draft {
    factor: Factor,
    key: TomlLocation,
    /// The values that are tried.
    written: Vec<Written>,
    /// The members of the groups by name.
    groups: Vec<(String, Assigned)>,
}

impl Draft {
    /// Returns the settings of one of its values.
    fn assigned(&self, (value, place): &Written) -> Assigned {
        if self.groups.is_empty() {
            let paths = self.factor.paths.iter();
            return paths
                .map(|path| (path.clone(), (value.clone(), place.clone())))
                .collect();
        }
        let name = value.shown();
        let group = self.groups.iter().find(|(own, _)| *own == name);
        group.map(|(_, assigned)| assigned.clone()).unwrap_or_default()
    }
}

pub(super) fn file(path: &Path) -> Result<Study, CaseError> {
    const STUDY: Expected = Expected {
        what: "study file",
        types: &[FileType::Study, FileType::Case],
        most: limits::TEXT_FILE,
    };
    let text = read_text(path, &STUDY).map_err(|error| {
        let help = match error.reason {
            Reason::NotFound => "check the path; docs/study.md has a study to begin with".to_owned(),
            _ => error
                .help()
                .unwrap_or_else(|| "a study file is TOML, saved as UTF-8".to_owned()),
        };
        Problem::new(error.to_string()).help(help)
    })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    self::text(&path.display().to_string(), &text, folder, None)
}

/// With the text of the case given, no case is looked for in the folder.
pub(super) fn text(
    file: &str,
    text: &str,
    folder: &Path,
    given: Option<CaseSource>,
) -> Result<Study, CaseError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let failed = |problems| CaseError::new(problems).of("study");
    let tree = tree::parse(&TomlSource::new(file, text)).map_err(failed)?;
    let sections = CASE_TABLES.iter();
    if let Some(case) = sections
        .filter(|_| tree.entry("case").is_none())
        .find_map(|key| tree.entry(key))
    {
        let problem = Problem::new(format!("{file} is a case file; a study file is expected"));
        let problem = problem.at(&case.key_place).label("only a case has this");
        return Err(failed(problem.help(FileType::Case.advice(file)).into()));
    }
    let mut problems = Problems::new();
    let top = CaseSection {
        path: String::new(),
        table: &tree,
        place: None,
    };
    top.allow_in(&KEYS, &[], "a study", &mut problems);
    let stem = Path::new(file).file_stem().and_then(|stem| stem.to_str());
    let default_name = stem
        .filter(|stem| name::problem(stem).is_none())
        .unwrap_or("study");
    let name = match tree.get("name") {
        None => default_name.to_owned(),
        Some(_) => match top.text("name", &mut problems) {
            Some((text, node)) => {
                problems.extend(name::problem(text).map(|problem| problem.at(&node.place)));
                text.to_owned()
            }
            None => String::new(),
        },
    };
    let optional = |key: &str| tree.get(key).is_some();
    let title = match optional("title") {
        true => top.text("title", &mut problems).map_or("", |(text, _)| text),
        false => "",
    };
    let accuracy = match optional("accuracy") {
        true => top.choice("accuracy", ACCURACIES, &mut problems),
        false => Some(Accuracy::Case),
    };
    let kind = top.choice("sampling", SAMPLINGS, &mut problems);
    let runs = whole(&top, "runs", 1.0, &mut problems);
    let seed = whole(&top, "seed", 0.0, &mut problems);
    let mut set = Vec::new();
    if let Some(section) = section(&top, "set", &mut problems) {
        assignments(section, "", &mut set);
    }
    let help = "write case = \"vdrun_toe_0_psi_0.012\", or the name of a case file beside the study";
    let source = match top.require("case", help, &mut problems) {
        Some(_) => top
            .text("case", &mut problems)
            .and_then(|(case, node)| given.or_else(|| case_source(case, node, folder, &mut problems))),
        None => None,
    };
    let (Some(kind), Some(accuracy), Some(source)) = (kind, accuracy, source) else {
        return Err(failed(problems));
    };
    let is_file = matches!(source, CaseSource::File { .. });
    if let (Accuracy::Engineering, false, Some(node)) = (accuracy, is_file, tree.get("accuracy")) {
        let problem =
            Problem::new("engineering accuracy is a choice for case files, and the case is a half-truck");
        let help = "take `accuracy` out; simulation.relative_tolerance below [set] says how tightly \
                    half-trucks are integrated";
        problems.push(problem.at(&node.place).label("not here").help(help));
        return Err(failed(problems));
    }
    let mut drafts = Vec::new();
    let mut list = Vec::new();
    let mut rows = Vec::new();
    if kind == Kind::List {
        refuse(
            &top,
            "vary",
            "a list",
            "a list has [[variants]]; take [vary] out",
            &mut problems,
        );
        (drafts, list, rows) = variants(&top, &mut problems);
    } else {
        let help = "[[variants]] belong to sampling = \"list\"";
        refuse(&top, "variants", "this sampling", help, &mut problems);
        match section(&top, "vary", &mut problems) {
            Some(table) => factors(table, "", kind, &mut drafts, &mut problems),
            None if optional("vary") => {}
            None => problems.push(
                Problem::new("nothing is varied: there is no [vary]")
                    .help("write [vary] and below it for example friction.column = [0.3, 0.4, 0.5]"),
            ),
        }
        if drafts.is_empty() && problems.is_empty() {
            problems.push(Problem::new("nothing is varied: [vary] is empty").help(RANGE_HELP));
        }
    }
    groups::find(&top, &mut drafts, &mut problems);
    let varied: usize = drafts.iter().map(|draft| draft.factor.paths.len()).sum();
    if varied.max(set.len()) > limits::FACTORS {
        let message = format!("more than {} parameters are varied or set", limits::FACTORS);
        let help = "vary fewer of them; what all runs share belongs into the case file";
        return Err(failed(Problem::new(message).help(help).into()));
    }
    check_paths(&drafts, &set, &mut problems);
    let samples = matches!(kind, Kind::Hypercube | Kind::Sobol);
    if samples && runs.is_none() && !optional("runs") {
        problems.push(
            Problem::new("`runs` is missing: a sample needs the number of its runs")
                .help("write for example runs = 256"),
        );
    }
    if !samples {
        let help = "the number of runs follows from the values; take `runs` out";
        refuse(&top, "runs", "this sampling", help, &mut problems);
        let help = "`seed` belongs to samplings latin_hypercube and sobol";
        refuse(&top, "seed", "this sampling", help, &mut problems);
    }
    if kind == Kind::Sobol && drafts.len() > DIMENSIONS {
        let message = format!(
            "{} parameters are varied; the Sobol' sequence here has {DIMENSIONS}",
            drafts.len()
        );
        problems.push(Problem::new(message).help("vary fewer, or take sampling = \"latin_hypercube\""));
    }
    let everywhere: Vec<String> = accuracy_overrides(accuracy)
        .chain(set.iter().map(overriding))
        .collect();
    let try_out = |overrides: &[String]| source.case(overrides);
    // The case itself, then what is set, then each value alone.
    let base = match try_out(&everywhere) {
        Ok(base) => base,
        Err(error) if try_out(&[]).is_ok() => {
            let set = set.iter().map(|(path, written)| (path.as_str(), written));
            problems.append(moved(error, set, None));
            return Err(failed(problems));
        }
        Err(error) => return Err(error),
    };
    let grouped = drafts.iter().any(|draft| !draft.groups.is_empty());
    let mut try_over = |assigned: &[(String, Written)], key: Option<&TomlLocation>| {
        let overrides: Vec<String> = everywhere
            .iter()
            .cloned()
            .chain(assigned.iter().map(overriding))
            .collect();
        let Err(error) = try_out(&overrides) else {
            return false;
        };
        let about_key = error.problems().iter().any(Problem::is_about_key);
        let set = set.iter().chain(assigned);
        let written: Vec<_> = set.map(|(path, written)| (path.as_str(), written)).collect();
        problems.append(moved(error, written.into_iter().rev(), key));
        about_key
    };
    if kind == Kind::List && grouped {
        let mut tried_rows = 0;
        // Values of groups need each other: rows are tried whole, as long as one has a value of its own.
        let mut seen = HashSet::new();
        for row in rows {
            let values = row.iter();
            let new = values.filter(|(path, (value, _))| seen.insert((path.clone(), value.to_toml(path))));
            if new.count() == 0 || tried_rows == TRIED {
                continue;
            }
            tried_rows += 1;
            let whole: Assigned = drafts
                .iter()
                .filter_map(|draft| {
                    let (_, written) = row.iter().find(|(path, _)| path == draft.factor.name())?;
                    Some(draft.assigned(written))
                })
                .flatten()
                .collect();
            try_over(&whole, None);
        }
    } else {
        let tried = (TRIED / varied.max(1)).max(2);
        'drafts: for draft in &drafts {
            for written in draft.written.iter().take(tried) {
                let all = draft.assigned(written);
                // A group at once; values that go together each for itself.
                let size = if draft.groups.is_empty() {
                    1
                } else {
                    all.len().max(1)
                };
                let key = draft.groups.is_empty().then_some(&draft.key);
                for part in all.chunks(size) {
                    if try_over(part, key) && key.is_some() {
                        continue 'drafts;
                    }
                }
            }
        }
    }
    if !problems.is_empty() {
        return Err(failed(problems));
    }
    let sampling = match kind {
        Kind::Factorial => Sampling::FullFactorial,
        Kind::Hypercube => Sampling::LatinHypercube {
            runs: runs.unwrap_or(1),
            seed: seed.unwrap_or(0),
        },
        Kind::Sobol => Sampling::Sobol {
            runs: runs.unwrap_or(1),
            seed,
        },
        Kind::List => Sampling::List,
    };
    let factors: Vec<Factor> = drafts.into_iter().map(|draft| draft.factor).collect();
    let count = match kind {
        Kind::Factorial => factors
            .iter()
            .try_fold(1_u64, |product, factor| product.checked_mul(factor.count()))
            .filter(|count| *count as f64 <= MOST_RUNS),
        Kind::Hypercube | Kind::Sobol => runs,
        Kind::List => Some(list.len() as u64),
    };
    let Some(count) = count else {
        let problem = Problem::new("the study has more runs than can be counted");
        let help = "vary fewer parameters, or take a sample of them: sampling = \"sobol\"";
        return Err(failed(problem.help(help).into()));
    };
    Ok(Study {
        name,
        title: title.to_owned(),
        sampling,
        accuracy,
        factors,
        set: set.iter().map(overriding).collect(),
        measures: base.definitions(),
        base,
        list,
        source: StudySource {
            name: file.to_owned(),
            text: text.to_owned(),
            folder: folder.to_owned(),
            case: source,
        },
        count,
    })
}

/// Returns all values below a table, as `--set` takes them; a table in braces is one value.
pub(crate) fn settings(table: &TableNode) -> Vec<String> {
    let mut assigned = Vec::new();
    assignments(table, "", &mut assigned);
    assigned.iter().map(overriding).collect()
}

/// Returns a value as `--set` takes it.
fn overriding((path, (value, _)): &(String, Written)) -> String {
    format!("{path}={}", value.to_toml(path))
}

/// Returns the mistakes of a case, moved to where the study has the value, or to its key.
fn moved<'w>(
    error: CaseError,
    written: impl Iterator<Item = (&'w str, &'w Written)>,
    key: Option<&TomlLocation>,
) -> Problems {
    let written: Vec<(&str, &Written)> = written.collect();
    let place = |problem: &Problem| {
        if problem.is_about_key()
            && let Some(key) = key
        {
            return Some(key.clone());
        }
        let path = problem.set_path();
        let own = written.iter().find(|(own, _)| Some(*own) == path);
        let found = own.or(written.first());
        found.map(|(_, (_, place))| place.clone())
    };
    error.into_problems().map(|problem| match place(&problem) {
        Some(place) => problem.moved_to(&place),
        None => problem,
    })
}

/// Returns a table under a key; nothing if it is left out.
fn section<'t>(top: &CaseSection<'t>, key: &str, problems: &mut Problems) -> Option<&'t TableNode> {
    top.table.entry(key)?;
    top.section(key, problems).map(|section| section.table)
}

/// Notes a key that must not be there.
fn refuse(top: &CaseSection<'_>, key: &str, what: &str, help: &str, problems: &mut Problems) {
    if let Some(entry) = top.table.entry(key) {
        let problem = Problem::new(format!("{what} has no `{key}`")).at(&entry.key_place);
        problems.push(problem.label("not here").help(help));
    }
}

/// Returns a whole number that may be left out.
fn whole(top: &CaseSection<'_>, key: &str, least: f64, problems: &mut Problems) -> Option<u64> {
    let node = top.table.get(key)?;
    match node.value {
        Toml::Number(value) if value.fract() == 0.0 && value >= least && value <= MOST_RUNS => {
            Some(value as u64)
        }
        _ => {
            let text = node.place.text();
            let problem = Problem::new(format!(
                "`{key}` is {text}; a whole number, at least {least}, is expected"
            ));
            let label = format!("a whole number from {least} to {MOST_RUNS}");
            problems.push(
                problem
                    .at(&node.place)
                    .label(label)
                    .help(format!("write for example {key} = 256")),
            );
            None
        }
    }
}

/// Returns the text of the case that is varied.
pub(crate) fn case_source(
    case: &str,
    node: &TreeNode,
    folder: &Path,
    problems: &mut Problems,
) -> Option<CaseSource> {
    let path = folder.join(case);
    match CaseSource::half_truck(folder, Path::new(case)) {
        Ok(None) => {}
        Ok(Some(source)) => return Some(source),
        Err(error) => {
            let help = "files are looked for from the folder of the study; `wedgelab nucars run --list` \
                        lists the built-in half-trucks";
            let problem = Problem::new(error.to_string()).at(&node.place);
            problems.push(problem.label("this run file").help(help));
            return None;
        }
    }
    if !path.is_file()
        && let Some(own) = models::built_in(case)
    {
        return Some(CaseSource::File {
            name: format!("{case}.toml"),
            text: own.text().to_owned(),
            folder: folder.to_owned(),
        });
    }
    match read_text(&path, &CASE_FILE) {
        Ok(text) => Some(CaseSource::File {
            folder: path.parent().unwrap_or(Path::new("")).to_owned(),
            name: path.display().to_string(),
            text,
        }),
        Err(error) => {
            let shown = path.display();
            let (message, help) = match quantity::nearest(case, models::built_in_names()) {
                _ if !matches!(error.reason, Reason::NotFound) => {
                    (error.to_string(), error.help().unwrap_or_default())
                }
                Some(near) => (
                    format!("there is neither a case file {shown} nor a built-in case \"{case}\""),
                    format!("did you mean the built-in case \"{near}\"?"),
                ),
                None => (
                    format!("there is neither a case file {shown} nor a built-in case \"{case}\""),
                    "files are looked for from the folder of the study; `wedgelab case` lists the built-in \
                     cases"
                        .to_owned(),
                ),
            };
            problems.push(
                Problem::new(message)
                    .at(&node.place)
                    .label("this case")
                    .help(help),
            );
            None
        }
    }
}
