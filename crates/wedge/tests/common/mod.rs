//! Shared by the tests of this crate: units, runs, and an independent model.
#![allow(dead_code, clippy::unwrap_used, clippy::expect_used)]

pub mod plain;

use integrate::{Event, Integrator, Options};
use mechanics::friction::FrictionLaw;
use mechanics::system::{Observation, System};
use wedge::Wedge;
use wedge::outputs::{Ledger, Outputs};
use wedge::parameters::Parameters;

pub const INCH: f64 = 0.0254;
pub const POUND: f64 = 0.453_592_37;
/// Pound-force, N.
pub const LBF: f64 = POUND * 9.806_65;
/// lbf·in, J.
pub const LBF_IN: f64 = LBF * INCH;
/// lbf/in, N/m.
pub const LBF_PER_IN: f64 = LBF / INCH;

pub const TOE: f64 = 0.2 * std::f64::consts::PI / 180.0;
pub const YAW: f64 = 0.012;

/// The end of a run.
pub struct End {
    pub time: f64,
    pub x: Vec<f64>,
    pub start_energy: f64,
    pub ledger: Ledger,
    pub events: Vec<Event>,
    pub steps: u64,
}

/// Runs a system from a state and shows every row to `each`, the first and the last included.
pub fn run_system(
    system: &System,
    start: &[f64],
    tolerance: f64,
    (until, interval): (f64, f64),
    mut each: impl FnMut(&Observation, &[u8]),
) -> End {
    let mut observer = system.clone();
    let options = Options {
        relative_tolerance: tolerance,
        ..Options::default()
    };
    let mut run = Integrator::new(system.clone(), options, 0.0, start).unwrap();
    let first = observer.observe(0.0, start);
    let start_energy = first.energies.total();
    each(&first, run.discrete_states());
    let (mut row, mut buffer, mut events) = (1, start.to_vec(), Vec::new());
    while run.time() < until {
        run.step_to(until).unwrap();
        events.extend_from_slice(run.events());
        observer.segment_like(run.problem());
        loop {
            // The last row is the end, whatever the rounding of its number times the interval.
            let time = f64::from(row) * interval;
            if time > run.time() + 1e-9 * interval {
                break;
            }
            let time = time.min(run.time());
            run.interpolate(time, &mut buffer);
            each(&observer.observe(time, &buffer), run.discrete_states());
            row += 1;
        }
    }
    let observation = observer.observe(run.time(), run.x());
    End {
        time: run.time(),
        x: run.x().to_vec(),
        start_energy,
        ledger: Outputs::ledger(&observer, &observation, start_energy),
        events,
        steps: run.statistics().steps,
    }
}

/// Runs a wedge from its start.
pub fn run(wedge: &Wedge, tolerance: f64, rows: (f64, f64), each: impl FnMut(&Observation, &[u8])) -> End {
    run_system(&wedge.system, &wedge.initial_state, tolerance, rows, each)
}

/// Longitudinal (normal) and vertical (friction on the side frame) force at the column, N.
pub fn column_forces(observation: &Observation) -> (f64, f64) {
    let face = &observation.faces[wedge::COLUMN];
    (
        face.normal_forces.iter().map(|f| f.0[0]).sum(),
        -face.friction_forces.iter().map(|f| f.0[2]).sum::<f64>(),
    )
}

/// Returns both faces with this law.
pub fn with_law(mut parameters: Parameters, law: FrictionLaw) -> Parameters {
    parameters.column_friction.law = law;
    parameters.slope_friction.law = law;
    parameters
}

/// Returns the bristle with the specification's default values, N/m and N·s/m.
pub fn bristle() -> FrictionLaw {
    FrictionLaw::Bristle {
        stiffness: 1e6 * LBF_PER_IN,
        damping: 1e3 * LBF_PER_IN,
    }
}

/// Returns which of x, y, z, roll, pitch, yaw are free.
pub fn free(names: &[&str]) -> [bool; 6] {
    mechanics::body::COORDINATES.map(|name| names.contains(&name))
}

/// Pseudo-random numbers (SplitMix64), the same on every system.
pub struct Random(pub u64);

impl Random {
    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / 9_007_199_254_740_992.0
    }
    /// Uniform in [a, b).
    pub fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.unit()
    }
    /// Either sign, magnitude log-uniform between `small` and `large`.
    pub fn spread(&mut self, small: f64, large: f64) -> f64 {
        let size = small * (large / small).powf(self.unit());
        if self.unit() < 0.5 { -size } else { size }
    }
}
