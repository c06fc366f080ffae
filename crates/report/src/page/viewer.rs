//! The page's interactive part, as `cargo xtask viewer` built it from the folder `viewer`.

/// The program; empty if it was not there when this crate was built.
const SCRIPT: &str = include_str!(concat!(env!("OUT_DIR"), "/viewer.js"));
/// Its style; empty if it was not there when this crate was built.
const STYLE: &str = include_str!(concat!(env!("OUT_DIR"), "/viewer.css"));

/// The message for people whose program was built without it.
pub const MISSING: &str = "The page is static: this program was built without its interactive part (plots \
                           that zoom, the 3D view). To get it, install Node.js 20.19 or later, run `cargo \
                           xtask viewer`, and build again.";

/// The interactive part of pages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Viewer {
    /// A script to be put at the end of the page; it reads the element `wedgelab-view`.
    pub script: &'static str,
    /// Its style sheet.
    pub style: &'static str,
}

impl Viewer {
    /// Returns the interactive part that this program holds, if it does.
    #[must_use]
    pub fn embedded() -> Option<Self> {
        (!SCRIPT.is_empty()).then_some(Self {
            script: SCRIPT,
            style: STYLE,
        })
    }
}
