//! What is wrong or doubtful in the printed files, and mistakes put in by hand.

#![allow(clippy::unwrap_used)]

use nucars::read::{Read, read_data, read_input, read_run, read_system};
use nucars::source::Source;
use nucars::tree::{DofKind, SystemFile};
use nucars::{Finding, Findings, Severity, builtin, check};

const CONSTANT: &str = "Bolst_wedge_sf_68_constant.sys";
const VARIABLE: &str = "Bolst_wedge_sf_68_variable.sys";
const CONSTANT_3D: &str = "bolst_wedge_sf_69_const.sys";
const VARIABLE_3D: &str = "bolst_wedge_sf_69_var.sys";
const VERTICAL: &str = "bolst_displ_input3.inp";
const YAW: &str = "bolst_displ_input36.inp";

fn text(name: &str) -> &'static str {
    builtin::text(name).unwrap()
}

/// All findings of a system file's text.
fn system(text: &str) -> Read<SystemFile> {
    let read = read_system(&Source::from_text("a.sys", text).unwrap());
    let more = check::system(&read);
    read.with(more)
}

fn input(text: &str) -> Findings {
    let read = read_input(&Source::from_text("a.inp", text).unwrap());
    let more = check::input(&read);
    read.with(more).findings
}

fn data(text: &str, system_name: &str) -> Findings {
    let read = read_data(&Source::from_text("a.dat", text).unwrap());
    let alone = check::data(&read);
    let more = check::data_of_system(&read, &system(self::text(system_name)).tree);
    read.with(alone).with(more).findings
}

fn run(text: &str) -> Findings {
    let read = read_run(&Source::from_text("a.run", text).unwrap());
    let more = check::run(&read);
    read.with(more).findings
}

fn list(findings: &Findings) -> String {
    let line = |finding: &Finding| {
        let (line, column) = finding.place().line_and_column();
        format!(
            "{line}:{column}: {} [{}] {finding} | {:?} | {}\n",
            finding.severity(),
            finding.code_name(),
            finding.place().text(),
            finding.advice().unwrap_or("")
        )
    };
    findings.list().iter().map(line).collect()
}

/// The codes of findings of this severity, in order and each once.
fn codes(findings: &Findings, severity: Severity) -> Vec<&'static str> {
    let own = findings
        .list()
        .iter()
        .filter(|finding| finding.severity() == severity);
    let mut codes: Vec<_> = own.map(Finding::code_name).collect();
    codes.sort_unstable();
    codes.dedup();
    codes
}

/// Whether one finding has this severity, this line of the text, and all these words.
fn has(findings: &Findings, severity: Severity, line: usize, words: &[&str]) -> bool {
    findings.list().iter().any(|finding| {
        let all = format!("{finding} {}", finding.advice().unwrap_or(""));
        finding.severity() == severity
            && (line == 0 || finding.place().line_and_column().0 == line)
            && words.iter().all(|word| all.contains(word))
    })
}

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
    // What is switched off: 52 announced, 31 listed, of which 3 flexible modes and the 14 of bodies 2, 5, 6 do not exist.
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
fn hidden_and_foreign_sections_are_told() {
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
fn text_within_the_records_is_told() {
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
