//! The start of a car's run: what it locks in, written, read, printed and kept.

use study::car::CarCase;
use study::car::summary::CarSummary;
use study::case::Tables;
use study::run::Run;

fn case(start: &str, lines: &str) -> CarCase {
    let text = format!("model = \"car\"\nstart.kind = \"{start}\"\nstart.settle = \"0 s\"\n{lines}");
    CarCase::parse("case.toml", &text, Tables::nowhere(), &[]).unwrap()
}

const SHORT: &str = "[simulation]\nduration = \"0.2 s\"\n";

/// A shaken start is written and read back, and the assumptions say what it is.
#[test]
fn input_a_shaken_start_reads_back() {
    let own = case("shaken", SHORT);
    assert!(own.to_toml().contains("kind = \"shaken\""), "{}", own.to_toml());
    let again = CarCase::parse("case.toml", own.to_toml(), Tables::nowhere(), &[]).unwrap();
    assert_eq!(again, own);
    assert_ne!(case("equilibrium", SHORT), own);
    let text = "model = \"car\"\nstart.kind = \"shaken\"\nwheels.geometry = \"linear\"\n\
                track.support.kind = \"rigid\"\ntrack.segments = [{ tangent = \"900 ft\" }]\n\
                [simulation]\nduration = \"1 s\"\n";
    let error = CarCase::parse("case.toml", text, Tables::nowhere(), &[]).unwrap_err();
    let [problem] = error.problems() else {
        panic!("{:?}", error.problems());
    };
    assert!(
        problem.message().contains("`start.kind` is \"shaken\""),
        "{problem}"
    );
    assert!(problem.advice().is_some_and(|own| own.contains("equilibrium")));
}

/// The summary has the forces at the start, those before the shaking beside them, and reads back; the line
/// about them has both.
#[test]
fn analytic_the_summary_says_what_the_start_locks_in() {
    let summary = |start: &str| Run::new(&case(start, SHORT)).unwrap().finish(|_| ()).summary;
    let (shaken, usual) = (summary("shaken"), summary("equilibrium"));
    assert_eq!(
        (shaken.start.as_str(), usual.start.as_str()),
        ("shaken", "equilibrium")
    );
    assert_eq!(shaken.locked_in.len(), 8);
    for (name, own) in &shaken.locked_in {
        let usual = &usual.locked_in[name];
        assert_eq!(usual.before_shaking, None);
        let before = own.before_shaking.as_ref().unwrap();
        let most = usual.at_start.column.value;
        assert!((before.column.value / most - 1.0).abs() < 1e-6, "{name}");
        assert!(own.at_start.column.value < 0.95 * most, "{name}");
        assert!(own.at_start.slope.value > own.at_start.column.value, "{name}");
    }
    let words = shaken.start_in_words().unwrap();
    assert!(
        words.contains("(shaken)") && words.contains("9824 lbf before"),
        "{words}"
    );
    let words = usual.start_in_words().unwrap();
    assert!(words.contains("9824 lbf at the start (equilibrium"), "{words}");
    assert!(shaken.assumptions.iter().any(|own| own.contains("FRA class 3")));
    let text = serde_json::to_string(&shaken).unwrap();
    assert_eq!(serde_json::from_str::<CarSummary>(&text).unwrap(), shaken);
    // Summaries of before have none of it.
    let mut old: serde_json::Value = serde_json::from_str(&text).unwrap();
    let fields = old.as_object_mut().unwrap();
    assert!(fields.remove("start").is_some() && fields.remove("locked_in").is_some());
    let old: CarSummary = serde_json::from_value(old).unwrap();
    assert_eq!(old.start_in_words(), None);
}

/// A run from a shaken start that is saved goes on with the same bits.
#[test]
fn reproducible_a_shaken_run_goes_on_with_the_same_bits() {
    let own = case("shaken", SHORT);
    let whole = Run::new(&own).unwrap().finish(|_| ());
    let mut first = Run::new(&own).unwrap();
    while first.time() < 0.1 {
        first.advance().unwrap();
    }
    let state = serde_json::from_str(&serde_json::to_string(&first.state()).unwrap()).unwrap();
    let second = Run::resume(&own, state).unwrap().finish(|_| ());
    let (rows, all) = (second.rows(), whole.rows());
    assert!(rows > 5 && rows < all);
    for name in [
        "axle_1_left_vertical",
        "truck_2_leading_left_column_normal",
        "ledger_residual",
    ] {
        let (a, b) = (whole.column(name).unwrap(), second.column(name).unwrap());
        assert_eq!(&a[all - rows..], b, "{name}");
    }
    assert_eq!(second.summary.locked_in, whole.summary.locked_in);
}
