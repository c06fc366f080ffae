//! Reading plans: what is wrong is shown at its place.

use std::path::Path;

use study::car::limits::Bound;
use study::design::Value;
use study::probability::{Estimator, Plan};

const PLAN: &str = r#"case = "cdrun_toe_out_0.2_psi_0.012"
measure = "peak_side_frame_pitch_moment"
at_most = "4000 lbf in"
method = "subset"
most_runs = 10000
[set]
simulation.duration = "1 s"
[uncertain]
friction.column = { distribution = "normal", mean = 0.4, deviation = 0.05, from = 0.2, to = 0.6, MARK }
side_frame.toe = { distribution = "discrete", values = ["0.2 deg out", "0 deg", "0.2 deg in"], WEIGHTS }
"#;

fn plan(text: &str) -> Result<Plan, study::case::CaseError> {
    Plan::parse("plan.toml", text, Path::new(""))
}

fn text() -> String {
    // Lines of this file are shorter than those of the plan.
    PLAN.replace("MARK", "mark = \"guess\"")
        .replace("WEIGHTS", "weights = [1, 2, 1], mark = \"derived\"")
}

#[test]
fn input_plans_make_cases() {
    let own = plan(&text()).unwrap();
    let Estimator::Subset(subset) = own.estimator else {
        unreachable!()
    };
    assert_eq!(
        [subset.samples, subset.repeats, subset.parts, subset.levels],
        [200, 10, 10, 8]
    );
    assert_eq!(own.limit.goal.bound, Bound::AtMost);
    assert!((own.limit.goal.limit / (4000.0 * 0.112_984_829) - 1.0).abs() < 1e-8);
    let values = own.values(&[0.0, -3.0]);
    assert_eq!(values[1].to_toml("side_frame.toe"), "\"0.2 deg out\"");
    let Value::Number { value, .. } = values[0] else {
        unreachable!()
    };
    assert!((value - 0.4).abs() < 1e-12);
    own.case(&[0.5, 3.0]).unwrap();
    // Marks decide no run.
    let marked = plan(&text().replace("\"guess\"", "\"remembered\"")).unwrap();
    assert_eq!(own.fingerprint(), marked.fingerprint());
    let wider = plan(&text().replace("0.05", "0.06")).unwrap();
    assert_ne!(own.fingerprint(), wider.fingerprint());
}

#[test]
fn input_limits_of_rules_bring_their_windows() {
    let text = r#"case = "car_twist_and_roll_loaded"
limit = "fra_213_333.single_wheel_load"
method = "monte_carlo"
runs = 10
[uncertain]
truck.friction.column = { distribution = "uniform", from = 0.3, to = 0.5, mark = "guess" }
"#;
    let own = plan(text).unwrap();
    assert_eq!(own.limit.measure, "least_load_distance");
    assert_eq!(
        (own.limit.goal.bound, own.limit.goal.limit),
        (Bound::AtLeast, 15.0)
    );
    assert_eq!(own.limit.in_words(), "15 %");
    assert!(own.limit.rule.starts_with("fra_213_333.single_wheel_load"));
    assert!(
        own.set.iter().any(|set| set.starts_with("output.")),
        "{:?}",
        own.set
    );
    for (from, to, words) in [
        (
            "wheel_load",
            "wheel_lod",
            "did you mean \"fra_213_333.single_wheel_load\"?",
        ),
        ("fra_213_333.", "fra_213_33.", "did you mean fra_213_333?"),
        (
            "fra_213_333.single_wheel_load",
            "wheel_load",
            "set and name of a limit",
        ),
        ("single_wheel_load", "single_wheel_l_over_v", "write its number"),
        ("method =", "at_most = 1\nmethod =", "take one out"),
        ("car_twist_and_roll_loaded", "vdrun_toe_0_psi_0", ""),
    ] {
        let error = plan(&text.replacen(from, to, 1)).unwrap_err();
        let advice = error.problems()[0].advice().unwrap_or_default();
        assert!(advice.contains(words), "{words}: {error} {advice}");
        assert!(
            error.problems().iter().all(|own| own.line_and_column().is_some()),
            "{error}"
        );
    }
}

#[test]
fn input_mistakes_of_plans_are_shown_where_they_are() {
    for (from, to, place, words) in [
        (", mark = \"guess\"", "", (9, 10), "mark` is missing"),
        (
            "\"guess\"",
            "\"source\"",
            (9, 105),
            "from a source that is not named",
        ),
        ("\"guess\"", "\"guessed\"", (9, 105), "cannot be \"guessed\""),
        ("to = 0.6", "to = -0.6", (9, 93), "not above the least one"),
        (
            "from = 0.2, to = 0.6",
            "from = 0.6, to = 0.61, mode = 0.4",
            (9, 0),
            "no key `mode`",
        ),
        ("from = 0.2", "from = -0.2", (9, 83), "friction.column"),
        (", from = 0.2, to = 0.6", ", from = 0.2", (9, 0), ""),
        (
            "deviation = 0.05, from = 0.2",
            "deviation = 0.2",
            (9, 36),
            "once in 3.5 million",
        ),
        ("deviation = 0.05", "deviation = 0", (9, 70), "greater than zero"),
        (
            "mean = 0.4",
            "mean = \"4 in\"",
            (9, 0),
            "not in the unit of the others",
        ),
        (
            "weights = [1, 2, 1]",
            "weights = [1, 2]",
            (10, 106),
            "are not 3 numbers",
        ),
        ("\"0 deg\"", "\"99 deg out\"", (10, 0), "toe"),
        ("friction.column", "friction.colum", (9, 10), "colum"),
        (
            "friction.column",
            "simulation.duration",
            (9, 12),
            "uncertain and set as well",
        ),
        (
            "peak_side_frame_pitch",
            "peak_side_frame_pich",
            (2, 11),
            "no measure",
        ),
        ("4000 lbf in", "4000 lbf", (3, 0), "moment"),
        (
            "at_most = \"4000 lbf in\"\n",
            "",
            (2, 11),
            "neither of `at_most` and `at_least`",
        ),
        (
            "most_runs = 10000",
            "most_runs = 100",
            (5, 13),
            "less than the first level",
        ),
        (
            "most_runs = 10000",
            "samples = 25\nmost_runs = 10000",
            (5, 11),
            "no multiple of 10",
        ),
        (
            "most_runs = 10000",
            "level_probability = 0.3\nmost_runs = 10000",
            (5, 21),
            "0.3",
        ),
        (
            "most_runs = 10000",
            "repeats = 2\nmost_runs = 10000",
            (5, 11),
            "at least 4",
        ),
        (
            "most_runs = 10000",
            "runs = 2\nmost_runs = 10000",
            (5, 1),
            "has no `runs`",
        ),
        ("\"subset\"", "\"subsets\"", (4, 10), "cannot be \"subsets\""),
        ("\"1 s\"", "\"-1 s\"", (7, 23), "duration"),
        ("[set]", "confidence = 95\n[set]", (6, 14), "below 1"),
    ] {
        if words.is_empty() {
            // One end may be left out.
            assert!(plan(&text().replacen(from, to, 1)).is_ok(), "{from}");
            continue;
        }
        let error = plan(&text().replacen(from, to, 1))
            .err()
            .unwrap_or_else(|| panic!("{from}: {to}"));
        let problem = &error.problems()[0];
        assert!(
            problem.message().contains(words),
            "{words}: {}",
            problem.message()
        );
        assert!(
            problem.advice().is_some_and(|own| !own.is_empty()),
            "{words}: no advice"
        );
        let (line, column) = problem.line_and_column().unwrap();
        assert_eq!(line, place.0, "{words}");
        assert!(place.1 == 0 || column == place.1, "{words}: column {column}");
    }
    let whole = text();
    let nothing = whole.split("[uncertain]").next().unwrap();
    let error = plan(nothing).err().unwrap();
    assert!(error.to_string().contains("nothing is uncertain"), "{error}");
}
