//! Records of the variants of a study: records, one a variant, as bytes that survive being cut off.
//!
//! A record is written at once and stands for itself, so that files of records may be made by any number of
//! programs that may die at any moment: a record is there, or what there is of it is recognized as none.
//! Layout, little-endian:
//!
//! ```text
//! bytes 0..4    "WLR2"
//!       4..8    length of the body
//!       8..12   CRC-32 of the body
//!       12..    body: study's fingerprint (8), number of the variant (8), status (1),
//!               number of measures (4), measures (8 each, in the order of the study's definitions),
//!               reason (UTF-8, the rest)
//! ```
//!
//! [`read`] finds all sound records in any bytes, whatever lies between them.

use std::panic::{AssertUnwindSafe, catch_unwind};

use mechanics::energy_balance::{FAILED, Verdict};
use quantity::SixDigits;

use crate::case::CaseError;
use crate::design::Study;
use crate::measures::{Definitions, Judged, Measures, Unmeasured};
use crate::models::AnyCase;
use crate::outcome::Outcome;

const MAGIC: [u8; 4] = *b"WLR2";
const HEAD: usize = 12;
const FIXED: usize = 8 + 8 + 1 + 4;
/// More measures than these has no run.
const MOST_MEASURES: usize = 4096;
/// A longer reason is cut.
const LONGEST_REASON: usize = 1000;
/// Longest body: a longer one is damage. Without this bound the time to find records among damage would grow
/// with the square of its length.
const LONGEST: usize = FIXED + 8 * MOST_MEASURES + LONGEST_REASON + '…'.len_utf8();

/// The end of a variant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// It came to its end.
    Complete,
    /// Its values make no case or no wedge.
    Refused,
    /// It stopped on its way.
    Stopped,
    /// It came to its end, but its energy ledger does not close, or it is nonsense: it has measures, which
    /// are not to be used.
    Failed,
    /// A wheel left its rail, where it ended: it has measures of the part until then.
    Derailed,
}

impl Status {
    /// All of them, in the order of their numbers.
    pub const ALL: [Self; 5] = [
        Self::Complete,
        Self::Refused,
        Self::Stopped,
        Self::Failed,
        Self::Derailed,
    ];

    /// Returns its name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Complete => "complete",
            Self::Refused => "refused",
            Self::Stopped => "stopped",
            Self::Failed => "failed",
            Self::Derailed => "derailed",
        }
    }

    fn from_number(number: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|status| *status as u8 == number)
    }
}

/// The outcome of a variant.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// The variant's number.
    pub number: u64,
    /// The way in which it ended.
    pub status: Status,
    /// The reason if it is not complete, else empty.
    pub reason: String,
    /// Its measures, SI; empty if it has none.
    pub measures: Measures,
}

/// Computes a variant. Whatever goes wrong in it, it is a record: others go on.
#[must_use]
pub fn run(study: &Study, number: u64) -> Record {
    caught(number, || compute(study, number))
}

/// Computes a case of which these measures are kept. Whatever goes wrong in it, or in making it, it is a
/// record.
#[must_use]
pub fn run_made(
    definitions: &Definitions,
    number: u64,
    make: impl FnOnce() -> Result<AnyCase, CaseError>,
) -> Record {
    caught(number, || judged_case(definitions, number, make()))
}

/// Computes a case as if it were this variant of the study.
#[must_use]
pub fn run_case(study: &Study, number: u64, case: &AnyCase) -> Record {
    caught(number, || record(study.measures(), number, case.judge()))
}

/// Returns a panic, which is a mistake of ours, as a record.
fn caught(number: u64, compute: impl FnOnce() -> Record) -> Record {
    catch_unwind(AssertUnwindSafe(compute)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<&str>().copied();
        let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
        Record {
            number,
            status: Status::Stopped,
            reason: shortened(format!(
                "a mistake of Wedgelab itself: {}",
                text.unwrap_or("no message")
            )),
            measures: Measures::default(),
        }
    })
}

fn compute(study: &Study, number: u64) -> Record {
    judged_case(study.measures(), number, study.case(number))
}

fn judged_case(definitions: &Definitions, number: u64, case: Result<AnyCase, CaseError>) -> Record {
    let case = case.map_err(|error| {
        let reasons: Vec<&str> = error.problems().iter().map(|problem| problem.message()).collect();
        Unmeasured::Refused(reasons.join("; "))
    });
    record(definitions, number, case.and_then(|case| case.judge()))
}

/// Returns the outcome of a variant as its record.
fn record(definitions: &Definitions, number: u64, outcome: Result<Judged, Unmeasured>) -> Record {
    let (status, reason, measures) = match outcome {
        Ok(Judged { measures, outcome }) => match definitions.not_finite(&measures) {
            None => {
                let (status, reason) = judged(outcome, ledger(definitions, &measures));
                (status, shortened(reason), measures)
            }
            Some(name) => {
                let reason = format!("`{name}` is not a finite number");
                (Status::Stopped, reason, Measures::default())
            }
        },
        Err(Unmeasured::Refused(reason)) => (Status::Refused, shortened(reason), Measures::default()),
        Err(Unmeasured::Stopped(reason)) => (Status::Stopped, shortened(reason), Measures::default()),
    };
    Record {
        number,
        status,
        reason,
        measures,
    }
}

/// Returns the status of a variant that has measures, and the reason; `ledger` is that of its energy ledger,
/// if it does not close.
fn judged(outcome: Outcome, ledger: Option<String>) -> (Status, String) {
    match (outcome, ledger) {
        (Outcome::Derailed(end), ledger) => {
            let also = ledger.map_or(String::new(), |reason| format!("; {reason}"));
            let time = SixDigits(end.time);
            (Status::Derailed, format!("at {time} s {}{also}", end.reason))
        }
        (_, Some(reason)) | (Outcome::Failed(reason), None) => (Status::Failed, reason),
        (Outcome::Stopped(end), None) => (Status::Stopped, end.reason),
        (Outcome::Complete, None) => (Status::Complete, String::new()),
    }
}

/// Returns the reason why a variant whose energy ledger does not close has failed.
fn ledger(definitions: &Definitions, measures: &Measures) -> Option<String> {
    let residual = definitions.get(measures, "ledger_residual")?;
    (Verdict::of(residual) == Verdict::Failed).then(|| {
        format!(
            "the energy ledger does not close: its relative residual is {residual:.2e} (above {FAILED:e}); \
             compute this run with accuracy = \"case\" or a lower simulation.relative_tolerance"
        )
    })
}

/// Computes these variants and gives their records as bytes, in the order of the numbers: what one worker of
/// many does. Numbers beyond the study are left out.
#[must_use]
pub fn run_all(study: &Study, numbers: impl IntoIterator<Item = u64>) -> Vec<u8> {
    let fingerprint = study.fingerprint();
    let mut bytes = Vec::new();
    for number in numbers.into_iter().filter(|number| *number < study.count()) {
        run(study, number).write(fingerprint, &mut bytes);
    }
    bytes
}

fn shortened(mut reason: String) -> String {
    if reason.len() > LONGEST_REASON {
        let end = (0..=LONGEST_REASON)
            .rev()
            .find(|end| reason.is_char_boundary(*end))
            .unwrap_or(0);
        reason.truncate(end);
        reason.push('…');
    }
    reason
}

impl Record {
    /// Appends it as bytes.
    pub fn write(&self, fingerprint: u64, out: &mut Vec<u8>) {
        let mut body = Vec::with_capacity(FIXED + 8 * self.measures.0.len() + self.reason.len());
        body.extend(fingerprint.to_le_bytes());
        body.extend(self.number.to_le_bytes());
        body.push(self.status as u8);
        body.extend((self.measures.0.len() as u32).to_le_bytes());
        for value in &self.measures.0 {
            // One NaN for all, so that the same record has the same bytes.
            let value = if value.is_nan() { f64::NAN } else { *value };
            body.extend(value.to_le_bytes());
        }
        body.extend(self.reason.as_bytes());
        out.extend(MAGIC);
        out.extend((body.len() as u32).to_le_bytes());
        out.extend(crc32fast::hash(&body).to_le_bytes());
        out.extend(body);
    }

    /// Reads the record that the bytes begin with: its study's fingerprint, itself, and its length.
    fn read(bytes: &[u8]) -> Option<(u64, Self, usize)> {
        let rest = bytes.strip_prefix(&MAGIC)?;
        let (length, rest) = rest.split_first_chunk::<4>()?;
        let (sum, rest) = rest.split_first_chunk::<4>()?;
        let length = u32::from_le_bytes(*length) as usize;
        if !(FIXED..=LONGEST).contains(&length) {
            return None;
        }
        let body = rest.get(..length)?;
        if crc32fast::hash(body) != u32::from_le_bytes(*sum) {
            return None;
        }
        let (fingerprint, rest) = body.split_first_chunk::<8>()?;
        let (number, rest) = rest.split_first_chunk::<8>()?;
        let (status, rest) = rest.split_first()?;
        let (count, rest) = rest.split_first_chunk::<4>()?;
        let count = u32::from_le_bytes(*count) as usize;
        let (numbers, reason) = rest.split_at_checked(8 * count.min(MOST_MEASURES))?;
        let numbers = numbers.as_chunks::<8>().0.iter();
        let values = numbers.map(|bytes| f64::from_le_bytes(*bytes)).collect();
        let record = Self {
            number: u64::from_le_bytes(*number),
            status: Status::from_number(*status)?,
            reason: std::str::from_utf8(reason).ok()?.to_owned(),
            measures: Measures(values),
        };
        Some((u64::from_le_bytes(*fingerprint), record, HEAD + length))
    }
}

/// The records that bytes hold.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadRecords {
    /// The study's sound records, in the order in which they were written.
    pub records: Vec<Record>,
    /// True if there are records of another study.
    pub foreign: bool,
    /// Bytes that belong to no sound record: one that was cut off, or damage.
    pub lost: usize,
}

/// Finds all records of a study in bytes, whatever lies between them.
#[must_use]
pub fn read(fingerprint: u64, bytes: &[u8]) -> ReadRecords {
    let mut found = ReadRecords::default();
    let mut at = 0;
    while at < bytes.len() {
        match Record::read(&bytes[at..]) {
            Some((own, record, length)) => {
                if own == fingerprint {
                    found.records.push(record);
                } else {
                    found.foreign = true;
                }
                at += length;
            }
            None => {
                found.lost += 1;
                at += 1;
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{Status, caught};

    #[test]
    #[allow(clippy::panic)]
    fn limits_a_mistake_of_ours_is_a_record() {
        let record = caught(7, || panic!("on {}", "purpose"));
        assert_eq!((record.number, record.status), (7, Status::Stopped));
        assert_eq!(record.reason, "a mistake of Wedgelab itself: on purpose");
    }
}
