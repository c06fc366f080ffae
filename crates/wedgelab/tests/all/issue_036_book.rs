//! Issue 36: the commands that the documentation shows are commands of this program.

#![cfg(unix)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The pages of the documentation.
fn pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let docs = fs::read_dir(root.join("docs")).unwrap();
    docs.map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "md"))
        .chain(["README.md", "CONTRIBUTING.md"].map(|name| root.join(name)))
        .collect()
}

/// The calls of the program in the blocks of shell code, without comments and without what follows them.
fn calls(page: &str) -> Vec<String> {
    let mut inside = false;
    let mut lines = String::new();
    for line in page.lines() {
        if line.starts_with("```") {
            inside = line == "```sh";
        } else if inside {
            let mut comments = line.match_indices(" #").map(|(at, _)| at);
            let comment = comments.find(|at| line[..*at].matches('"').count() % 2 == 0);
            let line = line[..comment.unwrap_or(line.len())].trim();
            match line.strip_suffix('\\') {
                Some(begun) => lines.push_str(begun),
                None => lines.push_str(&format!("{line}\n")),
            }
        }
    }
    let calls = lines.lines().filter(|line| line.starts_with("wedgelab "));
    let ends = [" > ", " | ", " && ", " &", ";"];
    let end = |call: &str| ends.iter().filter_map(|end| call.find(end)).min();
    calls
        .map(|call| call[..end(call).unwrap_or(call.len())].to_owned())
        .collect()
}

/// Commands, options and the values that these take; `--help` at the end keeps each from running.
#[test]
fn issue_036_commands_of_the_book_are_understood() {
    let program = Path::new(env!("CARGO_BIN_EXE_wedgelab"));
    let mut wrong = Vec::new();
    let mut count = 0;
    for page in pages() {
        for call in calls(&fs::read_to_string(&page).unwrap()) {
            count += 1;
            let line = format!("{} --help", call.replacen("wedgelab", "\"$WEDGELAB\"", 1));
            let mut shell = Command::new("sh");
            let output = shell
                .args(["-c", &line])
                .env("WEDGELAB", program)
                .output()
                .unwrap();
            if output.status.code() != Some(0) {
                let said = String::from_utf8_lossy(&output.stderr).into_owned();
                wrong.push(format!("{}: {call}\n{said}", page.display()));
            }
        }
    }
    assert!(count > 90, "{count} calls");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn calls_stand_in_blocks_of_shell_code() {
    let page = "wedgelab no\n```sh\nwedgelab run a --set b=\"1 # 2\"   # one\nwedgelab case x > y.toml\n\
                cargo x\nwedgelab run c \\\n  --force && ls\n```\n```toml\nwedgelab = 1\n```\n";
    assert_eq!(
        calls(page),
        [
            "wedgelab run a --set b=\"1 # 2\"",
            "wedgelab case x",
            "wedgelab run c --force"
        ]
    );
}
