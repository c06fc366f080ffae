//! Cases that programs make: values laid over a case, in which a bare number is one in SI units.

use std::path::Path;

use super::problem::{Problems, TomlSource};
use super::tree::{NodeValue, TableNode};
use super::{Case, CaseError, tree};

/// Keys of which a section has one or the other.
const EITHER: [(&str, &str, &str); 1] = [("control_coil", "stiffness", "table")];

impl Case {
    /// Lays values over a case file, given by the name that messages show it under and its text; without one,
    /// over the thesis's values.
    ///
    /// `values` is TOML as in a case file, but a bare number where a quantity is expected is in SI units (a
    /// toe in rad, positive out). Tables are merged key by key; a motion of another shape replaces the whole
    /// motion. Messages call these values `values_name`.
    ///
    /// # Errors
    /// As [`Case::parse`].
    pub fn of_values(
        base: Option<(&str, &str)>,
        values_name: &str,
        values: &str,
        folder: &Path,
    ) -> Result<Self, CaseError> {
        let mut tree = tree::parse(&TomlSource::in_si(values_name, values)).map_err(CaseError::new)?;
        let mut source = "case";
        if let Some((name, text)) = base {
            let text = text.strip_prefix('\u{feff}').unwrap_or(text);
            let mut below = tree::parse(&TomlSource::new(name, text)).map_err(CaseError::new)?;
            for (section, one, other) in EITHER {
                drop_other(&mut below, &tree, section, one, other);
                drop_other(&mut below, &tree, section, other, one);
            }
            tree.complete_from(&below);
            source = name;
        }
        Self::of_tree(tree, source, folder.into(), Problems::new())
    }
}

/// Takes `other` from a section below if the one above has `one`.
fn drop_other(below: &mut TableNode, above: &TableNode, section: &str, one: &str, other: &str) {
    if above.table(section).is_none_or(|table| table.get(one).is_none()) {
        return;
    }
    let entry = below.entries.iter_mut().find(|entry| entry.key == section);
    if let Some(NodeValue::Table(table)) = entry.map(|entry| &mut entry.node.value) {
        table.entries.retain(|entry| entry.key != other);
    }
}
