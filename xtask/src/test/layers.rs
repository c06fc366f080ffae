//! The workspace has layers: a crate depends on crates of lower layers only, never on its own or a higher
//! one.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use toml::{Table, Value};

use super::Outcome;
use crate::architecture;
use crate::shell::Workspace;

/// The layers from the lowest up, and the crates of each.
pub const LAYERS: &[(&str, &[&str])] = &[
    ("reading", &["input"]),
    (
        "foundation",
        &["numerics", "quantity", "drawing", "staging", "features"],
    ),
    ("integration", &["integrate", "wheelrail"]),
    ("mechanics", &["mechanics"]),
    ("systems", &["wedge", "nucars", "rolling"]),
    ("trucks", &["truck"]),
    ("vehicles", &["car"]),
    ("any vehicles", &["vehicle"]),
    ("analysis", &["study"]),
    ("output", &["report", "fmi"]),
    ("reproduction", &["reproduction"]),
    ("libraries", &["wedgelab-fmu"]),
    ("interfaces", &["wedgelab", "wedgelab-py"]),
    ("tools", &["benchmarks", "fuzz", "race", "xtask"]),
];

/// Checks the manifests of all members, and the table of the crates in ARCHITECTURE.md.
pub fn check(workspace: &Workspace) -> Outcome {
    let crates = read(&workspace.root)?;
    let mut broken: Vec<String> = crates.iter().flat_map(violations).collect();
    broken.extend(architecture::stale(workspace, &crates)?);
    if broken.is_empty() {
        Ok(Some(format!(
            "{} crates in {} layers",
            crates.len(),
            LAYERS.len()
        )))
    } else {
        Err(broken.join("\n"))
    }
}

/// A member of the workspace and the packages it depends on.
#[derive(Debug)]
pub struct Member {
    /// Its name.
    pub name: String,
    /// What it is, from its manifest.
    pub description: String,
    /// The packages, those of others too.
    pub depends_on: BTreeSet<String>,
}

fn layer(name: &str) -> Option<usize> {
    LAYERS.iter().position(|(_, crates)| crates.contains(&name))
}

/// Returns the violations of this crate, a sentence each.
fn violations(member: &Member) -> Vec<String> {
    let name = &member.name;
    let Some(own) = layer(name) else {
        return vec![format!(
            "`{name}` is in no layer: name it in LAYERS of xtask/src/test/layers.rs."
        )];
    };
    let too_high = |dependency: &String| {
        let other = layer(dependency).filter(|other| *other >= own)?;
        let relation = if other == own { "the same" } else { "a higher" };
        Some(format!(
            "`{name}` (layer {own}, {}) depends on `{dependency}` (layer {other}, {}), in {relation} layer.",
            LAYERS[own].0, LAYERS[other].0,
        ))
    };
    member.depends_on.iter().filter_map(too_high).collect()
}

/// Reads the manifests of all members.
///
/// # Errors
/// A manifest cannot be read, or lacks what it must have.
pub fn read(root: &Path) -> Result<Vec<Member>, String> {
    let workspace = manifest(&root.join("Cargo.toml"))?;
    let workspace = workspace
        .get("workspace")
        .and_then(Value::as_table)
        .ok_or("Cargo.toml has no [workspace]")?;
    let none = Table::new();
    let shared = workspace
        .get("dependencies")
        .and_then(Value::as_table)
        .unwrap_or(&none);
    let patterns = workspace
        .get("members")
        .and_then(Value::as_array)
        .ok_or("[workspace] has no members")?;
    let mut members = Vec::new();
    for pattern in patterns.iter().filter_map(Value::as_str) {
        for folder in folders(root, pattern)? {
            let file = folder.join("Cargo.toml");
            let member = member(&manifest(&file)?, shared);
            members.push(member.ok_or_else(|| format!("{} has no [package] name", file.display()))?);
        }
    }
    Ok(members)
}

/// Returns the folders a pattern of `workspace.members` stands for: itself, or with `/*` at its end all
/// packages in it.
fn folders(root: &Path, pattern: &str) -> Result<Vec<PathBuf>, String> {
    let Some(parent) = pattern.strip_suffix("/*") else {
        return Ok(vec![root.join(pattern)]);
    };
    let parent = root.join(parent);
    let entries = fs::read_dir(&parent).map_err(|error| format!("{}: {error}", parent.display()))?;
    let mut folders: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    folders.retain(|folder| folder.join("Cargo.toml").is_file());
    folders.sort();
    Ok(folders)
}

fn manifest(file: &Path) -> Result<Table, String> {
    let text = fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
    text.parse()
        .map_err(|error| format!("{}: {error}", file.display()))
}

/// Reads one manifest: dependencies and build dependencies, also those of some platforms only, under
/// their true names. Development dependencies do not count.
fn member(manifest: &Table, shared: &Table) -> Option<Member> {
    let package_table = manifest.get("package")?;
    let text = |key: &str| package_table.get(key)?.as_str().map(str::to_owned);
    let (name, description) = (text("name")?, text("description").unwrap_or_default());
    let platforms = manifest
        .get("target")
        .and_then(Value::as_table)
        .into_iter()
        .flat_map(Table::values);
    let parts = platforms.filter_map(Value::as_table).chain([manifest]);
    let mut depends_on = BTreeSet::new();
    for part in parts {
        for kind in ["dependencies", "build-dependencies"] {
            let Some(table) = part.get(kind).and_then(Value::as_table) else {
                continue;
            };
            depends_on.extend(
                table
                    .iter()
                    .map(|(key, value)| package(key, value, shared).to_owned()),
            );
        }
    }
    Some(Member {
        name,
        description,
        depends_on,
    })
}

/// Returns the package behind a dependency's key, which `package = "..."` may rename, here or in the
/// workspace.
fn package<'a>(key: &'a str, value: &'a Value, shared: &'a Table) -> &'a str {
    let inherited = value.get("workspace").and_then(Value::as_bool) == Some(true);
    let value = if inherited {
        shared.get(key).unwrap_or(value)
    } else {
        value
    };
    value.get("package").and_then(Value::as_str).unwrap_or(key)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the violations of the crate of this manifest, in a workspace with these shared dependencies.
    fn wrong(manifest: &str, shared: &str) -> Vec<String> {
        let manifest: Table = manifest.parse().expect("a manifest");
        let shared: Table = shared.parse().expect("dependencies");
        violations(&member(&manifest, &shared).expect("a package"))
    }

    fn wrong_with(name: &str, dependencies: &str) -> Vec<String> {
        wrong(&format!("[package]\nname = '{name}'\n{dependencies}"), "")
    }

    #[test]
    fn issue_036_every_library_s_entry_page_has_an_example() {
        let crates = Workspace::find().root.join("crates");
        let libraries = LAYERS
            .iter()
            .filter(|(layer, _)| !["libraries", "interfaces", "tools"].contains(layer));
        // There is no code in `features`.
        let names = libraries.flat_map(|(_, crates)| *crates);
        for name in names.filter(|name| **name != "features") {
            let text = fs::read_to_string(crates.join(name).join("src/lib.rs")).unwrap();
            let head: Vec<&str> = text.lines().take_while(|line| !line.starts_with("#!")).collect();
            assert!(
                head.contains(&"//! ```"),
                "{name} has no example on its entry page"
            );
        }
    }

    #[test]
    fn lower_layers_and_strangers_are_allowed() {
        let dependencies =
            "[dependencies]\nintegrate.workspace = true\nmechanics = { path = 'm' }\nlibm = '1'";
        assert_eq!(wrong_with("wedge", dependencies), [""; 0]);
        assert_eq!(
            wrong_with("xtask", "[dependencies]\nreport = { path = 'r' }"),
            [""; 0]
        );
    }

    #[test]
    fn the_same_layer_is_refused() {
        let found = wrong_with("numerics", "[dependencies]\nquantity.workspace = true");
        assert_eq!(
            found,
            [
                "`numerics` (layer 1, foundation) depends on `quantity` (layer 1, foundation), in the same \
                 layer."
            ]
        );
        assert_eq!(
            wrong_with("wedgelab-py", "[dependencies]\nwedgelab = { path = 'w' }").len(),
            1
        );
    }

    #[test]
    fn a_higher_layer_is_refused() {
        let found = wrong_with(
            "mechanics",
            "[dependencies]\nwedge = '1'\nstudy = '1'\nquantity = '1'",
        );
        assert_eq!(found.len(), 2);
        assert!(
            found[0].contains("`study` (layer 8, analysis), in a higher layer"),
            "{found:?}"
        );
    }

    #[test]
    fn neither_names_nor_platforms_nor_build_scripts_hide_a_dependency() {
        for dependency in [
            "[dependencies]\nother = { package = 'study', path = 's' }",
            "[dependencies]\nalias.workspace = true",
            "[dependencies.alias]\nworkspace = true\noptional = true",
            "[build-dependencies]\nstudy = '1'",
            "[target.'cfg(unix)'.dependencies]\nstudy = '1'",
        ] {
            let manifest = format!("[package]\nname = 'wedge'\n{dependency}");
            assert_eq!(
                wrong(&manifest, "alias = { package = 'study', path = 's' }").len(),
                1,
                "{dependency}"
            );
        }
    }

    #[test]
    fn development_dependencies_do_not_count() {
        assert_eq!(
            wrong_with("mechanics", "[dev-dependencies]\nstudy = '1'"),
            [""; 0]
        );
    }

    #[test]
    fn a_crate_without_a_layer_is_refused() {
        assert!(wrong_with("attic", "")[0].contains("`attic` is in no layer"));
    }

    #[test]
    fn no_crate_is_in_two_layers() {
        let all: Vec<_> = LAYERS.iter().flat_map(|(_, crates)| *crates).collect();
        assert_eq!(all.iter().collect::<BTreeSet<_>>().len(), all.len());
    }

    #[test]
    fn members_are_found_through_the_workspace() {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |file: &str, text: &str| {
            let file = folder.path().join(file);
            fs::create_dir_all(file.parent().expect("a parent")).expect("a folder");
            fs::write(file, text).expect("a file");
        };
        write("Cargo.toml", "[workspace]\nmembers = ['crates/*', 'xtask']");
        write("xtask/Cargo.toml", "[package]\nname = 'xtask'");
        write(
            "crates/wedge/Cargo.toml",
            "[package]\nname = 'wedge'\n[dependencies]\nstudy = '1'",
        );
        write("crates/notes.md", "no crate");
        let members = read(folder.path()).expect("members");
        assert_eq!(
            members
                .iter()
                .map(|member| member.name.as_str())
                .collect::<Vec<_>>(),
            ["wedge", "xtask"]
        );
        assert_eq!(members.iter().flat_map(violations).count(), 1);

        write("crates/broken/Cargo.toml", "[package");
        assert!(
            read(folder.path())
                .expect_err("a broken manifest")
                .contains("broken")
        );
    }
}
