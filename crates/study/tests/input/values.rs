//! Cases that programs make: values over a case, bare numbers in SI units.

use std::path::Path;

use study::case::{Case, CaseError, builtin};

fn over(base: Option<(&str, &str)>, values: &str) -> Result<Case, CaseError> {
    let (name, text) = base.unwrap_or(("case", ""));
    Case::of_values(name, text, Some(values), Path::new(""))
}

#[test]
fn bare_numbers_are_si_in_values_and_nowhere_else() {
    let case = over(
        None,
        "[wedge]\nangle = 0.5\nheight = 1\n[side_frame]\ntoe = -0.01",
    )
    .unwrap();
    assert_eq!(case.parameters.wedge.angle, 0.5);
    assert_eq!(case.parameters.wedge.height, 1.0);
    for line in ["angle = \"0.5 rad\"", "toe = \"0.01 rad in\""] {
        assert!(case.to_toml().contains(line), "{line}");
    }
    assert!(over(Some(("base.toml", "[wedge]\nangle = 0.5")), "").is_err());
    // What was typed is kept: the file of this case reads back to the same case.
    let text = case.to_toml();
    assert_eq!(Case::parse("case.toml", text, Path::new(""), &[]).unwrap(), case);
}

#[test]
fn values_win_over_the_case_below_and_leave_the_rest() {
    let text = builtin::text("cdrun_toe_out_0.2_psi_0.012").unwrap();
    let base = builtin::case("cdrun_toe_out_0.2_psi_0.012").unwrap();
    let case = over(Some(("base.toml", text)), "[friction]\ncolumn = 0.3").unwrap();
    assert_eq!(case.parameters.column_friction.coefficient, 0.3);
    let mut same = case.parameters.clone();
    same.column_friction = base.parameters.column_friction;
    assert_eq!(same, base.parameters);
    assert_eq!(
        case.to_toml().replace("column = 0.3 ", "column = 0.4 "),
        base.to_toml()
    );
    let ramp = "[bolster]\nvertical = { shape = \"ramp\", amplitude = 0.02, duration = 1.0 }";
    assert!(
        over(Some(("base.toml", text)), ramp).is_ok(),
        "another shape replaces the motion"
    );
}

#[test]
fn a_stiffness_takes_the_place_of_a_table_and_the_reverse() {
    let table = "[control_coil]\ntable = [[0.0, 0.0], [0.1, 4e4]]";
    let with_table = over(None, table).unwrap();
    let with_table = with_table.to_toml();
    let again = over(Some(("base.toml", with_table)), "[control_coil]\nstiffness = 5e5").unwrap();
    let back = over(Some(("base.toml", again.to_toml())), table).unwrap();
    assert_eq!(back.to_toml(), with_table);
}

#[test]
fn mistakes_are_shown_in_the_text_they_were_made_in() {
    let text = "[wedge]\nangle = \"3 in\"\n";
    let error = over(
        Some(("base.toml", text)),
        "[friction]\ncolumn = nan\n[wedge]\nheight = inf",
    )
    .unwrap_err();
    let mut sources: Vec<_> = error
        .problems()
        .iter()
        .filter_map(|one| one.source_name())
        .collect();
    sources.sort_unstable();
    assert_eq!(sources, ["base.toml", "values", "values"]);
}
