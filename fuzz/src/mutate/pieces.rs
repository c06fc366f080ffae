//! Mutations of bytes, whatever they mean.

use std::ops::Range;

use super::{Random, copies, insert};

/// A range is this long at most, if it is not one of those that may be of any length.
const SHORT: usize = 40;

/// Returns a range, mostly a short one.
pub fn range(bytes: &[u8], random: &mut Random) -> Range<usize> {
    let start = random.below(bytes.len());
    let rest = bytes.len() - start;
    let most = if random.once_in(6) { rest } else { rest.min(SHORT) };
    start..start + (1 + random.below(most)).min(rest)
}

pub fn flip_bit(bytes: &mut [u8], random: &mut Random) {
    let (at, bit) = (random.below(bytes.len()), random.below(8));
    if let Some(byte) = bytes.get_mut(at) {
        *byte ^= 1 << bit;
    }
}

pub fn replace(bytes: &mut [u8], random: &mut Random) {
    let at = random.below(bytes.len());
    let length = [1, 1, 1, 2, 4, 8][random.below(6)];
    let end = bytes.len().min(at + length);
    let (any, how) = (random.any().to_le_bytes(), random.below(5));
    for (place, byte) in bytes[at..end].iter_mut().enumerate() {
        *byte = match how {
            0 => 0,
            1 => 0xff,
            // The greatest and the least whole number with a sign, lowest byte first.
            2 if place + 1 == length => 0x7f,
            2 => 0xff,
            3 if place + 1 == length => 0x80,
            3 => 0,
            _ => any[place],
        };
    }
}

pub fn repeat(bytes: &mut Vec<u8>, random: &mut Random) {
    let range = range(bytes, random);
    let piece = bytes[range.clone()].to_vec();
    let copies = copies(random.many(), piece.len());
    // Behind itself, or elsewhere.
    let at = match random.once_in(3) {
        true => random.below(bytes.len()),
        false => range.end,
    };
    insert(bytes, at, &piece.repeat(copies));
}

pub fn swap(bytes: &mut Vec<u8>, random: &mut Random) {
    let (one, other) = (range(bytes, random), range(bytes, random));
    let (first, second) = if one.start <= other.start {
        (one, other)
    } else {
        (other, one)
    };
    let first = first.start..first.end.min(second.start);
    let pieces = [
        &bytes[..first.start],
        &bytes[second.clone()],
        &bytes[first.end..second.start],
        &bytes[first.clone()],
        &bytes[second.end..],
    ];
    *bytes = pieces.concat();
}

pub fn token(bytes: &mut Vec<u8>, random: &mut Random, dictionary: &[&[u8]]) {
    let piece = match random.pick(dictionary) {
        Some(piece) if !random.once_in(4) => piece,
        _ => random.pick(&MARKS).copied().unwrap_or_default(),
    };
    let mut replaced = range(bytes, random);
    if random.once_in(2) {
        replaced.end = replaced.start;
    }
    bytes.splice(replaced, piece.iter().copied());
}

/// Marks that most readers know.
const MARKS: [&[u8]; 24] = [
    b"\"", b"'", b"\"\"\"", b"'''", b"=", b"[", b"]", b"[[", b"{", b"}", b"(", b")", b",", b";", b":", b"..",
    b"#", b"\\", b"/", b"^", b"-", b"\t", b"\n", b"true",
];

/// Opening and closing brackets. Keys with dots, signs and operators nest without closing.
const NESTS: [(&[u8], &[u8]); 16] = [
    (b"(", b")"),
    (b"[", b"]"),
    (b"{", b"}"),
    (b"<", b">"),
    (b"[[", b"]]"),
    (b"{a=", b"}"),
    (b"{\"a\":", b"}"),
    (b"[0,", b"]"),
    (b"((", b"))"),
    (b"in/(", b")"),
    (b"\"", b"\""),
    (b"a.", b""),
    (b"-", b""),
    (b"^", b""),
    (b"/", b""),
    (b"s^2 ", b""),
];

pub fn nest(bytes: &mut Vec<u8>, random: &mut Random) {
    let Some((open, close)) = random.pick(&NESTS) else {
        return;
    };
    let depth = copies(random.many(), 2 * (open.len() + close.len()));
    let within = range(bytes, random);
    // Closed by as many, by one too few, or not at all.
    let closed = match random.below(4) {
        0 => 0,
        1 => depth - 1,
        _ => depth,
    };
    insert(bytes, within.end, &close.repeat(closed));
    insert(bytes, within.start, &open.repeat(depth));
}

pub fn splice(bytes: &mut Vec<u8>, random: &mut Random, corpus: &[Vec<u8>]) {
    let Some(other) = random.pick(corpus) else { return };
    let taken = range(other, random);
    let replaced = range(bytes, random);
    bytes.splice(replaced, other[taken].iter().copied());
}
