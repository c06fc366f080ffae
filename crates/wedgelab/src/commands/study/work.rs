//! Computing what a study lacks, several runs at a time.

use std::io::{self, IsTerminal};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use report::study_folder::{StudyFolder, StudyFolderError};
use study::design::Study;
use study::records;

use crate::failure::say;

/// What was done.
#[derive(Debug)]
pub struct Done {
    /// Runs that were there before.
    pub before: u64,
    /// Runs computed now.
    pub now: u64,
    /// Whether the user stopped it.
    pub interrupted: bool,
    /// Bytes of records that were cut off or damaged.
    pub lost: usize,
}

/// What is still to be done: the runs of one part, then of the next.
struct Queue {
    part: u64,
    numbers: std::vec::IntoIter<u64>,
}

/// Computes all runs that have no record.
pub fn all(study: &Study, folder: &StudyFolder, jobs: usize, quiet: bool) -> Result<Done, StudyFolderError> {
    let (mut before, mut lost) = (0, 0);
    for part in 0..folder.parts() {
        let found = folder.part(part)?;
        let count = found.records.len() as u64;
        before += count;
        // What was computed again since then needs no word.
        if count < folder.numbers(part).end - folder.numbers(part).start {
            lost += found.lost;
        }
    }
    let stop = on_interrupt();
    let progress = Progress::new(study.count(), before, quiet);
    let queue = Mutex::new(Queue {
        part: 0,
        numbers: Vec::new().into_iter(),
    });
    let failure: Mutex<Option<StudyFolderError>> = Mutex::new(None);
    let fail = |error| {
        stop.store(true, Ordering::Relaxed);
        let mut first = failure.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert(error);
    };
    let next = || -> Option<u64> {
        let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            if let Some(number) = queue.numbers.next() {
                return Some(number);
            }
            if queue.part >= folder.parts() {
                return None;
            }
            match folder.missing(queue.part) {
                Ok(numbers) => queue.numbers = numbers.into_iter(),
                Err(error) => {
                    fail(error);
                    return None;
                }
            }
            queue.part += 1;
        }
    };
    let worker = || {
        while !stop.load(Ordering::Relaxed) {
            let Some(number) = next() else { return };
            let record = records::run(study, number);
            match folder.keep(&record) {
                Ok(()) => progress.done(),
                Err(error) => return fail(error),
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..jobs {
            scope.spawn(worker);
        }
    });
    let now = progress.finish();
    let failed = failure.into_inner().unwrap_or_else(PoisonError::into_inner);
    match failed {
        Some(error) => Err(error),
        None => Ok(Done {
            before,
            now,
            interrupted: before + now < study.count(),
            lost,
        }),
    }
}

/// Becomes true when the user presses Ctrl-C: runs under way are finished then. Pressed again, it ends the program at once, as
/// safe for the study as any other end.
fn on_interrupt() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let seen = Arc::clone(&stop);
    std::thread::spawn(move || {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_io().build();
        let Ok(runtime) = runtime else { return };
        if runtime.block_on(tokio::signal::ctrl_c()).is_ok() {
            say("stopping: the runs under way are finished and kept (Ctrl-C again: at once)");
            seen.store(true, Ordering::Relaxed);
        }
        if runtime.block_on(tokio::signal::ctrl_c()).is_ok() {
            std::process::exit(i32::from(crate::failure::FAILED));
        }
    });
    stop
}

/// Lines on others than terminals are not closer than this.
const PAUSE: Duration = Duration::from_secs(10);

/// Progress with the time left: a bar on a terminal, a line now and then elsewhere.
struct Progress {
    bar: Option<ProgressBar>,
    quiet: bool,
    runs: u64,
    before: u64,
    start: Instant,
    told: Mutex<(u64, Instant)>,
}

impl Progress {
    fn new(runs: u64, before: u64, quiet: bool) -> Self {
        let bar = (!quiet && io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::new(runs);
            let template = "{bar:40} {human_pos} of {human_len} runs, {per_sec}, {eta} left";
            if let Ok(style) = ProgressStyle::with_template(template) {
                bar.set_style(style);
            }
            bar.set_position(before);
            bar.reset_eta();
            bar
        });
        if before > 0 && before < runs && !quiet {
            say(&format!("going on: {before} of {runs} runs are there"));
        }
        let start = Instant::now();
        Self {
            bar,
            quiet,
            runs,
            before,
            start,
            told: Mutex::new((0, start)),
        }
    }

    fn done(&self) {
        let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        told.0 += 1;
        if let Some(bar) = &self.bar {
            bar.set_position(self.before + told.0);
        } else if !self.quiet && told.1.elapsed() >= PAUSE {
            told.1 = Instant::now();
            let rate = told.0 as f64 / self.start.elapsed().as_secs_f64();
            let done = self.before + told.0;
            let left = (self.runs - done) as f64 / rate;
            say(&format!(
                "{done} of {} runs, {rate:.0} runs/s, {} left",
                self.runs,
                shown(left)
            ));
        }
    }

    /// All are done; gives their number.
    fn finish(self) -> u64 {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
        self.told.into_inner().unwrap_or_else(PoisonError::into_inner).0
    }
}

/// A time for people.
fn shown(seconds: f64) -> String {
    match seconds {
        s if s < 90.0 => format!("{s:.0} s"),
        s if s < 5400.0 => format!("{:.0} min", s / 60.0),
        s if s < 172_800.0 => format!("{:.1} h", s / 3600.0),
        s => format!("{:.1} days", s / 86_400.0),
    }
}
