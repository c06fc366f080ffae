//! Reading one table of a case: typed values, ranges, unknown keys.

use super::bounds;
use super::problem::{Problem, Problems, TomlLocation};
use super::tree::{NodeValue, TableNode, TreeNode};
use input::shortened;
use quantity::{Kind, Quantity, System, UnitError, nearest};

/// The range a value must lie in.
#[derive(Clone, Copy)]
pub(crate) enum Range {
    /// Any finite value.
    Any,
    /// Greater than zero.
    Positive,
    /// Zero or greater.
    NotNegative,
    /// Between two values, both excluded, SI; with the words for it.
    Between(f64, f64, &'static str),
    /// From zero to a value, both included; with the words for it.
    UpTo(f64, &'static str),
}

impl Range {
    fn holds(self, value: f64) -> bool {
        match self {
            Range::Any => value.is_finite(),
            Range::Positive => value > 0.0 && value.is_finite(),
            Range::NotNegative => value >= 0.0 && value.is_finite(),
            Range::Between(low, high, _) => value > low && value < high,
            Range::UpTo(high, _) => (0.0..=high).contains(&value),
        }
    }

    /// Returns its ends, SI: infinite where it has none.
    pub fn ends(self) -> [f64; 2] {
        match self {
            Range::Any => [f64::NEG_INFINITY, f64::INFINITY],
            Range::Positive | Range::NotNegative => [0.0, f64::INFINITY],
            Range::Between(low, high, _) => [low, high],
            Range::UpTo(high, _) => [0.0, high],
        }
    }

    fn words(self) -> &'static str {
        match self {
            Range::Any => "a finite number",
            Range::Positive => "greater than zero",
            Range::NotNegative => "zero or greater",
            Range::Between(.., words) | Range::UpTo(_, words) => words,
        }
    }
}

/// Names of choices in the file, and what they mean.
pub(crate) type Names<T> = &'static [(&'static str, T)];

/// Returns the name of a choice.
pub(crate) fn name_of<T: PartialEq>(names: Names<T>, choice: &T) -> &'static str {
    names
        .iter()
        .find(|(_, other)| other == choice)
        .map_or("", |(name, _)| name)
}

/// One table of the case, by its path. Its readers note what is wrong and return nothing then.
pub(crate) struct CaseSection<'a> {
    /// `wedge`, `bolster.vertical`; empty at the top.
    pub path: String,
    pub table: &'a TableNode,
    /// The place at which the table is named.
    pub place: Option<TomlLocation>,
}

impl<'a> CaseSection<'a> {
    pub fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() {
            key.into()
        } else {
            format!("{}.{key}", self.path)
        }
    }

    /// Returns the table under a key.
    pub fn section(&self, key: &str, problems: &mut Problems) -> Option<CaseSection<'a>> {
        let entry = self.table.entry(key)?;
        let NodeValue::Table(table) = &entry.node.value else {
            let found = entry.node.value.describe();
            problems.push(
                Problem::new(format!("`{}` is {found}; a table is expected", self.path_of(key)))
                    .at(&entry.node.place)
                    .label("not a table")
                    .help(format!(
                        "write [{}] on a line of its own and the keys below it",
                        self.path_of(key)
                    )),
            );
            return None;
        };
        Some(CaseSection {
            path: self.path_of(key),
            table,
            place: Some(entry.key_place.clone()),
        })
    }

    /// Returns the tables of a list, `[[key]]`.
    pub fn tables(&self, key: &str, problems: &mut Problems) -> Vec<CaseSection<'a>> {
        let Some(node) = self.table.get(key) else {
            return Vec::new();
        };
        let not_a_list = |node: &TreeNode, problems: &mut Problems| {
            let problem = Problem::new(format!(
                "`{}` holds {}; tables are expected",
                self.path_of(key),
                node.value.describe()
            ));
            problems.push(
                problem
                    .at(&node.place)
                    .label("not a table")
                    .help(format!("write [[{}]] on a line of its own", self.path_of(key))),
            );
        };
        let NodeValue::List(items) = &node.value else {
            not_a_list(node, problems);
            return Vec::new();
        };
        let mut found = Vec::new();
        for (number, item) in items.iter().enumerate() {
            match &item.value {
                NodeValue::Table(table) => {
                    let mut place = item.place.clone();
                    // Its first bracket: the rest may be long.
                    place.span.end = place.span.end.min(place.span.start + 1);
                    found.push(CaseSection {
                        path: format!("{}[{number}]", self.path_of(key)),
                        table,
                        place: Some(place),
                    });
                }
                _ => not_a_list(item, problems),
            }
        }
        found
    }

    /// Returns the value of a key that must be there.
    pub fn require(&self, key: &str, help: &str, problems: &mut Problems) -> Option<&'a TreeNode> {
        let node = self.table.get(key);
        if node.is_none() {
            let mut problem = Problem::new(format!("`{}` is missing", self.path_of(key)))
                .label(format!("`{key}` is missing here"))
                .help(help);
            if let Some(place) = &self.place {
                problem = problem.at(place);
            }
            problems.push(problem);
        }
        node
    }

    /// Notes every key that is not among `keys`.
    pub fn allow(&self, keys: &[&str], elsewhere: &[(&str, &[&str])], problems: &mut Problems) {
        self.allow_in(keys, elsewhere, "a case", problems);
    }

    /// The same; `top` says what the topmost table is.
    pub fn allow_in(&self, keys: &[&str], elsewhere: &[(&str, &[&str])], top: &str, problems: &mut Problems) {
        for entry in self
            .table
            .entries
            .iter()
            .filter(|entry| !keys.contains(&entry.key.as_str()))
        {
            // A key with another mistake is known, but its reader stopped there.
            if problems.is_at(&entry.node.place) {
                continue;
            }
            problems.push_with(|| {
                let owner = elsewhere
                    .iter()
                    .find(|(_, keys)| keys.contains(&entry.key.as_str()));
                let help = match (nearest(&entry.key, keys.iter().copied()), owner) {
                    (Some(near), _) => format!("did you mean `{near}`?"),
                    (None, Some((owner, _))) => format!("`{}` belongs below [{owner}]", entry.key),
                    (None, None) => {
                        // A key stands once for each of its shapes.
                        let mut known: Vec<&str> = Vec::with_capacity(keys.len());
                        for key in keys {
                            if !known.contains(key) {
                                known.push(key);
                            }
                        }
                        format!("known here: {}", known.join(", "))
                    }
                };
                let place = if self.path.is_empty() {
                    format!("in {top}")
                } else {
                    format!("in `{}`", self.path)
                };
                Problem::new(format!("there is no key `{}` {place}", shortened(&entry.key)))
                    .at(&entry.key_place)
                    .label("unknown key")
                    .help(help)
            });
        }
    }

    pub fn quantity(&self, key: &str, kind: Kind, range: Range, problems: &mut Problems) -> Option<Quantity> {
        let node = self.require(
            key,
            &format!("write for example {key} = \"{}\"", example(kind)),
            problems,
        )?;
        quantity(node, &self.path_of(key), kind, range, problems)
    }

    /// Three quantities in a list.
    pub fn triple(
        &self,
        key: &str,
        kind: Kind,
        range: Range,
        problems: &mut Problems,
    ) -> Option<[Quantity; 3]> {
        let one = example(kind);
        let help = format!("write for example {key} = [\"{one}\", \"{one}\", \"{one}\"]");
        let node = self.require(key, &help, problems)?;
        let path = self.path_of(key);
        match &node.value {
            NodeValue::List(items) if items.len() == 3 => {
                let mut read =
                    |at: usize| quantity(&items[at], &format!("{path}[{at}]"), kind, range, problems);
                let triple = [read(0), read(1), read(2)];
                let [Some(a), Some(b), Some(c)] = triple else {
                    return None;
                };
                Some([a, b, c])
            }
            NodeValue::List(items) => {
                let message = format!("`{path}` has {} entries; three are expected", items.len());
                problems.push(
                    Problem::new(message)
                        .at(&node.place)
                        .label("three quantities")
                        .help(help),
                );
                None
            }
            other => {
                let message = format!(
                    "`{path}` is {}; a list of three quantities is expected",
                    other.describe()
                );
                problems.push(
                    Problem::new(message)
                        .at(&node.place)
                        .label("not a list")
                        .help(help),
                );
                None
            }
        }
    }

    /// Returns a pure number.
    pub fn number(&self, key: &str, range: Range, example: &str, problems: &mut Problems) -> Option<f64> {
        let help = format!("write for example {key} = {example}");
        let node = self.require(key, &help, problems)?;
        let path = self.path_of(key);
        match node.value {
            NodeValue::Number(value) if range.holds(value) => Some(value),
            NodeValue::Number(_) => {
                let message = format!("`{path}` is {}; it must be {}", node.place.text(), range.words());
                problems.push(
                    Problem::new(message)
                        .at(&node.place)
                        .label(range.words())
                        .help(help),
                );
                None
            }
            ref other => {
                let message = format!(
                    "`{path}` is {}; a number without quotes and unit is expected",
                    other.describe()
                );
                problems.push(
                    Problem::new(message)
                        .at(&node.place)
                        .label("a number is expected")
                        .help(help),
                );
                None
            }
        }
    }

    pub fn truth(&self, key: &str, problems: &mut Problems) -> Option<bool> {
        let help = format!("write {key} = true or {key} = false, without quotes");
        let node = self.require(key, &help, problems)?;
        if let NodeValue::Truth(truth) = node.value {
            return Some(truth);
        }
        let message = format!(
            "`{}` is {}; true or false is expected",
            self.path_of(key),
            node.value.describe()
        );
        problems.push(
            Problem::new(message)
                .at(&node.place)
                .label("true or false")
                .help(help),
        );
        None
    }

    pub fn text(&self, key: &str, problems: &mut Problems) -> Option<(&'a str, &'a TreeNode)> {
        let help = format!("write {key} = \"...\"");
        let node = self.require(key, &help, problems)?;
        if let NodeValue::Text(text) = &node.value {
            return Some((text, node));
        }
        let message = format!(
            "`{}` is {}; text is expected",
            self.path_of(key),
            node.value.describe()
        );
        problems.push(
            Problem::new(message)
                .at(&node.place)
                .label("text in quotes is expected")
                .help(help),
        );
        None
    }

    /// Returns a text, an empty one if the key is left out.
    pub fn optional_text(&self, key: &str, problems: &mut Problems) -> Option<String> {
        match self.table.get(key) {
            Some(_) => self.text(key, problems).map(|(text, _)| text.to_owned()),
            None => Some(String::new()),
        }
    }

    pub fn choice<T: Copy>(&self, key: &str, names: Names<T>, problems: &mut Problems) -> Option<T> {
        let node = self.require(key, &one_of(names), problems)?;
        choice(node, &self.path_of(key), names, problems)
    }
}

/// Reads one of several names.
pub(crate) fn choice<T: Copy>(
    node: &TreeNode,
    path: &str,
    names: Names<T>,
    problems: &mut Problems,
) -> Option<T> {
    let message = match &node.value {
        NodeValue::Text(text) => match names.iter().find(|(name, _)| name == text) {
            Some((_, choice)) => return Some(*choice),
            None => format!("`{path}` cannot be \"{text}\""),
        },
        other => format!("`{path}` is {}; a name in quotes is expected", other.describe()),
    };
    let near = match &node.value {
        NodeValue::Text(text) => nearest(text, names.iter().map(|(name, _)| *name)),
        _ => None,
    };
    let help = match near {
        Some(near) => format!("did you mean \"{near}\"? {}", one_of(names)),
        None => one_of(names),
    };
    problems.push(
        Problem::new(message)
            .at(&node.place)
            .label("not one of the choices")
            .help(help),
    );
    None
}

fn one_of<T>(names: Names<T>) -> String {
    let names: Vec<String> = names.iter().map(|(name, _)| format!("\"{name}\"")).collect();
    format!("write one of {}", names.join(", "))
}

/// Returns a quantity written in a node.
pub(crate) fn quantity(
    node: &TreeNode,
    path: &str,
    kind: Kind,
    range: Range,
    problems: &mut Problems,
) -> Option<Quantity> {
    let read = match &node.value {
        NodeValue::Text(text) => Quantity::parse_as(text, kind),
        NodeValue::Number(value) if node.place.source.bare_numbers_are_si && value.is_finite() => {
            Quantity::new(*value, kind.unit(System::Si))
        }
        NodeValue::Number(value) => {
            let (text, span) = (node.place.text().to_string(), 0..node.place.span.len());
            Err(if value.is_finite() {
                UnitError::MissingUnit {
                    number: text,
                    expected: Some(kind),
                    span,
                }
            } else {
                UnitError::NotFinite { text, span }
            })
        }
        other => {
            let message = format!(
                "`{path}` is {}; {} is expected, a number and a unit in quotes",
                other.describe(),
                kind.name()
            );
            let help = format!("write for example \"{}\"", example(kind));
            problems.push(
                Problem::new(message)
                    .at(&node.place)
                    .label(kind.name())
                    .help(help),
            );
            return None;
        }
    };
    match read {
        Ok(quantity) => {
            let problem = out_of_range(&quantity, path, kind, range);
            let inside = problem.is_none();
            problems
                .extend(problem.map(|problem| problem.at(&node.place).label(said(range, kind, &quantity))));
            inside.then_some(quantity)
        }
        Err(error) => {
            problems.push(unit_problem(&error, path, kind, &inner_place(node, &error)));
            None
        }
    }
}

/// Returns the mistake of a quantity, at its place.
pub(crate) fn unit_problem(error: &UnitError, path: &str, kind: Kind, place: &TomlLocation) -> Problem {
    let label = match error {
        UnitError::UnknownUnit { .. } => "unknown unit".to_string(),
        UnitError::MissingUnit { .. } => "a unit is missing".to_string(),
        UnitError::WrongDimension { .. } => format!("not {}", kind.name()),
        UnitError::NotFinite { .. } => "not finite".to_string(),
        _ => format!("{} is expected", kind.name()),
    };
    Problem::new(format!("`{path}`: {error}"))
        .at(place)
        .label(label)
        .help(error.help())
}

/// Returns the part of a text in quotes that an error speaks of.
pub(crate) fn inner_place(node: &TreeNode, error: &UnitError) -> TomlLocation {
    let raw = node.place.text();
    let mut place = node.place.clone();
    if let NodeValue::Text(text) = &node.value
        && !text.trim().is_empty()
        && raw.len() == text.len() + 2
        && raw.get(1..raw.len() - 1) == Some(text)
    {
        let span = error.span();
        let start = place.span.start + 1;
        place.span = start + span.start..start + span.end;
    }
    place
}

/// Returns whether a quantity is not larger than anything of its kind.
pub(crate) fn is_bounded(quantity: &Quantity, kind: Kind) -> bool {
    quantity.to_si().abs() <= bounds::largest(kind)
}

/// Returns the condition on a quantity that is outside its range or beyond the bound of its kind.
fn said(range: Range, kind: Kind, quantity: &Quantity) -> String {
    if range.holds(quantity.to_si()) {
        bounds::words(kind)
    } else {
        range.words().to_owned()
    }
}

/// Returns the problem of a quantity outside its range, still without a place.
pub(crate) fn out_of_range(quantity: &Quantity, path: &str, kind: Kind, range: Range) -> Option<Problem> {
    if range.holds(quantity.to_si()) && is_bounded(quantity, kind) {
        return None;
    }
    let message = format!(
        "`{path}` is {quantity}; it must be {}",
        said(range, kind, quantity)
    );
    // A number without unit was read as metres.
    let hint = match kind {
        Kind::Length | Kind::Distance if quantity.unit_text() == "m" => {
            let most = bounds::largest(kind);
            let [low, high] = range.ends();
            quantity::length_hint(quantity.to_si(), [low.max(-most), high.min(most)])
        }
        _ => None,
    };
    let help = hint.unwrap_or_else(|| format!("write for example \"{}\"", example(kind)));
    Some(Problem::new(message).help(help))
}

/// Returns an example of a quantity of this kind.
pub(crate) fn example(kind: Kind) -> String {
    let number = match kind {
        Kind::Angle => "30",
        Kind::Stiffness => "3000",
        Kind::Force => "50",
        Kind::Inertia => "100",
        _ => "1",
    };
    format!("{number} {}", kind.unit(System::Us))
}
