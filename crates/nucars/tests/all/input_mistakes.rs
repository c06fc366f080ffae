//! Mistakes put into the printed files by hand: found, at their places, and explained.

use crate::common;
use common::{CONSTANT, CONSTANT_3D, VERTICAL, data, has, input, list, run, system, text};
use nucars::{Findings, Severity};

/// The finding is an error in the changed line.
#[track_caller]
fn found(findings: &Findings, text: &str, changed: &str, words: &[&str]) {
    let before = &text[..=text.find(changed).unwrap()];
    let first = before.lines().count().max(1);
    let lines = first..=first + changed.lines().count() + 1;
    let fits = lines
        .into_iter()
        .any(|line| has(findings, Severity::Error, line, words));
    assert!(fits, "{words:?} near line {first} not in\n{}", list(findings));
    for finding in findings.list() {
        assert!(finding.place().span.end as usize <= text.len());
        assert!(finding.advice().is_some(), "{finding}");
    }
}

#[test]
fn mistakes_in_every_section_of_a_system_are_found() {
    let cases: &[(&str, &str, &[&str])] = &[
        // Bodies.
        (
            "\\BODY DATA\n3\n",
            "\\BODY DATA\n4\n",
            &["the count is 4, but 3 bodies follow", "write 3"],
        ),
        (
            "\\BODY DATA\n3\n",
            "\\BODY DATA\n2\n",
            &["the count is 2, but 1 more bodies follow"],
        ),
        (
            "\\BODY DATA\n3\n",
            "\\BODY DATA\nthree\n",
            &["`three` is not a whole number"],
        ),
        ("319.175", "heavy", &["`heavy` is not a number"]),
        ("319.175", "0.0", &["the mass of body 1 is 0"]),
        (
            "6 1 2 3 4 5 6   319.175",
            "6 1 2 3 4 5 5   319.175",
            &["body 1 has the degree of freedom 5 twice"],
        ),
        (
            "6 1 2 3 4 5 6   319.175",
            "6 1 2 3 4 5 12   319.175",
            &["`12` is not a degree of freedom"],
        ),
        (
            "6 1 2 3 4 5 6   319.175",
            "7 1 2 3 4 5 6   319.175",
            &["`319.175` is not a degree of freedom"],
        ),
        ("4 ' Rgt", "3 ' Rgt", &["body 3 stands here a second time"]),
        (
            "' Half Car+Bolst'",
            "' Half Car+Bolst",
            &["has no second one in its line"],
        ),
        (
            "' Half Car+Bolst'",
            "HalfCar",
            &["`HalfCar` is not a text in quotation marks"],
        ),
        // Input bodies.
        (
            "5  1 2 3 4 5   1 2 3 4 5  .F.\n  8",
            "5  1 2 3 4 5   1 2 3 4 5  no\n  8",
            &["`no` is not `.T.` or `.F.`"],
        ),
        (
            "5  1 2 3 4 5   1 2 3 4 5  .F.\n  8",
            "5  1 2 3 4 5   1 2 3 4  .F.\n  8",
            &["`.F.` is not a whole number"],
        ),
        // Connections.
        (
            "\n50\n",
            "\n51\n",
            &["the count is 51, but 50 connections follow"],
        ),
        (
            "\n50\n",
            "\n49\n",
            &["the count is 49, but 1 more connections follow"],
        ),
        (
            "  1.1  1  3   -35.0",
            "  1.9  1  3   -35.0",
            &["`1.9` is not a type", "1, 1.1, 1.2, 1.3, 6.3"],
        ),
        (
            "  1.1  1  3   -35.0",
            "  1.1  1  5   -35.0",
            &["refers to body 5", "bodies 1, 3, 4, 7, 8, 9"],
        ),
        (
            "  1.1  1  3   -35.0",
            "  1.1  1  1   -35.0",
            &["connects body 1 with itself"],
        ),
        (
            "3 1 5 6 8 9 10\n118",
            "3 1 5 6 8 9\n118",
            &["connection 117 ends before"],
        ),
        (
            "3 1 5 6 8 9 10\n118",
            "3 1 5 6 8 9 99\n118",
            &["refers to characteristic 99"],
        ),
        (
            "3 1 5 6 8 9 10\n118",
            "3 1 5 6 8 9 14\n118",
            &[
                "connection 117 of type 1.1 cannot use characteristic 14",
                "type 6.8",
            ],
        ),
        (
            "3 2 14\n128",
            "3 1 14\n128",
            &["directions of connection 127 are not those of type 6.8"],
        ),
        (
            "118 'Ld R",
            "117 'Ld R",
            &["connection 117 stands here a second time"],
        ),
        // Characteristics.
        (
            "   8   11   12   1.0E09",
            "   8   77   12   1.0E09",
            &["refers to function 77"],
        ),
        (
            "   8   11   12   1.0E09  -1.0E09",
            "   8   11   12   -1.0E09  1.0E09",
            &["is below that in compression"],
        ),
        (
            "   8   11   12   1.0E09",
            "   8   11   12   1.0O09",
            &["`1.0O09` is not a number"],
        ),
        (
            "3.7022E3  1.0E6",
            "3.7022E3",
            &["characteristic 14 ends before its"],
        ),
        (
            "37.5  3.7022E3",
            "137.5  3.7022E3",
            &["wedge angle of characteristic 14 is 137.5"],
        ),
        (
            "1.0E06  1.0E03  0.5",
            "1.0E06  1.0E03  -0.5",
            &["coefficient of friction of characteristic 15 is -0.5"],
        ),
        (
            "1000.0  0.031382",
            "0.031382  1000.0",
            &["the gap of characteristic 16"],
        ),
        // Functions.
        (
            "0.0        0.042        1.042",
            "0.0        1.042        0.042",
            &["do not increase: 0.042 comes after 1.042"],
        ),
        (
            "  13   3            0.0",
            "  13   4            0.0",
            &["function 13 ends before its"],
        ),
        (
            "  13   3            0.0",
            "  13   2            0.0",
            &["function 13"],
        ),
        (
            "  13   3            0.0",
            "  99   3            0.0",
            &["refers to function 13"],
        ),
        (
            "0.0        0.042",
            "3*0.0        0.042",
            &["`3*0.0` is not a number", "repeat counts"],
        ),
        // Sections.
        ("\\PWL DATA", "\\PWL DATE", &["no section `\\PWL DATA`"]),
        (
            "\\PWL DATA",
            "$\\PWL DATA",
            &["no section `\\PWL DATA`", "take away the `$`"],
        ),
        (
            "\\PWL DATA\n",
            "\\BODY DATA\n!",
            &["`\\BODY DATA` stands here a second time"],
        ),
    ];
    let whole = text(CONSTANT);
    for (old, new, words) in cases {
        assert!(whole.contains(old), "{old:?}");
        let changed = whole.replacen(old, new, 1);
        let findings = system(&changed).findings;
        if words[0].contains("refers to") || words[0].contains("no section") {
            assert!(
                has(&findings, Severity::Error, 0, words),
                "{words:?} not in\n{}",
                list(&findings)
            );
        } else {
            found(&findings, &changed, new, words);
        }
    }
}

#[test]
fn one_mistake_does_not_hide_others_nor_bring_more() {
    let changed = text(CONSTANT)
        .replacen("319.175", "x", 1)
        .replacen(
            "118 'Ld R Bol-SF LPY'  1.1  1  4",
            "118 'Ld R Bol-SF LPY'  1.1  1  y",
            1,
        )
        .replacen("0.0        0.042        1.042", "0.0        z        1.042", 1);
    let findings = system(&changed).findings;
    let errors: Vec<_> = findings
        .list()
        .iter()
        .filter(|one| one.severity() == Severity::Error)
        .collect();
    let marked: Vec<_> = errors.iter().map(|error| error.place().text()).collect();
    assert_eq!(marked, ["x", "y", "z"], "{}", list(&findings));
}

#[test]
fn mistakes_in_inputs_runs_and_data_are_found() {
    let inputs: &[(&str, &str, &[&str])] = &[
        ("\n  6\n", "\n  7\n", &["the count is 7, but 6 histories"]),
        ("\n  6\n", "\n  5\n", &["the count is 5, but more"]),
        (
            "  3  1  1",
            "  3  2  1",
            &["history 3 has 2 segments, but segment 2 is missing"],
        ),
        ("  3  1  1", "  3  1  3", &["`3` is not 1 (time) or 2 (distance)"]),
        (
            "\n  3  1  1",
            "\n  2  01  1",
            &["history 2 stands here a second time"],
        ),
        ("  1  4  2000.0", "  1  5  2000.0", &["`5` is not a shape"]),
        ("  1  4  2000.0", "  1  4  -2000.0", &["ends at -2000"]),
        ("  1  4  2000.0", "  2  4  2000.0", &["stands in place 1"]),
        ("0.31831  1.0", "0.31831", &["segment"]),
        ("0.31831  1.0", "0.31831  1.0  9", &["more values"]),
    ];
    for (old, new, words) in inputs {
        let changed = text(VERTICAL).replacen(old, new, 1);
        assert_ne!(changed, text(VERTICAL), "{old:?}");
        found(&input(&changed), &changed, new, words);
    }
    let asked: &[(&str, &str, &[&str])] = &[
        (
            "\n16\n    127.1",
            "\n17\n    127.1",
            &["the count is 17, but 16 components"],
        ),
        ("    127.1 127.2", "    927.1 127.2", &["no connection 927"]),
        (
            "    127.1 127.2",
            "    127.3 127.2",
            &["connection 127 has 2 components, not 3", ".1 z, .2 y"],
        ),
        ("    127.1 127.2", "    127 127.2", &["`127` is not a component"]),
        (
            "    127.1 127.2",
            "    127.2 127.2",
            &["component 127.2 stands here a second time"],
        ),
        ("Nest' 1 4", "Nest' 3 4", &["`3` is not 1"]),
        ("Nest' 1 4", "Nest' 1 5", &["sum no. 1"]),
        ("\n2\n'Ld", "\n8\n'Ld", &["the count is 8, but 6 sums"]),
    ];
    for (old, new, words) in asked {
        let changed = text("sngl_trk_68.dat").replacen(old, new, 1);
        assert_ne!(changed, text("sngl_trk_68.dat"), "{old:?}");
        found(&data(&changed, CONSTANT), &changed, new, words);
    }
    let switched_on = text("sngl_trk_69.dat").replace("$\\DOF VELOCITY", "\\DOF VELOCITY");
    let findings = data(&switched_on, CONSTANT_3D);
    for words in [
        "the count is 52, but 31",
        "no body 2",
        "body 1 has no degree of freedom 7.01",
    ] {
        assert!(
            has(&findings, Severity::Error, 0, &[words]),
            "{words}: {}",
            list(&findings)
        );
    }
    let name = "bolst_wedge_sf_bolst-vert-displ_69_var.run";
    let runs: &[(&str, &str, &[&str])] = &[
        (
            "'sngl_trk.DAT'",
            "sngl_trk.DAT",
            &["not a text in quotation marks"],
        ),
        (
            "\\DATA FILE\n'sngl_trk.DAT'\n",
            "\\DATA FILE\n",
            &["ends before its file name"],
        ),
        ("\\STEPPING", "\\STEPING", &["no section `\\STEPPING CONSTANTS`"]),
        ("0.01 20.0 0.1", "0.01 0.0 0.1", &["end of the run is 0"]),
        (
            "0.01 20.0 0.1",
            "0.01 20.0",
            &["ends before its interval of results"],
        ),
        ("1 0 .F.", "1 0 5", &["`5` is not `.T.` or `.F.`"]),
    ];
    for (old, new, words) in runs {
        let changed = text(name).replacen(old, new, 1);
        assert_ne!(changed, text(name), "{old:?}");
        let findings = run(&changed);
        assert!(
            has(&findings, Severity::Error, 0, words),
            "{words:?} not in {}",
            list(&findings)
        );
    }
}

#[test]
fn hidden_and_foreign_sections_are_reported() {
    let moved = text(CONSTANT).replace("\\PWL DATA", " \\PWL DATA");
    let findings = system(&moved).findings;
    assert!(
        has(&findings, Severity::Warning, 0, &["not in the first column"]),
        "{}",
        list(&findings)
    );
    let foreign = format!("{}\\STEPPING CONSTANTS\n1 2 3\n\\PWM DATA\n", text(CONSTANT));
    let read = system(&foreign);
    assert!(has(
        &read.findings,
        Severity::Warning,
        0,
        &["STEPPING CONSTANTS", "belongs into a run file"]
    ));
    assert!(has(
        &read.findings,
        Severity::Warning,
        0,
        &["PWM DATA", "did you mean `\\PWL DATA`?"]
    ));
    assert_eq!(read.tree.other.len(), 2);
    let none = system("just a text\n").findings;
    assert!(has(&none, Severity::Error, 1, &["no keyword"]), "{}", list(&none));
    let empty = system(" \n\t").findings;
    assert!(
        has(&empty, Severity::Error, 1, &["the file is empty"]),
        "{}",
        list(&empty)
    );
    assert_eq!([none.list().len(), empty.list().len()], [1, 1]);
}

#[test]
fn text_within_the_records_is_reported() {
    // A line that lost its comment mark ends the list of functions.
    let changed = text(CONSTANT).replace("! Yaw, with stop\n  22", "Yaw, with stop\n  22");
    let findings = system(&changed).findings;
    assert!(
        has(&findings, Severity::Error, 0, &["section ends at `Yaw`"]),
        "{}",
        list(&findings)
    );
    let errors = findings.count(Severity::Error);
    assert_eq!(
        errors,
        1,
        "what refers to the lost functions is not an error too: {}",
        list(&findings)
    );
}
