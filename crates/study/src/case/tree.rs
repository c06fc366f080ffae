//! The case file as a tree in which every key and value knows its place.
//!
//! Three trees are laid over each other: the thesis's values, the file, and what `--set` gives.
//! Each mistake can be shown where it was written.

use super::field::quoted;
use super::problem::{Problem, Problems, TomlLocation, TomlSource};
use input::structure;
use std::sync::Arc;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value and its place.
#[derive(Clone, Debug)]
pub(crate) struct TreeNode {
    pub place: TomlLocation,
    pub value: NodeValue,
}

/// The values of TOML.
#[derive(Clone, Debug)]
pub(crate) enum NodeValue {
    Text(String),
    Number(f64),
    Truth(bool),
    Date,
    List(Vec<TreeNode>),
    Table(TableNode),
}

/// A table, in the order of the text.
#[derive(Clone, Debug, Default)]
pub(crate) struct TableNode {
    pub entries: Vec<TableEntry>,
}

/// A key and what it holds.
#[derive(Clone, Debug)]
pub(crate) struct TableEntry {
    pub key: String,
    pub key_place: TomlLocation,
    pub node: TreeNode,
}

/// Reads TOML; every mistake of syntax becomes a problem. What is too long or nested too deeply is not
/// parsed.
pub(crate) fn parse(source: &Arc<TomlSource>) -> Result<TableNode, Problems> {
    structure::toml(source.text()).map_err(|excess| {
        let place = TomlLocation {
            source: Arc::clone(source),
            span: excess.span(),
        };
        Problem::new(format!("this is not read: {excess}"))
            .at(&place)
            .label("too much")
            .help(excess.help())
    })?;
    let (table, errors) = DeTable::parse_recoverable(source.text());
    if errors.is_empty() {
        return Ok(table_of(table.get_ref(), source));
    }
    // Looked for once: there may be as many mistakes as bytes.
    let end = source.text().trim_end().len();
    let mut problems = Problems::new();
    for error in &errors {
        // The text ends there.
        let ends = !source.text().is_empty() && error.span().map_or(0, |span| span.start) >= end;
        problems.push_with(|| syntax(error, ends, source));
        // What is expected where a file ends is told once: more of it follows from the first.
        if ends {
            break;
        }
    }
    Err(problems)
}

/// Returns a mistake of syntax; `ends` tells whether it is that the text ends.
fn syntax(error: &toml::de::Error, ends: bool, source: &Arc<TomlSource>) -> Problem {
    let message = error.message().lines().collect::<Vec<_>>().join(", ");
    let span = error.span().unwrap_or(0..0);
    // A label of no length is not drawn.
    let (end, help) = match ends {
        true => (
            ", and the file ends here",
            "what was begun is not ended: the file was cut off, or a quote or bracket is missing",
        ),
        false => (
            "",
            "a line is `key = value`; text and quantities stand in quotes: angle = \"32 deg\"",
        ),
    };
    Problem::new(format!("this is not TOML: {message}{end}"))
        .at(&TomlLocation {
            source: Arc::clone(source),
            span,
        })
        .help(help)
}

fn table_of(table: &DeTable<'_>, source: &Arc<TomlSource>) -> TableNode {
    let mut entries: Vec<TableEntry> = table
        .iter()
        .map(|(key, value)| TableEntry {
            key: key.get_ref().to_string(),
            key_place: TomlLocation {
                source: Arc::clone(source),
                span: key.span(),
            },
            node: node_of(value, source),
        })
        .collect();
    entries.sort_by_key(|entry| entry.key_place.span.start);
    TableNode { entries }
}

fn node_of(value: &Spanned<DeValue<'_>>, source: &Arc<TomlSource>) -> TreeNode {
    let place = TomlLocation {
        source: Arc::clone(source),
        span: value.span(),
    };
    let value = match value.get_ref() {
        DeValue::String(text) => NodeValue::Text(text.to_string()),
        DeValue::Integer(number) => {
            let digits = i128::from_str_radix(number.as_str(), number.radix());
            NodeValue::Number(digits.map_or(f64::INFINITY, |number| number as f64))
        }
        DeValue::Float(number) => NodeValue::Number(number.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(truth) => NodeValue::Truth(*truth),
        DeValue::Datetime(_) => NodeValue::Date,
        DeValue::Array(items) => NodeValue::List(items.iter().map(|item| node_of(item, source)).collect()),
        DeValue::Table(table) => NodeValue::Table(table_of(table, source)),
    };
    TreeNode { place, value }
}

impl NodeValue {
    /// Returns the type of the node, in words.
    pub fn describe(&self) -> &'static str {
        match self {
            NodeValue::Text(_) => "text",
            NodeValue::Number(_) => "a number",
            NodeValue::Truth(_) => "true or false",
            NodeValue::Date => "a date",
            NodeValue::List(_) => "a list",
            NodeValue::Table(_) => "a table",
        }
    }

    /// Returns it as TOML: in one line, but a list of tables with one table a line. A date, which nothing
    /// reads, is empty text.
    pub fn to_toml(&self) -> String {
        match self {
            NodeValue::Text(text) => quoted(text),
            NodeValue::Number(number) if number.fract() == 0.0 && number.abs() < 1e15 => {
                format!("{number:.0}")
            }
            NodeValue::Number(number) => format!("{number:?}"),
            NodeValue::Truth(truth) => truth.to_string(),
            NodeValue::Date => quoted(""),
            NodeValue::List(items) => {
                let all: Vec<String> = items.iter().map(|item| item.value.to_toml()).collect();
                if items.iter().any(|item| matches!(item.value, NodeValue::Table(_))) {
                    let lines: Vec<String> = all.iter().map(|one| format!("\n    {one},")).collect();
                    format!("[{}\n]", lines.concat())
                } else {
                    format!("[{}]", all.join(", "))
                }
            }
            NodeValue::Table(table) => {
                let pairs = table.entries.iter();
                let all: Vec<String> = pairs
                    .map(|entry| format!("{} = {}", key(&entry.key), entry.node.value.to_toml()))
                    .collect();
                format!("{{ {} }}", all.join(", "))
            }
        }
    }
}

/// Returns a key as TOML writes it.
fn key(key: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !key.is_empty() && key.chars().all(bare) {
        key.to_owned()
    } else {
        quoted(key)
    }
}

impl TableNode {
    pub fn entry(&self, key: &str) -> Option<&TableEntry> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    pub fn get(&self, key: &str) -> Option<&TreeNode> {
        self.entry(key).map(|entry| &entry.node)
    }

    /// Returns the table under a key, if it is one.
    pub fn table(&self, key: &str) -> Option<&TableNode> {
        match &self.get(key)?.value {
            NodeValue::Table(table) => Some(table),
            _ => None,
        }
    }

    /// Returns the text under a key, if it is text.
    pub fn text(&self, key: &str) -> Option<&str> {
        match &self.get(key)?.value {
            NodeValue::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Returns whether a case file's tree describes anything: whether it has a value besides name, title and
    /// the section `simulation`, apart from defaults that this source has completed.
    pub fn gives_values(&self, defaults: &str) -> bool {
        let beside = |key: &str| matches!(key, "name" | "title" | "simulation");
        self.entries.iter().any(|entry| match &entry.node.value {
            _ if beside(&entry.key) => false,
            NodeValue::Table(table) => {
                let mut sources = table.entries.iter().map(|own| own.key_place.source.name());
                sources.any(|source| source != defaults)
            }
            _ => true,
        })
    }

    /// Returns the place of the value at a dotted path, or of the nearest table around it.
    pub fn place_of(&self, path: &str) -> Option<&TomlLocation> {
        let (key, rest) = path
            .split_once('.')
            .map_or((path, None), |(key, rest)| (key, Some(rest)));
        let entry = self.entry(key)?;
        let inner = match (&entry.node.value, rest) {
            (NodeValue::Table(table), Some(rest)) => table.place_of(rest),
            _ => None,
        };
        match entry.node.value {
            NodeValue::Table(_) => inner.or(Some(&entry.key_place)),
            _ => Some(&entry.node.place),
        }
    }

    /// Sets one key, replacing what was there.
    pub fn set(&mut self, entry: TableEntry) {
        match self.entries.iter_mut().find(|old| old.key == entry.key) {
            Some(old) => *old = entry,
            None => self.entries.push(entry),
        }
    }

    /// Takes over from `defaults` what is left out here.
    ///
    /// Tables are completed key by key, but for motions of another `shape` and for keys that
    /// exclude each other.
    pub fn complete_from(&mut self, defaults: &TableNode) {
        let has = |key| self.entry(key).is_some();
        // Of a coil's stiffness and its table one replaces the other.
        let other = [("stiffness", has("table")), ("table", has("stiffness"))];
        for default in &defaults.entries {
            match self.entries.iter_mut().find(|entry| entry.key == default.key) {
                None if other.contains(&(&*default.key, true)) => {}
                None => self.entries.push(default.clone()),
                Some(own) => {
                    if let (NodeValue::Table(own), NodeValue::Table(default)) =
                        (&mut own.node.value, &default.node.value)
                    {
                        let shapes = (own.get("shape"), own.text("shape"), default.text("shape"));
                        match shapes {
                            (None, ..) => own.complete_from(default),
                            (_, Some(shape), Some(same)) if shape == same => own.complete_from(default),
                            _ => {}
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each mistake looked through the blanks behind it: a megabyte of them took minutes.
    #[test]
    fn issue_048_many_mistakes_among_blanks_are_found_in_one_pass() {
        for text in [
            format!("a = 1{}\nb = 2\n", "\r".repeat(1 << 20)),
            format!("a = {}", "\r".repeat(1 << 20)),
        ] {
            let problems = parse(&TomlSource::new("case.toml", text)).unwrap_err();
            assert!(problems.kept().len() <= input::limits::MISTAKES);
            assert!(!problems.is_empty());
        }
    }
}
