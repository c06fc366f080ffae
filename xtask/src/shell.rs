//! The place of the workspace, and the start of other programs in it.

use std::cell::RefCell;
use std::env;
use std::ffi::OsStr;
use std::fmt::Display;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Makes cargo (and maturin) compile for all processors of the kind x86-64 instead of those with AVX2
/// (`.cargo/config.toml`): what comes later in these arguments wins. What leaves this machine is compiled so.
pub const PORTABLE: [&str; 2] = [
    "--config",
    "target.'cfg(target_arch = \"x86_64\")'.rustflags=[\"-C\", \"target-cpu=x86-64\"]",
];

/// The workspace on disk and the `cargo` that builds it.
pub struct Workspace {
    /// The folder of the workspace's `Cargo.toml`.
    pub root: PathBuf,
    /// The folder of what cargo builds (`target/`, or `CARGO_TARGET_DIR`).
    pub target: PathBuf,
    /// The cargo that started us.
    cargo: PathBuf,
}

impl Workspace {
    /// Finds the workspace from this package's own folder, which cargo tells us.
    pub fn find() -> Self {
        let package = env::var_os("CARGO_MANIFEST_DIR").unwrap_or_else(|| env!("CARGO_MANIFEST_DIR").into());
        let package = PathBuf::from(package);
        let root = package.parent().map(Path::to_path_buf).unwrap_or(package);
        // `join` leaves an absolute path as it is.
        let target = root.join(env::var_os("CARGO_TARGET_DIR").unwrap_or_else(|| "target".into()));
        let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into()).into();
        Self { root, target, cargo }
    }

    /// `cargo` with these arguments, in the root.
    pub fn cargo<I, S>(&self, arguments: I) -> Command
    where
        I: IntoIterator<Item = S>,
        S: AsRef<OsStr>,
    {
        let mut command = Command::new(&self.cargo);
        command.args(arguments).current_dir(&self.root);
        command
    }
}

/// Returns the command as one would type it; an absolute program path is cut to its last part.
fn line(command: &Command) -> String {
    let program = Path::new(command.get_program());
    let program = program.file_name().unwrap_or(program.as_os_str());
    let words = std::iter::once(program).chain(command.get_args());
    let words: Vec<_> = words.map(|word| word.to_string_lossy()).collect();
    let settings = command.get_envs().filter_map(|(key, value)| Some((key, value?)));
    let settings: String = settings
        .map(|(k, v)| format!("{}=\"{}\" ", k.to_string_lossy(), v.to_string_lossy()))
        .collect();
    settings + &words.join(" ")
}

thread_local! {
    /// Where this thread's output goes, if it is not to be shown.
    static KEPT: RefCell<Option<File>> = const { RefCell::new(None) };
}

/// Does some work; all that it says and what the commands of [`run`] print goes into a file.
pub fn into_file<T>(file: File, work: impl FnOnce() -> T) -> T {
    KEPT.set(Some(file));
    let result = work();
    KEPT.set(None);
    result
}

/// Says something in a line.
pub fn say(text: impl Display) {
    KEPT.with_borrow_mut(|kept| match kept {
        None => println!("{text}"),
        // Whoever cannot write here is told by the command that follows.
        Some(file) => writeln!(file, "{text}").unwrap_or_default(),
    });
}

/// Runs the command with its output shown, after saying what it is.
///
/// # Errors
/// The command cannot be started or does not exit with 0.
pub fn run(command: &mut Command) -> Result<(), String> {
    let line = line(command);
    say(format!("$ {line}"));
    KEPT.with_borrow(|kept| match kept {
        None => Ok(()),
        Some(file) => file.try_clone().and_then(|out| {
            command.stderr(file.try_clone()?).stdout(out);
            Ok(())
        }),
    })
    .map_err(|error| format!("the output of `{line}` cannot be kept: {error}"))?;
    let status = command
        .status()
        .map_err(|error| format!("`{line}` cannot be started: {error}"))?;
    if status.success() {
        Ok(())
    } else {
        Err(format!("`{line}`: {status}"))
    }
}

/// Returns the standard output of a command, or nothing when it fails.
pub fn output(command: &mut Command) -> Option<String> {
    let output = command.stderr(Stdio::null()).output().ok()?;
    output
        .status
        .success()
        .then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_is_shown_as_typed() {
        let mut command = Command::new("cargo");
        command
            .args(["doc", "--no-deps"])
            .env("RUSTDOCFLAGS", "-D warnings");
        assert_eq!(line(&command), "RUSTDOCFLAGS=\"-D warnings\" cargo doc --no-deps");
    }

    #[test]
    fn the_workspace_is_this_one() {
        assert!(Workspace::find().root.join("xtask").join("Cargo.toml").is_file());
    }
}
