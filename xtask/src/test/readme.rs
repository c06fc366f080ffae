//! The commands of the README, and those of the tutorial, run in their order in an empty folder.

use std::env;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use super::Outcome;
use crate::builds;
use crate::shell::{self, Workspace};

/// Beginnings of commands that are not run here: other checks run them, they need the repository, or they
/// take most of a minute.
const ELSEWHERE: [&str; 4] = [
    "cargo install --path crates/wedgelab",
    "cargo xtask ",
    "pip install .",
    "wedgelab stability car_hunting_roller_empty --nonlinear",
];

/// A built program is called in place of this.
const FROM_SOURCE: &str = "cargo run --release -- ";

/// Runs the commands.
pub fn check(workspace: &Workspace) -> Outcome {
    builds::wedgelab(workspace)?;
    let readme = run(workspace, "README.md")?;
    let tutorial = run(workspace, "docs/tutorial.md")?;
    Ok(Some(format!("{readme} commands, {tutorial} of the tutorial")))
}

/// Runs the commands of a page in an empty folder; returns how many there are.
fn run(workspace: &Workspace, page: &str) -> Result<usize, String> {
    let text = fs::read_to_string(workspace.root.join(page))
        .map_err(|error| format!("{page} cannot be read: {error}"))?;
    let commands = commands(&text);
    if commands.is_empty() {
        return Err(format!("{page} has no commands"));
    }
    let folder = workspace.target.join("tools").join("readme");
    let failed = |error: std::io::Error| format!("cannot prepare {}: {error}", folder.display());
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(failed)?;
    }
    fs::create_dir_all(&folder).map_err(failed)?;
    let programs = [workspace.target.join("release")].into_iter();
    let others = env::var_os("PATH").unwrap_or_default();
    let path = env::join_paths(programs.chain(env::split_paths(&others).collect::<Vec<PathBuf>>()))
        .map_err(|error| format!("PATH cannot be set: {error}"))?;
    for command in &commands {
        let mut shell = Command::new("bash");
        let options = ["-euo", "pipefail", "-c", command.as_str()];
        shell::run(shell.args(options).current_dir(&folder).env("PATH", &path))?;
    }
    Ok(commands.len())
}

/// Returns the commands of the blocks of shell code that are run here, without their comments, and commands
/// that save the blocks below "Save this as `NAME`".
fn commands(page: &str) -> Vec<String> {
    let mut commands = Vec::new();
    let mut inside = false;
    let mut name = None;
    let mut file: Option<String> = None;
    for line in page.lines() {
        if let Some((_, rest)) = line.split_once("Save this as `") {
            name = rest.split('`').next();
        }
        if line.starts_with("```") {
            inside = line == "```sh";
            commands.extend(file.take().map(|file| file + "END"));
            if line.len() > 3 {
                file = name.take().map(|name| format!("cat > {name} <<'END'\n"));
            }
        } else if let Some(file) = &mut file {
            file.push_str(line);
            file.push('\n');
        } else if inside {
            let command = line.split("  #").next().unwrap_or_default().trim();
            let elsewhere = ELSEWHERE.iter().any(|start| command.starts_with(start));
            if !command.is_empty() && !elsewhere {
                commands.push(command.replacen(FROM_SOURCE, "wedgelab ", 1));
            }
        }
    }
    commands
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_saved_as_a_page_says() {
        let page = "Save this as `a.toml`:\n\n```toml\nb = 1\n[c]\n```\n```sh\nwedgelab study a.toml\n```\n";
        let saved = "cat > a.toml <<'END'\nb = 1\n[c]\nEND";
        assert_eq!(commands(page), [saved, "wedgelab study a.toml"]);
    }

    #[test]
    fn issue_036_the_readme_is_short_and_says_what_to_trust() {
        let readme = fs::read_to_string(Workspace::find().root.join("README.md")).unwrap();
        let lines = readme.lines().count();
        assert!(lines <= 120, "{lines} lines");
        for text in [
            "![",
            "## Which numbers to trust",
            "## Limits",
            "always hold",
            "NUCARS",
        ] {
            assert!(readme.contains(text), "{text}");
        }
        assert!(!readme.contains("comparison program"));
    }

    #[test]
    fn issue_036_what_contributors_need_is_there() {
        let root = Workspace::find().root;
        let read = |name: &str| fs::read_to_string(root.join(name)).unwrap();
        let guide = read("CONTRIBUTING.md");
        for text in [
            "first force element",
            "first friction law",
            "## A release",
            "Rust 1.",
        ] {
            assert!(guide.contains(text), "{text}");
        }
        for name in ["CODE_OF_CONDUCT.md", ".github/pull_request_template.md"] {
            assert!(!read(name).trim().is_empty(), "{name}");
        }
        let checks = read(".github/workflows/checks.yml");
        for system in ["ubuntu", "macos", "windows"] {
            assert!(checks.contains(system), "{system}");
        }
        for text in [checks, read(".github/workflows/benchmarks.yml")] {
            assert!(text.lines().next().unwrap().contains("UNTESTED"));
        }
        for name in ["integrate", "wheelrail"] {
            assert!(
                root.join("crates").join(name).join("README.md").is_file(),
                "{name}"
            );
        }
    }

    #[test]
    fn commands_stand_in_blocks_of_shell_code() {
        let readme = "wedgelab no\n```sh\ncargo xtask test   # checks\ncargo run --release -- case   # list\n\
                      wedgelab run x --set a=\"1 #\"\n```\n```toml\nwedgelab = 1\n```\n";
        assert_eq!(
            commands(readme),
            ["wedgelab case", "wedgelab run x --set a=\"1 #\""]
        );
    }
}
