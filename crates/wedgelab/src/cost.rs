//! What many runs cost, judged by some of them and told before the others begin.

use std::time::Duration;

use crate::folders::size;
use crate::progress::shown;

/// Runs of a sample for each job.
pub const EACH: usize = 2;
/// A sample is taken where so many times as many runs are left.
pub const WORTH: u64 = 5;
/// Less time than this is not worth a word, s.
const SHORT: f64 = 60.0;

/// What runs cost.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// Number of runs that are left, the sample too.
    pub left: u64,
    /// Number of runs of the sample.
    pub sample: u64,
    /// Time in which these were computed.
    pub took: Duration,
    /// Runs at a time.
    pub jobs: usize,
    /// Bytes that a run leaves.
    pub bytes: u64,
}

impl Cost {
    /// Returns the time that all take, s.
    fn time(&self) -> f64 {
        self.took.as_secs_f64() / self.sample.max(1) as f64 * self.left as f64
    }

    /// Returns whether it is worth a word.
    pub fn is_long(&self) -> bool {
        self.time() >= SHORT
    }

    /// Returns it in words.
    pub fn words(&self) -> String {
        if self.sample == 0 {
            return "no run is left to compute".to_owned();
        }
        let time = self.time();
        format!(
            "{} runs: about {} at {} at a time, {} of cores, {} on the disk (judged by {} of them, which are \
             kept)",
            self.left,
            shown(time),
            self.jobs,
            shown(self.jobs as f64 * time),
            size(self.left * self.bytes),
            self.sample
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_cost_is_the_samples_times_the_runs() {
        let cost = Cost {
            left: 1000,
            sample: 4,
            took: Duration::from_secs(10),
            jobs: 2,
            bytes: 310,
        };
        let words = "1000 runs: about 42 min at 2 at a time, 83 min of cores, 310 kB on the disk (judged \
                     by 4 of them, which are kept)";
        assert_eq!(cost.words(), words);
        assert!(cost.is_long());
        let done = Cost {
            left: 0,
            sample: 0,
            ..cost
        };
        assert!(!done.is_long() && done.words() == "no run is left to compute");
    }
}
