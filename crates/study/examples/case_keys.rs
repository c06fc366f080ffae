//! Writes docs/case-keys.md: every key of every model's cases.
#![allow(missing_docs, clippy::unwrap_used)]

#[path = "../tests/case_keys/page.rs"]
mod page;

fn main() -> std::io::Result<()> {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/case-keys.md");
    std::fs::write(path, page::page())
}
