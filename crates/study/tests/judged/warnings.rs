//! Warnings against the rows of the same run: what they state is there, and it exceeds the limit they print.

use study::case::builtin as wedges;
use study::plausibility;
use study::result::RunResult;
use study::run::Run;

use crate::short_runs;

const INCH: f64 = 0.0254;

fn wedge(settings: &[&str]) -> RunResult {
    let settings: Vec<String> = settings.iter().map(|own| (*own).to_owned()).collect();
    let case = wedges::case_with("vdrun_toe_0_psi_0", &settings).unwrap();
    Run::new(&case).unwrap().finish(|_| ())
}

/// Returns the number behind some words of a warning.
fn number(text: &str, words: &str) -> f64 {
    let rest = text
        .split(words)
        .nth(1)
        .unwrap_or_else(|| panic!("no `{words}` in {text}"));
    rest.split_whitespace().next().unwrap().parse().unwrap()
}

fn the_one(result: &RunResult, words: &str) -> String {
    let mut found = plausibility::among(&result.summary.warnings).filter(|own| own.contains(words));
    let first = found
        .next()
        .unwrap_or_else(|| panic!("no `{words}`: {:?}", result.summary.warnings));
    first.to_owned()
}

/// Checks that value and time of a warning are those of the largest of some numbers, one a row.
fn compare(text: &str, quantity: &str, times: &[f64], values: &[f64]) {
    let (value, limit) = (number(text, quantity), number(text, "the limit is "));
    assert!(value > limit, "{text}");
    let largest = values.iter().fold(f64::MIN, |most, own| most.max(*own));
    assert!((value / largest - 1.0).abs() < 1e-2, "{largest}: {text}");
    let row = values.iter().position(|own| *own == largest).unwrap();
    assert!(
        (number(text, " at ") - times[row]).abs() < 1e-6,
        "{}: {text}",
        times[row]
    );
}

#[test]
fn issue_047_warnings_of_wedges_state_what_the_rows_hold() {
    let short = "simulation.duration=\"2 s\"";
    let soft = wedge(&["contact.stiffness=\"8e3 lbf/in\"", short]);
    let column = |name: &str| soft.column(name).unwrap();
    let times = column("time");
    let text = the_one(&soft, "penetrates its surface too deep");
    let deepest = |row: usize| {
        let gaps = soft.columns.iter().filter(|own| own.name.ends_with("_gap"));
        let faces = ["side_frame", "bolster"].map(|face| if text.contains(face) { face } else { "" });
        let own = gaps.filter(|own| {
            faces
                .iter()
                .all(|face| face.is_empty() || own.name.contains(face))
        });
        own.map(|own| -column(&own.name)[row] / INCH)
            .fold(f64::MIN, f64::max)
    };
    // The overlap of the start does not count.
    let mut depths: Vec<f64> = (0..times.len()).map(deepest).collect();
    depths[0] = 0.0;
    let value = number(&text, "the depth is ");
    assert!(value > number(&text, "the limit is "), "{text}");
    let largest = depths.iter().fold(f64::MIN, |most, own| most.max(*own));
    assert!(value <= largest * 1.001, "{largest}: {text}");
    assert!(
        depths.iter().any(|own| (own / value - 1.0).abs() < 1e-3),
        "{text}"
    );

    let far = wedge(&["bolster.vertical.amplitude=\"9 in\"", short]);
    let text = the_one(&far, "the column has slid off its surface");
    let height = far.column("wedge_z").unwrap();
    let way: Vec<f64> = height.iter().map(|own| (own - height[0]).abs() / INCH).collect();
    compare(&text, "moved along it by ", far.column("time").unwrap(), &way);
}

/// A heavy car is no reason to call its faces left: the warnings that it has are about what is so.
#[test]
fn issue_047_a_heavy_car_has_not_slid_off_its_surfaces() {
    let result = short_runs::run(
        "car_tangent_loaded",
        &["car.weight=\"5e6 lbf\"", "simulation.duration=\"0.2 s\""],
    );
    let slid = result
        .summary
        .warnings
        .iter()
        .find(|own| own.contains("has slid off"));
    assert_eq!(slid, None);
}
