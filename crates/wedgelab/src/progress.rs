//! Progress on the standard error: a bar on a terminal, a line a run elsewhere.

use std::io::{self, IsTerminal};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

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
    /// Returns the progress of this many runs.
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

    /// Returns the callback to which one run reports its progress.
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

/// Lines on others than terminals are not closer than this.
const PAUSE: Duration = Duration::from_secs(10);

/// Progress of many things of one kind, with the time left: a bar on a terminal, a line now and then
/// elsewhere.
#[derive(Debug)]
pub struct Steady {
    what: &'static str,
    bar: Option<ProgressBar>,
    quiet: bool,
    all: u64,
    before: u64,
    start: Instant,
    printed: Mutex<(u64, Instant)>,
}

impl Steady {
    /// Returns the progress of `all` things (`runs`), of which some were there before.
    pub fn new(what: &'static str, all: u64, before: u64, quiet: bool) -> Self {
        let bar = (!quiet && io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::new(all);
            let template =
                format!("{{bar:40}} {{human_pos}} of {{human_len}} {what}, {{per_sec}}, {{eta}} left");
            if let Ok(style) = ProgressStyle::with_template(&template) {
                bar.set_style(style);
            }
            bar.set_position(before);
            bar.reset_eta();
            bar
        });
        if before > 0 && before < all && !quiet {
            say(&format!("going on: {before} of {all} {what} are there"));
        }
        let start = Instant::now();
        Self {
            what,
            bar,
            quiet,
            all,
            before,
            start,
            printed: Mutex::new((0, start)),
        }
    }

    /// One more is done.
    pub fn done(&self) {
        let mut printed = self.printed.lock().unwrap_or_else(PoisonError::into_inner);
        printed.0 += 1;
        if let Some(bar) = &self.bar {
            bar.set_position(self.before + printed.0);
        } else if !self.quiet && printed.1.elapsed() >= PAUSE {
            printed.1 = Instant::now();
            let what = self.what;
            let rate = printed.0 as f64 / self.start.elapsed().as_secs_f64();
            let done = self.before + printed.0;
            let left = (self.all - done) as f64 / rate;
            let rate = match rate {
                rate if rate < 1.0 => format!("{rate:.2}"),
                rate if rate < 10.0 => format!("{rate:.1}"),
                rate => format!("{rate:.0}"),
            };
            say(&format!(
                "{done} of {} {what}, {rate} {what}/s, {} left",
                self.all,
                shown(left)
            ));
        }
    }

    /// Ends the progress and returns the number of runs done since the beginning.
    pub fn finish(self) -> u64 {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
        self.printed
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner)
            .0
    }
}

/// Returns a time for people.
pub fn shown(seconds: f64) -> String {
    match seconds {
        s if s < 90.0 => format!("{s:.0} s"),
        s if s < 5400.0 => format!("{:.0} min", s / 60.0),
        s if s < 172_800.0 => format!("{:.1} h", s / 3600.0),
        s => format!("{:.1} days", s / 86_400.0),
    }
}

#[cfg(test)]
mod tests {
    use super::shown;

    #[test]
    fn limits_times_left_are_in_units_for_people() {
        for (seconds, text) in [
            (0.4, "0 s"),
            (89.0, "89 s"),
            (91.0, "2 min"),
            (7200.0, "2.0 h"),
            (259_200.0, "3.0 days"),
        ] {
            assert_eq!(shown(seconds), text);
        }
    }
}
