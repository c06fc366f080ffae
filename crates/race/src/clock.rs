//! CPU time of this process.

use rustix::time::{ClockId, clock_gettime};

/// CPU time that this process has used, s.
#[must_use]
pub fn cpu_seconds() -> f64 {
    seconds(ClockId::ProcessCPUTime)
}

/// Time of a clock that nobody sets, s.
#[must_use]
pub fn wall_seconds() -> f64 {
    seconds(ClockId::Monotonic)
}

fn seconds(clock: ClockId) -> f64 {
    let now = clock_gettime(clock);
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}
