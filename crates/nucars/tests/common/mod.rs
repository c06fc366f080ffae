//! Reading and checking a text, and looking for what was found.

#![allow(dead_code, clippy::unwrap_used)]

use nucars::read::{Read, read_data, read_input, read_run, read_system};
use nucars::source::SourceText;
use nucars::tree::SystemFile;
use nucars::{Finding, Findings, Severity, builtin, check};

pub const CONSTANT: &str = "Bolst_wedge_sf_68_constant.sys";
pub const VARIABLE: &str = "Bolst_wedge_sf_68_variable.sys";
pub const CONSTANT_3D: &str = "bolst_wedge_sf_69_const.sys";
pub const VARIABLE_3D: &str = "bolst_wedge_sf_69_var.sys";
pub const VERTICAL: &str = "bolst_displ_input3.inp";
pub const YAW: &str = "bolst_displ_input36.inp";

pub fn text(name: &str) -> &'static str {
    builtin::text(name).unwrap()
}

/// Returns all findings of a system file's text.
pub fn system(text: &str) -> Read<SystemFile> {
    let read = read_system(&SourceText::from_text("a.sys", text).unwrap());
    let more = check::system(&read);
    read.with(more)
}

pub fn input(text: &str) -> Findings {
    let read = read_input(&SourceText::from_text("a.inp", text).unwrap());
    let more = check::input(&read);
    read.with(more).findings
}

pub fn data(text: &str, system_name: &str) -> Findings {
    let read = read_data(&SourceText::from_text("a.dat", text).unwrap());
    let alone = check::data(&read);
    let more = check::data_of_system(&read, &system(self::text(system_name)).tree);
    read.with(alone).with(more).findings
}

pub fn run(text: &str) -> Findings {
    let read = read_run(&SourceText::from_text("a.run", text).unwrap());
    let more = check::run(&read);
    read.with(more).findings
}

pub fn list(findings: &Findings) -> String {
    let line = |finding: &Finding| {
        let (line, column) = finding.place().line_and_column();
        format!(
            "{line}:{column}: {} [{}] {finding} | {:?} | {}\n",
            finding.severity(),
            finding.code_name(),
            finding.place().text(),
            finding.advice().unwrap_or("")
        )
    };
    findings.list().iter().map(line).collect()
}

/// Returns the codes of findings of this severity, in order and each once.
pub fn codes(findings: &Findings, severity: Severity) -> Vec<&'static str> {
    let own = findings
        .list()
        .iter()
        .filter(|finding| finding.severity() == severity);
    let mut codes: Vec<_> = own.map(Finding::code_name).collect();
    codes.sort_unstable();
    codes.dedup();
    codes
}

/// Returns whether one finding has this severity, this line of the text, and all these words.
pub fn has(findings: &Findings, severity: Severity, line: usize, words: &[&str]) -> bool {
    findings.list().iter().any(|finding| {
        let all = format!("{finding} {}", finding.advice().unwrap_or(""));
        finding.severity() == severity
            && (line == 0 || finding.place().line_and_column().0 == line)
            && words.iter().all(|word| all.contains(word))
    })
}
