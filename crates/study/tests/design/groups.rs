//! Groups of values under one name.

use super::common::{HEAD, SHORT, parse, study};

fn grouped(vary: &str) -> String {
    format!(
        "{HEAD}sampling = \"full_factorial\"\n{SHORT}
[groups.state.rough]
friction.column = 0.5
friction.slope = 0.45
[groups.state.smooth]
friction = {{ column = 0.2, slope = 0.1 }}
[groups.state.given]
[vary]
{vary}\n"
    )
}

#[test]
fn analytic_a_name_sets_what_its_group_says() {
    let study = study(&grouped(
        "state = [\"given\", \"rough\", \"smooth\"]\nfriction.reference_speed = [\"0.001 in/s\", \"0.002 \
         in/s\"]",
    ));
    assert_eq!(study.count(), 6);
    let friction = |number: u64| {
        let case = study.case(number).unwrap().to_toml().unwrap();
        let from = case.find("[friction]").unwrap();
        case[from..from + 400].to_owned()
    };
    let set = |number: u64| study.overrides(number).join("; ");
    assert!(!set(0).contains("friction.column"), "{}", set(0));
    assert!(
        set(2).contains("friction.column=0.5; friction.slope=0.45"),
        "{}",
        set(2)
    );
    assert!(
        set(4).contains("friction={ column = 0.2, slope = 0.1 }"),
        "{}",
        set(4)
    );
    assert_ne!(friction(0), friction(2));
    assert_ne!(friction(2), friction(4));
    // The table has a column of names.
    let values = study.values(5);
    assert_eq!(values[0].as_ref().unwrap().shown(), "smooth");
}

#[test]
fn input_groups_that_are_not_there() {
    for (text, message, help) in [
        (
            grouped("state = [\"rough\", \"smoth\"]"),
            "no group `groups.state.smoth`",
            "did you mean \"smooth\"?",
        ),
        (
            grouped("friction.column = [0.2, 0.3]"),
            "no parameter takes the groups of `state`",
            "[groups.condition.worn]",
        ),
        (
            grouped("state = [\"rough\", \"smooth\"]")
                .replace("friction.slope = 0.45", "friction.slop = 0.45"),
            "no key `slop`",
            "slope",
        ),
    ] {
        let error = parse(&text).err().unwrap_or_else(|| panic!("accepted:\n{text}"));
        let problem = &error.problems()[0];
        assert!(problem.message().contains(message), "{}", problem.message());
        assert!(
            problem.advice().unwrap_or("").contains(help),
            "{:?}",
            problem.advice()
        );
        assert!(problem.line_and_column().is_some());
        assert_eq!(problem.source_name(), Some("some.toml"));
    }
}

/// Values of a list that need each other are tried together.
#[test]
fn input_variants_with_groups_are_tried_whole() {
    let text = format!(
        "{HEAD}sampling = \"list\"\n[groups.state.long]\nsimulation.duration = \"0.02 s\"\n\
         [[variants]]\nstate = \"long\"\nsimulation.output_interval = \"0.001 s\"\n"
    );
    assert_eq!(study(&text).count(), 1);
    let wrong = text.replace("\"0.001 s\"", "\"0.5 s\"");
    let error = parse(&wrong).expect_err("an interval longer than the run");
    assert!(error.problems()[0].line_and_column().is_some());
}
