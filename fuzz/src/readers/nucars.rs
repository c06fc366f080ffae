//! The four kinds of files of NUCARS: read, checked alone and with their partners, shown, written and read
//! again, and made a run.

use std::sync::{Arc, LazyLock};

use miette::Diagnostic;
use nucars::read::{AnyFile, FileKind, Read, read, read_data, read_input, read_run, read_system};
use nucars::source::SourceText;
use nucars::tree::{DataFile, InputFile, RunFile, SystemFile};
use nucars::{Findings, builtin, check, show, write};
use study::half_truck::files::{self, FileTrees, Settings};

use super::{ReadOutcome, Reader, refused_as_written};
use crate::shown;

/// System files.
pub const SYSTEMS: Reader = Reader {
    name: "systems",
    about: "system files of NUCARS",
    corpus: || of_kind(FileKind::System),
    dictionary: DICTIONARY,
    read: |input| file(input, FileKind::System),
};

/// Input files.
pub const INPUTS: Reader = Reader {
    name: "inputs",
    about: "input files of NUCARS",
    corpus: || of_kind(FileKind::Input),
    dictionary: DICTIONARY,
    read: |input| file(input, FileKind::Input),
};

/// Data files.
pub const DATA: Reader = Reader {
    name: "data",
    about: "data files of NUCARS",
    corpus: || of_kind(FileKind::Data),
    dictionary: DICTIONARY,
    read: |input| file(input, FileKind::Data),
};

/// Run files.
pub const RUNS: Reader = Reader {
    name: "runs",
    about: "run files of NUCARS",
    corpus: || of_kind(FileKind::Run),
    dictionary: DICTIONARY,
    read: |input| file(input, FileKind::Run),
};

const DICTIONARY: &[&[u8]] = &[
    b"\\",
    b"$\\",
    b"!",
    b"'",
    b"''",
    b"\r",
    b"/",
    b"0",
    b"-1",
    b"4294967295",
    b"99999999999999999999",
    b"1.D0",
    b"1.D308",
    b".T.",
    b".F.",
    b"6.8",
    b"6.9",
    b"7.01",
    b"127.1",
    b"\\PWL DATA\n",
    b"\\BODY DATA\n",
    b"\\CONNECTION DATA\n",
    b"\\STEPPING CONSTANTS\n",
    b"\\END\n",
];

/// Returns the built-in files of a kind.
fn of_kind(kind: FileKind) -> Vec<Vec<u8>> {
    let texts = builtin::names().filter(|name| {
        let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
        ending.eq_ignore_ascii_case(kind.ending())
    });
    texts
        .filter_map(builtin::text)
        .map(|text| text.as_bytes().to_vec())
        .collect()
}

/// Sound files that a mutant is read together with.
struct Partners {
    system: Read<SystemFile>,
    input: Read<InputFile>,
    data: Read<DataFile>,
    run: Read<RunFile>,
}

static PARTNERS: LazyLock<Option<Partners>> = LazyLock::new(|| {
    Some(Partners {
        system: read_system(&builtin::source("Bolst_wedge_sf_68_constant.sys")?),
        input: read_input(&builtin::source("bolst_displ_input36.inp")?),
        data: read_data(&builtin::source("sngl_trk_68.dat")?),
        run: read_run(&builtin::source(
            "Bolst_wedge_sf_bolst-vert-displ_68_constant.run",
        )?),
    })
});

fn file(input: &[u8], kind: FileKind) -> ReadOutcome {
    let Some(partners) = PARTNERS.as_ref() else {
        return ReadOutcome::NO_TEXT;
    };
    // Without an ending, what it is follows from its sections.
    if let Ok(source) = SourceText::from_bytes("file", input.to_vec()) {
        let _ = FileKind::of(&source);
    }
    let source = match SourceText::from_bytes("file", input.to_vec()) {
        Ok(source) => source,
        Err(error) => return ReadOutcome::refused_with(&error.to_string()),
    };
    let all = match read(&source, kind) {
        AnyFile::System(read) => system(*read, partners),
        AnyFile::Input(read) => input_file(*read, partners),
        AnyFile::Data(read) => data(*read, partners),
        AnyFile::Run(read) => run(*read, partners),
    };
    ReadOutcome {
        accepted: !all.has_errors(),
        message: message_bytes(&all),
        attempts: 0,
    }
}

/// Checks the findings of a file as the program tells them, and returns the bytes of all of them.
fn message_bytes(findings: &Findings) -> usize {
    for finding in findings.list() {
        let place = finding.place();
        assert!(
            place.source.text().get(place.span.range()).is_some(),
            "place outside: {finding}"
        );
        let (line, column) = place.line_and_column();
        assert!(line >= 1 && column >= 1, "place outside: {finding}");
        assert!(
            !finding.message().is_empty() && finding.advice().is_some(),
            "no advice: {finding}"
        );
    }
    let errors = findings.list().iter();
    shown::check_all(errors.map(|finding| finding as &dyn Diagnostic))
}

/// Another file, as it was written.
fn written(text: String) -> Option<Arc<SourceText>> {
    SourceText::from_text("written", text).ok()
}

fn check_again<T: PartialEq>(own: &T, again: Option<Read<T>>) {
    let Some(again) = again else { return };
    match again.strict() {
        Ok(tree) => assert!(tree == *own, "another tree: written and read again"),
        Err(errors) => refused_as_written(&errors),
    }
}

/// Makes a run of files, without running it.
fn build(files: FileTrees<'_>) {
    if let Err(error) = files::case("files", "", files, &Settings::default()) {
        shown::check_text(&error.to_string());
    }
}

fn system(mut read: Read<SystemFile>, with: &Partners) -> Findings {
    for table in show::system(&read.tree) {
        let columns = table.columns.len();
        assert!(
            table.rows.iter().all(|row| row.len() == columns),
            "ragged table: {}",
            table.title
        );
    }
    if !read.findings.has_errors() {
        let again = written(write::write_system(&read.tree));
        check_again(&read.tree, again.map(|source| read_system(&source)));
    }
    read.add(check::system(&read));
    read.add(check::system_with_input(&read, &with.input.tree));
    message_bytes(&check::data_of_system(&with.data, &read.tree));
    if !read.findings.has_errors() {
        build(FileTrees {
            system: &read.tree,
            input: Some(&with.input.tree),
            data: Some(&with.data.tree),
            run: Some(&with.run.tree),
        });
    }
    read.findings
}

fn input_file(mut read: Read<InputFile>, with: &Partners) -> Findings {
    if !read.findings.has_errors() {
        let again = written(write::write_input(&read.tree));
        check_again(&read.tree, again.map(|source| read_input(&source)));
    }
    read.add(check::input(&read));
    message_bytes(&check::system_with_input(&with.system, &read.tree));
    message_bytes(&check::run_with_input(&with.run, &read.tree));
    if !read.findings.has_errors() {
        build(FileTrees {
            system: &with.system.tree,
            input: Some(&read.tree),
            data: Some(&with.data.tree),
            run: Some(&with.run.tree),
        });
    }
    read.findings
}

fn data(mut read: Read<DataFile>, with: &Partners) -> Findings {
    if !read.findings.has_errors() {
        let again = written(write::write_data(&read.tree));
        check_again(&read.tree, again.map(|source| read_data(&source)));
    }
    read.add(check::data(&read));
    let together = check::data_of_system(&read, &with.system.tree);
    message_bytes(&together);
    if !read.findings.has_errors() && !together.has_errors() {
        build(FileTrees {
            system: &with.system.tree,
            input: Some(&with.input.tree),
            data: Some(&read.tree),
            run: Some(&with.run.tree),
        });
    }
    read.findings
}

fn run(mut read: Read<RunFile>, with: &Partners) -> Findings {
    if !read.findings.has_errors() {
        let again = written(write::write_run(&read.tree));
        check_again(&read.tree, again.map(|source| read_run(&source)));
    }
    read.add(check::run(&read));
    read.add(check::run_with_input(&read, &with.input.tree));
    if !read.findings.has_errors() {
        build(FileTrees {
            system: &with.system.tree,
            input: Some(&with.input.tree),
            data: Some(&with.data.tree),
            run: Some(&read.tree),
        });
    }
    read.findings
}
