//! Writes docs/case-keys.md, every key of every model's cases, and their schemas docs/schema/MODEL.json.
#![allow(missing_docs, clippy::unwrap_used)]

use std::fs;
use std::path::Path;

use study::case::every_key::MODELS;

#[path = "../tests/case_keys/page.rs"]
mod page;

fn main() -> std::io::Result<()> {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    fs::write(docs.join("case-keys.md"), page::page())?;
    fs::create_dir_all(docs.join("schema"))?;
    for model in MODELS {
        fs::write(
            docs.join("schema").join(format!("{}.json", model.name)),
            page::schema(&model),
        )?;
    }
    Ok(())
}
