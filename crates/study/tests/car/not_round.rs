//! analytic, cross_code, energy, input: cars with wheels that are not round.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

use car::{ProfiledWheels, Wheels};
use study::car::CarCase;
use study::car::run::CarResult;
use study::run::Run;
use wheelrail::contact::WheelForm;

use crate::problems::in_words;

/// A folder with sections of a cone around a wheel that lies 0.5 mm beside its axle, every 22.5 deg.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut list = "0 1\n16\n0 0\n1\n".to_owned();
    for k in 0..16 {
        let angle = TAU * (f64::from(k) - 8.0) / 16.0;
        let grown = 0.5 * angle.cos();
        let mut text = "y [mm], z [mm]\n".to_owned();
        for i in -30..=30 {
            let y = f64::from(i);
            writeln!(text, "{y}, {:.6}", 0.05 * y - grown).unwrap();
        }
        std::fs::write(folder.path().join(format!("{k}.csv")), text).unwrap();
        writeln!(list, "{angle:.6} '{k}.csv'").unwrap();
    }
    std::fs::write(folder.path().join("wheel.slcw"), list).unwrap();
    folder
}

fn text(lines: &str) -> String {
    format!(
        "model = \"car\"\n{lines}\n[track]\nsupport = {{ kind = \"rigid\" }}\nsegments = [{{ tangent = \
         \"300 ft\" }}]\n"
    )
}

fn case(lines: &str, folder: &Path) -> CarCase {
    CarCase::parse("case.toml", &text(lines), folder, &[])
        .unwrap_or_else(|error| panic!("{}", in_words(error.problems())))
}

fn words_of(lines: &str, folder: &Path) -> String {
    in_words(
        CarCase::parse("case.toml", &text(lines), folder, &[])
            .unwrap_err()
            .problems(),
    )
}

fn on_rails(case: &CarCase) -> &ProfiledWheels {
    match &case.parameters.wheels {
        Wheels::OnRails(own) => own,
        Wheels::Linear { .. } => panic!("profiles are expected"),
    }
}

fn run(case: &CarCase) -> CarResult {
    let result = Run::new(case).unwrap().finish(|_| ());
    assert!(result.summary.complete, "{:?}", result.summary.stopped);
    result
}

fn column(result: &CarResult, name: &str) -> Vec<f64> {
    result.column(name).unwrap().to_vec()
}

const EACH: &str = "
[speed]
value = \"10 m/s\"
[wheels.left]
out_of_round = [{ order = 3, amplitude = \"0.1 mm\" }]
[wheels.axle_2]
flats = [{ length = \"50 mm\" }]
[wheels.axle_2.right]
flats = [{ length = \"2 in\", angle = \"10 deg\" }, { length = \"60 mm\", depth = \"0.4 mm\", angle = \
\"-90 deg\" }]
[simulation]
duration = \"0.4 s\"
output_interval = \"0.2 ms\"
";

/// What is said of one wheel goes before its wheelset, that before its side; written and read again it is
/// the same.
#[test]
fn input_each_wheel_may_have_its_own_flats() {
    let nowhere = Path::new(".");
    let first = case(EACH, nowhere);
    let again = CarCase::parse("again.toml", first.to_toml_embedded(), nowhere, &[]).unwrap();
    for case in [&first, &again] {
        let forms = &on_rails(case).forms;
        let of = |w: usize, side: usize| match &forms[w][side] {
            None => (0, 0),
            Some(WheelForm::OutOfRound(own)) => (own.flats().len(), own.harmonics().len()),
            Some(WheelForm::Sliced(_)) => panic!("flats are expected"),
        };
        assert_eq!(
            [of(0, 0), of(0, 1), of(3, 0), of(3, 1)],
            [(0, 1), (0, 0), (0, 1), (0, 0)]
        );
        assert_eq!([of(1, 0), of(1, 1)], [(1, 1), (2, 0)]);
        assert!(case.doubts.is_empty(), "{:?}", case.doubts);
    }
    // Half of 50 mm at 10 m/s.
    assert!((first.parameters.longest_step() - 2.5e-3).abs() < 1e-12);
}

#[test]
fn input_mistakes_about_wheels_that_are_not_round() {
    let folder = folder();
    let round = |entry: &str| format!("[wheels.axle_2.left]\nout_of_round = [{{ {entry} }}]");
    let flat = |entry: &str| format!("[wheels]\nflats = [{{ {entry} }}]");
    let cases = [
        (
            round("order = 0, amplitude = \"0.1 mm\""),
            "`wheels.axle_2.left.out_of_round[0].order`",
        ),
        (round("order = 2.5, amplitude = \"0.1 mm\""), "whole number"),
        (round("order = 40, amplitude = \"0.5 mm\""), "hollows"),
        (
            round("order = 2, amplitude = \"12 mm\""),
            "fiftieth of the radius",
        ),
        (round("order = 2"), "amplitude"),
        (flat("length = \"0 mm\""), "`wheels.flats[0].length`"),
        (flat("length = \"400 mm\""), "at most half of the radius"),
        (
            flat("length = \"50 mm\", depth = \"1 mm\""),
            "fresh flat of the same length",
        ),
        (flat("length = \"50 mm\", widht = \"1 mm\""), "widht"),
        (
            "[wheels]\nflats = [{ length = \"50 mm\" }, { length = \"50 mm\", angle = \"175 deg\" }]"
                .to_owned(),
            "do not overlap",
        ),
        (
            "[wheels]\ngeometry = \"linear\"\n[wheels.right]\nflats = [{ length = \"50 mm\" }]".to_owned(),
            "linear wheels are round",
        ),
        (
            "[wheels]\nprofile = \"wheel.slcw\"\nflats = [{ length = \"50 mm\" }]".to_owned(),
            "is a list of sections around the wheel",
        ),
        (
            "[wheels]\nprofile = \"wheel.slcw\"\ntables = true".to_owned(),
            "tables of contacts",
        ),
    ];
    for (lines, expected) in cases {
        let words = words_of(&lines, folder.path());
        assert!(words.contains(expected), "{lines}\n{words}");
    }
}

/// Rows that are too far apart for a flat are doubted with what to write; rows that are not are not.
#[test]
fn input_rows_too_far_apart_for_a_flat() {
    let of = |interval: &str| {
        let lines = format!(
            "[speed]\nvalue = \"10 m/s\"\n[wheels]\nflats = [{{ length = \"50 mm\" \
             }}]\n[simulation]\nduration = \"1 s\"\n\
             output_interval = \"{interval}\""
        );
        case(&lines, Path::new(".")).doubts
    };
    let doubts = of("5 ms");
    assert_eq!(doubts.len(), 1, "{doubts:?}");
    assert!(doubts[0].contains("within 2.50 ms at 10.0 m/s"), "{}", doubts[0]);
    assert!(
        doubts[0].contains("output_interval = \"0.62 ms\""),
        "{}",
        doubts[0]
    );
    assert!(of("0.6 ms").is_empty());
}

/// Flats of one wheelset of a car: its wheels are struck once a turn, 0.2873 s at 10 m/s, others are not,
/// and the ledger closes.
#[test]
fn analytic_flats_strike_once_a_turn() {
    let lines = "[speed]\nvalue = \"10 m/s\"\n[wheels.axle_3]\nflats = [{ length = \"30 mm\", angle = \"90 \
                 deg\" }]\n\
                 [simulation]\nduration = \"0.8 s\"\noutput_interval = \"0.2 ms\"\noutput_units = \"si\"";
    let result = run(&case(lines, Path::new(".")));
    let loads = column(&result, "axle_3_left_vertical");
    let period = TAU * 0.4572 / 10.0;
    assert!((period - 0.2873).abs() < 5e-5);
    let mut blows = Vec::new();
    for turn in 0..2 {
        let from = ((f64::from(turn) * period) / 2e-4) as usize;
        let rows = from..from + (period / 2e-4) as usize;
        let best = rows.max_by(|a, b| loads[*a].total_cmp(&loads[*b])).unwrap();
        assert!(loads[best] > 2.0 * loads[0], "{} {}", loads[best], loads[0]);
        blows.push(2e-4 * best as f64);
    }
    assert!((blows[1] - blows[0] - period).abs() < 2e-3, "{blows:?}");
    let calm = column(&result, "axle_1_left_vertical");
    assert!(calm.iter().all(|load| (load / calm[0] - 1.0).abs() < 0.05));
    let residual = result.summary.ledger.largest_relative_residual;
    assert!(residual < 1e-3, "{residual}");
}

/// Sections around the wheels of one wheelset load the rails once a turn, and the ledger closes.
#[test]
fn analytic_sections_around_a_wheel() {
    let folder = folder();
    let lines = "[speed]\nvalue = \"15 m/s\"\n[wheels.axle_1]\nprofile = \
                 \"wheel.slcw\"\n[simulation]\nduration = \"0.8 s\"\noutput_interval = \"2 ms\"";
    let case = case(lines, folder.path());
    let forms = &on_rails(&case).forms;
    let sliced = |form: &Option<WheelForm>| matches!(form, Some(WheelForm::Sliced(_)));
    assert!(forms[0].iter().all(sliced) && forms[1..].iter().flatten().all(Option::is_none));
    let result = run(&case);
    let [left, right] = ["left", "right"].map(|side| column(&result, &format!("axle_1_{side}_vertical")));
    let period = TAU * 0.4572 / 15.0;
    let rows = (3.0 * period / 2e-3) as usize;
    let first = left.len() - rows;
    let line = |number: usize| {
        let sums = (0..rows).fold([0.0; 2], |[a, b], k| {
            let (sine, cosine) = libm::sincos(TAU * (number * k) as f64 / rows as f64);
            let load = left[first + k] + right[first + k];
            [a + load * cosine, b + load * sine]
        });
        sums[0].hypot(sums[1])
    };
    // Three turns.
    let best = (1..rows / 2).max_by(|a, b| line(*a).total_cmp(&line(*b)));
    assert_eq!(best, Some(3));
    let residual = result.summary.ledger.largest_relative_residual;
    assert!(residual < 1e-3, "{residual}");
}
