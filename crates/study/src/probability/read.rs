//! From the text of a plan to the plan, with every mistake shown where it was written.

mod law;
mod limit;
mod method;

use std::path::Path;

use input::FileType;

use super::plan::{Plan, Uncertain, UncertainValues};
use crate::car::named;
use crate::case::CaseError;
use crate::case::name;
use crate::case::problem::{Problem, Problems, TomlLocation, TomlSource};
use crate::case::section::{CaseSection, Range};
use crate::case::tree::{self, NodeValue, TableNode};
use crate::design::{Value, below, case_source, settings};
use crate::models::CaseSource;

const KEYS: [&str; 20] = [
    "name",
    "title",
    "case",
    "set",
    "uncertain",
    "measure",
    "at_most",
    "at_least",
    "limit",
    "method",
    "runs",
    "samples",
    "repeats",
    "level_probability",
    "levels",
    "most_runs",
    "seed",
    "confidence",
    "indices",
    "remark",
];
const UNCERTAIN_HELP: &str = "write [uncertain] and below it for example friction.column = { distribution = \
                              \"uniform\", from = 0.3, to = 0.5, mark = \"guess\" }";
/// Values without an end are tried this many standard deviations from the middle: once in 3.5 million.
const TRIED: f64 = 5.0;

pub(super) fn file(path: &Path) -> Result<Plan, CaseError> {
    let types = &[FileType::Study, FileType::Case];
    let text = named::read(
        path,
        "plan of a probability",
        types,
        "docs/probability.md has a plan to begin with",
    )?;
    let folder = path.parent().unwrap_or(Path::new(""));
    self::text(&path.display().to_string(), &text, folder)
}

pub(super) fn text(file: &str, text: &str, folder: &Path) -> Result<Plan, CaseError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let failed = |problems| CaseError::new(problems).of("plan");
    let tree = tree::parse(&TomlSource::new(file, text)).map_err(failed)?;
    let mut problems = Problems::new();
    let top = CaseSection {
        path: String::new(),
        table: &tree,
        place: None,
    };
    top.allow_in(&KEYS, &[], "a plan", &mut problems);
    let given = |key: &str| tree.get(key).is_some();
    let own_name = name::read(&top, name::of_source_or(file, "plan"), &mut problems);
    let title = top.optional_text("title", &mut problems);
    top.optional_text("remark", &mut problems);
    let mut set = match given("set") {
        true => top
            .section("set", &mut problems)
            .map_or(Vec::new(), |own| settings(own.table)),
        false => Vec::new(),
    };
    let mut drafts = Vec::new();
    if given("uncertain")
        && let Some(section) = top.section("uncertain", &mut problems)
    {
        uncertain(section.table, "", &mut drafts, &mut problems);
    }
    if drafts.is_empty() && problems.is_empty() {
        problems.push(Problem::new("nothing is uncertain: there is no [uncertain]").help(UNCERTAIN_HELP));
    }
    check_paths(&drafts, &tree, &mut problems);
    let confidence = match given("confidence") {
        true => {
            let range = Range::Between(0.5, 1.0, "above 0.5 and below 1");
            top.number("confidence", range, "0.95", &mut problems)
        }
        false => Some(0.95),
    };
    let method = method::read(&top, drafts.len(), &mut problems);
    let help = "write case = \"car_twist_and_roll_loaded\", or the name of a case file beside the plan";
    let source = match top.require("case", help, &mut problems) {
        Some(_) => top
            .text("case", &mut problems)
            .and_then(|(case, node)| case_source(case, node, folder, &mut problems)),
        None => None,
    };
    let named = limit::named(&top, folder, &mut problems);
    let Some(source) = source.filter(|_| problems.is_empty()) else {
        return Err(failed(problems));
    };
    // The windows and filters of a rule, then what is set.
    let rule = named.as_ref().map_or(&[][..], |own| &own.output);
    set = rule.iter().cloned().chain(set).collect();
    let base = match source.case(&set) {
        Ok(base) => base,
        Err(error) if source.case(&[]).is_ok() => return Err(failed(moved(error, &tree))),
        Err(error) => return Err(error),
    };
    let measures = base.definitions();
    let limit = limit::read(&top, named, &measures, &mut problems);
    try_out(&source, &set, &drafts, &mut problems);
    let (Some(limit), Some((estimator, indices)), Some(confidence), true) =
        (limit, method, confidence, problems.is_empty())
    else {
        return Err(failed(problems));
    };
    Ok(Plan {
        name: own_name.unwrap_or_default(),
        title: title.unwrap_or_default(),
        uncertain: drafts.into_iter().map(|own| own.uncertain).collect(),
        set,
        limit,
        estimator,
        indices,
        confidence,
        base,
        measures,
        source,
    })
}

/// An uncertain parameter being read.
struct Draft {
    uncertain: Uncertain,
    key: TomlLocation,
    /// The place of its distribution.
    law: TomlLocation,
    /// Values that are tried, and their places: ends as written, discrete values.
    written: Vec<(Value, TomlLocation)>,
}

/// Reads the uncertain parameters below a table.
fn uncertain(table: &TableNode, path: &str, drafts: &mut Vec<Draft>, problems: &mut Problems) {
    for entry in &table.entries {
        let path = below(path, &entry.key);
        match &entry.node.value {
            NodeValue::Table(inner) if law::is_law(inner) || inner.entries.is_empty() => {
                let section = CaseSection {
                    path: path.clone(),
                    table: inner,
                    place: Some(entry.key_place.clone()),
                };
                if let Some((uncertain, written)) = law::read(&section, problems) {
                    drafts.push(Draft {
                        uncertain,
                        key: entry.key_place.clone(),
                        law: inner
                            .entry("distribution")
                            .map_or(&entry.key_place, |own| &own.node.place)
                            .clone(),
                        written,
                    });
                }
            }
            NodeValue::Table(inner) => uncertain(inner, &path, drafts, problems),
            other => {
                let message = format!("`{path}` is {}, without a distribution", other.describe());
                let problem = Problem::new(message).at(&entry.node.place);
                let help = format!("{UNCERTAIN_HELP}. A value that is certain belongs below [set]");
                problems.push(problem.label("a distribution is expected").help(help));
            }
        }
    }
}

/// Notes parameters that are uncertain twice, or set as well.
fn check_paths(drafts: &[Draft], tree: &TableNode, problems: &mut Problems) {
    let set = match tree.get("set").map(|node| &node.value) {
        Some(NodeValue::Table(table)) => settings(table),
        _ => Vec::new(),
    };
    let mut seen: Vec<&str> = Vec::new();
    for draft in drafts {
        for path in &draft.uncertain.paths {
            let mut wrong = |message: String, help: &str| {
                let problem = Problem::new(message).at(&draft.key).label("this parameter");
                problems.push(problem.help(help));
            };
            if seen.contains(&path.as_str()) {
                wrong(format!("`{path}` is uncertain twice"), "take one of them out");
            } else if set.iter().any(|own| own.split('=').next() == Some(path)) {
                wrong(
                    format!("`{path}` is uncertain and set as well"),
                    "take it out of [set]",
                );
            } else if path == "simulation.output_units" {
                let help = "all runs stand in one table; set it below [set]";
                wrong("the units of the output cannot be uncertain".to_owned(), help);
            }
            seen.push(path);
        }
    }
}

/// Returns the mistakes of a case, moved to where the plan sets the value.
fn moved(error: CaseError, tree: &TableNode) -> Problems {
    error.into_problems().map(|problem| {
        let path = problem.set_path().map(|path| format!("set.{path}"));
        let place = path
            .and_then(|path| tree.place_of(&path))
            .or(tree.place_of("limit"));
        match place.or(tree.place_of("set")) {
            Some(place) => problem.moved_to(place),
            None => problem,
        }
    })
}

/// Tries each uncertain parameter at its ends and discrete values, or, where it has no end, far out.
fn try_out(source: &CaseSource, set: &[String], drafts: &[Draft], problems: &mut Problems) {
    for draft in drafts {
        let own = &draft.uncertain;
        let ends = match &own.values {
            UncertainValues::Numbers { of, .. } => of.ends(),
            UncertainValues::Discrete { .. } => [0.0; 2],
        };
        let open = ends
            .iter()
            .zip([-TRIED, TRIED])
            .filter(|(end, _)| end.is_infinite());
        let far = open.map(|(_, u)| (own.at(u), None));
        let written = draft
            .written
            .iter()
            .map(|(value, place)| (value.clone(), Some(place)));
        'values: for (value, place) in written.chain(far) {
            for path in &own.paths {
                let over = format!("{path}={}", value.to_toml(path));
                let all: Vec<String> = set.iter().cloned().chain([over]).collect();
                let Err(error) = source.case(&all) else { continue };
                let about_key = error.problems().iter().any(Problem::is_about_key);
                let shown = value.shown().into_owned();
                problems.append(error.into_problems().map(|problem| match (place, about_key) {
                    (_, true) => problem.moved_to(&draft.key),
                    (Some(place), false) => problem.moved_to(place),
                    (None, false) => far_out(&problem, (path, &shown), &draft.law),
                }));
                if about_key {
                    break 'values;
                }
            }
        }
    }
}

/// Returns the mistake of a value that a distribution without an end reaches.
fn far_out(problem: &Problem, (path, shown): (&str, &str), law: &TomlLocation) -> Problem {
    let message = format!(
        "the distribution of `{path}` reaches {shown} (once in 3.5 million): {}",
        problem.message()
    );
    Problem::new(message)
        .at(law)
        .label("beyond the key's range")
        .help("cut it off: write `from` and `to` within the key's range")
}
