//! Large files: time and findings in proportion to their length.

use std::fmt::Write;
use std::time::Instant;

use nucars::read::{AnyFile, FileKind, Read, read, read_system};
use nucars::source::SourceText;
use nucars::tree::SystemFile;
use nucars::{builtin, check};

const SYSTEM: &str = "Bolst_wedge_sf_68_constant.sys";

/// Returns a system with records added to one section until it has so many bytes, and how many they are.
fn large(section: &str, bytes: usize) -> (String, usize) {
    let text = builtin::text(SYSTEM).unwrap();
    let mut out = String::with_capacity(bytes + text.len());
    let (before, after) = text.split_at(text.find(section).unwrap() + section.len());
    out.push_str(before);
    out.push('\n');
    let mut records = String::with_capacity(bytes);
    let mut number = 1000;
    while records.len() < bytes {
        number += 1;
        let _ = match section {
            "\\CONNECTION DATA" => writeln!(
                records,
                "{number} 'Ld L Bol-SF LPY'  1.1  1  3   -35.0    39.5    18.0   3 1 5 6 8 9 10"
            ),
            "\\CHARACTERISTIC DATA" => writeln!(records, "  {number}   11   12   1.0E09  -1.0E09"),
            _ => writeln!(
                records,
                "  {number}   3            0.0      2.225E3       1.09E5\n                    0.0         \
                 0.50         0.60"
            ),
        };
    }
    if section == "\\CONNECTION DATA" {
        let _ = write!(out, "{}\n{records}", 50 + number - 1000);
        out.push_str(after.trim_start().strip_prefix("50").unwrap());
    } else {
        out.push_str(&records);
        out.push_str(after.trim_start_matches('\n'));
    }
    (out, number - 1000)
}

fn timed(text: String) -> (Read<SystemFile>, f64) {
    let start = Instant::now();
    let read = read_system(&SourceText::from_bytes("large.sys", text.into_bytes()).unwrap());
    (read, start.elapsed().as_secs_f64())
}

/// A wide limit, s: hundreds of times as long as reading takes, which something quadratic exceeds all the
/// same.
const HANGS: f64 = 60.0;

/// All records of a large file are read, and it does not hang.
fn large_files(bytes: usize) {
    for section in SECTIONS {
        let (text, added) = large(section, bytes);
        let (read, seconds) = timed(text);
        println!("{section}: {seconds:.2} s");
        assert!(
            !read.findings.has_errors(),
            "{section}: {:?}",
            read.findings.list()
        );
        let tree = &read.tree;
        let (found, before) = match section {
            "\\CONNECTION DATA" => (tree.connections.len(), 50),
            "\\CHARACTERISTIC DATA" => (tree.characteristics.len(), 12),
            _ => (tree.piecewise_linear.len(), 11),
        };
        assert_eq!(found, before + added, "{section}");
        assert!(seconds < HANGS, "{section}: {seconds} s");
        let checked = check::system(&read);
        assert!(checked.list().len() <= 300);
    }
}

const SECTIONS: [&str; 3] = ["\\CONNECTION DATA", "\\CHARACTERISTIC DATA", "\\PWL DATA"];

#[test]
fn large_files_take_time_in_proportion() {
    // A hundredth of a second is needed for each MB, or less; something quadratic would need minutes.
    large_files(4_000_000);
}

/// Prints how long a hundred megabytes take.
#[test]
#[ignore = "a hundred megabytes: cargo test --release -p nucars --test limits -- --ignored --nocapture"]
fn a_hundred_megabytes_are_read() {
    large_files(100_000_000);
}

#[test]
fn large_nonsense_takes_time_in_proportion() {
    let lines = [
        "some text without meaning, 12 3 4\n",
        "1 2 3 4 5 6\n",
        "\\PWL DATE\n",
        "  \\\n",
        "1 'x\n",
        "1 2 3 ",
        "       ",
        "''",
        "x ",
    ];
    let heads = [
        "",
        "\\BODY DATA\n1000000000\n",
        "\\PWL DATA\n1 4000000000 ",
        "\\INPUT HISTORY DATA\n1000000000\n",
        "\\CONNECTION FORCE SUM\n10000000\n",
        "\\DOF FORCE\n99\n",
    ];
    for line in lines {
        for head in heads {
            let text = format!("{head}{}", line.repeat(300_000 / line.len()));
            let source = SourceText::from_text("nonsense", text).unwrap();
            for kind in FileKind::ALL {
                let start = Instant::now();
                let findings = match read(&source, kind) {
                    AnyFile::System(read) => read.findings,
                    AnyFile::Input(read) => read.findings,
                    AnyFile::Data(read) => read.findings,
                    AnyFile::Run(read) => read.findings,
                };
                let seconds = start.elapsed().as_secs_f64();
                assert!(seconds < HANGS, "{line:?} after {head:?} as {kind}: {seconds} s");
                assert!(
                    findings.has_errors() || kind == FileKind::Data,
                    "{line:?} after {head:?} as {kind}"
                );
                assert!(findings.list().len() <= 300);
            }
        }
    }
}
