//! From the text of a study file to the study, with every mistake shown where it was written.

use std::path::Path;

use super::factor::{Factor, Levels, Value};
use super::{Accuracy, CaseSource, DIMENSIONS, Sampling, Study, accuracy_overrides};
use crate::case::builtin;
use crate::case::name;
use crate::case::problem::{Place, Problem, Source};
use crate::case::section::{Names, Section};
use crate::case::tree::{self, Node, Table, Value as Toml};
use crate::case::{Case, CaseError};

const KEYS: [&str; 10] = [
    "name", "title", "case", "sampling", "runs", "seed", "accuracy", "set", "vary", "variants",
];
const RANGE_KEYS: [&str; 6] = ["from", "to", "values", "count", "scale", "also"];
const RANGE_HELP: &str = "write { from = 0.2, to = 0.6, count = 5 } (count in a full factorial study only), or a list of \
                          values; quantities stand in quotes with their unit";
const MOST_RUNS: f64 = (1_u64 << 52) as f64;
/// Values of a list that are tried out before anything runs; what is wrong with others their runs will tell.
const TRIED: usize = 200;

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
const SCALES: Names<bool> = &[("linear", false), ("logarithmic", true)];

/// A value and where it stands.
type Written = (Value, Place);

/// A factor being read.
struct Draft {
    factor: Factor,
    key: Place,
    /// What is tried out.
    written: Vec<Written>,
}

pub(super) fn file(path: &Path) -> Result<Study, CaseError> {
    let text = std::fs::read_to_string(path).map_err(|error| {
        let shown = path.display();
        match error.kind() {
            std::io::ErrorKind::NotFound => Problem::new(format!("there is no study file {shown}"))
                .help("check the path; docs/study.md has a study to begin with"),
            std::io::ErrorKind::InvalidData => Problem::new(format!("the study file {shown} is not text"))
                .help("a study file is TOML, saved as UTF-8"),
            _ => Problem::new(format!("the study file {shown} cannot be read: {error}"))
                .help("name a file that you may read"),
        }
    })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    self::text(&path.display().to_string(), &text, folder)
}

pub(super) fn text(source: &str, text: &str, folder: &Path) -> Result<Study, CaseError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let failed = |problems| CaseError::new(problems).of("study");
    let tree = tree::parse(&Source::new(source, text)).map_err(failed)?;
    let mut problems = Vec::new();
    let top = Section {
        path: String::new(),
        table: &tree,
        place: None,
    };
    top.allow_in(&KEYS, &[], "a study", &mut problems);
    let stem = Path::new(source).file_stem().and_then(|stem| stem.to_str());
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
            .and_then(|(case, node)| case_source(case, node, folder, &mut problems)),
        None => None,
    };
    let (Some(kind), Some(accuracy), Some(source)) = (kind, accuracy, source) else {
        return Err(failed(problems));
    };
    let mut drafts = Vec::new();
    let mut list = Vec::new();
    if kind == Kind::List {
        refuse(
            &top,
            "vary",
            "a list",
            "a list has [[variants]]; take [vary] out",
            &mut problems,
        );
        (drafts, list) = variants(&top, &mut problems);
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
        .chain(
            set.iter()
                .map(|(path, (value, _))| format!("{path}={}", value.to_toml(path))),
        )
        .collect();
    let try_out = |overrides: &[String]| Case::parse(&source.name, &source.text, &source.folder, overrides);
    // The case itself, then what is set, then each value alone.
    let base = match try_out(&everywhere) {
        Ok(base) => base,
        Err(error) if try_out(&[]).is_ok() => {
            let set = set.iter().map(|(path, written)| (path.as_str(), written));
            problems.extend(moved(error, set, None));
            return Err(failed(problems));
        }
        Err(error) => return Err(error),
    };
    for draft in &drafts {
        for (value, place) in draft.written.iter().take(TRIED) {
            for path in &draft.factor.paths {
                let mut overrides = everywhere.clone();
                overrides.push(format!("{path}={}", value.to_toml(path)));
                if let Err(error) = try_out(&overrides) {
                    let written = (value.clone(), place.clone());
                    let about_key = error.problems().iter().any(Problem::is_about_key);
                    problems.extend(moved(
                        error,
                        [(path.as_str(), &written)].into_iter(),
                        Some(&draft.key),
                    ));
                    if about_key {
                        break;
                    }
                }
            }
            if problems.iter().any(|problem| problem.is_at(&draft.key)) {
                break;
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
        return Err(failed(vec![problem.help(
            "vary fewer parameters, or take a sample of them: sampling = \"sobol\"",
        )]));
    };
    Ok(Study {
        name,
        title: title.to_owned(),
        sampling,
        accuracy,
        factors,
        set: set
            .iter()
            .map(|(path, (value, _))| format!("{path}={}", value.to_toml(path)))
            .collect(),
        base,
        list,
        source,
        count,
    })
}

/// The mistakes of a case, moved to where the study has the value, or to its key.
fn moved<'w>(
    error: CaseError,
    written: impl Iterator<Item = (&'w str, &'w Written)>,
    key: Option<&Place>,
) -> Vec<Problem> {
    let written: Vec<(&str, &Written)> = written.collect();
    let problems = error.into_problems().into_iter();
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
    problems
        .map(|problem| match place(&problem) {
            Some(place) => problem.moved_to(&place),
            None => problem,
        })
        .collect()
}

/// A table under a key; nothing if it is left out.
fn section<'t>(top: &Section<'t>, key: &str, problems: &mut Vec<Problem>) -> Option<&'t Table> {
    top.table.entry(key)?;
    top.section(key, problems).map(|section| section.table)
}

/// Notes a key that must not be there.
fn refuse(top: &Section<'_>, key: &str, what: &str, help: &str, problems: &mut Vec<Problem>) {
    if let Some(entry) = top.table.entry(key) {
        let problem = Problem::new(format!("{what} has no `{key}`")).at(&entry.key_place);
        problems.push(problem.label("not here").help(help));
    }
}

/// A whole number that may be left out.
fn whole(top: &Section<'_>, key: &str, least: f64, problems: &mut Vec<Problem>) -> Option<u64> {
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

/// The text of the case that is varied.
fn case_source(case: &str, node: &Node, folder: &Path, problems: &mut Vec<Problem>) -> Option<CaseSource> {
    let path = folder.join(case);
    if !path.is_file()
        && let Ok(text) = builtin::text(case)
    {
        return Some(CaseSource {
            name: format!("{case}.toml"),
            text: text.to_owned(),
            folder: folder.to_owned(),
        });
    }
    match std::fs::read_to_string(&path) {
        Ok(text) => Some(CaseSource {
            folder: path.parent().unwrap_or(Path::new("")).to_owned(),
            name: path.display().to_string(),
            text,
        }),
        Err(error) => {
            let shown = path.display();
            let (message, help) = match quantity::nearest(case, builtin::names()) {
                _ if error.kind() != std::io::ErrorKind::NotFound => {
                    (format!("the case file {shown} cannot be read: {error}"), String::new())
                }
                Some(near) => (
                    format!("there is neither a case file {shown} nor a built-in case \"{case}\""),
                    format!("did you mean the built-in case \"{near}\"?"),
                ),
                None => (
                    format!("there is neither a case file {shown} nor a built-in case \"{case}\""),
                    "files are looked for from the folder of the study; `wedgelab case` lists the built-in cases".to_owned(),
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

/// A value as written.
fn value(path: &str, node: &Node) -> Value {
    match &node.value {
        Toml::Number(number) if number.is_finite() => Value::Number {
            value: *number,
            unit: String::new(),
        },
        Toml::Text(text) => Value::of_text(path, text),
        _ => Value::Toml(node.place.text().to_owned()),
    }
}

/// A key under a path.
fn below(path: &str, key: &str) -> String {
    if path.is_empty() {
        key.to_owned()
    } else {
        format!("{path}.{key}")
    }
}

/// Whether a table is a value of its own, written in braces, rather than the way to others.
fn in_braces(node: &Node) -> bool {
    node.place.text().starts_with('{')
}

/// Values by path, from tables that lead to them.
fn assignments(table: &Table, path: &str, out: &mut Vec<(String, Written)>) {
    for entry in &table.entries {
        let path = below(path, &entry.key);
        match &entry.node.value {
            Toml::Table(inner) if !in_braces(&entry.node) => assignments(inner, &path, out),
            _ => out.push((
                path.clone(),
                (value(&path, &entry.node), entry.node.place.clone()),
            )),
        }
    }
}

/// The factors of `[vary]`.
fn factors(table: &Table, path: &str, kind: Kind, out: &mut Vec<Draft>, problems: &mut Vec<Problem>) {
    for entry in &table.entries {
        let path = below(path, &entry.key);
        let draft = match &entry.node.value {
            Toml::List(items) => listed(&path, items, &entry.node, problems)
                .map(|(levels, written)| (vec![path.clone()], levels, written)),
            Toml::Table(inner)
                if inner
                    .entries
                    .iter()
                    .any(|entry| RANGE_KEYS.contains(&entry.key.as_str())) =>
            {
                range(&path, inner, &entry.key_place, kind, problems)
            }
            Toml::Table(inner) if !inner.entries.is_empty() => {
                factors(inner, &path, kind, out, problems);
                continue;
            }
            other => {
                let message = format!("`{path}` is {}: it does not vary", other.describe());
                let place = &entry.node.place;
                let help = format!("{RANGE_HELP}. A value for all runs belongs below [set]");
                problems.push(
                    Problem::new(message)
                        .at(place)
                        .label("values are expected")
                        .help(help),
                );
                None
            }
        };
        if let Some((paths, levels, written)) = draft {
            out.push(Draft {
                factor: Factor { paths, levels },
                key: entry.key_place.clone(),
                written,
            });
        }
    }
}

/// A list of values.
fn listed(
    path: &str,
    items: &[Node],
    node: &Node,
    problems: &mut Vec<Problem>,
) -> Option<(Levels, Vec<Written>)> {
    if items.is_empty() {
        let problem = Problem::new(format!("`{path}` has no values")).at(&node.place);
        problems.push(problem.label("an empty list").help(RANGE_HELP));
        return None;
    }
    let written: Vec<Written> = items
        .iter()
        .map(|item| (value(path, item), item.place.clone()))
        .collect();
    for (number, (value, place)) in written.iter().enumerate() {
        if written[..number].iter().any(|(other, _)| other == value) {
            let problem = Problem::new(format!("`{path}` has the value {} twice", value.shown())).at(place);
            problems.push(
                problem
                    .label("the second time")
                    .help("take it out: its runs would be done twice"),
            );
            return None;
        }
    }
    let values = written.iter().map(|(value, _)| value.clone()).collect();
    Some((Levels::Values(values), written))
}

/// A range in braces.
fn range(
    path: &str,
    table: &Table,
    key: &Place,
    kind: Kind,
    problems: &mut Vec<Problem>,
) -> Option<(Vec<String>, Levels, Vec<Written>)> {
    let section = Section {
        path: path.to_owned(),
        table,
        place: Some(key.clone()),
    };
    let before = problems.len();
    section.allow(&RANGE_KEYS, &[], problems);
    let mut paths = vec![path.to_owned()];
    if let Some(node) = table.get("also") {
        match &node.value {
            Toml::List(items) if items.iter().all(|item| matches!(item.value, Toml::Text(_))) => {
                paths.extend(items.iter().filter_map(|item| match &item.value {
                    Toml::Text(text) => Some(text.clone()),
                    _ => None,
                }));
            }
            _ => {
                let problem = Problem::new(format!("`{path}.also` is no list of parameters")).at(&node.place);
                problems.push(
                    problem
                        .label("names in quotes")
                        .help("write also = [\"friction.slope\"]"),
                );
            }
        }
    }
    if let Some(entry) = table.entry("values") {
        for key in ["from", "to", "count", "scale"] {
            if let Some(other) = table.entry(key) {
                let problem =
                    Problem::new(format!("`{path}` has both `values` and `{key}`")).at(&other.key_place);
                problems.push(problem.label("one of them is expected").help(RANGE_HELP));
            }
        }
        let Toml::List(items) = &entry.node.value else {
            let problem = Problem::new(format!("`{path}.values` is no list")).at(&entry.node.place);
            problems.push(problem.label("a list is expected").help(RANGE_HELP));
            return None;
        };
        let (levels, written) = listed(path, items, &entry.node, problems)?;
        return (problems.len() == before).then_some((paths, levels, written));
    }
    let from = section.require("from", RANGE_HELP, problems)?;
    let to = section.require("to", RANGE_HELP, problems)?;
    let logarithmic = match table.get("scale") {
        Some(_) => section.choice("scale", SCALES, problems)?,
        None => false,
    };
    let mut wrong = |place: &Place, message: String, label: &str, help: &str| {
        problems.push(Problem::new(message).at(place).label(label).help(help));
        None
    };
    let (low, high) = (value(path, from), value(path, to));
    let (Value::Number { value: first, unit }, false) = (&low, matches!(high, Value::Toml(_))) else {
        let text = if matches!(low, Value::Toml(_)) { from } else { to };
        let message = format!(
            "`{path}` goes to or from {}, which is no number",
            text.place.text()
        );
        return wrong(
            &text.place,
            message,
            "a number with its unit is expected",
            RANGE_HELP,
        );
    };
    let Some(last) = high.in_unit(unit) else {
        let message = format!(
            "`{path}` goes from {} to {}: these do not measure the same",
            low.shown(),
            high.shown()
        );
        return wrong(
            &to.place,
            message,
            "another kind of quantity",
            "write both ends in units of one kind",
        );
    };
    if *first == last {
        let message = format!("`{path}` goes from {} to the same: nothing varies", low.shown());
        let help = "write another end, or put the value below [set]";
        return wrong(&to.place, message, "the same as `from`", help);
    }
    if *first > last {
        let message = format!("`{path}` goes from {} down to {}", low.shown(), high.shown());
        return wrong(&to.place, message, "less than `from`", "exchange from and to");
    }
    if logarithmic && *first <= 0.0 {
        let message = format!("`{path}` begins at {}: shares of it lead nowhere", low.shown());
        let help = "a logarithmic scale begins above zero; take scale = \"linear\"";
        return wrong(&from.place, message, "greater than zero is expected", help);
    }
    let count = match (kind, table.entry("count")) {
        (Kind::Factorial, Some(entry)) => match entry.node.value {
            Toml::Number(count) if count.fract() == 0.0 && (2.0..=1e9).contains(&count) => count as u64,
            _ => {
                let message = format!("`{path}.count` is {}", entry.node.place.text());
                let help = "a range has at least its two ends: count = 2 and more";
                return wrong(&entry.node.place, message, "a whole number from 2 on", help);
            }
        },
        (Kind::Factorial, None) => {
            let help = "write count = 5 into the braces, or list the values";
            let message = format!(
                "`{path}.count` is missing: how many values from {} to {}?",
                low.shown(),
                high.shown()
            );
            return wrong(key, message, "`count` is missing here", help);
        }
        (_, Some(entry)) => {
            let message = format!("`{path}` has a `count`, but a sample takes all values of a range");
            let help = "take `count` out; `runs` says how many runs there are";
            return wrong(&entry.key_place, message, "not here", help);
        }
        (_, None) => 0,
    };
    let levels = Levels::Range {
        from: *first,
        to: last,
        unit: unit.clone(),
        logarithmic,
        count,
    };
    let written = vec![(low.clone(), from.place.clone()), (high, to.place.clone())];
    (problems.len() == before).then_some((paths, levels, written))
}

/// The variants of a list: all paths that one of them sets, and for each variant its values.
fn variants(top: &Section<'_>, problems: &mut Vec<Problem>) -> (Vec<Draft>, Vec<Vec<Option<Value>>>) {
    const HELP: &str = "write [[variants]] for each of them and below it for example friction.column = 0.3";
    let mut drafts: Vec<Draft> = Vec::new();
    let mut rows: Vec<Vec<(String, Written)>> = Vec::new();
    match top.table.get("variants") {
        Some(node) => match &node.value {
            Toml::List(items) if !items.is_empty() => {
                for item in items {
                    let Toml::Table(table) = &item.value else {
                        let problem = Problem::new("a variant is no table").at(&item.place);
                        problems.push(problem.label("a table is expected").help(HELP));
                        continue;
                    };
                    let mut row = Vec::new();
                    assignments(table, "", &mut row);
                    rows.push(row);
                }
            }
            _ => problems.push(
                Problem::new("`variants` is no list of variants")
                    .at(&node.place)
                    .label("tables are expected")
                    .help(HELP),
            ),
        },
        None => problems.push(Problem::new("the list has no [[variants]]").help(HELP)),
    }
    for (path, written) in rows.iter().flatten() {
        let draft = match drafts.iter().position(|draft| draft.factor.name() == path) {
            Some(place) => &mut drafts[place],
            None => {
                drafts.push(Draft {
                    factor: Factor {
                        paths: vec![path.clone()],
                        levels: Levels::Values(Vec::new()),
                    },
                    key: written.1.clone(),
                    written: Vec::new(),
                });
                let last = drafts.len() - 1;
                &mut drafts[last]
            }
        };
        if draft.written.len() < TRIED && draft.written.iter().all(|(value, _)| *value != written.0) {
            draft.written.push(written.clone());
        }
        if let Levels::Values(values) = &mut draft.factor.levels
            && !values.contains(&written.0)
        {
            values.push(written.0.clone());
        }
    }
    let list = rows
        .iter()
        .map(|row| {
            let value = |draft: &Draft| {
                let found = row.iter().find(|(path, _)| path == draft.factor.name());
                found.map(|(_, (value, _))| value.clone())
            };
            drafts.iter().map(value).collect()
        })
        .collect();
    (drafts, list)
}

/// Paths that stand twice, or that a study cannot vary.
fn check_paths(drafts: &[Draft], set: &[(String, Written)], problems: &mut Vec<Problem>) {
    let mut seen: Vec<&str> = Vec::new();
    for draft in drafts {
        for path in &draft.factor.paths {
            let mut wrong = |message: String, help: &str| {
                problems.push(
                    Problem::new(message)
                        .at(&draft.key)
                        .label("this parameter")
                        .help(help),
                );
            };
            if seen.contains(&path.as_str()) {
                wrong(format!("`{path}` is varied twice"), "take one of them out");
            } else if set.iter().any(|(own, _)| own == path) {
                wrong(
                    format!("`{path}` is varied and set as well"),
                    "take it out of [set]",
                );
            } else if path == "simulation.output_units" {
                let help = "all runs stand in one table; set it below [set]";
                wrong("the units of the output cannot vary".to_owned(), help);
            }
            seen.push(path);
        }
    }
}
