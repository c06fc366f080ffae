//! `cargo xtask book`: the documentation as a book in `target/book`, by mdBook, which cargo installs into
//! `target/tools` once.
//!
//! The pages are those of the repository, copied with their folders, so that links between them hold; links
//! to other files lead to the repository on the web.

use std::fs;
use std::path::{Component, Path, PathBuf};
use std::process::{Command, ExitCode};

use crate::shell::{self, Workspace};

const VERSION: &str = "0.5.4";

const SETTINGS: &str = "[book]\ntitle = \"Wedgelab\"\nlanguage = \"en\"\nsrc = \"src\"\n\n\
                        [output.html]\nno-section-label = true\n";

/// Pages outside of `docs`.
const PAGES: [&str; 5] = [
    "README.md",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CODE_OF_CONDUCT.md",
    "CONTRIBUTING.md",
];

/// Runs the command.
pub fn run(workspace: &Workspace, arguments: &[String]) -> ExitCode {
    if !arguments.is_empty() {
        println!("Usage: cargo xtask book\n\nWrites the documentation to target/book/book/index.html.");
        let help = arguments
            .iter()
            .any(|argument| argument == "--help" || argument == "-h");
        return if help {
            ExitCode::SUCCESS
        } else {
            ExitCode::from(2)
        };
    }
    match build(workspace) {
        Ok(index) => {
            println!("Written: {}", index.display());
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Builds the book, and returns its first page.
pub fn build(workspace: &Workspace) -> Result<PathBuf, String> {
    let folder = workspace.target.join("book");
    let pages = folder.join("src");
    let failed = |error: std::io::Error| format!("cannot prepare {}: {error}", folder.display());
    if pages.exists() {
        fs::remove_dir_all(&pages).map_err(failed)?;
    }
    fs::create_dir_all(&pages).map_err(failed)?;
    fs::write(folder.join("book.toml"), SETTINGS).map_err(failed)?;
    let repository = repository(workspace)?;
    for name in PAGES {
        let text = fs::read_to_string(workspace.root.join(name)).map_err(failed)?;
        fs::write(pages.join(name), outward(&text, Path::new(name), &repository)).map_err(failed)?;
    }
    copy(workspace, Path::new("docs"), &pages, &repository).map_err(failed)?;
    let summary = fs::read_to_string(workspace.root.join("docs/SUMMARY.md")).map_err(failed)?;
    fs::write(pages.join("SUMMARY.md"), from_the_root(&summary)).map_err(failed)?;
    shell::run(Command::new(program(workspace)?).arg("build").arg(&folder))?;
    Ok(folder.join("book").join("index.html"))
}

/// Returns the program, installed if it is not there.
fn program(workspace: &Workspace) -> Result<PathBuf, String> {
    let root = workspace.target.join("tools").join("mdbook");
    let program = root.join("bin").join("mdbook");
    if !program.is_file() {
        shell::say("mdBook is installed into target/tools now, once.");
        // Not optimized: it is compiled more often than it is run.
        let arguments = [
            "install",
            "mdbook",
            "--debug",
            "--locked",
            "--quiet",
            "--version",
            VERSION,
        ];
        let features = ["--no-default-features", "--features", "search", "--root"];
        shell::run(workspace.cargo(arguments).args(features).arg(&root))?;
    }
    Ok(program)
}

/// Returns the address of the repository on the web, as the workspace's manifest names it.
fn repository(workspace: &Workspace) -> Result<String, String> {
    let manifest =
        fs::read_to_string(workspace.root.join("Cargo.toml")).map_err(|error| error.to_string())?;
    let line = manifest
        .lines()
        .find_map(|line| line.strip_prefix("repository = "));
    line.map(|address| address.trim().trim_matches('"').to_owned())
        .ok_or_else(|| "Cargo.toml names no repository".to_owned())
}

/// Copies a folder of pages and figures.
fn copy(workspace: &Workspace, folder: &Path, pages: &Path, repository: &str) -> std::io::Result<()> {
    fs::create_dir_all(pages.join(folder))?;
    for entry in fs::read_dir(workspace.root.join(folder))? {
        let entry = entry?;
        let name = folder.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            copy(workspace, &name, pages, repository)?;
        } else if name.extension().is_some_and(|extension| extension == "md") {
            let text = fs::read_to_string(entry.path())?;
            fs::write(pages.join(&name), outward(&text, &name, repository))?;
        } else {
            fs::copy(entry.path(), pages.join(&name))?;
        }
    }
    Ok(())
}

/// Returns a page whose links to files that are not in the book lead to the repository on the web.
fn outward(text: &str, page: &Path, repository: &str) -> String {
    let mut parts = text.split("](");
    let mut result = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        result.push_str("](");
        let end = part.find(')').unwrap_or(part.len());
        let target = place(page, &part[..end]);
        match target.filter(|target| !in_the_book(target)) {
            Some(target) => result.push_str(&format!("{repository}/blob/main/{target}{}", &part[end..])),
            None => result.push_str(part),
        }
    }
    result
}

/// Returns the place in the repository to which a link of a page leads; none: elsewhere.
fn place(page: &Path, link: &str) -> Option<String> {
    if link.is_empty() || link.starts_with('#') || link.contains("://") || link.contains(' ') {
        return None;
    }
    let file = link.split('#').next().unwrap_or(link);
    let mut parts: Vec<String> = Vec::new();
    for part in page.parent().unwrap_or(Path::new("")).join(file).components() {
        match part {
            Component::Normal(name) => parts.push(name.to_string_lossy().into_owned()),
            Component::ParentDir => drop(parts.pop()),
            _ => {}
        }
    }
    Some(parts.join("/"))
}

fn in_the_book(target: &str) -> bool {
    PAGES.contains(&target) || (target.starts_with("docs/") && target.contains('.'))
}

/// Returns the summary of `docs` as one of the folder above.
fn from_the_root(summary: &str) -> String {
    let links = summary.replace("](", "](docs/");
    links.replace("](docs/../", "](")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_out_of_the_book_lead_to_the_repository() {
        let text = "[a](elements.md) [b](../README.md) [c](../crates/x/src/y.rs#L3) [d](https://e.f) [g](#h)";
        let expected = "[a](elements.md) [b](../README.md) [c](https://web/blob/main/crates/x/src/y.rs) \
                        [d](https://e.f) [g](#h)";
        assert_eq!(outward(text, Path::new("docs/page.md"), "https://web"), expected);
    }

    #[test]
    fn the_summary_is_seen_from_above() {
        assert_eq!(
            from_the_root("- [a](b.md)\n- [c](../D.md)"),
            "- [a](docs/b.md)\n- [c](D.md)"
        );
    }

    /// Every page of the documentation stands in the summary.
    #[test]
    fn the_summary_is_complete() {
        let workspace = Workspace::find();
        let docs = workspace.root.join("docs");
        let summary = fs::read_to_string(docs.join("SUMMARY.md")).unwrap();
        for (folder, prefix) in [(docs.clone(), ""), (docs.join("decisions"), "decisions/")] {
            for entry in fs::read_dir(folder).unwrap() {
                let name = entry.unwrap().file_name().to_string_lossy().into_owned();
                let left_out = ["SUMMARY.md", "0000-template.md"].contains(&name.as_str());
                if name.ends_with(".md") && !left_out {
                    assert!(summary.contains(&format!("({prefix}{name})")), "{prefix}{name}");
                }
            }
        }
    }
}
