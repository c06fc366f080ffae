//! Studies for the tests.

use std::path::Path;

use study::case::CaseError;
use study::design::Study;

/// A short run of the thesis.
pub const HEAD: &str = "case = \"cdrun_toe_out_0.2_psi_0.012\"\n";
pub const SHORT: &str = "[set]\nsimulation.duration = \"0.02 s\"\n";

pub fn parse(text: &str) -> Result<Study, CaseError> {
    Study::parse("some.toml", text, Path::new(""))
}

pub fn study(text: &str) -> Study {
    parse(text).unwrap_or_else(|error| panic!("{:#?}", error.problems()))
}
