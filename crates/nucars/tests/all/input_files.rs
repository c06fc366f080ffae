//! The files of the thesis's appendices: counts, values, and the way out and back.

use nucars::read::{AnyFile, FileKind, Read, read, read_data, read_input, read_run, read_system};
use nucars::source::SourceText;
use nucars::tree::{DataFile, DataRequest, Element, HistoryShape, InputFile, Law, RunFile, SystemFile, Toe};
use nucars::{Severity, builtin, write};

const SYSTEMS: [&str; 4] = [
    "Bolst_wedge_sf_68_constant.sys",
    "Bolst_wedge_sf_68_variable.sys",
    "bolst_wedge_sf_69_const.sys",
    "bolst_wedge_sf_69_var.sys",
];

fn system(name: &str) -> Read<SystemFile> {
    read_system(&builtin::source(name).unwrap())
}

fn input(name: &str) -> InputFile {
    read_input(&builtin::source(name).unwrap()).strict().unwrap()
}

fn data(name: &str) -> DataFile {
    read_data(&builtin::source(name).unwrap()).strict().unwrap()
}

fn run(name: &str) -> RunFile {
    read_run(&builtin::source(name).unwrap()).strict().unwrap()
}

#[test]
fn all_files_are_read_without_errors() {
    for name in builtin::names() {
        let source = builtin::source(name).unwrap();
        let kind = FileKind::of(&source).unwrap();
        let findings = match read(&source, kind) {
            AnyFile::System(read) => read.findings,
            AnyFile::Input(read) => read.findings,
            AnyFile::Data(read) => read.findings,
            AnyFile::Run(read) => read.findings,
        };
        for finding in findings.list() {
            let (line, _) = finding.place().line_and_column();
            println!("{name}:{line}: {}: {finding}", finding.severity());
        }
        assert!(!findings.has_errors(), "{name}: {:?}", findings.list());
    }
}

#[test]
fn golden_counts() {
    // 3 bodies, 3 input bodies, 50 connections; characteristics and functions differ.
    for (name, characteristics, functions) in [
        (SYSTEMS[0], 12, 11),
        (SYSTEMS[1], 12, 12),
        (SYSTEMS[2], 13, 13),
        (SYSTEMS[3], 13, 13),
    ] {
        let file = system(name).strict().unwrap();
        assert_eq!(file.bodies.len(), 3, "{name}");
        assert_eq!(file.input_bodies.len(), 3, "{name}");
        assert_eq!(file.connections.len(), 50, "{name}");
        assert_eq!(file.characteristics.len(), characteristics, "{name}");
        assert_eq!(file.piecewise_linear.len(), functions, "{name}");
        let of = |code: &str| {
            file.connections
                .iter()
                .filter(|connection| connection.element.code() == code)
                .count()
        };
        let wedge = if name.contains("68") { "6.8" } else { "6.9" };
        let counts = [of("1"), of("1.1"), of("1.2"), of("1.3"), of("6.5"), of(wedge)];
        assert_eq!(counts, [16, 6, 8, 8, 8, 4], "{name}");
    }
    for name in ["bolst_displ_input3.inp", "bolst_displ_input36.inp"] {
        assert_eq!(input(name).histories.len(), 6);
    }
    for (name, counts) in [
        ("sngl_trk_68.dat", [16, 12, 8]),
        ("sngl_trk_69.dat", [20, 16, 12]),
    ] {
        let mut found = Vec::new();
        let mut sums_found = None;
        for section in data(name).active() {
            match &section.request {
                DataRequest::Components {
                    count, components, ..
                } => {
                    assert_eq!(*count.unwrap() as usize, components.len());
                    found.push(components.len());
                }
                DataRequest::Sums { count, sums } => sums_found = Some((*count.unwrap(), sums.len())),
                other => panic!("{other:?}"),
            }
        }
        assert_eq!(found, counts, "{name}");
        assert_eq!(sums_found, Some((2, 6)), "{name}");
    }
}

#[test]
fn values_as_printed() {
    let file = system(SYSTEMS[0]).strict().unwrap();
    let body = file.body(1).unwrap();
    assert_eq!((body.name.as_str(), *body.mass), (" Half Car+Bolst", 319.175));
    assert_eq!(
        body.inertia.map(|inertia| inertia.value),
        [922_760.0, 8_350_204.0, 8_352_760.0]
    );
    assert_eq!(body.position.map(|position| position.value), [-35.0, 0.0, 83.0]);
    assert_eq!(body.dofs.len(), 6);
    let central = file.input_body(8).unwrap();
    assert_eq!(
        central
            .histories
            .iter()
            .map(|history| history.value)
            .collect::<Vec<_>>(),
        [1, 2, 3, 4, 5, 6]
    );
    assert!(!*central.lag);
    let group = file.connection(117).unwrap();
    let characteristics: Vec<u32> = group.element.characteristics().iter().map(|one| **one).collect();
    assert_eq!(characteristics, [8, 9, 10]);
    assert!(matches!(group.element, Element::ParallelGroup(_)));

    let Law::StickSlipWedge {
        coil,
        angle,
        force,
        stiffness,
        toe,
        normal_limit,
        ..
    } = file.characteristic(14).unwrap().law
    else {
        panic!("type 6.8 expected")
    };
    assert_eq!(
        (*coil, *angle, *force, *stiffness, *normal_limit),
        (0, 37.5, 3702.2, 1e6, 1e5)
    );
    assert_eq!(*toe, Toe::Out);
    let Law::Gap {
        damping, high, low, ..
    } = file.characteristic(16).unwrap().law
    else {
        panic!("type 1.2 expected")
    };
    assert_eq!((*damping, *high, *low), (19, 1000.0, 0.031382));

    let file = system(SYSTEMS[3]).strict().unwrap();
    let Law::StickSlipWedge3d {
        coil,
        face,
        variable,
        direction,
        ..
    } = file.characteristic(114).unwrap().law
    else {
        panic!("type 6.9 expected")
    };
    assert_eq!((*coil, *face, *variable, *direction), (17, 24, true, -1.0));
    let names = [
        "bolst_displ_input_36.INP",
        "sngl_trk.DAT",
        "bolst_wedge_sf_69_var.SYS",
    ];
    let file = run("bolst_wedge_sf_bolst-vrt-displ-w-yaw_69_var.run");
    assert_eq!(
        [file.input, file.data, file.system].map(|name| name.unwrap().value),
        names
    );
    let stepping = file.stepping.unwrap();
    assert_eq!(
        (*stepping.step, *stepping.end, *stepping.output),
        (0.01, 20.0, 0.1)
    );

    let yaw = input("bolst_displ_input36.inp");
    let segment = &yaw.history(6).unwrap().segments[0];
    assert_eq!((*segment.shape, *segment.amplitude), (HistoryShape::Bend, 0.012));
    assert_eq!(
        segment.coefficients.map(|coefficient| coefficient.value),
        [0.1, 100.0]
    );
    assert_eq!(*yaw.history(3).unwrap().segments[0].shape, HistoryShape::Ssin);
}

#[test]
fn functions_have_the_slopes_and_zeros_of_the_thesis() {
    let file = system(SYSTEMS[0]).strict().unwrap();
    let coil = file.function(16).unwrap();
    assert!(!coil.is_mirrored());
    // 15403.78 lb at rest; 6500 lb/in pressed, 6390.2 lb/in released, 6561 lb/in at the end.
    assert!((coil.value(0.0) + 15_403.78).abs() < 1e-9);
    assert!((coil.slope(-0.5) - 6500.0).abs() < 0.1);
    assert!((coil.slope(0.5) - 6390.2).abs() < 0.1);
    assert!((coil.slope(2.4) - 6561.0).abs() < 0.1);
    // No point below 0: the slope goes on, 5.0e5 lb/in.
    let bearing = file.function(18).unwrap();
    assert!(!bearing.is_mirrored());
    assert!((bearing.slope(-1.0) - 5.0e5).abs() < 10.0);
    assert!(bearing.value(0.031_382).abs() < 1e-9);
    // (0, 0) first: mirrored; and on beyond the last point.
    let input = file.function(23).unwrap();
    assert!(input.is_mirrored());
    assert_eq!((input.value(-2.0), input.value(3.0)), (-2e6, 3e6));
    // The toe is 0.2 degrees.
    let file = system(SYSTEMS[2]).strict().unwrap();
    let toe = (-file.function(24).unwrap().slope(0.0)).atan().to_degrees();
    assert!((toe - 0.2).abs() < 1e-6, "{toe}");
}

#[test]
fn written_and_read_again_is_the_same() {
    for name in builtin::names() {
        let source = builtin::source(name).unwrap();
        let again = |text: String| SourceText::from_text(name, text).unwrap();
        match read(&source, FileKind::of(&source).unwrap()) {
            AnyFile::System(read) => {
                let text = write::write_system(&read.tree);
                assert!(read_system(&again(text)).strict().unwrap() == read.tree, "{name}");
            }
            AnyFile::Input(read) => {
                let text = write::write_input(&read.tree);
                assert!(read_input(&again(text)).strict().unwrap() == read.tree, "{name}");
            }
            AnyFile::Data(read) => {
                let text = write::write_data(&read.tree);
                assert!(read_data(&again(text)).strict().unwrap() == read.tree, "{name}");
            }
            AnyFile::Run(read) => {
                let text = write::write_run(&read.tree);
                assert!(read_run(&again(text)).strict().unwrap() == read.tree, "{name}");
            }
        }
    }
}

#[test]
fn commented_elements_can_be_switched_on() {
    // The older wedges: type 6.3 with one coefficient, type 6.7 with two and toe.
    let text = builtin::text(SYSTEMS[0]).unwrap();
    let new = "  14    0    0   37.5  3.7022E3  1.0E6  1.0E3  0.40  0.40  .T.  1.0D5";
    assert!(text.contains(new));
    for (kind, record) in [
        ("6.3", "! 14 0 0 37.5 3.640E03 1.0E04 0.40\n"),
        ("6.7", "! 14 0 0 37.5 2.898E3 1.0E04 0.40 0.40 .T.\n"),
    ] {
        assert!(text.contains(record));
        let changed = text.replace("  6.8  1", &format!("  {kind}  1")).replace(new, "");
        let changed = changed.replace(record, &record[1..]);
        let file = read_system(&SourceText::from_text("older.sys", changed).unwrap())
            .strict()
            .unwrap();
        assert_eq!(file.connection(127).unwrap().element.code(), kind);
        match file.characteristic(14).unwrap().law {
            Law::ViscousWedge {
                force,
                viscosity,
                friction,
                ..
            } => {
                assert_eq!((kind, *force, *viscosity, *friction), ("6.3", 3640.0, 1e4, 0.4));
            }
            Law::ViscousToeWedge { viscosity, toe, .. } => {
                assert_eq!((kind, *viscosity, *toe), ("6.7", 1e4, Toe::Out));
            }
            ref other => panic!("{other:?}"),
        }
    }
}

#[test]
fn other_bytes_read_the_same() {
    for name in SYSTEMS {
        let text = builtin::text(name).unwrap();
        let plain = system(name).tree;
        let windows = text.replace('\n', "\r\n");
        let old_mac = text.replace('\n', "\r");
        // The names have blanks too.
        let tabs = text.lines().map(|line| {
            if line.contains('\'') {
                line.to_owned()
            } else {
                line.replace(' ', "\t")
            }
        });
        let tabs = tabs.collect::<Vec<_>>().join("\n");
        let marked = format!("\u{feff}{text}");
        let upper = text.replace("\n\\BODY DATA", "\n\\Body  Data  ");
        for changed in [windows, old_mac, tabs, marked, upper] {
            let read = read_system(&SourceText::from_text(name, changed).unwrap());
            let tree = read.strict().unwrap();
            assert!(tree.connections == plain.connections, "{name}");
            assert!(tree.bodies == plain.bodies, "{name}");
            assert!(tree.piecewise_linear == plain.piecewise_linear, "{name}");
        }
        // Latin-1: a degree sign and an umlaut, which are no UTF-8.
        let mut bytes = text.replace("Half Car+Bolst", "Half Car+Tr?ger").into_bytes();
        let at = bytes.windows(4).position(|four| four == b"Tr?g").unwrap();
        bytes[at + 2] = 0xe4;
        bytes.extend_from_slice(b"! 0.2\xb0\n");
        let read = read_system(&SourceText::from_bytes(name, bytes).unwrap());
        assert_eq!(read.findings.count(Severity::Error), 0);
        assert_eq!(read.tree.body(1).unwrap().name.value, " Half Car+Träger");
        assert!(read.tree.connections == plain.connections);
    }
}

#[test]
fn utf_16_is_read() {
    for big in [false, true] {
        let marked = format!("\u{feff}{}", builtin::text(SYSTEMS[0]).unwrap());
        let bytes = |unit: u16| {
            if big {
                unit.to_be_bytes()
            } else {
                unit.to_le_bytes()
            }
        };
        let bytes = marked.encode_utf16().flat_map(bytes).collect();
        let read = read_system(&SourceText::from_bytes(SYSTEMS[0], bytes).unwrap());
        assert!(read.strict().unwrap() == system(SYSTEMS[0]).tree);
    }
}

/// The text with other line breaks where Fortran's list-directed input allows them.
#[test]
fn records_wrap_over_lines() {
    let changes = [
        // A connection over three lines, one of them a comment.
        (
            "117 'Ld L Bol-SF LPY'  1.1  1  3   -35.0    39.5    18.0   3 1 5 6 8 9 10",
            "117 'Ld L Bol-SF LPY'\n 1.1  1  3   -35.0    39.5 ! x, y\n! and so on\n    18.0   3 1 5 6\n\
             8 9 10",
        ),
        // A body in one.
        (
            "    -35.0      0.0     83.0\n    6 1 2 3",
            "    -35.0,0.0,83.0  6 1 2 3",
        ),
        // A characteristic over two, in the middle of its numbers.
        ("3.7022E3  1.0E6  1.0E3  0.40", "3.7022E3\n  1.0E6  1.0E3  0.40"),
        // A function with a value in each line, and in one line.
        (
            "  13   3            0.0          0.0       6.40E7",
            "  13   3\n 0.0\n\n0.0\n  6.40D7",
        ),
        (
            "0.0      2.55E05      8.95E05\n                    0.0",
            "0.0      2.55E05      8.95E05     0.0",
        ),
    ];
    let mut text = builtin::text(SYSTEMS[0]).unwrap().to_owned();
    for (old, new) in changes {
        assert!(text.contains(old), "{old}");
        text = text.replacen(old, new, 1);
    }
    let read = read_system(&SourceText::from_text("wrapped.sys", text).unwrap());
    assert!(read.strict().unwrap() == system(SYSTEMS[0]).tree);
}

#[test]
fn values_may_stand_in_the_line_of_their_keyword() {
    let name = "bolst_wedge_sf_bolst-vert-displ_69_var.run";
    let text = builtin::text(name).unwrap();
    let joined = [
        "SYSTEM FILE",
        "DATA FILE",
        "INPUT FILE",
        "CONTROL CONSTANTS",
        "STEPPING CONSTANTS",
    ]
    .iter()
    .fold(text.to_owned(), |text, keyword| {
        text.replace(&format!("{keyword}\n"), &format!("{keyword}  "))
    });
    assert_eq!(joined.lines().count() + 5, text.lines().count());
    let read = read_run(&SourceText::from_text(name, joined).unwrap());
    assert!(read.strict().unwrap() == run(name));
}
