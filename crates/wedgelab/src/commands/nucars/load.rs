//! Saying what was found in files.

use miette::Report;
use nucars::{Finding, Findings};

use crate::failure::say;

/// Shows findings on the standard error.
pub fn tell<'a>(findings: &'a Findings, which: impl Fn(&&'a Finding) -> bool) {
    for finding in findings.list().iter().filter(which) {
        say(&format!("{:?}", Report::new(finding.clone())));
    }
    if findings.not_kept() > 0 {
        say(&format!("... and {} more", findings.not_kept()));
    }
}
