//! The promises of readers in numbers.

use std::time::Duration;

/// Bytes of the longest input that is made.
pub const LONGEST_INPUT: usize = 1 << 20;

/// Bytes of the longest text of a refusal.
pub const LONGEST_MESSAGE: usize = 64 << 10;

/// Largest number of mistakes of one input that may be printed; `None`: any number.
pub const MOST_MISTAKES: Option<usize> = Some(input::limits::MISTAKES);

/// True if numbers that a comparison gives must be finite.
pub const FINITE_COMPARISONS: bool = true;

/// Processor time of the longest execution on a machine as fast as that of [`crate::reference`], in the dev
/// profile, which is what the program is compiled with; without the [`ATTEMPT`]s of an integrator.
pub const LONGEST_EXECUTION: Duration = Duration::from_secs(1);

/// Processor time of an attempted step of the integrator on that machine, dev profile. Their number has a
/// bound of its own, [`study::progress::most_attempts`].
pub const ATTEMPT: Duration = Duration::from_micros(15);

/// Bytes of memory that a process with one reader may hold at a time.
pub const MOST_MEMORY: usize = 1 << 30;

/// Bytes of the stack: what threads of the standard library have, on which the explorer reads.
pub const STACK: usize = 2 << 20;
