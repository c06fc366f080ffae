//! Checks of trees for gaps and contradictions: in themselves, and together with the files they belong to.
//!
//! Errors are what NUCARS, or any program, could not make sense of. Warnings are what can be computed and is
//! probably not meant: each of them is in one of the files printed with the thesis.

mod balance;
mod data;
mod doubts;
mod drives;
mod input;
mod references;
mod run;
mod system;

use std::collections::HashMap;
use std::hash::Hash;

use crate::finding::Findings;
use crate::read::Read;
use crate::source::{Span, Spanned};

pub use balance::{Balance, GRAVITY, vertical_balance};
pub use data::{data, data_of_system};
pub use drives::{SpringDrive, drives};
pub use input::input;
pub use run::{run, run_with_input, run_without_file};
pub use system::{system, system_with_input};

impl<T> Read<T> {
    /// Adds findings about the same file, without those that follow from an error in the same value.
    #[must_use]
    pub fn with(mut self, more: Findings) -> Self {
        self.add(more);
        self
    }

    /// Adds findings about the same file, without those that are known already or follow from an error in the
    /// same value.
    pub fn add(&mut self, more: Findings) {
        self.findings.join(more);
        self.findings.sort();
    }
}

/// Complains about keys that stand twice.
fn repeated<K: Copy + Eq + Hash + std::fmt::Display>(
    keys: impl Iterator<Item = Spanned<K>>,
    what: &str,
    findings: &mut Findings,
) {
    let mut first: HashMap<K, Span> = HashMap::new();
    for key in keys {
        if let Some(had) = first.get(&key.value) {
            if findings.is_full() {
                return;
            }
            let (line, _) = findings.source().line_and_column(had.start);
            findings.error(
                "repeated",
                key.span,
                format!("{what} {key} stands here a second time; the first is in line {line}"),
                "numbers must differ, because others refer to them",
            );
        } else {
            first.insert(key.value, key.span);
        }
    }
}

/// Returns the first numbers of a list, for messages.
fn some_of(numbers: impl Iterator<Item = u32>) -> String {
    const MOST: usize = 20;
    let mut numbers: Vec<u32> = numbers.collect();
    numbers.sort_unstable();
    numbers.dedup();
    let more = numbers.len() > MOST;
    let shown: Vec<String> = numbers
        .into_iter()
        .take(MOST)
        .map(|number| number.to_string())
        .collect();
    let list = shown.join(", ");
    if more { list + ", ..." } else { list }
}

/// Returns a number as in a table: four to six digits.
pub(crate) fn shown(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e6).contains(&size) {
        let digits = (4 - size.log10().floor() as i32).clamp(0, 8) as usize;
        let text = format!("{value:.digits$}");
        if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        } else {
            text
        }
    } else {
        let text = format!("{value:.3e}");
        match text.split_once('e') {
            Some((digits, exponent)) if digits.contains('.') => {
                format!(
                    "{}e{exponent}",
                    digits.trim_end_matches('0').trim_end_matches('.')
                )
            }
            _ => text,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::shown;

    #[test]
    fn numbers_are_short() {
        let cases = [
            (0.0, "0"),
            (123_229.8, "123230"),
            (0.4, "0.4"),
            (-1.7, "-1.7"),
            (1e6, "1e6"),
            (3.1205e9, "3.12e9"),
            (1.25e-6, "1.25e-6"),
            (0.031_382, "0.031382"),
            (100.0, "100"),
        ];
        for (value, text) in cases {
            assert_eq!(shown(value), text);
        }
    }
}
