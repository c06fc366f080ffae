//! Machine and date of a measurement, which stand beside every number on a page.

use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

use crate::shell;

/// A machine, a day and a compiler.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Machine {
    /// The processor as it reports itself.
    pub processor: String,
    /// Number of processors that a program may use.
    pub cores: usize,
    /// The day (UTC), such as 2026-11-25.
    pub date: String,
    /// The version of rustc, such as 1.95.0.
    pub rustc: String,
}

impl Machine {
    /// This machine, today.
    pub fn here() -> Self {
        let processors = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let rustc = shell::output(Command::new("rustc").arg("--version")).unwrap_or_default();
        let seconds = SystemTime::now().duration_since(UNIX_EPOCH);
        Self {
            processor: processor(&processors).unwrap_or_else(|| std::env::consts::ARCH.to_owned()),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            date: date(seconds.map_or(0, |since| since.as_secs() / 86_400)),
            rustc: rustc.split_whitespace().nth(1).unwrap_or("unknown").to_owned(),
        }
    }
}

/// Returns the processor's name in what Linux says of it.
fn processor(text: &str) -> Option<String> {
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    let (_, name) = line.split_once(':')?;
    Some(name.trim().to_owned())
}

/// Returns the date of a day since 1970-01-01, in the Gregorian calendar.
fn date(mut days: u64) -> String {
    let leap = |year: u64| year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    let mut year = 1970;
    while days >= 365 + u64::from(leap(year)) {
        days -= 365 + u64::from(leap(year));
        year += 1;
    }
    let february = 28 + u64::from(leap(year));
    let mut month = 1;
    for length in [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31] {
        if days < length {
            break;
        }
        days -= length;
        month += 1;
    }
    format!("{year}-{month:02}-{:02}", days + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_have_dates() {
        assert_eq!(date(0), "1970-01-01");
        assert_eq!(date(59), "1970-03-01");
        assert_eq!(date(11_016), "2000-02-29");
        assert_eq!(date(20_782), "2026-11-25");
        assert_eq!(date(20_818), "2026-12-31");
    }

    #[test]
    fn a_processor_has_a_name() {
        let text = "processor\t: 0\nmodel name\t: Some CPU @ 2.60GHz\nflags\t: fpu\n";
        assert_eq!(processor(text).as_deref(), Some("Some CPU @ 2.60GHz"));
        assert_eq!(processor(""), None);
    }
}
