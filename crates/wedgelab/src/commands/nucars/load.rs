//! Messages about findings in files.

use miette::Report;
use nucars::{Finding, Findings};

use crate::failure::say;

/// Shows findings on the standard error.
pub fn print_findings<'a>(findings: &'a Findings, which: impl Fn(&&'a Finding) -> bool) {
    for finding in findings.list().iter().filter(which) {
        say(&format!("{:?}", Report::new(finding.clone())));
    }
    let [notes, warnings, errors] = findings.not_kept();
    let more = [(errors, "errors"), (warnings, "warnings"), (notes, "notes")];
    let more: Vec<String> = more
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, name)| format!("{count} more {name}"))
        .collect();
    if !more.is_empty() {
        say(&format!("... and {}", more.join(", ")));
    }
}
