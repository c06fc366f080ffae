//! The MAT-file format, version 5, as far as results need it: matrices of doubles and lines of text,
//! uncompressed.
//!
//! Source: *MAT-File Format*, The MathWorks, "Level 5 MAT-File Format". A file is a header of 128 bytes, then
//! one data element a variable. Everything is little-endian; every part begins at a multiple of 8 bytes. The
//! header carries no date, so that the same variables make the same file.
//!
//! Own code, because the crate at hand (`matrw` 0.1) puts the hour of writing into the header, so that the
//! same run would never make the same file, and brings five dependencies for what are two kinds of variables
//! here.
//!
//! Limits: names and matrices below 4 GiB; no complex numbers, no structures, no compression. MATLAB (5 and
//! later), Octave and SciPy read it.

use std::io::{self, Write};

/// Data types of the format.
const INT8: u32 = 1;
const UINT16: u32 = 4;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;
/// Array classes of the format.
const CLASS_CHAR: u32 = 4;
const CLASS_DOUBLE: u32 = 6;

const HEADER_TEXT: usize = 116;
const TAG: usize = 8;
/// The longest name that MATLAB takes.
const LONGEST_NAME: usize = 63;

/// Writes the header; `text` says what the file is and is cut to 116 bytes.
///
/// # Errors
/// The writer's.
pub fn header(text: &str, out: &mut dyn Write) -> io::Result<()> {
    let mut bytes = [b' '; 128];
    let beginning = "MATLAB 5.0 MAT-file, ".bytes().chain(text.bytes());
    for (place, byte) in bytes.iter_mut().zip(beginning).take(HEADER_TEXT) {
        *place = byte;
    }
    bytes[HEADER_TEXT..124].fill(0);
    bytes[124..126].copy_from_slice(&0x0100_u16.to_le_bytes());
    bytes[126..].copy_from_slice(b"IM");
    out.write_all(&bytes)
}

/// Writes a matrix of doubles, given by its columns.
///
/// # Errors
/// The name is no MATLAB name, the columns differ in length, the matrix is too large for the format; or the
/// writer's.
pub fn matrix(name: &str, columns: &[&[f64]], out: &mut dyn Write) -> io::Result<()> {
    let rows = columns.first().map_or(0, |column| column.len());
    if columns.iter().any(|column| column.len() != rows) {
        return Err(unfit(name, "its columns differ in length"));
    }
    let values = columns.iter().flat_map(|column| column.iter());
    let bytes = values.flat_map(|value| value.to_le_bytes());
    array(name, CLASS_DOUBLE, [rows, columns.len()], (DOUBLE, 8, bytes), out)
}

/// Writes a line of text; it may hold line feeds.
///
/// # Errors
/// As [`matrix`].
pub fn text(name: &str, text: &str, out: &mut dyn Write) -> io::Result<()> {
    let length = text.encode_utf16().count();
    let bytes = text.encode_utf16().flat_map(u16::to_le_bytes);
    array(name, CLASS_CHAR, [1, length], (UINT16, 2, bytes), out)
}

/// Returns one variable: its flags, dimensions, name and data, given as data type, bytes a value, and bytes.
fn array(
    name: &str,
    class: u32,
    shape: [usize; 2],
    (kind, width, bytes): (u32, usize, impl Iterator<Item = u8>),
    out: &mut dyn Write,
) -> io::Result<()> {
    let letters = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
    if !name.starts_with(|first: char| first.is_ascii_alphabetic())
        || !name.bytes().all(letters)
        || name.len() > LONGEST_NAME
    {
        return Err(unfit(name, "this is no name of a MATLAB variable"));
    }
    let large = || unfit(name, "it is too large for the format (4 GiB)");
    let product = shape[0].checked_mul(shape[1]).and_then(|n| n.checked_mul(width));
    let data = product.ok_or_else(large)?;
    // Flags (16 bytes), dimensions (16 bytes), name and data with a tag each.
    let whole = data
        .checked_next_multiple_of(8)
        .and_then(|data| data.checked_add(32 + 2 * TAG + name.len().next_multiple_of(8)))
        .ok_or_else(large)?;
    let whole = u32::try_from(whole).map_err(|_| large())?;
    let mut begin = Vec::with_capacity(128);
    let number = |value: u32, to: &mut Vec<u8>| to.extend_from_slice(&value.to_le_bytes());
    for value in [MATRIX, whole, UINT32, 8, class, 0, INT32, 8] {
        number(value, &mut begin);
    }
    for length in shape {
        let length = i32::try_from(length).map_err(|_| large())?;
        begin.extend_from_slice(&length.to_le_bytes());
    }
    number(INT8, &mut begin);
    number(name.len() as u32, &mut begin);
    begin.extend_from_slice(name.as_bytes());
    begin.resize(begin.len().next_multiple_of(8), 0);
    number(kind, &mut begin);
    number(data as u32, &mut begin);
    out.write_all(&begin)?;
    let mut chunk = Vec::with_capacity(4096);
    for byte in bytes {
        chunk.push(byte);
        if chunk.len() == chunk.capacity() {
            out.write_all(&chunk)?;
            chunk.clear();
        }
    }
    // 4096 is a multiple of 8, so that what is left of the data ends where they end.
    chunk.resize(chunk.len().next_multiple_of(8), 0);
    out.write_all(&chunk)
}

fn unfit(name: &str, why: &str) -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidInput,
        format!("`{name}` cannot be stored in a MAT-file: {why}"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Vec<u8> {
        let mut out = Vec::new();
        assert!(write(&mut out).is_ok());
        out
    }

    #[test]
    fn a_header_has_its_marks() {
        let long = "x".repeat(200);
        for text in ["Wedgelab", long.as_str()] {
            let header = bytes(|out| header(text, out));
            assert_eq!(header.len(), 128);
            assert!(header.starts_with(b"MATLAB 5.0 MAT-file, "));
            assert_eq!(header[116..], *b"\0\0\0\0\0\0\0\0\x00\x01IM");
        }
    }

    /// The bytes of `z = [1 3; 2 4]`, taken apart by hand after the format's description.
    #[test]
    fn a_matrix_is_stored_by_columns() {
        let found = bytes(|out| matrix("z", &[&[1.0, 2.0], &[3.0, 4.0]], out));
        let mut expected = Vec::new();
        for word in [14, 32 + 16 + 40, 6, 8, 6, 0, 5, 8, 2, 2, 1, 1] {
            expected.extend_from_slice(&u32::to_le_bytes(word));
        }
        expected.extend_from_slice(b"z\0\0\0\0\0\0\0");
        for word in [9_u32, 32] {
            expected.extend_from_slice(&word.to_le_bytes());
        }
        for value in [1.0_f64, 2.0, 3.0, 4.0] {
            expected.extend_from_slice(&value.to_le_bytes());
        }
        assert_eq!(found, expected);
    }

    #[test]
    fn parts_end_at_multiples_of_eight() {
        for length in [0, 1, 3, 4, 5, 2047, 2048, 2049] {
            let found = bytes(|out| text("note", &"a".repeat(length), out));
            assert_eq!(found.len() % 8, 0);
            let stated = u32::from_le_bytes([found[4], found[5], found[6], found[7]]);
            assert_eq!(stated as usize, found.len() - 8, "{length}");
        }
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let refused = |name: &str, columns: &[&[f64]]| matrix(name, columns, &mut Vec::new()).is_err();
        assert!(refused("a", &[&[1.0], &[1.0, 2.0]]));
        for name in ["", "1a", "a-b", "\u{e4}", &"a".repeat(64)] {
            assert!(refused(name, &[&[1.0]]), "{name}");
        }
        assert!(!refused("a", &[]) && !refused("a", &[&[]]));
    }
}
