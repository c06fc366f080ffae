//! The commands of the README run, in its order, in an empty folder, and once more where results exist.

use std::env;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use super::Outcome;
use crate::builds;
use crate::shell::{self, Workspace};

/// Beginnings of commands that other checks run, or that need the repository: they are not run here.
const ELSEWHERE: [&str; 3] = [
    "cargo install --path crates/wedgelab",
    "cargo xtask ",
    "pip install .",
];

/// A built program is called in place of this.
const FROM_SOURCE: &str = "cargo run --release -- ";

/// Runs the commands.
pub fn check(workspace: &Workspace) -> Outcome {
    let readme = fs::read_to_string(workspace.root.join("README.md"))
        .map_err(|error| format!("README.md cannot be read: {error}"))?;
    let commands = commands(&readme);
    if commands.is_empty() {
        return Err("README.md has no commands".to_owned());
    }
    builds::wedgelab(workspace)?;
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
    for _ in 0..2 {
        for command in &commands {
            let mut shell = Command::new("bash");
            let options = ["-euo", "pipefail", "-c", command.as_str()];
            shell::run(shell.args(options).current_dir(&folder).env("PATH", &path))?;
        }
    }
    Ok(Some(format!("{} commands, twice", commands.len())))
}

/// Returns the commands of the blocks of shell code that are run here, without their comments.
fn commands(readme: &str) -> Vec<String> {
    let mut commands = Vec::new();
    let mut inside = false;
    for line in readme.lines() {
        if line.starts_with("```") {
            inside = line == "```sh";
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
    fn commands_stand_in_blocks_of_shell_code() {
        let readme = "wedgelab no\n```sh\ncargo xtask test   # checks\ncargo run --release -- case   # list\n\
                      wedgelab run x --set a=\"1 #\"\n```\n```toml\nwedgelab = 1\n```\n";
        assert_eq!(
            commands(readme),
            ["wedgelab case", "wedgelab run x --set a=\"1 #\""]
        );
    }
}
