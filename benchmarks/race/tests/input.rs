//! Wrong names and null pointers.
#![allow(missing_docs, unsafe_code, clippy::unwrap_used, clippy::expect_used)]

use race::c_interface::{
    race_close, race_dimension, race_jacobian, race_open, race_rates, race_rows, race_start, race_time,
};
use race::contest::{IN_OCTAVE, Tools, solver};
use race::problem::{RaceProblem, names};
use race::wedge_case::WedgeCase;

#[test]
fn an_unknown_problem_is_named_with_those_there_are() {
    let error = RaceProblem::named("vdrun").err().unwrap().to_string();
    assert!(
        error.contains("`vdrun`") && names().iter().all(|name| error.contains(name)),
        "{error}"
    );
}

#[test]
fn what_is_no_wedge_starts_nowhere_else() {
    let error = RaceProblem::named("stick_tanh@1").err().unwrap().to_string();
    assert!(error.contains("stick_tanh has no wedge"), "{error}");
    let error = RaceProblem::named("vdrun_toe_0_psi_0@x")
        .err()
        .unwrap()
        .to_string();
    assert!(error.contains("`vdrun_toe_0_psi_0@x`"), "{error}");
}

#[test]
fn what_is_no_wedge_is_not_handed_over() {
    let error = WedgeCase::named("stick_tanh").err().unwrap();
    assert!(error.contains("stick_tanh is no wedge"), "{error}");
    let case = WedgeCase::named("cdrun_toe_0_psi_0.012").unwrap();
    assert_eq!(
        (case.start.len(), case.scales.len(), case.times.len()),
        (9, 9, 1001)
    );
}

#[test]
fn equations_in_octave_take_part_in_the_yawed_cases_alone() {
    let file = std::path::PathBuf::new;
    let tools = |octave| Tools {
        own: file(),
        library: file(),
        drivers: file(),
        cvode: None,
        python: None,
        exudyn: None,
        octave,
    };
    let one = solver(IN_OCTAVE).unwrap();
    let with = tools(Some((file(), file())));
    let cases: Vec<String> = names()
        .into_iter()
        .filter(|case| one.takes_part(&with, case))
        .collect();
    assert_eq!(cases.len(), 6, "{cases:?}");
    assert!(cases.iter().all(|case| case.ends_with("psi_0.012")), "{cases:?}");
    assert!(!one.takes_part(&tools(None), &cases[0]));
}

#[test]
fn the_c_interface_refuses_nothing_and_nonsense() {
    // SAFETY: null pointers and texts that end are what the functions allow.
    unsafe {
        assert!(race_open(std::ptr::null()).is_null());
        assert!(race_open(c"no such problem".as_ptr()).is_null());
        assert!(race_open(c"\xff".as_ptr()).is_null());
        race_close(std::ptr::null_mut());
        assert_eq!(race_dimension(std::ptr::null()), 0);
        assert_eq!(race_rows(std::ptr::null()), 0);
        assert!(race_time(std::ptr::null(), 1).is_nan());
        assert_eq!(
            race_start(std::ptr::null(), std::ptr::null_mut(), std::ptr::null_mut()),
            1
        );
        assert_eq!(
            race_rates(std::ptr::null_mut(), 0.0, std::ptr::null(), std::ptr::null_mut()),
            1
        );
        assert_eq!(
            race_jacobian(std::ptr::null_mut(), 0.0, std::ptr::null(), std::ptr::null_mut()),
            1
        );
    }
}

#[test]
fn the_c_interface_gives_the_equations() {
    // SAFETY: the handle is alive from open to close, and all vectors are as long as it says.
    unsafe {
        let handle = race_open(c"vdrun_toe_0_psi_0.012".as_ptr());
        assert!(!handle.is_null());
        let n = race_dimension(handle) as usize;
        assert_eq!((n, race_rows(handle)), (9, 1001));
        assert_eq!(race_time(handle, 1000), 10.0);
        let (mut start, mut scales, mut rates) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let mut matrix = vec![0.0; n * n];
        assert_eq!(race_start(handle, start.as_mut_ptr(), scales.as_mut_ptr()), 0);
        assert!(scales.iter().all(|scale| *scale > 0.0));
        assert_eq!(race_rates(handle, 0.1, start.as_ptr(), rates.as_mut_ptr()), 0);
        assert_eq!(race_jacobian(handle, 0.1, start.as_ptr(), matrix.as_mut_ptr()), 0);
        let mut equations = race::equations::Equations::named("vdrun_toe_0_psi_0.012").unwrap();
        let (mut expected, mut jacobian) = (vec![0.0; n], vec![0.0; n * n]);
        equations.rates(0.1, &start, &mut expected);
        equations.jacobian(0.1, &start, &mut jacobian).unwrap();
        assert_eq!((rates, matrix), (expected, jacobian));
        race_close(handle);
    }
}
