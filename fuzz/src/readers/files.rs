//! Files of any kind: the recognition of their kind, before they are read.

use std::fs;

use input::FileType;
use input::file::{Expected, read_text};
use study::case::builtin;

use super::{ReadOutcome, Reader};

/// Files.
pub const FILES: Reader = Reader {
    name: "files",
    about: "what a file seems to be",
    corpus,
    dictionary: &[
        b"MATLAB 5.0 MAT-file",
        b"PK\x03\x04",
        b"PAR1",
        b"WLR2",
        b"\x89PNG",
        b"%PDF-",
        b"\x7fELF",
        b"\xff\xfe",
        b"\xef\xbb\xbf",
        b"<!doctype html>",
        b"<svg",
        b"<?xml",
        b"{",
        b"[{",
        b"\\BODY DATA",
        b"[wedge]",
        b"[vary]",
        b"time_s,a\n",
        b"\0",
    ],
    read,
};

/// Cases, and texts that seem to be nothing.
fn corpus() -> Vec<Vec<u8>> {
    let cases = builtin::names()
        .take(2)
        .filter_map(|name| builtin::text(name).ok());
    let texts = cases.chain(["a = 1\n", "some words\n"]);
    texts.map(|text| text.as_bytes().to_vec()).collect()
}

/// Expects a case.
fn read(input: &[u8]) -> ReadOutcome {
    const CASE: Expected = Expected {
        what: "case file",
        types: &[FileType::Case],
        most: 500_000,
    };
    let Ok(folder) = tempfile::tempdir() else {
        return ReadOutcome::NO_TEXT;
    };
    let path = folder.path().join("file");
    if fs::write(&path, input).is_err() {
        return ReadOutcome::NO_TEXT;
    }
    let text = read_text(&path, &CASE);
    let foreign = FileType::of(input).is_some_and(|found| found != FileType::Case);
    match text {
        Ok(text) => {
            assert!(!foreign, "wrong kind read: {:?}", FileType::of(input));
            assert!(text.len() <= input.len(), "more read: {} bytes", text.len());
            ReadOutcome::ACCEPTED
        }
        Err(error) => {
            let help = error.help().unwrap_or_default();
            ReadOutcome::refused_with(&format!("{error}\n{help}"))
        }
    }
}
