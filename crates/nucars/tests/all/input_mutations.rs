//! Files broken at random: no panic, every mistake has its place, and what is read without errors can be
//! written.

use nucars::read::{AnyFile, FileKind, read, read_data, read_input, read_run, read_system};
use nucars::source::SourceText;
use nucars::{Findings, builtin, check, show, write};

/// xorshift64*: the same mutants everywhere.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    fn below(&mut self, most: usize) -> usize {
        (self.next() % most.max(1) as u64) as usize
    }
}

/// Pieces that mean something to the reader.
const PIECES: [&[u8]; 28] = [
    b"\\",
    b"$\\",
    b"!",
    b"'",
    b"''",
    b"\"",
    b"\n",
    b"\r",
    b"\r\n",
    b"\t",
    b",",
    b"/",
    b"0",
    b"-1",
    b"4294967295",
    b"99999999999999999999",
    b"1e999",
    b"1.D0",
    b"nan",
    b".T.",
    b".F.",
    b"7.01",
    b"127.1",
    b"\xe4",
    b"\xff\xfe",
    b"\0",
    b"\xef\xbb\xbf",
    b"\\PWL DATA\n",
];

fn mutated(text: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = text.to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len());
        let length = random.below(40).min(bytes.len() - at);
        match random.below(7) {
            0 => bytes.truncate(at),
            1 => bytes[at] = random.next() as u8,
            2 => {
                bytes.drain(at..at + length);
            }
            3 => {
                let piece = PIECES[random.below(PIECES.len())];
                bytes.splice(at..at, piece.iter().copied());
            }
            4 => {
                let piece = PIECES[random.below(PIECES.len())];
                bytes.splice(at..at + length, piece.iter().copied());
            }
            5 => {
                let again = bytes[at..at + length].to_vec();
                let to = random.below(bytes.len());
                bytes.splice(to..to, again);
            }
            _ => {
                // Another number in place of one.
                let digit = (at..bytes.len()).find(|at| bytes[*at].is_ascii_digit());
                if let Some(digit) = digit {
                    bytes[digit] = b'0' + random.below(10) as u8;
                }
            }
        }
        if bytes.is_empty() {
            break;
        }
    }
    bytes
}

fn placed(findings: &Findings, source: &SourceText, name: &str) {
    for finding in findings.list() {
        let place = finding.place();
        let range = place.span.range();
        assert!(range.start <= range.end, "{name}: {finding}");
        assert!(
            source.text().get(range).is_some(),
            "{name}: {finding} has no place"
        );
        let (line, column) = place.line_and_column();
        assert!(
            line >= 1 && column >= 1 && line <= source.text().lines().count() + 1,
            "{name}: {finding}"
        );
        assert!(
            !finding.message().is_empty() && finding.advice().is_some(),
            "{name}: {finding}"
        );
        assert!(
            finding.message().len() < 1000 && finding.advice().unwrap_or("").len() < 1000,
            "{name}: {finding}"
        );
        let mut shown = String::new();
        miette::NarratableReportHandler::new()
            .render_report(&mut shown, finding)
            .unwrap();
    }
}

/// Reads, checks, shows; writes and reads again what has no errors, and says whether that was so.
fn survives(bytes: Vec<u8>, kind: FileKind, name: &str) -> bool {
    let source = SourceText::from_bytes(name, bytes).unwrap();
    let again = |text: String| SourceText::from_text(name, text).unwrap();
    let system = read_system(&builtin::source("Bolst_wedge_sf_68_constant.sys").unwrap());
    let input = read_input(&builtin::source("bolst_displ_input36.inp").unwrap());
    let has_errors;
    match read(&source, kind) {
        AnyFile::System(read) => {
            placed(&check::system(&read), &source, name);
            placed(&check::system_with_input(&read, &input.tree), &source, name);
            placed(&read.findings, &source, name);
            for table in show::system(&read.tree) {
                assert!(
                    table.rows.iter().all(|row| row.len() == table.columns.len()),
                    "{}",
                    table.title
                );
            }
            has_errors = read.findings.has_errors();
            if !has_errors {
                let second = read_system(&again(write::write_system(&read.tree)));
                assert!(second.strict().unwrap() == read.tree, "{name}: {}", source.text());
            }
        }
        AnyFile::Input(read) => {
            placed(&check::input(&read), &source, name);
            placed(
                &check::system_with_input(&system, &read.tree),
                &system.source,
                name,
            );
            placed(&read.findings, &source, name);
            has_errors = read.findings.has_errors();
            if !has_errors {
                let second = read_input(&again(write::write_input(&read.tree)));
                assert!(second.strict().unwrap() == read.tree, "{name}: {}", source.text());
            }
        }
        AnyFile::Data(read) => {
            placed(&check::data(&read), &source, name);
            placed(&check::data_of_system(&read, &system.tree), &source, name);
            placed(&read.findings, &source, name);
            has_errors = read.findings.has_errors();
            if !has_errors {
                let second = read_data(&again(write::write_data(&read.tree)));
                assert!(second.strict().unwrap() == read.tree, "{name}: {}", source.text());
            }
        }
        AnyFile::Run(read) => {
            placed(&check::run(&read), &source, name);
            placed(&check::run_with_input(&read, &input.tree), &source, name);
            placed(&read.findings, &source, name);
            has_errors = read.findings.has_errors();
            if !has_errors {
                let second = read_run(&again(write::write_run(&read.tree)));
                assert!(second.strict().unwrap() == read.tree, "{name}: {}", source.text());
            }
        }
    }
    !has_errors
}

#[test]
fn mutants_of_the_printed_files() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut sound = 0;
    for name in builtin::names() {
        let text = builtin::text(name).unwrap();
        let kind = FileKind::of(&SourceText::from_text(name, text).unwrap()).unwrap();
        for _ in 0..250 {
            sound += usize::from(survives(mutated(text.as_bytes(), &mut random), kind, name));
        }
    }
    // Of 4000 mutants many are broken, and many are files with other numbers.
    assert!((500..3500).contains(&sound), "{sound}");
}

#[test]
fn every_truncation_of_a_file() {
    for name in [
        "bolst_displ_input36.inp",
        "sngl_trk_68.dat",
        "bolst_wedge_sf_bolst-vert-displ_69_var.run",
    ] {
        let text = builtin::text(name).unwrap();
        let kind = FileKind::of(&SourceText::from_text(name, text).unwrap()).unwrap();
        for length in 0..text.len() {
            survives(text.as_bytes()[..length].to_vec(), kind, name);
        }
    }
    let name = "bolst_wedge_sf_69_var.sys";
    let text = builtin::text(name).unwrap();
    for length in (0..text.len()).step_by(23) {
        survives(text.as_bytes()[..length].to_vec(), FileKind::System, name);
    }
}

#[test]
fn noise() {
    let mut random = Random(7);
    for round in 0..400 {
        let mut bytes = Vec::new();
        for _ in 0..random.below(200) {
            if round % 2 == 0 {
                bytes.push(random.next() as u8);
            } else {
                bytes.extend_from_slice(PIECES[random.below(PIECES.len())]);
                bytes.push(b' ');
            }
        }
        for kind in FileKind::ALL {
            survives(bytes.clone(), kind, "noise");
        }
    }
}
