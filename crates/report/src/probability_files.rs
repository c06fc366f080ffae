//! The files of `wedgelab probability`: its summary, a table of all runs, a figure, and the result in words.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::Path;

use drawing::{Colour, Figure, Line, Mark, Panel, PlotCurve};
use quantity::SixDigits;
use staging::{FileError, Folder};
use study::car::limits::Bound;
use study::design::Value;
use study::probability::distribution::Distribution;
use study::probability::{
    Answer, Plan, ProbabilityRun, ProbabilitySummary, UncertainSummary, UncertainValues,
};

use crate::csv::{converted, rounded};
use crate::drawn::Drawn;
use crate::figures::{axis, digits};
use crate::output_table::{Cell, Content, OutputTable};
use crate::study_folder::value_column;

/// The summary.
pub const SUMMARY: &str = "probability.json";
/// All runs.
pub const TABLE: &str = "probability.csv";
/// The figure.
pub const FIGURE: &str = "probability.svg";
/// The same as a picture.
pub const PICTURE: &str = "probability.png";
/// The result in words.
pub const WORDS: &str = "probability.txt";
/// All of them.
pub const NAMES: [&str; 5] = [SUMMARY, TABLE, FIGURE, PICTURE, WORDS];

/// Writes all of them into a folder.
///
/// # Errors
/// They cannot be written.
pub fn write(
    plan: &Plan,
    summary: &ProbabilitySummary,
    runs: &[ProbabilityRun],
    path: &Path,
) -> Result<(), FileError> {
    let figure = Drawn::of(&figure(plan, summary, runs))?;
    let counted = summary.estimate.runs;
    Folder::check(path, &NAMES, true)?.write(|all| {
        all.add(SUMMARY, |out| write_summary(summary, out))?;
        all.add(TABLE, |out| write_table(plan, runs, counted, out))?;
        figure.add(all, FIGURE, PICTURE)?;
        all.add(WORDS, |out| out.write_all(words(plan, summary).as_bytes()))
    })
}

/// Writes the summary.
///
/// # Errors
/// The writer's.
pub fn write_summary(summary: &ProbabilitySummary, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, summary)?;
    out.write_all(b"\n")
}

/// Writes the table: one row a run, in the order in which they were asked for.
///
/// # Errors
/// The writer's.
pub fn write_table(
    plan: &Plan,
    runs: &[ProbabilityRun],
    counted: u64,
    out: &mut dyn Write,
) -> io::Result<()> {
    let mut table = OutputTable::<&ProbabilityRun>::new(runs, plan.units());
    let number = ["run", "", "number of the run, from 0"];
    table.column(number, Content::Integer, |run| {
        Cell::Integer(run.record.number as i64)
    });
    let part = ["part", "", "probability, or indices: of a sample of their own"];
    table.column(part, Content::Text, move |run| {
        match run.record.number < counted {
            true => "probability".into(),
            false => "indices".into(),
        }
    });
    for (place, own) in plan.uncertain.iter().enumerate() {
        let unit = own.unit();
        let content = unit.map_or(Content::Text, |_| Content::Number);
        let name = value_column(own.name(), unit.unwrap_or(""));
        table.column([&name, unit.unwrap_or(""), "uncertain"], content, move |run| {
            let value = own.at(run.point[place]);
            match unit {
                Some(unit) => value.in_unit(unit).map_or(Cell::Missing, Cell::Number),
                None => Cell::Text(with_direction(&value, own.name()).into()),
            }
        });
    }
    let about = [plan.limit.measure.as_str(), plan.limit.text.as_str()];
    table.quantity(about, plan.limit.kind, |run, factor| {
        Cell::Decimal(plan.measured(&run.record).unwrap_or(f64::NAN) * factor)
    });
    let side = ["limit", "", "within, beyond, or unknown"];
    table.column(side, Content::Text, |run| {
        match plan.limit.goal.is_beyond(plan.answer(&run.record)) {
            Some(true) => "beyond".into(),
            Some(false) => "within".into(),
            None => "unknown".into(),
        }
    });
    table.text("status", |run| run.record.status.name());
    table.text("reason", |run| &run.record.reason);
    table.write_csv(out)
}

/// Returns the figure: the share of runs beyond each value of the measure, with the limit; and what matters.
#[must_use]
pub fn figure(plan: &Plan, summary: &ProbabilitySummary, runs: &[ProbabilityRun]) -> Figure {
    let units = plan.units();
    let kind = plan.limit.kind;
    let shown = |si: f64| converted(si, kind, units);
    let estimate = &summary.estimate;
    let mut curves = Vec::new();
    if estimate.repeats.is_empty() {
        curves.push(PlotCurve::new(
            "runs",
            (Colour::Blue, Line::Solid),
            beyond_each(plan, runs, estimate.runs, &shown),
        ));
    }
    for repeat in &estimate.repeats {
        let levels = repeat.levels.iter();
        let points = levels.filter_map(|own| Some((shown(own.threshold?), libm::log10(own.probability))));
        curves.push(PlotCurve::new("repeats", (Colour::Sky, Line::Solid), points));
    }
    let limit = shown(plan.limit.goal.limit);
    let highest = libm::log10(estimate.bounds.high.max(f64::MIN_POSITIVE));
    let least = match estimate.is_upper_bound_only() {
        true => highest - 1.0,
        false => libm::log10(estimate.bounds.low),
    };
    let bottom = least.min(libm::log10(1.0 / estimate.runs as f64)).floor();
    let line = [(limit, bottom), (limit, 0.0)];
    curves.push(PlotCurve::new("limit", (Colour::Vermillion, Line::Dashed), line));
    let name = format!("{} % bounds", SixDigits(100.0 * estimate.confidence));
    let bounds = bracket(&curves, limit, [least, highest]);
    curves.push(PlotCurve::new(name, (Colour::Black, Line::Solid), bounds));
    let measure = axis(&summary.measure.replace('_', " "), kind, units);
    let y = "log10 of probability";
    let mut panels = vec![Panel::new(
        "(a) probability beyond each value",
        measure,
        y,
        curves,
    )];
    let known = summary
        .uncertain
        .iter()
        .filter_map(|own| Some((own, own.rank_correlation?)));
    let bars = known.clone().enumerate().map(|(place, (_, own))| {
        let y = place as f64;
        let bar = [(own.bounds.low, y), (own.bounds.high, y)];
        PlotCurve::new("", (Colour::Blue, Line::Bar), bar)
    });
    let marks = known.clone().enumerate().map(|(place, (_, own))| Mark {
        at: (own.value, place as f64),
        text: format!("{:.2}", own.value),
    });
    let names: Vec<String> = known.clone().map(|(own, _)| own.paths[0].clone()).collect();
    if !names.is_empty() {
        panels.push(Panel {
            y_names: names,
            marks: marks.collect(),
            x_window: Some((-1.0, 1.0)),
            ..Panel::new("(b) what matters", "rank correlation with the measure", "", bars)
        });
    }
    let caption = "Probability that the measure lies beyond a value, and the rank correlation of the measure \
                   with each uncertain parameter, with bounds.";
    Figure::new(heading(summary), caption, panels).in_columns(1)
}

/// Returns a vertical line with a cap at each end, as broad as fits the curves.
fn bracket(curves: &[PlotCurve], x: f64, ends: [f64; 2]) -> Vec<(f64, f64)> {
    let all = || curves.iter().flat_map(|curve| &curve.points).map(|point| point.0);
    let half = 0.01 * (all().fold(x, f64::max) - all().fold(x, f64::min));
    let cap = |y: f64| [(x - half, y), (x + half, y), (x, f64::NAN)];
    let line = [(x, ends[0]), (x, ends[1]), (x, f64::NAN)];
    [cap(ends[0]), line, cap(ends[1])].concat()
}

/// Returns the share of runs beyond each value, as a staircase over the values: measure, log10 of the share.
fn beyond_each(
    plan: &Plan,
    runs: &[ProbabilityRun],
    counted: u64,
    shown: &dyn Fn(f64) -> f64,
) -> Vec<(f64, f64)> {
    let runs = &runs[..counted as usize];
    let mut values: Vec<f64> = runs
        .iter()
        .filter_map(|run| match plan.answer(&run.record) {
            Answer::Value(value) => Some(value),
            Answer::Beyond | Answer::Unknown => None,
        })
        .collect();
    let sign = match plan.limit.goal.bound {
        Bound::AtMost => 1.0,
        Bound::AtLeast => -1.0,
    };
    values.sort_by(|a, b| (sign * a).total_cmp(&(sign * b)));
    let (all, known) = (runs.len(), values.len());
    let log = |beyond: usize| match beyond {
        0 => f64::NAN,
        _ => libm::log10(beyond as f64 / all as f64),
    };
    let step = |(place, value): (usize, &f64)| {
        // Derailments and unknown runs lie beyond all of them.
        let before = all - place;
        let missing = all - known;
        [
            (shown(*value), log(before)),
            (shown(*value), log(known - place - 1 + missing)),
        ]
    };
    values.iter().enumerate().flat_map(step).collect()
}

fn heading(summary: &ProbabilitySummary) -> String {
    match summary.title.is_empty() {
        true => summary.name.clone(),
        false => summary.title.clone(),
    }
}

/// Returns a probability in words: `0.021 (1 in 48)`.
fn share(value: f64) -> String {
    match value {
        value if value <= 0.0 => "0".to_owned(),
        value if value >= 0.2 => plain(value),
        value => format!("{} (1 in {})", plain(value), SixDigits(two_digits(1.0 / value))),
    }
}

/// Returns a number with two digits.
fn plain(value: f64) -> String {
    SixDigits(two_digits(value)).to_string()
}

fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

/// Returns the result in words.
#[must_use]
pub fn words(plan: &Plan, summary: &ProbabilitySummary) -> String {
    let mut text = String::new();
    let estimate = &summary.estimate;
    let percent = SixDigits(100.0 * estimate.confidence);
    let bounds = estimate.bounds;
    // Writing into a string does not fail.
    let _ = writeln!(
        text,
        "{}: probability that {} ({}) is {} {}\n",
        heading(summary),
        summary.measure,
        summary.measure_text,
        plan.beyond_in_words(),
        plan.limit.in_words(),
    );
    let found = estimate.probability;
    match estimate.is_upper_bound_only() {
        true if bounds.high >= 1.0 => {
            let _ = writeln!(text, "  not told: it may be anything from 0 to 1");
        }
        true => {
            let _ = writeln!(
                text,
                "  below {} with {percent} % confidence\n  {} runs can tell no probability less than {}; \
                 none is known to lie beyond the limit",
                share(bounds.high),
                estimate.runs,
                share(estimate.least_told),
            );
        }
        false => {
            let what = match found.low < found.high {
                true => format!("{} to {}", share(found.low), share(found.high)),
                false => share(found.high),
            };
            let _ = writeln!(
                text,
                "  {what}\n  {percent} % bounds: {} to {}, a factor of {}",
                share(bounds.low),
                share(bounds.high),
                SixDigits(two_digits(bounds.high / bounds.low)),
            );
        }
    }
    let _ = writeln!(
        text,
        "  {} runs: {} beyond the limit ({} derailed), {} of which it is not known{}",
        estimate.runs,
        estimate.beyond,
        estimate.derailed,
        estimate.unknown,
        match estimate.repeats.is_empty() {
            true => "",
            false => "; most were drawn towards the limit",
        }
    );
    let _ = writeln!(text, "\nUncertain");
    for own in &summary.uncertain {
        let _ = writeln!(text, "  {}", uncertain(own));
    }
    matters(&mut text, summary);
    for own in &summary.reasons {
        let _ = match own.runs {
            1 => writeln!(text, "\nrun {} has no value: {}", own.run, own.reason),
            many => writeln!(
                text,
                "\n{many} runs, the first is run {}, have no value: {}",
                own.run, own.reason
            ),
        };
    }
    for warning in &summary.warnings {
        let _ = writeln!(text, "\nwarning: {warning}");
    }
    let _ = writeln!(text, "\nAssumptions");
    for own in &summary.assumptions {
        let _ = writeln!(text, "  {own}");
    }
    text
}

/// Appends what matters.
fn matters(text: &mut String, summary: &ProbabilitySummary) {
    let mut known: Vec<_> = summary
        .uncertain
        .iter()
        .filter_map(|own| Some((&own.paths[0], own.rank_correlation?)))
        .collect();
    known.sort_by(|a, b| b.1.value.abs().total_cmp(&a.1.value.abs()));
    if !known.is_empty() {
        let _ = writeln!(
            text,
            "\nWhat matters (rank correlation with {}, -1 to 1)",
            summary.measure
        );
    }
    for (name, own) in known {
        let told = own.bounds.low > 0.0 || own.bounds.high < 0.0;
        let _ = writeln!(
            text,
            "  {name}: {:.2} ({:.2} to {:.2}){}",
            own.value,
            own.bounds.low,
            own.bounds.high,
            if told { "" } else { ", not told from none" }
        );
    }
    let Some(sobol) = &summary.sobol else { return };
    let _ = writeln!(
        text,
        "\nSobol' indices of {} (share of its variance: alone, and with others; {} further runs)",
        summary.measure, summary.index_runs
    );
    for (own, index) in summary.uncertain.iter().zip(&sobol.of) {
        let [first, total] = [index.first_bounds, index.total_bounds];
        let _ = writeln!(
            text,
            "  {}: {:.2} ({:.2} to {:.2}), {:.2} ({:.2} to {:.2})",
            own.paths[0], index.first, first.low, first.high, index.total, total.low, total.high
        );
    }
}

/// Returns an uncertain parameter in words.
fn uncertain(own: &UncertainSummary) -> String {
    let text = match own.text.as_str() {
        "" => String::new(),
        text => format!(": {text}"),
    };
    let values = match &own.values {
        UncertainValues::Discrete { values, weights } => {
            let all: f64 = weights.iter().sum();
            let each = values.iter().zip(weights);
            let each = each.map(|(value, weight)| {
                let value = with_direction(value, &own.paths[0]);
                format!("{value} ({} %)", digits(100.0 * weight / all))
            });
            each.collect::<Vec<_>>().join(", ")
        }
        UncertainValues::Numbers { of, unit } => numbers(of, unit),
    };
    format!("{} {values} [{}{text}]", own.paths.join(", "), own.mark)
}

/// Returns a value as a case file has it, without quotes: a toe with its direction.
fn with_direction(value: &Value, path: &str) -> String {
    value.to_toml(path).trim_matches('"').to_owned()
}

fn numbers(of: &Distribution, unit: &str) -> String {
    let number = |value: f64| {
        let text = SixDigits(rounded(value));
        match unit {
            "" => text.to_string(),
            unit => format!("{text} {unit}"),
        }
    };
    let [from, to] = of.ends().map(|end| end.is_finite().then(|| number(end)));
    let cut = match (&from, &to) {
        (Some(from), Some(to)) => format!(", cut off at {from} and {to}"),
        (Some(from), None) => format!(", cut off below {from}"),
        (None, Some(to)) => format!(", cut off above {to}"),
        (None, None) => String::new(),
    };
    let (from, to) = (from.unwrap_or_default(), to.unwrap_or_default());
    match *of {
        Distribution::Uniform { .. } => format!("uniform from {from} to {to}"),
        Distribution::Triangular { mode, .. } => {
            format!("triangular from {from} to {to}, likeliest {}", number(mode))
        }
        Distribution::Normal { mean, deviation, .. } => {
            format!(
                "normal, mean {}, standard deviation {}{cut}",
                number(mean),
                number(deviation)
            )
        }
        Distribution::Lognormal {
            median, factor, from, ..
        } => {
            let cut = if from > 0.0 || !to.is_empty() {
                cut
            } else {
                String::new()
            };
            format!(
                "lognormal, median {}, factor {}{cut}",
                number(median),
                SixDigits(factor)
            )
        }
    }
}
