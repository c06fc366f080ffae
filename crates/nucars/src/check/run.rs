//! Checks of run files.

use crate::files::NotFound;
use crate::finding::{Finding, Findings, Severity};
use crate::read::{FileKind, Read};
use crate::source::Spanned;
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

/// Checks a run file with its input file: whether the histories last, and whether they can be followed
/// without a speed.
pub fn run_with_input(read: &Read<RunFile>, input: &InputFile) -> Findings {
    let mut findings = Findings::new(&read.source);
    let Some(stepping) = &read.tree.stepping else {
        return findings;
    };
    for history in &input.histories {
        if findings.is_full_of(Severity::Warning) {
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

impl RunFile {
    /// Returns the name it gives to its file of this kind.
    pub fn names(&self, kind: FileKind) -> Option<&Spanned<String>> {
        match kind {
            FileKind::System => self.system.as_ref(),
            FileKind::Data => self.data.as_ref(),
            FileKind::Input => self.input.as_ref(),
            FileKind::Run => None,
        }
    }
}

/// Returns the mistake of a run that names a file which is not there; `option` names it instead.
pub fn run_without_file(read: &Read<RunFile>, kind: FileKind, missing: &NotFound, option: &str) -> Findings {
    let mut findings = Findings::new(&read.source);
    if let Some(name) = read.tree.names(kind) {
        let mut help = match (&missing.nearest, missing.alike.as_slice()) {
            (Some(near), []) => format!("did you mean '{near}'? "),
            (Some(near), alike) if alike.len() <= 5 => {
                format!("did you mean '{near}'? There are also {}. ", alike.join(", "))
            }
            (Some(near), _) => format!("did you mean '{near}'? "),
            (None, _) => String::new(),
        };
        help += &format!("{option} takes another file without changing the run");
        let dress = |finding: Finding| finding.label("not found").help(help);
        let message = format!("the {kind} is missing: {missing}");
        findings.add(Severity::Error, "missing-file", name.span, message, dress);
    }
    findings
}
