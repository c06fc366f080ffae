//! The parent: starts workers, watches them, and goes on after the inputs that break them.

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use fuzz::inputs::Inputs;
use fuzz::readers::Reader;

use crate::finding::{self, Finding, Groups, beginning, without_numbers};
use crate::folder::Folder;
use crate::tally::Tally;
use crate::worker::{FINDINGS, GIVEN_UP, TALLY};

/// The factor by which the wall time of an input may exceed its processor time, where other programs compute
/// beside it.
const WALL: u32 = 20;
/// The interval of checking the workers.
const LOOK: Duration = Duration::from_millis(10);

/// The settings of a run over readers.
pub struct FuzzPlan {
    /// The readers.
    pub readers: Vec<&'static Reader>,
    /// The seed of the inputs.
    pub seed: u64,
    /// Number of readers that work at a time.
    pub jobs: usize,
    /// Processor time after which an input is given up.
    pub patience: Duration,
    /// Time of each reader.
    pub time: Option<Duration>,
    /// Executions of each reader.
    pub executions: Option<u64>,
}

/// The result of a reader.
pub struct ReaderResult {
    /// The reader.
    pub reader: &'static Reader,
    /// Its counts.
    pub tally: Tally,
    /// The findings.
    pub found: Groups,
}

/// Runs all readers, some at a time, and shows each result to `done`.
///
/// # Errors
/// Workers cannot be started, or their files not be read.
pub fn run(plan: &FuzzPlan, done: &(dyn Fn(&ReaderResult) + Sync)) -> Result<Vec<ReaderResult>, String> {
    let folder = Folder::make().map_err(|error| format!("no folder for workers: {error}"))?;
    let results = Mutex::new(Vec::new());
    let next = AtomicUsize::new(0);
    thread::scope(|scope| {
        for _ in 0..plan.jobs.min(plan.readers.len()) {
            scope.spawn(|| {
                while let Some(reader) = plan.readers.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let result = run_reader(reader, plan, folder.path());
                    if let Ok(result) = &result {
                        done(result);
                    }
                    let mut results = results.lock().unwrap_or_else(|lock| lock.into_inner());
                    results.push(result.map_err(|error| format!("{}: {error}", reader.name)));
                }
            });
        }
    });
    let results = results.into_inner().unwrap_or_else(|lock| lock.into_inner());
    let mut results = results.into_iter().collect::<Result<Vec<_>, _>>()?;
    let place = |result: &ReaderResult| {
        plan.readers
            .iter()
            .position(|reader| reader.name == result.reader.name)
    };
    results.sort_by_key(place);
    Ok(results)
}

fn run_reader(reader: &'static Reader, plan: &FuzzPlan, folder: &Path) -> io::Result<ReaderResult> {
    let folder = tempfile::tempdir_in(folder)?;
    let begin = Instant::now();
    let mut result = ReaderResult {
        reader,
        tally: Tally::default(),
        found: Groups::new(),
    };
    let inputs = Inputs::of(reader);
    let mut from = 0;
    loop {
        let left = plan.time.map(|time| time.saturating_sub(begin.elapsed()));
        let until = plan.executions.unwrap_or(u64::MAX);
        if left.is_some_and(|left| left.is_zero()) || from >= until {
            break;
        }
        let ended = Worker::start(reader, folder.path())
            .numbers(plan.seed, from, until)
            .seconds(left)
            .watch(plan.patience)?;
        result.tally.add(&ended.tally);
        for found in ended.findings {
            finding::add(&mut result.found, found);
        }
        let number = ended.tally.number;
        from = number + 1;
        let (what, detail) = match ended.end {
            WorkerEnd::Done => break,
            WorkerEnd::Failed(text) => return Err(io::Error::other(text)),
            WorkerEnd::Broke { what, detail } => (what, detail),
            WorkerEnd::Hung => (
                "hangs".to_owned(),
                format!(
                    "not done after {} s of processor time",
                    plan.patience.as_secs_f64()
                ),
            ),
        };
        result.tally.executions += 1;
        let length = inputs.input(plan.seed, number).len();
        let found = Finding {
            what,
            detail,
            number,
            length,
        };
        finding::add(&mut result.found, found);
    }
    Ok(result)
}

/// The end of a worker.
pub enum WorkerEnd {
    /// As it should.
    Done,
    /// It could not begin.
    Failed(String),
    /// The input broke it.
    Broke {
        /// The description.
        what: String,
        /// The description of it.
        detail: String,
    },
    /// One input took too long.
    Hung,
}

/// The end of a worker.
pub struct Ended {
    /// Its counts.
    pub tally: Tally,
    /// Its findings.
    pub findings: Vec<Finding>,
    /// The way in which it ended.
    pub end: WorkerEnd,
}

/// A worker that is to be started.
pub struct Worker {
    folder: PathBuf,
    command: io::Result<Command>,
}

impl Worker {
    /// Starts a worker of a reader, with its files in a folder.
    pub fn start(reader: &Reader, folder: &Path) -> Self {
        let command = std::env::current_exe().map(|program| {
            let mut command = Command::new(program);
            command
                .args(["worker", "--reader", reader.name, "--folder"])
                .arg(folder);
            // Readers that need a folder make it there.
            command.env("TMPDIR", folder);
            command
        });
        Self {
            folder: folder.to_owned(),
            command,
        }
    }

    fn with(mut self, name: &str, value: &str) -> Self {
        if let Ok(command) = &mut self.command {
            command.args([name, value]);
        }
        self
    }

    /// Returns the numbers of the inputs that it reads.
    #[must_use]
    pub fn numbers(self, seed: u64, from: u64, until: u64) -> Self {
        self.with("--seed", &seed.to_string())
            .with("--from", &from.to_string())
            .with("--until", &until.to_string())
    }

    /// For how long.
    #[must_use]
    pub fn seconds(self, time: Option<Duration>) -> Self {
        match time {
            Some(time) => self.with("--seconds", &time.as_secs_f64().to_string()),
            None => self,
        }
    }

    /// Reads this file only.
    #[must_use]
    pub fn input(self, file: &Path) -> Self {
        self.with("--input", &file.display().to_string())
    }

    /// Starts it, and waits for its end, for as long as one input may take.
    ///
    /// # Errors
    /// It cannot be started, or its files cannot be read.
    pub fn watch(self, patience: Duration) -> io::Result<Ended> {
        let said = self.folder.join("said");
        let (tally, findings) = (self.folder.join(TALLY), self.folder.join(FINDINGS));
        for file in [&tally, &findings, &said] {
            File::create(file)?;
        }
        let mut command = self.command?;
        command.args(["--patience", &patience.as_secs_f64().to_string()]);
        // The worker ends when this end of its input is gone.
        command
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(File::create(&said)?);
        let status = wait(&mut command.spawn()?, &tally, patience)?;
        let counted = Tally::read(&tally)?;
        let end = match status {
            None => WorkerEnd::Hung,
            Some(status) if status.code() == Some(i32::from(GIVEN_UP)) => WorkerEnd::Hung,
            Some(status) if status.success() => WorkerEnd::Done,
            Some(status) => {
                let said = fs::read(&said)?;
                let said = String::from_utf8_lossy(&said);
                match counted {
                    None => WorkerEnd::Failed(format!("{status}: {}", beginning(said.trim()))),
                    Some(_) => broke(status, said.trim()),
                }
            }
        };
        Ok(Ended {
            tally: counted.unwrap_or_default(),
            findings: read_findings(&findings)?,
            end,
        })
    }
}

/// Returns the description of an input that ended the process.
fn broke(status: ExitStatus, said: &str) -> WorkerEnd {
    let first = said.lines().next().unwrap_or("nothing was said");
    // Names of threads and processes differ.
    let words = ["overflowed its stack", "memory allocation of"];
    let known = words.iter().find(|words| said.contains(**words));
    let what = known.map_or_else(|| without_numbers(first), |words| (*words).to_owned());
    WorkerEnd::Broke {
        what: format!("abort: {what}"),
        detail: format!("{status}: {}", beginning(said)),
    }
}

/// Waits until a worker ends. A worker ends itself when it computes for too long; one that waits without
/// computing is ended here.
fn wait(child: &mut Child, tally: &Path, patience: Duration) -> io::Result<Option<ExitStatus>> {
    let mut seen = None;
    let mut since = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        let now = Tally::read(tally)?.map(|tally| (tally.number, tally.attempt, tally.executions));
        if now != seen {
            (seen, since) = (now, Instant::now());
        } else if since.elapsed() > patience.saturating_mul(WALL) {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        thread::sleep(LOOK);
    }
}

fn read_findings(path: &Path) -> io::Result<Vec<Finding>> {
    let lines = BufReader::new(File::open(path)?).lines();
    // The last line may be one that was cut off.
    let read = |line: io::Result<String>| line.map(|line| serde_json::from_str(&line).ok());
    lines.filter_map(|line| read(line).transpose()).collect()
}
