//! A reader that breaks as its input says, by which the program itself is tested.

use std::hint::black_box;

use cpu_time::ThreadTime;

use super::{ReadOutcome, Reader};
use crate::limits::LONGEST_EXECUTION;
use crate::reference;

/// The reader.
pub const BROKEN: Reader = Reader {
    name: "broken",
    about: "breaks as its input says",
    corpus: || WORDS.map(|word| word.as_bytes().to_vec()).to_vec(),
    dictionary: &[],
    read,
};

const WORDS: [&str; 7] = [
    "sound",
    "panic",
    "recursion",
    "memory",
    "slow",
    "endless",
    "promise",
];

fn read(input: &[u8]) -> ReadOutcome {
    match std::str::from_utf8(input) {
        Ok("sound") => ReadOutcome::ACCEPTED,
        #[allow(clippy::panic)]
        Ok("panic") => panic!("promise broken: on purpose"),
        Ok("promise") => ReadOutcome::refused_with(&"long ".repeat(100_000)),
        Ok("recursion") => {
            black_box(down(u64::MAX));
            ReadOutcome::ACCEPTED
        }
        Ok("memory") => {
            black_box(vec![1_u8; 2 << 30]);
            ReadOutcome::ACCEPTED
        }
        Ok("slow") => {
            // Longer than the limit, however slow the machine is.
            compute(|| 2.0 * LONGEST_EXECUTION.as_secs_f64() * reference::slowdown());
            ReadOutcome::ACCEPTED
        }
        Ok("endless") => {
            compute(|| f64::INFINITY);
            ReadOutcome::ACCEPTED
        }
        _ => ReadOutcome::NO_TEXT,
    }
}

/// Recursion that no compiler turns into a loop.
fn down(depth: u64) -> u64 {
    let here = black_box([depth; 16]);
    match depth {
        0 => 0,
        _ => down(depth - 1).wrapping_add(black_box(here)[3]),
    }
}

/// Computes for a time of the processor (s), which may change while it computes.
fn compute(seconds: impl Fn() -> f64) {
    let start = ThreadTime::now();
    while start.elapsed().as_secs_f64() < seconds() {
        black_box(0);
    }
}
