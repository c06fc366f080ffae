//! Locked files.

use std::fs::{File, TryLockError};

/// A file that this program has locked. The system unlocks it when the program ends, however it ends.
///
/// Closing the file alone would not do: between `fork` and `exec` a child that another thread of this program
/// starts holds the same open file, and with it the lock, for some milliseconds more.
#[derive(Debug)]
pub struct Locked(File);

impl Locked {
    /// Locks a file.
    ///
    /// # Errors
    /// Another program has locked it, or it cannot be locked.
    pub fn new(file: File) -> Result<Self, TryLockError> {
        file.try_lock().map(|()| Self(file))
    }

    /// Returns the file, to be written to.
    pub fn file(&mut self) -> &mut File {
        &mut self.0
    }
}

impl Drop for Locked {
    fn drop(&mut self) {
        // What cannot be unlocked is unlocked when it is closed.
        let _ = self.0.unlock();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A duplicate stands for the child between `fork` and `exec`.
    #[test]
    fn issue_035_behaviour_a_lock_ends_though_a_child_still_holds_the_file() {
        let held = tempfile::NamedTempFile::new().expect("a file");
        let other = || File::open(held.path()).expect("it opens");
        let own = held.reopen().expect("it opens");
        let child = own.try_clone().expect("a duplicate");
        let locked = Locked::new(own).expect("nobody else has it");
        assert!(matches!(Locked::new(other()), Err(TryLockError::WouldBlock)));
        drop(locked);
        assert!(Locked::new(other()).is_ok());
        drop(child);
    }
}
