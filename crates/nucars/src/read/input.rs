//! Reading `.INP` files.

use std::sync::Arc;

use super::fields::{Fields, Stop, Wrap, begins_numbered};
use super::{FileKind, Read, sections};
use crate::finding::{Finding, Findings, Severity};
use crate::number;
use crate::source::{At, SourceText, Spanned};
use crate::tree::{Argument, History, HistoryShape, InputFile, Segment};

pub const KEYWORDS: &[&str] = &["INPUT TITLE", "INPUT HISTORY DATA"];

/// Reads an input file.
pub fn read_input(source: &Arc<SourceText>) -> Read<InputFile> {
    let mut findings = Findings::new(source);
    let sections = sections::split(source);
    sections::look_for_hidden(source, &sections, FileKind::Input, &mut findings);
    let mut tree = InputFile {
        title: sections::title(&sections, "INPUT TITLE", source, &mut findings),
        histories: Vec::new(),
        other: sections::others(&sections, KEYWORDS, source, FileKind::Input, &mut findings),
        lost: true,
    };
    if let Some(section) = sections::required(&sections, "INPUT HISTORY DATA", FileKind::Input, &mut findings)
    {
        let fields = Fields::new(
            section.cursor(source),
            source.text(),
            Wrap::Counted,
            &mut findings,
        );
        (tree.histories, tree.lost) = histories(fields);
    }
    Read {
        tree,
        source: Arc::clone(source),
        findings: findings.sorted(),
    }
}

fn histories(mut fields: Fields<'_, '_>) -> (Vec<History>, bool) {
    fields.begin("histories", 0, 1);
    let Ok(count) = fields.key("number of histories") else {
        return (Vec::new(), true);
    };
    fields.end_of_record(Severity::Warning, "the rest of the line is not read");
    let mut list = Vec::new();
    let mut lost = false;
    let mut seen = 0;
    while seen < *count && begins_number(&fields) {
        seen += 1;
        match history(&mut fields, seen) {
            Ok(history) => list.push(history),
            Err(Stop) => {
                lost = true;
                // The next line of three values: a history's first.
                fields.recover(|cursor, text| {
                    cursor.tokens_in_line(4) == 3 && begins_numbered(&mut cursor.clone(), text, 3)
                });
            }
        }
    }
    if seen < *count {
        lost = true;
        let message = format!("the count is {}, but {seen} histories follow", *count);
        let dress = |finding: Finding| {
            finding
                .label("says how many")
                .help(format!("write {seen} if the list is complete"))
        };
        fields
            .findings
            .add(Severity::Error, "count", count.span, message, dress);
    } else if begins_number(&fields) {
        lost = true;
        let place = fields
            .cursor
            .peek()
            .map_or(fields.cursor.here(), |token| token.span);
        let line = fields.cursor_line(place.start);
        let message = format!(
            "the count is {}, but more records follow, which are not read",
            *count
        );
        let help = format!(
            "the first of them is in line {line}: correct the number of histories, or that of the last \
             one's segments"
        );
        fields.findings.error("count", count.span, message, help);
    }
    (list, lost)
}

fn begins_number(fields: &Fields<'_, '_>) -> bool {
    let token = fields.cursor.peek();
    token.is_some_and(|token| number::real(fields.text_of(token)).is_some())
}

const FEW_SEGMENTS: &str =
    "a history's line has three values, a segment's eight: correct the number of segments";

fn history(fields: &mut Fields<'_, '_>, index: u32) -> Result<History, Stop> {
    fields.begin("history", index, 3);
    let number = fields.key("number")?;
    fields.identify(*number);
    let count = fields.key("number of segments")?;
    let argument =
        fields.word(
            "argument",
            "1 (time) or 2 (distance)",
            Argument::Time,
            |text| match number::whole(text)? {
                1 => Some(Argument::Time),
                2 => Some(Argument::Distance),
                _ => None,
            },
        )?;
    let mut span = fields.span();
    if !fields.end_of_record(Severity::Error, FEW_SEGMENTS) {
        return Err(Stop);
    }
    let mut segments = Vec::new();
    for index in 1..=*count {
        if fields.cursor.tokens_in_line(4) == 3 {
            // A history's line where a segment's should be.
            let message = format!("history {number} has {count} segments, but segment {index} is missing");
            fields.findings.error("count", count.span, message, FEW_SEGMENTS);
            return Err(Stop);
        }
        let segment = segment(fields, index)?;
        span = span.to(segment.span.0);
        segments.push(segment);
    }
    Ok(History {
        number,
        argument,
        segments,
        span: At(span),
    })
}

fn segment(fields: &mut Fields<'_, '_>, index: u32) -> Result<Segment, Stop> {
    fields.begin("segment", index, 8);
    let number = fields.whole("number")?;
    let shape = fields.word(
        "shape",
        "a shape: 0 NULL, 1 CUSP, 2 BEND, 3 SIN, 4 SSIN",
        HistoryShape::Null,
        |text| HistoryShape::from_code(number::whole(text)?),
    )?;
    let end = fields.number("end (s or ft)")?;
    let base = [
        fields.number("base at the start")?,
        fields.number("base at the end")?,
    ];
    let coefficients: [Spanned<f64>; 2] = [
        fields.number("first coefficient")?,
        fields.number("second coefficient")?,
    ];
    let amplitude = fields.number("amplitude (in or rad)")?;
    let span = fields.span();
    fields.end_of_record(Severity::Error, "a segment has eight values");
    Ok(Segment {
        number,
        shape,
        end,
        base,
        coefficients,
        amplitude,
        span: At(span),
    })
}
