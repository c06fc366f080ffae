//! Findings: inputs that break a promise.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// One input that does.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Finding {
    /// The kind of the finding, the same for inputs that do the same as far as is known.
    pub what: String,
    /// The description of this input.
    pub detail: String,
    /// The input's number.
    pub number: u64,
    /// The input's length.
    pub length: usize,
}

/// Findings that are the same as far as can be told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FindingGroup {
    /// Number of inputs that did it.
    pub count: u64,
    /// The shortest of them.
    pub shortest: Finding,
}

/// All findings of a reader, by what they are.
pub type Groups = BTreeMap<String, FindingGroup>;

/// More groups are not told apart.
const MOST_GROUPS: usize = 40;

/// Adds a finding to its group.
pub fn add(groups: &mut Groups, mut finding: Finding) {
    if groups.len() >= MOST_GROUPS && !groups.contains_key(&finding.what) {
        "other findings".clone_into(&mut finding.what);
    }
    let group = groups
        .entry(finding.what.clone())
        .or_insert_with(|| FindingGroup {
            count: 0,
            shortest: finding.clone(),
        });
    group.count += 1;
    if finding.length < group.shortest.length {
        group.shortest = finding;
    }
}

/// Returns a text with all numbers alike, and not too long: what is left of a message to tell mistakes apart.
#[must_use]
pub fn without_numbers(text: &str) -> String {
    const MOST: usize = 120;
    let mut plain = String::new();
    for letter in text.chars().take(MOST) {
        match letter {
            '0'..='9' if plain.ends_with('#') => {}
            '0'..='9' => plain.push('#'),
            letter if letter.is_control() => plain.push(' '),
            letter => plain.push(letter),
        }
    }
    plain
}

/// Returns the beginning of a text that may be long.
#[must_use]
pub fn beginning(text: &str) -> String {
    const MOST: usize = 600;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{} ... ({} bytes)", &text[..end], text.len()),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finding(what: &str, number: u64, length: usize) -> Finding {
        Finding {
            what: what.to_owned(),
            detail: String::new(),
            number,
            length,
        }
    }

    #[test]
    fn the_shortest_of_a_group_is_kept() {
        let mut groups = Groups::new();
        for one in [
            finding("a", 1, 9),
            finding("a", 2, 3),
            finding("a", 3, 5),
            finding("b", 4, 1),
        ] {
            add(&mut groups, one);
        }
        assert_eq!(groups["a"].count, 3);
        assert_eq!(groups["a"].shortest.number, 2);
        assert_eq!(groups.len(), 2);
    }

    #[test]
    fn groups_do_not_grow_without_end() {
        let mut groups = Groups::new();
        for number in 0..1000 {
            add(&mut groups, finding(&format!("{number}"), number, 1));
        }
        assert_eq!(groups.len(), MOST_GROUPS + 1);
    }

    #[test]
    fn numbers_do_not_tell_apart() {
        assert_eq!(without_numbers("the len is 15 but 7\n"), "the len is # but # ");
    }
}
