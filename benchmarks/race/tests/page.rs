//! The page on disk is that of the stored results.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::Path;

use race::page::Results;

#[test]
fn reproduction_the_page_is_written_from_the_stored_results() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let file = docs.join("measured/race.json");
    let results = Results::read(&file).unwrap();
    assert_eq!(results.to_json().unwrap(), fs::read_to_string(&file).unwrap());
    let page = fs::read_to_string(docs.join("race.md")).unwrap();
    assert!(
        results.page() == page,
        "docs/race.md differs from what `cargo xtask race --page` writes"
    );
}
