//! Wrong and doubtful entries in the printed files.

use crate::common;
use common::{
    CONSTANT, CONSTANT_3D, VARIABLE, VARIABLE_3D, VERTICAL, YAW, codes, data, has, input, list, system, text,
};
use nucars::read::{read_input, read_system};
use nucars::tree::DofKind;
use nucars::{Severity, builtin, check};

#[test]
fn the_printed_systems_have_no_errors_and_the_known_doubts() {
    let known: [(&str, &[&str]); 4] = [
        (CONSTANT, &["held-turn", "shared-by-turns", "title"]),
        (VARIABLE, &["held-turn", "preload", "shared-by-turns", "title"]),
        (
            CONSTANT_3D,
            &["copied-stop", "held-turn", "shared-by-turns", "title"],
        ),
        (
            VARIABLE_3D,
            &["copied-stop", "held-turn", "preload", "shared-by-turns", "title"],
        ),
    ];
    for (name, doubts) in known {
        let findings = system(text(name)).findings;
        assert_eq!(codes(&findings, Severity::Error), [""; 0], "{}", list(&findings));
        assert_eq!(codes(&findings, Severity::Warning), doubts, "{}", list(&findings));
        // The yaw spring of 1e6 in·lb/rad against 2 * 1e6 lb/in * (39.5 in)^2 = 3.12e9 in·lb/rad.
        let yaw = [
            "216 cannot yaw body 1",
            "1e6 in·lb/rad",
            "3.12e9 in·lb/rad",
            "201, 221",
        ];
        assert!(has(&findings, Severity::Warning, 0, &yaw), "{}", list(&findings));
    }
    // Only one of the texts contradicts its wedges.
    for (name, wrong) in [(CONSTANT_3D, false), (VARIABLE_3D, true)] {
        let findings = system(text(name)).findings;
        assert_eq!(
            has(&findings, Severity::Warning, 0, &["constant damping"]),
            wrong,
            "{name}"
        );
    }
    // The longitudinal stop took the abscissa of the lateral one: 1e5 lb in 0.475 in.
    let findings = system(text(CONSTANT_3D)).findings;
    assert!(
        has(&findings, Severity::Warning, 0, &["function 11", "210526"]),
        "{}",
        list(&findings)
    );
}

#[test]
fn the_constant_case_is_in_balance_and_the_variable_one_is_not() {
    // 319.175 * 386.0886 = 123 229.8 lb on eight springs of 15 403.78 lb; 2.98 * 386.0886 = 1150.5 lb.
    let balance = |name: &str| {
        let file = system(text(name)).tree;
        check::vertical_balance(&file)
            .iter()
            .map(|one| one.carried - one.weight)
            .collect::<Vec<_>>()
    };
    for name in [CONSTANT, CONSTANT_3D] {
        let [body, left, right] = balance(name)[..] else {
            unreachable!()
        };
        assert!((body - 0.4).abs() < 0.1, "{body}");
        assert!((left + 1.7).abs() < 0.1 && left == right, "{left} {right}");
    }
    for name in [VARIABLE, VARIABLE_3D] {
        let [body, left, right] = balance(name)[..] else {
            unreachable!()
        };
        assert!((body + 123_229.8).abs() < 0.1, "{body}");
        assert!((left - 61_614.0).abs() < 1.0 && left == right, "{left} {right}");
    }
}

#[test]
fn a_commanded_yaw_does_not_arrive() {
    let read = read_system(&builtin::source(CONSTANT).unwrap());
    let with = |name: &str| {
        let input = read_input(&builtin::source(name).unwrap());
        check::system_with_input(&read, &input.tree)
    };
    assert_eq!(with(VERTICAL).list().len(), 0);
    // 0.012 rad * 1e6 / (1e6 + 2e6 * 39.5^2)
    let findings = with(YAW);
    assert!(
        has(
            &findings,
            Severity::Warning,
            0,
            &["history 6", "yaw of 0.012 rad", "3.844e-6 rad"]
        ),
        "{}",
        list(&findings)
    );

    let drives = check::drives(&read.tree);
    let find = |axis| drives.iter().find(|drive| drive.axis == axis).unwrap();
    assert!((find(DofKind::Yaw).holding - 2e6 * 39.5 * 39.5).abs() < 1.0);
    // Roll: the two outer vertical springs, about the middle.
    assert!((find(DofKind::Roll).holding - 2e6 * 39.5 * 39.5).abs() < 1.0);
    // Pitch: all springs in one line.
    assert_eq!(
        (find(DofKind::Pitch).holding, find(DofKind::Pitch).stiffness),
        (0.0, 3e6)
    );
}

#[test]
fn a_yaw_spring_that_is_stiff_enough_is_no_doubt() {
    // Without the two longitudinal drives, and with a characteristic of its own.
    let mended: String = text(CONSTANT)
        .lines()
        .filter(|line| !line.starts_with("201 ") && !line.starts_with("221 "))
        .map(|line| line.to_owned() + "\n")
        .collect();
    let mended = mended.replace("\n50\n", "\n48\n");
    let findings = system(&mended).findings;
    assert!(
        !has(&findings, Severity::Warning, 0, &["cannot yaw"]),
        "{}",
        list(&findings)
    );
    assert!(
        has(&findings, Severity::Warning, 0, &["cannot roll"]),
        "{}",
        list(&findings)
    );
}

#[test]
fn the_printed_inputs_contradict_their_comments() {
    assert_eq!(input(text(VERTICAL)).list().len(), 0);
    let findings = input(text(YAW));
    assert_eq!(findings.count(Severity::Error), 0);
    assert!(
        has(&findings, Severity::Warning, 23, &["history 3", "null", "SSIN"]),
        "{}",
        list(&findings)
    );
    assert!(
        has(&findings, Severity::Warning, 33, &["history 6", "sine", "BEND"]),
        "{}",
        list(&findings)
    );
}

#[test]
fn the_printed_data_files_have_the_known_faults() {
    for (name, system_name) in [("sngl_trk_68.dat", CONSTANT), ("sngl_trk_69.dat", CONSTANT_3D)] {
        let findings = data(text(name), system_name);
        assert_eq!(findings.count(Severity::Error), 0, "{}", list(&findings));
        assert!(
            has(&findings, Severity::Warning, 0, &["sums is 2, but 6"]),
            "{}",
            list(&findings)
        );
    }
    // In the second, lateral sums take .2 of the three-dimensional wedges, which is longitudinal.
    let findings = data(text("sngl_trk_69.dat"), CONSTANT_3D);
    for text in [
        "127.2 in x to 119.1 in y",
        "128.2 in x to 120.1 in y",
        "the y of this connection is .3",
    ] {
        assert!(
            has(&findings, Severity::Warning, 0, &[text]),
            "{}",
            list(&findings)
        );
    }
    assert!(!codes(&data(text("sngl_trk_68.dat"), CONSTANT), Severity::Warning).contains(&"mixed-sum"));
    // What is switched off: 52 announced, 31 listed, of which 3 flexible modes and the 14 of bodies 2, 5, 6
    // do not exist.
    assert!(
        has(&findings, Severity::Note, 22, &["the count is 52, but 31"]),
        "{}",
        list(&findings)
    );
    assert!(
        has(&findings, Severity::Note, 22, &["asks for 17 things"]),
        "{}",
        list(&findings)
    );
    // A file for the other system asks for components that are not there.
    let findings = data(text("sngl_trk_69.dat"), CONSTANT);
    assert!(
        has(
            &findings,
            Severity::Error,
            0,
            &["connection 127 has 2 components, not 3"]
        ),
        "{}",
        list(&findings)
    );
}

#[test]
fn wedges_with_toe_in_jam() {
    // Mu 0.4 at 37.5 degrees, toe in: (sin - mu cos) - mu (cos + mu sin) = -0.123 for a face without lean.
    let toe_in = text(CONSTANT).replace("0.40  0.40  .T.  1.0D5", "0.40  0.40  .F.  1.0D5");
    let findings = system(&toe_in).findings;
    assert!(
        has(
            &findings,
            Severity::Warning,
            0,
            &["characteristic 14 jams", "-0.12"]
        ),
        "{}",
        list(&findings)
    );
    let slippery = text(CONSTANT).replace("0.40  0.40  .T.  1.0D5", "0.20  0.20  .F.  1.0D5");
    assert!(!codes(&system(&slippery).findings, Severity::Warning).contains(&"jam"));
    // The face of type 6.9 leaning inwards by 0.2 degrees: margins -0.127 at 37.5 and -0.237 at 32 degrees.
    for (name, margin) in [(CONSTANT_3D, "-0.127"), (VARIABLE_3D, "-0.237")] {
        let face = "0.015708          0.0    -0.015708";
        let leaning = text(name).replace(face, "-0.015708          0.0    0.015708");
        let findings = system(&leaning).findings;
        assert!(
            has(&findings, Severity::Warning, 0, &["jams", margin]),
            "{}",
            list(&findings)
        );
    }
}
