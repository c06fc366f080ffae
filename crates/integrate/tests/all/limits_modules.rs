//! limits: modules use only modules of the lines before their own, as the documentation of the crate states.

use std::fs;
use std::path::Path;

/// Returns all text of a module: its file, or the files of its folder.
fn text(source: &Path, module: &str) -> String {
    let file = source.join(format!("{module}.rs"));
    if file.exists() {
        return fs::read_to_string(file).unwrap();
    }
    fs::read_dir(source.join(module))
        .unwrap()
        .map(|entry| fs::read_to_string(entry.unwrap().path()).unwrap())
        .collect()
}

/// Returns the modules of the crate that a text uses.
fn used(text: &str) -> Vec<String> {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let uses = code.flat_map(|line| line.split("crate::").skip(1).map(str::to_owned));
    uses.map(|rest| {
        let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        rest[..end.unwrap_or(rest.len())].to_owned()
    })
    .collect()
}

#[test]
fn limits_modules_use_only_modules_of_earlier_lines() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let head = fs::read_to_string(source.join("lib.rs")).unwrap();
    let order: Vec<Vec<&str>> = head
        .lines()
        .skip_while(|line| *line != "//! # Modules")
        .skip_while(|line| *line != "//! ```text")
        .skip(1)
        .take_while(|line| *line != "//! ```")
        .map(|line| line.trim_start_matches("//! ").split_whitespace().collect())
        .collect();
    let level = |module: &str| order.iter().position(|line| line.contains(&module));
    let declared: Vec<&str> = head
        .lines()
        .filter_map(|line| line.strip_prefix("pub mod ").or(line.strip_prefix("mod ")))
        .map(|line| line.trim_end_matches(';'))
        .collect();
    assert_eq!(declared.len(), order.iter().flatten().count());
    let mut checked = 0;
    for module in declared {
        let own = level(module).unwrap_or_else(|| panic!("{module} is in no line"));
        for other in used(&text(&source, module)) {
            if let Some(line) = level(&other)
                && other != module
            {
                assert!(line < own, "{module} uses {other}");
                checked += 1;
            }
        }
    }
    assert!(checked > 80, "{checked} uses");
}
