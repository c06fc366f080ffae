//! Benchmarks: how fast, with caveats.
//!
//! Wall times depend on the machine and on what else it does: compare within one run, and trust ratios of 1.2 and more.
//! Instruction counts (`valgrind --tool=callgrind`) repeat to the last digit for the same binary.

pub mod circle;
pub mod truck;
pub mod wedges;

use mechanics::small::System;
use nucars::truck::Choices;
use rustix::time::{ClockId, clock_gettime};
use study::truck::catalog;
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

/// A half-truck of the catalog ([`catalog::entries`]) with its bolster going down and its wedges sliding, and its state.
///
/// # Errors
/// There is no such run, or it makes no system.
pub fn sliding_truck(name: &str) -> Result<(System, Vec<f64>), String> {
    let entry = catalog::entry(name).ok_or_else(|| format!("there is no run {name}"))?;
    let case = entry.case(&Choices::default(), 1.0)?;
    let body = case
        .truck
        .body(1)
        .ok_or_else(|| format!("{name} has no body 1"))?;
    let system = System::new(case.truck.model.clone()).map_err(|error| error.to_string())?;
    let mut x = system.initial_state();
    let count = system.layout().speeds;
    let height = system
        .position_of(body, 2)
        .ok_or_else(|| format!("{name}: body 1 does not move up and down"))?;
    x[height] = -0.01;
    x[count + height] = -0.04;
    for place in case.truck.wedges() {
        if let Some(deflection) = system.deflection_of(place) {
            x[deflection] = -1e-4;
        }
    }
    Ok((system, x))
}

/// CPU time that this process has used, s.
#[must_use]
pub fn cpu_seconds() -> f64 {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}
