//! The twelve runs of the thesis's table 4-1.
//!
//! Their names say the direction of the toe in words. The thesis's files have a sign instead, in which -0.2
//! is toe *out*; eq. 5-1 has it the other way round. This file is the one place where its names are
//! translated.

use std::borrow::Cow;

use super::{BuiltIn, CaseGroup};

/// The name of the group.
pub(super) const NAME: &str = "thesis";

/// Name, damping, toe, yaw.
const RUNS: [[&str; 4]; 12] = [
    ["vdrun_toe_out_0.2_psi_0", "variable", "0.2 deg out", "0 rad"],
    ["vdrun_toe_0_psi_0", "variable", "0 deg", "0 rad"],
    ["vdrun_toe_in_0.2_psi_0", "variable", "0.2 deg in", "0 rad"],
    [
        "vdrun_toe_out_0.2_psi_0.012",
        "variable",
        "0.2 deg out",
        "0.012 rad",
    ],
    ["vdrun_toe_0_psi_0.012", "variable", "0 deg", "0.012 rad"],
    [
        "vdrun_toe_in_0.2_psi_0.012",
        "variable",
        "0.2 deg in",
        "0.012 rad",
    ],
    ["cdrun_toe_out_0.2_psi_0", "constant", "0.2 deg out", "0 rad"],
    ["cdrun_toe_0_psi_0", "constant", "0 deg", "0 rad"],
    ["cdrun_toe_in_0.2_psi_0", "constant", "0.2 deg in", "0 rad"],
    [
        "cdrun_toe_out_0.2_psi_0.012",
        "constant",
        "0.2 deg out",
        "0.012 rad",
    ],
    ["cdrun_toe_0_psi_0.012", "constant", "0 deg", "0.012 rad"],
    [
        "cdrun_toe_in_0.2_psi_0.012",
        "constant",
        "0.2 deg in",
        "0.012 rad",
    ],
];

/// Returns our name of a run that is called by its name in the thesis (`vdrun_toe_-0.2_psi_0` is toe out),
/// and any other name as it is.
pub fn own_name(name: &str) -> Cow<'_, str> {
    for (signed, in_words) in [
        ("run_toe_-0.2_", "run_toe_out_0.2_"),
        ("run_toe_0.2_", "run_toe_in_0.2_"),
    ] {
        if name.contains(signed) {
            return name.replace(signed, in_words).into();
        }
    }
    name.into()
}

pub(super) fn group() -> CaseGroup {
    CaseGroup {
        name: NAME,
        title: "The twelve runs of the thesis (table 4-1)",
        look_at: "Compare the width of the loops by toe: going up with constant damping, toe out gives the \
                  greatest force, toe in the least. With variable damping look for the lift-off after 3 s, \
                  where the wedge rings on its coil and nothing is lost.",
        cases: RUNS.iter().map(built_in).collect(),
    }
}

/// Returns the case file, which holds what sets the case apart from the others of its damping.
fn built_in([name, damping, toe, yaw]: &[&'static str; 4]) -> BuiltIn {
    let direction = match toe.split_once(" deg") {
        Some((_, "")) | None => "no toe".to_string(),
        Some((_, direction)) => format!("toe{direction}"),
    };
    let yawed = if *yaw == "0 rad" { "not yawed" } else { "yawed" };
    let title = format!("{damping} damping, {direction}, {yawed}");
    BuiltIn::new(
        (*name).to_owned(),
        title,
        &format!(
            "[wedge]\ndamping = \"{damping}\"\n[side_frame]\ntoe = \"{toe}\"\n[bolster]\nyaw = \"{yaw}\"\n"
        ),
    )
}
