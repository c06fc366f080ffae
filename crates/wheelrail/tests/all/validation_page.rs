//! reproduction: the page docs/validation-wheelrail.md holds what is computed.

#[path = "../validation/page.rs"]
mod page;

/// The page's numbers are those of this build; and all parts are there, so that none was left out by an
/// error.
#[test]
fn reproduction_the_validation_page_holds_what_is_computed() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/validation-wheelrail.md");
    let written = std::fs::read_to_string(path).unwrap();
    let computed = page::page();
    for (number, (written, computed)) in written.lines().zip(computed.lines()).enumerate() {
        assert_eq!(
            written,
            computed,
            "line {} of docs/validation-wheelrail.md: run cargo run --release -p wheelrail --example \
             validation",
            number + 1
        );
    }
    assert_eq!(written.lines().count(), computed.lines().count());
    assert_eq!(computed.matches("\n## ").count(), 9);
    // Rows of the nine tables and the second ones of Hertz and EN 15302: heads, lines, and numbers.
    assert_eq!(
        computed.lines().filter(|line| line.starts_with('|')).count(),
        2 * 11 + 4 + 7 + 6 + 3 + 5 + 2 + 16 + 5 + 4 + 3 + 4
    );
    assert!(!computed.contains("NaN") && !computed.contains("no height"));
}
