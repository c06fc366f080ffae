//! reproduction: the page docs/case-keys.md holds the keys of this build.

#[path = "../case_keys/page.rs"]
mod page;
#[path = "../case_keys/python.rs"]
mod python;

use study::models::case_keys;

#[test]
fn reproduction_the_reference_of_case_keys_is_that_of_this_build() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/case-keys.md");
    let written = std::fs::read_to_string(path).unwrap();
    let expected = page::page();
    for (number, (written, expected)) in written.lines().zip(expected.lines()).enumerate() {
        let hint = "run cargo run --release -p study --example case_keys";
        assert_eq!(
            written,
            expected,
            "line {} of docs/case-keys.md: {hint}",
            number + 1
        );
    }
    assert_eq!(written.lines().count(), expected.lines().count());
    // Every key has a meaning, but for motions along coordinates, whose names say all.
    let unexplained = expected.lines().filter(|line| line.ends_with("|  |"));
    assert_eq!(unexplained.collect::<Vec<_>>(), Vec::<&str>::new());
}

/// The schemas of docs/schema and the sections in Python are those of this build.
#[test]
fn reproduction_schemas_and_python_sections_are_those_of_this_build() {
    let schemas =
        case_keys().map(|(model, keys)| (format!("docs/schema/{model}.json"), page::schema(model, keys)));
    let python = "crates/wedgelab-py/python/wedgelab/sections.py".to_owned();
    for (path, expected) in schemas.chain([(python, python::sections())]) {
        let written =
            std::fs::read_to_string(format!("{}/../../{path}", env!("CARGO_MANIFEST_DIR"))).unwrap();
        let hint = "run cargo run --release -p study --example case_keys";
        assert!(written == expected, "{path} is of another build: {hint}");
    }
}
