//! `like`: a body, an element, a wheelset or a truck takes what it does not give from another one.

use vehicle::GROUND;

use crate::case::problem::{Problem, Problems};
use crate::case::tree::{NodeValue, TableNode};
use crate::reader::CaseReader;

/// Key of what another body, element, wheelset or truck of the case gives.
const LIKE: &str = "like";

/// Completes tables that are like others.
pub(super) fn complete(tree: &mut TableNode, problems: &mut Problems) {
    for name in ["bodies", "elements", "wheelsets", "trucks"] {
        let Some(own) = tree.table(name).cloned() else {
            continue;
        };
        let completed: Vec<(usize, TableNode)> = own
            .entries
            .iter()
            .enumerate()
            .filter_map(|(place, entry)| {
                let whole = followed(&own, &entry.key, name, problems)?;
                Some((place, whole))
            })
            .collect();
        let table = tree.entries.iter_mut().find(|entry| entry.key == name);
        if let Some(NodeValue::Table(table)) = table.map(|entry| &mut entry.node.value) {
            for (place, whole) in completed {
                table.entries[place].node.value = NodeValue::Table(whole);
            }
        }
    }
}

/// Reads `like` in the current section, which stands at a path. Returns whether it could not be followed,
/// which is told: then no more is said of what the section lacks.
pub(super) fn is_told(r: &mut CaseReader<'_>, path: &str) -> bool {
    r.also_known(LIKE);
    let told = r.at(&format!("{path}.{LIKE}")).is_some();
    if told {
        r.known_elsewhere();
    }
    told
}

/// Returns a table with what those that it is like give, if it is like another one.
fn followed(all: &TableNode, name: &str, of: &str, problems: &mut Problems) -> Option<TableNode> {
    let mut whole = all.table(name)?.clone();
    let mut seen = vec![name.to_owned()];
    let mut next = whole.get(LIKE).cloned();
    next.as_ref()?;
    while let Some(node) = next {
        let path = format!("{of}.{}.{LIKE}", seen.last().map_or("", String::as_str));
        let NodeValue::Text(other) = &node.value else {
            let message = format!(
                "`{path}` is {}; a name in quotes is expected",
                node.value.describe()
            );
            problems.push(Problem::new(message).at(&node.place).label("not a name"));
            return None;
        };
        if seen.contains(other) {
            // The first of a loop tells it.
            if seen
                .first()
                .is_some_and(|own| own == seen.iter().min().unwrap_or(own))
            {
                let chain = seen.iter().chain([other]).map(|own| format!("`{own}`"));
                let chain: Vec<String> = chain.collect();
                let message = format!("{} are like each other in a loop", chain.join(" is like "));
                let help = "one of them must give all of its own values: leave its `like` out";
                problems.push(Problem::new(message).at(&node.place).label("a loop").help(help));
            }
            return None;
        }
        let Some(table) = all.table(other) else {
            let known = all.entries.iter().map(|entry| entry.key.as_str());
            let help = match quantity::nearest(other, known) {
                Some(near) => format!("did you mean \"{near}\"?"),
                None if other == GROUND => "the ground gives no values".to_owned(),
                None => format!("name a table of [{of}]"),
            };
            let message = format!(
                "`{path}` names \"{}\", which there is not",
                input::shortened(other)
            );
            problems.push(
                Problem::new(message)
                    .at(&node.place)
                    .label("no such table")
                    .help(help),
            );
            return None;
        };
        whole.complete_from(table);
        seen.push(other.clone());
        next = table.get(LIKE).cloned();
    }
    // Where it stays a mistake was told: see `is_told`.
    whole.entries.retain(|entry| entry.key != LIKE);
    Some(whole)
}
