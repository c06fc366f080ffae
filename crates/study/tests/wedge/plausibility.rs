//! Runs say what is implausible in them, with place, time, amount and what to do; sound ones say nothing.

use std::path::Path;

use study::case::{Case, builtin};
use study::design::Study;
use study::plausibility;
use study::records::{self, Status};
use study::result::RunResult;
use study::run::{Counts, Run, RunError, RunState};

/// Returns the run of a thesis's case, not yawed, with settings.
fn case(damping: &str, settings: &[&str]) -> Case {
    let settings: Vec<String> = settings.iter().map(|text| (*text).to_owned()).collect();
    builtin::case_with(&format!("{damping}_toe_0_psi_0"), &settings).unwrap()
}

fn run(damping: &str, settings: &[&str]) -> RunResult {
    Run::new(&case(damping, settings)).unwrap().finish(|_| ())
}

fn implausible(result: &RunResult) -> Vec<&str> {
    plausibility::among(&result.summary.warnings).collect()
}

/// A run has a warning with all these texts.
fn assert_says(result: &RunResult, texts: &[&str]) {
    let warnings = implausible(result);
    let has = |warning: &&str| texts.iter().all(|text| warning.contains(text));
    assert!(warnings.iter().any(has), "{texts:?} in {warnings:#?}");
}

#[test]
fn limits_the_thesiss_runs_say_nothing() {
    for (name, result) in &*crate::runs::TWELVE {
        assert!(
            result.summary.warnings.is_empty(),
            "{name}: {:?}",
            result.summary.warnings
        );
    }
}

/// A bolster that moves by a foot takes the wedge out of its place.
#[test]
fn limits_a_wedge_that_leaves_its_column_says_when_and_how_far() {
    let settings = [
        "bolster.vertical.amplitude=\"12 in\"",
        "simulation.duration=\"2 s\"",
    ];
    let result = run("cdrun", &settings);
    let places = crate::runs::column(&result, "wedge_z", crate::runs::INCH);
    let farthest = places.iter().fold(0.0, |most: f64, place| most.max(place.abs()));
    assert!(farthest > 6.125, "{farthest}");
    let (slid, limit) = ("the column has slid off its surface", "the limit is 6.125 in");
    assert_says(
        &result,
        &[slid, limit, " s; ", "exceeded from", "do not use what follows"],
    );
}

#[test]
fn limits_soft_contacts_say_how_deep_the_wedge_is_pressed_in() {
    let settings = ["contact.stiffness=\"1e3 lbf/in\"", "simulation.duration=\"1 s\""];
    let result = run("cdrun", &settings);
    let deepest = |name: &str| {
        let gaps = crate::runs::column(&result, name, crate::runs::INCH);
        gaps.iter().fold(0.0, |most: f64, gap| most.max(-gap))
    };
    let depth = deepest("column_lower_left_gap").max(deepest("column_lower_right_gap"));
    assert!(depth > 0.1, "{depth}");
    let texts = [
        "corner of the column penetrates",
        "the limit is 0.06125 in",
        "raise contact.stiffness",
    ];
    assert_says(&result, &texts);
}

#[test]
fn limits_friction_above_one_and_a_coil_that_pulls_are_said() {
    let short = "simulation.duration=\"0.5 s\"";
    let result = run("vdrun", &["friction.column=1.4", short]);
    assert_says(
        &result,
        &["the column has a coefficient of friction of 1.4, above 1"],
    );
    let pulled = ["control_coil.free_length=\"9.5 in\"", short];
    assert_says(
        &run("vdrun", &pulled),
        &["the control coil pulls", "control_coil.pulls = false"],
    );
}

/// Faces that begin deep inside throw the wedge out: the energy of the release is most of what happens.
#[test]
fn energy_an_overlap_at_the_start_is_said_with_the_start_that_avoids_it() {
    let settings = ["side_frame.toe=\"2 deg out\"", "simulation.duration=\"0.2 s\""];
    let texts = [
        "the column overlaps its surface at the start",
        "lbf in",
        "simulation.start = \"touching\"",
    ];
    assert_says(&run("cdrun", &settings), &texts);
    let touching = [&settings[..], &["simulation.start=\"touching\""]].concat();
    let result = run("cdrun", &touching);
    let warnings = implausible(&result);
    assert!(
        !warnings.iter().any(|text| text.contains("at the start")),
        "{warnings:?}"
    );
}

#[test]
fn limits_a_run_that_was_saved_and_goes_on_says_the_same() {
    let settings = [
        "contact.stiffness=\"1e3 lbf/in\"",
        "friction.slope=1.2",
        "simulation.duration=\"0.6 s\"",
    ];
    let case = case("cdrun", &settings);
    let straight = Run::new(&case).unwrap().finish(|_| ());
    let mut run = Run::new(&case).unwrap();
    while run.time() < 0.3 {
        run.advance().unwrap();
    }
    let text = serde_json::to_string(&run.state()).unwrap();
    let state: RunState<Counts> = serde_json::from_str(&text).unwrap();
    let continued = Run::resume(&case, state.clone()).unwrap().finish(|_| ());
    assert!(
        straight.summary.warnings.len() >= 3,
        "{:?}",
        straight.summary.warnings
    );
    assert_eq!(continued.summary.warnings, straight.summary.warnings);

    let mut spoilt = state;
    spoilt.plausibility.worst[0].value = f64::INFINITY;
    let error = Run::resume(&case, spoilt).err().unwrap();
    assert!(
        matches!(
            error,
            RunError::Damaged {
                member: "plausibility",
                ..
            }
        ),
        "{error}"
    );
}

/// A variant that is nonsense is a record with its reason and its measures.
#[test]
fn limits_a_variant_that_is_nonsense_has_failed_and_says_why() {
    let text = "case = \"cdrun_toe_0_psi_0\"\nsampling = \"full_factorial\"\naccuracy = \"engineering\"\n\
                [set]\nsimulation.duration = \"1 s\"\n[vary]\n\
                contact.stiffness = [\"1e3 lbf/in\", \"2.5e5 lbf/in\"]\n";
    let study = Study::parse("some.toml", text, Path::new("")).unwrap();
    let all = [0, 1].map(|number| records::run(&study, number));
    assert_eq!(
        all.each_ref().map(|record| record.status),
        [Status::Failed, Status::Complete]
    );
    assert!(
        all[0].reason.starts_with("implausible: the "),
        "{}",
        all[0].reason
    );
    assert!(
        study
            .measures()
            .get(&all[0].measures, "ledger_residual")
            .is_some()
    );
    let bytes = records::run_all(&study, [0, 1]);
    assert_eq!(records::read(study.fingerprint(), &bytes).records, all);
}

#[test]
fn input_a_case_file_without_values_says_that_all_are_defaults() {
    let parse = |text: &str| Case::parse("case.toml", text, Path::new(""), &[]).unwrap();
    let says = |text: &str| {
        let mut case = parse(text);
        case.simulation.duration = 0.02;
        let warnings = Run::new(&case).unwrap().finish(|_| ()).summary.warnings;
        warnings
            .iter()
            .any(|warning| warning == plausibility::NOTHING_GIVEN)
    };
    for empty in [
        "",
        "title = \"mine\"\n[wedge]\n",
        "[simulation]\nduration = \"1 s\"\n",
    ] {
        assert!(says(empty), "{empty}");
    }
    assert!(!says("[wedge]\nangle = \"32 deg\"\n"));
    let complete = parse("").to_toml().to_owned();
    assert!(!says(&complete));
}
