//! Corpora and dictionaries as files, for libFuzzer.

use std::fmt::Write;
use std::fs;
use std::io;
use std::path::Path;

use fuzz::readers::Reader;

/// Writes for each reader a folder with its corpus, and a dictionary beside it.
///
/// # Errors
/// Something cannot be written.
pub fn write(readers: &[&Reader], folder: &Path) -> io::Result<()> {
    for reader in readers {
        let own = folder.join(reader.name);
        fs::create_dir_all(&own)?;
        for (number, entry) in (reader.corpus)().iter().enumerate() {
            fs::write(own.join(format!("{number:03}")), entry)?;
        }
        fs::write(
            folder.join(format!("{}.dict", reader.name)),
            dictionary(reader.dictionary),
        )?;
    }
    Ok(())
}

/// Returns one piece a line, in quotes, every byte by its number.
fn dictionary(pieces: &[&[u8]]) -> String {
    let mut text = String::new();
    for piece in pieces {
        text.push('"');
        for byte in *piece {
            // Writing to a String cannot fail.
            let _ = write!(text, "\\x{byte:02x}");
        }
        text.push_str("\"\n");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reader_has_its_files() {
        let folder = tempfile::tempdir().unwrap();
        let reader = fuzz::readers::find("records").unwrap();
        write(&[reader], folder.path()).unwrap();
        let first = fs::read(folder.path().join("records").join("000")).unwrap();
        assert_eq!(first, (reader.corpus)()[0]);
        let text = fs::read_to_string(folder.path().join("records.dict")).unwrap();
        assert!(text.starts_with("\"\\x57\\x4c\\x52\\x31\"\n"), "{text}");
    }
}
