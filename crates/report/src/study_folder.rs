//! The folder of a study: what is computed, kept so that it survives being killed at any moment.
//!
//! ```text
//! study.json            what the study is; a study that is not this one is refused
//! parts/part-NNNNNN     records (`study::records`), appended one by one as variants end
//! table.parquet         the table, made of the parts by `StudyFolder::merge` alone
//! table.csv             the same table as text
//! index.html            the summary page
//! .lock                 held while a program works here
//! ```
//!
//! Variant `i` belongs to part `i / part_size`. A part only ever grows; a record that was cut off or damaged
//! is passed over and its variant computed again. The table and the page appear whole or not at all
//! ([`staging`]).

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use input::file::{Expected, ReadError, Reason, read, read_text};
use input::{FileType, limits};
use serde::Serialize;
use study::design::{Factor, Study, Value};
use study::records::{self, Record};

use crate::csv;
use crate::output_table::{Cell, Content, OutputTable};
use crate::page::study as page;
use crate::parquet::{Storage, TableWriter, plain};
use staging::{FileError, Folder, Locked};

mod error;

pub use error::StudyFolderError;

/// The file that says what the study is.
pub const STUDY_FILE: &str = "study.json";
/// The table.
pub const TABLE_FILE: &str = "table.parquet";
/// The same table as text.
pub const TABLE_CSV_FILE: &str = "table.csv";
/// The key of the study's description in the table's metadata.
pub const STUDY_KEY: &str = "wedgelab.study";
/// The folder with the time series of some runs.
pub const SERIES: &str = "series";
const PARTS: &str = "parts";
const LOCK_FILE: &str = ".lock";

/// The expected file of a study's description.
const MANIFEST: Expected = Expected {
    what: "description of the study",
    types: &[FileType::Json],
    most: limits::RECORD_FILE,
};
/// The expected file of a part. Damage at its beginning may look like anything.
const RECORDS: Expected = Expected {
    what: "part of the study",
    types: &FileType::ALL,
    most: limits::RECORD_FILE,
};

fn unreadable(file: &Path, error: ReadError) -> StudyFolderError {
    let reason = match error.reason {
        Reason::System(reason) => reason,
        _ => io::Error::other(error.to_string()),
    };
    StudyFolderError::Unreadable {
        file: file.to_owned(),
        reason,
    }
}

/// A study's folder, held by this program.
#[derive(Debug)]
pub struct StudyFolder {
    path: PathBuf,
    fingerprint: u64,
    description: String,
    count: u64,
    part_size: u64,
    removed: Vec<PathBuf>,
    _lock: Locked,
    /// One record at a time.
    writing: Mutex<()>,
}

/// The contents of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyPart {
    /// Its records by number, each once.
    pub records: Vec<Record>,
    /// Bytes that belong to no sound record.
    pub lost: usize,
}

/// Variants in a part: the folder has at most some thousand parts, and a part fits into memory.
#[must_use]
pub fn part_size(count: u64) -> u64 {
    (count / 1024).next_power_of_two().clamp(16, 4096)
}

impl StudyFolder {
    /// Begins a study in a folder, or goes on with the same study.
    ///
    /// # Errors
    /// The folder holds something else or another study, another program works there, or it cannot be written
    /// to.
    pub fn open(path: &Path, study: &Study) -> Result<Self, StudyFolderError> {
        let made = [TABLE_FILE, TABLE_CSV_FILE, page::FILE_NAME, SERIES];
        let description = study.description();
        let of = (study.fingerprint(), study.count());
        Self::open_as(path, (STUDY_FILE, &made), &description, of)
    }

    /// Begins a folder of other numbered runs, or goes on with the same: `manifest` is the file that says
    /// what they are, `made` the files that are made of them.
    ///
    /// # Errors
    /// As [`StudyFolder::open`].
    pub fn open_as(
        path: &Path,
        (manifest_name, made): (&'static str, &[&str]),
        description: &impl Serialize,
        (fingerprint, count): (u64, u64),
    ) -> Result<Self, StudyFolderError> {
        let description = serde_json::to_string_pretty(description)
            .map_err(|error| write_error(path, io::Error::other(error)))?;
        let manifest = path.join(manifest_name);
        if !manifest.is_file() {
            refuse_foreign(path, manifest_name, made)?;
        }
        // Says in its own words what is wrong with a path. Whether there is a study is asked again below the
        // lock: another program may have begun it meanwhile.
        let folder = Folder::check(path, &[manifest_name], true)?;
        fs::create_dir_all(path.join(PARTS)).map_err(|reason| write_error(path, reason))?;
        let lock = OpenOptions::new()
            .create(true)
            .truncate(false)
            .write(true)
            .open(path.join(LOCK_FILE))
            .map_err(|reason| write_error(&path.join(LOCK_FILE), reason))?;
        let lock = Locked::new(lock).map_err(|_| StudyFolderError::Busy {
            folder: path.to_owned(),
        })?;
        if manifest.is_file() {
            let found = read_text(&manifest, &MANIFEST).map_err(|error| unreadable(&manifest, error))?;
            error::compare(path, &manifest, &found, &description)?;
        } else {
            folder.write(|files| files.add(manifest_name, |out| out.write_all(description.as_bytes())))?;
        }
        Ok(Self {
            removed: staging::remove_left_over([&folder]),
            path: path.to_owned(),
            fingerprint,
            description,
            count,
            part_size: part_size(count),
            _lock: lock,
            writing: Mutex::new(()),
        })
    }

    /// Returns the folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the hidden folders that killed programs had left here and that were removed.
    #[must_use]
    pub fn removed(&self) -> &[PathBuf] {
        &self.removed
    }

    /// Number of parts.
    #[must_use]
    pub fn parts(&self) -> u64 {
        self.count.div_ceil(self.part_size)
    }

    /// Returns the numbers of the variants of a part.
    #[must_use]
    pub fn numbers(&self, part: u64) -> Range<u64> {
        let start = part * self.part_size;
        start..(start + self.part_size).min(self.count)
    }

    /// Returns the part of a variant.
    #[must_use]
    pub fn part_of(&self, number: u64) -> u64 {
        number / self.part_size
    }

    fn file_of(&self, part: u64) -> PathBuf {
        self.path.join(PARTS).join(format!("part-{part:06}"))
    }

    /// Returns the contents of a part so far.
    ///
    /// # Errors
    /// It cannot be read, has records of another study, or two that contradict each other.
    pub fn part(&self, part: u64) -> Result<StudyPart, StudyFolderError> {
        let file = self.file_of(part);
        let bytes = match read(&file, &RECORDS) {
            Ok(bytes) => bytes,
            Err(error) if matches!(error.reason, Reason::NotFound) => Vec::new(),
            Err(error) => return Err(unreadable(&file, error)),
        };
        let found = records::read(self.fingerprint, &bytes);
        let numbers = self.numbers(part);
        let outside = found
            .records
            .iter()
            .any(|record| !numbers.contains(&record.number));
        if found.foreign || outside {
            return Err(StudyFolderError::ForeignPart { file });
        }
        let mut records = found.records;
        records.sort_by_key(|record| record.number);
        let contradiction = records
            .windows(2)
            .find(|pair| pair[0].number == pair[1].number && pair[0] != pair[1]);
        if let Some(pair) = contradiction {
            return Err(StudyFolderError::Contradiction {
                number: pair[0].number,
                file,
            });
        }
        records.dedup_by_key(|record| record.number);
        Ok(StudyPart {
            records,
            lost: found.lost,
        })
    }

    /// Returns the numbers of a part's variants that have no record yet.
    ///
    /// # Errors
    /// As [`StudyFolder::part`].
    pub fn missing(&self, part: u64) -> Result<Vec<u64>, StudyFolderError> {
        let done = self.part(part)?;
        let mut records = done.records.iter().map(|record| record.number).peekable();
        Ok(self
            .numbers(part)
            .filter(|number| records.next_if_eq(number).is_none())
            .collect())
    }

    /// Keeps a record: when this returns, it survives the end of the program.
    ///
    /// # Errors
    /// It cannot be written; what was written before stays.
    pub fn keep(&self, record: &Record) -> Result<(), StudyFolderError> {
        let mut bytes = Vec::new();
        record.write(self.fingerprint, &mut bytes);
        let file = self.file_of(self.part_of(record.number));
        let _one_at_a_time = self.writing.lock().unwrap_or_else(PoisonError::into_inner);
        let failed = |reason| StudyFolderError::Append {
            file: file.clone(),
            reason,
        };
        let mut out = OpenOptions::new()
            .append(true)
            .create(true)
            .open(&file)
            .map_err(failed)?;
        let before = out.metadata().map_err(failed)?.len();
        out.write_all(&bytes).map_err(|reason| {
            // What there is of it would be passed over; without it the file is tidier.
            let _ = out.set_len(before);
            failed(reason)
        })
    }

    /// Keeps records that another worker computed ([`records::run_all`]); gives their number.
    ///
    /// # Errors
    /// The bytes hold something else than records of this study, or they cannot be written.
    pub fn keep_all(&self, bytes: &[u8]) -> Result<u64, StudyFolderError> {
        let found = records::read(self.fingerprint, bytes);
        if found.foreign || found.lost > 0 {
            return Err(StudyFolderError::ForeignBytes);
        }
        for record in &found.records {
            self.keep(record)?;
        }
        Ok(found.records.len() as u64)
    }

    /// Keeps those of the records of a part that are not there yet; gives their number.
    ///
    /// # Errors
    /// The part cannot be read, the bytes hold records of another study or part, or they cannot be written.
    pub fn keep_new(&self, part: u64, bytes: &[u8]) -> Result<u64, StudyFolderError> {
        let missing = self.missing(part)?;
        let found = records::read(self.fingerprint, bytes);
        let numbers = self.numbers(part);
        let is_foreign = |record: &Record| !numbers.contains(&record.number);
        if found.foreign || found.records.iter().any(is_foreign) {
            return Err(StudyFolderError::ForeignBytes);
        }
        let new: BTreeMap<u64, Record> = found
            .records
            .into_iter()
            .filter(|record| missing.binary_search(&record.number).is_ok())
            .map(|record| (record.number, record))
            .collect();
        new.values().try_for_each(|record| self.keep(record))?;
        Ok(new.len() as u64)
    }

    /// Refuses another study whose description was found elsewhere, in a `place`.
    ///
    /// # Errors
    /// It is another study, or no description of one.
    pub fn compare(&self, place: &Path, description: &str) -> Result<(), StudyFolderError> {
        error::compare(place, &place.join(STUDY_FILE), description, &self.description)
    }

    /// Makes the table of all records, in the order of their numbers, as Parquet and as CSV, and shows each
    /// row to `each` with the values of the factors. Memory does not grow with the number of records.
    ///
    /// # Errors
    /// A record is missing, a part cannot be read, or the table cannot be written.
    pub fn merge(
        &self,
        study: &Study,
        mut each: impl FnMut(&[Option<Value>], &Record),
    ) -> Result<(), StudyFolderError> {
        let folder = Folder::check(&self.path, &[TABLE_FILE, TABLE_CSV_FILE], true)?;
        let table = table(study);
        // An error of reading leaves the closure of writing by this way.
        let mut unread = None;
        let written = folder.write(|files| {
            files.add(TABLE_FILE, |out| {
                let mut rows = self.rows(&table, out)?;
                self.for_each(0..self.parts(), &mut unread, |record| {
                    let row = (study.values(record.number), record);
                    rows.row(table.cells(&row)).map_err(plain)?;
                    each(&row.0, &row.1);
                    Ok(())
                })?;
                rows.finish().map_err(plain)
            })?;
            // The parts are read again: the rows need not be kept.
            files.add(TABLE_CSV_FILE, |out| {
                let mut lines = csv::Lines::new(table.descriptions(), out)?;
                self.for_each(0..self.parts(), &mut unread, |record| {
                    lines.row(table.cells(&(study.values(record.number), record)))
                })
            })
        });
        match unread {
            Some(error) => Err(error),
            None => written.map_err(StudyFolderError::after_all_runs),
        }
    }

    /// Returns the rows of a part that has all its records as a Parquet file of its own: those of all parts,
    /// in their order, are the table of [`StudyFolder::merge`].
    ///
    /// # Errors
    /// A record is missing, or the part cannot be read.
    pub fn part_table(&self, study: &Study, part: u64) -> Result<Vec<u8>, StudyFolderError> {
        let table = table(study);
        let (mut bytes, mut unread) = (Vec::new(), None);
        let mut write = || {
            let mut rows = self.rows(&table, &mut bytes)?;
            self.for_each(part..part + 1, &mut unread, |record| {
                let row = (study.values(record.number), record);
                rows.row(table.cells(&row)).map_err(plain)
            })?;
            rows.finish().map_err(plain)
        };
        match (write(), unread) {
            (_, Some(error)) => Err(error),
            (Err(reason), None) => Err(StudyFolderError::Table {
                file: self.file_of(part),
                reason,
            }),
            (Ok(()), None) => Ok(bytes),
        }
    }

    fn rows<W: Write + Send>(
        &self,
        table: &OutputTable<'_, (Vec<Option<Value>>, Record)>,
        out: W,
    ) -> io::Result<TableWriter<W>> {
        let metadata = [(STUDY_KEY, self.description.clone())];
        let columns = table.descriptions().to_vec();
        TableWriter::new(out, columns, Storage::Values, &metadata).map_err(plain)
    }

    /// Shows all records of some parts to `each`, in the order of their numbers; why they cannot be read is
    /// left in `unread`.
    fn for_each(
        &self,
        parts: Range<u64>,
        unread: &mut Option<StudyFolderError>,
        mut each: impl FnMut(Record) -> io::Result<()>,
    ) -> io::Result<()> {
        for part in parts {
            let found =
                self.part(part)
                    .and_then(|found| match self.numbers(part).count() - found.records.len() {
                        0 => Ok(found),
                        missing => Err(StudyFolderError::Incomplete { missing }),
                    });
            match found {
                Ok(found) => found.records.into_iter().try_for_each(&mut each)?,
                Err(error) => {
                    *unread = Some(error);
                    return Err(io::Error::other("a part cannot be read"));
                }
            }
        }
        Ok(())
    }
}

/// Refuses a folder that holds anything but the beginnings of such runs.
fn refuse_foreign(path: &Path, manifest: &str, made: &[&str]) -> Result<(), StudyFolderError> {
    let Ok(entries) = fs::read_dir(path) else {
        // It is not there, or what is wrong with it will be said when it is written to.
        return Ok(());
    };
    // With parts it is a study whose description was moved away; whose records they are, each of them tells.
    let made: &[&str] = match path.join(PARTS).is_dir() {
        true => made,
        false if made.contains(&SERIES) => &[SERIES],
        false => &[],
    };
    let own = |name: &str| {
        [LOCK_FILE, PARTS, manifest].contains(&name)
            || name.starts_with(staging::HIDDEN)
            || made.contains(&name)
    };
    let mut names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    match names.find(|name| !own(name)) {
        Some(name) => Err(StudyFolderError::NotAStudy {
            folder: path.to_owned(),
            name,
        }),
        None => Ok(()),
    }
}

fn write_error(file: &Path, reason: io::Error) -> StudyFolderError {
    StudyFolderError::File(FileError::Write {
        file: file.to_owned(),
        reason,
    })
}

/// Returns the name of a factor's column, with its unit: `wedge.angle_deg`. Of a toe it says the direction in
/// which it is positive: `side_frame.toe_out_deg`.
#[must_use]
pub fn factor_column(factor: &Factor) -> String {
    value_column(factor.name(), factor.unit().unwrap_or(""))
}

/// Returns the name of the column of a parameter's values in a unit, as [`factor_column`].
#[must_use]
pub fn value_column(name: &str, unit: &str) -> String {
    let suffix = unit.replace('/', " per ").replace(['^', '(', ')'], "");
    let words: Vec<&str> = suffix
        .split([' ', '*', '·'])
        .filter(|word| !word.is_empty())
        .collect();
    let name = match name.ends_with(".toe") && !words.is_empty() {
        true => format!("{name}_out"),
        false => name.to_owned(),
    };
    if words.is_empty() {
        name
    } else {
        format!("{name}_{}", words.join("_"))
    }
}

/// Returns the table of a study, without rows: values of the factors, and the record.
#[must_use]
pub fn table(study: &Study) -> OutputTable<'_, (Vec<Option<Value>>, Record)> {
    let mut table = OutputTable::<(Vec<Option<Value>>, Record)>::new([], study.units());
    let number = ["run", "", "number of the variant, from 0"];
    table.column(number, Content::Integer, |(_, record)| {
        Cell::Integer(record.number as i64)
    });
    let status = "complete; refused: its values make no run; stopped: it did not come to its end; failed: \
                  its energy ledger does not close, and its measures are not to be used; derailed: a wheel \
                  left its rail, where it ended, and its measures are of the part until then";
    table.column(["status", "", status], Content::Text, |(_, record)| {
        record.status.name().into()
    });
    for (place, factor) in study.factors.iter().enumerate() {
        let text = match factor.paths.as_slice() {
            [_] => "varied".to_owned(),
            [_, others @ ..] => format!("varied, and with it {}", others.join(", ")),
            [] => String::new(),
        };
        let unit = factor.unit();
        let content = unit.map_or(Content::Text, |_| Content::Number);
        let about = [&factor_column(factor), unit.unwrap_or(""), &text];
        table.column(about, content, move |(values, _)| match (&values[place], unit) {
            (None, _) => Cell::Missing,
            (Some(value), Some(unit)) => value.in_unit(unit).map_or(Cell::Missing, Cell::Number),
            (Some(value), None) => Cell::Text(value.shown()),
        });
    }
    for (place, measure) in study.measures().iter().enumerate() {
        table.quantity(
            [&measure.name, &measure.text],
            measure.kind,
            move |(_, record), factor| {
                Cell::Number(record.measures.0.get(place).copied().unwrap_or(f64::NAN) * factor)
            },
        );
    }
    let reason = ["reason", "", "why it is not complete"];
    table.column(reason, Content::Text, |(_, record)| record.reason.as_str().into());
    table
}
