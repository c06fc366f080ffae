//! Reading `[output]` of what runs on a track: what statistics are taken, and how.

use quantity::{Kind, Quantity};

use super::statistics::Rules;
use crate::case::field::{Reach, Written, quoted};
use crate::case::problem::{Problem, Problems};
use crate::case::section::{CaseSection, Range, quantity};
use crate::case::tree::NodeValue;
use crate::reader::schema::Form;
use crate::reader::{CaseReader, QuantityForm};

/// Reads `[output]`.
pub(crate) fn output(r: &mut CaseReader<'_>, rules: &mut Rules) {
    r.section(
        "output",
        "What statistics are taken, and how, and what is written. All values of statistics are remembered: \
         check them against your edition of the rules.",
    );
    let time: QuantityForm = (Kind::Time, Range::Positive, Reach::Positive);
    let distance: QuantityForm = (Kind::Distance, Range::Positive, Reach::Positive);
    let comment = "low-pass filter of wheel forces: fourth order, no phase, -3 dB there";
    frequency(r, "wheel_filter", &mut rules.wheel_filter, comment);
    let comment = "wheel L/V, axle sums and wheel loads that last so long";
    r.quantity("hold_time", time, &mut rules.hold_time, comment);
    r.quantity(
        "hold_distance",
        distance,
        &mut rules.hold_distance,
        "wheel L/V over this distance",
    );
    r.quantity(
        "side_distance",
        distance,
        &mut rules.side_distance,
        "L/V of a truck's side over this distance",
    );
    let comment = "share of wheel L/V and axle sums in curves that lies below the value reported";
    let range = Range::Between(0.0, 1.0, "between 0 and 1");
    r.number(
        "percentile",
        range,
        Reach::Between(0.5, 0.999),
        &mut rules.percentile,
        comment,
    );
    frequency(
        r,
        "acceleration_filter",
        &mut rules.acceleration_filter,
        "low-pass filter of accelerations",
    );
    let comment = "largest standard deviation of accelerations over this distance";
    r.quantity(
        "deviation_distance",
        distance,
        &mut rules.deviation_distance,
        comment,
    );
    r.quantity(
        "rms_time",
        time,
        &mut rules.rms_time,
        "largest rms of accelerations over this time",
    );
    let comment = "accelerations: greatest less least level that lasts for the hold time, within this time";
    r.quantity("range_time", time, &mut rules.range_time, comment);
    let comment = "largest rms of accelerations about a straight line over this time";
    r.quantity("rmst_time", time, &mut rules.rmst_time, comment);
    let comment = "band-pass filter of the accelerations of trucks, -3 dB at both ends";
    band(r, "truck_band", &mut rules.truck_band, comment);
    let comment = "largest rms of the accelerations of trucks over this time, about zero and a straight line";
    r.quantity("truck_rms_time", time, &mut rules.truck_rms_time, comment);
    // Standards of Europe state these in meters.
    let mut metric = |key, value: &mut f64, comment: &str| {
        let usual = Quantity::parse_as(&format!("{value} m"), Kind::Distance).ok();
        r.quantity_or(key, distance, usual, value, comment);
    };
    let comment = "sections of the run, of whose values mean and deviation count";
    metric("section_length", &mut rules.section_length, comment);
    let comment = "sliding means of L/V and of axles' lateral forces";
    metric("mean_distance", &mut rules.mean_distance, comment);
    let factor = (Range::NotNegative, Reach::FromZero(6.0));
    let comment = "deviations of sections beyond their mean, of L/V and axles' lateral forces";
    let value = &mut rules.section_factor_safety;
    r.number("section_factor_safety", factor.0, factor.1, value, comment);
    let comment = "the same of vertical forces and of the body's accelerations";
    r.number(
        "section_factor",
        factor.0,
        factor.1,
        &mut rules.section_factor,
        comment,
    );
    r.truth(
        "filtered_columns",
        &mut rules.filtered_columns,
        "whether results have filtered columns beside the raw ones",
    );
}

/// A cutoff in Hz; frequencies are angular inside.
fn frequency(r: &mut CaseReader<'_>, key: &'static str, hertz: &mut f64, comment: &str) {
    let form: QuantityForm = (Kind::Frequency, Range::Positive, Reach::Positive);
    let default = format!("{hertz} Hz");
    let read = |section: &CaseSection<'_>, problems: &mut Problems| {
        let (kind, range, _) = form;
        section.quantity(key, kind, range, problems)
    };
    let Ok(usual) = Quantity::parse_as(&default, Kind::Frequency) else {
        return;
    };
    let own = r.other(key, Form::Quantity(form.0), comment, usual, read, |own| {
        Written::quantity(own, form.0, form.2)
    });
    *hertz = in_hertz(&own);
}

fn in_hertz(own: &Quantity) -> f64 {
    // Angular and back again leaves a last digit.
    (own.to_si() / (2.0 * std::f64::consts::PI) * 1e9).round() / 1e9
}

/// A band of frequencies in Hz, the lower end first.
fn band(r: &mut CaseReader<'_>, key: &'static str, hertz: &mut [f64; 2], comment: &str) {
    let usual = hertz.map(|own| Quantity::parse_as(&format!("{own} Hz"), Kind::Frequency).ok());
    let [Some(low), Some(high)] = usual else { return };
    let read = |section: &CaseSection<'_>, problems: &mut Problems| {
        let path = section.path_of(key);
        let help = format!("write for example {key} = [\"0.5 Hz\", \"10 Hz\"]");
        let node = section.require(key, &help, problems)?;
        let wrong = |what: &str| {
            let problem = Problem::new(format!("`{path}` {what}")).at(&node.place);
            problem.label("two frequencies, the lower one first").help(&help)
        };
        let NodeValue::List(items) = &node.value else {
            problems.push(wrong("is no list"));
            return None;
        };
        let [low, high] = items.as_slice() else {
            problems.push(wrong(&format!("has {} entries; two are expected", items.len())));
            return None;
        };
        let mut of = |at: usize, node| {
            quantity(
                node,
                &format!("{path}[{at}]"),
                Kind::Frequency,
                Range::Positive,
                problems,
            )
        };
        let (low, high) = (of(0, low), of(1, high));
        let ends = [low?, high?];
        if ends[0].to_si() >= ends[1].to_si() {
            problems.push(wrong("is no band"));
            return None;
        }
        Some(ends)
    };
    let write = |ends: &[Quantity; 2]| {
        let [low, high] = ends.each_ref().map(|own| quoted(own.text()));
        Written::toml(format!("[{low}, {high}]"))
    };
    let own = r.other(
        key,
        Form::Pair(Kind::Frequency),
        comment,
        [low, high],
        read,
        write,
    );
    *hertz = own.each_ref().map(in_hertz);
}
