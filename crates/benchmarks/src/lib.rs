//! Benchmarks: how fast, with caveats.
//!
//! Wall times depend on the machine and on what else it does: compare within one run, and trust ratios of 1.2 and more.
//! Instruction counts (`valgrind --tool=callgrind`) repeat to the last digit for the same binary.

use wedge::parameters::Damping;
use wedge::{BuildError, Wedge, thesis};

/// A wedge in the middle of a branch, pressed into both faces and sliding, toe out and yawed, and its state.
///
/// # Errors
/// The thesis's parameters make no wedge, which would be a defect.
pub fn sliding_wedge(damping: Damping) -> Result<(Wedge, Vec<f64>), BuildError> {
    let wedge = Wedge::new(thesis::parameters(damping, 0.003, 0.012))?;
    let mut x = wedge.initial_state.clone();
    x[1] = 2e-5;
    x[3] = 0.006;
    x[5] = -0.04;
    Ok((wedge, x))
}
