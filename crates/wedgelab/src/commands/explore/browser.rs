//! Opening the page in a browser, without showing its secret to other users of the machine.
//!
//! Every user can read a program's arguments. So the browser is called with a file that only its owner may
//! read, and that leads on to the address.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The file that leads to the page; it is removed with this.
pub struct Leading {
    file: PathBuf,
}

impl Leading {
    /// Writes the file and calls a browser with it: `$BROWSER`, or the one that the system has.
    ///
    /// # Errors
    /// The file cannot be written, or there is no browser to call.
    pub fn open(address: &str) -> io::Result<Self> {
        let leading = Self::write(&std::env::temp_dir(), address)?;
        call(&leading.file)?;
        Ok(leading)
    }

    fn write(folder: &Path, address: &str) -> io::Result<Self> {
        let mut bytes = [0; 8];
        getrandom::fill(&mut bytes).map_err(io::Error::other)?;
        let file = folder.join(format!(
            "wedgelab-explore-{:016x}.html",
            u64::from_le_bytes(bytes)
        ));
        let mut options = OpenOptions::new();
        options.write(true).create_new(true);
        #[cfg(unix)]
        std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        let mut out = options.open(&file)?;
        let leading = Self { file };
        write!(
            out,
            "<!doctype html><meta charset=\"utf-8\"><title>Wedgelab</title><meta name=\"referrer\" \
             content=\"no-referrer\"><meta http-equiv=\"refresh\" content=\"0;url={address}\">\n\
             <a href=\"{address}\">Wedgelab</a>\n"
        )?;
        Ok(leading)
    }
}

impl Drop for Leading {
    fn drop(&mut self) {
        // Its secret is of no use any more.
        let _ = fs::remove_file(&self.file);
    }
}

fn call(file: &Path) -> io::Result<()> {
    let mut command = match std::env::var_os("BROWSER").filter(|own| !own.is_empty()) {
        Some(own) => Command::new(own),
        None if cfg!(target_os = "macos") => Command::new("open"),
        None if cfg!(windows) => Command::new("explorer"),
        None => Command::new("xdg-open"),
    };
    let none = || Stdio::null();
    command.arg(file).stdin(none()).stdout(none()).stderr(none());
    // It goes on by itself; nobody waits for it.
    command.spawn().map(drop)
}
