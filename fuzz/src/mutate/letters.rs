//! Mutations of letters and of their encoding.

use super::{Random, copies, insert};

pub fn encoding(bytes: &mut Vec<u8>, random: &mut Random) {
    let text = String::from_utf8_lossy(bytes).into_owned();
    let utf16 = |unit: fn(u16) -> [u8; 2]| -> Vec<u8> {
        let units = std::iter::once(0xfeff).chain(text.encode_utf16());
        units.flat_map(unit).collect()
    };
    match random.below(9) {
        0 => *bytes = text.replace('\n', "\r\n").into_bytes(),
        1 => *bytes = text.replace('\n', "\r").into_bytes(),
        2 => *bytes = text.replace('\n', "\n\r").into_bytes(),
        3 => insert(bytes, 0, "\u{feff}".as_bytes()),
        4 => *bytes = utf16(u16::to_le_bytes),
        5 => *bytes = utf16(u16::to_be_bytes),
        6 => {
            let latin = text.chars().map(|letter| u8::try_from(letter).unwrap_or(b'?'));
            *bytes = latin.collect();
            insert(bytes, random.below(bytes.len()), b"\xe4");
        }
        7 => insert(bytes, random.below(bytes.len()), "\u{feff}".as_bytes()),
        _ => {
            let zeros = vec![0; copies(random.many(), 1)];
            insert(bytes, random.below(bytes.len()), &zeros);
        }
    }
}

/// Letters that look like these, or whose other case has another length.
const ALIKE: [(char, &str); 16] = [
    ('a', "\u{430}"),
    ('e', "\u{435}"),
    ('o', "\u{3bf}"),
    ('i', "\u{131}"),
    ('I', "\u{130}"),
    ('s', "\u{17f}"),
    ('k', "\u{212a}"),
    ('m', "\u{b5}m"),
    ('0', "\u{ff10}"),
    ('1', "\u{661}"),
    ('2', "\u{b2}"),
    ('-', "\u{2212}"),
    ('.', "\u{2024}"),
    ('"', "\u{201c}"),
    (' ', "\u{a0}"),
    ('=', "\u{ff1d}"),
];

/// Marks on letters, signs without width, and other signs that text programs stumble over.
const SIGNS: [&str; 12] = [
    "\u{301}",
    "\u{200b}",
    "\u{200d}",
    "\u{202e}",
    "\u{85}",
    "\u{2028}",
    "\u{1f600}",
    "\u{fffd}",
    "\u{10ffff}",
    "\u{7f}",
    "\u{1b}[31m",
    "\u{df}",
];

pub fn letters(bytes: &mut Vec<u8>, random: &mut Random) {
    let at = random.below(bytes.len());
    match random.below(4) {
        0 => {
            let end = bytes.len().min(at + 1 + random.below(20));
            for byte in &mut bytes[at..end] {
                if byte.is_ascii_alphabetic() {
                    *byte ^= 0x20;
                }
            }
        }
        1 => {
            let sign = random.pick(&SIGNS).copied().unwrap_or_default();
            let signs = sign.repeat(copies(random.many(), sign.len()));
            insert(bytes, at, signs.as_bytes());
        }
        _ => {
            let Some((letter, alike)) = random.pick(&ALIKE) else {
                return;
            };
            let found = (at..bytes.len()).find(|at| char::from(bytes[*at]) == *letter);
            match found {
                Some(found) => drop(bytes.splice(found..=found, alike.bytes())),
                None => insert(bytes, at, alike.as_bytes()),
            }
        }
    }
}
