//! Tables as Parquet files, with the unit of each column in the file's metadata.
//!
//! Rows are gathered and written in groups, so that the memory needed does not grow with the table; the same
//! rows give the same bytes. Tables of runs ([`Storage::Histories`]) are stored smaller than others: the
//! bytes of numbers by place, so that signs and exponents, which hardly change, lie side by side, and
//! deflated. No number loses a bit. The metadata has, under `wedgelab.columns`, JSON with name, unit and text
//! of each column, and what else the writer is given.

use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{Compression, Encoding, GzipLevel, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{WriterProperties, WriterPropertiesBuilder};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use crate::output_table::{Cell, Content, Description};

/// The key of the columns' description in the metadata.
pub const COLUMNS_KEY: &str = "wedgelab.columns";
/// Rows of a group.
const GROUP: usize = 16_384;

/// How the numbers of a table are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// Values that may repeat: dictionaries, Snappy.
    Values,
    /// Numbers that change from row to row: byte stream split, GZIP.
    Histories,
}

impl Storage {
    fn properties(self) -> WriterPropertiesBuilder {
        let builder = WriterProperties::builder();
        match self {
            Self::Values => builder.set_compression(Compression::SNAPPY),
            Self::Histories => builder
                .set_compression(Compression::GZIP(GzipLevel::default()))
                .set_dictionary_enabled(false)
                .set_encoding(Encoding::BYTE_STREAM_SPLIT),
        }
    }
}

/// The values of a column that are gathered; missing ones are left out.
#[derive(Debug, Default)]
struct Gathered {
    integers: Vec<i64>,
    numbers: Vec<f64>,
    texts: Vec<ByteArray>,
    /// 1 for each value that is there, 0 for each that is missing.
    levels: Vec<i16>,
}

/// Writes a table row by row.
pub struct TableWriter<W: Write + Send> {
    writer: SerializedFileWriter<W>,
    columns: Vec<Description>,
    gathered: Vec<Gathered>,
    rows: usize,
}

impl<W: Write + Send> TableWriter<W> {
    /// Returns a table of these columns; `metadata` are further keys with their values.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn new(
        out: W,
        columns: Vec<Description>,
        storage: Storage,
        metadata: &[(&str, String)],
    ) -> Result<Self, ParquetError> {
        let described =
            serde_json::to_string(&columns).map_err(|error| ParquetError::External(error.into()))?;
        let mut pairs = vec![KeyValue::new(COLUMNS_KEY.to_owned(), described)];
        pairs.extend(
            metadata
                .iter()
                .map(|(key, value)| KeyValue::new((*key).to_owned(), value.clone())),
        );
        let properties = storage
            .properties()
            .set_created_by(format!("wedgelab {}", env!("CARGO_PKG_VERSION")))
            .set_key_value_metadata(Some(pairs))
            .build();
        let fields = columns.iter().map(field).collect::<Result<Vec<_>, _>>()?;
        let schema = Type::group_type_builder("schema").with_fields(fields).build()?;
        Ok(Self {
            writer: SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties))?,
            gathered: columns.iter().map(|_| Gathered::default()).collect(),
            columns,
            rows: 0,
        })
    }

    /// Adds a row: a cell for each column, of its content or missing.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn row<'c>(&mut self, cells: impl IntoIterator<Item = Cell<'c>>) -> Result<(), ParquetError> {
        let mut cells = cells.into_iter();
        for (column, gathered) in self.columns.iter().zip(&mut self.gathered) {
            let level = match (column.content, cells.next()) {
                (Content::Integer, Some(Cell::Integer(value))) => {
                    gathered.integers.push(value);
                    1
                }
                (Content::Number, Some(Cell::Number(value) | Cell::Decimal(value))) if !value.is_nan() => {
                    gathered.numbers.push(value);
                    1
                }
                (Content::Text, Some(Cell::Text(text))) => {
                    gathered.texts.push(ByteArray::from(text.as_bytes().to_vec()));
                    1
                }
                _ => 0,
            };
            gathered.levels.push(level);
        }
        self.rows += 1;
        if self.rows >= GROUP {
            self.flush()?;
        }
        Ok(())
    }

    fn flush(&mut self) -> Result<(), ParquetError> {
        if self.rows == 0 {
            return Ok(());
        }
        let mut group = self.writer.next_row_group()?;
        let mut columns = self.columns.iter().zip(&mut self.gathered);
        while let Some(mut out) = group.next_column()? {
            let Some((column, gathered)) = columns.next() else {
                break;
            };
            let levels = Some(gathered.levels.as_slice());
            match column.content {
                Content::Integer => out
                    .typed::<Int64Type>()
                    .write_batch(&gathered.integers, levels, None)?,
                Content::Number => out
                    .typed::<DoubleType>()
                    .write_batch(&gathered.numbers, levels, None)?,
                Content::Text => out
                    .typed::<ByteArrayType>()
                    .write_batch(&gathered.texts, levels, None)?,
            };
            out.close()?;
            *gathered = Gathered::default();
        }
        group.close()?;
        self.rows = 0;
        Ok(())
    }

    /// Writes what is left and ends the file.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn finish(mut self) -> Result<(), ParquetError> {
        self.flush()?;
        self.writer.close().map(|_| ())
    }
}

fn field(column: &Description) -> Result<Arc<Type>, ParquetError> {
    let (physical, logical) = match column.content {
        Content::Integer => (Physical::INT64, None),
        Content::Number => (Physical::DOUBLE, None),
        Content::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
    };
    let field = Type::primitive_type_builder(&column.name, physical)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(logical);
    field.build().map(Arc::new)
}

/// Returns the system's error, without the library's words around it.
pub(crate) fn plain(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(reason) => io::Error::other(reason),
        other => io::Error::other(other),
    }
}
