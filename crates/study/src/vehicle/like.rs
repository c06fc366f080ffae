//! `like`: a body or an element takes what it does not give from another one.

use vehicle::GROUND;

use super::bodies::LIKE;
use crate::case::problem::{Problem, Problems};
use crate::case::tree::{NodeValue, TableNode};

/// Completes bodies and elements that are like others.
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
            break;
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
            break;
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
            break;
        };
        whole.complete_from(table);
        seen.push(other.clone());
        next = table.get(LIKE).cloned();
    }
    // Read by nobody else.
    whole.entries.retain(|entry| entry.key != LIKE);
    Some(whole)
}
