//! The twelve runs of the thesis's table 4-1.
//!
//! Their names carry the thesis's sign of the toe, in which -0.2 is toe *out*; eq. 5-1 has it the
//! other way round. This file is the one place where the names are translated.

use super::problem::Problem;
use super::{Case, CaseError};
use quantity::nearest;
use std::path::Path;

struct Builtin {
    name: &'static str,
    damping: &'static str,
    toe: &'static str,
    yaw: &'static str,
}

const fn run(name: &'static str, damping: &'static str, toe: &'static str, yaw: &'static str) -> Builtin {
    Builtin {
        name,
        damping,
        toe,
        yaw,
    }
}

static BUILTIN: [Builtin; 12] = [
    run("vdrun_toe_-0.2_psi_0", "variable", "0.2 deg out", "0 rad"),
    run("vdrun_toe_0_psi_0", "variable", "0 deg", "0 rad"),
    run("vdrun_toe_0.2_psi_0", "variable", "0.2 deg in", "0 rad"),
    run("vdrun_toe_-0.2_psi_0.012", "variable", "0.2 deg out", "0.012 rad"),
    run("vdrun_toe_0_psi_0.012", "variable", "0 deg", "0.012 rad"),
    run("vdrun_toe_0.2_psi_0.012", "variable", "0.2 deg in", "0.012 rad"),
    run("cdrun_toe_-0.2_psi_0", "constant", "0.2 deg out", "0 rad"),
    run("cdrun_toe_0_psi_0", "constant", "0 deg", "0 rad"),
    run("cdrun_toe_0.2_psi_0", "constant", "0.2 deg in", "0 rad"),
    run("cdrun_toe_-0.2_psi_0.012", "constant", "0.2 deg out", "0.012 rad"),
    run("cdrun_toe_0_psi_0.012", "constant", "0 deg", "0.012 rad"),
    run("cdrun_toe_0.2_psi_0.012", "constant", "0.2 deg in", "0.012 rad"),
];

impl Builtin {
    fn title(&self) -> String {
        let toe = match self.toe.split_once(" deg") {
            Some((_, "")) | None => "no toe".to_string(),
            Some((_, direction)) => format!("toe{direction}"),
        };
        let yaw = if self.yaw == "0 rad" { "not yawed" } else { "yawed" };
        format!("{} damping, {toe}, {yaw}", self.damping)
    }

    /// The case file: what sets it apart from the others of its damping.
    fn text(&self) -> String {
        format!(
            "name = \"{}\"\ntitle = \"{}\"\n[wedge]\ndamping = \"{}\"\n[side_frame]\ntoe = \"{}\"\n\
             [bolster]\nyaw = \"{}\"\n",
            self.name,
            self.title(),
            self.damping,
            self.toe,
            self.yaw
        )
    }
}

/// The names of the built-in cases, variable damping first.
pub fn names() -> impl ExactSizeIterator<Item = &'static str> {
    BUILTIN.iter().map(|builtin| builtin.name)
}

/// Names and titles of the built-in cases.
pub fn list() -> impl ExactSizeIterator<Item = (&'static str, String)> {
    BUILTIN.iter().map(|builtin| (builtin.name, builtin.title()))
}

/// The built-in case of this name.
///
/// # Errors
/// There is none of this name; the help names the nearest, or all.
pub fn case(name: &str) -> Result<Case, CaseError> {
    case_with(name, &[])
}

/// The built-in case of this name with `--set` overrides (`path.key=value`).
///
/// # Errors
/// There is none of this name, or an override is wrong.
pub fn case_with(name: &str, overrides: &[String]) -> Result<Case, CaseError> {
    match BUILTIN.iter().find(|builtin| builtin.name == name) {
        Some(builtin) => Case::parse(&format!("{name}.toml"), &builtin.text(), Path::new(""), overrides),
        None => {
            let help = match nearest(name, names()) {
                Some(near) => format!("did you mean {near}?"),
                None => format!(
                    "the built-in cases are {}",
                    names().collect::<Vec<_>>().join(", ")
                ),
            };
            Err(Problem::new(format!("there is no built-in case \"{name}\""))
                .help(help)
                .into())
        }
    }
}
