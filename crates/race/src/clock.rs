//! CPU time of this process.

/// CPU time that this process has used, s; on systems other than Linux the wall time since the first call.
#[must_use]
pub fn cpu_seconds() -> f64 {
    // Nanoseconds on a processor, of the only thread that there is.
    let text = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    let nanoseconds = text
        .split_whitespace()
        .next()
        .and_then(|word| word.parse::<f64>().ok());
    nanoseconds.map_or_else(wall_seconds, |nanoseconds| nanoseconds * 1e-9)
}

/// Wall time since the first call, s.
#[must_use]
pub fn wall_seconds() -> f64 {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START.get_or_init(std::time::Instant::now).elapsed().as_secs_f64()
}
