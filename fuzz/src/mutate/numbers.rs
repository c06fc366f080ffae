//! Mutations of numbers as they are written.

use std::ops::Range;

use super::{Random, copies, insert};

const EXTREMES: [&str; 34] = [
    "0",
    "-0",
    "0.0",
    "-0.0",
    "1",
    "-1",
    "2",
    "0.1",
    "1e308",
    "-1e308",
    "1.7976931348623157e308",
    "1e-308",
    "5e-324",
    "1e999",
    "-1e999",
    "1e-999",
    "nan",
    "-nan",
    "inf",
    "-inf",
    "Infinity",
    "127",
    "255",
    "256",
    "65535",
    "65536",
    "2147483648",
    "4294967295",
    "4294967296",
    "9007199254740993",
    "9223372036854775808",
    "18446744073709551615",
    "18446744073709551616",
    "0x7fffffffffffffff",
];

/// Returns the number at or after some place.
fn number(bytes: &[u8], random: &mut Random) -> Option<Range<usize>> {
    let from = random.below(bytes.len());
    let first = |range: Range<usize>| range.into_iter().find(|at| bytes[*at].is_ascii_digit());
    let start = first(from..bytes.len()).or_else(|| first(0..from))?;
    let belongs = |byte: &&u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'e' | b'E' | b'_');
    let length = bytes[start..].iter().take_while(belongs).count();
    let before = bytes[..start]
        .iter()
        .rev()
        .take_while(|byte| byte.is_ascii_digit());
    Some(start - before.count()..start + length)
}

pub fn extreme(bytes: &mut Vec<u8>, random: &mut Random) {
    let Some(range) = number(bytes, random) else {
        return;
    };
    let long = random.many();
    let digits = "9".repeat(copies(long, 1));
    let text = match random.below(12) {
        0 => digits,
        1 => format!("0.{}1", "0".repeat(copies(long, 1))),
        2 => format!("1e{digits}"),
        3 => format!("-{}", String::from_utf8_lossy(&bytes[range.clone()])),
        _ => random.pick(&EXTREMES).copied().unwrap_or("0").to_owned(),
    };
    bytes.splice(range, text.into_bytes());
}

pub fn digits(bytes: &mut Vec<u8>, random: &mut Random) {
    let Some(range) = number(bytes, random) else {
        return;
    };
    for _ in 0..=random.below(3) {
        let at = range.start + random.below(range.len());
        let digit = b'0' + random.below(10) as u8;
        match bytes[at].is_ascii_digit() {
            true => bytes[at] = digit,
            false => insert(bytes, at, &[digit]),
        }
    }
}
