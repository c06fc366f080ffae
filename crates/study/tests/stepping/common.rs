//! Cases and loops of the tests of driven wedges.

use study::case::{Case, builtin};
use study::stepping::{Neighbours, SteppedWedge};

/// A yawed case of each damping, a straight one, and one with bristles.
pub const YAWED: &str = "cdrun_toe_out_0.2_psi_0.012";

/// Returns a built-in case with overrides.
pub fn case(name: &str, overrides: &[&str]) -> Case {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    builtin::case_with(name, &overrides).unwrap()
}

/// Returns the places in the case's own motions.
pub fn place(case: &Case, time: f64) -> Neighbours {
    Neighbours::of(&case.parameters, time)
}

/// Drives a wedge along the case's own motions from where it is to a time, in steps of a length.
pub fn drive(case: &Case, wedge: &mut SteppedWedge, end: f64, step: f64) {
    let first = (wedge.time() / step).round() as u64;
    let last = (end / step).round() as u64;
    for number in first + 1..=last {
        let time = number as f64 * step;
        wedge.step_to(&place(case, time), time).unwrap();
    }
}

/// Returns a wedge of a case at a time on its way.
pub fn at(case: &Case, end: f64, step: f64) -> SteppedWedge {
    let mut wedge = SteppedWedge::new(case).unwrap();
    drive(case, &mut wedge, end, step);
    wedge
}

/// Returns the value of a column.
pub fn value(wedge: &mut SteppedWedge, name: &str) -> f64 {
    let row = wedge.row();
    let index = wedge
        .columns()
        .iter()
        .position(|column| column.name == name)
        .unwrap_or_else(|| panic!("no column {name}"));
    row[index]
}
