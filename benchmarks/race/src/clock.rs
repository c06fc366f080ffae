//! CPU time and wall time of a part of this process.

use std::time::Instant;

use cpu_time::ProcessTime;

/// Measures times since it was started.
#[derive(Clone, Copy, Debug)]
pub struct Stopwatch {
    cpu: ProcessTime,
    wall: Instant,
}

impl Stopwatch {
    /// Starts a stopwatch.
    #[must_use]
    pub fn start() -> Self {
        Self {
            cpu: ProcessTime::now(),
            wall: Instant::now(),
        }
    }

    /// Returns the CPU time that this process has used since the start, s.
    #[must_use]
    pub fn cpu(&self) -> f64 {
        self.cpu.elapsed().as_secs_f64()
    }

    /// Returns the time since the start, s.
    #[must_use]
    pub fn wall(&self) -> f64 {
        self.wall.elapsed().as_secs_f64()
    }
}
