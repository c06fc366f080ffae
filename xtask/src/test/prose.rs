//! Nothing in the repository points outside it: no path of one machine, no file that only its authors have.
//! No line of a Rust source is longer than [`WIDTH`].

use std::fs;
use std::path::Path;

use super::Outcome;
use crate::shell::Workspace;

/// Texts that no file may contain. Written in pieces, so that this file does not find itself.
const FORBIDDEN: &[&str] = &[
    concat!("..", "/shared"),
    concat!("/", "work/"),
    concat!("/", "home/"),
    concat!("/", "root/"),
    concat!("/", "tmp/"),
    concat!("/", "Users/"),
    concat!("C:", "\\Users"),
];

/// The longest line of a Rust source, characters: as in `rustfmt.toml`, which leaves comments, strings and
/// the contents of macros alone.
const WIDTH: usize = 110;

/// Checks all text files of the repository.
pub fn check(workspace: &Workspace) -> Outcome {
    let ignored = ignored(&fs::read_to_string(workspace.root.join(".gitignore")).unwrap_or_default());
    let mut search = Search {
        root: &workspace.root,
        ignored,
        files: 0,
        found: Vec::new(),
    };
    search
        .folder(&workspace.root)
        .map_err(|error| format!("the repository cannot be read: {error}"))?;
    if search.found.is_empty() {
        Ok(Some(format!("{} files", search.files)))
    } else {
        Err(search.found.join("\n"))
    }
}

/// Returns the plain folder and file names in `.gitignore`, those of the topmost folder with a slash before
/// them; patterns are left aside.
fn ignored(gitignore: &str) -> Vec<String> {
    let names = gitignore.lines().map(|line| line.trim().trim_end_matches('/'));
    let inner = |name: &str| name.strip_prefix('/').unwrap_or(name).contains('/');
    let plain =
        names.filter(|name| !name.is_empty() && !name.contains(['#', '*', '!', '?', '[']) && !inner(name));
    plain
        .map(str::to_owned)
        .chain(["target".to_owned(), ".git".to_owned()])
        .collect()
}

struct Search<'a> {
    root: &'a Path,
    ignored: Vec<String>,
    files: usize,
    found: Vec<String>,
}

impl Search<'_> {
    fn folder(&mut self, folder: &Path) -> std::io::Result<()> {
        let mut entries = fs::read_dir(folder)?.collect::<Result<Vec<_>, _>>()?;
        entries.sort_by_key(fs::DirEntry::file_name);
        for entry in entries {
            let name = entry.file_name();
            let is_ignored = |ignored: &String| match ignored.strip_prefix('/') {
                Some(top) => folder == self.root && name == top,
                None => name == ignored.as_str(),
            };
            if self.ignored.iter().any(is_ignored) {
                continue;
            }
            let kind = entry.file_type()?;
            if kind.is_dir() {
                self.folder(&entry.path())?;
            } else if kind.is_file() {
                self.file(&entry.path())?;
            }
        }
        Ok(())
    }

    fn file(&mut self, file: &Path) -> std::io::Result<()> {
        let bytes = fs::read(file)?;
        if bytes.contains(&0) {
            return Ok(());
        }
        self.files += 1;
        let shown = file.strip_prefix(self.root).unwrap_or(file).display();
        let rust = file.extension().is_some_and(|extension| extension == "rs");
        for (number, line) in String::from_utf8_lossy(&bytes).lines().enumerate() {
            let place = format!("{shown}:{}", number + 1);
            if let Some(path) = offence(line) {
                self.found
                    .push(format!("{place}: names `{path}`: {}", line.trim()));
            }
            if rust && too_long(line) {
                self.found
                    .push(format!("{place}: longer than {WIDTH} characters"));
            }
        }
        Ok(())
    }
}

/// Returns the forbidden path in a line, if there is one. What stands within a longer path or address
/// (`example.org/home/`) is none.
fn offence(line: &str) -> Option<&'static str> {
    let inside = |before: char| before.is_alphanumeric() || matches!(before, '_' | '-' | '.' | '}' | ')');
    let begins = |at: usize| !line[..at].ends_with(inside);
    let offends = |path: &&str| line.match_indices(*path).any(|(at, _)| begins(at));
    FORBIDDEN.iter().copied().find(offends)
}

/// Returns true for a line of a Rust source that is longer than [`WIDTH`] and could be shorter: rows of
/// tables in doc comments and addresses cannot be wrapped.
fn too_long(line: &str) -> bool {
    let begins = line.trim_start();
    let row = begins.starts_with("//! |") || begins.starts_with("/// |");
    line.chars().count() > WIDTH && !row && !line.contains("://")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_of_a_machine_are_found() {
        for path in FORBIDDEN {
            for line in [
                format!("see {path}spec"),
                format!("({path}x)"),
                format!("\"{path}\""),
                (*path).to_owned(),
            ] {
                assert_eq!(offence(&line), Some(*path), "{line}");
            }
        }
        assert_eq!(offence(concat!("../..", "/shared/spec")), Some(FORBIDDEN[0]));
    }

    #[test]
    fn longer_paths_and_addresses_are_not() {
        for line in [
            "https://example.org/home/page",
            "frame/work/energy",
            "${ROOT}/tmp/x",
            "work/ and home/",
        ] {
            assert_eq!(offence(line), None, "{line}");
        }
    }

    #[test]
    fn long_lines_are_found_but_for_tables_and_addresses() {
        let widest = "é".repeat(WIDTH);
        assert!(!too_long(&widest));
        assert!(too_long(&format!("{widest}.")));
        assert!(too_long(&format!("    /// {widest}")));
        for line in [
            format!("    /// | a | {widest} |"),
            format!("//! https://example.org/{widest}"),
        ] {
            assert!(!too_long(&line), "{line}");
        }
    }

    #[test]
    fn plain_names_of_gitignore_are_left_out() {
        let names = ignored("# built\ntarget/\n/reproduction/\n*.tmp\n!kept\n\n");
        assert_eq!(names, ["target", "/reproduction", "target", ".git"]);
    }

    #[test]
    fn the_search_names_file_and_line() {
        let folder = tempfile::tempdir().expect("a folder");
        let bad = concat!("fine\nsee /", "work/spec\n");
        for (name, text) in [
            ("a.md", bad),
            ("target/b.md", bad),
            ("docs/c.md", bad),
            ("results/e.md", bad),
            ("docs/results/f.md", bad),
            ("d.bin", "\0/"),
        ] {
            let file = folder.path().join(name);
            fs::create_dir_all(file.parent().expect("a parent")).expect("a folder");
            fs::write(file, text).expect("a file");
        }
        let mut search = Search {
            root: folder.path(),
            ignored: ignored("/results/\n"),
            files: 0,
            found: Vec::new(),
        };
        search.folder(folder.path()).expect("readable");
        assert_eq!(search.files, 3);
        assert_eq!(search.found.len(), 3);
        assert!(search.found[0].starts_with("a.md:2: names"), "{:?}", search.found);
    }
}
