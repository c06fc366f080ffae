//! A case with the files that it names, as they lie together in one folder.

use std::ops::Range;
use std::path::{Path, PathBuf};

use super::CarCase;
use crate::case::field::quoted;
use crate::case::problem::TomlSource;
use crate::case::tables::NamedFile;
use crate::case::tree::{self, NodeValue, TableEntry};

impl CarCase {
    /// Returns the text of the case in which profiles and measured tables are named `files/...`, and these
    /// files: their names from the folder of the case, and the places where they lie. A case that names no
    /// files is [`CarCase::to_toml_embedded`]. What is packed once more has the same names.
    #[must_use]
    pub fn packed(&self) -> (String, Vec<(String, PathBuf)>) {
        let mut text = self.to_toml_embedded().to_owned();
        let mut named = Vec::new();
        // The text is one that this program wrote.
        if let Ok(tree) = tree::parse(&TomlSource::new("case.toml", text.as_str())) {
            for entry in &tree.entries {
                find(entry, &entry.key, &mut named);
            }
        }
        named.sort_by_key(|(_, _, span)| span.start);
        let mut packed: Vec<(String, PathBuf)> = Vec::new();
        let mut spans: Vec<(Range<usize>, String)> = Vec::new();
        for (key, typed, span) in named {
            let same = |own: &&NamedFile| own.key == key && own.typed == typed;
            let Some(file) = self.files.iter().find(same) else {
                continue;
            };
            let known = packed.iter().find(|(_, path)| *path == file.path);
            let name = known.map(|(name, _)| name.clone()).unwrap_or_else(|| {
                let ending = Path::new(&file.typed)
                    .extension()
                    .and_then(|ending| ending.to_str());
                let ending = ending.unwrap_or("csv").to_ascii_lowercase();
                let name = format!("files/{}_{}.{ending}", packed.len() + 1, key.replace('.', "_"));
                packed.push((name.clone(), file.path.clone()));
                name
            });
            spans.push((span, quoted(&name)));
        }
        for (span, name) in spans.into_iter().rev() {
            text.replace_range(span, &name);
        }
        (text, packed)
    }
}

/// Finds the texts that may be names of files: key, text and place.
fn find(entry: &TableEntry, section: &str, found: &mut Vec<(&'static str, String, Range<usize>)>) {
    match &entry.node.value {
        NodeValue::Text(text) => {
            let key = match (section, entry.key.as_str()) {
                ("wheels", "profile") => "wheels.profile",
                ("rails", "profile") => "rails.profile",
                ("track", "table") => "table",
                _ => return,
            };
            found.push((key, text.clone(), entry.node.place.span.clone()));
        }
        NodeValue::Table(inner) => inner.entries.iter().for_each(|own| find(own, section, found)),
        NodeValue::List(items) => {
            for item in items {
                if let NodeValue::Table(inner) = &item.value {
                    inner.entries.iter().for_each(|own| find(own, section, found));
                }
            }
        }
        _ => {}
    }
}
