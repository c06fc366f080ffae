//! Tables that the user names: bodies and elements of a vehicle.

use quantity::Kind;

use super::{CaseReader, QuantityForm, known};
use crate::case::field::Reach;
use crate::case::problem::Problem;
use crate::case::section::{Range, example};
use crate::case::tree::NodeValue;

/// Longest name of a body or an element.
const LONGEST: usize = 60;

impl<'r> CaseReader<'r> {
    /// Returns the names of the tables in a table, in the order of the text. Notes what is no table, and
    /// names that cannot begin those of columns.
    pub fn names(&mut self, table: &'static str) -> Vec<&'r str> {
        self.named.push(table);
        let mut own = known(table.to_owned(), "");
        own.open = true;
        self.known.push(own);
        let Some(entries) = self.tree.table(table).map(|table| &table.entries) else {
            return Vec::new();
        };
        let mut names = Vec::with_capacity(entries.len());
        for entry in entries {
            let name = entry.key.as_str();
            let plain = |sign: char| sign.is_ascii_alphanumeric() || sign == '_';
            let begins = name.starts_with(|sign: char| sign.is_ascii_alphabetic());
            let wrong = if !matches!(entry.node.value, NodeValue::Table(_)) {
                let found = entry.node.value.describe();
                let help = format!("write [{table}.{name}] on a line of its own and its keys below it");
                Some((format!("`{table}.{name}` is {found}; a table is expected"), help))
            } else if !(begins && name.chars().all(plain) && name.len() <= LONGEST) {
                let help = format!(
                    "its columns begin with it: write a letter, then letters, digits and _, at most \
                     {LONGEST} \
                     in all"
                );
                Some((
                    format!("`{}` is no name for one of [{table}]", input::shortened(name)),
                    help,
                ))
            } else {
                names.push(name);
                None
            };
            if let Some((message, help)) = wrong {
                let problem = Problem::new(message).at(&entry.key_place);
                self.problems.push(problem.label("not read").help(help));
            }
        }
        names
    }

    /// Notes that a key of the current section is missing.
    fn missing(&mut self, key: &str, example: &str) {
        if self.complete || self.gives(key) {
            return;
        }
        let path = self.section.clone();
        let problem = Problem::new(format!("`{path}.{key}` is missing"));
        let help = format!("write {key} = {example} below [{path}]");
        self.problem_at_key(&path, problem.label("needs it").help(help));
    }

    /// A quantity without a default.
    pub fn needed(&mut self, key: &'static str, form: QuantityForm, value: &mut f64, comment: &str) {
        self.missing(key, &format!("\"{}\"", example(form.0)));
        self.quantity(key, form, value, comment);
    }

    /// Three quantities without a default.
    pub fn needed_triple(
        &mut self,
        key: &'static str,
        form: QuantityForm,
        values: &mut [f64; 3],
        comment: &str,
    ) {
        let one = example(form.0);
        self.missing(key, &format!("[\"{one}\", \"{one}\", \"{one}\"]"));
        self.triple(key, form, values, comment);
    }

    /// A weight without a default.
    pub fn needed_weight(&mut self, mass: &mut f64, comment: &str) {
        self.missing("weight", "\"1000 lbf\"");
        self.weight(mass, comment);
    }

    /// A place in the nominal layout, without a default.
    pub fn place(&mut self, key: &'static str, place: &mut [f64; 3], comment: &str) {
        let form = (Kind::Length, Range::Any, Reach::Signed(0.254));
        self.needed_triple(key, form, place, comment);
    }

    /// The name of one of several things, without a default; `None` notes what is wrong.
    pub fn name_among(&mut self, key: &'static str, names: &[&str], comment: &str) -> Option<usize> {
        self.missing(key, &format!("\"{}\"", names.last().unwrap_or(&"")));
        let node = self.node(key, super::Form::Text)?;
        let path = self.path(key);
        let NodeValue::Text(name) = &node.value else {
            let found = node.value.describe();
            let problem = Problem::new(format!("`{path}` is {found}; a name in quotes is expected"));
            self.problems.push(problem.at(&node.place).label("not a name"));
            return None;
        };
        let Some(place) = names.iter().position(|own| own == name) else {
            let message = format!(
                "`{path}` names \"{}\", which there is not",
                input::shortened(name)
            );
            let help = match quantity::nearest(name, names.iter().copied()) {
                Some(near) => format!("did you mean \"{near}\"?"),
                None => format!("write one of \"{}\"", names.join("\", \"")),
            };
            let problem = Problem::new(message).at(&node.place);
            self.problems
                .push(problem.label("no body of this name").help(help));
            return None;
        };
        self.line(key, true, super::Written::text(name), comment);
        Some(place)
    }
}
