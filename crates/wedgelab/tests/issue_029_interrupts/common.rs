//! Commands under way, and signals to them.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// The signals, with their exit codes.
pub const SIGNALS: [(&str, i32); 3] = [("INT", 130), ("TERM", 143), ("HUP", 129)];
/// A run that does not end by itself, with few rows.
pub const ENDLESS: [&str; 4] = [
    "--set",
    "simulation.duration=100000 s",
    "--set",
    "simulation.output_interval=0.5 s",
];
/// Nothing that is waited for takes longer.
const PATIENCE: Duration = Duration::from_secs(120);

/// A command that has ended.
pub struct Ended {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

/// A command under way; it is killed if a test fails.
pub struct Running {
    child: Option<Child>,
    /// The messages read so far.
    said: String,
}

pub fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wedgelab"));
    prepare(&mut command, folder);
    command.args(arguments);
    command
}

fn prepare(command: &mut Command, folder: &Path) {
    command
        .current_dir(folder)
        .env_remove("FORCE_COLOR")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
}

/// Returns a shell's line under way, in which `$0` is the program.
pub fn start_by_shell(folder: &Path, line: &str) -> Running {
    let mut command = Command::new("sh");
    prepare(&mut command, folder);
    command.args(["-c", line, env!("CARGO_BIN_EXE_wedgelab")]);
    spawn(&mut command)
}

pub fn start(folder: &Path, arguments: &[&str]) -> Running {
    spawn(&mut command(folder, arguments))
}

fn spawn(command: &mut Command) -> Running {
    Running {
        child: Some(command.spawn().unwrap()),
        said: String::new(),
    }
}

/// Runs a command to its end.
pub fn wedgelab(folder: &Path, arguments: &[&str]) -> Ended {
    start(folder, arguments).ended()
}

/// Runs a command that ends well.
#[track_caller]
pub fn done(folder: &Path, arguments: &[&str]) -> Ended {
    let ended = wedgelab(folder, arguments);
    assert_eq!(ended.code, Some(0), "{arguments:?}: {}", ended.err);
    ended
}

impl Running {
    fn id(&self) -> u32 {
        self.child.as_ref().unwrap().id()
    }

    pub fn is_working(&mut self) -> bool {
        self.child.as_mut().unwrap().try_wait().unwrap().is_none()
    }

    /// Sends a signal; nothing happens if the command has ended.
    pub fn send(&self, signal: &str) {
        let mut kill = Command::new("kill");
        kill.arg(format!("-{signal}")).arg(self.id().to_string());
        kill.stderr(Stdio::null()).status().unwrap();
    }

    /// Waits until something is so, or the command has ended.
    #[track_caller]
    pub fn wait_until(&mut self, mut is_so: impl FnMut() -> bool) {
        let start = Instant::now();
        while !is_so() && self.is_working() {
            assert!(start.elapsed() < PATIENCE, "it does not come to that");
            std::thread::yield_now();
        }
    }

    /// Waits until the command has computed for a while: longer than it takes to begin.
    #[track_caller]
    pub fn wait_for_work(&mut self) {
        let stat = PathBuf::from(format!("/proc/{}/stat", self.id()));
        if !stat.exists() {
            std::thread::sleep(Duration::from_secs(1));
        }
        self.wait_until(|| match fs::read_to_string(&stat) {
            // Hundredths of a second in user mode, the twelfth number after the name in parentheses.
            Ok(text) => {
                let after = text.rsplit(')').next().unwrap_or_default();
                let ticks = after.split_whitespace().nth(11);
                ticks.is_some_and(|ticks| ticks.parse::<u64>().unwrap() >= 30)
            }
            Err(_) => true,
        });
        assert!(self.is_working(), "it has ended too early");
    }

    /// Waits until the command catches a signal with this number. Only where the system tells.
    #[cfg(target_os = "linux")]
    pub fn wait_until_it_listens(&mut self, number: u32) {
        let status = PathBuf::from(format!("/proc/{}/status", self.id()));
        self.wait_until(|| {
            let text = fs::read_to_string(&status).unwrap_or_default();
            let mask = text.lines().find_map(|line| line.strip_prefix("SigCgt:"));
            let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
            mask.is_some_and(|mask| mask >> (number - 1) & 1 == 1)
        });
    }

    /// Waits until the command has said something.
    #[track_caller]
    pub fn wait_until_it_says(&mut self, text: &str) {
        let err = self.child.as_mut().unwrap().stderr.as_mut().unwrap();
        let mut byte = [0];
        while !self.said.contains(text) {
            assert!(
                err.read(&mut byte).unwrap() == 1,
                "{text:?} is not in: {}",
                self.said
            );
            self.said.push(char::from(byte[0]));
        }
    }

    /// Kills the command; tells whether it was still at work.
    pub fn kill(mut self) -> bool {
        let mut child = self.child.take().unwrap();
        let working = child.try_wait().unwrap().is_none();
        child.kill().unwrap();
        child.wait().unwrap();
        working
    }

    pub fn ended(mut self) -> Ended {
        let output = self.child.take().unwrap().wait_with_output().unwrap();
        let ended = Ended {
            code: output.status.code(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: self.said.clone() + &String::from_utf8(output.stderr).unwrap(),
        };
        assert!(!ended.err.contains("panicked"), "{}", ended.err);
        ended
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if let Some(child) = &mut self.child {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

/// Returns the names in a folder, sorted; none if it is not there.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// Returns the hidden folders in a folder and all below it.
pub fn hidden(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for name in names(folder) {
        let path = folder.join(&name);
        if name.starts_with(".wedgelab-") {
            found.push(path);
        } else if path.is_dir() {
            found.append(&mut hidden(&path));
        }
    }
    found
}

#[track_caller]
pub fn contains(text: &str, pieces: &[&str]) {
    for piece in pieces {
        assert!(text.contains(piece), "{piece:?} is not in: {text}");
    }
}

pub fn json(file: &Path) -> serde_json::Value {
    serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap()
}

/// Checks that the files of a run are there and agree with each other; returns its summary.
#[track_caller]
pub fn whole_run(folder: &Path) -> serde_json::Value {
    let summary = json(&folder.join("summary.json"));
    let table = fs::read_to_string(folder.join("result.csv")).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    let cells = |line: &str| line.split(',').count();
    assert!(table.ends_with('\n') && lines.iter().all(|line| cells(line) == cells(lines[0])));
    assert_eq!(summary["rows"], lines.len() - 1);
    let mat = fs::read(folder.join("result.mat")).unwrap();
    let mut place = 128;
    while place < mat.len() {
        let length = u32::from_le_bytes(mat[place + 4..place + 8].try_into().unwrap());
        place += 8 + length as usize;
    }
    assert_eq!(place, mat.len(), "the MAT-file is cut off");
    summary
}
