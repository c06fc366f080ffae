//! Reading a case key by key: what is left out has a default, and everything is written down as it is read.
//!
//! One line for each key says its name, what it measures, its range, its default and what it means. From
//! these lines come the values, the complete, commented case file and the fields of the explorer.

mod keys;
mod motions;
mod named;
pub(crate) mod schema;
mod simulation;
mod text;

pub(crate) use keys::in_customary_units;
pub(crate) use motions::check_motions;
pub use text::CaseText;

use std::mem;

use quantity::Kind;
use schema::{Form, KnownKey, KnownSection};

use crate::case::field::{Reach, Written};
use crate::case::model::{MODELS, Model};
use crate::case::page::Page;
use crate::case::problem::{Problem, Problems};
use crate::case::section::{self, CaseSection, Range};
use crate::case::tables::NamedFile;
use crate::case::tree::{NodeValue, TableNode, TreeNode};
use crate::case::{Tables, motion, name};

/// Kind, range and suggested reach of a quantity.
pub(crate) type QuantityForm = (Kind, Range, Reach);

/// A length that is not negative.
pub(crate) const CLEARANCE: QuantityForm = (Kind::Length, Range::NotNegative, Reach::FromZero(0.025));
/// A length.
pub(crate) const LENGTH: QuantityForm = (Kind::Length, Range::Positive, Reach::Positive);
/// A stiffness.
pub(crate) const STIFFNESS: QuantityForm = (Kind::Stiffness, Range::Positive, Reach::Wide);
/// A damping.
pub(crate) const DAMPING: QuantityForm = (Kind::Damping, Range::NotNegative, Reach::FromZero(5000.0));
/// A static load.
pub(crate) const PRELOAD: QuantityForm = (Kind::Force, Range::NotNegative, Reach::Positive);
/// A force that a mass weighs.
const WEIGHT: QuantityForm = (Kind::Force, Range::Positive, Reach::Positive);

/// Reads sections and writes them down.
pub(crate) struct CaseReader<'r> {
    tree: &'r TableNode,
    tables: Tables<'r>,
    pub problems: &'r mut Problems,
    /// As typed, and with the points of tables in files.
    pages: [Page; 2],
    /// The table that sections are in: empty, or a truck of a car, an element of a vehicle.
    within: String,
    /// Tables whose tables have names of the user's: bodies of a vehicle.
    named: Vec<&'static str>,
    /// The full path of the current section.
    section: String,
    /// True if only given values are written down, and no defaults.
    overlay: bool,
    /// Sections with their keys.
    known: Vec<KnownSection>,
    /// True if sections that change nothing are read too, so that all keys are known.
    complete: bool,
    /// Rows of the tables that were read.
    rows: usize,
    /// The motions that were given, with their paths.
    pub motions: Vec<(String, motion::CaseMotion)>,
    /// Profiles and measured tables that were read.
    pub files: Vec<NamedFile>,
}

impl<'r> CaseReader<'r> {
    pub fn new(tree: &'r TableNode, tables: Tables<'r>, problems: &'r mut Problems) -> Self {
        Self {
            tree,
            tables,
            problems,
            pages: [Page::default(), Page::default()],
            within: String::new(),
            named: Vec::new(),
            section: String::new(),
            overlay: false,
            known: vec![known(String::new(), "")],
            complete: false,
            rows: 0,
            motions: Vec::new(),
            files: Vec::new(),
        }
    }

    /// Takes the sections that follow from a table of the case; from the case itself where that is empty.
    /// Paths of sections are relative to it.
    pub fn within(&mut self, table: &str) {
        table.clone_into(&mut self.within);
    }

    /// Returns the full path of what stands at a path within the table that sections are taken from.
    fn full(&self, path: &str) -> String {
        match (self.within.as_str(), path) {
            ("", path) => path.to_owned(),
            (within, "") => within.to_owned(),
            (within, path) => format!("{within}.{path}"),
        }
    }

    /// Begins a section.
    pub fn section(&mut self, path: &str, about: &str) {
        self.section = self.full(path);
        self.overlay = false;
        self.begin(about);
        for page in &mut self.pages {
            page.section(&self.section, about);
        }
    }

    /// Takes note of the current section, of which some keys may be known.
    fn begin(&mut self, about: &str) {
        let at = self.known.iter().position(|known| known.path == self.section);
        let mut own = known(self.section.clone(), about);
        if let Some(at) = at {
            own.keys = self.known.remove(at).keys;
        }
        self.known.push(own);
    }

    /// Begins a section that holds for one of several bodies, and of which nothing is written that is not
    /// given. Returns whether anything is.
    pub fn overlay(&mut self, path: &str, about: &str) -> bool {
        self.section = self.full(path);
        self.overlay = true;
        self.begin(about);
        let given = self.table_at(&self.section).is_some();
        if given {
            for page in &mut self.pages {
                page.section(&self.section, about);
            }
        }
        given || self.complete
    }

    /// Makes all sections be read, also those for one of several bodies that are not given.
    pub fn completely(mut self) -> Self {
        self.complete = true;
        self
    }

    /// Returns the sections and keys that were met.
    pub fn into_known(mut self) -> Vec<KnownSection> {
        for section in &mut self.known {
            for table in &self.named {
                if let Some(rest) = section.path.strip_prefix(&format!("{table}.")) {
                    let inner = rest.split_once('.').map_or("", |(_, inner)| inner);
                    section.general = match inner {
                        "" => format!("{table}.*"),
                        inner => format!("{table}.*.{inner}"),
                    };
                }
            }
        }
        self.known
    }

    /// Says that a section holds keys that are read elsewhere.
    pub fn expect(&mut self, section: &str, keys: &[&'static str]) {
        let section = self.full(section);
        let keys = keys.iter().map(|name| KnownKey::new(name, Form::Unsaid));
        match self.known.iter_mut().find(|known| known.path == section) {
            Some(known) => known.keys.extend(keys),
            None => self.known.push(KnownSection {
                keys: keys.collect(),
                ..known(section, "")
            }),
        }
    }

    /// Returns whether the case has a section or a key at a path.
    pub fn has(&self, path: &str) -> bool {
        self.at(path).is_some()
    }

    /// Returns the node at a path.
    pub fn at(&self, path: &str) -> Option<&'r TreeNode> {
        let path = &self.full(path);
        let (section, key) = path.rsplit_once('.').unwrap_or(("", path));
        self.table_at(section)?.get(key)
    }

    /// Returns whether the case describes anything, whatever its name, its settings of the run and what the
    /// source `defaults` has completed.
    pub fn gives_values(&self, defaults: &str) -> bool {
        self.tree.gives_values(defaults)
    }

    /// Returns whether the current section has a key.
    pub fn gives(&self, key: &str) -> bool {
        self.table_at(&self.section)
            .is_some_and(|own| own.get(key).is_some())
    }

    /// Says that the current section may have a key too.
    pub fn also_known(&mut self, key: &'static str) {
        self.node(key, Form::Unsaid);
    }

    /// Notes a mistake at the key with a full path, not at its value.
    pub fn problem_at_key(&mut self, path: &str, problem: Problem) {
        let (section, key) = path.rsplit_once('.').unwrap_or(("", path));
        let entry = self.table_at(section).and_then(|table| table.entry(key));
        self.problems.push(match entry {
            Some(entry) => problem.at(&entry.key_place),
            None => problem,
        });
    }

    /// Notes a mistake at a path.
    pub fn problem(&mut self, path: &str, problem: Problem) {
        self.problem_at(&self.full(path), problem);
    }

    /// The same at a full path.
    pub fn problem_at(&mut self, path: &str, problem: Problem) {
        self.problems.push(match self.tree.place_of(path) {
            Some(place) => problem.at(place),
            None => problem,
        });
    }

    fn table_at(&self, path: &str) -> Option<&'r TableNode> {
        let mut table = self.tree;
        for key in path.split('.').filter(|key| !key.is_empty()) {
            table = table.table(key)?;
        }
        Some(table)
    }

    /// Returns the current section, if the case has it.
    pub fn given(&self) -> Option<CaseSection<'r>> {
        let (outer, key) = self.section.rsplit_once('.').unwrap_or(("", &self.section));
        let place = self.table_at(outer).and_then(|table| table.entry(key));
        Some(CaseSection {
            path: self.section.clone(),
            table: self.table_at(&self.section)?,
            place: place.map(|entry| entry.key_place.clone()),
        })
    }

    /// Takes note of a key. Returns the node there.
    fn node(&mut self, name: &'static str, form: Form) -> Option<&'r TreeNode> {
        if let Some(section) = self.known.last_mut() {
            section.keys.push(KnownKey::new(name, form));
        }
        self.table_at(&self.section)?.get(name)
    }

    /// Takes note of what a key means, and of its value (TOML), where all keys are asked for.
    fn explain(&mut self, key: &str, help: &str, value: &str) {
        if !self.complete {
            return;
        }
        let keys = self.known.last_mut().map(|section| &mut section.keys);
        if let Some(known) = keys.and_then(|keys| keys.iter_mut().rfind(|known| known.name == key)) {
            (known.help, known.value) = (help.to_owned(), value.to_owned());
        }
    }

    /// A line that says that a key is left out, with an example.
    fn absent(&mut self, key: &str, example: &str, comment: &str) {
        self.explain(key, comment, "");
        if !self.overlay {
            for page in &mut self.pages {
                page.absent(key, example, comment);
            }
        }
    }

    /// Returns the full path of a key of the current section.
    pub fn path(&self, key: &str) -> String {
        format!("{}.{key}", self.section)
    }

    fn line(&mut self, key: &str, given: bool, written: Written, comment: &str) {
        self.explain(key, comment, &written.toml);
        if given || !self.overlay {
            let [typed, embedded] = &mut self.pages;
            typed.line(key, written.clone(), comment);
            embedded.line(key, written, comment);
        }
    }

    /// A key at the top of the file.
    fn top(&mut self, key: &'static str, form: Form, written: Written, comment: &str) {
        self.node(key, form);
        self.line(key, true, written, comment);
    }

    /// Returns the access to the files that the case names.
    pub fn tables(&self) -> Tables<'r> {
        self.tables
    }

    /// Says that the keys of the current section are read by another reader.
    pub fn known_elsewhere(&mut self) {
        if let Some(section) = self.known.last_mut() {
            section.open = true;
        }
    }

    /// A line of the current section that another reader has read: as typed, and with files written into it.
    pub fn write(&mut self, key: &str, texts: [String; 2], comment: &str) {
        for (page, text) in self.pages.iter_mut().zip(texts) {
            page.line(key, Written::toml(text), comment);
        }
    }

    /// The same of the case as typed alone.
    pub fn write_typed(&mut self, key: &str, text: String, comment: &str) {
        self.pages[0].line(key, Written::toml(text), comment);
    }

    /// The same of the case with files written into it alone.
    pub fn write_embedded(&mut self, key: &str, text: String, comment: &str) {
        self.pages[1].line(key, Written::toml(text), comment);
    }

    /// Reads and writes down the top of a case: name, title and model. Returns name and title.
    pub fn head(&mut self, default_name: &str, model: Model, comment: &str) -> Option<[String; 2]> {
        let top = CaseSection {
            path: String::new(),
            table: self.tree,
            place: None,
        };
        let name = name::read(&top, default_name, self.problems)?;
        let title = match self.tree.get("title") {
            Some(_) => top.text("title", self.problems).map(|(text, _)| text)?,
            None => "",
        };
        let model_name = section::name_of(MODELS, &model);
        for page in &mut self.pages {
            page.text = format!("#:schema {}\n", schema::address(model_name));
        }
        self.top(
            "name",
            Form::Text,
            Written::text(&name),
            "a folder name: results go there",
        );
        self.top("title", Form::Text, Written::text(title), "one line for people");
        let own = Form::Choice(vec![model_name]);
        self.top("model", own, Written::choice(MODELS, &model), comment);
        Some([name, title.to_owned()])
    }

    /// Notes keys that nobody asked for; `what` is read: a truck's case. Returns the completed case.
    pub fn finish(&mut self, what: &str) -> CaseText {
        let owners: Vec<(&str, Vec<&str>)> = self
            .known
            .iter()
            .filter(|known| !known.path.is_empty() && !known.path.contains('.'))
            .map(|known| (known.path.as_str(), known.names()))
            .collect();
        let owners: Vec<(&str, &[&str])> = owners
            .iter()
            .map(|(path, keys)| (*path, keys.as_slice()))
            .collect();
        for section in &self.known {
            let (path, mut keys) = (&section.path, section.names());
            // Sections within it.
            let prefix = if path.is_empty() {
                String::new()
            } else {
                format!("{path}.")
            };
            for other in &self.known {
                if let Some(rest) = other.path.strip_prefix(&prefix).filter(|rest| !rest.is_empty()) {
                    keys.push(rest.split('.').next().unwrap_or(rest));
                }
            }
            let (outer, key) = path.rsplit_once('.').unwrap_or(("", path));
            let outer = self.table_at(outer);
            let entry = outer.and_then(|table| table.entry(key));
            if let Some(entry) = entry
                && !matches!(entry.node.value, NodeValue::Table(_))
            {
                let message = format!("`{path}` is {}; a table is expected", entry.node.value.describe());
                let problem = Problem::new(message).at(&entry.node.place).label("not a table");
                let help = format!("write [{path}] on a line of its own and the keys below it");
                self.problems.push(problem.help(help));
            }
            if let Some(table) = self.table_at(path).filter(|_| !section.open) {
                let section = CaseSection {
                    path: path.clone(),
                    table,
                    place: None,
                };
                section.allow_in(&keys, &owners, what, self.problems);
            }
        }
        let [typed, embedded] = mem::take(&mut self.pages);
        CaseText {
            typed: typed.text,
            embedded: embedded.text,
            fields: typed.sections,
        }
    }
}

/// A section of which no key is known yet.
fn known(path: String, about: &str) -> KnownSection {
    KnownSection {
        general: path.clone(),
        path,
        about: about.to_owned(),
        keys: Vec::new(),
        open: false,
    }
}
