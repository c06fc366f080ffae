//! Statistics of sections against closed forms, and their files.

use std::f64::consts::{PI, SQRT_2};
use std::path::Path;

use proptest::prelude::*;
use quantity::{Kind, System as Units};
use study::sections::{
    Acceptance, Along, CutError, Differences, MEAN_SHARE, SectionQuantity, SectionRequest, SectionVerdict,
    section_values,
};

const FOOT: f64 = 0.3048;

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} {expected}");
}

/// A ramp from a to b over the section: mean (a + b)/2, rms |b - a|/√12, 99.85 % at 0.9985 of the way. Rows
/// are not evenly apart, and neither end of the section is one.
#[test]
fn analytic_a_ramp_has_its_mean_rms_and_percentile_in_each_section() {
    let places = [0.0, 0.7, 0.9, 2.0, 5.0, 5.1, 9.0];
    let values = places.map(|x| 3.0 - 2.0 * x);
    for [from, to] in [[0.3, 1.3], [1.3, 8.0], [0.0, 9.0], [0.7, 0.9]] {
        let [mean, most, rms] = section_values(&places, &values, false, [from, to]).unwrap();
        let [a, b] = [from, to].map(|x| 3.0 - 2.0 * x);
        near(mean, 0.5 * (a + b), 1e-14);
        near(rms, (b - a).abs() / 12.0_f64.sqrt(), 1e-13);
        let ends = [0.0015, 0.9985].map(|share| (a + share * (b - a)).abs());
        near(most, ends[0].max(ends[1]), 1e-13);
    }
}

/// A sine of whole periods: mean zero, rms A/√2, and |x| ≤ A cos(0.0015 π) but for 0.15 % on each side.
#[test]
fn convergence_a_sine_has_its_rms_and_percentile() {
    let at = |count: usize| {
        let places: Vec<f64> = (0..=count).map(|row| row as f64 / count as f64).collect();
        let values: Vec<f64> = places.iter().map(|x| 5.0 * (2.0 * PI * 4.0 * x).sin()).collect();
        let [mean, most, rms] = section_values(&places, &values, false, [0.0, 1.0]).unwrap();
        near(mean, 0.0, 1e-14);
        [most - 5.0 * (0.0015 * PI).cos(), rms - 5.0 / SQRT_2].map(f64::abs)
    };
    let (coarse, fine) = (at(4000), at(8000));
    // Chords are second order.
    assert!(
        coarse[1] < 1e-4 && fine[1] < 0.26 * coarse[1],
        "{coarse:?} {fine:?}"
    );
    assert!(fine[0] < 2e-5, "{fine:?}");
}

/// A step of a held signal, 1 over a quarter of the section: mean 1/4, rms √(3/16), maximum 1; 1 over 0.1 %
/// of it is below the 99.85 % percentile. A signal that is not held rises between the rows.
#[test]
fn analytic_a_step_counts_by_its_length() {
    let places = [0.0, 3.0, 4.0, 5.0];
    let values = [0.0, 1.0, 0.0, 0.0];
    let [mean, most, rms] = section_values(&places, &values, true, [0.0, 4.0]).unwrap();
    near(mean, 0.25, 1e-15);
    near(rms, (3.0_f64 / 16.0).sqrt(), 1e-15);
    assert_eq!(most, 1.0);
    let [_, most, _] = section_values(&[0.0, 0.999, 1.0], &[0.0, 1.0, 1.0], true, [0.0, 1.0]).unwrap();
    near(most, 0.0, 1e-15);
    // A triangle of height 1 on a base of 4 and then nothing.
    let [mean, ..] = section_values(&places, &values, false, [0.0, 5.0]).unwrap();
    near(mean, 2.0 / 5.0, 1e-15);
    // Rows at one place, as an odometer with coarse steps gives them, are a step.
    let [mean, ..] = section_values(&[0.0, 1.0, 1.0, 2.0], &[0.0, 0.0, 4.0, 4.0], false, [0.0, 2.0]).unwrap();
    near(mean, 2.0, 1e-15);
}

#[test]
fn limits_a_section_beyond_the_rows_has_no_values() {
    let (places, values) = ([1.0, 2.0], [5.0, 5.0]);
    for section in [[0.9, 1.5], [1.5, 2.1], [1.5, 1.5], [f64::NAN, 2.0]] {
        assert_eq!(
            section_values(&places, &values, false, section),
            None,
            "{section:?}"
        );
    }
    assert_eq!(section_values(&[], &[], false, [0.0, 1.0]), None);
    assert_eq!(section_values(&[1.0], &[1.0], false, [1.0, 2.0]), None);
    assert_eq!(
        section_values(&places, &values, false, [1.0, 2.0]),
        Some([5.0, 5.0, 0.0])
    );
}

proptest! {
    /// Values lie where they must, and do not depend on rows that split a straight line.
    #[test]
    fn limits_section_values_are_bounded_and_keep_when_rows_are_added(
        values in prop::collection::vec(-1e3..1e3_f64, 3..60),
        cut in 0.0..1.0_f64,
    ) {
        let last = values.len() - 1;
        let places: Vec<f64> = (0..=last).map(|row| row as f64).collect();
        let section = [0.3 * cut, last as f64 - 0.4];
        let own = section_values(&places, &values, false, section).unwrap();
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        prop_assert!(own[0] >= least - 1e-9 && own[0] <= most + 1e-9);
        prop_assert!(own[1] <= least.abs().max(most.abs()) && own[2] <= 0.5 * (most - least) + 1e-9);
        let finer: Vec<f64> = (0..=2 * last).map(|row| 0.5 * row as f64).collect();
        let between = |row: usize| match row % 2 {
            0 => values[row / 2],
            _ => 0.5 * (values[row / 2] + values[row / 2 + 1]),
        };
        let split: Vec<f64> = (0..=2 * last).map(between).collect();
        let again = section_values(&finer, &split, false, section).unwrap();
        for (a, b) in own.iter().zip(again) {
            prop_assert!((a - b).abs() < 1e-8, "{} {}", a, b);
        }
    }
}

/// A constant offset is the mean of the differences and leaves no deviation; offsets ±d by turns have none in
/// the mean and d √(n/(n - 1)) as deviation.
#[test]
fn analytic_offsets_are_the_mean_and_the_deviation() {
    let measured: Vec<f64> = (0..14).map(|k| 100.0 + 3.0 * f64::from(k)).collect();
    let pairs = |offset: &dyn Fn(usize) -> f64| -> Vec<[f64; 2]> {
        let pairs = measured.iter().enumerate();
        pairs.map(|(k, own)| [*own, own + offset(k)]).collect()
    };
    let constant = Differences::of(&pairs(&|_| 2.0)).unwrap();
    assert_eq!(
        (constant.sections, constant.mean, constant.deviation),
        (14, 2.0, 0.0)
    );
    near(constant.measured, 119.5, 1e-12);
    near(constant.percent().unwrap()[0], 100.0 * 2.0 / 119.5, 1e-12);
    let turns = Differences::of(&pairs(&|k| if k.is_multiple_of(2) { 5.0 } else { -5.0 })).unwrap();
    near(turns.mean, 0.0, 1e-13);
    near(turns.deviation, 5.0 * (14.0_f64 / 13.0).sqrt(), 1e-13);
    assert_eq!(Differences::of(&pairs(&|_| 0.0)[..1]), None);
    // Percentages of nothing are none.
    assert_eq!(
        Differences::of(&[[0.0, 1.0], [0.0, 1.0]]).unwrap().percent(),
        None
    );
}

/// Exactly at a limit is within it.
#[test]
fn limits_verdicts_are_by_two_thirds_and_the_whole_limit() {
    let of = |mean: f64, deviation: f64| {
        let own = Differences {
            sections: 12,
            mean,
            deviation,
            measured: 10.0,
        };
        SectionVerdict::of(&own, 3.0).words()
    };
    assert_eq!(of(-3.0 * MEAN_SHARE, 3.0), "accepted");
    assert_eq!(of(-2.001, 3.0), "mean too large");
    assert_eq!(of(2.0, 3.001), "deviation too large");
    assert_eq!(of(2.001, 3.001), "mean and deviation too large");
}

#[test]
fn sections_are_cut_by_number_length_and_file() {
    let parse = |text: &str| SectionRequest::parse(text).unwrap();
    let cut = parse("4").cut(Along::Time, [1.0, 3.0], Units::Si).unwrap();
    assert_eq!(cut.sections, [[1.0, 1.5], [1.5, 2.0], [2.0, 2.5], [2.5, 3.0]]);
    let hundred = parse("100 ft");
    assert_eq!(hundred.along(), Some(Along::Distance));
    let cut = hundred
        .cut(Along::Distance, [0.0, 350.0 * FOOT], Units::Us)
        .unwrap();
    assert_eq!(cut.sections.len(), 3);
    near(cut.rest, 50.0 * FOOT, 1e-9);
    // Three tenths and seven tenths are a whole but for rounding.
    let cut = parse("0.1 s").cut(Along::Time, [0.3, 1.0], Units::Us).unwrap();
    assert_eq!((cut.sections.len(), cut.sections[6][1]), (7, 1.0));
    let text = "# ours\nfrom [ft], to [m]\n0, 30\n100, 60\n200, 90\n";
    let listed = SectionRequest::of_text(Path::new("own.csv"), text).unwrap();
    let cut = listed.cut(Along::Distance, [5.0, 100.0], Units::Us).unwrap();
    assert_eq!((cut.sections.len(), cut.beyond), (2, vec![1]));
    near(cut.sections[0][0], 30.48, 1e-12);
    let times = SectionRequest::of_text(Path::new("own.csv"), "from [s], to [ms]\n0,500\n1,2000\n").unwrap();
    assert_eq!(
        times,
        SectionRequest::Listed(Along::Time, vec![[0.0, 0.5], [1.0, 2.0]])
    );
    let few = parse("60 m")
        .cut(Along::Distance, [0.0, 100.0], Units::Us)
        .unwrap_err();
    assert!(matches!(few, CutError::TooFew { found: 1, .. }));
    // 100 m by 12.
    assert!(few.help().contains("27.3403 ft"), "{}", few.help());
    let many = parse("1 mm")
        .cut(Along::Distance, [0.0, 100.0], Units::Us)
        .unwrap_err();
    assert_eq!(many, CutError::TooMany { found: 100_000 });
}

#[test]
fn input_what_are_no_sections_is_refused_with_the_way_out() {
    let refused = |text: &str, message: &str| {
        let error = SectionRequest::parse(text).unwrap_err();
        let problem = &error.problems()[0];
        assert!(problem.message().contains(message), "{text}: {problem}");
        assert!(
            problem.advice().is_some_and(|own| own.contains("--sections")),
            "{text}: {problem}"
        );
    };
    for text in ["1", "0", "-3", "2.5", "1e99", "nan", "20000"] {
        refused(text, "a whole number of sections from 2 to 10000");
    }
    for text in ["100 lbf", "0 m", "-5 ft"] {
        refused(text, "no length or time above zero");
    }
    refused("100 metres long", "--sections");
    refused("no_such.csv", "no_such.csv");
    let file = |text: &str, message: &str, line: usize| {
        let error = SectionRequest::of_text(Path::new("own.csv"), text).unwrap_err();
        let problem = &error.problems()[0];
        assert!(problem.message().contains(message), "{text}: {problem}");
        assert_eq!(
            problem.line_and_column().map_or(0, |own| own.0),
            line,
            "{problem}"
        );
        assert!(problem.advice().is_some(), "{problem}");
    };
    file("", "empty", 1);
    file("from, to\n0,1\n", "has no unit", 1);
    file("from [ft], to [s]\n0,1\n", "", 1);
    file("from [ft], to [ft]\n0,1,2\n", "3 values", 2);
    file("from [ft], to [ft]\n0,one\n", "not a number", 2);
    file(
        "from [ft], to [ft]\n0,100\n50,150\n",
        "begins before the one above ends",
        3,
    );
    file("from [ft], to [ft]\n0,100\n150,150\n", "does not end behind", 3);
    file("from [ft], to [ft]\n0,100\n", "1 sections", 0);
}

#[test]
fn input_accepted_differences_are_read_with_their_units() {
    let text =
        "source = \"ours\"\n[accept.force]\nmean = \"1 kN\"\nrms = \"2 lbf\"\n[accept.ratio]\nmax = 0.1\n";
    let read = Acceptance::parse("a.toml", text).unwrap();
    assert_eq!(read.columns().collect::<Vec<_>>(), ["force", "ratio"]);
    let limit = |column, quantity, kind| read.limit(column, quantity, kind);
    assert_eq!(
        limit("force", SectionQuantity::Mean, Kind::Force).unwrap(),
        Some(1000.0)
    );
    assert_eq!(
        limit("force", SectionQuantity::Maximum, Kind::Force).unwrap(),
        None
    );
    assert_eq!(
        limit("ratio", SectionQuantity::Maximum, Kind::Dimensionless).unwrap(),
        Some(0.1)
    );
    assert_eq!(limit("other", SectionQuantity::Mean, Kind::Force).unwrap(), None);
    let wrong = limit("force", SectionQuantity::Mean, Kind::Length).unwrap_err();
    assert_eq!(wrong.problems()[0].line_and_column().unwrap().0, 3);
    let unknown = read.unknown("ratio", ["ration"].into_iter());
    assert_eq!(unknown.problems()[0].advice(), Some("did you mean `ration`?"));

    let refused = |text: &str, message: &str| {
        let error = Acceptance::parse("a.toml", text).unwrap_err();
        let problems: Vec<String> = error.problems().iter().map(ToString::to_string).collect();
        assert!(
            problems.iter().any(|own| own.contains(message)),
            "{text}: {problems:?}"
        );
        assert!(
            error.problems().iter().all(|own| own.advice().is_some()),
            "{problems:?}"
        );
    };
    refused("[accept.force]\nmean = \"1 kN\"\n", "`source` is missing");
    refused("source = \"x\"\n", "`accept` is missing");
    refused("source = \"x\"\naccept = 3\n", "`accept` is a number");
    refused("source = \"x\"\n[accept]\n", "no column has a limit");
    refused("source = \"x\"\n[accept.force]\n", "sets no limit");
    refused("source = \"x\"\n[accept.force]\nmedian = 1\n", "no key `median`");
    refused("source = \"x\"\n[accept.force]\nmean = \"-1 kN\"\n", "above zero");
    refused("source = \"x\"\n[accept.force]\nmean = inf\n", "above zero");
    refused("source = \"x\"\n[accept.force]\nmean = true\n", "above zero");
    refused("source = \"x\"\n[accept.force]\nmean = \"1 kX\"\n", "kX");
    refused(
        "source = \"x\"\nlimit = 1\n[accept.a]\nmean = 1\n",
        "no key `limit`",
    );
    refused("source = \"x\n", "not TOML");
}
