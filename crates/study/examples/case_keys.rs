//! Writes docs/case-keys.md, every key of every model's cases, their schemas docs/schema/MODEL.json, and the
//! sections of a wedge's case in Python.
#![allow(missing_docs, clippy::unwrap_used)]

use std::fs;
use std::path::Path;

use study::models::case_keys;

#[path = "../tests/case_keys/page.rs"]
mod page;
#[path = "../tests/case_keys/python.rs"]
mod python;

fn main() -> std::io::Result<()> {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    fs::write(docs.join("case-keys.md"), page::page())?;
    let python = docs.join("../crates/wedgelab-py/python/wedgelab/sections.py");
    fs::write(python, python::sections())?;
    fs::create_dir_all(docs.join("schema"))?;
    for (model, keys) in case_keys() {
        fs::write(
            docs.join("schema").join(format!("{model}.json")),
            page::schema(model, keys),
        )?;
    }
    Ok(())
}
