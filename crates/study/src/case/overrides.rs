//! `--set path.key=value`: single values laid over a case.

use super::problem::{Problem, Problems, TomlLocation, TomlSource};
use super::tree::{self, NodeValue, TableEntry, TableNode};
use std::sync::Arc;

/// The name of overrides as a source.
pub(super) const SOURCE: &str = "--set";

/// A key that excludes others of its table: an override that sets it takes the place of those that the case
/// gives.
struct Exclusive {
    table: &'static str,
    key: &'static str,
    /// The excluded keys; `None`: all others.
    excluded: Option<&'static [&'static str]>,
    /// A value with which the excluded keys stay.
    unless: Option<&'static str>,
}

const EXCLUSIVE: [Exclusive; 4] = [
    Exclusive {
        table: "track",
        key: "file",
        excluded: None,
        unless: None,
    },
    Exclusive {
        table: "track",
        key: "segments",
        excluded: Some(&["file", "center_line"]),
        unless: None,
    },
    Exclusive {
        table: "track",
        key: "center_line",
        excluded: Some(&["file", "segments", "grades"]),
        unless: None,
    },
    Exclusive {
        table: "lading",
        key: "kind",
        excluded: Some(&["masses"]),
        unless: Some("masses"),
    },
];

/// Removes what an override excludes of the case. What another override sets stays, and is a mistake.
fn exclude(tree: &mut TableNode, path: &[TableEntry], entry: &TableEntry) {
    let [table] = path else { return };
    let rule = EXCLUSIVE
        .iter()
        .find(|rule| rule.table == table.key && rule.key == entry.key);
    let Some(rule) = rule else { return };
    if matches!(&entry.node.value, NodeValue::Text(text) if Some(text.as_str()) == rule.unless) {
        return;
    }
    let table = tree.entries.iter_mut().find(|own| own.key == rule.table);
    if let Some(NodeValue::Table(table)) = table.map(|own| &mut own.node.value) {
        table.entries.retain(|own| {
            let excluded = rule.excluded.is_none_or(|keys| keys.contains(&own.key.as_str()));
            own.key == rule.key || !excluded || own.key_place.source.name() == SOURCE
        });
    }
}

/// Lays every override over the tree; the problems are those of the overrides themselves.
pub(crate) fn apply(tree: &mut TableNode, overrides: &[String]) -> Problems {
    let mut problems = Problems::new();
    for text in overrides {
        let laid = parse(text).and_then(|(path, entry)| {
            exclude(tree, &path, &entry);
            set(tree, &path, entry)
        });
        match laid {
            Ok(()) => {}
            Err(found) => problems.append(found),
        }
    }
    problems
}

/// Returns an override as a line of TOML.
pub(crate) fn to_toml(text: &str) -> Result<String, Problems> {
    let (tables, entry) = parse(text)?;
    let keys = tables.iter().chain([&entry]).map(|own| own.key.as_str());
    let path = keys.collect::<Vec<_>>().join(".");
    Ok(format!("{path} = {}", entry.node.value.to_toml()))
}

/// Returns the tables on the way, and the last key with its value.
fn parse(text: &str) -> Result<(Vec<TableEntry>, TableEntry), Problems> {
    let source = TomlSource::new(SOURCE, text);
    let whole = TomlLocation {
        source: Arc::clone(&source),
        span: 0..text.len(),
    };
    let malformed = |message: &str| {
        Problem::new(message)
            .at(&whole)
            .label("path.key=value is expected")
            .help("write for example --set friction.column=0.3 or --set 'wedge.angle=\"30 deg\"'")
    };
    let Some(equals) = equals_sign(text) else {
        return Err(malformed("this sets nothing: there is no = in it").into());
    };
    let (key, value) = (text[..equals].trim(), text[equals + 1..].trim());
    if key.is_empty() || value.is_empty() {
        let missing = if key.is_empty() {
            "the key is missing"
        } else {
            "the value is missing"
        };
        return Err(malformed(missing).into());
    }
    let (table, equals) = match tree::parse(&source) {
        Ok(table) => (table, equals),
        // Shells take quotes away: `wedge.angle=30 deg` is meant as text.
        Err(_) if !value.starts_with(['"', '\'', '[', '{']) => {
            let quoted = TomlSource::new(SOURCE, format!("{key}={}", toml::Value::from(value)));
            (tree::parse(&quoted)?, key.len())
        }
        Err(problems) => return Err(problems),
    };
    let mut path = Vec::new();
    let mut table = table;
    loop {
        let [_] = table.entries.as_slice() else {
            return Err(malformed("one --set sets one value").into());
        };
        let Some(entry) = table.entries.pop() else {
            return Err(malformed("the key is missing").into());
        };
        match entry.node.value {
            NodeValue::Table(ref inner)
                if inner
                    .entries
                    .first()
                    .is_some_and(|inner| inner.key_place.span.start < equals) =>
            {
                table = inner.clone();
                path.push(entry);
            }
            _ => return Ok((path, entry)),
        }
    }
}

/// Returns the place of the first `=` that is not inside quotes.
fn equals_sign(text: &str) -> Option<usize> {
    let mut quote = None;
    for (at, c) in text.char_indices() {
        match (quote, c) {
            (None, '=') => return Some(at),
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), c) if open == c => quote = None,
            _ => {}
        }
    }
    None
}

fn set(tree: &mut TableNode, path: &[TableEntry], entry: TableEntry) -> Result<(), Problems> {
    let Some((first, rest)) = path.split_first() else {
        tree.set(entry);
        return Ok(());
    };
    if tree.entry(&first.key).is_none() {
        let mut empty = first.clone();
        empty.node.value = NodeValue::Table(TableNode::default());
        tree.entries.push(empty);
    }
    let Some(own) = tree.entries.iter_mut().find(|own| own.key == first.key) else {
        return Ok(());
    };
    set_inside(&mut own.node.value, first, rest, entry)
}

/// Sets a key of a table, or an item of a list by its number, counted from 0: `bolster.vertical.1.amplitude`.
fn set_inside(
    within: &mut NodeValue,
    named: &TableEntry,
    path: &[TableEntry],
    entry: TableEntry,
) -> Result<(), Problems> {
    match within {
        NodeValue::Table(table) => set(table, path, entry),
        NodeValue::List(items) => {
            let key = path.first().unwrap_or(&entry);
            let (count, number) = (items.len(), key.key.parse::<usize>().ok());
            let Some(item) = number.and_then(|number| items.get_mut(number)) else {
                let last = count.saturating_sub(1);
                let message = format!("`{}` is a list of {count}; it has no `{}`", named.key, key.key);
                let problem = Problem::new(message).at(&key.key_place);
                let help = format!(
                    "items have the numbers 0 to {last}; or set all of it at once: `{}=...`",
                    named.key
                );
                return Err(problem.label("no number of an item").help(help).into());
            };
            match path.split_first() {
                Some((first, rest)) => set_inside(&mut item.value, first, rest, entry),
                None => {
                    *item = entry.node;
                    Ok(())
                }
            }
        }
        other => Err(Problem::new(format!(
            "`{}` is {} in this case, it has no `{}`",
            named.key,
            other.describe(),
            path.first().unwrap_or(&entry).key
        ))
        .at(&named.key_place)
        .label("this is no table")
        .help(format!("set all of it at once: `{}=...`", named.key))
        .into()),
    }
}
