//! Check that the processor has the instructions that the program was compiled for.
//!
//! The repository's `.cargo/config.toml` compiles for processors of the kind x86-64-v3 (AVX2; Intel since
//! 2013, AMD since 2015). On an older one such a program would be stopped by the system at its first vector
//! instruction, without a word: the command and FMUs ask here first.

/// The processor lacks instructions that the program was compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "this program was compiled for processors with AVX2 (nearly all since 2013), which this one does not have"
)]
pub struct OldProcessor;

impl OldProcessor {
    /// Advice for the user.
    pub const ADVICE: &str = "Compile it for all processors: `RUSTFLAGS=\"-C target-cpu=x86-64\" cargo build \
        --release`. It computes the same numbers, in a quarter more time.";
}

/// Checks whether the program can run on this processor.
///
/// # Errors
/// If it was compiled for AVX2 and the processor has none.
#[inline(never)]
pub fn check() -> Result<(), OldProcessor> {
    if cfg!(target_feature = "avx2") && !has_avx2() {
        return Err(OldProcessor);
    }
    Ok(())
}

/// Asked of the processor itself: the standard library's macro takes for granted what the program was
/// compiled for.
#[cfg(target_arch = "x86_64")]
fn has_avx2() -> bool {
    use std::arch::x86_64::{__cpuid, __cpuid_count};
    /// The system keeps vector registers (leaf 1, ECX): AVX may be used.
    const SYSTEM_KEEPS_STATE: u32 = 1 << 27;
    /// BMI1, AVX2, BMI2 (leaf 7, EBX).
    const THIRD_LEVEL: u32 = 1 << 3 | 1 << 5 | 1 << 8;
    __cpuid(0).eax >= 7
        && __cpuid(1).ecx & SYSTEM_KEEPS_STATE != 0
        && __cpuid_count(7, 0).ebx & THIRD_LEVEL == THIRD_LEVEL
}

/// Other processors have other instructions.
#[cfg(not(target_arch = "x86_64"))]
fn has_avx2() -> bool {
    false
}

#[cfg(test)]
mod tests {
    #[test]
    fn what_runs_the_tests_was_compiled_for_this_processor() {
        assert_eq!(super::check(), Ok(()));
        // The macro reads the feature at run time only if it was not compiled in.
        #[cfg(all(target_arch = "x86_64", not(target_feature = "avx2")))]
        assert_eq!(super::has_avx2(), std::is_x86_feature_detected!("avx2"));
    }
}
