//! The report that `reproduce` writes: complete, self-contained, small.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::OnceLock;

use tempfile::TempDir;

/// Returns the folder of a whole reproduction.
fn reproduction() -> &'static Path {
    static FOLDER: OnceLock<TempDir> = OnceLock::new();
    FOLDER
        .get_or_init(|| {
            let folder = tempfile::tempdir().unwrap();
            let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
                .args(["reproduce", "--quiet", "--force", "--out"])
                .arg(folder.path())
                .output()
                .unwrap();
            let errors = String::from_utf8(output.stderr).unwrap();
            assert!(output.status.success(), "{errors}");
            // Only the wedge that is pushed out is warned of, and slopes of massless wedges that feed energy.
            for line in errors.lines() {
                let yawed = line.starts_with("warning: nucars_69_") && line.contains("_yaw: implausible: ");
                let slopes = yawed && line.contains("`wedge_slope_loss` is a loss below zero");
                assert!(slopes || line.starts_with("warning: overturned_toe: "), "{line}");
            }
            folder
        })
        .path()
}

fn page() -> String {
    fs::read_to_string(reproduction().join("index.html")).unwrap()
}

/// Returns the page of the three-piece truck.
fn truck_page() -> String {
    fs::read_to_string(reproduction().join("truck.html")).unwrap()
}

/// Returns the values of an attribute.
fn values<'p>(page: &'p str, attribute: &str) -> Vec<&'p str> {
    let start = format!(" {attribute}=\"");
    page.split(start.as_str())
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .collect()
}

#[test]
fn every_link_leads_somewhere() {
    for (page, least) in [(page(), 200), (truck_page(), 80)] {
        links_lead_somewhere(&page, least);
    }
}

fn links_lead_somewhere(page: &str, least: usize) {
    let ids: Vec<&str> = values(page, "id");
    let unique: BTreeSet<&str> = ids.iter().copied().collect();
    assert_eq!(ids.len(), unique.len(), "an id stands twice");
    let links = values(page, "href");
    assert!(links.len() > least, "{}", links.len());
    for link in links {
        match link.strip_prefix('#') {
            Some(id) => assert!(unique.contains(id), "{link}"),
            None => assert!(reproduction().join(link).is_file(), "{link}"),
        }
    }
}

/// The page without what stands in its scripts, which name addresses in their licences and messages. That
/// they fetch nothing is watched in a browser (`cargo xtask test --only browser`).
fn markup() -> String {
    let page = page();
    let mut pieces = page.split("<script");
    let first = pieces.next().unwrap_or_default().to_owned();
    pieces.fold(first, |markup, piece| {
        let (_, rest) = piece.split_once("</script>").unwrap();
        markup + rest
    })
}

#[test]
fn the_page_needs_nothing_else() {
    let page = markup();
    assert!(values(&page, "src").is_empty());
    assert!(!self::page().contains("<script src"));
    for foreign in ["http:", "https:", "<link", "@import", "url("] {
        let found = page
            .replace("http://www.w3.org/2000/svg", "")
            .replace("url(#", "");
        assert!(!found.contains(foreign), "{foreign}");
    }
    assert!(page.len() < 15_000_000, "{} bytes", page.len());
}

#[test]
fn every_figure_is_there_twice_and_has_its_caption() {
    let page = page() + &truck_page();
    let figures = page.matches("<figure ").count();
    assert_eq!(figures, page.matches("<figcaption>").count());
    assert_eq!(figures, page.matches("<svg role=\"img\"").count());
    let files: BTreeSet<String> = fs::read_dir(reproduction().join("figures"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    assert_eq!(files.len(), 2 * figures);
    for file in &files {
        let bytes = fs::read(reproduction().join("figures").join(file)).unwrap();
        if let Some(name) = file.strip_suffix(".svg") {
            assert!(files.contains(&format!("{name}.png")), "{name}");
            assert!(
                bytes.starts_with(b"<svg ") && bytes.ends_with(b"</svg>\n"),
                "{file}"
            );
        } else {
            assert!(bytes.starts_with(b"\x89PNG"), "{file}");
            assert!(has_ink(&bytes), "{file} is empty");
        }
    }
}

/// The truck's page has every number of its file, and is not too large to be opened.
#[test]
fn the_trucks_page_tells_the_numbers_of_its_file() {
    let page = truck_page();
    assert!(page.len() < 15_000_000, "{} bytes", page.len());
    let text = fs::read_to_string(reproduction().join("truck.json")).unwrap();
    let found: serde_json::Value = serde_json::from_str(&text).unwrap();
    let checks = found["checks"].as_array().unwrap();
    assert!(checks.len() > 30, "{}", checks.len());
    for check in checks {
        let what = check["what"].as_str().unwrap();
        assert!(page.contains(&what.replace('&', "&amp;")), "{what}");
        if check["basis"] != "massless_wedge" {
            assert_eq!(check["agrees"], true, "{check}");
        }
    }
    assert_eq!(found["sensitivities"].as_array().unwrap().len(), 10);
}

/// Returns whether a picture is more than a blank page: a blank one of this size packs into a few kilobytes.
fn has_ink(png: &[u8]) -> bool {
    png.len() > 8_000
}

#[test]
fn issue_048_the_first_commands_page_is_interactive() {
    let folder = tempfile::tempdir().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
        .args(["reproduce", "--quiet", "--only", "cdrun_toe_0_psi_0", "--out"])
        .arg(folder.path())
        .output()
        .unwrap();
    let stdout = String::from_utf8(output.stdout).unwrap();
    let page = fs::read_to_string(folder.path().join("index.html")).unwrap();
    assert!(page.contains("id=\"wedgelab-view\"") && page.contains("id=\"wedgelab-viewer\""));
    assert!(!stdout.contains("Node.js"), "{stdout}");
}
