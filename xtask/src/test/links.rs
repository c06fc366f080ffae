//! Links between the pages of the repository lead to files and headings that exist, and source files that
//! pages name exist.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::Outcome;
use crate::shell::{self, Workspace};

/// Checks all Markdown files that belong to the repository.
pub fn check(workspace: &Workspace) -> Outcome {
    let mut list = std::process::Command::new("git");
    list.args(["ls-files", "--cached", "--others", "--exclude-standard"])
        .current_dir(&workspace.root);
    let files = shell::output(&mut list).ok_or("git cannot list the files")?;
    let (mut count, mut broken) = (0, Vec::new());
    for name in files.lines().filter(|name| name.ends_with(".md")) {
        let page = workspace.root.join(name);
        let Ok(text) = fs::read_to_string(&page) else {
            continue;
        };
        for (line, link) in links(&text) {
            count += 1;
            if let Err(reason) = follow(&page, &text, &link) {
                broken.push(format!("{name}:{line}: `{link}`: {reason}"));
            }
        }
        // Records of decisions and changes name what was there on their day.
        if name.contains("decisions/") || name == "CHANGELOG.md" {
            continue;
        }
        for (line, source) in sources(&text) {
            if !files.lines().any(|file| is_named(file, &source)) {
                broken.push(format!("{name}:{line}: `{source}`: there is no such source file"));
            }
        }
    }
    if broken.is_empty() {
        Ok(Some(format!("{count} links")))
    } else {
        Err(broken.join("\n"))
    }
}

/// Returns the targets of links and images to places within the repository, with their lines.
fn links(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut code = false;
    for (number, line) in text.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            code = !code;
        }
        if code {
            continue;
        }
        for part in line.split("](").skip(1) {
            let target = part.split([')', ' ']).next().unwrap_or_default();
            if !target.is_empty() && !target.contains("://") && !target.starts_with("mailto:") {
                found.push((number + 1, target.to_owned()));
            }
        }
    }
    found
}

/// Returns the Rust files that the text names in backticks, with their lines: a path or its end.
fn sources(text: &str) -> Vec<(usize, String)> {
    let is_source = |word: &&str| word.ends_with(".rs") && !word.contains([' ', '*', '{']);
    let lines = text.lines().enumerate();
    let found = lines.flat_map(|(number, line)| {
        let inside = line.split('`').skip(1).step_by(2);
        inside
            .filter(is_source)
            .map(move |word| (number + 1, word.to_owned()))
    });
    found.collect()
}

/// Returns whether a file's path ends with all parts of the name.
fn is_named(file: &str, name: &str) -> bool {
    let before = file.strip_suffix(name.trim_start_matches("../"));
    before.is_some_and(|before| before.is_empty() || before.ends_with('/'))
}

/// Follows a link from a page with this text.
fn follow(page: &Path, text: &str, link: &str) -> Result<(), String> {
    let (file, heading) = link.split_once('#').unwrap_or((link, ""));
    let folder = page.parent().unwrap_or(Path::new("."));
    let target: PathBuf = if file.is_empty() {
        page.to_owned()
    } else {
        folder.join(file)
    };
    if !target.exists() {
        return Err("there is no such file".to_owned());
    }
    if heading.is_empty() {
        return Ok(());
    }
    let read;
    let text = if file.is_empty() {
        text
    } else {
        read = fs::read_to_string(&target).map_err(|error| error.to_string())?;
        &read
    };
    if headings(text).contains(heading) {
        Ok(())
    } else {
        Err("there is no such heading".to_owned())
    }
}

/// Returns the anchors of all headings, as forges make them: lower case, hyphens for spaces, punctuation left
/// out; numbered where a heading stands twice.
fn headings(text: &str) -> HashSet<String> {
    let mut found = HashSet::new();
    let mut code = false;
    for line in text.lines() {
        if line.starts_with("```") {
            code = !code;
        }
        let Some(title) = line.strip_prefix('#').filter(|_| !code) else {
            continue;
        };
        let title = title.trim_start_matches('#').trim().to_lowercase();
        let kept = title
            .chars()
            .filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
        let anchor: String = kept.map(|c| if c == ' ' { '-' } else { c }).collect();
        let mut unique = anchor.clone();
        let mut number = 0;
        while !found.insert(unique.clone()) {
            number += 1;
            unique = format!("{anchor}-{number}");
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn source_files_are_named_in_backticks() {
        let text = "`a/b.rs` and `c d.rs`\nnothing `*.rs`; `e.rs`";
        assert_eq!(sources(text), [(1, "a/b.rs".to_owned()), (2, "e.rs".to_owned())]);
        assert!(is_named("crates/a/b.rs", "a/b.rs") && is_named("b.rs", "b.rs"));
        assert!(!is_named("crates/a/b.rs", "c/b.rs") && !is_named("crates/bb.rs", "b.rs"));
    }

    #[test]
    fn links_and_headings_are_found() {
        let text = "# A title, with `code`\n[x](y.md#z) ![p](q.svg)\n```\n[not](me)\n```\n\
                    [web](https://a.b)\n## Twice\n## Twice\n";
        let found: Vec<String> = links(text).into_iter().map(|(_, link)| link).collect();
        assert_eq!(found, ["y.md#z", "q.svg"]);
        let expected = ["a-title-with-code", "twice", "twice-1"].map(str::to_owned);
        assert_eq!(headings(text), HashSet::from(expected));
    }

    #[test]
    fn broken_links_are_reported() {
        let page = Workspace::find().root.join("README.md");
        assert!(follow(&page, "# Here\n", "#here").is_ok());
        assert!(follow(&page, "# Here\n", "#there").is_err());
        assert!(follow(&page, "", "no_such_file.md").is_err());
    }
}
