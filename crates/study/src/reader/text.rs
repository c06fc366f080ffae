//! A completed case as text.

use crate::case::field::{FieldSection, quoted};

/// A complete, commented case file, and its fields.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseText {
    /// As typed.
    pub typed: String,
    /// With the contents of files that it names.
    pub embedded: String,
    /// Its fields, in the order of the file.
    pub fields: Vec<FieldSection>,
}

impl CaseText {
    /// Returns a value of the case as typed or by default; empty if there is none at this path.
    pub fn as_typed(&self, path: &str) -> &str {
        let fields = self.fields.iter().flat_map(|section| &section.fields);
        let found = fields.into_iter().find(|field| field.path == path);
        found.map_or("", |field| field.text.as_str())
    }

    /// Returns the same of a case with another name, which stands in the line below that of the schema.
    #[must_use]
    pub fn named(&self, name: &str) -> Self {
        let rename = |text: &str| {
            let mut lines = text.splitn(3, '\n');
            let (schema, _, rest) = (lines.next(), lines.next(), lines.next());
            let [schema, rest] = [schema, rest].map(Option::unwrap_or_default);
            format!("{schema}\nname = {}\n{rest}", quoted(name))
        };
        Self {
            typed: rename(&self.typed),
            embedded: rename(&self.embedded),
            fields: self.fields.clone(),
        }
    }
}
