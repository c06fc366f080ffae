//! Mutations of lines.

use std::ops::Range;

use super::{Random, copies, insert};

/// Returns the lines, each with its ending.
fn lines(bytes: &[u8]) -> Vec<Range<usize>> {
    let mut start = 0;
    let pieces = bytes.split_inclusive(|byte| *byte == b'\n');
    pieces
        .map(|line| {
            let range = start..start + line.len();
            start = range.end;
            range
        })
        .collect()
}

/// The texts that may lengthen a line.
const FILL: [&str; 8] = [" ", "a", "9", "\t", "#", "é", "\u{1f600}", ", 1"];

pub fn long(bytes: &mut Vec<u8>, random: &mut Random) {
    let fill = random.pick(&FILL).copied().unwrap_or(" ").as_bytes();
    let wanted = 100 + random.many() * (1 + random.below(4));
    let filling = fill.repeat(copies(wanted, fill.len()));
    insert(bytes, random.below(bytes.len()), &filling);
}

pub fn many(bytes: &mut Vec<u8>, random: &mut Random) {
    let lines = lines(bytes);
    let line = match (random.below(6), random.pick(&lines)) {
        (0, _) | (_, None) => b"\n".to_vec(),
        (1, _) => b"# no data\n".to_vec(),
        (2, _) => b"a = 1\n".to_vec(),
        (3, _) => b"1,2\n".to_vec(),
        (_, Some(line)) => bytes[line.clone()].to_vec(),
    };
    let at = random.pick(&lines).map_or(0, |line| line.end);
    insert(bytes, at, &line.repeat(copies(random.many(), line.len())));
}

pub fn order(bytes: &mut Vec<u8>, random: &mut Random) {
    let mut lines = lines(bytes);
    if lines.is_empty() {
        return;
    }
    for _ in 0..=random.below(3) {
        let (one, other) = (random.below(lines.len()), random.below(lines.len()));
        match random.below(4) {
            0 if lines.len() > 1 => drop(lines.remove(one)),
            1 => lines.insert(other, lines[one].clone()),
            2 => lines.swap(one, other),
            // All lines in another order.
            _ if random.once_in(4) => {
                (1..lines.len()).for_each(|last| lines.swap(last, random.below(last + 1)))
            }
            _ => {
                let line = lines.remove(one);
                lines.insert(other.min(lines.len()), line);
            }
        }
    }
    let pieces: Vec<&[u8]> = lines.into_iter().map(|line| &bytes[line]).collect();
    *bytes = pieces.concat();
}
