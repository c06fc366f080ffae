//! Long texts in a page, deflated: base64 of GZIP, which every browser unpacks.

use std::io::{self, Read, Write};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use input::limits;

/// Packs a text.
#[must_use]
pub fn pack(text: &str) -> String {
    let mut packed = GzEncoder::new(Vec::new(), Compression::best());
    // Writing into memory does not fail.
    let done = packed.write_all(text.as_bytes()).and_then(|()| packed.finish());
    STANDARD.encode(done.unwrap_or_default())
}

/// Unpacks a text.
///
/// # Errors
/// It is no packed text, or longer than what is read of a page.
pub fn unpack(packed: &str) -> io::Result<String> {
    let bytes = STANDARD.decode(packed.trim()).map_err(io::Error::other)?;
    let mut text = String::new();
    GzDecoder::new(bytes.as_slice())
        .take(limits::RECORD_FILE)
        .read_to_string(&mut text)?;
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::{pack, unpack};

    #[test]
    fn issue_048_packed_texts_come_back() {
        let text = "{\"data\":[\"\u{3b1}\"]}".repeat(1000);
        let packed = pack(&text);
        assert!(packed.len() < text.len() / 10);
        assert_eq!(unpack(&packed).ok().as_deref(), Some(text.as_str()));
        assert_eq!(pack(&text), packed, "the same text has the same bytes");
        assert!(unpack("not packed").is_err());
        assert!(unpack(&packed[..packed.len() / 2]).is_err());
    }
}
