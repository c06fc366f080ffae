//! `cargo xtask architecture`: the table of the crates in ARCHITECTURE.md, from their manifests. The check
//! `layers` holds the page to it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::process::ExitCode;

use crate::shell::Workspace;
use crate::test::layers::{self, LAYERS, Member};

const PAGE: &str = "ARCHITECTURE.md";
const HELP: &str = "\
Usage: cargo xtask architecture

Writes the table of the crates in ARCHITECTURE.md, from the descriptions and dependencies in their
manifests.";
/// What stands before and after the table.
const MARKS: [&str; 2] = [
    "<!-- From the manifests by `cargo xtask architecture`. -->\n",
    "<!-- End of the table. -->",
];

/// Runs the command.
pub fn run(workspace: &Workspace, arguments: &[String]) -> ExitCode {
    match arguments {
        [] => {}
        [only] if only == "--help" || only == "-h" => {
            println!("{HELP}");
            return ExitCode::SUCCESS;
        }
        _ => {
            eprintln!("{HELP}");
            return ExitCode::from(2);
        }
    }
    match layers::read(&workspace.root).and_then(|crates| write(workspace, &crates)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn write(workspace: &Workspace, crates: &[Member]) -> Result<(), String> {
    let page = with_table(&read(workspace)?, &table(crates))?;
    fs::write(workspace.root.join(PAGE), page).map_err(|error| format!("{PAGE} cannot be written: {error}"))
}

/// Returns what to do if the page's table is not that of the manifests.
///
/// # Errors
/// The page cannot be read, or has no place for the table.
pub fn stale(workspace: &Workspace, crates: &[Member]) -> Result<Option<String>, String> {
    let page = read(workspace)?;
    let same = with_table(&page, &table(crates))? == page;
    Ok((!same).then(|| {
        format!("The table of the crates in {PAGE} is out of date: run `cargo xtask architecture`.")
    }))
}

fn read(workspace: &Workspace) -> Result<String, String> {
    let page = fs::read_to_string(workspace.root.join(PAGE));
    page.map_err(|error| format!("{PAGE} cannot be read: {error}"))
}

/// Returns the page with this table between the marks.
fn with_table(page: &str, table: &str) -> Result<String, String> {
    let [before, after] = MARKS;
    let missing = || format!("{PAGE} lacks the marks around the table of the crates.");
    let (head, rest) = page.split_once(before).ok_or_else(missing)?;
    let (_, tail) = rest.split_once(after).ok_or_else(missing)?;
    Ok(format!("{head}{before}{table}{after}{tail}"))
}

/// Returns the table, the highest layer first.
fn table(crates: &[Member]) -> String {
    let by_name: BTreeMap<&str, &Member> = crates.iter().map(|own| (own.name.as_str(), own)).collect();
    let mut table = String::from("| layer | crate | contents | uses |\n|---|---|---|---|\n");
    for (layer, names) in LAYERS.iter().rev() {
        let mut layer = *layer;
        for own in names.iter().filter_map(|name| by_name.get(name)) {
            let uses: Vec<String> = uses(own, &by_name)
                .into_iter()
                .map(|name| format!("`{name}`"))
                .collect();
            let (name, contents) = (&own.name, own.description.trim_end_matches('.'));
            let row = format!("| {layer} | `{name}` | {contents} | {} |", uses.join(" "));
            table.push_str(&row.replace("  |", " |"));
            table.push('\n');
            layer = "";
        }
    }
    table
}

/// Returns the crates of the workspace that a crate uses, without those that come with another of them.
fn uses<'c>(own: &'c Member, crates: &BTreeMap<&str, &'c Member>) -> Vec<&'c str> {
    let direct = |own: &'c Member| {
        let names = own.depends_on.iter().map(String::as_str);
        names.filter(|name| crates.contains_key(name)).collect::<Vec<_>>()
    };
    let mut indirect = BTreeSet::new();
    let mut open: Vec<&str> = direct(own)
        .into_iter()
        .flat_map(|name| direct(crates[name]))
        .collect();
    while let Some(name) = open.pop() {
        if indirect.insert(name) {
            open.extend(direct(crates[name]));
        }
    }
    let names = direct(own).into_iter();
    names.filter(|name| !indirect.contains(name)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn member(name: &str, description: &str, depends_on: &[&str]) -> Member {
        Member {
            name: name.to_owned(),
            description: description.to_owned(),
            depends_on: depends_on.iter().map(|name| (*name).to_owned()).collect(),
        }
    }

    #[test]
    fn the_table_has_layers_descriptions_and_what_is_used_directly() {
        let crates = [
            member("numerics", "Numbers.", &["libm"]),
            member("mechanics", "Bodies.", &["numerics", "quantity"]),
            member("quantity", "Units.", &[]),
            member("wedge", "The wedge.", &["mechanics", "numerics", "serde"]),
        ];
        assert_eq!(
            table(&crates),
            "| layer | crate | contents | uses |\n|---|---|---|---|\n\
             | systems | `wedge` | The wedge | `mechanics` |\n\
             | mechanics | `mechanics` | Bodies | `numerics` `quantity` |\n\
             | foundation | `numerics` | Numbers | |\n\
             | | `quantity` | Units | |\n"
        );
    }

    #[test]
    fn a_table_takes_the_place_of_the_one_before() {
        let [before, after] = MARKS;
        let page = format!("a\n{before}old\n{after}\nb");
        assert_eq!(
            with_table(&page, "new\n"),
            Ok(format!("a\n{before}new\n{after}\nb"))
        );
        assert!(with_table("a", "new").is_err());
    }
}
