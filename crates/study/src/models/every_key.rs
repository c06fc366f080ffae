//! All keys of a model's cases: built-in cases that together have all of them, and the schema by which
//! editors complete and check a case.

use std::collections::BTreeSet;

use serde_json::Value;

use super::built_in;
use crate::case::builtin::BuiltIn;
use crate::reader::schema::{KnownSection, address, schema as joined};

/// A built-in case and `--set` overrides of it.
pub type Variant = (&'static str, &'static [&'static str]);

/// All keys of a model's cases.
#[derive(Debug)]
pub struct ModelKeys {
    /// Cases that together have all keys.
    pub cases: &'static [Variant],
    /// Tables with the keys of another one.
    pub(crate) alike: &'static [[&'static str; 2]],
    /// Reads the text of a case with values laid over it: its sections and keys.
    pub(crate) known: fn(&str, &[String]) -> Vec<KnownSection>,
}

impl ModelKeys {
    /// Returns the schema of the cases of the model with this name (JSON Schema, draft 7).
    #[must_use]
    pub fn schema(&self, model: &str) -> Value {
        let text = |name: &str| built_in(name).map_or("", BuiltIn::text);
        // What is said first stands: the built-in cases before their variants.
        let (mut sections, mut variants) = (Vec::new(), Vec::new());
        let mut chosen = BTreeSet::new();
        for (name, overrides) in self.cases {
            let overrides: Vec<String> = overrides.iter().map(|&own| own.to_owned()).collect();
            let known = (self.known)(text(name), &overrides);
            // Keys that there are beside one choice alone.
            for choice in known.iter().flat_map(KnownSection::choices) {
                if chosen.insert(choice.clone()) {
                    let overrides = [overrides.as_slice(), &[choice]].concat();
                    variants.extend((self.known)(text(name), &overrides));
                }
            }
            sections.extend(known);
        }
        sections.extend(variants);
        let title = format!("A case of Wedgelab, model \"{model}\"");
        joined(&address(model), &title, &sections, self.alike)
    }
}
