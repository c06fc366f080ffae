//! A case with the files that it names, as they lie together in one folder.

use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::car::CarCase;
use crate::case::field::quoted;
use crate::case::problem::TomlSource;
use crate::case::tables::NamedFile;
use crate::case::tree::{self, NodeValue, TableEntry};
use crate::vehicle::VehicleCase;

/// A file that lies beside a packed case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PackedFile {
    /// Its name from the folder of the case.
    pub name: String,
    /// The place where it lies.
    pub path: PathBuf,
    /// The files that it names itself: as it calls them, and as they are called beside it.
    renamed: Vec<(String, String)>,
}

impl PackedFile {
    /// Returns what is packed of what the file holds: a list of sections names its files anew.
    #[must_use]
    pub fn content(&self, bytes: Vec<u8>) -> Vec<u8> {
        if self.renamed.is_empty() {
            return bytes;
        }
        let text = String::from_utf8_lossy(&bytes);
        let lines = text.lines().map(|line| {
            let quoted = |(old, new): &(String, String)| {
                let forms = ['\'', '"'].map(|quote| format!("{quote}{old}{quote}"));
                let form = forms.iter().find(|form| line.contains(form.as_str()))?;
                Some(line.replacen(form.as_str(), &format!("'{new}'"), 1))
            };
            self.renamed
                .iter()
                .find_map(quoted)
                .unwrap_or_else(|| line.to_owned())
                + "\n"
        });
        lines.collect::<String>().into_bytes()
    }
}

/// The files of a packed case, each once.
#[derive(Default)]
struct Files {
    packed: Vec<PackedFile>,
}

impl Files {
    /// Packs a file that is typed so under a key; returns its name.
    fn add(&mut self, key: &str, typed: &str, path: &Path) -> String {
        if let Some(known) = self.packed.iter().find(|own| own.path == path) {
            return known.name.clone();
        }
        let ending = Path::new(typed).extension().and_then(|ending| ending.to_str());
        let ending = ending.unwrap_or("csv").to_ascii_lowercase();
        let name = format!(
            "files/{}_{}.{ending}",
            self.packed.len() + 1,
            key.replace('.', "_")
        );
        self.packed.push(PackedFile {
            name: name.clone(),
            path: path.to_owned(),
            renamed: Vec::new(),
        });
        name
    }
}

/// Returns the text of a case in which profiles and measured tables are named `files/...`, and these files,
/// with those that lists of sections name. A case that names no files stays as it is. What is packed once
/// more has the same names.
fn packed(text: &str, read: &[NamedFile]) -> (String, Vec<PackedFile>) {
    let mut named = Vec::new();
    // The text is one that this program wrote.
    if let Ok(tree) = tree::parse(&TomlSource::new("case.toml", text)) {
        for entry in &tree.entries {
            find(entry, &entry.key, &mut named);
        }
    }
    named.sort_by_key(|(_, _, span)| span.start);
    let mut files = Files::default();
    let mut spans: Vec<(Range<usize>, String)> = Vec::new();
    for (key, typed, span) in named {
        let same = |own: &&NamedFile| own.key == key && own.typed == typed;
        let Some(file) = read.iter().find(same) else {
            continue;
        };
        let name = files.add(key, &typed, &file.path);
        let listed = file.listed.iter().map(|(own, path)| {
            let beside = files.add("rails.section", own, path);
            let beside = beside.strip_prefix("files/").unwrap_or(&beside).to_owned();
            (own.clone(), beside)
        });
        let renamed: Vec<(String, String)> = listed.collect();
        if let Some(packed) = files.packed.iter_mut().find(|own| own.name == name) {
            packed.renamed = renamed;
        }
        spans.push((span, quoted(&name)));
    }
    let mut text = text.to_owned();
    for (span, name) in spans.into_iter().rev() {
        text.replace_range(span, &name);
    }
    (text, files.packed)
}

/// Packs cases that keep the files that were read for them.
macro_rules! packs {
    ($($case:ty,)+) => {$(
        impl $case {
            /// Returns the text of the case in which profiles and measured tables are named `files/...`, and
            /// these files, with those that lists of sections name. What is packed once more has the same
            /// names.
            #[must_use]
            pub fn packed(&self) -> (String, Vec<PackedFile>) {
                packed(self.to_toml_embedded(), &self.files)
            }
        }
    )+};
}

packs! {
    CarCase,
    VehicleCase,
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
