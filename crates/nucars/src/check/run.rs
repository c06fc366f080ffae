//! Checks of run files.

use crate::finding::Findings;
use crate::read::Read;
use crate::tree::{Argument, InputFile, RunFile};

/// Checks a run file's numbers.
pub fn run(read: &Read<RunFile>) -> Findings {
    let mut findings = Findings::new(&read.source);
    let Some(stepping) = &read.tree.stepping else {
        return findings;
    };
    for (value, what) in [
        (stepping.step, "step"),
        (stepping.end, "end of the run"),
        (stepping.output, "interval of results"),
    ] {
        if *value <= 0.0 {
            findings.error(
                "range",
                value.span,
                format!("the {what} is {value} s"),
                "it must be above 0",
            );
        }
    }
    if *stepping.output > *stepping.end && *stepping.end > 0.0 {
        let message = format!(
            "results come every {} s, but the run ends at {} s",
            stepping.output, stepping.end
        );
        findings.warning(
            "range",
            stepping.output.span,
            message,
            "the order is: step, end, interval of results",
        );
    }
    if *stepping.step > *stepping.output && *stepping.output > 0.0 {
        let message = format!(
            "the step, {} s, is longer than the interval of results, {} s",
            stepping.step, stepping.output
        );
        findings.warning(
            "range",
            stepping.step.span,
            message,
            "the order is: step, end, interval of results",
        );
    }
    findings
}

/// Checks a run file with its input file: whether the histories last, and whether they can be followed without a speed.
pub fn run_with_input(read: &Read<RunFile>, input: &InputFile) -> Findings {
    let mut findings = Findings::new(&read.source);
    let Some(stepping) = &read.tree.stepping else {
        return findings;
    };
    for history in &input.histories {
        if findings.is_full() {
            break;
        }
        let Some(last) = history.segments.last() else {
            continue;
        };
        match *history.argument {
            Argument::Time if *last.end < *stepping.end => findings.warning(
                "history-ends",
                stepping.end.span,
                format!(
                    "history {} ends at {} s, before the run does",
                    history.number, last.end
                ),
                "what comes after the last segment is not defined: lengthen it, or end the run earlier",
            ),
            Argument::Time => {}
            Argument::Distance => findings.warning(
                "distance",
                stepping.end.span,
                format!(
                    "history {} is a function of distance, and the run has no speed",
                    history.number
                ),
                "make it a function of time: 1 as the third number of the history",
            ),
        }
    }
    findings
}
