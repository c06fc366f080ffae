//! Progress on the standard error: a bar on a terminal, a line a run elsewhere.

use std::io::{self, IsTerminal};
use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::{ProgressBar, ProgressStyle};

use crate::failure::say;

const PARTS: u64 = 100;

/// The progress of several runs at a time.
#[derive(Debug)]
pub struct Progress {
    bar: Option<ProgressBar>,
    runs: usize,
    done: AtomicUsize,
    quiet: bool,
}

impl Progress {
    /// The progress of this many runs.
    pub fn new(runs: usize, quiet: bool) -> Self {
        let bar = (!quiet && io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::new(runs as u64 * PARTS);
            if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}") {
                bar.set_style(style);
            }
            bar.set_message(format!("0 of {runs} runs"));
            bar
        });
        Self {
            bar,
            runs,
            done: AtomicUsize::new(0),
            quiet,
        }
    }

    /// What one run reports to while it goes on.
    pub fn of_run(&self, duration: f64) -> impl FnMut(f64) {
        let mut reached = 0;
        move |time| {
            let now = ((time / duration * PARTS as f64) as u64).min(PARTS);
            if let Some(bar) = self.bar.as_ref().filter(|_| now > reached) {
                bar.inc(now - reached);
                reached = now;
            }
        }
    }

    /// One run is done.
    pub fn done(&self, name: &str, how: &str) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        match &self.bar {
            Some(bar) => bar.set_message(format!("{done} of {} runs", self.runs)),
            None if self.quiet => {}
            None => say(&format!("{done:>2} of {} runs: {name}, {how}", self.runs)),
        }
    }

    /// All are done.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
