//! `result.parquet`: the table of a run as a Parquet file, under the names and in the units of `result.csv`,
//! each number with all of its bits.
//!
//! Rows lie in groups ([`parquet`](crate::parquet)); the metadata has name, unit and text of each column
//! under `wedgelab.columns`, and [`TABLE_KEY`] with the schema. Parquet tables of other programs are read as
//! well, if their columns are numbers and have names as a CSV table has.

use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use bytes::Bytes;
use input::limits;
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};

use crate::output_table::RunTable;
use crate::parquet::Storage;
use crate::table::TableError;

/// The file's name.
pub const FILE_NAME: &str = "result.parquet";
/// The key of the schema in the metadata.
pub const TABLE_KEY: &str = "wedgelab.table";
/// The schema.
const SCHEMA: &str = "wedgelab.result/1";

/// Writes the table of a run.
///
/// # Errors
/// The writer's.
pub fn write(table: &RunTable<'_>, out: &mut (dyn Write + Send)) -> io::Result<()> {
    table.write_parquet(Storage::Histories, (TABLE_KEY, SCHEMA.to_owned()), out)
}

/// Names of columns with their values; a value that is missing is no number.
pub(crate) type Read = Vec<(String, Vec<f64>)>;

/// Reads a Parquet file of numbers.
///
/// # Errors
/// It is damaged, too large, or has other columns than numbers.
pub(crate) fn read(file: &Path, bytes: Vec<u8>) -> Result<Read, TableError> {
    let damaged = |reason: String| TableError::Damaged {
        file: file.to_owned(),
        reason: input::shortened(&reason),
    };
    // The library gives up on some damaged files by a panic.
    match catch_unwind(AssertUnwindSafe(|| read_columns(file, Bytes::from(bytes)))) {
        Ok(Ok(read)) => read,
        Ok(Err(error)) => Err(damaged(error.to_string())),
        Err(_) => Err(damaged("its pages contradict its directory".to_owned())),
    }
}

fn read_columns(file: &Path, bytes: Bytes) -> Result<Result<Read, TableError>, ParquetError> {
    let reader = SerializedFileReader::new(bytes)?;
    let metadata = reader.metadata();
    let columns = metadata.file_metadata().schema_descr().columns();
    let names: Vec<String> = columns.iter().map(|column| column.path().string()).collect();
    if names.starts_with(&["run".to_owned(), "status".to_owned()]) {
        return Ok(Err(TableError::of_study(file)));
    }
    let rows = usize::try_from(metadata.file_metadata().num_rows()).unwrap_or(usize::MAX);
    if rows.saturating_mul(names.len().max(1)) > limits::RESULT_CELLS {
        let line = (limits::RESULT_CELLS / names.len().max(1)) as u64 + 1;
        let file = file.to_owned();
        return Ok(Err(TableError::TooLarge { file, line }));
    }
    let mut all: Read = names.into_iter().map(|name| (name, Vec::new())).collect();
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group)?;
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
        for (place, (_, values)) in all.iter_mut().enumerate() {
            let of_group = match group.get_column_reader(place)? {
                ColumnReader::DoubleColumnReader(own) => numbers(own, rows, |value| value)?,
                ColumnReader::FloatColumnReader(own) => numbers(own, rows, f64::from)?,
                ColumnReader::Int32ColumnReader(own) => numbers(own, rows, f64::from)?,
                ColumnReader::Int64ColumnReader(own) => numbers(own, rows, |value| value as f64)?,
                _ => {
                    return Ok(Err(TableError::foreign(
                        file,
                        "a Parquet table with more than numbers",
                    )));
                }
            };
            values.extend(of_group);
        }
    }
    Ok(Ok(all))
}

/// Returns the values of a column of a group; one that is missing is no number.
fn numbers<T: DataType>(
    mut column: ColumnReaderImpl<T>,
    rows: usize,
    number: impl Fn(T::T) -> f64,
) -> Result<Vec<f64>, ParquetError> {
    let (mut values, mut levels) = (Vec::new(), Vec::new());
    let (read, ..) = column.read_records(rows, Some(&mut levels), None, &mut values)?;
    if read != rows || (levels.is_empty() && values.len() != rows) {
        return Err(ParquetError::EOF("a column ends too early".to_owned()));
    }
    if levels.is_empty() {
        return Ok(values.into_iter().map(number).collect());
    }
    let mut present = values.into_iter();
    let mut next = |level: i16| match level {
        0 => f64::NAN,
        _ => present.next().map_or(f64::NAN, &number),
    };
    Ok(levels.into_iter().map(&mut next).collect())
}
