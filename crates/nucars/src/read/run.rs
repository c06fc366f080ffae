//! Reading `.RUN` files.

use std::sync::Arc;

use super::fields::{Fields, Stop, Wrap};
use super::sections::{self, FileSection};
use super::{FileKind, Read};
use crate::finding::{Findings, Severity};
use crate::source::{SourceText, Spanned};
use crate::tree::{Control, RunFile, Stepping};

pub const KEYWORDS: &[&str] = &[
    "RUN TITLE",
    "SYSTEM FILE",
    "DATA FILE",
    "INPUT FILE",
    "CONTROL CONSTANTS",
    "STEPPING CONSTANTS",
    "REVERSE VIDEO",
];

/// Reads a run file.
pub fn read_run(source: &Arc<SourceText>) -> Read<RunFile> {
    let mut findings = Findings::new(source);
    let sections = sections::split(source);
    sections::look_for_hidden(source, &sections, FileKind::Run, &mut findings);
    let title = sections::title(&sections, "RUN TITLE", source, &mut findings);
    let other = sections::others(&sections, KEYWORDS, source, FileKind::Run, &mut findings);
    let mut of = |keyword: &'static str| -> Option<Spanned<String>> {
        let section = sections::required(&sections, keyword, FileKind::Run, &mut findings)?;
        values(section, source, keyword, &mut findings, |fields| {
            fields.quoted("file name")
        })
    };
    let system = of("SYSTEM FILE");
    let data = of("DATA FILE");
    let input = of("INPUT FILE");
    let control = sections::only(&sections, "CONTROL CONSTANTS", &mut findings);
    let control = control.and_then(|section| {
        values(section, source, "CONTROL CONSTANTS", &mut findings, |fields| {
            Ok(Control {
                analysis: fields.whole("first number")?,
                option: fields.whole("second number")?,
                flag: fields.logical("truth value")?,
            })
        })
    });
    let stepping = sections::required(&sections, "STEPPING CONSTANTS", FileKind::Run, &mut findings);
    let stepping = stepping.and_then(|section| {
        values(section, source, "STEPPING CONSTANTS", &mut findings, |fields| {
            Ok(Stepping {
                step: fields.number("step (s)")?,
                end: fields.number("end (s)")?,
                output: fields.number("interval of results (s)")?,
            })
        })
    });
    Read {
        tree: RunFile {
            title,
            system,
            data,
            input,
            control,
            stepping,
            other,
        },
        source: Arc::clone(source),
        findings: findings.sorted(),
    }
}

fn values<T>(
    section: &FileSection,
    source: &SourceText,
    keyword: &'static str,
    findings: &mut Findings,
    read: impl Fn(&mut Fields<'_, '_>) -> Result<T, Stop>,
) -> Option<T> {
    let mut fields = Fields::new(
        section.cursor(source),
        source.text(),
        Wrap::NamedRecords,
        findings,
    );
    fields.begin(keyword, 0, 1);
    let value = read(&mut fields).ok()?;
    if fields.is_bad() {
        return None;
    }
    fields.end_of_record(Severity::Warning, "the rest of the line is not read");
    Some(value)
}
