//! The schema of a model's cases (JSON Schema, draft 7): which keys there are, what may stand there, and what
//! it means, from the same lines that read a case. Editors complete and check case files by it.
//!
//! A reading meets the keys of one case: those of another kind of coil or load are met where a case has that
//! kind. So the schema joins the keys of several cases that together have all of them.

use std::collections::BTreeMap;

use quantity::Kind;
use serde_json::{Map, Value, json};

use crate::case::page::uncommented;
use crate::case::section::{Names, Range, example};

/// Returns the address of the schema of a model's cases.
pub(crate) fn address(model: &str) -> String {
    let raw = "https://raw.githubusercontent.com/wedgelab/wedgelab/main/docs/schema";
    format!("{raw}/{model}.json")
}

/// What may stand at a key.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Form {
    /// A number with a unit.
    Quantity(Kind),
    /// Two of them.
    Pair(Kind),
    /// Three of them.
    Triple(Kind),
    /// A number between two ends.
    Number([f64; 2]),
    /// True or false.
    Truth,
    /// One of several names.
    Choice(Vec<&'static str>),
    /// Some of several names.
    Several(Vec<&'static str>),
    /// Any text.
    Text,
    /// One held value, a shape, or a list to be added up.
    Motion(Kind),
    /// Rows of quantities, or the name of a file.
    Rows,
    /// Whole numbers in a list.
    Counts,
    /// Lists of numbers in a list.
    Grid,
    /// A name, or a table of values.
    Described,
    /// A table of values.
    Table,
    /// What another reader reads.
    Other,
    /// Not said: the key is known only so that a mistake is not noted twice.
    Unsaid,
}

/// A key that a section may have.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct KnownKey {
    pub name: &'static str,
    pub form: Form,
    /// What it means; may be empty.
    pub help: String,
    /// Its value in a complete case, as TOML; empty if it has none.
    pub value: String,
}

impl KnownKey {
    /// Returns a key of which nothing is said yet.
    pub fn new(name: &'static str, form: Form) -> Self {
        Self {
            name,
            form,
            help: String::new(),
            value: String::new(),
        }
    }
}

/// A section that a case may have.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct KnownSection {
    pub path: String,
    /// The same with `*` in place of a name of the user's.
    pub general: String,
    pub about: String,
    pub keys: Vec<KnownKey>,
    /// True if another reader knows its keys.
    pub open: bool,
}

impl KnownSection {
    /// Returns the names of its keys.
    pub fn names(&self) -> Vec<&'static str> {
        self.keys.iter().map(|key| key.name).collect()
    }

    /// Returns every choice of every key, as `--set` takes it.
    pub fn choices(&self) -> impl Iterator<Item = String> {
        let path = |key: &KnownKey| format!("{}.{}", self.path, key.name);
        let keys = self.keys.iter().filter(|_| !self.path.is_empty());
        keys.flat_map(move |key| match &key.form {
            Form::Choice(names) => names.iter().map(|name| format!("{}={name}", path(key))).collect(),
            _ => Vec::new(),
        })
    }
}

impl Form {
    pub fn number(range: Range) -> Self {
        Self::Number(range.ends())
    }

    pub fn choice<T>(names: Names<T>) -> Self {
        Self::Choice(names.iter().map(|(name, _)| *name).collect())
    }

    pub fn several<T>(names: Names<T>) -> Self {
        Self::Several(names.iter().map(|(name, _)| *name).collect())
    }

    fn schema(&self) -> Value {
        match self {
            Self::Quantity(kind) => quantity(*kind),
            Self::Pair(kind) => json!({
                "type": "array", "items": quantity(*kind), "minItems": 2, "maxItems": 2,
            }),
            Self::Triple(kind) => json!({
                "type": "array", "items": quantity(*kind), "minItems": 3, "maxItems": 3,
            }),
            Self::Number([low, high]) => {
                let mut own = Map::from_iter([("type".to_owned(), json!("number"))]);
                let ends = [("minimum", low), ("maximum", high)];
                for (name, end) in ends.into_iter().filter(|(_, end)| end.is_finite()) {
                    own.insert(name.to_owned(), json!(end));
                }
                Value::Object(own)
            }
            Self::Truth => json!({"type": "boolean"}),
            Self::Choice(names) => json!({"type": "string", "enum": names}),
            Self::Several(names) => json!({
                "type": "array", "items": {"type": "string", "enum": names}, "uniqueItems": true,
            }),
            Self::Text => json!({"type": "string"}),
            Self::Motion(kind) => {
                json!({"allOf": [{"$ref": format!("#/definitions/{}", motion_name(*kind))}]})
            }
            Self::Rows => json!({
                "anyOf": [
                    {"type": "string"},
                    {"type": "array", "items": {"type": "array", "items": {"type": ["string", "number"]}}},
                ],
            }),
            Self::Counts => json!({"type": "array", "items": {"type": "integer", "minimum": 1}}),
            Self::Grid => json!({"type": "array", "items": {"type": "array", "items": {"type": "number"}}}),
            Self::Described => json!({"anyOf": [{"type": "string"}, {"type": "object"}]}),
            Self::Table => json!({"type": "object"}),
            Self::Other | Self::Unsaid => json!({}),
        }
    }
}

fn quantity(kind: Kind) -> Value {
    // A number comes first, or a point before its digits; then a unit.
    let pattern = r"^\s*[+-]?\.?\d[\d.eE+-]*\s*[^\d\s.eE+-]";
    json!({"type": "string", "pattern": pattern, "examples": [example(kind)]})
}

fn motion(kind: Kind) -> Value {
    let one = quantity(kind);
    let text = || json!({"type": "string"});
    let profiles = Form::choice(crate::case::motion::PROFILES).schema();
    let shape = json!({
        "type": "object",
        "properties": {
            "shape": {"enum": crate::case::motion::SHAPES},
            "value": one, "amplitude": one,
            "frequency": quantity(Kind::Frequency),
            "start_frequency": quantity(Kind::Frequency),
            "end_frequency": quantity(Kind::Frequency),
            "phase": quantity(Kind::Angle),
            "start": quantity(Kind::Time), "duration": quantity(Kind::Time),
            "profile": profiles,
            "file": text(),
            "points": {"type": "array"},
        },
        "additionalProperties": false,
    });
    json!({"anyOf": [one, shape, {"type": "array", "items": {"anyOf": [one, shape]}}]})
}

/// Kinds of the values of motions and loads.
const MOVED: [Kind; 4] = [Kind::Length, Kind::Angle, Kind::Force, Kind::Moment];

/// Returns the name of the definition of a motion.
fn motion_name(kind: Kind) -> String {
    format!("motion of {}", kind.name())
}

/// A table of a case, with the keys and the tables in it.
#[derive(Default)]
struct TableSchema {
    about: String,
    keys: BTreeMap<&'static str, KeySchema>,
    tables: BTreeMap<String, TableSchema>,
    open: bool,
}

#[derive(Default)]
struct KeySchema {
    help: String,
    value: String,
    forms: Vec<Form>,
}

impl TableSchema {
    fn at(&mut self, path: &str) -> &mut Self {
        let names = path.split('.').filter(|name| !name.is_empty());
        names.fold(self, |table, name| {
            table.tables.entry(name.to_owned()).or_default()
        })
    }

    fn join(&mut self, section: &KnownSection) {
        let table = self.at(&section.general);
        if table.about.is_empty() {
            table.about.clone_from(&section.about);
        }
        table.open |= section.open;
        for key in &section.keys {
            let own = table.keys.entry(key.name).or_default();
            if own.help.is_empty() {
                own.help.clone_from(&key.help);
            }
            if own.value.is_empty() {
                own.value.clone_from(&key.value);
            }
            if !own.forms.contains(&key.form) {
                own.forms.push(key.form.clone());
            }
        }
    }

    fn schema(&self) -> Value {
        let keys = self
            .keys
            .iter()
            .map(|(name, key)| ((*name).to_owned(), key.schema()));
        let tables = self.tables.iter().filter(|(name, _)| *name != "*");
        let tables = tables.map(|(name, table)| {
            let own = table.schema();
            // A key may be a table too, as a law of friction is.
            let own = match self.keys.get(name.as_str()) {
                Some(key) => json!({"anyOf": [own, key.schema()]}),
                None => own,
            };
            (name.clone(), own)
        });
        let properties: Map<String, Value> = keys.chain(tables).collect();
        let mut own = Map::from_iter([
            ("type".to_owned(), json!("object")),
            ("properties".to_owned(), Value::Object(properties)),
        ]);
        if let Some(named) = self.tables.get("*") {
            own.insert("additionalProperties".to_owned(), named.schema());
        } else if !self.open {
            own.insert("additionalProperties".to_owned(), json!(false));
        }
        if !self.about.is_empty() {
            own.insert("description".to_owned(), json!(uncommented(&self.about)));
        }
        Value::Object(own)
    }
}

impl KeySchema {
    fn schema(&self) -> Value {
        let known = self.forms.iter().filter(|form| **form != Form::Unsaid);
        let mut schemas: Vec<Value> = known.map(Form::schema).collect();
        let mut own = match (schemas.len(), schemas.pop()) {
            (1, Some(Value::Object(one))) => one,
            (0, _) | (_, None) => Map::new(),
            (_, Some(last)) => {
                schemas.push(last);
                Map::from_iter([("anyOf".to_owned(), json!(schemas))])
            }
        };
        if !self.help.is_empty() {
            own.insert("description".to_owned(), json!(uncommented(&self.help)));
        }
        if let Some(value) = default(&self.value) {
            own.insert("default".to_owned(), value);
        }
        Value::Object(own)
    }
}

/// Returns a value of a case file as JSON.
fn default(toml: &str) -> Option<Value> {
    let table: toml::Table = format!("value = {toml}").parse().ok()?;
    serde_json::to_value(table.get("value")?).ok()
}

/// Returns the schema of a model's cases; `title` names it, `sections` are those of several readings. Each of
/// the `alike` tables takes the keys of the table beside it.
pub(crate) fn schema<'s>(
    id: &str,
    title: &str,
    sections: impl IntoIterator<Item = &'s KnownSection>,
    alike: &[[&str; 2]],
) -> Value {
    let mut top = TableSchema::default();
    for section in sections {
        top.join(section);
    }
    let mut own = top.schema();
    if let Value::Object(own) = &mut own {
        own.insert(
            "$schema".to_owned(),
            json!("http://json-schema.org/draft-07/schema#"),
        );
        own.insert("$id".to_owned(), json!(id));
        own.insert("title".to_owned(), json!(title));
        let motions = MOVED.map(|kind| (motion_name(kind), motion(kind)));
        own.insert(
            "definitions".to_owned(),
            Value::Object(motions.into_iter().collect()),
        );
        if let Some(Value::Object(keys)) = own.get_mut("properties") {
            for [name, other] in alike {
                let reference = format!("#/properties/{other}");
                keys.insert((*name).to_owned(), json!({"$ref": reference}));
            }
        }
    }
    own
}
