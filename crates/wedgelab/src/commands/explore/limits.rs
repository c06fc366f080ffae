//! Limits of one request, of one connection and of all together. `docs/explore.md` states the same.

use std::time::Duration;

use study::models::AnyCase;

/// Rows of output of a run, at most: one such run and its answer take some 40 MB.
pub const ROWS: u64 = 20_001;
/// Size of a request's body, bytes.
pub const BODY: usize = 256 * 1024;
/// Number of changes in a request.
pub const CHANGES: usize = 200;
/// Length of a change's path and of a preset's name, bytes.
pub const NAME: usize = 200;
/// Length of a change's text, bytes.
pub const TEXT: usize = 64 * 1024;
/// Size of a request's first line and headers, bytes.
pub const HEAD: usize = 16 * 1024;
/// Connections at once that have shown the token; further ones stay strangers.
pub const CONNECTIONS: usize = 64;
/// Connections at once that have not; a further one ends the oldest.
pub const STRANGERS: usize = 64;
/// Runs and files being made or sent at once; further ones wait.
pub const ANSWERS: usize = 4;
/// Stack of a thread that makes an answer, bytes: a reader that goes one level down for every byte of a text
/// of [`TEXT`] bytes still finds room.
pub const STACK: usize = 32 * 1024 * 1024;

/// Times that the server waits for clients.
#[derive(Clone, Copy, Debug)]
pub struct Patience {
    /// For a request's first line and headers; also for the next request on an open connection.
    pub head: Duration,
    /// For a request's body.
    pub body: Duration,
    /// For a client that takes nothing of its answer.
    pub write: Duration,
    /// For open connections at the end.
    pub end: Duration,
}

impl Default for Patience {
    fn default() -> Self {
        Self {
            head: Duration::from_secs(15),
            body: Duration::from_secs(15),
            write: Duration::from_secs(20),
            end: Duration::from_secs(2),
        }
    }
}

/// Longest run of a car, s: a page is waited for.
pub const CAR_SECONDS: f64 = 60.0;

/// A run that is too long, and what to do about it.
#[derive(Debug, PartialEq, Eq)]
pub struct TooLong {
    /// The key that makes it so.
    pub path: &'static str,
    /// The mistake.
    pub message: String,
    /// The remedy: text to type.
    pub help: String,
}

/// Refuses a run of more rows than [`ROWS`], and of a car of more time than [`CAR_SECONDS`].
///
/// # Errors
/// The run is longer.
pub fn check(case: &AnyCase) -> Result<(), TooLong> {
    let [duration, interval] = case.duration_and_interval();
    if case.car().is_some() && duration > CAR_SECONDS {
        return Err(TooLong {
            path: "simulation.duration",
            message: format!("{duration} s of a car are more than {CAR_SECONDS} s, which is the most here"),
            help: "write a shorter simulation.duration, or run the case with `wedgelab run`".to_owned(),
        });
    }
    rows([duration, interval])
}

/// Refuses a run of more rows than [`ROWS`].
///
/// # Errors
/// The run has more.
fn rows([duration, interval]: [f64; 2]) -> Result<(), TooLong> {
    let most = (ROWS - 1) as f64;
    // As much is forgiven as in the count of rows: 200 s in steps of 0.01 s are 20,001 rows.
    if duration / interval <= most * (1.0 + 1e-12) {
        return Ok(());
    }
    Err(TooLong {
        path: "simulation.output_interval",
        message: format!(
            "{duration} s in steps of {interval} s are more than {ROWS} rows of output, which is the most \
             here"
        ),
        help: format!(
            "write {} s or more for simulation.output_interval, or run the case with `wedgelab run`",
            rounded_up(duration / most)
        ),
    })
}

/// Returns the next number of two digits that is not smaller.
fn rounded_up(value: f64) -> f64 {
    let step = 10_f64.powf(value.log10().floor() - 1.0);
    let digits = format!("{:.1e}", (value / step * (1.0 - 1e-12)).ceil() * step);
    digits.parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_counted_before_they_are_made() {
        assert_eq!(rows([200.0, 0.01]), Ok(()));
        assert_eq!(rows([10.0, 0.01]), Ok(()));
        let refused = rows([10.0, 1e-8]).unwrap_err();
        assert!(refused.message.contains("more than 20001 rows"), "{refused:?}");
        assert!(refused.help.contains("write 0.0005 s or more"), "{refused:?}");
        for (duration, interval) in [
            (7.0, 1e-5),
            (1e12, 1.0),
            (3e-7, 1e-15),
            (201.0, 0.01),
            (1e300, 1.0),
        ] {
            assert!(rows([duration, interval]).is_err());
            let advised = rounded_up(duration / (ROWS - 1) as f64);
            assert_eq!(
                rows([duration, advised]),
                Ok(()),
                "{duration} s in steps of {advised} s"
            );
        }
    }
}
