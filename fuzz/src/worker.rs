//! A worker: one reader, one input after the other, until its time is over or it breaks.

use std::cell::RefCell;
use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::panic::{self, PanicHookInfo};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use clap::Args;
use cpu_time::{ProcessTime, ThreadTime};
use fuzz::inputs::Inputs;
use fuzz::limits::{ATTEMPT, LONGEST_EXECUTION, MOST_MEMORY, STACK};
use fuzz::readers::{self, ReadOutcome, Reader};
use fuzz::{reference, shown};

use crate::MEMORY;
use crate::finding::{Finding, beginning, without_numbers};
use crate::tally::{Tally, TallyFile};

/// The file of counts in a worker's folder.
pub const TALLY: &str = "tally";
/// The file of findings, one a line.
pub const FINDINGS: &str = "findings";

/// The file of the messages about a single input.
pub const MESSAGES: &str = "messages";

/// The arguments of a worker.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The reader
    #[arg(long)]
    reader: String,
    /// Seed of the inputs
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// The first number
    #[arg(long, default_value_t = 0)]
    from: u64,
    /// The number after the last one
    #[arg(long, default_value_t = u64::MAX)]
    until: u64,
    /// For how long
    #[arg(long)]
    seconds: Option<f64>,
    /// Seconds of processor time after which an input is given up
    #[arg(long)]
    patience: f64,
    /// Folder of counts and findings
    #[arg(long)]
    folder: PathBuf,
    /// This file's content is the only input
    #[arg(long)]
    input: Option<PathBuf>,
}

/// Exit code: an input took too long.
pub const GIVEN_UP: u8 = 3;

/// The beginning of this process's processor time.
static START: LazyLock<ProcessTime> = LazyLock::new(ProcessTime::now);

/// Processor time of this process when it began the input that it reads, ns.
static STARTED: AtomicU64 = AtomicU64::new(u64::MAX);

/// Ends this process when it has computed for too long on one input.
fn end_when_patience_ends(patience: Duration) {
    const LOOK: Duration = Duration::from_millis(50);
    let patience = patience.as_nanos() as u64;
    std::thread::spawn(move || {
        loop {
            std::thread::sleep(LOOK);
            // Started later than now: nothing is read.
            let since = used().checked_sub(STARTED.load(Ordering::Relaxed));
            if since.is_some_and(|since| since > patience) {
                std::process::exit(i32::from(GIVEN_UP));
            }
        }
    });
}

/// Ends this process with its parent, whose end closes the standard input.
fn end_with_parent() {
    std::thread::spawn(|| {
        let _ = io::copy(&mut io::stdin(), &mut io::sink());
        std::process::exit(i32::from(crate::WRONG));
    });
}

/// Runs the worker. On a thread with the stack that readers must do with.
pub fn work(arguments: &Arguments) -> ExitCode {
    end_with_parent();
    end_when_patience_ends(Duration::try_from_secs_f64(arguments.patience).unwrap_or(Duration::MAX));
    let done = std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK);
        let handle = thread.spawn_scoped(scope, || begin(arguments))?;
        handle
            .join()
            .unwrap_or_else(|_| Err(io::Error::other("the worker itself panicked")))
    });
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("the worker cannot work: {error}");
            ExitCode::from(crate::WRONG)
        }
    }
}

fn begin(arguments: &Arguments) -> io::Result<()> {
    let reader =
        readers::find(&arguments.reader).ok_or_else(|| io::Error::other("there is no such reader"))?;
    let mut worker = Worker::new(reader, &arguments.folder)?;
    panic::set_hook(Box::new(note_panic));
    if let Some(file) = &arguments.input {
        shown::listen();
        worker.execute(0, &std::fs::read(file)?)?;
        std::fs::write(arguments.folder.join(MESSAGES), shown::heard().join("\n"))?;
        return worker.note();
    }
    let inputs = Inputs::of(reader);
    // What is made once does not belong to the first input.
    let first = inputs.input(arguments.seed, 0);
    let _ = panic::catch_unwind(|| (reader.read)(&first));
    let _ = MEMORY.set_limit(MOST_MEMORY);
    let end = arguments
        .seconds
        .map(|seconds| Instant::now() + Duration::try_from_secs_f64(seconds).unwrap_or_default());
    for number in arguments.from..arguments.until {
        if end.is_some_and(|end| Instant::now() >= end) {
            break;
        }
        worker.execute(number, &inputs.input(arguments.seed, number))?;
    }
    worker.note()
}

struct Worker {
    reader: &'static Reader,
    tally: Tally,
    file: TallyFile,
    findings: File,
}

impl Worker {
    fn new(reader: &'static Reader, folder: &Path) -> io::Result<Self> {
        Ok(Self {
            reader,
            tally: Tally::default(),
            file: TallyFile::create(&folder.join(TALLY))?,
            findings: OpenOptions::new()
                .append(true)
                .create(true)
                .open(folder.join(FINDINGS))?,
        })
    }

    fn note(&mut self) -> io::Result<()> {
        self.tally.memory = MEMORY.max_allocated() as u64;
        self.file.write(&self.tally)
    }

    /// Reads an input; what breaks a promise is written down.
    fn execute(&mut self, number: u64, input: &[u8]) -> io::Result<()> {
        self.tally.number = number;
        self.tally.attempt = 0;
        self.note()?;
        let (mut time, outcome) = self.measured(input);
        let attempts = outcome.as_ref().map_or(0, |outcome| outcome.attempts);
        let nominal = LONGEST_EXECUTION + ATTEMPT * u32::try_from(attempts).unwrap_or(u32::MAX);
        let mut longest = nominal;
        if time > longest {
            // Once more, with the speed of the machine before and after: another program may share the core.
            self.tally.attempt = 1;
            self.note()?;
            let before = reference::slowdown();
            time = time.min(self.measured(input).0);
            longest = nominal.mul_f64(before.max(reference::slowdown()));
        }
        self.tally.executions += 1;
        self.tally.slowest = self.tally.slowest.max(time.as_nanos() as u64);
        match outcome {
            Ok(outcome) => {
                self.tally.accepted += u64::from(outcome.accepted);
                self.tally.refused += u64::from(!outcome.accepted);
                self.tally.message = self.tally.message.max(outcome.message as u64);
            }
            Err(panic) => self.write(Finding {
                what: panic.what,
                detail: panic.detail,
                number,
                length: input.len(),
            })?,
        }
        if time > longest {
            let [time, longest] = [time, longest].map(|time| time.as_secs_f64());
            self.write(Finding {
                what: "too slow".to_owned(),
                detail: format!("{time:.2} s of processor time, {longest:.2} s are admissible here"),
                number,
                length: input.len(),
            })?;
        }
        Ok(())
    }

    fn measured(&self, input: &[u8]) -> (Duration, Result<ReadOutcome, Panic>) {
        STARTED.store(used(), Ordering::Relaxed);
        let start = ThreadTime::now();
        let outcome = panic::catch_unwind(|| (self.reader.read)(input));
        (start.elapsed(), outcome.map_err(|_| last_panic()))
    }

    fn write(&mut self, finding: Finding) -> io::Result<()> {
        let mut line = serde_json::to_vec(&finding)?;
        line.push(b'\n');
        self.findings.write_all(&line)
    }
}

/// Returns the processor time that this process has used, ns.
fn used() -> u64 {
    START.elapsed().as_nanos() as u64
}

/// A panic.
#[derive(Default)]
struct Panic {
    what: String,
    detail: String,
}

thread_local! {
    static LAST: RefCell<Panic> = RefCell::default();
}

fn last_panic() -> Panic {
    LAST.with_borrow_mut(std::mem::take)
}

fn note_panic(info: &PanicHookInfo<'_>) {
    let place = info.location().map_or_else(String::new, ToString::to_string);
    let message = info.payload_as_str().unwrap_or("no message");
    // A broken promise is known by the words before the colon; a mistake of the code by its place.
    let own = file!()
        .strip_suffix("worker.rs")
        .is_some_and(|folder| place.starts_with(folder));
    let kind = if own {
        message.split(':').next().unwrap_or_default()
    } else {
        message
    };
    LAST.set(Panic {
        what: match own {
            true => without_numbers(kind),
            false => format!("panic at {}: {}", shorter(&place), without_numbers(kind)),
        },
        detail: format!("{}: {}", shorter(&place), beginning(message)),
    });
}

/// Returns a place without the folders in front of the crate.
fn shorter(place: &str) -> &str {
    let marks = ["crates/", "registry/src/", "library/"];
    let found = marks.iter().find_map(|mark| place.find(mark));
    found.map_or(place, |at| &place[at..])
}
