//! Checks of input files.

use super::repeated;
use crate::finding::{Finding, Findings, Severity};
use crate::read::Read;
use crate::source::{SourceText, Span};
use crate::tree::{History, HistoryShape, InputFile, Segment};

/// Checks an input file alone.
pub fn input(read: &Read<InputFile>) -> Findings {
    let mut findings = Findings::new(&read.source);
    repeated(
        read.tree.histories.iter().map(|history| history.number),
        "history",
        &mut findings,
    );
    let mut end = read.tree.histories.first().map_or(0, |first| first.span.0.start);
    for history in &read.tree.histories {
        if findings.is_full() {
            break;
        }
        segments(history, &mut findings);
        for segment in &history.segments {
            comments(
                &read.source,
                Span {
                    start: end,
                    end: segment.span.0.start,
                },
                history,
                segment,
                &mut findings,
            );
            end = segment.span.0.end;
        }
    }
    findings
}

fn segments(history: &History, findings: &mut Findings) {
    if history.segments.is_empty() {
        let message = format!("history {} has no segments", history.number);
        findings.error(
            "segments",
            history.number.span,
            message,
            "a history has one segment at least; shape 0 is none",
        );
    }
    let mut before = 0.0;
    for (index, segment) in history.segments.iter().enumerate() {
        let what = format!("segment {} of history {}", segment.number, history.number);
        if *segment.number as usize != index + 1 {
            let message = format!("{what} stands in place {}", index + 1);
            findings.error(
                "order",
                segment.number.span,
                message,
                format!("segments are numbered in order: write {}", index + 1),
            );
        }
        if *segment.end <= before {
            let message = format!("{what} ends at {}, not after {before}", segment.end);
            findings.error(
                "order",
                segment.end.span,
                message,
                "each segment ends after the one before, the first after 0",
            );
        }
        before = *segment.end;
        shape(segment, &what, findings);
    }
}

fn shape(segment: &Segment, what: &str, findings: &mut Findings) {
    let [first, second] = segment.coefficients;
    match *segment.shape {
        HistoryShape::Sin | HistoryShape::Ssin => {
            for frequency in [first, second] {
                if *frequency < 0.0 {
                    let message = format!("a frequency of {what} is {frequency} Hz");
                    findings.error("range", frequency.span, message, "frequencies are not below 0");
                }
            }
            if *first == 0.0 && *second == 0.0 && *segment.amplitude != 0.0 {
                let message = format!("{what} is a sine without frequency");
                findings.warning("no-effect", first.span, message, "write its frequency in Hz");
            }
        }
        HistoryShape::Bend | HistoryShape::Cusp => {
            if *first <= 0.0 {
                let message = format!("the first coefficient of {what} is {first}");
                findings.error(
                    "range",
                    first.span,
                    message,
                    "it is the length of the rise and above 0",
                );
            }
        }
        HistoryShape::Null => {
            if *segment.amplitude != 0.0 {
                let message = format!(
                    "{what} has the shape NULL, so its amplitude of {} has no effect",
                    segment.amplitude
                );
                findings.warning(
                    "no-effect",
                    segment.amplitude.span,
                    message,
                    "choose a shape, or write 0.0",
                );
            }
        }
    }
}

/// A comment before the segment that names another shape.
fn comments(
    source: &SourceText,
    before: Span,
    history: &History,
    segment: &Segment,
    findings: &mut Findings,
) {
    let text = source.slice(before);
    let shape = *segment.shape;
    let moves = shape != HistoryShape::Null && *segment.amplitude != 0.0;
    for line in text.lines().filter(|line| line.trim_start().starts_with('!')) {
        let line = line.to_lowercase();
        let words = |word: &str| {
            line.split(|letter: char| !letter.is_alphanumeric())
                .any(|part| part == word)
        };
        let said = if words("null") && moves {
            "null"
        } else if words("sine") && matches!(shape, HistoryShape::Bend | HistoryShape::Cusp) {
            "sine"
        } else if words("bend") && matches!(shape, HistoryShape::Sin | HistoryShape::Ssin) {
            "bend"
        } else {
            continue;
        };
        let message = format!(
            "the comment before history {} says {said}, the shape is {} with amplitude {}",
            history.number,
            shape.name(),
            segment.amplitude
        );
        let dress = |finding: Finding| {
            finding
                .label("this counts")
                .help("correct the comment, or the shape")
        };
        findings.add(Severity::Warning, "comment", segment.shape.span, message, dress);
    }
}
