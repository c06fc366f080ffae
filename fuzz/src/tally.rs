//! The counts of a worker, in a small file that outlives it.

use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

const FIELDS: usize = 8;

/// Counts of one reader.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// The number of the input that is being read.
    pub number: u64,
    /// The number of attempts: the time of an execution is taken twice before it is called too long.
    pub attempt: u64,
    /// Executions that ended.
    pub executions: u64,
    /// Inputs that were accepted.
    pub accepted: u64,
    /// Inputs that were refused.
    pub refused: u64,
    /// Processor time of the longest execution, ns.
    pub slowest: u64,
    /// Bytes that the process held at most.
    pub memory: u64,
    /// Bytes of the longest message.
    pub message: u64,
}

impl Tally {
    fn fields(&self) -> [u64; FIELDS] {
        [
            self.number,
            self.attempt,
            self.executions,
            self.accepted,
            self.refused,
            self.slowest,
            self.memory,
            self.message,
        ]
    }

    /// Adds what another worker of the same reader counted.
    pub fn add(&mut self, other: &Self) {
        self.executions += other.executions;
        self.accepted += other.accepted;
        self.refused += other.refused;
        self.slowest = self.slowest.max(other.slowest);
        self.memory = self.memory.max(other.memory);
        self.message = self.message.max(other.message);
    }

    /// Reads what a worker wrote last; nothing, if it wrote nothing.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn read(path: &Path) -> io::Result<Option<Self>> {
        let mut bytes = [0; 8 * FIELDS];
        let mut file = File::open(path)?;
        match file.read_exact(&mut bytes) {
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(None),
            other => other?,
        }
        let mut fields = [0; FIELDS];
        for (field, bytes) in fields.iter_mut().zip(bytes.as_chunks::<8>().0) {
            *field = u64::from_le_bytes(*bytes);
        }
        let [
            number,
            attempt,
            executions,
            accepted,
            refused,
            slowest,
            memory,
            message,
        ] = fields;
        Ok(Some(Self {
            number,
            attempt,
            executions,
            accepted,
            refused,
            slowest,
            memory,
            message,
        }))
    }
}

/// The file, open for a worker.
pub struct TallyFile(File);

impl TallyFile {
    /// Makes it, empty.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn create(path: &Path) -> io::Result<Self> {
        let file = OpenOptions::new()
            .write(true)
            .create(true)
            .truncate(true)
            .open(path)?;
        Ok(Self(file))
    }

    /// Writes over what is there.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(&mut self, tally: &Tally) -> io::Result<()> {
        let mut bytes = [0; 8 * FIELDS];
        for (bytes, field) in bytes.as_chunks_mut::<8>().0.iter_mut().zip(tally.fields()) {
            *bytes = field.to_le_bytes();
        }
        self.0.seek(SeekFrom::Start(0))?;
        self.0.write_all(&bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("tally");
        let mut file = TallyFile::create(&path).unwrap();
        assert_eq!(Tally::read(&path).unwrap(), None);
        for number in [3, 4] {
            let tally = Tally {
                number,
                accepted: 2,
                message: u64::MAX,
                ..Tally::default()
            };
            file.write(&tally).unwrap();
            assert_eq!(Tally::read(&path).unwrap(), Some(tally));
        }
    }
}
