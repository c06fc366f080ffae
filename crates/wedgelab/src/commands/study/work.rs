//! Computing what a study lacks, several runs at a time.

use std::io::{self, IsTerminal};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use report::study_folder::{StudyFolder, StudyFolderError};
use report::study_work;
use study::design::Study;

use crate::failure::say;
use crate::interrupt;

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

/// Computes all runs that have no record.
pub fn all(study: &Study, folder: &StudyFolder, jobs: usize, quiet: bool) -> Result<Done, StudyFolderError> {
    let begun = study_work::begun(folder)?;
    let progress = Progress::new(study.count(), begun.runs, quiet);
    let computed = study_work::compute(study, folder, jobs, interrupt::flag(), &|| progress.done());
    let now = progress.finish();
    computed?;
    Ok(Done {
        before: begun.runs,
        now,
        interrupted: begun.runs + now < study.count(),
        lost: begun.lost,
    })
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
