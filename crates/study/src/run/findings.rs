//! What is implausible in a run, in words.

use mechanics::plausibility::{FindingKind, PlausibilityFinding};

use super::{Recorder, Run, RunCase};

/// Returns the warnings about what is implausible in a run.
#[must_use]
pub fn warnings<C: RunCase>(run: &Run<C>) -> Vec<String> {
    let units = run.case.units();
    let findings = findings(run);
    let words = |finding: &PlausibilityFinding| run.recorder.describe(&run.system, finding, units);
    findings.iter().map(words).collect()
}

/// Returns the same, of each kind the first only, with the number of places that have it: a model of many
/// parts says everything many times.
#[must_use]
pub fn warnings_by_kind<C: RunCase>(run: &Run<C>) -> Vec<String> {
    by_kind(run, |_| true)
}

/// Returns the same of what runs along a track: that it leaves its place is none.
#[must_use]
pub fn warnings_of_rolling<C: RunCase>(run: &Run<C>) -> Vec<String> {
    by_kind(run, |kind| !matches!(kind, FindingKind::Displacement))
}

fn by_kind<C: RunCase>(run: &Run<C>, counts: impl Fn(FindingKind) -> bool) -> Vec<String> {
    let units = run.case.units();
    let mut findings = findings(run);
    findings.retain(|finding| counts(finding.kind));
    let kind = |finding: &PlausibilityFinding| std::mem::discriminant(&finding.kind);
    let mut warnings = Vec::new();
    for (number, finding) in findings.iter().enumerate() {
        if findings[..number]
            .iter()
            .any(|other| kind(other) == kind(finding))
        {
            continue;
        }
        let words = run.recorder.describe(&run.system, finding, units);
        warnings.push(
            match findings
                .iter()
                .filter(|other| kind(other) == kind(finding))
                .count()
            {
                1 => words,
                count => format!("{words} (and the same at {} more places)", count - 1),
            },
        );
    }
    warnings
}

/// Returns the reason why a run is nonsense: the first finding after which results mean nothing. Returns
/// `None` if there is none.
#[must_use]
pub fn nonsense<C: RunCase>(run: &Run<C>) -> Option<String> {
    nonsense_among(run, |_| true)
}

/// Returns the same of a truck's run. That corners are pressed in is none: it is how a nest locks in warp,
/// and the contact stiffness then sets the moment.
#[must_use]
pub fn nonsense_in_truck<C: RunCase>(run: &Run<C>) -> Option<String> {
    nonsense_among(run, |kind| !matches!(kind, FindingKind::Penetration))
}

/// Returns the same of a car's run, which leaves the place where it started.
#[must_use]
pub fn nonsense_in_car<C: RunCase>(run: &Run<C>) -> Option<String> {
    nonsense_among(run, |kind| {
        !matches!(kind, FindingKind::Penetration | FindingKind::Displacement)
    })
}

fn nonsense_among<C: RunCase>(run: &Run<C>, counts: impl Fn(FindingKind) -> bool) -> Option<String> {
    let findings = findings(run);
    let found = findings
        .iter()
        .filter(|finding| finding.kind.is_nonsense() && counts(finding.kind));
    let first = found.min_by(|a, b| a.since.unwrap_or(0.0).total_cmp(&b.since.unwrap_or(0.0)))?;
    Some(run.recorder.describe(&run.system, first, run.case.units()))
}

fn findings<C: RunCase>(run: &Run<C>) -> Vec<PlausibilityFinding> {
    let [_, interval] = run.case.duration_and_interval();
    run.plausibility
        .findings(&run.system, &run.energy_balance, interval)
}
