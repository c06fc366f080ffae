//! Groups of values: what the values of a parameter stand for that is no key of the case.

use super::vary::assignments;
use super::{Draft, overriding};
use crate::case::problem::{Problem, Problems};
use crate::case::section::CaseSection;
use crate::case::tree::NodeValue as Toml;
use crate::design::Group;
use crate::design::factor::Levels;

const HELP: &str = "write [groups.condition.worn] and below it for example wedge.rise = \"0.75 in\", then \
                    condition = [\"new\", \"worn\"] below [vary]; [groups.condition.new] may be empty";

/// Finds the groups that the values of factors name.
pub(super) fn find(top: &CaseSection<'_>, drafts: &mut [Draft], problems: &mut Problems) {
    if top.table.get("groups").is_none() {
        return;
    }
    let Some(section) = top.section("groups", problems) else {
        return;
    };
    for entry in &section.table.entries {
        let Toml::Table(own) = &entry.node.value else {
            let message = format!("`groups.{}` is {}", entry.key, entry.node.value.describe());
            let problem = Problem::new(message).at(&entry.node.place);
            problems.push(problem.label("tables are expected").help(HELP));
            continue;
        };
        let mut groups = Vec::new();
        for group in &own.entries {
            let Toml::Table(values) = &group.node.value else {
                let message = format!(
                    "`groups.{}.{}` is {}",
                    entry.key,
                    group.key,
                    group.node.value.describe()
                );
                let problem = Problem::new(message).at(&group.node.place);
                problems.push(problem.label("a table is expected").help(HELP));
                continue;
            };
            let mut assigned = Vec::new();
            assignments(values, "", &mut assigned);
            groups.push((group.key.clone(), assigned));
        }
        let named = drafts.iter_mut().find(|draft| draft.factor.name() == entry.key);
        let Some(draft) = named else {
            let message = format!("no parameter takes the groups of `{}`", entry.key);
            let problem = Problem::new(message).at(&entry.key_place);
            problems.push(problem.label("not varied").help(HELP));
            continue;
        };
        if draft.factor.paths.len() > 1 || !matches!(draft.factor.levels, Levels::Values(_)) {
            let message = format!("`{}` is not a list of groups", entry.key);
            let problem = Problem::new(message).at(&draft.key);
            problems.push(problem.label("names of groups are expected").help(HELP));
            continue;
        }
        for (value, place) in &draft.written {
            let name = value.shown();
            if groups.iter().any(|(own, _)| *own == name) {
                continue;
            }
            let message = format!("there is no group `groups.{}.{name}`", entry.key);
            let names = groups.iter().map(|(own, _)| own.as_str());
            let help = match quantity::nearest(&name, names) {
                Some(near) => format!("did you mean \"{near}\"?"),
                None => HELP.to_owned(),
            };
            problems.push(Problem::new(message).at(place).label("this group").help(help));
        }
        draft.factor.groups = groups
            .iter()
            .map(|(name, assigned)| Group {
                name: name.clone(),
                set: assigned.iter().map(overriding).collect(),
            })
            .collect();
        draft.groups = groups;
    }
}
