//! reproduction: the page docs/validation-rolling.md holds what is computed.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

#[path = "validation/page.rs"]
mod page;

/// The page's numbers are those of this build, and all parts are there.
#[test]
fn reproduction_the_validation_page_holds_what_is_computed() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/validation-rolling.md");
    let written = std::fs::read_to_string(path).unwrap();
    let computed = page::page();
    for (number, (written, computed)) in written.lines().zip(computed.lines()).enumerate() {
        assert_eq!(
            written,
            computed,
            "line {} of docs/validation-rolling.md: run cargo run --release -p rolling --example \
             wheelset_validation",
            number + 1
        );
    }
    assert_eq!(written.lines().count(), computed.lines().count());
    assert_eq!(computed.matches("\n## ").count(), 9);
    assert!(!computed.contains("NaN") && !computed.contains("MORE"));
}
