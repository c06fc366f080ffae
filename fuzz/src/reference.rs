//! A reference workload: how fast this machine is at the moment, compared with the one on which
//! [`limits::LONGEST_EXECUTION`](crate::limits::LONGEST_EXECUTION) was chosen.
//!
//! A limit of processor time depends on the machine: on a processor whose core is shared with another thread
//! an input takes up to twice as long. The workload does what readers do (numbers to text and back,
//! allocation, sorting), so that it takes longer by the same factor.

use std::hint::black_box;
use std::time::Duration;

use cpu_time::ThreadTime;

/// Numbers of the workload.
const COUNT: u32 = 100_000;

/// Processor time of the workload on the machine of the limit (AVX2, nothing beside).
const NOMINAL: Duration = Duration::from_millis(45);

/// Returns the factor by which this machine is slower at the moment than that of the limit; at least 1.
#[must_use]
pub fn slowdown() -> f64 {
    let start = ThreadTime::now();
    black_box(workload());
    (start.elapsed().as_secs_f64() / NOMINAL.as_secs_f64()).max(1.0)
}

fn workload() -> f64 {
    let mut texts: Vec<String> = (1..=COUNT).map(|n| (1.0 / f64::from(n)).to_string()).collect();
    texts.sort_unstable();
    texts.iter().filter_map(|text| text.parse::<f64>().ok()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_workload_is_done() {
        // The harmonic number ln n + γ + 1/2n.
        let n = f64::from(COUNT);
        assert!((workload() - n.ln() - 0.577_215_664_901_5 - 0.5 / n).abs() < 1e-9);
        assert!(slowdown() >= 1.0);
    }
}
