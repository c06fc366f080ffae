//! Writes docs/validation-rolling.md: the numbers of this crate beside those of their sources.
#![allow(missing_docs)]

#[path = "../tests/validation/page.rs"]
mod page;

fn main() -> std::io::Result<()> {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/validation-rolling.md");
    std::fs::write(path, page::page())
}
