//! The limits of every reader. `docs/reliability.md` lists them for users.
//!
//! Each limit is far beyond what any real input needs and far below what takes a second or a gigabyte; where
//! a limit was chosen by another one, its comment says so.

/// Largest file that holds a case, a study, a table of a case or a file of NUCARS, in bytes.
///
/// A table of [`TABLE_ROWS`] rows, embedded in a case, has about 5 MB.
pub const TEXT_FILE: u64 = 16 << 20;

/// Largest table of results (CSV), in bytes: a run of [`OUTPUT_ROWS`] rows writes about as much.
pub const RESULT_FILE: u64 = 1 << 30;

/// Most cells of a table of results; as numbers they take 8 bytes each.
pub const RESULT_CELLS: usize = 60_000_000;

/// Largest file of records, summary or description of a study, in bytes.
pub const RECORD_FILE: u64 = 64 << 20;

/// Largest saved state of a run, in bytes: with [`OUTPUT_ROWS`] rows of the columns that a car's summary
/// reads it has about 190 MB.
pub const SAVED_STATE: u64 = 256 << 20;

/// Longest line of a text, in bytes. A list of points may be written in one line.
pub const LINE: usize = 4 << 20;

/// Deepest nesting of lists and tables in TOML, of keys joined by dots, and of brackets in a unit.
///
/// The parsers recurse; a case needs four.
pub const NESTING: usize = 16;

/// Most values (keys, list items) of a TOML text; each takes some 300 bytes while it is read.
pub const VALUES: usize = 1_000_000;

/// Most rows of a table in a case, or beside it.
pub const TABLE_ROWS: usize = 100_000;

/// Most rows of all tables of a case together, so that the case can be written with its tables inside and
/// read again (three values a row, see [`VALUES`]).
pub const CASE_ROWS: usize = 300_000;

/// Most parameters that a study varies, and most that it sets for all runs.
pub const FACTORS: usize = 100;

/// Most limits in a file of them: each is compared with all before it.
pub const LIMITS: usize = 1000;

/// Most conditions in a file of them: each is tried on a car, which takes some hundredths of a second.
pub const CONDITIONS: usize = 100;

/// Longest text of one quantity, number and unit together, in bytes.
pub const QUANTITY: usize = 256;

/// Largest library for one platform in an FMU, in bytes.
pub const FMU_LIBRARY: u64 = 256 << 20;

/// Largest FMU as a file, in bytes; largest size of all files in FMUs that are merged; most files in one.
pub const FMU_FILE: u64 = 64 << 20;
/// See [`FMU_FILE`].
pub const FMU_UNPACKED: u64 = 512 << 20;
/// See [`FMU_FILE`].
pub const FMU_FILES: usize = 1000;

/// Most values in one call of an FMU's importer.
pub const FMU_VALUES: usize = 1 << 20;

/// Most rows of a run's output: more than an hour at the usual interval of 0.01 s.
///
/// With 133 columns they take 430 MB in memory and about 1 GB as CSV.
pub const OUTPUT_ROWS: u64 = 400_000;

/// Most mistakes reported of one file; the others are counted.
pub const MISTAKES: usize = 20;

/// Longest message or advice, in bytes; a longer one is cut.
pub const MESSAGE: usize = 1000;

/// Longest piece of a user's text quoted in a message, in characters.
pub const QUOTED: usize = 60;

/// Length of a long line shown on either side of a mistake, bytes.
pub const EXCERPT: usize = 120;
