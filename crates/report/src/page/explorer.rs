//! The explorer's page, as `cargo xtask viewer` built it from the folder `viewer`: a script that asks the
//! server of `wedgelab explore` for everything else.

use maud::{DOCTYPE, html};

/// The program; empty if it was not there when this crate was built.
const SCRIPT: &str = include_str!(concat!(env!("OUT_DIR"), "/explorer.js"));
/// Its style, with the colours of all pages, light and dark.
const STYLE: &str = concat!(
    include_str!("colours.css"),
    include_str!(concat!(env!("OUT_DIR"), "/explorer.css"))
);

/// The message for people whose program was built without it.
pub const MISSING: &str = "This program was built without the explorer's page. To get it, install Node.js \
                           20.19 or later, run `cargo xtask viewer`, and build again. Everything else works \
                           without: `wedgelab run CASE --set PATH.KEY=VALUE` changes a case and runs it.";

/// The explorer's page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Explorer {
    /// `explorer.js`
    pub script: &'static str,
    /// `explorer.css`
    pub style: &'static str,
}

impl Explorer {
    /// Returns the page that this program holds, if it does.
    #[must_use]
    pub fn embedded() -> Option<Self> {
        (!SCRIPT.is_empty()).then_some(Self {
            script: SCRIPT,
            style: STYLE,
        })
    }

    /// Returns the page as HTML; it asks for `/explorer.js` and `/explorer.css`.
    #[must_use]
    pub fn page(self) -> String {
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    title { "Wedgelab explorer" }
                    link rel="icon" href="data:,";
                    link rel="stylesheet" href="/explorer.css";
                }
                body {
                    main id="explorer" { noscript { "The explorer needs JavaScript." } }
                    script src="/explorer.js" {}
                }
            }
        };
        page.into_string()
    }
}
