//! reproduction: the page docs/case-keys.md holds the keys of this build.

#[path = "../case_keys/page.rs"]
mod page;

use study::case::every_key::MODELS;

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

/// The files of docs/schema are the schemas of this build.
#[test]
fn reproduction_the_schemas_of_cases_are_those_of_this_build() {
    for model in MODELS {
        let path = format!(
            "{}/../../docs/schema/{}.json",
            env!("CARGO_MANIFEST_DIR"),
            model.name
        );
        let written = std::fs::read_to_string(&path).unwrap();
        let hint = "run cargo run --release -p study --example case_keys";
        assert!(
            written == page::schema(&model),
            "{path} is of another build: {hint}"
        );
    }
}
