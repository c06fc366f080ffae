//! Writes docs/figures/truck_layout.svg: the nominal layout, and where the keys act.
#![allow(missing_docs, clippy::unwrap_used)]

#[path = "../tests/case_keys/layout.rs"]
mod layout;

fn main() -> std::io::Result<()> {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/figures/truck_layout.svg");
    std::fs::write(path, layout::picture())
}
