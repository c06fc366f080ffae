//! The factors of a study in its file: lists, ranges, variants.

use std::collections::HashSet;

use input::limits;

use super::{Assigned, Draft, Kind, Written};
use crate::case::problem::{Problem, Problems, TomlLocation};
use crate::case::section::{CaseSection, Names};
use crate::case::tree::{NodeValue as Toml, TableNode, TreeNode};
use crate::design::factor::{Factor, Levels, Value};

const RANGE_KEYS: [&str; 6] = ["from", "to", "values", "count", "scale", "also"];
pub(super) const RANGE_HELP: &str = "write { from = 0.2, to = 0.6, count = 5 } (count in a full factorial \
                                     study only), or a list of values; quantities stand in quotes with \
                                     their unit";
/// Values that are tried out before anything runs; what is wrong with others their runs will tell.
pub(super) const TRIED: usize = 200;
const SCALES: Names<bool> = &[("linear", false), ("logarithmic", true)];

/// Returns a value as written.
pub(crate) fn value(path: &str, node: &TreeNode) -> Value {
    match &node.value {
        Toml::Number(number) if number.is_finite() => Value::Number {
            value: *number,
            unit: String::new(),
        },
        Toml::Text(text) => Value::of_text(path, text),
        _ => Value::Toml(node.place.text().to_owned()),
    }
}

/// Returns a key under a path.
pub(crate) fn below(path: &str, key: &str) -> String {
    if path.is_empty() {
        key.to_owned()
    } else {
        format!("{path}.{key}")
    }
}

/// Returns whether a table is a value of its own, written in braces, rather than the way to others.
fn in_braces(node: &TreeNode) -> bool {
    node.place.text().starts_with('{')
}

/// Values by path, from tables that lead to them.
pub(super) fn assignments(table: &TableNode, path: &str, out: &mut Assigned) {
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
pub(super) fn factors(
    table: &TableNode,
    path: &str,
    kind: Kind,
    out: &mut Vec<Draft>,
    problems: &mut Problems,
) {
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
                factor: Factor::new(paths, levels),
                key: entry.key_place.clone(),
                written,
                groups: Vec::new(),
            });
        }
    }
}

/// Returns a list of values.
fn listed(
    path: &str,
    items: &[TreeNode],
    node: &TreeNode,
    problems: &mut Problems,
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
    let mut seen = HashSet::new();
    for (value, place) in &written {
        if !seen.insert(value.to_toml(path)) {
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

/// Returns a range in braces.
fn range(
    path: &str,
    table: &TableNode,
    key: &TomlLocation,
    kind: Kind,
    problems: &mut Problems,
) -> Option<(Vec<String>, Levels, Vec<Written>)> {
    let section = CaseSection {
        path: path.to_owned(),
        table,
        place: Some(key.clone()),
    };
    let before = problems.count();
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
        return (problems.count() == before).then_some((paths, levels, written));
    }
    let from = section.require("from", RANGE_HELP, problems)?;
    let to = section.require("to", RANGE_HELP, problems)?;
    let logarithmic = match table.get("scale") {
        Some(_) => section.choice("scale", SCALES, problems)?,
        None => false,
    };
    let mut wrong = |place: &TomlLocation, message: String, label: &str, help: &str| {
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
        let help = match path {
            "side_frame.toe" => {
                "a toe says its direction in words: { from = \"0.2 deg in\", to = \"0.2 deg out\" }"
            }
            _ => RANGE_HELP,
        };
        return wrong(&text.place, message, "a number with its unit is expected", help);
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
    let (least, at) = match *first < last {
        true => (*first, (from, &low)),
        false => (last, (to, &high)),
    };
    if logarithmic && least <= 0.0 {
        let (end, shown) = at;
        let message = format!(
            "`{path}` has an end at {}: shares of it lead nowhere",
            shown.shown()
        );
        let help = "both ends of a logarithmic scale are above zero; take scale = \"linear\"";
        return wrong(&end.place, message, "greater than zero is expected", help);
    }
    let count = match (kind, table.entry("count")) {
        (Kind::Factorial, Some(entry)) => match entry.node.value {
            Toml::Number(count) if count.fract() == 0.0 && (2.0..=1e9).contains(&count) => count as u64,
            _ => {
                let message = format!("`{path}.count` is {}", entry.node.place.text());
                let help = "a range has at least its two ends, and at most a billion values";
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
    (problems.count() == before).then_some((paths, levels, written))
}

/// All paths that a variant sets; for each variant its values; and what it says.
type Variants = (Vec<Draft>, Vec<Vec<Option<Value>>>, Vec<Assigned>);

/// Returns the variants of a list.
pub(super) fn variants(top: &CaseSection<'_>, problems: &mut Problems) -> Variants {
    const HELP: &str = "write [[variants]] for each of them and below it for example friction.column = 0.3";
    let mut drafts: Vec<Draft> = Vec::new();
    let mut rows: Vec<Assigned> = Vec::new();
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
    let mut seen = HashSet::new();
    for (path, written) in rows.iter().flatten() {
        let draft = match drafts.iter().position(|draft| draft.factor.name() == path) {
            Some(place) => &mut drafts[place],
            None if drafts.len() == limits::FACTORS => {
                let message = format!("the variants set more than {} parameters", limits::FACTORS);
                let problem = Problem::new(message).at(&written.1).label("one too many");
                problems.push(problem.help("put what all of them share below [set]"));
                return (drafts, Vec::new(), Vec::new());
            }
            None => {
                drafts.push(Draft {
                    factor: Factor::new(vec![path.clone()], Levels::Values(Vec::new())),
                    key: written.1.clone(),
                    written: Vec::new(),
                    groups: Vec::new(),
                });
                let last = drafts.len() - 1;
                &mut drafts[last]
            }
        };
        if !seen.insert((path.as_str(), written.0.to_toml(path))) {
            continue;
        }
        draft.written.push(written.clone());
        if let Levels::Values(values) = &mut draft.factor.levels {
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
    (drafts, list, rows)
}

/// Paths that stand twice, or that a study cannot vary.
pub(super) fn check_paths(drafts: &[Draft], set: &[(String, Written)], problems: &mut Problems) {
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
